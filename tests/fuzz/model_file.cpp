// SPDX-License-Identifier: BSD-3-Clause
#include "model_file.hpp"

#include <fuzzer/FuzzedDataProvider.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "memory_file.hpp"

namespace slipwave::fuzz {
namespace {

using Data = FuzzedDataProvider;

void call(int status) {
  if (status != NC_NOERR) fail("the netCDF library refuses: " + std::string(nc_strerror(status)));
}

struct Dimension {
  const char* name;
  std::size_t length;  // of what is written
  std::size_t said;    // in the file; 0: unlimited
};

struct Attribute {
  std::string name;
  nc_type type = NC_CHAR;
  std::vector<double> numbers;
  std::string text;
};

struct Variable {
  const char* name;
  nc_type type;
  std::vector<int> along;  // rows of Description::dimensions
  double first = 1, step = 0;
  std::vector<std::pair<std::size_t, double>> changed = {};
  std::string text = "fault";
  std::vector<Attribute> attributes = {};
};

constexpr int x = 0, y = 1, z = 2, sets = 3, systems = 4, axis = 5, time_ = 6, setting = 7;

struct Description {
  std::vector<Dimension> dimensions = {
      {"x", 4, 4},           {"y", 2, 2},    {"z", 3, 3},    {"fracture_set", 1, 1},
      {"slip_system", 1, 1}, {"axis", 2, 2}, {"time", 2, 2}, {"setting", 2, 2}};
  std::vector<Variable> variables = {{"x", NC_DOUBLE, {x}, 2.5, 5},
                                     {"z", NC_DOUBLE, {z}, 2.5, 5},
                                     {"vp", NC_FLOAT, {z, x}, 3000},
                                     {"vs", NC_FLOAT, {z, x}, 1500},
                                     {"rho", NC_FLOAT, {z, x}, 2200},
                                     {"fracture", NC_UBYTE, {z, x}},
                                     {"fracture_name", NC_STRING, {sets}},
                                     {"slip_set", NC_INT, {systems}, 0},
                                     {"slip_normal", NC_DOUBLE, {systems, axis}, 0, 0, {{0, 1}}},
                                     {"slip_friction", NC_DOUBLE, {systems}},
                                     {"slip_viscosity", NC_DOUBLE, {systems}},
                                     {"slip_strength", NC_DOUBLE, {systems}},
                                     {"slip_opening", NC_UBYTE, {systems}},
                                     {"slip_law", NC_UBYTE, {systems}},
                                     {"slip_dynamic_friction", NC_DOUBLE, {systems}},
                                     {"slip_distance", NC_DOUBLE, {systems}, 1},
                                     {"prestress_xx", NC_FLOAT, {z, x}, -1e6},
                                     {"prestress_zz", NC_FLOAT, {z, x}, -1e6},
                                     {"prestress_xz", NC_FLOAT, {z, x}, 0},
                                     {"time", NC_DOUBLE, {time_}, 0, 0.1},
                                     {"vx", NC_FLOAT, {time_, z, x}, 0, 1},
                                     {"order", NC_INT, {setting}, 5, 2},
                                     {"error", NC_DOUBLE, {setting}, 0.1},
                                     {"seconds", NC_DOUBLE, {setting}},
                                     {"courant", NC_DOUBLE, {setting}},
                                     {"step", NC_DOUBLE, {setting}, 5},
                                     {"cells", NC_DOUBLE, {setting}, 1000},
                                     {"steps", NC_DOUBLE, {setting}, 100},
                                     {"time_order", NC_INT, {setting}, 2},
                                     {"slip_order", NC_INT, {setting}, 0},
                                     {"late_error", NC_DOUBLE, {setting}, 0.1},
                                     {"memory", NC_DOUBLE, {setting}, 1e6}};
  std::vector<Attribute> attributes;
};

double strange(Data& data) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return data.PickValueInArray({0., -1., std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, 1e300,
                                -1e300, 1e-300, 1e38, 2.5, 255., 256., 4294967296., 1e19});
}

Attribute attribute(Data& data) {
  Attribute one;
  one.name = data.PickValueInArray({"_FillValue", "missing_value", "scale_factor", "add_offset", "units",
                                    "positive", "axis", "title", "history", "source", "Conventions", "chosen",
                                    "wanted_error", "reference"});
  one.type = data.PickValueInArray({NC_CHAR, NC_STRING, NC_DOUBLE, NC_FLOAT, NC_INT, NC_UBYTE});
  one.numbers.resize(data.ConsumeIntegralInRange<std::size_t>(0, 3));
  for (auto& number : one.numbers) number = strange(data);
  one.text = data.ConsumeRandomLengthString(12);
  return one;
}

/// A file of three dimensions: its fields lie along y, too.
void deepen(Description& file) {
  for (auto& variable : file.variables)
    if (variable.along.size() > 1 && variable.along.back() == x)
      variable.along.insert(variable.along.end() - 1, y);
  file.variables.push_back({"y", NC_DOUBLE, {y}, 2.5, 5});
  file.dimensions[axis].length = file.dimensions[axis].said = 3;
}

void change(Description& file, Data& data) {
  auto& dimension = file.dimensions[data.ConsumeIntegralInRange<std::size_t>(0, file.dimensions.size() - 1)];
  const auto n = data.ConsumeIntegralInRange<std::size_t>(0, file.variables.size() - 1);
  auto& variable = file.variables[n];
  switch (data.ConsumeIntegralInRange(0, 8)) {
    case 0:
      variable.changed.emplace_back(data.ConsumeIntegral<std::uint8_t>(), strange(data));
      break;
    case 1:
      variable.attributes.push_back(attribute(data));
      break;
    case 2:
      dimension.length = dimension.said = data.ConsumeIntegralInRange<std::size_t>(0, 5);
      break;
    case 3:  // large ones have no values
      dimension.length = 0;
      dimension.said = data.PickValueInArray(
          {std::size_t(3000), std::size_t(100000), std::size_t(1) << 31, std::size_t(1) << 40});
      break;
    case 4:
      variable.type = data.PickValueInArray({NC_BYTE, NC_CHAR, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE,
                                             NC_UBYTE, NC_USHORT, NC_UINT, NC_INT64, NC_UINT64, NC_STRING});
      break;
    case 5:
      variable.along.resize(data.ConsumeIntegralInRange<std::size_t>(0, 4));
      for (auto& one : variable.along)
        one = data.ConsumeIntegralInRange<int>(0, int(file.dimensions.size()) - 1);
      break;
    case 6:
      file.variables.erase(file.variables.begin() + std::ptrdiff_t(n));
      break;
    case 7:
      variable.text = data.ConsumeRandomLengthString(8);
      break;
    default:
      file.attributes.push_back(attribute(data));
  }
}

/// What the library refuses to write nobody will find in a file.
void put(int file, int variable, const Attribute& attribute) {
  const char* text = attribute.text.c_str();
  if (attribute.type == NC_CHAR)
    nc_put_att_text(file, variable, attribute.name.c_str(), attribute.text.size(), text);
  else if (attribute.type == NC_STRING)
    nc_put_att_string(file, variable, attribute.name.c_str(), 1, &text);
  else
    nc_put_att_double(file, variable, attribute.name.c_str(), attribute.type, attribute.numbers.size(),
                      attribute.numbers.data());
}

void put_values(int file, int id, const Variable& variable, const std::vector<std::size_t>& count) {
  const auto size = std::accumulate(count.begin(), count.end(), std::size_t(1), std::multiplies<>());
  if (size == 0) return;
  const std::vector<std::size_t> start(count.size() + 1, 0);
  if (variable.type == NC_STRING) {
    std::vector<const char*> all(size, variable.text.c_str());
    nc_put_vara_string(file, id, start.data(), count.data(), all.data());
  } else if (variable.type == NC_CHAR) {
    nc_put_vara_text(file, id, start.data(), count.data(), std::string(size, 'a').data());
  } else {
    std::vector<double> values(size);
    for (std::size_t n = 0; n < size; ++n) values[n] = variable.first + double(n) * variable.step;
    for (const auto& [n, value] : variable.changed) values[n % size] = value;
    nc_put_vara_double(file, id, start.data(), count.data(), values.data());
  }
}

}  // namespace

