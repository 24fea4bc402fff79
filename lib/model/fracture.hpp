// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "geology/region.hpp"
#include "model/model.hpp"

namespace slipwave {

/// The unit normal of a plane that dips `dip_deg` from the horizontal, deepening towards +x when positive:
/// the plane runs along (cos dip, sin dip), so n = (sin dip, -cos dip). Horizontal planes have dip 0,
/// vertical ones
/// 90. Throws a usage Error beyond -90 to 90.
Point<2> normal_of_dip(double dip_deg);

/// The dip of the planes of a unit normal, from -90 to 90 degrees: the inverse of normal_of_dip().
double dip_of_normal(const Point<2>& normal);
/// Whether planes lie along no axis of the grid.
template <int D>
bool is_oblique(const Point<D>& normal) {
  double oblique = 0;
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    oblique = std::max(oblique, std::abs(normal[axis] * normal[D - 1]));
  return oblique > 1e-9;
}
/// Whether planes are level.
template <int D>
bool is_level(const Point<D>& normal) {
  return std::abs(normal[D - 1]) > 1 - 1e-9;
}
/// Whether slip on any planes of a set takes more off the stress of an anisotropic cell than off that of
/// isotropic rock: in 2-D where planes lie askew to the axes of symmetry, or these to the grid; in 3-D all
/// but those of one level family in rock that is alike in all horizontal directions, and single fractures.
template <int D>
bool lie_askew(const FractureSet<D>& set, const Medium<D>& medium, std::size_t cell);

/// In 3-D: of planes that dip towards an azimuth in degrees from +x, 90 being +y; and back, with a dip from 0
/// to 90 degrees.
Point<3> normal_of_dip(double dip_deg, double azimuth_deg);
struct DipAndAzimuth {
  double dip_deg, azimuth_deg;
};
DipAndAzimuth dip_and_azimuth_of(const Point<3>& normal);

/// `direction` scaled to length 1. Throws a usage Error when it has none.
template <int D>
Point<D> unit_normal(const Point<D>& direction);

/// Whether two unit normals are at right angles, as far as numbers in a file go.
template <int D>
bool at_right_angles(const Point<D>& a, const Point<D>& b);

/// "coulomb", "slip-weakening", "none".
std::string name_of(FrictionLaw law);

/// Gives a system the law "coulomb" or "slip-weakening:QD:DC": friction falls from that of the system to QD
/// over a slip of DC m. Throws a usage Error when the text is another.
template <int D>
void set_friction_law(SlipSystem<D>& system, const std::string& text);

/// Constants of a system's friction law; stress is `unit` times Pa.
template <int D, class Real>
FrictionConstants<Real> constants_of(const SlipSystem<D>& system, double unit);

/// The least mu D_c/((q_s - q_d) |s_n|) of the cells of a set, or of those beside its faces, under the
/// prestress, m (theory.md S18), and the cell it is in. Infinite where nothing weakens. Cells larger than
/// that fall to dynamic friction at once.
struct CriticalLength {
  double length_m;
  std::int64_t cell;
};
template <int D>
CriticalLength critical_length(const Model<D>& model, std::size_t code);

/// Effects of a model that can be left out of a run: slip, what it consists of, and attenuation.
enum class ModelEffect {
  slip,
  friction,
  viscosity,
  cohesion,
  opening,
  prestress,
  attenuation,
  anisotropy,
  compliance
};

/// Throws a usage Error that lists the names.
ModelEffect model_effect_named(const std::string& name);
/// The name that it takes.
std::string name_of(ModelEffect effect);

/// Takes an effect out of a model: planes without friction (q = 0), viscosity (eta = 0: dry) or cohesion,
/// planes that carry tension, no prestress, neither qp nor qs, planes that do not give way as springs (where
/// they do nothing else their cells are intact). `slip` leaves the model alone: Scene::with_slip.
template <int D>
void remove_effect(Model<D>& model, ModelEffect effect);

/// Whether a model has anything of an effect, so that taking it out may change what is simulated.
template <int D>
bool has_effect(const Model<D>& model, ModelEffect effect);

/// Leaves cells intact whose planes no wave moves in numbers of this resolution (the epsilon of their type):
/// springs that strain by less than that of what the rock strains, and friction with a cohesion of at least
/// mu, which a strain below 1 does not reach. Returns the names of the sets that lost all their cells.
template <int D>
std::vector<std::string> leave_out_inert(Model<D>& model, double resolution);

/// How many cells a region of fractures took and did not take.
struct FractureCount {
  std::int64_t marked = 0;  // solid cells, now of the new set
  std::int64_t cut = 0;     // of them those that the edge of the region cuts
  std::int64_t left = 0;    // fluid and void cells in the region, left intact
  std::int64_t taken = 0;   // marked cells that belonged to an earlier set
};

/// The solid cells whose centres, in true depth, are inside(centre); says how many there are and how many
/// fluid and void ones. Throws Error when there is none.
template <int D>
std::vector<std::size_t> find_solid_cells(const Model<D>& model,
                                          const std::function<bool(const Point<D>&)>& inside,
                                          FractureCount& count);

/// Throws Error when the model has 255 sets, the most that codes of cells can tell apart.
template <int D>
void check_room_for_set(const Model<D>& model);

/// Adds `set` to the model and marks with it the solid cells whose centres are inside(centre); an earlier set
/// gives way. Fluid and void cells stay intact: nothing slips there. Throws Error when no solid cell is
/// inside, when the model has 255 sets, when two systems of the set are parallel; constants: check().
template <int D>
FractureCount add_fractures(Model<D>& model, const FractureSet<D>& set,
                            const std::function<bool(const Point<D>&)>& inside);

/// Adds a set and marks with it the cells that lie in a region or are cut by its edge: these get the share of
/// their volume that is inside, in Model::fracture_share; in fitted grids it is that of the box about their
/// centre. A share within 0.001 of 0 or 1 counts as that. Where an earlier set has part of a cell its share
/// is added, and the set that fills more of the cell gets it, the later one where it fills half.
template <int D>
FractureCount add_fractures(Model<D>& model, const FractureSet<D>& set, const RegionIn<D>& region);

}  // namespace slipwave
