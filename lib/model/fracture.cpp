// SPDX-License-Identifier: BSD-3-Clause
#include "model/fracture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "grid/tensor.hpp"
#include "model/cluster_edge.hpp"
#include "model/split_faces.hpp"
#include "rock/anisotropy.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

/// By ModelEffect.
const std::vector<std::string> effect_names = {"slip",        "friction",   "viscosity",
                                               "cohesion",    "opening",    "prestress",
                                               "attenuation", "anisotropy", "compliance"};

std::vector<Property> properties_of(ModelEffect effect) {
  if (effect == ModelEffect::attenuation) return {Property::qp, Property::qs};
  if (effect != ModelEffect::anisotropy) return {};
  auto properties = all_properties();
  std::erase_if(properties, [](Property property) { return !tells_anisotropy(property); });
  return properties;
}

/// Rock that has c33 and c55 alone of its elastic constants must be one.
template <int D>
void check_isotropic_rest(const Medium<D>& medium) {
  for (std::size_t cell = 0; medium.has(Property::c33) && cell < medium.vp.size(); ++cell) {
    const double most = double(medium.vp[cell]) * std::sqrt(0.75);
    if (!has_constants(medium, cell) || double(medium.vs[cell]) < most) continue;
    throw Error("without anisotropy the rock at " + place_of(medium.grid(), std::int64_t(cell)) +
                " would have a vs of " + shown(medium.vs[cell]) +
                " m/s, expected below vp sqrt(3)/2 = " + shown(most) + " m/s; leave its anisotropy in");
  }
}

}  // namespace

Point<2> normal_of_dip(double dip_deg) {
  if (!(std::abs(dip_deg) <= 90)) {
    throw Error("found a dip of " + shown(dip_deg) + " degrees, expected it from -90 to 90",
                ErrorKind::usage);
  }
  const double dip = dip_deg * std::numbers::pi / 180;
  Point<2> normal = {std::sin(dip), -std::cos(dip)};
  // Horizontal and vertical planes exactly so.
  for (auto& part : normal) {
    if (std::abs(part) < 1e-15) part = 0;
  }
  return normal;
}

double dip_of_normal(const Point<2>& normal) {
  // Either of the two directions of the normal: the one that points up.
  const double up = normal[1] > 0 ? -1 : 1;
  return std::atan2(up * normal[0], up * -normal[1]) * 180 / std::numbers::pi;
}

template <int D>
bool lie_askew(const FractureSet<D>& set, const Medium<D>& medium, std::size_t cell) {
  if (!is_anisotropic(medium, cell)) return false;
  if (has_tilted_axis(medium, cell)) return true;
  // All other planes of 3-D meet two shear moduli.
  if (D == 3)
    return !set.is_cluster() || set.systems.size() > 1 || is_orthorhombic(medium, cell) ||
           !is_level<D>(set.systems[0].normal);
  for (const auto& trace : set.traces)
    for (std::size_t n = 1; n < trace.size(); ++n)
      if (trace[n][0] != trace[n - 1][0] && trace[n][D - 1] != trace[n - 1][D - 1]) return true;
  return set.is_cluster() && std::any_of(set.systems.begin(), set.systems.end(),
                                         [](const auto& system) { return is_oblique<D>(system.normal); });
}
SLIPWAVE_INSTANTIATE_D(FUNCTION, lie_askew);

Point<3> normal_of_dip(double dip_deg, double azimuth_deg) {
  const auto [across, down] = normal_of_dip(dip_deg);
  const double azimuth = azimuth_deg * std::numbers::pi / 180;
  Point<3> normal = {across * std::cos(azimuth), across * std::sin(azimuth), down};
  for (auto& part : normal) {
    if (std::abs(part) < 1e-15) part = 0;
  }
  return normal;
}

DipAndAzimuth dip_and_azimuth_of(const Point<3>& normal) {
  const double up = normal[2] > 0 ? -1 : 1;  // the direction that points up
  const double across = std::hypot(normal[0], normal[1]), degree = std::numbers::pi / 180;
  return {std::atan2(across, up * -normal[2]) / degree,
          across > 0 ? std::atan2(up * normal[1], up * normal[0]) / degree : 0};
}

template <int D>
Point<D> unit_normal(const Point<D>& direction) {
  double length = 0;
  for (const double part : direction) length = std::hypot(length, part);
  if (!(length > 0) || !std::isfinite(length)) {
    throw Error("found a normal of length " + shown(length) + ", expected a direction", ErrorKind::usage);
  }
  Point<D> normal = direction;
  for (auto& part : normal) part /= length;
  return normal;
}

