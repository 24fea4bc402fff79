// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "gather/spectrum_file.hpp"

namespace slipwave {
namespace {

class SpectrumText final : public SpectrumFile {
 public:
  SpectrumText(OutputFile& out, const SpectrumFacts& facts) : out_(out), facts_(facts) {
    for (const std::string& line : facts.source) put("# " + line + "\n");
    put("# " + split(facts.history, '\n').back() + "\n# " + facts.definition + "\n");
  }

  void add(const TraceHeader& header, std::span<const double> values) override {
    if (++traces_ > 1) put("\n\n");
    put("# trace " + std::to_string(traces_) + ": " + name_of(header.component) + ", shot " +
        std::to_string(header.shot) + ", channel " + std::to_string(header.channel) + ", receiver at " +
        shown(header.receiver_m[0]) + "," + shown(header.receiver_m[2]) + "\n# frequency_Hz " +
        column(header.component) + "\n");
    for (std::size_t k = 0; k < values.size(); ++k)
      put(number(facts_.frequencies_hz[k]) + " " + number(values[k]) + "\n");
  }

  void add_means(const std::map<Component, SpectrumMean>& means) override {
    std::vector<std::vector<double>> columns;
    std::string head = "# frequency_Hz";
    for (const auto& [component, mean] : means) {
      columns.push_back(mean.mean());
      head.append(" ")
          .append(column(component))
          .append(" (mean of ")
          .append(std::to_string(mean.count()))
          .append(")");
    }
    put(head + "\n");
    for (std::size_t k = 0; k < facts_.frequencies_hz.size(); ++k) {
      std::string line = number(facts_.frequencies_hz[k]);
      for (const auto& values : columns) line.append(" ").append(number(values[k]));
      put(line + "\n");
    }
  }

  void finish() override { out_.commit(); }

 private:
  void put(const std::string& text) { out_.write(text.data(), text.size()); }
  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
  }
  std::string column(Component component) const {
    std::string title = name_of(component);
    const std::string unit = spectrum_unit(component, facts_.power);
    if (!unit.empty()) title.append("[").append(unit).append("]");
    return title;
  }

  OutputFile& out_;
  SpectrumFacts facts_;
  std::int64_t traces_ = 0;
};

}  // namespace

std::unique_ptr<SpectrumFile> spectrum_text(OutputFile& out, const SpectrumFacts& facts) {
  return std::make_unique<SpectrumText>(out, facts);
}

std::string definition_of(const SampleAxis& axis, const SpectrumSettings& settings, std::size_t length) {
  const std::string quantity =
      settings.power ? "one-sided energy spectral density 2 |F|^2 (|F|^2 at 0 and at the Nyquist frequency)"
                     : "amplitude spectrum |F|";
  return quantity + ", F = dt sum w x exp(-2 pi i f t); window w: " + name_of(settings.window) +
         ", not compensated; " + std::to_string(length - static_cast<std::size_t>(axis.count)) +
         " zeros appended to " + std::to_string(axis.count) + " samples of dt = " + shown(axis.interval_s) +
         " s";
}

std::string spectrum_unit(Component component, bool power) {
  const std::string unit = cf_unit(unit_of(component));
  if (unit.empty()) return "";
  if (!power) return unit + " Hz-1";
  return (unit.find('-') == std::string::npos ? unit : "(" + unit + ")") + "^2 s Hz-1";
}

}  // namespace slipwave
