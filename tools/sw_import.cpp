// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/error.hpp"
#include "base/history.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"
#include "build/import.hpp"
#include "build/import_fit.hpp"
#include "build/raw_shape.hpp"
#include "build/resample.hpp"
#include "cli/tool.hpp"
#include "geology/layers.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "rock/input_units.hpp"
#include "rock/property_range.hpp"
#include "rock/relations.hpp"
#include "rock/stiffness_input.hpp"
#include "segy/reader.hpp"
#include "segy/sniff.hpp"
#include "traces/section_input.hpp"

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
  options.add("shape", settings.shape, "NXxNZ",
              "number of cells of raw files (little-endian float32), of volumes NXxNYxNZ");
  options.add_choice("order", settings.order, {"z-fast", "x-fast"}, "fastest axis in raw files");
  options.add("step", settings.step_m, "H", "cell size, m, of raw files and SEG-Y");
  options.add(
      "units", settings.units, "LIST",
      "units of numbers that name none (raw, SEG-Y, constants) instead of m/s, kg/m3 and Pa: km/s,g/cm3,GPa");
  options.add("allow-rough", settings.allow_rough,
              "take --shape even if neighbouring columns then differ, and traces of SEG-Y as columns "
              "whatever their headers say");
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
  options.add(
      "crop", settings.crop, "X0:X1,Z0:Z1",
      "keep only this box (of a volume X0:X1,Y0:Y1,Z0:Z1), after resampling; its top becomes the surface");
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
  options.needs("order", {"shape"});
  options.needs("no-average", {"resample"});
  options.needs("fluid-vp", {"vs-from-vp"});
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
        !settings.file(property).empty() && !(turns_axes(property) && !given.are_of_any_rock()))
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

InputUnits units_of(const Settings& settings) {
  if (settings.units.empty()) return {};
  return in_place("--units", [&] { return InputUnits::parse(settings.units); });
}

template <int D>
Field<D> read_raw(const Settings& settings, const std::string& path) {
  const auto shape = in_place("--shape", [&] { return parse_shape<D>(settings.shape); });
  const double step = *settings.step_m;
  Point<D> size{};
  for (std::size_t axis = 0; axis < D; ++axis) size[axis] = double(shape[axis]) * step;
  const auto grid = in_place("--shape", [&] { return grid_of_size<D>(size, step); });
  // A file's size is told as it is; a stream may have no end.
  const auto most = is_regular_input(path) ? 0 : std::size_t(grid.size()) * sizeof(float);
  const auto bytes = read_all(path, {}, most);
  const auto fast = settings.order == "z-fast" ? FastAxis::z : FastAxis::x;
  auto field = in_place(shown_input(path), [&] { return field_from_raw(bytes, grid, fast); });
  if (!settings.allow_rough)
    in_place("--shape: " + shown_input(path), [&] { check_raw_shape(bytes, grid, fast); });
  return field;
}

ImportedField read_raw(const Settings& settings, const std::string& path) {
  const bool is_section = split(settings.shape, 'x').size() != 3;
  auto field =
      is_section ? imported_from(read_raw<2>(settings, path)) : imported_from(read_raw<3>(settings, path));
  field.placed = false;
  return field;
}

/// What numbers of a property are in, where their file does not say it.
struct NumberUnit {
  std::optional<double> given;  // by --units
  bool is_speed = false;
  double factor() const { return given.value_or(1); }
};

NumberUnit unit_of(const Settings& settings, Property property) {
  return {units_of(settings).given(property), row_of(property).units == row_of(Property::vp).units};
}

void scale(ImportedField& field, double factor) {
  for (auto& value : field.values)
    if (factor != 1) value = float(double(value) * factor);
}

ImportedField read_segy(const Settings& settings, const std::string& path, const std::vector<char>& taken,
                        const NumberUnit& unit) {
  if (!settings.step_m) {
    throw Error(shown_input(path) + ": a SEG-Y model has no cell size; give --step", ErrorKind::usage);
  }
  segy::Reader reader(path, {}, {taken.begin(), taken.end()});
  auto field = read_section(reader, *settings.step_m, !settings.allow_rough);
  for (auto& doubt : reader.doubts()) field.said.push_back(std::move(doubt));
  const bool in_feet = reader.header().feet && unit.is_speed && !unit.given;
  if (in_feet)
    field.said.emplace_back(
        "the measurement system is feet (byte 3255): speeds are taken in ft/s; --units m/s says otherwise");
  constexpr double foot_m = 0.3048;
  scale(field, in_feet ? foot_m : unit.factor());
  return field;
}

