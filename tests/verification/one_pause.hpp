// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "memory_archive.hpp"
#include "shared_out.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

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
    last_ = place.done;
    throw LeftOff();
  }
  std::int64_t last() const { return last_; }

 private:
  std::vector<char>& kept_;
  int asked_;
  std::atomic<int> times_asked_ = 0;
  std::int64_t last_ = 0;
};

/// Of a shot that is left off again and again, at the third pause each time; none if it does not end.
template <int D>
std::vector<double> samples_in_pieces(const Scene<D>& scene) {
  std::vector<char> kept;
  for (int piece = 0; piece < 50; ++piece) {
    OnePause pause(kept, 3);
    try {
      return all_samples(shoot<D>(scene, 1, {}, {}, &pause));
    } catch (const LeftOff&) {
    }
  }
  return {};
}

}  // namespace slipwave::solver
