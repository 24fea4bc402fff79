// SPDX-License-Identifier: BSD-3-Clause
#include "geology/marmousi_strata.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geology/noise.hpp"

namespace slipwave::marmousi {
namespace {

// Clastics above this depth in the pile were never buried deeper than they are.
constexpr double young_m = 1200;

/// How the pile of a unit alternates. Formations are bundles of beds that share a tendency.
struct Alternation {
  double formation_m, bed_m;            // mean thicknesses
  double sand, limestone;               // shares; the rest is shale
  double formation_spread, bed_spread;  // of speeds, relative
};

Alternation alternation_of(Unit unit, double pile_m) {
  switch (unit) {
    case Unit::clastics:
      if (pile_m < young_m) return {230, 58, 0.5, 0, 0.065, 0.035};
      return {210, 57, 0.4, 0.06, 0.065, 0.04};
    case Unit::fill:
      return {190, 62, 0.25, 0.28, 0.065, 0.04};
    case Unit::dome:
      return {190, 75, 0.15, 0.5, 0.05, 0.04};
    case Unit::folded:
    case Unit::evaporites:
      break;
  }
  return {270, 80, 0.25, 0.32, 0.08, 0.06};
}

/// Depth of burial in m that sets the speed: beds keep in part what they had before they were moved.
double burial_of(const Place& place) {
  switch (place.unit) {
    case Unit::clastics:
      return 0.65 * place.pile_m + 0.35 * place.depth_m;
    case Unit::fill:
    case Unit::evaporites:
      return place.depth_m;
    case Unit::dome:
      return 0.5 * (place.pile_m + 2000) + 0.5 * place.depth_m;
    case Unit::folded:
      break;
  }
  return 0.8 * 2300 + 0.2 * place.depth_m;
}

/// P speed by lithology and burial.
double speed_of(Lithology rock, const Place& place) {
  const double burial = std::max(burial_of(place), 0.);
  // Compaction: fast at first, then slowing down.
  const double young = place.unit == Unit::clastics && place.pile_m < young_m ? 0.68 : 1;
  const double shale = 1800 + young * 2300 * (1 - std::exp(-burial / 1900));
  switch (rock) {
    case Lithology::shale:
      return shale;
    case Lithology::sand:
      return 1.07 * shale + 30;
    case Lithology::limestone:
      return 3500 + 0.32 * burial;
    case Lithology::evaporite:
      break;
  }
  return 4500;
}

/// Bed number: boundary k lies near k times the thickness and wanders along x, so beds swell, thin and end;
/// where boundaries cross, the later one cuts off the earlier ones.
std::int64_t number_at(std::uint64_t key, double in_thicknesses, double x_m) {
  constexpr double drawn = 0.35, wandering = 0.3;
  const auto nearest = std::int64_t(std::floor(in_thicknesses));
  for (std::int64_t k = nearest + 1; k >= nearest; --k) {
    const double below = in_thicknesses - double(k);
    if (below < -drawn - wandering) continue;
    if (below >= drawn + wandering) return k;
    if (drawn * uniform(key, k, -1, 1) + wandering * noise(mixed(key, k), x_m / 2200) <= below) return k;
  }
  return nearest - 1;
}

struct Keys {
  std::uint64_t formation = 0, bed = 0;
};

Keys keys_of(std::uint64_t seed, const Section& section, const Place& place, const Alternation& alternation) {
  const std::uint64_t key = mixed(seed, 50 + std::int64_t(place.unit));
  Keys keys;
  keys.formation =
      mixed(key, number_at(mixed(key, 1), place.pile_m / alternation.formation_m, section.x_m()));
  keys.bed = mixed(keys.formation, number_at(mixed(key, 2), place.pile_m / alternation.bed_m, section.x_m()));
  return keys;
}

/// Formations lean towards sand, limestone or shale, beds follow more or less.
Lithology lithology_of(const Keys& keys, const Alternation& alternation) {
  constexpr double common = 0.58, own = 1 - common;
  const double draw = common * uniform(keys.formation, 1) + own * uniform(keys.bed, 1);
  // The distribution of that sum is a trapezium: its share below the draw, from the nearer end.
  const auto low_end = [](double t) { return t < own ? t * t / (2 * common * own) : (t - own / 2) / common; };
  const double below = draw < 0.5 ? low_end(draw) : 1 - low_end(1 - draw);
  if (below < alternation.limestone) return Lithology::limestone;
  if (below > 1 - alternation.sand) return Lithology::sand;
  return Lithology::shale;
}

/// The bed of a trap, where the place is in one; nothing fills it outside its block.
std::optional<Bed> trapped_at(const Section& section, const Place& place, std::uint64_t where) {
  const auto& traps = section.province().traps;
  for (std::size_t i = 0; i < traps.size(); ++i) {
    const auto& trap = traps[i];
    const double away = (section.offset_m() - trap.middle_m) / trap.half_width_m;
    if (trap.unit != place.unit || std::abs(away) >= 1) continue;
    const double in_bed = place.pile_m - trap.pile_m;
    if (in_bed < 0 || in_bed >= trap.thickness_m * (1 - away * away)) continue;
    Bed bed{0, Lithology::sand, Filling::brine, 0.9};
    if (trap.block < 0 || trap.block == place.block) {
      if (place.depth_m < trap.oil_above_m) bed.filling = Filling::oil;
      if (place.depth_m < trap.gas_above_m) bed.filling = Filling::gas;
    }
    bed.body = mixed(where, std::int64_t(1 + 4 * i) + std::int64_t(bed.filling));
    return bed;
  }
  return {};
}

}  // namespace

Bed bed_at(std::uint64_t seed, const Section& section, const Place& place) {
  const std::uint64_t where = mixed(std::uint64_t(place.unit) * 16 + std::uint64_t(place.block), 0);
  if (place.unit == Unit::evaporites) return {where, Lithology::evaporite};
  if (const auto bed = trapped_at(section, place, where)) return *bed;
  if (place.unit == Unit::clastics && section.is_marker(place.pile_m))
    return {mixed(where, -1), Lithology::limestone, Filling::brine, 1.04};
  const auto alternation = alternation_of(place.unit, place.pile_m);
  const auto keys = keys_of(seed, section, place, alternation);
  return {mixed(keys.bed, std::int64_t(where >> 1)),
          lithology_of(keys, alternation),
          Filling::brine,
          1,
          keys.formation,
          keys.bed};
}

Material material_of(const Bed& bed, const Section& section, const Place& place) {
  double speed = bed.speed, density = 1;
  if (bed.bed_key != 0) {
    const auto alternation = alternation_of(place.unit, place.pile_m);
    speed += alternation.formation_spread * bell(bed.formation_key, 2) +
             alternation.bed_spread * bell(bed.bed_key, 2) +
             0.015 * noise(mixed(bed.bed_key, 3), section.x_m() / 2500);
    density += 0.025 * (bell(bed.formation_key, 4) + bell(bed.bed_key, 4));
  }
  auto material = brine_saturated(bed.lithology, speed * speed_of(bed.lithology, place));
  material.rho *= density;
  if (bed.filling == Filling::oil) return with_fluid(material, oil);
  if (bed.filling == Filling::gas) return with_fluid(material, gas);
  return material;
}

}  // namespace slipwave::marmousi
