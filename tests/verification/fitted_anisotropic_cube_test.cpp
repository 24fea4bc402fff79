// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic rock in 3-D in rows that bend against the solver in 2-D, sums over plane waves, level rows,
// symmetry and itself.
#include <gtest/gtest.h>

#include <cstdlib>

#include "anisotropic_cube.hpp"
#include "fitted_scenes.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

bool long_form() { return std::getenv("SLIPWAVE_LONG") != nullptr; }
bool show() { return std::getenv("SLIPWAVE_SHOW") != nullptr; }

Material turned_by(Material rock, double tilt, double azimuth, double rotation = 0) {
  rock.tilt = tilt, rock.azimuth = azimuth, rock.rotation = rotation;
  return rock;
}
const Material stiff{3600, 1900, 2450, 0.15, 0.1, 0, 0.1};

/// Makes the solids of a medium of two rocks of these, by which is faster; water stays.
template <int D>
void put_rocks(Medium<D>& medium, const Material& slow, const Material& fast, double between_m_s) {
  if (D == 3)
    medium[slow.orthorhombic || fast.orthorhombic ? Property::epsilon1 : Property::gamma] =
        Field<D>(medium.grid());
  else
    medium[Property::epsilon] = Field<D>(medium.grid());
  add_angles(medium, {slow, fast});
  complete_anisotropy(medium);
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (medium.is_solid(cell)) put(medium, cell, medium.vp[cell] > between_m_s ? fast : slow);
}

const std::vector<Component> motion_and_stress = {Component::vx, Component::vz, Component::sxx,
                                                  Component::szz, Component::sxz};

/// A slice of hills or of a sea in the plane of two axes, of anisotropic rocks, and what it is in 2-D.
Extruded bent_slice(const std::array<int, 2>& axes, bool hills, const EdgeLaws<2>& edges,
                    const Material& upper, const Material& lower) {
  const bool along_y = axes[0] == 1;
  const std::vector<Component> of_yz = {Component::vy, Component::vz, Component::syy, Component::szz,
                                        Component::syz};
  auto both = extruded(axes, edges, "force:1,2", along_y ? "force:0,1,2" : "force:1,0,2", motion_and_stress,
                       along_y ? of_yz : motion_and_stress);
  const auto floor = [](double x) { return 81 + 0.12 * x + 6 * std::sin(x / 35); };
  const auto bed = [](double x) { return 212 - 0.05 * x; };
  const auto layers = [&](bool swapped) {
    const auto on = [swapped](auto depth) {
      return [=](double x, double y) { return depth(swapped ? y : x); };
    };
    const Rock one{upper.vp, upper.vs, upper.rho}, two{lower.vp, lower.vs, lower.rho};
    if (hills) return std::vector<Below>{below(on(floor), one), below(on(bed), two)};
    return std::vector<Below>{water_above, below(on(floor), one), below(on(bed), two)};
  };
  both.flat.model.medium = fitted_medium<2>(both.flat.model.grid(), layers(false), hills);
  both.deep.model.medium = fitted_medium<3>(both.deep.model.grid(), layers(along_y), hills);
  const double between = (upper.vp + lower.vp) / 2;
  const auto flat = [](Material rock) {
    rock.gamma = 0, rock.azimuth = 0;
    return rock;
  };
  put_rocks(both.flat.model.medium, flat(upper), flat(lower), between);
  const auto in_space = [&](const Material& rock) { return turned_by(rock, rock.tilt, along_y ? 90 : 0); };
  put_rocks(both.deep.model.medium, in_space(upper), in_space(lower), between);
  const std::vector<Point<2>> receivers = {{101, 120}, {302.5, 201.3}, {420, 180}, {201, 313}, {330, 125}};
  both.flat.survey.receivers_m = receivers;
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    both.deep.survey.receivers_m.resize(receivers.size(), {2.5, 2.5, 2.5});
    for (std::size_t axis = 0; axis < 2; ++axis)
      both.deep.survey.receivers_m[n][std::size_t(axes[axis])] = receivers[n][axis];
  }
  both.flat.recording.duration_s = both.deep.recording.duration_s = 0.1;
  // The smaller of both bounds.
  both.flat.numerics.cfl = 0.7;
  both.deep.numerics.cfl = 0.7 * stable_time_step_s(both.flat) / stable_time_step_s(both.deep);
  return both;
}

