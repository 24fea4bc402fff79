// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <variant>

#include "parallel/threads.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::bench {

struct Shot::Impl {
  using Single = solver::ShotSimulation<2, float>;
  using Double = solver::ShotSimulation<2, double>;

  explicit Impl(const Case& what) : threads(what.threads), scene(make_scene(what)) {
    const SnapshotSink<2> sink = [this](double, const FieldReader<2>& field) {
      seen += double(field(Component::vz)[0]);
    };
    const auto snapshots = scene.snapshot_every_s ? sink : SnapshotSink<2>{};
    if (what.double_precision)
      step = std::make_unique<Double>(scene, 1, snapshots);
    else
      step = std::make_unique<Single>(scene, 1, snapshots);
  }

  ThreadLimit threads;
  Scene<2> scene;
  std::variant<std::unique_ptr<Single>, std::unique_ptr<Double>> step;
  std::int64_t done = 0;
  double seen = 0;
};

Shot::Shot(const Case& what) : impl_(std::make_unique<Impl>(what)) {}
Shot::~Shot() = default;

void Shot::run(std::int64_t steps) {
  impl_->done += steps;
  std::visit([&](auto& step) { step->run_to(impl_->done); }, impl_->step);
}

std::int64_t Shot::memory_bytes() const {
  return std::visit([](const auto& step) { return step->memory_bytes(); }, impl_->step);
}

int flops_of_leaving(int order, bool uniform) {
  const int m = reach_of(order);
  // As written in reconstruction.hpp.
  // Courant number 2, then by neighbours on each side as they are computed there.
  constexpr int weights_by_reach[] = {0, 2 + 7, 2 + 18, 2 + 32, 2 + 50, 2 + 72};
  // Of each of two fields: e0 u, sum, times, plus; difference, times, plus but for the first.
  const int sums = m == 0 ? 0 : 2 * (1 + 6 * m - 1);
  return sums + (m == 0 ? 3 : 6) + (uniform ? 0 : weights_by_reach[m]);
}

int flops_a_cell_step(int order, bool uniform, bool fluid) {
  const int pairs = fluid ? 1 : 2;
  int others = 0;
  if (uniform) {
    // Differences of outgoing waves up and down, v* 2, v 3, stresses 2 each; of S v* 2, v 3, stress 2.
    others = fluid ? 9 : 11 + 9;
  } else {
    // Riemann: v* 2, s* 4 a pair; sums of impedances 2 a pair, the common division 4 (of one pair 1).
    const int meet = 8 * pairs + (fluid ? 1 : 4);
    // Updates: v 3, difference of v* 1, stresses 2 each (of fluid one), v_t 3, s_nt 3; the moduli.
    others = meet + (fluid ? 6 + 4 : 14 + 8);
  }
  // Sweeps along x of neighbouring steps are one: two sweeps per step.
  return 2 * (pairs * flops_of_leaving(order, uniform) + others);
}

int bytes_a_cell_step(const Case& what) {
  const int real = what.double_precision ? 8 : 4;
  const int fields = what.fluid ? 3 : 5;
  const int material = what.variety != Variety::random ? 0 : what.fluid ? 2 : 3;
  return real * (2 * fields + material);
}

void register_run(const std::string& name, const Case& what) {
  const std::int64_t cells = what.nx * what.nz;
  // Threads work on several steps at once: few steps would be spent on starting and ending.
  const std::int64_t steps = std::max<std::int64_t>(8, 4'000'000 / cells);
  const std::int64_t repeats = std::max<std::int64_t>(3, 60'000'000 / (cells * steps));
  const auto run = [=](benchmark::State& state) {
    Shot shot(what);
    shot.run(steps);
    const double least = least_seconds(state, [&] { shot.run(steps); });
    state.counters["cell_steps_per_s"] = double(cells * steps) / least;
    state.counters["seconds_per_step"] = least / double(steps);
    if (what.time_order == 2)
      state.counters["flops"] = flops_a_cell_step(what.order, what.variety != Variety::random, what.fluid);
    state.counters["bytes"] = bytes_a_cell_step(what);
    state.counters["memory_per_cell"] = double(shot.memory_bytes()) / double(cells);
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Iterations(repeats)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace slipwave::bench
