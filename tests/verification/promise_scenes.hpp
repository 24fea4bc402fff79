// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "lab.hpp"
#include "layer_stack.hpp"
#include "model/layers.hpp"
#include "scene/scene.hpp"

namespace slipwave::solver {

/// How a drawn scene is computed.
struct Scheme {
  int order = 5, time_order = 2;
  double cfl = 0.9, cells = 10;  // per dominant wavelength of the slowest wave
};

/// A scene drawn from a seed, and its exact traces: parallel layers of solid and fluid, flat or dipping, on
/// and off faces, with and without a free surface, on fitted and on regular grids.
class DrawnScene {
 public:
  /// What it is drawn for: anything; sources just below a free surface of rock; sources beside an interface,
  /// as likely in the fluid as in the solid where it is a sea floor; receivers just below a sea floor; a
  /// cable below the surface of deep water.
  enum class Kind { any, shallow, near_floor, on_floor, deep_water };
  explicit DrawnScene(std::uint64_t seed, Kind kind = Kind::any, std::optional<Scheme> scheme = {})
      : engine_(seed), kind_(kind) {
    draw_layers();
    if (scheme) scheme_ = *scheme;
    if (kind == Kind::any)
      draw_places();
    else
      draw_special_places();
    build();
  }
  const Scene<2>& scene() const { return scene_; }
  const std::string& name() const { return name_; }
  /// The same, recording pressure.
  Scene<2> scene_of_pressure() const {
    auto scene = scene_;
    scene.recording.components = {Component::p};
    return scene;
  }
  /// Pressure of all receivers: -rho (vp^2 - vs^2) times the divergence of displacement.
  std::vector<double> exact_pressure() const {
    constexpr double apart_m = 0.25;
    std::vector<LayerStack::Receiver> round;
    for (const auto& at : receivers_) {
      for (const double a : {-apart_m, apart_m}) round.push_back({at.a + a, at.b});
      for (const double b : {-apart_m, apart_m}) round.push_back({at.a, at.b + b});
    }
    const auto count = std::size_t(scene_.recording.samples());
    const auto found = exact_stack().ricker(peak_hz, interval_s, count, round);
    std::vector<double> all;
    for (std::size_t r = 0; r < receivers_.size(); ++r) {
      const auto& rock = rocks_[layer_at(receivers_[r].b)];
      const double stiffness = rock.rho * (rock.vp * rock.vp - rock.vs * rock.vs);
      double pressure = 0, before = 0;
      for (std::size_t n = 0; n < count; ++n) {
        const double divergence =
            (found[4 * r + 1][0][n] - found[4 * r][0][n] + found[4 * r + 3][1][n] - found[4 * r + 2][1][n]) /
            (2 * apart_m);
        pressure -= stiffness * interval_s * (before + divergence) / 2;
        before = divergence;
        all.push_back(pressure);
      }
    }
    return all;
  }
  /// vx of all receivers, then vz.
  std::vector<double> exact_traces() const {
    const auto count = std::size_t(scene_.recording.samples());
    const auto found = exact_stack().ricker(peak_hz, interval_s, count, receivers_);
    std::vector<double> all;
    for (const bool vertical : {false, true})
      for (const auto& motion : found)
        for (std::size_t n = 0; n < count; ++n)
          all.push_back(vertical ? motion[0][n] * sine_ + motion[1][n] * cosine_
                                 : motion[0][n] * cosine_ - motion[1][n] * sine_);
    return all;
  }

 private:
  static constexpr double peak_hz = 15, interval_s = 0.001, duration_s = 0.6;

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
    const bool floor = kind_ != Kind::any && kind_ != Kind::shallow;
    const int count = (floor ? 2 : 1) + int(uniform(0, floor ? 2 : 4));
    free_surface_ = kind_ == Kind::shallow || kind_ == Kind::deep_water || chance(0.3);
    for (int n = 0; n < count; ++n) {
      const bool fluid = kind_ == Kind::any ? n + 1 < count && chance(n == 0 ? 0.45 : 0.15) : floor && n == 0;
      rocks_.push_back(fluid ? Rock{1500, 0, 1000} : draw_rock());
    }
    if (free_surface_) faces_m_.push_back(0);
    double at = kind_ == Kind::deep_water ? uniform(380, 600) : free_surface_ ? uniform(120, 300) : 0;
    for (int n = 0; n + 1 < count; ++n) {
      faces_m_.push_back(at);
      at += chance(0.2) ? uniform(12, 40) : uniform(60, 220);
    }
    dip_deg_ = faces_m_.empty() || chance(0.4) ? 0 : std::round(uniform(2, kind_ == Kind::any ? 45 : 30));
    if (kind_ == Kind::deep_water) dip_deg_ = 0;
    on_faces_ = dip_deg_ == 0 && chance(0.5);
    fitted_ = chance(0.6);
    cosine_ = std::cos(dip_deg_ * std::numbers::pi / 180);
    sine_ = std::sin(dip_deg_ * std::numbers::pi / 180);
    scheme_.order = int(one_of({5, 5, 5, 5, 7, 3}));
    scheme_.cfl = one_of({0.9, 0.9, 0.9, 0.5});
    scheme_.cells = one_of({10, 12, 16, 20, 24});
  }

