// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/slip_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/instantiate.hpp"
#include "grid/tensor.hpp"
#include "model/fracture.hpp"

namespace slipwave::solver {
namespace {

/// Weights of the components of a stress in s_n.
template <int D, class Real>
void put_normal(const Point<D>& n, Real* weights) {
  using Tensor = SymmetricTensor<D, double>;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = i; j < D; ++j)
      weights[Tensor::place(int(i), int(j))] = Real((i == j ? 1 : 2) * n[i] * n[j]);
}

/// n m + m n.
template <int D, class Real>
void put_shear(const Point<D>& n, const Point<D>& m, Real* weights) {
  using Tensor = SymmetricTensor<D, double>;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = i; j < D; ++j)
      weights[Tensor::place(int(i), int(j))] = Real(n[i] * m[j] + n[j] * m[i]);
}

}  // namespace

template <int D>
std::array<Point<D>, std::size_t(D - 1)> tangents_of(const Point<D>& n) {
  if constexpr (D == 2) {
    return {{{-n[1], n[0]}}};
  } else {
    // The axis that lies flattest in the planes, less its component along n; then their product.
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(n[i]) < std::abs(n[axis])) axis = i;
    Point<3> a{}, b{};
    const double size = std::sqrt(1 - n[axis] * n[axis]);
    for (std::size_t i = 0; i < 3; ++i) a[i] = ((i == axis) - n[axis] * n[i]) / size;
    for (std::size_t i = 0; i < 3; ++i)
      b[i] = n[(i + 1) % 3] * a[(i + 2) % 3] - n[(i + 2) % 3] * a[(i + 1) % 3];
    return {{a, b}};
  }
}

template <int D, class Real>
SlipPlanes<Real> planes_of(const std::vector<SlipSystem<D>>& systems, double unit) {
  SlipPlanes<Real> planes{};
  for (std::size_t n = 0; n < systems.size() && n < SlipPlanes<Real>::most_systems; ++n) {
    put_normal<D>(unit_normal<D>(systems[n].normal), planes.normal[n]);
    planes.law[n] = constants_of<D, Real>(systems[n], unit);
  }
  const auto normal = unit_normal<D>(systems[0].normal);
  const auto tangents = tangents_of<D>(normal);
  for (std::size_t t = 0; t < tangents.size(); ++t) put_shear<D>(normal, tangents[t], planes.shear[t]);
  return planes;
}

template <int D>
CellCompliance compliance_of(const SlipSystem<D>& system, bool below_friction, double lambda, double mu) {
  const double most = below_friction ? 1e3 : slip::most_compliance;
  return slip::bounded(compliance_in(system.compliance, lambda, mu), lambda, mu, most);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, tangents_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, compliance_of);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, planes_of);

}  // namespace slipwave::solver
