// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "cube.hpp"
#include "scene/subdomains.hpp"
#include "sea_over_fractures.hpp"
#include "solver/shot_simulation.hpp"

// What a time step is made of, and what its effects write.
namespace slipwave::solver::time_step_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000};

// docs/solver.md shows these lists.
TEST(TimeStep, IsAListOfSweepsEffectsAndRecords) {
  const auto list_of = [](const Scene<2>& scene) {
    return ShotSimulation<2, float>(scene, 1, {}).time_step().text();
  };
  using Lines = std::vector<std::string>;
  auto scene = sea_over_fractures();
  scene.model.fracture_sets.clear();
  scene.model.fracture = {};
  EXPECT_EQ(list_of(scene),
            (Lines{"sweep along x, 0.5 (PML)", "sweep along z, 1 (PML)", "sweep along x, 0.5 (PML)", "source",
                   "record", "source, after recording"}));
  auto acoustic = scene;
  acoustic.model.medium = uniform_medium(330, 120, 5, water);
  acoustic.edges = edges_all(EdgeLaw::free);
  EXPECT_EQ(list_of(acoustic), (Lines{"sweep along x, 0.5", "sweep along z, 1", "sweep along x, 0.5",
                                      "source", "record", "source, after recording"}));
  auto slip = sea_over_fractures();
  slip.model.medium = uniform_medium(330, 120, 5, rock);
  slip.edges[1][0] = EdgeLaw::absorbing;
  slip.survey.sources = {{{0, 0}, parse_mechanism<2>("plane:0"), parse_wavelet("ricker:40"), 1}};
  EXPECT_EQ(list_of(slip),
            (Lines{"sweep along x, 0.5 (PML, incident wave)", "sweep along z, 1 (PML, incident wave)",
                   "sweep along x, 0.5 (PML, incident wave)", "slip, centred", "record",
                   "slip, centred, after recording"}));
}

TEST(TimeStep, IsThatOfItsOwnModelWhateverWasNotedOfAnother) {
  auto scene = sea_over_fractures();
  note_speeds(scene);
  auto faster = scene;
  faster.subdomain = {};
  for (auto& vp : faster.model.medium.vp) vp *= 2;
  EXPECT_EQ(stable_time_step_s(with_model(scene, faster.model)), stable_time_step_s(faster));
  EXPECT_LT(stable_time_step_s(faster), 0.6 * stable_time_step_s(scene));
}

/// Numbers of the field rows that differ.
unsigned changed(const State<2, float>& state, const std::vector<float>& before) {
  unsigned rows = 0;
  for (std::int64_t line = 0; line < state.layout.lines(); ++line)
    for (int row = 0; row < FieldRows<2>::count; ++row) {
      const auto place =
          std::size_t(state.layout.line(state.layout.line_index(line)) + row * state.layout.row_pitch());
      for (std::size_t x = 0; x < std::size_t(state.layout.shape()[0]); ++x)
        if (state.fields.data()[place + x] != before[place + x]) rows |= 1U << row;
    }
  return rows;
}

TEST(Effects, WriteNothingButWhatTheyDeclare) {
  for (const char* mechanism : {"explosion", "force:1,0", "moment:0,0,1", "plane:0"}) {
    auto scene = sea_over_fractures();
    scene.model.medium = uniform_medium(330, 120, 5, rock);
    scene.edges[1][0] = EdgeLaw::absorbing;
    scene.survey.sources[0].mechanism = parse_mechanism<2>(mechanism);
    if (std::string(mechanism) == "plane:0") scene.survey.sources[0].position_m = {0, 0};
    const double dt_s = time_step_s(scene);
    auto domain = make_domain(scene.model.medium, scene.edges, zone_cells(scene, scene.survey.sources[0]));
    auto state = make_filled_state<2, float>(domain, scene.model.medium, dt_s);
    const auto effects = StepBuilder<2, float>{scene, domain, state, dt_s}.effects(1, 1, nullptr);
    ASSERT_EQ(effects.size(), std::string(mechanism) == "plane:0" ? 2u : 3u);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> random(-1e6F, 1e6F);
    for (const auto& effect : effects) {
      SCOPED_TRACE(effect->name());
      for (std::int64_t n = 0; n < state.fields.size(); ++n) state.fields.data()[n] = random(engine);
      const std::vector<float> before(state.fields.data(), state.fields.data() + state.fields.size());
      const StepTime time{40, dt_s};
      for (std::int64_t step = 0; step <= time.step; ++step) effect->begin({step, dt_s});
      for (std::int64_t row = 0; row < state.layout.lines(); ++row)
        effect->apply(time, state.row_fields(row), {0, state.layout.shape()[0]});
      const auto declared = effect->declaration();
      EXPECT_EQ(changed(state, before) & ~declared.writes, 0u);
      EXPECT_EQ(changed(state, before) != 0, declared.acts_on != ActsOn::nothing);
    }
  }
}

}  // namespace
}  // namespace slipwave::solver::time_step_test