  LayerStack exact_stack() const {
    LayerStack exact{rocks_, faces_m_, free_surface_, source_b_, !force_, {}};
    if (force_) exact.force = {0.5 * cosine_ + sine_, cosine_ - 0.5 * sine_};
    return exact;
  }
  std::size_t layer_at(double b) const {
    std::size_t layer = 0;
    for (std::size_t n = free_surface_ ? 1 : 0; n < faces_m_.size(); ++n) layer += b > faces_m_[n];
    return layer;
  }

  /// Place across the layers that is not within `away` of a face.
  double across(double low, double high, double away) {
    for (;;) {
      const double b = uniform(low, high);
      if (std::all_of(faces_m_.begin(), faces_m_.end(),
                      [&](double face) { return std::abs(b - face) >= away; }))
        return b;
    }
  }

  void draw_places() {
    const double last = faces_m_.empty() ? 0 : faces_m_.back(), first = free_surface_ ? 20 : -250;
    near_ = chance(0.15);
    source_b_ = across(first, last + 250, near_ ? 8 : 30);
    // A force in a fluid has no closed form here.
    force_ = rocks_[layer_at(source_b_)].vs > 0 && chance(0.5);
    const double levels[] = {across(first, last + 200, near_ ? 8 : 30),
                             across(first, last + 200, near_ ? 8 : 30)};
    for (const double b : levels)
      for (const double a : {-250., -80., 90., 240., 400.})
        if (std::hypot(a, b - source_b_) > 60) receivers_.push_back({a, b});
  }

  double spacing_m() const {
    double slowest = 1e30;
    for (const auto& rock : rocks_) slowest = std::min(slowest, rock.vs > 0 ? rock.vs : rock.vp);
    return slowest / peak_hz / scheme_.cells;
  }

  void draw_special_places() {
    const double h = spacing_m();
    double levels[2] = {};
    if (kind_ == Kind::shallow) {
      source_b_ = h * uniform(1, 7);
      levels[0] = chance(0.5) ? h * uniform(0.6, 3) : 60 + uniform(0, 40);
      levels[1] = faces_m_.size() > 1 ? across(faces_m_[1], faces_m_.back() + 150, 30) : 180;
      force_ = chance(0.5);
    }
    const double floor = faces_m_.empty() ? 0 : faces_m_[free_surface_ ? 1 : 0];
    if (kind_ == Kind::near_floor) {
      const double away = h * uniform(0.7, 4);
      const bool below = chance(0.6);
      source_b_ = floor + (below ? away : -away);
      force_ = below && chance(0.6);
      levels[0] = floor - uniform(20, 100);
      levels[1] = floor + (chance(0.5) ? h * uniform(0.6, 3) : uniform(20, 50));
    }
    if (kind_ == Kind::on_floor) {
      const bool below = chance(0.4);
      source_b_ = floor + (below ? uniform(15, 50) : -uniform(15, 100));
      force_ = below && chance(0.6);
      levels[0] = floor + h * uniform(0.3, 2);
      levels[1] = chance(0.5) ? floor - h * uniform(0.3, 2) : floor + uniform(20, 50);
    }
    if (kind_ == Kind::deep_water) {
      source_b_ = uniform(8, 25);
      levels[0] = uniform(10, 30);
      levels[1] = floor - uniform(10, 60);
    }
    for (const double b : levels)
      for (const double a : {-250., -80., 90., 240., 400.})
        if (std::hypot(a, b - source_b_) > 60) receivers_.push_back({a, b});
  }

