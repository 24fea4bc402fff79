// SPDX-License-Identifier: BSD-3-Clause
#include "model/anisotropy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.hpp"

namespace slipwave {
namespace {

/// Directions from the vertical to the horizontal among which the largest and smallest are searched.
constexpr int directions = 180;
/// The same along both angles of an octant, in space.
constexpr int directions_in_space = 24;
/// Less is rounding.
constexpr double least_orthorhombic = 1e-9;

/// Of the mixed stiffness: (c_ab + c_shear)^2 = (c_aa - c_shear) (c_aa - c_shear + 2 delta c_aa).
double mixed_stiffness(double normal, double shear, double delta) {
  const double apart = normal - shear;
  return std::sqrt(apart * (apart + 2 * delta * normal)) - shear;
}
double delta_of(double normal, double shear, double mixed) {
  const double sum = mixed + shear, apart = normal - shear;
  return (sum * sum - apart * apart) / (2 * normal * apart);
}

}  // namespace

Stiffness stiffness_of(const Material& material) {
  const double c33 = material.rho * material.vp * material.vp, c55 = material.rho * material.vs * material.vs;
  if (!material.is_anisotropic()) return {c33, c33 - 2 * c55, c33, c55};
  const double apart = c33 - c55;
  return {c33 * (1 + 2 * material.epsilon), std::sqrt(apart * (apart + 2 * material.delta * c33)) - c55, c33,
          c55};
}

Material material_of_stiffness(const Stiffness& stiffness, double rho) {
  const auto& [c11, c13, c33, c55] = stiffness;
  const double sum = c13 + c55, apart = c33 - c55;
  return {std::sqrt(c33 / rho), std::sqrt(c55 / rho), rho, (c11 / c33 - 1) / 2,
          (sum * sum - apart * apart) / (2 * c33 * apart)};
}

OrthorhombicStiffness stiffness_in_space(const Material& material) {
  const auto [c11, c13, c33, c55] = stiffness_of(material);
  const double c66 = c55 * (1 + 2 * material.gamma);
  if (!material.orthorhombic) return {c11, c11, c33, c55, c55, c66, c11 - 2 * c66, c13, c13};
  const auto& [epsilon1, delta1, delta3, gamma2] = *material.orthorhombic;
  const double c44 = c66 / (1 + 2 * gamma2);
  return {c11, c33 * (1 + 2 * epsilon1),         c33, c44, c55, c66, mixed_stiffness(c11, c66, delta3),
          c13, mixed_stiffness(c33, c44, delta1)};
}

Material material_of_stiffness_in_space(const OrthorhombicStiffness& stiffness, double rho) {
  const auto& [c11, c22, c33, c44, c55, c66, c12, c13, c23] = stiffness;
  auto material = material_of_stiffness(Stiffness{c11, c13, c33, c55}, rho);
  material.gamma = (c66 / c55 - 1) / 2;
  const Orthorhombic of = {(c22 / c33 - 1) / 2, delta_of(c33, c44, c23), delta_of(c11, c66, c12),
                           (c66 / c44 - 1) / 2};
  const auto apart = {of.epsilon1 - material.epsilon, of.delta1 - material.delta, of.delta3,
                      of.gamma2 - material.gamma};
  if (std::any_of(apart.begin(), apart.end(),
                  [](double value) { return std::abs(value) > least_orthorhombic; }))
    material.orthorhombic = of;
  return material;
}

PlaneStiffness tilted(const Stiffness& upright, double dip_rad) {
  const auto& [c11, c13, c33, c55] = upright;
  const double c = std::cos(dip_rad), s = std::sin(dip_rad), cc = c * c, ss = s * s, cs = c * s,
               apart = cc - ss, mixed = c13 + 2 * c55;
  return {cc * cc * c11 + ss * ss * c33 + 2 * cs * cs * mixed,
          cs * cs * (c11 + c33 - 4 * c55) + (cc * cc + ss * ss) * c13,
          cs * (cc * c11 - ss * c33 - apart * mixed),
          ss * ss * c11 + cc * cc * c33 + 2 * cs * cs * mixed,
          cs * (ss * c11 - cc * c33 + apart * mixed),
          cs * cs * (c11 + c33 - 2 * c13) + apart * apart * c55};
}

PlaneStiffness plane_stiffness_of(const Material& material) {
  return tilted(stiffness_of(material), material.tilt * std::numbers::pi / 180);
}

template <int D>
std::int64_t anisotropic_cells(const Medium<D>& medium) {
  if (!medium.has(Property::epsilon) && !medium.has(Property::delta) &&
      (D == 2 || !medium.has(Property::gamma)))
    return 0;
  std::int64_t count = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) count += is_anisotropic(medium, cell);
  return count;
}

