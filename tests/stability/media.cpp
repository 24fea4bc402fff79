// SPDX-License-Identifier: BSD-3-Clause
#include "media.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>

#include "solver/sweep/interface_stencils.hpp"

namespace slipwave {
namespace {

struct Cell {
  double vp, vs, rho;
};

constexpr Cell basement{4500, 2250, 2500}, water{1500, 0, 1000}, air{340, 0, 1.2}, steel{5900, 3200, 7800},
    hole{0, 0, 0};

/// What fills cell (i, k) of a square of n cells; draws come from `random`, uniform in 0 .. 1.
using Filling = std::function<Cell(int i, int k, int n, const std::function<double()>& random)>;

Cell solid_of(double f, double g) { return {1500 + 4500 * f, 500 + 2000 * f, 1500 + 1500 * g}; }

Filling blocks(int size) {
  return [size](int i, int k, int, const auto&) {
    const auto [f, g, unused] = draws_of(i / size, k / size, 7);
    return solid_of(f, g);
  };
}

Filling layers(int size) {
  return [size](int, int k, int, const auto&) {
    const auto [f, g, unused] = draws_of(0, k / size, 11);
    return solid_of(f, g);
  };
}

Filling over(Cell upper, Cell lower) {
  return [=](int, int k, int n, const auto&) { return k < n / 2 ? upper : lower; };
}

/// A plate of a third of the height.
Filling between(Cell outside, Cell plate) {
  return [=](int, int k, int n, const auto&) { return k >= n / 3 && k < n - n / 3 ? plate : outside; };
}

Filling pixels(Cell one, Cell other, double share = 0.5) {
  return [=](int, int, int, const auto& random) { return random() < share ? one : other; };
}

Filling checkerboard(int size, Cell one, Cell other) {
  return [=](int i, int k, int, const auto&) { return (i / size + k / size) % 2 ? one : other; };
}

/// Contrasts as large as those a stencil still runs across, and a hair larger.
Cell scaled(double ratio) { return {4500 / ratio, 2250 / ratio, 2500}; }
Cell denser(double ratio) { return {4500, 2250, 2500 * ratio}; }

const std::map<std::string, Filling>& fillings() {
  constexpr double r = strong_interface_ratio;
  static const std::map<std::string, Filling> all = {
      {"WaterOverRock", over(water, basement)},
      {"WaterOverCurvedRock",
       [](int i, int k, int n, const auto&) {
         return k < n / 2 + n / 8. * std::sin(i * 0.2) ? water : basement;
       }},
      {"WaterOverSteel", over(water, steel)},
      {"AirOverRock", over(air, basement)},
      {"AirOverSteel", over(air, steel)},
      {"RandomWaterAndRock", pixels(water, basement)},
      {"RandomAirAndRock", pixels(air, basement)},
      {"RandomAirAndSteel", pixels(air, steel)},
      {"RandomDensityRatio100", pixels({4500, 2250, 25}, basement)},
      {"RandomSolids",
       [](int, int, int, const auto& random) {
         const double f = random();
         return solid_of(f, random());
       }},
      {"SolidBlocksOf2Cells", blocks(2)},
      {"SolidBlocksOf3Cells", blocks(3)},
      {"SolidBlocksOf4Cells", blocks(4)},
      {"SolidBlocksOf5Cells", blocks(5)},
      {"SolidLayersOf1Cell", layers(1)},
      {"SolidLayersOf3Cells", layers(3)},
      {"RandomVoids", pixels(hole, basement, 0.3)},
      {"SoilOverRock", over({1000, 100, 1500}, basement)},
      {"SoilInRock", between(basement, {1000, 100, 1500})},
      {"SteelInAir", between(air, steel)},
      {"SteelInWater", between(water, steel)},
      {"SteelInSoil", between({1000, 100, 1500}, steel)},
      {"RockInSofterRock", between({2250, 1125, 2300}, basement)},
      {"SofterRockInRock", between(basement, {2250, 1125, 2300})},
      {"SoftCheckerboard", checkerboard(5, {1000, 100, 1500}, basement)},
      {"VpOverVs10",
       [](int, int, int, const auto&) {
         return Cell{4500, 450, 2500};
       }},
      {"Checkerboard1To20", checkerboard(1, {450, 225, 1250}, basement)},
      {"RandomMixture",
       [](int, int, int, const auto& random) {
         const double u = random();
         return u < 0.3 ? hole : u < 0.6 ? water : basement;
       }},
      {"ContrastBelowTheInterfaceRatio", checkerboard(1, scaled(r * 0.99), basement)},
      {"ContrastAboveTheInterfaceRatio", checkerboard(1, scaled(r * 1.01), basement)},
      {"RandomSpeedsBelowTheInterfaceRatio",
       [](int, int, int, const auto& random) {
         const double f = 1 + (r * 0.99 - 1) * random();
         return Cell{3000 * f, 1500, 2500};
       }},
      {"RandomDensitiesBelowTheInterfaceRatio",
       [](int, int, int, const auto& random) { return denser(1 + (r * 0.99 - 1) * random()); }},
      {"RandomDensitiesAboutTheInterfaceRatio", pixels(denser(1), denser(r * 1.001))},
  };
  return all;
}

}  // namespace

const std::vector<std::string>& medium_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, filling] : fillings()) all.push_back(name);
    return all;
  }();
  return names;
}

