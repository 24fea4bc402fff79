// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/small_matrix.hpp"
#include "grid/grid.hpp"
#include "grid/tensor.hpp"
#include "rock/averaging.hpp"

namespace slipwave {

/// Stiffnesses of a rock along the axes of the grid, Pa: of strains and stresses in D dimensions, in 2-D
/// those of the plane of x and z.
template <int D>
struct Elasticity {
  static constexpr std::size_t components = std::size_t(D * (D + 1) / 2);
  /// By Voigt's pairs xx, yy, zz, yz, xz, xy, in 2-D xx, zz, xz. Symmetric.
  SmallMatrix<components> voigt{};

  bool operator==(const Elasticity&) const = default;
  /// Voigt's pair of two axes, counted from 0.
  static constexpr std::size_t pair(int one, int other) {
    return std::size_t(one == other ? one : 3 * (D - 1) - one - other);
  }
  /// C_ijkl, axes from 0.
  double operator()(int i, int j, int k, int l) const { return voigt[pair(i, j)][pair(k, l)]; }
  /// C_mn by Voigt's numbers from 1 to 6, in 2-D 1, 3 and 5.
  double operator()(int m, int n) const { return voigt[place(m)][place(n)]; }
  void set(int m, int n, double value) { voigt[place(m)][place(n)] = voigt[place(n)][place(m)] = value; }
  /// What orthorhombic rock along the grid has of it: no normal strain loads a shear stress, and no shear
  /// strain another.
  Elasticity along_grid() const;
  Elasticity times(double factor) const { return {slipwave::times(voigt, factor)}; }

 private:
  static constexpr std::size_t place(int number) {
    return std::size_t(D == 3 ? number - 1 : (number - 1) / 2);
  }
};

/// The axes 1, 2 and 3 of a rock, in 2-D 1 and 3: unit vectors.
template <int D>
using RockAxes = std::array<Point<D>, std::size_t(D)>;
template <int D>
RockAxes<D> axes_of(const Material& material);  // from tilt, azimuth and rotation (theory.md (T2), (O6))
template <>
RockAxes<2> axes_of<2>(const Material& material);
template <>
RockAxes<3> axes_of<3>(const Material& material);

template <int D>
Elasticity<D> isotropic(double p_modulus, double mu);
/// Rock that is alike about the vertical, in the plane of x and z.
Elasticity<2> vertical_symmetry(double c11, double c13, double c33, double c55);
/// Rock whose axes of symmetry lie along the grid: c11, c22, c33, c44, c55, c66, c12, c13, c23.
Elasticity<3> orthorhombic(const std::array<double, 9>& moduli);

/// The elasticity of elastic constants; in 2-D that of the plane of x and z.
template <int D>
Elasticity<D> elasticity_of_constants(const ElasticConstants& constants);
/// The rock of any stiffness along the axes of the grid.
template <int D>
Material rock_of_constants(const Elasticity<D>& elasticity, double rho);

/// A constant on the diagonal of a stiffness, by Voigt's number, and what it must be above, Pa.
struct SoftConstant {
  int number;
  double least;
};
/// The first constant that is too small beside those before it, so that some strain costs no energy; nothing
/// where all strains do.
template <int D>
std::optional<SoftConstant> soft_constant(const Elasticity<D>& elasticity);

/// A rock about its own axes, from speeds and the parameters of Thomsen and Tsvankin (theory.md (V2), (O2)).
/// NaN where these leave none. Elastic constants are along the axes of the grid.
template <int D>
Elasticity<D> upright_elasticity(const Material& material);
template <>
Elasticity<2> upright_elasticity<2>(const Material& material);
template <>
Elasticity<3> upright_elasticity<3>(const Material& material);
/// Returns the elasticity in the axes of the grid of a rock whose own axes lie there as the material says.
template <int D>
Elasticity<D> elasticity_of(const Material& material);
/// A rock whose own axes, along which it has this elasticity, are these.
template <int D>
Elasticity<D> turned(const Elasticity<D>& upright, const RockAxes<D>& axes);

/// The rock of these stiffnesses, which are those of a rock along the grid; in 3-D c12 + c66, c13 + c55 and
/// c23 + c44 must not be negative.
Material material_of(const Elasticity<2>& elasticity, double rho);
Material material_of(const Elasticity<3>& elasticity, double rho);

/// The matrix n_j C_ijkl e_l of i and k: tractions on planes with the vector n by velocity gradients along e.
template <int D>
SmallMatrix<std::size_t(D)> tractions(const Elasticity<D>& elasticity, const Point<D>& n, const Point<D>& e);
/// Returns the Christoffel matrix, n_j C_ijkl n_l (theory.md (V3), (O3)).
template <int D>
SmallMatrix<std::size_t(D)> christoffel(const Elasticity<D>& elasticity, const Point<D>& n) {
  return tractions<D>(elasticity, n, n);
}
/// The plane waves whose fronts move along a unit vector: moduli rho c^2, falling, and motions.
template <int D>
Eigensystem<std::size_t(D)> waves_along(const Elasticity<D>& elasticity, const Point<D>& direction) {
  return eigensystem_of(christoffel<D>(elasticity, direction));
}
/// Their speeds, m/s, from the fastest to the slowest.
template <int D>
Point<D> phase_speeds(const Elasticity<D>& elasticity, double rho, const Point<D>& direction);
/// Unit vectors to half of all directions, the others of which are their opposites.
template <int D>
const std::vector<Point<D>>& half_of_all_directions();
/// Backward group velocity along an axis, counted from 0: the largest share of its phase speed at which
/// energy moves back along the axis while the front of the wave moves on along it, -k_a g_a/omega (theory.md
/// (V6)); 0 where none does, as in any isotropic rock.
template <int D>
double backward_group_velocity(const Elasticity<D>& elasticity, int axis);

/// Hooke's law. Stress and strain are as SymmetricTensor has them, shear strains doubled.
template <int D>
using TensorValues = std::array<double, Elasticity<D>::components>;
template <int D>
TensorValues<D> stress_of_strain(const Elasticity<D>& elasticity, const TensorValues<D>& strain);
template <int D>
TensorValues<D> strain_of_stress(const Elasticity<D>& elasticity, const TensorValues<D>& stress);
/// s:C^-1:s of a stress: twice the elastic energy of a volume, Pa.
template <int D>
double complementary(const Elasticity<D>& elasticity, const TensorValues<D>& stress) {
  return dot_product(stress, strain_of_stress<D>(elasticity, stress));
}

}  // namespace slipwave
