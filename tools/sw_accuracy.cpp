// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "accuracy/cases.hpp"
#include "accuracy/ladder.hpp"
#include "base/error.hpp"
#include "base/history.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "planning/measured.hpp"
#include "planning/measured_error.hpp"
#include "planning/wanted_error.hpp"
#include "scene_options.hpp"

using namespace slipwave;

namespace {

struct Settings {
  SceneOptions shot;
  std::string built_in, orders = "5,7", time_orders = "2", cfls = "0.9,0.5", steps, corrections = "centred",
                        limits = "none", reference;
  std::optional<double> wanted;
  std::string output;
  bool json = false;
};

void declare(cli::Options& options, Settings& s) {
  declare_scene(options, s.shot);
  const auto of_scene = options.names();
  options.add_choice("case", s.built_in, {"full-space"},
                     "a built-in scene with a closed form, instead of a model");
  options.add("steps", s.steps, "LIST", "cell sizes, m [the model's and twice that]");
  options.add("orders", s.orders, "LIST", "orders of the scheme in space: " + joined(texts_of(orders), ", "));
  options.add("cfls", s.cfls, "LIST", "Courant numbers, up to 1; with order 4 in time up to 2");
  options.add("time-orders", s.time_orders, "LIST", "orders in time: " + joined(texts_of(time_orders), ", "));
  options.add("corrections", s.corrections, "LIST",
              "time integration of slip: first, second, exponential, centred");
  options.add("limits", s.limits, "LIST",
              "limits of outgoing waves: none, monotone (as sw-shoot --monotone)");
  options.add("reference", s.reference, "ORDER,CFL,STEP",
              "reference solution [7,0.4 and the finest of --steps]");
  options.add("error", s.wanted, "SHARE", "mark the cheapest setting with at most this error (0.01: 1 %)");
  options.add("output,o", s.output, "FILE", "also write the table here, as netCDF");
  options.add("json", s.json, "print the table as one JSON object");
  options.excludes("case", of_scene, "the case is a scene of its own");
  options.excludes("case", {"reference"}, "it has a closed form");
  options.add_threads();
  options.headings({{"case", "Settings to vary"}});
  options.common({"source", "kind", "wavelet", "amplitude", "receivers", "time", "record", "case", "steps",
                  "orders", "cfls", "reference", "error", "output", "json"});
  // A configuration of sw-shoot says what is shot; how is varied here.
  options.pass_over({"order", "time-order", "cfl", "time-step", "correction", "monotone", "snapshots",
                     "every", "fields", "slice"});
}

double number_in(const char* option, const std::string& text) {
  return in_place(option, [&] { return parse_number(text); });
}

std::vector<double> numbers_of(const char* option, const std::string& list) {
  std::vector<double> numbers;
  for (const auto& text : split(list, ',')) {
    numbers.push_back(number_in(option, text));
    if (!(numbers.back() > 0))
      throw Error(std::string(option) + ": found " + text + ", expected numbers above 0", ErrorKind::usage);
  }
  return numbers;
}

int one_of(const char* option, double number, std::span<const int> choices) {
  std::string list;
  for (const int choice : choices) {
    if (number == choice) return choice;
    list += (list.empty() ? "" : ", ") + std::to_string(choice);
  }
  throw Error(std::string(option) + ": found " + shown(number) + ", expected one of " + list,
              ErrorKind::usage);
}

SlipCorrection correction_of(const std::string& name) {
  if (name == "first") return SlipCorrection::first;
  if (name == "second") return SlipCorrection::second;
  if (name == "exponential") return SlipCorrection::exponential;
  if (name == "centred") return SlipCorrection::centred;
  throw Error("--corrections: found " + name + ", expected first, second, exponential or centred",
              ErrorKind::usage);
}

bool is_monotone(const std::string& limit) {
  if (limit == "none" || limit == "monotone") return limit == "monotone";
  throw Error("--limits: found " + limit + ", expected none or monotone", ErrorKind::usage);
}

/// All combinations, cheap ones first; without --steps the model's cells and cells of twice the size.
template <int D>
std::vector<AccuracySetting> ladder_of(const Settings& s, const Scene<D>& scene) {
  const double own = scene.model.grid().spacing_m;
  auto steps = s.steps.empty() ? std::vector<double>{2 * own, own} : numbers_of("--steps", s.steps);
  std::sort(steps.begin(), steps.end(), std::greater<>());
  auto corrections = split(s.corrections, ',');
  if (!scene.slips()) corrections.resize(1);
  std::vector<AccuracySetting> ladder;
  for (const double step : steps)
    for (const double order : numbers_of("--orders", s.orders))
      for (const double cfl : numbers_of("--cfls", s.cfls))
        for (const double time_order : numbers_of("--time-orders", s.time_orders))
          for (const auto& correction : corrections)
            for (const auto& limit : split(s.limits, ','))
              ladder.push_back({one_of("--orders", order, orders), cfl, step, correction_of(correction),
                                one_of("--time-orders", time_order, time_orders), is_monotone(limit)});
  return ladder;
}

AccuracySetting reference_of(const Settings& s, const AccuracySetting& finest) {
  if (s.reference.empty()) return {7, 0.4, finest.spacing_m, SlipCorrection::centred};
  const auto numbers = numbers_of("--reference", s.reference);
  if (numbers.size() != 3)
    throw Error("--reference: found " + s.reference + ", expected ORDER,CFL,STEP", ErrorKind::usage);
  return {one_of("--reference", numbers[0], orders), numbers[1], numbers[2], SlipCorrection::centred};
}

/// The user's scene; nothing of it is asked for where a built-in case is.
template <int D>
Scene<D> make_scene(const Settings& s, const NetcdfFile& file, const cli::Context& context) {
  auto scene = s.shot.without_model<D>();
  for (const auto& sentence : s.shot.read_model_into(scene, file)) context.warn(sentence);
  return scene;
}

void check_given(const Settings& s) {
  for (const auto& [given, name] : {std::pair{s.shot.survey.any_source(), "--source"},
                                    {!s.shot.wavelet.empty(), "--wavelet"},
                                    {s.shot.survey.any_receiver(), "--receivers"},
                                    {s.shot.duration_s > 0, "--time"}})
    if (!given)
      throw Error(std::string(name) + " is missing; give it, or --case full-space", ErrorKind::usage);
}

std::vector<std::size_t> all_shots(std::size_t count) {
  std::vector<std::size_t> shots(count);
  std::iota(shots.begin(), shots.end(), std::size_t(1));
  return shots;
}

/// The traces that everything is measured against: a closed form, or those of a reference, whose own error is
/// measured in larger cells.
template <int D>
std::vector<Gather> exact_of(const Settings& s, SceneRuns<D>& runs, const AccuracySetting& finest,
                             AccuracyTable& table, const cli::Context& context) {
  if (!s.built_in.empty()) {
    table.reference = "the closed form";
    return {full_space_traces()};
  }
  const auto reference = reference_of(s, finest);
  table.reference = name_of(reference, runs.scene());
  context.note("reference: " + table.reference);
  table.rows.push_back(measured(runs, reference, {}));
  try {
    table.reference_error = measured_error(runs, reference, {true, false, false}).error.whole;
  } catch (const Error& error) {
    context.warn("the error of the reference is not known: " + std::string(error.what()));
  }
  return runs.run(reference).observed;
}

/// Throws where a scene's own cells could not be computed so.
template <int D>
void check_numerics(Scene<D> scene, const AccuracySetting& setting) {
  scene.numerics = numerics_of(setting, scene.numerics);
  check(scene);
}

/// In cells that hold the scene.
template <int D>
std::vector<AccuracySetting> held_ladder(const SceneRuns<D>& runs, std::vector<AccuracySetting> ladder) {
  for (auto& setting : ladder) {
    check_numerics(runs.scene(), setting);
    const auto held = runs.held(setting);
    if (!held)
      throw Error(
          "--steps: cells of " + shown(setting.spacing_m) +
              " m do not hold the scene: sides of too few cells, or sources and receivers in other matter",
          ErrorKind::usage);
    setting = *held;
  }
  return ladder;
}

/// All of a ladder's rows, each said as soon as it is there.
template <int D>
void measure(const Settings& s, const Scene<D>& scene, const cli::Context& context) {
  const bool built_in = !s.built_in.empty();
  SceneRuns<D> runs(scene, {all_shots(scene.survey.sources.size()), false},
                    {[&s](Scene<D>& again) { s.shot.place_again(again); },
                     [&context](const std::string& title) { return context.progress(title, "steps"); }});
  const auto ladder = held_ladder(runs, ladder_of(s, scene));
  // A name that cannot be written costs no computing.
  std::optional<OutputFile> out;
  if (!s.output.empty()) out.emplace(s.output, OutputFile::Content::binary);

  AccuracyTable table;
  table.title = built_in
                    ? "full space, force along z: accuracy and cost"
                    : (scene.model.title.empty() ? s.shot.model : scene.model.title) + ": accuracy and cost";
  table.history = scene.model.history;
  append_history(table.history, context.command_line);
  table.wanted_error = s.wanted;
  const auto exact = exact_of(s, runs, ladder.back(), table, context);
  for (const auto& setting : ladder) {
    table.rows.push_back(measured(runs, setting, exact));
    context.note(name_of(setting, scene) + ": done");
  }
  if (s.wanted) table.chosen = cheapest(table.rows, *s.wanted);
  OutputFile text("-", OutputFile::Content::text);
  const auto lines = s.json ? report_of(table).json() + "\n" : text_of(table);
  text.write(lines.data(), lines.size());
  text.commit();
  if (out) write_accuracy_table(*out, table, context.version);
}

void run(const Settings& s, const cli::Context& context) {
  if (s.wanted) check_wanted_error(*s.wanted);
  expect_other_files(s.output, {s.shot.model});
  if (!s.built_in.empty()) {
    if (s.shot.model != "-") throw Error("--case needs no model, found " + s.shot.model, ErrorKind::usage);
    return measure(s, full_space_case(), context);
  }
  check_given(s);
  const auto file = NetcdfFile::open(s.shot.model);
  if (dimension_of(file) == 3) return measure(s, make_scene<3>(s, file, context), context);
  measure(s, make_scene<2>(s, file, context), context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-accuracy", "Runs a scene with many settings and measures error and time of each.",
       "[options] MODEL [-o TABLE]",
       "sw-accuracy model.nc --config shot.cfg --steps 10,5,2.5 --error 0.01 -o accuracy.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
