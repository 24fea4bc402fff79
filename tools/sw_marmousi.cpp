// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "geology/layers.hpp"
#include "geology/marmousi.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "parallel/threads.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string size = "10000x3500";
  double step_m = 0;
  int seed = 1;
  MarmousiSettings geology;
  std::string fit;
  bool no_average = false;
  std::string title = "Marmousi-like model";
  std::string output = "-";
};

void declare(cli::Options& options, Settings& settings) {
  options.add("size", settings.size, "LXxLZ", "size of the model, m");
  options.add("step", settings.step_m, "H", "cell size, m");
  options.add("water", settings.geology.water_m, "DEPTH", "depth of the sea, m; 0 is land");
  options.add("seed", settings.seed, "S", "seed of the geology; it is the same at every size and cell size");
  options.add("scale", settings.geology.scale, "F", "factor on all lengths except the water depth");
  options.add("vp-over-vs", settings.geology.vp_over_vs, "R",
              "one vp/vs for all rock, instead of by lithology");
  options.add(
      "fit", settings.fit, "floor|none",
      "let rows of cells follow the sea floor where it lies on no face of cells, or never; by default if "
      "possible");
  options.add("no-average", settings.no_average,
              "cells with several beds take the material at their centre, not the average");
  options.add("title", settings.title, "TEXT", "title of the model file");
  options.add("output,o", settings.output, "M", "model file; - is standard output");
  options.add_threads();
  options.require("step");
}

void run(const Settings& settings, const cli::Context& context) {
  const ThreadLimit threads(context.threads);
  const auto size = in_place("--size", [&] { return parse_size<2>(settings.size); });
  const auto grid = in_place("--size, --step", [&] { return grid_of_size<2>(size, settings.step_m); });
  auto geology = settings.geology;
  if (settings.seed < 0)
    throw Error("--seed: found " + std::to_string(settings.seed) + ", expected 0 or more", ErrorKind::usage);
  geology.seed = std::uint64_t(settings.seed);
  const auto choice =
      settings.fit.empty() ? FitChoice() : in_place("--fit", [&] { return parse_fit(settings.fit); });
  const auto fit = fit_marmousi(grid, geology, choice);
  OutputFile out(settings.output, OutputFile::Content::binary);
  Model<2> model;
  model.medium = marmousi_medium(fit.grid, geology, !settings.no_average);
  model.geology = {.maker = Maker::sw_marmousi,
                   .fit = choice,
                   .average = settings.no_average ? Average::none : Average::isotropic,
                   .marmousi = geology};
  check(model);
  if (std::all_of(model.medium.vs.begin(), model.medium.vs.end(), [](float speed) { return speed == 0; }))
    throw Error("--water: found " + shown(geology.water_m) + ", expected a sea that ends above the bottom, " +
                    shown(size[1]) + " m",
                ErrorKind::usage);
  if (!fit.summary.empty()) context.say(fit.summary);
  for (const auto& sentence : fit.left_out) context.warn(sentence + "; --fit none follows nothing");
  model.title = settings.title;
  model.source = context.version;
  model.history = context.command_line;
  write_model(model, out);
  context.note(shown(fit.grid));
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-marmousi", "Builds a model that resembles Marmousi-II, from a seed.", "--step H [options] [-o M]",
       "sw-marmousi --step 10 --seed 3 -o model.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
