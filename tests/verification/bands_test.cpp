// SPDX-License-Identifier: BSD-3-Clause
// Bands of cells of several sizes (docs/theory/bands.md) against exact traces, and against cells of one size.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "accuracy/full_space.hpp"
#include "long_form.hpp"
#include "memory_archive.hpp"
#include "model/fracture.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "planning/measured_error.hpp"
#include "samples.hpp"
#include "scene/bands.hpp"
#include "shared_out.hpp"
#include "solver/banded_shot.hpp"
#include "solver/simulation.hpp"
#include "stack_scene.hpp"

namespace slipwave::solver::bands_test {
namespace {

constexpr Rock soft{900, 300, 1800}, stiff_soil{1200, 600, 1900}, mud{1600, 400, 1500},
    hard{3500, 2000, 2300}, sea{1500, 0, 1000};

/// Of all traces together, relative.
double difference(const Gather& found, const Gather& wanted) {
  return relative_error(samples_of(found), samples_of(wanted));
}

std::vector<LayerStack::Receiver> line_at(double b, double last_a) {
  std::vector<LayerStack::Receiver> line;
  for (double a = 20; a <= last_a; a += 30) line.push_back({a, b});
  return line;
}

/// 30 m of soft ground on rock, a force in it: ground roll of 20 cells per wavelength.
StackScene soft_ground() {
  StackScene stack{"soft ground", {soft, hard}, {0, 30}, true};
  stack.source_b = 8.1, stack.force = {{0, 1}};
  stack.receivers = line_at(0, 200);
  stack.duration_s = 0.7, stack.spacing_m = 0.6, stack.order = 7, stack.margin_m = 60;
  return stack;
}

/// Mud between water and rock, an explosion in the water.
StackScene muddy_floor() {
  StackScene stack{"mud below water", {sea, mud, hard}, {0, 36, 60}, true};
  stack.source_b = 9.1;
  stack.receivers = line_at(21, 200);
  stack.duration_s = 0.5, stack.spacing_m = 1, stack.order = 7, stack.margin_m = 120;
  return stack;
}

Gather in_bands(Scene<2> scene, std::vector<Band> bands) {
  scene.numerics.bands = std::move(bands);
  return shoot(scene, 1);
}

TEST(Bands, OfSoftGroundOnRockGiveItsExactTraces) {
  auto stack = soft_ground();
  if (!long_form()) stack.duration_s = 0.5;
  EXPECT_LT(difference(in_bands(stack.scene(), {{0, 0.6}, {30, 2.4}}), stack.exact().front()), 0.01);
}

/// All bands in cells of other sizes tell the error of these.
TEST(Bands, HaveAnErrorThatIsMeasured) {
  auto stack = soft_ground();
  stack.duration_s = 0.4;
  auto scene = stack.scene();
  scene.numerics.bands = {{0, 0.75}, {30, 3}};
  SceneRuns<2> runs(scene, {{1}});
  const auto measured = measured_error(runs, setting_of(scene));
  const auto wider = runs.scene_of(other_sizes(runs, measured.setting).front()).numerics.bands;
  EXPECT_GT(wider[0].spacing_m, 0.75);
  EXPECT_NEAR(wider[1].spacing_m, 4 * wider[0].spacing_m, 1e-9);
  EXPECT_EQ(wider[1].from_m, 30);
  const double found = difference(runs.run(measured.setting).recorded.front(), stack.exact().front());
  EXPECT_GT(measured.error.whole, found);
  EXPECT_LT(measured.error.whole, 4 * found);
}

TEST(Bands, OfMudBelowWaterGiveItsExactTraces) {
  const auto stack = muddy_floor();
  EXPECT_LT(difference(in_bands(stack.scene(), {{0, 1}, {60, 4}}), stack.exact().front()), 0.01);
}

/// Absorbing zones of bands have fewer cells where their time step is short. Edges far from the line tell
/// what those near it send back from the error of the cells.
TEST(Bands, SendBackLessAtTheirEdgesThanCellsOfOneSize) {
  const auto sent_back = [](const std::vector<Band>& bands) {
    auto far = muddy_floor(), near = far;
    near.margin_m = 60;
    return difference(in_bands(near.scene(), bands), in_bands(far.scene(), bands));
  };
  const double whole = sent_back({});
  EXPECT_LT(whole, 0.003);
  EXPECT_LT(sent_back({{0, 1}, {60, 4}}), 0.8 * whole);
}

/// What both bands read or move is wrong by its own size; cells of one size are wrong there by up to 9 %.
TEST(Bands, ReadAndMovePointsOnAndBesideAFaceOnce) {
  constexpr double bound = 0.1;
  for (const double at : {30., 29.4, 31.}) {
    if (!long_form() && at == 31) continue;
    auto stack = soft_ground();
    stack.receivers = line_at(at, 200), stack.duration_s = 0.3;
    EXPECT_LT(difference(in_bands(stack.scene(), {{0, 0.6}, {30, 2.4}}), stack.exact().front()), bound) << at;
  }
  for (const double at : {29.4, 31.}) {
    if (!long_form() && at < 30) continue;
    auto stack = soft_ground();
    stack.source_b = at, stack.duration_s = 0.3;
    EXPECT_LT(difference(in_bands(stack.scene(), {{0, 0.6}, {30, 2.4}}), stack.exact().front()), bound) << at;
  }
}

// Proves (B4): with the same time step cells of one size and bands differ by what the larger cells do to
// waves.
TEST(Bands, DifferLittleFromCellsOfOneSizeAtTheSameTimeStep) {
  for (const int time_order : {2, 4}) {
    // In the short form the tests of attenuation and of planes are of second order in time.
    if (!long_form() && time_order == 2) continue;
    auto stack = soft_ground();
    stack.time_order = time_order, stack.duration_s = long_form() ? 0.3 : 0.2, stack.spacing_m = 1;
    auto scene = stack.scene();
    const auto whole = shoot(scene, 1);
    scene.numerics.cfl /= 4;
    EXPECT_LT(difference(in_bands(scene, {{0, 1}, {30, 4}}), whole), 0.004) << "time order " << time_order;
  }
}

/// Attenuation on both sides of a face.
TEST(Bands, AttenuateAsCellsOfOneSizeDo) {
  auto stack = soft_ground();
  stack.qualities = {{30, 15}, {100, 60}}, stack.duration_s = 0.3, stack.spacing_m = 1;
  auto scene = stack.scene();
  const auto whole = shoot(scene, 1);
  scene.numerics.cfl /= 4;
  EXPECT_LT(difference(in_bands(scene, {{0, 1}, {30, 4}}), whole), 0.004);
}

/// Soft ground with compliant planes on both sides of its bottom and across it.
Scene<2> fractured_ground(double margin_m = 60) {
  auto stack = soft_ground();
  stack.margin_m = margin_m;
  stack.duration_s = 0.3, stack.spacing_m = 1;
  auto scene = stack.scene();
  auto& model = scene.model;
  model.fracture = Field<2, std::uint8_t>(model.grid());
  for (std::int64_t n = 0; n < model.grid().size(); ++n) {
    const auto at = model.grid().index(n);
    const double x = model.grid().centre(0, at[0]), z = model.grid().centre(1, at[1]);
    model.fracture[std::size_t(n)] = std::abs(x - 140) < 40 && std::abs(z - 34) < 20;
  }
  SlipSystem<2> planes;
  planes.normal = {0.6, 0.8}, planes.law = FrictionLaw::none;
  planes.compliance.normal_m_per_pa = 1e-10, planes.compliance.tangential_m_per_pa = 2e-10,
  planes.compliance.spacing_m = 1;
  model.fracture_sets = {{"planes", {planes}}};
  return scene;
}

TEST(Bands, GiveWayAsCellsOfOneSizeDo) {
  auto scene = fractured_ground();
  const auto whole = shoot(scene, 1);
  auto intact = scene;
  intact.with_slip = false;
  EXPECT_GT(difference(shoot(intact, 1), whole), 0.05);
  scene.numerics.cfl /= 4;
  EXPECT_LT(difference(in_bands(scene, {{0, 1}, {30, 4}}), whole), 0.01);
}

/// Level and upright fractures on faces, in soil and in the rock below it; one is too short for cells of the
/// rock.
Scene<2> cracked_ground(double margin_m = 60) {
  auto scene = fractured_ground(margin_m);
  const auto fractures = [](double compliance_m_per_pa, std::vector<FractureTrace<2>> traces) {
    SlipSystem<2> planes;
    planes.law = FrictionLaw::none;
    planes.compliance.normal_m_per_pa = compliance_m_per_pa;
    planes.compliance.tangential_m_per_pa = 2 * compliance_m_per_pa;
    return FractureSet<2>{"at " + shown(compliance_m_per_pa), {planes}, std::move(traces), true};
  };
  scene.model.fracture = {};
  scene.model.fracture_sets = {
      fractures(3e-9, {{{80, 14}, {120, 14}}, {{150, 4}, {150, 20}}, {{60, 10}, {64, 10}}}),
      fractures(1e-9, {{{100, 54}, {190, 54}}, {{70, 50}, {70, 74}}})};
  return scene;
}

TEST(Bands, HaveFracturesOnFaces) {
  auto scene = cracked_ground();
  const auto whole = shoot(scene, 1);
  for (const std::size_t set : {0, 1}) {
    auto without = scene;
    without.model.fracture_sets.erase(without.model.fracture_sets.begin() + std::ptrdiff_t(set));
    EXPECT_GT(difference(shoot(without, 1), whole), 0.02);
  }
  scene.numerics.cfl /= 2;
  EXPECT_LT(difference(in_bands(scene, {{0, 1}, {30, 2}}), whole), 0.002);
}

// Proves (B5): waves that arrive at a face in one rock at up to 70 degrees, 12 cells in the shortest
// wavelength of S.
TEST(Bands, ReflectNextToNothingInOneRock) {
  StackScene stack{"one rock", {{3000, 1700, 2200}}};
  stack.peak_hz = 20, stack.spacing_m = 2, stack.order = 7, stack.duration_s = 0.6, stack.margin_m = 200;
  for (double a = 60; a <= 600; a += 60) stack.receivers.push_back({a, -40});
  for (const auto& force : {std::optional<Point<2>>(), std::optional<Point<2>>({0.6, 0.8})}) {
    if (!long_form() && !force) continue;
    stack.force = force;
    const auto scene = stack.scene();
    const double face_m = 4 * std::round((stack.place({0, 0})[1] + 88) / 4);
    const auto whole = shoot(scene, 1);
    EXPECT_LT(difference(in_bands(scene, {{0, 2}, {face_m, 4}}), whole), 1e-3);
  }
}

/// A box of rigid walls in 3-D, a force in its soft half.
Scene<3> box_in_space(std::int64_t rows = 60) {
  Scene<3> scene;
  const Grid<3> grid{{30, 30, rows}, 3, {0, 0, 0}};
  auto& medium = scene.model.medium = Medium<3>(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto& rock = grid.index(n)[2] < 24 ? mud : hard;
    medium.vp[std::size_t(n)] = float(rock.vp), medium.vs[std::size_t(n)] = float(rock.vs);
    medium.rho[std::size_t(n)] = float(rock.rho);
  }
  for (int axis = 0; axis < 3; ++axis) scene.edges[axis] = {EdgeLaw::rigid, EdgeLaw::rigid};
  scene.survey.sources = {{{45, 48, 33}, PointForce<3>{{1, 0.5, 0.7}}, parse_wavelet("ricker:15"), 1e6}};
  scene.survey.receivers_m = {{30, 30, 27}, {60, 39, 45}, {63, 66, 69}, {21, 72, 84}, {63, 48, 130}};
  scene.recording = {{Component::vx, Component::vy, Component::vz}, 0.2, 0.001};
  scene.numerics.order = 7, scene.numerics.cfl = 0.8, scene.numerics.zone_cells = 8;
  return scene;
}

TEST(Bands, InSpaceAreAsCellsOfOneSize) {
  const auto scene = box_in_space();
  const auto whole = shoot(scene, 1);
  for (const int ratio : {2, 3}) {
    if (!long_form() && ratio == 2) continue;
    auto banded = scene;
    banded.numerics.cfl /= ratio;
    banded.numerics.bands = {{0, 3}, {72, 3. * ratio}};
    EXPECT_LT(difference(shoot(banded, 1), whole), 0.01) << ratio;
  }
}

/// One picture of all bands, on the cells of the model.
TEST(Bands, GiveSnapshotsOnTheCellsOfTheModel) {
  auto stack = soft_ground();
  stack.spacing_m = 1, stack.duration_s = 0.25;
  auto scene = stack.scene();
  scene.snapshot_every_s = 0.25;
  const auto last_of = [](const Scene<2>& of) {
    Field<2> last;
    shoot<2>(of, 1, {}, [&](double, const FieldReader<2>& field) { last = field(Component::vz); });
    return last;
  };
  const auto whole = last_of(scene);
  scene.numerics.cfl /= 4;
  scene.numerics.bands = {{0, 1}, {30, 4}};
  const auto banded = last_of(scene);
  ASSERT_EQ(banded.grid(), scene.model.grid());
  double squares = 0, all = 0;
  for (std::size_t n = 0; n < whole.size(); ++n)
    squares += std::pow(banded[n] - whole[n], 2), all += std::pow(whole[n], 2);
  // Values of cells of 4 m stand for those of 1 m.
  EXPECT_LT(std::sqrt(squares / all), 0.05);
}

/// A plane wave in soil over rock, in cells of one size.
template <int D>
Scene<D> shaken_ground(const std::string& kind, const Index<D>& shape, double cell_m) {
  Scene<D> scene;
  auto& medium = scene.model.medium = Medium<D>(Grid<D>{shape, cell_m, {}});
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto& rock = medium.grid().depth(medium.grid().index(n)) < 30 ? stiff_soil : hard;
    const auto cell = std::size_t(n);
    medium.vp[cell] = float(rock.vp), medium.vs[cell] = float(rock.vs), medium.rho[cell] = float(rock.rho);
  }
  scene.model.fracture = Field<D, std::uint8_t>(medium.grid());
  Point<D> source;
  for (int axis = 0; axis < D; ++axis)
    source[std::size_t(axis)] = double(shape[std::size_t(axis)]) * cell_m * (axis == D - 1 ? 1 : 0.5);
  scene.survey.sources = {{source, parse_mechanism<D>(kind), parse_wavelet("ricker:10"), 0.002}};
  for (const double depth : {0., 12.5, 50.}) {
    auto at = source;
    at[D - 1] = depth;
    scene.survey.receivers_m.push_back(at);
  }
  for (int axis = 0; axis < D; ++axis) scene.edges[axis] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.edges[D - 1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz}, 0.6, 0.001};
  scene.numerics.order = 7;
  return scene;
}