/// A property or stiffness from a file of any kind; `history` is what a netCDF file says of its own. Only
/// netCDF is in SI for sure.
ImportedField read_file(const Settings& settings, const std::string& given, const PropertyRow& row,
                        const NumberUnit& unit, std::string& history) {
  if (!settings.shape.empty()) {
    auto field = read_raw(settings, given);
    if (unit.is_speed)
      if (auto doubt = doubt_of_depth(field.values); !doubt.empty()) field.said.push_back(std::move(doubt));
    scale(field, unit.factor());
    return field;
  }
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
    return field_from_netcdf(file, row, variable, settings.step_m, unit.factor());
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (segy::looks_like_segy(bytes)) return read_segy(settings, path, start.taken(), unit);
  throw Error(shown_input(path) + ": is neither netCDF nor SEG-Y; raw float32 needs --shape and --step");
}

/// The number that stands in place of a file, in SI.
std::optional<double> constant_of(const Settings& settings, Property property) {
  const auto& given = settings.file(property);
  const auto& row = row_of(property);
  if (row.if_absent == PropertyRow::infinite && given == "inf") return PropertyRow::infinite;
  if (!is_number(given)) return {};
  const double value = parse_number(given) * units_of(settings).factor(property);
  if (!is_in_range(row, value))
    throw Error("--" + row.name + ": found " + given + ", expected " + expected_values(row),
                ErrorKind::usage);
  return value;
}

/// What is read of all files.
struct Inputs {
  std::vector<std::optional<ImportedField>> fields =
      std::vector<std::optional<ImportedField>>(all_properties().size());  // by property
  std::array<std::optional<ImportedField>, modulus_count> stiffness;       // by Modulus
  std::string history;                                                     // of the first netCDF file
  std::vector<std::string> said;

  std::vector<std::pair<std::string, ImportedField*>> all() {
    std::vector<std::pair<std::string, ImportedField*>> all;
    for (const Property property : all_properties())
      if (auto& field = fields[std::size_t(property)]) all.emplace_back(row_of(property).name, &*field);
    for (std::size_t n = 0; n < modulus_count; ++n)
      if (stiffness[n]) all.emplace_back(modulus_names()[n], &*stiffness[n]);
    return all;
  }
};

/// All files must be of one model. Those that do not say where they begin begin where the others do.
void check_places(Inputs& inputs) {
  const auto all = inputs.all();
  const auto& [first_name, first] = all.front();
  const auto placed = std::find_if(all.begin(), all.end(), [](const auto& of) { return of.second->placed; });
  const auto* const from = placed == all.end() ? first : placed->second;
  const auto where = [](const Grid<3>& grid, bool is_section) {
    return "x=" + shown(grid.origin_m[0]) + (is_section ? "" : " y=" + shown(grid.origin_m[1])) +
           " z=" + shown(grid.origin_m[2]);
  };
  const auto begin = from->values.grid();
  for (const auto& [name, field] : all) {
    if (field->is_section != first->is_section)
      throw Error(name + ": found a " + (field->is_section ? "section" : "volume") + ", expected a " +
                  (first->is_section ? "section" : "volume") + " as of " + first_name);
    const auto grid = field->values.grid();
    bool same = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      same = same && std::abs(grid.origin_m[axis] - begin.origin_m[axis]) <= 1e-3 * grid.spacing_m;
    if (field->placed && !same)
      throw Error(name + ": begins at " + where(grid, field->is_section) + ", expected " +
                  where(begin, field->is_section) + " as of " + placed->first);
    place_at(*field, begin.origin_m);
  }
}

Inputs read_inputs(const Settings& settings) {
  Inputs inputs;
  bool any = false;
  const auto read = [&](const std::string& file, const PropertyRow& row, const NumberUnit& unit) {
    std::string other;
    auto field = read_file(settings, file, row, unit, any ? other : inputs.history);
    any = true;
    for (const auto& sentence : field.said)
      if (std::find(inputs.said.begin(), inputs.said.end(), sentence) == inputs.said.end())
        inputs.said.push_back(shown_input(file) + ": " + sentence);
    return field;
  };
  for (const Property property : all_properties())
    if (!settings.file(property).empty() && !constant_of(settings, property))
      inputs.fields[std::size_t(property)] =
          read(settings.file(property), row_of(property), unit_of(settings, property));
  const NumberUnit of_stiffness{units_of(settings).of_stiffness(), false};
  for (std::size_t n = 0; n < modulus_count; ++n)
    if (const auto& file = settings.stiffness_files[n]; !file.empty() && !is_number(file))
      inputs.stiffness[n] = read(file, row_of(Modulus(n)), of_stiffness);
  if (!any)
    throw Error("found constants only, expected a file of at least one " +
                    std::string(settings.of_stiffness() ? "of them" : "property"),
                ErrorKind::usage);
  check_places(inputs);
  return inputs;
}

/// Speeds are 0 in void (rho 0); a constant cannot say so.
template <int D>
void clear_void(Medium<D>& medium, const Settings& settings) {
  for (const Property property : {Property::vp, Property::vs}) {
    if (!constant_of(settings, property)) continue;
    for (std::size_t cell = 0; cell < std::size_t(medium.grid().size()); ++cell)
      if (medium.is_void(cell)) medium[property][cell] = 0;
  }
}