template <int D>
void complete_anisotropy(Medium<D>& medium) {
  constexpr std::array plane = {Property::epsilon, Property::delta};
  constexpr std::array in_space = {Property::epsilon1, Property::delta1, Property::delta3, Property::gamma2};
  const auto any = [&](const auto& properties) {
    return std::any_of(properties.begin(), properties.end(),
                       [&](Property property) { return medium.has(property); });
  };
  const auto complete = [&](Property property, const Field<D>& with) {
    if (!medium.has(property)) medium[property] = with;
  };
  const bool orthorhombic = any(in_space);
  const bool wanted = any(plane) || orthorhombic || (D == 3 && medium.has(Property::gamma));
  for (const auto property : plane)
    if (wanted) complete(property, Field<D>(medium.grid()));
  if (wanted && (D == 3 || orthorhombic)) complete(Property::gamma, Field<D>(medium.grid()));
  if (!orthorhombic) return;
  complete(Property::epsilon1, medium[Property::epsilon]);
  complete(Property::delta1, medium[Property::delta]);
  complete(Property::delta3, Field<D>(medium.grid()));
  complete(Property::gamma2, medium[Property::gamma]);
}

template <int D>
bool any_orthorhombic(const Medium<D>& medium) {
  for (std::size_t cell = 0; D == 3 && medium.has(Property::epsilon1) && cell < medium.vp.size(); ++cell)
    if (is_orthorhombic(medium, cell)) return true;
  return false;
}

template <int D>
bool any_tilted_axes(const Medium<D>& medium) {
  if (!medium.has(Property::tilt) && !medium.has(Property::azimuth) && !medium.has(Property::rotation))
    return false;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (has_tilted_axis(medium, cell)) return true;
  return false;
}

PlaneSpeeds phase_speeds(const Stiffness& stiffness, double rho, double angle_rad) {
  const auto& [c11, c13, c33, c55] = stiffness;
  const double along = std::sin(angle_rad), down = std::cos(angle_rad), x = along * along, z = down * down;
  const double mean = ((c11 + c55) * x + (c33 + c55) * z) / 2;
  const double half = std::hypot((c11 - c55) * x - (c33 - c55) * z, 2 * (c13 + c55) * along * down) / 2;
  return {std::sqrt((mean + half) / rho), std::sqrt(std::max(mean - half, 0.) / rho)};
}

namespace {

/// Calls what(speeds) for directions from the vertical to the horizontal.
template <class What>
void for_directions(const Material& material, const What& what) {
  const auto stiffness = stiffness_of(material);
  for (int n = 0; n <= directions; ++n)
    what(phase_speeds(stiffness, material.rho, n * std::numbers::pi / 2 / directions));
}

}  // namespace

PlaneSpeeds slowest_speeds(const Material& material) {
  PlaneSpeeds slowest = {material.vp, material.vs};
  if (!material.is_anisotropic()) return slowest;
  for_directions(material, [&](const PlaneSpeeds& speeds) {
    slowest = {std::min(slowest.p, speeds.p), std::min(slowest.s, speeds.s)};
  });
  return slowest;
}

