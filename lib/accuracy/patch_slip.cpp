#include "accuracy/patch_slip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fft.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;
using Tensor = SymmetricTensor<2, double>;

/// Samples in a period of the wavelet, and in all.
constexpr double samples_per_period = 100;
constexpr std::size_t most_samples = 4000;
/// Periods after the wavelet.
constexpr double periods_after = 3;

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

}  // namespace

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
  std::vector<Complex> rate_of_wave = spectrum_of(history.values, history);
  for (std::size_t f = 0; f < rate_of_wave.size(); ++f)
    rate_of_wave[f] *= Complex(0, 2 * std::numbers::pi * history.hz[f]);
  MomentSpectrum moment(history.hz.size());
  for (const auto& system : set.systems) {
    const auto& n = system.normal;
    const Point<2> t = {n[1], -n[0]};
    Point<2> tau{}, tau_before{};
    const double normal = resolve<2, double>(n, stress, tau), along = tau[0] * t[0] + tau[1] * t[1];
    const double before = resolve<2, double>(n, prestress, tau_before);
    const auto springs = compliance_in(system.compliance, lambda, mu);
    const double soft_n = springs.normal / (1 + (lambda + 2 * mu) * springs.normal) * normal,
                 soft_t = springs.tangential / (1 + mu * springs.tangential) * along;
    std::vector<Complex> slip(history.hz.size());
    if (system.slides())
      slip = spectrum_of(
          slip_rates(system, mu, normal, along, before, tau_before[0] * t[0] + tau_before[1] * t[1], history),
          history);
    for (std::size_t f = 0; f < moment.size(); ++f)
      for (const int i : {0, 1})
        for (int j = i; j < 2; ++j) {
          const auto a = std::size_t(i), b = std::size_t(j);
          moment[f](i, j) += soft_n * rate_of_wave[f] * ((i == j ? lambda : 0) + 2 * mu * n[a] * n[b]) +
                             mu * (soft_t * rate_of_wave[f] + slip[f]) * (n[a] * t[b] + t[a] * n[b]);
        }
  }
  return moment;
}

}  // namespace slipwave
