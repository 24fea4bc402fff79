// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_netcdf.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/geology_netcdf.hpp"
#include "grid/grid_netcdf.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_units.hpp"
#include "io/output_file.hpp"
#include "model/prestress.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

using Type = NetcdfFile::Type;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

template <int D>
void check_dimensions(const NetcdfFile& file, const std::string& name) {
  if (!file.has_variable(name))
    throw Error(file.shown_name() + ": found no variable '" + name + "', expected a model");
  const auto found = file.variable(name).dimensions;
  if (D == 2 && found == field_dimensions<3>())
    throw Error(file.shown_name() + ": found a model in 3-D, expected one in 2-D");
  if (found != field_dimensions<D>()) {
    throw Error(file.shown_name() + ": " + name + ": found dimensions (" + listed(found) + "), expected (" +
                listed(field_dimensions<D>()) + ")");
  }
}

/// Returns where the part of a variable that a grid stands for begins, and its lengths, the slowest axis
/// first.
template <int D>
std::array<std::vector<std::size_t>, 2> block_of(const Grid<D>& grid) {
  std::array<std::vector<std::size_t>, 2> block;
  for (int axis = D - 1; axis >= 0; --axis) {
    block[0].push_back(std::size_t(grid.first[std::size_t(axis)]));
    block[1].push_back(std::size_t(grid.shape[std::size_t(axis)]));
  }
  return block;
}

template <int D>
Field<D> read_field(const NetcdfFile& file, const Grid<D>& grid, const std::string& name,
                    const std::string& unit) {
  check_dimensions<D>(file, name);
  const auto [start, count] = block_of(grid);
  const auto values = file.get_physical(name, start, count);
  const auto conversion = conversion_of(file, name, unit);
  Field<D> field(grid);
  std::copy(values.begin(), values.end(), field.begin());
  for (auto& value : field)
    if (conversion.changes()) value = float(conversion(double(value)));
  return field;
}

/// A column of a slip constant: one value a slip system.
std::vector<double> read_column(const NetcdfFile& file, const std::string& name, std::size_t systems,
                                const std::string& unit, std::size_t width = 1) {
  auto values = file.get<double>(name);
  if (const auto conversion = conversion_of(file, name, unit); conversion.changes())
    for (auto& value : values) value = conversion(value);
  if (values.size() != systems * width) {
    throw Error(file.shown_name() + ": " + name + ": found " + std::to_string(values.size()) +
                " values, expected " + std::to_string(systems * width));
  }
  return values;
}

template <int D>
void define_property(NetcdfFile& file, const Field<D>& field, const std::string& name,
                     const std::string& long_name, const std::string& units) {
  file.define_variable(name, Type::f32, field_dimensions<D>());
  file.put_attribute(name, "_FillValue", std::vector<float>{std::numeric_limits<float>::quiet_NaN()});
  file.put_attribute(name, "long_name", long_name);
  file.put_attribute(name, "units", units);
  const auto [low, high] = std::minmax_element(field.begin(), field.end());
  file.put_attribute(name, "actual_range", std::vector<float>{*low, *high});
  put_coordinates(file, field.grid(), name);
}

template <int D>
bool any_opens(const std::vector<FractureSet<D>>& sets) {
  for (const auto& set : sets)
    for (const auto& system : set.systems)
      if (system.opens) return true;
  return false;
}

/// Whether any system has another law than Coulomb's, the only one that files without a law know.
template <int D>
bool any_law(const std::vector<FractureSet<D>>& sets) {
  for (const auto& set : sets)
    for (const auto& system : set.systems)
      if (system.law != FrictionLaw::coulomb) return true;
  return false;
}

