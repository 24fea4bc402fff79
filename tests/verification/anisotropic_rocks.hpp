// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cube_shot.hpp"
#include "long_form.hpp"
#include "model/fracture.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave::solver {

/// Those scenes of a list that its form has: the short one leaves some out.
template <class Case>
std::vector<Case> of_this_form(std::vector<Case> cases) {
  if (!long_form()) std::erase_if(cases, [](const Case& of) { return !of.in_short; });
  return cases;
}

/// The rock with its axes turned so, in degrees.
inline Material turned_by(Material rock, double tilt, double azimuth = 0, double rotation = 0) {
  rock.tilt = tilt, rock.azimuth = azimuth, rock.rotation = rotation;
  return rock;
}

/// Alike in all directions along their beds: a shale, one whose waves turn (epsilon below delta), a stiff
/// one whose waves do not, hard rock; sandstone (Thomsen 1986, as Mesaverde and Taylor) and an elliptical
/// rock; orthorhombic: a shale with upright cracks (Schoenberg and Helbig 1997, over density 2300).
inline const Material shale{3000, 1600, 2300, 0.2, 0.1, 0, 0.15},
    crossed{3200, 1700, 2400, -0.05, 0.2, 0, -0.1}, stiff{3600, 1900, 2450, 0.15, 0.1, 0, 0.1},
    hard{4200, 2300, 2600, 0.1, 0.15}, sandstone{3370, 1830, 2500, 0.11, -0.035},
    elliptical{2800, 1500, 2200, 0.18, 0.18}, plain{3000, 1600, 2300}, sea{1500, 0, 1000};
inline const Material cracked =
    material_of(orthorhombic({2300 * 9e6, 2300 * 9.84e6, 2300 * 5.9375e6, 2300 * 2e6, 2300 * 1.6e6,
                              2300 * 2.182e6, 2300 * 3.6e6, 2300 * 2.25e6, 2300 * 2.4e6}),
                2300);
/// With axes that point anywhere.
inline const Material dipping_shale = turned_by(shale, 30), steep = turned_by(crossed, -60),
                      askew = turned_by(cracked, 40, 25, -50);

/// The rock by its elastic constants; isotropic rock and water stay.
template <int D>
Material by_constants(const Material& rock) {
  if (D == 2 ? !rock.is_anisotropic() : !rock.is_anisotropic_in_3d()) return rock;
  return rock_of_constants<D>(elasticity_of<D>(rock), rock.rho);
}
/// Rocks without an axis of symmetry: one of the plane of x and z, one in 3-D.
inline const Material sheared =
    rock_of_constants<2>({{{{26e9, 9e9, 2.5e9}, {9e9, 20e9, -2e9}, {2.5e9, -2e9, 6e9}}}}, 2300);
inline const Material triclinic = rock_of_constants<3>({{{{20.7e9, 8.3e9, 5.2e9, 0.7e9, -0.9e9, 0.6e9},
                                                          {8.3e9, 22.6e9, 5.5e9, -0.5e9, 0.4e9, -0.8e9},
                                                          {5.2e9, 5.5e9, 13.7e9, 0.9e9, -0.6e9, 0.3e9},
                                                          {0.7e9, -0.5e9, 0.9e9, 4.6e9, 0.4e9, -0.3e9},
                                                          {-0.9e9, 0.4e9, -0.6e9, 0.4e9, 3.7e9, 0.5e9},
                                                          {0.6e9, -0.8e9, 0.3e9, -0.3e9, 0.5e9, 5e9}}}},
                                                       2300);

/// As a model in 2-D has a rock of the plane of x and z, and one in 3-D a rock of 2-D.
inline Material in_plane(Material rock) {
  rock.gamma = 0, rock.azimuth = 0, rock.orthorhombic = {};
  return rock;
}

