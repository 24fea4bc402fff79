// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "grid/field.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {

/// Reads what SnapshotWriter wrote, one field of one time at once.
template <int D>
class SnapshotReader {
 public:
  /// Throws Error naming the file when it holds no snapshots in D dimensions, or none at all.
  explicit SnapshotReader(NetcdfFile file);

  const Grid<D>& grid() const { return grid_; }
  /// Ascending.
  const std::vector<double>& times_s() const { return times_s_; }
  /// Names of the fields, as the file orders them.
  const std::vector<std::string>& fields() const { return fields_; }
  /// The number of the time nearest to `time_s`.
  std::size_t nearest(double time_s) const;
  /// Throws Error when there is no such field, listing those there are. 0 <= time < times_s().size().
  Field<D> read(const std::string& field, std::size_t time) const;
  /// "m s-1"; "" where the file does not say.
  std::string unit(const std::string& field) const;
  const std::string& name() const { return file_.shown_name(); }

 private:
  void check(const std::string& field) const;

  NetcdfFile file_;
  Grid<D> grid_;
  std::vector<double> times_s_;
  std::vector<std::string> fields_;
};

extern template class SnapshotReader<2>;
extern template class SnapshotReader<3>;

}  // namespace slipwave
