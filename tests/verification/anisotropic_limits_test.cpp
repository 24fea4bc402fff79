// SPDX-License-Identifier: BSD-3-Clause
// Rock that is next to isotropic, or next to elastic, is that, though other loops compute it; and what a free
// surface and layers that absorb make of anisotropic rock.
#include <gtest/gtest.h>

#include "anisotropic_rocks.hpp"
#include "anisotropic_scene.hpp"
#include "fitted_scenes.hpp"
#include "geology/layers.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "rock/tilted_mean.hpp"
#include "solver/effect/slip.hpp"

namespace slipwave::solver::anisotropic_limits_test {
namespace {

template <int D>
std::vector<double> traces_of(const Scene<D>& scene) {
  check(scene);
  return samples_of(shoot(scene, 1));
}
std::vector<double> difference(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t n = 0; n < one.size(); ++n) one[n] -= other[n];
  return one;
}
/// What slip changes in the traces.
std::vector<double> of_slip(Scene<3> scene) {
  const auto with = traces_of(scene);
  scene.with_slip = false;
  return difference(with, traces_of(scene));
}
/// No property but those of isotropic rock.
template <int D>
Scene<D> without_anisotropy(Scene<D> scene) {
  for (const auto property : scene.model.medium.properties())
    if (property >= Property::epsilon) scene.model.medium[property] = {};
  return scene;
}

/// Blocks of rocks and water between a free surface, mirrors and layers that absorb.
template <int D>
Scene<D> blocks(const std::vector<Material>& rocks) {
  Index<D> shape, block;
  shape.fill(D == 2 ? 60 : 26), block.fill(D == 2 ? 20 : 13);
  Scene<D> scene;
  scene.model.medium = blocks_below_water<D>(rocks, shape, block);
  const double size = 5. * double(shape[0]);
  Point<D> from, to, other;
  from.fill(0.4 * size), to.fill(0.7 * size), other.fill(0.3 * size);
  scene.survey.sources = {
      {from, parse_mechanism<D>(D == 2 ? "force:1,1" : "force:1,1,1"), parse_wavelet("ricker:25"), 1e9}};
  scene.survey.receivers_m = {to, other};
  for (int axis = 0; axis < D; ++axis) {
    const auto law = axis > 0 ? EdgeLaw::mirror : EdgeLaw::absorbing;
    scene.edges[axis] = {law, law};
  }
  scene.edges[D - 1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, D == 2 ? 0.15 : 0.06, 0.001};
  if (D == 3) scene.recording.components.push_back(Component::vy);
  if (D == 3) scene.numerics.zone_cells = 6;
  return scene;
}

/// By how much the traces differ where no cell is anisotropic but one far away, by some property.
template <int D>
double error_beside(Property property) {
  const Material soft{2500, 1200, 2100};
  auto scene = without_anisotropy(blocks<D>({plain, soft, plain}));
  const auto isotropic = traces_of(scene);
  // No cell is anisotropic.
  EXPECT_EQ(traces_of(blocks<D>({plain, soft, plain})), isotropic);
  auto& medium = scene.model.medium;
  medium[property] = Field<D>(medium.grid());
  medium[property][medium.vp.size() - 1] = 1e-6F;
  complete_anisotropy(medium);
  return relative_error(traces_of(scene), isotropic);
}

// Proves (V1), (O1), (O8).
TEST(NextToIsotropic, InLevelRowsIsIsotropicRock) {
  const ThreadLimit one_thread(1);
  EXPECT_LT(error_beside<2>(Property::epsilon), 1e-5);
  EXPECT_LT(error_beside<3>(Property::gamma), 2e-5);
  EXPECT_LT(error_beside<3>(Property::gamma2), 2e-5);
  // Swept as tilted rock all the same.
  auto rock = plain;
  rock.epsilon = 1e-8;
  // What forces and velocities beside a sea floor are told of it (A24) stops at turned axes.
  const auto away = [](const Material& of) {
    auto scene = blocks<3>({of});
    scene.survey.sources[0].position_m[2] = 92;
    return traces_of(scene);
  };
  EXPECT_LT(relative_error(away(turned_by(rock, 30, 20)), away(plain)), 3e-5);
}

/// The largest difference of the traces of a sea of isotropic rocks from those of rocks next to them.
template <int D>
void expect_next_to_isotropic_in_fitted_rows(Scene<D> scene) {
  // Water over rock: free surfaces of rock alone have terms (E11b), (E11c) that anisotropic rock has not.
  scene.with_slip = false;
  scene.numerics.double_precision = true;
  for (const int order : {5, 7}) {
    scene.numerics.order = order;
    auto other = scene;
    describe(other.model.medium, {turned_by(dipping_shale, 20, D == 3 && order == 7 ? 50 : 0)});
    for (std::size_t cell = 0; cell < scene.model.medium.vp.size(); ++cell) {
      if (!scene.model.medium.is_solid(cell)) continue;
      auto rock = material_of(scene.model.medium, cell);
      rock.epsilon = 1e-7;
      put(other.model.medium, cell, order == 7 ? turned_by(rock, 20, D == 3 ? 50 : 0) : rock);
    }
    EXPECT_LT(relative_error(traces_of(other), traces_of(scene)), 1e-6) << D << ' ' << order;
  }
}

// Proves (F11), (F12), (F16).
TEST(NextToIsotropic, InFittedRowsIsIsotropicRock) {
  const ThreadLimit one_thread(1);
  auto plane = fitted_sea(110, 80);
  if (!long_form()) plane.numerics.zone_cells = 10;
  plane.survey.sources[0].position_m[0] = 230;
  plane.survey.receivers_m = {{330, 150}, {262.5, 261.3}, {140, 333}, {240, 118}};
  expect_next_to_isotropic_in_fitted_rows(plane);
  auto space = fitted_sea_3d({26, 14, 34});
  if (!long_form()) space.numerics.zone_cells = 4;
  space.model.fracture = {}, space.model.fracture_sets = {};
  space.survey.sources[0].position_m = {62, 32, 112};
  space.survey.receivers_m = {{82.5, 42.5, 127.5}, {41, 23.4, 31}, {102, 40, 88}};
  expect_next_to_isotropic_in_fitted_rows(space);
}

TEST(NextToIsotropic, StandsBelowAFloorThatRowsFollow) {
  // Curvilinear rows above, level ones of another height below, among which a rock that is next to isotropic.
  const std::vector<Layer> layers = {parse_layer("0:1500:0:1000"),
                                     parse_layer("sine,100,10,200:2500:1200:2200"),
                                     parse_layer("300:3000:1600:2300 epsilon=1e-6")};
  const auto fit = fit_layers<2>(Grid<2>{{60, 90}, 5, {0, 0}}, layers, {});
  ASSERT_TRUE(fit.grid.rows);
  Scene<2> scene;
  scene.model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
  scene.survey.sources = {{{150, 50}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:25"), 1e6}};
  scene.survey.receivers_m = {{60, 40}, {220, 350}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.2, 0.002};
  expect_same(scene);
  EXPECT_LT(relative_error(traces_of(scene), traces_of(without_anisotropy(scene))), 1e-4);
}

/// Dips and azimuths of one family of planes, or of more.
const std::vector<std::vector<std::array<double, 2>>> all_dips = {
    {{40, 25}}, {{40, 25}, {90, -50}}, {{40, 25}, {90, -50}, {0, 0}}};

/// By how much what planes change in rock next to isotropic differs from what they change in isotropic rock,
/// with steps of `step` of those of the clusters.
double slip_next_to_isotropic(const FractureSet<3>& set, SlipCorrection correction, double step = 1) {
  auto next = plain;
  next.gamma = 1e-6;
  auto isotropic = cluster(plain, set), other = cluster(next, set);
  for (auto* scene : {&isotropic, &other}) {
    scene->numerics.correction = correction;
    scene->numerics.double_precision = true;
    scene->numerics.cfl *= step;
  }
  EXPECT_TRUE(lie_askew(set, other.model.medium, 0));
  const auto wanted = of_slip(isotropic);
  isotropic.with_slip = false;
  EXPECT_GT(relative_error(difference(traces_of(isotropic), wanted), traces_of(isotropic)), 0.05);
  return relative_error(of_slip(other), wanted);
}

// Proves (S27a), (S34a).
TEST(NextToIsotropic, SlipsAsIsotropicRock) {
  const ThreadLimit one_thread(1);
  using enum SlipCorrection;
  for (const auto& dips : all_dips)
    for (const auto correction : {centred, second, exponential, first}) {
      // In the short form each rule with one family, with two or with three.
      const bool early = correction == second || correction == exponential;
      if (!long_form() && dips.size() != (early ? 1U : correction == centred ? 2U : 3U)) continue;
      // Exactly solved slip of one family takes another path there than that of several.
      const bool same_rule = dips.size() > 1 || correction == first || correction == second;
      // Strengths that stay: friction makes much of little (theory/slip.md).
      const auto planes = families(dips, 0, 5000, 5e3);
      const double found = slip_next_to_isotropic(planes, correction);
      SCOPED_TRACE(std::to_string(dips.size()) + ' ' + name_of(correction));
      if (same_rule)
        EXPECT_LT(found, 1e-5);
      else
        // Two rules of second order differ by the error of the step: of an order above 1.5.
        EXPECT_LT(slip_next_to_isotropic(planes, correction, 0.5), std::pow(0.5, 1.5) * found) << found;
    }
}

// Proves (S34b).
TEST(NextToIsotropic, GivesWayAsIsotropicRock) {
  const ThreadLimit one_thread(1);
  for (const auto& dips : all_dips)
    EXPECT_LT(slip_next_to_isotropic(springs(dips, 0.3, 0.8), SlipCorrection::centred), 1e-5) << dips.size();
}

// Proves (Q12).
TEST(NextToElastic, IsElasticToTheBitWithoutLoss) {
  const ThreadLimit one_thread(1);
  auto scene = blocks<3>(
      {turned_by(shale, 30, 20), {2900, 1500, 2200}, cracked, turned_by(cracked, -40, 60, 15), shale});
  scene.recording.duration_s = 0.03;
  const auto elastic = traces_of(scene);
  // Rows whose rock does not attenuate keep their bits, and so does a Q that is next to infinite.
  attenuate(scene, {PropertyRow::infinite, PropertyRow::infinite});
  EXPECT_FALSE(scene.attenuates());
  EXPECT_EQ(traces_of(scene), elastic);
  attenuate(scene, {1e8, 1e8});
  ASSERT_TRUE(scene.attenuates());
  EXPECT_LT(relative_error(traces_of(scene), elastic), 2e-5);
}

TEST(TiltedMeans, AreIsotropicWhereRockSlipsOrAttenuates) {
  Scene<2> scene;
  scene.model.medium =
      layered_medium(Grid<2>{{50, 40}, 5, {0, 0}},
                     {parse_layer("-10000:1500:0:1000"), parse_layer("40:2000:1150:2000"),
                      parse_layer("60:4000:2300:2300:18"), parse_layer("180:2500:1200:2100:-25")},
                     Average::tilted);
  scene.survey.sources = {{{101, 93}, parse_mechanism<2>("force:0.6,0.8"), parse_wavelet("ricker:30"), 1e6}};
  scene.survey.receivers_m = {{70, 60}, {190, 150}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::szz}, 0.08, 0.002};
  scene.model.fracture_sets = {{"all", {{{0, 1}, 0.3, 1000, 0}}}};
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 0);
  for (std::size_t cell = 0; cell < scene.model.fracture.size(); ++cell)
    scene.model.fracture[cell] = scene.model.medium.is_solid(cell) ? 1 : 0;
  auto isotropic = scene;
  drop_tilted_means(isotropic.model.medium);
  EXPECT_TRUE(traces_of(scene) == traces_of(isotropic));
  scene.with_slip = isotropic.with_slip = false;
  EXPECT_FALSE(traces_of(scene) == traces_of(isotropic));
}

/// How much of what strains at a free surface with that normal, in a plane that dips by its slopes, hold in
/// stresses is traction on it, at most of all three, as a share of the stress that the third strain alone
/// has.
template <int D>
double traction(Scene<D> scene, const Material& rock, const std::vector<double>& normal) {
  using enum Component;
  scene.recording.components =
      D == 2 ? std::vector{exx, ezz, exz} : std::vector{exx, eyy, ezz, eyz, exz, exy};
  scene.edges[D - 1][0] = EdgeLaw::free;
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto points = scene.survey.receivers_m.size();
  const std::vector<int> pairs = D == 2 ? std::vector{1, 3, 5} : std::vector{1, 2, 3, 4, 5, 6};
  const auto stiffness = [&, c = elasticity_of<D>(rock)](int one, int other) { return c(one, other); };
  const auto pair = [](int i, int j) { return i == j ? i + 1 : 6 - i - j + 1; };
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    if (D == 2 && i == 1) continue;
    double sum = 0, size = 0;
    for (std::size_t sample = 0; sample < points * gather.traces[0].samples.size(); ++sample) {
      const auto strain = [&](std::size_t k) {
        return gather.traces[k * points + sample % points].samples[sample / points];
      };
      double here = 0;
      for (int j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < pairs.size() && normal[std::size_t(j)] != 0; ++k)
          here +=
              normal[std::size_t(j)] * stiffness(pair(i, j), pairs[k]) * (pairs[k] <= 3 ? 1 : 2) * strain(k);
      sum += here * here, size += std::pow(stiffness(3, 3) * strain(D - 1), 2);
    }
    most = std::max(most, std::sqrt(sum / size));
  }
  return most;
}