// Proves (F15).
TEST(FittedAnisotropyInSpace, OfASliceIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  struct Kind {
    EdgeLaw top, sides, bottom;
    int order;
    bool hills;
    double tilt;
  };
  for (const auto& [top, sides, bottom, order, hills, tilt] :
       {Kind{EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing, 5, true, 0},
        Kind{EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing, 5, false, 30},
        Kind{EdgeLaw::rigid, EdgeLaw::free, EdgeLaw::rigid, 7, true, -40},
        Kind{EdgeLaw::absorbing, EdgeLaw::mirror, EdgeLaw::rigid, 3, false, 0}}) {
    SCOPED_TRACE(std::to_string(hills) + " order " + std::to_string(order));
    auto both = bent_slice({0, 2}, hills, edges_of(top, sides, bottom), turned_by(shale, tilt, 0),
                           turned_by(stiff, -tilt / 2, 0));
    both.flat.numerics.order = both.deep.numerics.order = order;
    const double error = largest_error(both);
    if (show()) std::printf("slice hills %d order %d tilt %g: %g\n", hills, order, tilt, error);
    EXPECT_LT(error, 1e-8);
  }
}

// Proves (F16).
TEST(FittedAnisotropyInSpace, OfASliceOfYAndZIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  // Half sweeps along x of two steps are one in 2-D, but not along y: that error falls with the step.
  const auto difference = [](double cfl) {
    auto both = bent_slice({1, 2}, true, edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing),
                           turned_by(shale, 30, 0), turned_by(stiff, -15, 0));
    both.flat.numerics.cfl *= cfl, both.deep.numerics.cfl *= cfl;
    both.flat.recording.duration_s = both.deep.recording.duration_s = long_form() ? 0.1 : 0.05;
    const double error = relative_error(samples_of(shoot(both.deep, 1)), samples_of(shoot(both.flat, 1)));
    if (show()) std::printf("slice of y and z: %g\n", error);
    return error;
  };
  const double coarse = difference(1);
  EXPECT_LT(coarse, 4e-3);
  if (!long_form()) return;
  EXPECT_LT(difference(0.5), 0.6 * coarse);
}

// Proves (F16).
TEST(FittedAnisotropyInSpace, ThatAttenuatesIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  auto both = bent_slice({0, 2}, true, edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing),
                         turned_by(shale, 30, 0), stiff);
  const auto attenuate = [](auto& scene) {
    auto& medium = scene.model.medium;
    for (const auto property : {Property::qp, Property::qs}) {
      medium[property] = medium.rho;
      for (auto& value : medium[property]) value = property == Property::qp ? 30 : 20;
    }
    set_attenuation(scene);
  };
  const auto elastic = both;
  attenuate(both.flat), attenuate(both.deep);
  const double error = largest_error(both);
  if (show()) std::printf("attenuating slice: %g\n", error);
  // Moduli without relaxation are single precision; points beside interfaces extrapolate from their own side,
  // which multiplies what these round by up to 3.5.
  EXPECT_LT(error, 2e-5);
  both.flat = elastic.flat;
  EXPECT_GT(largest_error(both), 0.1);
}

// Proves (F16).
TEST(FittedAnisotropyInSpace, LeavesStrainsAtASurfaceThatDipsThatPutNoTractionOnIt) {
  const ThreadLimit one_thread(1);
  const auto rock = turned_by(cracked, 30, 40, 20);
  const auto surface = [](double x, double y) { return 50 + 0.3 * (x - 70) - 0.2 * (y - 70); };
  auto medium = fitted_medium<3>(Grid<3>{{28, 28, 30}, 5, {0, 0, 0}},
                                 {below(surface, {rock.vp, rock.vs, rock.rho})}, true);
  put_rocks(medium, rock, rock, 0);
  auto scene = scene_of(
      std::move(medium), edges_all_3d(EdgeLaw::rigid), {62, 65, 100}, "force:0,0,1", "ricker:20",
      {{85, 80, surface(85, 80)}},
      {Component::exx, Component::eyy, Component::ezz, Component::eyz, Component::exz, Component::exy}, 0.08,
      0.001);
  scene.edges[2][0] = EdgeLaw::free;
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto c = elasticity_of<3>(rock);
  const std::array<double, 3> normal = {-0.3, 0.2, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0, size = 0;
    for (std::size_t n = 0; n < gather.traces[0].samples.size(); ++n) {
      double traction = 0;
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 6; ++k)
          traction += normal[j] * c.voigt[Elasticity<3>::pair(int(i), int(j))][k] * (k < 3 ? 1 : 2) *
                      gather.traces[k].samples[n];
      sum += traction * traction, size += std::pow(c.voigt[2][2] * gather.traces[2].samples[n], 2);
    }
    if (show()) std::printf("traction %g\n", std::sqrt(sum / size));
    EXPECT_LT(std::sqrt(sum / size), 1e-4) << i;
  }
}

