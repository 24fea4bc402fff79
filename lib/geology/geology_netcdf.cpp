// SPDX-License-Identifier: BSD-3-Clause
#include "geology/geology_netcdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/netcdf_file.hpp"
#include "rock/property_range.hpp"

namespace slipwave {
namespace {

using Type = NetcdfFile::Type;

const std::string container = "geology";
/// Tops of layers as messages name them, one a line.
const std::string tops_name = "layer_tops";
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

template <class Value>
struct Named {
  const char* name;
  Value value;
};
constexpr std::array<Named<Maker>, 3> makers = {
    {{"sw-layers", Maker::sw_layers}, {"sw-marmousi", Maker::sw_marmousi}, {"sw-import", Maker::sw_import}}};
constexpr std::array<Named<CellResampling>, 3> resamplings = {
    {{"none", CellResampling::none},
     {"averaged", CellResampling::averaged},
     {"interpolated", CellResampling::interpolated}}};
constexpr std::array<Named<bool FitChoice::*>, 3> roles = {
    {{"surface", &FitChoice::surfaces}, {"floor", &FitChoice::floors}, {"layer", &FitChoice::layers}}};

/// A number of a layer that says where its top is or what its rock is; a column is absent where all have the
/// usual one.
struct LayerColumn {
  const char *name, *long_name, *units;
  double usual;
  double HorizonShape::*of_top;  // or, of rock,
  Material Layer::*rock = nullptr;
  double Material::*of_rock = nullptr;
};
constexpr double needed = not_given;  // equal to no value: the column is always there
constexpr LayerColumn layer_columns[] = {
    {"layer_depth", "depth of the plane of the top at x = 0", "m", needed, &HorizonShape::depth_m},
    {"layer_dip", "dip of that plane, deepening towards +x", "degree", 0, &HorizonShape::dip_deg},
    {"layer_amplitude", "amplitude of a sine along x that is added to it", "m", 0,
     &HorizonShape::amplitude_m},
    {"layer_wavelength", "wavelength of that sine", "m", 1, &HorizonShape::wavelength_m},
    {"layer_phase", "phase of that sine at x = 0", "degree", 0, &HorizonShape::phase_deg},
    {"layer_vp", "P-wave speed at the top", "m s-1", needed, nullptr, &Layer::material, &Material::vp},
    {"layer_vs", "S-wave speed at the top", "m s-1", needed, nullptr, &Layer::material, &Material::vs},
    {"layer_rho", "density at the top", "kg m-3", needed, nullptr, &Layer::material, &Material::rho},
    {"layer_vp_gradient", "what vp gains with depth below the top", "s-1", 0, nullptr, &Layer::gradient,
     &Material::vp},
    {"layer_vs_gradient", "what vs gains with depth below the top", "s-1", 0, nullptr, &Layer::gradient,
     &Material::vs},
    {"layer_rho_gradient", "what rho gains with depth below the top", "kg m-4", 0, nullptr, &Layer::gradient,
     &Material::rho}};

double value_of(const LayerColumn& column, const Layer& layer) {
  return column.of_top ? layer.top.shape().*column.of_top : layer.*column.rock.*column.of_rock;
}

bool is_written(const LayerColumn& column, const std::vector<Layer>& layers) {
  return !std::all_of(layers.begin(), layers.end(),
                      [&](const Layer& layer) { return value_of(column, layer) == column.usual; });
}

/// What a layer gives of a property besides vp, vs and rho.
double given(const Layer& layer, Property property) {
  for (const auto& [of, value] : layer.others)
    if (of == property) return value;
  return not_given;
}

/// Returns the properties that any layer gives.
std::vector<Property> given_properties(const std::vector<Layer>& layers) {
  auto all = all_properties();
  std::erase_if(all, [&](Property property) {
    return std::all_of(layers.begin(), layers.end(),
                       [&](const Layer& layer) { return std::isnan(given(layer, property)); });
  });
  return all;
}

std::string variable_of(Property property) { return "layer_" + row_of(property).name; }

/// Names of the variables of the grid that a layer's top follows.
struct GridNames {
  std::string depth, x, y;
  explicit GridNames(std::size_t layer)
      : depth("layer_" + std::to_string(layer + 1) + "_depth"), x(depth + "_x"), y(depth + "_y") {}
};

bool any_smooth(const std::vector<Layer>& layers) {
  return std::any_of(layers.begin(), layers.end(),
                     [](const Layer& layer) { return layer.top.shape().smooth; });
}

std::size_t points_of(const std::vector<Layer>& layers) {
  std::size_t count = 0;
  for (const auto& layer : layers) count += layer.top.shape().points_m.size();
  return count;
}

std::size_t samples_of(const std::vector<Layer>& layers) {
  std::size_t count = 0;
  for (const auto& layer : layers)
    if (layer.log) count += layer.log->depths_m.size();
  return count;
}

/// What a log says of rock.
struct LogColumn {
  const char *name, *long_name, *units;
  double Material::*of;
};
constexpr LogColumn log_columns[] = {{"layer_log_vp", "P-wave speed of a sample", "m s-1", &Material::vp},
                                     {"layer_log_vs", "S-wave speed of a sample", "m s-1", &Material::vs},
                                     {"layer_log_rho", "density of a sample", "kg m-3", &Material::rho}};

void define(NetcdfFile& file, const std::string& name, const std::vector<std::string>& dimensions,
            const std::string& long_name, const std::string& units, Type type = Type::f64) {
  file.define_variable(name, type, dimensions, {false, {}});
  file.put_attribute(name, "long_name", long_name);
  if (!units.empty()) file.put_attribute(name, "units", units);
}

/// Defines the variables of layers whose blocks are made of a log.
void define_logs(NetcdfFile& file, const std::vector<Layer>& layers) {
  const auto samples = samples_of(layers);
  if (samples == 0) return;
  define(file, "layer_log_block", {"layer"}, "thickness of blocks that a log is averaged over; 0: cells",
         "m");
  define(file, "layer_log_backus", {"layer"}, "1: averages of flat layers (Backus), with their anisotropy",
         "", Type::u8);
  file.define_dimension("layer_log_sample", samples);
  const std::vector<std::string> along = {"layer_log_sample"};
  define(file, "layer_log_of", along, "layer that the sample of a log is of, from 0", "", Type::i32);
  define(file, "layer_log_depth", along, "depth of a sample", "m");
  for (const auto& column : log_columns) define(file, column.name, along, column.long_name, column.units);
}

void put_logs(NetcdfFile& file, const std::vector<Layer>& layers) {
  if (samples_of(layers) == 0) return;
  std::vector<double> blocks, backus, depths;
  std::vector<int> owner;
  for (std::size_t n = 0; n < layers.size(); ++n) {
    const auto log = layers[n].log.value_or(LayerLog());
    blocks.push_back(log.block_m.value_or(0));
    backus.push_back(log.layered);
    depths.insert(depths.end(), log.depths_m.begin(), log.depths_m.end());
    owner.insert(owner.end(), log.depths_m.size(), int(n));
  }
  file.put("layer_log_block", blocks.data());
  file.put("layer_log_backus", backus.data());
  file.put("layer_log_of", owner.data());
  file.put("layer_log_depth", depths.data());
  for (const auto& column : log_columns) {
    std::vector<double> values;
    for (const auto& layer : layers)
      if (layer.log)
        for (const auto& material : layer.log->materials) values.push_back(material.*column.of);
    file.put(column.name, values.data());
  }
}

void define_layers(NetcdfFile& file, const std::vector<Layer>& layers) {
  file.define_dimension("layer", layers.size());
  // An attribute, since older kinds of netCDF have no variables of text.
  std::string tops;
  for (const auto& layer : layers) tops += (tops.empty() ? "" : "\n") + layer.top.name();
  file.put_attribute(container, tops_name, tops);
  for (const auto& column : layer_columns)
    if (is_written(column, layers)) define(file, column.name, {"layer"}, column.long_name, column.units);
  for (const auto property : given_properties(layers))
    define(file, variable_of(property), {"layer"}, row_of(property).long_name + "; NaN: not given",
           row_of(property).units);
  define_logs(file, layers);
  if (any_smooth(layers))
    define(file, "layer_smooth", {"layer"}, "1: the top has continuous slopes between points or nodes", "",
           Type::u8);
  if (const auto points = points_of(layers)) {
    file.define_dimension("layer_point", points);
    define(file, "layer_point_of", {"layer_point"}, "layer whose top the point is of, from 0", "", Type::i32);
    define(file, "layer_point_x", {"layer_point"}, "x of a point of a curve", "m");
    define(file, "layer_point_depth", {"layer_point"}, "what the curve adds to the plane at the point", "m");
  }
  for (std::size_t n = 0; n < layers.size(); ++n) {
    const auto& grid = layers[n].top.shape().grid;
    if (!grid) continue;
    const GridNames names(n);
    file.define_dimension(names.x, grid->x_m().size());
    file.define_dimension(names.y, grid->y_m().size());
    define(file, names.x, {names.x}, "x of nodes of the top of a layer", "m");
    define(file, names.y, {names.y}, "y of nodes of the top of a layer", "m");
    file.define_variable(names.depth, Type::f64, {names.y, names.x});
    file.put_attribute(names.depth, "long_name", "what the grid adds to the plane of the top at its nodes");
    file.put_attribute(names.depth, "units", "m");
  }
}

void put_layers(NetcdfFile& file, const std::vector<Layer>& layers) {
  const auto put = [&](const std::string& name, const auto& value) {
    std::vector<double> values;
    for (const auto& layer : layers) values.push_back(value(layer));
    file.put(name, values.data());
  };
  for (const auto& column : layer_columns)
    if (is_written(column, layers))
      put(column.name, [&](const Layer& layer) { return value_of(column, layer); });
  for (const auto property : given_properties(layers))
    put(variable_of(property), [&](const Layer& layer) { return given(layer, property); });
  put_logs(file, layers);
  if (any_smooth(layers)) put("layer_smooth", [](const Layer& layer) { return layer.top.shape().smooth; });
  std::vector<int> owner;
  std::vector<double> x, depth;
  for (std::size_t n = 0; n < layers.size(); ++n) {
    const auto& shape = layers[n].top.shape();
    for (const auto& point : shape.points_m)
      owner.push_back(int(n)), x.push_back(point[0]), depth.push_back(point[1]);
    if (!shape.grid) continue;
    const GridNames names(n);
    file.put(names.x, shape.grid->x_m().data());
    file.put(names.y, shape.grid->y_m().data());
    file.put(names.depth, shape.grid->depths_m().data());
  }
  if (owner.empty()) return;
  file.put("layer_point_of", owner.data());
  file.put("layer_point_x", x.data());
  file.put("layer_point_depth", depth.data());
}

[[noreturn]] void refuse(const NetcdfFile& file, const std::string& variable, const std::string& what) {
  throw Error(file.shown_name() + ": " + variable + ": " + what);
}

/// Finite numbers, as many as another variable has.
std::vector<double> numbers(const NetcdfFile& file, const std::string& name, std::size_t count,
                            bool all_finite = true) {
  auto values = file.get<double>(name);
  if (values.size() != count)
    refuse(file, name,
           "found " + std::to_string(values.size()) + " values, expected " + std::to_string(count));
  for (const double value : values)
    if (all_finite && !std::isfinite(value))
      refuse(file, name, "found " + shown(value) + ", expected a finite number");
  return values;
}

/// The layer that a value of a table of several is of.
std::size_t layer_in(const NetcdfFile& file, const std::string& variable, int owner, std::size_t layers) {
  if (owner < 0 || std::size_t(owner) >= layers)
    refuse(file, variable,
           "found " + std::to_string(owner) + ", expected 0 to " + std::to_string(layers - 1));
  return std::size_t(owner);
}

/// Curves and grids of tops.
void read_shapes(const NetcdfFile& file, std::vector<HorizonShape>& shapes) {
  if (file.has_variable("layer_smooth")) {
    const auto smooth = numbers(file, "layer_smooth", shapes.size());
    for (std::size_t n = 0; n < shapes.size(); ++n) shapes[n].smooth = smooth[n] != 0;
  }
  if (file.has_variable("layer_point_of")) {
    const auto owner = file.get<int>("layer_point_of");
    const auto x = numbers(file, "layer_point_x", owner.size());
    const auto depth = numbers(file, "layer_point_depth", owner.size());
    for (std::size_t i = 0; i < owner.size(); ++i) {
      auto& points = shapes[layer_in(file, "layer_point_of", owner[i], shapes.size())].points_m;
      if (!points.empty() && !(x[i] > points.back()[0]))
        refuse(file, "layer_point_x",
               "found " + shown(x[i]) + " after " + shown(points.back()[0]) +
                   ", expected x to ascend within a layer");
      points.push_back({x[i], depth[i]});
    }
    for (const auto& shape : shapes)
      if (shape.points_m.size() == 1)
        refuse(file, "layer_point_of", "found 1 point of a curve, expected at least 2");
  }
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const GridNames names(n);
    if (!file.has_variable(names.depth)) continue;
    auto x = file.get<double>(names.x), y = file.get<double>(names.y);
    auto depths = numbers(file, names.depth, x.size() * y.size());
    shapes[n].grid = in_place(file.shown_name() + ": " + names.depth,
                              [&] { return DepthGrid(std::move(x), std::move(y), std::move(depths)); });
  }
}

void check_log(const NetcdfFile& file, const LayerLog& log) {
  const auto& depths = log.depths_m;
  for (std::size_t n = 1; n < depths.size(); ++n)
    if (!(depths[n] > depths[n - 1]))
      refuse(file, "layer_log_depth",
             "found " + shown(depths[n]) + " after " + shown(depths[n - 1]) + ", expected depths to ascend");
  for (const auto& rock : log.materials) {
    for (const auto& [property, value] :
         {std::pair(Property::vp, rock.vp), {Property::vs, rock.vs}, {Property::rho, rock.rho}})
      if (!(value >= 0) || (property != Property::vs && value == 0))
        refuse(file, "layer_log_" + row_of(property).name,
               "found " + shown(value) + ", expected a speed or density");
    if ((rock.vs == 0) != (log.materials.front().vs == 0))
      refuse(file, "layer_log_vs", "found fluid beside rock, expected one of them");
  }
}

void read_logs(const NetcdfFile& file, std::vector<Layer>& layers) {
  if (!file.has_variable("layer_log_of")) return;
  const auto blocks = numbers(file, "layer_log_block", layers.size());
  const auto backus = numbers(file, "layer_log_backus", layers.size());
  const auto owner = file.get<int>("layer_log_of");
  const auto depths = numbers(file, "layer_log_depth", owner.size());
  std::vector<Material> rocks(owner.size());
  for (const auto& column : log_columns) {
    const auto values = numbers(file, column.name, owner.size());
    for (std::size_t i = 0; i < values.size(); ++i) rocks[i].*column.of = values[i];
  }
  for (std::size_t i = 0; i < owner.size(); ++i) {
    const auto n = layer_in(file, "layer_log_of", owner[i], layers.size());
    auto& log = layers[n].log;
    if (!log) {
      if (!(blocks[n] >= 0))
        refuse(file, "layer_log_block", "found " + shown(blocks[n]) + ", expected it not below 0");
      log.emplace();
      if (blocks[n] > 0) log->block_m = blocks[n];
      log->layered = backus[n] != 0;
    }
    log->depths_m.push_back(depths[i]);
    log->materials.push_back(rocks[i]);
  }
  for (const auto& layer : layers)
    if (layer.log) check_log(file, *layer.log);
}

std::vector<Layer> read_layers(const NetcdfFile& file) {
  const auto tops = split(*file.text_attribute(container, tops_name), '\n');
  std::vector<Layer> layers(tops.size());
  std::vector<HorizonShape> shapes(tops.size());
  for (std::size_t n = 0; n < tops.size(); ++n) shapes[n].name = tops[n];
  for (const auto& column : layer_columns) {
    if (!std::isnan(column.usual) && !file.has_variable(column.name)) continue;
    const auto values = numbers(file, column.name, tops.size());
    for (std::size_t n = 0; n < tops.size(); ++n)
      (column.of_top ? shapes[n].*column.of_top : layers[n].*column.rock.*column.of_rock) = values[n];
  }
  read_shapes(file, shapes);
  read_logs(file, layers);
  for (const auto property : all_properties()) {
    const auto& row = row_of(property);
    if (!row.if_absent || row.computed || !file.has_variable(variable_of(property))) continue;
    const auto values = numbers(file, variable_of(property), tops.size(), false);
    for (std::size_t n = 0; n < tops.size(); ++n) {
      if (std::isnan(values[n])) continue;
      if (!is_in_range(row, values[n]))
        refuse(file, variable_of(property),
               "found " + shown(values[n]) + ", expected " + expected_values(row));
      layers[n].others.emplace_back(property, values[n]);
    }
  }
  for (std::size_t n = 0; n < tops.size(); ++n) {
    layers[n].top = in_place(file.shown_name() + ": layer " + std::to_string(n + 1),
                             [&] { return Horizon(std::move(shapes[n])); });
    layers[n].complete();
  }
  return layers;
}

std::string text_of(const NetcdfFile& file, const std::string& name) {
  const auto text = file.text_attribute(container, name);
  if (!text) refuse(file, container, "found no attribute " + name + ", expected a text");
  return *text;
}

double number_of(const NetcdfFile& file, const std::string& name) {
  const auto values = file.number_attribute(container, name);
  if (!values || values->size() != 1 || !std::isfinite(values->front()))
    refuse(file, container, "found no attribute " + name + ", expected a number");
  return values->front();
}

template <class Value, std::size_t Count>
Value named(const NetcdfFile& file, const std::string& name, const std::array<Named<Value>, Count>& rows) {
  const auto text = text_of(file, name);
  std::string expected;
  for (const auto& row : rows) {
    if (text == row.name) return row.value;
    expected += (expected.empty() ? "" : " or ") + std::string(row.name);
  }
  refuse(file, container, "found " + name + " '" + text + "', expected " + expected);
}

/// "floor layer".
std::string roles_of(const FitChoice& choice) {
  std::string text;
  for (const auto& [name, wanted] : roles)
    if (choice.*wanted) text += (text.empty() ? "" : " ") + std::string(name);
  return text.empty() ? "none" : text;
}

FitChoice fit_in(const NetcdfFile& file) {
  FitChoice choice{false, false, false};
  const auto words = split(text_of(file, "fit"), ' ');
  for (const auto& word : words) {
    const auto role =
        std::find_if(roles.begin(), roles.end(), [&](const auto& row) { return word == row.name; });
    if (role != roles.end())
      choice.*role->value = true;
    else if (word != "none" || words.size() > 1)
      refuse(file, container,
             "found fit '" + text_of(file, "fit") + "', expected surface, floor, layer or none");
  }
  return choice;
}

std::uint64_t seed_in(const NetcdfFile& file) {
  const auto text = text_of(file, "seed");
  std::uint64_t seed = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || text.size() > 20)
      refuse(file, container, "found seed '" + text + "', expected a whole number");
    seed = 10 * seed + std::uint64_t(c - '0');
  }
  return seed;
}

