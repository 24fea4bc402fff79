// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/dispersion.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/orders.hpp"
#include "scene/splitting.hpp"
#include "solver/kernels/reconstruction.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;

/// F_up of a wave exp(i k x) that is 1 at the cell.
template <int Order>
Complex flux(double courant, double phase) {
  constexpr int reach = (Order - 1) / 2;
  double real[2 * reach + 1], imaginary[2 * reach + 1];
  const double nothing[2 * reach + 1] = {};
  for (int n = -reach; n <= reach; ++n) {
    real[n + reach] = std::cos(n * phase);
    imaginary[n + reach] = std::sin(n * phase);
  }
  double up, up_imaginary, down;
  solver::reconstruct_cell<Order>(real + reach, nothing + reach, 1, 1., courant, up, down);
  solver::reconstruct_cell<Order>(imaginary + reach, nothing + reach, 1, 1., courant, up_imaginary, down);
  return {up, up_imaginary};
}

/// flux() by the reach of the reconstruction, which grows by one from order to order.
template <int... N>
constexpr std::array<Complex (*)(double, double), sizeof...(N)> fluxes(std::integer_sequence<int, N...>) {
  return {flux<orders[N]>...};
}

/// The factor of (E12) for a wave whose phase changes by `phase` from cell to cell and travels towards higher
/// cells.
Complex factor(int order, double courant, double phase) {
  static constexpr auto flux_of = fluxes(std::make_integer_sequence<int, order_count>());
  const auto f = flux_of[std::size_t(reach_of(order))](courant, phase);
  return 1.0 - courant * f * (1.0 - std::polar(1.0, -phase));
}

/// vx, vz, sxx, szz, sxz in units of cells and steps, density 1: speeds are Courant numbers.
using Amplitudes = std::array<Complex, 5>;

/// A pair (v, s) of impedance z swept over the fraction `part` of a step.
void sweep_pair(Complex& v, Complex& s, int order, double z, double part, double phase) {
  // Back in time it is the sweep forward in time of -v.
  const double sign = part < 0 ? -1 : 1, courant = sign * part * z;
  const Complex up = (sign * z * v - s) * factor(order, courant, phase);
  const Complex down = (sign * z * v + s) * factor(order, courant, -phase);
  v = sign * (up + down) / (2 * z);
  s = (down - up) / 2.0;
}

/// A sweep along `axis` (0: x, 1: z).
void sweep(Amplitudes& u, const UniformScheme& scheme, int axis, double part, double phase) {
  const double p = scheme.courant_p, s = scheme.courant_s;
  const auto along = std::size_t(axis), across = std::size_t(1 - axis);
  const Complex before = u[2 + along];
  sweep_pair(u[along], u[2 + along], scheme.order, p, part, phase);
  u[2 + across] += (1 - 2 * s * s / (p * p)) * (u[2 + along] - before);
  if (s > 0) sweep_pair(u[across], u[4], scheme.order, s, part, phase);
}

/// The strain that belongs to stresses: their product is twice the energy. What fluids cannot carry is 0.
Amplitudes strained(const UniformScheme& scheme, const Amplitudes& u) {
  const double stiff = scheme.courant_p * scheme.courant_p, mu = scheme.courant_s * scheme.courant_s;
  const double lambda = stiff - 2 * mu;
  if (mu == 0) return {u[0], u[1], u[2] / (2 * lambda), u[3] / (2 * lambda), 0};
  const double scale = 1 / (4 * mu * (lambda + mu));
  return {u[0], u[1], scale * (stiff * u[2] - lambda * u[3]), scale * (stiff * u[3] - lambda * u[2]),
          u[4] / mu};
}

Complex product(const Amplitudes& a, const Amplitudes& b) {
  Complex sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += std::conj(a[n]) * b[n];
  return sum;
}

}  // namespace

Complex amplification(int order, double courant, double cells) {
  return factor(order, courant, 2 * std::numbers::pi / cells);
}

Complex step_error(const UniformScheme& scheme, WaveKind kind, double cells, double angle) {
  const double speed = kind == WaveKind::p ? scheme.courant_p : scheme.courant_s;
  const double x = std::sin(angle), z = std::cos(angle), mu = scheme.courant_s * scheme.courant_s;
  const double lambda = scheme.courant_p * scheme.courant_p - 2 * mu;
  const Amplitudes wave =
      kind == WaveKind::p
          ? Amplitudes{x, z, -(lambda + 2 * mu * x * x) / speed, -(lambda + 2 * mu * z * z) / speed,
                       -2 * mu * x * z / speed}
          : Amplitudes{z, -x, -2 * mu * x * z / speed, 2 * mu * x * z / speed, -mu * (z * z - x * x) / speed};
  const double phase = 2 * std::numbers::pi / cells;
  Amplitudes moved = wave;
  for (const auto& [axis, part] : splitting(2, scheme.time_order))
    sweep(moved, scheme, axis, part, phase * (axis == 0 ? x : z));
  // Exact waves are orthogonal in energy, so the share of the wave in its own mode is its eigenvalue up
  // to the square of the error.
  const auto weighed = strained(scheme, wave);
  return std::log(product(weighed, moved) / product(weighed, wave)) + Complex(0, speed * phase);
}

double loss_per_wavelength(const UniformScheme& scheme, double cells) {
  return -std::expm1(cells / scheme.courant_p * step_error(scheme, WaveKind::p, cells, 0).real());
}

}  // namespace slipwave
