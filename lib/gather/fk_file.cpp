// SPDX-License-Identifier: BSD-3-Clause
#include "gather/fk_file.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "gather/spectrum_file.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {
namespace {

using Type = NetcdfFile::Type;

std::string definition_of(const FkFacts& facts, const FkSpectra& spectra) {
  const FkTransform& transform = spectra.transform();
  const std::string x(1, spectra.direction());
  return std::string(facts.settings.power
                         ? "energy density 2 |F|^2 (|F|^2 at f = 0 and at the Nyquist frequency)"
                         : "amplitude |F|") +
         ", F = dt d" + x + " sum v w u exp(-2 pi i (f t - k " + x + ")); window w over time and v over " +
         x + ": " + name_of(facts.settings.window) + ", not compensated; " +
         std::to_string(transform.zeros_in_time()) + " zeros appended to " +
         std::to_string(facts.axis.count) + " samples of dt = " + shown(facts.axis.interval_s) + " s, " +
         std::to_string(transform.zeros_in_3d()) + " to " + std::to_string(transform.receivers()) +
         " receivers every " + shown(transform.spacing_m(), 9) + " m" +
         (spectra.velocities().empty() ? ""
                                       : "; at k = f/c of each phase velocity c, receivers without zeros");
}

/// What spectra lie over beside the frequency.
struct Rows {
  std::string name, long_name, unit, column;
  std::vector<double> values;
};

Rows rows_of(const FkSpectra& spectra) {
  if (auto velocities = spectra.velocities(); !velocities.empty())
    return {"phase_velocity", "phase velocity", "m s-1", "phase_velocity_m/s", std::move(velocities)};
  return {"wavenumber", "wavenumber", "m-1", "wavenumber_1/m", spectra.transform().wavenumbers_per_m()};
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace

std::string fk_unit(Component component, bool power) {
  const std::string unit = spectrum_unit(component, power);
  return unit.empty() ? "" : unit + (power ? " m2" : " m");
}

void write_fk_netcdf(OutputFile& out, const FkFacts& facts, const FkSpectra& spectra) {
  NetcdfFile file = NetcdfFile::create(out.path_for_libraries(), out.shown_name());
  file.put_attribute("", "Conventions", "CF-1.10");
  file.put_attribute("", "title", facts.settings.power ? "f-k energy spectra" : "f-k amplitude spectra");
  file.put_attribute("", "history", facts.history);
  std::string source;
  for (const std::string& line : facts.source) source.append(source.empty() ? "" : "\n").append(line);
  if (!source.empty()) file.put_attribute("", "source", source);
  file.put_attribute("", "comment", definition_of(facts, spectra));
  const auto put_axis = [&](const std::string& name, const std::string& long_name, const std::string& unit,
                            const std::vector<double>& values) {
    file.define_dimension(name, values.size());
    file.define_variable(name, Type::f64, {name});
    file.put_attribute(name, "long_name", long_name);
    file.put_attribute(name, "units", unit);
    file.put(name, values.data());
  };
  const auto rows = rows_of(spectra);
  put_axis(rows.name,
           rows.long_name + " along " + spectra.direction() + ", above 0 for waves that travel that way",
           rows.unit, rows.values);
  put_axis("frequency", "frequency", "Hz", spectra.transform().frequencies_hz());
  for (const auto& [component, mean] : spectra.means()) {
    const std::string name = name_of(component);
    file.define_variable(name, Type::f64, {rows.name, "frequency"});
    file.put_attribute(name, "long_name",
                       std::string("mean f-k ") + (facts.settings.power ? "power" : "amplitude") + " of " +
                           name + " over " + std::to_string(mean.gathers) + " gathers");
    const std::string unit = fk_unit(component, facts.settings.power);
    if (!unit.empty()) file.put_attribute(name, "units", unit);
    file.put(name, mean.values.data());
  }
  file.close();
  out.commit();
}

void write_fk_text(OutputFile& out, const FkFacts& facts, const FkSpectra& spectra) {
  const auto put = [&](const std::string& text) { out.write(text.data(), text.size()); };
  for (const std::string& line : facts.source) put("# " + line + "\n");
  put("# " + split(facts.history, '\n').back() + "\n# " + definition_of(facts, spectra) + "\n# " +
      rows_of(spectra).column + " frequency_Hz");
  for (const auto& [component, mean] : spectra.means()) {
    const std::string unit = fk_unit(component, facts.settings.power);
    put(" " + std::string(name_of(component)) + (unit.empty() ? "" : "[" + unit + "]") + " (mean of " +
        std::to_string(mean.gathers) + ")");
  }
  put("\n");
  const auto k = rows_of(spectra).values;
  const auto f = spectra.transform().frequencies_hz();
  for (std::size_t j = 0; j < k.size(); ++j) {
    for (std::size_t n = 0; n < f.size(); ++n) {
      std::string line = number(k[j]) + " " + number(f[n]);
      for (const auto& [component, mean] : spectra.means())
        line.append(" ").append(number(mean.values[j * f.size() + n]));
      put(line + "\n");
    }
    put("\n");
  }
  out.commit();
}

}  // namespace slipwave
