// SPDX-License-Identifier: BSD-3-Clause
// How cost grows: with the number of cells, in time and memory, and with the number of shots.
#include <fstream>
#include <string>

#include "bench.hpp"
#include "parallel/threads.hpp"
#include "run.hpp"
#include "solver/simulation.hpp"

namespace slipwave::bench {
namespace {

/// Memory of this process, bytes, that is really there; 0 where the system does not say.
double resident_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) * 1024;
  return 0;
}

/// What a model and then a shot through it add to the memory of the process. A step is made, so that all that
/// will be used has been touched.
void memory(benchmark::State& state, const Case& what) {
  const double cells = double(what.nx) * double(what.nz);
  double model = 0, shot = 0;
  for (auto _ : state) {
    const double before = resident_bytes();
    {
      const auto scene = make_scene(what);
      model = resident_bytes() - before;
    }
    const double again = resident_bytes();
    Shot running(what);
    running.run(1);
    // The shot keeps a model of its own.
    shot = resident_bytes() - again - model;
    state.counters["allocated_per_cell"] = double(running.memory_bytes()) / cells;
  }
  state.counters["model_per_cell"] = model / cells;
  state.counters["shot_per_cell"] = shot / cells;
}

/// Shots one after the other through a small scene, set up anew each time.
void shots(benchmark::State& state, int count) {
  Case what;
  what.nx = what.nz = 100;
  what.variety = Variety::layered;
  what.others = EdgeLaw::absorbing;
  what.top = EdgeLaw::free;
  what.receivers = 10;
  what.duration_s = 0.2;
  auto scene = make_scene(what);
  scene.survey.sources.resize(std::size_t(count), scene.survey.sources.front());
  const ThreadLimit one(1);
  const double least = least_seconds(state, [&] {
    for (int n = 1; n <= count; ++n) benchmark::DoNotOptimize(shoot<2>(scene, std::size_t(n)));
  });
  state.counters["seconds_per_shot"] = least / count;
}

}  // namespace

void register_growth() {
  for (const std::int64_t side : {316, 1000, 3162, 10000})
    for (const Variety variety : {Variety::uniform, Variety::random}) {
      if (side == 10000 && variety == Variety::uniform) continue;
      Case what;
      what.nx = what.nz = side;
      what.variety = variety;
      const std::string path = "/cells:" + std::to_string(side * side) + "/material:" + name_of(variety);
      register_run("growth" + path, what);
      benchmark::RegisterBenchmark(("memory" + path).c_str(),
                                   [what](benchmark::State& state) { memory(state, what); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  for (const int count : {1, 10, 100})
    benchmark::RegisterBenchmark(("shots:" + std::to_string(count)).c_str(),
                                 [count](benchmark::State& state) { shots(state, count); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

}  // namespace slipwave::bench
