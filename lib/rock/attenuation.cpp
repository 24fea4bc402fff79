// SPDX-License-Identifier: BSD-3-Clause
#include "rock/attenuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/last_found.hpp"
#include "rock/bulk_part.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Q is wanted within this; a qp is capped without a word by less.
constexpr double wanted_error = 0.03;
/// Rates are spread for a Q at which shares are small.
constexpr double weak_quality = 100;
constexpr int frequencies = 64;

/// Frequency number n of the band, evenly by logarithm.
double frequency(int n, double low_hz, double high_hz) {
  return low_hz * std::pow(high_hz / low_hz, double(n) / (frequencies - 1));
}

/// 1/(1 + i f/rate): what a mechanism takes from the modulus (Q1).
std::complex<double> relaxed(double hz, double rate) {
  return 1. / std::complex<double>(1, 2 * std::numbers::pi * hz / rate);
}

/// A_l of (Q8).
double part_relaxed(double half_interval) {
  return half_interval > 0 ? std::tanh(half_interval) / half_interval : 1;
}

/// The P modulus is the bulk modulus and this many times the shear modulus.
template <int D>
constexpr double of_shear = D == 2 ? 1. : 4. / 3;

/// The rock of a cell whose stress relaxes about axes of its own; nothing where it is isotropic.
template <int D>
std::optional<Material> rock_with_axis(const Medium<D>& medium, std::size_t cell) {
  if (is_anisotropic(medium, cell) || (D == 2 && is_tilted_mean(medium, cell))) return rock_of(medium, cell);
  return {};
}

/// What of the P modulus relaxes by shear, over the density (Q5), (Q9), (Q11); (m/s)^2.
template <int D>
double shear_part(double vs, const std::optional<Material>& rock) {
  if (!rock) return of_shear<D> * vs * vs;
  if (D == 3) return (1 - bulk_part(upright_elasticity<3>(*rock)).share) * rock->vp * rock->vp;
  const auto c = upright_elasticity<2>(*rock);
  return (c(3, 3) - c(1, 3) * std::sqrt(c(3, 3) / c(1, 1))) / (2 * rock->rho);
}

/// Sets the delta of a rock to what is left of both parts of its P modulus over the density (Q10).
void set_delta(Medium<2>& medium, std::size_t cell, const Material& rock, double bulk, double shear) {
  const double p = bulk + shear, vs = medium.vs[cell], along = 1 + 2 * rock.epsilon;
  const auto left =
      material_of(vertical_symmetry(p * along, (bulk - shear) * std::sqrt(along), p, vs * vs), 1);
  medium[is_tilted_mean(medium, cell) ? Property::cut_delta : Property::delta][cell] = float(left.delta);
}

/// Sets the deltas of a rock in 3-D (Q12) whose speeds in the medium have changed.
void set_deltas(Medium<3>& medium, std::size_t cell, const Material& rock) {
  const double p = std::pow(medium.vp[cell] / rock.vp, 2), s = std::pow(medium.vs[cell] / rock.vs, 2);
  const auto c = upright_elasticity<3>(rock);
  // Sums below 0 have no delta (O2).
  auto left = c;
  for (int one = 1; one <= 3; ++one) {
    left.set(one, one, p * c(one, one)), left.set(one + 3, one + 3, s * c(one + 3, one + 3));
    for (int other = one + 1; other <= 3; ++other) {
      const int shear = 9 - one - other;
      left.set(one, other,
               std::max((p - s) * std::sqrt(c(one, one) * c(other, other)) + s * c(one, other),
                        -s * c(shear, shear)));
    }
  }
  const auto now = material_of(left, rock.rho);
  medium[Property::delta][cell] = float(now.delta);
  if (!medium.has(Property::delta1)) return;
  const auto of = now.orthorhombic.value_or(Orthorhombic{0, now.delta, 0, 0});
  medium[Property::delta1][cell] = float(rock.orthorhombic ? of.delta1 : now.delta);
  medium[Property::delta3][cell] = float(rock.orthorhombic ? of.delta3 : 0);
}

