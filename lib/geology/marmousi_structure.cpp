// SPDX-License-Identifier: BSD-3-Clause
#include "geology/marmousi_structure.hpp"

#include <algorithm>
#include <cmath>

#include "geology/noise.hpp"

namespace slipwave::marmousi {
namespace {

/// The random curves of a seed.
enum Curve : std::int64_t { base = 10, unconformity, salt, ripple, drape, marker = 20 };

/// Height of a fold's limbs against its crest: hyperbolas.
double limb_of(const Province& province, double x_m) {
  const double offset = province.offset_of(x_m) - province.fold_crest_m;
  const double slope = offset < 0 ? province.fold_slope_left : province.fold_slope_right;
  return slope * (province.fold_width_m - std::hypot(offset, province.fold_width_m));
}

/// Anticlines meet in synclines rounded over some 150 m. Those further away than the next ones lie too deep
/// to matter.
double fold_of(const std::array<Province, 3>& neighbours, double x_m) {
  constexpr double round_m = 150;
  std::array<double, 3> heights{};
  for (std::size_t k = 0; k < 3; ++k) heights[k] = limb_of(neighbours[k], x_m);
  const double highest = *std::max_element(heights.begin(), heights.end());
  double sum = 0;
  for (const double height : heights) sum += std::exp((height - highest) / round_m);
  return highest + round_m * std::log(sum);
}

double dome_of(const Province& province, double offset_m) {
  const double from_crest = offset_m - province.dome_crest_m;
  return province.dome_m * (from_crest < 0 ? smooth_step(-province.dome_left_m, 0, from_crest)
                                           : smooth_step(province.dome_right_m, 0, from_crest));
}

/// Thickness of the lenses to the left and to the right of the dome; they end before the next province.
double evaporite_of(std::uint64_t seed, const Province& province, double x_m) {
  const double offset = province.offset_of(x_m), away = std::abs(offset);
  const double inner = offset < 0 ? province.evaporite_left_m * (0.3 * smooth_step(-900, -2500, offset) +
                                                                 0.7 * smooth_step(-2800, -5600, offset))
                                  : province.evaporite_right_m * smooth_step(500, 3800, offset);
  return inner * smooth_step(7600, 5800, away) * (1 + 0.3 * noise(mixed(seed, salt), x_m / 1500));
}

}  // namespace

Section::Section(std::uint64_t seed, double x_m) : x_m_(x_m) {
  const std::int64_t number = province_at(seed, x_m);
  const std::array<Province, 3> neighbours{province_of(seed, number - 1), province_of(seed, number),
                                           province_of(seed, number + 1)};
  province_ = neighbours[1];
  offset_m_ = province_.offset_of(x_m);
  rise_m_ = province_.rise_at(offset_m_);
  undulation_m_ = undulation_of(seed, x_m);
  dome_m_ = dome_of(province_, offset_m_);
  evaporite_m_ = evaporite_of(seed, province_, x_m);
  fold_m_ = fold_of(neighbours, x_m) + 30 * noise(mixed(seed, ripple), x_m / 700);
  drape_m_ = 45 * noise(mixed(seed, drape), x_m / 2600);
  constexpr std::array<Marker, 2> flat{Marker{1385, 1425}, Marker{1585, 1690}};
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const std::uint64_t key = mixed(seed, marker + std::int64_t(i));
    markers_[i].top_m = flat[i].top_m + 20 * noise(key, x_m / 2500);
    const double thickness =
        (flat[i].bottom_m - flat[i].top_m) * (1 + 0.4 * noise(mixed(key, 1), x_m / 3000));
    markers_[i].bottom_m = markers_[i].top_m + thickness;
  }
  const double right = smooth_step(600, 4500, offset_m_) * smooth_step(7900, 5500, offset_m_);
  unconformity_m_ = 2560 - 320 * right + 60 * noise(mixed(seed, unconformity), x_m / 5000);
  top_of_dome_m_ = unconformity_m_ - dome_m_;
  base_of_clastics_m_ = 1730 - 0.12 * dome_m_ + 50 * noise(mixed(seed, base), x_m / 3000);
}

bool Section::is_marker(double pile_m) const {
  return std::any_of(markers_.begin(), markers_.end(), [&](const Marker& marker) {
    return pile_m >= marker.top_m && pile_m < marker.bottom_m;
  });
}

Place Section::at(double depth_m) const {
  if (depth_m < base_of_clastics_m_) {
    int block = 0;
    const double pile = province_.pile_of_clastics(offset_m_, depth_m, rise_m_ + undulation_m_, block);
    return {Unit::clastics, depth_m, pile, block};
  }
  if (depth_m >= unconformity_m_) return {Unit::folded, depth_m, depth_m + fold_m_, 0};
  if (depth_m >= unconformity_m_ - evaporite_m_) return {Unit::evaporites, depth_m, depth_m, 0};
  if (depth_m >= top_of_dome_m_) return {Unit::dome, depth_m, depth_m - top_of_dome_m_, 0};
  return {Unit::fill, depth_m, depth_m + 0.4 * dome_m_ + drape_m_, 0};
}

}  // namespace slipwave::marmousi
