// SPDX-License-Identifier: BSD-3-Clause
#include "cli/ranks.hpp"
#include "cli/tool.hpp"
#include "output/snapshot_netcdf.hpp"
#include "parallel/ranks_started.hpp"
#include "scene_options.hpp"
#include "shooting/shooting.hpp"

using namespace slipwave;

namespace {

void declare(cli::Options& options, ShootingOptions& s) {
  declare_scene(options, s.scene);
  declare_numerics(options, s.scene);
  options.add("bands", s.scene.bands, "DEPTH:STEP,...",
              "cells of their own from each depth on, beside each other 2 to 4 times as large: 0:0.5,30:2; "
              "auto chooses them; none, the default: those of the model");
  options.add(
      "error", s.wanted_error, "SHARE",
      "choose the cheapest order, cell size and time step whose measured error is at most this (0.01: 1 %)");
  options.add("of", s.error_of, "WHAT",
              "what errors are measured of: traces, or response (what fractures add to them)");
  options.add("budget", s.budget_s, "S", "with --error: at most this much processor time, s");
  options.add("measure", s.measure,
              "measure the error, by runs in larger cells; with --plan only these are run");
  options.add("error-gather", s.error_gather, "FILE",
              "write the measured error of each trace here, as SEG-Y");
  options.add("plan", s.plan, "print dispersion, time and memory, and stop; with -v all details");
  options.add("json", s.json, "with --plan, --measure, --error: print all results as one JSON object");
  options.add("inject", s.scene.survey.inject, "GATHER",
              "traces as sources where they were recorded: velocities as forces, p as explosions");
  options.add("reverse", s.scene.survey.reverse, "with --inject: reverse the traces in time");
  options.add("output,o", s.output.traces, "GATHER",
              "SEG-Y, Seismic Unix if the name ends in .su; {component} and {shot} in the name split the "
              "traces; - is standard output");
  options.add_choice("revision", s.output.revision, {"auto", "0", "1", "2"},
                     "revision of SEG-Y; auto: 1, or 2 where 1 cannot hold the sampling");
  options.add("snapshots", s.output.snapshots, "FILE",
              "write snapshots of the wave field to this netCDF file");
  options.add("every", s.snapshot_every_s, "S", "time between snapshots, s");
  options.add("fields", s.output.snapshot_fields, "LIST", snapshot_field_help());
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
  options.require("time");
  options.excludes("error", {"order", "time-order", "cfl", "time-step"}, "it chooses them");
  options.needs("of", {"error", "measure", "error-gather"});
  options.needs("budget", {"error"});
  options.needs("json", {"plan", "measure", "error"});
  for (const char* name : {"every", "fields", "slice"}) options.needs(name, {"snapshots"});
  options.needs("output", {"receivers", "geometry", "inject", "plan"});
  options.needs("checkpoint-every", {"checkpoint"});
  options.needs("reverse", {"inject"});
  options.add_log();
  options.add_threads();
  options.headings(
      {{"inject", "Recorded traces as sources"}, {"output", "Output"}, {"shots-in-parallel", "The run"}});
  options.common({"source", "kind", "wavelet", "amplitude", "receivers", "time", "record", "top", "error",
                  "measure", "plan", "output", "snapshots", "every", "threads"});
}

void run(ShootingOptions& settings, const cli::Context& context) {
  settings.details = context.verbose;
  const Provenance provenance = {context.version, context.command_line};
  const auto ranks = started_ranks();
  if (!ranks && settings.output.ranks_per_shot > 0)
    context.warn("--ranks-per-shot has no effect without mpirun");
  if (!ranks) return shoot_survey(settings, provenance, context.messages());
  // A plan is made of the whole model, and by one process.
  if (settings.plan && ranks->number() > 0) return;
  if (settings.plan) return shoot_survey(settings, provenance, context.messages());
  cli::run_on_ranks(context, *ranks, end_all_ranks, [&](const cli::Context& own) {
    shoot_survey_on_ranks(settings, provenance, own.messages(), *ranks);
  });
}

}  // namespace

int main(int argc, char** argv) {
  ShootingOptions settings;
  return cli::run_tool(
      argc, argv,
      {"sw-shoot", "Simulates shots over a model and writes the recorded gathers.",
       "[options] MODEL [-o GATHER]",
       "sw-shoot model.nc --source 1250,5 --wavelet ricker:30 --receivers 0:2500:25,5 --time 1 "
       "-o shot.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
