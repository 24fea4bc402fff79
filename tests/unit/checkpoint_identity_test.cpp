// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "checkpoint/identity.hpp"

namespace slipwave::checkpoint_identity_test {
namespace {

Scene<2> scene() {
  Scene<2> scene;
  const Grid<2> grid{{12, 10}, 5, {0, 0}};
  scene.model.medium = {Field<2>(grid, 3000), Field<2>(grid, 1500), Field<2>(grid, 2000)};
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  scene.model.fracture[7] = 1;
  scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 1000, 0}}}};
  scene.survey.sources = {{{25, 20}, parse_mechanism<2>("moment:1,2,3"), parse_wavelet("ricker:40"), 1}};
  scene.survey.receivers_m = {{10, 5}, {20, 5}};
  scene.recording = {{Component::vx, Component::p}, 0.2, 0.001};
  scene.snapshot_every_s = 0.1;
  return scene;
}

shape::Sampled samples(double one) { return {{0, 1, 2}, {0, one, 0}, 0}; }

}  // namespace

TEST(Identity, IsThatOfTheSameScene) {
  EXPECT_EQ(difference_of(identity_of(scene()), identity_of(scene())), std::nullopt);
  // How passes are cut changes no result.
  auto other = scene();
  other.numerics.tiling = {1, 64, true};
  EXPECT_EQ(difference_of(identity_of(scene()), identity_of(other)), std::nullopt);
}

TEST(Identity, TellsEverythingThatMattersByName) {
  struct Change {
    const char* said;
    std::function<void(Scene<2>&)> make;
  };
  const std::vector<Change> changes = {
      {"another model", [](auto& s) { s.model.medium.vp[119] -= 1; }},
      {"another model", [](auto& s) { s.model.medium.vs[3] += 1; }},
      {"another model", [](auto& s) { s.model.medium.rho[0] += 1; }},
      {"another model", [](auto& s) { s.model.fracture[8] = 1; }},
      {"another model", [](auto& s) { s.model.fracture_sets[0].name = "faults"; }},
      {"another model",
       [](auto& s) {
         s.model.fracture_sets[0].systems[0].normal = {1, 0};
       }},
      {"another model", [](auto& s) { s.model.fracture_sets[0].systems[0].friction = 0.4; }},
      {"another model", [](auto& s) { s.model.fracture_sets[0].systems[0].viscosity_s = 1; }},
      {"another model", [](auto& s) { s.model.fracture_sets[0].systems[0].strength_pa = 1; }},
      {"another model", [](auto& s) { s.model.fracture_sets[0].systems[0].opens = true; }},
      {"another model", [](auto& s) { s.model.fracture_share = Field<2>(s.model.grid(), 0.5); }},
      {"another model", [](auto& s) { s.model.prestress_pa.resize(1); }},
      {"another model", [](auto& s) { s.model.history = "sw-layers"; }},
      {"another source or wavelet", [](auto& s) { s.survey.sources[0].position_m[0] += 1; }},
      {"another source or wavelet", [](auto& s) { s.survey.sources[0].amplitude = 2; }},
      {"another source or wavelet",
       [](auto& s) { s.survey.sources[0].mechanism = parse_mechanism<2>("moment:1,2,4"); }},
      {"another source or wavelet",
       [](auto& s) { s.survey.sources[0].mechanism = parse_mechanism<2>("force:1,2"); }},
      {"another source or wavelet",
       [](auto& s) { s.survey.sources[0].mechanism = parse_mechanism<2>("plane:10"); }},
      {"another source or wavelet",
       [](auto& s) { s.survey.sources[0].wavelet = parse_wavelet("ricker:41"); }},
      {"another set of receivers", [](auto& s) { s.survey.receivers_m[1][1] += 1; }},
      {"number of receivers 2, expected 1", [](auto& s) { s.survey.receivers_m.pop_back(); }},
      {"number of sources 1, expected 2",
       [](auto& s) { s.survey.sources.push_back(s.survey.sources.front()); }},
      {"order 5, expected 7", [](auto& s) { s.numerics.order = 7; }},
      {"time step 0.0015 s, expected 0.001 s", [](auto& s) { s.numerics.time_step_s = 0.001; }},
      {"precision float, expected double", [](auto& s) { s.numerics.double_precision = true; }},
      {"time order 2, expected 4", [](auto& s) { s.numerics.time_order = 4; }},
      {"slip correction centred, expected first order",
       [](auto& s) { s.numerics.correction = SlipCorrection::first; }},
      {"edge width 0, expected 30", [](auto& s) { s.numerics.zone_cells = 30; }},
      {"slip on, expected off", [](auto& s) { s.with_slip = false; }},
      {"diary of slip not kept, expected kept", [](auto& s) { s.slip_diary = true; }},
      {"length of the traces 0.2 s, expected 0.3 s", [](auto& s) { s.recording.duration_s = 0.3; }},
      {"sampling interval 0.001 s, expected 0.002 s", [](auto& s) { s.recording.interval_s = 0.002; }},
      {"components vx,p, expected p,vx",
       [](auto& s) { std::swap(s.recording.components[0], s.recording.components[1]); }},
      {"time between snapshots 0.1 s, expected none", [](auto& s) { s.snapshot_every_s.reset(); }},
      {"low edge of z free, expected rigid", [](auto& s) { s.edges[1][0] = EdgeLaw::rigid; }},
      {"high edge of x free, expected mirror", [](auto& s) { s.edges[0][1] = EdgeLaw::mirror; }},
  };
  for (const auto& [said, make] : changes) {
    auto other = scene();
    make(other);
    EXPECT_EQ(difference_of(identity_of(scene()), identity_of(other)).value_or("nothing"), said);
  }
}

TEST(Identity, KnowsTheFrictionLaw) {
  const auto with = [](FrictionLaw law, double dynamic_friction, double distance_m) {
    auto one = scene();
    one.model.fracture_sets = {{"set", {{{0, 1}, 0.6, 0, 0, false, law, dynamic_friction, distance_m}}}};
    return identity_of(one);
  };
  const auto weak = with(FrictionLaw::slip_weakening, 0.2, 1e-3);
  EXPECT_EQ(difference_of(weak, weak), std::nullopt);
  for (const auto& other : {with(FrictionLaw::coulomb, 0, 0), with(FrictionLaw::slip_weakening, 0.3, 1e-3),
                            with(FrictionLaw::slip_weakening, 0.2, 2e-3)})
    EXPECT_EQ(difference_of(weak, other), "another model");
}

TEST(Identity, LooksIntoTheFileOfAWavelet) {
  auto one = scene(), other = scene();
  one.survey.sources[0].wavelet = Wavelet(samples(1), "file:w.txt");
  other.survey.sources[0].wavelet = Wavelet(samples(1), "file:w.txt");
  EXPECT_EQ(difference_of(identity_of(one), identity_of(other)), std::nullopt);
  other.survey.sources[0].wavelet = Wavelet(samples(1.5), "file:w.txt");
  EXPECT_EQ(difference_of(identity_of(one), identity_of(other)), "another source or wavelet");
}

}  // namespace slipwave::checkpoint_identity_test
