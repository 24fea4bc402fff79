#include <optional>

#include "accuracy/choice.hpp"
#include "accuracy/plan.hpp"
#include "base/error.hpp"
#include "cli/tool.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "parallel/ranks_started.hpp"
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
  options.add("snapshots", s.output.snapshots, "FILE",
              "write snapshots of the wave field to this netCDF file");
  options.add("every", s.every_s, "S", "time between snapshots, s");
  options.add(
      "fields", s.output.snapshot_fields, "LIST",
      "fields: vx, vz, p, sxx, szz, sxz, div, curl, slip, slip_rate, dissipated, opening; in 3-D also vy, "
      "syy, sxy, syz, and curlx, curly, curlz for curl");
  options.add("slice", s.output.slice, "AXIS=AT", "in 3-D: snapshots on this plane only, y=500");
  options.add("balance", s.balance, "report how many cells slipped and where the energy went");
  options.add("shots-in-parallel", s.output.shots_in_parallel, "N",
              "shots computed at once; 0: one per thread while they fit 1 GiB");
  options.add("ranks-per-shot", s.output.ranks_per_shot, "N",
              "with mpirun: processes per shot; 0: as few as possible");
  options.add("first-shot", s.output.first_shot, "N", "number of the first shot; the others follow");
  options.add("checkpoint", s.output.checkpoint, "FILE",
              "save the state of the run here, and resume from it if it exists");
  options.add("checkpoint-every", s.output.checkpoint_every_s, "S",
              "wall-clock time between checkpoints, s [600]");
  options.add("keep-unstable", s.output.keep_unstable,
              "keep the output of an unstable run, in files unstable-NAME");
  options.add("error", s.wanted_error, "SHARE",
              "choose the cheapest order, cell size and time step for this expected error (0.01: 1 %)");
  options.add("plan", s.plan, "print grid, cost and expected error, and stop");
  options.add("output,o", s.output.traces, "GATHER",
              "SEG-Y; {component} and {shot} in the name split the traces; - is standard output");
  for (const char* name : {"source", "wavelet", "time"}) options.require(name);
  options.add_threads();
}

template <int D>
Scene<D> make_scene(const Settings& s) {
  auto scene = s.shot.without_model<D>();
  if (!s.output.snapshots.empty()) {
    if (!s.every_s) throw Error("--snapshots needs --every, the time between snapshots", ErrorKind::usage);
    scene.snapshot_every_s = s.every_s;
  }
  scene.slip_diary = s.balance || (!s.output.snapshots.empty() && s.output.wants_slip());
  s.output.check<D>(scene.survey.sources.size());
  for (const auto& output : {s.output.traces, s.output.snapshots}) {
    expect_other_files(output, {s.shot.model});
    if (s.output.keep_unstable && !output.empty()) expect_other_files(unstable_name(output), {s.shot.model});
  }
  if (scene.survey.receivers_m.empty() && s.output.snapshots.empty() && !s.plan)
    throw Error("nothing to record: give --receivers or --snapshots", ErrorKind::usage);
  return scene;
}

/// What several processes can not do together.
void check_together(const Settings& s, int count) {
  const auto refuse = [&](bool given, const std::string& option, const std::string& remedy) {
    if (given)
      throw Error(option + " does not work with " + std::to_string(count) + " processes; " + remedy,
                  ErrorKind::usage);
  };
  refuse(!s.output.checkpoint.empty(), "--checkpoint", "use one");
  refuse(s.output.shots_in_parallel > 1, "--shots-in-parallel", "use --ranks-per-shot");
  refuse(s.wanted_error.has_value(), "--error", "use --plan with one process, then give what it chooses");
  refuse(s.shot.model == "-", "a model from standard input", "give the name of a file");
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
  throw Error("--error needs a model in 2-D, found one in 3-D", ErrorKind::usage);
}

template <int D>
void shoot_together(const Settings& settings, NetcdfFile file, const cli::Context& context, Ranks& ranks) {
  Scene<D> scene;
  collective_try(&ranks, [&] { scene = make_scene<D>(settings); });
  const RankGroups crew(ranks, settings.output.ranks_per_shot, scene.survey.sources.size(),
                        !settings.output.snapshots.empty());
  settings.shot.read_part_into(scene, file, ranks, crew.group());
  file.close();
  collective_try(&ranks, [&] { settings.output.check_run(scene, context); });
  std::string mine;
  for (const auto& sentence : warnings(scene)) mine = sentence;
  for (const auto& sentence : allgather_texts(ranks, mine))
    if (!sentence.empty()) {
      context.warn(sentence);
      break;
    }
  std::string history = scene.model.history;
  append_history(history, context.command_line);
  settings.output.shoot_all(scene, history, context, &crew);
}

template <int D>
void shoot_model(const Settings& settings, NetcdfFile file, const cli::Context& context) {
  auto scene = make_scene<D>(settings);
  settings.shot.read_model_into(scene, file);
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
  settings.output.check_run(scene, context);
  std::string history = scene.model.history;
  append_history(history, context.command_line);
  settings.output.shoot_all(scene, history, context);
}

void run_alone(const Settings& settings, const cli::Context& context) {
  auto file = NetcdfFile::open(settings.shot.model);
  if (dimension_of(file) == 3) return shoot_model<3>(settings, std::move(file), context);
  shoot_model<2>(settings, std::move(file), context);
}

void run_together(const Settings& settings, cli::Context context, Ranks& ranks) {
  if (ranks.number() > 0) {
    context.quiet = true;
    context.verbose = false;
  }
  std::optional<NetcdfFile> file;
  collective_try(&ranks, [&] {
    check_together(settings, ranks.count());
    file = NetcdfFile::open(settings.shot.model);
  });
  if (dimension_of(*file) == 3) return shoot_together<3>(settings, std::move(*file), context, ranks);
  shoot_together<2>(settings, std::move(*file), context, ranks);
}

void run(const Settings& settings, const cli::Context& context) {
  const auto ranks = started_ranks();
  if (!ranks) return run_alone(settings, context);
  const bool leads = ranks->number() == 0;
  // A plan is made of the whole model, and of one process.
  if (settings.plan) {
    if (leads) run_alone(settings, context);
    return;
  }
  // A launcher ends all processes when one of them ends with an error: that must wait for the one that says
  // why, and keeps what there is.
  const auto end_together = [&](int status) {
    ranks->all_of({});
    throw cli::EndSilently{status};
  };
  try {
    return run_together(settings, context, *ranks);
  } catch (const CollectiveError& error) {
    if (leads) cli::say_error(context.tool, error.what());
    end_together(int(error.kind()));
  } catch (const cli::EndSilently& end) {
    end_together(end.status);
  } catch (const Error& error) {
    cli::say_error(context.tool, error.what());
    if (error.kind() == ErrorKind::unstable) end_together(int(error.kind()));
    end_all_ranks(int(error.kind()));  // the others do not know, and would wait
    throw cli::EndSilently{int(error.kind())};
  } catch (const std::bad_alloc&) {
    cli::say_error(context.tool, "out of memory");
    end_all_ranks(1);
    throw cli::EndSilently{1};
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-shoot", "Simulates shots over a model and writes the recorded gathers.",
       "[options] MODEL [-o GATHER]",
       "sw-shoot model.nc --source 1250,5 --wavelet ricker:30 --receivers 0:2500:25,5 --time 1 "
       "-o shot.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
