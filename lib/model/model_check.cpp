// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "model/fracture.hpp"
#include "model/model.hpp"
#include "model/planar_fracture.hpp"
#include "model/prestress.hpp"
#include "rock/anisotropy.hpp"
#include "rock/attenuation.hpp"
#include "rock/property_range.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

// Room for the rounding of vp and vs to float.
constexpr double slack = 1 + 1e-6;

/// "vs at x=1200 z=45 is NaN, expected ..."
template <int D>
[[noreturn]] void refuse(const Grid<D>& grid, std::size_t cell, const std::string& name,
                         const std::string& rest) {
  throw Error(name + " at " + place_of(grid, std::int64_t(cell)) + " " + rest);
}

template <int D>
void check_values(const Medium<D>& medium, Property property) {
  const auto& row = row_of(property);
  const auto& field = medium[property];
  for (std::size_t cell = 0; cell < field.size(); ++cell) {
    const double value = double(field[cell]);
    if (is_in_range(row, value)) continue;
    if (row.if_absent && medium.is_void(cell)) continue;
    refuse(field.grid(), cell, row.name, "is " + shown_float(value) + ", expected " + expected_values(row));
  }
}

template <int D>
void check_grids(const Medium<D>& medium) {
  const auto properties = medium.properties();
  const auto alike = [&](Property property) { return medium[property].grid() == medium.grid(); };
  if (std::all_of(properties.begin(), properties.end(), alike)) return;
  std::string names, grids;
  for (const Property property : properties) {
    const bool first = property == properties.front(), last = property == properties.back();
    names += (first ? "" : last ? " and " : ", ") + row_of(property).name;
    grids += (first ? "" : ", ") + shown(medium[property].grid());
  }
  throw Error(names + " have different grids: " + grids);
}

// Time steps become as short as the thinnest row wants; the slack is for the rounding of depths.
constexpr double thinnest_row = 0.2 * (1 - 1e-6);

/// Rows of a fitted grid.
template <int D>
void check_rows(const Grid<D>& grid) {
  if (!grid.rows) return;
  for (std::size_t axis = 0; axis < D; ++axis) {
    if (grid.first[axis] + grid.shape[axis] <= grid.rows->cells()[axis]) continue;
    throw Error("the grid of " + shown(grid) + " reaches beyond its own depths");
  }
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const double height = grid.height(grid.index(cell));
    if (height >= thinnest_row * grid.spacing_m) continue;
    throw Error("the row at " + place_of(grid, cell) + " is " + shown(height, 4) +
                " m high, expected at least a fifth of a cell of " + shown(grid.spacing_m) +
                " m: fit fewer horizons or choose smaller cells");
  }
}

// Dry sand and mud are slower than anything else in the Earth; only gases are as light as that, and they are
// slow.
constexpr double slowest_vp = 50, slowest_vs = 5, fastest = 15000;
constexpr double lightest = 30, heaviest = 30000, fastest_gas = 1000;

/// Speeds and densities in other units than those of the model.
template <int D>
void check_plausible(const Medium<D>& medium, std::size_t cell) {
  const auto unlikely = [&](const char* name, double value, const char* unit, const char* meant) {
    refuse(medium.grid(), cell, name,
           "is " + shown_float(value) + " " + unit + ", which no rock or fluid has; if the numbers are in " +
               meant + ", build the model with --units " + meant + ", if it is meant so, use --allow-slow");
  };
  const double vp = double(medium.vp[cell]), vs = double(medium.vs[cell]), rho = double(medium.rho[cell]);
  if (vp < slowest_vp) unlikely("vp", vp, "m/s", rho < lightest ? "km/s,g/cm3" : "km/s");
  if (vp > fastest) unlikely("vp", vp, "m/s", "ft/s");
  if (vs > 0 && vs < slowest_vs) unlikely("vs", vs, "m/s", "km/s");
  if (rho < lightest && (vs > 0 || vp > fastest_gas)) unlikely("rho", rho, "kg/m3", "g/cm3");
  if (rho > heaviest)
    refuse(
        medium.grid(), cell, "rho",
        "is " + shown_float(rho) + " kg/m3, which no rock or fluid has; if it is meant so, use --allow-slow");
}

/// What does not go with elastic constants; any that make strain cost energy are rock.
template <int D>
void check_constants(const Medium<D>& medium, std::size_t cell) {
  for (const auto property : {Property::qp, Property::qs})
    if (medium.value(property, cell) < elastic_quality)
      refuse(
          medium.grid(), cell, row_of(property).name,
          "is " + shown_float(medium.value(property, cell)) +
              ", expected inf where rock has elastic constants: how it attenuates is not known; leave it out "
              "there");
}

