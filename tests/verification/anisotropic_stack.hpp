// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "complex_system.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave::solver {

/// A stack of flat layers, VTI or tilted, of solids (and fluids, where c55 is 0) with a line source in one of
/// them, by wave number: in each layer plane quasi-P and quasi-S waves go down and up, the roots of the
/// Christoffel equation for a horizontal wave number; motion and traction are continuous at interfaces, one
/// system of equations for all of them (the plane-wave coefficients of Daley & Hron 1977 are its solution for
/// one interface). Nothing is shared with the solver but the stiffnesses of a rock.
struct AnisotropicStack {
  using Complex = std::complex<double>;
  struct RealPlane {
    RealPlane(const Elasticity<2>& c)  // NOLINT(google-explicit-constructor): a layer is given either
        : c11(c(1, 1)), c13(c(1, 3)), c15(c(1, 5)), c33(c(3, 3)), c35(c(3, 5)), c55(c(5, 5)) {}
    double c11, c13, c15, c33, c35, c55;
  };
  /// Of rock that attenuates.
  struct ComplexPlane {
    Complex c11, c13, c15, c33, c35, c55;
  };
  struct Layer {
    RealPlane c;
    double rho;
    std::function<ComplexPlane(Complex omega)> relaxed = {};  // by frequency; none where it is elastic
  };
  std::vector<Layer> layers;   // from the top down
  std::vector<double> tops_m;  // of the layers below the first
  bool free_surface = false;   // at z = 0
  double source_m = 0;         // depth; its x is 0
  /// Forces along x and z, or moment rates xx = zz and xz, that are the wavelet.
  std::array<double, 2> force{};
  double explosion = 0, couple = 0;

  struct Receiver {
    double x, z;
  };

  /// vx and vz at t = n interval of a Ricker wavelet that begins at 0 and peaks at 1.5/F, by receiver. None
  /// may be as deep as the source. Sources repeat along x, and frequencies lie below the real axis, so that
  /// what comes from those, or after the window, has decayed.
  std::vector<std::array<std::vector<double>, 2>> ricker(double peak_hz, double interval_s, std::size_t count,
                                                         const std::vector<Receiver>& receivers) const {
    constexpr double pi = std::numbers::pi;
    const double window_s = 1.3 * double(count) * interval_s, damping = 16 / window_s;
    double fastest = 0;
    for (const auto& layer : layers)
      fastest = std::max(fastest, std::sqrt(std::max(layer.c.c11, layer.c.c33) / layer.rho));
    const double period_m = 1.5 * fastest * window_s;
    std::vector<std::array<std::vector<double>, 2>> traces(receivers.size());
    for (auto& of_receiver : traces)
      for (auto& trace : of_receiver) trace.assign(count, 0);
    for (int bin = 0; bin < 4.5 * peak_hz * window_s; ++bin) {
      const Complex omega(2 * pi * bin / window_s, -damping), f = omega / (2 * pi * peak_hz);
      const auto spectrum = 2 / (std::sqrt(pi) * peak_hz) * f * f * std::exp(-f * f) *
                            std::exp(Complex(0, -1.5 / peak_hz) * omega);
      const auto motion = velocities(omega, period_m, receivers);
      for (std::size_t r = 0; r < receivers.size(); ++r)
        for (std::size_t n = 0; n < count; ++n) {
          const auto phase = std::exp(Complex(0, double(n) * interval_s) * omega);
          for (std::size_t row = 0; row < 2; ++row)
            traces[r][row][n] += (bin == 0 ? 1 : 2) / window_s * (motion[r][row] * spectrum * phase).real();
        }
    }
    return traces;
  }

