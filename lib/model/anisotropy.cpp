#include "model/anisotropy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace slipwave {
namespace {

/// Directions from the vertical to the horizontal among which the largest and smallest are searched.
constexpr int directions = 180;

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
  if (!medium.has(Property::epsilon) && !medium.has(Property::delta)) return 0;
  std::int64_t count = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) count += is_anisotropic(medium, cell);
  return count;
}

template <int D>
void complete_anisotropy(Medium<D>& medium) {
  if (medium.has(Property::epsilon) == medium.has(Property::delta)) return;
  medium[medium.has(Property::epsilon) ? Property::delta : Property::epsilon] = Field<D>(medium.grid());
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

template <int D>
Medium<D> in_slowest_directions(const Medium<D>& medium) {
  Medium<D> slowest = medium;
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    if (slowest.has(property)) slowest[property] = {};
  // Speeds go over all directions; most cells are like the one before them.
  Material last;
  PlaneSpeeds of_last;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    const auto material = material_of(medium, cell);
    if (!material.is_anisotropic()) continue;
    if (!(material == last)) of_last = slowest_speeds(last = material);
    slowest.vp[cell] = float(of_last.p);
    slowest.vs[cell] = float(of_last.s);
  }
  return slowest;
}

std::optional<AnisotropyFault> fault_of_anisotropy(const Material& material) {
  const auto& [vp, vs, rho, epsilon, delta, tilt] = material;
  if (!material.is_anisotropic() && tilt != 0)
    return AnisotropyFault{Property::tilt,
                           "is " + shown(tilt, 6) +
                               ", expected 0 where epsilon and delta are 0: isotropic rock has "
                               "no axis; set one of them, or leave the tilt out there"};
  if (!material.is_anisotropic() || rho == 0) return {};
  if (vs == 0) {
    const auto of = epsilon != 0 ? Property::epsilon : Property::delta;
    return AnisotropyFault{of,
                           "is " + shown(epsilon != 0 ? epsilon : delta, 6) +
                               ", expected 0 in fluid, which is isotropic; set it to 0 or vs above 0 there"};
  }
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
  return {};
}

template std::int64_t anisotropic_cells(const Medium<2>&);
template std::int64_t anisotropic_cells(const Medium<3>&);
template void complete_anisotropy(Medium<2>&);
template void complete_anisotropy(Medium<3>&);
template Medium<2> in_slowest_directions(const Medium<2>&);
template Medium<3> in_slowest_directions(const Medium<3>&);

}  // namespace slipwave