// Proves (A16).
TEST(Bands, LetAPlaneSWaveShakeSoilAsInTheClosedForm) {
  auto scene = shaken_ground<2>("plane-s:180", {48, 96}, 1);
  scene.numerics.bands = {{0, 1}, {30, 3}};
  check(scene);
  const auto gather = shoot(scene, 1);
  // v = 2 cos(k z)/(cos(k H) + i alpha sin(k H)) of the wave that comes to the depth H, alpha the ratio of
  // impedances: what the free surface and the interface of a layer make of a vertical wave. One that travels
  // up moves towards -x first.
  const double alpha = stiff_soil.rho * stiff_soil.vs / (hard.rho * hard.vs), height = 30;
  for (std::size_t n = 0; n < scene.survey.receivers_m.size(); ++n) {
    const double z = scene.survey.receivers_m[n][1];
    if (z > height) continue;
    const auto exact = ricker_response(10, 0.001, gather.axis.count, [&](double omega) {
      const double phase = omega * height / stiff_soil.vs;
      const std::complex<double> below = std::polar(1., -omega * (96 - height) / hard.vs);
      return Motion{-0.002 * below * 2. * std::cos(omega * z / stiff_soil.vs) /
                    (std::cos(phase) + std::complex<double>(0, alpha * std::sin(phase)))};
    });
    EXPECT_LT(relative_error(gather.traces[n].samples, exact[0]), 0.004) << "at " << z << " m";
  }
}

