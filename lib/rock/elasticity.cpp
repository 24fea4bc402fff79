// SPDX-License-Identifier: BSD-3-Clause
#include "rock/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Directions of half a circle, and of half a sphere, among which backward group velocities are searched.
constexpr int half_circle = 360, rings = 16, around = 64;
/// How close to the best direction that search comes, radians: the largest share is flat there.
constexpr double direction_tolerance = 1e-6;
/// Less is rounding.
constexpr double least_orthorhombic = 1e-9, least_backward = 1e-9;

/// The mixed stiffness: (c_ab + c_shear)^2 = (c_aa - c_shear) (c_aa - c_shear + 2 delta c_aa).
double mixed_stiffness(double normal, double shear, double delta) {
  const double apart = normal - shear;
  return std::sqrt(apart * (apart + 2 * delta * normal)) - shear;
}
double delta_of(double normal, double shear, double mixed) {
  const double sum = mixed + shear, apart = normal - shear;
  return (sum * sum - apart * apart) / (2 * normal * apart);
}

/// Voigt's pair of a component of SymmetricTensor, and back.
template <int D>
std::size_t exchanged(std::size_t component) {
  return D == 2 || component < 3 ? component : 8 - component;
}

template <int D>
std::vector<Point<D>> make_half_of_all_directions() {
  std::vector<Point<D>> all;
  if constexpr (D == 2) {
    for (int n = 0; n < half_circle; ++n) {
      const double angle = n * std::numbers::pi / half_circle;
      all.push_back({std::sin(angle), std::cos(angle)});
    }
  } else {
    // The last ring is as close to the horizontal as in 2-D: there tilted rock has waves that turn.
    for (int ring = 0; ring <= rings + 1; ++ring)
      for (int k = 0; k < (ring == 0 ? 1 : around); ++k) {
        const double angle = ring <= rings ? ring * std::numbers::pi / 2 / rings
                                           : std::numbers::pi / 2 - std::numbers::pi / half_circle,
                     about = k * 2 * std::numbers::pi / around;
        all.push_back(
            {std::sin(angle) * std::cos(about), std::sin(angle) * std::sin(about), std::cos(angle)});
      }
  }
  return all;
}

}  // namespace

template <int D>
Elasticity<D> Elasticity<D>::along_grid() const {
  auto of = *this;
  for (std::size_t i = 0; i < components; ++i)
    for (std::size_t j = D; j < components; ++j)
      if (i != j) of.voigt[i][j] = of.voigt[j][i] = 0;
  return of;
}

template <int D>
const std::vector<Point<D>>& half_of_all_directions() {
  static const auto all = make_half_of_all_directions<D>();
  return all;
}

template <>
RockAxes<2> axes_of<2>(const Material& material) {
  const double c = std::cos(material.tilt * degree), s = std::sin(material.tilt * degree);
  return {{{c, s}, {-s, c}}};
}

template <>
RockAxes<3> axes_of<3>(const Material& material) {
  const auto cosine = [](double degrees) { return std::cos(degrees * degree); };
  const auto sine = [](double degrees) { return std::sin(degrees * degree); };
  const double ct = cosine(material.tilt), st = sine(material.tilt);
  const double ca = cosine(material.azimuth), sa = sine(material.azimuth);
  const double cr = cosine(material.rotation), sr = sine(material.rotation);
  const Point<3> down_dip = {ca * ct, sa * ct, st}, strike = {-sa, ca, 0};
  RockAxes<3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[0][i] = cr * down_dip[i] + sr * strike[i];
    axes[1][i] = cr * strike[i] - sr * down_dip[i];
  }
  axes[2] = {-ca * st, -sa * st, ct};
  return axes;
}

template <int D>
Elasticity<D> isotropic(double p_modulus, double mu) {
  Elasticity<D> of;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) of.voigt[i][j] = i == j ? p_modulus : p_modulus - 2 * mu;
  for (std::size_t i = D; i < of.components; ++i) of.voigt[i][i] = mu;
  return of;
}

Elasticity<2> vertical_symmetry(double c11, double c13, double c33, double c55) {
  return {{{{c11, c13, 0}, {c13, c33, 0}, {0, 0, c55}}}};
}

Elasticity<3> orthorhombic(const std::array<double, 9>& moduli) {
  const auto& [c11, c22, c33, c44, c55, c66, c12, c13, c23] = moduli;
  return {{{{c11, c12, c13, 0, 0, 0},
            {c12, c22, c23, 0, 0, 0},
            {c13, c23, c33, 0, 0, 0},
            {0, 0, 0, c44, 0, 0},
            {0, 0, 0, 0, c55, 0},
            {0, 0, 0, 0, 0, c66}}}};
}

