// SPDX-License-Identifier: BSD-3-Clause
#include "rock/anisotropy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Directions from the vertical to the horizontal among which the largest and smallest are searched.
constexpr int directions = 180;
/// Places of the constants that rock of the plane of x and z has.
constexpr std::array plane_constants = {
    place_of_constant(1, 1), place_of_constant(1, 3), place_of_constant(1, 5),
    place_of_constant(3, 3), place_of_constant(3, 5), place_of_constant(5, 5),
};
bool is_of_plane(std::size_t place) {
  return std::find(plane_constants.begin(), plane_constants.end(), place) != plane_constants.end();
}
/// Directions along both angles of an octant among which the largest and smallest are searched in 3-D.
constexpr int directions_in_3d = 24;

/// Calls what(speeds) for directions of a quadrant, in 3-D of an octant: upright rock is alike in all of
/// them. Of elastic constants for half of all directions.
template <int D, class What>
void each_direction(const Material& material, const What& what) {
  const auto c = upright_elasticity<D>(material);
  if (material.constants) {
    for (const auto& direction : half_of_all_directions<D>())
      what(phase_speeds<D>(c, material.rho, direction));
    return;
  }
  constexpr double right_angle = std::numbers::pi / 2;
  if constexpr (D == 2) {
    for (int n = 0; n <= directions; ++n) {
      const double angle = n * right_angle / directions;
      what(phase_speeds<2>(c, material.rho, {std::sin(angle), std::cos(angle)}));
    }
  } else {
    for (int n = 0; n <= directions_in_3d; ++n)
      for (int k = 0; k <= directions_in_3d; ++k) {
        const double angle = n * right_angle / directions_in_3d, azimuth = k * right_angle / directions_in_3d;
        what(phase_speeds<3>(
            c, material.rho,
            {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)}));
      }
  }
}

/// The largest modulus rho c^2 that is found from any of these directions: C_ijkl n_i u_j n_k u_l is the same
/// with n and u exchanged, so it never falls from turn to turn.
template <int D>
double largest_modulus(const Elasticity<D>& c, const std::vector<Point<D>>& from) {
  constexpr int most_turns = 200;
  double largest = 0;
  for (auto direction : from) {
    double modulus = 0;
    for (int turn = 0; turn < most_turns; ++turn) {
      const auto waves = waves_along<D>(c, direction);
      const bool settled = waves.values[0] < modulus * (1 + 1e-10);
      modulus = std::max(modulus, waves.values[0]), direction = waves.vectors[0];
      if (settled) break;
    }
    largest = std::max(largest, modulus);
  }
  return largest;
}

/// Unit vectors along axes and between them, those of an octant or of half of all directions.
template <int D>
std::vector<Point<D>> main_directions(bool of_octant) {
  std::vector<Point<D>> all;
  // In 2-D more of them, at next to no cost.
  constexpr int most = D == 2 ? 2 : 1, parts = 2 * most + 1, count = D == 2 ? parts * parts : 27;
  // Opposite ones have numbers that are alike far from the middle.
  for (int n = count / 2 + 1; n < count; ++n) {
    Point<D> direction;
    int left = n;
    for (auto& part : direction) part = left % parts - most, left /= parts;
    if (of_octant && std::any_of(direction.begin(), direction.end(), [](double part) { return part < 0; }))
      continue;
    all.push_back(normalized(direction));
  }
  return all;
}

/// The largest speed of all waves of elastic constants, m/s.
template <int D>
double fastest_of_constants(const Material& material) {
  return std::sqrt(largest_modulus<D>(upright_elasticity<D>(material), main_directions<D>(false)) /
                   material.rho);
}

}  // namespace

template <int D>
std::int64_t anisotropic_cells(const Medium<D>& medium) {
  if (!medium.has(Property::epsilon) && !medium.has(Property::delta) && !medium.has(Property::c33) &&
      (D == 2 || !medium.has(Property::gamma)))
    return 0;
  std::int64_t count = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) count += is_anisotropic(medium, cell);
  return count;
}

namespace {

template <int D>
void complete_constants(Medium<D>& medium) {
  constexpr auto count = std::tuple_size_v<ElasticConstants>;
  bool any = false, all = D == 3;
  for (std::size_t n = 0; n < count; ++n)
    if (medium.has(constant_at(n))) any = true, all = all || !is_of_plane(n);
  for (std::size_t n = 0; any && n < count; ++n)
    if ((all || is_of_plane(n)) && !medium.has(constant_at(n)))
      medium[constant_at(n)] = Field<D>(medium.grid());
}

}  // namespace