TEST(Bands, LetAnObliquePlaneWaveThroughInSpaceAsCellsOfOneSizeDo) {
  auto scene = shaken_ground<3>("plane:165,30", {4, 4, 44}, 3);
  scene.numerics.zone_cells = 6;
  scene.recording.duration_s = 0.1;
  check(scene);
  auto banded = scene;
  banded.numerics.bands = {{0, 3}, {72, 6}};
  check(banded);
  EXPECT_LT(difference(shoot(banded, 1), shoot(scene, 1)), 0.01);
}

/// A banded shot, made plainly or in tiles, and in two pieces where the second is made `otherwise`.
template <int D>
Gather in_pieces(Scene<D> scene, bool plain, bool otherwise) {
  scene.numerics.tiling.plain = plain;
  BandedShot<D, float> first(scene, 1);
  first.run_to(first.steps() / 2);
  std::vector<char> kept;
  ToMemory to(kept);
  first.serialize(to);
  scene.numerics.tiling.plain = plain != otherwise;
  BandedShot<D, float> second(scene, 1);
  FromMemory from(kept);
  second.serialize(from);
  EXPECT_TRUE(from.all_used());
  second.run_to(second.steps());
  return second.take_gather();
}

template <int D>
void expect_same_bits(const char* what, Scene<D> scene, std::vector<Band> bands, double duration_s) {
  SCOPED_TRACE(what);
  scene.recording.duration_s = duration_s;
  scene.numerics.bands = std::move(bands);
  scene.numerics.tiling.plain = true;
  const auto plain = shoot(scene, 1);
  scene.numerics.tiling.plain = false;
  for (const int stripe : {0, D == 2 ? 64 : 5}) {
    scene.numerics.tiling.stripe_cells = stripe;
    EXPECT_EQ(difference(shoot(scene, 1), plain), 0) << "stripes of " << stripe;
  }
  EXPECT_EQ(difference(in_pieces(scene, false, false), plain), 0) << "in pieces";
  EXPECT_EQ(difference(in_pieces(scene, false, true), plain), 0) << "plainly in the second";
}