template <int D>
bool at_right_angles(const Point<D>& a, const Point<D>& b) {
  double product = 0;
  for (std::size_t i = 0; i < D; ++i) product += a[i] * b[i];
  return std::abs(product) < 1e-9;
}

std::string name_of(FrictionLaw law) {
  return law == FrictionLaw::coulomb ? "coulomb" : law == FrictionLaw::none ? "none" : "slip-weakening";
}

template <int D>
void set_friction_law(SlipSystem<D>& system, const std::string& text) {
  const auto parts = split(text, ':');
  const bool coulomb = parts[0] == name_of(FrictionLaw::coulomb);
  if (!(coulomb && parts.size() == 1) &&
      !(parts[0] == name_of(FrictionLaw::slip_weakening) && parts.size() == 3)) {
    throw Error("found '" + text + "', expected coulomb or slip-weakening:QD:DC", ErrorKind::usage);
  }
  if (coulomb) {
    system.law = FrictionLaw::coulomb;
    return;
  }
  system.law = FrictionLaw::slip_weakening;
  system.dynamic_friction = parse_number(parts[1]);
  system.slip_distance_m = parse_number(parts[2]);
  if (!(system.dynamic_friction >= 0) || system.dynamic_friction > system.friction) {
    throw Error("found a dynamic friction of " + shown(system.dynamic_friction) +
                    ", expected it from 0 to the static friction of " + shown(system.friction),
                ErrorKind::usage);
  }
  if (!(system.slip_distance_m > 0)) {
    throw Error("found a slip distance of " + shown(system.slip_distance_m) + " m, expected it above zero",
                ErrorKind::usage);
  }
}

template <int D, class Real>
FrictionConstants<Real> constants_of(const SlipSystem<D>& system, double unit) {
  FrictionConstants<Real> law;
  law.friction = Real(system.friction);
  law.cohesion_pa = Real(unit * system.strength_pa);
  if (system.law == FrictionLaw::slip_weakening) {
    law.friction_drop = Real(system.friction - system.dynamic_friction);
    law.per_distance = Real(std::min(1 / system.slip_distance_m, most_per_distance));
  }
  return law;
}

template <int D>
CriticalLength critical_length(const Model<D>& model, std::size_t code) {
  CriticalLength least = {std::numeric_limits<double>::infinity(), 0};
  if (model.prestress_pa.empty()) return least;
  const auto& set = model.fracture_sets[code - 1];
  const auto see = [&](const SlipSystem<D>& system, double normal_pa, std::size_t cell) {
    if (system.law != FrictionLaw::slip_weakening) return;
    const double vs = double(model.medium.vs[cell]), mu = double(model.medium.rho[cell]) * vs * vs;
    const double drop_pa = (system.friction - system.dynamic_friction) * std::max(-normal_pa, 0.);
    if (drop_pa > 0 && mu * system.slip_distance_m / drop_pa < least.length_m)
      least = {mu * system.slip_distance_m / drop_pa, std::int64_t(cell)};
  };
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    if (model.fracture[cell] != code) continue;
    SymmetricTensor<D, double> stress;
    for (std::size_t c = 0; c < stress.values.size(); ++c)
      stress.values[c] = double(model.prestress_pa[c][cell]);
    Point<D> traction{};
    for (const auto& system : set.systems)
      see(system, resolve<D, double>(system.normal, stress, traction), cell);
  }
  for (const auto& face : split_faces(model, set))
    for (const auto& at : {face.before(), face.behind})
      see(set.systems.front(), face.law.prestress_pa[0], std::size_t(model.grid().flat(at)));
  return least;
}

ModelEffect model_effect_named(const std::string& name) {
  const auto at = std::find(effect_names.begin(), effect_names.end(), name);
  if (at != effect_names.end()) return ModelEffect(at - effect_names.begin());
  throw Error("found '" + name + "', expected " + joined(effect_names, " or "), ErrorKind::usage);
}

std::string name_of(ModelEffect effect) { return effect_names[std::size_t(effect)]; }

template <int D>
bool has_effect(const Model<D>& model, ModelEffect effect) {
  if (effect == ModelEffect::prestress) return !model.prestress_pa.empty();
  for (const auto property : properties_of(effect))
    if (model.medium.has(property)) return true;
  if (effect == ModelEffect::anisotropy) return tilted_means(model.medium) > 0;
  return std::any_of(model.fracture_sets.begin(), model.fracture_sets.end(), [&](const auto& set) {
    return std::any_of(set.systems.begin(), set.systems.end(), [&](const auto& system) {
      return effect == ModelEffect::slip ||
             (effect == ModelEffect::friction && (system.friction != 0 || system.dynamic_friction != 0)) ||
             (effect == ModelEffect::viscosity && system.viscosity_s != 0) ||
             (effect == ModelEffect::cohesion && system.strength_pa != 0) ||
             (effect == ModelEffect::opening && system.opens) ||
             (effect == ModelEffect::compliance && system.compliance.gives());
    });
  });
}