template <int D>
void check_cell(const Medium<D>& medium, std::size_t cell, const MediumLimits& limits) {
  const double vp = double(medium.vp[cell]), vs = double(medium.vs[cell]);
  if (medium.is_void(cell)) {
    if (vp == 0 && vs == 0) return;
    refuse(medium.grid(), cell, "rho",
           "is 0 with vp " + shown_float(vp) + " and vs " + shown_float(vs) +
               ", expected both 0 in void or a density");
  }
  if (vp == 0) refuse(medium.grid(), cell, "vp", "is 0, expected a speed above zero outside void");
  if (vs == 0 && medium.has(Property::qs) && medium[Property::qs][cell] < elastic_quality)
    refuse(medium.grid(), cell, "qs",
           "is " + shown_float(double(medium[Property::qs][cell])) +
               ", expected inf in fluid, which carries no S waves");
  if (medium.has(Property::epsilon) || medium.has(Property::delta) || medium.has(Property::tilt) ||
      medium.has(Property::gamma) || medium.has(Property::azimuth) || medium.has(Property::rotation) ||
      medium.has(Property::c33))
    if (const auto fault = fault_of_anisotropy(material_of(medium, cell), D == 3 || limits.in_3d))
      refuse(medium.grid(), cell, row_of(fault->of).name, fault->text);
  if (medium.has(Property::cut_epsilon) || medium.has(Property::cut_delta))
    if (const auto fault = fault_of_tilted_mean(medium, cell))
      refuse(medium.grid(), cell, row_of(fault->of).name, fault->text);
  if (!limits.allow_slow) check_plausible(medium, cell);
  if (has_constants(medium, cell)) return check_constants(medium, cell);
  const auto found = [vs] { return "is " + shown_float(vs) + ", expected "; };
  if (limits.allow_auxetic) {
    const double limit = vp * std::sqrt(0.75);
    if (vs * slack >= limit) {
      refuse(medium.grid(), cell, "vs",
             found() + "below vp sqrt(3)/2 = " + shown_float(limit) + " (positive bulk modulus)");
    }
  } else if (vs > vp / std::sqrt(2.0) * slack) {
    refuse(medium.grid(), cell, "vs",
           found() + "at most vp/sqrt(2) = " + shown_float(vp / std::sqrt(2.0)) +
               " (lambda < 0 needs --allow-auxetic)");
  }
}

/// The constants of planes that give way as springs.
template <int D>
void check_compliance(const SlipSystem<D>& system, bool single, bool on_faces, const std::string& name) {
  const auto& of = system.compliance;
  const auto refuse_unless = [&](bool good, const std::string& what, double value, const std::string& rest) {
    if (!good) throw Error(name + ": " + what + " is " + shown(value) + ", expected " + rest);
  };
  const std::pair<const char*, double> constants[] = {
      {"normal compliance", of.normal_m_per_pa},    {"tangential compliance", of.tangential_m_per_pa},
      {"normal dashpot", of.normal_dashpot_pa_s_m}, {"tangential dashpot", of.tangential_dashpot_pa_s_m},
      {"spacing of planes", of.spacing_m},          {"crack density", of.crack_density},
      {"aspect ratio of cracks", of.aspect},        {"bulk modulus of the fill", of.fill_pa}};
  // On faces a fracture may be open; then nothing is left for friction.
  const auto infinite = [&](const double& value) {
    return on_faces && !system.slides() && std::isinf(value) &&
           (&value == &constants[0].second || &value == &constants[1].second);
  };
  for (const auto& [what, value] : constants)
    refuse_unless((infinite(value) && value > 0) || (value >= 0 && std::isfinite(value)), what, value,
                  "a finite number not below zero");
  if (!single && (of.normal_m_per_pa > 0 || of.tangential_m_per_pa > 0))
    refuse_unless(of.spacing_m > 0, "spacing of planes", of.spacing_m, "it above zero, in metres");
  if (of.fill_pa > 0)
    refuse_unless(of.aspect > 0 && of.aspect <= 1, "aspect ratio of cracks", of.aspect,
                  "it above zero and at most 1");
  if (system.opens && ((of.gives() && !on_faces) || !system.slides()))
    throw Error(name + ": planes that open carry no tension, planes with a compliance do; give one of both");
}

/// What families of planes of one set cannot have together.
template <int D>
void check_together(const FractureSet<D>& set, const std::string& name) {
  if (!gives(set) || set.systems.size() == 1) return;
  for (const auto& system : set.systems) {
    if (system.compliance.damped())
      throw Error(name + ": dashpots need one family of planes, found " + std::to_string(set.systems.size()));
    if (slides(set) && (D == 3 || !at_right_angles<D>(set.systems.front().normal, set.systems.back().normal)))
      throw Error(name +
                  ": friction together with compliance needs one family of planes, in 2-D or two at "
                  "right angles; give the others a set of their own");
  }
}