  void build() {
    const double h = spacing_m();
    // What lies where if (0, 0) of the frame of the layers is at the origin.
    double low[2] = {0, 0}, high[2] = {0, 0};
    const auto reach = [&](const LayerStack::Receiver& at) {
      const Point<2> place = {at.a * cosine_ - at.b * sine_, at.a * sine_ + at.b * cosine_};
      for (const std::size_t axis : {0, 1}) {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis]);
      }
    };
    reach({0, source_b_});
    for (const auto& at : receivers_) reach(at);
    if (!faces_m_.empty()) reach({0, faces_m_.back()});
    constexpr double margin_m = 150;
    const double x0 = std::ceil((margin_m - low[0]) / h) * h;
    const bool flat_top = free_surface_ && dip_deg_ == 0;
    double z0 = flat_top ? 0 : std::ceil((margin_m - low[1]) / h) * h;
    // A surface that dips stays below the top of the model.
    if (free_surface_ && !flat_top) z0 = std::max(z0, std::ceil(x0 * sine_ / cosine_ / h + 8) * h);
    const double shift = on_faces_ || flat_top ? 0 : uniform(0.1, 0.9) * h;
    z0 += shift;
    if (on_faces_)
      for (auto& face : faces_m_) face = std::round(face / h) * h;
    const std::int64_t nx = std::int64_t(std::ceil((x0 + high[0] + margin_m) / h));
    const std::int64_t nz = std::int64_t(std::ceil((z0 + high[1] + margin_m) / h));
    std::vector<Layer> layers;
    const double slope = sine_ / cosine_;
    for (std::size_t n = 0; n < rocks_.size(); ++n) {
      const auto& rock = rocks_[n];
      const double face = free_surface_ ? faces_m_[n] : n == 0 ? 0 : faces_m_[n - 1];
      if (n == 0 && !free_surface_)
        layers.emplace_back(-1e5, rock.vp, rock.vs, rock.rho);
      else
        layers.emplace_back(z0 + face / cosine_ - x0 * slope, rock.vp, rock.vs, rock.rho, dip_deg_);
    }
    FitChoice choice;
    choice.surfaces = choice.floors = choice.layers = fitted_;
    const Grid<2> regular{{nx, nz}, h, {0, 0}};
    // As sw-layers would write it.
    std::ostringstream history;
    history.precision(12);
    history << "sw-layers --size 1x1 --step " << h << (fitted_ ? "" : " --fit none");
    for (std::size_t n = 0; n < rocks_.size(); ++n)
      history << " --layer " << layers[n].top.depth_m() << ':' << rocks_[n].vp << ':' << rocks_[n].vs << ':'
              << rocks_[n].rho << ':' << (n == 0 && !free_surface_ ? 0 : dip_deg_);
    scene_.model.history = history.str();
    const auto fit = fit_layers<2>(regular, layers, choice);
    scene_.model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
    const auto place = [&](double a, double b) {
      return Point<2>{x0 + a * cosine_ - b * sine_, z0 + a * sine_ + b * cosine_};
    };
    scene_.survey.sources = {{place(0, source_b_), parse_mechanism<2>(force_ ? "force:0.5,1" : "explosion"),
                              parse_wavelet("ricker:15"), 1e6}};
    for (const auto& at : receivers_) scene_.survey.receivers_m.push_back(place(at.a, at.b));
    scene_.edges = edges_all(EdgeLaw::absorbing);
    if (free_surface_) scene_.edges[1][0] = EdgeLaw::free;
    scene_.recording = {{Component::vx, Component::vz}, duration_s, interval_s};
    scene_.numerics.order = scheme_.order;
    scene_.numerics.time_order = scheme_.time_order;
    scene_.numerics.cfl = scheme_.cfl;
    check(scene_);
    name(fit.summary.empty() ? "regular" : "fitted", fit.left_out.size());
  }

  void name(const std::string& grid, std::size_t left_out) {
    std::ostringstream text;
    text << (free_surface_ ? "surface," : "") << ' ';
    for (std::size_t n = 0; n < rocks_.size(); ++n)
      text << int(rocks_[n].vp) << '/' << int(rocks_[n].vs) << ' ';
    text << "dip " << dip_deg_ << (on_faces_ ? " on faces, " : " off faces, ") << grid;
    if (left_out > 0) text << " but " << left_out;
    text << (force_ ? ", force" : ", explosion") << (near_ ? " near" : "") << ", order " << scheme_.order
         << ',' << scheme_.time_order << " Courant " << scheme_.cfl << ", n " << scheme_.cells;
    name_ = text.str();
  }

  std::mt19937_64 engine_;
  Kind kind_;
  std::vector<Rock> rocks_;
  std::vector<double> faces_m_;
  std::vector<LayerStack::Receiver> receivers_;
  bool free_surface_ = false, on_faces_ = false, fitted_ = false, force_ = false, near_ = false;
  double dip_deg_ = 0, cosine_ = 1, sine_ = 0, source_b_ = 0;
  Scheme scheme_;
  Scene<2> scene_;
  std::string name_;
};

