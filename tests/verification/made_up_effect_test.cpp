// SPDX-License-Identifier: BSD-3-Clause
// An effect, a record and a treatment of faces that slipwave does not have, as somebody else would add them:
// a class each, and no other file.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "parallel/threads.hpp"
#include "solver/build_step.hpp"
#include "solver/effect/effect.hpp"
#include "solver/record/record.hpp"

namespace slipwave::solver::made_up_effect_test {
namespace {

/// Drag on all that moves, dv/dt = -v/tau, half of it before a step ends and half after.
class Drag : public Effect<2, double> {
 public:
  Drag(const Domain<2>& domain, double tau_s)
      : tau_s_(tau_s), cells_(domain.grid.size()), rows_(std::size_t(domain.grid.shape[1])) {
    std::iota(rows_.begin(), rows_.end(), 0);
  }
  EffectDeclaration declaration() const override {
    return {.acts_on = ActsOn::rows, .reads = all_velocities<2>, .writes = all_velocities<2>};
  }
  std::string name() const override { return "drag"; }
  std::int64_t cells() const override { return cells_; }
  std::span<const std::int64_t> rows() const override { return rows_; }
  void apply(const StepTime& time, const RowFields<double>& fields, const IndexRange& columns) override {
    const double left = std::exp(-time.dt_s / 2 / tau_s_);
    for (const int velocity : {0, 1})
      for (auto column = columns.first; column < columns.last; ++column)
        fields.field(velocity)[column] *= left;
  }
  void apply_after_record(const StepTime& time, const RowFields<double>& fields,
                          const IndexRange& columns) override {
    apply(time, fields, columns);
  }

 private:
  double tau_s_;
  std::int64_t cells_;
  std::vector<std::int64_t> rows_;
};

/// A record of velocities along x, of one row at the end of one step.
class OneRow : public Record<2, double> {
 public:
  OneRow(std::int64_t row, std::int64_t step, std::int64_t columns)
      : row_(row), step_(step), velocities(std::size_t(columns)) {}
  bool reads(const StepTime& time, std::int64_t row) const override {
    return time.step == step_ && row == row_;
  }
  Box box() const override { return {{row_, row_ + 1}, {0, std::int64_t(velocities.size())}}; }
  void read(const StepTime& time, const RowFields<const double>& fields, const IndexRange& cells) override {
    if (!reads(time, fields.row)) return;
    for (auto column = cells.first; column < cells.last; ++column)
      velocities[std::size_t(column)] = fields.field(0)[column];
  }

 private:
  std::int64_t row_, step_;

 public:
  std::vector<double> velocities;
};

constexpr double vp = 3000, vs = 1700, rho = 2300;

/// One rock between rigid walls across x.
Scene<2> channel(double length_m, double spacing_m, const Tiling& tiling) {
  Scene<2> scene;
  scene.model.medium = Medium<2>(Grid<2>{{std::llround(length_m / spacing_m), 12}, spacing_m, {0, 0}});
  for (std::size_t cell = 0; cell < scene.model.medium.vp.size(); ++cell)
    put(scene.model.medium, cell, {vp, vs, rho});
  scene.edges[0] = {EdgeLaw::rigid, EdgeLaw::rigid};
  scene.edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.numerics.tiling = tiling;
  return scene;
}

constexpr double length_m = 480, tau_s = 0.1;
constexpr double wave_number = 2 * std::numbers::pi / length_m;

/// A standing P wave along x between rigid walls, in cells of `spacing_m`, with drag.
class DraggedWave {
 public:
  DraggedWave(double spacing_m, const Tiling& tiling) : scene_(channel(length_m, spacing_m, tiling)) {
    StepBuilder<2, double> builder{scene_, domain_, state_, dt_s_};
    effects_.push_back(std::make_unique<Drag>(domain_, tau_s));
    step_ = std::make_unique<TimeStep<2, double>>(builder.time_step(sweeps_, effects_, {&record_}, steps()));
    executor_ = builder.executor(sweeps_, *step_, nullptr);
    // A step begins with what comes after recording.
    const double begun = std::exp(-dt_s_ / 2 / tau_s);
    for (std::int64_t k = 0; k < shape()[1]; ++k)
      for (std::int64_t i = 0; i < shape()[0]; ++i) state_.field_row({0, k}, 0)[i] = begun * standing(i);
    executor_->fields_changed();
    executor_->run(0, steps(), {});
  }
  /// By what the closed form is missed at the end, as a share of the wave that began.
  double error() const {
    // q'' + q'/tau + (vp k)^2 q = 0.
    const double t = double(steps()) * dt_s_, half = 1 / (2 * tau_s);
    const double omega = std::sqrt(std::pow(vp * wave_number, 2) - half * half);
    const double left = std::exp(-half * t) * (std::cos(omega * t) - half / omega * std::sin(omega * t));
    double sum = 0, all = 0;
    for (std::int64_t i = 0; i < shape()[0]; ++i) {
      sum += std::pow(record_.velocities[std::size_t(i)] - left * standing(i), 2);
      all += std::pow(standing(i), 2);
    }
    return std::sqrt(sum / all);
  }
  const std::vector<double>& velocities() const { return record_.velocities; }