/// The sea of fitted_sea_3d(), or hills of rock in its place.
Scene<3> sea_or_hills(bool hills, const Material& rock, const Index<3>& shape = {40, 22, 44}) {
  auto scene = fitted_sea_3d(shape);
  scene.model.fracture = {}, scene.model.fracture_sets = {}, scene.with_slip = false;
  const auto floor = [](double x, double y) {
    return 63 + 0.1 * x - 0.15 * y + 4 * std::sin(x / 25 + y / 30);
  };
  const Rock solid{rock.vp, rock.vs, rock.rho};
  const Grid<3> grid{shape, 5, {0, 0, 0}};
  scene.model.medium = hills ? fitted_medium<3>(grid, {below(floor, solid)}, true)
                             : fitted_medium<3>(grid, {water_above, below(floor, solid)});
  if (rock.is_anisotropic()) put_rocks(scene.model.medium, rock, rock, 0);
  return scene;
}

// Proves (F16).
TEST(FittedAnisotropyInSpace, OfNextToNoneIsIsotropicRock) {
  const ThreadLimit one_thread(1);
  // Water over rock: free surfaces of rock alone have terms (E11b), (E11c) that anisotropic rock has not.
  for (const int order : {5, 7}) {
    Material rock{3000, 1600, 2300};
    auto scene = sea_or_hills(false, rock);
    scene.numerics.double_precision = true, scene.numerics.order = order;
    const auto isotropic = samples_of(shoot(scene, 1));
    rock.epsilon = 1e-7;
    scene.model.medium = sea_or_hills(false, order == 7 ? turned_by(rock, 20, 50) : rock).model.medium;
    const double error = relative_error(samples_of(shoot(scene, 1)), isotropic);
    if (show()) std::printf("next to none, order %d: %g\n", order, error);
    EXPECT_LT(error, 1e-6);
  }
}

/// By how much the traces of hills differ from those of the same turned about the vertical by a right angle:
/// x becomes y, and y becomes -x.
double difference_when_turned(bool bent, double cfl) {
  const double length = 150;
  std::array<std::vector<double>, 2> samples;
  for (const bool turned : {false, true}) {
    const auto before = [=](double x, double y) { return turned ? Point<2>{y, length - x} : Point<2>{x, y}; };
    const auto surface = [=](double x, double y) {
      const auto at = before(x, y);
      return bent ? 31 + 0.2 * at[0] + 0.08 * at[1] + 3 * std::sin(at[0] / 25 + at[1] / 40) : 30;
    };
    const auto place = [=](const Point<3>& at) {
      return turned ? Point<3>{length - at[1], at[0], at[2]} : at;
    };
    const auto rock = turned_by(cracked, 25, turned ? 125 : 35, 50);
    const Grid<3> grid{{30, 30, 44}, 5, {0, 0, 0}};
    auto medium = fitted_medium<3>(grid, {below(surface, {rock.vp, rock.vs, rock.rho})}, true);
    put_rocks(medium, rock, rock, 0);
    auto edges = edges_all_3d(EdgeLaw::rigid);
    edges[2][0] = EdgeLaw::free;
    auto scene =
        scene_of(std::move(medium), edges, place({72, 62, 91}), turned ? "force:-2,1,3" : "force:1,2,3",
                 "ricker:30", {place({112, 102, 110}), place({41, 33, 80})},
                 {Component::vx, Component::vy, Component::vz}, 0.09, 0.001);
    scene.numerics.double_precision = true, scene.numerics.cfl = cfl;
    check(scene);
    auto gather = shoot(scene, 1);
    if (turned)
      for (std::size_t n = 0; n < 2; ++n) {
        std::swap(gather.traces[n].samples, gather.traces[2 + n].samples);
        for (auto& value : gather.traces[2 + n].samples) value = -value;
      }
    samples[std::size_t(turned)] = samples_of(gather);
  }
  return relative_error(samples[1], samples[0]);
}