template <int D>
void complete_anisotropy(Medium<D>& medium) {
  constexpr std::array plane = {Property::epsilon, Property::delta};
  constexpr std::array in_3d = {Property::epsilon1, Property::delta1, Property::delta3, Property::gamma2};
  const auto any = [&](const auto& properties) {
    return std::any_of(properties.begin(), properties.end(),
                       [&](Property property) { return medium.has(property); });
  };
  const auto complete = [&](Property property, const Field<D>& with) {
    if (!medium.has(property)) medium[property] = with;
  };
  const bool orthorhombic = any(in_3d);
  const bool wanted = any(plane) || orthorhombic || (D == 3 && medium.has(Property::gamma));
  for (const auto property : plane)
    if (wanted) complete(property, Field<D>(medium.grid()));
  if (wanted && (D == 3 || orthorhombic)) complete(Property::gamma, Field<D>(medium.grid()));
  complete_constants(medium);
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
  if (!medium.has(Property::tilt) && !medium.has(Property::azimuth) && !medium.has(Property::rotation) &&
      !medium.has(Property::c33))
    return false;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (has_tilted_axis(medium, cell)) return true;
  return false;
}

namespace {

/// Where a search for the slowest speeds begins: those along the axis, which elastic constants do not tell.
PlaneSpeeds before_all_directions(const Material& material) {
  if (!material.constants) return {material.vp, material.vs};
  return {PropertyRow::infinite, PropertyRow::infinite};
}

}  // namespace

template <>
PlaneSpeeds slowest_speeds<2>(const Material& material) {
  auto slowest = before_all_directions(material);
  if (!material.is_anisotropic()) return slowest;
  each_direction<2>(material, [&](const Point<2>& speeds) {
    slowest = {std::min(slowest.p, speeds[0]), std::min(slowest.s, speeds[1])};
  });
  return slowest;
}

template <>
PlaneSpeeds slowest_speeds<3>(const Material& material) {
  auto slowest = before_all_directions(material);
  const auto see = [&](const Point<3>& speeds) {
    slowest = {std::min(slowest.p, speeds[0]), std::min(slowest.s, speeds[2])};
  };
  if (material.constants) {
    each_direction<3>(material, see);
    return slowest;
  }
  slowest = slowest_speeds<2>(material);
  const auto c = upright_elasticity<3>(material);
  slowest.s = std::min({slowest.s, std::sqrt(c(6, 6) / material.rho), std::sqrt(c(4, 4) / material.rho)});
  if (!material.orthorhombic) return slowest;
  each_direction<3>(material, see);
  return slowest;
}

template <>
double fastest_p_speed<2>(const Material& material) {
  if (material.constants) return fastest_of_constants<2>(material);
  double fastest = material.vp;
  if (!material.is_anisotropic()) return fastest;
  each_direction<2>(material, [&](const Point<2>& speeds) { fastest = std::max(fastest, speeds[0]); });
  return fastest;
}

template <>
double fastest_p_speed<3>(const Material& material) {
  if (material.constants) return fastest_of_constants<3>(material);
  double fastest = fastest_p_speed<2>(material);
  if (!material.orthorhombic) return fastest;
  each_direction<3>(material, [&](const Point<3>& speeds) { fastest = std::max(fastest, speeds[0]); });
  return fastest;
}

double fastest_p_speed_at_most(const Material& material) {
  if (material.constants) return fastest_of_constants<2>(material);
  return material.vp * std::sqrt(1 + 2 * std::max({material.epsilon, material.delta, 0.}));
}

double fastest_along_grid(const Material& material) {
  const auto c = elasticity_of<3>(material);
  double fastest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    fastest = std::max(fastest, phase_speeds<3>(c, material.rho, unit_vector<3>(axis))[0]);
  return fastest;
}

double fastest_in_3d(const Material& material) {
  if (material.constants) return fastest_of_constants<3>(material);
  // About its own axes rock is what it is about any, and alike in all octants.
  const auto c = upright_elasticity<3>(material);
  if (!material.orthorhombic)
    return std::max(fastest_p_speed_at_most(material), std::sqrt(c(6, 6) / material.rho));
  return std::sqrt(largest_modulus<3>(c, main_directions<3>(true)) / material.rho);
}

