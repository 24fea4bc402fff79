// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "grid/tensor.hpp"
#include "model/model.hpp"

namespace slipwave {

/// Stress of the weight above (theory.md S15): s_zz = -g times the mass above the cell's centre on a unit
/// area, the horizontal stresses k0 times that, no shear. Without k0 as in rock that never gave way sideways,
/// lambda/(lambda + 2 mu) cell by cell.
struct Lithostatic {
  std::optional<double> k0;
};

/// What the prestress of cells is made from: none, the weight above, or one tensor, Pa, tension positive.
template <int D>
using Prestress = std::variant<std::monostate, Lithostatic, SymmetricTensor<D, double>>;

/// "none", "lithostatic", "lithostatic:K0", "P" (a pressure, Pa) or "SXX,SZZ,SXZ" (3-D:
/// "SXX,SYY,SZZ,SXY,SXZ,SYZ"), Pa. Throws a usage Error.
template <int D>
Prestress<D> parse_prestress(const std::string& text);

/// "sxx", "szz", "sxz" (3-D: "sxx", "syy", "szz", "sxy", "sxz", "syz"): the components of a stress in the
/// order of SymmetricTensor.
template <int D>
const std::vector<std::string>& stress_names();
template <>
const std::vector<std::string>& stress_names<2>();
template <>
const std::vector<std::string>& stress_names<3>();

/// Gives the cells of fracture set `code` (1-based) their prestress; of one on faces the cells on both sides
/// of these that belong to no other set.
template <int D>
void set_prestress(Model<D>& model, std::size_t code, const Prestress<D>& prestress);

/// Throws an Error on the first fractured cell, or face with friction, whose prestress is not finite, or
/// slips (shear traction above the strength (S2)) or parts (s_n > 0 where planes open) by itself.
template <int D>
void check_prestress(const Model<D>& model);

}  // namespace slipwave