double fastest_p_speed(const Material& material) {
  double fastest = material.vp;
  if (!material.is_anisotropic()) return fastest;
  for_directions(material, [&](const PlaneSpeeds& speeds) { fastest = std::max(fastest, speeds.p); });
  return fastest;
}

double fastest_p_speed_at_most(const Material& material) {
  return material.vp * std::sqrt(1 + 2 * std::max({material.epsilon, material.delta, 0.}));
}

double largest_turning(const PlaneStiffness& stiffness, bool vertical) {
  const auto& [c11, c13, c15, c33, c35, c55] = stiffness;
  double most = 0;
  // Where the axis is upright both quadrants are alike.
  const bool upright = c15 == 0 && c35 == 0;
  for (int n = 1; n < (upright ? 1 : 2) * directions; ++n) {
    const double angle = n * std::numbers::pi / 2 / directions, x = std::sin(angle), z = std::cos(angle);
    const double xx = c11 * x * x + c55 * z * z + 2 * c15 * x * z,
                 zz = c55 * x * x + c33 * z * z + 2 * c35 * x * z,
                 xz = (c13 + c55) * x * z + c15 * x * x + c35 * z * z;
    const double mean = (xx + zz) / 2, half = std::hypot((xx - zz) / 2, xz);
    for (const double inertia : {mean + half, mean - half}) {
      // Motion (a, b) of that wave; the energy of the group moves with the derivative of omega by k.
      const double size = std::hypot(xz, inertia - xx), a = xz / size, b = (inertia - xx) / size;
      const double group = vertical ? (c55 * z + c15 * x) * a * a + ((c13 + c55) * x + 2 * c35 * z) * a * b +
                                          (c33 * z + c35 * x) * b * b
                                    : (c11 * x + c15 * z) * a * a + ((c13 + c55) * z + 2 * c15 * x) * a * b +
                                          (c55 * x + c35 * z) * b * b;
      most = std::max(most, -(vertical ? z : x) * group / inertia);
    }
  }
  return most < 1e-9 ? 0 : most;
}