template <int D>
Medium<D> in_slowest_directions(const Medium<D>& medium) {
  Medium<D> slowest = medium;
  for (const auto property : medium.properties())
    if (tells_anisotropy(property)) slowest[property] = {};
  // Speeds go over all directions; most cells are like the one before them.
  Material last;
  PlaneSpeeds of_last;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    const auto material = material_of(medium, cell);
    if (!(D == 3 ? material.is_anisotropic_in_3d() : material.is_anisotropic())) continue;
    if (!(material == last)) of_last = slowest_speeds<D>(last = material);
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

/// What keeps strains in 3-D from costing energy; those in 2-D do.
std::optional<AnisotropyFault> fault_in_3d(const Material& of) {
  const auto above = [](Property property, double value, double least, const std::string& rest) {
    return AnisotropyFault{property, "is " + shown(value, 6) + ", expected above " + shown(least, 4) + rest};
  };
  if (!(of.gamma > -0.5)) return above(Property::gamma, of.gamma, -0.5, ": c66 must be more than 0");
  const auto c = upright_elasticity<3>(of);
  const double c66 = c(6, 6);
  const auto most_gamma = [&](double most_c66) {
    return AnisotropyFault{Property::gamma, "is " + shown(of.gamma, 6) + ", expected below " +
                                                shown((most_c66 / c(5, 5) - 1) / 2, 4) +
                                                " with an epsilon of " + shown(of.epsilon, 6)};
  };
  if (!of.orthorhombic) {
    const double most = c(1, 1) - c(1, 3) * c(1, 3) / c(3, 3);
    if (c66 < most) return {};
    auto fault = most_gamma(most);
    fault.text += " and a delta of " + shown(of.delta, 6) + ": (c11 - c66) c33 must be more than c13^2, " +
                  gives_energy + "lower gamma or raise epsilon";
    return fault;
  }
  const auto& extra = *of.orthorhombic;
  if (!(c66 < c(1, 1))) {
    auto fault = most_gamma(c(1, 1));
    fault.text += ": c66 must be less than c11; lower gamma";
    return fault;
  }
  const double c44 = c(4, 4);
  if (!(extra.gamma2 > -0.5) || !(c44 < c(3, 3)))
    return above(Property::gamma2, extra.gamma2, extra.gamma2 > -0.5 ? (c66 / c(3, 3) - 1) / 2 : -0.5,
                 ": c44 must be more than 0 and less than c33; raise gamma2");
  const double least_delta1 = (c44 / c(3, 3) - 1) / 2, least_delta3 = (c66 / c(1, 1) - 1) / 2;
  if (!(extra.delta1 >= least_delta1))
    return above(Property::delta1, extra.delta1, least_delta1, ": (c23 + c44)^2 must not be below 0");
  if (!(extra.delta3 >= least_delta3))
    return above(Property::delta3, extra.delta3, least_delta3, ": (c12 + c66)^2 must not be below 0");
  const double least1 = (c(2, 3) * c(2, 3) / (c(3, 3) * c(3, 3)) - 1) / 2;
  if (!(extra.epsilon1 > least1))
    return above(Property::epsilon1, extra.epsilon1, least1,
                 std::string(": c22 c33 must be more than c23^2, ") + gives_energy + "raise epsilon1");
  if (is_positive(c.voigt)) return {};
  return AnisotropyFault{Property::delta3, "is " + shown(extra.delta3, 6) +
                                               ", expected less with these epsilon and epsilon1: the "
                                               "determinant of c11 to c33 must be above 0, " +
                                               gives_energy + "lower delta3 or raise epsilon1"};
}

}  // namespace

