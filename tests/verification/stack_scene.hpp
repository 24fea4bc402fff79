// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "geology/layers.hpp"
#include "lab.hpp"
#include "layer_stack.hpp"
#include "scene/scene.hpp"

namespace slipwave::solver {

/// A stack of parallel layers (LayerStack) at any dip as a scene: level and dipping ones as sw-layers makes
/// them, with the geology that it stores; upright ones cell by cell.
struct StackScene {
  std::string name;
  std::vector<Rock> rocks;           // by increasing b
  std::vector<double> faces_m = {};  // before layer n + 1, or with a free surface before layer n
  bool free_surface = false;
  double dip_deg = 0;  // 90: b grows towards lower x
  double source_b = 0;
  std::optional<Point<2>> force = {};  // along x and z; none: an explosion
  std::vector<LayerStack::Receiver> receivers = {};
  double peak_hz = 15, duration_s = 0.6, spacing_m = 5, cfl = 0.9, margin_m = 150;
  int order = 5, time_order = 2, zone_cells = 0;
  double deeper_m = 0;  // than the margin
  bool fitted = true;
  /// How far below a face of cells the frame of the layers begins, as a part of a cell.
  double shift = 0;
  /// Upright: nothing lies beyond the first face and the model ends there, instead of void.
  bool ends = false;
  std::vector<std::array<double, 2>> qualities = {};  // qp and qs by layer; empty: none attenuates

  static constexpr double interval_s = 0.001;

  /// Where the frame of the layers begins.
  Point<2> origin() const {
    double low[2] = {0, 0};
    const auto reach = [&](const LayerStack::Receiver& at) {
      const auto place = turned(at);
      for (const std::size_t axis : {0, 1}) low[axis] = std::min(low[axis], place[axis]);
    };
    reach({0, source_b});
    for (const auto& at : receivers) reach(at);
    const double h = spacing_m;
    const bool flat_top = free_surface && dip_deg == 0;
    Point<2> from = {std::ceil((margin_m - low[0]) / h) * h,
                     flat_top ? 0 : std::ceil((margin_m - low[1]) / h) * h};
    // A surface that dips stays below the top of the model.
    if (free_surface && !flat_top && dip_deg < 90)
      from[1] = std::max(from[1], std::ceil(from[0] * sine() / cosine() / h + 8) * h);
    if (!flat_top) from[dip_deg == 90 ? 0 : 1] += shift * h;
    return from;
  }
  Point<2> place(const LayerStack::Receiver& at) const {
    const auto from = origin(), way = turned(at);
    return {from[0] + way[0], from[1] + way[1]};
  }
  Scene<2> scene() const {
    Scene<2> scene;
    scene.model = dip_deg == 90 ? upright() : layered();
    const auto kind = force ? Mechanism<2>(PointForce<2>{*force}) : Mechanism<2>(Explosion{});
    scene.survey.sources = {
        {place({0, source_b}), kind, parse_wavelet("ricker:" + std::to_string(peak_hz)), 1e6}};
    for (const auto& at : receivers) scene.survey.receivers_m.push_back(place(at));
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (free_surface && dip_deg < 90) scene.edges[1][0] = EdgeLaw::free;
    if (ends) scene.edges[0][1] = EdgeLaw::free;
    scene.recording = {{Component::vx, Component::vz}, duration_s, interval_s};
    scene.numerics.order = order;
    scene.numerics.time_order = time_order;
    scene.numerics.cfl = cfl;
    scene.numerics.zone_cells = zone_cells;
    if (!qualities.empty()) set_attenuation(scene);
    check(scene);
    return scene;
  }
  /// vx of all receivers, then vz.
  std::vector<Gather> exact() const {
    LayerStack stack{rocks, faces_m, free_surface, source_b, !force, {}};
    if (force)
      stack.force = {(*force)[0] * cosine() + (*force)[1] * sine(),
                     (*force)[1] * cosine() - (*force)[0] * sine()};
    const Mechanisms mechanisms(AttenuationChoice().mechanisms, peak_hz / 5, 2.5 * peak_hz);
    for (const auto& [p, s] : qualities)
      stack.losses.push_back(
          {standard_linear(mechanisms, p, peak_hz), standard_linear(mechanisms, s > 0 ? s : p, peak_hz)});
    Gather gather;
    gather.axis = {std::int64_t(std::lround(duration_s / interval_s)) + 1, interval_s, 0};
    const auto found = stack.ricker(peak_hz, interval_s, std::size_t(gather.axis.count), receivers);
    for (const bool vertical : {false, true})
      for (std::size_t n = 0; n < found.size(); ++n) {
        Trace trace;
        trace.header.component = vertical ? Component::vz : Component::vx;
        trace.header.channel = std::int64_t(n) + 1;
        for (std::size_t k = 0; k < std::size_t(gather.axis.count); ++k)
          trace.samples.push_back(1e6 * (vertical ? found[n][0][k] * sine() + found[n][1][k] * cosine()
                                                  : found[n][0][k] * cosine() - found[n][1][k] * sine()));
        gather.traces.push_back(std::move(trace));
      }
    return {gather};
  }

