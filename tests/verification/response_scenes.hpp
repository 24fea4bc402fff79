// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "accuracy/ladder.hpp"
#include "base/error.hpp"
#include "base/fft.hpp"
#include "lab.hpp"
#include "scene/scene.hpp"
#include "solver/simulation.hpp"

// Scenes with a cluster of fractures, and what it adds to their traces.
namespace slipwave::solver {

/// Fractured less elastic traces, velocities of all receivers.
inline std::vector<std::vector<double>> response_of(const Scene<2>& scene) {
  auto elastic = scene;
  elastic.with_slip = false;
  const auto found = shoot(scene, 1), without = shoot(elastic, 1);
  std::vector<std::vector<double>> all;
  for (std::size_t n = 0; n < found.traces.size(); ++n) {
    auto& trace = all.emplace_back();
    for (std::size_t k = 0; k < found.traces[n].samples.size(); ++k)
      trace.push_back(double(found.traces[n].samples[k]) - double(without.traces[n].samples[k]));
  }
  return all;
}

/// Relative L2 error of traces of one length below a frequency.
inline double error_below(const std::vector<std::vector<double>>& found,
                          const std::vector<std::vector<double>>& exact, double hz, double interval_s) {
  RealTransform transform(fast_transform_length(2 * exact[0].size()));
  const auto below = std::size_t(hz * interval_s * double(transform.length()));
  double wrong = 0, all = 0;
  const auto energy = [&](const std::vector<double>& samples) {
    const auto bins = transform.forward(samples);
    double sum = 0;
    for (std::size_t bin = 1; bin <= below; ++bin) sum += std::norm(bins[bin]);
    return sum;
  };
  for (std::size_t n = 0; n < exact.size(); ++n) {
    std::vector<double> difference(exact[n].size());
    for (std::size_t k = 0; k < difference.size(); ++k) difference[k] = found[n][k] - exact[n][k];
    wrong += energy(difference);
    all += energy(exact[n]);
  }
  return std::sqrt(wrong / all);
}

/// Rock with a box of planes, drawn: their law and their angle, the way of waves to them and from them to a
/// line of receivers, the cells and how it is computed.
class ResponseScene {
 public:
  /// `small`: of a quarter of the extent, for tests that are short.
  explicit ResponseScene(std::uint64_t seed, bool small = false) : engine_(seed), small_(small) {
    for (int n = 0; n < 5; ++n) engine_();
    vp_ = std::round(uniform(2600, 4800));
    vs_ = std::round(vp_ / uniform(1.65, 2.1));
    hz_ = std::round(uniform(20, 40));
    linear_ = chance(0.3);
    const double cells = one_of({6, 8, 10, 12, 15, 20, 25, 30});
    // Rows and columns are counted in cells of the scene.
    const double h = std::round(1000 * vs_ / hz_ / cells) / 1000;
    const double wave = vp_ / hz_ / h;
    const double whole = small ? 0.5 : 1;
    const std::int64_t nx = count(wave * uniform(4, 8) * whole), nz = count(wave * uniform(3, 6) * whole);
    scene_.model.medium = uniform_medium(nx, nz, h, {vp_, vs_, 2300});
    add_planes(wave, whole);
    add_survey(wave);
    auto& numerics = scene_.numerics;
    numerics.order = int(one_of({5, 5, 5, 7, 9}));
    numerics.cfl = one_of({0.9, 0.9, 0.6, 0.45});
    using enum SlipCorrection;
    numerics.correction = chance(0.25) ? second : chance(0.1) ? first : chance(0.1) ? exponential : centred;
    parts_ = std::max(2, int(std::ceil((small ? 24 : 36) / cells)));
    name_ += shown(cells) + " cells, " + name_of(setting(), scene_);
  }
  const Scene<2>& scene() const { return scene_; }
  const std::string& name() const { return name_; }
  double below_hz() const { return 2 * hz_; }
  AccuracySetting setting() const {
    return {scene_.numerics.order, scene_.numerics.cfl, scene_.model.grid().spacing_m,
            scene_.numerics.correction};
  }
  /// What is compared with: smaller cells and steps, thick absorbing zones.
  Scene<2> reference() const {
    const double h = scene_.model.grid().spacing_m / parts_;
    auto fine = with_setting(scene_, {7, 0.45, h, SlipCorrection::centred});
    fine.numerics.zone_cells = int(std::ceil((small_ ? 0.9 : 1.75) * vp_ / hz_ / h));
    return fine;
  }

 private:
  static std::int64_t count(double cells) { return std::llround(cells); }
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  bool chance(double share) { return uniform(0, 1) < share; }
  double one_of(std::initializer_list<double> values) {
    return values.begin()[std::size_t(uniform(0, double(values.size())))];
  }

