// SPDX-License-Identifier: BSD-3-Clause
#include "base/small_matrix.hpp"

#include <gtest/gtest.h>

#include <random>

namespace slipwave::base_small_matrix_test {
namespace {

/// A matrix of random numbers and, of it, one that is symmetric and positive.
template <std::size_t N>
SmallMatrix<N> random_matrix(std::mt19937& engine) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  SmallMatrix<N> m;
  for (auto& row : m)
    for (double& value : row) value = uniform(engine);
  return m;
}
template <std::size_t N>
SmallMatrix<N> positive_matrix(std::mt19937& engine) {
  const auto m = random_matrix<N>(engine);
  return product_of(m, transposed(m));
}

template <std::size_t N>
void expect_near(const SmallMatrix<N>& one, const SmallMatrix<N>& other, double most) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) EXPECT_NEAR(one[i][k], other[i][k], most) << i << k;
}

template <std::size_t N>
SmallMatrix<N> unit_matrix() {
  SmallMatrix<N> unit;
  for (std::size_t i = 0; i < N; ++i) unit[i] = unit_vector<N>(i);
  return unit;
}

template <std::size_t N>
void expect_eigensystem(const SmallMatrix<N>& m) {
  const auto [values, vectors] = eigensystem_of(m);
  SmallMatrix<N> sum{};
  for (std::size_t n = 0; n < N; ++n) {
    if (n > 0) {
      EXPECT_GE(values[n - 1], values[n]);
    }
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < N; ++k) sum[i][k] += values[n] * vectors[n][i] * vectors[n][k];
  }
  expect_near(sum, m, 1e-13);
  expect_near(product_of(vectors, transposed(vectors)), unit_matrix<N>(), 1e-14);
}

TEST(SmallMatrix, IsTheSumOfItsEigenvectors) {
  std::mt19937 engine(3);
  for (int n = 0; n < 50; ++n) {
    expect_eigensystem(positive_matrix<2>(engine));
    expect_eigensystem(positive_matrix<3>(engine));
    expect_eigensystem(positive_matrix<6>(engine));
  }
  // Eigenvalues that are alike, or nearly so.
  expect_eigensystem(unit_matrix<3>());
  expect_eigensystem<3>({{{2, 1e-9, 0}, {1e-9, 2, 1e-12}, {0, 1e-12, 5}}});
}

TEST(SmallMatrix, HasARootWhoseSquareItIs) {
  std::mt19937 engine(4);
  for (int n = 0; n < 50; ++n) {
    const auto m = positive_matrix<3>(engine);
    const auto root = square_root_of(m);
    expect_near(product_of(root, root), m, 1e-13);
  }
  // Of a fluid, whose shear is zero, as far as numbers go.
  EXPECT_EQ(square_root_of<2>({{{4, 0}, {0, 1e-16}}}), (SmallMatrix<2>{{{2, 0}, {0, 0}}}));
}

TEST(SmallMatrix, SolvesWhatItsProductIs) {
  std::mt19937 engine(5);
  for (int n = 0; n < 50; ++n) {
    const auto m = random_matrix<6>(engine);
    const auto x = random_matrix<6>(engine)[0], found = solved(m, product_of(m, x));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], x[i], 1e-10);
    const auto positive = positive_matrix<3>(engine);
    expect_near(product_of(positive, inverse_of(positive)), unit_matrix<3>(), 1e-7);
  }
  // Its first pivot is zero.
  EXPECT_EQ((solved<2, double>({{{0, 1}, {2, 0}}}, {3, 4})), (std::array<double, 2>{2, 3}));
}

TEST(SmallMatrix, IsPositiveWhereAllEigenvaluesAre) {
  std::mt19937 engine(6);
  for (int n = 0; n < 100; ++n) {
    const auto m = random_matrix<3>(engine), symmetric = sum_of(m, transposed(m));
    EXPECT_EQ(is_positive(symmetric), eigensystem_of(symmetric).values[2] > 0);
  }
}

}  // namespace
}  // namespace slipwave::base_small_matrix_test
