// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/import.hpp"
#include "model/import_fit.hpp"
#include "model/input_units.hpp"
#include "model/layers.hpp"
#include "model/model_netcdf.hpp"
#include "model/raw_shape.hpp"
#include "model/relations.hpp"
#include "model/resample.hpp"
#include "model/stiffness_input.hpp"
#include "segy/reader.hpp"
#include "segy/sniff.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::vector<std::string> files = std::vector<std::string>(property_names().size());  // by property
  std::array<std::string, modulus_count> stiffness_files;                              // by Modulus
  std::string shape, order = "z-fast";
  std::optional<double> step_m, resample_m;
  std::optional<double> extrude_m;
  std::string crop, vs_from, rho_from, q_from;
  std::string surface, floor;
  std::string units;
  double fluid_vp = 1500;
  bool no_average = false, allow_rough = false;
  MediumLimits limits;
  std::string title = "imported model";
  std::string output = "-";

  const std::string& file(Property property) const { return files[std::size_t(property)]; }
  bool of_stiffness() const {
    return std::any_of(stiffness_files.begin(), stiffness_files.end(),
                       [](const std::string& file) { return !file.empty(); });
  }
};

void declare(cli::Options& options, Settings& settings) {
  for (const Property property : all_properties())
    if (!row_of(property).computed)
      options.add(row_of(property).name, settings.files[std::size_t(property)], "F", row_of(property).help);
  for (std::size_t n = 0; n < modulus_count; ++n)
    options.add(modulus_names()[n], settings.stiffness_files[n], "F", row_of(Modulus(n)).help);
  options.add("shape", settings.shape, "NXxNZ", "number of cells of raw files (little-endian float32)");
  options.add_choice("order", settings.order, {"z-fast", "x-fast"}, "fastest axis in raw files");
  options.add("step", settings.step_m, "H", "cell size, m, of raw files and SEG-Y");
  options.add(
      "units", settings.units, "LIST",
      "units of numbers that name none (raw, SEG-Y, constants) instead of m/s, kg/m3 and Pa: km/s,g/cm3,GPa");
  options.add("allow-rough", settings.allow_rough,
              "take --shape though columns then do not continue each other");
  options.add_choice("vs-from-vp", settings.vs_from, {"castagna"}, "vs = (vp - 1360)/1.16 in solids");
  options.add("fluid-vp", settings.fluid_vp, "VP", "with --vs-from-vp: fluid where vp is at most this");
  options.add_choice("rho-from-vp", settings.rho_from, {"gardner"},
                     "rho = 310 vp^0.25 in solids, 1000 in fluid");
  options.add("q-from-vs", settings.q_from, "RULE",
              "qp and qs of solids: vs/N (qs = vs/N), olsen (0.02 vs, 0.1 vs from 1500 m/s on) or brocher (a "
              "polynomial in vs); qp = 1.5 to 2 qs");
  options.add("resample", settings.resample_m, "H",
              "new cell size: averages in larger cells, interpolates for smaller ones; kinds are not mixed");
  options.add("no-average", settings.no_average, "interpolate also for larger cells");
  options.add("crop", settings.crop, "X0:X1,Z0:Z1",
              "keep only this box, after resampling; its top becomes the surface");
  options.add(
      "surface", settings.surface, "FILE",
      "let rows of cells follow this surface, lines \"X Z\" or a horizon as of sw-layers; void above it is "
      "left out");
  options.add("floor", settings.floor, "FILE|found",
              "let rows follow this sea floor, or the one found in the cells, made smooth within their size");
  options.add("extrude", settings.extrude_m, "LY",
              "finally extend the model to 3-D, uniform over LY m along y");
  options.add("title", settings.title, "TEXT", "title of the model file");
  options.add("allow-slow", settings.limits.allow_slow,
              "allow speeds and densities that no rock or fluid has");
  options.add("allow-auxetic", settings.limits.allow_auxetic, "allow vs above vp/sqrt(2)");
  options.add("output,o", settings.output, "M", "model file; - is standard output");
  options.common({"vp", "vs", "rho", "shape", "order", "step", "units", "vs-from-vp", "rho-from-vp",
                  "resample", "crop", "output"});
}

