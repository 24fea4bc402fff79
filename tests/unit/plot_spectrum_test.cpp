// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "gather/fk_file.hpp"
#include "gather/spectrum_file.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "plot/colour_map.hpp"
#include "plot/spectra.hpp"
#include "plot/spectrum_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_spectrum_test {
namespace {

class PlotSpectrum : public testing::Test {
 protected:
  PlotSpectrum()
      : path_(std::filesystem::temp_directory_path() / ("plot_spectrum_" + std::to_string(::getpid()))) {}
  ~PlotSpectrum() override { std::filesystem::remove(path_); }

  std::string path() const { return path_.string(); }
  NetcdfFile open() const { return NetcdfFile::open(path_.string()); }
  void write_means() const {
    OutputFile out(path_.string(), OutputFile::Content::binary);
    const auto file = spectrum_netcdf(out, {{0, 10, 20}, false, "", "", {}});
    std::map<Component, SpectrumMean> means;
    means[Component::vz].add(std::vector<double>{1, 5, 2});
    means[Component::p].add(std::vector<double>{100, 300, 200});
    file->add_means(means);
    file->finish();
  }
  void write_traces(const std::vector<double>& x_m) const {
    OutputFile out(path_.string(), OutputFile::Content::binary);
    const auto file = spectrum_netcdf(out, {{0, 10, 20}, false, "", "", {}});
    for (std::size_t n = 0; n < x_m.size(); ++n) {
      for (const auto component : {Component::vx, Component::vz}) {
        TraceHeader header;
        header.component = component;
        header.receiver_m[0] = x_m[n];
        const double base = component == Component::vz ? 100 : 1;
        file->add(header, std::vector<double>{base, base + double(n), base});
      }
    }
    file->finish();
  }

 private:
  std::filesystem::path path_;
};

TEST_F(PlotSpectrum, MeansAreReadComponentByComponent) {
  write_means();
  const auto spectra = read_spectra(open(), {});
  EXPECT_FALSE(spectra.each());
  EXPECT_EQ(spectra.quantity, "amplitude");
  EXPECT_EQ(spectra.frequencies_hz, (std::vector<double>{0, 10, 20}));
  ASSERT_EQ(spectra.lines.size(), 2u);
  const auto only = read_spectra(open(), Component::vz);
  ASSERT_EQ(only.lines.size(), 1u);
  EXPECT_EQ(only.lines[0].values, (std::vector<double>{1, 5, 2}));
  EXPECT_EQ(only.lines[0].unit, "m/s/Hz");
  EXPECT_THROW(read_spectra(open(), Component::sxx), Error);
}

TEST_F(PlotSpectrum, TracesOfOneComponentStandAtTheirReceivers) {
  write_traces({5, 10, 20});
  const auto spectra = read_spectra(open(), Component::vz);
  EXPECT_TRUE(spectra.each());
  EXPECT_EQ(spectra.place, Spectra::Place::receiver_x);
  EXPECT_EQ(spectra.places, (std::vector<double>{5, 10, 20}));
  ASSERT_EQ(spectra.lines.size(), 3u);
  EXPECT_EQ(spectra.lines[2].values, (std::vector<double>{100, 102, 100}));
  EXPECT_EQ(read_spectra(open(), {}).lines[1].values, (std::vector<double>{1, 2, 1}));
}

TEST_F(PlotSpectrum, TracesThatDoNotAscendStandByNumber) {
  write_traces({5, 20, 10});
  const auto spectra = read_spectra(open(), {});
  EXPECT_EQ(spectra.place, Spectra::Place::trace_number);
  EXPECT_EQ(spectra.places, (std::vector<double>{1, 2, 3}));
}

TEST_F(PlotSpectrum, ThePeakStandsAtItsFrequency) {
  Spectra spectra{"a.nc", "amplitude", {}, {{"vz", "m/s/Hz", {}}}, {}};
  for (int n = 0; n <= 400; ++n) {
    spectra.frequencies_hz.push_back(0.25 * n);
    spectra.lines[0].values.push_back(n == 160 ? 1 : 0);  // at 40 Hz
  }
  Look look;
  look.x = Limits{0, 100};
  const auto pixels = decoded(draw_spectra({spectra}, false, look, page_of_size("1000x600px")).bytes);
  const std::uint32_t colour = pixel_of(line_colour(0)) & 0xffffff;
  // Along the bottom the line runs over the whole axis; high up only the peak is left.
  int left = 1000, right = 0;
  Patch peak{0, 1000, -1, 600, -1};
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < 850; ++x) {
      if (!alike(pixels.at(x, y), colour)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      if (y < 300) peak = {peak.count + 1, std::min(peak.left, x), std::max(peak.right, x), 0, 0};
    }
  }
  ASSERT_GT(peak.count, 10);
  EXPECT_NEAR((peak.left + peak.right) / 2.0, left + 0.4 * (right - left), 3);
}

