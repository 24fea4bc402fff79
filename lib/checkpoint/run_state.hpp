// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "base/interruption.hpp"
#include "base/pauses.hpp"
#include "checkpoint/checkpoint_file.hpp"
#include "checkpoint/file_lock.hpp"
#include "checkpoint/identity.hpp"
#include "checkpoint/snapshot_log.hpp"
#include "gather/trace.hpp"

namespace slipwave {

/// State of a run: which of its shots are finished and what they recorded, and with a checkpoint also
/// where the others are. Shots may run at the same time; all of them pause while a checkpoint is written. It
/// is written when `every_s` have passed since the last, and when a signal asks the run to end.
class RunState {
 public:
  struct Settings {
    std::string path;  // of the checkpoint; empty: there is none
    double every_s = 600;
    std::size_t shots = 1;
    std::size_t first_shot = 1;  // what messages call the first one
    Identity identity;
    std::function<void(const std::string&)> say, warn;
  };
  /// Continues where a run of the same identity stopped. Throws an Error naming the file when there is
  /// one that is damaged, of another run or in use by one, or none can be written there.
  explicit RunState(Settings settings);

  bool keeps_checkpoints() const { return !settings_.path.empty(); }
  /// "1 of 5 shots done, shot 2 at step 120 of 400": where the run continues; empty where it begins.
  const std::string& continues_at() const { return continues_at_; }

  bool finished(std::size_t shot) const { return finished_.count(shot) > 0; }
  /// A finished shot has to be shot again: what it recorded was released and is gone.
  void forget(std::size_t shot) { finished_.erase(shot); }
  /// What a finished shot recorded; null once it was released.
  Gather* gather(std::size_t shot);
  /// A shot has come to its end.
  void finish(std::size_t shot, Gather gather);
  /// What it recorded is in files of its own, and need not be kept any more.
  void release(std::size_t shot);

  /// These return where the snapshots of a shot are logged, and how many of them an earlier run has taken.
  std::string snapshot_log(std::size_t shot) const;
  SnapshotMark snapshots_of(std::size_t shot) const;
  using Mark = std::function<SnapshotMark()>;
  /// Returns the pauses of a shot that is about to be shot; they live as long as it runs. Null without a
  /// checkpoint. `mark` says how far the log of its snapshots is, where it has one.
  std::unique_ptr<Pauses> pauses_of(std::size_t shot, Mark mark = {});

  /// Between shots: writes a checkpoint where it is time, and ends the run where a signal asks for that.
  void checkpoint_if_due();
  /// All outputs are in place: nothing has to be remembered any more.
  void close();

 private:
  class ShotPauses;
  struct Running {
    Serialize keep;
    ShotPlace place;
    Mark mark;
    bool waits = false;
  };
  /// What an earlier run left of a shot that has not continued yet.
  struct LeftOff {
    ShotPlace place;
    SnapshotMark snapshots;
    CheckpointPart content;
  };
  using Clock = std::chrono::steady_clock;

  static Clock::duration in_ticks(double seconds);
  void read(const std::string& path);
  void write();
  void write_checkpoint();
  void serialize_finished(Archive& archive);
  std::string description() const;
  bool wanted() const;
  void pause(std::size_t shot, const Serialize& keep, const ShotPlace& place);
  void leave(std::size_t shot, bool failed);
  bool all_wait() const;

  Settings settings_;
  std::optional<FileLock> lock_;
  std::optional<SignalWatch> watch_;
  std::unique_ptr<CheckpointReader> reader_;
  std::string continues_at_;
  mutable std::mutex mutex_;
  std::condition_variable checkpoint_done_;
  std::map<std::size_t, std::optional<Gather>> finished_;
  std::map<std::size_t, Running> running_;
  std::map<std::size_t, LeftOff> left_off_;
  std::set<std::size_t> logs_, older_logs_;  // that the newest checkpoint and the older one need
  std::uint64_t written_ = 0;                // checkpoints written
  int ends_ = 0;                             // the signal that the newest checkpoint answers
  std::atomic<bool> failed_ = false;         // a shot has: the others may be left anywhere
  std::atomic<Clock::rep> due_ = 0;
};

}  // namespace slipwave