  /// ux, uz, szz, sxz.
  using Fields = std::array<Complex, 4>;
  /// A wave that decays as exp(-m |z - z0|), with its fields at z0.
  struct Wave {
    Complex m;
    Fields fields;
  };
  /// Both waves of a solid, the one of a fluid, down or up.
  template <class Plane>
  static std::vector<Wave> waves(const Plane& c, double rho, bool down, Complex omega, double k) {
    const auto& [c11, c13, c15, c33, c35, c55] = c;
    const Complex inertia = rho * omega * omega;
    if (c55 == 0.) {
      const auto m = std::sqrt(k * k - inertia / c33), s = down ? -m : m;
      return {{m, {-i * k, s, -inertia, 0}}};
    }
    if (c15 != 0. || c35 != 0.) return tilted_waves(c, down, inertia, k);
    const auto a = c33 * c55, sum = c13 + c55;
    const Complex x = inertia - c11 * k * k, z = inertia - c55 * k * k,
                  b = c55 * z + c33 * x + k * k * sum * sum, root = std::sqrt(b * b - 4. * a * x * z);
    std::vector<Wave> both;
    for (const double sign : {1., -1.}) {
      const Complex square = (-b + sign * root) / (2. * a);
      auto m = std::sqrt(square);
      if (m.real() < 0) m = -m;
      const auto s = down ? -m : m;
      // Either equation of the two gives the motion; one of them may say nothing.
      std::array<Complex, 2> u = {i * k * sum * s, c55 * square + x};
      const std::array<Complex, 2> other = {c33 * square + z, i * k * sum * s};
      if (std::norm(other[0]) + std::norm(other[1]) > std::norm(u[0]) + std::norm(u[1])) u = other;
      const double size = std::sqrt(std::norm(u[0]) + std::norm(u[1]));
      const auto ux = u[0] / size, uz = u[1] / size;
      both.push_back({m, {ux, uz, -i * k * c13 * ux + c33 * s * uz, c55 * (s * ux - i * k * uz)}});
    }
    return both;
  }

 private:
  static constexpr Complex i{0, 1};
  struct Unknown {
    std::size_t layer;
    bool down;
    Wave wave;
  };

  bool fluid(std::size_t n) const { return layers[n].c.c55 == 0; }
  bool has_top(std::size_t n) const { return free_surface || n > 0; }
  double top(std::size_t n) const { return n > 0 ? tops_m[n - 1] : 0; }
  bool has_bottom(std::size_t n) const { return n + 1 < layers.size(); }
  std::size_t layer_of(double z) const {
    std::size_t n = 0;
    for (const double top_m : tops_m) n += z >= top_m;
    return n;
  }

  /// what(stiffness), real or complex.
  template <class What>
  auto with_stiffness(std::size_t layer, Complex omega, const What& what) const {
    const auto& of = layers[layer];
    return of.relaxed ? what(of.relaxed(omega)) : what(of.c);
  }