std::vector<char> model_file(std::span<const std::uint8_t> input) {
  Data data(input.data(), input.size());
  Description description;
  if (data.ConsumeBool()) deepen(description);
  while (data.remaining_bytes() > 0) change(description, data);

  int file = -1;
  constexpr std::size_t first_bytes = 65536;
  call(nc_create_mem("model", NC_NETCDF4, first_bytes, &file));
  std::vector<int> dimensions;
  for (const auto& dimension : description.dimensions) {
    dimensions.push_back(-1);
    call(nc_def_dim(file, dimension.name, dimension.said, &dimensions.back()));
  }
  for (const auto& variable : description.variables) {
    std::vector<int> ids;
    std::vector<std::size_t> count;
    for (const int one : variable.along) {
      ids.push_back(dimensions[std::size_t(one)]);
      count.push_back(description.dimensions[std::size_t(one)].length);
    }
    int id = 0;
    if (nc_def_var(file, variable.name, variable.type, int(ids.size()), ids.data(), &id) != NC_NOERR)
      continue;
    for (const auto& one : variable.attributes) put(file, id, one);
    put_values(file, id, variable, count);
  }
  for (const auto& one : description.attributes) put(file, NC_GLOBAL, one);
  NC_memio memory{};
  call(nc_close_memio(file, &memory));
  const char* first = static_cast<const char*>(memory.memory);
  std::vector<char> bytes(first, first + memory.size);
  std::free(memory.memory);
  return bytes;
}

}  // namespace slipwave::fuzz
