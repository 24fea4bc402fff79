#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "accuracy/response_error.hpp"
#include "response_scenes.hpp"

namespace slipwave::solver {
namespace {

std::string short_name(const std::string& name) {
  for (const char* one : {"come", "P waves", "S waves", "step", "cells", "edges"})
    if (name.find(one) != std::string::npos) return std::string(one).substr(0, 1) == "S" ? "S" : std::string(one).substr(0, 1) == "P" ? "P" : one;
  return "?";
}

TEST(Harness, Measures) {
  const std::uint64_t from = std::uint64_t(std::atoi(std::getenv("FROM")));
  const std::uint64_t to = std::uint64_t(std::atoi(std::getenv("TO")));
  for (auto seed = from; seed < to; ++seed) {
    const ResponseScene drawn(seed, std::getenv("SMALL") != nullptr);
    std::fprintf(stderr, "# %llu %s\n", (unsigned long long)seed, drawn.name().c_str());
    if (std::getenv("LOOK")) continue;
    const auto& scene = drawn.scene();
    check(scene);
    const bool predict = std::getenv("PREDICT");
    const auto exact = predict ? std::vector<std::vector<double>>{} : response_of(drawn.reference());
    const auto measure = [&](const char* what, const Scene<2>& one) {
      if (predict) {
        const auto of = FractureResponse(one).promised(response_setting(one));
        std::printf("%llu %s all %.5f", (unsigned long long)seed, what, of.error);
        for (const auto& cause : of.causes) std::printf(" %s %.5f", short_name(cause.name).c_str(), cause.error);
        std::printf("\n");
        return;
      }
      const double error = error_below(response_of(one), exact, drawn.below_hz(), scene.recording.interval_s);
      std::printf("%llu %s %d %g %d %d %.4f\n", (unsigned long long)seed, what, one.numerics.order, one.numerics.cfl,
                  int(one.numerics.correction), one.numerics.zone_cells, 100 * error);
      std::fflush(stdout);
    };
    measure("own", scene);
    if (std::getenv("OWN")) continue;
    auto other = scene;
    other.numerics.zone_cells = 2 * zone_cells(scene, scene.survey.sources[0]);
    other.numerics.cfl = 0.3;
    other.numerics.order = 9;
    other.numerics.correction = SlipCorrection::centred;
    measure("high3", other);
    other.numerics.cfl = 0.9;
    other.numerics.order = 5;
    other.numerics.zone_cells = 0;
    measure("default", other);
  }
}

}  // namespace
}  // namespace slipwave::solver
