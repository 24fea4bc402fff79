// SPDX-License-Identifier: BSD-3-Clause
#include "scene/splitting.hpp"

namespace slipwave {
namespace {

/// Theory.md (E18): the parts a of one flow and b of the other, to the middle.
constexpr double a1 = 0.2316, a2 = -0.067498409365708231;
constexpr double b1 = -0.1312, b2 = 0.45306344962548994;

/// Returns the parts of (E18) as steps of first order, x y z and its mirror image z y x by turns (McLachlan
/// 1995): the first half of them, the other is its mirror image.
std::vector<double> half_of_stages(int time_order) {
  if (time_order == 2) return {0.5};
  constexpr double a3 = 0.5 - (a1 + a2);
  std::vector<double> stages{a1};
  for (const double sum : {b1, a2, b2, a3}) stages.push_back(sum - stages.back());
  return stages;
}

}  // namespace

std::vector<SweepFraction> splitting(int dimension, int time_order) {
  auto stages = half_of_stages(time_order);
  for (auto n = stages.size(); n > 0; --n) stages.push_back(stages[n - 1]);
  std::vector<SweepFraction> sweeps;
  for (std::size_t n = 0; n < stages.size(); ++n)
    for (int turn = 0; turn < dimension; ++turn) {
      const int axis = n % 2 == 0 ? turn : dimension - 1 - turn;
      if (!sweeps.empty() && sweeps.back().axis == axis)
        sweeps.back().fraction += stages[n];
      else
        sweeps.push_back({axis, stages[n]});
    }
  return sweeps;
}

}  // namespace slipwave