// Proves (V4), (O4), (O9), (F16).
TEST(FreeSurfaceOfAnisotropicRock, HasStrainsThatPutNoTractionOnIt) {
  const ThreadLimit one_thread(1);
  for (const auto& rock : {shale, dipping_shale}) {
    auto stack = below_surface(rock);
    stack.receivers = {{150, 0}, {300, 0}}, stack.cells = 12, stack.duration_s = 0.25, stack.depth_m = 400;
    EXPECT_LT(traction(stack.scene(), rock, {0, 0, 1}), 1e-4) << rock.tilt;
  }
  const auto turned = turned_by(cracked, 30, 40, 20);
  for (const auto& rock : {cracked, turned})
    EXPECT_LT(
        traction(scene_of(uniform_rock(Grid<3>{{26, 26, 18}, 5, {}}, rock), edges_all_3d(EdgeLaw::rigid),
                          {62, 65, 50}, "force:0,0,1", "ricker:20", {{85, 80, 0}}, {}, 0.08, 0.001),
                 rock, {0, 0, 1}),
        1e-4)
        << rock.tilt;
  const auto surface = [](double x, double y) { return 50 + 0.3 * (x - 70) - 0.2 * (y - 70); };
  auto medium = fitted_medium<3>(Grid<3>{{28, 28, 30}, 5, {}},
                                 {below(surface, {turned.vp, turned.vs, turned.rho})}, true);
  put_rocks(medium, turned, turned, 0);
  EXPECT_LT(traction(scene_of(std::move(medium), edges_all_3d(EdgeLaw::rigid), {62, 65, 100}, "force:0,0,1",
                              "ricker:20", {{85, 80, surface(85, 80)}}, {}, 0.08, 0.001),
                     turned, {-0.3, 0.2, 1}),
            1e-4);
}