  void add_planes(double wave, double whole) {
    auto& model = scene_.model;
    const auto& shape = model.grid().shape;
    model.fracture = Field<2, std::uint8_t>(model.grid());
    const auto wide = count(wave * uniform(0.8, 3.5) * whole),
               high = std::max<std::int64_t>(2, count(wave * uniform(0.2, 1.2) * whole));
    const auto i0 = std::max<std::int64_t>(0, count((double(shape[0]) - double(wide)) * uniform(0.25, 0.75)));
    const auto k0 = std::min(count(double(shape[1]) * uniform(0.55, 0.7)), shape[1] - high - 2);
    for (std::int64_t i = i0; i < std::min(i0 + wide, shape[0]); ++i)
      for (std::int64_t k = k0; k < k0 + high; ++k) model.fracture({i, k}) = 1;
    const double dip = uniform(-80, 80) * std::numbers::pi / 180, mu = 2300 * vs_ * vs_;
    SlipSystem<2> system;
    system.normal = {std::sin(dip), -std::cos(dip)};
    if (linear_) {
      system.law = FrictionLaw::none;
      system.compliance.spacing_m = 1;
      system.compliance.tangential_m_per_pa = std::exp(uniform(std::log(0.05), std::log(1))) / mu;
      system.compliance.normal_m_per_pa = uniform(0, 1) * system.compliance.tangential_m_per_pa / 3;
    } else {
      system.friction = uniform(0.05, 0.5);
      // The strength is that friction of 1 cm/s, so this is from dry to hardly slipping.
      const double strength = system.friction * 2300 * vp_ * 0.01;
      system.viscosity_s = chance(0.2) ? 0
                                       : mu / (2 * std::numbers::pi * hz_ * strength) *
                                             std::exp(uniform(std::log(0.02), std::log(3)));
    }
    model.fracture_sets = {{"cluster", {system}}};
    name_ += linear_ ? "springs " + shown(system.compliance.tangential_m_per_pa * mu, 2) + " " +
                           shown(system.compliance.normal_m_per_pa * mu, 2)
                     : "friction " + shown(system.friction, 2) + ", " + shown(system.viscosity_s, 2) + " s";
    name_ += ", dip " + shown(dip * 180 / std::numbers::pi, 2) + ", " + std::to_string(wide) + " x " +
             std::to_string(high) + ", ";
  }

  void add_survey(double wave) {
    const auto& grid = scene_.model.grid();
    const double h = grid.spacing_m, wide = double(grid.shape[0]) * h;
    const double top = std::max(0.25 * wave, 3.) * h;
    Source<2> source{{wide * uniform(0.3, 0.7), top}, Explosion{}, parse_wavelet("ricker:" + shown(hz_)), 1};
    const double kind = uniform(0, 1);
    if (kind < 0.45) {
      const double angle = chance(0.5) ? 0 : std::round(uniform(-25, 25));
      source.position_m = {wide / 2, 0};
      const auto text = (chance(0.8) ? "plane:" : "plane-s:") + shown(angle);
      source.mechanism = parse_mechanism<2>(text);
      if (chance(0.3)) source.wavelet = parse_wavelet("sine:" + shown(hz_) + ":1");
      // The front must be outside the model at the beginning.
      source.position_m[0] = angle >= 0 ? 0 : wide;
      source.amplitude = 0.01;
      name_ += text;
    } else if (kind < 0.75) {
      source.amplitude = 2300 * vp_ * vp_ * 0.01 * 1.5 * vp_ / hz_;
      name_ += "explosion";
    } else {
      source.mechanism = parse_mechanism<2>("force:0.3,1");
      source.amplitude = 2300 * vp_ * 0.01 * 4 * vp_ / hz_;
      name_ += "force";
    }
    scene_.survey.sources = {source};
    // As many receivers in cells of any size.
    for (int n = 0; n < 15; ++n) scene_.survey.receivers_m.push_back({wide * (n + 0.5) / 15, top});
    scene_.edges = edges_all(EdgeLaw::absorbing);
    const double depth = double(grid.shape[1]) * h * 0.8;
    const double slow = chance(0.5) ? vs_ : vp_;
    scene_.recording = {{Component::vx, Component::vz}, 0, 0.001};
    const double duration = depth / vp_ + std::hypot(depth, wide / 3) / slow + 3 / hz_;
    scene_.recording.duration_s = std::round(1000 * duration) / 1000;
    name_ += ", " + shown(2 * depth / (wave * h), 2) + " wavelengths, ";
  }

  std::mt19937_64 engine_;
  bool small_;
  double vp_ = 0, vs_ = 0, hz_ = 0;
  bool linear_ = false;
  int parts_ = 2;
  std::string name_;
  Scene<2> scene_;
};

}  // namespace slipwave::solver