/// Of stiffnesses and densities, files or numbers.
template <int D>
Medium<D> read_stiffness(const Settings& settings, const Inputs& inputs, const Grid<D>& grid,
                         const std::optional<Field<D>>& given_rho) {
  std::array<std::optional<Field<D>>, modulus_count> fields;
  const double unit = units_of(settings).of_stiffness();
  for (std::size_t n = 0; n < modulus_count; ++n) {
    const auto& given = settings.stiffness_files[n];
    if (given.empty()) continue;
    fields[n] = inputs.stiffness[n] ? field_of<D>(*inputs.stiffness[n])
                                    : Field<D>(grid, float(parse_number(given) * unit));
    if (fields[n]->grid() == grid) continue;
    throw Error(modulus_names()[n] + ": found " + shown(fields[n]->grid()) + ", expected " + shown(grid) +
                " as of the first file");
  }
  return medium_of_stiffness<D>(
      fields, given_rho ? *given_rho : Field<D>(grid, float(*constant_of(settings, Property::rho))));
}

template <int D>
Medium<D> read_medium(const Settings& settings, Inputs& inputs) {
  const auto grid = grid_of<D>(*inputs.all().front().second);
  const auto taken = [&](Property property) -> std::optional<Field<D>> {
    auto& field = inputs.fields[std::size_t(property)];
    if (field) return field_of<D>(*std::exchange(field, std::nullopt));
    if (row_of(property).if_absent || settings.file(property).empty()) return {};
    return Field<D>(grid, float(*constant_of(settings, property)));
  };
  Medium<D> medium;
  if (!settings.of_stiffness()) {
    auto vp = taken(Property::vp), vs = taken(Property::vs), rho = taken(Property::rho);
    medium = medium_of<D>(std::move(*vp), std::move(vs), std::move(rho), settings.fluid_vp);
    clear_void(medium, settings);
  } else {
    medium = read_stiffness<D>(settings, inputs, grid, taken(Property::rho));
  }
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

/// A model begins at the surface: says which depth of the files that is.
void begin_at_surface(Inputs& inputs, const cli::Context& context) {
  for (const auto& sentence : inputs.said) context.say(sentence);
  const auto begin = inputs.all().front().second->values.grid().origin_m;
  if (begin[2] == 0) return;
  context.say("depth " + shown(begin[2]) + " m of the files" +
              (begin[2] < 0 ? " (a height of " + shown(-begin[2]) + " m)" : "") +
              " became 0, the surface of the model");
  for (const auto& [name, field] : inputs.all()) place_at(*field, {begin[0], begin[1], 0});
}

template <int D>
void build(const Settings& settings, const cli::Context& context, Inputs inputs, OutputFile& out) {
  Model<D> model;
  model.history = inputs.history;
  model.medium = read_medium<D>(settings, inputs);
  auto limits = settings.limits;
  limits.in_3d = D == 3 || settings.extrude_m.has_value();
  check(model, limits);
  const double sampled_m = model.grid().spacing_m;
  if (settings.resample_m)
    model =
        in_place("--resample", [&] { return resampled(model, *settings.resample_m, !settings.no_average); });
  Geology geology = {.maker = Maker::sw_import, .sampled_m = sampled_m};
  if (model.grid().spacing_m != sampled_m)
    geology.resampling = model.grid().spacing_m > sampled_m && !settings.no_average
                             ? CellResampling::averaged
                             : CellResampling::interpolated;
  if (!settings.crop.empty()) {
    model = in_place("--crop", [&] { return cropped(model, parse_box<D>(settings.crop)); });
  }
  if constexpr (D == 2) {
    fit(model, settings, sampled_m, context);
    if (settings.extrude_m) {
      Model<3> deep;
      deep.medium = in_place("--extrude", [&] { return extruded(model.medium, *settings.extrude_m); });
      deep.history = std::move(model.history);
      deep.geology = geology;
      return write(std::move(deep), settings, context, out);
    }
  }
  model.geology = geology;
  write(std::move(model), settings, context, out);
}

void run(const Settings& settings, const cli::Context& context) {
  check_choices(settings);
  OutputFile out(settings.output, OutputFile::Content::binary);
  auto inputs = read_inputs(settings);
  begin_at_surface(inputs, context);
  if (inputs.all().front().second->is_section) return build<2>(settings, context, std::move(inputs), out);
  for (const auto& [given, name] :
       {std::pair(settings.extrude_m.has_value(), "--extrude"),
        std::pair(!settings.surface.empty(), "--surface"), std::pair(!settings.floor.empty(), "--floor")})
    if (given)
      throw Error(std::string("found ") + name + " and a volume, expected a section with it",
                  ErrorKind::usage);
  build<3>(settings, context, std::move(inputs), out);
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