namespace {

/// Angles of what has no axes, and those that turn them out of a plane.
std::optional<AnisotropyFault> fault_of_axes(const Material& of, bool in_3d) {
  const bool has_axes = in_3d ? of.is_anisotropic_in_3d() : of.is_anisotropic();
  const std::pair<Property, double> all[] = {
      {Property::tilt, of.tilt}, {Property::azimuth, of.azimuth}, {Property::rotation, of.rotation}};
  for (const auto& [property, value] : all) {
    if (value == 0) continue;
    const std::string is = "is " + shown(value, 6) + ", expected 0 ";
    if (!in_3d && property != Property::tilt)
      return AnisotropyFault{property,
                             is + "in 2-D, where beds deepen along x; turn the section, or leave the " +
                                 row_of(property).name + " out"};
    if (!has_axes)
      return AnisotropyFault{property,
                             is + "where epsilon" + (in_3d ? ", delta and gamma" : " and delta") +
                                 " are 0: isotropic rock has no axis; set one of them, or leave the " +
                                 row_of(property).name + " out there"};
  }
  return {};
}

/// A constant of such rock and how it is wrong.
AnisotropyFault constant_fault(const Material& of, std::size_t place, const std::string& expected) {
  return {constant_at(place), "is " + gpa((*of.constants)[place]) + ", expected " + expected};
}

/// Constants that the other properties or the dimension do not let be.
std::optional<AnisotropyFault> fault_beside_constants(const Material& of, bool in_3d) {
  if (of.vs == 0)
    return constant_fault(of, place_of_constant(1, 1), "all elastic constants to be 0 in fluid");
  const auto extra = of.orthorhombic.value_or(Orthorhombic{});
  const std::pair<Property, double> all[] = {
      {Property::epsilon, of.epsilon},  {Property::delta, of.delta},
      {Property::gamma, of.gamma},      {Property::delta3, extra.delta3},
      {Property::tilt, of.tilt},        {Property::epsilon1, extra.epsilon1},
      {Property::delta1, extra.delta1}, {Property::gamma2, extra.gamma2},
      {Property::azimuth, of.azimuth},  {Property::rotation, of.rotation}};
  for (const auto& [property, value] : all)
    if (value != 0)
      return AnisotropyFault{property, "is " + shown(value, 6) +
                                           ", expected 0 where elastic constants, which are along the axes "
                                           "of the grid, say what the rock is"};
  if (in_3d && (*of.constants)[place_of_constant(2, 2)] == 0)
    return constant_fault(of, place_of_constant(2, 2),
                          "more in 3-D, where the six constants of the plane of x and z are not enough: "
                          "give c22, c44, c66, c12 and c23, too");
  for (const auto& [m, n] : {std::pair{1, 4}, {1, 6}, {3, 4}, {3, 6}, {4, 5}, {5, 6}})
    if (const auto place = place_of_constant(m, n); !in_3d && (*of.constants)[place] != 0)
      return constant_fault(of, place, "0 in 2-D, where waves do not move rock out of the plane of x and z");
  return {};
}

/// What keeps rock from having its elastic constants.
template <int D>
std::optional<AnisotropyFault> fault_of_constants(const Material& of) {
  if (auto fault = fault_beside_constants(of, D == 3)) return fault;
  const auto c = upright_elasticity<D>(of);
  if (const auto soft = soft_constant<D>(c))
    return constant_fault(of, place_of_constant(soft->number, soft->number), above_soft_constant(*soft));
  // What speeds and constants are rounded by in files.
  constexpr double rounding = 1e-5;
  for (const auto& [number, speed] : {std::pair{3, of.vp}, {5, of.vs}}) {
    const double modulus = of.rho * speed * speed;
    if (std::abs(c(number, number) - modulus) > rounding * modulus)
      return constant_fault(of, place_of_constant(number, number),
                            gpa(modulus) + " as of rho " + (number == 3 ? "vp^2" : "vs^2"));
  }
  return {};
}

}  // namespace

std::string gpa(double pascal) { return shown(pascal / 1e9, 6) + " GPa"; }

std::string above_soft_constant(const SoftConstant& soft) {
  return "more than " + gpa(soft.least) +
         " beside the constants of lower numbers, or some strain would cost no energy; raise it, or lower "
         "those that couple it to them";
}

std::optional<AnisotropyFault> fault_of_anisotropy(const Material& material, bool in_3d) {
  if (material.constants) return in_3d ? fault_of_constants<3>(material) : fault_of_constants<2>(material);
  const double vp = material.vp, vs = material.vs, rho = material.rho;
  const double epsilon = material.epsilon, delta = material.delta;
  if (auto fault = fault_of_axes(material, in_3d)) return fault;
  if (!material.is_anisotropic_in_3d() || rho == 0) return {};
  if (vs == 0) return fault_of_fluid(material);
  // (c13 + c55)^2 must not be negative, and c11 c33 must be more than c13^2.
  const double ratio = vs * vs / (vp * vp), least_delta = (ratio - 1) / 2;
  if (!(delta >= least_delta))
    return AnisotropyFault{Property::delta,
                           "is " + shown(delta, 6) + ", expected at least -(1 - (vs/vp)^2)/2 = " +
                               shown(least_delta, 4) + " with vp " + shown(vp) + " and vs " + shown(vs)};
  const auto c = upright_elasticity<2>(material);
  const double share = c(1, 3) / c(3, 3), least = (share * share - 1) / 2;
  if (!(epsilon > least))
    return AnisotropyFault{Property::epsilon,
                           "is " + shown(epsilon, 6) + ", expected above " + shown(least, 4) +
                               " with a delta of " + shown(delta, 6) +
                               ": c11 c33 must be more than c13^2, or the rock would give " +
                               "energy; raise epsilon or lower delta"};
  return in_3d ? fault_in_3d(material) : std::nullopt;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, any_orthorhombic);

SLIPWAVE_INSTANTIATE_D(FUNCTION, any_tilted_axes);
SLIPWAVE_INSTANTIATE_D(FUNCTION, anisotropic_cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, complete_anisotropy);
SLIPWAVE_INSTANTIATE_D(FUNCTION, in_slowest_directions);

}  // namespace slipwave
