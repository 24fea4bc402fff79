// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "grid/slice.hpp"
#include "output/snapshot_reader.hpp"
#include "plot/snapshot_picture.hpp"

namespace slipwave::plot {

/// The snapshots of a file, of volumes those on one plane or on three, less those of another file where one
/// is given.
class SnapshotFile {
 public:
  SnapshotFile(NetcdfFile file, const std::string& minus, const WantedPlanes& planes);

  const std::vector<double>& times_s() const;
  const std::vector<std::string>& fields() const;
  std::size_t nearest(double time_s) const;
  /// One section, or three: planes().
  std::vector<Snapshot> read(const std::string& field, std::size_t time) const;
  std::size_t sections() const { return grids_.size(); }
  const Grid<2>& grid(std::size_t section) const { return grids_[section]; }
  /// The axis across a section, and in 3-D the plane that it is.
  int axis(std::size_t section) const { return layers_.empty() ? 1 : layers_[section].axis; }
  std::optional<Slice> plane(std::size_t section) const;

 private:
  using Reader = std::variant<SnapshotReader<2>, SnapshotReader<3>>;
  static Reader open(NetcdfFile file);
  std::vector<Field<2>> values(const Reader& reader, const std::string& field, std::size_t time) const;

  Reader of_;
  std::optional<Reader> minus_;
  std::vector<CellLayer> layers_;  // of volumes
  std::vector<Grid<2>> grids_;
};

}  // namespace slipwave::plot
