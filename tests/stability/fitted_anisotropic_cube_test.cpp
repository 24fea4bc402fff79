// SPDX-License-Identifier: BSD-3-Clause
// Energy of anisotropic rock in 3-D, upright and tilted, in rows that bend.
#include <cmath>
#include <numbers>

#include "any_stiffness.hpp"
#include "fitted_lab.hpp"
#include "media.hpp"

namespace slipwave::fitted_anisotropic_cube_test {
namespace {

constexpr double h = 5;
const Below water{nullptr, 1500, 0, 1000}, air{nullptr, 340, 0, 1.2};

/// Gives solid cells of a medium anisotropy of any kind and, where it `tilts`, any axes, by blocks of cells;
/// vp, vs and rho stay.
void make_anisotropic(Medium<3>& medium, unsigned seed, int block, bool tilts) {
  const auto& grid = medium.grid();
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto property : {Property::epsilon1, Property::tilt, Property::azimuth, Property::rotation})
    medium[property] = Field<3>(grid);
  complete_anisotropy(medium);
  std::array<std::int64_t, 3> blocks{};
  for (std::size_t axis = 0; axis < 3; ++axis) blocks[axis] = (grid.shape[int(axis)] + block - 1) / block;
  const auto angle = [&](double most) { return tilts ? most * (2 * uniform(engine) - 1) : 0; };
  std::vector<Material> drawn(std::size_t(blocks[0] * blocks[1] * blocks[2]));
  for (auto& one : drawn) {
    const auto any = [&] { return -0.4 + 1.2 * uniform(engine); };
    one.epsilon = any(), one.delta = any(), one.gamma = any();
    one.orthorhombic = Orthorhombic{any(), any(), 0.5 * any(), any()};
    one.tilt = angle(90), one.azimuth = angle(180), one.rotation = angle(180);
  }
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto at = grid.index(n);
    const auto cell = std::size_t(n);
    if (!medium.is_solid(cell)) continue;
    const auto& of =
        drawn[std::size_t((at[2] / block * blocks[1] + at[1] / block) * blocks[0] + at[0] / block)];
    for (double share = 1;; share *= 0.7) {
      Material any = of;
      any.vp = medium.vp[cell], any.vs = medium.vs[cell], any.rho = medium.rho[cell];
      any.epsilon *= share, any.delta *= share, any.gamma *= share;
      auto& more = *any.orthorhombic;
      more.epsilon1 *= share, more.delta1 *= share, more.delta3 *= share, more.gamma2 *= share;
      if (fault_of_anisotropy(any, true)) continue;
      put(medium, cell, any);
      break;
    }
  }
}

struct Kind {
  const char* name;
  std::vector<Below> layers;
  bool surface;
};

std::vector<Kind> kinds(const Index<3>& shape) {
  const double x0 = double(shape[0]) * h / 2, y0 = double(shape[1]) * h / 2,
               depth = (double(shape[2] / 2) + 0.37) * h, high = depth - double(shape[2]) / 6 * h;
  const auto plane = [=](double degrees, double strike_deg, double at) {
    const double slope = std::tan(degrees * std::numbers::pi / 180),
                 strike = strike_deg * std::numbers::pi / 180;
    return [=](double x, double y) {
      return at + slope * (std::cos(strike) * (x - x0) + std::sin(strike) * (y - y0));
    };
  };
  const auto curve = [=](double x, double y) {
    return depth + h * std::sin(x / (2.5 * h)) * std::cos(y / (3 * h));
  };
  const auto rock = [](auto top, double vp, double vs, double rho) { return Below{top, vp, vs, rho}; };
  return {
      {"WaterDip15", {water, rock(plane(15, 0, depth), 4500, 2250, 2500)}, false},
      {"WaterDip45AlongY", {water, rock(plane(45, 90, depth), 3000, 1600, 2200)}, false},
      {"AirDip30", {air, rock(plane(30, 30, depth), 5900, 3200, 7800)}, false},
      {"SoftOverHardDip30",
       {{nullptr, 2500, 1200, 2000}, rock(plane(30, -50, depth), 4500, 2250, 2500)},
       false},
      {"MudOverHardDip45", {{nullptr, 1800, 400, 1800}, rock(plane(45, 0, depth), 6000, 3500, 2800)}, false},
      {"CurvedFloor", {water, rock(curve, 4500, 2250, 2500)}, false},
      {"SurfaceDip30", {rock(plane(30, 60, high), 3000, 1600, 2200)}, true},
      {"SurfaceDip45", {rock(plane(45, 0, high), 4500, 2250, 2500)}, true}};
}

