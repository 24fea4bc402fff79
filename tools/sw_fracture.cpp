#include <algorithm>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "model/fracture.hpp"
#include "model/model_netcdf.hpp"
#include "model/prestress.hpp"
#include "model/region.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string model = "-";
  std::string box, polygon, ellipse, slab;
  int count = 0, seed = 1;
  std::string body;
  std::vector<std::string> dips, normals;
  double friction = 0, viscosity_s = 0, strength_pa = 0;
  bool block = false, opening = false;
  std::string prestress;
  std::string name;
  std::string output = "-";
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.model, "M");
  options.add("box", settings.box, "X0:X1,Z0:Z1", "the region: cells whose centres lie in a box, m");
  options.add("polygon", settings.polygon, "FILE", "or in a polygon: a line \"X Z\" for each vertex");
  options.add("ellipse", settings.ellipse, "X,Z:A,B[:DIP]",
              "or in an ellipse round X,Z: half axes A, which dips by DIP, and B");
  options.add("slab", settings.slab, "X,Z:L,T[:DIP]", "or in a slab of length L and thickness T");
  options.add("count", settings.count, "N",
              "not all of the region but N small slabs in it, along the planes");
  options.add("body", settings.body, "L,T",
              "their mean length and thickness [1/10 of the region's longer side, 1/10 of that]");
  options.add("seed", settings.seed, "S", "another S, other slabs");
  options.add(
      "dip", settings.dips, "DEG",
      "angle of the planes from the horizontal, deepening towards +x; give two for two families of planes");
  options.add("normal", settings.normals, "NX,NZ", "or their normal, of any length; z points down");
  options.add("friction", settings.friction, "Q", "coefficient of friction");
  options.add("viscosity", settings.viscosity_s, "ETA", "viscosity of slip, s");
  options.add("strength", settings.strength_pa, "PA", "cohesion, Pa");
  options.add("block", settings.block, "blocks: planes across those of --dip or --normal, too");
  options.add("opening", settings.opening, "planes part under tension, which they carry otherwise");
  options.add("prestress", settings.prestress, "STRESS",
              "static stress of these cells, Pa: none, lithostatic[:K0] (the weight above; sideways K0 times "
              "that [lambda/(lambda + 2 mu)]), a pressure, or SXX,SZZ,SXZ, tension positive");
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
  if (settings.block && normals.size() != 1) {
    throw Error("found --block and " + std::to_string(normals.size()) +
                    " of --dip and --normal, expected one of them with --block",
                ErrorKind::usage);
  }
  if (settings.block) normals.push_back({-normals[0][1], normals[0][0]});
  if (normals.empty() || normals.size() > 2) {
    throw Error("found " + std::to_string(normals.size()) + " of --dip and --normal, expected one or two",
                ErrorKind::usage);
  }
  return normals;
}

Region region_of(const Settings& settings) {
  const int given =
      !settings.box.empty() + !settings.polygon.empty() + !settings.ellipse.empty() + !settings.slab.empty();
  if (given != 1) {
    throw Error(
        "found " + std::to_string(given) + " of --box, --polygon, --ellipse and --slab, expected one of them",
        ErrorKind::usage);
  }
  if (settings.polygon == "-" && settings.model == "-") {
    throw Error("--polygon: standard input holds the model already, expected a file", ErrorKind::usage);
  }
  if (!settings.polygon.empty()) return read_polygon(settings.polygon);
  if (!settings.ellipse.empty())
    return in_place("--ellipse", [&] { return parse_ellipse(settings.ellipse); });
  if (!settings.slab.empty()) return in_place("--slab", [&] { return parse_slab(settings.slab); });
  return in_place("--box", [&] { return region_of_box(parse_box<2>(settings.box)); });
}

/// The region itself, or slabs in it that lie along planes of this dip.
Region bodies_of(const Settings& settings, const Region& region, double dip_deg) {
  if (settings.count == 0) {
    if (settings.body.empty()) return region;
    throw Error("found --body without --count, expected both", ErrorKind::usage);
  }
  const auto& low = region.bounds.low_m;
  const auto& high = region.bounds.high_m;
  Scatter scatter{settings.count, std::uint64_t(settings.seed), 0, 0, dip_deg};
  scatter.length_m = std::max(high[0] - low[0], high[1] - low[1]) / 10;
  scatter.thickness_m = scatter.length_m / 10;
  if (!settings.body.empty()) {
    const auto body = in_place("--body", [&] { return parse_point<2>(settings.body); });
    scatter.length_m = body[0], scatter.thickness_m = body[1];
  }
  return in_place("--count", [&] { return scattered_in(region, scatter); });
}

void run(const Settings& settings, const cli::Context& context) {
  FractureSet<2> set;
  for (const auto& normal : normals_of(settings)) {
    set.systems.push_back(
        {normal, settings.friction, settings.viscosity_s, settings.strength_pa, settings.opening});
  }
  const auto prestress = in_place("--prestress", [&] {
    return parse_prestress<2>(settings.prestress.empty() ? "none" : settings.prestress);
  });
  const auto region = bodies_of(settings, region_of(settings), dip_of_normal(set.systems[0].normal));
  OutputFile out(settings.output, OutputFile::Content::binary);
  auto model = read_model<2>(settings.model);
  set.name =
      settings.name.empty() ? "fractures-" + std::to_string(model.fracture_sets.size() + 1) : settings.name;
  const auto input = settings.model == "-" ? "standard input" : settings.model;
  // Whoever built the model decided about vs > vp/sqrt(2).
  in_place(input, [&] { check(model, {.allow_auxetic = true}); });
  const auto count = add_fractures<2>(model, set, region.contains);
  if (!settings.prestress.empty()) set_prestress(model, model.fracture_sets.size(), prestress);
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
       "[M] (--box BOX | ...) (--dip DEG | --normal NX,NZ) --friction Q --viscosity ETA [-o "
       "M]",
       "sw-fracture model.nc --box 500:2000,2000:2100 --dip 45 --friction 0.1 --viscosity 4e3 -o broken.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