// Proves (F16).
TEST(FittedAnisotropyInSpace, IsTurnedWithItsAxes) {
  const ThreadLimit one_thread(1);
  // Sweeps along x and y do not commute: that error falls with the step, as that of level rows does.
  const double level = difference_when_turned(false, 0.8), coarse = difference_when_turned(true, 0.8);
  if (show()) std::printf("turned %g level %g\n", coarse, level);
  EXPECT_LT(coarse, 1.5 * level);
  if (!long_form()) return;
  EXPECT_LT(difference_when_turned(true, 0.4), 0.7 * coarse);
}

/// The error of a force in a space of one rock, whose rows follow a horizon that dips and rolls, against sums
/// over plane waves.
double error_in_bent_rows(const Material& rock, int cells) {
  auto tilted = rock;
  // So that the scene stretches to all sides.
  if (tilted.tilt == 0) tilted.tilt = 1e-3;
  auto force = force_in_space(tilted, cells);
  auto& medium = force.scene.model.medium;
  auto grid = medium.grid();
  // Fitted grids begin at a depth of 0.
  const double size = 5. * cells, middle = -grid.origin_m[2];
  const auto horizon = [=](double x, double y) {
    return middle + 0.1 * size + 0.25 * x - 0.15 * y + 0.1 * size * std::sin((x + y) / size);
  };
  const Rock solid{rock.vp, rock.vs, rock.rho};
  grid.origin_m[2] = 0;
  medium = fitted_medium<3>(grid, {below(nullptr, solid), below(horizon, solid)});
  put_rocks(medium, rock, rock, 0);
  auto& survey = force.scene.survey;
  survey.sources[0].position_m[2] += middle;
  for (auto& at : survey.receivers_m) at[2] += middle;
  check(force.scene);
  const AnisotropicSpace space(rock);
  return force.error([&](Point<3> at, std::size_t count) {
    at[2] -= middle;
    return space.velocity(at, 1, {force.peak_hz}, 0.001, count);
  });
}

// Proves (F15).
TEST(FittedAnisotropyInSpace, OfAForceIsThatOfPlaneWavesInAllDirections) {
  const ThreadLimit one_thread(1);
  const auto error_of = [](const char* name, const Material& rock, int cells) {
    const double error = error_in_bent_rows(rock, cells);
    if (show()) std::printf("force in bent rows, %s, %d cells: %.4f\n", name, cells, error);
    return error;
  };
  EXPECT_LT(error_of("tilted", turned_by(cracked, 40, 25, -50), 10), 0.04);
  if (!long_form()) return;
  for (const auto& [name, rock] :
       {std::pair{"upright", shale}, {"tilted", turned_by(cracked, 40, 25, -50)}}) {
    const double coarse = error_of(name, rock, 12), fine = error_of(name, rock, 18);
    EXPECT_LT(coarse, 0.03) << name;
    EXPECT_LT(fine, 0.01) << name;
  }
}

/// An experiment in rock below a surface, or a floor of water, that is level, or dips along x and y. Places
/// are along the dip, along the strike, and below.
struct TurnedExperiment {
  Material rock;  // alike in all directions across its axis
  bool sea;
  int cells;  // per wavelength of its slowest wave at the peak

  static constexpr double h = 5, slope_x = 0.25, slope_y = 0.15;
  double wavelength() const { return h * cells; }
  /// Of the dipping frame; that of the level one is the grid.
  static std::array<Point<3>, 3> frame() {
    const double over = 1 / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
    const Point<3> down = {-slope_x * over, -slope_y * over, over};
    const double along = 1 / std::sqrt(1 + slope_x * slope_x);
    const Point<3> one = {along, 0, slope_x * along};
    return {one,
            {down[1] * one[2] - down[2] * one[1], down[2] * one[0] - down[0] * one[2],
             down[0] * one[1] - down[1] * one[0]},
            down};
  }
  /// The rock as the dipping frame sees it: its axis in components of the frame.
  Material seen_level() const {
    const auto axis = axes_of<3>(rock)[2];
    Point<3> seen{};
    const auto axes = frame();
    for (std::size_t n = 0; n < 3; ++n)
      for (std::size_t i = 0; i < 3; ++i) seen[n] += axes[n][i] * axis[i];
    const double degree = std::numbers::pi / 180;
    return turned_by(rock, std::atan2(std::hypot(seen[0], seen[1]), seen[2]) / degree,
                     std::atan2(-seen[1], -seen[0]) / degree);
  }