/// What single fractures cannot have.
template <int D>
void check_single(const FractureSet<D>& set, const std::string& name) {
  if (set.on_faces && set.is_cluster()) throw Error(name + " lies on faces, expected single fractures there");
  if (set.is_cluster()) return;
  if (D == 3 && set.on_faces)
    throw Error(name + " lies on faces between cells, which fractures of models in 2-D do");
  const auto& system = set.systems.front();
  if (set.systems.size() != 1 || (system.slides() && !set.on_faces) || system.compliance.damped() ||
      system.compliance.crack_density > 0)
    throw Error(name + ": single fractures have a normal and a tangential compliance and no other law" +
                (D == 2 ? ", on faces friction, too" : ""));
  if (system.slides() && system.viscosity_s > 0 && !(system.compliance.spacing_m > 0))
    throw Error(name +
                ": the viscosity of a single fracture needs a spacing above zero, in metres: that of " +
                "the planes of which it is one");
  for (const auto& trace : set.traces) {
    if constexpr (D == 3) {
      if (const auto fault = fault_of_polygon(trace); !fault.empty()) throw Error(name + ": " + fault);
      continue;
    }
    bool good = trace.size() > 1;
    for (std::size_t n = 0; good && n < trace.size(); ++n) {
      good = n == 0 || trace[n] != trace[n - 1];
      // Farther away than any model reaches.
      for (const double part : trace[n]) good = good && std::abs(part) <= 1e9;
    }
    if (!good)
      throw Error(name + ": found a single fracture without length or end, expected two vertices or more");
  }
}

template <int D>
void check_set(const FractureSet<D>& set, std::size_t number) {
  const std::string name = "fracture set " + std::to_string(number) + " '" + set.name + "'";
  if (set.systems.empty() || set.systems.size() > std::size_t(D)) {
    throw Error(name + " has " + std::to_string(set.systems.size()) + " slip systems, expected 1 to " +
                std::to_string(D));
  }
  for (const auto& system : set.systems) {
    double square = 0;
    for (const double part : system.normal) square += part * part;
    if (!(std::abs(square - 1) < 1e-6)) {
      throw Error(name + ": found a normal of length " + shown(std::sqrt(square)) +
                  ", expected a unit vector");
    }
    const auto check_constant = [&](const std::string& what, double value) {
      if (value >= 0 && std::isfinite(value)) return;
      throw Error(name + ": " + what + " is " + shown(value) + ", expected a finite number not below zero");
    };
    check_constant("friction", system.friction);
    check_constant("viscosity", system.viscosity_s);
    check_constant("strength", system.strength_pa);
    check_compliance(system, !set.is_cluster(), set.on_faces, name);
    if (system.law != FrictionLaw::slip_weakening) continue;
    check_constant("dynamic friction", system.dynamic_friction);
    if (system.dynamic_friction > system.friction)
      throw Error(name + ": dynamic friction is " + shown(system.dynamic_friction) +
                  ", expected at most the static friction of " + shown(system.friction));
    if (!(system.slip_distance_m > 0))
      throw Error(name + ": slip distance is " + shown(system.slip_distance_m) +
                  " m, expected it above zero");
  }
  check_together(set, name);
  check_single(set, name);
}

template <int D>
void check_shares(const Model<D>& model) {
  if (model.fracture_share.empty()) return;
  if (!(model.fracture_share.grid() == model.grid()))
    throw Error("fracture_share and vp have different grids: " + shown(model.fracture_share.grid()) + ", " +
                shown(model.grid()));
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    const auto share = double(model.fracture_share[cell]);
    if (model.fracture[cell] != 0 && !(share > 0 && share <= 1))
      refuse(model.grid(), cell, "fracture_share",
             "is " + shown(share) + ", expected the share of the cell that slips, above 0 and at most 1");
  }
}

}  // namespace

template <int D>
void check(const Model<D>& model, const MediumLimits& limits) {
  const auto& medium = model.medium;
  if (medium.vp.empty()) throw Error("the model has no cells");
  check_grids(medium);
  check_rows(medium.grid());
  for (const Property property : medium.properties()) check_values(medium, property);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) check_cell(medium, cell, limits);
  for (std::size_t k = 0; k < model.fracture_sets.size(); ++k) check_set(model.fracture_sets[k], k + 1);
  if (model.fracture.empty()) return;
  if (!(model.fracture.grid() == medium.grid())) {
    throw Error("fracture and vp have different grids: " + shown(model.fracture.grid()) + ", " +
                shown(medium.grid()));
  }
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    const std::size_t code = model.fracture[cell];
    if (code == 0) continue;
    if (code > model.fracture_sets.size()) {
      refuse(model.grid(), cell, "fracture",
             "is " + std::to_string(code) + ", expected at most " +
                 std::to_string(model.fracture_sets.size()) + ", the number of sets");
    }
    if (!medium.is_solid(cell)) {
      refuse(model.grid(), cell, "fracture",
             std::string("lies in ") + (medium.is_void(cell) ? "void" : "fluid") +
                 "; only solid cells can be fractured");
    }
  }
  check_shares(model);
  check_prestress(model);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, check);

}  // namespace slipwave