/// Topography, a rolling sea floor, or that and a bed that rolls otherwise, drawn from a seed; no closed form
/// has such traces, so scene(parts) gives the same in cells of a part of the size, whose geometry is as much
/// finer.
class BentScene {
 public:
  explicit BentScene(std::uint64_t seed) : engine_(seed) {
    const int kind = int(uniform(0, 3));
    hills_ = kind == 0;
    double at = uniform(120, 160);
    const auto add = [&](const Rock& rock, bool level) {
      std::ostringstream text;
      text << "sine," << at << ',' << (level ? 0 : uniform(5, 20)) << ',' << uniform(220, 500) << ':'
           << rock.vp << ':' << rock.vs << ':' << rock.rho;
      layers_.push_back(text.str());
      slowest_ = std::min(slowest_, rock.vs > 0 ? rock.vs : rock.vp);
    };
    if (!hills_) {
      layers_.emplace_back("-10:1500:0:1000");
      slowest_ = 1500;
    }
    const double vp = uniform(2000, 3200);
    add({vp, vp / uniform(1.7, 2.1), 2100}, false);
    at += uniform(110, 160);
    if (kind > 0) add({uniform(3300, 4300), uniform(1800, 2300), 2400}, kind == 1);
    fitted_ = uniform(0, 1) < 0.7;
    cells_ = std::round(uniform(9, 18));
    order_ = uniform(0, 1) < 0.3 ? 7 : 5;
    force_ = uniform(0, 1) < 0.4;
    source_ = {uniform(250, 450), hills_ || force_ ? uniform(200, 330) : uniform(30, 330)};
    const double upper = hills_ ? uniform(200, 240) : uniform(30, 90), lower = uniform(210, 400);
    for (const double x : {120., 230., 340., 460., 560.})
      for (const double depth : {upper, lower})
        if (std::hypot(x - source_[0], depth - source_[1]) > 60) receivers_.push_back({x, depth});
  }
  std::string name() const {
    std::ostringstream text;
    for (const auto& layer : layers_) text << layer << ' ';
    text << (fitted_ ? "fitted" : "regular") << (force_ ? ", force" : ", explosion") << ", order " << order_
         << ", n " << cells_;
    return text.str();
  }
  Scene<2> scene(int parts = 1) const {
    const double wide_m = 700, h = wide_m / std::ceil(wide_m * 15 * cells_ / slowest_) / parts;
    const Grid<2> regular{{std::llround(wide_m / h), std::llround(490 / h)}, h, {0, 0}};
    std::vector<Layer> layers;
    for (const auto& text : layers_) layers.push_back(parse_layer(text));
    FitChoice choice;
    choice.surfaces = choice.floors = choice.layers = fitted_ || parts > 1;
    const auto fit = fit_layers<2>(regular, layers, choice);
    Scene<2> scene;
    scene.model.medium = layered_medium<2>(fit.grid, layers, Average::isotropic, fit.rows);
    scene.survey.sources = {
        {source_, parse_mechanism<2>(force_ ? "force:0.5,1" : "explosion"), parse_wavelet("ricker:15"), 1e6}};
    scene.survey.receivers_m = receivers_;
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (hills_) scene.edges[1][0] = EdgeLaw::free;
    scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
    scene.numerics.order = parts > 1 ? 7 : order_;
    scene.numerics.zone_cells = 20 * parts;
    check(scene);
    return scene;
  }

 private:
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }

  std::mt19937_64 engine_;
  std::vector<std::string> layers_;
  bool hills_ = false, fitted_ = true, force_ = false;
  int order_ = 5;
  double cells_ = 12, slowest_ = 1e30;
  Point<2> source_{};
  std::vector<Point<2>> receivers_;
};

}  // namespace slipwave::solver
