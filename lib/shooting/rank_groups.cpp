// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/rank_groups.hpp"

#include <algorithm>
#include <cstring>

#include "base/archive.hpp"
#include "base/instantiate.hpp"

namespace slipwave {
namespace {

/// Serializes into bytes, or from them.
class ByteArchive : public Archive {
 public:
  ByteArchive() = default;
  explicit ByteArchive(std::span<const std::byte> packed)
      : packed_(packed.begin(), packed.end()), reads_(true) {}
  void bytes(void* first, std::size_t count) override {
    if (count == 0) return;
    if (reads_) {
      std::memcpy(first, packed_.data() + read_, count);
      read_ += count;
    } else {
      const auto* const from = static_cast<const std::byte*>(first);
      packed_.insert(packed_.end(), from, from + count);
    }
  }
  std::size_t count(std::size_t now, std::size_t) override {
    value(now);
    return now;
  }
  bool at_end() const { return read_ == packed_.size(); }
  std::span<const std::byte> packed() const { return packed_; }

 private:
  std::vector<std::byte> packed_;
  std::size_t read_ = 0;
  bool reads_ = false;
};

void serialize_outcome(Archive& archive, RankGroups::Outcome& outcome) {
  archive.value(outcome.shot);
  archive.value(outcome.report);
  archive.flag(outcome.stable);
  archive.value(outcome.sound_until_s);
  archive.text(outcome.what);
  archive.value(outcome.gather.axis);
  outcome.gather.traces.resize(archive.count(outcome.gather.traces.size(), sizeof(TraceHeader)));
  for (auto& trace : outcome.gather.traces) {
    archive.value(trace.header);
    archive.values(trace.samples);
  }
}

int ranks_a_shot(int all, int wanted, std::size_t shots, bool one_shot_at_a_time, int most) {
  if (wanted < 0 || (wanted > 0 && all % wanted != 0))
    throw CollectiveError("found --ranks-per-shot " + std::to_string(wanted) + " and " + std::to_string(all) +
                              " processes, expected a number that divides them",
                          ErrorKind::usage);
  if (one_shot_at_a_time) {
    if (wanted > 0 && wanted != all)
      throw CollectiveError("found --snapshots and --ranks-per-shot " + std::to_string(wanted) + " of " +
                                std::to_string(all) + " processes, expected all of them at one shot",
                            ErrorKind::usage);
    return all;
  }
  if (wanted > 0) return wanted;
  int found = 1;
  for (int few = 1; few <= (most > 0 ? std::min(most, all) : all); ++few) {
    if (all % few != 0) continue;
    found = few;
    if (std::size_t(all / few) <= shots) break;
  }
  return found;
}

}  // namespace

RankGroups::RankGroups(Ranks& all, int ranks_per_shot, std::size_t shots, bool one_shot_at_a_time, int most)
    : all_(all) {
  const int in_group = ranks_a_shot(all.count(), ranks_per_shot, shots, one_shot_at_a_time, most);
  groups_ = std::size_t(all.count() / in_group);
  number_ = std::size_t(all.number() / in_group);
  auto group = all.split(int(number_));
  if (in_group > 1) group_ = std::move(group);
}

template <int D>
std::vector<RankGroups::Outcome> RankGroups::shoot(const Scene<D>& scene, std::span<const std::size_t> shots,
                                                   const Progress& progress,
                                                   const SnapshotSink<D>& snapshots) const {
  Outcome mine;
  if (number_ < shots.size()) {
    mine.shot = shots[number_];
    try {
      mine.gather = slipwave::shoot(scene, mine.shot, progress, snapshots, nullptr,
                                    scene.slip_diary ? &mine.report : nullptr, group());
    } catch (const Unstable& error) {
      mine.stable = false;
      mine.what = error.what();
      mine.sound_until_s = error.sound_until_s();
      mine.gather = error.gather();
    }
  }
  ByteArchive out;
  if (mine.shot > 0 && (!group_ || group_->number() == 0)) serialize_outcome(out, mine);
  const bool all_stable = smallest_of(&all_, mine.stable ? 1 : 0) == 1;
  ByteArchive in(gather_on_first(all_, out.packed()));
  if (!all_stable && !leads()) throw EndedElsewhere{ErrorKind::unstable};
  std::vector<Outcome> outcomes;
  while (leads() && !in.at_end()) serialize_outcome(in, outcomes.emplace_back());
  for (auto& outcome : outcomes)
    if (!outcome.stable)
      throw Unstable(outcome.what, outcome.shot, std::move(outcome.gather), outcome.sound_until_s);
  return outcomes;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, RankGroups::shoot);

}  // namespace slipwave
