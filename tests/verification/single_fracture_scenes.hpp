// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lab.hpp"
#include "line_fractures.hpp"
#include "model/single_fracture.hpp"
#include "solver/simulation.hpp"

// Scenes with single fractures, and what boundary elements say of them.
namespace slipwave::solver {

/// Rock with one to four lines, drawn, an explosion beside them and receivers round them.
class SingleFractureScene {
 public:
  /// `small`: one line in few cells, for tests that are short.
  explicit SingleFractureScene(std::uint64_t seed, bool small = false) : engine_(seed) {
    for (int n = 0; n < 5; ++n) engine_();
    rock_.vp = std::round(uniform(2600, 4800));
    rock_.vs = std::round(rock_.vp / uniform(1.65, 2.1));
    rock_.rho = 2300;
    hz_ = std::round(uniform(20, 40));
    const double cells = small ? one_of({8, 10, 12}) : one_of({8, 10, 12, 16, 20, 25});
    const double wave = rock_.vs / hz_, h = std::round(1000 * wave / cells) / 1000;
    const auto side = std::int64_t(std::llround((small ? 9 : 12) * wave / h));
    scene_.model.medium = uniform_medium(side, side, h, rock_);
    middle_m_ = double(side) * h / 2;
    const int lines = small ? 1 : int(uniform(1, 5));
    name_ = shown(cells) + " cells";
    for (int n = 0; n < lines; ++n) add_line(wave);
    const Point<2> source = {middle_m_ - 3 * wave, middle_m_ + uniform(-3, 3) * wave};
    scene_.survey.sources = {
        {source, parse_mechanism<2>("explosion"), parse_wavelet("ricker:" + shown(hz_)), strength}};
    for (int n = 0; n < 16; ++n) {
      const double angle = (n + 0.5) / 8 * pi;
      scene_.survey.receivers_m.push_back(
          {middle_m_ + 3.5 * wave * std::cos(angle), middle_m_ + 3.5 * wave * std::sin(angle)});
    }
    scene_.edges = edges_all(EdgeLaw::absorbing);
    scene_.numerics.order = int(one_of({5, 5, 7, 9}));
    scene_.numerics.cfl = one_of({0.9, 0.9, 0.6, 0.45});
    scene_.recording = {{Component::vx, Component::vz}, 0, interval_s};
    scene_.recording.duration_s =
        std::round(1000 * (5 * wave / rock_.vp + 5 * wave / rock_.vs + 5 / hz_)) / 1000;
    name_ += ", order " + std::to_string(scene_.numerics.order) + ", Courant " + shown(scene_.numerics.cfl);
  }
  const Scene<2>& scene() const { return scene_; }
  const std::string& name() const { return name_; }

  /// Relative L2 error of what the lines scatter, all receivers, both components, below twice the frequency.
  double error() const {
    auto whole = scene_;
    whole.with_slip = false;
    const auto with = shoot(scene_, 1), without = shoot(whole, 1);
    const auto& wavelet = scene_.survey.sources[0].wavelet;
    std::vector<double> history;
    for (double t = 0; t < wavelet.duration_s(); t += interval_s) history.push_back(wavelet(t));
    double off = 0, all = 0;
    for (int n = 1; n <= frequencies; ++n) {
      const double omega = 2 * pi * 2 * hz_ * n / frequencies;
      LineFractures exact(rock_, omega);
      for (const auto& line : lines_) {
        const int count = std::max(4, int(length_of(line.trace) * omega / (2 * pi * rock_.vs) * 16));
        exact.add(line.trace[0], line.trace[1], count, {line.normal, line.tangential});
      }
      const auto u = exact.scattered(scene_.survey.sources[0].position_m, scene_.survey.receivers_m);
      const auto scale = strength * spectrum(history, omega);
      for (std::size_t k = 0; k < 2 * u.size(); ++k) {
        const auto found =
            spectrum(with.traces[k].samples, omega) - spectrum(without.traces[k].samples, omega);
        const auto wanted = scale * u[k % u.size()][k / u.size()];
        off += std::norm(found - wanted), all += std::norm(wanted);
      }
    }
    return std::sqrt(off / all);
  }

 private:
  static constexpr double pi = std::numbers::pi, interval_s = 0.001, strength = 1e6;
  static constexpr int frequencies = 10;
  struct Line {
    FractureTrace<2> trace;
    double normal, tangential;
  };
  void add_line(double wave) {
    const double dip = uniform(-90, 90) * pi / 180, half = uniform(0.3, 1.5) * wave / 2;
    const Point<2> at = {middle_m_ + uniform(-1, 1) * wave, middle_m_ + uniform(-1, 1) * wave};
    // The tangential one times omega rho vs/2 at the peak is from 0.005 to 3.
    const double tangential =
        std::exp(uniform(std::log(0.005), std::log(3))) / (pi * hz_ * rock_.rho * rock_.vs);
    Line line{{{at[0] - half * std::cos(dip), at[1] - half * std::sin(dip)},
               {at[0] + half * std::cos(dip), at[1] + half * std::sin(dip)}},
              tangential * uniform(0.2, 1),
              tangential};
    SlipSystem<2> system{normal_between_tips(line.trace), 0, 0, 0, false, FrictionLaw::none};
    system.compliance = {line.normal, line.tangential, 0, 0, 0};
    add_single_fractures(scene_.model, {"line " + std::to_string(lines_.size()), {system}, {line.trace}});
    name_ += ", dip " + shown(dip * 180 / pi, 2) + " with " + shown(tangential, 2) + " m/Pa";
    lines_.push_back(std::move(line));
  }
  static std::complex<double> spectrum(const std::vector<double>& samples, double omega) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < samples.size(); ++n)
      sum += samples[n] * std::polar(1., omega * double(n) * interval_s);
    return sum * interval_s;
  }
  double uniform(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  double one_of(std::initializer_list<double> values) {
    return values.begin()[std::size_t(uniform(0, double(values.size())))];
  }

  std::mt19937_64 engine_;
  Rock rock_{};
  double hz_ = 0, middle_m_ = 0;
  std::vector<Line> lines_;
  std::string name_;
  Scene<2> scene_;
};

}  // namespace slipwave::solver