MarmousiSettings marmousi_in(const NetcdfFile& file) {
  MarmousiSettings settings;
  settings.seed = seed_in(file);
  settings.water_m = number_of(file, "water_depth");
  settings.scale = number_of(file, "scale");
  if (file.number_attribute(container, "vp_over_vs")) settings.vp_over_vs = number_of(file, "vp_over_vs");
  return settings;
}

template <class Value, std::size_t Count>
std::string name_in(const std::array<Named<Value>, Count>& rows, Value value) {
  for (const auto& row : rows)
    if (row.value == value) return row.name;
  return "";
}

}  // namespace

void define_geology(NetcdfFile& file, const Geology& geology) {
  if (geology.maker == Maker::unknown) return;
  file.define_variable(container, Type::i32, {});
  const auto text = [&](const char* name, const std::string& value) {
    file.put_attribute(container, name, value);
  };
  const auto number = [&](const char* name, double value) {
    file.put_attribute(container, name, std::vector<double>{value});
  };
  text("long_name", "what the builder of the model knows of it; no value");
  text("maker", name_in(makers, geology.maker));
  if (geology.sampled_m > 0) {
    number("sampled", geology.sampled_m);
    text("resampling", name_in(resamplings, geology.resampling));
  }
  if (!geology.knows_places()) return;
  text("fit", roles_of(geology.fit));
  text("average", name_of(geology.average));
  if (!geology.layers.empty()) define_layers(file, geology.layers);
  if (!geology.marmousi) return;
  text("seed", std::to_string(geology.marmousi->seed));
  number("water_depth", geology.marmousi->water_m);
  number("scale", geology.marmousi->scale);
  if (geology.marmousi->vp_over_vs) number("vp_over_vs", *geology.marmousi->vp_over_vs);
}

void put_geology(NetcdfFile& file, const Geology& geology) {
  if (!geology.layers.empty()) put_layers(file, geology.layers);
}

Geology read_geology(const NetcdfFile& file) {
  Geology geology;
  if (!file.has_variable(container) || !file.text_attribute(container, "maker")) return geology;
  geology.maker = named(file, "maker", makers);
  if (file.number_attribute(container, "sampled")) {
    geology.sampled_m = number_of(file, "sampled");
    geology.resampling = named(file, "resampling", resamplings);
  }
  if (file.text_attribute(container, tops_name)) geology.layers = read_layers(file);
  if (file.text_attribute(container, "seed")) geology.marmousi = marmousi_in(file);
  if (!geology.knows_places()) return geology;
  geology.fit = fit_in(file);
  geology.average =
      in_place(file.shown_name() + ": " + container, [&] { return parse_average(text_of(file, "average")); });
  return geology;
}

}  // namespace slipwave