template <int D>
std::vector<std::string> leave_out_inert(Model<D>& model, double resolution) {
  const auto inert = [&](SlipSystem<D> system, bool single, double lambda, double mu) {
    if (single) system.compliance.spacing_m = model.grid().spacing_m;
    const auto gives = compliance_in(system.compliance, lambda, mu);
    return (!system.slides() || (system.strength_pa >= mu && !system.opens)) &&
           (lambda + 2 * mu) * gives.normal < resolution && mu * gives.tangential < resolution;
  };
  const auto sets = model.fracture_sets.size();
  std::vector<char> lost(sets, 0), left(sets, 0);
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    auto& code = model.fracture[cell];
    if (code == 0) continue;
    const auto& set = model.fracture_sets[code - 1u];
    const double vp = double(model.medium.vp[cell]), vs = double(model.medium.vs[cell]),
                 rho = double(model.medium.rho[cell]), mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
    const bool gone = std::all_of(set.systems.begin(), set.systems.end(), [&](const auto& system) {
      return inert(system, !set.is_cluster(), lambda, mu);
    });
    (gone ? lost : left)[code - 1u] = 1;
    if (gone) code = 0;
  }
  std::vector<std::string> names;
  for (std::size_t set = 0; set < sets; ++set)
    if (lost[set] && !left[set]) names.push_back(model.fracture_sets[set].name);
  return names;
}

template <int D>
void remove_effect(Model<D>& model, ModelEffect effect) {
  if (effect == ModelEffect::prestress) model.prestress_pa.clear();
  if (effect == ModelEffect::anisotropy) check_isotropic_rest(model.medium);
  for (const auto property : properties_of(effect))
    if (model.medium.has(property)) model.medium[property] = {};
  if (effect == ModelEffect::anisotropy) drop_tilted_means(model.medium);
  for (auto& set : model.fracture_sets)
    for (auto& system : set.systems) {
      if (effect == ModelEffect::friction) system.friction = system.dynamic_friction = 0;
      if (effect == ModelEffect::viscosity) system.viscosity_s = 0;
      if (effect == ModelEffect::cohesion) system.strength_pa = 0;
      if (effect == ModelEffect::opening) system.opens = false;
      // Planes of which one is on faces stay as far apart as viscosity has them.
      if (effect == ModelEffect::compliance)
        system.compliance = {.spacing_m = set.on_faces ? system.compliance.spacing_m : 0};
    }
}

template <int D>
std::vector<std::size_t> find_solid_cells(const Model<D>& model,
                                          const std::function<bool(const Point<D>&)>& inside,
                                          FractureCount& count) {
  std::vector<std::size_t> cells;
  for (std::int64_t n = 0; n < model.grid().size(); ++n) {
    const auto at = model.grid().index(n);
    Point<D> centre{};
    for (std::size_t axis = 0; axis < D; ++axis) centre[axis] = model.grid().centre(int(axis), at[axis]);
    centre[D - 1] = model.grid().depth(at);
    if (!inside(centre)) continue;
    if (model.medium.is_solid(std::size_t(n)))
      cells.push_back(std::size_t(n));
    else
      ++count.left;
  }
  count.marked = decltype(count.marked)(cells.size());
  if (cells.empty())
    throw Error("none of the " + std::to_string(count.left) +
                " cells in the region is solid, at least one must be");
  return cells;
}

template <int D>
void check_room_for_set(const Model<D>& model) {
  constexpr std::size_t most_sets = 255;  // the code of a cell is one byte
  if (model.fracture_sets.size() >= most_sets) {
    throw Error("the model has " + std::to_string(most_sets) +
                " fracture sets already, expected room for one more");
  }
}

namespace {

template <int D>
void check_not_parallel(const FractureSet<D>& set) {
  for (std::size_t i = 0; i < set.systems.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double product = 0;
      for (std::size_t axis = 0; axis < D; ++axis)
        product += set.systems[i].normal[axis] * set.systems[j].normal[axis];
      if (std::abs(product) > 1 - 1e-9) {
        throw Error("two slip systems of the set are parallel, expected different planes", ErrorKind::usage);
      }
    }
  }
}

