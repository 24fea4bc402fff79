// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <vector>

#include "gather/spectrum_file.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {
namespace {

using Type = NetcdfFile::Type;

/// A chunk for every trace would make a file of a million traces mostly index.
constexpr std::size_t chunk_values = 1 << 15;

class SpectrumNetcdf final : public SpectrumFile {
 public:
  SpectrumNetcdf(OutputFile& out, const SpectrumFacts& facts)
      : out_(out),
        facts_(facts),
        file_(NetcdfFile::create(out.path_for_libraries(), out.shown_name())),
        quantity_(facts.power ? "power" : "amplitude"),
        rows_a_chunk_(std::max<std::size_t>(1, chunk_values / facts.frequencies_hz.size())) {
    file_.put_attribute("", "Conventions", "CF-1.10");
    file_.put_attribute("", "title", facts.power ? "energy spectra" : "amplitude spectra");
    file_.put_attribute("", "history", facts.history);
    std::string source;
    for (const std::string& line : facts.source) source.append(source.empty() ? "" : "\n").append(line);
    if (!source.empty()) file_.put_attribute("", "source", source);
    file_.put_attribute("", "comment", facts.definition);
    file_.define_dimension("frequency", facts.frequencies_hz.size());
    file_.define_variable("frequency", Type::f64, {"frequency"});
    describe("frequency", "frequency", "Hz");
    file_.put("frequency", facts.frequencies_hz.data());
  }

  void add(const TraceHeader& header, std::span<const double> values) override {
    if (traces_ == 0) define_traces();
    ++traces_;
    components_.insert(header.component);
    rows_.shot.push_back(static_cast<int>(header.shot));
    rows_.channel.push_back(static_cast<int>(header.channel));
    rows_.component.push_back(static_cast<int>(header.component));
    rows_.source_x.push_back(header.source_m[0]);
    rows_.source_z.push_back(header.source_m[2]);
    rows_.receiver_x.push_back(header.receiver_m[0]);
    rows_.receiver_z.push_back(header.receiver_m[2]);
    rows_.values.insert(rows_.values.end(), values.begin(), values.end());
    if (rows_.shot.size() == rows_a_chunk_) write_rows();
  }

  void add_means(const std::map<Component, SpectrumMean>& means) override {
    for (const auto& [component, mean] : means) {
      const std::string name = name_of(component);
      file_.define_variable(name, Type::f64, {"frequency"});
      describe(name,
               "mean " + quantity_ + " of " + name + " over " + std::to_string(mean.count()) + " traces",
               spectrum_unit(component, facts_.power));
      file_.put(name, mean.mean().data());
    }
  }

  void finish() override {
    write_rows();
    if (components_.size() == 1)
      describe(quantity_, quantity_ + " of " + name_of(*components_.begin()),
               spectrum_unit(*components_.begin(), facts_.power));
    else if (!components_.empty())
      file_.put_attribute(quantity_, "long_name", quantity_ + " of the component of each trace, in its unit");
    file_.close();
    out_.commit();
  }

 private:
  /// Traces that are not in the file yet.
  struct Rows {
    std::vector<int> shot, channel, component;
    std::vector<double> source_x, source_z, receiver_x, receiver_z, values;
  };

  void write_rows() {
    const std::size_t count = rows_.shot.size();
    if (count == 0) return;
    const std::vector<std::size_t> first = {traces_ - count};
    const auto put = [&](const char* name, const auto& column) {
      file_.put(name, first, {count}, column.data());
    };
    put("shot", rows_.shot);
    put("channel", rows_.channel);
    put("component", rows_.component);
    put("source_x", rows_.source_x);
    put("source_z", rows_.source_z);
    put("receiver_x", rows_.receiver_x);
    put("receiver_z", rows_.receiver_z);
    file_.put(quantity_, {first[0], 0}, {count, facts_.frequencies_hz.size()}, rows_.values.data());
    rows_ = {};
  }

  void describe(const std::string& variable, const std::string& long_name, const std::string& units) {
    file_.put_attribute(variable, "long_name", long_name);
    if (!units.empty()) file_.put_attribute(variable, "units", units);
  }

  void define_traces() {
    file_.define_dimension("trace", 0);
    const auto define = [&](const char* name, Type type, const char* long_name, const char* units) {
      file_.define_variable(name, type, {"trace"}, {true, {4096}});
      describe(name, long_name, units);
    };
    define("shot", Type::i32, "shot", "");
    define("channel", Type::i32, "receiver number within its component", "");
    define("component", Type::i32, "component", "");
    std::vector<int> values;
    std::string meanings;
    for (int index = 0; index <= static_cast<int>(Component::other); ++index) {
      values.push_back(index);
      if (index > 0) meanings += ' ';
      meanings += name_of(static_cast<Component>(index));
    }
    file_.put_attribute("component", "flag_values", values);
    file_.put_attribute("component", "flag_meanings", meanings);
    define("source_x", Type::f64, "source x", "m");
    define("source_z", Type::f64, "source depth", "m");
    define("receiver_x", Type::f64, "receiver x", "m");
    define("receiver_z", Type::f64, "receiver depth", "m");
    file_.define_variable(quantity_, Type::f64, {"trace", "frequency"},
                          {true, {rows_a_chunk_, facts_.frequencies_hz.size()}});
  }

  OutputFile& out_;
  SpectrumFacts facts_;
  NetcdfFile file_;
  std::string quantity_;
  std::size_t rows_a_chunk_;
  Rows rows_;
  std::size_t traces_ = 0;
  std::set<Component> components_;
};

}  // namespace

std::unique_ptr<SpectrumFile> spectrum_netcdf(OutputFile& out, const SpectrumFacts& facts) {
  return std::make_unique<SpectrumNetcdf>(out, facts);
}

}  // namespace slipwave
