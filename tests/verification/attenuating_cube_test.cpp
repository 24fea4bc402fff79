// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic rock in 3-D that attenuates against complex moduli, the solver in 2-D, symmetry and itself.
#include <gtest/gtest.h>

#include <cstdio>

#include "attenuating_space.hpp"
#include "continued.hpp"
#include "model/bulk_part.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"
#include "solver/effect/attenuation.hpp"

namespace slipwave::solver {
namespace {

template <int D>
void attenuate(Medium<D>& medium, const Qualities& of) {
  for (const auto property : {Property::qp, Property::qs}) {
    medium[property] = Field<D>(medium.grid(), float(PropertyRow::infinite));
    for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
      if (property == Property::qp || medium.is_solid(cell))
        medium[property][cell] = float(property == Property::qp ? of.p : of.s);
  }
}

/// Sixteen cells of a rock, each under a strain of its own that swings; the first six are strained in one
/// component each.
class SwingingCells {
 public:
  SwingingCells(const Material& rock, const Qualities& of, const Attenuation& attenuation, double interval_s)
      : medium_(uniform_rock({1, 1, 1}, 5, rock)), interval_s_(interval_s), count_(3) {
    attenuate(medium_, of);
    EXPECT_EQ(unrelax(medium_, attenuation), "");
    const StepwiseRelaxation<3> relaxation(medium_, attenuation.mechanisms, interval_s);
    const auto now = material_of(relaxation.medium(), 0);
    stiffness_ = elasticity_of<3>(now);
    const auto tensors = bulk_tensors(now);
    what_ = tensors.are_turned() ? Relaxing::turned : Relaxing::upright;
    const int components = axis_values(3, what_) / 2;
    const auto shares = relaxation.shares(0);
    const auto put = [](std::vector<double>& to, double value) { to.insert(to.end(), block, value); };
    for (const auto* tensor : {&tensors.weights, &tensors.stress})
      for (int c = 0; c < components; ++c) put(axes_, (*tensor)[std::size_t(c)]);
    for (const auto* share : {&shares.bulk, &shares.shear})
      for (int l = 0; l < count_; ++l) put(shares_, relaxation.decay(l) * (*share)[std::size_t(l)]);
    for (int l = 0; l < count_; ++l) rows_.decays[l] = relaxation.decay(l);
    memory_.assign(std::size_t(block * count_ * 6), 0);
  }
  Relaxing what() const { return what_; }
  /// The stiffness in the last of so many cycles, by Voigt's pairs.
  AttenuatingSpace::Voigt stiffness(double hz, int cycles) {
    const double omega = 2 * std::numbers::pi * hz;
    const auto steps = std::int64_t(std::round(cycles / (hz * interval_s_))),
               last = steps * (cycles - 1) / cycles;
    rows_.stress = stress_.data(), rows_.pitch = block, rows_.memory = memory_.data();
    rows_.shares = shares_.data(), rows_.axes = axes_.data();
    AttenuatingSpace::Voigt sum{};
    const auto relax = relaxation_kernel<double>(3, what_, count_);
    for (std::int64_t n = 0; n < steps; ++n) {
      const double t = double(n) * interval_s_;
      const double grown = std::sin(omega * (t + interval_s_)) - std::sin(omega * t);
      for (std::size_t one = 0; one < 6; ++one)
        for (std::size_t other = 0; other < 6; ++other)
          stress_[row_of(one) * block + other] += stiffness_.voigt[one][other] * grown;
      const auto before = stress_;
      relax(block, rows_);
      if (n < last) continue;
      const auto turn = std::polar(2. / double(steps - last), -omega * (t + interval_s_)) * Complex(0, 1);
      for (std::size_t one = 0; one < 6; ++one)
        for (std::size_t other = 0; other < 6; ++other) {
          const auto at = row_of(one) * block + other;
          sum[one][other] += turn * (before[at] + stress_[at]) / 2.;
        }
    }
    return sum;
  }

 private:
  static constexpr std::size_t block = std::size_t(relaxation_block);
  /// Of fields, which have xy before xz and yz.
  static std::size_t row_of(std::size_t voigt) { return voigt < 3 ? voigt : 8 - voigt; }