  std::vector<Wave> waves(std::size_t layer, bool down, Complex omega, double k) const {
    return with_stiffness(layer, omega,
                          [&](const auto& c) { return waves(c, layers[layer].rho, down, omega, k); });
  }
  /// Where the axis is tilted: the roots are those of a polynomial of fourth degree, two decay down, two up.
  template <class Plane>
  static std::vector<Wave> tilted_waves(const Plane& c, bool down, Complex inertia, double k) {
    const Complex q = -i * k;
    // The Christoffel matrix by powers of s, the derivative along z.
    const std::array<Complex, 3> xx = {inertia + q * q * c.c11, 2. * q * c.c15, c.c55},
                                 zz = {inertia + q * q * c.c55, 2. * q * c.c35, c.c33},
                                 xz = {q * q * c.c15, q * (c.c13 + c.c55), c.c35};
    std::array<Complex, 5> of{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) of[a + b] += xx[a] * zz[b] - xz[a] * xz[b];
    const auto at = [](const auto& powers, Complex s) {
      Complex sum = 0;
      for (std::size_t n = powers.size(); n-- > 0;) sum = sum * s + powers[n];
      return sum;
    };
    // All roots at once (Durand and Kerner).
    const double size = std::sqrt(std::abs(inertia / c.c55)) + std::abs(k);
    std::array<Complex, 4> roots;
    for (std::size_t n = 0; n < 4; ++n) roots[n] = size * std::exp(Complex(0, 0.4 + 1.5 * double(n)));
    for (int round = 0; round < 200; ++round) {
      double most = 0;
      for (std::size_t n = 0; n < 4; ++n) {
        Complex others = of[4];
        for (std::size_t m = 0; m < 4; ++m)
          if (m != n) others *= roots[n] - roots[m];
        const auto change = at(of, roots[n]) / others;
        roots[n] -= change;
        most = std::max(most, std::abs(change));
      }
      if (most < 1e-14 * size) break;
    }
    std::sort(roots.begin(), roots.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
    std::vector<Wave> both;
    for (std::size_t n = 0; n < 2; ++n) {
      const auto s = roots[down ? n : n + 2];
      std::array<Complex, 2> u = {-at(xz, s), at(xx, s)};
      const std::array<Complex, 2> other = {at(zz, s), -at(xz, s)};
      if (std::norm(other[0]) + std::norm(other[1]) > std::norm(u[0]) + std::norm(u[1])) u = other;
      const double length = std::sqrt(std::norm(u[0]) + std::norm(u[1]));
      const auto ux = u[0] / length, uz = u[1] / length;
      const auto exx = q * ux, ezz = s * uz, shear = s * ux + q * uz;
      both.push_back(
          {down ? -s : s,
           {ux, uz, c.c13 * exx + c.c33 * ezz + c.c35 * shear, c.c15 * exx + c.c35 * ezz + c.c55 * shear}});
    }
    return both;
  }

  /// What the source makes of the fields from just above it to just below.
  template <class Plane>
  Fields jump(const Plane& c, double k) const {
    if (c.c55 == 0.) return {0, explosion / c.c33, -force[1], -force[0]};
    // A moment is what strains across the source would hold.
    const auto size = c.c33 * c.c55 - c.c35 * c.c35;
    const auto ux = (c.c33 * couple - c.c35 * explosion) / size,
               uz = (c.c55 * explosion - c.c35 * couple) / size;
    return {ux, uz, -force[1], -force[0] - i * k * (explosion - c.c13 * uz - c.c15 * ux)};
  }
  /// The waves that leave the source up and down, with their amplitudes.
  std::array<std::vector<Wave>, 2> direct(Complex omega, double k) const {
    const auto layer = layer_of(source_m);
    std::array<std::vector<Wave>, 2> sides = {waves(layer, false, omega, k), waves(layer, true, omega, k)};
    const std::vector<std::size_t> rows =
        fluid(layer) ? std::vector<std::size_t>{1, 2} : std::vector<std::size_t>{0, 1, 2, 3};
    const auto jumps = with_stiffness(layer, omega, [&](const auto& c) { return jump(c, k); });
    ComplexSystem system;
    for (const auto row : rows) {
      const double scale = row < 2 ? 1 : 1 / (layers[layer].rho * std::abs(omega) * 1000);
      auto& equation = system.emplace_back();
      for (const auto& wave : sides[1]) equation.push_back(scale * wave.fields[row]);
      for (const auto& wave : sides[0]) equation.push_back(-scale * wave.fields[row]);
      equation.push_back(scale * jumps[row]);
    }
    const auto found = solved(std::move(system));
    for (std::size_t n = 0; n < found.size(); ++n) {
      const auto half = found.size() / 2;
      for (auto& field : (n < half ? sides[1][n] : sides[0][n - half]).fields) field *= found[n];
    }
    return sides;
  }
  static void add(const Wave& wave, double away_m, Complex factor, Fields& to) {
    const auto value = factor * std::exp(-wave.m * away_m);
    for (std::size_t row = 0; row < 4; ++row) to[row] += value * wave.fields[row];
  }

  std::vector<Unknown> unknowns(Complex omega, double k) const {
    std::vector<Unknown> all;
    for (std::size_t n = 0; n < layers.size(); ++n)
      for (const bool down : {false, true})
        if (down ? has_top(n) : has_bottom(n))
          for (const auto& wave : waves(n, down, omega, k)) all.push_back({n, down, wave});
    return all;
  }
  double away(const Unknown& of, double z) const {
    return of.down ? z - top(of.layer) : top(of.layer + 1) - z;
  }

  std::vector<Complex> scattered(const std::vector<Unknown>& all,
                                 const std::array<std::vector<Wave>, 2>& from, Complex omega) const {
    ComplexSystem system;
    const auto layer_of_source = layer_of(source_m);
    const auto add_equation = [&](std::size_t row, double z, std::size_t above, bool of_above,
                                  bool of_below) {
      const double scale = row < 2 ? 1 : 1 / (layers[0].rho * std::abs(omega) * 1000);
      auto& equation = system.emplace_back(all.size() + 1);
      const auto side = [&](std::size_t layer, double sign) {
        for (std::size_t n = 0; n < all.size(); ++n)
          if (all[n].layer == layer)
            equation[n] +=
                sign * scale * all[n].wave.fields[row] * std::exp(-all[n].wave.m * away(all[n], z));
        if (layer != layer_of_source) return;
        Fields sum{};
        for (const auto& wave : from[z > source_m ? 1 : 0]) add(wave, std::abs(z - source_m), 1, sum);
        equation.back() -= sign * scale * sum[row];
      };
      if (of_above) side(above, 1);
      if (of_below) side(above + 1, -1);
    };
    if (free_surface) {
      // The layer below the surface as the one above a face.
      add_equation(2, 0, 0, true, false);
      if (!fluid(0)) add_equation(3, 0, 0, true, false);
    }
    for (std::size_t n = 0; n + 1 < layers.size(); ++n) {
      const double z = top(n + 1);
      const bool above = !fluid(n), below = !fluid(n + 1);
      add_equation(1, z, n, true, true);
      add_equation(2, z, n, true, true);
      if (above && below) add_equation(0, z, n, true, true);
      if (above && below)
        add_equation(3, z, n, true, true);
      else if (above || below)
        add_equation(3, z, n, above, below);
    }
    return system.empty() ? std::vector<Complex>{} : solved(std::move(system));
  }

  double least_way(const std::vector<Receiver>& receivers) const {
    double least = 1e30;
    for (const auto& receiver : receivers) least = std::min(least, std::abs(receiver.z - source_m));
    return least;
  }

  std::vector<std::array<Complex, 2>> velocities(Complex omega, double period_m,
                                                 const std::vector<Receiver>& receivers) const {
    std::vector<std::array<Complex, 2>> sum(receivers.size());
    double slowest = 1e30;
    for (const auto& of : layers)
      slowest = std::min(slowest, 0.6 * std::sqrt((of.c.c55 > 0 ? of.c.c55 : of.c.c33) / of.rho));
    const double dk = 2 * std::numbers::pi / period_m;
    const double largest = std::abs(omega) / slowest + 20 / least_way(receivers);
    const auto rate = force[0] == 0 && force[1] == 0 ? Complex(1) : i * omega;
    for (int n = -int(largest / dk); n <= int(largest / dk); ++n) {
      const double k = n * dk;
      const auto all = unknowns(omega, k);
      const auto from = direct(omega, k);
      const auto found = scattered(all, from, omega);
      for (std::size_t r = 0; r < receivers.size(); ++r) {
        const auto layer = layer_of(receivers[r].z);
        Fields fields{};
        if (layer == layer_of(source_m))
          for (const auto& wave : from[receivers[r].z > source_m ? 1 : 0])
            add(wave, std::abs(receivers[r].z - source_m), 1, fields);
        for (std::size_t m = 0; m < all.size(); ++m)
          if (all[m].layer == layer) add(all[m].wave, away(all[m], receivers[r].z), found[m], fields);
        const auto phase = std::exp(Complex(0, -k * receivers[r].x)) * rate / period_m;
        for (std::size_t row = 0; row < 2; ++row) sum[r][row] += fields[row] * phase;
      }
    }
    return sum;
  }
};

}  // namespace slipwave::solver
