// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/band_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
      for (int o = -samples / 2; o < samples / 2; ++o)
        all[std::size_t(n)][std::size_t(o + samples / 2)] +=
            (symbols[std::size_t(n)][0] * std::cos(theta * o) +
             symbols[std::size_t(n)][1] * std::sin(theta * o)) /
            (std::sqrt(squares) * samples);
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
  parts_.resize(std::size_t(ratio * (wide + 2 * reach_)));
  sums_.resize(std::size_t(wide));
}

/// Fills the columns beyond both ends. The image of part n of a narrow row is its part ratio - 1 - n.
template <class Real>
void BandColumns<Real>::extend(int parts, const Images& images) {
  for (std::int64_t n = 1; n <= reach_; ++n)
    for (int of = 0; of < parts; ++of) {
      // Where there are fewer columns than are reached, these are images of images.
      part(of)[-n] = images[0] * part(parts - 1 - of)[n - 1];
      part(of)[wide_ - 1 + n] = images[1] * part(parts - 1 - of)[wide_ - n];
    }
}

template <class Real>
void BandColumns<Real>::to_narrow(const Real* from, std::int64_t stride_from, Real* to,
                                  std::int64_t stride_to, std::int64_t lanes, const Images& images) {
  for (std::int64_t lane = 0; lane < lanes; ++lane) {
    for (std::int64_t i = 0; i < wide_; ++i) part(0)[i] = from[i * stride_from + lane];
    extend(1, images);
    for (int n = 0; n < ratio_; ++n) {
      std::fill(sums_.begin(), sums_.end(), Real(0));
      for (std::int64_t o = -reach_; o <= reach_; ++o) {
        const Real tap = taps_[std::size_t(n)][std::size_t(o + reach_)];
        const Real* const beside = part(0) + o;
        for (std::int64_t i = 0; i < wide_; ++i) sums_[std::size_t(i)] += tap * beside[i];
      }
      for (std::int64_t i = 0; i < wide_; ++i)
        to[(i * ratio_ + n) * stride_to + lane] = sums_[std::size_t(i)];
    }
  }
}

template <class Real>
void BandColumns<Real>::to_wide(const Real* from, std::int64_t stride_from, Real* to, std::int64_t stride_to,
                                std::int64_t lanes, const Images& images) {
  for (std::int64_t lane = 0; lane < lanes; ++lane) {
    for (int n = 0; n < ratio_; ++n)
      for (std::int64_t i = 0; i < wide_; ++i) part(n)[i] = from[(i * ratio_ + n) * stride_from + lane];
    extend(ratio_, images);
    std::fill(sums_.begin(), sums_.end(), Real(0));
    for (int n = 0; n < ratio_; ++n)
      for (std::int64_t o = -reach_; o <= reach_; ++o) {
        const Real tap = taps_[std::size_t(n)][std::size_t(o + reach_)] / Real(ratio_);
        const Real* const beside = part(n) - o;
        for (std::int64_t i = 0; i < wide_; ++i) sums_[std::size_t(i)] += tap * beside[i];
      }
    for (std::int64_t i = 0; i < wide_; ++i) to[i * stride_to + lane] = sums_[std::size_t(i)];
  }
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

template class BandColumns<float>;
template class BandColumns<double>;
template int image_sign<2>(EdgeLaw, int, int);
template int image_sign<3>(EdgeLaw, int, int);

}  // namespace slipwave::solver
