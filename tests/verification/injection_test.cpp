// SPDX-License-Identifier: BSD-3-Clause
// Recorded traces as sources (theory.md (A20)): waves come back to where they began, and the run with them is
// the adjoint of the run that recorded them (A21).

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "acquisition/ground.hpp"
#include "lab.hpp"
#include "scene/scene.hpp"
#include "scratch.hpp"
#include "segy/writer.hpp"
#include "shooting/scene_options.hpp"
#include "solver/simulation.hpp"

namespace slipwave::injection_test {

using solver::Rock;

namespace {

constexpr double h = 10, dt = 0.002;

class Injection : public testing::Test {
 protected:
  ~Injection() override { std::filesystem::remove(path_); }

  /// In a closed box, at one sample a time step.
  static SceneOptions options_of(const std::string& receivers, const std::string& record, double duration_s) {
    SceneOptions options;
    options.survey.receivers = {receivers};
    options.record = record;
    options.duration_s = duration_s;
    options.interval_s = dt;
    options.time_step_s = dt;
    options.top = options.sides = options.bottom = "rigid";
    options.precision = "double";
    return options;
  }
  static Gather run(const SceneOptions& options, const Medium<2>& medium) {
    auto scene = options.without_model<2>();
    scene.model.medium = medium;
    place(scene.survey, Ground<2>(medium.grid()));
    check(scene);
    return shoot(scene, 1);
  }
  /// As a file in doubles, as a run with --inject reads it.
  SceneOptions injecting(SceneOptions options, const Gather& gather, bool reverse) const {
    OutputFile out(path_, OutputFile::Content::binary);
    segy::FileFormat format;
    format.code = 6;
    format.revision = 2;
    segy::write_gather(out, gather, format, {});
    out.commit();
    options.survey.inject = path_;
    options.survey.reverse = reverse;
    return options;
  }
  /// One trace of that component at a place.
  static Gather one_trace(Component component, double x, double z, std::vector<double> samples) {
    TraceHeader header;
    header.shot = 1;
    header.channel = 1;
    header.component = component;
    header.receiver_m = header.source_m = {x, 0, z};
    return {{std::int64_t(samples.size()), dt, 0}, {{header, std::move(samples)}}};
  }
  /// Band-limited noise that begins and ends at 0.
  static std::vector<double> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> samples(count);
    for (int wave = 0; wave < 12; ++wave) {
      const double hz = 3 + double(random() % 1000) / 100, phase = double(random() % 628) / 100;
      for (std::size_t n = 0; n < count; ++n)
        samples[n] += std::sin(2 * M_PI * hz * double(n) * dt + phase) *
                      std::pow(std::sin(M_PI * double(n) / double(count - 1)), 2);
    }
    samples.front() = samples.back() = 0;
    return samples;
  }
  static double product(const std::vector<double>& a, const std::vector<double>& b, bool reversed) {
    double sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[reversed ? b.size() - 1 - n : n];
    return sum;
  }
  /// <d, F m>/<F* d, m> - 1 of a source at s and a receiver at r, F* d by injecting d reversed in time.
  double mismatch(const Medium<2>& medium, Component component, const Point<2>& s, const Point<2>& r) const {
    constexpr std::size_t count = 201;
    const auto m = noise(count, 1), d = noise(count, 2);
    const auto there = [](const Point<2>& at) { return shown(at[0]) + "," + shown(at[1]); };
    const double end_s = double(count - 1) * dt;
    const std::string record = name_of(component);
    const auto forward = run(
        injecting(options_of(there(r), record, end_s), one_trace(component, s[0], s[1], m), false), medium);
    const auto adjoint = run(
        injecting(options_of(there(s), record, end_s), one_trace(component, r[0], r[1], d), true), medium);
    return product(d, forward.traces[0].samples, false) / product(m, adjoint.traces[0].samples, true) - 1;
  }

  Scratch scratch_;
  std::string path_ = scratch_.file("injected.sgy");
};

}  // namespace

// Proves (A20).
TEST_F(Injection, ReversedInTimeFocusesWaterWavesAtTheirSourceAndTime) {
  const auto water = solver::uniform_medium(80, 80, h, {1500, 0, 1000});
  auto forward = options_of("105:695:20,105", "p", 0.6);
  forward.survey.receivers = {"105:695:10,105", "105:695:10,695", "105,115:685:10", "695,115:685:10"};
  forward.survey.sources = {"345,455"};
  forward.wavelet = "ricker:12";
  const auto recorded = run(forward, water);
  // A map of the pressure round the source, 100 m either way.
  auto back = options_of("245:445:20,355", "p", 0.6);
  back.survey.receivers.clear();
  for (int z = 355; z <= 555; z += 20) back.survey.receivers.push_back("245:445:20," + std::to_string(z));
  const auto focused = run(injecting(back, recorded, true), water);
  double largest = 0;
  std::array<double, 3> at{};
  std::size_t when = 0;
  for (const auto& [header, samples] : focused.traces)
    for (std::size_t n = 0; n < samples.size(); ++n)
      if (std::abs(samples[n]) > largest) largest = std::abs(samples[n]), at = header.receiver_m, when = n;
  EXPECT_EQ(at[0], 345);
  EXPECT_EQ(at[2], 455);
  // The peak left the source at 1.5/12 s and is back at the end less that; within a quarter of a period.
  EXPECT_NEAR(double(when) * dt, 0.6 - 1.5 / 12, 0.25 / 12);
}

// Proves (A21).
TEST_F(Injection, OfPressureIsAdjointToRoundingInUniformWater) {
  // Sources at centres of cells are read and injected by one cell, and a step of the scheme transposed is the
  // step of the reversed waves. None comes back from an edge, where stencils end.
  const auto water = solver::uniform_medium(120, 120, h, {1500, 0, 1000});
  EXPECT_LT(std::abs(mismatch(water, Component::p, {545, 605}, {695, 555})), 1e-10);
}

// Proves (A21).
TEST_F(Injection, OfPressureIsAdjointByTheRatioOfBulkModuliInLayeredWater) {
  auto layers = solver::uniform_medium(50, 40, h, {1500, 0, 1000});
  for (std::int64_t k = 20; k < 40; ++k)
    for (std::int64_t i = 0; i < 50; ++i) solver::put(layers, {i, k}, {1700, 0, 1100});
  const double ratio = (1700. * 1700 * 1100) / (1500. * 1500 * 1000);  // of the source to the receiver
  const double found = mismatch(layers, Component::p, {105, 305}, {355, 125}) + 1;
  EXPECT_NEAR(found * ratio, 1, 0.01) << "to the order of the scheme, whose stencils end at interfaces";
}

// Proves (A21).
TEST_F(Injection, OfVelocitiesIsAdjointToTheOrderOfTheSchemeInRock) {
  // Forces are spread smoothly over cells (A8), receivers read by (A1): both are delta functions to the order
  // of the scheme only.
  const auto rock = solver::uniform_medium(50, 40, h, {2500, 1400, 2200});
  for (const Component component : {Component::vx, Component::vz})
    EXPECT_LT(std::abs(mismatch(rock, component, {105, 205}, {355, 125})), 0.02) << name_of(component);
}

}  // namespace slipwave::injection_test
