// SPDX-License-Identifier: BSD-3-Clause
#include <netcdf.h>

#include <array>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_impl.hpp"

namespace slipwave {
namespace {

int code_of(NetcdfFile::Type type) {
  switch (type) {
    case NetcdfFile::Type::f64:
      return NC_DOUBLE;
    case NetcdfFile::Type::f32:
      return NC_FLOAT;
    case NetcdfFile::Type::i32:
      return NC_INT;
    case NetcdfFile::Type::u8:
      return NC_UBYTE;
    case NetcdfFile::Type::text:
      return NC_STRING;
    case NetcdfFile::Type::other:
      break;
  }
  throw Error("netCDF variables can be written as double, float, int, ubyte and string only");
}

NetcdfFile::Type type_of(nc_type code) {
  switch (code) {
    case NC_DOUBLE:
      return NetcdfFile::Type::f64;
    case NC_FLOAT:
      return NetcdfFile::Type::f32;
    case NC_INT:
      return NetcdfFile::Type::i32;
    case NC_UBYTE:
      return NetcdfFile::Type::u8;
    case NC_STRING:
      return NetcdfFile::Type::text;
    default:
      return NetcdfFile::Type::other;
  }
}

}  // namespace

std::size_t NetcdfFile::Variable::size() const {
  std::size_t values = 1;
  for (const auto length : shape) values *= length;
  return values;
}

void NetcdfFile::define_dimension(const std::string& name, std::size_t length) {
  int dimension = 0;
  impl_->check(nc_def_dim(impl_->id, name.c_str(), length ? length : NC_UNLIMITED, &dimension), name);
}

void NetcdfFile::define_variable(const std::string& name, Type type,
                                 const std::vector<std::string>& dimensions, const Storage& storage) {
  std::vector<int> ids(dimensions.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    impl_->check(nc_inq_dimid(impl_->id, dimensions[i].c_str(), &ids[i]), dimensions[i]);
  }
  int variable = 0;
  impl_->check(nc_def_var(impl_->id, name.c_str(), code_of(type), int(ids.size()), ids.data(), &variable),
               name);
  if (ids.empty() || type == Type::text) return;
  if (!storage.chunk.empty()) {
    impl_->check(nc_def_var_chunking(impl_->id, variable, NC_CHUNKED, storage.chunk.data()), name);
  }
  if (storage.compress) impl_->check(nc_def_var_deflate(impl_->id, variable, 1, 1, 1), name);
}

std::vector<NetcdfFile::Variable> NetcdfFile::variables() const {
  int count = 0;
  impl_->check(nc_inq_nvars(impl_->id, &count));
  std::vector<Variable> all;
  for (int id = 0; id < count; ++id) {
    std::array<char, NC_MAX_NAME + 1> name{};
    impl_->check(nc_inq_varname(impl_->id, id, name.data()));
    all.push_back(variable(name.data()));
  }
  return all;
}

bool NetcdfFile::has_variable(const std::string& name) const {
  int variable = 0;
  return nc_inq_varid(impl_->id, name.c_str(), &variable) == NC_NOERR;
}

NetcdfFile::Variable NetcdfFile::variable(const std::string& name) const {
  const int id = impl_->variable_id(name);
  Variable found;
  found.name = name;
  nc_type type = 0;
  int rank = 0;
  impl_->check(nc_inq_var(impl_->id, id, nullptr, &type, &rank, nullptr, nullptr), name);
  std::vector<int> dimensions(std::size_t(rank), 0);
  impl_->check(nc_inq_vardimid(impl_->id, id, dimensions.data()), name);
  found.type = type_of(type);
  for (const int dimension : dimensions) {
    std::array<char, NC_MAX_NAME + 1> dimension_name{};
    std::size_t length = 0;
    impl_->check(nc_inq_dim(impl_->id, dimension, dimension_name.data(), &length), name);
    found.dimensions.emplace_back(dimension_name.data());
    found.shape.push_back(length);
  }
  return found;
}

std::optional<std::size_t> NetcdfFile::dimension_length(const std::string& name) const {
  int id = 0;
  std::size_t length = 0;
  if (nc_inq_dimid(impl_->id, name.c_str(), &id) != NC_NOERR) return {};
  impl_->check(nc_inq_dimlen(impl_->id, id, &length), name);
  return length;
}

}  // namespace slipwave
