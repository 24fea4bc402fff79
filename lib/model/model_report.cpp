// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "model/cluster_edge.hpp"
#include "model/fracture.hpp"
#include "model/planar_fracture.hpp"
#include "model/prestress.hpp"
#include "model/single_fracture.hpp"
#include "model/split_faces.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  std::int64_t not_finite = 0;
  bool may_be_infinite = false;  // then that is a value like others, without being low or high
  std::int64_t infinite = 0;
  void see(double value) {
    if (!std::isfinite(value)) {
      ++(may_be_infinite && value > 0 ? infinite : not_finite);
      return;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

void report(Report& report, const std::string& key, const Range& range, const std::string& unit) {
  if (range.low <= range.high) report.range(key, range.low, range.high, unit);
  if (range.infinite) report.count(key + " infinite", range.infinite);
  if (range.not_finite) report.count(key + " not finite", range.not_finite);
}

template <int D>
void report_grid(Report& report, const Grid<D>& grid) {
  report.text("grid", shown(grid));
  report.number("step", grid.spacing_m, "m");
  for (int axis = 0; axis < D - (grid.rows ? 1 : 0); ++axis) {
    report.range(std::string(1, axis_names<D>()[std::size_t(axis)]), grid.origin_m[std::size_t(axis)],
                 grid.end(axis), "m");
  }
  if (!grid.rows) return;
  Range depths;
  for (const double depth : grid.rows->corners_m()) depths.see(depth);
  report.range("z", depths.low, depths.high, "m");
  const auto [thinnest, thickest] = grid.rows->heights();
  report.range("row heights", thinnest, thickest, "m");
  std::vector<Report> fitted;
  for (const auto& horizon : grid.rows->horizons()) {
    Range depth;
    const auto corners = grid.rows->row(horizon.row);
    for (const double here : corners) depth.see(here);
    fitted.emplace_back();
    fitted.back().text("name", horizon.name);
    fitted.back().text("role", horizon.role);
    fitted.back().count("row", horizon.row);
    fitted.back().range("depth", depth.low, depth.high, "m");
  }
  report.list("fitted horizons", fitted);
}

template <int D>
void report_field(Report& into, const std::string& key, const Field<D>& field, const std::string& unit,
                  bool may_be_infinite = false) {
  Range range;
  range.may_be_infinite = may_be_infinite;
  for (const float value : field) range.see(double(value));
  report(into, key, range, unit);
}

void report_compliance(Report& report, const LinearCompliance& of) {
  if (of.crack_density > 0) {
    report.number("crack density", of.crack_density, "");
    if (of.fill_pa > 0) {
      report.number("aspect ratio", of.aspect, "");
      report.number("fill", of.fill_pa, "Pa");
    }
  } else if (of.gives()) {
    const auto compliance = [&](const std::string& name, double m_per_pa) {
      if (std::isinf(m_per_pa))
        report.text(name, "infinite: open");
      else
        report.number(name, m_per_pa, "m/Pa");
    };
    compliance("normal compliance", of.normal_m_per_pa);
    compliance("tangential compliance", of.tangential_m_per_pa);
    if (of.normal_dashpot_pa_s_m > 0) report.number("normal dashpot", of.normal_dashpot_pa_s_m, "Pa s/m");
    if (of.tangential_dashpot_pa_s_m > 0)
      report.number("tangential dashpot", of.tangential_dashpot_pa_s_m, "Pa s/m");
    if (of.spacing_m > 0) report.number("spacing", of.spacing_m, "m");
  }
}

struct CellsOfSet {
  std::int64_t all = 0, cut = 0;
  double shares = 0;  // sum over all
};

template <int D>
Report report_of_set(const FractureSet<D>& set, const CellsOfSet& cells) {
  Report of_set;
  of_set.text("name", set.name);
  of_set.count("cells", cells.all);
  if (cells.cut > 0) {
    of_set.count("cut by its edge", cells.cut);
    of_set.number("as whole cells", std::round(cells.shares * 10) / 10, "");
  }
  if (!set.is_cluster()) {
    double size = 0;
    for (const auto& trace : set.traces) {
      if constexpr (D == 2)
        size += length_of(trace);
      else
        size += area_of(trace);
    }
    of_set.count("single fractures", std::int64_t(set.traces.size()));
    of_set.number(D == 2 ? "length of all" : "area of all", size, D == 2 ? "m" : "m2");
    if (set.on_faces) of_set.text("lie", "on faces between cells");
  }
  std::vector<Report> systems;
  for (const auto& system : set.systems) {
    std::string normal;
    for (const double part : system.normal) {
      normal += (normal.empty() ? "" : ",") + shown(std::round(part * 1e6) / 1e6 + 0.0);
    }
    systems.emplace_back();
    if (set.is_cluster()) systems.back().text("normal", normal);
    report_compliance(systems.back(), system.compliance);
    if (!system.slides()) continue;
    if (!system.compliance.gives() && system.compliance.spacing_m > 0)
      systems.back().number("spacing", system.compliance.spacing_m, "m");
    systems.back().number("friction", system.friction, "");
    systems.back().number("viscosity", system.viscosity_s, "s");
    systems.back().number("strength", system.strength_pa, "Pa");
    if (system.opens) systems.back().text("opens", "under tension");
    if (system.law == FrictionLaw::coulomb) continue;
    systems.back().text("law", name_of(system.law));
    systems.back().number("dynamic friction", system.dynamic_friction, "");
    systems.back().number("slip distance", system.slip_distance_m, "m");
  }
  of_set.list("slip", systems);
  return of_set;
}

template <int D>
bool has_coordinates(const NetcdfFile& file) {
  for (const auto& name : field_dimensions<D>()) {
    if (!file.has_variable(name)) return false;
  }
  return true;
}

Range range_of(const NetcdfFile& file, const NetcdfFile::Variable& variable) {
  Range range;
  if (variable.size() == 0) return range;
  if (variable.shape.size() < 2) {
    for (const double value : file.get<double>(variable.name)) range.see(value);
    return range;
  }
  std::vector<std::size_t> start(variable.shape.size(), 0), count = variable.shape;
  count[0] = 1;
  for (start[0] = 0; start[0] < variable.shape[0]; ++start[0]) {
    for (const double value : file.get<double>(variable.name, start, count)) range.see(value);
  }
  return range;
}

/// In any direction, m/s; infinite where all is void.
template <int D>
double slowest_speed(const Medium<D>& medium) {
  if (anisotropic_cells(medium) > 0) return slowest_speed(in_slowest_directions(medium));
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (!medium.is_void(cell))
      slowest = std::min(slowest, double(medium.is_fluid(cell) ? medium.vp[cell] : medium.vs[cell]));
  return slowest;
}

}  // namespace

template <int D>
Report report_of(const Model<D>& model) {
  Report of_model;
  const auto& medium = model.medium;
  report_grid(of_model, model.grid());
  for (const Property property : medium.properties())
    report_field(of_model, row_of(property).name, medium[property], row_of(property).shown_unit,
                 row_of(property).if_absent == PropertyRow::infinite);
  std::int64_t solid = 0, fluid = 0, nothing = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    (medium.is_void(cell) ? nothing : medium.is_fluid(cell) ? fluid : solid) += 1;
  of_model.count("solid cells", solid);
  of_model.count("fluid cells", fluid);
  of_model.count("void cells", nothing);
  const double slowest = slowest_speed(medium);
  if (std::isfinite(slowest)) of_model.number("slowest wave", slowest, "m/s");
  std::vector<CellsOfSet> cells(model.fracture_sets.size() + 1);
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    const std::size_t code = model.fracture[cell];
    if (code >= cells.size()) continue;
    ++cells[code].all;
    cells[code].cut += is_cut(model, cell);
    cells[code].shares += fracture_share_of(model, cell);
  }
  std::vector<Report> sets;
  for (std::size_t k = 0; k < model.fracture_sets.size(); ++k) {
    sets.push_back(report_of_set(model.fracture_sets[k], cells[k + 1]));
  }
  of_model.list("fractures", sets);
  const auto faces = split_faces(model);
  for (std::size_t c = 0; c < model.prestress_pa.size(); ++c) {
    Range range;  // elsewhere it does nothing
    for (std::size_t cell = 0; cell < model.fracture.size(); ++cell)
      if (model.fracture[cell] != 0) range.see(double(model.prestress_pa[c][cell]));
    for (const auto& face : faces) {
      if (!face.law.any()) continue;
      for (const auto& at : {face.before(), face.behind}) range.see(double(model.prestress_pa[c](at)));
    }
    report(of_model, "prestress " + stress_names<D>()[c], range, "Pa");
  }
  if (!model.title.empty()) of_model.text("title", model.title);
  if (!model.source.empty()) of_model.text("source", model.source);
  if (!model.history.empty()) of_model.text("history", model.history);
  return of_model;
}