/// Gives a medium the properties that these rocks need.
template <int D>
void describe(Medium<D>& medium, const std::vector<Material>& rocks) {
  const auto any = [&](const auto& of) { return std::any_of(rocks.begin(), rocks.end(), of); };
  const auto add = [&](Property property) { medium[property] = Field<D>(medium.grid()); };
  const bool orthorhombic = any([](const Material& rock) { return rock.orthorhombic.has_value(); });
  add(D == 2 ? Property::epsilon : orthorhombic ? Property::epsilon1 : Property::gamma);
  if (any([](const Material& rock) { return rock.tilt != 0; })) add(Property::tilt);
  if (any([](const Material& rock) { return rock.azimuth != 0; })) add(Property::azimuth);
  if (any([](const Material& rock) { return rock.rotation != 0; })) add(Property::rotation);
  if (any([](const Material& rock) { return bool(rock.constants); })) add(Property::c33);
  complete_anisotropy(medium);
}

/// A medium of these rocks: in each cell the one that rock_at() says of its index.
template <int D, class At>
Medium<D> medium_of(const Grid<D>& grid, const std::vector<Material>& rocks, const At& rock_at) {
  Medium<D> medium(grid);
  describe(medium, rocks);
  for (std::int64_t n = 0; n < grid.size(); ++n) put(medium, std::size_t(n), rock_at(grid.index(n)));
  return medium;
}
template <int D>
Medium<D> uniform_rock(const Grid<D>& grid, const Material& rock) {
  return medium_of(grid, {rock}, [&](const Index<D>&) { return rock; });
}

/// Blocks of so many cells of rocks in turn, below eight rows of water.
template <int D>
Medium<D> blocks_below_water(const std::vector<Material>& rocks, const Index<D>& shape,
                             const Index<D>& block) {
  constexpr std::int64_t wet = 8;
  return medium_of(Grid<D>{shape, 5, {}}, rocks, [&](const Index<D>& at) {
    std::int64_t turn = 0;
    for (std::size_t axis = 0; axis < D; ++axis) turn += (at[axis] - (axis + 1 < D ? 0 : wet)) / block[axis];
    return at[D - 1] < wet ? sea : rocks[std::size_t(turn) % rocks.size()];
  });
}

/// Makes the solids of a medium of two rocks of these, by which is faster; water stays.
template <int D>
void put_rocks(Medium<D>& medium, const Material& slow, const Material& fast, double between_m_s) {
  describe(medium, {slow, fast});
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (medium.is_solid(cell)) put(medium, cell, medium.vp[cell] > between_m_s ? fast : slow);
}

/// Leaves the first of these cells, in the order of the file, isotropic.
template <int D>
void make_isotropic(Medium<D>& medium, std::size_t cells) {
  for (const auto property : medium.properties())
    for (std::size_t cell = 0; cell < cells && property >= Property::epsilon; ++cell)
      medium[property][cell] = 0;
}

/// Quality factors of P and S waves along the axes of a rock.
struct Qualities {
  double p, s;
};

/// Gives all solids and fluids of a scene these.
template <int D>
void attenuate(Scene<D>& scene, const Qualities& of) {
  auto& medium = scene.model.medium;
  for (const auto property : {Property::qp, Property::qs}) {
    medium[property] = Field<D>(medium.grid(), float(PropertyRow::infinite));
    for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
      if (property == Property::qp || medium.is_solid(cell))
        medium[property][cell] = float(property == Property::qp ? of.p : of.s);
  }
  set_attenuation(scene);
}

/// Families of planes that slide, by dip and azimuth, of one law.
inline FractureSet<3> families(const std::vector<std::array<double, 2>>& dips, double friction,
                               double viscosity_s, double cohesion_pa = 0) {
  FractureSet<3> set{"cluster", {}};
  for (const auto& [dip, azimuth] : dips)
    set.systems.push_back({normal_of_dip(dip, azimuth), friction, viscosity_s, cohesion_pa});
  return set;
}

