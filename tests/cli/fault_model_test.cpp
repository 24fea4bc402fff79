// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>
#include <new>
#include <vector>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "shell.hpp"

namespace slipwave::fault_model_test {
namespace {

/// What becomes of reading a model, in a process of its own with little time and memory.
enum class End { read, refused, out_of_memory, other };

constexpr rlim_t most_memory = rlim_t(1) << 30;
constexpr rlim_t most_processor_s = 20;

End look(std::vector<char> bytes) {
  try {
    const auto file = NetcdfFile::open(std::move(bytes), "model.nc");
    if (kind_of(file) != "model") return End::refused;
    const auto model = read_model<2>(file);
    check(model, {});
    return End::read;
  } catch (const Error&) {
    return End::refused;
  } catch (const std::bad_alloc&) {
    return End::out_of_memory;
  } catch (...) {
    return End::other;
  }
}

/// The end of `look`, or the number of the signal that came first, negative.
int end_of(const std::vector<char>& bytes) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{most_memory, most_memory}, no_core{0, 0}, time{most_processor_s, most_processor_s};
    setrlimit(RLIMIT_AS, &limit);
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_CPU, &time);
    _exit(int(look(bytes)));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

class FaultOfModels : public Shell {
 protected:
  /// Every `stride`-th byte changed in each of `ways`; how often each end came.
  std::map<int, int> ends_of_flips(const std::string& whole, std::size_t stride,
                                   const std::vector<unsigned char>& ways) {
    std::map<int, int> ends;
    std::vector<char> bytes(whole.begin(), whole.end());
    for (std::size_t at = 0; at < bytes.size(); at += stride)
      for (const unsigned char way : ways) {
        const char before = bytes[at];
        bytes[at] = char(before ^ char(way));
        const int end = end_of(bytes);
        bytes[at] = before;
        ++ends[end];
        EXPECT_GE(end, 0) << "byte " << at << " ^ " << int(way) << ": signal " << -end;
        EXPECT_NE(end, int(End::out_of_memory)) << "byte " << at << " ^ " << int(way);
        EXPECT_NE(end, int(End::other)) << "byte " << at << " ^ " << int(way);
      }
    std::printf("%zu bytes: %d read, %d refused\n", bytes.size(), ends[int(End::read)],
                ends[int(End::refused)]);
    return ends;
  }
};

}  // namespace

TEST_F(FaultOfModels, AnyByteOfANetcdf4FileMayBeWrong) {
  done(
      "sw-layers --size 40x30 --step 5 --layer 0:3000:1500:2200 -o m.nc; sw-fracture m.nc --box 10:30,10:20 "
      "--dip 30 "
      "--friction 0.1 --viscosity 1 -o f.nc");
  const auto whole = content("f.nc");
  // In the long form all places in words of eight bytes.
  ends_of_flips(whole, long_form() ? 31 : 787, {0xff});
}

TEST_F(FaultOfModels, AnyByteOfAClassicFileMayBeWrong) {
  if (run("nccopy 2> /dev/null; test $? -ne 127").code != 0) GTEST_SKIP() << "no nccopy (Debian: netcdf-bin)";
  done("sw-layers --size 40x30 --step 5 --layer 0:3000:1500:2200 -o m.nc");
  for (const std::string kind : {"classic", "64-bit-offset", "cdf5"}) {
    done("nccopy -k " + kind + " m.nc c.nc");
    ends_of_flips(content("c.nc"), long_form() ? 1 : 89, {0xff, 0x01, 0x80});
  }
}

}  // namespace slipwave::fault_model_test
