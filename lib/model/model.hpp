// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "fracture/friction_policy.hpp"
#include "fracture/linear_slip.hpp"
#include "geology/geology.hpp"
#include "grid/field.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// One family of parallel slip planes (theory.md, slip law).
template <int D>
struct SlipSystem {
  Point<D> normal{};       // unit vector
  double friction = 0;     // q, dimensionless
  double viscosity_s = 0;  // eta, s
  double strength_pa = 0;  // cohesion added to q max(-s_n, 0)
  bool opens = false;      // planes part under tension; otherwise they carry it
  FrictionLaw law = FrictionLaw::coulomb;
  // Of slip weakening: friction falls from q to this over that slip of the planes of a cell.
  double dynamic_friction = 0;
  double slip_distance_m = 0;
  LinearCompliance compliance = {};

  bool slides() const { return law != FrictionLaw::none; }
};

/// A single fracture: its vertices, m in true depth, from tip to tip; in 3-D those of a plane polygon.
template <int D>
using FractureTrace = std::vector<Point<D>>;

/// Cells that share slip systems: 1 to D systems. Or single fractures, all of the compliance of the one
/// system, without spacing and whatever its normal: then the set's cells are those beside the traces, or,
/// with `on_faces` (2-D), none: the fractures part the faces between cells that they lie on
/// (split_faces.hpp), and may have infinite compliances: they are open.
template <int D>
struct FractureSet {
  std::string name;
  std::vector<SlipSystem<D>> systems;
  std::vector<FractureTrace<D>> traces = {};
  bool on_faces = false;

  /// Planes in all of their cells; else single fractures along traces.
  bool is_cluster() const { return traces.empty(); }
};

/// Whether any planes of a set give way as springs; whether any may slide.
template <int D>
bool gives(const FractureSet<D>& set) {
  for (const auto& system : set.systems)
    if (system.compliance.gives()) return true;
  return false;
}
template <int D>
bool slides(const FractureSet<D>& set) {
  for (const auto& system : set.systems)
    if (system.slides()) return true;
  return false;
}

/// What a model file holds.
template <int D>
struct Model {
  Medium<D> medium;
  Field<D, std::uint8_t> fracture;  // 0 = intact, k = fracture_sets[k - 1]; empty when the model has none
  std::vector<FractureSet<D>> fracture_sets;
  /// Share of its volume in which the planes of a cell slip, above 0: below 1 where the edge of a cluster
  /// cuts the cell (theory/slip.md). Empty: no edge cuts a cell.
  Field<D> fracture_share;
  /// Static stress, Pa, tension positive: its components in the order of SymmetricTensor; empty: none. The
  /// waves come on top of it.
  std::vector<Field<D>> prestress_pa;
  std::string title, source, history;
  Geology geology = {};

  const Grid<D>& grid() const { return medium.grid(); }
};

/// Whether the planes of a set continue outside the model where waves leave it: those of a cluster that give
/// way in proportion to the stress of waves. Friction ends with the model, since in absorbing zones it may
/// add energy to what is damped (theory/fractures.md).
template <int D>
bool continues_outside(const Model<D>& model, std::size_t set) {
  const auto proportional = [&](const SlipSystem<D>& of) {
    return !of.slides() || (of.law == FrictionLaw::coulomb && of.friction == 0 && of.strength_pa == 0 &&
                            !of.opens && model.prestress_pa.empty());
  };
  const auto& of = model.fracture_sets[set];
  return of.is_cluster() && std::all_of(of.systems.begin(), of.systems.end(), proportional);
}

/// A model of another grid with all that one holds besides its cells: those have no values yet.
template <int D>
Model<D> without_values(const Model<D>& of, const Grid<D>& grid) {
  Model<D> model;
  model.medium = Medium<D>(grid, of.medium);
  if (!of.fracture.empty()) model.fracture = Field<D, std::uint8_t>(grid);
  model.fracture_sets = of.fracture_sets;
  if (!of.fracture_share.empty()) model.fracture_share = Field<D>(grid);
  model.prestress_pa.assign(of.prestress_pa.size(), Field<D>(grid));
  model.title = of.title, model.source = of.source, model.history = of.history;
  model.geology = of.geology;
  return model;
}

/// Throws an Error naming the first cell that is not physical: NaN, infinite or negative values or others
/// that the row of a property does not let through (of an optional one outside void), rho = 0 with vp or vs
/// set, vp = 0 outside void, speeds and densities that look like km/s, ft/s or g/cm3, vs > vp/sqrt(2) (with
/// allow_auxetic: vs >= vp sqrt(3)/2 in 2-D and 3-D, where the bulk modulus vanishes), a fracture code
/// without its set, a fracture in fluid or void, a slip normal that is no unit vector, negative or non-finite
/// slip constants, a prestress that is not finite or under which planes slip or part by themselves.
template <int D>
void check(const Model<D>& model, const MediumLimits& limits = {});

}  // namespace slipwave
