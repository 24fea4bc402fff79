#include "shooting/shooting.hpp"

#include <utility>

#include "accuracy/choice.hpp"
#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
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

/// The scene without its model, all options checked.
template <int D>
Scene<D> make_scene(const ShootingOptions& options) {
  const auto& output = options.output;
  const bool any_snapshot = !output.snapshots.empty();
  auto scene = options.scene.without_model<D>();
  if (any_snapshot) {
    if (!options.snapshot_every_s)
      throw Error("--snapshots needs --every, the time between snapshots", ErrorKind::usage);
    scene.snapshot_every_s = options.snapshot_every_s;
  }
  scene.slip_diary = options.balance || (any_snapshot && output.wants_slip());
  output.check<D>(scene.survey.sources.size());
  check_outputs(options);
  if (scene.survey.receivers_m.empty() && !any_snapshot && !options.plan)
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

/// The cheapest way to compute the scene with the error that is wanted.
template <int D>
Scene<D> with_wanted_error(const Scene<D>& scene, double wanted, const Messages& messages) {
  if (!(wanted > 0))
    throw Error("--error: found " + shown(wanted) + ", expected it above 0", ErrorKind::usage);
  if constexpr (D == 2) {
    const auto choice = cheapest_setting(scene, wanted);
    if (!choice.good_enough)
      throw Error("--error: found no setting for " + shown(wanted) + "; the best is " +
                  sentence_of(choice, scene) + " (margin: 1.5)" +
                  (choice.reason.empty() ? "" : "; " + choice.reason));
    messages.say("chose " + sentence_of(choice, scene));
    auto chosen = chosen_scene(scene, choice);
    check(chosen);
    return chosen;
  }
  throw Error("--error needs a model in 2-D, found one in 3-D", ErrorKind::usage);
}

template <int D>
void print_plan(const Scene<D>& scene, bool with_choice, const std::string& path) {
  auto report = report_of(plan(scene));
  if constexpr (D == 2)
    if (with_choice) {
      const auto choice = cheapest_setting(scene, 0.01);
      report.text("for an error of 1 %", (choice.good_enough ? "" : "at best ") + sentence_of(choice, scene) +
                                             (choice.reason.empty() ? "" : "; " + choice.reason));
    }
  const std::string text = report.lines();
  OutputFile out(path, OutputFile::Content::text);
  out.write(text.data(), text.size());
  out.commit();
}

template <int D>
void shoot_model(const ShootingOptions& options, const Provenance& provenance, const Messages& messages,
                 NetcdfFile file) {
  auto scene = make_scene<D>(options);
  for (const auto& sentence : options.scene.read_model_into(scene, file)) messages.warn(sentence);
  file.close();
  if (options.wanted_error) scene = with_wanted_error(scene, *options.wanted_error, messages);
  for (const auto& sentence : warnings(scene)) messages.warn(sentence);
  if (options.plan) return print_plan(scene, !options.wanted_error, options.output.traces);
  options.output.check_scene(scene, messages.warn);
  SurveyRun<D>(scene, options.output, provenance, messages, nullptr).run();
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
  collective_try(&ranks, [&] { options.output.check_scene(scene, messages.warn); });
  // Of each kind the first one's.
  for (const auto& sentences : {of_model, warnings(scene)})
    for (const auto& sentence : allgather_texts(ranks, sentences.empty() ? "" : sentences.back()))
      if (!sentence.empty()) {
        messages.warn(sentence);
        break;
      }
  SurveyRun<D>(scene, options.output, provenance, messages, &groups).run();
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
