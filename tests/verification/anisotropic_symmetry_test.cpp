// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic rock of every kind in a slice of 3-D is that in 2-D, is turned with its axes, and is shot alike
// from both ends.
#include <gtest/gtest.h>

#include "anisotropic_rocks.hpp"
#include "cube_extruded.hpp"
#include "fitted_scenes.hpp"
#include "parallel/threads.hpp"
#include "solver/effect/slip.hpp"

namespace slipwave::solver::anisotropic_symmetry_test {
namespace {

using Layers = std::vector<std::pair<Material, std::int64_t>>;

bool show() { return std::getenv("SLIPWAVE_SHOW") != nullptr; }

/// The rock with two axes exchanged.
Material exchanged(const Material& rock, int one, int other) {
  const auto c = upright_elasticity<3>(rock);
  std::array<int, 3> axis = {0, 1, 2};
  std::swap(axis[std::size_t(one)], axis[std::size_t(other)]);
  const auto normal = [&](std::size_t i, std::size_t j) { return c(axis[i], axis[i], axis[j], axis[j]); };
  const auto shear = [&](std::size_t i, std::size_t j) { return c(axis[i], axis[j], axis[i], axis[j]); };
  return material_of(orthorhombic({normal(0, 0), normal(1, 1), normal(2, 2), shear(1, 2), shear(0, 2),
                                   shear(0, 1), normal(0, 1), normal(0, 2), normal(1, 2)}),
                     rock.rho);
}
/// What a rock alike in all level directions is in their plane.
Material in_level_plane(const Material& rock) {
  const auto c = upright_elasticity<3>(rock);
  return {std::sqrt(c(1, 1) / rock.rho), std::sqrt(c(6, 6) / rock.rho), rock.rho};
}

/// The short form has less rock around the source.
Index<2> slice_cells() { return long_form() ? Index<2>{90, 70} : Index<2>{64, 52}; }

/// Both scenes with their times and receivers, which the short form has closer to the source and to narrower
/// layers that absorb.
Extruded recorded(Extruded both, double short_s, double long_s, const std::vector<Point<2>>& near,
                  const std::vector<Point<2>>& far) {
  const auto& points = long_form() ? far : near;
  both.flat.recording.duration_s = both.deep.recording.duration_s = long_form() ? long_s : short_s;
  if (!long_form()) both.flat.numerics.zone_cells = both.deep.numerics.zone_cells = 6;
  both.flat.survey.receivers_m = points;
  both.deep.survey.receivers_m.assign(points.size(), {2.5, 2.5, 2.5});
  for (std::size_t n = 0; n < points.size(); ++n)
    for (std::size_t axis = 0; axis < 2; ++axis)
      both.deep.survey.receivers_m[n][std::size_t(both.axes[axis])] = points[n][axis];
  return both;
}

/// In the plane of two axes, below water and a free surface where it is upright.
Extruded level_slice(const std::array<int, 2>& axes, const Material& upper, const Material& lower,
                     const Material& flat_upper, const Material& flat_lower) {
  const bool level = axes[1] == 1;
  const char* names[] = {"vx", "vy", "vz"};
  std::string force = "force:0,0,0";
  force[std::size_t(6 + 2 * axes[0])] = '1', force[std::size_t(6 + 2 * axes[1])] = '1';
  auto both =
      extruded(axes, edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing), "force:1,1",
               force.c_str(), {Component::vx, Component::vz},
               {component_named(names[axes[0]], 3), component_named(names[axes[1]], 3)}, slice_cells());
  const auto rock_at = [=](std::int64_t row, const Material& over, const Material& under) {
    return !level && row < 12 ? sea : row > 38 ? under : over;
  };
  both.flat.model.medium =
      medium_of(both.flat.model.grid(), {flat_upper, flat_lower},
                [&](const Index<2>& at) { return rock_at(at[1], flat_upper, flat_lower); });
  both.deep.model.medium = medium_of(both.deep.model.grid(), {upper, lower}, [&](const Index<3>& at) {
    return rock_at(at[std::size_t(axes[1])], upper, lower);
  });
  // In 2-D the sweeps of a step are others where the plane is not that of x and z, of second order in it.
  if (axes != std::array<int, 2>{0, 2}) both.flat.numerics.cfl = both.deep.numerics.cfl = 0.4;
  // Along y vectors of cells hold one each.
  return recorded(both, axes[0] == 1 ? 0.07 : 0.09, 0.12, {{191, 43}, {262.5, 161.3}, {241, 83}, {211, 213}},
                  {{101, 33}, {302.5, 201.3}, {420, 60}, {201, 313}});
}
/// Of rock that is tilted within it: along x, or along y.
Extruded tilted_slice(const Material& upper, const Material& lower, double azimuth = 0) {
  const auto at = [=](Material rock) {
    if (rock.tilt != 0) rock.azimuth = azimuth;
    return rock;
  };
  return level_slice({azimuth > 0 ? 1 : 0, 2}, at(upper), at(lower), in_plane(upper), in_plane(lower));
}

/// Of hills or of a sea whose rows bend, with stresses.
Extruded curvilinear_slice(int along, bool hills, const EdgeLaws<2>& edges, int order, const Material& upper,
                           const Material& lower) {
  using enum Component;
  const bool along_y = along == 1;
  const std::vector<Component> of_xz = {vx, vz, sxx, szz, sxz}, of_yz = {vy, vz, syy, szz, syz};
  auto both = extruded({along, 2}, edges, "force:1,2", along_y ? "force:0,1,2" : "force:1,0,2", of_xz,
                       along_y ? of_yz : of_xz, slice_cells());
  const auto layers = [&](bool swapped) {
    const auto on = [swapped](auto depth) {
      return [=](double x, double y) { return depth(swapped ? y : x); };
    };
    std::vector<Below> all = {
        water_above,
        below(on([](double x) { return 81 + 0.12 * x + 6 * std::sin(x / 35); }),
              {upper.vp, upper.vs, upper.rho}),
        below(on([](double x) { return 212 - 0.05 * x; }), {lower.vp, lower.vs, lower.rho})};
    if (hills) all.erase(all.begin());
    return all;
  };
  both.flat.model.medium = fitted_medium<2>(both.flat.model.grid(), layers(false), hills);
  both.deep.model.medium = fitted_medium<3>(both.deep.model.grid(), layers(along_y), hills);
  const double between = (upper.vp + lower.vp) / 2;
  put_rocks(both.flat.model.medium, in_plane(upper), in_plane(lower), between);
  const auto in_3d = [&](const Material& rock) { return turned_by(rock, rock.tilt, along_y ? 90 : 0); };
  put_rocks(both.deep.model.medium, in_3d(upper), in_3d(lower), between);
  both.flat.numerics.order = both.deep.numerics.order = order;
  // The smaller of both bounds.
  both.flat.numerics.cfl = 0.7;
  both.deep.numerics.cfl = 0.7 * stable_time_step_s(both.flat) / stable_time_step_s(both.deep);
  return recorded(both, 0.06, 0.1, {{191, 120}, {252.5, 171.3}, {211, 223}, {241, 125}},
                  {{101, 120}, {302.5, 201.3}, {420, 180}, {201, 313}, {330, 125}});
}

/// With loss, or with planes in a part of the rock.
Extruded lossy(Extruded both, const Qualities& of = {30, 20}) {
  attenuate(both.flat, of), attenuate(both.deep, of);
  return both;
}
Extruded fractured(const FractureSet<2>& flat, const FractureSet<3>& deep,
                   SlipCorrection correction = SlipCorrection::centred) {
  auto both = tilted_slice(dipping_shale, turned_by(stiff, -50));
  both.flat.numerics.correction = both.deep.numerics.correction = correction;
  both.flat.model.fracture = Field<2, std::uint8_t>(both.flat.model.grid());
  both.deep.model.fracture = Field<3, std::uint8_t>(both.deep.model.grid());
  for (std::int64_t k = 30; k < 45; ++k)
    for (std::int64_t i = 35; i < 60; ++i)
      both.flat.model.fracture({i, k}) = 1, both.deep.model.fracture(both.deep_cell(i, k)) = 1;
  both.flat.model.fracture_sets = {flat}, both.deep.model.fracture_sets = {deep};
  return both;
}
Extruded slipping(SlipCorrection correction) {
  return fractured({"planes", {{normal_of_dip(30), 0, 100, 3e5}, {{1, 0}, 0, 200, 2e5}}},
                   {"planes", {{normal_of_dip(30, 0), 0, 100, 3e5}, {{1, 0, 0}, 0, 200, 2e5}}}, correction);
}
Extruded sprung() {
  const auto deep = springs({{30, 0}, {90, 0}}, 0.3, 0.6);
  FractureSet<2> flat{"springs", {{normal_of_dip(30)}, {{1, 0}}}};
  for (std::size_t n = 0; n < 2; ++n) {
    flat.systems[n].law = FrictionLaw::none;
    flat.systems[n].compliance = deep.systems[n].compliance;
  }
  return fractured(flat, deep);
}

Extruded in_plane_wave(const char* kind) {
  const Layers layers = {{in_plane(dipping_shale), 20}, {turned_by({3600, 1900, 2450, 0.15, 0.1}, -50), 0}};
  Extruded both{plane_wave_in<2>(layers, {50, 40}, kind, -60, 0.2),
                plane_wave_in<3>(layers, {50, 1, 40}, kind, -60, 0.2),
                {0, 2}};
  both.deep.edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
  both.deep.recording.components = both.flat.recording.components;
  both.flat.survey.receivers_m = {{-24, 33}, {27, 122}, {6, 181}};
  both.deep.survey.receivers_m = {{-24, 0, 33}, {27, 0, 122}, {6, 0, 181}};
  both.flat.numerics.zone_cells = both.deep.numerics.zone_cells = 10;
  both.flat.numerics.order = both.deep.numerics.order = 5;
  both.flat.numerics.double_precision = both.deep.numerics.double_precision = true;
  both.flat.numerics.cfl = both.deep.numerics.cfl = 0.6;
  check(both.flat), check(both.deep);
  return both;
}

struct Slice {
  const char* name;
  std::function<Extruded()> scenes;
  double bound;
  /// What takes an effect away from 2-D, and by what that changes the traces at least.
  std::function<void(Scene<2>&)> without = {};
  double effect = 0;
  bool in_short = true;
};
void PrintTo(const Slice& of, std::ostream* out) { *out << of.name; }

const auto no_loss = [](Scene<2>& scene) {
  for (const auto property : {Property::qp, Property::qs}) scene.model.medium[property] = {};
  set_attenuation(scene);
};
const auto no_slip = [](Scene<2>& scene) { scene.with_slip = false; };
const auto fitted_edges = edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing);
const auto walls = edges_of(EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::rigid);

