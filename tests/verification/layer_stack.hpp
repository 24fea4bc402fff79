// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "complex_system.hpp"
#include "lab.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {

/// Any stack of parallel solid and fluid layers with a line source in one of them, by wave number: a runs
/// along the layers, b across them. In each layer there are plane waves down and up, P and in solids S;
/// motion and traction are continuous at each interface (fluid slides along solid), which is one system of
/// equations for all of them. Nothing is shared with the solver.
struct LayerStack {
  std::vector<Rock> layers;  // by increasing b; fluid where vs = 0
  /// b of the interfaces: before layer n + 1, or with a free surface before layer n.
  std::vector<double> faces_m;
  bool free_surface = false;
  double source_m = 0;            // b of the source, in no face; its a is 0
  bool explosion = true;          // of unit moment rate; else
  std::array<double, 2> force{};  // N/m along a and b
  /// Of P and S waves of each layer, which makes the speeds above those of the reference frequency; empty:
  /// none loses anything.
  std::vector<std::array<ModulusOf, 2>> losses = {};

  /// A place whose motion is wanted.
  struct Receiver {
    double a, b;
  };

  /// Velocities along a and b at t = n interval of a Ricker wavelet (W1) that begins at 0, by receiver. The
  /// scattered waves are a sum over wave numbers, so sources repeat; frequencies lie below the real axis, so
  /// what comes from those, or after the window, has decayed to 1e-7. The direct wave is the closed form.
  std::vector<std::array<std::vector<double>, 2>> ricker(double peak_hz, double interval_s, std::size_t count,
                                                         const std::vector<Receiver>& receivers) const {
    constexpr double pi = std::numbers::pi;
    const double window_s = 1.3 * double(count) * interval_s, damping = 16 / window_s;
    double fastest = 0;
    for (const auto& rock : layers) fastest = std::max(fastest, rock.vp);
    const double period_m = 1.5 * fastest * window_s;
    std::vector<std::array<std::vector<double>, 2>> traces(receivers.size());
    for (auto& of_receiver : traces)
      for (auto& trace : of_receiver) trace.assign(count, 0);
    for (int bin = 0; bin < 4.5 * peak_hz * window_s; ++bin) {
      const Complex omega(2 * pi * bin / window_s, -damping), f = omega / (2 * pi * peak_hz);
      const auto spectrum = 2 / (std::sqrt(pi) * peak_hz) * f * f * std::exp(-f * f) *
                            std::exp(Complex(0, -1.5 / peak_hz) * omega);
      const auto motion = scattered(omega, period_m, receivers);
      for (std::size_t r = 0; r < receivers.size(); ++r)
        for (std::size_t n = 0; n < count; ++n) {
          const auto phase = std::exp(Complex(0, double(n) * interval_s) * omega);
          for (std::size_t row = 0; row < 2; ++row)
            traces[r][row][n] += (bin == 0 ? 1 : 2) / window_s * (motion[r][row] * spectrum * phase).real();
        }
    }
    for (std::size_t r = 0; r < receivers.size(); ++r)
      add_direct(peak_hz, interval_s, receivers[r], traces[r]);
    return traces;
  }

 private:
  /// Displacements along a and b and the tractions bb and ab, of potentials and their derivatives along b.
  using Fields = std::array<Complex, 4>;
  struct Potentials {
    Complex p, dp, s, ds;
  };
  struct Unknown {
    std::size_t layer;
    bool shear, down;
  };

  bool fluid(std::size_t layer) const { return layers[layer].vs == 0; }
  std::size_t layer_of(double b) const {
    std::size_t layer = 0;
    for (std::size_t n = free_surface ? 1 : 0; n < faces_m.size(); ++n) layer += b >= faces_m[n];
    return layer;
  }
  double top(std::size_t layer) const { return faces_m[free_surface ? layer : layer - 1]; }
  bool has_top(std::size_t layer) const { return free_surface || layer > 0; }
  bool has_bottom(std::size_t layer) const { return layer + 1 < layers.size(); }
  double bottom(std::size_t layer) const { return top(layer + 1); }
  /// At a frequency, which may be complex.
  Complex vp(std::size_t layer, Complex omega) const {
    const auto loss = losses.empty() ? 1. : losses[layer][0](omega / (2 * std::numbers::pi));
    return layers[layer].vp * std::sqrt(loss);
  }
  Complex vs(std::size_t layer, Complex omega) const {
    const auto loss = losses.empty() ? 1. : losses[layer][1](omega / (2 * std::numbers::pi));
    return layers[layer].vs * std::sqrt(loss);
  }
  static Complex decay(Complex c, Complex omega, double k) {
    return std::sqrt(k * k - omega * omega / (c * c));
  }

