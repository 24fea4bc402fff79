// SPDX-License-Identifier: BSD-3-Clause
#include "rock/stiffness_input.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

/// Less, as a share of c33 or of 1, is the rounding of floats.
constexpr double rounding = 1e-5, least_parameter = 1e-6;
constexpr std::array always = {Modulus::c11, Modulus::c13, Modulus::c33, Modulus::c55};
constexpr std::array of_orthorhombic = {Modulus::c22, Modulus::c44, Modulus::c12, Modulus::c23};
constexpr std::array of_tilted = {Modulus::c15, Modulus::c35};
constexpr std::array of_space = {Modulus::c14, Modulus::c16, Modulus::c24, Modulus::c25, Modulus::c26,
                                 Modulus::c34, Modulus::c36, Modulus::c45, Modulus::c46, Modulus::c56};

const std::string& name_of(Modulus of) { return modulus_names()[std::size_t(of)]; }

/// A stiffness in the plane of x and z and its axes: the upright one and the dip of its beds.
struct AxesOfPlane {
  Elasticity<2> upright;
  double dip_rad = 0;
};

/// By the parts of a stiffness that turn with twice and four times the angle; beds are the stiffer side.
AxesOfPlane axes_of_plane(const Elasticity<2>& c) {
  const double twice[] = {c(1, 1) - c(3, 3), 2 * (c(1, 5) + c(3, 5))};
  const double four[] = {c(1, 1) + c(3, 3) - 2 * c(1, 3) - 4 * c(5, 5), 4 * (c(1, 5) - c(3, 5))};
  const double still = c(1, 1) + c(3, 3) + 2 * c(1, 3), shear = c(5, 5) - c(1, 3);
  double dip = std::atan2(twice[1], twice[0]) / 2;
  if (std::hypot(twice[0], twice[1]) < rounding * c(3, 3)) dip = std::atan2(four[1], four[0]) / 4;
  const double apart = twice[0] * std::cos(2 * dip) + twice[1] * std::sin(2 * dip),
               of_four = four[0] * std::cos(4 * dip) + four[1] * std::sin(4 * dip);
  const double sum = (of_four + 3 * still + 4 * shear) / 4, c13 = (still - sum) / 2;
  return {vertical_symmetry((sum + apart) / 2, c13, (sum - apart) / 2, shear + c13), dip};
}

bool differ(const Elasticity<2>& one, const Elasticity<2>& other) {
  for (std::size_t i = 0; i < one.components; ++i)
    for (std::size_t j = 0; j < one.components; ++j)
      if (std::abs(one.voigt[i][j] - other.voigt[i][j]) > 1e-3 * one(3, 3)) return true;
  return false;
}

/// All of them, those that are not given as where rock is alike in all horizontal directions.
Elasticity<3> completed(const GivenStiffness& given, const Elasticity<2>& plane) {
  const double c11 = plane(1, 1), c13 = plane(1, 3), c33 = plane(3, 3), c55 = plane(5, 5);
  const double c66 = given[Modulus::c66].value_or(c55);
  if (!given[Modulus::c22]) return orthorhombic({c11, c11, c33, c55, c55, c66, c11 - 2 * c66, c13, c13});
  return orthorhombic({c11, *given[Modulus::c22], c33, *given[Modulus::c44], c55, c66, *given[Modulus::c12],
                       c13, *given[Modulus::c23]});
}

Elasticity<2> in_plane(const GivenStiffness& given) {
  auto c = vertical_symmetry(*given[Modulus::c11], *given[Modulus::c13], *given[Modulus::c33],
                             *given[Modulus::c55]);
  c.set(1, 5, given[Modulus::c15].value_or(0)), c.set(3, 5, given[Modulus::c35].value_or(0));
  return c;
}

AxesOfPlane plane_of(const GivenStiffness& given) {
  const auto c = in_plane(given);
  const bool tilted = std::max(std::abs(c(1, 5)), std::abs(c(3, 5))) >= rounding * c(3, 3);
  return tilted ? axes_of_plane(c) : AxesOfPlane{c.along_grid()};
}

/// All of them as elastic constants; those that are not given are 0.
ElasticConstants constants_of(const GivenStiffness& given) {
  ElasticConstants all{};
  for (std::size_t n = 0; n < modulus_count; ++n) {
    const auto& name = modulus_names()[n];
    all[place_of_constant(name[1] - '0', name[2] - '0')] = given.moduli[n].value_or(0);
  }
  return all;
}