const std::vector<Slice> slices = {
    // Each upright plane has its own stiffnesses; level ones are isotropic, with the speeds along them.
    {"Orthorhombic",
     [] {
       return level_slice({0, 2}, cracked, shale, in_plane(cracked), in_plane(shale));
     },
     1e-3},
    {"OrthorhombicOfYAndZ",
     [] {
       return level_slice({1, 2}, cracked, shale, in_plane(exchanged(cracked, 0, 1)), in_plane(shale));
     },
     7e-3},
    {"LevelOfXAndY",
     [] {
       return level_slice({0, 1}, shale, crossed, in_level_plane(shale), in_level_plane(crossed));
     },
     7e-3},
    {"Tilted", [] { return tilted_slice(dipping_shale, turned_by(stiff, -55)); }, 1e-3},
    {"TiltedOfYAndZ",
     [] { return tilted_slice(dipping_shale, turned_by(stiff, -55), 90); },
     7e-3,
     {},
     0,
     false},
    {"Attenuating", [] { return lossy(tilted_slice(shale, stiff)); }, 1e-3, no_loss, 0.1},
    {"TiltedAttenuating", [] { return lossy(tilted_slice(dipping_shale, turned_by(stiff, -55))); }, 1e-3,
     no_loss, 0.1},
    {"AttenuatingOfYAndZ", [] { return lossy(tilted_slice(shale, stiff, 90)); }, 7e-3, no_loss, 0.1, false},
    {"TiltedAttenuatingOfYAndZ", [] { return lossy(tilted_slice(dipping_shale, turned_by(stiff, -55), 90)); },
     7e-3, no_loss, 0.1, false},
    {"Slip", [] { return slipping(SlipCorrection::centred); }, 1e-5, no_slip, 0.03},
    {"SlipSecond", [] { return slipping(SlipCorrection::second); }, 1e-5, no_slip, 0.03, false},
    {"SlipExponential", [] { return slipping(SlipCorrection::exponential); }, 1e-5, no_slip, 0.03, false},
    {"SlipFirst", [] { return slipping(SlipCorrection::first); }, 1e-5, no_slip, 0.03, false},
    {"Springs", sprung, 1e-5, no_slip, 0.03},
    {"FittedHills", [] { return curvilinear_slice(0, true, fitted_edges, 5, shale, stiff); }, 1e-8},
    {"FittedTiltedSea",
     [] { return curvilinear_slice(0, false, fitted_edges, 5, dipping_shale, turned_by(stiff, -15)); }, 1e-8},
    {"FittedTiltedHillsBetweenWalls",
     [] {
       return curvilinear_slice(0, true, edges_of(EdgeLaw::rigid, EdgeLaw::free, EdgeLaw::rigid), 7,
                                turned_by(shale, -40), turned_by(stiff, 20));
     },
     1e-8},
    {"FittedSeaBetweenMirrors",
     [] {
       return curvilinear_slice(0, false, edges_of(EdgeLaw::absorbing, EdgeLaw::mirror, EdgeLaw::rigid), 3,
                                shale, stiff);
     },
     1e-8},
    // Moduli without relaxation are single precision; points beside interfaces extrapolate from their own
    // side, which multiplies what these round by up to 3.5. Between rigid walls: in a layer that absorbs,
    // relaxation and damping follow each other in another order in 3-D, whose steps have more sweeps.
    {"FittedAttenuating",
     [] {
       return lossy(curvilinear_slice(0, true, walls, 5, dipping_shale, stiff), {20, 13});
     },
     2e-5, no_loss, 0.1},
    {"PlaneWave", [] { return in_plane_wave("plane:20"); }, 2e-4, {}, 0, false},
    {"PlaneSWave", [] { return in_plane_wave("plane-s:-25"); }, 2e-4},
};