/// Stiffnesses stand for speeds and what tells anisotropic rock from other rock.
void check_stiffness(const Settings& settings) {
  GivenStiffness given;
  for (std::size_t n = 0; n < modulus_count; ++n)
    if (!settings.stiffness_files[n].empty()) given.moduli[n] = 0;
  given.check_kind();
  for (const Property property : all_properties())
    if (row_of(property).mean == Mean::elastic && property != Property::rho &&
        !settings.file(property).empty() && !(turns_axes(property) && !given[Modulus::c15]))
      throw Error("found both stiffnesses and --" + row_of(property).name + ", expected one of them",
                  ErrorKind::usage);
  if (!settings.vs_from.empty() || !settings.rho_from.empty())
    throw Error("found stiffnesses and --vs-from-vp or --rho-from-vp, expected --rho F alone",
                ErrorKind::usage);
  if (settings.file(Property::rho).empty())
    throw Error("--rho is missing; stiffnesses need densities: --rho F", ErrorKind::usage);
}

void check_choices(const Settings& settings) {
  const auto one_of = [](const std::string& file, const std::string& relation, const std::string& name) {
    if (file.empty() != relation.empty()) return;
    throw Error(std::string("found ") + (file.empty() ? "neither --" : "both --") + name +
                    (file.empty() ? " nor --" : " and --") + name + "-from-vp, expected one of them",
                ErrorKind::usage);
  };
  if (settings.of_stiffness()) {
    check_stiffness(settings);
  } else {
    if (settings.file(Property::vp).empty())
      throw Error("--vp is missing; expected --vp F, or stiffnesses: --c11 F and more", ErrorKind::usage);
    one_of(settings.file(Property::vs), settings.vs_from, "vs");
    one_of(settings.file(Property::rho), settings.rho_from, "rho");
  }
  for (const auto property : {Property::qp, Property::qs})
    if (!settings.q_from.empty() && !settings.file(property).empty())
      throw Error("found both --q-from-vs and --" + row_of(property).name + ", expected one of them",
                  ErrorKind::usage);
  if (!settings.shape.empty() && !settings.step_m)
    throw Error("--step is missing; raw files need it", ErrorKind::usage);
  if (settings.step_m && !(*settings.step_m > 0)) {
    throw Error("--step: found " + shown(*settings.step_m) + ", expected it above zero", ErrorKind::usage);
  }
  if (std::count(settings.files.begin(), settings.files.end(), "-") +
          std::count(settings.stiffness_files.begin(), settings.stiffness_files.end(), "-") >
      1) {
    throw Error("found - more than once; only one input can be standard input", ErrorKind::usage);
  }
}

Field<2> read_raw(const Settings& settings, const std::string& path) {
  const auto shape = in_place("--shape", [&] { return parse_shape<2>(settings.shape); });
  const double step = *settings.step_m;
  const auto grid = in_place("--shape", [&] {
    return grid_of_size<2>({double(shape[0]) * step, double(shape[1]) * step}, step);
  });
  // A file's size is told as it is; a stream may have no end.
  const auto most = is_regular_input(path) ? 0 : std::size_t(grid.size()) * sizeof(float);
  const auto bytes = read_all(path, {}, most);
  const auto fast = settings.order == "z-fast" ? FastAxis::z : FastAxis::x;
  auto field = in_place(shown_input(path), [&] { return field_from_raw(bytes, grid, fast); });
  if (!settings.allow_rough)
    in_place("--shape: " + shown_input(path), [&] { check_raw_shape(bytes, grid, fast); });
  return field;
}

Field<2> read_segy(const Settings& settings, const std::string& path, const std::vector<char>& taken) {
  if (!settings.step_m) {
    throw Error(shown_input(path) + ": a SEG-Y model has no cell size; give --step", ErrorKind::usage);
  }
  segy::Reader reader(path, {}, {taken.begin(), taken.end()});
  std::vector<std::vector<double>> columns;
  for (segy::Trace trace; reader.next(trace);) columns.push_back(trace.samples);
  return in_place(shown_input(path), [&] { return field_from_columns(columns, *settings.step_m); });
}