  Medium<3> medium_;
  double interval_s_;
  int count_;
  Elasticity<3> stiffness_;
  Relaxing what_;
  std::vector<double> stress_ = std::vector<double>(6 * block), memory_, shares_, axes_;
  RelaxationRows<double> rows_{};
};

// Proves (Q11).
TEST(AttenuatingSpace, RelaxesAsItsComplexStiffnesses) {
  const double peak_hz = 20;
  const Attenuation attenuation{Mechanisms(3, peak_hz / 5, 2.5 * peak_hz), peak_hz};
  for (const auto& rock : {shale, cracked, turned_by(shale, 30, 90), turned_by(cracked, 40, 25, -50)})
    for (const double hz : {8., 20., 35.}) {
      SwingingCells cells(rock, {40, 25}, attenuation, 1 / (400 * hz));
      EXPECT_EQ(cells.what(), rock.tilt == 0 ? Relaxing::upright : Relaxing::turned);
      const auto found = cells.stiffness(hz, 25),
                 wanted = AttenuatingSpace(rock, {40, 25}, attenuation.mechanisms, peak_hz).stiffness(hz);
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          EXPECT_LT(std::abs(found[i][j] - wanted[i][j]), 2e-4 * std::abs(wanted[2][2]))
              << rock.tilt << ' ' << hz << ' ' << i << j << ' ' << found[i][j] << wanted[i][j];
    }
}

/// The error of a force in rock that attenuates, at the first of its receivers.
double error_of_a_force(const Material& rock, const Qualities& of, int cells, std::size_t receivers) {
  auto force = force_in_space(rock, cells);
  auto& scene = force.scene;
  scene.survey.receivers_m.resize(std::min(receivers, scene.survey.receivers_m.size()));
  if (!long_form()) scene.numerics.zone_cells = 10;
  attenuate(scene.model.medium, of);
  set_attenuation(scene);
  check(scene);
  const Mechanisms mechanisms(3, force.peak_hz / 5, 2.5 * force.peak_hz);
  const AttenuatingSpace space(rock, of, mechanisms, force.peak_hz);
  const double error = force.error([&](const Point<3>& at, std::size_t count) {
    return space.velocity(at, 1, force.peak_hz, 0.001, count);
  });
  if (long_form()) std::printf("tilt %g, %d cells: %.4f\n", rock.tilt, cells, error);
  return error;
}

// Proves (Q12).
TEST(AttenuatingSpace, OfAForceIsThatOfComplexStiffnesses) {
  const ThreadLimit one_thread(1);
  EXPECT_LT(error_of_a_force(turned_by(shale, 30, 90), {30, 20}, 10, 2), 0.03);
  if (!long_form()) return;
  for (const auto& rock : {shale, cracked, turned_by(shale, 30, 90), turned_by(crossed, -50, 35),
                           turned_by(cracked, 40, 25, -50)})
    EXPECT_LT(error_of_a_force(rock, {30, 20}, 16, 20), 0.01) << rock.tilt;
}

/// Gives a medium Q by cell, in blocks of which some are elastic.
template <int D>
void attenuate_blocks(Medium<D>& medium, std::int64_t every) {
  attenuate(medium, {60, 30});
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    const auto kind = (at[0] / every + at[D - 1] / every) % 3;
    const auto put = [&](Property property, double q) {
      auto& value = medium[property][std::size_t(n)];
      if (std::isfinite(value)) value = float(q);
    };
    if (kind == 0) put(Property::qp, PropertyRow::infinite), put(Property::qs, PropertyRow::infinite);
    if (kind == 1) put(Property::qp, 25), put(Property::qs, 40);
  }
}

// Proves (Q12).
TEST(AttenuatingSpace, OfASliceIsThatInTwoDimensions) {
  const ThreadLimit one_thread(1);
  // Below water and a free surface; the plane of y and z is that of x and z.
  const Material stiff{3600, 1900, 2450, 0.15, 0.1, 0, 0.1};
  const auto flat = [](Material rock) {
    rock.gamma = 0, rock.azimuth = 0;
    return rock;
  };
  for (const double azimuth : long_form() ? std::vector{0., 90.} : std::vector{0.})
    for (const double tilt : {0., 30.}) {
      const auto of = [&](Material rock, double dip) {
        return tilt > 0 ? turned_by(rock, dip, azimuth) : rock;
      };
      const auto upper = of(shale, tilt), lower = of(stiff, -55);
      auto both = slice({azimuth > 0 ? 1 : 0, 2}, upper, lower, flat(upper), flat(lower));
      if (azimuth > 0) both.flat.numerics.cfl = both.deep.numerics.cfl = 0.4;
      both.flat.recording.duration_s = both.deep.recording.duration_s = 0.12;
      const auto elastic = both;
      attenuate(both.flat.model.medium, {30, 20}), attenuate(both.deep.model.medium, {30, 20});
      set_attenuation(both.flat), set_attenuation(both.deep);
      EXPECT_LT(largest_error(both), azimuth > 0 ? 7e-3 : 1e-3) << tilt;
      both.flat = elastic.flat;
      EXPECT_GT(largest_error(both), 0.1) << tilt;
    }
}

// Proves (Q12).
TEST(AttenuatingSpace, IsTurnedWithItsAxes) {
  const ThreadLimit one_thread(1);
  // About the vertical by a right angle, below a free surface: x becomes y, and y becomes -x.
  const auto shot = [&](const Material& rock, const Point<3>& source, const Point<3>& receiver,
                        const char* force) {
    auto edges = edges_all_3d(EdgeLaw::rigid);
    edges[2][0] = EdgeLaw::free;
    auto scene = scene_of(uniform_rock({24, 24, 24}, 5, rock), edges, source, force, "ricker:18", {receiver},
                          {Component::vx, Component::vy, Component::vz}, 0.09, 0.001);
    scene.numerics.cfl = 0.5;
    attenuate(scene.model.medium, {30, 15});
    set_attenuation(scene);
    check(scene);
    return shoot(scene, 1);
  };
  const auto one = shot(turned_by(cracked, 25, 35, 50), {41, 52, 33}, {91, 82, 12}, "force:1,0,0");
  const auto turned = shot(turned_by(cracked, 25, 125, 50), {68, 41, 33}, {38, 91, 12}, "force:0,1,0");
  auto minus = turned.traces[0].samples;
  for (auto& value : minus) value = -value;
  EXPECT_LT(relative_error(turned.traces[1].samples, one.traces[0].samples), 0.005);
  EXPECT_LT(relative_error(minus, one.traces[1].samples), 0.005);
  EXPECT_LT(relative_error(turned.traces[2].samples, one.traces[2].samples), 0.005);
}

const std::vector<Material> rocks = {
    turned_by(shale, 30, 20), {2900, 1500, 2200}, cracked, turned_by(cracked, -40, 60, 15), shale};

/// Blocks of rocks, upright, tilted and isotropic, water above, under a free surface and in layers that
/// absorb.
Scene<3> blocks(const Index<3>& shape) {
  auto edges = edges_all_3d(EdgeLaw::mirror);
  edges[0] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  edges[2] = {EdgeLaw::free, EdgeLaw::absorbing};
  auto scene = scene_of(blocks_below_water(rocks, shape, {22, 9, 7}), edges, {92, 41, 72}, "force:1,1,1",
                        "ricker:25", {{120, 61, 90}, {42, 35, 63}},
                        {Component::vx, Component::vy, Component::vz, Component::p}, 0.03, 0.001);
  scene.numerics.zone_cells = 6;
  return scene;
}

// Proves (Q12).
TEST(AttenuatingSpace, WithoutLossIsElasticToTheBit) {
  const ThreadLimit one_thread(1);
  auto scene = blocks({40, 18, 24});
  const auto elastic = samples_of(shoot(scene, 1));
  // Rows whose rock does not attenuate keep their bits, and so does a Q that is next to infinite.
  attenuate(scene.model.medium, {PropertyRow::infinite, PropertyRow::infinite});
  set_attenuation(scene);
  EXPECT_FALSE(scene.attenuates());
  EXPECT_EQ(samples_of(shoot(scene, 1)), elastic);
  attenuate(scene.model.medium, {1e8, 1e8});
  set_attenuation(scene);
  ASSERT_TRUE(scene.attenuates());
  EXPECT_LT(relative_error(samples_of(shoot(scene, 1)), elastic), 2e-5);
}

}  // namespace
}  // namespace slipwave::solver