class AnisotropicSlice : public testing::TestWithParam<Slice> {};

// Proves (O1), (O4), (O8), (O9), (Q12), (S34a), (S34b), (F15), (F16), (A19).
TEST_P(AnisotropicSlice, IsThatInTwoDimensions) {
  const auto& of = GetParam();
  const ThreadLimit one_thread(1);
  auto both = of.scenes();
  EXPECT_LT(largest_error(both), of.bound);
  if (!of.without) return;
  const auto with = samples_of(shoot(both.flat, 1));
  of.without(both.flat);
  EXPECT_GT(relative_error(with, samples_of(shoot(both.flat, 1))), of.effect);
}
const auto name_of_case = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Of, AnisotropicSlice, testing::ValuesIn(of_this_form(slices)), name_of_case);

// Proves (F16).
TEST(AnisotropicSlice, OfYAndZInFittedRowsIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  // Half sweeps along x of two steps are one in 2-D, but not along y: that error falls with the step.
  const auto difference = [](double cfl) {
    auto both = curvilinear_slice(1, true, fitted_edges, 5, dipping_shale, turned_by(stiff, -15));
    both.flat.numerics.cfl *= cfl, both.deep.numerics.cfl *= cfl;
    if (!long_form()) both.flat.recording.duration_s = both.deep.recording.duration_s = 0.03;
    return relative_error(samples_of(shoot(both.deep, 1)), samples_of(shoot(both.flat, 1)));
  };
  const double coarse = difference(1);
  EXPECT_LT(coarse, 4e-3);
  if (long_form()) {
    EXPECT_LT(difference(0.5), 0.6 * coarse);
  }
}

