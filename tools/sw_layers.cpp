// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "io/output_file.hpp"
#include "model/layers.hpp"
#include "model/model_netcdf.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string size;
  double step_m = 0;
  std::vector<std::string> layers;
  std::string fit, units;
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
      "fit", settings.fit, "surface,floor|all|none",
      "which tops rows of cells follow where they lie on no faces: all of them that rows can, unless given");
  options.add("units", settings.units, "LIST",
              "units of VP, VS and RHO instead of m/s and kg/m3, as km/s,g/cm3; K stays per second (kg/m4)");
  options.add("average", settings.average, "tilted|isotropic|none",
              "what cells cut by a top are made of: where all is solid, in 2-D, the average of layers that "
              "dip as the top does; the isotropic average of their parts; or what is at their centre");
  options.add("no-average", settings.no_average, "the same as --average none");
  options.add("title", settings.title, "TEXT", "title of the model file");
  options.add("allow-slow", settings.limits.allow_slow,
              "allow speeds and densities that no rock or fluid has");
  options.add("allow-auxetic", settings.limits.allow_auxetic, "allow vs above vp/sqrt(2)");
  options.add("output,o", settings.output, "M", "model file; - is standard output");
  for (const char* name : {"size", "step", "layer"}) options.require(name);
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
  }
  const auto choice =
      settings.fit.empty() ? FitChoice() : in_place("--fit", [&] { return parse_fit(settings.fit); });
  const auto fit = in_place("--layer", [&] { return fit_layers(grid, layers, choice); });
  const auto average = in_place("--average", [&] { return parse_average(settings.average); });
  OutputFile out(settings.output, OutputFile::Content::binary);
  Model<D> model;
  model.medium = in_place("--layer", [&] {
    return layered_medium(fit.grid, layers, settings.no_average ? Average::none : average, fit.rows);
  });
  check(model, settings.limits);
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