TEST(Bands, GiveTheSameBitsPlainlyAndInTiles) {
  const std::vector<Band> bands = {{0, 0.6}, {30, 2.4}};
  auto scene = soft_ground().scene();
  expect_same_bits("soft ground", scene, bands, 0.04);
  scene.numerics.order = 5, scene.numerics.time_order = 4;
  expect_same_bits("fourth order in time", scene, bands, 0.03);
  scene = soft_ground().scene();
  scene.edges[0] = {EdgeLaw::free, EdgeLaw::absorbing};
  expect_same_bits("a free side", scene, bands, 0.04);
  auto stack = muddy_floor();
  stack.qualities = {{HUGE_VAL, HUGE_VAL}, {30, 15}, {100, 60}};
  expect_same_bits("mud that attenuates", stack.scene(), {{0, 1}, {60, 4}}, 0.04);
  expect_same_bits("compliant planes", fractured_ground(), {{0, 1}, {30, 4}}, 0.04);
  expect_same_bits("fractures on faces", cracked_ground(), {{0, 1}, {30, 2}}, 0.04);
  stack = soft_ground();
  stack.rocks = {hard, soft}, stack.spacing_m = 1;
  expect_same_bits("hard on soft", stack.scene(), {{0, 2}, {30, 1}}, 0.03);
  stack = soft_ground();
  stack.source_b = 31;
  expect_same_bits("a source below the face", stack.scene(), bands, 0.05);
  expect_same_bits("a plane wave", shaken_ground<2>("plane-s:160", {48, 96}, 1), {{0, 1}, {30, 3}}, 0.05);
}

