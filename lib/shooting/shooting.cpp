// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/shooting.hpp"

#include <utility>

#include "accuracy/choice.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_zeros.hpp"
#include "planning/plan.hpp"
#include "shooting/output_names.hpp"
#include "shooting/rank_groups.hpp"
#include "shooting/survey_run.hpp"

namespace slipwave {
namespace {

/// Outputs must not be written over the model.
void check_outputs(const ShootingOptions& options) {
  const auto& output = options.output;
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

/// Whether --error is of the response of fractures. Throws a usage Error.
bool is_of_response(const ShootingOptions& options) {
  const auto& of = options.error_of;
  if (of != "traces" && of != "response")
    throw Error("--of: found '" + of + "', expected traces or response", ErrorKind::usage);
  if (of == "response" && !options.wanted_error && !options.plan)
    throw Error("--of response needs --error or --plan", ErrorKind::usage);
  return of == "response";
}

/// The scene without its model, all options checked.
template <int D>
Scene<D> make_scene(const ShootingOptions& options) {
  is_of_response(options);
  if (options.json && !options.plan) throw Error("--json needs --plan", ErrorKind::usage);
  if (!options.scene.survey.any_source())
    throw Error("--source is missing; expected --source X,Z", ErrorKind::usage);
  auto scene = options.scene.without_model<D>();
  const OutputOptions output = labelled(options.output, scene.survey);
  const bool any_snapshot = !output.snapshots.empty();
  if (any_snapshot) {
    if (!options.snapshot_every_s)
      throw Error("--snapshots needs --every, the time between snapshots", ErrorKind::usage);
    scene.snapshot_every_s = options.snapshot_every_s;
  }
  scene.slip_diary = options.balance || (any_snapshot && output.wants_slip());
  output.check<D>(scene.survey.sources.size());
  check_outputs(options);
  if (!scene.survey.any_receiver() && !any_snapshot && !options.plan)
    throw Error("nothing to record: give --receivers or --snapshots", ErrorKind::usage);
  return scene;
}

/// What several processes can not do together.
void check_on_ranks(const ShootingOptions& options, int count) {
  const auto refuse = [&](bool given, const std::string& option, const std::string& remedy) {
    if (given)
      throw Error(option + " does not work with " + std::to_string(count) + " processes; " + remedy,
                  ErrorKind::usage);
  };
  refuse(!options.output.checkpoint.empty(), "--checkpoint", "use one");
  refuse(options.output.shots_in_parallel > 1, "--shots-in-parallel", "use --ranks-per-shot");
  refuse(options.wanted_error.has_value(), "--error",
         "use --plan with one process, then give what it chooses");
  refuse(options.scene.model == "-", "a model from standard input", "give the name of a file");
}

Choice choice_for(const Scene<2>& scene, const ShootingOptions& options, double wanted) {
  if (!is_of_response(options)) return cheapest_setting(scene, wanted);
  try {
    return cheapest_setting_for_response(scene, wanted);
  } catch (const Error& error) {
    throw Error("--of response: " + std::string(error.what()), error.kind());
  }
}

/// The cheapest way to compute the scene with the error that is wanted.
template <int D>
Scene<D> with_wanted_error(const Scene<D>& scene, const ShootingOptions& options, const Messages& messages) {
  const double wanted = *options.wanted_error;
  if (!(wanted > 0))
    throw Error("--error: found " + shown(wanted) + ", expected it above 0", ErrorKind::usage);
  if (scene.numerics.monotone)
    throw Error(
        "found --error with --monotone, whose error is not known beforehand; measure it with sw-accuracy "
        "--limits none,monotone",
        ErrorKind::usage);
  if constexpr (D == 2) {
    const auto choice = choice_for(scene, options, wanted);
    if (!choice.good_enough)
      throw Error("--error: found no setting for " + shown(wanted) + "; the best is " +
                  sentence_of(choice, scene) + " (margin: 1.5)" +
                  (choice.reason.empty() ? "" : "; " + choice.reason));
    messages.say("chose " + sentence_of(choice, scene));
    auto chosen = chosen_scene(scene, choice);
    // Between columns the ground of smaller cells is a little higher or lower.
    if (chosen.model.grid().spacing_m != scene.model.grid().spacing_m) options.scene.place_again(chosen);
    check(chosen);
    return chosen;
  }
  throw Error("--error needs a model in 2-D, found one in 3-D", ErrorKind::usage);
}

/// What sw-shoot --error 0.01 would choose, and what it costs against the scene as it is.
Report setting_for_1_percent(const Scene<2>& scene, const ShootingOptions& options) {
  Report report;
  const auto choice = choice_for(scene, options, 0.01);
  report.text(
      "for 1 percent",
      std::string(scene.numerics.monotone ? "without --monotone: " : "") +
          (choice.good_enough ? "--error 0.01" + std::string(choice.of_response ? " --of response: " : ": ")
                              : "none is known; at best ") +
          sentence_of(choice, scene) + (choice.reason.empty() ? "" : "; " + choice.reason));
  return report;
}

template <int D>
void print_plan(const Scene<D>& scene, const ShootingOptions& options) {
  const auto planned = plan(scene);
  const auto side_by_side = shots_at_once(options.output, scene);
  // Traces of all shots stand in memory until they are written to one file.
  auto report = summary_of(planned, {side_by_side, scene.survey.sources.size() - side_by_side});
  if constexpr (D == 2)
    if (!options.wanted_error) report.append(setting_for_1_percent(scene, options));
  if (options.details || options.json) report.append(report_of(planned));
  const std::string text = options.json ? report.json() + "\n" : report.lines();
  OutputFile out(options.output.traces, OutputFile::Content::text);
  out.write(text.data(), text.size());
  out.commit();
}

template <int D>
void shoot_model(const ShootingOptions& options, const Provenance& provenance, const Messages& messages,
                 NetcdfFile file) {
  auto scene = make_scene<D>(options);
  for (const auto& sentence : options.scene.read_model_into(scene, file)) messages.warn(sentence);
  file.close();
  release_zeros(scene.model);
  release_freed_memory();
  if (options.wanted_error) scene = with_wanted_error(scene, options, messages);
  for (const auto& sentence : warnings(scene)) messages.warn(sentence);
  warn_of_projection(scene.survey, messages);
  if (options.plan) return print_plan(scene, options);
  const OutputOptions output = labelled(options.output, scene.survey);
  output.check_scene(scene, messages.warn);
  SurveyRun<D>(scene, output, provenance, messages, nullptr).run();
}

template <int D>
void shoot_model_on_ranks(const ShootingOptions& options, const Provenance& provenance,
                          const Messages& messages, NetcdfFile file, Ranks& ranks) {
  Scene<D> scene;
  collective_try(&ranks, [&] { scene = make_scene<D>(options); });
  const RankGroups groups(ranks, options.output.ranks_per_shot, scene.survey.sources.size(),
                          !options.output.snapshots.empty());
  const auto of_model = options.scene.read_part_into(scene, file, ranks, groups.group());
  file.close();
  release_zeros(scene.model);
  release_freed_memory();
  const OutputOptions output = labelled(options.output, scene.survey);
  collective_try(&ranks, [&] { output.check_scene(scene, messages.warn); });
  if (groups.leads()) warn_of_projection(scene.survey, messages);
  // Of each kind the first one's.
  for (const auto& sentences : {of_model, warnings(scene)})
    for (const auto& sentence : allgather_texts(ranks, sentences.empty() ? "" : sentences.back()))
      if (!sentence.empty()) {
        messages.warn(sentence);
        break;
      }
  SurveyRun<D>(scene, output, provenance, messages, &groups).run();
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
