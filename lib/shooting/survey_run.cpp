// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/survey_run.hpp"

#include <unistd.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/history.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "model/model_netcdf.hpp"
#include "parallel/threads.hpp"
#include "scene/empty_gather.hpp"
#include "shooting/energy_balance.hpp"
#include "shooting/output_names.hpp"
#include "shooting/textual_header.hpp"

namespace slipwave {
namespace {

template <int D>
std::string history_of(const Scene<D>& scene, const Provenance& provenance) {
  std::string history = scene.model.history;
  append_history(history, provenance.command_line);
  return history;
}

}  // namespace

template <int D>
SurveyRun<D>::SurveyRun(const Scene<D>& scene, const OutputOptions& options, const Provenance& provenance,
                        const Messages& messages, const RankGroups* groups)
    : scene_(scene),
      options_(options),
      messages_(messages),
      groups_(groups),
      provenance_{"", provenance.version, history_of(scene, provenance)},
      state_(state_settings(provenance.version)),
      traces_(options,
              writes() && scene.survey.any_receiver() ? scene.recording.components : std::vector<Component>(),
              options.trace_format(scene.recording),
              textual_header_of(scene, provenance_.history, provenance), messages.warn),
      at_once_(groups ? groups->groups() : shots_at_once(options, scene)) {}

template <int D>
RunState::Settings SurveyRun<D>::state_settings(const std::string& version) const {
  RunState::Settings settings;
  settings.path = options_.checkpoint;
  settings.shots = shots();
  settings.first_shot = std::size_t(options_.first_shot);
  settings.say = messages_.say;
  settings.warn = messages_.warn;
  if (options_.checkpoint.empty()) return settings;
  settings.every_s = options_.checkpoint_every_s.value_or(settings.every_s);
  settings.identity = identity_of(scene_);
  settings.identity.push_back({"program", version});
  if (!options_.snapshots.empty()) settings.identity.push_back({"fields", options_.snapshot_fields});
  if (!options_.slice.empty()) settings.identity.push_back({"slice", options_.slice});
  settings.identity.push_back({"first shot", std::to_string(options_.first_shot)});
  settings.identity.push_back({"command line or history of the model", provenance_.history, false});
  return settings;
}

template <int D>
void SurveyRun<D>::take(std::size_t shot, Gather recorded) {
  if (!state_.finished(shot)) state_.finish(shot, std::move(recorded));
}

template <int D>
void SurveyRun<D>::run() {
  // Samples are written alike whether anything was computed before, or all came from a checkpoint.
  flush_subnormals();
  try {
    simulate_all();
  } catch (const Unstable& error) {
    const auto saved = save_unstable(error);
    throw Error((shots() > 1 ? "shot " + number(error.shot()) + ": " : "") + error.what() +
                    (saved.empty() ? ""
                                   : "; what it recorded until t=" +
                                         shown(error.sound_until_s() - scene_.recording.before_s, 6) +
                                         " s is in " + joined(saved)),
                ErrorKind::unstable);
  }
}

template <int D>
void SurveyRun<D>::simulate_all() {
  if (!state_.continues_at().empty())
    messages_.say("continues from " + options_.checkpoint + ": " + state_.continues_at());
  const auto rest = unfinished_shots();
  if (traces_.one_per_shot() && writes()) traces_.write(state_, shots());
  shots_to_do_ = rest.size();
  rounds_ = (rest.size() + at_once_ - 1) / at_once_;
  for (std::size_t first = 0; first < rest.size(); first += at_once_) {
    const std::span<const std::size_t> some(rest.data() + first, std::min(at_once_, rest.size() - first));
    open_outputs(some);
    const auto reports = groups_ ? simulate_on_ranks(some) : simulate_in_threads(some);
    if (!writes()) continue;
    finish_outputs(some, reports);
    if (some.back() != rest.back()) state_.checkpoint_if_due();
  }
  if (!traces_.one_per_shot() && writes()) traces_.write(state_, shots());
  state_.close();
}

/// Returns the shots that are left; those whose outputs are gone, though an earlier run finished them, are
/// among them.
template <int D>
std::vector<std::size_t> SurveyRun<D>::unfinished_shots() {
  const auto outputs_exist = [&](std::size_t shot) {
    const auto snapshots = name_for(options_.snapshots, options_.number_of(shot), "");
    const bool there = snapshots.empty() || snapshots == "-" || access(snapshots.c_str(), F_OK) == 0;
    return there && (state_.gather(shot) || traces_.exist(shot));
  };
  std::vector<std::size_t> rest;
  for (std::size_t shot = 1; shot <= shots(); ++shot) {
    if (state_.finished(shot) && !outputs_exist(shot)) state_.forget(shot);
    if (!state_.finished(shot)) rest.push_back(shot);
  }
  return rest;
}

template <int D>
void SurveyRun<D>::open_outputs(std::span<const std::size_t> some) {
  for (const auto shot : some) traces_.open(shot);
  snapshots_.reset();
  if (!writes() || options_.snapshots.empty()) return;
  const auto grid = scene_.subdomain.whole(scene_.model.grid());
  auto history = provenance_;
  history.title = "wave fields of shot " + number(some[0]);
  snapshots_.emplace(name_for(options_.snapshots, options_.number_of(some[0]), ""), grid,
                     cut_of(grid, options_.slice), parse_snapshot_fields<D>(options_.snapshot_fields),
                     history, state_, some[0]);
}

/// One bar for the whole survey, which the rounds of shots that run together fill one after the other.
template <int D>
Progress SurveyRun<D>::progress_of(std::span<const std::size_t> some) {
  const auto round = std::int64_t(round_++);
  if (rounds_ == 1)
    return messages_.progress(
        "shot " + number(some.front()) + (some.size() > 1 ? " to " + number(some.back()) : ""), "steps");
  if (!progress_) progress_ = messages_.progress(std::to_string(shots_to_do_) + " shots", "steps");
  if (!progress_) return {};  // silent
  return [this, round](std::int64_t done, std::int64_t total) {
    progress_(round * total + done, std::int64_t(rounds_) * total);
  };
}

template <int D>
std::vector<ShotReport> SurveyRun<D>::simulate_in_threads(std::span<const std::size_t> some) {
  std::vector<ShotReport> reports(some.size());
  const auto progress = progress_of(some);
  parallel_jobs(std::int64_t(some.size()), int(at_once_), [&](std::int64_t n) {
    const auto shot = some[std::size_t(n)];
    const auto pauses = state_.pauses_of(shot, snapshots_ ? snapshots_->mark() : RunState::Mark());
    // The first of those that run together speaks for all.
    state_.finish(shot, in_record(shoot(scene_, shot, n == 0 ? progress : Progress(),
                                        snapshots_ ? snapshots_->sink() : SnapshotSink<D>(), pauses.get(),
                                        scene_.slip_diary ? &reports[std::size_t(n)] : nullptr),
                                  scene_.recording));
  });
  return reports;
}

template <int D>
std::vector<ShotReport> SurveyRun<D>::simulate_on_ranks(std::span<const std::size_t> some) {
  std::vector<ShotReport> reports(some.size());
  const auto sink = snapshots_ ? snapshots_->sink()
                    : options_.snapshots.empty()
                        ? SnapshotSink<D>()
                        : sink_of_helper<D>(parse_snapshot_fields<D>(options_.snapshot_fields));
  auto outcomes = groups_->shoot(scene_, some, writes() ? progress_of(some) : Progress(), sink);
  for (std::size_t n = 0; n < outcomes.size(); ++n) {
    state_.finish(outcomes[n].shot, in_record(std::move(outcomes[n].gather), scene_.recording));
    reports[n] = outcomes[n].report;
  }
  return reports;
}

template <int D>
void SurveyRun<D>::finish_outputs(std::span<const std::size_t> some, const std::vector<ShotReport>& reports) {
  for (std::size_t n = 0; scene_.slip_diary && n < some.size(); ++n)
    messages_.say("shot " + number(some[n]) + ": " + sentence_of(reports[n], D));
  if (snapshots_) snapshots_->commit();
  if (traces_.one_per_shot()) traces_.write(state_, shots());
}

/// Puts complete files of other shots in place when a shot has become unstable, and all the rest under other
/// names where that is wanted. Returns these names; what cannot be written is a warning.
template <int D>
std::vector<std::string> SurveyRun<D>::save_unstable(const Unstable& error) {
  std::vector<std::string> saved;
  try {
    if (traces_.one_per_shot()) traces_.write_finished(state_, shots());
    if (!options_.keep_unstable) return {};
    for (std::size_t shot = 1; traces_.one_per_shot() && shot <= shots(); ++shot) state_.forget(shot);
    state_.finish(error.shot(), in_record(error.gather(), scene_.recording));
    traces_.write_unstable(state_, shots(),
                           "shot " + number(error.shot()) + " became unstable: its samples after " +
                               shown(error.sound_until_s() - scene_.recording.before_s, 6) + " s are zero",
                           saved);
    if (!snapshots_) return saved;
    const auto name = unstable_name(name_for(options_.snapshots, options_.number_of(error.shot()), ""));
    snapshots_->commit_as(name);
    saved.push_back(name);
  } catch (const Error& other) {
    messages_.warn(other.what());
  }
  return saved;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SurveyRun);

}  // namespace slipwave