template <int D>
Elasticity<D> elasticity_of_constants(const ElasticConstants& constants) {
  Elasticity<D> of;
  constexpr int step = D == 3 ? 1 : 2;
  for (int m = 1; m <= 6; m += step)
    for (int n = m; n <= 6; n += step) of.set(m, n, constants[place_of_constant(m, n)]);
  return of;
}

template <int D>
Material rock_of_constants(const Elasticity<D>& c, double rho) {
  ElasticConstants constants{};
  constexpr int step = D == 3 ? 1 : 2;
  for (int m = 1; m <= 6; m += step)
    for (int n = m; n <= 6; n += step) constants[place_of_constant(m, n)] = c(m, n);
  return {.vp = std::sqrt(c(3, 3) / rho),
          .vs = std::sqrt(c(5, 5) / rho),
          .rho = rho,
          .constants = ConstantsIfAny(constants)};
}

template <int D>
std::optional<SoftConstant> soft_constant(const Elasticity<D>& elasticity) {
  const auto pivot = first_pivot_not_positive(elasticity.voigt);
  if (!pivot) return {};
  const int number = D == 3 ? int(pivot->row) + 1 : 2 * int(pivot->row) + 1;
  return SoftConstant{number, elasticity(number, number) - pivot->value};
}

template <>
Elasticity<2> upright_elasticity<2>(const Material& material) {
  if (material.constants) return elasticity_of_constants<2>(*material.constants);
  const double c33 = material.rho * material.vp * material.vp, c55 = material.rho * material.vs * material.vs;
  if (!material.is_anisotropic()) return vertical_symmetry(c33, c33 - 2 * c55, c33, c55);
  return vertical_symmetry(c33 * (1 + 2 * material.epsilon), mixed_stiffness(c33, c55, material.delta), c33,
                           c55);
}

template <>
Elasticity<3> upright_elasticity<3>(const Material& material) {
  if (material.constants) return elasticity_of_constants<3>(*material.constants);
  const auto plane = upright_elasticity<2>(material);
  const double c11 = plane(1, 1), c13 = plane(1, 3), c33 = plane(3, 3), c55 = plane(5, 5),
               c66 = c55 * (1 + 2 * material.gamma);
  if (!material.orthorhombic) return orthorhombic({c11, c11, c33, c55, c55, c66, c11 - 2 * c66, c13, c13});
  const auto& [epsilon1, delta1, delta3, gamma2] = *material.orthorhombic;
  const double c44 = c66 / (1 + 2 * gamma2);
  return orthorhombic({c11, c33 * (1 + 2 * epsilon1), c33, c44, c55, c66, mixed_stiffness(c11, c66, delta3),
                       c13, mixed_stiffness(c33, c44, delta1)});
}

template <int D>
Elasticity<D> elasticity_of(const Material& material) {
  return turned<D>(upright_elasticity<D>(material), axes_of<D>(material));
}

template <int D>
Elasticity<D> turned(const Elasticity<D>& upright, const RockAxes<D>& axes) {
  constexpr auto size = Elasticity<D>::components;
  // Bond's matrix of stresses: sigma_ij = sum of a_ki a_lj sigma_kl.
  SmallMatrix<size> bond{};
  const auto a = [&](int axis, int component) { return axes[std::size_t(axis)][std::size_t(component)]; };
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      for (int k = 0; k < D; ++k)
        for (int l = k; l < D; ++l)
          bond[Elasticity<D>::pair(i, j)][Elasticity<D>::pair(k, l)] =
              k == l ? a(k, i) * a(k, j) : a(k, i) * a(l, j) + a(l, i) * a(k, j);
  Elasticity<D> of{product_of(product_of(bond, upright.voigt), transposed(bond))};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j) of.voigt[i][j] = of.voigt[j][i];
  return of;
}

Material material_of(const Elasticity<2>& c, double rho) {
  return {std::sqrt(c(3, 3) / rho), std::sqrt(c(5, 5) / rho), rho, (c(1, 1) / c(3, 3) - 1) / 2,
          delta_of(c(3, 3), c(5, 5), c(1, 3))};
}

Material material_of(const Elasticity<3>& c, double rho) {
  auto material = material_of(vertical_symmetry(c(1, 1), c(1, 3), c(3, 3), c(5, 5)), rho);
  material.gamma = (c(6, 6) / c(5, 5) - 1) / 2;
  const Orthorhombic of = {(c(2, 2) / c(3, 3) - 1) / 2, delta_of(c(3, 3), c(4, 4), c(2, 3)),
                           delta_of(c(1, 1), c(6, 6), c(1, 2)), (c(6, 6) / c(4, 4) - 1) / 2};
  const auto apart = {of.epsilon1 - material.epsilon, of.delta1 - material.delta, of.delta3,
                      of.gamma2 - material.gamma};
  if (std::any_of(apart.begin(), apart.end(),
                  [](double value) { return std::abs(value) > least_orthorhombic; }))
    material.orthorhombic = of;
  return material;
}