/// A constant of linear slip: one value a slip system.
struct ComplianceColumn {
  const char *name, *long_name, *units;
  double LinearCompliance::*value;
};
constexpr ComplianceColumn compliance_columns[] = {
    {"slip_normal_compliance", "normal compliance of a plane", "m Pa-1", &LinearCompliance::normal_m_per_pa},
    {"slip_tangential_compliance", "tangential compliance of a plane", "m Pa-1",
     &LinearCompliance::tangential_m_per_pa},
    {"slip_normal_dashpot", "dashpot beside the normal compliance of a plane", "Pa s m-1",
     &LinearCompliance::normal_dashpot_pa_s_m},
    {"slip_tangential_dashpot", "dashpot beside the tangential compliance of a plane", "Pa s m-1",
     &LinearCompliance::tangential_dashpot_pa_s_m},
    {"slip_spacing", "distance between planes that have a compliance, or of which one lies on faces", "m",
     &LinearCompliance::spacing_m},
    {"slip_crack_density", "density of penny-shaped cracks", "1", &LinearCompliance::crack_density},
    {"slip_crack_aspect", "thickness of cracks over their diameter", "1", &LinearCompliance::aspect},
    {"slip_crack_fill", "bulk modulus of what fills the cracks, 0: dry", "Pa", &LinearCompliance::fill_pa}};

/// Whether any set has such constants: planes with friction on faces have a spacing at most.
template <int D>
bool any_gives(const std::vector<FractureSet<D>>& sets) {
  return std::any_of(sets.begin(), sets.end(), [](const auto& set) {
    return gives(set) || (set.on_faces && set.systems.front().compliance.spacing_m > 0);
  });
}

template <int D>
void put_compliances(NetcdfFile& file, const std::vector<FractureSet<D>>& sets) {
  if (!any_gives(sets)) return;
  for (const auto& column : compliance_columns) {
    std::vector<double> values;
    for (const auto& set : sets)
      for (const auto& system : set.systems) values.push_back(system.compliance.*column.value);
    file.put(column.name, values.data());
  }
}

template <int D>
void read_compliances(const NetcdfFile& file, std::vector<SlipSystem<D>>& systems) {
  for (const auto& column : compliance_columns) {
    if (!file.has_variable(column.name)) continue;
    const auto values = read_column(file, column.name, systems.size(), column.units);
    for (std::size_t i = 0; i < systems.size(); ++i) systems[i].compliance.*column.value = values[i];
  }
}

/// A blank ends a meaning in CF's flag_meanings.
std::string flag_word(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && std::string("_-.+@").find(c) == std::string::npos)
      c = '_';
  return name.empty() ? "_" : name;
}

/// What the codes 0, 1, 2, ... of a variable of type T mean, as CF has it.
template <class T>
void put_flags(NetcdfFile& file, const std::string& variable, const std::vector<std::string>& meanings) {
  std::vector<T> values;
  std::string words;
  for (const auto& meaning : meanings) {
    words += (values.empty() ? "" : " ") + flag_word(meaning);
    values.push_back(T(values.size()));
  }
  file.put_attribute(variable, "flag_values", values);
  file.put_attribute(variable, "flag_meanings", words);
}

template <int D>
std::size_t vertices_of(const std::vector<FractureSet<D>>& sets) {
  std::size_t sum = 0;
  for (const auto& set : sets)
    for (const auto& trace : set.traces) sum += trace.size();
  return sum;
}

template <int D>
bool any_on_faces(const std::vector<FractureSet<D>>& sets) {
  return std::any_of(sets.begin(), sets.end(), [](const auto& set) { return set.on_faces; });
}

