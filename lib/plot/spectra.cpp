// SPDX-License-Identifier: BSD-3-Clause
#include "plot/spectra.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "gather/fk_file.hpp"
#include "gather/spectrum_file.hpp"
#include "io/netcdf_file.hpp"
#include "plot/ticks.hpp"

namespace slipwave::plot {
namespace {

/// Units of spectra as they are written, and with fraction bars: "s-1 Hz-1" and "1/s/Hz".
std::string with_fraction_bars(const std::string& unit) {
  for (const auto& row : component_rows()) {
    const std::string recorded = typeset_unit(row.unit);
    const bool fraction = recorded.find('/') != std::string::npos;
    auto squared = (fraction ? "(" + recorded + ")" : recorded) + "\u00b2 s/Hz";
    if (unit == spectrum_unit(row.component, false)) return recorded + "/Hz";
    if (unit == spectrum_unit(row.component, true)) return squared;
    if (unit == fk_unit(row.component, false)) return recorded + " m/Hz";
    if (unit == fk_unit(row.component, true)) return squared + " m\u00b2";
  }
  return unit;
}

/// "m/s/Hz" for "m s-1 Hz-1", "(m/s)² s/Hz" for "(m s-1)^2 s Hz-1".
std::string unit_as_shown(const std::string& unit) {
  if (unit == "m s-1 Hz-1 m") return "m\u00b2/s/Hz";
  if (unit == "(m s-1)^2 s Hz-1 m2") return "(m\u00b2/s)\u00b2 s/Hz";
  if (unit == "Pa^2 s Hz-1 m2") return "(Pa m)\u00b2 s/Hz";
  return with_fraction_bars(unit);
}

std::string without_folders(const std::string& path) { return path.substr(path.rfind('/') + 1); }

void read_means(const NetcdfFile& file, const std::optional<Component>& component, Spectra& spectra) {
  for (const auto& variable : file.variables()) {
    if (variable.name == "frequency" || variable.dimensions != std::vector<std::string>{"frequency"})
      continue;
    if (component && variable.name != name_of(*component)) continue;
    spectra.lines.push_back({variable.name,
                             unit_as_shown(file.text_attribute(variable.name, "units").value_or("")),
                             file.get<double>(variable.name)});
  }
}

void read_traces(const NetcdfFile& file, const std::string& variable, const std::optional<Component>& wanted,
                 Spectra& spectra) {
  const auto components = file.get<int>("component");
  const auto x_m = file.get<double>("receiver_x");
  const auto values = file.get<double>(variable);
  const auto bins = spectra.frequencies_hz.size();
  if (components.empty() || x_m.size() != components.size() || values.size() != bins * components.size())
    return;
  const auto component = wanted.value_or(static_cast<Component>(components[0]));
  const auto unit = unit_as_shown(spectrum_unit(component, variable == "power"));
  for (std::size_t n = 0; n < components.size(); ++n) {
    if (components[n] != static_cast<int>(component)) continue;
    const auto first = values.begin() + std::ptrdiff_t(n * bins);
    spectra.lines.push_back({name_of(component), unit, {first, first + std::ptrdiff_t(bins)}});
    spectra.places.push_back(x_m[n]);
  }
  const auto descends =
      std::adjacent_find(spectra.places.begin(), spectra.places.end(), std::greater_equal<>());
  if (descends == spectra.places.end() && spectra.places.size() > 1) {
    spectra.place = Spectra::Place::receiver_x;
    return;
  }
  for (std::size_t n = 0; n < spectra.places.size(); ++n) spectra.places[n] = double(n + 1);
}

void read_fk(const NetcdfFile& file, const std::optional<Component>& wanted, Spectra& spectra) {
  const bool over_velocity = file.has_variable("phase_velocity");
  const std::string rows = over_velocity ? "phase_velocity" : "wavenumber";
  const std::vector<std::string> axes = {rows, "frequency"};
  for (const auto& variable : file.variables()) {
    if (variable.dimensions != axes || (wanted && variable.name != name_of(*wanted))) continue;
    spectra.places = file.get<double>(rows);
    spectra.place = over_velocity ? Spectra::Place::phase_velocity : Spectra::Place::wavenumber;
    const auto unit = unit_as_shown(file.text_attribute(variable.name, "units").value_or(""));
    const auto values = file.get<double>(variable.name);
    const auto bins = std::ptrdiff_t(spectra.frequencies_hz.size());
    for (auto first = values.begin(); first != values.end(); first += bins)
      spectra.lines.push_back({variable.name, unit, {first, first + bins}});
    return;
  }
}

}  // namespace

Spectra read_spectra(const NetcdfFile& file, const std::optional<Component>& component) {
  Spectra spectra;
  spectra.name = without_folders(file.shown_name());
  const auto fail = [&](const std::string& found) { throw Error(file.shown_name() + ": " + found); };
  if (!file.has_variable("frequency")) fail("found no variable frequency, expected spectra");
  spectra.frequencies_hz = file.get<double>("frequency");
  if (spectra.frequencies_hz.empty()) fail("holds no frequencies, expected at least one");
  const bool power = file.has_variable("power") ||
                     file.text_attribute("", "title").value_or("").find("energy") != std::string::npos;
  spectra.quantity = power ? "energy density" : "amplitude";
  const std::string of_traces = power ? "power" : "amplitude";
  if (file.has_variable("wavenumber") || file.has_variable("phase_velocity"))
    read_fk(file, component, spectra);
  else if (file.has_variable(of_traces))
    read_traces(file, of_traces, component, spectra);
  else
    read_means(file, component, spectra);
  if (spectra.lines.empty())
    throw Error(file.shown_name() + ": holds no spectra" +
                    (component ? " of " + std::string(name_of(*component)) : "") + ", expected at least one",
                component ? ErrorKind::usage : ErrorKind::data);
  return spectra;
}

}  // namespace slipwave::plot
