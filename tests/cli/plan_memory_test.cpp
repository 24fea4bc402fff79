// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "shell.hpp"

namespace slipwave::plan_memory_test {
namespace {

/// What sw-shoot --plan says of memory, against the peak that the run has then.
class PlannedMemory : public Shell {
 protected:
  void expect_told(const std::string& command) {
    const auto plan = done(command + " --plan");
    const auto at = plan.find("\n  memory ");
    ASSERT_NE(at, std::string::npos) << plan;
    const double told = std::strtod(plan.c_str() + plan.find_first_not_of(' ', at + 10), nullptr);
    const auto ran = run(command + " -o traces.sgy");
    ASSERT_EQ(ran.code, 0) << ran.err;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_NEAR(told / ran.peak_mib, 1, 0.1) << command << "\ntold " << told << " MiB, took " << ran.peak_mib;
#endif
    EXPECT_GT(told, 28);
  }
};

/// Waves come to nearly all cells, and back: before, memory of cells that they have not reached is not taken.
const std::string shot = " --wavelet ricker:10 -q --threads 1 --receivers 500,100 --record p --time 2 ";

}  // namespace

TEST_F(PlannedMemory, OfRockWithSlipAndSnapshotsIsThatOfTheRun) {
  done(
      "sw-layers --size 6000x6000 --step 10 --layer 0:3000:1600:2300 | "
      "sw-fracture --box 1000:5000,1000:5000 --dip 60 --friction 0.5 --viscosity 0.01 -o m.nc");
  expect_told("sw-shoot m.nc --source 500,120" + shot);
  expect_told("sw-shoot m.nc --source 500,120 --snapshots s.nc --every 0.75" + shot);
}

TEST_F(PlannedMemory, OfAttenuatingRockIsThatOfTheRun) {
  done("sw-layers --size 6000x6000 --step 10 --layer '0:3000:1600:2300 qp=60 qs=40' -o m.nc");
  expect_told("sw-shoot m.nc --source 500,120" + shot);
}

TEST_F(PlannedMemory, OfACubeIsThatOfTheRun) {
  done("sw-layers --size 960x960x640 --step 20 --layer '0:3000:1600:2300 qp=60 qs=40' -o m.nc");
  for (const std::string without : {"--without attenuation ", ""}) {
    if (!long_form() && without.empty()) continue;
    expect_told("sw-shoot m.nc --source 480,480,120 --receivers 480,480,10 " + without +
                "--wavelet ricker:10 -q --threads 1 --record vz --time 0.5");
  }
}

TEST_F(PlannedMemory, OfManyTracesAndShotsIsThatOfTheRun) {
  done("sw-layers --size 1000x1000 --step 10 --layer 0:3000:1600:2300 -o m.nc");
  expect_told(
      "sw-shoot m.nc --source 200:800:300,120 --receivers 10:990:0.98,30 --record vx,vz,p --dt 0.0002 --time "
      "0.2 "
      "--wavelet ricker:10 -q --threads 2");
}

}  // namespace slipwave::plan_memory_test
