// Cells whose axes of symmetry do not lie along the grid: tilted means.
#include <gtest/gtest.h>

#include <numbers>

#include "lab.hpp"
#include "model/layers.hpp"
#include "model/tilted_mean.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"
#include "solver/simulation.hpp"
#include "vti_stack.hpp"

namespace slipwave::solver {
namespace {

/// Water over rocks whose interfaces dip both ways, and meet.
Scene<2> wedges(double time_order = 2) {
  Scene<2> scene;
  const Grid<2> grid{{150, 120}, 5, {0, 0}};
  scene.model.medium = layered_medium(grid,
                                      {{-1e4, 1500, 0, 1000},
                                       {100, 2000, 1150, 2000},
                                       {150, 4000, 2300, 2300, 18},
                                       {560, 2500, 1200, 2100, -25}},
                                      Average::tilted);
  scene.survey.sources = {{{301, 203}, parse_mechanism<2>("force:0.6,0.8"), parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = {{150, 140}, {420, 330}, {600, 60}, {333, 480}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.time_order = int(time_order);
  scene.recording = {{Component::vx, Component::szz}, 0.25, 0.002};
  return scene;
}

}  // namespace

TEST(TiltedMeans, OfAWholeRockAreARotatedOne) {
  constexpr Material shale{3000, 1600, 2300, 0.2, 0.1};
  constexpr double dip_deg = 27, dip = dip_deg * std::numbers::pi / 180, h = 5, middle = 350;
  const Point<2> along{std::cos(dip), std::sin(dip)}, down{-along[1], along[0]};
  const auto turned = [&](double a, double b) {
    return Point<2>{a * along[0] + b * down[0], a * along[1] + b * down[1]};
  };
  Scene<2> scene;
  const Grid<2> grid{{140, 140}, h, {0, 0}};
  scene.model.medium = Medium<2>(grid);
  add_tilted_means(scene.model.medium);
  for (std::size_t cell = 0; cell < std::size_t(grid.size()); ++cell) {
    put(scene.model.medium, cell, {shale.vp, shale.vs, shale.rho});
    put_tilted_mean(scene.model.medium, cell, shale, dip);
  }
  const std::vector<VtiStack::Receiver> receivers = {{0, 100}, {60, 80}, {90, 40}, {-90, 50}, {70, -80}};
  const auto force = turned(0.6, 0.8);
  scene.survey.sources = {{{middle, middle}, PointForce<2>{force}, parse_wavelet("ricker:20"), 1e6}};
  for (const auto& at : receivers) {
    const auto place = turned(at.x, at.z);
    scene.survey.receivers_m.push_back({middle + place[0], middle + place[1]});
  }
  scene.edges = edges_all(EdgeLaw::absorbing);
  // Before anything comes back from zones, which are isotropic.
  scene.recording = {{Component::vx, Component::vz}, 0.2, 0.001};
  check(scene);
  const auto gather = shoot(scene, 1);
  VtiStack stack{{{stiffness_of(shale), shale.rho}}, {}};
  stack.force = {0.6, 0.8};
  const auto exact = stack.ricker(20, 0.001, std::size_t(gather.axis.count), receivers);
  std::vector<double> found, wanted;
  for (std::size_t r = 0; r < receivers.size(); ++r)
    for (std::size_t n = 0; n < std::size_t(gather.axis.count); ++n) {
      const double vx = gather.traces[r].samples[n], vz = gather.traces[receivers.size() + r].samples[n];
      found.push_back(vx * along[0] + vz * along[1]);
      found.push_back(vx * down[0] + vz * down[1]);
      wanted.push_back(1e6 * exact[r][0][n]);
      wanted.push_back(1e6 * exact[r][1][n]);
    }
  EXPECT_LT(relative_error(found, wanted), 0.02);
}

TEST(TiltedMeans, GiveTheBitsOfThePlainExecutorInTiles) {
  for (const int time_order : {2, 4}) {
    SCOPED_TRACE(std::to_string(time_order));
    auto scene = wedges();
    ASSERT_GT(tilted_means(scene.model.medium), 200);
    scene.numerics.time_order = time_order;
    scene.numerics.double_precision = time_order == 4;
    scene.numerics.order = time_order == 4 ? 7 : 5;
    expect_same(scene);
  }
}

TEST(TiltedMeans, GiveTheBitsOfOneProcessOnSeveral) {
  const auto scene = wedges();
  const auto alone = all_samples(shoot(scene, 1));
  for (const int ranks : {2, 3}) EXPECT_TRUE(all_samples(shared_out(scene, ranks)) == alone) << ranks;
}

TEST(TiltedMeans, AreIsotropicWhereRockSlipsOrAttenuates) {
  auto scene = wedges();
  scene.model.fracture_sets = {{"all", {{{0, 1}, 0.3, 1000, 0}}}};
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 0);
  for (std::size_t cell = 0; cell < scene.model.fracture.size(); ++cell)
    scene.model.fracture[cell] = scene.model.medium.is_solid(cell) ? 1 : 0;
  auto isotropic = scene;
  drop_tilted_means(isotropic.model.medium);
  EXPECT_TRUE(all_samples(shoot(scene, 1)) == all_samples(shoot(isotropic, 1)));
  scene.with_slip = isotropic.with_slip = false;
  EXPECT_FALSE(all_samples(shoot(scene, 1)) == all_samples(shoot(isotropic, 1)));
}

}  // namespace slipwave::solver