bool is_of_space(const GivenStiffness& given) { return given[Modulus::c22].has_value(); }
bool are_zero(const GivenStiffness& given, const auto& moduli, double least) {
  return std::all_of(moduli.begin(), moduli.end(),
                     [&](Modulus of) { return std::abs(given[of].value_or(0)) <= least; });
}
StiffnessFault fault(Modulus of, double value, const std::string& rest) {
  return {of, "is " + gpa(value) + ", expected " + rest};
}

/// Returns the fault of two axes: c_ab with c_aa, c_bb and their shear modulus.
std::optional<StiffnessFault> fault_of_pair(Modulus mixed, double value, double one, double other,
                                            double shear, const std::string& moduli) {
  const double most = std::sqrt(one * other);
  if (!(std::abs(value) < most))
    return fault(mixed, value,
                 "less than " + gpa(most) + " in size: " + moduli +
                     " must be more than its square, or the rock would give energy");
  if (!(value + shear >= 0))
    return fault(mixed, value, "at least " + gpa(-shear) + ", that is minus the shear modulus of its plane");
  return {};
}

std::optional<StiffnessFault> fault_of_fluid(const GivenStiffness& given, const Elasticity<2>& plane) {
  for (const auto& [modulus, value] : {std::pair{Modulus::c11, plane(1, 1)}, {Modulus::c13, plane(1, 3)}})
    if (std::abs(value - plane(3, 3)) > 1e-3 * plane(3, 3))
      return fault(modulus, value, "c33 = " + gpa(plane(3, 3)) + " in fluid, where c55 is 0");
  const auto none = [&](Modulus modulus) -> std::optional<StiffnessFault> {
    if (given[modulus].value_or(0) == 0) return {};
    return fault(modulus, *given[modulus], "0 in fluid, where c55 is 0");
  };
  for (const auto modulus : {Modulus::c66, Modulus::c44})
    if (auto found = none(modulus)) return found;
  for (const auto modulus : of_tilted)
    if (auto found = none(modulus)) return found;
  for (const auto modulus : of_space)
    if (auto found = none(modulus)) return found;
  return {};
}

std::optional<StiffnessFault> fault_of_plane(const Elasticity<2>& plane) {
  const double c11 = plane(1, 1), c13 = plane(1, 3), c33 = plane(3, 3), c55 = plane(5, 5);
  const std::string slower = ", or P waves would be slower than S waves";
  if (!(c33 > c55)) return fault(Modulus::c33, c33, "more than c55 = " + gpa(c55) + slower);
  if (!(c11 > c55)) return fault(Modulus::c11, c11, "more than c55 = " + gpa(c55) + slower);
  return fault_of_pair(Modulus::c13, c13, c11, c33, c55, "c11 c33");
}

std::optional<StiffnessFault> fault_in_3d(const Elasticity<3>& c, bool alike) {
  if (!(c(6, 6) > 0)) return fault(Modulus::c66, c(6, 6), "more than 0, as c55 is");
  if (alike) {
    const double most = c(1, 1) - c(1, 3) * c(1, 3) / c(3, 3);
    if (c(6, 6) < most) return {};
    return fault(Modulus::c66, c(6, 6),
                 "less than " + gpa(most) +
                     ": (c11 - c66) c33 must be more than c13^2, or the rock would give "
                     "energy");
  }
  if (!(c(4, 4) > 0 && c(4, 4) < c(3, 3)))
    return fault(Modulus::c44, c(4, 4), "more than 0 and less than c33");
  if (!(c(6, 6) < c(1, 1))) return fault(Modulus::c66, c(6, 6), "less than c11 = " + gpa(c(1, 1)));
  if (!(c(2, 2) > std::max(c(4, 4), c(6, 6)))) return fault(Modulus::c22, c(2, 2), "more than c44 and c66");
  if (auto of_xy = fault_of_pair(Modulus::c12, c(1, 2), c(1, 1), c(2, 2), c(6, 6), "c11 c22")) return of_xy;
  if (auto of_yz = fault_of_pair(Modulus::c23, c(2, 3), c(2, 2), c(3, 3), c(4, 4), "c22 c33")) return of_yz;
  if (is_positive(c.voigt)) return {};
  return fault(Modulus::c12, c(1, 2),
               "another value: with c13 and c23 the determinant of c11 to c33 must be above 0, or the rock "
               "would give energy");
}

