// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_probe.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <new>

#include "base/error.hpp"

namespace slipwave::base_netcdf_probe_test {
namespace {

constexpr int cannot_open = -1;

/// A number that the child process and this one both see.
class Shared {
 public:
  Shared()
      : place_(mmap(nullptr, sizeof(std::size_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        value_(new (place_) volatile std::size_t(0)) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() { munmap(place_, sizeof(std::size_t)); }
  volatile std::size_t& operator*() const { return *value_; }

 private:
  void* place_;
  volatile std::size_t* value_;
};

std::string said_of(const std::function<int()>& open, const ProbeLimits& limits = {}) {
  try {
    probe_netcdf(open, limits);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string damaged = "damaged: the HDF5 library cannot read it";

}  // namespace

TEST(NetcdfProbe, HappensInAProcessOfItsOwn) {
  int here = 0;
  const Shared there;
  EXPECT_EQ(said_of([&] {
              here = 1;
              *there = std::size_t(getpid());
              return cannot_open;
            }),
            "");
  EXPECT_EQ(here, 0);
  EXPECT_NE(*there, 0u);
  EXPECT_NE(*there, std::size_t(getpid()));
}

TEST(NetcdfProbe, CallsAFileDamagedThatCrashesTheLibrary) {
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE})
    EXPECT_EQ(said_of([number] { return raise(number); }), damaged) << number;
}

TEST(NetcdfProbe, HearsOfCrashesWhereTheNewsOfChildrenIsIgnored) {
  struct sigaction ignored {
  }, before{}, after{};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGCHLD, &ignored, &before);
  EXPECT_EQ(said_of([] { return raise(SIGSEGV); }), damaged);
  sigaction(SIGCHLD, &before, &after);
  EXPECT_EQ(after.sa_handler, SIG_IGN);
}

TEST(NetcdfProbe, EndsALoopWithoutEnd) {
  EXPECT_EQ(said_of(
                [] {
                  const volatile bool on = true;
                  while (on) {
                  }
                  return cannot_open;
                },
                {1, std::size_t(1) << 30}),
            damaged);
}

TEST(NetcdfProbe, GivesTheLibraryLittleMemory) {
  constexpr std::size_t block = std::size_t(1) << 24, most = std::size_t(1) << 28;
  const Shared taken;
  const auto take_all = [&] {
    // As in a loop that never gives back, and not from the heap: tests before may have left room there.
    while (*taken < 16 * most) {
      if (mmap(nullptr, block, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED)
        break;
      *taken = *taken + block;
    }
    return cannot_open;
  };
  EXPECT_EQ(said_of(take_all, {10, most}), "");
  EXPECT_GE(*taken, most / 2);
  EXPECT_LE(*taken, most);
}

}  // namespace slipwave::base_netcdf_probe_test