TEST(Bands, GiveTheSameBitsPlainlyAndInTilesInSpace) {
  auto scene = box_in_space();
  expect_same_bits("rigid", scene, {{0, 3}, {72, 9}}, 0.015);
  for (int axis = 0; axis < 3; ++axis) scene.edges[axis] = {EdgeLaw::free, EdgeLaw::absorbing};
  expect_same_bits("free and absorbing", scene, {{0, 3}, {72, 6}}, 0.01);
  scene = box_in_space();
  scene.edges[1] = {EdgeLaw::free, EdgeLaw::free};
  scene.numerics.tiling.steps = 1;
  expect_same_bits("free along y, steps one by one", scene, {{0, 3}, {72, 6}}, 0.02);
}

TEST(Bands, GiveTheSameBitsWhateverTheThreads) {
  const auto expect_on_threads = [](Scene<2> scene, std::vector<Band> bands) {
    scene.numerics.bands = std::move(bands);
    const auto by = [&](int threads) {
      const ThreadLimit limit(threads);
      return shoot(scene, 1);
    };
    EXPECT_EQ(difference(by(3), by(1)), 0);
  };
  auto stack = soft_ground();
  stack.duration_s = 0.05;
  expect_on_threads(stack.scene(), {{0, 0.6}, {30, 2.4}});
  stack.rocks = {hard, soft}, stack.spacing_m = 1;
  expect_on_threads(stack.scene(), {{0, 2}, {30, 1}});
}