/// By a right angle about the vertical, or not: x becomes y, and y becomes what is left of the width less x.
struct Turn {
  bool on;
  double width_m;
  double degrees() const { return on ? 90 : 0; }
  Point<3> place(const Point<3>& at) const { return on ? Point<3>{width_m - at[1], at[0], at[2]} : at; }
  /// A force, and traces of vx, vy and vz turned back.
  std::string force(double x, double y, double z) const {
    if (on) std::swap(x, y), x = -x;
    return "force:" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z);
  }
  std::vector<double> back(std::vector<double> samples) const {
    const auto third = samples.size() / 3;
    for (std::size_t n = 0; n < third && on; ++n) {
      std::swap(samples[n], samples[third + n]);
      samples[third + n] = -samples[third + n];
    }
    return samples;
  }
};
Material turned_more(const Material& rock, const Turn& turn) {
  return turned_by(rock, rock.tilt, rock.azimuth + turn.degrees(), rock.rotation);
}

/// By how much the traces of a scene that is turned differ from those of the one that is not, at most in one
/// component, or what slip makes of them.
double error_of_turn(double width_m, const std::function<Scene<3>(const Turn&)>& scene_of_turn) {
  std::vector<double> samples[2];
  for (const bool on : {false, true}) {
    const Turn turn{on, width_m};
    auto scene = scene_of_turn(turn);
    check(scene);
    samples[on] = samples_of(shoot(scene, 1));
    if (scene.with_slip && !scene.model.fracture.empty()) {
      scene.with_slip = false;
      const auto welded = samples_of(shoot(scene, 1));
      for (std::size_t n = 0; n < welded.size(); ++n) samples[on][n] -= welded[n];
    }
    samples[on] = turn.back(samples[on]);
  }
  return relative_error(samples[1], samples[0]);
}

