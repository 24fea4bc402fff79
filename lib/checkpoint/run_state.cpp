// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/run_state.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>

#include "base/error.hpp"

namespace slipwave {
namespace {

/// How long a piece of an archive will be.
class Length : public Archive {
 public:
  void bytes(void*, std::size_t count) override { bytes_ += count; }
  std::size_t count(std::size_t now, std::size_t) override {
    bytes_ += sizeof(std::uint64_t);
    return now;
  }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::uint64_t bytes_ = 0;
};

void serialize_gather(Archive& archive, Gather& gather) {
  archive.value(gather.axis.count);
  archive.value(gather.axis.interval_s);
  archive.value(gather.axis.start_s);
  gather.traces.resize(archive.count(gather.traces.size(), 1));
  for (auto& [header, samples] : gather.traces) {
    auto& [shot, channel, bin, component, source_m, receiver_m, depth_source_m, depth_receiver_m] = header;
    archive.value(shot);
    archive.value(channel);
    archive.value(bin);
    archive.value(component);
    archive.value(source_m);
    archive.value(receiver_m);
    archive.value(depth_source_m);
    archive.value(depth_receiver_m);
    archive.values(samples);
  }
}

bool is_whole(const Gather& gather) {
  return std::all_of(gather.traces.begin(), gather.traces.end(), [&](const Trace& trace) {
    return trace.header.component >= Component::vx && trace.header.component <= Component::other &&
           std::int64_t(trace.samples.size()) == gather.axis.count;
  });
}

/// A few bytes at a time from one archive to another.
void copy(CheckpointPart from, Archive& to) {
  std::vector<char> block(std::size_t(1) << 18);
  while (from.left() > 0) {
    const auto count = std::size_t(std::min<std::uint64_t>(from.left(), block.size()));
    from.bytes(block.data(), count);
    to.bytes(block.data(), count);
  }
}

std::string place_words(std::size_t shot, const ShotPlace& place) {
  return "shot " + std::to_string(shot) + " at step " + std::to_string(place.done) + " of " +
         std::to_string(place.steps);
}

}  // namespace

/// The link between a running shot and the state of the run.
class RunState::ShotPauses : public Pauses {
 public:
  ShotPauses(RunState& run, std::size_t shot)
      : run_(run), shot_(shot), exceptions_(std::uncaught_exceptions()) {}
  ~ShotPauses() override { run_.leave(shot_, std::uncaught_exceptions() > exceptions_); }
  void begin(const Serialize& keep) override {
    const std::lock_guard lock(run_.mutex_);
    const auto left = run_.left_off_.find(shot_);
    if (left == run_.left_off_.end()) return;
    in_place(run_.settings_.path, [&] { keep(left->second.content); });
    run_.left_off_.erase(left);
  }
  bool wanted() override { return run_.wanted(); }
  void pause(const Serialize& keep, const ShotPlace& place) override { run_.pause(shot_, keep, place); }

 private:
  RunState& run_;
  std::size_t shot_;
  int exceptions_;
};

RunState::RunState(Settings settings) : settings_(std::move(settings)) {
  if (!keeps_checkpoints()) return;
  lock_.emplace(settings_.path + ".lock", settings_.path);
  const auto there = [](const std::string& path) {
    return access(path.c_str(), F_OK) == 0 || errno != ENOENT;
  };
  const auto older = older_checkpoint(settings_.path);
  if (there(settings_.path))
    read(settings_.path);
  else if (there(older))
    read(older);
  // A place where none can be written is said before anything is computed.
  CheckpointWriter probe(settings_.path);
  due_ = (Clock::now() + in_ticks(settings_.every_s)).time_since_epoch().count();
  watch_.emplace();
}

RunState::Clock::duration RunState::in_ticks(double seconds) {
  constexpr double longest_s = 1e9;  // more would not fit the clock
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(seconds, longest_s)));
}

void RunState::read(const std::string& path) {
  try {
    reader_ = std::make_unique<CheckpointReader>(path);
  } catch (const Error& error) {
    const auto older = older_checkpoint(settings_.path);
    if (path == older || access(older.c_str(), F_OK) != 0) throw;
    throw Error(error.what() + ("; " + older + " is the one before"));
  }
  auto content = reader_->content();
  Identity found;
  in_place(path, [&] { slipwave::serialize(content, found); });
  if (const auto difference = difference_of(found, settings_.identity))
    throw Error(path + ": is of a run with " + *difference + "; remove it to begin anew");
  serialize_finished(content);
  for (const auto& [shot, gather] : finished_)
    if (gather && !is_whole(*gather)) throw Error(path + ": holds traces that no shot records");
  auto count = content.count(0, 1);
  for (; count > 0; --count) {
    std::uint64_t shot = 0, bytes = 0;
    ShotPlace place;
    SnapshotMark snapshots;
    content.value(shot);
    content.value(place);
    content.value(snapshots);
    content.value(bytes);
    left_off_.emplace(shot, LeftOff{place, snapshots, content.part(bytes)});
    if (snapshots.bytes > 0) logs_.insert(shot);
  }
  older_logs_ = logs_;
  continues_at_ = description();
}