/// Families that are springs, whose compliances times that modulus are these.
constexpr double usual_mu = 5e9;
inline FractureSet<3> springs(const std::vector<std::array<double, 2>>& dips, double normal,
                              double tangential) {
  FractureSet<3> set{"springs", {}};
  for (const auto& [dip, azimuth] : dips) {
    set.systems.push_back({normal_of_dip(dip, azimuth)});
    set.systems.back().law = FrictionLaw::none;
    set.systems.back().compliance = {normal / usual_mu, tangential / usual_mu, 0, 0, 1};
  }
  return set;
}

/// A cluster of fractures amid a cube of one rock, under a force above it.
inline Scene<3> cluster(const Material& rock, const FractureSet<3>& set,
                        const Index<3>& shape = {18, 18, 18}) {
  auto scene = scene_of(uniform_rock(Grid<3>{shape, 5, {}}, rock), edges_all_3d(EdgeLaw::rigid), {41, 52, 18},
                        "force:1,0.5,1", "ricker:25", {{51, 37, 78}, {26, 62, 53}},
                        {Component::vx, Component::vy, Component::vz}, 0.06, 0.001);
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid());
  for (std::int64_t n = 0; n < scene.model.grid().size(); ++n) {
    const auto at = scene.model.grid().index(n);
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside = inside && at[axis] >= shape[axis] / 3 && at[axis] < shape[axis] - shape[axis] / 3;
    scene.model.fracture[std::size_t(n)] = inside;
  }
  scene.model.fracture_sets = {set};
  return scene;
}

/// A plane wave of so many m of the axis before, or behind, the top in layers of so many rows of a rock each,
/// between layers that absorb, below a free surface where the first is water. The middle of the top is at 0.
template <int D>
Scene<D> plane_wave_in(const std::vector<std::pair<Material, std::int64_t>>& layers, const Index<D>& shape,
                       const std::string& kind, double from_m, double duration_s) {
  Grid<D> grid{shape, 5, {}};
  for (std::size_t axis = 0; axis + 1 < D; ++axis) grid.origin_m[axis] = -2.5 * double(shape[axis]);
  std::vector<Material> rocks;
  for (const auto& layer : layers) rocks.push_back(layer.first);
  Scene<D> scene;
  scene.model.medium = medium_of(grid, rocks, [&](const Index<D>& at) {
    std::size_t n = 0;
    for (auto row = at[D - 1]; n + 1 < layers.size() && row >= layers[n].second; ++n) row -= layers[n].second;
    return rocks[n];
  });
  Point<D> from{};
  from[D - 1] = from_m;
  scene.survey.sources = {{from, parse_mechanism<D>(kind), parse_wavelet("ricker:25"), 1}};
  for (int axis = 0; axis < D; ++axis) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  if (rocks[0].vs == 0) scene.edges[D - 1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz}, duration_s, 0.001};
  if (D == 3) scene.recording.components = {Component::vx, Component::vy, Component::vz};
  scene.numerics.order = 7;
  if (D == 3) scene.numerics.zone_cells = 10;
  return scene;
}

/// Draws rocks, numbers and water.
struct Draw {
  explicit Draw(unsigned seed) : engine(seed) {}
  double operator()(double low, double high) { return low + (high - low) * uniform(engine); }
  /// Orthorhombic rock: what its parameters may be, as shares of `wide` on both sides of 0.
  Material rock(double wide, std::array<double, 2> vs_over_vp, bool turned) {
    for (;;) {
      auto& draw = *this;
      const double vp = draw(2000, 5000), low = -wide, high = 2 * wide;
      Material rock{vp,
                    vp * draw(vs_over_vp[0], vs_over_vp[1]),
                    draw(1800, 2800),
                    draw(low, high),
                    draw(low, high),
                    0,
                    draw(low, high)};
      rock.orthorhombic = {draw(low, high), draw(low, high), draw(low, -low), draw(low, high)};
      if (fault_of_anisotropy(rock, true)) continue;
      return turned ? turned_by(rock, draw(-90, 90), draw(-180, 180), draw(-180, 180)) : rock;
    }
  }
  std::mt19937 engine;
  std::uniform_real_distribution<double> uniform{0, 1};
};

}  // namespace slipwave::solver
