// SPDX-License-Identifier: BSD-3-Clause
#include "geology/marmousi_province.hpp"

#include <algorithm>
#include <cmath>

#include "geology/noise.hpp"

namespace slipwave::marmousi {
namespace {

constexpr double spacing_m = 16000;      // of provinces
constexpr double grown_by_m = 1500;      // movements are older than nothing that lies deeper
constexpr double grown_at_floor = 0.45;  // their share that is younger than the rocks of the sea floor

/// Random numbers of one province, in the order of drawing.
class Draws {
 public:
  explicit Draws(std::uint64_t key) : key_(key) {}
  double operator()(double low, double high) { return uniform(key_, next_++, low, high); }

 private:
  std::uint64_t key_;
  std::int64_t next_ = 0;
};

double centre_of(std::uint64_t seed, std::int64_t number) {
  return (double(number) + 0.39) * spacing_m + uniform(mixed(seed, 1), number, -500, 500);
}

double grown(double depth_m) {
  return grown_at_floor + (1 - grown_at_floor) * std::clamp(depth_m / grown_by_m, 0., 1.);
}

/// 0 up to low, then bending smoothly into the line x - (low + high)/2: the integral of smooth_step.
double bend(double low, double high, double x) {
  if (x >= high) return x - (low + high) / 2;
  const double t = std::max((x - low) / (high - low), 0.);
  return (high - low) * t * t * t * (1 - t / 2);
}

void draw_rise(Province& province, Draws& draw) {
  province.dome_m = draw(560, 720);
  province.dome_crest_m = draw(-800, -300);
  province.dome_left_m = draw(2300, 3000);
  province.dome_right_m = draw(1300, 1900);
  province.fold_slope_left = draw(0.5, 0.7);
  province.fold_slope_right = draw(0.35, 0.55);
  province.fold_width_m = draw(700, 1300);
  province.fold_crest_m = draw(-100, 500);
  province.evaporite_left_m = draw(180, 300);
  province.evaporite_right_m = draw(220, 330);
}

void draw_faults(Province& province, Draws& draw) {
  const int count = draw(0, 1) < 0.7 ? 3 : 4;
  double at = draw(-2100, -1700);
  for (int i = 0; i < count; ++i) {
    // The last one is the steepest at the sea floor, and throws most.
    const bool last = i == count - 1;
    const double cotangent = last ? draw(0.25, 0.4) : draw(0.6, 0.9);
    province.faults.push_back({at, cotangent, last ? draw(4.5e-4, 6e-4) : draw(2e-4, 4e-4),
                               (last ? draw(650, 850) : draw(430, 600)) * 3 / count});
    at += (i == count - 2 ? draw(1150, 1450) : draw(480, 700)) * (count == 3 ? 1 : 0.8);
  }
  for (int i = 0; i < 7; ++i) {
    const double middle = draw(-5000, 5000), depth = draw(400, 1500);
    const int hanging = draw(0, 1) < 0.5 ? -1 : 1;
    province.small_faults.push_back(
        {middle, depth, hanging * draw(0.3, 0.8), hanging * draw(15, 55), draw(250, 600)});
  }
}

/// Gas and oil in the highest corner of a block, under the fault to its right.
void draw_fault_trap(Province& province, Draws& draw, std::uint64_t seed, int block, double depth_m) {
  const double depth = depth_m + draw(-100, 100);
  const double offset = province.faults[std::size_t(block)].position(depth) - 1;
  const double lift = province.rise_at(offset) + undulation_of(seed, province.x_of(offset));
  int found = 0;
  const double pile = province.pile_of_clastics(offset, depth, lift, found);
  const double gas = draw(100, 190);
  province.traps.push_back({Unit::clastics, pile, draw(35, 60), offset - 500, 2500, block, depth + gas,
                            depth + gas + draw(40, 90)});
}

void draw_traps(Province& province, Draws& draw, std::uint64_t seed) {
  const int last = int(province.faults.size()) - 1;
  draw_fault_trap(province, draw, seed, last, 650);
  draw_fault_trap(province, draw, seed, 0, 800);
  // A lens of sand far from the faults, full of gas.
  province.traps.push_back(
      {Unit::clastics, draw(450, 1000), draw(30, 50), draw(-5500, -3600), draw(250, 500), -1, 3000, 3000});
  // Oil in the crest of the dome.
  province.traps.push_back({Unit::dome, draw(60, 110), draw(45, 70), province.dome_crest_m, 1800, -1, 0,
                            2560 - province.dome_m + draw(150, 200)});
}

}  // namespace

double undulation_of(std::uint64_t seed, double x_m) {
  return 150 * noise(mixed(seed, 3), x_m / 4200) + 25 * noise(mixed(seed, 4), x_m / 1100);
}

double Province::rise_at(double offset_m) const {
  double throws = 0;
  for (const auto& fault : faults) throws += fault.throw_m;
  const double inner = -2150, outer = 1000;  // midway through either bend
  return throws * (bend(-4300, 0, offset_m) - bend(500, 1500, offset_m)) / (outer - inner);
}

double Province::pile_of_clastics(double offset_m, double depth_m, double lift_m, int& block) const {
  double moved = lift_m, shifted = 0;
  block = 0;
  for (const auto& fault : faults) {
    if (offset_m <= fault.position(depth_m)) break;
    moved -= fault.throw_m;
    ++block;
  }
  for (const auto& fault : small_faults) {
    const double above = (depth_m - fault.depth_m) / fault.reach_m;
    const double beyond = offset_m - fault.middle_m - fault.cotangent * (depth_m - fault.depth_m);
    if (std::abs(above) >= 1 || beyond < 0) continue;
    shifted -= fault.throw_m * (1 - above * above) * (1 - above * above) * smooth_step(2000, 0, beyond);
  }
  return depth_m + grown(depth_m) * moved + shifted;
}

std::int64_t province_at(std::uint64_t seed, double x_m) {
  const auto guess = std::int64_t(std::floor(x_m / spacing_m));
  std::int64_t best = guess - 1;
  for (std::int64_t number = guess; number <= guess + 1; ++number) {
    if (std::abs(x_m - centre_of(seed, number)) < std::abs(x_m - centre_of(seed, best))) best = number;
  }
  return best;
}

Province province_of(std::uint64_t seed, std::int64_t number) {
  Draws draw(mixed(mixed(seed, 2), number));
  Province province;
  province.centre_m = centre_of(seed, number);
  province.side = draw(0, 1) < 0.7 ? 1 : -1;
  draw_rise(province, draw);
  draw_faults(province, draw);
  draw_traps(province, draw, seed);
  return province;
}

}  // namespace slipwave::marmousi
