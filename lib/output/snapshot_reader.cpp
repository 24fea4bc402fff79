// SPDX-License-Identifier: BSD-3-Clause
#include "output/snapshot_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/grid_netcdf.hpp"

namespace slipwave {

template <int D>
SnapshotReader<D>::SnapshotReader(NetcdfFile file)
    : file_(std::move(file)), grid_(read_grid<D>(file_, D == 2)) {
  auto wanted = field_dimensions<D>();
  wanted.insert(wanted.begin(), "time");
  for (const auto& variable : file_.variables()) {
    if (variable.dimensions == wanted) fields_.push_back(variable.name);
  }
  if (fields_.empty())
    throw Error(name() + ": found no field of time, z and x, expected snapshots in " + std::to_string(D) +
                " dimensions");
  times_s_ = file_.get<double>("time");
  if (times_s_.empty()) throw Error(name() + ": holds no time, expected at least one snapshot");
  if (!std::is_sorted(times_s_.begin(), times_s_.end()))
    throw Error(name() + ": the times do not ascend, expected them to");
}

template <int D>
std::size_t SnapshotReader<D>::nearest(double time_s) const {
  const auto nearer = [&](double a, double b) { return std::fabs(a - time_s) < std::fabs(b - time_s); };
  // Beyond the ends by less than the time between two.
  const double first = times_s_.front(), last = times_s_.back();
  const double between = times_s_.size() > 1 ? (last - first) / double(times_s_.size() - 1) : last;
  if (!(time_s >= first - between && time_s <= last + between))
    throw Error(name() + ": found a time of " + shown(time_s) + " s, the snapshots are of " + shown(first) +
                    " to " + shown(last) + " s",
                ErrorKind::usage);
  return std::size_t(std::min_element(times_s_.begin(), times_s_.end(), nearer) - times_s_.begin());
}

template <int D>
void SnapshotReader<D>::check(const std::string& field) const {
  if (std::find(fields_.begin(), fields_.end(), field) != fields_.end()) return;
  std::string list;
  for (const auto& one : fields_) list += (list.empty() ? "" : ", ") + one;
  throw Error(name() + ": found no field '" + field + "', it holds " + list, ErrorKind::usage);
}

template <int D>
Field<D> SnapshotReader<D>::read(const std::string& field, std::size_t time) const {
  check(field);
  std::vector<std::size_t> start(D + 1, 0), count = {1};
  start[0] = time;
  for (int axis = D; axis-- > 0;) count.push_back(std::size_t(grid_.shape[std::size_t(axis)]));
  const auto values = file_.get<float>(field, start, count);
  Field<D> result(grid_);
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

template <int D>
std::string SnapshotReader<D>::unit(const std::string& field) const {
  check(field);
  return file_.text_attribute(field, "units").value_or("");
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SnapshotReader);

}  // namespace slipwave