template <int D>
SmallMatrix<std::size_t(D)> tractions(const Elasticity<D>& c, const Point<D>& n, const Point<D>& e) {
  SmallMatrix<std::size_t(D)> of{};
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k)
      for (int j = 0; j < D; ++j)
        for (int l = 0; l < D; ++l)
          of[std::size_t(i)][std::size_t(k)] += c(i, j, k, l) * n[std::size_t(j)] * e[std::size_t(l)];
  return of;
}

template <int D>
Point<D> phase_speeds(const Elasticity<D>& elasticity, double rho, const Point<D>& direction) {
  auto speeds = waves_along<D>(elasticity, direction).values;
  for (auto& speed : speeds) speed = std::sqrt(std::max(speed, 0.) / rho);
  return speeds;
}

namespace {

/// The group velocity of the plane waves in a direction, backward along an axis, as a share of their phase
/// speed: the largest of all of them.
template <int D>
double backward_share(const Elasticity<D>& elasticity, std::size_t axis, const Point<D>& direction) {
  const auto waves = waves_along<D>(elasticity, direction);
  const auto load = tractions<D>(elasticity, unit_vector<std::size_t(D)>(axis), direction);
  double most = 0;
  for (std::size_t wave = 0; wave < D; ++wave) {
    // The group velocity along the axis times the phase speed and the density.
    const double group = dot_product(waves.vectors[wave], product_of(load, waves.vectors[wave]));
    most = std::max(most, -direction[axis] * group / waves.values[wave]);
  }
  return most;
}

}  // namespace

template <int D>
double backward_group_velocity(const Elasticity<D>& elasticity, int axis) {
  const auto share = [&](const Point<D>& direction) {
    return backward_share<D>(elasticity, std::size_t(axis), direction);
  };
  double most = 0;
  Point<D> best{};
  const auto keep_larger = [&](const Point<D>& direction) {
    const double found = share(direction);
    if (found <= most) return false;
    most = found, best = direction;
    return true;
  };
  // About this axis: waves across it, whose directions lie closest together there, may turn.
  for (const auto& about_last : half_of_all_directions<D>()) {
    Point<D> direction;
    for (std::size_t n = 0; n < D; ++n) direction[(std::size_t(axis) + 1 + n) % D] = about_last[n];
    keep_larger(direction);
  }
  if (most < least_backward) return 0;
  // From the best of these uphill: else rock in a plane and in space would differ by what lies between them.
  for (double step = std::numbers::pi / (2 * rings); step > direction_tolerance;) {
    bool rose = false;
    for (std::size_t a = 0; a < D; ++a)
      for (const double way : {step, -step}) {
        auto beside = best;
        beside[a] += way;
        rose = keep_larger(normalized(beside)) || rose;
      }
    if (!rose) step /= 2;
  }
  return most;
}

template <int D>
TensorValues<D> stress_of_strain(const Elasticity<D>& elasticity, const TensorValues<D>& strain) {
  TensorValues<D> stress{};
  for (std::size_t i = 0; i < stress.size(); ++i)
    for (std::size_t j = 0; j < stress.size(); ++j)
      stress[exchanged<D>(i)] += elasticity.voigt[i][j] * strain[exchanged<D>(j)];
  return stress;
}

template <int D>
TensorValues<D> strain_of_stress(const Elasticity<D>& elasticity, const TensorValues<D>& stress) {
  TensorValues<D> ordered, strain;
  for (std::size_t i = 0; i < stress.size(); ++i) ordered[i] = stress[exchanged<D>(i)];
  ordered = solved(elasticity.voigt, ordered);
  for (std::size_t i = 0; i < stress.size(); ++i) strain[exchanged<D>(i)] = ordered[i];
  return strain;
}

SLIPWAVE_INSTANTIATE_D(TYPE, struct Elasticity);
SLIPWAVE_INSTANTIATE_D(FUNCTION, isotropic);
SLIPWAVE_INSTANTIATE_D(FUNCTION, elasticity_of_constants);
SLIPWAVE_INSTANTIATE_D(FUNCTION, rock_of_constants);
SLIPWAVE_INSTANTIATE_D(FUNCTION, soft_constant);
SLIPWAVE_INSTANTIATE_D(FUNCTION, half_of_all_directions);
SLIPWAVE_INSTANTIATE_D(FUNCTION, elasticity_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, turned);
SLIPWAVE_INSTANTIATE_D(FUNCTION, tractions);
SLIPWAVE_INSTANTIATE_D(FUNCTION, phase_speeds);
SLIPWAVE_INSTANTIATE_D(FUNCTION, backward_group_velocity);
SLIPWAVE_INSTANTIATE_D(FUNCTION, stress_of_strain);
SLIPWAVE_INSTANTIATE_D(FUNCTION, strain_of_stress);

}  // namespace slipwave
