// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "memory_archive.hpp"
#include "plain_and_tiled.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::solver {

/// Expects a shot that continues from a state kept half way, at an odd step, to record the same bits.
template <int D>
void expect_to_continue(const Scene<D>& scene) {
  ShotSimulation<D, float> whole(scene, 1, {}), begun(scene, 1, {}), continued(scene, 1, {});
  whole.run_to(whole.steps());
  begun.run_to(whole.steps() / 2 | 1);
  std::vector<char> kept;
  ToMemory to(kept);
  begun.serialize(to);
  FromMemory from(kept);
  continued.serialize(from);
  EXPECT_TRUE(from.all_used());
  continued.run_to(continued.steps());
  EXPECT_TRUE(samples_of(continued.take_gather()) == samples_of(whole.take_gather()));
}

struct LeftOff {};

/// Ends the shot at its `asked`-th pause or lets it run on; begins with the stored state where there is one.
class OnePause : public Pauses {
 public:
  OnePause(std::vector<char>& kept, int asked) : kept_(kept), asked_(asked) {}
  void begin(const Serialize& keep) override {
    if (kept_.empty()) return;
    FromMemory from(kept_);
    keep(from);
    EXPECT_TRUE(from.all_used());
    kept_.clear();
  }
  bool wanted() override { return ++times_asked_ >= asked_; }
  void pause(const Serialize& keep, const ShotPlace& place) override {
    EXPECT_GT(place.done, 0);
    EXPECT_LT(place.done, place.steps);
    ToMemory to(kept_);
    keep(to);
    throw LeftOff();
  }

 private:
  std::vector<char>& kept_;
  int asked_;
  std::atomic<int> times_asked_ = 0;
};

/// Bits, so that zeros of both signs differ.
template <class Value>
bool same_bits(const std::vector<Value>& one, const std::vector<Value>& other) {
  return one.size() == other.size() &&
         (one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(Value)) == 0);
}

/// Expects a shot that is left off after one to three time tiles again and again, each time taken up by as
/// many other threads in tiles of other sizes, to give what one does that was never interrupted.
template <int D>
void expect_same_in_pieces(Scene<D> scene, const Outcome& whole) {
  SCOPED_TRACE("in pieces");
  const Tiling tilings[] = {{1, D == 2 ? 16 : 7}, {2}, {3, D == 2 ? 112 : 12}};
  Outcome pieces;
  std::vector<char> kept;
  for (int run = 0;; ++run) {
    ASSERT_LT(run, 1000);
    const ThreadLimit limit(1 + run % 3);
    scene.numerics.tiling = tilings[run % 3];
    OnePause pause(kept, 1 + (run + run / 3) % 3);
    try {
      shoot_into(pieces, scene, &pause);
      EXPECT_GT(run, 1);
      break;
    } catch (const LeftOff&) {
    }
  }
  EXPECT_TRUE(same_bits(pieces.samples, whole.samples));
  EXPECT_TRUE(same_bits(pieces.snapshots, whole.snapshots));
  expect_same_diary(pieces, whole);
}

}  // namespace slipwave::solver