/// Vertices of single fractures, one fracture after the other.
template <int D>
void define_traces(NetcdfFile& file, const std::vector<FractureSet<D>>& sets) {
  const auto vertices = vertices_of(sets);
  if (vertices == 0) return;
  file.define_dimension("fracture_trace_vertex", vertices);
  const auto define = [&](const std::string& name, Type type, const std::vector<std::string>& dimensions,
                          const std::string& long_name) {
    file.define_variable(name, type, dimensions, {false, {}});
    file.put_attribute(name, "long_name", long_name);
  };
  define("fracture_trace_set", Type::i32, {"fracture_trace_vertex"},
         "row of fracture_set the single fracture belongs to");
  define("fracture_trace_number", Type::i32, {"fracture_trace_vertex"},
         "number of the single fracture the vertex is of, from 0");
  define("fracture_trace_position", Type::f64, {"fracture_trace_vertex", "axis"},
         "vertex of a single fracture, in true depth");
  file.put_attribute("fracture_trace_position", "units", "m");
  if (!any_on_faces(sets)) return;
  define("fracture_on_faces", Type::u8, {"fracture_set"},
         "1: the single fractures of the set lie on faces between cells");
  put_flags<std::uint8_t>(file, "fracture_on_faces", {"in_cells", "on_faces"});
}

template <int D>
void put_traces(NetcdfFile& file, const std::vector<FractureSet<D>>& sets) {
  std::vector<int> owner, number;
  std::vector<double> position;
  int fractures = 0;
  for (std::size_t set = 0; set < sets.size(); ++set)
    for (const auto& trace : sets[set].traces) {
      for (const auto& vertex : trace) {
        owner.push_back(int(set));
        number.push_back(fractures);
        position.insert(position.end(), vertex.begin(), vertex.end());
      }
      ++fractures;
    }
  if (owner.empty()) return;
  file.put("fracture_trace_set", owner.data());
  file.put("fracture_trace_number", number.data());
  file.put("fracture_trace_position", position.data());
  if (!any_on_faces(sets)) return;
  std::vector<std::uint8_t> on_faces;
  for (const auto& set : sets) on_faces.push_back(set.on_faces ? 1 : 0);
  file.put("fracture_on_faces", on_faces.data());
}

template <int D>
void read_traces_of(const NetcdfFile& file, std::vector<FractureSet<D>>& sets) {
  if (!file.has_variable("fracture_trace_set")) return;
  const auto owner = file.get<int>("fracture_trace_set");
  const auto number = read_column(file, "fracture_trace_number", owner.size(), "1");
  const auto position = read_column(file, "fracture_trace_position", owner.size(), "m", D);
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] < 0 || std::size_t(owner[i]) >= sets.size())
      throw Error(file.shown_name() + ": fracture_trace_set: found " + std::to_string(owner[i]) +
                  ", expected 0 to " + std::to_string(std::int64_t(sets.size()) - 1));
    auto& traces = sets[std::size_t(owner[i])].traces;
    if (i == 0 || number[i] != number[i - 1] || owner[i] != owner[i - 1]) traces.emplace_back();
    Point<D> vertex{};
    for (std::size_t axis = 0; axis < D; ++axis) vertex[axis] = position[i * D + axis];
    traces.back().push_back(vertex);
  }
  if (!file.has_variable("fracture_on_faces")) return;
  const auto on_faces = read_column(file, "fracture_on_faces", sets.size(), "1");
  for (std::size_t set = 0; set < sets.size(); ++set) {
    if (on_faces[set] != 0 && on_faces[set] != 1)
      throw Error(file.shown_name() + ": fracture_on_faces: found " + shown(on_faces[set]) +
                  ", expected 0 or 1");
    sets[set].on_faces = on_faces[set] == 1;
  }
}

