// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/shooting.hpp"

#include <utility>

#include "accuracy/direct_waves.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_zeros.hpp"
#include "planning/plan.hpp"
#include "scene/bands.hpp"
#include "scene/magnitude.hpp"
#include "scene/subdomains.hpp"
#include "scene/timing.hpp"
#include "shooting/measured_survey.hpp"
#include "shooting/output_names.hpp"
#include "shooting/rank_groups.hpp"
#include "shooting/survey_run.hpp"

namespace slipwave {
namespace {

/// Outputs must not be written over the model.
void check_outputs(const ShootingOptions& options) {
  const auto& output = options.output;
  expect_other_files(options.error_gather, {options.scene.model, output.traces, output.snapshots});
  for (const auto& name : {output.traces, output.snapshots}) {
    expect_other_files(name, {options.scene.model});
    if (output.keep_unstable && !name.empty()) expect_other_files(unstable_name(name), {options.scene.model});
  }
}

/// The options of outputs, shots called as the survey numbers them.
template <int D>
OutputOptions labelled(OutputOptions output, const Survey<D>& survey) {
  if (!survey.spreads || !survey.spreads->given().numbered) return output;
  for (std::size_t shot = 1; shot <= survey.sources.size(); ++shot)
    output.shot_labels.push_back(survey.label_of(shot));
  return output;
}

/// A survey that lies beside a section was moved onto it.
template <int D>
void warn_of_projection(const Survey<D>& survey, const Messages& messages) {
  const double moved_m = survey.spreads ? survey.spreads->moved_m() : 0;
  if (moved_m > 0)
    messages.warn("the survey was moved onto the model's section, places by up to " + shown(moved_m, 3) +
                  " m across it and offsets by up to " + shown(survey.spreads->offset_change_m(), 3) +
                  " m; --origin and --azimuth choose the section, a model in 3-D keeps all places");
}

/// The scene without its model, all options checked.
template <int D>
Scene<D> make_scene(const ShootingOptions& options) {
  check_measuring(options);
  if (!options.scene.survey.any_source())
    throw Error("--source is missing; expected --source X,Z", ErrorKind::usage);
  auto scene = options.scene.without_model<D>();
  const OutputOptions output = labelled(options.output, scene.survey);
  const bool any_snapshot = !output.snapshots.empty();
  if (any_snapshot) {
    if (!options.snapshot_every_s)
      throw Error("--snapshots needs --every, the time between snapshots", ErrorKind::usage);
    if (scene.recording.before_s > 0)
      throw Error(
          "found --snapshots and a delay below 0, expected one of them: snapshots begin with the record",
          ErrorKind::usage);
    scene.snapshot_every_s = options.snapshot_every_s;
  }
  scene.slip_diary = options.balance || (any_snapshot && output.wants_slip());
  output.check<D>(scene.survey.sources.size());
  check_outputs(options);
  if (!scene.survey.any_receiver() && !any_snapshot && !options.plan)
    throw Error("nothing to record: give --receivers or --snapshots", ErrorKind::usage);
  return scene;
}

bool in_bands(const ShootingOptions& options) {
  return !options.scene.bands.empty() && options.scene.bands != "none";
}

/// What several processes cannot do together.
void check_on_ranks(const ShootingOptions& options, int count) {
  const auto refuse = [&](bool given, const std::string& option, const std::string& remedy) {
    if (given)
      throw Error(option + " does not work with " + std::to_string(count) + " processes; " + remedy,
                  ErrorKind::usage);
  };
  refuse(!options.output.checkpoint.empty(), "--checkpoint", "use one");
  refuse(options.output.shots_in_parallel > 1, "--shots-in-parallel", "use --ranks-per-shot");
  refuse(measures(options), "--error, --measure or --error-gather",
         "use one process, then give what it chooses");
  refuse(options.scene.model == "-", "a model from standard input", "give the name of a file");
}

template <int D>
void print_plan(const Scene<D>& scene, const ShootingOptions& options, const Messages& messages) {
  const auto planned = plan(scene);
  const auto side_by_side = shots_at_once(options.output, scene);
  // Traces of all shots stand in memory until they are written to one file.
  auto report = summary_of(planned, {side_by_side, scene.survey.sources.size() - side_by_side});
  if (options.measure) report.append(measured_report(scene, options, messages));
  if (options.details || options.json) report.append(report_of(planned));
  const std::string text = options.json ? report.json() + "\n" : report.lines();
  OutputFile out(options.output.traces, OutputFile::Content::text);
  out.write(text.data(), text.size());
  out.commit();
}

/// "3 shots, expected error 1.4 % in direct arrivals, ": what the last line of a run begins with.
template <int D>
std::string result_in_words(const Scene<D>& scene) {
  const auto shots = scene.survey.sources.size();
  if (!scene.numerics.bands.empty())
    return std::to_string(shots) + (shots == 1 ? " shot" : " shots") + ", cells of " +
           shown(scene.numerics.bands);
  const DirectWaves<D> waves(scene);
  const auto cells = discretisation_of(scene);
  const auto error = waves.error(cells);
  return std::to_string(shots) + (shots == 1 ? " shot, " : " shots, ") +
         (error.p || error.s
              ? "expected error " + shown(100 * waves.together(cells), 2) + " % in direct arrivals, "
              : "no direct wave arrives, ");
}

/// Chooses bands where that was asked for. Says in one line what was chosen and what it saves; where nothing
/// was said of bands, what they would save.
template <int D>
void say_or_choose_bands(Scene<D>& scene, const ShootingOptions& options, const Messages& messages) {
  const bool asked = options.scene.bands == "auto";
  if (!asked && !(options.scene.bands.empty() && messages.heard)) return;
  const auto chosen = bands_for(scene);
  const auto cells = "cells of " + shown(chosen.bands), share = shown(100 * chosen.share, 2) + " %";
  if (asked) scene.numerics.bands = chosen.bands;
  if (!chosen.bands.empty())
    messages.say(asked ? "bands: " + cells + "; " + share + " of the cells and steps of one size"
                       : cells + " would take " + share + " of these cells and steps: --bands auto");
  else if (asked)
    messages.say("bands: none, all in cells of " + shown(scene.model.grid().spacing_m) + " m");
}

template <int D>
void shoot_model(const ShootingOptions& options, const Provenance& provenance, const Messages& messages,
                 NetcdfFile file) {
  auto scene = make_scene<D>(options);
  for (const auto& sentence : options.scene.read_model_into(scene, file)) messages.warn(sentence);
  file.close();
  release_zeros(scene.model);
  release_freed_memory();
  warn_of_projection(scene.survey, messages);
  say_or_choose_bands(scene, options, messages);
  if (!options.wanted_error)
    for (const auto& sentence : warnings(scene)) messages.warn(sentence);
  if (options.plan) return print_plan(scene, options, messages);
  const OutputOptions output = labelled(options.output, scene.survey);
  output.check_scene(scene, messages.warn);
  check_magnitudes(scene);
  for (const auto& sentence : timing_warnings(scene)) messages.warn(sentence);
  if (measures(options)) return shoot_measured(scene, options, output, provenance, messages);
  SurveyRun<D>(scene, output, provenance, messages, nullptr).run();
  messages.close([&] { return result_in_words(scene); });
}

/// Collective: `most` processes a shot at most, where that is above 0.
template <int D>
RankGroups groups_for(const Scene<D>& scene, const ShootingOptions& options, Ranks& ranks, int most = 0) {
  return {ranks, options.output.ranks_per_shot, scene.survey.sources.size(),
          !options.output.snapshots.empty(), most};
}

/// Collective: chooses bands and the groups that shoot in them, for which the rows of bands must be known:
/// all processes have the whole model.
template <int D>
RankGroups groups_in_bands(Scene<D>& scene, const ShootingOptions& options, const Messages& messages,
                           Ranks& ranks) {
  collective_try(&ranks, [&] { say_or_choose_bands(scene, options, messages); });
  std::vector<Scene<D>> bands;
  int most = 0;
  collective_try(&ranks, [&] {
    if (scene.numerics.bands.empty()) return;
    bands = scenes_of_bands(scene);
    most = most_processes(scene, bands);
  });
  auto groups = groups_for(scene, options, ranks, most);
  auto* const group = groups.group();
  collective_try(&ranks, [&] {
    if (!bands.empty()) return void(subdomains_for(scene, bands, 0, group ? group->count() : 1));
    if (!group) return;
    const auto part = subdomain_for(scene, scene.model.grid(), group->number(), group->count());
    scene = cut_to(std::move(scene), part);
  });
  if (bands.empty() && group) join(scene, *group);
  return groups;
}

template <int D>
void shoot_model_on_ranks(const ShootingOptions& options, const Provenance& provenance,
                          const Messages& messages, NetcdfFile file, Ranks& ranks) {
  Scene<D> scene;
  collective_try(&ranks, [&] { scene = make_scene<D>(options); });
  std::optional<RankGroups> formed;
  if (!in_bands(options)) formed.emplace(groups_for(scene, options, ranks));
  const auto of_model = options.scene.read_part_into(scene, file, ranks, formed ? formed->group() : nullptr);
  file.close();
  if (!formed) formed.emplace(groups_in_bands(scene, options, messages, ranks));
  const auto& groups = *formed;
  release_zeros(scene.model);
  release_freed_memory();
  const OutputOptions output = labelled(options.output, scene.survey);
  collective_try(&ranks, [&] { output.check_scene(scene, messages.warn); });
  collective_try(&ranks,
                 [&] { check_magnitudes(scene, scene.subdomain.is_whole() ? nullptr : groups.group()); });
  if (groups.leads()) {
    warn_of_projection(scene.survey, messages);
    for (const auto& sentence : timing_warnings(scene)) messages.warn(sentence);
  }
  // Of each kind the first one's.
  for (const auto& sentences : {of_model, warnings(scene)})
    for (const auto& sentence : allgather_texts(ranks, sentences.empty() ? "" : sentences.back()))
      if (!sentence.empty()) {
        messages.warn(sentence);
        break;
      }
  SurveyRun<D>(scene, output, provenance, messages, &groups).run();
  const auto shots = scene.survey.sources.size();
  messages.close([&] { return std::to_string(shots) + (shots == 1 ? " shot, " : " shots, "); });
}

}  // namespace

void shoot_survey(const ShootingOptions& options, const Provenance& provenance, const Messages& messages) {
  auto file = NetcdfFile::open(options.scene.model);
  if (dimension_of(file) == 3) return shoot_model<3>(options, provenance, messages, std::move(file));
  shoot_model<2>(options, provenance, messages, std::move(file));
}

void shoot_survey_on_ranks(const ShootingOptions& options, const Provenance& provenance,
                           const Messages& messages, Ranks& ranks) {
  std::optional<NetcdfFile> file;
  collective_try(&ranks, [&] {
    check_on_ranks(options, ranks.count());
    file = NetcdfFile::open(options.scene.model);
  });
  if (dimension_of(*file) == 3)
    return shoot_model_on_ranks<3>(options, provenance, messages, std::move(*file), ranks);
  shoot_model_on_ranks<2>(options, provenance, messages, std::move(*file), ranks);
}

}  // namespace slipwave
