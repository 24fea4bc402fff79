#include "scene/splitting.hpp"

namespace slipwave {
namespace {

/// Blanes & Moan (2002), table 2, order 4, 6 stages: the parts a of one flow and b of the other, to the
/// middle.
constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195;
constexpr double b1 = 0.209515106613362, b2 = -0.143851773179818;

/// The same as steps of first order, x y z and its mirror image z y x by turns (McLachlan 1995): the first
/// half of them, the other is its mirror image.
std::vector<double> half_of_stages(int time_order) {
  if (time_order == 2) return {0.5};
  constexpr double b3 = 0.5 - (b1 + b2);
  std::vector<double> stages{a1};
  for (const double sum : {b1, a2, b2, a3, b3}) stages.push_back(sum - stages.back());
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
