#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "grid/slice.hpp"
#include "output/snapshot_reader.hpp"
#include "plot/snapshot_picture.hpp"

namespace slipwave::plot {

/// The snapshots of a file, of volumes those on a plane, less those of another file where one is given.
class SnapshotFile {
 public:
  SnapshotFile(NetcdfFile file, const std::string& minus, const std::optional<Slice>& slice);

  /// Of the section.
  const Grid<2>& grid() const { return grid_; }
  const std::vector<double>& times_s() const;
  const std::vector<std::string>& fields() const;
  std::size_t nearest(double time_s) const;
  Snapshot read(const std::string& field, std::size_t time) const;
  /// The axis across the section, and in 3-D the plane that it is.
  int axis() const { return layer_ ? layer_->axis : 1; }
  std::optional<Slice> slice() const;

 private:
  using Reader = std::variant<SnapshotReader<2>, SnapshotReader<3>>;
  static Reader open(NetcdfFile file);
  Field<2> values(const Reader& reader, const std::string& field, std::size_t time) const;

  Reader of_;
  std::optional<Reader> minus_;
  std::optional<CellLayer> layer_;  // of volumes
  Grid<2> grid_;
};

}  // namespace slipwave::plot