namespace {

/// The Christoffel matrix of a direction, of the order xx, yy, zz, xy, xz, yz.
std::array<double, 6> christoffel(const OrthorhombicStiffness& c, const std::array<double, 3>& n) {
  const double x = n[0], y = n[1], z = n[2];
  return {c.c11 * x * x + c.c66 * y * y + c.c55 * z * z,
          c.c66 * x * x + c.c22 * y * y + c.c44 * z * z,
          c.c55 * x * x + c.c44 * y * y + c.c33 * z * z,
          (c.c12 + c.c66) * x * y,
          (c.c13 + c.c55) * x * z,
          (c.c23 + c.c44) * y * z};
}

/// Its eigenvalues, falling: by the cosine of a third of an angle.
std::array<double, 3> eigenvalues(const std::array<double, 6>& m) {
  const auto [xx, yy, zz, xy, xz, yz] = m;
  const double mean = (xx + yy + zz) / 3, a = xx - mean, b = yy - mean, c = zz - mean;
  const double square = (a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6;
  if (square <= 1e-30 * mean * mean) return {mean, mean, mean};
  const double size = std::sqrt(square);
  const double half =
      (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2 * size * square);
  const double angle = std::acos(std::clamp(half, -1., 1.)) / 3;
  const double first = mean + 2 * size * std::cos(angle),
               last = mean + 2 * size * std::cos(angle + 2 * std::numbers::pi / 3);
  return {first, 3 * mean - first - last, last};
}

/// Calls what(direction) for directions of an octant: rock is alike in all of them.
template <class What>
void for_directions_in_space(const What& what) {
  for (int n = 0; n <= directions_in_space; ++n)
    for (int k = 0; k <= directions_in_space; ++k) {
      const double angle = n * std::numbers::pi / 2 / directions_in_space,
                   azimuth = k * std::numbers::pi / 2 / directions_in_space;
      what(std::array<double, 3>{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                                 std::cos(angle)});
    }
}

/// The wave of that eigenvalue: the square of each component of its motion over all, and products, as the
/// adjugate of the Christoffel matrix less the eigenvalue has them.
std::array<double, 6> squared_motion(const std::array<double, 6>& m, double eigenvalue) {
  const double xx = m[0] - eigenvalue, yy = m[1] - eigenvalue, zz = m[2] - eigenvalue;
  const double xy = m[3], xz = m[4], yz = m[5];
  return {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
          xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - yz * xx};
}

}  // namespace

std::array<double, 3> phase_speeds(const OrthorhombicStiffness& stiffness, double rho,
                                   const std::array<double, 3>& direction) {
  auto speeds = eigenvalues(christoffel(stiffness, direction));
  for (auto& speed : speeds) speed = std::sqrt(std::max(speed, 0.) / rho);
  return speeds;
}

PlaneSpeeds slowest_speeds_in_space(const Material& material) {
  auto slowest = slowest_speeds(material);
  const auto c = stiffness_in_space(material);
  slowest.s = std::min({slowest.s, std::sqrt(c.c66 / material.rho), std::sqrt(c.c44 / material.rho)});
  if (!material.orthorhombic) return slowest;
  for_directions_in_space([&](const std::array<double, 3>& direction) {
    const auto speeds = phase_speeds(c, material.rho, direction);
    slowest = {std::min(slowest.p, speeds[0]), std::min(slowest.s, speeds[2])};
  });
  return slowest;
}

double fastest_p_speed_in_space(const Material& material) {
  double fastest = fastest_p_speed(material);
  if (!material.orthorhombic) return fastest;
  const auto c = stiffness_in_space(material);
  for_directions_in_space([&](const std::array<double, 3>& direction) {
    fastest = std::max(fastest, phase_speeds(c, material.rho, direction)[0]);
  });
  return fastest;
}

double largest_turning(const OrthorhombicStiffness& c, int axis) {
  double most = 0;
  for_directions_in_space([&](const std::array<double, 3>& n) {
    const auto matrix = christoffel(c, n);
    const auto along = std::size_t(axis);
    // The derivative of the matrix by that component of the direction, times the component over 2.
    std::array<double, 6> change{};
    for (int i = 0; i < 3; ++i)
      change[std::size_t(i)] = (i == axis ? c.normal(i, i) : c.shear(i, axis)) * n[along] * n[along];
    for (std::size_t other = 0; other < 3; ++other)
      if (other != along) change[along + other + 2] = matrix[along + other + 2] / 2;
    for (const double inertia : eigenvalues(matrix)) {
      const auto motion = squared_motion(matrix, inertia);
      const double size = motion[0] + motion[1] + motion[2];
      // Where two waves are as fast the adjugate is rounding; other directions are near.
      if (std::abs(size) < 1e-6 * inertia * inertia) continue;
      double moved = 0;
      for (std::size_t k = 0; k < 6; ++k) moved += (k < 3 ? 1 : 2) * change[k] * motion[k];
      most = std::max(most, -moved / (size * inertia));
    }
  });
  return most < 1e-9 ? 0 : most;
}

template <int D>
Medium<D> in_slowest_directions(const Medium<D>& medium) {
  Medium<D> slowest = medium;
  for (const auto property :
       {Property::epsilon, Property::delta, Property::tilt, Property::gamma, Property::epsilon1,
        Property::delta1, Property::delta3, Property::gamma2, Property::azimuth, Property::rotation})
    if (slowest.has(property)) slowest[property] = {};
  // Speeds go over all directions; most cells are like the one before them.
  Material last;
  PlaneSpeeds of_last;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    const auto material = material_of(medium, cell);
    if (!(D == 3 ? material.is_anisotropic_in_space() : material.is_anisotropic())) continue;
    if (!(material == last))
      of_last = D == 3 ? slowest_speeds_in_space(last = material) : slowest_speeds(last = material);
    slowest.vp[cell] = float(of_last.p);
    slowest.vs[cell] = float(of_last.s);
  }
  return slowest;
}