template <int D>
void define_sets(NetcdfFile& file, const Grid<D>& grid, const std::vector<FractureSet<D>>& sets) {
  std::size_t systems = 0;
  for (const auto& set : sets) systems += set.systems.size();
  file.define_dimension("fracture_set", sets.size());
  file.define_dimension("slip_system", systems);
  file.define_dimension("axis", D);
  // Not as bytes: readers of classic netCDF, ParaView's for one, know none without sign.
  file.define_variable("fracture", Type::i32, field_dimensions<D>());
  file.put_attribute("fracture", "long_name",
                     "fracture set of the cell, 0 = intact, k = row k-1 of fracture_set");
  std::vector<std::string> meanings = {"intact"};
  for (const auto& set : sets) meanings.push_back(set.name);
  put_flags<int>(file, "fracture", meanings);
  put_coordinates(file, grid, "fracture");
  file.define_variable("fracture_name", Type::text, {"fracture_set"});
  file.put_attribute("fracture_name", "long_name", "name of the fracture set");
  const auto define = [&](const std::string& name, Type type, const std::string& long_name,
                          const std::string& units) {
    std::vector<std::string> dimensions = {"slip_system"};
    if (name == "slip_normal") dimensions.push_back("axis");
    file.define_variable(name, type, dimensions, {false, {}});
    file.put_attribute(name, "long_name", long_name);
    if (!units.empty()) file.put_attribute(name, "units", units);
  };
  define("slip_set", Type::i32, "row of fracture_set the slip system belongs to", "");
  define("slip_normal", Type::f64, "unit normal of the slip planes", "1");
  define("slip_friction", Type::f64, "coefficient of friction", "1");
  define("slip_viscosity", Type::f64, "viscosity of slip", "s");
  define("slip_strength", Type::f64, "cohesion", "Pa");
  if (any_opens(sets)) {
    define("slip_opening", Type::u8, "1: the planes part under tension", "");
    put_flags<std::uint8_t>(file, "slip_opening", {"stay_closed", "part_under_tension"});
  }
  define_traces(file, sets);
  if (any_gives(sets))
    for (const auto& column : compliance_columns)
      define(column.name, Type::f64, column.long_name, column.units);
  if (!any_law(sets)) return;
  define("slip_law", Type::u8, "friction law: 0 Coulomb, 1 slip weakening, 2 none: the planes never slide",
         "");
  put_flags<std::uint8_t>(file, "slip_law", {"Coulomb", "slip_weakening", "none"});
  define("slip_dynamic_friction", Type::f64, "coefficient of friction after weakening", "1");
  define("slip_distance", Type::f64, "slip over which friction falls to the dynamic one", "m");
}

template <int D>
void put_sets(NetcdfFile& file, const Model<D>& model) {
  file.put("fracture", model.fracture.data());
  std::vector<std::string> names;
  std::vector<int> owner;
  std::vector<double> normal, friction, viscosity, strength;
  std::vector<double> dynamic_friction, distance;
  std::vector<std::uint8_t> opening, law;
  for (const auto& set : model.fracture_sets) {
    for (const auto& system : set.systems) {
      owner.push_back(int(names.size()));
      normal.insert(normal.end(), system.normal.begin(), system.normal.end());
      friction.push_back(system.friction);
      viscosity.push_back(system.viscosity_s);
      strength.push_back(system.strength_pa);
      opening.push_back(system.opens ? 1 : 0);
      law.push_back(std::uint8_t(system.law));
      dynamic_friction.push_back(system.dynamic_friction);
      distance.push_back(system.slip_distance_m);
    }
    names.push_back(set.name);
  }
  file.put_text("fracture_name", names);
  file.put("slip_set", owner.data());
  file.put("slip_normal", normal.data());
  file.put("slip_friction", friction.data());
  file.put("slip_viscosity", viscosity.data());
  file.put("slip_strength", strength.data());
  if (any_opens(model.fracture_sets)) file.put("slip_opening", opening.data());
  put_compliances(file, model.fracture_sets);
  put_traces(file, model.fracture_sets);
  if (!any_law(model.fracture_sets)) return;
  file.put("slip_law", law.data());
  file.put("slip_dynamic_friction", dynamic_friction.data());
  file.put("slip_distance", distance.data());
}