class FittedAnisotropyInSpace : public ::testing::TestWithParam<int> {
 protected:
  Medium<3> medium(unsigned seed, int block, bool tilts) const {
    const Grid<3> grid{long_form() ? Index<3>{12, 10, 34} : Index<3>{10, 8, 26}, h, {0, 0, 0}};
    const auto kind = kinds(grid.shape)[std::size_t(GetParam())];
    auto made = fitted_medium<3>(grid, kind.layers, kind.surface);
    make_anisotropic(made, seed, block, tilts);
    return made;
  }
  const ThreadLimit one_thread_{1};
  const int steps_ = long_form() ? 200 : 30;
};

// Proves (F16).
TEST_P(FittedAnisotropyInSpace, NeverAddsEnergy) {
  unsigned seed = 1;
  for (const bool tilts : {false, true})
    for (const int block : {1, 5, 100})
      for (const int order : long_form()
                                 ? share_of(std::vector{1, 3, 5, 7, 9, 11}, std::size_t(block + tilts))
                                 : std::vector{block == 5 ? 7 : 5}) {
        const auto edge = seed % 2 ? EdgeLaw::free : EdgeLaw::rigid;
        SCOPED_TRACE("seed " + std::to_string(seed) + " block " + std::to_string(block) +
                     (tilts ? " tilted" : " upright"));
        expect_no_growth<double>(medium(seed, block, tilts), all_edges<3>(edge),
                                 {order, 2, seed % 3 == 0 ? 0.6 : 1}, steps_, 0);
        ++seed;
      }
  if (long_form() && GetParam() == 0)
    expect_no_growth<double>(medium(7, 5, true), all_edges<3>(EdgeLaw::free), {5}, steps_, 20000);
}

// Proves (F16).
TEST_P(FittedAnisotropyInSpace, NeverAddsEnergyInFloatAndAtFourthOrderInTime) {
  for (const int order : {5, 7}) {
    expect_no_growth<float>(medium(5, 5, true), all_edges<3>(EdgeLaw::free), {order}, steps_, 0);
    expect_no_growth<double>(medium(6, 5, true), all_edges<3>(EdgeLaw::free), {order, 4, 2}, steps_ / 2, 0);
  }
}

// Proves (F16).
TEST_P(FittedAnisotropyInSpace, OfAnyStiffnessNeverAddsEnergy) {
  for (const auto& [block, order] : {std::pair{1, 5}, {5, 7}, {100, 5}}) {
    auto of_any = medium(1, 1, false);
    put_any_stiffness(of_any, unsigned(block), block);
    expect_no_growth<double>(of_any, all_edges<3>(block == 5 ? EdgeLaw::rigid : EdgeLaw::free), {order},
                             steps_, 0);
  }
}

// Proves (F16).
TEST_P(FittedAnisotropyInSpace, StaysBoundedInThePml) {
  FittedLab<3, double> lab(medium(3, 100, true), all_edges<3>(EdgeLaw::absorbing),
                           {5, 2, matched_cfl, 6, 30});
  const double begin = lab.energy();
  const int first = long_form() ? 300 : 30;
  for (int n = 0; n < first; ++n) lab.step();
  const double early = lab.energy();
  EXPECT_LT(early, begin);
  for (int n = 0; n < (long_form() ? 2000 : 40); ++n) lab.step();
  // Written so that NaN fails.
  EXPECT_TRUE(lab.energy() < 1.001 * early) << lab.energy() << ", it was " << early;
}

INSTANTIATE_TEST_SUITE_P(HardMedia, FittedAnisotropyInSpace,
                         ::testing::ValuesIn(share_of(std::vector{0, 1, 2, 3, 4, 5, 6, 7}, 1)),
                         [](const auto& info) {
                           return kinds({12, 10, 34})[std::size_t(info.param)].name;
                         });

}  // namespace
}  // namespace slipwave::fitted_anisotropic_cube_test