/// The bands in which the rows of the processes end, but those of the last.
template <int D>
std::vector<std::size_t> bands_cut(const Scene<D>& scene, int count) {
  const auto bands = scenes_of_bands(scene);
  std::vector<std::size_t> cut;
  for (int number = 0; number + 1 < count; ++number) {
    const auto parts = subdomains_for(scene, bands, number, count);
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (!parts[n].is_empty() && parts[n].continues(1)) cut.push_back(n);
  }
  return cut;
}

/// Receivers down through all bands: near faces between bands and near the ends of the rows of processes.
template <int D>
void add_borehole(Scene<D>& scene, double every_m) {
  auto at = scene.survey.sources.front().position_m;
  at[0] += 7.3;
  const auto& grid = scene.model.grid();
  for (double z = 0.4; z < double(grid.shape[D - 1]) * grid.spacing_m; z += every_m) {
    at[D - 1] = z;
    scene.survey.receivers_m.push_back(at);
  }
}

/// So many processes, and the bands in which their rows end.
using CutBands = std::vector<std::pair<int, std::vector<std::size_t>>>;

/// Expects processes to have the outcome of one: in tiles and plainly, with receivers everywhere and with
/// those of the scene, which let processes exchange fewer rows.
template <int D>
void expect_same_on_ranks(const char* what, Scene<D> scene, std::vector<Band> bands, double duration_s,
                          const CutBands& all) {
  SCOPED_TRACE(what);
  scene.recording.duration_s = duration_s;
  scene.snapshot_every_s = duration_s / 2;
  scene.slip_diary = true;
  scene.numerics.bands = std::move(bands);
  for (const bool borehole : {false, true}) {
    if (borehole) add_borehole(scene, 1.7);
    const auto alone = outcome_of(scene);
    ASSERT_GT(*std::max_element(alone.snapshots.begin(), alone.snapshots.end()), 0);
    const auto& heard = borehole ? alone.samples : std::vector<double>{1};
    ASSERT_GT(*std::max_element(heard.begin(), heard.end()), 0);
    for (const auto& [count, cut] : all) {
      EXPECT_EQ(bands_cut(scene, count), cut) << count << " ranks";
      for (const bool plain : {false, true}) {
        if (plain && !borehole && !long_form()) continue;
        scene.numerics.tiling.plain = plain;
        SCOPED_TRACE(std::string(plain ? "plainly" : "in tiles") + (borehole ? ", a borehole" : ""));
        expect_same_on_ranks(scene, alone, count, count == 2 ? 3 : 1);
      }
      scene.numerics.tiling.plain = false;
    }
  }
}

/// Soft ground of few columns whose rock has rows for several processes.
StackScene deep_ground() {
  auto stack = soft_ground();
  stack.receivers = line_at(0, 50), stack.margin_m = 90;
  return stack;
}

TEST(BandsOnRanks, GiveTheBitsOfOneProcess) {
  const std::vector<Band> bands = {{0, 0.6}, {30, 2.4}};
  const auto stack = deep_ground();
  if (long_form()) expect_same_on_ranks("soft ground", stack.scene(), bands, 0.04, {{2, {0}}, {3, {0, 0}}});
  expect_same_on_ranks("five on soft ground", stack.scene(), bands, 0.03, {{5, {0, 0, 0, 1}}});
  auto scene = stack.scene();
  scene.numerics.order = 5, scene.numerics.time_order = 4;
  expect_same_on_ranks("fourth order in time", scene, bands, 0.02, {{2, {0}}});
  scene = stack.scene();
  scene.edges[0] = {EdgeLaw::free, EdgeLaw::absorbing};
  expect_same_on_ranks("a free side", scene, bands, 0.03, {{3, {0, 1}}});
}

/// Sources on a face between bands and beside it, and where the rows of one process end.
TEST(BandsOnRanks, MoveRockAsOneProcessDoes) {
  const std::vector<Band> bands = {{0, 0.6}, {30, 2.4}};
  auto stack = deep_ground();
  auto scene = stack.scene();
  scene.numerics.bands = bands;
  const double end_m = 0.6 * double(subdomains_for(scene, scenes_of_bands(scene), 0, 2).front().last);
  for (const double depth_m : {30., 29.4, 31., end_m, end_m - 0.3}) {
    stack.source_b = depth_m;
    expect_same_on_ranks(("from " + std::to_string(depth_m) + " m").c_str(), stack.scene(), bands, 0.015,
                         {{2, {0}}});
  }
}