namespace {

/// A parameter of fluid that is not 0, or nothing.
std::optional<AnisotropyFault> fault_of_fluid(const Material& of) {
  const auto extra = of.orthorhombic.value_or(Orthorhombic{});
  const std::pair<Property, double> all[] = {
      {Property::epsilon, of.epsilon},  {Property::delta, of.delta},
      {Property::gamma, of.gamma},      {Property::epsilon1, extra.epsilon1},
      {Property::delta1, extra.delta1}, {Property::delta3, extra.delta3},
      {Property::gamma2, extra.gamma2}};
  for (const auto& [property, value] : all)
    if (value != 0)
      return AnisotropyFault{
          property, "is " + shown(value, 6) +
                        ", expected 0 in fluid, which is isotropic; set it to 0 or vs above 0 there"};
  return {};
}

const char* const gives_energy = "or the rock would give energy; ";

/// What keeps strains in space from costing energy; those in the plane of x and z do.
std::optional<AnisotropyFault> fault_in_space(const Material& of) {
  const auto above = [](Property property, double value, double least, const std::string& rest) {
    return AnisotropyFault{property, "is " + shown(value, 6) + ", expected above " + shown(least, 4) + rest};
  };
  if (!(of.gamma > -0.5)) return above(Property::gamma, of.gamma, -0.5, ": c66 must be more than 0");
  const auto plane = stiffness_of(of);
  const double c66 = plane.c55 * (1 + 2 * of.gamma);
  const auto most_gamma = [&](double most_c66) {
    return AnisotropyFault{Property::gamma, "is " + shown(of.gamma, 6) + ", expected below " +
                                                shown((most_c66 / plane.c55 - 1) / 2, 4) +
                                                " with an epsilon of " + shown(of.epsilon, 6)};
  };
  if (!of.orthorhombic) {
    const double most = plane.c11 - plane.c13 * plane.c13 / plane.c33;
    if (c66 < most) return {};
    auto fault = most_gamma(most);
    fault.text += " and a delta of " + shown(of.delta, 6) + ": (c11 - c66) c33 must be more than c13^2, " +
                  gives_energy + "lower gamma or raise epsilon";
    return fault;
  }
  const auto& extra = *of.orthorhombic;
  if (!(c66 < plane.c11)) {
    auto fault = most_gamma(plane.c11);
    fault.text += ": c66 must be less than c11; lower gamma";
    return fault;
  }
  const double c44 = c66 / (1 + 2 * extra.gamma2);
  if (!(extra.gamma2 > -0.5) || !(c44 < plane.c33))
    return above(Property::gamma2, extra.gamma2, extra.gamma2 > -0.5 ? (c66 / plane.c33 - 1) / 2 : -0.5,
                 ": c44 must be more than 0 and less than c33; raise gamma2");
  const double least_delta1 = (c44 / plane.c33 - 1) / 2, least_delta3 = (c66 / plane.c11 - 1) / 2;
  if (!(extra.delta1 >= least_delta1))
    return above(Property::delta1, extra.delta1, least_delta1, ": (c23 + c44)^2 must not be below 0");
  if (!(extra.delta3 >= least_delta3))
    return above(Property::delta3, extra.delta3, least_delta3, ": (c12 + c66)^2 must not be below 0");
  const auto c = stiffness_in_space(of);
  const double least1 = (c.c23 * c.c23 / (c.c33 * c.c33) - 1) / 2;
  if (!(extra.epsilon1 > least1))
    return above(Property::epsilon1, extra.epsilon1, least1,
                 std::string(": c22 c33 must be more than c23^2, ") + gives_energy + "raise epsilon1");
  const double determinant = c.c11 * (c.c22 * c.c33 - c.c23 * c.c23) -
                             c.c12 * (c.c12 * c.c33 - c.c13 * c.c23) +
                             c.c13 * (c.c12 * c.c23 - c.c13 * c.c22);
  if (c.c11 * c.c22 > c.c12 * c.c12 && determinant > 0) return {};
  return AnisotropyFault{Property::delta3, "is " + shown(extra.delta3, 6) +
                                               ", expected less with these epsilon and epsilon1: the "
                                               "determinant of c11 to c33 must be above 0, " +
                                               gives_energy + "lower delta3 or raise epsilon1"};
}

}  // namespace