/// Largest qp of a cell: shear loss alone (Q6).
double most_qp(double vp, double shear, double qs) {
  if (shear == 0 || std::isinf(qs)) return infinite;
  return qs * vp * vp / shear;
}

struct Qualities {
  double p = infinite, s = infinite;
};

template <int D>
Qualities qualities(const Medium<D>& medium, std::size_t cell) {
  if (medium.is_void(cell)) return {};
  const auto of = [&](Property property) {
    const double q = medium.value(property, cell);
    return q < double(elastic_quality) ? q : infinite;
  };
  return {of(Property::qp), medium.is_fluid(cell) ? infinite : of(Property::qs)};
}

}  // namespace

Mechanisms::Mechanisms(int count, double low_hz, double high_hz)
    : count_(count), low_hz_(low_hz), high_hz_(high_hz) {
  if (count < fewest_mechanisms || count > most_mechanisms)
    throw Error("found " + std::to_string(count) + " mechanisms, expected " +
                    std::to_string(fewest_mechanisms) + " to " + std::to_string(most_mechanisms),
                ErrorKind::usage);
  if (!(low_hz > 0) || !(high_hz > low_hz) || !std::isfinite(high_hz))
    throw Error("found a band of " + shown(low_hz) + " to " + shown(high_hz) +
                    " Hz, expected two frequencies above 0, the lower one first",
                ErrorKind::usage);
  // By how much of the band's half width the outer rates are off its middle: the best of these.
  double best = infinite, width = 0;
  for (int n = 20; n < 100; ++n) {
    const double part = 0.02 * n;
    spread(part);
    const double error = largest_error(weak_quality);
    if (error < best) best = error, width = part;
  }
  spread(width);
  error_limit_ = std::max(wanted_error, 2 * best);
  double fitted = weak_quality, failing = 0.5;
  while (fitted - failing > 1e-3 * fitted) {
    const double middle = (fitted + failing) / 2;
    (largest_error(middle) <= error_limit_ ? fitted : failing) = middle;
  }
  least_quality_ = fitted;
}

/// Chooses the rates and sums up the normal equations.
void Mechanisms::spread(double half_width) {
  const double middle = std::sqrt(low_hz_ * high_hz_), ratio = std::sqrt(high_hz_ / low_hz_);
  for (int l = 0; l < count_; ++l)
    rates_[std::size_t(l)] =
        2 * std::numbers::pi * middle * std::pow(ratio, half_width * (2 * double(l) / (count_ - 1) - 1));
  squares_ = products_ = ones_ = {};
  sum_of_losses_ = sum_of_stores_ = {};
  for (int n = 0; n < frequencies; ++n) {
    std::array<std::complex<double>, most_mechanisms> of{};
    for (std::size_t l = 0; l < std::size_t(count_); ++l)
      of[l] = relaxed(frequency(n, low_hz_, high_hz_), rates_[l]);
    for (std::size_t l = 0; l < std::size_t(count_); ++l) {
      sum_of_losses_[l] -= of[l].imag();
      sum_of_stores_[l] += of[l].real();
      for (std::size_t m = 0; m < std::size_t(count_); ++m) {
        squares_[l][m] += of[l].imag() * of[m].imag();
        products_[l][m] -= of[l].imag() * of[m].real() + of[l].real() * of[m].imag();
        ones_[l][m] += of[l].real() * of[m].real();
      }
    }
  }
}

/// By Cholesky's elimination.
RelaxedShares Mechanisms::shares(double q) const {
  RelaxedShares y{};
  if (std::isinf(q)) return y;
  const auto size = std::size_t(count_);
  Matrix a{};
  for (std::size_t l = 0; l < size; ++l) {
    y[l] = q * sum_of_losses_[l] + sum_of_stores_[l];
    for (std::size_t m = 0; m < size; ++m)
      a[l][m] = q * q * squares_[l][m] + q * products_[l][m] + ones_[l][m];
  }
  for (std::size_t l = 0; l < size; ++l)
    for (std::size_t row = l + 1; row < size; ++row) {
      const double factor = a[row][l] / a[l][l];
      for (std::size_t m = l; m < size; ++m) a[row][m] -= factor * a[l][m];
      y[row] -= factor * y[l];
    }
  for (std::size_t l = size; l-- > 0;) {
    for (std::size_t m = l + 1; m < size; ++m) y[l] -= a[l][m] * y[m];
    y[l] /= a[l][l];
  }
  return y;
}

