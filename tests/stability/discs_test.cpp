// SPDX-License-Identifier: BSD-3-Clause
// Single fractures in 3-D: the energy of waves and springs never rises, however stiff or soft discs are and
// wherever they cross (docs/theory.md (S25), (S30)).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lab.hpp"
#include "model/fracture_network.hpp"
#include "model/single_fracture.hpp"
#include "solver/simulation.hpp"
#include "whole_effect.hpp"

namespace slipwave::discs_test {
namespace {

/// Waves of random values in a box with discs in it.
template <class Real>
class DiscBox {
 public:
  struct Setup {
    EdgeLaw edges;
    int order;
    double cfl;
    SlipCorrection correction;
    std::vector<double> compliances;  // of each set, times mu/h
    bool lumps;                       // harder and softer rock, water and void
  };
  DiscBox(const Setup& of, unsigned seed) {
    auto& model = scene_.model;
    constexpr std::int64_t cells = 13;
    const double h = 5, mu = 2e10;
    model.medium = medium_of({cells, cells + 1, cells + 2}, h, of.lumps, seed);
    std::uint64_t drawn = seed;
    for (const double compliance : of.compliances) {
      FractureNetwork network{4, 0, 2 * h, 8 * h, 2, 40, 0, ++drawn};
      SlipSystem<3> system{{0, 0, 1}, 0, 0, 0, false, FrictionLaw::none};
      const double z = compliance * h / mu;
      system.compliance = {drawn % 3 == 0 ? 0 : z, drawn % 5 == 0 ? 0 : 2 * z, 0, 0, 0};
      const double side = double(cells) * h;
      add_single_fractures<3>(
          model, {"discs",
                  {system},
                  drawn_fractures(model.grid(), region_of_box<3>({{0, 0, 0}, {side, side, side}}), network)});
    }
    EdgeLaws<3> edges;
    for (int axis = 0; axis < 3; ++axis) edges[axis] = {of.edges, of.edges};
    scene_.numerics.correction = of.correction;
    dt_s_ = of.cfl * h / fastest_speed(model.medium);
    domain_ = solver::make_domain(model.medium, edges, 1, {}, of.order);
    state_ = solver::make_state<3, Real>(domain_.grid.shape, domain_.material_kind());
    solver::fill_material(state_, domain_, model.medium, dt_s_);
    sweeps_ = std::make_unique<solver::Sweeps<3, Real>>(state_, domain_, of.order);
    springs_ = std::make_unique<solver::LinearSlip<3, Real>>(state_, domain_, scene_, dt_s_);
    shake(seed);
  }
  void step() {
    for (const auto& [axis, fraction] : splitting(3, 2)) sweeps_->along(axis, Real(fraction));
    const solver::StepTime time{steps_++, dt_s_};
    solver::run_everywhere(*springs_, time, state_);
    solver::run_after_everywhere(*springs_, time, state_);
  }
  double energy() const {
    return solver::energy(state_, domain_, scene_.model.medium) + springs_->stored_energy();
  }
  std::int64_t fractured() const { return springs_->cells(); }

 private:
  static Medium<3> medium_of(const Index<3>& shape, double h, bool lumps, unsigned seed) {
    const Grid<3> grid{shape, h, {0, 0, 0}};
    Medium<3> medium{Field<3>(grid, 4500), Field<3>(grid, 2250), Field<3>(grid, 2500)};
    const float others[][3] = {{2500, 1200, 2000}, {1500, 0, 1000}, {0, 0, 0}, {5500, 3800, 2700}};
    for (std::size_t cell = 0; lumps && cell < medium.vp.size(); ++cell) {
      const auto at = grid.index(std::int64_t(cell));
      std::mt19937 block(unsigned(at[0] / 3 + 7 * (at[1] / 3) + 49 * (at[2] / 3)) + seed);
      const auto number = block() % 8;
      if (number >= 4) continue;
      medium.vp[cell] = others[number][0], medium.vs[cell] = others[number][1],
      medium.rho[cell] = others[number][2];
    }
    return medium;
  }
  /// Random values in all cells that carry them.
  void shake(unsigned seed) {
    const auto& medium = scene_.model.medium;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> random(-0.5, 0.5);
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const auto cell = std::size_t(n);
      const double z = double(medium.rho[cell]) * medium.vp[cell], pressure = z * random(engine);
      for (int row = 0; row < solver::FieldRows<3>::count; ++row) {
        const double value = random(engine);
        if (!solver::FieldRows<3>::is_stored(state_.layout, row)) continue;
        const bool solid = medium.is_solid(cell), normal = row >= 3 && row < 6;
        state_.field_row({0, at[1], at[2]}, row)[at[0]] = Real(medium.is_void(cell) ? 0
                                                               : row < 3            ? value
                                                               : solid              ? z * value
                                                               : normal             ? pressure
                                                                                    : 0);
      }
    }
  }

  Scene<3> scene_;
  double dt_s_ = 0;
  solver::Domain<3> domain_;
  solver::State<3, Real> state_;
  std::unique_ptr<solver::Sweeps<3, Real>> sweeps_;
  std::unique_ptr<solver::LinearSlip<3, Real>> springs_;
  std::int64_t steps_ = 0;
};

template <class Real>
void expect_bounded(const typename DiscBox<Real>::Setup& of, unsigned seed) {
  DiscBox<Real> box(of, seed);
  SCOPED_TRACE("compliance " + std::to_string(of.compliances[0]) + ", order " + std::to_string(of.order) +
               ", Courant " + std::to_string(of.cfl) + ", " + name_of(of.correction) + ", seed " +
               std::to_string(seed));
  EXPECT_GT(box.fractured(), 100);
  const int steps = long_form() ? 3000 : 60;
  const double begin = box.energy();
  double highest_late = 0;
  ASSERT_GT(begin, 0);
  for (int n = 0; n < steps; ++n) {
    box.step();
    if (n > 100 && n % 10 != 0) continue;
    const double now = box.energy();
    // Written so that NaN fails.
    ASSERT_TRUE(now <= begin * (1 + rounding<Real>())) << "step " << n << ": " << now << " of " << begin;
    if (2 * n > steps) highest_late = std::max(highest_late, now);
  }
  EXPECT_LT(highest_late, begin);
}

// Proves (S30).
TEST(Discs, NeverAddEnergyHoweverStiffOrSoft) {
  const ThreadLimit one_thread{1};
  constexpr SlipCorrection corrections[] = {SlipCorrection::first, SlipCorrection::second,
                                            SlipCorrection::exponential, SlipCorrection::centred};
  constexpr EdgeLaw edges[] = {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::mirror};
  constexpr int orders[] = {5, 7, 3, 1, 9};
  constexpr double courant[] = {1, 0.9, 0.45};
  unsigned number = 0;
  for (const auto& compliances : std::vector<std::vector<double>>{
           {1e-6}, {0.01}, {1}, {30}, {1e9}, {1e9, 1e-3}, {1e19, 1e19}, {30, 1, 0.1}})
    for (const bool lumps : {false, true}) {
      ++number;
      const auto edge = edges[number % 3];
      const int order = orders[number % 5];
      const double cfl = courant[number / 2 % 3];
      const auto correction = corrections[number % 4];
      if (number % 3 == 0)
        expect_bounded<float>({edge, order, cfl, correction, compliances, lumps}, number);
      else
        expect_bounded<double>({edge, order, cfl, correction, compliances, lumps}, number);
    }
}

}  // namespace
}  // namespace slipwave::discs_test
