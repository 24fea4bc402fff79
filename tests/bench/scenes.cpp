// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "model/fracture.hpp"
#include "model/prestress.hpp"

namespace slipwave::bench {
namespace {

constexpr double spacing_m = 5;

void fill(Medium<2>& medium, const Case& what) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> spread(0.95F, 1.F);
  const Index<2> shape = medium.grid().shape;
  for (std::int64_t k = 0; k < shape[1]; ++k)
    for (std::int64_t i = 0; i < shape[0]; ++i) {
      const Index<2> at{i, k};
      float size = 1;
      if (what.variety == Variety::layered) size = 0.85F + 0.05F * float(4 * k / shape[1]);
      if (what.variety == Variety::random) size = spread(engine);
      medium.vp(at) = 4500 * size;
      medium.vs(at) = what.fluid ? 0 : 2250 * size;
      medium.rho(at) = 2500 * size;
    }
}

/// Rows that roll by 15 % of their depth, most in the middle: heights of 0.81 to 1.19 cells, slopes up to
/// 0.3.
std::shared_ptr<const RowDepths<2>> rolling_rows(const Index<2>& shape) {
  const double pi = std::acos(-1.);
  std::vector<double> depths;
  for (std::int64_t k = 0; k <= shape[1]; ++k)
    for (std::int64_t i = 0; i <= shape[0]; ++i) {
      const double share = double(k) / double(shape[1]), amplitude = 0.06 * double(shape[1]);
      depths.push_back(spacing_m * (double(k) + amplitude * std::sin(pi * share) *
                                                    std::sin(20 * double(i) / double(shape[0]))));
    }
  return std::make_shared<const RowDepths<2>>(shape, std::move(depths));
}

}  // namespace

const char* name_of(Variety variety) {
  return variety == Variety::uniform ? "uniform" : variety == Variety::layered ? "layered" : "random";
}

Scene<2> make_scene(const Case& what) {
  Scene<2> scene;
  Grid<2> grid{{what.nx, what.nz}, spacing_m, {0, 0}};
  if (what.curvilinear) grid.rows = rolling_rows(grid.shape);
  scene.model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
  fill(scene.model.medium, what);
  const double width = double(what.nx) * spacing_m, depth = double(what.nz) * spacing_m;
  if (what.slipping > 0) {
    scene.model.fracture = Field<2, std::uint8_t>(grid);
    const double half = std::sqrt(what.slipping) / 2;
    FractureSet<2> set = {"cluster", {{normal_of_dip(60), 0.5, 0.01, 0, what.parting}}};
    if (what.blocks) set.systems.push_back({normal_of_dip(-30), 0.5, 0.01, 0, what.parting});
    add_fractures<2>(scene.model, set, [&](const Point<2>& p) {
      return std::abs(p[0] - width / 2) <= half * width && std::abs(p[1] - depth / 2) <= half * depth;
    });
    if (what.under_stress) set_prestress(scene.model, 1, Prestress<2>(Lithostatic{1.0}));
  }
  scene.numerics.correction = what.correction;
  scene.edges[0] = {what.others, what.others};
  scene.edges[1] = {what.top, what.others};
  scene.numerics.order = what.order;
  scene.numerics.cfl = 0.4;
  scene.numerics.time_order = what.time_order;
  scene.numerics.double_precision = what.double_precision;
  scene.numerics.tiling = what.tiling;
  scene.numerics.tiling.everywhere = !what.only_where_seen;
  const Point<2> source = {width / 2 + 1, what.at_the_surface ? 2 * spacing_m + 1 : depth / 2 + 1};
  if (what.plane_wave)
    scene.survey.sources = {{source, parse_mechanism<2>("plane:0"), parse_wavelet("ricker:20"), 1}};
  else
    scene.survey.sources = {{source, Explosion{}, parse_wavelet("ricker:20"), 1e6}};
  for (int n = 0; n < what.receivers; ++n)
    scene.survey.receivers_m.push_back({width * (0.1 + 0.8 * (n + 0.5) / what.receivers),
                                        what.at_the_surface ? 2 * spacing_m : depth * 0.3});
  scene.recording = {what.recorded, what.duration_s, 0.001};
  if (what.receivers <= 1) scene.recording.interval_s = 0.01;
  if (what.snapshot_every_s > 0) scene.snapshot_every_s = what.snapshot_every_s;
  if (what.attenuating > 0) {
    auto& medium = scene.model.medium;
    medium[Property::qp] = Field<2>(medium.grid(), float(2 * what.attenuating));
    if (!what.fluid) medium[Property::qs] = Field<2>(medium.grid(), float(what.attenuating));
    set_attenuation(scene);
  }
  return scene;
}

}  // namespace slipwave::bench