std::array<double, 3> draws_of(int column, int row, unsigned seed) {
  // Beginning an engine takes longer than a cell does in a step.
  static std::map<std::tuple<int, int, unsigned>, std::array<double, 3>> known;
  const auto [found, is_new] = known.try_emplace({column, row, seed});
  if (is_new) {
    std::seed_seq mixed{unsigned(column), unsigned(row), seed};
    std::mt19937 engine(mixed);
    for (double& draw : found->second) draw = std::uniform_real_distribution<double>(0, 1)(engine);
  }
  return found->second;
}

Medium<2> rock(int nx, int nz) {
  const Grid<2> grid{{nx, nz}, 5, {0, 0}};
  return {Field<2>(grid, float(basement.vp)), Field<2>(grid, float(basement.vs)),
          Field<2>(grid, float(basement.rho))};
}

Medium<2> of_rocks(int cells, const std::function<Material(int i, int k)>& rock_at) {
  Medium<2> medium = rock(cells, cells);
  medium[Property::epsilon] = medium[Property::delta] = Field<2>(medium.grid());
  for (int k = 0; k < cells; ++k)
    for (int i = 0; i < cells; ++i) {
      const auto rock = rock_at(i, k);
      if (rock.constants && !medium.has(Property::c33)) {
        medium[Property::c33] = Field<2>(medium.grid());
        complete_anisotropy(medium);
      }
      put(medium, std::size_t(k * cells + i), rock);
    }
  return medium;
}

Material random_anisotropic(const std::function<double()>& random) {
  for (;;) {
    const double vp = 1500 + 4500 * random(), vs = vp * (0.1 + 0.6 * random());
    const Material any{vp, vs, 1500 + 1500 * random(), -0.4 + 1.4 * random(), -0.4 + 1.4 * random()};
    if (!fault_of_anisotropy(any)) return any;
  }
}

Medium<2> medium_named(const std::string& name, int cells, unsigned seed) {
  Medium<2> medium = rock(cells, cells);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::function<double()> random = [&] { return uniform(engine); };
  for (int k = 0; k < cells; ++k)
    for (int i = 0; i < cells; ++i) {
      const Cell cell = fillings().at(name)(i, k, cells, random);
      const auto n = std::size_t(k * cells + i);
      medium.vp[n] = float(cell.vp);
      medium.vs[n] = float(cell.vs);
      medium.rho[n] = float(cell.rho);
    }
  return medium;
}

}  // namespace slipwave
