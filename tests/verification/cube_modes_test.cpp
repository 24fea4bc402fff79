// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "cube.hpp"

// Standing waves between mirrors: closed forms in a closed box.
namespace slipwave::solver::cube_modes_test {
namespace {

constexpr Rock rock{4500, 2600, 2500};
constexpr double side_m = 120;

/// A mode of the box: half waves along each axis and the amplitudes of the velocities, along the wave vector
/// (P) or across it (S).
struct Mode {
  std::array<double, 3> halves, amplitude;
  double speed;
  double k(int axis) const { return std::numbers::pi * halves[std::size_t(axis)] / side_m; }
  double omega() const { return speed * std::hypot(k(0), k(1), k(2)); }
};
const Mode p_mode = {{1, 2, 1}, {1, 2, 1}, rock.vp};
const Mode s_mode = {{2, 1, 1}, {1, -1, -1}, rock.vs};
const Mode other_s_mode = {{1, 1, 2}, {1, 1, -1}, rock.vs};

/// Value of a row at a place and time: v_i = a_i sin(k_i x_i) times the cosines along the other axes and cos
/// wt.
double value(const Mode& mode, int row, const Point<3>& place, double t) {
  using Rows = FieldRows<3>;
  const auto wave = [&](int axis, bool sine) {
    const double phase = mode.k(axis) * place[std::size_t(axis)];
    return sine ? std::sin(phase) : std::cos(phase);
  };
  const auto product = [&](bool x, bool y, bool z) { return wave(0, x) * wave(1, y) * wave(2, z); };
  const auto& a = mode.amplitude;
  const double rise = std::sin(mode.omega() * t) / mode.omega();
  if (row < 3)
    return a[std::size_t(row)] * product(row == 0, row == 1, row == 2) * std::cos(mode.omega() * t);
  double divergence = 0;
  for (int axis = 0; axis < 3; ++axis) divergence += a[std::size_t(axis)] * mode.k(axis);
  for (int i = 0; i < 3; ++i) {
    if (row == Rows::normal_stress(i))
      return (rock.lambda() * divergence + 2 * rock.mu() * a[std::size_t(i)] * mode.k(i)) *
             product(false, false, false) * rise;
    for (int j = i + 1; j < 3; ++j)
      if (row == Rows::shear_stress(i, j))
        return -rock.mu() * (a[std::size_t(i)] * mode.k(j) + a[std::size_t(j)] * mode.k(i)) *
               product(i == 0 || j == 0, i == 1 || j == 1, i == 2 || j == 2) * rise;
  }
  return 0;
}

/// Relative error of all fields, stresses over the impedance, after a time the wave takes for 60 m.
double error_after(const Mode& mode, std::int64_t cells, int order, double cfl, int time_order) {
  const double h = side_m / double(cells), end_s = 60 / mode.speed;
  const auto steps = std::int64_t(std::ceil(end_s / (cfl * h / rock.vp)));
  Cube<double> cube(uniform_cube({cells, cells, cells}, h, rock), edges_all_3d(EdgeLaw::mirror), order,
                    end_s / double(steps), time_order);
  const auto each = [&](auto&& what) {
    for (std::int64_t n = 0; n < cube.grid().size(); ++n) {
      const auto at = cube.grid().index(n);
      for (int row = 0; row < FieldRows<3>::count; ++row)
        what(row, at,
             Point<3>{cube.grid().centre(0, at[0]), cube.grid().centre(1, at[1]),
                      cube.grid().centre(2, at[2])});
    }
  };
  each([&](int row, const Index<3>& at, const Point<3>& place) {
    cube(row, at) = value(mode, row, place, 0);
  });
  cube.steps(steps);
  std::vector<double> found, exact;
  each([&](int row, const Index<3>& at, const Point<3>& place) {
    const double unit = row < 3 ? 1 : rock.rho * mode.speed;
    found.push_back(cube(row, at) / unit);
    exact.push_back(value(mode, row, place, end_s) / unit);
  });
  return relative_error(found, exact);
}

// Proves (E3).
TEST(CubeModes, OfPAndSWavesConvergeWithTheSecondOrderOfTheSplitting) {
  for (const auto& mode : {p_mode, s_mode, other_s_mode})
    for (const int order : {5, 7}) {
      const double coarse = error_after(mode, 12, order, 0.9, 2), fine = error_after(mode, 24, order, 0.9, 2);
      EXPECT_GT(observed_order(coarse, fine), 1.9) << "order " << order;
      EXPECT_LT(fine, 0.02) << "order " << order;
    }
}

TEST(CubeModes, ConvergeWithTheOrderOfTheReconstructionWhereTheCourantNumberIsSmall) {
  for (const auto& mode : {p_mode, s_mode}) {
    EXPECT_GT(observed_order(error_after(mode, 24, 1, 0.4, 2), error_after(mode, 48, 1, 0.4, 2)), 0.85);
    EXPECT_GT(observed_order(error_after(mode, 12, 3, 0.05, 2), error_after(mode, 24, 3, 0.05, 2)), 2.8);
  }
}

TEST(CubeModes, ConvergeWithTheFourthOrderInTime) {
  for (const auto& mode : {p_mode, s_mode, other_s_mode}) {
    const double coarse = error_after(mode, 12, 7, 1.8, 4), fine = error_after(mode, 24, 7, 1.8, 4);
    EXPECT_GT(observed_order(coarse, fine), 3.8);
    EXPECT_LT(fine, error_after(mode, 24, 7, 0.9, 2) / 5);
  }
}

}  // namespace
}  // namespace slipwave::solver::cube_modes_test
