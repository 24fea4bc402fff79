// SPDX-License-Identifier: BSD-3-Clause
// Whole steps in three dimensions.
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "bench.hpp"
#include "measure.hpp"
#include "parallel/threads.hpp"
#include "run.hpp"
#include "scenes.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::bench {
namespace {

struct Cube {
  Index<3> shape;
  Variety variety = Variety::random;
  int order = 5, threads = 1;
  Tiling tiling{0, 0, true};
};

Scene<3> make_scene(const Cube& what) {
  const double h = 5;
  const Grid<3> grid{what.shape, h, {0, 0, 0}};
  Scene<3> scene;
  scene.model.medium = {Field<3>(grid), Field<3>(grid), Field<3>(grid)};
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> spread(0.9F, 1.0F);
  for (std::size_t n = 0; n < std::size_t(grid.size()); ++n) {
    const float size = what.variety == Variety::random ? spread(engine) : 1.0F;
    scene.model.medium.vp[n] = 4500 * size;
    scene.model.medium.vs[n] = 2250 * size;
    scene.model.medium.rho[n] = 2500 * size;
  }
  for (int axis = 0; axis < 3; ++axis) scene.edges[axis] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.numerics.order = what.order;
  scene.numerics.cfl = 0.4;
  scene.numerics.tiling = what.tiling;
  Point<3> middle;
  for (std::size_t a = 0; a < 3; ++a) middle[a] = double(what.shape[a]) * h / 2 + 1;
  scene.survey.sources = {{middle, Explosion{}, parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = {{middle[0], middle[1], middle[2] / 2}};
  scene.recording = {{Component::vz}, 100, 0.01};
  return scene;
}

/// Floating-point operations on a cell in a step, counted as in run.cpp: three pairs per sweep, five sweeps
/// of which the two along x are one.
int flops_a_cell_step(int order, bool uniform) {
  const int others = uniform ? 13 + 2 * 9 : 18 + 10 + 22 + 10;
  return 4 * (3 * flops_of_leaving(order, uniform) + others);
}

void register_cube(const std::string& name, const Cube& what) {
  const std::int64_t cells = what.shape[0] * what.shape[1] * what.shape[2];
  // Threads work on several steps at once: few steps would be spent on starting and ending.
  const std::int64_t steps = std::max<std::int64_t>(8, 50'000'000 / cells);
  const auto run = [=](benchmark::State& state) {
    const ThreadLimit threads(what.threads);
    const auto scene = make_scene(what);
    solver::ShotSimulation<3, float> step(scene, 1, {});
    std::int64_t done = steps;
    step.run_to(done);
    const double least = least_seconds(state, [&] { step.run_to(done += steps); });
    state.counters["cell_steps_per_s"] = double(cells * steps) / least;
    state.counters["seconds_per_step"] = least / double(steps);
    const bool uniform = what.variety == Variety::uniform;
    state.counters["flops"] = flops_a_cell_step(what.order, uniform);
    // Nine fields read and written, and the material.
    state.counters["bytes"] = 4 * (2 * 9 + (uniform ? 0 : 3));
    state.counters["memory_per_cell"] = double(step.memory_bytes()) / double(cells);
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Iterations(3)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

std::string name_of(const Index<3>& shape) {
  return std::to_string(shape[0]) + "x" + std::to_string(shape[1]) + "x" + std::to_string(shape[2]);
}

}  // namespace

void register_cubes() {
  for (const std::int64_t side : {128, 256})
    for (const int order : {3, 5, 7})
      for (const Variety variety : {Variety::uniform, Variety::random})
        for (const int threads : {1, 2}) {
          if (order != 5 && side != 128) continue;
          Cube what;
          what.shape = {side, side, side};
          what.order = order;
          what.variety = variety;
          what.threads = threads;
          register_cube("cube/order:" + std::to_string(order) + "/cells:" + name_of(what.shape) +
                            "/material:" + bench::name_of(variety) + "/threads:" + std::to_string(threads),
                        what);
        }
  for (const int steps : {1, 2})
    for (const int rows : {4, 6, 8, 12, 24, 48, 128}) {
      Cube what;
      what.shape = {128, 128, 128};
      what.tiling = {steps, rows, true};
      register_cube("cube_passage/steps:" + std::to_string(steps) + "/rows:" + std::to_string(rows), what);
    }
}

}  // namespace slipwave::bench
