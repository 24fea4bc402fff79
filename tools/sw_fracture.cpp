#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "model/fracture.hpp"
#include "model/model_netcdf.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string model = "-";
  std::string box, polygon;
  std::vector<std::string> dips, normals;
  double friction = 0, viscosity_s = 0, strength_pa = 0;
  std::string name;
  std::string output = "-";
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.model, "M");
  options.add("box", settings.box, "X0:X1,Z0:Z1", "the region: cells whose centres lie in a box, m");
  options.add("polygon", settings.polygon, "FILE", "or in a polygon: a line \"X Z\" for each vertex");
  options.add(
      "dip", settings.dips, "DEG",
      "angle of the planes from the horizontal, deepening towards +x; give two for two families of planes");
  options.add("normal", settings.normals, "NX,NZ", "or their normal, of any length; z points down");
  options.add("friction", settings.friction, "Q", "coefficient of friction");
  options.add("viscosity", settings.viscosity_s, "ETA", "viscosity of slip, s");
  options.add("strength", settings.strength_pa, "PA", "cohesion, Pa");
  options.add("name", settings.name, "S", "name of the set [fractures-N]");
  options.add("output,o", settings.output, "M", "model file, - is standard output");
  for (const char* name : {"friction", "viscosity"}) options.require(name);
}

std::vector<Point<2>> normals_of(const Settings& settings) {
  std::vector<Point<2>> normals;
  for (const auto& text : settings.dips) {
    normals.push_back(in_place("--dip", [&] { return normal_of_dip(parse_number(text)); }));
  }
  for (const auto& text : settings.normals) {
    normals.push_back(in_place("--normal", [&] { return unit_normal<2>(parse_point<2>(text)); }));
  }
  if (normals.empty() || normals.size() > 2) {
    throw Error("found " + std::to_string(normals.size()) + " of --dip and --normal, expected one or two",
                ErrorKind::usage);
  }
  return normals;
}

std::function<bool(const Point<2>&)> region_of(const Settings& settings) {
  if (settings.box.empty() == settings.polygon.empty()) {
    throw Error(std::string("found ") + (settings.box.empty() ? "neither --box nor" : "both --box and") +
                    " --polygon, expected one of them",
                ErrorKind::usage);
  }
  if (!settings.box.empty()) {
    const auto box = in_place("--box", [&] { return parse_box<2>(settings.box); });
    return [box](const Point<2>& at) { return box.contains(at); };
  }
  if (settings.polygon == "-" && settings.model == "-") {
    throw Error("--polygon: standard input holds the model already, expected a file", ErrorKind::usage);
  }
  return [polygon = Polygon::read(settings.polygon)](const Point<2>& at) { return polygon.contains(at); };
}

void run(const Settings& settings, const cli::Context& context) {
  FractureSet<2> set;
  for (const auto& normal : normals_of(settings)) {
    set.systems.push_back({normal, settings.friction, settings.viscosity_s, settings.strength_pa});
  }
  const auto region = region_of(settings);
  OutputFile out(settings.output, OutputFile::Content::binary);
  auto model = read_model<2>(settings.model);
  set.name =
      settings.name.empty() ? "fractures-" + std::to_string(model.fracture_sets.size() + 1) : settings.name;
  const auto input = settings.model == "-" ? "standard input" : settings.model;
  // Whoever built the model decided about vs > vp/sqrt(2).
  in_place(input, [&] { check(model, {.allow_auxetic = true}); });
  const auto count = add_fractures<2>(model, set, region);
  check(model, {.allow_auxetic = true});
  if (count.left) {
    context.warn(std::to_string(count.left) + " fluid or void cells in the region stay intact, " +
                 std::to_string(count.marked) + " cells are fractured");
  }
  context.note(std::to_string(count.marked) + " cells of set '" + set.name + "', " +
               std::to_string(count.taken) + " of them from earlier sets");
  append_history(model.history, context.command_line);
  model.source = context.version;
  write_model(model, out);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-fracture", "Puts a cluster of parallel fractures into a model.",
       "[M] (--box BOX | --polygon FILE) (--dip DEG | --normal NX,NZ) --friction Q --viscosity ETA [-o M]",
       "sw-fracture model.nc --box 500:2000,2000:2100 --dip 45 --friction 0.1 --viscosity 4e3 -o broken.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
