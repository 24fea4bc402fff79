// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace slipwave {

/// Square matrices of a few rows, row by row, for what is computed once for a medium, a face or an axis
/// (docs/decisions.md says why this is not Eigen).
template <std::size_t N, class Number = double>
using SmallMatrix = std::array<std::array<Number, N>, N>;

template <std::size_t N, class Number>
Number dot_product(const std::array<Number, N>& a, const std::array<Number, N>& b) {
  Number sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}
/// Divided by its length.
template <std::size_t N>
std::array<double, N> normalized(std::array<double, N> vector) {
  const double length = std::sqrt(dot_product(vector, vector));
  for (auto& component : vector) component /= length;
  return vector;
}

/// Unit vector along one of the axes.
template <std::size_t N>
constexpr std::array<double, N> unit_vector(std::size_t axis) {
  std::array<double, N> unit{};
  unit[axis] = 1;
  return unit;
}

template <std::size_t N, class Number>
SmallMatrix<N, Number> transposed(const SmallMatrix<N, Number>& m) {
  SmallMatrix<N, Number> of;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) of[k][i] = m[i][k];
  return of;
}

template <std::size_t N, class Number>
std::array<Number, N> product_of(const SmallMatrix<N, Number>& m, const std::array<Number, N>& x) {
  std::array<Number, N> product;
  for (std::size_t i = 0; i < N; ++i) product[i] = dot_product(m[i], x);
  return product;
}
template <std::size_t N, class Number>
SmallMatrix<N, Number> product_of(const SmallMatrix<N, Number>& one, const SmallMatrix<N, Number>& other) {
  const auto columns = transposed(other);
  SmallMatrix<N, Number> product;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) product[i][k] = dot_product(one[i], columns[k]);
  return product;
}

template <std::size_t N, class Number>
SmallMatrix<N, Number> times(SmallMatrix<N, Number> m, Number factor) {
  for (auto& row : m)
    for (auto& value : row) value *= factor;
  return m;
}
/// one + factor other.
template <std::size_t N, class Number>
SmallMatrix<N, Number> sum_of(SmallMatrix<N, Number> one, const SmallMatrix<N, Number>& other,
                              Number factor = 1) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) one[i][k] += factor * other[i][k];
  return one;
}

/// x of m x = right, by Gauss's elimination with pivots.
template <std::size_t N, class Number>
std::array<Number, N> solved(SmallMatrix<N, Number> m, std::array<Number, N> right) {
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < N; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    std::swap(m[k], m[pivot]), std::swap(right[k], right[pivot]);
    for (std::size_t i = k + 1; i < N; ++i) {
      const Number factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < N; ++j) m[i][j] -= factor * m[k][j];
      right[i] -= factor * right[k];
    }
  }
  for (std::size_t k = N; k-- > 0;) {
    for (std::size_t j = k + 1; j < N; ++j) right[k] -= m[k][j] * right[j];
    right[k] /= m[k][k];
  }
  return right;
}

/// The inverse of a symmetric matrix.
template <std::size_t N>
SmallMatrix<N> inverse_of(const SmallMatrix<N>& m) {
  SmallMatrix<N> inverse;
  for (std::size_t k = 0; k < N; ++k) inverse[k] = solved(m, unit_vector<N>(k));
  return inverse;
}

/// The first pivot of Gauss's elimination of a symmetric matrix that is not positive.
struct Pivot {
  std::size_t row;
  double value;
};
template <std::size_t N>
std::optional<Pivot> first_pivot_not_positive(SmallMatrix<N> m) {
  for (std::size_t k = 0; k < N; ++k) {
    if (!(m[k][k] > 0)) return Pivot{k, m[k][k]};
    for (std::size_t i = k + 1; i < N; ++i)
      for (std::size_t j = k + 1; j < N; ++j) m[i][j] -= m[i][k] * m[k][j] / m[k][k];
  }
  return {};
}
/// Whether a symmetric matrix is positive definite: its pivots are.
template <std::size_t N>
bool is_positive(const SmallMatrix<N>& m) {
  return !first_pivot_not_positive(m);
}

/// Eigenvalues of a symmetric matrix, falling, and their unit eigenvectors.
template <std::size_t N>
struct Eigensystem {
  std::array<double, N> values{};
  SmallMatrix<N> vectors{};  // row by row
};

/// By Jacobi's rotations, which converge quadratically and keep eigenvectors at right angles where
/// eigenvalues are near each other.
template <std::size_t N>
Eigensystem<N> eigensystem_of(SmallMatrix<N> m) {
  Eigensystem<N> of;
  for (std::size_t i = 0; i < N; ++i) of.vectors[i][i] = 1;
  const auto rotate = [](double cosine, double sine, double& one, double& other) {
    const double before = one;
    one = cosine * before - sine * other, other = sine * before + cosine * other;
  };
  constexpr int most_sweeps = 8;
  bool diagonal = false;
  for (int sweep = 0; sweep < most_sweeps && !diagonal; ++sweep) {
    diagonal = true;
    for (std::size_t p = 0; p < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) {
        if (m[p][q] == 0) continue;
        diagonal = false;
        const double half = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double tangent = (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
        const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
        for (std::size_t i = 0; i < N; ++i) rotate(cosine, sine, m[i][p], m[i][q]);
        for (std::size_t i = 0; i < N; ++i) rotate(cosine, sine, m[p][i], m[q][i]);
        for (std::size_t i = 0; i < N; ++i) rotate(cosine, sine, of.vectors[p][i], of.vectors[q][i]);
        m[p][q] = m[q][p] = 0;
      }
  }
  for (std::size_t i = 0; i < N; ++i) of.values[i] = m[i][i];
  for (std::size_t i = 1; i < N; ++i)
    for (std::size_t k = i; k > 0 && of.values[k - 1] < of.values[k]; --k)
      std::swap(of.values[k - 1], of.values[k]), std::swap(of.vectors[k - 1], of.vectors[k]);
  return of;
}

/// The root of a symmetric matrix none of whose eigenvalues is below zero; those that rounding leaves of zero
/// count as zero.
template <std::size_t N>
SmallMatrix<N> square_root_of(const SmallMatrix<N>& m) {
  constexpr double rounding = 1e-12;
  const auto [values, vectors] = eigensystem_of(m);
  SmallMatrix<N> root{};
  for (std::size_t n = 0; n < N; ++n) {
    if (!(values[n] > rounding * values[0])) continue;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < N; ++k) root[i][k] += std::sqrt(values[n]) * vectors[n][i] * vectors[n][k];
  }
  return root;
}

}  // namespace slipwave