 private:
  double cosine() const { return dip_deg == 90 ? 0 : std::cos(dip_deg * std::numbers::pi / 180); }
  double sine() const { return dip_deg == 90 ? 1 : std::sin(dip_deg * std::numbers::pi / 180); }
  Point<2> turned(const LayerStack::Receiver& at) const {
    return {at.a * cosine() - at.b * sine(), at.a * sine() + at.b * cosine()};
  }
  /// Cells along x and z.
  Index<2> shape() const {
    Point<2> high = place({0, source_b});
    const auto reach = [&](const Point<2>& place) {
      for (const std::size_t axis : {0, 1}) high[axis] = std::max(high[axis], place[axis]);
    };
    for (const auto& at : receivers) reach(place(at));
    if (!faces_m.empty() && dip_deg < 90) reach(place({0, faces_m.back()}));
    if (ends) return {std::llround(origin()[0] / spacing_m), cells(high[1] + deeper_m)};
    return {cells(high[0]), cells(high[1] + deeper_m)};
  }
  std::int64_t cells(double high_m) const { return std::int64_t(std::ceil((high_m + margin_m) / spacing_m)); }
  Model<2> layered() const {
    const auto from = origin();
    Geology geology{.maker = Maker::sw_layers, .average = Average::isotropic};
    if (!fitted) geology.fit = parse_fit("none");
    for (std::size_t n = 0; n < rocks.size(); ++n) {
      const bool above_all = n == 0 && !free_surface;
      const double face = free_surface ? faces_m[n] : n == 0 ? 0 : faces_m[n - 1];
      std::ostringstream text;
      text.precision(12);
      text << (above_all ? -1e5 : from[1] + face / cosine() - from[0] * sine() / cosine()) << ':'
           << rocks[n].vp << ':' << rocks[n].vs << ':' << rocks[n].rho << ':' << (above_all ? 0 : dip_deg);
      if (!qualities.empty() && std::isfinite(qualities[n][0]))
        text << " qp=" << qualities[n][0]
             << (rocks[n].vs > 0 ? " qs=" + std::to_string(qualities[n][1]) : "");
      geology.layers.push_back(parse_layer(text.str()));
    }
    Model<2> model;
    model.medium = medium_of<2>(geology, {shape(), spacing_m, {0, 0}});
    model.geology = std::move(geology);
    return model;
  }
  Model<2> upright() const {
    Model<2> model;
    const Grid<2> grid{shape(), spacing_m, {0, 0}};
    model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
    const double x0 = origin()[0];
    for (std::int64_t n = 0; n < grid.size(); ++n) {
      const double b = x0 - grid.centre(0, grid.index(n)[0]);
      if (free_surface && b < faces_m.front()) continue;
      std::size_t layer = 0;
      for (std::size_t f = free_surface ? 1 : 0; f < faces_m.size(); ++f) layer += b > faces_m[f];
      put(model.medium, grid.index(n), rocks[layer]);
    }
    return model;
  }
};

/// A stack drawn from a seed: parallel layers of solid and fluid, flat or dipping, on and off faces, with and
/// without a free surface, on fitted and on regular grids.
class DrawnStack {
 public:
  /// What it is drawn for: anything; sources just below a free surface of rock; sources beside an interface,
  /// as likely in the fluid as in the solid where it is a sea floor; receivers just below a sea floor; a
  /// cable below the surface of deep water.
  enum class Kind { any, shallow, near_floor, on_floor, deep_water };
  explicit DrawnStack(std::uint64_t seed, Kind kind = Kind::any) : engine_(seed), kind_(kind) {
    draw_layers();
    if (kind == Kind::any)
      draw_places();
    else
      draw_special_places();
    if (on_faces_)
      for (auto& face : stack_.faces_m) face = std::round(face / stack_.spacing_m) * stack_.spacing_m;
    name();
  }
  const StackScene& stack() const { return stack_; }

