// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "grid/field.hpp"

namespace slipwave {

/// Derivative of a field along an axis, per metre: central differences of fourth order, of second order and
/// one-sided towards the edges of the grid. In a fitted grid along true x, y and z. For pictures; across
/// interfaces it contains the jump.
template <int D>
Field<D> derivative(const Field<D>& field, int axis);

/// d v_i/d x_i.
template <int D>
Field<D> divergence(const std::array<Field<D>, std::size_t(D)>& velocity);

/// dvx/dz - dvz/dx.
Field<2> curl(const std::array<Field<2>, 2>& velocity);
/// x, y and z component.
std::array<Field<3>, 3> curl(const std::array<Field<3>, 3>& velocity);

}  // namespace slipwave
