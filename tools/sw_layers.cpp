// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "geology/layers.hpp"
#include "geology/well_log.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "rock/property_range.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string size;
  double step_m = 0;
  std::vector<std::string> layers;
  std::string fit, units;
  std::string log, vs_from, rho_from;
  double fluid_vp = 1500;
  std::optional<double> block_m;
  bool backus = false;
  std::string average = "tilted";
  bool no_average = false;
  MediumLimits limits;
  std::string title = "layered model";
  std::string output = "-";
};

void declare(cli::Options& options, Settings& settings) {
  options.add("size", settings.size, "LXxLZ", "size of the model, m; in 3-D LXxLYxLZ");
  options.add("step", settings.step_m, "H", "cell size, m");
  options.add(
      "layer", settings.layers, "DEPTH:VP:VS:RHO[:DIP] [NAME=VALUE...]",
      "a layer from DEPTH down; repeat, top layer first. DIP in degrees, deepening towards +x, with DEPTH at "
      "x = 0. VS 0 is fluid; above the first layer is void. DEPTH may be sine,MEAN,AMPLITUDE,WAVELENGTH or "
      "@FILE of lines \"X Z\", in 3-D also a grid of lines \"X Y DEPTH\" or in netCDF; smooth@FILE has no "
      "kinks. VP, VS, RHO may be A+K or A-K: A at the top, K more or less per metre. Other properties follow "
      "by name: 'qp=80 qs=40 epsilon=0.2 delta=0.1 gamma=0.1 tilt=20'; or "
      "stiffnesses: '0:-:-:2300 c11=26e9 ...'");
  options.add(
      "log", settings.log, "FILE",
      "a well log as a layer from its first depth on: LAS 2.0, or columns below a header such as \"DEPTH.M "
      "VP.M/S VS.M/S RHO.G/CC\"; sonics count too. Each cell is the average of its samples");
  options.add("block", settings.block_m, "H", "average the log over blocks of H m instead");
  options.add("backus", settings.backus,
              "average the log in each cell as flat layers (Backus), with the anisotropy of their average");
  options.add_choice("vs-from-vp", settings.vs_from, {"castagna"},
                     "for a log without vs: vs = (vp - 1360)/1.16 in solids");
  options.add("fluid-vp", settings.fluid_vp, "VP", "with --vs-from-vp: fluid where vp is at most this");
  options.add_choice("rho-from-vp", settings.rho_from, {"gardner"},
                     "for a log without density: rho = 310 vp^0.25");
  options.add(
      "fit", settings.fit, "surface,floor|all|none",
      "which tops rows of cells follow, where tops lie on no faces: by default all that rows can follow");
  options.add("units", settings.units, "LIST",
              "units of VP, VS and RHO instead of m/s and kg/m3, as km/s,g/cm3; K stays per second (kg/m4)");
  options.add("average", settings.average, "tilted|isotropic|none",
              "material of cells cut by a top: where all is solid, in 2-D, the average of layers that dip as "
              "the top does; the isotropic average of their parts; or the material at their centre");
  options.add("no-average", settings.no_average, "the same as --average none");
  options.add("title", settings.title, "TEXT", "title of the model file");
  options.add("allow-slow", settings.limits.allow_slow,
              "allow speeds and densities that no rock or fluid has");
  options.add("allow-auxetic", settings.limits.allow_auxetic, "allow vs above vp/sqrt(2)");
  options.add("output,o", settings.output, "M", "model file; - is standard output");
  options.common({"size", "step", "layer", "log", "fit", "units", "average", "output"});
  for (const char* name : {"size", "step"}) options.require(name);
  for (const char* name : {"block", "backus", "vs-from-vp", "rho-from-vp"}) options.needs(name, {"log"});
  options.needs("fluid-vp", {"vs-from-vp"});
  options.excludes("block", {"backus"});
  options.excludes("average", {"no-average"});
}

/// Of properties that no wave in a section meets.
void warn_of_three_dimensions(const std::vector<Layer>& layers, const cli::Context& context) {
  for (const auto property :
       {Property::gamma, Property::epsilon1, Property::delta1, Property::delta3, Property::gamma2})
    for (const auto& layer : layers)
      for (const auto& [given, value] : layer.others) {
        if (given != property) continue;
        context.warn(row_of(property).name +
                     " has no effect in 2-D, where waves travel and move in the section; it counts in 3-D");
        return;
      }
}

