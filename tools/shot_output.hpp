#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint/run_state.hpp"
#include "cli/tool.hpp"
#include "scene/scene.hpp"
#include "shot_crew.hpp"
#include "solver/simulation.hpp"

namespace slipwave {

/// Where the shots of sw-shoot go. Names may hold {shot} and {component}; what they do not tell apart goes
/// into one file.
struct ShotOutput {
  std::string traces = "-";
  std::string snapshots;  // empty: none
  std::string snapshot_fields = "vx,vz";
  std::string slice;       // of 3-D snapshots, empty: all of the volume
  int first_shot = 1;      // number of the first source
  std::string checkpoint;  // empty: none
  std::optional<double> checkpoint_every_s;
  bool keep_unstable = false;
  int shots_in_parallel = 0;  // 0: as many as there are threads, in most_together_bytes of memory
  int ranks_per_shot = 0;     // 0: as few processes as leave none without work

  /// Whether snapshots hold what slip has done.
  bool wants_slip() const;
  /// Throws a usage Error when the names can not hold all shots.
  template <int D>
  void check(std::size_t shots) const;
  /// Throws an Error on what the outputs of a checked scene can not hold, and warns of what they lose.
  template <int D>
  void check_run(const Scene<D>& scene, const cli::Context& context) const;
  static constexpr std::int64_t most_together_bytes = std::int64_t(1) << 30;
  static constexpr double usual_checkpoint_every_s = 600;
  /// Shoots every shot of a checked scene and writes what it recorded. Outputs are opened before the run they
  /// belong to, so that a name that can not be written costs no computing. With a checkpoint it goes on where
  /// that was written. Where a shot becomes unstable it throws the Error that says so, after it has put what
  /// there is under other names if `keep_unstable`. With a `crew` (may be null) the scene is what this
  /// process holds of it, and the process that leads writes.
  template <int D>
  void shoot_all(const Scene<D>& scene, const std::string& history, const cli::Context& context,
                 const RankGroups* crew = nullptr) const;

 private:
  template <int D>
  struct Underway;
  /// In headers and names, of shot 1, 2, ... of the run.
  std::size_t number_of(std::size_t shot) const { return shot + std::size_t(first_shot - 1); }
  template <int D>
  void shoot_rest(const Scene<D>& scene, const std::string& history, const cli::Context& context,
                  Underway<D>& run, const RankGroups* crew) const;
  std::map<std::string, Gather> gathers_by_file(RunState& book, std::size_t shots) const;
  template <int D>
  std::string keep(const Scene<D>& scene, const Unstable& error, const cli::Context& context,
                   Underway<D>& run) const;
  template <int D>
  std::size_t shots_at_once(const Scene<D>& scene) const;
  template <int D>
  RunState open_book(const Scene<D>& scene, const std::string& history, const cli::Context& context) const;
  template <int D>
  bool in_place_still(const Scene<D>& scene, RunState& book, std::size_t shot) const;
};

/// A name for a shot (as messages number it) and a component.
std::string name_for(std::string pattern, std::size_t shot, const std::string& component);
/// Throws a usage Error on a misspelt mark, which would make a file of that name.
void check_marks(const std::string& pattern);
bool holds(std::string pattern, const std::string& mark);
/// Where what an unstable run recorded is kept: "dir/unstable-out.sgy" for "dir/out.sgy".
std::string unstable_name(std::string pattern);

/// What the textual header says of a run.
template <int D>
std::vector<std::string> entries_of(const Scene<D>& scene, const std::string& history,
                                    const std::string& version);

}  // namespace slipwave
