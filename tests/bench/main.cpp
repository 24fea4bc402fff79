// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <fstream>
#include <string>
#include <thread>

#include "bench.hpp"
#include "solver/kernels/kernels.hpp"

namespace {

/// What the processor calls itself, "unknown" where the system does not say.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
  slipwave::bench::register_triad();
  slipwave::bench::register_kernels();
  slipwave::bench::register_steps();
  slipwave::bench::register_cubes();
  slipwave::bench::register_effects();
  slipwave::bench::register_growth();
  benchmark::AddCustomContext("processor", processor_name());
  benchmark::AddCustomContext("threads", std::to_string(std::thread::hardware_concurrency()));
  benchmark::AddCustomContext("instruction_set", slipwave::solver::instruction_set());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
