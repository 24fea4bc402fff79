// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <thread>

#include "checkpoint/run_state.hpp"
#include "refusal.hpp"
#include "scratch.hpp"

namespace slipwave::checkpoint_test {
namespace {

namespace fs = std::filesystem;

class CheckpointFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name = "c") const { return scratch_.file(name); }
  static std::string content(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  static void write(const std::string& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(scratch_.path()))
      all.push_back(entry.path().filename().string());
    std::sort(all.begin(), all.end());
    return all;
  }
  RunState::Settings settings(double every_s = 1e6) const {
    return {path(), every_s, 3, 1, {{"order", "5"}, {"model", "17", false}}, said_, said_};
  }
  std::function<void(const std::string&)> said_ = [this](const std::string& sentence) {
    said += sentence + '\n';
  };
  mutable std::string said;

 private:
  Scratch scratch_;
};

Gather gather_of(std::size_t shot) {
  Gather gather;
  gather.axis = {3, 0.5, 0};
  for (const auto component : {Component::vx, Component::p}) {
    Trace trace{{}, {double(shot), 1e-40, -0.}};
    trace.header.shot = std::int64_t(shot);
    trace.header.component = component;
    trace.header.receiver_m = {1, 2, double(shot)};
    gather.traces.push_back(trace);
  }
  return gather;
}

/// A shot that counts its steps and remembers all of them.
struct Counting {
  std::vector<std::int64_t> steps;
  Serialize keep = [this](Archive& archive) { archive.values(steps); };
  void run_to(std::int64_t last, Pauses& pauses) {
    pauses.begin(keep);
    while (std::int64_t(steps.size()) < last) {
      steps.push_back(std::int64_t(steps.size()));
      if (pauses.wanted()) pauses.pause(keep, {std::int64_t(steps.size()), last});
    }
  }
  bool in_order() const {
    std::vector<std::int64_t> expected(steps.size());
    std::iota(expected.begin(), expected.end(), 0);
    return steps == expected;
  }
};

/// Writes a checkpoint of one finished shot and one in progress.
void leave_off(const RunState::Settings& settings, Gather gather = gather_of(1)) {
  RunState run(settings);
  run.finish(1, std::move(gather));
  Counting shot;
  const auto pauses = run.pauses_of(2);
  shot.steps = {0, 1, 2, 3};
  pauses->pause(shot.keep, {4, 10});
}

}  // namespace

TEST_F(CheckpointFile, HoldsWhatIsFinishedAndWhereTheOthersAre) {
  leave_off(settings());
  RunState run(settings());
  EXPECT_EQ(run.continues_at(), "1 of 3 shots done, shot 2 at step 4 of 10");
  ASSERT_TRUE(run.gather(1));
  EXPECT_FALSE(run.finished(2));
  const auto expected = gather_of(1);
  const auto& found = *run.gather(1);
  EXPECT_EQ(found.axis, expected.axis);
  ASSERT_EQ(found.traces.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(found.traces[n].samples, expected.traces[n].samples);
    EXPECT_EQ(found.traces[n].header.component, expected.traces[n].header.component);
    EXPECT_EQ(found.traces[n].header.receiver_m, expected.traces[n].header.receiver_m);
  }
  Counting shot;
  const auto pauses = run.pauses_of(2);
  pauses->begin(shot.keep);
  EXPECT_EQ(shot.steps, (std::vector<std::int64_t>{0, 1, 2, 3}));
}

TEST_F(CheckpointFile, IsRefusedWithTracesThatNoShotRecords) {
  auto shorter = gather_of(1), other = shorter;
  shorter.traces[1].samples.pop_back();
  other.traces[0].header.component = Component(99);
  for (const auto& gather : {shorter, other}) {
    leave_off(settings(), gather);
    EXPECT_EQ(refusal([&] { RunState run(settings()); }), path() + ": holds traces that no shot records");
    fs::remove(path());
  }
}

TEST_F(CheckpointFile, IsRefusedWhicheverOfItsBytesIsDamaged) {
  leave_off(settings());
  const auto whole = content(path());
  ASSERT_GT(whole.size(), 200u);
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    auto damaged = whole;
    damaged[byte] = char(damaged[byte] ^ (1 << byte % 8));
    write(path(), damaged);
    const auto said = refusal([&] { RunState run(settings()); });
    EXPECT_EQ(said.find(path() + ": "), 0u) << "byte " << byte << ": '" << said << "'";
  }
  write(path(), whole);
  EXPECT_EQ(refusal([&] { RunState run(settings()); }), "");
}

TEST_F(CheckpointFile, IsRefusedWhereverItIsCutOffOrGoesOn) {
  leave_off(settings());
  const auto whole = content(path());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(path(), whole.substr(0, size));
    EXPECT_NE(refusal([&] { RunState run(settings()); }), "") << size;
  }
  for (const std::size_t more : {1, 7, 8, 4096}) {
    write(path(), whole + std::string(more, '\0'));
    EXPECT_NE(refusal([&] { RunState run(settings()); }), "") << more;
  }
}

