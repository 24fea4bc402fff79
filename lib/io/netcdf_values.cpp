// SPDX-License-Identifier: BSD-3-Clause
#include <netcdf.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/error.hpp"
#include "io/netcdf_impl.hpp"

namespace slipwave {
namespace {

int put_block(int file, int variable, const std::size_t* start, const std::size_t* count,
              const double* values) {
  return nc_put_vara_double(file, variable, start, count, values);
}
int put_block(int file, int variable, const std::size_t* start, const std::size_t* count,
              const float* values) {
  return nc_put_vara_float(file, variable, start, count, values);
}
int put_block(int file, int variable, const std::size_t* start, const std::size_t* count, const int* values) {
  return nc_put_vara_int(file, variable, start, count, values);
}
int put_block(int file, int variable, const std::size_t* start, const std::size_t* count,
              const std::uint8_t* values) {
  return nc_put_vara_uchar(file, variable, start, count, values);
}
int get_block(int file, int variable, const std::size_t* start, const std::size_t* count, double* values) {
  return nc_get_vara_double(file, variable, start, count, values);
}
int get_block(int file, int variable, const std::size_t* start, const std::size_t* count, float* values) {
  return nc_get_vara_float(file, variable, start, count, values);
}
int get_block(int file, int variable, const std::size_t* start, const std::size_t* count, int* values) {
  return nc_get_vara_int(file, variable, start, count, values);
}
int get_block(int file, int variable, const std::size_t* start, const std::size_t* count,
              std::uint8_t* values) {
  return nc_get_vara_uchar(file, variable, start, count, values);
}

}  // namespace

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::string& text) {
  impl_->check(
      nc_put_att_text(impl_->id, impl_->variable_id(variable), name.c_str(), text.size(), text.data()),
      variable);
}

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::vector<double>& values) {
  impl_->check(nc_put_att_double(impl_->id, impl_->variable_id(variable), name.c_str(), NC_DOUBLE,
                                 values.size(), values.data()),
               variable);
}

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::vector<float>& values) {
  impl_->check(nc_put_att_float(impl_->id, impl_->variable_id(variable), name.c_str(), NC_FLOAT,
                                values.size(), values.data()),
               variable);
}

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::vector<int>& values) {
  impl_->check(nc_put_att_int(impl_->id, impl_->variable_id(variable), name.c_str(), NC_INT, values.size(),
                              values.data()),
               variable);
}

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::vector<std::uint8_t>& values) {
  impl_->check(nc_put_att_uchar(impl_->id, impl_->variable_id(variable), name.c_str(), NC_UBYTE,
                                values.size(), values.data()),
               variable);
}

template <class T>
void NetcdfFile::put(const std::string& variable, const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& count, const T* values) {
  const int id = impl_->variable_id(variable);
  errno = 0;
  impl_->check(put_block(impl_->id, id, start.data(), count.data(), values), variable);
}

template <class T>
void NetcdfFile::put(const std::string& name, const T* values) {
  const auto shape = variable(name).shape;
  put(name, std::vector<std::size_t>(shape.size(), 0), shape, values);
}

void NetcdfFile::put_text(const std::string& variable, const std::vector<std::string>& values) {
  std::vector<const char*> texts;
  for (const auto& value : values) texts.push_back(value.c_str());
  const int id = impl_->variable_id(variable);
  errno = 0;
  impl_->check(nc_put_var_string(impl_->id, id, texts.data()), variable);
}

std::optional<std::string> NetcdfFile::text_attribute(const std::string& variable,
                                                      const std::string& name) const {
  const int id = impl_->variable_id(variable);
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(impl_->id, id, name.c_str(), &type, &length) != NC_NOERR) return {};
  if (type == NC_STRING && length == 1) {
    char* text = nullptr;
    impl_->check(nc_get_att_string(impl_->id, id, name.c_str(), &text), variable);
    std::string copy = text ? text : "";
    nc_free_string(1, &text);
    return copy;
  }
  if (type != NC_CHAR) return {};
  impl_->check_size(variable, {length}, 1);
  std::string text(length, '\0');
  impl_->check(nc_get_att_text(impl_->id, id, name.c_str(), text.data()), variable);
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::optional<std::vector<double>> NetcdfFile::number_attribute(const std::string& variable,
                                                                const std::string& name) const {
  const int id = impl_->variable_id(variable);
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(impl_->id, id, name.c_str(), &type, &length) != NC_NOERR) return {};
  if (type == NC_CHAR || type >= NC_STRING) return {};
  impl_->check_size(variable, {length}, sizeof(double));
  std::vector<double> values(length);
  impl_->check(nc_get_att_double(impl_->id, id, name.c_str(), values.data()), variable);
  return values;
}