/// The friction law of each system.
template <int D>
void read_laws(const NetcdfFile& file, std::vector<SlipSystem<D>>& systems) {
  if (!file.has_variable("slip_law")) return;
  const auto law = read_column(file, "slip_law", systems.size(), "1");
  const auto friction = read_column(file, "slip_dynamic_friction", systems.size(), "1");
  const auto distance = read_column(file, "slip_distance", systems.size(), "m");
  for (std::size_t i = 0; i < systems.size(); ++i) {
    if (law[i] != 0 && law[i] != 1 && law[i] != 2)
      throw Error(file.shown_name() + ": slip_law: found " + shown(law[i]) +
                  ", expected 0 (Coulomb), 1 (slip weakening) or 2 (none)");
    systems[i].law = FrictionLaw(int(law[i]));
    systems[i].dynamic_friction = friction[i];
    systems[i].slip_distance_m = distance[i];
  }
}

std::string prestress_variable(const std::string& component) { return "prestress_" + component; }

/// All components or none.
template <int D>
std::vector<Field<D>> read_prestress(const NetcdfFile& file, const Grid<D>& grid) {
  const auto& names = stress_names<D>();
  const auto is_there = [&](const auto& name) { return file.has_variable(prestress_variable(name)); };
  std::vector<Field<D>> stress;
  if (std::none_of(names.begin(), names.end(), is_there)) return stress;
  for (const auto& name : names) stress.push_back(read_field(file, grid, prestress_variable(name), "Pa"));
  return stress;
}

}  // namespace

int dimension_of(const NetcdfFile& file) {
  return file.has_variable("y") && file.dimension_length("y") ? 3 : 2;
}

template <int D>
std::vector<FractureSet<D>> read_fracture_sets(const NetcdfFile& file) {
  std::vector<FractureSet<D>> sets;
  for (const auto& name : file.get_text("fracture_name")) sets.push_back({name, {}, {}});
  const auto owner = file.get<int>("slip_set");
  const auto normal = read_column(file, "slip_normal", owner.size(), "1", D);
  const auto friction = read_column(file, "slip_friction", owner.size(), "1");
  const auto viscosity = read_column(file, "slip_viscosity", owner.size(), "s");
  const auto strength = read_column(file, "slip_strength", owner.size(), "Pa");
  const auto opening = file.has_variable("slip_opening")
                           ? read_column(file, "slip_opening", owner.size(), "1")
                           : std::vector<double>(owner.size(), 0);
  std::vector<SlipSystem<D>> systems(owner.size());
  read_laws(file, systems);
  read_compliances(file, systems);
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] < 0 || std::size_t(owner[i]) >= sets.size()) {
      throw Error(file.shown_name() + ": slip_set: found " + std::to_string(owner[i]) + ", expected 0 to " +
                  std::to_string(std::int64_t(sets.size()) - 1));
    }
    auto& system = systems[i];
    for (std::size_t axis = 0; axis < D; ++axis) system.normal[axis] = normal[i * D + axis];
    system.friction = friction[i];
    system.viscosity_s = viscosity[i];
    system.strength_pa = strength[i];
    if (opening[i] != 0 && opening[i] != 1)
      throw Error(file.shown_name() + ": slip_opening: found " + shown(opening[i]) + ", expected 0 or 1");
    system.opens = opening[i] == 1;
    sets[std::size_t(owner[i])].systems.push_back(system);
  }
  read_traces_of(file, sets);
  return sets;
}

template <int D>
Grid<D> read_model_grid(const NetcdfFile& file) {
  check_dimensions<D>(file, row_of(Property::vp).name);
  return read_grid<D>(file);
}