TEST_F(CheckpointFile, OfAnotherFormatOrRunOrNoneIsRefusedByName) {
  leave_off(settings());
  const auto whole = content(path());
  auto later = whole;
  later[24] = 7;
  write(path(), later);
  EXPECT_EQ(refusal([&] { RunState run(settings()); }),
            path() + ": found a checkpoint of format 7, expected 2");
  write(path(), std::string(5000, 'x'));
  EXPECT_EQ(refusal([&] { RunState run(settings()); }),
            path() + ": is not a checkpoint of sw-shoot, or damaged");
  write(path(), whole);
  auto other = settings();
  other.identity[0].value = "7";
  EXPECT_EQ(refusal([&] { RunState run(other); }),
            path() + ": is of a run with order 5, expected 7; remove it to begin anew");
  other = settings();
  other.identity[1].value = "18";
  EXPECT_EQ(refusal([&] { RunState run(other); }),
            path() + ": is of a run with another model; remove it to begin anew");
  other = settings();
  other.identity.pop_back();
  EXPECT_NE(refusal([&] { RunState run(other); }), "");
  EXPECT_EQ(content(path()), whole);
}

TEST_F(CheckpointFile, KeepsOneOlderAndLeavesNothingWhenClosed) {
  auto often = settings(1e-9);
  RunState run(often);
  Counting shot;
  {
    const auto pauses = run.pauses_of(1);
    shot.run_to(2, *pauses);
    EXPECT_EQ(names(), (std::vector<std::string>{"c", "c.1", "c.lock"}));
    const auto first = content(path());
    pauses->pause(shot.keep, {2, 9});
    EXPECT_EQ(content(path("c.1")), first);
  }
  run.close();
  EXPECT_EQ(names(), std::vector<std::string>{});
  EXPECT_EQ(said, "");
}

TEST_F(CheckpointFile, OfShotsThatRunTogetherIsOneMomentOfAll) {
  // Three shots of different length in three threads, pausing all the time; each run ends with the first shot
  // that has gone its part of the way, and the next continues from the newest moment of all.
  const auto often = settings(1e-3);
  std::array<std::size_t, 3> before{};
  for (int round = 0; round < 4; ++round) {
    RunState run(often);
    std::array<Counting, 3> shots;
    std::array<std::size_t, 3> begun{};
    std::vector<std::thread> threads;
    std::atomic<int> ended = 0;
    for (std::size_t n = 0; n < 3; ++n)
      threads.emplace_back([&run, &shots, &begun, &ended, n] {
        auto pauses = run.pauses_of(n + 1);
        auto& shot = shots[n];
        pauses->begin(shot.keep);
        begun[n] = shot.steps.size();
        // The last one outlasts the others, however threads are kept waiting.
        for (int step = 0; step < 40 + 20 * int(n) || (n == 2 && ended < 2); ++step) {
          shot.steps.push_back(std::int64_t(shot.steps.size()));
          std::this_thread::sleep_for(std::chrono::microseconds(50));
          if (pauses->wanted()) pauses->pause(shot.keep, {std::int64_t(shot.steps.size()), 1000});
        }
        // The last state that a shot stores is the one from which the next run continues.
        pauses->pause(shot.keep, {std::int64_t(shot.steps.size()), 1000});
        pauses.reset();
        ++ended;
      });
    for (auto& thread : threads) thread.join();
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_TRUE(shots[n].in_order());
      EXPECT_GE(begun[n], before[n]);
    }
    // The longest one runs on alone, the others have ended then.
    EXPECT_EQ(run.finished(3), false);
    before = {0, 0, begun[2]};
  }
  EXPECT_GE(before[2], 240u);
  EXPECT_EQ(said, "");
}

TEST_F(CheckpointFile, IsNotWrittenOnceAShotHasFailed) {
  RunState run(settings(1e-9));
  {
    Counting shot;
    const auto pauses = run.pauses_of(1);
    EXPECT_THROW(
        {
          const auto other = run.pauses_of(2);
          throw Error("unstable");
        },
        Error);
    EXPECT_FALSE(pauses->wanted());
    pauses->pause(shot.keep, {1, 2});
  }
  EXPECT_EQ(names(), std::vector<std::string>{"c.lock"});
}

TEST_F(CheckpointFile, OfALogOfSnapshotsCutsItBack) {
  const Grid<2> grid{{3, 2}, 1, {0, 0}};
  const auto field = [&](float value) { return std::vector<Field<2>>{Field<2>(grid, value)}; };
  const auto nothing = [](double, const auto&) { FAIL(); };
  SnapshotMark mark;
  {
    SnapshotLog<2> log(path(), grid, 1, {}, nothing);
    log.append(0.25, field(3));
    log.append(0.5, field(4));
    mark = log.synchronized();
    log.append(0.75, field(5));
  }
  const auto whole = content(path());
  EXPECT_EQ(whole.size(), 3 * (8 + 6 * 4u));
  std::vector<double> times;
  {
    SnapshotLog<2> log(path(), grid, 1, mark, [&](double time_s, const std::vector<Field<2>>& fields) {
      times.push_back(time_s);
      EXPECT_EQ(fields.at(0)[5], time_s == 0.25 ? 3 : 4);
    });
  }
  EXPECT_EQ(times, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(content(path()), whole.substr(0, 2 * (8 + 6 * 4)));
  for (std::size_t byte = 0; byte < mark.bytes; ++byte) {
    auto damaged = whole;
    damaged[byte] = char(damaged[byte] ^ 4);
    write(path(), damaged);
    EXPECT_EQ(refusal([&] { SnapshotLog<2> log(path(), grid, 1, mark, nothing); }),
              path() + ": does not hold what the checkpoint says of it");
  }
  write(path(), whole.substr(0, 40));
  EXPECT_EQ(refusal([&] { SnapshotLog<2> log(path(), grid, 1, mark, nothing); }),
            path() + ": found 40 bytes, expected the 64 of which the checkpoint knows");
}

}  // namespace slipwave::checkpoint_test