std::string RunState::description() const {
  std::string words;
  if (settings_.shots > 1)
    words = std::to_string(finished_.size()) + " of " + std::to_string(settings_.shots) + " shots done";
  const auto add = [&](std::size_t shot, const ShotPlace& place) {
    words += (words.empty() ? "" : ", ") + place_words(shot + settings_.first_shot - 1, place);
  };
  for (const auto& [shot, running] : running_)
    if (running.waits) add(shot, running.place);
  for (const auto& [shot, left] : left_off_) add(shot, left.place);
  return words.empty() ? "the shot done" : words;
}

Gather* RunState::gather(std::size_t shot) {
  const auto found = finished_.find(shot);
  return found != finished_.end() && found->second ? &*found->second : nullptr;
}

void RunState::finish(std::size_t shot, Gather gather) {
  const std::lock_guard lock(mutex_);
  finished_[shot] = std::move(gather);
}

void RunState::release(std::size_t shot) { finished_[shot].reset(); }

std::string RunState::snapshot_log(std::size_t shot) const {
  return settings_.path + ".shot" + std::to_string(shot);
}

SnapshotMark RunState::snapshots_of(std::size_t shot) const {
  const auto left = left_off_.find(shot);
  return left == left_off_.end() ? SnapshotMark() : left->second.snapshots;
}

std::unique_ptr<Pauses> RunState::pauses_of(std::size_t shot, Mark mark) {
  if (!keeps_checkpoints()) return nullptr;
  const std::lock_guard lock(mutex_);
  running_[shot].mark = std::move(mark);
  return std::make_unique<ShotPauses>(*this, shot);
}

bool RunState::wanted() const {
  return !failed_ && (watch_->noted() != 0 || Clock::now().time_since_epoch().count() >= due_);
}

bool RunState::all_wait() const {
  return std::all_of(running_.begin(), running_.end(), [](const auto& one) { return one.second.waits; });
}

void RunState::pause(std::size_t shot, const Serialize& keep, const ShotPlace& place) {
  std::unique_lock lock(mutex_);
  auto& self = running_.at(shot);
  self.keep = keep;
  self.place = place;
  self.waits = true;
  const auto before = written_;
  while (before == written_ && !failed_) {
    if (all_wait())
      write_checkpoint();
    else
      checkpoint_done_.wait(lock);
  }
  self.waits = false;
  if (ends_ != 0) throw Interrupted{ends_};
}

/// A shot has ended, one way or the other; others may wait for it.
void RunState::leave(std::size_t shot, bool failed) {
  const std::lock_guard lock(mutex_);
  if (failed) failed_ = true;
  running_.erase(shot);
  checkpoint_done_.notify_all();
}

void RunState::checkpoint_if_due() {
  if (!keeps_checkpoints() || !wanted()) return;
  const std::lock_guard lock(mutex_);
  write_checkpoint();
  if (ends_ != 0) throw Interrupted{ends_};
}

/// While all shots wait. A checkpoint that cannot be written does not end the run: the older one is there.
void RunState::write_checkpoint() {
  ends_ = watch_->noted();
  const std::string ended = ends_ == 0 ? "" : "ended by signal " + std::to_string(ends_);
  try {
    write();
    if (ends_ != 0) settings_.say(ended + "; " + settings_.path + " holds " + description());
  } catch (const Error& error) {
    settings_.warn(ended + (ended.empty() ? "" : "; ") + error.what() +
                   "; the checkpoint was not written, an older one stays as it was; --checkpoint names a "
                   "file elsewhere");
  }
  due_ = (Clock::now() + in_ticks(settings_.every_s)).time_since_epoch().count();
  ++written_;
  for (auto& [shot, running] : running_) running.waits = false;
  checkpoint_done_.notify_all();
}

void RunState::write() {
  CheckpointWriter out(settings_.path);
  std::set<std::size_t> logs;
  slipwave::serialize(out, settings_.identity);
  serialize_finished(out);
  out.count(running_.size() + left_off_.size(), 1);
  const auto announce = [&](std::uint64_t shot, ShotPlace place, SnapshotMark snapshots,
                            std::uint64_t bytes) {
    out.value(shot);
    out.value(place);
    out.value(snapshots);
    out.value(bytes);
    if (snapshots.bytes > 0) logs.insert(shot);
  };
  for (const auto& [shot, running] : running_) {
    Length length;
    running.keep(length);
    announce(shot, running.place, running.mark ? running.mark() : SnapshotMark(), length.bytes());
    running.keep(out);
  }
  for (const auto& [shot, left] : left_off_) {
    announce(shot, left.place, left.snapshots, left.content.left());
    copy(left.content, out);
  }
  out.commit();
  // The older checkpoint stays of use, too.
  for (const auto shot : older_logs_)
    if (logs.count(shot) + logs_.count(shot) == 0) unlink(snapshot_log(shot).c_str());
  older_logs_ = std::exchange(logs_, logs);
}

void RunState::serialize_finished(Archive& archive) {
  std::vector<std::uint64_t> shots;
  for (const auto& [shot, gather] : finished_) shots.push_back(shot);
  archive.values(shots);
  for (const auto shot : shots) {
    auto& gather = finished_[shot];
    bool kept = gather.has_value();
    archive.flag(kept);
    if (kept && !gather) gather.emplace();
    if (kept) serialize_gather(archive, *gather);
  }
}

void RunState::close() {
  if (!keeps_checkpoints()) return;
  unlink(older_checkpoint(settings_.path).c_str());
  unlink(settings_.path.c_str());
  remove_snapshot_logs(settings_.path + ".shot");
  lock_.reset();
}

}  // namespace slipwave
