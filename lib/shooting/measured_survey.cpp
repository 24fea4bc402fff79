// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/measured_survey.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/history.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "io/output_file.hpp"
#include "planning/plan.hpp"
#include "planning/wanted_error.hpp"
#include "segy/writer.hpp"
#include "shooting/survey_run.hpp"
#include "shooting/trace_files.hpp"

namespace slipwave {
namespace {

/// What changes less than this part of the error is not worth a line.
constexpr double least_share = 0.1;

template <int D>
Observed observed_of(const Scene<D>& scene, const ShootingOptions& options) {
  const bool response = options.error_of == "response";
  if (!scene.survey.any_receiver())
    throw Error("errors are measured by traces; give --receivers", ErrorKind::usage);
  if (response && scene.model.fracture_sets.empty())
    throw Error("--of response: found no fractures in the model", ErrorKind::usage);
  return {representative_shots(scene.survey), response};
}

template <int D>
SceneInCells<D> in_cells_of(const ShootingOptions& options, const Messages& messages) {
  return {[&options](Scene<D>& scene) { options.scene.place_again(scene); },
          [&messages](const std::string& title) { return messages.progress(title, "steps"); }};
}

SearchLimits limits_of(const ShootingOptions& options) {
  SearchLimits limits;
  // What the system and other programs need stays theirs.
  constexpr double ours = 0.8;
  limits.memory_bytes = ours * double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  limits.seconds = options.budget_s.value_or(0);
  return limits;
}

std::string short_percent(double share) { return shown(100 * share, 2) + " %"; }

std::string joined_sizes(const MeasuredError& measured) {
  std::vector<std::string> sizes;
  for (const double size_m : measured.others_m) sizes.push_back(shown(size_m, 4));
  return joined(sizes, " and ") + " m";
}

/// "on shots 1 and 50 of 50"; empty where all are measured.
template <int D>
std::string shots_text(const SceneRuns<D>& runs) {
  const auto& survey = runs.scene().survey;
  const auto& shots = runs.observed().shots;
  if (shots.size() == survey.sources.size()) return "";
  std::vector<std::string> labels;
  for (const auto shot : shots) labels.push_back(std::to_string(survey.label_of(shot)));
  return ", on shots " + joined(labels, " and ") + " of " + std::to_string(survey.sources.size());
}

/// What edges and other options change, where that matters.
std::vector<std::string> remedies_of(const MeasuredError& measured) {
  std::vector<std::string> sentences;
  for (const auto& one : measured.sensitivities)
    if (one.change > least_share * measured.error.whole)
      sentences.push_back(one.what + " (" + one.option + "): " + short_percent(one.change) + " in cells of " +
                          shown(one.spacing_m, 4) + " m");
  return sentences;
}

void report_percent(Report& report, const std::string& key, double share) {
  if (std::isfinite(share)) report.number(key, std::stod(shown(100 * share, 3)), "%");
}

/// All of it, in numbers.
template <int D>
Report report_of(const MeasuredError& measured, const SceneRuns<D>& runs) {
  Report report;
  const auto& error = measured.error;
  report.text("setting", name_of(measured.setting, runs.scene()));
  report_percent(report, "error measured", error.whole);
  for (const auto& [component, share] : error.components)
    report_percent(report, "error of " + std::string(name_of(component)), share);
  report_percent(report, "error of the late quarter", error.late);
  report_percent(report, "error of the worst trace", error.worst);
  report.count("shot of the worst trace",
               runs.scene().survey.label_of(runs.observed().shots[error.worst_shot]));
  report.count("channel of the worst trace", error.worst_channel);
  report_percent(report, "error cured by smaller cells", measured.by_cells);
  report_percent(report, "error of edges", measured.by_edges);
  report.number("order of the error", measured.order, "");
  report.text("measured in cells of", joined_sizes(measured) + shots_text(runs));
  std::vector<Report> all;
  for (const auto& one : measured.sensitivities) {
    auto& entry = all.emplace_back();
    entry.text("what", one.what);
    entry.text("option", one.option);
    report_percent(entry, "change", one.change);
    entry.number("step", one.spacing_m, "m");
  }
  if (!all.empty()) report.list("also changes the traces", all);
  report.number("processor time of the shots measured", measured.run_s, "s");
  report.number("processor time to know the error", measured.measuring_s, "s");
  return report;
}

/// The error of each trace, found less exact, in a file of its own.
template <int D>
void write_error_gather(const MeasuredError& measured, const SceneRuns<D>& runs, OutputFile& out,
                        const Provenance& provenance, const Messages& messages) {
  Gather all;
  for (const auto& gather : measured.wrong) {
    all.axis = gather.axis;
    all.traces.insert(all.traces.end(), gather.traces.begin(), gather.traces.end());
  }
  auto history = runs.scene().model.history;
  append_history(history, provenance.command_line);
  segy::Heading heading{
      {provenance.version + ": errors of synthetic seismograms, found less exact, as measured",
       provenance.measured},
      std::move(history)};
  if (runs.observed().response) heading.entries.push_back("of what fractures add to the traces");
  const auto sentences = segy::write_gather(out, all, segy::format_named_by(out.shown_name()), heading);
  out.commit();
  for (const auto& sentence : sentences) messages.warn(out.shown_name() + ": " + sentence);
}

/// "measured error: 0.82 % of all traces (...), by cells of 3.75 and 5.625 m, order 1.9".
template <int D>
std::string line_of(const MeasuredError& measured, const SceneRuns<D>& runs) {
  return "measured error: " + sentence_of(measured, runs) + ", by cells of " + joined_sizes(measured) +
         ", order " + shown(measured.order, 2) + shots_text(runs);
}

template <int D>
void say(const MeasuredError& measured, const SceneRuns<D>& runs, double all_s, const Messages& messages) {
  messages.say(name_of(measured.setting, runs.scene()) + ": " + line_of(measured, runs));
  for (const auto& sentence : remedies_of(measured)) messages.say(sentence);
  if (measured.beside_source > 0)
    messages.warn(std::to_string(measured.beside_source) + " receivers of these shots stand within " +
                  std::to_string(cells_of_a_source) +
                  " cells of a source, in the cells that it is spread over: their traces are "
                  "left out of the error");
  const double extra = measured.run_s > 0 ? (all_s - measured.run_s) / measured.run_s : 0;
  messages.say("knowing it took " + shown(all_s - measured.run_s, 2) + " s of processor time, " +
               shown(100 * extra, 2) + " % of the " + shown(measured.run_s, 2) +
               " s of the shots that it was measured on");
  const auto& all = runs.scene().survey.sources;
  const auto& shots = runs.observed().shots;
  if (all.size() > shots.size())
    messages.say("the other " + std::to_string(all.size() - shots.size()) + " shots will take about " +
                 shown(measured.run_s / double(shots.size()) * double(all.size() - shots.size()), 2) +
                 " s of processor time");
}

/// Names that cannot be written cost no computing.
void expect_writable(const OutputOptions& output, const std::vector<Component>& components,
                     const std::vector<std::size_t>& shots) {
  TraceFiles files(output, components, {}, {}, {});
  for (const auto shot : shots) files.open(shot);
}

template <int D>
ReachedError found_error(SceneRuns<D>& runs, const ShootingOptions& options, const Messages& messages) {
  if (options.wanted_error) return reach_error(runs, *options.wanted_error, limits_of(options), messages.say);
  ReachedError reached;
  reached.good = true;
  reached.measured = measured_error(runs, setting_of(runs.scene()), {true, true, options.measure});
  return reached;
}

}  // namespace

bool measures(const ShootingOptions& options) {
  return options.wanted_error || options.measure || !options.error_gather.empty();
}

void check_measuring(const ShootingOptions& options) {
  const auto usage = [](const std::string& sentence) { throw Error(sentence, ErrorKind::usage); };
  if (options.error_of != "traces" && options.error_of != "response")
    usage("--of: found '" + options.error_of + "', expected traces or response");
  if (options.wanted_error) check_wanted_error(*options.wanted_error);
  if (options.wanted_error && options.plan)
    usage(
        "found --plan with --error, which runs the scene to choose; --plan --measure measures its own "
        "setting");
  if (options.budget_s && !(*options.budget_s > 0))
    usage("--budget: found " + shown(*options.budget_s) + " s, expected it above 0");
  if (!options.error_gather.empty() && options.plan)
    usage("found --error-gather with --plan, expected a run: its traces are compared");
  if (options.json && !options.plan && options.output.traces == "-")
    usage("found --json and traces to standard output, expected -o FILE");
}

template <int D>
void shoot_measured(const Scene<D>& scene, const ShootingOptions& options, const OutputOptions& output,
                    const Provenance& provenance, const Messages& messages) {
  SceneRuns<D> runs(scene, observed_of(scene, options), in_cells_of<D>(options, messages));
  expect_writable(output, scene.recording.components, runs.observed().shots);
  std::optional<OutputFile> errors;
  if (!options.error_gather.empty()) errors.emplace(options.error_gather, OutputFile::Content::binary);
  const auto reached = found_error(runs, options, messages);
  const auto& measured = reached.measured;
  say(measured, runs, runs.seconds(), messages);
  if (!reached.good)
    messages.warn("wanted " + short_percent(*options.wanted_error) + ", reached " +
                  short_percent(measured.error.whole) + ": " + reached.reason);
  auto own = provenance;
  own.measured = line_of(measured, runs);
  if (errors) write_error_gather(measured, runs, *errors, own, messages);
  if (options.json) {
    const std::string text = report_of(measured, runs).json() + "\n";
    OutputFile out("-", OutputFile::Content::text);
    out.write(text.data(), text.size());
    out.commit();
  }
  const auto chosen = runs.scene_of(measured.setting);
  if (options.wanted_error && !chosen.numerics.bands.empty())
    for (const auto& sentence : warnings(chosen)) messages.warn(sentence);
  SurveyRun<D> survey(chosen, output, own, messages, nullptr);
  // Snapshots and diaries want the shot again.
  const bool again = !output.snapshots.empty() || chosen.slip_diary;
  if (const auto* run = runs.find(measured.setting); run && !again)
    for (std::size_t n = 0; n < run->recorded.size(); ++n)
      survey.take(runs.observed().shots[n], run->recorded[n]);
  survey.run();
}

template <int D>
Report measured_report(const Scene<D>& scene, const ShootingOptions& options, const Messages& messages) {
  SceneRuns<D> runs(scene, observed_of(scene, options), in_cells_of<D>(options, messages));
  const auto measured = measured_error(runs, setting_of(scene), {false, true, true});
  Report report;
  report.text("measured error", sentence_of(measured, runs));
  report.text("measured in", "cells of " + joined_sizes(measured) + ", taken on to " +
                                 shown(measured.setting.spacing_m, 4) + " m as of second order" +
                                 shots_text(runs));
  report.texts("changes with", remedies_of(measured));
  report.text("measuring took", shown(measured.measuring_s, 2) + " s of processor time");
  if (options.json) report.append(report_of(measured, runs));
  return report;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, shoot_measured);
SLIPWAVE_INSTANTIATE_D(FUNCTION, measured_report);

}  // namespace slipwave