const auto turning = turned_by(cracked, 25, 35, 50);

Scene<3> under_surface(const Turn& turn) {
  const auto n = std::int64_t(turn.width_m / 5);
  auto edges = edges_all_3d(EdgeLaw::rigid);
  edges[2][0] = EdgeLaw::free;
  const auto middle = turn.width_m / 2;
  auto scene = scene_of(uniform_rock(Grid<3>{{n, n, n}, 5, {}}, turned_more(turning, turn)), edges,
                        turn.place({middle - 19, middle - 8, 33}), turn.force(1, 0, 0).c_str(), "ricker:18",
                        {turn.place({middle + 31, middle + 22, 12})},
                        {Component::vx, Component::vy, Component::vz}, 0.09, 0.001);
  scene.numerics.cfl = 0.5;
  return scene;
}
Scene<3> turned_cluster(const FractureSet<3>& set, const Turn& turn) {
  auto scene = cluster(turned_more(turning, turn), set);
  scene.survey.sources[0].position_m = turn.place({31, 42, 18});
  scene.survey.sources[0].mechanism = parse_mechanism<3>(turn.force(1, 0, 0));
  scene.survey.receivers_m = {turn.place({51, 62, 78})};
  scene.numerics.cfl = 0.4;
  return scene;
}
Scene<3> turned_plane_wave(const Turn& turn) {
  const bool whole = long_form();
  const std::int64_t across = whole ? 10 : 6, rows = whole ? 16 : 8;
  auto scene =
      plane_wave_in<3>({{turned_more(askew, turn), rows}, {turned_by(shale, 20, 70 + turn.degrees()), 0}},
                       {across, across, 2 * rows}, "plane:25," + std::to_string(40 + turn.degrees()),
                       whole ? -60 : -30, whole ? 0.12 : 0.055);
  scene.survey.receivers_m = {turn.place({-7, 11, 5. * double(rows) - 9})};
  scene.numerics.cfl = 0.4;
  if (!whole) scene.numerics.zone_cells = 6;
  return scene;
}
Scene<3> turned_hills(bool bent, double cfl, const Turn& turn) {
  const auto before = [=](double x, double y) {
    return turn.on ? Point<2>{y, turn.width_m - x} : Point<2>{x, y};
  };
  const auto surface = [=](double x, double y) {
    const auto at = before(x, y);
    return bent ? 31 + 0.2 * at[0] + 0.08 * at[1] + 3 * std::sin(at[0] / 25 + at[1] / 40) : 30;
  };
  const auto rock = turned_more(turning, turn);
  const auto n = std::int64_t(turn.width_m / 5);
  auto medium =
      fitted_medium<3>(Grid<3>{{n, n, n + 14}, 5, {}}, {below(surface, {rock.vp, rock.vs, rock.rho})}, true);
  put_rocks(medium, rock, rock, 0);
  auto edges = edges_all_3d(EdgeLaw::rigid);
  edges[2][0] = EdgeLaw::free;
  const double size = turn.width_m / 150;
  auto scene = scene_of(std::move(medium), edges, turn.place({72 * size, 62 * size, 91}),
                        turn.force(1, 2, 3).c_str(), "ricker:30",
                        {turn.place({112 * size, 102 * size, 110}), turn.place({41 * size, 33 * size, 80})},
                        {Component::vx, Component::vy, Component::vz}, long_form() ? 0.09 : 0.06, 0.001);
  scene.numerics.double_precision = true, scene.numerics.cfl = cfl;
  return scene;
}

