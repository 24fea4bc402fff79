// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

namespace slipwave {

/// A rock or fluid: m/s, m/s, kg/m3.
struct UniformMedium {
  double vp, vs, rho;
  double mu() const { return rho * vs * vs; }
  double lambda() const { return rho * vp * vp - 2 * mu(); }
};

/// Spectra of velocity and stress at a point: vx, vz, sxx, szz, sxz.
using Motion = std::array<std::complex<double>, 5>;

/// What a line explosion of unit moment rate does at the offset x, z (m) from it, at the angular frequency
/// omega (1/s), for exp(i omega t): with g = H0(2)(k r)/(4 i), k = omega/vp, which solves lap g + k^2 g =
/// -delta,
///   v = -grad g/(rho vp^2),
/// and stresses by Hooke's law.
Motion explosion_motion(const UniformMedium& rock, double omega, double x, double z);

/// What a line force of 1 N/m along x (0) or z (1) does: g_s and g_p of k_s and k_p,
///   v_i = i omega [g_s delta_ij + (g_s - g_p),ij/k_s^2]/mu.
/// Stresses are left zero.
Motion force_motion(const UniformMedium& rock, double omega, double x, double z, int along);

/// The time functions of a motion driven by a Ricker wavelet (W1) of delay 1.5/F, at t = n interval, n = 0 ..
/// count - 1: the Fourier sum over a period of 4 s, frequencies to 6 F (its spectrum is below 1e-13 of its
/// peak there). What wraps round after 4 s has decayed.
std::array<std::vector<double>, 5> ricker_response(double peak_hz, double interval_s, std::int64_t count,
                                                   const std::function<Motion(double omega)>& motion_at);

}  // namespace slipwave
