// SPDX-License-Identifier: BSD-3-Clause
// Shared by the slip law tests: every correction, scalar type and dimension, on random cells and planes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <type_traits>

#include "fracture_slip_cell.hpp"

namespace slipwave {

template <int D, class Real>
using Matrix = std::array<std::array<Real, D>, D>;

template <int D, class Real>
Stress<D, Real> rotated(const Matrix<D, Real>& r, const Stress<D, Real>& s) {
  Stress<D, Real> out;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      for (int k = 0; k < D; ++k)
        for (int l = 0; l < D; ++l) out(i, j) += r[i][k] * r[j][l] * s(k, l);
  return out;
}

/// A rotation made of plane rotations by random angles.
template <int D>
Matrix<D, double> random_rotation(std::mt19937& random) {
  Matrix<D, double> r{};
  for (int i = 0; i < D; ++i) r[i][i] = 1;
  for (int a = 0; a < D; ++a)
    for (int b = a + 1; b < D; ++b) {
      const double angle = std::uniform_real_distribution<>(0, 6.28)(random);
      for (int k = 0; k < D; ++k) {
        const double x = r[a][k], y = r[b][k];
        r[a][k] = std::cos(angle) * x - std::sin(angle) * y;
        r[b][k] = std::sin(angle) * x + std::cos(angle) * y;
      }
    }
  return r;
}

template <int D, class Real>
Stress<D, Real> random_stress(std::mt19937& random, double size = 1e5) {
  Stress<D, Real> s;
  for (auto& v : s.values) v = Real(std::uniform_real_distribution<>(-size, size)(random));
  return s;
}

template <int D, class Real>
double shear_magnitude(const std::type_identity_t<Traction<D, Real>>& n, const Stress<D, Real>& s) {
  double sum = 0;
  const double s_n = normal_stress<D, Real>(n, s);
  for (int i = 0; i < D; ++i) {
    double tau = -s_n * n[i];
    for (int j = 0; j < D; ++j) tau += double(s(i, j)) * n[j];
    sum += tau * tau;
  }
  return std::sqrt(sum);
}

template <class Correction_, class Real_, int D_>
struct Case {
  using Correction = Correction_;
  using Real = Real_;
  static constexpr int D = D_;
};

template <class Case>
class SlipLaw : public testing::Test {
 public:
  static constexpr int D = Case::D;
  using Real = typename Case::Real;
  using Normal = Traction<D, Real>;
  using Cell = Stress<D, Real>;
  using Memory = typename Case::Correction::template Memory<D, Real>;
  static constexpr double eps = std::numeric_limits<Real>::epsilon();

  std::mt19937 random{7};

  Cell any_stress(double size = 1e5) { return random_stress<D, Real>(random, size); }
  /// A unit vector: a row of a random rotation.
  Normal any_normal() {
    const auto row = random_rotation<D>(random)[0];
    Normal n;
    for (int i = 0; i < D; ++i) n[i] = Real(row[i]);
    return n;
  }
  static Cell after(Cell s, const SlipStrength<Real>& law, const Normal& n, double d, Memory& memory) {
    correct<typename Case::Correction, D, Real>(law, n, d, s, memory);
    return s;
  }
  static Cell after(const Cell& s, const SlipStrength<Real>& law, const Normal& n, double d) {
    Memory memory{};
    return after(s, law, n, d, memory);
  }
  static void expect_near(const Cell& a, const Cell& b, double tolerance) {
    for (int k = 0; k < Cell::components; ++k) EXPECT_NEAR(a.values[k], b.values[k], tolerance) << k;
  }
};

using SlipCases =
    testing::Types<Case<FirstOrder, float, 2>, Case<SecondOrder, float, 2>, Case<Exponential, float, 2>,
                   Case<FirstOrder, double, 2>, Case<SecondOrder, double, 2>, Case<Exponential, double, 2>,
                   Case<FirstOrder, float, 3>, Case<SecondOrder, float, 3>, Case<Exponential, float, 3>,
                   Case<FirstOrder, double, 3>, Case<SecondOrder, double, 3>, Case<Exponential, double, 3>>;

}  // namespace slipwave
