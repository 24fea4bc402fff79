// SPDX-License-Identifier: BSD-3-Clause
#include "plot/rock_picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "plot/panel.hpp"
#include "rock/anisotropy.hpp"
#include "rock/elasticity.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave::plot {
namespace {

constexpr int points = 361;

/// A value of each of P and S waves; S is left out in fluid.
using OfWaves = std::function<PlaneSpeeds(double)>;

struct Curves {
  Axis x, y;
  std::vector<std::pair<std::string, std::vector<double>>> lines;  // of `points` values each
  double at(int n) const { return x.low + (x.high - x.low) * n / (points - 1); }
};

/// Room above and below values between these.
void set_heights(Curves& curves, double low, double high) {
  const double room = std::max(0.08 * (high - low), 0.01 * high);
  curves.y.low = std::max(low - room, 0.), curves.y.high = high + room;
}

Curves curves_of(const Axis& x, const Axis& y, bool solid, const std::array<std::string, 2>& names,
                 const OfWaves& of_waves) {
  Curves curves{x, y, {{names[0], {}}}};
  if (solid) curves.lines.push_back({names[1], {}});
  double low = 1e300, high = 0;
  for (int n = 0; n < points; ++n) {
    const auto both = of_waves(curves.at(n));
    for (std::size_t wave = 0; wave < curves.lines.size(); ++wave) {
      const double value = wave == 0 ? both.p : both.s;
      curves.lines[wave].second.push_back(value);
      low = std::min(low, value), high = std::max(high, value);
    }
  }
  set_heights(curves, low, high);
  return curves;
}

Axis angles() { return {"angle of the front from the vertical, towards +x", "degrees", -90, 90}; }

Curves speeds_by_angle(const Material& material) {
  const auto c = elasticity_of<2>(material);
  return curves_of(angles(), {"phase speed", "m/s"}, material.vs > 0, {"P", "S"}, [&](double angle) {
    const auto speeds =
        phase_speeds<2>(c, material.rho, {std::sin(angle * degree), std::cos(angle * degree)});
    return PlaneSpeeds{speeds[0], speeds[1]};
  });
}

/// Returns the phase speeds of all three waves in 3-D, in the upright plane of an axis.
Curves speeds_in_3d(const Material& material, std::size_t axis) {
  auto x = angles();
  if (axis == 1) x.name = "angle of the front from the vertical, towards +y";
  const auto c = elasticity_of<3>(material);
  Curves curves{x, {"phase speed", "m/s"}, {{"P", {}}, {"S1", {}}, {"S2", {}}}};
  double low = 1e300, high = 0;
  for (int n = 0; n < points; ++n) {
    const double angle = curves.at(n) * degree;
    Point<3> direction{0, 0, std::cos(angle)};
    direction[axis] = std::sin(angle);
    const auto speeds = phase_speeds<3>(c, material.rho, direction);
    for (std::size_t wave = 0; wave < 3; ++wave) curves.lines[wave].second.push_back(speeds[wave]);
    low = std::min(low, speeds[2]), high = std::max(high, speeds[0]);
  }
  set_heights(curves, low, high);
  return curves;
}

/// The rock as a medium of one cell, unrelaxed, and its mechanisms.
class Relaxing {
 public:
  Relaxing(const RockAt& rock, const Attenuation& attenuation) : medium_(Grid<2>{{1, 1}, 1, {0, 0}}) {
    for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
      medium_[property] = Field<2>(medium_.grid());
    put(medium_, 0, rock.material);
    medium_[Property::qp] = Field<2>(medium_.grid(), float(rock.qp));
    medium_[Property::qs] = Field<2>(medium_.grid(), float(rock.qs));
    unrelax(medium_, attenuation);
    relaxation_.emplace(medium_, attenuation.mechanisms, 0);
  }
  /// Returns the waves whose fronts move at this angle from the axis of the rock.
  LossyWaves waves(double hz, double angle_rad = 0) const {
    return lossy_waves(relaxation_->stiffness(0, hz), double(medium_.rho[0]), angle_rad);
  }