 private:
  /// Distributions of the standard library differ from house to house.
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  bool chance(double share) { return uniform(0, 1) < share; }
  double one_of(std::initializer_list<double> values) {
    return values.begin()[std::size_t(uniform(0, double(values.size())))];
  }
  Rock draw_rock() {
    const double vp = uniform(2000, 4500), vs = std::max(850., vp / uniform(1.6, 2.2));
    return {vp, vs, 1740 * std::pow(vp / 1000, 0.25)};
  }
  void draw_layers() {
    auto& s = stack_;
    const bool floor = kind_ != Kind::any && kind_ != Kind::shallow;
    const int count = (floor ? 2 : 1) + int(uniform(0, floor ? 2 : 4));
    s.free_surface = kind_ == Kind::shallow || kind_ == Kind::deep_water || chance(0.3);
    for (int n = 0; n < count; ++n) {
      const bool fluid = kind_ == Kind::any ? n + 1 < count && chance(n == 0 ? 0.45 : 0.15) : floor && n == 0;
      s.rocks.push_back(fluid ? Rock{1500, 0, 1000} : draw_rock());
    }
    if (s.free_surface) s.faces_m.push_back(0);
    double at = kind_ == Kind::deep_water ? uniform(380, 600) : s.free_surface ? uniform(120, 300) : 0;
    for (int n = 0; n + 1 < count; ++n) {
      s.faces_m.push_back(at);
      at += chance(0.2) ? uniform(12, 40) : uniform(60, 220);
    }
    s.dip_deg = s.faces_m.empty() || chance(0.4) ? 0 : std::round(uniform(2, kind_ == Kind::any ? 45 : 30));
    if (kind_ == Kind::deep_water) s.dip_deg = 0;
    on_faces_ = s.dip_deg == 0 && chance(0.5);
    s.fitted = chance(0.6);
    s.shift = on_faces_ ? 0 : uniform(0.1, 0.9);
    // Errors of some permille to some percent.
    s.order = int(one_of({5, 5, 5, 7, 7, 11}));
    s.cfl = one_of({0.9, 0.9, 0.9, 0.5});
    cells_ = s.order == 5 ? one_of({20, 24, 28}) : s.order == 7 ? one_of({16, 20, 24}) : one_of({13, 16});
    double slowest = 1e30;
    for (const auto& rock : s.rocks) slowest = std::min(slowest, rock.vs > 0 ? rock.vs : rock.vp);
    s.spacing_m = slowest / s.peak_hz / cells_;
  }
  std::size_t layer_at(double b) const {
    std::size_t layer = 0;
    for (std::size_t n = stack_.free_surface ? 1 : 0; n < stack_.faces_m.size(); ++n)
      layer += b > stack_.faces_m[n];
    return layer;
  }
  /// Place across the layers that is not within `away` of a face.
  double across(double low, double high, double away) {
    for (;;) {
      const double b = uniform(low, high);
      if (std::all_of(stack_.faces_m.begin(), stack_.faces_m.end(),
                      [&](double face) { return std::abs(b - face) >= away; }))
        return b;
    }
  }
  void push_source(bool force) {
    // A force in a fluid has no closed form here.
    if (force && stack_.rocks[layer_at(stack_.source_b)].vs > 0) stack_.force = Point<2>{0.5, 1};
  }
  void add_receivers(const double (&levels)[2]) {
    for (const double b : levels)
      for (const double a : {-250., -80., 90., 240., 400.})
        if (std::hypot(a, b - stack_.source_b) > 60) stack_.receivers.push_back({a, b});
  }
  void draw_places() {
    const double last = stack_.faces_m.empty() ? 0 : stack_.faces_m.back();
    const double first = stack_.free_surface ? 20 : -250, away = chance(0.15) ? 8 : 30;
    stack_.source_b = across(first, last + 250, away);
    push_source(chance(0.5));
    add_receivers({across(first, last + 200, away), across(first, last + 200, away)});
  }
  void draw_special_places() {
    auto& s = stack_;
    const double h = s.spacing_m, floor = s.faces_m.empty() ? 0 : s.faces_m[s.free_surface ? 1 : 0];
    double levels[2] = {};
    bool force = false;
    if (kind_ == Kind::shallow) {
      s.source_b = h * uniform(1, 7);
      levels[0] = chance(0.5) ? h * uniform(0.6, 3) : 60 + uniform(0, 40);
      levels[1] = s.faces_m.size() > 1 ? across(s.faces_m[1], s.faces_m.back() + 150, 30) : 180;
      force = chance(0.5);
    }
    if (kind_ == Kind::near_floor) {
      const double away = h * uniform(0.7, 4);
      const bool below = chance(0.6);
      s.source_b = floor + (below ? away : -away);
      force = below && chance(0.6);
      levels[0] = floor - uniform(20, 100);
      levels[1] = floor + (chance(0.5) ? h * uniform(0.6, 3) : uniform(20, 50));
    }
    if (kind_ == Kind::on_floor) {
      const bool below = chance(0.4);
      s.source_b = floor + (below ? uniform(15, 50) : -uniform(15, 100));
      force = below && chance(0.6);
      levels[0] = floor + h * uniform(0.3, 2);
      levels[1] = chance(0.5) ? floor - h * uniform(0.3, 2) : floor + uniform(20, 50);
    }
    if (kind_ == Kind::deep_water) {
      s.source_b = uniform(8, 25);
      levels[0] = uniform(10, 30);
      levels[1] = floor - uniform(10, 60);
    }
    push_source(force);
    add_receivers(levels);
  }
  void name() {
    const auto& s = stack_;
    std::ostringstream text;
    text << (s.free_surface ? "surface, " : "");
    for (const auto& rock : s.rocks) text << int(rock.vp) << '/' << int(rock.vs) << ' ';
    text << "dip " << s.dip_deg << (on_faces_ ? " on faces" : " off faces")
         << (s.fitted ? ", fitted" : ", not fitted") << (s.force ? ", force" : ", explosion") << ", order "
         << s.order << " Courant " << s.cfl << ", n " << cells_;
    stack_.name = text.str();
  }

  std::mt19937_64 engine_;
  Kind kind_;
  bool on_faces_ = false;
  double cells_ = 10;
  StackScene stack_;
};

}  // namespace slipwave::solver