template <class T>
std::vector<T> NetcdfFile::get(const std::string& name, const std::vector<std::size_t>& start,
                               const std::vector<std::size_t>& count) const {
  const Variable found = variable(name);
  if (start.size() != found.shape.size() || count.size() != found.shape.size()) {
    impl_->fail(name, "found " + std::to_string(found.shape.size()) + " dimensions, expected " +
                          std::to_string(count.size()));
  }
  nc_type type = 0;
  impl_->check(nc_inq_vartype(impl_->id, impl_->variable_id(name), &type), name);
  if (type == NC_CHAR || type == NC_STRING) impl_->fail(name, "found text, expected numbers");
  impl_->check_size(name, count, sizeof(T));
  std::size_t values = 1;
  for (const auto length : count) values *= length;
  std::vector<T> result(values);
  errno = 0;
  if (values) {
    impl_->check(get_block(impl_->id, impl_->variable_id(name), start.data(), count.data(), result.data()),
                 name);
  }
  return result;
}

template <class T>
std::vector<T> NetcdfFile::get(const std::string& name) const {
  const auto shape = variable(name).shape;
  return get<T>(name, std::vector<std::size_t>(shape.size(), 0), shape);
}

std::vector<std::string> NetcdfFile::get_text(const std::string& name) const {
  const Variable found = variable(name);
  if (found.type != Type::text) impl_->fail(name, "found another type, expected strings");
  impl_->check_size(name, found.shape, sizeof(char*));
  std::vector<char*> texts(found.size(), nullptr);
  errno = 0;
  impl_->check(nc_get_var_string(impl_->id, impl_->variable_id(name), texts.data()), name);
  std::vector<std::string> copies;
  for (const char* text : texts) copies.emplace_back(text ? text : "");
  nc_free_string(texts.size(), texts.data());
  return copies;
}

std::vector<float> NetcdfFile::get_physical(const std::string& name) const {
  const auto shape = variable(name).shape;
  return get_physical(name, std::vector<std::size_t>(shape.size(), 0), shape);
}

std::vector<float> NetcdfFile::get_physical(const std::string& name, const std::vector<std::size_t>& start,
                                            const std::vector<std::size_t>& count) const {
  const auto first = [&](const std::string& attribute) -> std::optional<double> {
    const auto values = number_attribute(name, attribute);
    if (!values || values->empty()) return {};
    return values->front();
  };
  const auto scale = first("scale_factor"), offset = first("add_offset");
  const auto missing = first("missing_value");
  const auto fill = first("_FillValue");
  // What lies outside the valid range, which is of packed values, is missing, too.
  const auto range = number_attribute(name, "valid_range");
  const bool whole = range && range->size() == 2;
  const auto least = whole ? range->front() : first("valid_min").value_or(-HUGE_VAL);
  const auto largest = whole ? range->back() : first("valid_max").value_or(HUGE_VAL);
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  if (!scale && !offset) {
    auto values = get<float>(name, start, count);
    const float blank = fill ? float(*fill) : NC_FILL_FLOAT;
    for (auto& value : values) {
      if (value == blank || (missing && value == float(*missing)) || value < float(least) ||
          value > float(largest))
        value = nothing;
    }
    return values;
  }
  const auto packed = get<double>(name, start, count);
  std::vector<float> values(packed.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const bool blank = (fill && packed[i] == *fill) || (missing && packed[i] == *missing) ||
                       packed[i] < least || packed[i] > largest;
    values[i] = blank ? nothing : float(packed[i] * scale.value_or(1) + offset.value_or(0));
  }
  return values;
}

template void NetcdfFile::put(const std::string&, const double*);
template void NetcdfFile::put(const std::string&, const float*);
template void NetcdfFile::put(const std::string&, const int*);
template void NetcdfFile::put(const std::string&, const std::uint8_t*);
template void NetcdfFile::put(const std::string&, const std::vector<std::size_t>&,
                              const std::vector<std::size_t>&, const double*);
template void NetcdfFile::put(const std::string&, const std::vector<std::size_t>&,
                              const std::vector<std::size_t>&, const float*);
template void NetcdfFile::put(const std::string&, const std::vector<std::size_t>&,
                              const std::vector<std::size_t>&, const int*);
template void NetcdfFile::put(const std::string&, const std::vector<std::size_t>&,
                              const std::vector<std::size_t>&, const std::uint8_t*);
template std::vector<double> NetcdfFile::get(const std::string&) const;
template std::vector<float> NetcdfFile::get(const std::string&) const;
template std::vector<int> NetcdfFile::get(const std::string&) const;
template std::vector<std::uint8_t> NetcdfFile::get(const std::string&) const;
template std::vector<double> NetcdfFile::get(const std::string&, const std::vector<std::size_t>&,
                                             const std::vector<std::size_t>&) const;
template std::vector<float> NetcdfFile::get(const std::string&, const std::vector<std::size_t>&,
                                            const std::vector<std::size_t>&) const;
template std::vector<int> NetcdfFile::get(const std::string&, const std::vector<std::size_t>&,
                                          const std::vector<std::size_t>&) const;
template std::vector<std::uint8_t> NetcdfFile::get(const std::string&, const std::vector<std::size_t>&,
                                                   const std::vector<std::size_t>&) const;

}  // namespace slipwave