 private:
  const Index<2>& shape() const { return domain_.grid.shape; }
  std::int64_t steps() const { return std::llround(0.3 / dt_s_); }
  double standing(std::int64_t i) const {
    return std::sin(wave_number * (double(i) + 0.5) * domain_.grid.spacing_m);
  }

  Scene<2> scene_;
  double dt_s_ = time_step_s(scene_);
  Domain<2> domain_ = make_domain(scene_.model.medium, scene_.edges, 0);
  State<2, double> state_ = make_filled_state<2, double>(domain_, scene_.model.medium, dt_s_);
  Sweeps<2, double> sweeps_{state_, domain_, scene_.numerics.order};
  Effects<2, double> effects_;
  OneRow record_{shape()[1] / 2, steps() - 1, shape()[0]};
  std::unique_ptr<TimeStep<2, double>> step_;
  std::unique_ptr<Executor> executor_;
};

TEST(MadeUpEffect, IsAppliedAsItsClosedFormSays) {
  const double coarse = DraggedWave(10, {}).error(), fine = DraggedWave(5, {}).error();
  EXPECT_LT(coarse, 0.0005) << fine;
  // Of second order.
  EXPECT_LT(fine, coarse / 3.5);
}

TEST(MadeUpEffect, GivesTheSameBitsPlainlyAndInTiles) {
  Tiling plain, narrow;
  plain.plain = true;
  narrow.steps = 3, narrow.stripe_cells = 16;
  const auto expected = DraggedWave(5, plain).velocities();
  EXPECT_EQ(DraggedWave(5, narrow).velocities(), expected);
  const ThreadLimit one_thread(1);
  EXPECT_EQ(DraggedWave(5, {}).velocities(), expected);
}

/// Dashpots in a plane across x, before the cells of one column: tractions before and behind it differ by
/// eta times its velocity.
class Dashpots : public FaceTreatment<2, double> {
 public:
  Dashpots(const State<2, double>& state, std::int64_t column, double eta)
      : state_(state), column_(column), eta_(eta) {}
  bool beside(int axis, std::int64_t) const override { return axis == 0; }
  void add(int axis, std::int64_t line, const IndexRange& columns, double scale, InterfaceStates<double> lo,
           InterfaceStates<double> hi, const SweptRows<double>& rows, bool) override {
    if (axis != 0) return;
    for (const std::int64_t side : {0, 1}) {
      const auto cell = column_ - 1 + side, i = cell - columns.first;
      if (cell < columns.first || cell >= columns.last) continue;
      // Z v - s of the cell before the plane and Z v + s of that behind stay; on both sides is one rock.
      const auto material = state_.material_from(state_.layout.line_index(line), cell, axis);
      const double z = *material.zp, lambda = z * z - 2 * *material.zs * *material.zs, b = *material.b;
      const double slowed = (side == 0 ? hi : lo).v(0)[i] * eta_ / (2 * z + eta_), strained = b * slowed;
      rows.v[i] -= scale * z * strained;
      rows.s[i] += (side == 0 ? -1 : 1) * scale * z * z * strained;
      rows.passive[i] += (side == 0 ? -1 : 1) * scale * lambda * strained;
    }
  }
  std::int64_t memory_bytes() const override { return 0; }