TEST(BandsOnRanks, EndTheirRowsInTheLowerBandToo) {
  auto stack = deep_ground();
  stack.rocks = {hard, soft}, stack.spacing_m = 1;
  expect_same_on_ranks("hard on soft", stack.scene(), {{0, 2}, {30, 1}}, 0.03, {{2, {1}}, {3, {1, 1}}});
}

TEST(BandsOnRanks, ShareThreeBands) {
  auto stack = deep_ground();
  stack.rocks = {soft, stiff_soil, hard}, stack.faces_m = {0, 15, 75};
  stack.spacing_m = 0.75, stack.margin_m = 120, stack.order = 5;
  const std::vector<Band> bands = {{0, 0.75}, {15, 1.5}, {75, 3}};
  expect_same_on_ranks("three", stack.scene(), bands, 0.05, {{2, {1}}, {3, {1, 1}}, {5, {1, 1, 2, 2}}});
}

TEST(BandsOnRanks, AttenuateAndGiveWayAsInOneProcess) {
  auto stack = deep_ground();
  stack.qualities = {{30, 15}, {100, 60}};
  expect_same_on_ranks("attenuating", stack.scene(), {{0, 0.6}, {30, 2.4}}, 0.03, {{3, {0, 0}}});
  expect_same_on_ranks("compliant planes", fractured_ground(), {{0, 1}, {30, 2}}, 0.04, {{2, {0}}});
  expect_same_on_ranks("fractures on faces", cracked_ground(100), {{0, 1}, {30, 2}}, 0.04, {{2, {1}}});
}

TEST(BandsOnRanks, GiveTheBitsOfOneProcessInSpace) {
  auto scene = box_in_space(120);
  scene.survey.receivers_m.resize(1);
  scene.survey.receivers_m[0][2] = 1;
  auto& source_z_m = scene.survey.sources[0].position_m[2];  // near where rows of one process end
  if (long_form()) expect_same_on_ranks("rigid", scene, {{0, 3}, {72, 6}}, 0.005, {{2, {0}}});
  source_z_m = 140;
  if (long_form()) expect_same_on_ranks("rigid below", scene, {{0, 3}, {72, 6}}, 0.005, {{5, {0, 1, 1, 1}}});
  source_z_m = 195;
  for (int axis = 0; axis < 3; ++axis) scene.edges[axis] = {EdgeLaw::free, EdgeLaw::absorbing};
  expect_same_on_ranks("free and absorbing", scene, {{0, 3}, {72, 6}}, 0.005, {{2, {1}}});
}

TEST(BandsOnRanks, AllSayWhereAShotBecameUnstable) {
  auto scene = deep_ground().scene();
  scene.numerics.bands = {{0, 0.6}, {30, 2.4}};
  scene.numerics.cfl = 2.5;
  std::vector<std::string> said(3);
  RanksInThreads::run(3, [&](Ranks& ranks) {
    try {
      shoot(scene, 1, {}, {}, nullptr, nullptr, &ranks);
    } catch (const Unstable& error) {
      said[std::size_t(ranks.number())] = error.what();
    }
  });
  EXPECT_NE(said[0].find("became unstable at x="), std::string::npos) << said[0];
  EXPECT_EQ(said, std::vector<std::string>(3, said[0]));
}

TEST(BandsOnRanks, AreRefusedWhereRowsAreTooFew) {
  auto scene = soft_ground().scene();
  scene.numerics.bands = {{0, 0.6}, {30, 2.4}};
  const auto bands = scenes_of_bands(scene);
  EXPECT_EQ(most_processes(scene, bands), 5);
  try {
    subdomains_for(scene, bands, 0, 9);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "found 9 processes a shot for bands of 50 and 25 rows, expected at most 5: each takes 12 or "
                 "more of a band that it shares");
  }
  scene.survey.sources[0].mechanism = PlaneWave<2>{};
  EXPECT_EQ(most_processes(scene, bands), 1);
  EXPECT_THROW(subdomains_for(scene, bands, 0, 2), Error);
}

}  // namespace
}  // namespace slipwave::solver::bands_test
