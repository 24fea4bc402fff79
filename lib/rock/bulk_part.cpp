// SPDX-License-Identifier: BSD-3-Clause
#include "rock/bulk_part.hpp"

#include <algorithm>
#include <cmath>

#include "grid/tensor.hpp"

namespace slipwave {

BulkPart bulk_part(const Elasticity<3>& c) {
  const auto over = [](double of, double one, double other) { return of / std::sqrt(one * other); };
  const double a = over(c(2, 3), c(2, 2), c(3, 3)), b = over(c(1, 3), c(1, 1), c(3, 3)),
               d = over(c(1, 2), c(1, 1), c(2, 2));
  // The sums of the rows of the adjugate of ((1, d, b), (d, 1, a), (b, a, 1)), and its determinant.
  const Point<3> rows = {(1 - a * a) + (a * b - d) + (a * d - b), (a * b - d) + (1 - b * b) + (b * d - a),
                         (a * d - b) + (b * d - a) + (1 - d * d)};
  const double sum = rows[0] + rows[1] + rows[2], determinant = 1 + 2 * a * b * d - a * a - b * b - d * d;
  return {std::clamp(determinant / sum, 0., 1.), {rows[0] / sum, rows[1] / sum, rows[2] / sum}};
}

bool BulkTensors::are_turned() const {
  // Less is rounding of right angles.
  constexpr double least = 1e-12;
  const auto any = [](const std::array<double, 6>& tensor) {
    return std::any_of(tensor.begin() + 3, tensor.end(),
                       [](double value) { return std::abs(value) > least; });
  };
  return any(weights) || any(stress);
}

BulkTensors bulk_tensors(const Material& rock) {
  const auto c = upright_elasticity<3>(rock);
  const auto part = bulk_part(c);
  const auto axes = axes_of<3>(rock);
  const Point<3> stretch = {std::sqrt(c(1, 1) / c(3, 3)), std::sqrt(c(2, 2) / c(3, 3)), 1};
  BulkTensors tensors{{}, {}};
  using Tensor = SymmetricTensor<3, double>;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double weight = 0, stress = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double both = axes[a][std::size_t(i)] * axes[a][std::size_t(j)];
        weight += part.weights[a] / stretch[a] * both, stress += stretch[a] * both;
      }
      tensors.weights[std::size_t(Tensor::place(i, j))] = (i == j ? 1 : 2) * weight;
      tensors.stress[std::size_t(Tensor::place(i, j))] = stress;
    }
  return tensors;
}

}  // namespace slipwave
