// SPDX-License-Identifier: BSD-3-Clause
// Energy of anisotropic rock, upright and tilted, in rows that bend.
#include <cmath>
#include <numbers>

#include "any_stiffness.hpp"
#include "fitted_lab.hpp"
#include "media.hpp"

namespace slipwave::fitted_anisotropy_test {
namespace {

constexpr double h = 5;
const Below water{nullptr, 1500, 0, 1000}, air{nullptr, 340, 0, 1.2};

/// Gives solid cells of a medium epsilon, delta and, where it `tilts`, a tilt, by blocks of cells; speeds
/// stay.
void make_anisotropic(Medium<2>& medium, unsigned seed, int block, bool tilts) {
  const auto& grid = medium.grid();
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(grid);
  const auto across = (grid.shape[0] + block - 1) / block, down = (grid.shape[1] + block - 1) / block;
  std::vector<std::array<double, 3>> drawn(std::size_t(across * down));
  for (auto& one : drawn)
    one = {-0.4 + 1.4 * uniform(engine), -0.4 + 1.4 * uniform(engine),
           tilts ? 180 * uniform(engine) - 90 : 0};
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const auto cell = std::size_t(n);
    if (!medium.is_solid(cell)) continue;
    const auto& [epsilon, delta, tilt] = drawn[std::size_t(at[1] / block * across + at[0] / block)];
    for (double share = 1;; share *= 0.7) {
      Material any = material_of(medium, cell);
      any.epsilon = share * epsilon, any.delta = share * delta, any.tilt = tilt;
      if (fault_of_anisotropy(any)) continue;
      medium[Property::epsilon][cell] = float(any.epsilon);
      medium[Property::delta][cell] = float(any.delta);
      medium[Property::tilt][cell] = float(any.tilt);
      break;
    }
  }
}

struct Kind {
  const char* name;
  std::vector<Below> layers;
  bool surface;
};

std::vector<Kind> kinds(int nx, int nz) {
  const double middle = nx * h / 2, depth = (nz / 2 + 0.37) * h;
  const auto plane = [&](double degrees, double at) {
    return dipping(at, std::tan(degrees * std::numbers::pi / 180), middle);
  };
  const auto curve = [=](double x, double) {
    return depth + h * std::sin(2 * std::numbers::pi * x / (20 * h));
  };
  const auto rock = [](auto top, double vp, double vs, double rho) { return Below{top, vp, vs, rho}; };
  return {
      {"WaterDip15", {water, rock(plane(15, depth), 4500, 2250, 2500)}, false},
      {"WaterDip45", {water, rock(plane(45, depth), 3000, 1600, 2200)}, false},
      {"AirDip30", {air, rock(plane(30, depth), 5900, 3200, 7800)}, false},
      {"SoftOverHardDip30", {{nullptr, 2500, 1200, 2000}, rock(plane(30, depth), 4500, 2250, 2500)}, false},
      {"MudOverHardDip45", {{nullptr, 1800, 400, 1800}, rock(plane(45, depth), 6000, 3500, 2800)}, false},
      {"CurvedFloor", {water, rock(curve, 4500, 2250, 2500)}, false},
      {"SurfaceDip30", {rock(plane(30, depth - nz / 4 * h), 3000, 1600, 2200)}, true},
      {"SurfaceDip45", {rock(plane(45, depth - nz / 4 * h), 4500, 2250, 2500)}, true}};
}

class FittedAnisotropy : public ::testing::TestWithParam<int> {
 protected:
  Medium<2> medium(unsigned seed, int block, bool tilts) const {
    const Grid<2> grid{{20, 44}, h, {0, 0}};
    const auto kind = kinds(int(grid.shape[0]), int(grid.shape[1]))[std::size_t(GetParam())];
    SCOPED_TRACE(kind.name);
    auto made = fitted_medium<2>(grid, kind.layers, kind.surface);
    make_anisotropic(made, seed, block, tilts);
    return made;
  }
  const ThreadLimit one_thread_{1};
  static constexpr int steps_ = 150, long_run_ = 5000;
};

// Proves (F13).
TEST_P(FittedAnisotropy, NeverAddsEnergy) {
  unsigned seed = 1;
  for (const bool tilts : {false, true})
    for (const int block : {1, 6, 100})
      for (const int order : long_form()
                                 ? share_of(std::vector{1, 3, 5, 7, 9, 11}, std::size_t(block + tilts))
                                 : std::vector{block == 6 ? 7 : 5}) {
        const auto edge = seed % 2 ? EdgeLaw::free : EdgeLaw::rigid;
        const bool weak = seed % 3 == 0;
        SCOPED_TRACE("seed " + std::to_string(seed) + " block " + std::to_string(block) +
                     (tilts ? " tilted" : " upright"));
        expect_no_growth<double>(medium(seed, block, tilts), all_edges(edge), {order, 2, weak ? 0.6 : 1},
                                 steps_, long_run_);
        ++seed;
      }
}

// Proves (F14).
TEST_P(FittedAnisotropy, NeverAddsEnergyInFloatAndAtFourthOrderInTime) {
  for (const int order : {5, 7}) {
    expect_no_growth<float>(medium(5, 6, true), all_edges(EdgeLaw::free), {order}, steps_, long_run_);
    expect_no_growth<double>(medium(6, 6, true), all_edges(EdgeLaw::free), {order, 4, 2}, steps_ / 2,
                             long_run_ / 2);
  }
}

// Proves (F13).
TEST_P(FittedAnisotropy, OfAnyStiffnessNeverAddsEnergy) {
  for (const auto& [block, order] : {std::pair{1, 5}, {6, 7}, {100, 5}}) {
    auto of_any = medium(1, 1, false);
    put_any_stiffness(of_any, unsigned(block), block);
    expect_no_growth<double>(of_any, all_edges(block == 6 ? EdgeLaw::rigid : EdgeLaw::free), {order}, steps_,
                             long_run_);
  }
}

TEST_P(FittedAnisotropy, StaysBoundedInThePml) {
  FittedLab<2, double> lab(medium(3, 100, true), edges_below(EdgeLaw::absorbing, EdgeLaw::absorbing),
                           {5, 2, matched_cfl, 8, 30});
  const double begin = lab.energy();
  for (int n = 0; n < 300; ++n) lab.step();
  const double early = lab.energy();
  EXPECT_LT(early, begin);
  for (int n = 0; n < (long_form() ? 20000 : 400); ++n) lab.step();
  // Written so that NaN fails.
  EXPECT_TRUE(lab.energy() < 1.001 * early) << lab.energy() << ", it was " << early;
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedAnisotropy,
                         ::testing::ValuesIn(share_of(std::vector{0, 1, 2, 3, 4, 5, 6, 7}, 0)),
                         [](const auto& info) { return kinds(20, 44)[std::size_t(info.param)].name; });

}  // namespace
}  // namespace slipwave::fitted_anisotropy_test