/// Whether speeds and parameters, and in a plane a tilt, give moduli that may be those of any rock.
bool have_parameters(const GivenStiffness& given) {
  const double least = rounding * *given[Modulus::c33];
  if (is_of_space(given) && !(are_zero(given, of_tilted, least) && are_zero(given, of_space, least)))
    return false;
  const auto [plane, dip] = plane_of(given);
  if (fault_of_plane(plane)) return false;
  if (is_of_space(given)) return !fault_in_3d(completed(given, plane), false);
  return !differ(in_plane(given), turned<2>(plane, axes_of<2>({.tilt = dip * 180 / std::numbers::pi})));
}

template <int D>
std::optional<StiffnessFault> fault_of_any_rock(const GivenStiffness& given) {
  const auto soft = soft_constant<D>(elasticity_of_constants<D>(constants_of(given)));
  if (!soft) return {};
  const auto& names = modulus_names();
  const auto digit = std::to_string(soft->number);
  const auto of = Modulus(std::find(names.begin(), names.end(), "c" + digit + digit) - names.begin());
  return fault(of, *given[of], above_soft_constant(*soft));
}

}  // namespace

const std::array<std::string, modulus_count>& modulus_names() {
  static const std::array<std::string, modulus_count> names = {
      "c11", "c13", "c33", "c55", "c15", "c35", "c66", "c22", "c44", "c12", "c23",
      "c14", "c16", "c24", "c25", "c26", "c34", "c36", "c45", "c46", "c56"};
  return names;
}

PropertyRow row_of(Modulus modulus) {
  const auto among = [&](const auto& some) {
    return std::find(some.begin(), some.end(), modulus) != some.end();
  };
  return {.name = name_of(modulus),
          .long_name = "stiffness " + name_of(modulus),
          .help = "stiffness " + name_of(modulus) + ", Pa" +
                  (among(always)             ? "; with the others of c11, c13, c33, c55 instead of vp and vs"
                   : among(of_tilted)        ? ", of any rock in the plane of x and z"
                   : among(of_space)         ? ", of any rock in 3-D, 0 by default"
                   : modulus == Modulus::c66 ? ", in 3-D"
                                             : ", of orthorhombic rock") +
                  ", a file or a number",
          .units = "Pa",
          .shown_unit = "Pa"};
}

bool GivenStiffness::any() const {
  return std::any_of(moduli.begin(), moduli.end(), [](const auto& modulus) { return modulus.has_value(); });
}

void GivenStiffness::check_kind() const {
  const auto& all = *this;
  const auto with = [&](const auto& wanted, const std::string& why) {
    std::string missing, names;
    for (const auto modulus : wanted) {
      names += (names.empty() ? "" : ", ") + name_of(modulus);
      if (!all[modulus] && missing.empty()) missing = name_of(modulus);
    }
    if (!missing.empty())
      throw Error(missing + " is missing; " + why + " " + names + " together", ErrorKind::usage);
  };
  const auto given = [&](Modulus modulus) { return all[modulus].has_value(); };
  with(always, "stiffnesses are");
  const bool of_any_space = std::any_of(of_space.begin(), of_space.end(), given);
  if (of_any_space || std::any_of(of_orthorhombic.begin(), of_orthorhombic.end(), given)) {
    const std::string rock = of_any_space ? "rock with c14 to c56" : "orthorhombic rock";
    with(of_orthorhombic, rock + " has");
    with(std::array{Modulus::c66}, rock + " has c11 to c66, c12, c13, c23;");
    return;
  }
  if (!given(Modulus::c15) && !given(Modulus::c35)) return;
  with(of_tilted, "rock of a plane has");
  if (given(Modulus::c66))
    throw Error("found c15 and c35 with c66 alone, expected c22, c44, c12 and c23 of rock in 3-D, too",
                ErrorKind::usage);
}

bool GivenStiffness::are_of_any_rock() const {
  const auto given = [&](Modulus modulus) { return (*this)[modulus].has_value(); };
  return std::any_of(of_tilted.begin(), of_tilted.end(), given) ||
         std::any_of(of_space.begin(), of_space.end(), given);
}