/// The largest value of a component after a share of so many steps, as a share of the largest before.
template <int D>
double late_share(Scene<D> scene, const char* wavelet, int steps, double after = 0.5) {
  scene.survey.sources[0].wavelet = parse_wavelet(wavelet);
  scene.recording = {
      {D == 2 ? Component::vz : Component::vy, Component::vx}, steps * time_step_s(scene), 0.01};
  check(scene);
  const auto gather = shoot(scene, 1);
  double largest = 0, late = 0;
  for (const auto& trace : gather.traces)
    for (std::size_t n = 0; n < trace.samples.size(); ++n) {
      auto& of = double(n) < after * double(trace.samples.size()) ? largest : late;
      of = std::max(of, std::abs(trace.samples[n]));
    }
  return late / largest;
}
/// A box that absorbs along x and z, or y.
Scene<2> box(const Material& rock, double size_m, double spacing_m) {
  const auto cells = std::int64_t(std::llround(size_m / spacing_m));
  Scene<2> scene;
  scene.model.medium = uniform_rock(Grid<2>{{cells, cells}, spacing_m, {}}, rock);
  scene.survey.sources = {
      {{size_m / 2, size_m / 2}, parse_mechanism<2>("force:0.6,0.8"), parse_wavelet("ricker:1"), 1e6}};
  scene.survey.receivers_m = {{size_m / 2 + 30, size_m / 2 + 30}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  return scene;
}
Scene<3> box_in_slice(const Material& rock, std::int64_t cells, int thin) {
  Index<3> shape = {cells, cells, cells};
  Point<3> from = {12.5 * double(cells), 12.5 * double(cells), 12.5 * double(cells)}, to = from;
  for (auto& part : to) part += 30;
  shape[std::size_t(thin)] = 1, from[std::size_t(thin)] = to[std::size_t(thin)] = 12.5;
  auto edges = edges_all_3d(EdgeLaw::absorbing);
  edges[thin] = {EdgeLaw::mirror, EdgeLaw::mirror};
  return scene_of(uniform_rock(Grid<3>{shape, 25, {}}, rock), edges, from,
                  thin == 2 ? "force:0.6,0.8,0" : "force:0.6,0,0.8", "ricker:1", {to}, {}, 1, 0.01);
}

// Proves (V6), (V7), (O3), (O9).
TEST(AbsorbingLayers, LetWavesOutWhoseFrontsAndEnergyGoOppositeWays) {
  const ThreadLimit one_thread(1);
  // Medium III of Becache, Fauqueux & Joly (2003), whose S waves carry energy back while their fronts move
  // on. A wave as long as the model is what layers feed: without damping (V6) it blows up within this time.
  const auto turning = material_of(vertical_symmetry(4e9, 7.5e9, 20e9, 2e9), 2500);
  if (long_form())
    EXPECT_LT(late_share(box(turning, 750, 5), "ricker:1", 6000), 1e-3);
  else
    EXPECT_LT(late_share(box(turning, 750, 5), "ricker:2", 3000, 0.75), 1e-3);
  // Nothing grows in thousands of steps, of rocks whose beds dip, too.
  for (const auto& rock : {dipping_shale, steep})
    EXPECT_LT(late_share(box(rock, 500, 20 / std::ceil(20 * 6 * peak_hz / slowest_speeds<2>(rock).s)),
                         "ricker:2", 2000),
              1e-3)
        << rock.tilt;
  // The same in the plane of x and y; those of z are isotropic or nearly.
  const auto lying = material_of(orthorhombic({4e9, 20e9, 20e9, 2e9, 2e9, 2e9, 7.5e9, 6e9, 16e9}), 2500);
  for (const int axis : {0, 1})
    EXPECT_GT(backward_group_velocity(upright_elasticity<3>(lying), axis), 0.1) << axis;
  EXPECT_LT(late_share(box_in_slice(lying, 30, 2), "ricker:1", long_form() ? 6000 : 3000), 1e-3);
  // And tilted in a slice of the plane of x and z.
  auto tilted = turned_by(turning, 35);
  tilted.gamma = -0.25;
  for (const int axis : {0, 2})
    EXPECT_GT(backward_group_velocity(elasticity_of<3>(tilted), axis), 0.1) << axis;
  EXPECT_LT(late_share(box_in_slice(tilted, 8, 1), long_form() ? "ricker:1" : "ricker:2",
                       long_form() ? 12000 : 450, 0.75),
            long_form() ? 1e-3 : 0.03);
}

}  // namespace
}  // namespace slipwave::solver::anisotropic_limits_test
