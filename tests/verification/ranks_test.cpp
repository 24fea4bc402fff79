#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "cube_extruded.hpp"
#include "lab.hpp"
#include "ranks_in_threads.hpp"
#include "solver/parts.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {
namespace {

template <int D>
Gather shared_out(const Scene<D>& scene, int count, int threads = 1) {
  const ThreadLimit limit(threads);
  Gather found;
  RanksInThreads::run(count, [&](Ranks& ranks) {
    auto part = cut_to(scene, part_for(scene, scene.model.grid(), ranks.number(), count));
    join(part, ranks);
    check(part);
    auto gather = shoot(part, 1, {}, {}, nullptr, nullptr, &ranks);
    if (ranks.number() == 0) found = std::move(gather);
  });
  return found;
}

std::vector<double> all_samples(const Gather& gather) {
  std::vector<double> all;
  for (const auto& trace : gather.traces) all.insert(all.end(), trace.samples.begin(), trace.samples.end());
  return all;
}

/// Water over rocks, with fractures and voids down to the bottom.
Scene<2> reef() {
  constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, soft{2500, 1200, 2000}, air{0, 0, 0};
  const std::int64_t nx = 90, nz = 190;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 30 + i / 10) put(scene.model.medium, {i, k}, water);
      if (k > 120 + i / 9) put(scene.model.medium, {i, k}, soft);
      if (i > 60 && i < 66 && k > 60 && k < 100) put(scene.model.medium, {i, k}, air);
      if (i >= 30 && i < 50 && k > 55 && k < 185) scene.model.fracture({i, k}) = 1 + (i + k) % 2;
    }
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.5, 0.001, 0.01, true}}},
                               {"blocks", {{{1, 0}, 0.4, 0, 0.02}, {{0, 1}, 0.3, 0.001, 0.01}}}};
  scene.survey.sources = {{{203, 461}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 3}, {402.5, 201.3}, {220, 400}, {220.1, 470.2}, {227, 703.3}, {33, 941}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p, Component::sxz}, 0.16, 0.001};
  return scene;
}

TEST(Ranks, RecordTogetherWhatOneProcessDoes) {
  struct Kind {
    const char* name;
    EdgeLaw sides, bottom;
    int order, time_order;
    SlipCorrection correction;
  };
  for (const auto& [name, sides, bottom, order, time_order, correction] :
       {Kind{"matched layer", EdgeLaw::absorbing, EdgeLaw::absorbing, 5, 2, SlipCorrection::second},
        Kind{"free sides", EdgeLaw::free, EdgeLaw::rigid, 7, 2, SlipCorrection::exponential},
        Kind{"mirror", EdgeLaw::mirror, EdgeLaw::absorbing, 3, 2, SlipCorrection::first},
        Kind{"order 1", EdgeLaw::absorbing, EdgeLaw::free, 1, 2, SlipCorrection::second},
        Kind{"order 4 in time", EdgeLaw::free, EdgeLaw::absorbing, 5, 4, SlipCorrection::second}}) {
    SCOPED_TRACE(name);
    auto scene = reef();
    scene.edges[0] = {sides, sides};
    scene.edges[1][1] = bottom;
    scene.numerics.order = order;
    scene.numerics.time_order = time_order;
    scene.numerics.correction = correction;
    const auto alone = all_samples(shoot(scene, 1));
    double largest = 0;
    for (const double sample : alone) largest = std::max(largest, std::abs(sample));
    EXPECT_GT(largest, 0);
    for (const int count : {2, time_order == 4 ? 2 : 4})
      for (const int threads : {1, 3})
        EXPECT_TRUE(all_samples(shared_out(scene, count, threads)) == alone)
            << count << " ranks, " << threads << " threads";
  }
}

}  // namespace
}  // namespace slipwave::solver
