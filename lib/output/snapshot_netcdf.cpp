// SPDX-License-Identifier: BSD-3-Clause
#include "output/snapshot_netcdf.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "grid/grid_netcdf.hpp"

namespace slipwave {

namespace {

/// Derivatives of whole grids, and the recorded components they are.
struct DerivativeRow {
  Derivative content;
  Component component;
};

constexpr DerivativeRow derivatives[] = {
    {Derivative::divergence, Component::div}, {Derivative::curl, Component::curl},
    {Derivative::curl_x, Component::curl_x},  {Derivative::curl_y, Component::curl_y},
    {Derivative::curl_z, Component::curl_z},
};

template <int D>
std::vector<SnapshotField> make_fields() {
  std::vector<SnapshotField> fields;
  for (const auto& row : component_rows())
    if (row.in(D) && row.is_field())
      fields.push_back({row.name, row.description(D), cf_unit(row.unit), row.component});
  for (const auto& [content, component] : derivatives)
    if (const auto& row = row_of(component); row.in(D))
      fields.push_back({row.name, row.long_name, cf_unit(row.unit), content});
  fields.push_back({"slip", "accumulated slip on fracture planes, as a strain", "1", SlipField::slip});
  fields.push_back({"slip_rate", "slip strain rate in the last step", "s-1", SlipField::slip_rate});
  fields.push_back({"dissipated", "energy dissipated by slip", "J m-3", SlipField::dissipated});
  fields.push_back({"opening", "strain by which fracture planes stand open", "1", SlipField::opening});
  return fields;
}

std::vector<std::string> derivative_names(bool in_2d, bool in_3d) {
  std::vector<std::string> names;
  for (const auto& [content, component] : derivatives)
    if (const auto& row = row_of(component); row.in_2d == in_2d && row.in_3d == in_3d)
      names.emplace_back(row.name);
  return names;
}

template <int D>
std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const auto& field : snapshot_fields<D>()) names.push_back(field.name);
  return names;
}

}  // namespace

template <int D>
const std::vector<SnapshotField>& snapshot_fields() {
  static const std::vector<SnapshotField> fields = make_fields<D>();
  return fields;
}

template <int D>
const SnapshotField& snapshot_field(const std::string& name) {
  const auto& known = snapshot_fields<D>();
  const auto at =
      std::find_if(known.begin(), known.end(), [&](const auto& field) { return field.name == name; });
  if (at != known.end()) return *at;
  throw Error("found the field '" + name + "', expected one of " + joined(field_names<D>()),
              ErrorKind::usage);
}

std::string snapshot_field_help() {
  return "fields: " + joined(field_names<2>()) + "; in 3-D also " +
         joined(component_names(3, 2, Listed::fields)) + ", and " + joined(derivative_names(false, true)) +
         " for " + joined(derivative_names(true, false));
}

template <int D>
std::vector<std::string> parse_snapshot_fields(const std::string& text) {
  auto names = split(text, ',');
  for (auto name = names.begin(); name != names.end(); ++name) {
    snapshot_field<D>(*name);
    if (std::find(names.begin(), name, *name) != name)
      throw Error("found the field '" + *name + "' twice, expected each once", ErrorKind::usage);
  }
  return names;
}

template <int D>
SnapshotWriter<D>::SnapshotWriter(const std::string& path, const Grid<D>& grid,
                                  std::vector<std::string> fields, const SnapshotHistory& history)
    : grid_(grid),
      fields_(std::move(fields)),
      out_(path, OutputFile::Content::binary),
      file_(NetcdfFile::create(out_.path_for_libraries(), out_.shown_name())),
      low_(fields_.size(), std::numeric_limits<float>::infinity()),
      high_(fields_.size(), -std::numeric_limits<float>::infinity()) {
  file_.put_attribute("", "Conventions", conventions_of(grid));
  for (const auto& [name, text] : {std::pair<const char*, const std::string&>{"title", history.title},
                                   {"source", history.source},
                                   {"history", history.history}})
    if (!text.empty()) file_.put_attribute("", name, text);
  define_grid(file_, grid);
  file_.define_dimension("time", 0);
  file_.define_variable("time", NetcdfFile::Type::f64, {"time"}, {false, {1024}});
  file_.put_attribute("time", "standard_name", "time");
  file_.put_attribute("time", "long_name", "time since the start of the run");
  file_.put_attribute("time", "units", "s");
  file_.put_attribute("time", "axis", "T");
  auto dimensions = field_dimensions<D>();
  dimensions.insert(dimensions.begin(), "time");
  std::vector<std::size_t> chunk = {1};
  for (int axis = D; axis-- > 0;) chunk.push_back(std::size_t(grid.shape[std::size_t(axis)]));
  for (const auto& name : fields_) {
    const auto& field = snapshot_field<D>(name);
    file_.define_variable(name, NetcdfFile::Type::f32, dimensions, {true, chunk});
    file_.put_attribute(name, "_FillValue", std::vector<float>{std::numeric_limits<float>::quiet_NaN()});
    file_.put_attribute(name, "long_name", field.long_name);
    file_.put_attribute(name, "units", field.units);
    put_coordinates(file_, grid, name);
  }
  put_grid(file_, grid);
}

template <int D>
void SnapshotWriter<D>::write(double time_s, std::span<const Field<D>> fields) {
  assert(fields.size() == fields_.size());
  assert(times_ == 0 || time_s > last_s_);
  std::vector<std::size_t> start(D + 1, 0), count = {1};
  start[0] = times_;
  for (int axis = D; axis-- > 0;) count.push_back(std::size_t(grid_.shape[std::size_t(axis)]));
  file_.put("time", {times_}, {1}, &time_s);
  for (std::size_t n = 0; n < fields_.size(); ++n) {
    assert(fields[n].grid() == grid_);
    file_.put(fields_[n], start, count, fields[n].data());
    for (const float value : fields[n]) {
      low_[n] = std::min(low_[n], value);
      high_[n] = std::max(high_[n], value);
    }
  }
  if (times_ == 0) first_s_ = time_s;
  last_s_ = time_s;
  ++times_;
}

template <int D>
void SnapshotWriter<D>::finish() {
  if (times_ > 0) {
    file_.put_attribute("time", "actual_range", std::vector<double>{first_s_, last_s_});
    for (std::size_t n = 0; n < fields_.size(); ++n)
      if (low_[n] <= high_[n])
        file_.put_attribute(fields_[n], "actual_range", std::vector<float>{low_[n], high_[n]});
  }
  file_.close();
}

template <int D>
void SnapshotWriter<D>::commit() {
  finish();
  out_.commit();
}

template <int D>
void SnapshotWriter<D>::commit_as(const std::string& path) {
  finish();
  out_.commit_as(path);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, snapshot_fields);
SLIPWAVE_INSTANTIATE_D(FUNCTION, snapshot_field);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_snapshot_fields);
SLIPWAVE_INSTANTIATE_D(TYPE, class SnapshotWriter);

}  // namespace slipwave