struct Turning {
  const char* name;
  double width_m;
  std::function<Scene<3>(const Turn&)> scene;
  double bound;
};
void PrintTo(const Turning& of, std::ostream* out) { *out << of.name; }

const Turning turns[] = {
    {"Tilted", 110, under_surface, 0.005},
    {"Attenuating", 110,
     [](const Turn& turn) {
       auto scene = under_surface(turn);
       attenuate(scene, {30, 15});
       return scene;
     },
     0.005},
    {"Slip", 90,
     [](const Turn& turn) {
       const double azimuth = 20 + turn.degrees();
       return turned_cluster(families({{35, azimuth}, {70, azimuth + 110}}, 0.2, 200), turn);
     },
     0.02},
    {"Springs", 90,
     [](const Turn& turn) {
       const double azimuth = 20 + turn.degrees();
       return turned_cluster(springs({{35, azimuth}, {70, azimuth + 110}}, 0.4, 0.7), turn);
     },
     0.02},
    {"PlaneWave", 0, turned_plane_wave, 0.01},
};
class TurnedAnisotropy : public testing::TestWithParam<Turning> {};

// Proves (O8), (Q12), (S34a), (S34b), (A19).
TEST_P(TurnedAnisotropy, HasTheTracesTurned) {
  const ThreadLimit one_thread(1);
  EXPECT_LT(error_of_turn(GetParam().width_m, GetParam().scene), GetParam().bound);
}
INSTANTIATE_TEST_SUITE_P(Of, TurnedAnisotropy, testing::ValuesIn(turns), name_of_case);

// Proves (F16).
TEST(TurnedAnisotropy, InFittedRowsHasTheTracesTurned) {
  const ThreadLimit one_thread(1);
  // Sweeps along x and y do not commute: that error falls with the step, as that of level rows does.
  const auto error_of = [](bool bent, double cfl) {
    return error_of_turn(long_form() ? 150 : 100,
                         [=](const Turn& turn) { return turned_hills(bent, cfl, turn); });
  };
  const double level = error_of(false, 0.8), coarse = error_of(true, 0.8);
  if (show()) std::printf("turned %g level %g\n", coarse, level);
  EXPECT_LT(coarse, 1.5 * level);
  if (long_form()) {
    EXPECT_LT(error_of(true, 0.4), 0.7 * coarse);
  }
}