template <int D>
Box<D> box_of(const Grid<D>& grid, const Index<D>& at) {
  Box<D> box;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const bool depth = axis + 1 == D;
    const double centre = depth ? grid.depth(at) : grid.centre(int(axis), at[axis]);
    const double half = (depth ? grid.height(at) : grid.spacing_m) / 2;
    box.low_m[axis] = centre - half, box.high_m[axis] = centre + half;
  }
  return box;
}

/// Shares nearer to 0 or 1 than this are that.
constexpr double least_share = 1e-3;

template <int D>
void put_share(Model<D>& model, std::size_t cell, double share) {
  if (model.fracture_share.empty()) {
    if (share >= 1) return;
    model.fracture_share = Field<D>(model.grid());
    std::fill(model.fracture_share.begin(), model.fracture_share.end(), 1.F);
  }
  model.fracture_share[cell] = float(share);
}

/// Gives a cell to a set that fills a share of it, or to the one that has it and fills more.
template <int D>
void share_cell(Model<D>& model, std::size_t cell, std::uint8_t code, double share, FractureCount& count) {
  const std::size_t had = model.fracture[cell];
  const bool of_cluster = had != 0 && model.fracture_sets[had - 1].is_cluster();
  const double before = of_cluster ? fracture_share_of(model, cell) : 0;
  if (had != 0 && share < 0.5 && (share < before || !of_cluster)) {
    if (of_cluster) put_share(model, cell, std::min(before + share, 1.));
    return;
  }
  count.taken += had != 0;
  count.marked += 1;
  model.fracture[cell] = code;
  put_share(model, cell, std::min(before + share, 1.));
  count.cut += is_cut(model, cell);
}

}  // namespace

template <int D>
FractureCount add_fractures(Model<D>& model, const FractureSet<D>& set,
                            const std::function<bool(const Point<D>&)>& inside) {
  check_room_for_set(model);
  check_not_parallel(set);
  FractureCount count;
  const auto cells = find_solid_cells(model, inside, count);
  if (model.fracture.empty()) model.fracture = Field<D, std::uint8_t>(model.grid());
  const auto code = std::uint8_t(model.fracture_sets.size() + 1);
  for (const auto cell : cells) {
    count.taken += model.fracture[cell] != 0;
    model.fracture[cell] = code;
    put_share(model, cell, 1);
  }
  model.fracture_sets.push_back(set);
  return count;
}

template <int D>
FractureCount add_fractures(Model<D>& model, const FractureSet<D>& set, const RegionIn<D>& region) {
  check_room_for_set(model);
  check_not_parallel(set);
  const auto& grid = model.grid();
  if (model.fracture.empty()) model.fracture = Field<D, std::uint8_t>(grid);
  const auto code = std::uint8_t(model.fracture_sets.size() + 1);
  FractureCount count;
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const double share = share_within(region, box_of(grid, grid.index(n)));
    if (share < least_share) continue;
    if (model.medium.is_solid(std::size_t(n)))
      share_cell(model, std::size_t(n), code, share > 1 - least_share ? 1 : share, count);
    else
      ++count.left;
  }
  if (count.marked == 0) {
    if (!model.fracture_sets.empty() && count.left == 0)
      throw Error("the region holds less than half of any cell that no earlier set fills more of");
    if (model.fracture_sets.empty()) model.fracture = {};
    throw Error("none of the " + std::to_string(count.left) +
                " cells in the region is solid, at least one must be");
  }
  model.fracture_sets.push_back(set);
  return count;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, unit_normal);
SLIPWAVE_INSTANTIATE_D(FUNCTION, at_right_angles);
SLIPWAVE_INSTANTIATE_D(FUNCTION, set_friction_law);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, constants_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, critical_length);
SLIPWAVE_INSTANTIATE_D(FUNCTION, remove_effect);
SLIPWAVE_INSTANTIATE_D(FUNCTION, has_effect);
SLIPWAVE_INSTANTIATE_D(FUNCTION, leave_out_inert);
SLIPWAVE_INSTANTIATE_D(FUNCTION, find_solid_cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, check_room_for_set);
template FractureCount add_fractures<2>(Model<2>&, const FractureSet<2>&,
                                        const std::function<bool(const Point<2>&)>&);
template FractureCount add_fractures<3>(Model<3>&, const FractureSet<3>&,
                                        const std::function<bool(const Point<3>&)>&);
template FractureCount add_fractures<2>(Model<2>&, const FractureSet<2>&, const RegionIn<2>&);
template FractureCount add_fractures<3>(Model<3>&, const FractureSet<3>&, const RegionIn<3>&);

}  // namespace slipwave