std::complex<double> Mechanisms::modulus(const RelaxedShares& shares, double hz) const {
  std::complex<double> modulus = 1;
  for (std::size_t l = 0; l < std::size_t(count_); ++l) modulus -= shares[l] * relaxed(hz, rates_[l]);
  return modulus;
}

std::complex<double> Mechanisms::stepwise_modulus(const RelaxedShares& shares, double hz,
                                                  double interval_s) const {
  const double b = std::numbers::pi * hz * interval_s;
  std::complex<double> modulus = 1;
  for (std::size_t l = 0; l < std::size_t(count_); ++l) {
    const double a = rates_[l] * interval_s / 2, part = part_relaxed(a);
    modulus -= shares[l] *
               (1 - part + part * std::sinh(a) * std::sin(b) / b / std::sinh(std::complex<double>(a, b)));
  }
  return modulus;
}

double Mechanisms::quality(const RelaxedShares& shares, double hz) const {
  const auto of = modulus(shares, hz);
  return of.real() / of.imag();
}

double Mechanisms::unrelaxed_speed(double q, double hz) const {
  const double known_hz = speed_known_at(hz);
  const double factor = std::pow(modulus(shares(q), known_hz), -0.5).real();
  return known_hz == hz ? factor : factor * faster_by_constant_quality(q, hz, known_hz);
}

double faster_by_constant_quality(double q, double from_hz, double to_hz) {
  return std::pow(to_hz / from_hz, std::atan(1 / q) / std::numbers::pi);
}

double Mechanisms::largest_error(double q) const {
  const auto of = shares(q);
  double sum = 0;
  for (const double share : of) sum += share;
  if (!(sum < 1) || *std::min_element(of.begin(), of.end()) < 0) return infinite;
  double largest = 0;
  for (int n = 0; n < frequencies; ++n)
    largest = std::max(largest, std::abs(quality(of, frequency(n, low_hz_, high_hz_)) / q - 1));
  return largest;
}

template <int D>
bool attenuates(const Medium<D>& medium, std::size_t cell) {
  const auto [p, s] = qualities(medium, cell);
  return std::isfinite(p) || std::isfinite(s);
}

template <int D>
std::int64_t attenuating_cells(const Medium<D>& medium) {
  if (!medium.has(Property::qp) && !medium.has(Property::qs)) return 0;
  std::int64_t count = 0;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) count += attenuates(medium, cell);
  return count;
}

namespace {

/// Refuses a Q that is not fitted.
template <int D>
void check_fit(const Medium<D>& medium, std::size_t cell, const Mechanisms& mechanisms, Property property,
               double q) {
  if (q >= mechanisms.least_quality()) return;
  throw Error(row_of(property).name + " at " + place_of(medium.grid(), std::int64_t(cell)) + " is " +
              shown(q, 6) + ", too low: " + std::to_string(mechanisms.count()) +
              " mechanisms give Q within " + shown(100 * mechanisms.error_limit(), 2) + " % from " +
              shown(mechanisms.least_quality(), 3) + " up" +
              (mechanisms.count() < most_mechanisms
                   ? "; raise it or use --q-mechanisms " + std::to_string(most_mechanisms)
                   : "; raise it"));
}

}  // namespace

