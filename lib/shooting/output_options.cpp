// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/output_options.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "output/snapshot_netcdf.hpp"
#include "parallel/threads.hpp"
#include "planning/plan.hpp"
#include "segy/writer.hpp"
#include "segy/writer_headers.hpp"
#include "shooting/output_names.hpp"
#include "shooting/shot_snapshots.hpp"
#include "solver/simulation.hpp"

namespace slipwave {
namespace {

/// What shots that are simulated at once may take of memory together.
constexpr std::int64_t most_together_bytes = std::int64_t(1) << 30;

SampleAxis axis_of(const Recording& recording) {
  return {recording.samples() - recording.samples_before(), recording.interval_s, 0};
}

}  // namespace

segy::FileFormat OutputOptions::trace_format(const Recording& recording) const {
  segy::FileFormat format;
  if (revision != "auto")
    format.revision = std::stoi(revision);
  else if (segy::needs_revision_2(axis_of(recording)))
    format.revision = 2;
  return format;
}

/// What the trace files cannot hold is refused before anything is computed.
void OutputOptions::check_sampling(const Recording& recording,
                                   const std::function<void(const std::string&)>& warn) const {
  segy::FileInfo info;
  info.format = segy::format_named_by(traces, trace_format(recording));
  info.axis = axis_of(recording);
  if (info.format.su && revision != "auto")
    throw Error("found --revision " + revision + " and -o " + traces +
                    ", expected one of them: Seismic Unix has no revision",
                ErrorKind::usage);
  try {
    segy::checked_format(info);
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + " (--time " +
                    shown(recording.duration_s - recording.before_s, 9) + ", --dt " +
                    shown(recording.interval_s) + "; " +
                    (info.format.su ? "name the output .sgy" : "--revision 2, or a longer --dt") + ")",
                ErrorKind::usage);
  }
  if (revision == "auto" && info.format.revision == 2)
    warn(
        "traces are written in SEG-Y revision 2: revision 1 holds up to 65535 samples at whole microseconds; "
        "--revision 1 with another --dt or --time keeps to it");
  for (const auto& sentence : segy::warnings_of(info)) warn(sentence);
}

bool OutputOptions::wants_slip() const {
  const auto names = split(snapshot_fields, ',');
  return std::any_of(names.begin(), names.end(), [](const auto& name) {
    const auto& known = slipwave::snapshot_fields<2>();
    return std::any_of(known.begin(), known.end(), [&](const auto& field) {
      return field.name == name && std::holds_alternative<SlipField>(field.content);
    });
  });
}

template <int D>
void OutputOptions::check(std::size_t shots) const {
  check_names<D>(shots);
  check_checkpoint();
  check_parallel();
}

template <int D>
void OutputOptions::check_names(std::size_t shots) const {
  check_marks(traces);
  check_marks(snapshots);
  if (!snapshots.empty()) in_place("--fields", [&] { return parse_snapshot_fields<D>(snapshot_fields); });
  if (!slice.empty() && D == 2)
    throw Error("found --slice with a model in 2-D, expected one in 3-D", ErrorKind::usage);
  if (first_shot < 1)
    throw Error("--first-shot: found " + std::to_string(first_shot) + ", expected 1 or more",
                ErrorKind::usage);
  if (first_shot != 1 && !shot_labels.empty())
    throw Error("found --first-shot " + std::to_string(first_shot) +
                    " and a survey that numbers its shots, expected one of them",
                ErrorKind::usage);
  if (!snapshots.empty() && shots > 1 && !holds(snapshots, "{shot}"))
    throw Error("found " + std::to_string(shots) + " sources and --snapshots " + snapshots +
                    ", expected {shot} in the name",
                ErrorKind::usage);
  if (!snapshots.empty() && holds(snapshots, "{component}"))
    throw Error(
        "{component} is for traces, found it in --snapshots " + snapshots + "; choose fields with --fields",
        ErrorKind::usage);
}

void OutputOptions::check_checkpoint() const {
  if (checkpoint_every_s && !(*checkpoint_every_s > 0))
    throw Error("--checkpoint-every: found " + shown(*checkpoint_every_s) + ", expected it above 0",
                ErrorKind::usage);
  if (checkpoint == "-") throw Error("--checkpoint: found -, expected the name of a file", ErrorKind::usage);
  for (const auto& output : {traces, snapshots})
    if (!checkpoint.empty() && checkpoint == output)
      throw Error("--checkpoint and an output both name " + checkpoint + "; give them different names",
                  ErrorKind::usage);
}

void OutputOptions::check_parallel() const {
  if (ranks_per_shot < 0)
    throw Error("--ranks-per-shot: found " + std::to_string(ranks_per_shot) + ", expected 0 or more",
                ErrorKind::usage);
  if (shots_in_parallel < 0)
    throw Error("--shots-in-parallel: found " + std::to_string(shots_in_parallel) + ", expected 0 or more",
                ErrorKind::usage);
  if (!snapshots.empty() && shots_in_parallel > 1)
    throw Error("--snapshots needs --shots-in-parallel 1, found " + std::to_string(shots_in_parallel) +
                    ": snapshots are written one shot after the other",
                ErrorKind::usage);
}

template <int D>
void OutputOptions::check_scene(const Scene<D>& scene,
                                const std::function<void(const std::string&)>& warn) const {
  const bool any_trace = scene.survey.any_receiver();
  if (any_trace) check_sampling(scene.recording, warn);
  if (!any_trace && revision != "auto") warn("--revision has no effect: there are no receivers");
  if (any_trace && !snapshots.empty() && snapshots == traces)
    throw Error("--output and --snapshots both name " + traces + "; give them different names",
                ErrorKind::usage);
  if (keep_unstable && ((any_trace && traces == "-") || snapshots == "-"))
    throw Error("found --keep-unstable and an output to standard output, expected the name of a file",
                ErrorKind::usage);
  in_place("--slice", [&] { cut_of(scene.subdomain.whole(scene.model.grid()), slice); });
}

template <int D>
std::size_t shots_at_once(const OutputOptions& options, const Scene<D>& scene) {
  const auto shots = scene.survey.sources.size();
  if (!options.snapshots.empty()) return 1;
  if (options.shots_in_parallel > 0) return std::min(std::size_t(options.shots_in_parallel), shots);
  const std::int64_t fit = most_together_bytes / memory_of_a_shot_bytes(scene);
  return std::size_t(
      std::clamp<std::int64_t>(std::min<std::int64_t>(fit, parallel_threads()), 1, std::int64_t(shots)));
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, OutputOptions::check);
SLIPWAVE_INSTANTIATE_D(FUNCTION, OutputOptions::check_scene);
SLIPWAVE_INSTANTIATE_D(FUNCTION, shots_at_once);

}  // namespace slipwave
