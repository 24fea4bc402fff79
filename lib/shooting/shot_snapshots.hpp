// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checkpoint/run_state.hpp"
#include "checkpoint/snapshot_log.hpp"
#include "grid/slice.hpp"
#include "output/snapshot_netcdf.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// The layer of cells that snapshots are cut down to: "y=500", or "" for none. Throws a usage Error, also
/// when it misses the grid. No grid in 2-D is cut.
std::optional<CellLayer> cut_of(const Grid<2>& grid, const std::string& slice);
std::optional<CellLayer> cut_of(const Grid<3>& grid, const std::string& slice);

/// Reads all of these fields and drops them: what ranks do that help another one to write them.
template <int D>
SnapshotSink<D> sink_of_helper(const std::vector<std::string>& fields);

/// Snapshots of one shot: the file, and with a checkpoint the log that goes with it.
template <int D>
class ShotSnapshots {
 public:
  ShotSnapshots(const std::string& path, const Grid<D>& grid, const std::optional<CellLayer>& cut,
                const std::vector<std::string>& fields, const SnapshotHistory& history, const RunState& state,
                std::size_t shot);
  SnapshotSink<D> sink();
  RunState::Mark mark();
  void commit() { writer_.commit(); }
  void commit_as(const std::string& path) { writer_.commit_as(path); }

 private:
  Field<D> taken(const std::string& name, const FieldReader<D>& field) const;

  std::optional<CellLayer> cut_;
  SnapshotWriter<D> writer_;
  std::optional<SnapshotLog<D>> log_;
};

}  // namespace slipwave