std::optional<StiffnessFault> fault_of_stiffness(const GivenStiffness& given) {
  for (std::size_t n = 0; n < modulus_count; ++n)
    if (given.moduli[n] && !std::isfinite(*given.moduli[n]))
      return StiffnessFault{Modulus(n), "is not finite, expected a stiffness in Pa"};
  const double c33 = *given[Modulus::c33], c55 = *given[Modulus::c55];
  if (!(c33 > 0)) return fault(Modulus::c33, c33, "more than 0");
  if (c33 < 1e6)
    return fault(Modulus::c33, c33, "at least 0.001 GPa; if the numbers are in GPa, use --units GPa");
  if (!(c55 >= 0)) return fault(Modulus::c55, c55, "at least 0");
  const auto [plane, dip] = plane_of(given);
  if (c55 == 0) return fault_of_fluid(given, plane);
  if (given.are_of_any_rock()) {
    if (have_parameters(given)) return {};
    return is_of_space(given) ? fault_of_any_rock<3>(given) : fault_of_any_rock<2>(given);
  }
  if (auto of_plane = fault_of_plane(plane)) return of_plane;
  if (!given[Modulus::c66]) return {};
  return fault_in_3d(completed(given, plane), !given[Modulus::c22]);
}

Material material_of_given(const GivenStiffness& given, double rho) {
  const auto [plane, dip] = plane_of(given);
  if (*given[Modulus::c55] == 0) return {std::sqrt(plane(3, 3) / rho), 0, rho};
  if (given.are_of_any_rock() && !have_parameters(given)) {
    const auto constants = constants_of(given);
    return is_of_space(given) ? rock_of_constants(elasticity_of_constants<3>(constants), rho)
                              : rock_of_constants(elasticity_of_constants<2>(constants), rho);
  }
  auto material = material_of(completed(given, plane), rho);
  const auto tidy = [](double& parameter) {
    if (std::abs(parameter) < least_parameter) parameter = 0;
  };
  tidy(material.epsilon), tidy(material.delta), tidy(material.gamma);
  if (material.orthorhombic) {
    auto& of = *material.orthorhombic;
    tidy(of.epsilon1), tidy(of.delta1), tidy(of.delta3), tidy(of.gamma2);
    if (of == Orthorhombic{material.epsilon, material.delta, 0, material.gamma}) material.orthorhombic = {};
  }
  if (material.is_anisotropic()) material.tilt = dip * 180 / std::numbers::pi;
  return material;
}

template <int D>
Medium<D> medium_of_stiffness(const std::array<std::optional<Field<D>>, modulus_count>& given,
                              const Field<D>& rho) {
  Medium<D> medium(rho.grid());
  const auto has = [&](Modulus modulus) { return given[std::size_t(modulus)].has_value(); };
  const auto add = [&](Property property) { medium[property] = Field<D>(rho.grid()); };
  add(Property::epsilon);
  if (has(Modulus::c66)) add(Property::gamma);
  if (has(Modulus::c22)) add(Property::epsilon1);
  if (has(Modulus::c15) && !has(Modulus::c22)) add(Property::tilt);
  complete_anisotropy(medium);
  bool any_parameters = false;
  for (std::size_t cell = 0; cell < rho.size(); ++cell) {
    if (rho[cell] == 0) continue;
    const auto refuse = [&](const std::string& name, const std::string& text) {
      throw Error(name + " at " + place_of(rho.grid(), std::int64_t(cell)) + " " + text);
    };
    if (!(rho[cell] > 0) || !std::isfinite(rho[cell]))
      refuse("rho", "is " + shown(rho[cell]) + ", expected a density above 0, or 0 in void");
    GivenStiffness of_cell;
    for (std::size_t n = 0; n < modulus_count; ++n)
      if (given[n]) of_cell.moduli[n] = double((*given[n])[cell]);
    if (const auto found = fault_of_stiffness(of_cell)) refuse(name_of(found->of), found->text);
    const auto material = material_of_given(of_cell, double(rho[cell]));
    if (material.constants && !medium.has(Property::c33)) {
      add(has(Modulus::c22) ? Property::c22 : Property::c33);
      complete_anisotropy(medium);
    }
    any_parameters = any_parameters || (material.is_anisotropic_in_3d() && !material.constants);
    put(medium, cell, material);
  }
  for (const auto property : medium.properties())
    if (medium.has(Property::c33) && !any_parameters && tells_anisotropy(property) &&
        !is_elastic_constant(property))
      medium[property] = {};
  return medium;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, medium_of_stiffness);

}  // namespace slipwave
