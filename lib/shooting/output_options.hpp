// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "segy/writer.hpp"

namespace slipwave {

/// These options say where the outputs of a run go and how it is organised, as sw-shoot takes them. Names may
/// hold {shot} and {component}; what they do not tell apart goes into one file.
struct OutputOptions {
  std::string traces = "-";
  std::string revision = "auto";  // of SEG-Y: 0, 1, 2, or 1 where it holds the sampling and 2 where not
  std::string snapshots;          // empty: none
  std::string snapshot_fields = "vx,vz";
  std::string slice;                      // of 3-D snapshots, empty: all of the volume
  int first_shot = 1;                     // number of the first source
  std::vector<std::int64_t> shot_labels;  // of a survey that numbers its shots; empty: none
  std::string checkpoint;                 // empty: none
  std::optional<double> checkpoint_every_s;
  bool keep_unstable = false;
  int shots_in_parallel = 0;  // 0: as many as there are threads and memory allows (shots_at_once)
  int ranks_per_shot = 0;     // 0: as few processes as leave none without work

  /// Whether snapshots hold what slip has done.
  bool wants_slip() const;
  /// In headers, names and messages, of shot 1, 2, ... of the run.
  std::size_t number_of(std::size_t shot) const {
    return shot_labels.empty() ? shot + std::size_t(first_shot - 1) : std::size_t(shot_labels[shot - 1]);
  }
  /// Returns the format of files with the traces of such a recording, Seismic Unix aside.
  segy::FileFormat trace_format(const Recording& recording) const;
  /// Throws a usage Error on options that contradict each other or cannot hold all shots.
  template <int D>
  void check(std::size_t shots) const;
  /// Throws an Error on what the outputs of a checked scene cannot hold, and warns of what they lose.
  template <int D>
  void check_scene(const Scene<D>& scene, const std::function<void(const std::string&)>& warn) const;

 private:
  template <int D>
  void check_names(std::size_t shots) const;
  void check_sampling(const Recording& recording, const std::function<void(const std::string&)>& warn) const;
  void check_checkpoint() const;
  void check_parallel() const;
};

/// How many shots of a checked scene are simulated at once by one process: one where snapshots are written,
/// as many as the options say, or one per thread as long as 1 GiB holds them.
template <int D>
std::size_t shots_at_once(const OutputOptions& options, const Scene<D>& scene);

}  // namespace slipwave