namespace {

/// What a file holds of a grid or a part of it.
template <int D>
Model<D> read_on(const NetcdfFile& file, const Grid<D>& grid) {
  Model<D> model;
  for (const Property property : all_properties()) {
    const auto& row = row_of(property);
    if (row.if_absent && !file.has_variable(row.name)) continue;
    model.medium[property] = read_field(file, grid, row.name, row.units);
  }
  complete_anisotropy(model.medium);
  if (file.has_variable("fracture")) {
    check_dimensions<D>(file, "fracture");
    const auto [start, count] = block_of(grid);
    const auto codes = file.get<std::uint8_t>("fracture", start, count);
    model.fracture = Field<D, std::uint8_t>(grid);
    std::copy(codes.begin(), codes.end(), model.fracture.begin());
    model.fracture_sets = read_fracture_sets<D>(file);
    if (file.has_variable("fracture_share"))
      model.fracture_share = read_field(file, grid, "fracture_share", "1");
    model.prestress_pa = read_prestress(file, grid);
  }
  model.title = file.text_attribute("", "title").value_or("");
  model.source = file.text_attribute("", "source").value_or("");
  model.history = file.text_attribute("", "history").value_or("");
  model.geology = read_geology(file);
  return model;
}

}  // namespace

template <int D>
Model<D> read_model(const NetcdfFile& file) {
  return read_on(file, read_model_grid<D>(file));
}

template <int D>
Model<D> read_model_rows(const NetcdfFile& file, std::int64_t first, std::int64_t last) {
  auto grid = read_model_grid<D>(file);
  grid.first[D - 1] = first;
  grid.shape[D - 1] = last - first;
  return read_on(file, grid);
}

template <int D>
Model<D> read_model(const std::string& path) {
  return read_model<D>(NetcdfFile::open(path));
}

template <int D>
void write_model(const Model<D>& model, OutputFile& out) {
  auto file = NetcdfFile::create(out.path_for_libraries(), out.shown_name());
  const bool fractured = !model.fracture.empty() && !model.fracture_sets.empty();
  file.put_attribute("", "Conventions", conventions_of(model.grid()));
  if (!model.title.empty()) file.put_attribute("", "title", model.title);
  if (!model.source.empty()) file.put_attribute("", "source", model.source);
  if (!model.history.empty()) file.put_attribute("", "history", model.history);
  define_grid(file, model.grid());
  const auto properties = model.medium.properties();
  for (const Property property : properties) {
    const auto& row = row_of(property);
    define_property(file, model.medium[property], row.name, row.long_name, row.units);
  }
  if (fractured) define_sets(file, model.grid(), model.fracture_sets);
  const bool any_cut = fractured && !model.fracture_share.empty();
  if (any_cut)
    define_property(file, model.fracture_share, "fracture_share",
                    "share of the cell in which the planes of its fracture set slip", "1");
  for (std::size_t c = 0; fractured && c < model.prestress_pa.size(); ++c) {
    const auto& name = stress_names<D>()[c];
    define_property(file, model.prestress_pa[c], prestress_variable(name),
                    "static stress " + name + ", tension positive", "Pa");
  }
  define_geology(file, model.geology);
  put_grid(file, model.grid());
  for (const Property property : properties) file.put(row_of(property).name, model.medium[property].data());
  if (fractured) put_sets(file, model);
  put_geology(file, model.geology);
  if (any_cut) file.put("fracture_share", model.fracture_share.data());
  for (std::size_t c = 0; fractured && c < model.prestress_pa.size(); ++c)
    file.put(prestress_variable(stress_names<D>()[c]), model.prestress_pa[c].data());
  file.close();
  out.commit();
}

template <int D>
void write_model(const Model<D>& model, const std::string& path) {
  OutputFile out(path, OutputFile::Content::binary);
  write_model(model, out);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, read_fracture_sets);
SLIPWAVE_INSTANTIATE_D(FUNCTION, read_model_grid);
SLIPWAVE_INSTANTIATE_D(FUNCTION, read_model_rows);
template Model<2> read_model<2>(const NetcdfFile&);
template Model<3> read_model<3>(const NetcdfFile&);
template Model<2> read_model<2>(const std::string&);
template Model<3> read_model<3>(const std::string&);
template void write_model(const Model<2>&, OutputFile&);
template void write_model(const Model<3>&, OutputFile&);
template void write_model(const Model<2>&, const std::string&);
template void write_model(const Model<3>&, const std::string&);

}  // namespace slipwave