TEST_F(PlotSpectrum, SpectraOfEachTraceAreDrawnAlone) {
  write_traces({5, 10, 20});
  const auto spectra = read_spectra(open(), {});
  EXPECT_GT(draw_spectra({spectra}, false, {}, page_of_size("")).bytes.size(), 1000u);
  EXPECT_THROW(draw_spectra({spectra, spectra}, false, {}, page_of_size("")), Error);
}

TEST_F(PlotSpectrum, FkSpectraHaveALineForEachWavenumber) {
  {
    OutputFile out(path(), OutputFile::Content::binary);
    FkSpectra spectra({4, 0.25, 0}, {});
    for (const auto component : {Component::vz, Component::p}) {
      for (int n = 0; n < 3; ++n) {
        TraceHeader header;
        header.component = component;
        header.receiver_m[0] = 10.0 * n;
        spectra.add(header, std::vector<double>{component == Component::vz ? 1.0 : 2.0, 0, 0, 0});
      }
    }
    spectra.finish();
    write_fk_netcdf(out, {{4, 0.25, 0}, {}, "", {}}, spectra);
  }
  const auto spectra = read_spectra(open(), Component::p);
  EXPECT_EQ(spectra.place, Spectra::Place::wavenumber);
  EXPECT_EQ(spectra.frequencies_hz, (std::vector<double>{0, 1, 2}));
  ASSERT_EQ(spectra.places.size(), 3u);
  EXPECT_NEAR(spectra.places[0], -1 / 30.0, 1e-12);
  ASSERT_EQ(spectra.lines.size(), 3u);
  EXPECT_EQ(spectra.lines[0].unit, "Pa m/Hz");
  // three equal spikes: all at k = 0, 3 of 2 Pa times 0.25 s times 10 m
  EXPECT_NEAR(spectra.lines[1].values[2], 15, 1e-12);
  EXPECT_NEAR(spectra.lines[0].values[2], 0, 1e-12);
  EXPECT_EQ(read_spectra(open(), {}).lines[0].name, "vz");
  EXPECT_THROW(read_spectra(open(), Component::vx), Error);
}

TEST_F(PlotSpectrum, WavenumbersAndFrequenciesEndWithTheBandOfTheData) {
  // Waves up to 30 Hz and 0.01 1/m, and a ten thousandth of them everywhere.
  Spectra spectra{"a.nc", "amplitude", {}, {}, {}, Spectra::Place::wavenumber};
  for (int n = 0; n <= 500; ++n) spectra.frequencies_hz.push_back(n);
  for (int j = -50; j < 50; ++j) {
    spectra.places.push_back(0.001 * j);
    spectra.lines.push_back({"vz", "m/s/Hz", std::vector<double>(501, 1e-4)});
    for (int n = 5; n <= 30 && std::abs(j) <= 10; ++n) spectra.lines.back().values[std::size_t(n)] = 1;
  }
  const auto map = ColourMap("uniform");
  const auto share = [&](const Look& look) {  // of the panel that has the colour of the waves
    const auto pixels = decoded(draw_spectra({spectra}, false, look, page_of_size("1000x800px")).bytes);
    std::array<int, 2> count{};
    for (int y = 0; y < 800; ++y)
      for (int x = 0; x < 860; ++x)  // less the bar
        for (const int end : {0, 1})
          count[std::size_t(end)] += pixels.at(x, y) == (map.pixel(end) & 0xffffff);
    return double(count[1]) / (count[0] + count[1]);
  };
  EXPECT_NEAR(share({}), (0.021 / 0.022) * (26 / 33.0), 0.05);
  EXPECT_NEAR(share({.x = Limits{-0.0505, 0.0495}, .y = Limits{0, 500}}), 0.21 * (26 / 500.0), 0.005);
}

