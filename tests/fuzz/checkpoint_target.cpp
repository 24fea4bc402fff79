// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint_target.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "checkpoint/run_state.hpp"
#include "memory_file.hpp"
#include "solver/simulation.hpp"

namespace slipwave::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t all_shots = 2;

/// A folder that lies in memory where there is one: each checkpoint is brought to the disk.
class Folder {
 public:
  Folder() {
    std::string name = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path().string();
    name += "/slipwave-fuzz-XXXXXX";
    if (!mkdtemp(name.data())) fail("no folder");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  std::string checkpoint() const { return path_ + "/c"; }
  void clear() const {
    for (const auto& entry : fs::directory_iterator(path_)) fs::remove(entry);
  }

 private:
  std::string path_;
};

const Folder& folder() {
  static const Folder one;
  return one;
}

/// Rock with a crack below a free surface, other sides absorbing: all that remembers anything.
const Scene<2>& scene() {
  static const Scene<2> one = [] {
    Scene<2> scene;
    const Grid<2> grid{{16, 12}, 5, {0, 0}};
    scene.model.medium = {Field<2>(grid, 3000), Field<2>(grid, 1500), Field<2>(grid, 2200)};
    scene.model.fracture = Field<2, std::uint8_t>(grid);
    for (std::int64_t i = 6; i < 10; ++i) scene.model.fracture({i, 8}) = 1;
    scene.model.fracture_sets = {{"crack", {{{0, 1}, 0.5, 0.01, 0}}}};
    scene.edges = {{{{EdgeLaw::absorbing, EdgeLaw::absorbing}, {EdgeLaw::free, EdgeLaw::absorbing}}}};
    scene.numerics.order = 3;
    scene.numerics.zone_cells = 3;
    scene.numerics.tiling.steps = 1;
    scene.recording = {{Component::vx, Component::p}, 0.03, 0.001};
    scene.slip_diary = true;
    for (std::size_t shot = 0; shot < all_shots; ++shot)
      scene.survey.sources.push_back(
          {{40. + 5. * double(shot), 20}, Explosion(), parse_wavelet("ricker:40"), 1e6});
    scene.survey.receivers_m = {{20, 5}, {60, 5}};
    check(scene);
    return scene;
  }();
  return one;
}

struct LeftOff {};

/// Leaves a shot off after some passes.
class Leaver : public Pauses {
 public:
  Leaver(Pauses& run, int passes) : run_(run), left_(passes) {}
  void begin(const Serialize& keep) override { run_.begin(keep); }
  bool wanted() override { return --left_ < 0; }
  void pause(const Serialize& keep, const ShotPlace& place) override {
    run_.pause(keep, place);
    throw LeftOff();
  }

 private:
  Pauses& run_;
  int left_;
};

RunState::Settings settings() {
  constexpr double never_s = 1e9;
  const auto silent = [](const std::string&) {};
  return {folder().checkpoint(), never_s, all_shots, 1, identity_of(scene()), silent, silent};
}

void go_on() {
  const std::string place = folder().checkpoint();
  try {
    RunState run(settings());
    for (std::size_t shot = 1; shot <= all_shots; ++shot) {
      if (const auto* gather = run.gather(shot)) {
        for (const auto& trace : gather->traces) {
          if (std::int64_t(trace.samples.size()) != gather->axis.count) fail("a trace of another length");
          name_of(trace.header.component);
        }
        continue;
      }
      if (run.finished(shot)) continue;
      const auto pauses = run.pauses_of(shot);
      for (const auto& trace : shoot(scene(), shot, {}, {}, pauses.get()).traces)
        if (std::int64_t(trace.samples.size()) != scene().recording.samples())
          fail("the run recorded a trace of another length");
    }
  } catch (const Unstable&) {
  } catch (const Error& error) {
    const std::string said = error.what();
    if (!said.starts_with(place)) fail("names no file: " + said);
  }
}

}  // namespace

std::vector<std::uint8_t> checkpoint_content(int passes, int shots) {
  {
    RunState run(settings());
    for (std::size_t shot = 1; shot <= std::size_t(shots); ++shot) run.finish(shot, shoot(scene(), shot));
    const std::size_t next = std::size_t(shots) + 1;
    const auto pauses = run.pauses_of(next);
    Leaver leaver(*pauses, passes);
    try {
      shoot(scene(), next, {}, {}, &leaver);
      fail("the shot came to its end before it was left off");
    } catch (const LeftOff&) {
    }
  }
  const CheckpointReader reader(folder().checkpoint());
  auto content = reader.content();
  std::vector<std::uint8_t> bytes(content.left());
  content.bytes(bytes.data(), bytes.size());
  folder().clear();
  return bytes;
}

void go_on_from_content(std::span<const std::uint8_t> content) {
  {
    std::vector<std::uint8_t> bytes(content.begin(), content.end());
    CheckpointWriter writer(folder().checkpoint());
    writer.bytes(bytes.data(), bytes.size());
    writer.commit();
  }
  go_on();
  folder().clear();
}

void go_on_from_file(std::span<const std::uint8_t> file) {
  std::ofstream(folder().checkpoint(), std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), std::streamsize(file.size()));
  go_on();
  folder().clear();
}

}  // namespace slipwave::fuzz
