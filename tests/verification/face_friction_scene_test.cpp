// SPDX-License-Identifier: BSD-3-Clause
// Planes with friction on faces between cells in whole scenes: who computes them makes no difference
// (docs/theory/fractures.md, (S40) to (S43)).
#include <gtest/gtest.h>

#include <limits>

#include "build/resample.hpp"
#include "long_form.hpp"
#include "model/fracture.hpp"
#include "scene_of_faces.hpp"
#include "slip_layer.hpp"

namespace slipwave::solver::face_friction_scene_test {
namespace {

// Proves (S43).
TEST(FaceFriction, IsTheSameInSingleAndDoublePrecision) { expect_same_in_double_precision(faulted()); }

TEST(FaceFriction, KeepsItsPrestressInCellsOfAnotherSize) {
  Model<2> model;
  model.medium = uniform_medium(60, 60, 5, {4500, 2250, 2500});
  add_faces(model, {}, {{{51, 101}, {249, 101}}}, "-2000,-3000,500");
  add_faces(model, {0.5, 0, 0, true}, {{{150, 120}, {150, 280}}}, "-7000,-5000,100");
  for (const double h : {2.5, 4., 10., 12.}) {
    const auto resized = resampled(model, h, true);
    check(resized);
    int level = 0, upright = 0;
    for (const auto& face : split_faces(resized)) {
      const auto& stress = face.law.prestress_pa;
      if (face.axis == 1) ++level;
      if (face.axis == 0) ++upright;
      EXPECT_EQ(stress, face.axis == 1 ? (std::array{-3000., 500.}) : (std::array{-7000., 100.})) << h;
    }
    EXPECT_GE(level, int(198 / h)) << h;
    EXPECT_GE(upright, int(160 / h)) << h;
  }
}

/// An explosion above a level plane whose tips lie between faces, in so large cells.
Scene<2> over_a_plane(double h) {
  Scene<2> scene;
  const auto cells = std::int64_t(600 / h);
  scene.model.medium = uniform_medium(cells, cells, h, {4500, 2250, 2500});
  scene.survey.sources = {{{203, 161}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e9}};
  for (double x = 100; x <= 500; x += 50)
    for (const double z : {200., 400.}) scene.survey.receivers_m.push_back({x, z});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.25, 0.001};
  return scene;
}
const FractureTrace<2> level{{201, 300}, {399, 300}};

double change_between(const Scene<2>& one, const Scene<2>& other) {
  return largest_difference(samples_of(shoot(one, 1)), samples_of(shoot(other, 1)));
}

TEST(FaceFriction, OfEachKindChangesTheTraces) {
  const auto scene = faulted();
  for (std::size_t set = 1; set < scene.model.fracture_sets.size(); ++set) {
    auto without = scene;
    auto& system = without.model.fracture_sets[set].systems[0];
    system.law = FrictionLaw::none, system.opens = false;
    EXPECT_GT(change_between(scene, without), 1e-3) << set;
  }
}

// Proves (S42).
TEST(FaceFriction, WithoutAnyIsACrackThatIsFreeAlongItself) {
  auto free = over_a_plane(5), slippery = free;
  SlipSystem<2> system{{0, 1}, 0, 0, 0, false, FrictionLaw::none};
  system.compliance.tangential_m_per_pa = std::numeric_limits<double>::infinity();
  add_single_fractures(free.model, {"free", {system}, {level}, true});
  add_faces(slippery.model, {0}, {level}, "none");
  EXPECT_LT(change_between(slippery, free), 1e-5);
  EXPECT_GT(change_between(slippery, over_a_plane(5)), 0.1);
}

// Proves (S42).
TEST(FaceFriction, OfStrengthThatNoWaveReachesIsTheSpringAlone) {
  auto spring = over_a_plane(5), strong = spring;
  SlipSystem<2> system{{0, 1}, 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {1e-9, 2e-9, 0, 0, 0};
  add_single_fractures(spring.model, {"spring", {system}, {level}, true});
  add_faces(strong.model, {0, 1e12, 0, false, 1e-9, 2e-9}, {level}, "none");
  EXPECT_LT(change_between(strong, spring), 1e-5);
}

// Proves (S43).
TEST(FaceFriction, OfStrengthThatNoWaveReachesIsRockThatIsWhole) {
  // Up to what sweeps of order 5 beside it leave, as beside a spring that is stiff as rock.
  auto strong = over_a_plane(5);
  add_faces(strong.model, {0, 1e12}, {level}, "none");
  EXPECT_LT(change_between(strong, over_a_plane(5)), 1e-3);
}

/// A plane of that strength, whose viscosity drags as so many times Z at it, that may fall with slip.
struct Fault {
  double strength_pa, drag;
  std::string law = "coulomb";
};

/// What it sends out, on faces or as a row of cells whose middles lie where it does.
std::vector<double> sent_out(const Fault& of, double h, bool row) {
  auto scene = over_a_plane(h);
  const double z = 2500 * 2250 / 2;
  // Under so much pressure that waves change the strength little.
  constexpr double friction = 1e-3;
  const std::string prestress = shown(of.strength_pa / friction);
  if (row) {
    auto grid = scene.model.grid();
    grid.origin_m[1] = -h / 2;
    ++grid.shape[1];
    scene.model.medium = {Field<2>(grid, 4500), Field<2>(grid, 2250), Field<2>(grid, 2500)};
    scene.model.fracture = Field<2, std::uint8_t>(grid);
    for (auto i = std::int64_t(200 / h); i < std::int64_t(400 / h); ++i)
      scene.model.fracture({i, std::int64_t(300 / h)}) = 1;
    // A row has some more viscosity of its own, (S9).
    constexpr double k = 0.19;
    scene.model.fracture_sets = {{"row", {{{0, 1}, friction, (of.drag - k) * z * h / of.strength_pa}}}};
    set_friction_law(scene.model.fracture_sets[0].systems[0], of.law);
    set_prestress(scene.model, 1, parse_prestress<2>(prestress));
  } else {
    // Of planes as far apart as add_faces() has them.
    add_faces(scene.model, {friction, 0, of.drag * z * 5 / of.strength_pa, false, 0, 0, of.law},
              {{{200, 300}, {400, 300}}}, prestress);
  }
  auto whole = scene;
  whole.with_slip = false;
  auto sent = samples_of(shoot(scene, 1));
  const auto wave = samples_of(shoot(whole, 1));
  for (std::size_t n = 0; n < sent.size(); ++n) sent[n] -= wave[n];
  return sent;
}

/// Expects a row of cells to come near it on faces as they get small.
void expect_row_near(const Fault& of) {
  const auto off = [&of](double h) { return relative_error(sent_out(of, h, true), sent_out(of, h, false)); };
  const double fine = off(2.5);
  EXPECT_LT(fine, 0.05);
  EXPECT_GT(off(5), 1.5 * fine);
}

/// The largest shear traction of the waves where that plane lies.
double largest_traction() {
  auto probe = over_a_plane(5);
  probe.survey.receivers_m = {{250, 300}, {300, 300}, {350, 300}};
  probe.recording.components = {Component::sxz};
  double most = 0;
  for (const double sample : samples_of(shoot(probe, 1))) most = std::max(most, std::abs(sample));
  return most;
}

/// Slip of a traction of the waves within a tenth of a period of 30 Hz.
double slip_of(double traction_pa) { return traction_pa / (2500 * 2250 / 2) / 30 / 10; }

// Proves (S17).
TEST(FaceFriction, ThatWeakensLiesBetweenStaticAndDynamicFriction) {
  const double most = largest_traction();
  const auto with = [&](const Plane& plane) {
    auto scene = over_a_plane(5);
    add_faces(scene.model, plane, {level}, shown(most));
    return scene;
  };
  const auto falling = [](const std::string& dynamic, const std::string& distance_m) {
    return Plane{0.6, 0, 0, false, 0, 0, "slip-weakening:" + dynamic + ':' + distance_m};
  };
  const auto coulomb = with({0.6}), dynamic = with({0.1});
  EXPECT_EQ(change_between(with(falling("0.6", "1e-6")), coulomb), 0);
  EXPECT_EQ(change_between(with(falling("0.1", "1e300")), coulomb), 0);
  const double all = change_between(coulomb, dynamic);
  EXPECT_GT(all, 0.01);
  double before = all;
  for (const double share : {1., 0.1, 1e-3}) {
    const double off = change_between(with(falling("0.1", shown(share * slip_of(most)))), dynamic);
    EXPECT_LT(off, before) << share;
    before = off;
  }
  EXPECT_LT(before, 0.2 * all);
}

// Proves (S41).
TEST(FaceFriction, IsWhatARowOfCellsComesNearAsTheyGetSmall) {
  const double most = largest_traction();
  for (const auto& [share, drag] : {std::pair{0.1, 1.}, {0.25, 3.}}) {
    // The short form has the other drag with strength that falls.
    if (drag > 1 && !long_form()) continue;
    SCOPED_TRACE(share);
    expect_row_near({share * most, drag});
  }
}

// Proves (S44).
TEST(FaceFriction, ThatWeakensIsWhatARowOfCellsComesNearToo) {
  const double most = largest_traction(), strength = 0.25 * most;
  const Fault weak{strength, 3, "slip-weakening:5e-4:" + shown(slip_of(most))};
  EXPECT_GT(relative_error(sent_out(weak, 5, false), sent_out({strength, 3}, 5, false)), 0.1);
  expect_row_near(weak);
}

}  // namespace
}  // namespace slipwave::solver::face_friction_scene_test