  Fields fields(std::size_t layer, Complex omega, double k, const Potentials& of) const {
    const Complex i(0, 1);
    const Rock& rock = layers[layer];
    if (fluid(layer)) return {-i * k * of.p, of.dp, -rock.rho * omega * omega * of.p, 0};
    const auto c = vs(layer, omega), mu = rock.rho * c * c, q = 2 * k * k - omega * omega / (c * c);
    return {-i * k * of.p - of.ds, of.dp - i * k * of.s, mu * (q * of.p - 2. * i * k * of.ds),
            mu * (-2. * i * k * of.dp - q * of.s)};
  }

  std::vector<Unknown> unknowns() const {
    std::vector<Unknown> all;
    for (std::size_t layer = 0; layer < layers.size(); ++layer)
      for (const bool shear : {false, true})
        for (const bool down : {false, true})
          if ((!shear || !fluid(layer)) && (down ? has_top(layer) : has_bottom(layer)))
            all.push_back({layer, shear, down});
    return all;
  }

  /// A wave of potential 1 at the face that it leaves.
  Fields wave(const Unknown& of, Complex omega, double k, double b) const {
    const auto m = decay(of.shear ? vs(of.layer, omega) : vp(of.layer, omega), omega, k);
    const auto value = std::exp(-m * (of.down ? b - top(of.layer) : bottom(of.layer) - b));
    const auto slope = (of.down ? -1. : 1.) * m * value;
    return of.shear ? fields(of.layer, omega, k, {0, 0, value, slope})
                    : fields(of.layer, omega, k, {value, slope, 0, 0});
  }

  /// The direct wave in the layer of the source, per k dk/2 pi: displacement of unit moment or force.
  Fields direct(Complex omega, double k, double b) const {
    const Complex i(0, 1);
    const auto layer = layer_of(source_m);
    const Rock& rock = layers[layer];
    const double sign = b >= source_m ? 1 : -1, away = std::abs(b - source_m);
    const auto c_p = vp(layer, omega), m = decay(c_p, omega, k), g = std::exp(-m * away) / (2. * m);
    if (explosion) {
      const auto p = -g / (rock.rho * c_p * c_p);
      return fields(layer, omega, k, {p, -sign * m * p, 0, 0});
    }
    const auto l = decay(vs(layer, omega), omega, k), gs = std::exp(-l * away) / (2. * l);
    const auto c = 1. / (rock.rho * omega * omega);
    const auto p = c * (force[1] * sign * m * g + force[0] * i * k * g);
    const auto s = c * (force[1] * i * k * gs - force[0] * sign * l * gs);
    return fields(layer, omega, k, {p, -sign * m * p, s, -sign * l * s});
  }

  /// One equation: sum of sign x quantity over the sides of a face.
  struct Side {
    std::size_t layer;
    double sign;
  };
  std::vector<Complex> equation(const std::vector<Unknown>& all, const std::vector<Side>& sides,
                                std::size_t quantity, double b, Complex omega, double k) const {
    std::vector<Complex> row(all.size() + 1);
    const double scale = quantity < 2 ? 1 : 1 / (layers.back().rho * layers.back().vp * std::abs(omega));
    for (const auto& side : sides) {
      for (std::size_t n = 0; n < all.size(); ++n)
        if (all[n].layer == side.layer) row[n] += side.sign * scale * wave(all[n], omega, k, b)[quantity];
      if (side.layer == layer_of(source_m)) row.back() -= side.sign * scale * direct(omega, k, b)[quantity];
    }
    return row;
  }

