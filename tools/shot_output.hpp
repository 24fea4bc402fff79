#pragma once

#include <optional>
#include <string>

#include "checkpoint/run_book.hpp"
#include "cli/tool.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Where the shots of sw-shoot go. Names may hold {shot} and {component}; what they do not tell apart goes
/// into one file.
struct ShotOutput {
  std::string traces = "-";
  std::string snapshots;  // empty: none
  std::string snapshot_fields = "vx,vz";
  int first_shot = 1;      // number of the first source
  std::string checkpoint;  // empty: none
  std::optional<double> checkpoint_every_s;
  int shots_in_parallel = 0;  // 0: as many as there are threads, in most_together_bytes of memory

  /// Whether snapshots hold what slip has done.
  bool wants_slip() const;
  /// Throws a usage Error when the names can not hold all shots.
  void check(std::size_t shots) const;
  static constexpr std::int64_t most_together_bytes = std::int64_t(1) << 30;
  static constexpr double usual_checkpoint_every_s = 600;
  /// Shoots every shot of a checked scene and writes what it recorded. Outputs are opened before the run they
  /// belong to, so that a name that can not be written costs no computing. With a checkpoint it goes on where
  /// that was written.
  void shoot_all(const Scene<2>& scene, const std::string& history, const cli::Context& context) const;

 private:
  std::size_t shots_at_once(const Scene<2>& scene) const;
  RunBook open_book(const Scene<2>& scene, const std::string& history, const cli::Context& context) const;
  bool in_place_still(const Scene<2>& scene, RunBook& book, std::size_t shot) const;
};

}  // namespace slipwave