Report report_of(const NetcdfFile& file) {
  Report of_file;
  if (has_coordinates<3>(file)) {
    report_grid(of_file, read_grid<3>(file, false));
  } else if (has_coordinates<2>(file)) {
    report_grid(of_file, read_grid<2>(file));
  }
  std::vector<Report> variables;
  for (const auto& variable : file.variables()) {
    if (variable.name == "x" || variable.name == "y" || variable.name == "z") continue;
    std::string dimensions;
    for (std::size_t i = 0; i < variable.shape.size(); ++i) {
      dimensions += (i ? " x " : "") + variable.dimensions[i] + " " + std::to_string(variable.shape[i]);
    }
    Report of_variable;
    of_variable.text("name", variable.name);
    if (!dimensions.empty()) of_variable.text("of", dimensions);
    const bool numbers = variable.type != NetcdfFile::Type::text && variable.type != NetcdfFile::Type::other;
    if (numbers) {
      report(of_variable, "values", range_of(file, variable),
             file.text_attribute(variable.name, "units").value_or(""));
    }
    variables.push_back(of_variable);
  }
  of_file.list("variable", variables);
  for (const char* name : {"title", "source", "history"}) {
    if (const auto text = file.text_attribute("", name)) of_file.text(name, *text);
  }
  return of_file;
}

std::string kind_of(const NetcdfFile& file) {
  const auto rows = material_properties();
  const auto is_there = [&](const PropertyRow& row) { return row.if_absent || file.has_variable(row.name); };
  if (std::all_of(rows.begin(), rows.end(), is_there) && !file.dimension_length("time")) return "model";
  const bool in_3d = has_coordinates<2>(file) || has_coordinates<3>(file);
  return in_3d && file.dimension_length("time") ? "snapshots" : "netCDF";
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, report_of);

}  // namespace slipwave