 private:
  Medium<2> medium_;
  std::optional<StepwiseRelaxation<2>> relaxation_;
};

void add_attenuation(const RockAt& rock, const Attenuation& attenuation, std::vector<Curves>& all) {
  const Relaxing relaxing(rock, attenuation);
  const auto& mechanisms = attenuation.mechanisms;
  const bool s_too = rock.material.vs > 0 && std::isfinite(rock.qs) && rock.qs < double(elastic_quality);
  if (rock.material.is_anisotropic()) {
    // In space of the plane in which both are alike, wherever it lies.
    auto x = angles();
    if (rock.in_3d) x.name = "angle of the front from axis 3 of the rock, towards axis 1";
    const double tilt = rock.in_3d ? 0 : rock.material.tilt;
    all.push_back(curves_of(x, {"quality factor", ""}, s_too, {"P", "S"}, [&](double angle) {
      return relaxing.waves(attenuation.reference_hz, (angle + tilt) * degree).quality;
    }));
  }
  const Axis frequency{rock.material.is_anisotropic() ? "frequency, along the axis of the rock" : "frequency",
                       "Hz", mechanisms.low_hz() / 2, 2 * mechanisms.high_hz()};
  all.push_back(curves_of(frequency, {"quality factor", ""}, s_too, {"P", "S"},
                          [&](double hz) { return relaxing.waves(hz).quality; }));
  const auto reference = relaxing.waves(attenuation.reference_hz).speed;
  all.push_back(
      curves_of(frequency, {"phase speed, as a share of the model's", ""}, s_too, {"P", "S"}, [&](double hz) {
        const auto speeds = relaxing.waves(hz).speed;
        return PlaneSpeeds{speeds.p / reference.p, reference.s > 0 ? speeds.s / reference.s : 0};
      }));
}

std::string words_of(const RockAt& rock) {
  const auto& of = rock.material;
  std::string words = rock.place + ": vp " + shown(of.vp, 4) + " m/s, vs " + shown(of.vs, 4) + " m/s";
  if (of.constants)
    words += ", by its elastic constants";
  else if (of.is_anisotropic())
    words += ", epsilon " + shown(of.epsilon, 3) + ", delta " + shown(of.delta, 3);
  if (rock.in_3d && of.gamma != 0) words += ", gamma " + shown(of.gamma, 3);
  const std::pair<const char*, double> all[] = {
      {"tilt", of.tilt}, {"azimuth", of.azimuth}, {"rotation", of.rotation}};
  for (const auto& [name, value] : all)
    if (value != 0) words += std::string(", ") + name + " " + shown(value, 3) + "\u00b0";
  if (rock.attenuates()) words += ", qp " + shown(rock.qp, 3) + ", qs " + shown(rock.qs, 3);
  return words;
}

}  // namespace

bool RockAt::attenuates() const {
  const auto finite = [](double q) { return q < double(elastic_quality); };
  return finite(qp) || finite(qs);
}

template <int D>
RockAt rock_at(const Model<D>& model, const Point<D>& point_m) {
  const auto& medium = model.medium;
  const auto& grid = medium.grid();
  const auto at = cell_of(grid, point_m);
  const auto place = grid.row_coordinates(point_m);
  const auto refuse = [&](const std::string& what) {
    throw Error("found a point " + what + ", expected one in rock or fluid of " + shown(grid),
                ErrorKind::usage);
  };
  for (std::size_t axis = 0; axis < D; ++axis)
    if (!(place[axis] >= grid.origin_m[axis] && place[axis] <= grid.end(int(axis))))
      refuse("outside the model");
  const auto cell = std::size_t(grid.flat(at));
  if (medium.is_void(cell)) refuse("in void");
  RockAt rock{rock_of(medium, cell), medium.value(Property::qp, cell), medium.value(Property::qs, cell),
              place_of(grid, std::int64_t(cell)), D == 3};
  return rock;
}

Picture draw_rock(const RockAt& rock, const std::optional<Attenuation>& attenuation, Page page) {
  std::vector<Curves> all;
  if (rock.in_3d && rock.material.is_anisotropic_in_3d())
    all = {speeds_in_3d(rock.material, 0), speeds_in_3d(rock.material, 1)};
  else
    all = {speeds_by_angle(rock.material)};
  if (attenuation && rock.attenuates()) add_attenuation(rock, *attenuation, all);
  if (page.height_pt == 0) page.height_pt = double(all.size()) * 7.5 * points_per_cm;
  const double height = page.height_pt / double(all.size());
  std::vector<PanelSpec> specs;
  double left = 0, right = 0;
  const auto room = [&](std::size_t n) { return Rect{0, double(n) * height, page.width_pt, height}; };
  for (const auto& curves : all) {
    PanelSpec spec{specs.empty() ? (page.title.empty() ? words_of(rock) : page.title) : "", curves.x,
                   curves.y};
    for (std::size_t n = 0; n < curves.lines.size(); ++n)
      spec.legend.push_back(
          {.text = curves.lines[n].first, .colour = line_colour(n), .line = Stroke{line_colour(n), 1.2, {}}});
    const Panel panel(spec, room(specs.size()), page);
    left = std::max(left, panel.plot().x), right = std::max(right, page.width_pt - panel.plot().right());
    specs.push_back(std::move(spec));
  }
  Canvas canvas(page);
  for (std::size_t k = 0; k < all.size(); ++k) {
    specs[k].least_left_pt = left, specs[k].least_right_pt = right;
    const Panel panel(specs[k], room(k), page);
    panel.draw_grid(canvas);
    canvas.within(panel.plot(), [&] {
      for (std::size_t line = 0; line < all[k].lines.size(); ++line) {
        std::vector<Spot> spots;
        for (int n = 0; n < points; ++n)
          spots.push_back({panel.x(all[k].at(n)), panel.y(all[k].lines[line].second[std::size_t(n)])});
        canvas.polyline(spots, {line_colour(line), 1.2, {}});
      }
    });
    panel.draw(canvas);
  }
  return {canvas.finish(), canvas.words()};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, rock_at);

}  // namespace slipwave::plot
