#include <optional>

#include "accuracy/choice.hpp"
#include "accuracy/plan.hpp"
#include "base/error.hpp"
#include "base/netcdf_file.hpp"
#include "base/output_file.hpp"
#include "cli/tool.hpp"
#include "model/model_netcdf.hpp"
#include "shot_output.hpp"
#include "shot_settings.hpp"

using namespace slipwave;

namespace {

struct Settings {
  ShotSettings shot;
  std::optional<double> every_s, wanted_error;
  bool plan = false, balance = false;
  ShotOutput output;
};

void declare(cli::Options& options, Settings& s) {
  s.shot.declare_scene(options);
  s.shot.declare_numerics(options);
  options.add("snapshots", s.output.snapshots, "FILE", "write whole wave fields to this netCDF file");
  options.add("every", s.every_s, "S", "time between snapshots, s");
  options.add(
      "fields", s.output.snapshot_fields, "LIST",
      "of vx, vz, p, sxx, szz, sxz, div, curl, slip, slip_rate, dissipated, opening; in 3-D also vy, syy, "
      "sxy, syz, and curlx, curly, curlz, not curl");
  options.add("slice", s.output.slice, "AXIS=AT", "in 3-D: snapshots of the cells on a plane, y=500, alone");
  options.add("balance", s.balance, "say at the end how many cells slipped and where the energy went");
  options.add("shots-in-parallel", s.output.shots_in_parallel, "N",
              "shots shot at once; 0: one a thread as long as 1 GiB holds them");
  options.add("first-shot", s.output.first_shot, "N", "number of the first source, the others follow");
  options.add("checkpoint", s.output.checkpoint, "FILE",
              "keep the state of the run here, and go on from it where there is one");
  options.add("checkpoint-every", s.output.checkpoint_every_s, "S",
              "wall-clock time between checkpoints, s [600]");
  options.add("keep-unstable", s.output.keep_unstable,
              "keep what a run recorded before it became unstable, in files unstable-NAME");
  options.add("error", s.wanted_error, "SHARE",
              "choose order, cell size and time step for this expected error (0.01: 1 %), cheapest first");
  options.add("plan", s.plan, "print what would be computed, and stop");
  options.add("output,o", s.output.traces, "GATHER",
              "SEG-Y; {component} and {shot} in the name split the traces; - is standard output");
  for (const char* name : {"source", "wavelet", "time"}) options.require(name);
  options.add_threads();
}

template <int D>
Scene<D> make_scene(const Settings& s, const NetcdfFile& file) {
  auto scene = s.shot.without_model<D>();
  if (!s.output.snapshots.empty()) {
    if (!s.every_s)
      throw Error("found --snapshots without --every, expected the time between them", ErrorKind::usage);
    scene.snapshot_every_s = s.every_s;
  }
  scene.slip_diary = s.balance || (!s.output.snapshots.empty() && s.output.wants_slip());
  s.output.check<D>(scene.survey.sources.size());
  for (const auto& output : {s.output.traces, s.output.snapshots}) {
    expect_other_files(output, {s.shot.model});
    if (s.output.keep_unstable && !output.empty()) expect_other_files(unstable_name(output), {s.shot.model});
  }
  if (scene.survey.receivers_m.empty() && s.output.snapshots.empty() && !s.plan)
    throw Error("found neither --receivers nor --snapshots, expected what to record", ErrorKind::usage);
  s.shot.read_model_into(scene, file);
  return scene;
}

/// The cheapest way to compute the scene with the error that is wanted.
template <int D>
Scene<D> with_wanted_error(const Scene<D>& scene, double wanted, const cli::Context& context) {
  if (!(wanted > 0))
    throw Error("--error: found " + shown(wanted) + ", expected it above 0", ErrorKind::usage);
  if constexpr (D == 2) {
    const auto choice = cheapest_setting(scene, wanted);
    if (!choice.good_enough)
      throw Error("--error: found no setting for " + shown(wanted) + "; the best is " +
                  sentence_of(choice, scene) + " (margin: 1.5)");
    context.say("chose " + sentence_of(choice, scene));
    auto chosen = with_setting(scene, choice.setting);
    check(chosen);
    return chosen;
  }
  throw Error("found --error with a model in 3-D, expected one in 2-D", ErrorKind::usage);
}

template <int D>
void shoot_model(const Settings& settings, NetcdfFile file, const cli::Context& context) {
  auto scene = make_scene<D>(settings, file);
  file.close();
  if (settings.wanted_error) scene = with_wanted_error(scene, *settings.wanted_error, context);
  for (const auto& sentence : warnings(scene)) context.warn(sentence);
  if (settings.plan) {
    auto report = report_of(plan(scene));
    if constexpr (D == 2)
      if (!settings.wanted_error) {
        const auto choice = cheapest_setting(scene, 0.01);
        report.text("for an error of 1 %",
                    (choice.good_enough ? "" : "at best ") + sentence_of(choice, scene));
      }
    const std::string text = report.lines();
    OutputFile out(settings.output.traces, OutputFile::Content::text);
    out.write(text.data(), text.size());
    return out.commit();
  }
  std::string history = scene.model.history;
  append_history(history, context.command_line);
  settings.output.shoot_all(scene, history, context);
}

void run(const Settings& settings, const cli::Context& context) {
  auto file = NetcdfFile::open(settings.shot.model);
  if (dimension_of(file) == 3) return shoot_model<3>(settings, std::move(file), context);
  shoot_model<2>(settings, std::move(file), context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-shoot", "Shoots a model: what a survey over it would record.", "[options] MODEL [-o GATHER]",
       "sw-shoot model.nc --source 1250,5 --wavelet ricker:30 --receivers 0:2500:25,5 --time 1 "
       "-o shot.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
