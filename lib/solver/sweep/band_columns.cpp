// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/band_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/instantiate.hpp"
#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {
namespace {

/// Points of the Lagrange interpolation that (B1) begins with: it leaves reflections of 1e-8 at 12 cells a
/// wavelength, where more points change nothing (docs/theory/bands.md).
int points_of(int ratio) { return ratio % 2 ? 5 : 6; }

/// Offsets of the points round the centre of a narrow column at `place`, in wide columns.
std::vector<int> offsets_of(int points, double place) {
  const int first = points % 2 ? -(points / 2) : int(std::floor(place)) - points / 2 + 1;
  std::vector<int> offsets;
  for (int n = 0; n < points; ++n) offsets.push_back(first + n);
  return offsets;
}

double lagrange(const std::vector<int>& offsets, std::size_t of, double place) {
  double weight = 1;
  for (std::size_t n = 0; n < offsets.size(); ++n)
    if (n != of) weight *= (place - offsets[n]) / double(offsets[of] - offsets[n]);
  return weight;
}

/// Taps [narrow column][offset] of (B1), as far as any is above `least`: the symbols of the interpolation
/// over the root of their mean square, back in columns by sums over `samples` wave numbers, which is more
/// than taps reach.
std::vector<std::vector<double>> isometric_taps(int ratio, double least) {
  constexpr int samples = 512;
  const int points = points_of(ratio);
  std::vector<std::vector<double>> all(std::size_t(ratio), std::vector<double>(samples, 0));
  for (int k = 0; k < samples; ++k) {
    const double theta = 2 * std::numbers::pi * k / samples;
    std::vector<std::array<double, 2>> symbols;
    double squares = 0;
    for (int n = 0; n < ratio; ++n) {
      const double place = (n + 0.5) / ratio - 0.5;
      const auto offsets = offsets_of(points, place);
      std::array<double, 2> sum{};
      for (std::size_t of = 0; of < offsets.size(); ++of) {
        const double weight = lagrange(offsets, of, place);
        sum[0] += weight * std::cos(theta * offsets[of]), sum[1] += weight * std::sin(theta * offsets[of]);
      }
      symbols.push_back(sum);
      squares += (sum[0] * sum[0] + sum[1] * sum[1]) / ratio;
    }
    for (int n = 0; n < ratio; ++n)
      for (std::size_t at = 0; at < samples; ++at) {
        const double turn = theta * (double(at) - samples / 2.);
        all[std::size_t(n)][at] +=
            (symbols[std::size_t(n)][0] * std::cos(turn) + symbols[std::size_t(n)][1] * std::sin(turn)) /
            (std::sqrt(squares) * samples);
      }
  }
  std::size_t reach = 0;
  for (const auto& taps : all)
    for (std::size_t n = 0; n < taps.size(); ++n)
      if (std::abs(taps[n]) > least)
        reach = std::max(reach, n > samples / 2 ? n - samples / 2 : samples / 2 - n);
  for (auto& taps : all)
    taps = {taps.begin() + std::ptrdiff_t(samples / 2 - reach),
            taps.begin() + std::ptrdiff_t(samples / 2 + reach + 1)};
  return all;
}

}  // namespace

template <class Real>
BandColumns<Real>::BandColumns(int ratio, std::int64_t wide) : ratio_(ratio), wide_(wide) {
  // What rounding hides is left out.
  for (const auto& taps : isometric_taps(ratio, std::numeric_limits<Real>::epsilon()))
    taps_.emplace_back(taps.begin(), taps.end());
  reach_ = std::int64_t(taps_.front().size()) / 2;
}

/// Room for rows of so many lanes, each column of all lanes after the other.
template <class Real>
void BandColumns<Real>::make_room(int parts, std::int64_t lanes) {
  lanes_ = lanes;
  parts_.resize(std::size_t(parts * (wide_ + 2 * reach_) * lanes));
  sums_.resize(std::size_t(wide_ * lanes));
}

/// Fills the columns beyond both ends. The image of part n of a narrow row is its part ratio - 1 - n.
template <class Real>
void BandColumns<Real>::extend(int parts, const Images& images) {
  for (std::int64_t n = 1; n <= reach_; ++n)
    for (int of = 0; of < parts; ++of)
      for (std::int64_t lane = 0; lane < lanes_; ++lane) {
        // Where there are fewer columns than are reached, these are images of images.
        const Real* const image = part(parts - 1 - of) + lane;
        part(of)[-n * lanes_ + lane] = images[0] * image[(n - 1) * lanes_];
        part(of)[(wide_ - 1 + n) * lanes_ + lane] = images[1] * image[(wide_ - n) * lanes_];
      }
}

template <class Real>
void BandColumns<Real>::to_narrow(const Real* from, std::int64_t stride_from, Real* to,
                                  std::int64_t stride_to, std::int64_t lanes, const Images& images) {
  make_room(1, lanes);
  for (std::int64_t i = 0; i < wide_; ++i) std::copy_n(from + i * stride_from, lanes, part(0) + i * lanes);
  extend(1, images);
  for (int n = 0; n < ratio_; ++n) {
    std::fill(sums_.begin(), sums_.end(), Real(0));
    for (std::int64_t o = -reach_; o <= reach_; ++o)
      add(taps_[std::size_t(n)][std::size_t(o + reach_)], part(0) + o * lanes);
    for (std::int64_t i = 0; i < wide_; ++i)
      std::copy_n(sums_.data() + i * lanes, lanes, to + (i * ratio_ + n) * stride_to);
  }
}

template <class Real>
void BandColumns<Real>::to_wide(const Real* from, std::int64_t stride_from, Real* to, std::int64_t stride_to,
                                std::int64_t lanes, const Images& images) {
  make_room(ratio_, lanes);
  for (int n = 0; n < ratio_; ++n)
    for (std::int64_t i = 0; i < wide_; ++i)
      std::copy_n(from + (i * ratio_ + n) * stride_from, lanes, part(n) + i * lanes);
  extend(ratio_, images);
  std::fill(sums_.begin(), sums_.end(), Real(0));
  for (int n = 0; n < ratio_; ++n)
    for (std::int64_t o = -reach_; o <= reach_; ++o)
      add(taps_[std::size_t(n)][std::size_t(o + reach_)] / Real(ratio_), part(n) - o * lanes);
  for (std::int64_t i = 0; i < wide_; ++i) std::copy_n(sums_.data() + i * lanes, lanes, to + i * stride_to);
}

template <class Real>
void BandColumns<Real>::add(Real tap, const Real* beside) {
  for (std::size_t n = 0; n < sums_.size(); ++n) sums_[n] += tap * beside[n];
}

template <int D>
int image_sign(EdgeLaw law, int axis, int field_row) {
  using Rows = FieldRows<D>;
  const auto sign = [law](Wave wave, bool velocity) {
    const auto extension = extension_of(law, wave);
    return extension == (velocity ? Extension::motionless : Extension::traction_free) ? -1 : 1;
  };
  if (field_row < D) return sign(field_row == axis ? wave_p : wave_s, true);
  if (field_row == Rows::normal_stress(axis)) return sign(wave_p, false);
  for (int other = 0; other < D; ++other)
    if (other != axis && field_row == Rows::shear_stress(std::min(axis, other), std::max(axis, other)))
      return sign(wave_s, false);
  return 1;
}

SLIPWAVE_INSTANTIATE_REAL(TYPE, class BandColumns);
SLIPWAVE_INSTANTIATE_D(FUNCTION, image_sign);

}  // namespace slipwave::solver