namespace {

/// Angles of what has no axes, and those that turn them out of a plane.
std::optional<AnisotropyFault> fault_of_axes(const Material& of, bool in_space) {
  const bool has_axes = in_space ? of.is_anisotropic_in_space() : of.is_anisotropic();
  const std::pair<Property, double> all[] = {
      {Property::tilt, of.tilt}, {Property::azimuth, of.azimuth}, {Property::rotation, of.rotation}};
  for (const auto& [property, value] : all) {
    if (value == 0) continue;
    const std::string is = "is " + shown(value, 6) + ", expected 0 ";
    if (!in_space && property != Property::tilt)
      return AnisotropyFault{property,
                             is + "in 2-D, where beds deepen along x; turn the section, or leave the " +
                                 row_of(property).name + " out"};
    if (!has_axes)
      return AnisotropyFault{property,
                             is + "where epsilon" + (in_space ? ", delta and gamma" : " and delta") +
                                 " are 0: isotropic rock has no axis; set one of them, or leave the " +
                                 row_of(property).name + " out there"};
  }
  return {};
}

}  // namespace

std::optional<AnisotropyFault> fault_of_anisotropy(const Material& material, bool in_space) {
  const double vp = material.vp, vs = material.vs, rho = material.rho;
  const double epsilon = material.epsilon, delta = material.delta;
  if (auto fault = fault_of_axes(material, in_space)) return fault;
  if (!material.is_anisotropic_in_space() || rho == 0) return {};
  if (vs == 0) return fault_of_fluid(material);
  // (c13 + c55)^2 must not be negative, and c11 c33 must be more than c13^2.
  const double ratio = vs * vs / (vp * vp), least_delta = (ratio - 1) / 2;
  if (!(delta >= least_delta))
    return AnisotropyFault{Property::delta,
                           "is " + shown(delta, 6) + ", expected at least -(1 - (vs/vp)^2)/2 = " +
                               shown(least_delta, 4) + " with vp " + shown(vp) + " and vs " + shown(vs)};
  const auto stiffness = stiffness_of(material);
  const double share = stiffness.c13 / stiffness.c33, least = (share * share - 1) / 2;
  if (!(epsilon > least))
    return AnisotropyFault{Property::epsilon,
                           "is " + shown(epsilon, 6) + ", expected above " + shown(least, 4) +
                               " with a delta of " + shown(delta, 6) +
                               ": c11 c33 must be more than c13^2, or the rock would give " +
                               "energy; raise epsilon or lower delta"};
  return in_space ? fault_in_space(material) : std::nullopt;
}

template bool any_orthorhombic(const Medium<2>&);
template bool any_orthorhombic(const Medium<3>&);

template bool any_tilted_axes(const Medium<2>&);
template bool any_tilted_axes(const Medium<3>&);
template std::int64_t anisotropic_cells(const Medium<2>&);
template std::int64_t anisotropic_cells(const Medium<3>&);
template void complete_anisotropy(Medium<2>&);
template void complete_anisotropy(Medium<3>&);
template Medium<2> in_slowest_directions(const Medium<2>&);
template Medium<3> in_slowest_directions(const Medium<3>&);

}  // namespace slipwave
