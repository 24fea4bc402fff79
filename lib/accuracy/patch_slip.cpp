// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/patch_slip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fft.hpp"
#include "model/plane_motion.hpp"
#include "model/plane_strain.hpp"
#include "model/spline_shares.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;
using Tensor = SymmetricTensor<2, double>;

/// Samples in a period of the wavelet, and in all.
constexpr double samples_per_period = 100;
constexpr std::size_t most_samples = 4000;
/// Periods after the wavelet.
constexpr double periods_after = 3;
/// How much more often waves that run along nearly open fractures, and back from their tips, feel what these
/// send out (S33a); fitted to what boundary elements say (docs/slip.md).
constexpr double there_and_back = 1.5;

/// Slip of a system, rate by time, along across(normal).
std::vector<double> slip_rates(const SlipSystem<2>& system, double mu, double normal_pa, double tau_pa,
                               double normal_before_pa, double tau_before_pa, const WaveHistory& history) {
  const double dt = history.interval_s;
  std::vector<double> rates;
  double slip = 0;
  for (const double value : history.values) {
    const double load = tau_before_pa + value * tau_pa - mu * slip;
    const double strength =
        system.friction * std::max(-(normal_before_pa + value * normal_pa), 0.) + system.strength_pa;
    const double excess = std::max(std::abs(load) - strength, 0.);
    const double left =
        system.viscosity_s > 0 && strength > 0 ? std::exp(-mu * dt / (system.viscosity_s * strength)) : 0;
    const double more = std::copysign(excess * (1 - left), load) / mu;
    slip += more;
    rates.push_back(more / dt);
  }
  return rates;
}

std::vector<Complex> spectrum_of(const std::vector<double>& values, const WaveHistory& history) {
  std::vector<Complex> spectrum;
  for (const auto& phases : history.phases) {
    Complex sum = 0;
    for (std::size_t n = 0; n < values.size(); ++n) sum += values[n] * phases[n];
    spectrum.push_back(sum);
  }
  return spectrum;
}

/// Spectrum of the rate of the history.
std::vector<Complex> rate_of(const WaveHistory& history) {
  auto rate = spectrum_of(history.values, history);
  for (std::size_t f = 0; f < rate.size(); ++f) rate[f] *= Complex(0, 2 * std::numbers::pi * history.hz[f]);
  return rate;
}

/// Adds the moment of planes with that normal which open and, along (n_z, -n_x), slip.
void add_jump(SymmetricTensor<2, Complex>& moment, const UniformMedium& rock, const Point<2>& n,
              const Complex& opening, const Complex& slip) {
  const double mu = rock.mu(), lambda = rock.lambda();
  const Point<2> t = {n[1], -n[0]};
  for (const int i : {0, 1})
    for (int j = i; j < 2; ++j) {
      const auto a = std::size_t(i), b = std::size_t(j);
      moment(i, j) +=
          opening * ((i == j ? lambda : 0) + 2 * mu * n[a] * n[b]) + mu * slip * (n[a] * t[b] + t[a] * n[b]);
    }
}

}  // namespace