template <int D>
std::string unrelax(Medium<D>& medium, const Attenuation& attenuation) {
  if (attenuating_cells(medium) == 0) return {};
  const auto& mechanisms = attenuation.mechanisms;
  const double reference_hz = attenuation.reference_hz;
  for (const auto property : {Property::qp, Property::qs})
    if (!medium.has(property)) medium[property] = Field<D>(medium.grid(), float(infinite));
  complete_anisotropy(medium);
  LastFound<double, double> factor_p, factor_s;  // by Q
  std::int64_t lowered = 0;
  std::string first;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (!attenuates(medium, cell)) continue;
    const auto given = qualities(medium, cell);
    check_fit(medium, cell, mechanisms, Property::qp, given.p);
    check_fit(medium, cell, mechanisms, Property::qs, given.s);
    const double vp = medium.vp[cell], vs = medium.vs[cell];
    const auto rock = rock_with_axis(medium, cell);
    const double shear = shear_part<D>(vs, rock), most = most_qp(vp, shear, given.s);
    if (std::isfinite(given.p) && given.p > (1 + wanted_error) * most && lowered++ == 0)
      first = "qp at " + place_of(medium.grid(), std::int64_t(cell)) + " is " + shown(given.p, 4) +
              ", more than its qs of " + shown(given.s, 4) + " allows: " + shown(most, 4);
    medium[Property::qp][cell] = float(std::min(given.p, most));
    const auto factor = [&](double q) { return mechanisms.unrelaxed_speed(q, reference_hz); };
    const double faster_s = factor_s(given.s, factor);
    medium.vp[cell] = float(vp * factor_p(std::min(given.p, most), factor));
    medium.vs[cell] = float(vs * faster_s);
    if (!rock) continue;
    if constexpr (D == 3) {
      set_deltas(medium, cell, *rock);
    } else {
      const double of_p = double(medium.vp[cell]), of_s = shear * std::pow(faster_s, 2);
      set_delta(medium, cell, *rock, of_p * of_p - of_s, of_s);
    }
  }
  if (lowered == 0) return {};
  return first + " is used" +
         (lowered > 1 ? ", and as much as qs allows in " + std::to_string(lowered - 1) + " more cells" : "") +
         "; a lower qp or a higher qs of the model (sw-layers --layer, sw-import --qp --qs) is taken as it "
         "is";
}

template <int D>
StepwiseRelaxation<D>::StepwiseRelaxation(const Medium<D>& medium, const Mechanisms& mechanisms,
                                          double interval_s)
    : medium_(&medium), mechanisms_(mechanisms), interval_s_(interval_s) {
  for (int l = 0; l < mechanisms.count(); ++l)
    parts_[std::size_t(l)] = part_relaxed(mechanisms.rate(l) * interval_s / 2);
}

template <int D>
auto StepwiseRelaxation<D>::key_of(std::size_t cell, bool isotropic) const -> Key {
  const auto [qp, qs] = qualities(*medium_, cell);
  return {qp, qs, medium_->vp[cell], medium_->vs[cell],
          isotropic ? std::nullopt : rock_with_axis(*medium_, cell)};
}

/// Returns the shares of a medium that relaxes all the time.
template <int D>
CellShares StepwiseRelaxation<D>::continuous(const Key& of) const {
  CellShares shares{mechanisms_.shares(of.qp), mechanisms_.shares(of.qs)};
  const double p = of.vp * of.vp, s = shear_part<D>(of.vs, of.rock);
  if (of.vs == 0) return shares;
  // Least squares for two Q differ a little in shape: no mechanism may give energy.
  for (std::size_t l = 0; l < shares.bulk.size(); ++l)
    shares.bulk[l] = std::max(0., (p * shares.bulk[l] - s * shares.shear[l]) / (p - s));
  return shares;
}

/// The modulus that is left of an unrelaxed one.
template <int D>
double StepwiseRelaxation<D>::kept(const RelaxedShares& shares) const {
  double kept = 1;
  for (std::size_t l = 0; l < shares.size(); ++l) kept -= shares[l] * (1 - parts_[l]);
  return kept;
}

template <int D>
CellShares StepwiseRelaxation<D>::shares(std::size_t cell, bool isotropic) const {
  return shares(key_of(cell, isotropic));
}

template <int D>
std::function<CellShares(std::size_t, bool)> StepwiseRelaxation<D>::shares_in_turn() const {
  return [this, last = LastFound<Key, CellShares>()](std::size_t cell, bool isotropic) mutable {
    return last(key_of(cell, isotropic), [this](const Key& of) { return shares(of); });
  };
}

