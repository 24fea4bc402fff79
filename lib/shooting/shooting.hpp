// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "base/messages.hpp"
#include "parallel/ranks.hpp"
#include "shooting/output_options.hpp"
#include "shooting/provenance.hpp"
#include "shooting/scene_options.hpp"

namespace slipwave {

/// The settings of sw-shoot.
struct ShootingOptions {
  SceneOptions scene;
  OutputOptions output;
  std::optional<double> snapshot_every_s;
  std::optional<double> wanted_error;  // choose the numerics for it
  std::string error_of = "traces";     // what it is of, or "response"
  std::optional<double> budget_s;      // of processor time, for the search of wanted_error
  std::string error_gather;            // where the error of each trace goes; empty: nowhere
  bool measure = false;                // the error of the scene as it is
  bool plan = false;                   // print what would be computed, to output.traces
  bool json = false;                   // of the plan or of what was measured, all of it
  bool details = false;                // all of the plan
  bool balance = false;                // say where the energy went
};

/// Reads the model, simulates all shots of the survey and writes what they recorded; or prints the plan.
/// Throws an Error naming the option, the file or the shot.
void shoot_survey(const ShootingOptions& options, const Provenance& provenance, const Messages& messages);

/// Collective: the same by several processes, each of which reads its part of the model. A CollectiveError is
/// thrown on all; where a shot becomes unstable the first throws the Error and the others EndedElsewhere; any
/// other Error is thrown by one of them alone.
void shoot_survey_on_ranks(const ShootingOptions& options, const Provenance& provenance,
                           const Messages& messages, Ranks& ranks);

}  // namespace slipwave
