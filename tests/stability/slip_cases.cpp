// SPDX-License-Identifier: BSD-3-Clause
#include "slip_cases.hpp"

#include <cmath>
#include <stdexcept>

namespace slipwave {

const std::vector<Cluster>& clusters() {
  static const std::vector<Cluster> all = {
      {"one cell", [](int i, int k, int n) { return i == n / 2 && k == n / 2; }, "SolidBlocksOf3Cells"},
      {"one row", [](int, int k, int n) { return k == n / 3; }, "Checkerboard1To20"},
      {"one column", [](int i, int, int n) { return i == n / 3; }, "WaterOverCurvedRock"},
      {"the row under the free surface", [](int, int k, int) { return k == 0; }, "RandomSolids"},
      {"the row under water", [](int, int k, int n) { return k == n / 2; }, "WaterOverRock"},
      {"a block inside",
       [](int i, int k, int n) { return std::abs(i - n / 2) < n / 5 && std::abs(k - 2 * n / 3) < n / 8; },
       "VpOverVs10"},
      {"everywhere, so every edge", [](int, int, int) { return true; }, "RandomMixture"},
      {"every second cell", [](int i, int k, int) { return (i + k) % 2 == 0; }, "SolidBlocksOf2Cells"},
  };
  return all;
}

const Cluster& cluster_named(const std::string& name) {
  for (const auto& cluster : clusters())
    if (name == cluster.name) return cluster;
  throw std::out_of_range("there is no cluster '" + name + "'");
}

const std::vector<Planes>& kinds_of_planes() {
  static const std::vector<Planes> all = {
      {"One", {35}, true, false},
      {"OneThatOpens", {35}, true, true},
      {"EqualBlocks", {35, 125}, true, false},
      {"Blocks", {20, 110}, false, false},
      {"BlocksThatOpen", {20, 110}, false, true},
      {"Crossing", {20, 75}, false, false},
      {"CrossingThatOpen", {-30, 30}, true, true},
      {"OneThatWeakens", {35}, true, false, true},
      {"CrossingThatWeakenAndOpen", {20, 75}, false, true, true},
  };
  return all;
}

const std::vector<Law>& laws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> laws;
    for (const double friction : {0., 0.1, 100.})
      for (const double viscosity_s : {0., 1e-300, 1., 1e3, 1e300}) laws.push_back({friction, viscosity_s});
    return laws;
  }();
  return all;
}

const std::vector<SlipCorrection>& corrections() {
  static const std::vector<SlipCorrection> all = {SlipCorrection::first, SlipCorrection::second,
                                                  SlipCorrection::exponential};
  return all;
}

std::string name_of_case(const Planes& planes, SlipCorrection correction) {
  return planes.name + std::string(correction == SlipCorrection::first    ? "First"
                                   : correction == SlipCorrection::second ? "Second"
                                                                          : "Exponential");
}

SlipSystem<2> system_of(double angle_deg, const Law& law, double strength_pa, bool opens) {
  const double angle = angle_deg * std::acos(-1.0) / 180;
  return {{std::sin(angle), -std::cos(angle)}, law.friction, law.viscosity_s, strength_pa, opens};
}

void weaken(SlipSystem<2>& system, double share, double distance_m) {
  system.law = FrictionLaw::slip_weakening;
  system.dynamic_friction = share * system.friction;
  system.slip_distance_m = distance_m;
}

FractureSet<2> set_of(const Planes& planes, const Law& law, double strength_pa) {
  FractureSet<2> set{planes.name, {}};
  for (const double angle_deg : planes.angles_deg) {
    const bool other = !planes.equal && !set.systems.empty();
    const Law own = {other ? 4 * law.friction : law.friction, law.viscosity_s};
    set.systems.push_back(system_of(angle_deg, own, other ? strength_pa + 1e5 : strength_pa, planes.open));
    if (planes.weaken) weaken(set.systems.back(), 0.1, 1e-4);
  }
  return set;
}

namespace {

bool sticks(const SlipSystem<2>& system, const PlaneStress& s) {
  const double nx = system.normal[0], nz = system.normal[1];
  const double tx = s.xx * nx + s.xz * nz, tz = s.xz * nx + s.zz * nz, s_n = nx * tx + nz * tz;
  return std::abs(nx * tz - nz * tx) <= system.friction * std::max(-s_n, 0.) + system.strength_pa &&
         !(system.opens && s_n > 0);
}

}  // namespace

PlaneStress at_the_verge(const std::vector<FractureSet<2>>& sets, double pressure_pa, double share) {
  const auto& n = sets.front().systems.front().normal;
  const auto with_shear = [&](double shear_pa) {
    const double across = 2 * n[0] * n[1] * shear_pa;
    return PlaneStress{across - pressure_pa, -across - pressure_pa, (n[1] * n[1] - n[0] * n[0]) * shear_pa};
  };
  const auto holds = [&](double shear_pa) {
    for (const auto& set : sets)
      for (const auto& system : set.systems)
        if (!sticks(system, with_shear(shear_pa))) return false;
    return true;
  };
  double low = 0, high = 1e12;
  for (int halved = 0; halved < 200; ++halved) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return with_shear(share * low);
}

std::vector<Field<2>> uniform_stress(const Grid<2>& grid, const PlaneStress& stress) {
  std::vector<Field<2>> fields;
  for (const double value : {stress.xx, stress.zz, stress.xz}) fields.emplace_back(grid, float(value));
  return fields;
}

template <class Real>
typename Lab<Real>::Setup fractured(const Medium<2>& medium, const Cluster& cluster,
                                    const FractureSet<2>& set) {
  typename Lab<Real>::Setup setup;
  setup.medium = medium;
  setup.fracture_sets = {set};
  setup.fracture = Field<2, std::uint8_t>(medium.grid());
  const int n = int(medium.grid().shape[0]);
  for (int k = 0; k < int(medium.grid().shape[1]); ++k)
    for (int i = 0; i < n; ++i) {
      const auto cell = std::size_t(k * n + i);
      setup.fracture[cell] = medium.is_solid(cell) && cluster.holds(i, k, n);
    }
  return setup;
}

template Lab<float>::Setup fractured<float>(const Medium<2>&, const Cluster&, const FractureSet<2>&);
template Lab<double>::Setup fractured<double>(const Medium<2>&, const Cluster&, const FractureSet<2>&);

std::string Rotation::shown() const {
  static const char* const edges[] = {"free", "absorbing", "rigid", "mirror"};
  return "order " + std::to_string(order()) + ", in time " + std::to_string(time_order()) + ", cfl " +
         std::to_string(cfl()) + ", edges " + edges[std::size_t(edge())] +
         (in_double() ? ", double" : ", float");
}

}  // namespace slipwave
