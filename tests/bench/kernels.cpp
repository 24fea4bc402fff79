// SPDX-License-Identifier: BSD-3-Clause
// The inner loops alone, on rows that stay in the first cache.
#include <vector>

#include "bench.hpp"
#include "measure.hpp"
#include "run.hpp"
#include "solver/kernels/kernels.hpp"

namespace slipwave::bench {
namespace {

constexpr std::int64_t cells = 256, gap = 16, repeats = 200;

/// Rows of fields, material and faces of a range of cells, some room before and behind each.
template <class Real>
class Rows {
 public:
  Rows() : values_(std::size_t(count * pitch)) {
    for (int row = 0; row < count; ++row)
      for (std::int64_t i = 0; i < pitch; ++i)
        values_[std::size_t(row * pitch + i)] = row < 5 ? Real(1e-3) * Real((i * 7 + row) % 11 - 5) : Real(0);
    for (std::int64_t i = -gap; i < cells + gap; ++i) {
      row(5)[i] = Real(1e-7) * (1 + Real(0.01) * Real(i % 5));
      row(6)[i] = Real(4e6) * (1 + Real(0.01) * Real(i % 3));
      row(7)[i] = Real(2e6) * (1 + Real(0.01) * Real(i % 7));
    }
  }
  Real* row(int n) { return values_.data() + n * pitch + gap; }
  solver::MaterialRows<Real> material(std::int64_t i) { return {row(5) + i, row(6) + i, row(7) + i}; }
  /// Faces between the cells: what lies before cell i stands at i.
  solver::InterfaceStates<Real> faces() { return {row(8), pitch}; }
  solver::OutgoingWaves<Real> outgoing() { return {row(12), pitch}; }

 private:
  static constexpr int count = 16;
  static constexpr std::int64_t pitch = cells + 2 * gap;
  std::vector<Real> values_;
};

enum class Subdomain { leave, meet, update, inside, sweep };

template <class Real>
void run(benchmark::State& state, Subdomain part, int order, bool uniform) {
  const auto& kernels = solver::kernels<Real>(order, uniform);
  const auto& face = kernels.face[0];
  Rows<Real> rows;
  const auto leave = [&](int v, int s, int z, int pair) {
    kernels.reconstruct(cells + 2, 1, rows.row(v) - 1, rows.row(s) - 1, rows.row(z) - 1, rows.row(5) - 1,
                        Real(1), rows.outgoing().up(pair) - 1, rows.outgoing().down(pair) - 1);
  };
  const auto meet = [&] {
    face.solve_riemann(cells + 1, rows.outgoing().at(-1), rows.outgoing(), rows.material(-1),
                       rows.material(0), rows.faces());
  };
  const auto update = [&] {
    face.update(cells, Real(1), rows.faces(), rows.faces().at(1), rows.material(0),
                {rows.row(0), rows.row(1), rows.row(2), rows.row(3), rows.row(4)});
  };
  const auto inside = [&] {
    const auto here = rows.outgoing();
    face.update_uniform(cells, Real(1), here.at(-1), here, here.at(1), rows.material(0),
                        {rows.row(0), rows.row(1), rows.row(2), rows.row(3), rows.row(4)});
  };
  const bool all = part == Subdomain::sweep;
  const double least = least_seconds(state, [&] {
    for (std::int64_t n = 0; n < repeats; ++n) {
      if (part == Subdomain::leave || all) leave(0, 1, 6, 0);
      if (part == Subdomain::leave || all) leave(3, 4, 7, 1);
      if (part == Subdomain::meet || (all && !uniform)) meet();
      if (part == Subdomain::update || (all && !uniform)) update();
      if (part == Subdomain::inside || (all && uniform)) inside();
      benchmark::ClobberMemory();
    }
  });
  state.counters["cells_per_s"] = double(cells * repeats) / least;
  if (part == Subdomain::sweep) state.counters["flops"] = flops_a_cell_step(order, uniform, false) / 2.;
}

template <class Real>
void add(const char* name, Subdomain part, int order, bool uniform) {
  const std::string path = std::string("kernel:") + name + "/order:" + std::to_string(order) +
                           "/material:" + (uniform ? "uniform" : "random") +
                           "/precision:" + (sizeof(Real) == 4 ? "float" : "double");
  benchmark::RegisterBenchmark(path.c_str(),
                               [=](benchmark::State& state) { run<Real>(state, part, order, uniform); })
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

template <class Real>
void add_all() {
  for (const bool uniform : {true, false}) {
    for (const int order : orders) {
      add<Real>("leave", Subdomain::leave, order, uniform);
      add<Real>("sweep", Subdomain::sweep, order, uniform);
    }
    add<Real>("meet", Subdomain::meet, 5, uniform);
    add<Real>("update", Subdomain::update, 5, uniform);
    if (uniform) add<Real>("inside", Subdomain::inside, 5, uniform);
  }
}

}  // namespace

void register_kernels() {
  add_all<float>();
  add_all<double>();
}

}  // namespace slipwave::bench
