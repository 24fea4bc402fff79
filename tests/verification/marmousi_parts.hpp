// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/input_bytes.hpp"
#include "lab.hpp"
#include "model/import.hpp"
#include "model/layers.hpp"
#include "model/marmousi.hpp"
#include "model/resample.hpp"
#include "scene/scene.hpp"

namespace slipwave::solver {

/// The raw files of Marmousi-II in a folder, in their cells of 20 m; nothing where they are not there.
inline std::optional<Model<2>> marmousi_2(const std::string& folder) {
  const auto path = [&](const std::string& property) { return folder + "/marmousi_II_marine." + property; };
  if (!std::filesystem::exists(path("vp"))) return std::nullopt;
  const Grid<2> grid{{500, 174}, 20, {0, 0}};
  const auto read = [&](const std::string& property) {
    return field_from_raw(read_all(path(property)), grid, FastAxis::z);
  };
  Model<2> model;
  model.medium = medium_of<2>(read("vp"), read("vs"), read("rho"), 1600);
  return model;
}

/// A shot over a part of Marmousi-II, drawn from a seed: in the sea above it, with receivers in the water, or
/// in its rock, some of it below a free surface. Between the centres of its cells of 20 m the model is
/// interpolated, or it is one of sw-marmousi; scene(parts) gives the same part in cells of a part of the
/// size.
class MarmousiPart {
 public:
  /// Of the real model, or where there is none of one that is drawn, too; `size` of all lengths and times.
  MarmousiPart(std::uint64_t seed, std::optional<Model<2>> real, double size = 1)
      : engine_(seed), real_(std::move(real)), seed_(seed) {
    wide_m_ = 20 * std::round(size * uniform(60, 110));
    marine_ = uniform(0, 1) < 0.6;
    water_m_ = marine_ ? 20 * std::round(uniform(3, 12)) : 0;
    deep_m_ = water_m_ + 20 * std::round(size * uniform(25, 45));
    left_m_ = 20 * std::round(uniform(0, (10000 - wide_m_) / 20));
    upper_m_ = real_ ? marine_ ? 440 - water_m_ : 20 * std::round(uniform(23, 80)) : 0;
    spacing_m_ = 20 / std::round(uniform(1.6, 4.4));
    cells_ = std::round(uniform(9, 18));
    order_ = uniform(0, 1) < 0.5 ? 7 : 5;
    cfl_ = uniform(0, 1) < 0.7 ? 0.9 : 0.5;
    free_ = uniform(0, 1) < 0.7;
    force_ = !marine_ && uniform(0, 1) < 0.5;
    const double low = marine_ ? uniform(10, 40) : uniform(40, 200);
    source_ = {wide_m_ * uniform(0.15, 0.85), low};
    const double line = marine_ ? uniform(10, water_m_ - 5) : uniform(40, 120);
    for (double x = 0.06 * wide_m_; x < 0.95 * wide_m_; x += wide_m_ / 27)
      if (std::hypot(x - source_[0], line - source_[1]) > 60) receivers_.push_back({x, line});
    time_s_ = size * uniform(0.8, 1.4);
    slowest_ = least_speed(model(1).medium);
  }
  std::string name() const {
    std::ostringstream text;
    text << (real_ ? "Marmousi-II" : "sw-marmousi") << (marine_ ? ", sea, " : ", rock, ") << wide_m_ << 'x'
         << deep_m_ << " m at " << left_m_ << ',' << upper_m_ << (free_ ? ", free surface" : "")
         << (force_ ? ", force" : ", explosion") << ", cells of " << spacing_m_ << " m, n " << cells_
         << ", order " << order_ << ", Courant " << cfl_;
    return text.str();
  }
  Scene<2> scene(int parts = 1) const {
    Scene<2> scene;
    scene.model = model(parts);
    scene.survey.sources = {{{left_m_ + source_[0], source_[1]},
                             parse_mechanism<2>(force_ ? "force:0.5,1" : "explosion"),
                             parse_wavelet("ricker:" + std::to_string(peak_hz())),
                             1e6}};
    scene.survey.receivers_m = receivers_;
    for (auto& at : scene.survey.receivers_m) at[0] += left_m_;
    scene.edges = edges_all(EdgeLaw::absorbing);
    if (free_) scene.edges[1][0] = EdgeLaw::free;
    scene.recording = {{Component::vx, Component::vz}, time_s_, 0.002};
    scene.numerics.order = parts > 1 ? 7 : order_;
    scene.numerics.cfl = parts > 1 ? 0.9 : cfl_;
    scene.numerics.zone_cells = 20 * parts;
    check(scene);
    return scene;
  }
  double peak_hz() const { return std::round(100 * slowest_ / spacing_m_ / cells_) / 100; }

 private:
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  Model<2> model(int parts) const {
    const double h = spacing_m_ / parts;
    if (real_) {
      const auto box = slipwave::Box<2>{{left_m_, upper_m_}, {left_m_ + wide_m_, upper_m_ + deep_m_}};
      auto part = resampled(cropped(*real_, box), h);
      part.history = "sw-import --step 20 --resample " + std::to_string(h);
      return part;
    }
    Model<2> drawn;
    MarmousiSettings settings;
    settings.seed = seed_;
    settings.water_m = water_m_;
    settings.vp_over_vs = 1.732;
    drawn.medium = marmousi_medium(
        Grid<2>{{std::llround(wide_m_ / h), std::llround(deep_m_ / h)}, h, {left_m_, 0}}, settings);
    return drawn;
  }
  static double least_speed(const Medium<2>& medium) {
    double least = 1e30;
    for (std::size_t n = 0; n < std::size_t(medium.grid().size()); ++n)
      least = std::min<double>(least, medium.vs[n] > 0 ? medium.vs[n] : medium.vp[n]);
    return least;
  }

  std::mt19937_64 engine_;
  std::optional<Model<2>> real_;
  std::uint64_t seed_;
  double wide_m_ = 0, deep_m_ = 0, water_m_ = 0, left_m_ = 0, upper_m_ = 0, spacing_m_ = 0, cells_ = 0,
         cfl_ = 0, time_s_ = 0, slowest_ = 0;
  bool marine_ = false, free_ = false, force_ = false;
  int order_ = 5;
  Point<2> source_{};
  std::vector<Point<2>> receivers_;
};

}  // namespace slipwave::solver