/// Puts the log among the layers: below those whose tops are not deeper than its own.
template <int D>
void add_log(const Settings& settings, const InputUnits& units, std::vector<Layer>& layers,
             const cli::Context& context) {
  if (settings.log.empty()) return;
  const LogChoice choice{units,
                         !settings.vs_from.empty(),
                         !settings.rho_from.empty(),
                         settings.fluid_vp,
                         settings.block_m,
                         settings.limits,
                         settings.backus};
  const auto log = in_place("--log", [&] { return read_well_log(settings.log, choice); });
  auto layer = in_place(settings.block_m ? "--block" : "--log",
                        [&] { return layer_of_log(log, settings.step_m, D == 3, choice); });
  const auto after = std::find_if(layers.begin(), layers.end(),
                                  [&](const Layer& other) { return other.top.at(0) > layer.top.depth_m(); });
  if (after == layers.begin() && layer.top.depth_m() > 0)
    throw Error("--log: begins " + shown(layer.top.depth_m()) +
                    " m deep, expected a --layer above it, as --layer 0:VP:VS:RHO",
                ErrorKind::usage);
  context.say(report_of_log(log, layer, choice));
  layers.insert(after, std::move(layer));
}

/// Throws a usage Error on a value that a property cannot have.
void check_values(const Layer& layer) {
  const auto check_value = [](Property property, double value) {
    const auto& row = row_of(property);
    if (!is_in_range(row, value))
      throw Error(
          "found " + std::string(row.name) + " of " + shown(value) + ", expected " + expected_values(row),
          ErrorKind::usage);
  };
  check_value(Property::vp, layer.material.vp);
  check_value(Property::vs, layer.material.vs);
  check_value(Property::rho, layer.material.rho);
  for (const auto& [property, value] : layer.others) check_value(property, value);
}

template <int D>
void build(const Settings& settings, const cli::Context& context) {
  const auto size = in_place("--size", [&] { return parse_size<D>(settings.size); });
  const auto grid = in_place("--size, --step", [&] { return grid_of_size<D>(size, settings.step_m); });
  const auto units = settings.units.empty()
                         ? InputUnits()
                         : in_place("--units", [&] { return InputUnits::parse(settings.units); });
  std::vector<Layer> layers;
  for (const auto& text : settings.layers) {
    layers.push_back(in_place("--layer", [&] { return parse_layer(text, units); }));
    in_place("--layer", [&] { check_values(layers.back()); });
  }
  add_log<D>(settings, units, layers, context);
  const auto choice =
      settings.fit.empty() ? FitChoice() : in_place("--fit", [&] { return parse_fit(settings.fit); });
  const auto fit = in_place("--layer", [&] { return fit_layers(grid, layers, choice); });
  const auto average = in_place("--average", [&] { return parse_average(settings.average); });
  OutputFile out(settings.output, OutputFile::Content::binary);
  Model<D> model;
  model.geology = {.maker = Maker::sw_layers,
                   .fit = choice,
                   .average = settings.no_average ? Average::none : average,
                   .layers = layers};
  model.medium =
      in_place("--layer", [&] { return layered_medium(fit.grid, layers, model.geology.average, fit.rows); });
  check(model, settings.limits);
  if (model.medium.rho.empty() || std::all_of(model.medium.rho.begin(), model.medium.rho.end(),
                                              [](float density) { return density == 0; }))
    throw Error("--layer: found void in all cells, expected a layer that begins above the bottom, " +
                    shown(grid.end(D - 1)) + " m",
                ErrorKind::usage);
  if (D == 2) warn_of_three_dimensions(layers, context);
  if (!fit.summary.empty()) context.say(fit.summary);
  for (const auto& sentence : fit.left_out) context.warn(sentence + "; --fit says what to follow");
  for (const auto& sentence : cut_off_layers(grid, layers))
    context.warn(sentence + "; if that is not meant, change the --layer");
  model.title = settings.title;
  model.source = context.version;
  model.history = context.command_line;
  write_model(model, out);
  context.note(shown(fit.grid));
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.layers.empty() && settings.log.empty())
    throw Error("--layer is missing; expected --layer DEPTH:VP:VS:RHO[:DIP] [NAME=VALUE...]",
                ErrorKind::usage);
  if (split(settings.size, 'x').size() == 3) return build<3>(settings, context);
  build<2>(settings, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-layers", "Builds a model of flat, dipping and curved layers.", "[options] [-o M]",
       "sw-layers --size 2500x3000 --step 5 --layer 0:1500:0:1000 --layer "
       "sine,400,20,500:1800+0.6:600+0.4:2100 "
       "-o model.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
