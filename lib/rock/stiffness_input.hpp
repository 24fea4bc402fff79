// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "rock/averaging.hpp"

namespace slipwave {

/// Stiffnesses that users give instead of speeds and parameters, by their place; Pa.
enum class Modulus : std::size_t {
  c11,
  c13,
  c33,
  c55,
  c15,
  c35,
  c66,
  c22,
  c44,
  c12,
  c23,
  c14,
  c16,
  c24,
  c25,
  c26,
  c34,
  c36,
  c45,
  c46,
  c56
};
inline constexpr std::size_t modulus_count = 21;
/// "c11" and so on, in that order.
const std::array<std::string, modulus_count>& modulus_names();
/// How one is described to users, and read from files.
PropertyRow row_of(Modulus modulus);

/// The moduli that are given of a rock, in Pa.
struct GivenStiffness {
  std::array<std::optional<double>, modulus_count> moduli;

  std::optional<double>& operator[](Modulus of) { return moduli[std::size_t(of)]; }
  const std::optional<double>& operator[](Modulus of) const { return moduli[std::size_t(of)]; }
  bool any() const;
  /// Throws a usage Error unless they are of one kind: c11, c13, c33 and c55 always; c66, too, in 3-D; c22,
  /// c44, c12 and c23, too, of orthorhombic rock; c15 and c35, too, of any rock of a plane; c14 to c56 beside
  /// those of orthorhombic rock, of any rock.
  void check_kind() const;
  /// Whether they may be those of rock whose axes are not those of the grid.
  bool are_of_any_rock() const;
};

/// What no rock has: the modulus, and what follows its place in an error: "is 9e9 Pa, expected ...".
struct StiffnessFault {
  Modulus of;
  std::string text;
};
/// What keeps strains from costing energy or, unless they may be those of any rock, waves from being those of
/// speeds and Thomsen's and Tsvankin's parameters; nothing where all is well.
std::optional<StiffnessFault> fault_of_stiffness(const GivenStiffness& given);

/// The rock of moduli without fault and a density in kg/m3: a fluid where c55 is 0. Differences as small as
/// the rounding of floats are none. Rock has elastic constants where no parameters give them: in a plane a
/// tilted axis of symmetry within 0.1 % of c33, in space axes along the grid.
Material material_of_given(const GivenStiffness& given, double rho);

/// A medium of moduli, each of all cells where it is given, and densities (0: void). Throws an Error naming
/// the first cell at fault.
template <int D>
Medium<D> medium_of_stiffness(const std::array<std::optional<Field<D>>, modulus_count>& given,
                              const Field<D>& rho);

}  // namespace slipwave