double WaveHistory::largest() const {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

WaveHistory history_of(const Wavelet& wavelet, bool of_line_source, std::vector<double> hz) {
  const double period = 1 / wavelet.nominal_hz(), whole = wavelet.duration_s() + periods_after * period;
  const auto count = fast_transform_length(
      std::min(most_samples, std::size_t(std::ceil(whole / period * samples_per_period))));
  WaveHistory history{whole / double(count), {}, std::move(hz), {}};
  for (std::size_t n = 0; n < count; ++n) history.values.push_back(wavelet(double(n) * history.interval_s));
  if (of_line_source) {
    RealTransform transform(count);
    const auto bins = transform.forward(history.values);
    std::vector<Complex> steeper(bins.begin(), bins.end());
    for (std::size_t n = 0; n < steeper.size(); ++n)
      steeper[n] *= std::sqrt(Complex(0, 2 * std::numbers::pi * double(n) / whole));
    const auto back = transform.backward(steeper);
    history.values.assign(back.begin(), back.end());
  }
  for (const double f : history.hz) {
    auto& of = history.phases.emplace_back();
    for (std::size_t n = 0; n < count; ++n)
      of.push_back(
          std::polar(history.interval_s, -2 * std::numbers::pi * f * double(n) * history.interval_s));
  }
  return history;
}

MomentSpectrum moment_rate_of(const FractureSet<2>& set, const UniformMedium& rock, const Tensor& stress,
                              const Tensor& prestress, const WaveHistory& history) {
  const double mu = rock.mu(), lambda = rock.lambda();
  const auto rate_of_wave = rate_of(history);
  MomentSpectrum moment(history.hz.size());
  for (const auto& system : set.systems) {
    const auto& n = system.normal;
    const Point<2> t = {n[1], -n[0]};
    Point<2> tau{}, tau_before{};
    const double normal = resolve<2, double>(n, stress, tau), along = tau[0] * t[0] + tau[1] * t[1];
    const double before = resolve<2, double>(n, prestress, tau_before);
    const auto springs = slip::bounded(compliance_in(system.compliance, lambda, mu), lambda, mu);
    const double soft_n = springs.normal / (1 + (lambda + 2 * mu) * springs.normal) * normal,
                 soft_t = springs.tangential / (1 + mu * springs.tangential) * along;
    std::vector<Complex> slip(history.hz.size());
    if (system.slides())
      slip = spectrum_of(
          slip_rates(system, mu, normal, along, before, tau_before[0] * t[0] + tau_before[1] * t[1], history),
          history);
    for (std::size_t f = 0; f < moment.size(); ++f)
      add_jump(moment[f], rock, n, soft_n * rate_of_wave[f], soft_t * rate_of_wave[f] + slip[f]);
  }
  return moment;
}

Slower slower_in_springs(const FractureSet<2>& set, const UniformMedium& rock, const Point<2>& n, double hz) {
  const double mu = rock.mu(), lambda = rock.lambda(), whole = 4 * mu * (lambda + mu);
  if (!(mu > 0)) return {};
  // Compliances of rock and planes add up; Hooke's law the other way round then gives the stiffness.
  PlaneStiffness compliance{
      (lambda + 2 * mu) / whole, -lambda / whole, 0, (lambda + 2 * mu) / whole, 0, 1 / mu};
  for (const auto& system : set.systems) {
    const auto springs = slip::bounded(compliance_in(system.compliance, lambda, mu), lambda, mu);
    const auto give = [&](double of, double damping) {
      return of / std::hypot(1, 2 * std::numbers::pi * hz * of * damping);
    };
    const auto of = strain_of_plane<2>(system.normal, give(springs.normal, springs.normal_damping),
                                       give(springs.tangential, springs.tangential_damping));
    compliance.c11 += of[0], compliance.c13 += of[1], compliance.c15 += of[2];
    compliance.c33 += of[4], compliance.c35 += of[5], compliance.c55 += 2 * of[8];
  }
  const auto xx = strain_of_stress(compliance, {1, 0, 0}), zz = strain_of_stress(compliance, {0, 1, 0}),
             xz = strain_of_stress(compliance, {0, 0, 1});
  const PlaneStiffness stiffness{xx[0], xx[1], xx[2], zz[1], zz[2], xz[2]};
  const auto times = [&](double speed, bool shear) {
    return std::max(1., speed / plane_motion(stiffness, rock.rho, n[0], n[1], shear).speed);
  };
  return {times(rock.vp, false), times(rock.vs, true)};
}

SmearedMoment moment_rate_of_single(const LinearCompliance& compliance, const FracturePiece& piece,
                                    const UniformMedium& rock, const Tensor& stress,
                                    const WaveHistory& history) {
  const auto& n = piece.normal;
  Point<2> tau{};
  const double across = resolve<2, double>(n, stress, tau), along = tau[0] * n[1] - tau[1] * n[0];
  const double nu = rock.lambda() / (2 * (rock.lambda() + rock.mu()));
  // What rock about a crack of that length resists it with at rest, on average.
  const double at_rest = 4 * rock.mu() / (std::numbers::pi * (1 - nu) * piece.whole_m);
  const auto rate_of_wave = rate_of(history);
  SmearedMoment moment{MomentSpectrum(history.hz.size()), MomentSpectrum(history.hz.size())};
  for (std::size_t f = 0; f < rate_of_wave.size(); ++f) {
    const double omega = 2 * std::numbers::pi * history.hz[f];
    const auto give = [&](double z, double speed) {
      return z / (1. + z * Complex(at_rest, omega * rock.rho * speed / 2));
    };
    const Complex normal = give(compliance.normal_m_per_pa, rock.vp),
                  tangential = give(compliance.tangential_m_per_pa, rock.vs);
    const Complex opening = normal * across * rate_of_wave[f], slip = tangential * along * rate_of_wave[f];
    const auto off = [&](double z, double speed) {
      const double x = omega * z * rock.rho * speed / 2;
      return omega * omega * rock.rho / 2 * (1 + there_and_back * x * x / (16 + x * x));
    };
    add_jump(moment.rate[f], rock, n, opening, slip);
    add_jump(moment.off[f], rock, n, off(compliance.normal_m_per_pa, rock.vp) * normal * opening,
             off(compliance.tangential_m_per_pa, rock.vs) * tangential * slip);
  }
  return moment;
}

}  // namespace slipwave
