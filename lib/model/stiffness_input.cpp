// SPDX-License-Identifier: BSD-3-Clause
#include "model/stiffness_input.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "model/anisotropy.hpp"

namespace slipwave {
namespace {

/// Less, as a share of c33 or of 1, is the rounding of floats.
constexpr double rounding = 1e-5, least_parameter = 1e-6;
constexpr std::array always = {Modulus::c11, Modulus::c13, Modulus::c33, Modulus::c55};
constexpr std::array orthorhombic = {Modulus::c22, Modulus::c44, Modulus::c12, Modulus::c23};

const std::string& name_of(Modulus of) { return modulus_names()[std::size_t(of)]; }

/// A stiffness in the plane of x and z and its axes: the upright one and the dip of its beds.
struct AxesOfPlane {
  Stiffness upright;
  double dip_rad = 0;
};

/// By the parts of a stiffness that turn with twice and four times the angle; beds are the stiffer side.
AxesOfPlane axes_of(const PlaneStiffness& c) {
  const double twice[] = {c.c11 - c.c33, 2 * (c.c15 + c.c35)};
  const double four[] = {c.c11 + c.c33 - 2 * c.c13 - 4 * c.c55, 4 * (c.c15 - c.c35)};
  const double still = c.c11 + c.c33 + 2 * c.c13, shear = c.c55 - c.c13;
  double dip = std::atan2(twice[1], twice[0]) / 2;
  if (std::hypot(twice[0], twice[1]) < rounding * c.c33) dip = std::atan2(four[1], four[0]) / 4;
  const double apart = twice[0] * std::cos(2 * dip) + twice[1] * std::sin(2 * dip),
               of_four = four[0] * std::cos(4 * dip) + four[1] * std::sin(4 * dip);
  const double sum = (of_four + 3 * still + 4 * shear) / 4, c13 = (still - sum) / 2;
  return {{(sum + apart) / 2, c13, (sum - apart) / 2, shear + c13}, dip};
}

bool differ(const PlaneStiffness& one, const PlaneStiffness& other) {
  const auto apart = {one.c11 - other.c11, one.c13 - other.c13, one.c15 - other.c15,
                      one.c33 - other.c33, one.c35 - other.c35, one.c55 - other.c55};
  return std::any_of(apart.begin(), apart.end(), [&](double by) { return std::abs(by) > 1e-3 * one.c33; });
}

/// All of them, those that are not given as where rock is alike in all horizontal directions.
OrthorhombicStiffness completed(const GivenStiffness& given, const Stiffness& plane) {
  const auto [c11, c13, c33, c55] = plane;
  const double c66 = given[Modulus::c66].value_or(c55);
  if (!given[Modulus::c22]) return {c11, c11, c33, c55, c55, c66, c11 - 2 * c66, c13, c13};
  return {c11, *given[Modulus::c22], c33, *given[Modulus::c44], c55,
          c66, *given[Modulus::c12], c13, *given[Modulus::c23]};
}

AxesOfPlane plane_of(const GivenStiffness& given) {
  const double c11 = *given[Modulus::c11], c13 = *given[Modulus::c13], c33 = *given[Modulus::c33],
               c55 = *given[Modulus::c55];
  if (!given[Modulus::c15]) return {{c11, c13, c33, c55}};
  const double c15 = *given[Modulus::c15], c35 = *given[Modulus::c35];
  if (std::max(std::abs(c15), std::abs(c35)) < rounding * c33) return {{c11, c13, c33, c55}};
  return axes_of({c11, c13, c15, c33, c35, c55});
}

std::string gpa(double pascal) { return shown(pascal / 1e9, 6) + " GPa"; }
StiffnessFault fault(Modulus of, double value, const std::string& rest) {
  return {of, "is " + gpa(value) + ", expected " + rest};
}

/// Of two axes: c_ab with c_aa, c_bb and their shear modulus.
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

std::optional<StiffnessFault> fault_of_fluid(const GivenStiffness& given, const Stiffness& plane) {
  for (const auto& [modulus, value] : {std::pair{Modulus::c11, plane.c11}, {Modulus::c13, plane.c13}})
    if (std::abs(value - plane.c33) > 1e-3 * plane.c33)
      return fault(modulus, value, "c33 = " + gpa(plane.c33) + " in fluid, where c55 is 0");
  for (const auto modulus : {Modulus::c66, Modulus::c44})
    if (given[modulus].value_or(0) != 0) return fault(modulus, *given[modulus], "0 in fluid, where c55 is 0");
  return {};
}

std::optional<StiffnessFault> fault_of_plane(const Stiffness& plane) {
  const auto& [c11, c13, c33, c55] = plane;
  const std::string slower = ", or P waves would be slower than S waves";
  if (!(c33 > c55)) return fault(Modulus::c33, c33, "more than c55 = " + gpa(c55) + slower);
  if (!(c11 > c55)) return fault(Modulus::c11, c11, "more than c55 = " + gpa(c55) + slower);
  return fault_of_pair(Modulus::c13, c13, c11, c33, c55, "c11 c33");
}

std::optional<StiffnessFault> fault_in_space(const OrthorhombicStiffness& c, bool alike) {
  if (!(c.c66 > 0)) return fault(Modulus::c66, c.c66, "more than 0, as c55 is");
  if (alike) {
    const double most = c.c11 - c.c13 * c.c13 / c.c33;
    if (c.c66 < most) return {};
    return fault(Modulus::c66, c.c66,
                 "less than " + gpa(most) +
                     ": (c11 - c66) c33 must be more than c13^2, or the rock would give "
                     "energy");
  }
  if (!(c.c44 > 0 && c.c44 < c.c33)) return fault(Modulus::c44, c.c44, "more than 0 and less than c33");
  if (!(c.c66 < c.c11)) return fault(Modulus::c66, c.c66, "less than c11 = " + gpa(c.c11));
  if (!(c.c22 > std::max(c.c44, c.c66))) return fault(Modulus::c22, c.c22, "more than c44 and c66");
  if (auto of_xy = fault_of_pair(Modulus::c12, c.c12, c.c11, c.c22, c.c66, "c11 c22")) return of_xy;
  if (auto of_yz = fault_of_pair(Modulus::c23, c.c23, c.c22, c.c33, c.c44, "c22 c33")) return of_yz;
  const double determinant = c.c11 * (c.c22 * c.c33 - c.c23 * c.c23) -
                             c.c12 * (c.c12 * c.c33 - c.c13 * c.c23) +
                             c.c13 * (c.c12 * c.c23 - c.c13 * c.c22);
  if (determinant > 0) return {};
  return fault(Modulus::c12, c.c12,
               "another value: with c13 and c23 the determinant of c11 to c33 must be above 0, or the rock "
               "would give energy");
}

}  // namespace

const std::array<std::string, modulus_count>& modulus_names() {
  static const std::array<std::string, modulus_count> names = {"c11", "c13", "c33", "c55", "c15", "c35",
                                                               "c66", "c22", "c44", "c12", "c23"};
  return names;
}

PropertyRow row_of(Modulus modulus) {
  const bool tilted = modulus == Modulus::c15 || modulus == Modulus::c35;
  const bool in_plane = std::find(always.begin(), always.end(), modulus) != always.end();
  return {.name = name_of(modulus),
          .long_name = "stiffness " + name_of(modulus),
          .help = "stiffness " + name_of(modulus) + ", Pa" +
                  (in_plane                  ? "; with the others of c11, c13, c33, c55 instead of vp and vs"
                   : tilted                  ? ", of axes that are tilted in the plane of x and z"
                   : modulus == Modulus::c66 ? ", in 3-D"
                                             : ", of orthorhombic rock") +
                  ", a file or a number",
          .units = "Pa",
          .shown_unit = "Pa",
          .si = {"Pa"}};
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
  if (std::any_of(orthorhombic.begin(), orthorhombic.end(), given)) {
    with(orthorhombic, "orthorhombic rock has");
    with(std::array{Modulus::c66}, "orthorhombic rock has c11 to c66, c12, c13, c23;");
  }
  if (!given(Modulus::c15) && !given(Modulus::c35)) return;
  with(std::array{Modulus::c15, Modulus::c35}, "tilted axes have");
  for (const auto modulus : {Modulus::c66, Modulus::c22})
    if (given(modulus))
      throw Error("found c15 and c35 with " + name_of(modulus) +
                      ", expected one of both: in 3-D tilt, azimuth and rotation turn the axes",
                  ErrorKind::usage);
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
  if (given[Modulus::c15]) {
    const double c15 = *given[Modulus::c15];
    const auto found = tilted(plane, dip);
    if (differ({*given[Modulus::c11], *given[Modulus::c13], c15, c33, *given[Modulus::c35], c55}, found))
      return fault(Modulus::c15, c15,
                   gpa(found.c15) + " of the axes of symmetry that are nearest, tilted by " +
                       shown(dip * 180 / std::numbers::pi, 4) +
                       " degrees: rock of two axes in the plane is swept, none without");
  }
  if (auto of_plane = fault_of_plane(plane)) return of_plane;
  if (!given[Modulus::c66]) return {};
  return fault_in_space(completed(given, plane), !given[Modulus::c22]);
}

Material material_of_given(const GivenStiffness& given, double rho) {
  const auto [plane, dip] = plane_of(given);
  if (plane.c55 == 0) return {std::sqrt(plane.c33 / rho), 0, rho};
  auto material = material_of_stiffness_in_space(completed(given, plane), rho);
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

Medium<2> medium_of_stiffness(const std::array<std::optional<Field<2>>, modulus_count>& given,
                              const Field<2>& rho) {
  Medium<2> medium(rho.grid());
  const auto has = [&](Modulus modulus) { return given[std::size_t(modulus)].has_value(); };
  medium[Property::epsilon] = Field<2>(rho.grid());
  if (has(Modulus::c66)) medium[Property::gamma] = Field<2>(rho.grid());
  if (has(Modulus::c22)) medium[Property::epsilon1] = Field<2>(rho.grid());
  if (has(Modulus::c15)) medium[Property::tilt] = Field<2>(rho.grid());
  complete_anisotropy(medium);
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
    put(medium, cell, material_of_given(of_cell, double(rho[cell])));
  }
  return medium;
}

}  // namespace slipwave