TEST_F(PlotSpectrum, DispersionImagesHaveVelocitiesOverFrequency) {
  // 1 at 300 m/s and 60 Hz, half of it at all velocities up to 100 Hz, nothing up to 500 Hz.
  Spectra spectra{"a.nc", "amplitude", {}, {}, {}, Spectra::Place::phase_velocity};
  for (int n = 0; n <= 500; ++n) spectra.frequencies_hz.push_back(n);
  for (int j = 0; j < 200; ++j) {
    spectra.places.push_back(100 + 4 * j);
    spectra.lines.push_back({"vz", "m/s/Hz", std::vector<double>(501)});
    for (int n = 0; n <= 100; ++n) spectra.lines.back().values[std::size_t(n)] = 0.5;
  }
  spectra.lines[50].values[60] = 1;
  Look look;
  look.colours = Limits{0, 1};
  const auto pixels = decoded(draw_spectra({spectra}, false, look, page_of_size("1000x800px")).bytes);
  const ColourMap map("uniform");
  const auto patch_of = [&](double share) {
    const auto colour = map.pixel(share) & 0xffffff;
    Patch patch{0, 1000, -1, 800, -1};
    for (int y = 0; y < 800; ++y)
      for (int x = 0; x < 860; ++x)  // less the bar
        if (pixels.at(x, y) == colour)
          patch = {patch.count + 1, std::min(patch.left, x), std::max(patch.right, x), std::min(patch.top, y),
                   std::max(patch.bottom, y)};
    return patch;
  };
  const Patch half = patch_of(0.5), spot = patch_of(1);
  ASSERT_GT(half.count, 10000);
  ASSERT_GT(spot.count, 0);
  // Frequencies from 0 rightwards, to 100.5 Hz where they are half; velocities from 98 to 898 m/s upwards.
  const double per_hz = (half.right - half.left) / 100.5, per_speed = (half.bottom - half.top) / 800.0;
  EXPECT_NEAR((spot.left + spot.right) / 2.0, half.left + 60 * per_hz, 3);
  EXPECT_NEAR((spot.top + spot.bottom) / 2.0, half.bottom - 202 * per_speed, 3);
}

TEST_F(PlotSpectrum, AWavenumberStandsWhereItBelongsWithItsDecibels) {
  // 1 at k = 0.02 and f = 30, a hundredth (-40 dB) at k = -0.04 and f = 80, nothing elsewhere
  Spectra spectra{"a.nc", "amplitude", {}, {}, {}, Spectra::Place::wavenumber};
  for (int n = 0; n <= 100; ++n) spectra.frequencies_hz.push_back(n);
  for (int j = -50; j < 50; ++j) {
    spectra.places.push_back(0.001 * j);
    spectra.lines.push_back({"vz", "m/s/Hz", std::vector<double>(101)});
  }
  spectra.lines[70].values[30] = 1;
  spectra.lines[10].values[80] = 0.01;
  Look look;
  look.x = Limits{-0.0505, 0.0495};
  look.y = Limits{0, 100};
  look.map = "white-black";
  const auto pixels = decoded(draw_spectra({spectra}, true, look, page_of_size("1000x800px")).bytes);
  const auto map = map_of(look, "uniform");
  const auto where = [&](double share) {
    const std::uint32_t colour = map.pixel(share) & 0xffffff;
    Patch patch{0, 1000, -1, 800, -1};
    for (int y = 20; y < 700; ++y)
      for (int x = 100; x < 800; ++x)
        if (alike(pixels.at(x, y), colour))
          patch = {patch.count + 1, std::min(patch.left, x), std::max(patch.right, x), std::min(patch.top, y),
                   std::max(patch.bottom, y)};
    return patch;
  };
  const Patch weak = where(1.0 / 3);  // 20 of 60 dB
  ASSERT_GT(weak.count, 20);
  EXPECT_LT(weak.right - weak.left, 12);
  EXPECT_LT(weak.bottom - weak.top, 12);
}

}  // namespace
}  // namespace slipwave::plot::plot_spectrum_test
