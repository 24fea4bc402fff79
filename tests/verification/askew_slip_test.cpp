// SPDX-License-Identifier: BSD-3-Clause
// Slip on planes that lie askew to the axes of anisotropic rock, against the same experiment turned.
#include <gtest/gtest.h>

#include "anisotropic_scene.hpp"
#include "model/fracture.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

/// A disc of planes that slide along the beds of a shale, and its beds, which dip by so much; source and
/// receivers turn with them.
struct Turned {
  double dip_deg;
  double friction = 0.2, viscosity_s = 200;
  double h = 4;

  Point<2> at(double x, double z) const {
    const double dip = dip_deg * std::numbers::pi / 180, middle = 300;
    return {middle + x * std::cos(dip) - z * std::sin(dip), middle + x * std::sin(dip) + z * std::cos(dip)};
  }
  Scene<2> scene() const {
    Scene<2> scene;
    const auto cells = std::int64_t(600 / h);
    const Grid<2> grid{{cells, cells}, h, {0, 0}};
    Medium<2> medium(grid);
    for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
      medium[property] = Field<2>(grid);
    for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
      put(medium, cell, {3000, 1600, 2300, 0.2, 0.1, dip_deg});
    scene.model.medium = medium;
    FractureSet<2> set{"beds", {{normal_of_dip(dip_deg), friction, viscosity_s, 0}}};
    const auto middle = at(0, 0);
    add_fractures<2>(scene.model, set, [&](const Point<2>& place) {
      return std::hypot(place[0] - middle[0], place[1] - middle[1]) < 60;
    });
    const auto force = at(0.6, 0.8), none = at(0, 0);
    scene.survey.sources = {{at(-20, -150), PointForce<2>{{force[0] - none[0], force[1] - none[1]}},
                             parse_wavelet("ricker:20"), 1e6}};
    for (const auto& [x, z] : {std::pair{0., 130.}, {110., 90.}, {-130., 40.}})
      scene.survey.receivers_m.push_back(at(x, z));
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.recording = {{Component::vx, Component::vz}, 0.25, 0.001};
    check(scene);
    return scene;
  }
  /// Velocities along and across the beds.
  std::vector<double> traces(bool slips = true) const {
    auto shot = scene();
    shot.with_slip = slips;
    const auto gather = shoot(shot, 1);
    const double dip = dip_deg * std::numbers::pi / 180;
    std::vector<double> all;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t n = 0; n < gather.traces[r].samples.size(); ++n) {
        const double vx = gather.traces[r].samples[n], vz = gather.traces[r + 3].samples[n];
        all.push_back(vx * std::cos(dip) + vz * std::sin(dip));
        all.push_back(vz * std::cos(dip) - vx * std::sin(dip));
      }
    return all;
  }
};

std::vector<double> difference(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t n = 0; n < one.size(); ++n) one[n] -= other[n];
  return one;
}

// Proves (S34).
TEST(AskewSlip, OfBedsThatDipIsThatOfFlatBedsTurned) {
  const Turned flat{0}, dipping{30};
  const auto of_flat = difference(flat.traces(), flat.traces(false)),
             of_dipping = difference(dipping.traces(), dipping.traces(false));
  EXPECT_GT(relative_error(flat.traces(), flat.traces(false)), 0.05);
  EXPECT_LT(relative_error(of_dipping, of_flat), 0.05);
}

}  // namespace
}  // namespace slipwave::solver
