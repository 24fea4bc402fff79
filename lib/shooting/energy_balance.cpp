// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/energy_balance.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {
namespace {

std::string percent(double share) { return shown(100 * share, 3) + " %"; }

std::string slipped(const ShotReport& report) {
  if (!report.slip) return "no slip";
  const auto& slip = *report.slip;
  return std::to_string(slip.slipped) + " of " + std::to_string(slip.cells) + " fractured cells slipped (" +
         percent(double(slip.slipped) / double(slip.cells)) + ")";
}

}  // namespace

std::string sentence_of(const ShotReport& report, int dimension) {
  const auto joules = [dimension](double energy) {
    return shown(energy, 3) + (dimension == 2 ? " J/m" : " J");
  };
  const SlipTotals slip = report.slip.value_or(SlipTotals());
  // Only the prestress makes heat that does not come from the waves.
  const double of_static = slip.dissipated - slip.out_of_waves;
  std::string heat;
  if (std::abs(of_static) > 1e-6 * std::abs(slip.dissipated))
    heat = " (to which the prestress adds " + joules(of_static) + ")";
  if (!report.source_work || !(*report.source_work > 0))
    return slipped(report) + "; slip took " + joules(slip.out_of_waves) + " from the waves" + heat + ", " +
           joules(report.energy_left) + " remain in the model";
  const double work = *report.source_work;
  const double gone = work - slip.out_of_waves - report.energy_left;
  return slipped(report) + "; of " + joules(work) + " of source work slip took " +
         percent(slip.out_of_waves / work) + heat + ", " + percent(report.energy_left / work) +
         " remain in the model, " + percent(gone / work) +
         " left through the boundaries or were dissipated numerically, mostly near the source";
}

}  // namespace slipwave
