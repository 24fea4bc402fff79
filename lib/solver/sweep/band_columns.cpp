// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/band_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/instantiate.hpp"

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

/// Taps [narrow column][offset] of the interpolation that (B1) begins with, at offsets as far as any reaches
/// on either side.
std::vector<std::vector<double>> interpolation_taps(int ratio) {
  std::vector<std::vector<double>> all;
  const int points = points_of(ratio), reach = points / 2;
  for (int n = 0; n < ratio; ++n) {
    const double place = (n + 0.5) / ratio - 0.5;
    const auto offsets = offsets_of(points, place);
    auto& taps = all.emplace_back(2 * std::size_t(reach) + 1, 0.);
    for (std::size_t of = 0; of < offsets.size(); ++of)
      taps.begin()[reach + offsets[of]] = lagrange(offsets, of, place);
  }
  return all;
}

/// Taps from offset 0 on of the symmetric filter of wide columns in (B1), one over the root of the mean
/// square of the symbols of these taps, as far as any is above `least`: sums over `samples` wave numbers,
/// which is more than taps reach.
std::vector<double> isometric_taps(const std::vector<std::vector<double>>& interpolation, double least) {
  constexpr int samples = 512;
  std::vector<double> taps(samples / 2, 0.);
  for (int k = 0; k < samples; ++k) {
    const double theta = 2 * std::numbers::pi * k / samples;
    double squares = 0;
    for (const auto& of : interpolation) {
      double real = 0, imaginary = 0;
      for (std::size_t n = 0; n < of.size(); ++n)
        real += of[n] * std::cos(theta * double(n)), imaginary += of[n] * std::sin(theta * double(n));
      squares += (real * real + imaginary * imaginary) / double(interpolation.size());
    }
    for (std::size_t at = 0; at < taps.size(); ++at)
      taps[at] += std::cos(theta * double(at)) / (std::sqrt(squares) * samples);
  }
  while (std::abs(taps.back()) <= least) taps.pop_back();
  return taps;
}

/// Values that are summed at a time: they stay in the first cache.
constexpr std::size_t summed_at_once = 1024;

}  // namespace

template <class Real>
BandColumns<Real>::BandColumns(int ratio, std::int64_t wide) : ratio_(ratio), wide_(wide) {
  const auto interpolation = interpolation_taps(ratio);
  for (const auto& taps : interpolation) interpolation_.emplace_back(taps.begin(), taps.end());
  // What rounding hides is left out.
  const auto taps = isometric_taps(interpolation, std::numeric_limits<Real>::epsilon());
  isometry_.assign(taps.begin(), taps.end());
  reach_ = std::max(std::ssize(isometry_) - 1, std::ssize(interpolation_.front()) / 2);
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
  sum_isometry();
  std::copy(sums_.begin(), sums_.end(), part(0));
  extend(1, images);
  for (int n = 0; n < ratio_; ++n) {
    sum([&](std::size_t first, std::size_t last) {
      const auto& taps = interpolation_[std::size_t(n)];
      const auto middle = std::ssize(taps) / 2;
      for (auto o = -middle; o <= middle; ++o)
        add(taps[std::size_t(o + middle)], part(0) + o * lanes, first, last);
    });
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
  sum([&](std::size_t first, std::size_t last) {
    for (int n = 0; n < ratio_; ++n) {
      const auto& taps = interpolation_[std::size_t(n)];
      const auto middle = std::ssize(taps) / 2;
      for (auto o = -middle; o <= middle; ++o)
        add(taps[std::size_t(o + middle)] / Real(ratio_), part(n) - o * lanes, first, last);
    }
  });
  std::copy(sums_.begin(), sums_.end(), part(0));
  extend(1, images);
  sum_isometry();
  for (std::int64_t i = 0; i < wide_; ++i) std::copy_n(sums_.data() + i * lanes, lanes, to + i * stride_to);
}

/// Fills sums_: `add_all` adds to the range that it is given.
template <class Real>
template <class Add>
void BandColumns<Real>::sum(Add&& add_all) {
  for (std::size_t first = 0; first < sums_.size(); first += summed_at_once) {
    const auto last = std::min(first + summed_at_once, sums_.size());
    std::fill(sums_.begin() + std::ptrdiff_t(first), sums_.begin() + std::ptrdiff_t(last), Real(0));
    add_all(first, last);
  }
}

template <class Real>
void BandColumns<Real>::sum_isometry() {
  sum([&](std::size_t first, std::size_t last) {
    add(isometry_[0], part(0), first, last);
    for (std::int64_t o = 1; o < std::ssize(isometry_); ++o) {
      const Real *const one = part(0) - o * lanes_, *const other = part(0) + o * lanes_;
      const Real tap = isometry_[std::size_t(o)];
      for (auto n = first; n < last; ++n) sums_[n] += tap * (one[n] + other[n]);
    }
  });
}

template <class Real>
void BandColumns<Real>::add(Real tap, const Real* beside, std::size_t first, std::size_t last) {
  if (tap == 0) return;
  for (auto n = first; n < last; ++n) sums_[n] += tap * beside[n];
}

SLIPWAVE_INSTANTIATE_REAL(TYPE, class BandColumns);

}  // namespace slipwave::solver