 private:
  const State<2, double>& state_;
  std::int64_t column_;
  double eta_;
};

/// A pulse of P waves along x that meets dashpots of the rock's own impedance.
class PulseThroughDashpots {
 public:
  PulseThroughDashpots(double spacing_m, const Tiling& tiling)
      : scene_(channel(2 * plane_m, spacing_m, tiling)) {
    sweeps_.use(&dashpots_);
    StepBuilder<2, double> builder{scene_, domain_, state_, dt_s_};
    step_ = std::make_unique<TimeStep<2, double>>(builder.time_step(sweeps_, effects_, {&record_}, steps()));
    executor_ = builder.executor(sweeps_, *step_, nullptr);
    for (std::int64_t k = 0; k < domain_.grid.shape[1]; ++k)
      for (std::int64_t i = 0; i < domain_.grid.shape[0]; ++i) {
        const double v = pulse(x_of(i) - from_m);
        state_.field_row({0, k}, 0)[i] = v;
        state_.field_row({0, k}, 2)[i] = -rho * vp * v;
        state_.field_row({0, k}, 3)[i] = -rho * (vp - 2 * vs * vs / vp) * v;
      }
    executor_->fields_changed();
    executor_->run(0, steps(), {});
  }
  /// By what the closed form is missed at the end, as a share of the pulse that began.
  double error() const {
    const double gone = vp * double(steps()) * dt_s_;
    double sum = 0, all = 0;
    for (std::int64_t i = 0; i < domain_.grid.shape[0]; ++i) {
      const double x = x_of(i), past = pulse(x - from_m - gone),
                   back = pulse(2 * plane_m - x - from_m - gone);
      // With eta = Z a plane lets 2 Z/(2 Z + eta) pass, and the velocity of -eta/(2 Z + eta) returns.
      const double exact = x > plane_m ? past * 2 / 3 : past - back / 3;
      sum += std::pow(record_.velocities[std::size_t(i)] - exact, 2);
      all += std::pow(pulse(x - from_m), 2);
    }
    return std::sqrt(sum / all);
  }
  const std::vector<double>& velocities() const { return record_.velocities; }

 private:
  static constexpr double from_m = 240, plane_m = 480;
  static double pulse(double x) { return std::exp(-x * x / (40. * 40.)); }
  /// Faces that a treatment changes are told to the domain, so that they are solved in uniform rock, too.
  static Domain<2> domain_of(const Scene<2>& scene, std::int64_t column) {
    auto domain = make_domain(scene.model.medium, scene.edges, 0);
    for (std::int64_t k = 0; k < domain.grid.shape[1]; ++k) domain.split.push_back({.behind = {column, k}});
    return domain;
  }
  double x_of(std::int64_t i) const { return (double(i) + 0.5) * domain_.grid.spacing_m; }
  std::int64_t steps() const { return std::llround(0.15 / dt_s_); }

  Scene<2> scene_;
  double dt_s_ = time_step_s(scene_);
  std::int64_t column_ = std::llround(plane_m / scene_.model.grid().spacing_m);
  Domain<2> domain_ = domain_of(scene_, column_);
  State<2, double> state_ = make_filled_state<2, double>(domain_, scene_.model.medium, dt_s_);
  Dashpots dashpots_{state_, column_, rho* vp};
  Sweeps<2, double> sweeps_{state_, domain_, scene_.numerics.order};
  Effects<2, double> effects_;
  OneRow record_{domain_.grid.shape[1] / 2, steps() - 1, domain_.grid.shape[0]};
  std::unique_ptr<TimeStep<2, double>> step_;
  std::unique_ptr<Executor> executor_;
};

TEST(MadeUpFace, ReflectsAndPassesAsItsClosedFormSays) {
  const double coarse = PulseThroughDashpots(5, {}).error(), fine = PulseThroughDashpots(2.5, {}).error();
  // Of first order: cells beside the plane are reconstructed as if tractions were continuous there.
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse / 1.8);
}

TEST(MadeUpFace, GivesTheSameBitsPlainlyAndInTiles) {
  Tiling plain, narrow;
  plain.plain = true;
  narrow.steps = 3, narrow.stripe_cells = 16;
  const auto expected = PulseThroughDashpots(2.5, plain).velocities();
  EXPECT_EQ(PulseThroughDashpots(2.5, narrow).velocities(), expected);
}

}  // namespace
}  // namespace slipwave::solver::made_up_effect_test