InputUnits units_of(const Settings& settings) {
  if (settings.units.empty()) return {};
  return in_place("--units", [&] { return InputUnits::parse(settings.units); });
}

/// A property or stiffness from a file of any kind; `history` is what a netCDF file says of its own. Only
/// netCDF is in SI for sure.
Field<2> read_file(const Settings& settings, const std::string& given, const PropertyRow& row, double unit,
                   std::string& history) {
  const auto in_si = [unit](Field<2> field) {
    for (auto& value : field)
      if (unit != 1) value = float(double(value) * unit);
    return field;
  };
  if (!settings.shape.empty()) return in_si(read_raw(settings, given));
  std::string path = given, variable;
  std::error_code failed;
  if (const auto colon = given.rfind(':');
      colon != std::string::npos && !std::filesystem::exists(given, failed)) {
    path = given.substr(0, colon);
    variable = given.substr(colon + 1);
  }
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  if (begins_netcdf({first.data(), first.size()})) {
    const auto file = start.is_regular() ? NetcdfFile::open(path)
                                         : NetcdfFile::open(read_all(path, start.taken()), shown_input(path));
    history = file.text_attribute("", "history").value_or("");
    return field_from_netcdf(file, row, variable, settings.step_m, unit);
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (segy::looks_like_segy(bytes)) return in_si(read_segy(settings, path, start.taken()));
  throw Error(shown_input(path) + ": is neither netCDF nor SEG-Y; raw float32 needs --shape and --step");
}

/// The number that stands in place of a file, in SI.
std::optional<double> constant_of(const Settings& settings, Property property) {
  const auto& given = settings.file(property);
  if (row_of(property).if_absent && given == "inf") return PropertyRow::infinite;
  try {
    return parse_number(given) * units_of(settings).factor(property);
  } catch (const Error&) {
    return {};
  }
}

/// What is given of each property; constants that every model has, on the grid of the first file. `history`
/// is that of the file.
std::vector<std::optional<Field<2>>> read_given(const Settings& settings, std::string& history) {
  const auto units = units_of(settings);
  std::vector<std::optional<Field<2>>> fields(all_properties().size());
  std::optional<Grid<2>> grid;
  for (const Property property : all_properties()) {
    if (settings.file(property).empty() || constant_of(settings, property)) continue;
    std::string other;
    fields[std::size_t(property)] = read_file(settings, settings.file(property), row_of(property),
                                              units.factor(property), grid ? other : history);
    if (!grid) grid = fields[std::size_t(property)]->grid();
  }
  if (!grid && settings.of_stiffness()) return fields;
  if (!grid) throw Error("found constants only, expected a file of at least one property", ErrorKind::usage);
  for (const Property property : all_properties()) {
    if (row_of(property).if_absent || settings.file(property).empty()) continue;
    if (!fields[std::size_t(property)])
      fields[std::size_t(property)] = Field<2>(*grid, float(*constant_of(settings, property)));
  }
  return fields;
}

/// Speeds are 0 in void (rho 0); a constant can not say so.
void clear_void(Medium<2>& medium, const Settings& settings) {
  for (const Property property : {Property::vp, Property::vs}) {
    if (!constant_of(settings, property)) continue;
    for (std::size_t cell = 0; cell < std::size_t(medium.grid().size()); ++cell)
      if (medium.is_void(cell)) medium[property][cell] = 0;
  }
}

/// Of stiffnesses and densities, files or numbers.
Medium<2> read_stiffness(const Settings& settings, const std::optional<Field<2>>& given_rho,
                         std::string& history) {
  std::array<std::optional<Field<2>>, modulus_count> fields;
  std::array<std::optional<double>, modulus_count> numbers;
  std::optional<Grid<2>> grid;
  if (given_rho) grid = given_rho->grid();
  for (std::size_t n = 0; n < modulus_count; ++n) {
    const auto& given = settings.stiffness_files[n];
    if (given.empty()) continue;
    const double unit = units_of(settings).of_stiffness();
    try {
      numbers[n] = parse_number(given) * unit;
      continue;
    } catch (const Error&) {
      std::string other;
      fields[n] = read_file(settings, given, row_of(Modulus(n)), unit, grid ? other : history);
    }
    if (!grid) grid = fields[n]->grid();
    if (fields[n]->grid() == *grid) continue;
    throw Error(modulus_names()[n] + ": found " + shown(fields[n]->grid()) + ", expected " + shown(*grid) +
                " as of the first file");
  }
  if (!grid) throw Error("found constants only, expected a file of at least one of them", ErrorKind::usage);
  for (std::size_t n = 0; n < modulus_count; ++n)
    if (numbers[n]) fields[n] = Field<2>(*grid, float(*numbers[n]));
  return medium_of_stiffness(
      fields, given_rho ? *given_rho : Field<2>(*grid, float(*constant_of(settings, Property::rho))));
}

Medium<2> read_medium(const Settings& settings, std::string& history) {
  auto fields = read_given(settings, history);
  const auto taken = [&](Property property) { return std::move(fields[std::size_t(property)]); };
  auto medium = settings.of_stiffness() ? read_stiffness(settings, taken(Property::rho), history)
                                        : medium_of<2>(*taken(Property::vp), taken(Property::vs),
                                                       taken(Property::rho), settings.fluid_vp);
  if (!settings.of_stiffness()) clear_void(medium, settings);
  for (const Property property : all_properties()) {
    if (!row_of(property).if_absent || settings.file(property).empty()) continue;
    if (const auto value = constant_of(settings, property))
      add_constant(medium, property, *value);
    else
      add_property(medium, property, *taken(property));
  }
  if (!settings.q_from.empty()) in_place("--q-from-vs", [&] { add_q_from_vs(medium, settings.q_from); });
  return medium;
}

/// Rows follow what is given of surface and floor.
void fit(Model<2>& model, const Settings& settings, double sampled_m, const cli::Context& context) {
  if (settings.surface.empty() && settings.floor.empty()) return;
  ImportedHorizons horizons;
  horizons.sampled_m = sampled_m;
  horizons.find_floor = settings.floor == "found";
  if (!settings.surface.empty())
    horizons.surface = in_place("--surface", [&] { return parse_imported_horizon(settings.surface); });
  if (!settings.floor.empty() && !horizons.find_floor)
    horizons.floor = in_place("--floor", [&] { return parse_imported_horizon(settings.floor); });
  auto fitted = in_place(settings.floor.empty() ? "--surface" : "--floor",
                         [&] { return fit_imported(model, horizons); });
  for (const auto& sentence : fitted.warnings)
    context.warn(sentence + "; --floor found takes the floor of the cells");
  context.say(fitted.summary.empty() ? "nothing to fit: surface and floor lie on faces of cells"
                                     : fitted.summary);
  model = std::move(fitted.model);
}

template <int D>
void write(Model<D> model, const Settings& settings, const cli::Context& context, OutputFile& out) {
  model.title = settings.title;
  model.source = context.version;
  append_history(model.history, context.command_line);
  write_model(model, out);
  context.note(shown(model.grid()));
}

void run(const Settings& settings, const cli::Context& context) {
  check_choices(settings);
  OutputFile out(settings.output, OutputFile::Content::binary);
  Model<2> model;
  model.medium = read_medium(settings, model.history);
  auto limits = settings.limits;
  limits.in_space = settings.extrude_m.has_value();
  check(model, limits);
  const double sampled_m = model.grid().spacing_m;
  if (settings.resample_m)
    model =
        in_place("--resample", [&] { return resampled(model, *settings.resample_m, !settings.no_average); });
  if (!settings.crop.empty()) {
    model = in_place("--crop", [&] { return cropped(model, parse_box<2>(settings.crop)); });
  }
  fit(model, settings, sampled_m, context);
  if (!settings.extrude_m) return write(std::move(model), settings, context, out);
  Model<3> deep;
  deep.medium = in_place("--extrude", [&] { return extruded(model.medium, *settings.extrude_m); });
  deep.history = std::move(model.history);
  write(std::move(deep), settings, context, out);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-import", "Builds a model from files of vp, vs and density.",
       "--vp F [--vs F] [--rho F] [options] [-o M]",
       "sw-import --vp m.vp --vs m.vs --rho m.rho --shape 500x174 --step 20 --resample 5 -o model.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