// Proves (O1), (O8).
TEST(TurnedAnisotropy, HasTheTracesOfExchangedAxes) {
  const ThreadLimit one_thread(1);
  // Sweeps come in another order, of second order in the step.
  const auto shot = [&](const Material& rock, const Point<3>& source, const Point<3>& receiver,
                        const char* force) {
    auto scene = scene_of(uniform_rock(Grid<3>{{30, 30, 30}, 5, {}}, rock), edges_all_3d(EdgeLaw::rigid),
                          source, force, "ricker:18", {receiver},
                          {Component::vx, Component::vy, Component::vz}, long_form() ? 0.12 : 0.09, 0.001);
    scene.numerics.cfl = 0.5;
    check(scene);
    return shoot(scene, 1);
  };
  const auto one = shot(cracked, {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  const auto turned = shot(exchanged(cracked, 0, 2), {73, 62, 41}, {128, 102, 111}, "force:0,0,1");
  const auto about_z = shot(exchanged(cracked, 0, 1), {62, 41, 73}, {102, 111, 128}, "force:0,1,0");
  for (const std::size_t n : {0, 1, 2}) {
    EXPECT_LT(relative_error(turned.traces[2 - n].samples, one.traces[n].samples), 0.004) << n;
    EXPECT_LT(relative_error(about_z.traces[n < 2 ? 1 - n : 2].samples, one.traces[n].samples), 0.004) << n;
  }
  // A right angle of the tilt lays axes along the grid: no cell is tilted.
  const auto lying = shot(turned_by(shale, 90), {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  const auto c = elasticity_of<3>(turned_by(shale, 90)).along_grid();
  const auto upright = shot(material_of(c, shale.rho), {41, 62, 73}, {111, 102, 128}, "force:1,0,0");
  for (const std::size_t n : {0, 1, 2})
    EXPECT_LT(relative_error(lying.traces[n].samples, upright.traces[n].samples), 1e-4) << n;
}

/// A disc of planes that slide along the beds of a shale, which dip by so much; source and receivers turn
/// with them. Velocities along and across the beds.
std::vector<double> traces_of_beds(double dip_deg, bool slips) {
  const double dip = dip_deg * std::numbers::pi / 180, c = std::cos(dip), s = std::sin(dip);
  const auto at = [=](double x, double z) { return Point<2>{300 + x * c - z * s, 300 + x * s + z * c}; };
  Scene<2> scene;
  scene.model.medium = uniform_rock(Grid<2>{{150, 150}, 4, {}}, turned_by(in_plane(shale), dip_deg));
  add_fractures<2>(scene.model, {"beds", {{normal_of_dip(dip_deg), 0.2, 200, 0}}},
                   [&](const Point<2>& place) { return std::hypot(place[0] - 300, place[1] - 300) < 60; });
  scene.survey.sources = {{at(-20, -150), PointForce<2>{{0.6 * c - 0.8 * s, 0.6 * s + 0.8 * c}},
                           parse_wavelet("ricker:20"), 1e6}};
  for (const auto& [x, z] : {std::pair{0., 130.}, {110., 90.}, {-130., 40.}})
    scene.survey.receivers_m.push_back(at(x, z));
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.25, 0.001};
  scene.with_slip = slips;
  check(scene);
  const auto gather = shoot(scene, 1);
  std::vector<double> all;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t n = 0; n < gather.traces[r].samples.size(); ++n) {
      const double x = gather.traces[r].samples[n], z = gather.traces[r + 3].samples[n];
      all.insert(all.end(), {x * c + z * s, z * c - x * s});
    }
  return all;
}

// Proves (S34).
TEST(TurnedAnisotropy, OfBedsThatSlipIsThatOfFlatBeds) {
  std::vector<double> of_slip[2];
  for (const bool dips : {false, true}) {
    const auto welded = traces_of_beds(dips ? 30 : 0, false);
    of_slip[dips] = traces_of_beds(dips ? 30 : 0, true);
    if (!dips) {
      EXPECT_GT(relative_error(of_slip[dips], welded), 0.05);
    }
    for (std::size_t n = 0; n < welded.size(); ++n) of_slip[dips][n] -= welded[n];
  }
  EXPECT_LT(relative_error(of_slip[1], of_slip[0]), 0.05);
}

/// By what one component of a force along another axis here, and the reverse there, source and receiver
/// exchanged, differ: vz of one along x, or y, and vx, or vy, of one along z.
template <int D>
double error_of_exchange(Scene<D> scene, const Point<D>& one, const Point<D>& other) {
  const auto shot = [&](const Point<D>& from, const Point<D>& to, bool down) {
    scene.survey.sources[0].position_m = from;
    scene.survey.sources[0].mechanism =
        parse_mechanism<D>(std::string(D == 2 ? "force:" : "force:0,") + (down ? "0,1" : "1,0"));
    scene.survey.receivers_m = {to};
    scene.recording.components = {down ? D == 2 ? Component::vx : Component::vy : Component::vz};
    check(scene);
    return samples_of(shoot(scene, 1));
  };
  return relative_error(shot(one, other, false), shot(other, one, true));
}

template <int D>
Scene<D> blocks(const std::vector<Material>& rocks, const Index<D>& shape, const Index<D>& block,
                const char* wavelet, double duration_s) {
  Scene<D> scene;
  scene.model.medium = blocks_below_water<D>(rocks, shape, block);
  for (int axis = 0; axis < D; ++axis) {
    const auto law = D == 2 || axis == 0 ? EdgeLaw::absorbing : EdgeLaw::mirror;
    scene.edges[axis] = {law, law};
  }
  scene.edges[D - 1][0] = EdgeLaw::free;
  scene.survey.sources = {{{}, parse_mechanism<D>("explosion"), parse_wavelet(wavelet), 1e9}};
  scene.recording = {{}, duration_s, 0.001};
  scene.numerics.double_precision = D == 2;
  if (!long_form()) scene.numerics.zone_cells = 10;
  return scene;
}

// Proves (V1), (V7), (O1), (O8).
TEST(ExchangedAnisotropy, DoesNotDependOnWhichWayItIsShot) {
  const ThreadLimit one_thread(1);
  const auto level = blocks<2>({shale, crossed, sandstone}, {150, 90}, {11, 30}, "ricker:25", 0.2);
  EXPECT_LT(error_of_exchange(level, {302.5, 162.5}, {427.5, 352.5}), 0.01);
  // In proportion to the cells of a wavelength: 1.5 % at 40 Hz, 0.3 % at 8 Hz.
  const auto tilted = blocks<2>({dipping_shale, steep, {3100, 1650, 2350, 0.15, 0.05}, {3000, 1500, 2200}},
                                {110, 90}, {13, 17}, "ricker:18", 0.2);
  EXPECT_LT(error_of_exchange(tilted, {202.5, 162.5}, {327.5, 352.5}), 0.01);
  const auto upright_3d = blocks<3>({shale, crossed, cracked}, {34, 30, 32}, {12, 15, 13}, "ricker:25", 0.08);
  EXPECT_LT(error_of_exchange(upright_3d, {63, 71, 92}, {121, 108, 133}), 0.03);
  const auto tilted_3d = blocks<3>({turned_by(shale, 30, 20),
                                    {2900, 1500, 2200},
                                    turned_by(cracked, -40, 60, 15),
                                    turned_by(crossed, 70, -30)},
                                   {34, 30, 32}, {12, 15, 13}, "ricker:25", 0.08);
  EXPECT_LT(error_of_exchange(tilted_3d, {63, 71, 92}, {141, 118, 143}), 0.04);
}

}  // namespace
}  // namespace slipwave::solver::anisotropic_symmetry_test
