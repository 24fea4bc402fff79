// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "gather/component.hpp"
#include "grid/field.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Spatial derivatives of the velocity (output/derivatives.hpp); curl is that of 2-D, dvx/dz - dvz/dx.
enum class Derivative { divergence, curl, curl_x, curl_y, curl_z };

/// A field a snapshot file can hold, and what it is.
struct SnapshotField {
  std::string name, long_name, units;
  std::variant<Component, Derivative, SlipField> content;
};

/// All of them: every component that is recorded (gather/component.hpp), derivatives of the velocity (2-D:
/// div curl; 3-D: div curlx curly curlz), and slip slip_rate dissipated opening.
template <int D>
const std::vector<SnapshotField>& snapshot_fields();

/// The field of that name. Throws a usage Error that lists them.
template <int D>
const SnapshotField& snapshot_field(const std::string& name);

/// "fields: vx, vz, ...; in 3-D also ...": the names of all, for the help of an option.
std::string snapshot_field_help();

/// "vx,vz,div": names of snapshot_fields(), each once, in the order given. Throws a usage Error that lists
/// them.
template <int D>
std::vector<std::string> parse_snapshot_fields(const std::string& text);

/// Global attributes; empty ones are left out.
struct SnapshotHistory {
  std::string title, source, history;
};

/// Writes snapshots of a run as netCDF-4 (docs/formats): dimensions time (unlimited), z, [y,] x; coordinates
/// as in the model file, of fitted grids with their depths; every field float(time, z, [y,] x), one chunk a
/// time, shuffled and deflated. The file appears when commit() is called; destroyed before, the writer leaves
/// nothing behind.
template <int D>
class SnapshotWriter {
 public:
  /// `fields`: names of snapshot_fields(). path "-" is standard output. Throws Error when it cannot be
  /// written.
  SnapshotWriter(const std::string& path, const Grid<D>& grid, std::vector<std::string> fields,
                 const SnapshotHistory& history);

  /// The state at a time, later than the last one: one field on the writer's grid for each name, in that
  /// order, in SI.
  void write(double time_s, std::span<const Field<D>> fields);
  /// Finishes the file and puts it in place. Once, at the end.
  void commit();
  /// Finishes the file under another name (OutputFile::commit_as).
  void commit_as(const std::string& path);

  const std::vector<std::string>& fields() const { return fields_; }
  std::size_t times() const { return times_; }

 private:
  void finish();

  Grid<D> grid_;
  std::vector<std::string> fields_;
  OutputFile out_;
  NetcdfFile file_;
  std::size_t times_ = 0;
  double first_s_ = 0, last_s_ = 0;
  std::vector<float> low_, high_;  // of each field over all times
};

extern template class SnapshotWriter<2>;
extern template class SnapshotWriter<3>;

}  // namespace slipwave