template <int D>
CellShares StepwiseRelaxation<D>::shares(const Key& of) const {
  auto shares = continuous(of);
  for (auto* of : {&shares.bulk, &shares.shear}) {
    const double left = kept(*of);
    for (std::size_t l = 0; l < of->size(); ++l) (*of)[l] *= parts_[l] / left;
  }
  return shares;
}

template <int D>
Medium<D> StepwiseRelaxation<D>::medium() const {
  auto medium = *medium_;
  LastFound<Key, CellShares> last;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (!attenuates(medium, cell)) continue;
    const auto shares = last(key_of(cell, false), [this](const Key& of) { return continuous(of); });
    const double vp = medium.vp[cell], vs = medium.vs[cell];
    const auto rock = rock_with_axis(medium, cell);
    const double s = shear_part<D>(vs, rock);
    medium.vp[cell] = float(std::sqrt((vp * vp - s) * kept(shares.bulk) + s * kept(shares.shear)));
    medium.vs[cell] = float(vs * std::sqrt(kept(shares.shear)));
    if (!rock) continue;
    if constexpr (D == 3)
      set_deltas(medium, cell, *rock);
    else
      set_delta(medium, cell, *rock, (vp * vp - s) * kept(shares.bulk), s * kept(shares.shear));
  }
  return medium;
}

template <int D>
double StepwiseRelaxation<D>::decay(int l) const {
  return -std::expm1(-mechanisms_.rate(l) * interval_s_);
}

template <int D>
ComplexStiffness StepwiseRelaxation<D>::stiffness(std::size_t cell, double hz) const {
  const auto of = shares(cell);
  const double vp = medium_->vp[cell], vs = medium_->vs[cell], rho = medium_->rho[cell];
  const auto rock = rock_with_axis(*medium_, cell);
  // In a plane of symmetry (Q9) and (Q11) have the same moduli, from other parts.
  const double s = shear_part<D>(vs, rock), apart = shear_part<2>(vs, rock),
               along = rock ? 1 + 2 * rock->epsilon : 1;
  const auto relaxed_shear = mechanisms_.modulus(of.shear, hz);
  const auto bulk = (vp * vp - s) * mechanisms_.modulus(of.bulk, hz), shear = s * relaxed_shear,
             across = rho * (bulk + shear), of_s = rho * vs * vs * relaxed_shear;
  return {across * along,
          rock ? (across - 2 * rho * apart * relaxed_shear) * std::sqrt(along) : across - 2. * of_s, across,
          of_s};
}

RelaxingAxis relaxing_axis(const Material& rock) {
  const double scale = std::log(1 + 2 * rock.epsilon) / 4, twice = rock.tilt * std::numbers::pi / 90;
  return {std::cosh(scale), -std::sinh(scale), std::cos(twice), std::sin(twice)};
}

LossyWaves lossy_waves(const ComplexStiffness& stiffness, double rho, double angle_rad) {
  const auto& [c11, c13, c33, c55] = stiffness;
  const double along = std::sin(angle_rad), down = std::cos(angle_rad), x = along * along, z = down * down;
  const auto mean = ((c11 + c55) * x + (c33 + c55) * z) / 2., apart = (c11 - c55) * x - (c33 - c55) * z,
             mixed = 2. * (c13 + c55) * along * down;
  auto half = std::sqrt(apart * apart + mixed * mixed) / 2.;
  if (half.real() < 0) half = -half;
  LossyWaves waves;
  const auto add = [&](std::complex<double> modulus, double& speed, double& quality) {
    speed = 1 / (1. / std::sqrt(modulus / rho)).real();
    quality = modulus.imag() > 0 ? modulus.real() / modulus.imag() : infinite;
  };
  add(mean + half, waves.speed.p, waves.quality.p);
  if (c55 != 0.) add(mean - half, waves.speed.s, waves.quality.s);
  return waves;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class StepwiseRelaxation);
SLIPWAVE_INSTANTIATE_D(FUNCTION, attenuates);
SLIPWAVE_INSTANTIATE_D(FUNCTION, attenuating_cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, unrelax);

}  // namespace slipwave
