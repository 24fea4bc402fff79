// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "lab.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

/// What fills a cell of a scene, numbered from its first one.
using Filling = std::function<Rock(std::int64_t i, std::int64_t k)>;
constexpr Rock nothing{0, 0, 0};

/// A draw of numbers; `seed` alone decides them.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.; }
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + std::int64_t(engine_() % std::uint32_t(high - low + 1));
  }
  /// A rock whose S waves have `cells` cells of 1 m in the wavelength of 100 Hz.
  Rock rock(double cells);

 private:
  std::mt19937 engine_;
};

/// Seeds of a relation: a few in the short form, more where SLIPWAVE_LONG is set.
std::vector<unsigned> seeds(unsigned in_short_form = 2, unsigned in_long_form = 20);

/// A scene in double precision, Ricker wavelet of 100 Hz, all edges absorbing, vz and vx. Where cells are not
/// of 1 m, all times are as many times as long as the cells are large.
Scene<2> scene_of(std::int64_t nx, std::int64_t nz, const Filling& filling, double duration_s = 0.06,
                  double spacing_m = 1);
/// One force or explosion, and receivers, in cells from the origin.
void shoot_from(Scene<2>& scene, const Point<2>& source, const std::string& mechanism,
                std::vector<Point<2>> receivers);
/// All traces of the shot, one after the other.
std::vector<double> traces_of(const Scene<2>& scene);
/// Relative L2 difference.
double difference(const std::vector<double>& found, const std::vector<double>& wanted);

/// What is left of rounding in double precision after some hundred steps.
constexpr double rounding = 1e-9;

}  // namespace slipwave::solver