  ComplexSystem system(const std::vector<Unknown>& all, Complex omega, double k) const {
    ComplexSystem rows;
    const auto add = [&](const std::vector<Side>& sides, std::size_t quantity, double b) {
      rows.push_back(equation(all, sides, quantity, b, omega, k));
    };
    if (free_surface) {
      add({{0, 1}}, 2, top(0));
      if (!fluid(0)) add({{0, 1}}, 3, top(0));
    }
    for (std::size_t n = 0; n + 1 < layers.size(); ++n) {
      const std::vector<Side> both = {{n, 1}, {n + 1, -1}};
      const double b = bottom(n);
      add(both, 1, b);
      add(both, 2, b);
      if (!fluid(n) && !fluid(n + 1)) {
        add(both, 0, b);
        add(both, 3, b);
      } else {
        if (!fluid(n)) add({both[0]}, 3, b);
        if (!fluid(n + 1)) add({both[1]}, 3, b);
      }
    }
    return rows;
  }

  /// The least way across the layers of any scattered wave: wave numbers are needed until it has decayed
  /// there.
  double least_way(const std::vector<Receiver>& receivers) const {
    double least = 1e30;
    const auto from = layer_of(source_m);
    for (const auto& receiver : receivers) {
      const auto at = layer_of(receiver.b);
      if (at != from) least = std::min(least, std::abs(receiver.b - source_m));
      if (at != from) continue;
      if (has_top(at)) least = std::min(least, source_m + receiver.b - 2 * top(at));
      if (has_bottom(at)) least = std::min(least, 2 * bottom(at) - source_m - receiver.b);
    }
    return least;
  }

  std::vector<std::array<Complex, 2>> scattered(Complex omega, double period_m,
                                                const std::vector<Receiver>& receivers) const {
    std::vector<std::array<Complex, 2>> sum(receivers.size());
    const auto all = unknowns();
    double slowest = 1e30;
    for (const auto& rock : layers) slowest = std::min(slowest, rock.vs > 0 ? rock.vs : rock.vp);
    const double dk = 2 * std::numbers::pi / period_m;
    const double largest = std::abs(omega) / slowest + 20 / least_way(receivers);
    const auto rate = explosion ? Complex(1) : Complex(0, 1) * omega;
    for (int n = -int(largest / dk); n <= int(largest / dk); ++n) {
      const double k = n * dk;
      const auto found = solved(system(all, omega, k));
      for (std::size_t r = 0; r < receivers.size(); ++r) {
        const auto layer = layer_of(receivers[r].b);
        const auto phase = std::exp(Complex(0, -k * receivers[r].a)) * rate / period_m;
        for (std::size_t m = 0; m < all.size(); ++m) {
          if (all[m].layer != layer) continue;
          const auto of = wave(all[m], omega, k, receivers[r].b);
          for (std::size_t row = 0; row < 2; ++row) sum[r][row] += found[m] * of[row] * phase;
        }
      }
    }
    return sum;
  }

  Motion lossy_direct(std::size_t layer, double omega, double a, double b) const {
    if (omega == 0) return {};
    const LossyRock rock(layers[layer], omega, losses[layer][0], losses[layer][1]);
    std::array<Complex, 2> v{};
    if (explosion) v = lossy_explosion<2>(rock, omega, {a, b});
    for (const int along : {0, 1})
      if (!explosion) {
        const auto one = lossy_force<2>(rock, omega, {a, b}, along);
        for (std::size_t row = 0; row < 2; ++row) v[row] += force[std::size_t(along)] * one[row];
      }
    return {v[0], v[1]};
  }
  void add_direct(double peak_hz, double interval_s, const Receiver& receiver,
                  std::array<std::vector<double>, 2>& traces) const {
    const auto layer = layer_of(source_m);
    if (layer_of(receiver.b) != layer) return;
    const double b = receiver.b - source_m;
    const auto direct_wave =
        ricker_response(peak_hz, interval_s, std::int64_t(traces[0].size()), [&](double omega) {
          if (!losses.empty()) return lossy_direct(layer, omega, receiver.a, b);
          if (explosion) return explosion_motion(layers[layer], omega, receiver.a, b);
          Motion sum{};
          for (const int along : {0, 1}) {
            const auto one = force_motion(layers[layer], omega, receiver.a, b, along);
            for (std::size_t row = 0; row < sum.size(); ++row)
              sum[row] += force[std::size_t(along)] * one[row];
          }
          return sum;
        });
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t n = 0; n < traces[row].size(); ++n) traces[row][n] += direct_wave[row][n];
  }
};

}  // namespace slipwave::solver