  /// Traces along the dip, the strike and the normal.
  std::vector<double> traces(bool dips) const {
    const double l = wavelength(), depth = (sea ? 1.9 : 1.1) * l;
    // Wide enough that nothing comes back from where the rows of the zones become level.
    const auto across = std::int64_t(4.2 * cells),
               down = std::int64_t(std::lround((sea ? 4.2 : 3.4) * cells));
    const double middle = 0.5 * h * double(across), top = dips  ? depth
                                                          : sea ? std::lround(1.9 * cells) * h
                                                                : 0;
    const auto axes = frame();
    const auto place = [&](double a, double b, double c) -> Point<3> {
      if (!dips) return {middle + a, middle + b, top + c};
      Point<3> at = {middle, middle, top};
      for (std::size_t i = 0; i < 3; ++i) at[i] += a * axes[0][i] + b * axes[1][i] + c * axes[2][i];
      return at;
    };
    const auto horizon = [=](double x, double y) {
      return dips ? depth + slope_x * (x - middle) + slope_y * (y - middle) : top;
    };
    const Grid<3> grid{{across, across, down}, h, {0, 0, 0}};
    const Rock solid{rock.vp, rock.vs, rock.rho};
    auto medium = sea    ? fitted_medium<3>(grid, {water_above, below(horizon, solid)})
                  : dips ? fitted_medium<3>(grid, {below(horizon, solid)}, true)
                         : uniform_cube(grid.shape, h, solid);
    const auto own = dips ? rock : seen_level();
    put_rocks(medium, own, own, 0);
    std::vector<Point<3>> receivers;
    for (const auto& at : {Point<3>{0.8, 0.3, 0.3}, {-0.7, 0.6, 0.5}, {0.2, -0.9, 0.25}, {-0.5, -0.6, 0.8}})
      receivers.push_back(place(at[0] * l, at[1] * l, at[2] * l));
    const double peak_hz = slowest_speeds<3>(rock).s / l;
    auto edges = edges_all_3d(EdgeLaw::absorbing);
    if (!sea) edges[2][0] = EdgeLaw::free;
    auto scene = scene_of(std::move(medium), edges, place(0.05 * l, -0.1 * l, (sea ? -0.6 : 0.7) * l),
                          "explosion", ("ricker:" + std::to_string(peak_hz)).c_str(), receivers,
                          {Component::vx, Component::vy, Component::vz}, 2.9 / peak_hz, 0.05 / peak_hz);
    check(scene);
    const auto gather = shoot(scene, 1);
    std::vector<double> found;
    for (std::size_t at = 0; at < receivers.size(); ++at)
      for (std::size_t n = 0; n < 3; ++n)
        for (std::size_t sample = 0; sample < gather.traces[at].samples.size(); ++sample) {
          double sum = 0;
          for (std::size_t i = 0; i < 3; ++i)
            sum += (dips ? axes[n][i] : double(n == i)) *
                   gather.traces[i * receivers.size() + at].samples[sample];
          found.push_back(sum);
        }
    return found;
  }
  double difference() const { return relative_error(traces(true), traces(false)); }
};

// Proves (F16).
TEST(FittedAnisotropyInSpace, OfAnExperimentThatIsTurnedIsTheTurnedFieldLong) {
  const ThreadLimit one_thread(1);
  for (const bool sea : {false, true}) {
    if (!long_form() && sea) continue;
    const auto rock = turned_by(shale, 25, 70);
    const double coarse = TurnedExperiment{rock, sea, 10}.difference();
    if (show()) std::printf("turned, %s, 10 cells: %.4f\n", sea ? "sea" : "surface", coarse);
    EXPECT_LT(coarse, 0.05);
    if (!long_form()) continue;
    const double fine = TurnedExperiment{rock, sea, 18}.difference();
    if (show()) std::printf("turned, %s, 18 cells: %.4f\n", sea ? "sea" : "surface", fine);
    EXPECT_LT(fine, 0.01);
    EXPECT_GT(std::log(coarse / fine) / std::log(1.8), 2);
  }
}

}  // namespace
}  // namespace slipwave::solver
