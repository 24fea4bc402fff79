// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "build/import.hpp"
#include "geology/layers.hpp"
#include "geology/marmousi.hpp"
#include "io/input_bytes.hpp"
#include "long_form.hpp"

namespace slipwave::model_likeness_test {

// The real Marmousi-II and models of sw-marmousi, measured alike. The tables of docs/marmousi.md are what
// these tests print.

namespace {

/// The rocks of a field below `top` rows, row by row.
using Rows = std::vector<std::vector<double>>;

Rows rows_below(const Field<2>& field, std::int64_t top) {
  Rows rows;
  for (std::int64_t k = top; k < field.grid().shape[1]; ++k) {
    const auto line = field.line(k);
    rows.emplace_back(line.begin(), line.end());
  }
  return rows;
}

std::vector<double> sorted(const Rows& rows) {
  std::vector<double> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  std::sort(values.begin(), values.end());
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

double deviation(const std::vector<double>& values) {
  double sum = 0;
  const double level = mean(values);
  for (const double value : values) sum += std::pow(value - level, 2);
  return std::sqrt(sum / double(values.size()));
}

/// How far values must be moved, on average, to give one histogram the other's shape.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  constexpr int parts = 1000;
  for (int n = 0; n < parts; ++n) {
    const double share = (n + 0.5) / parts;
    sum += std::abs(a[std::size_t(share * double(a.size()))] - b[std::size_t(share * double(b.size()))]);
  }
  return sum / parts;
}

/// What differs from the mean over x at each depth.
Rows anomaly(Rows rows) {
  for (auto& row : rows) {
    const double level = mean(row);
    for (double& value : row) value -= level;
  }
  return rows;
}

/// Where the autocorrelation of the anomaly falls to 1/e, in cells, along x or down.
double correlation_length(const Rows& field, bool along_x) {
  const auto rows = anomaly(field);
  const std::size_t nz = rows.size(), nx = rows[0].size();
  double before = 0, start = 0;
  for (std::size_t lag = 0; lag < (along_x ? nx : nz) / 2; ++lag) {
    double sum = 0, count = 0;
    for (std::size_t k = 0; k + (along_x ? 0 : lag) < nz; ++k)
      for (std::size_t i = 0; i + (along_x ? lag : 0) < nx; ++i, ++count)
        sum += rows[k][i] * rows[k + (along_x ? 0 : lag)][i + (along_x ? lag : 0)];
    const double now = sum / count;
    if (lag == 0) start = now;
    const double level = start / std::exp(1.);
    if (now < level) return double(lag) - (level - now) / (before - now);
    before = now;
  }
  return 1e9;
}

/// Standard deviation of the reflection coefficients from cell to cell down.
double reflectivity(const Rows& vp, const Rows& rho) {
  std::vector<double> coefficients;
  for (std::size_t k = 0; k + 1 < vp.size(); ++k) {
    for (std::size_t i = 0; i < vp[k].size(); ++i) {
      const double a = vp[k][i] * rho[k][i], b = vp[k + 1][i] * rho[k + 1][i];
      coefficients.push_back((b - a) / (b + a));
    }
  }
  return deviation(coefficients);
}

/// Correlation coefficient of two anomalies.
double resemblance(const Rows& a, const Rows& b) {
  const auto p = anomaly(a), q = anomaly(b);
  double pp = 0, qq = 0, pq = 0;
  for (std::size_t k = 0; k < p.size(); ++k)
    for (std::size_t i = 0; i < p[k].size(); ++i)
      pp += p[k][i] * p[k][i], qq += q[k][i] * q[k][i], pq += p[k][i] * q[k][i];
  return pq / std::sqrt(pp * qq);
}

struct Rocks {
  Rows vp, vs, rho;
};

Rocks rocks_of(const Medium<2>& medium) {
  // The sea is 440 m deep; the first row of rock in the real files still has the density of water.
  constexpr std::int64_t rows = 23;
  return {rows_below(medium.vp, rows), rows_below(medium.vs, rows), rows_below(medium.rho, rows)};
}

/// A line of measures, and one of the shares in classes of equal width, in percent.
void print(const std::string& name, const Rows& rows, double low, double width, int classes) {
  constexpr double h = 20;
  const auto all = sorted(rows);
  const auto quantile = [&](double q) { return all[std::size_t(q * double(all.size()))]; };
  std::printf("%-11s mean %5.0f deviation %4.0f quantiles", name.c_str(), mean(all), deviation(all));
  for (const double q : {0.05, 0.25, 0.5, 0.75, 0.95}) std::printf(" %5.0f", quantile(q));
  std::printf(" lengths %3.0f m down %3.0f m along\n%-11s in classes of %.0f from %.0f:",
              h * correlation_length(rows, false), h * correlation_length(rows, true), "", width, low);
  for (int n = 0; n < classes; ++n) {
    const auto begin = std::lower_bound(all.begin(), all.end(), low + n * width);
    const auto end = std::lower_bound(all.begin(), all.end(), low + (n + 1) * width);
    std::printf(" %.1f", 100 * double(end - begin) / double(all.size()));
  }
  std::printf(" %%\n");
}

void print(const std::string& name, const Rocks& rocks) {
  print(name + " vp", rocks.vp, 1500, 500, 7);
  print(name + " vs", rocks.vs, 0, 500, 6);
  print(name + " rho", rocks.rho, 1800, 100, 9);
  std::printf("%-11s reflectivity %.4f\n", name.c_str(), reflectivity(rocks.vp, rocks.rho));
}

class MarmousiLikeness : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* given = std::getenv("SLIPWAVE_SHARED");
    const std::string folder = std::string(given ? given : SLIPWAVE_SHARED_DEFAULT) + "/data/marmousi2/";
    if (!std::filesystem::exists(folder + "marmousi_II_marine.vp")) {
      GTEST_SKIP() << "no " << folder << "; SLIPWAVE_SHARED names the folder of shared data";
    }
    const auto grid = grid_of_size<2>({10000, 3480}, 20);
    const auto read = [&](const std::string& property) {
      return field_from_raw(read_all(folder + "marmousi_II_marine." + property), grid, FastAxis::z);
    };
    real_ = rocks_of({read("vp"), read("vs"), read("rho")});
    print("real", real_);
    for (std::uint64_t seed = 1; seed <= (long_form() ? 6 : 3); ++seed) {
      MarmousiSettings settings;
      settings.seed = seed, settings.water_m = 440;
      drawn_.push_back(rocks_of(marmousi_medium(grid, settings)));
      print("seed " + std::to_string(seed), drawn_.back());
    }
  }

  Rocks real_;
  std::vector<Rocks> drawn_;
};

}  // namespace

TEST_F(MarmousiLikeness, IsOfSpeedsDensitiesAndLengthsButNotOfPlaces) {
  const auto real_vp = sorted(real_.vp), real_rho = sorted(real_.rho);
  const double real_lengths[] = {correlation_length(real_.vp, false), correlation_length(real_.vp, true)};
  const double real_reflectivity = reflectivity(real_.vp, real_.rho);
  for (const auto& rocks : drawn_) {
    const auto vp = sorted(rocks.vp);
    EXPECT_LT(distance(vp, real_vp), 200);  // of a mean of 3186 m/s
    EXPECT_NEAR(mean(vp), mean(real_vp), 0.05 * mean(real_vp));
    EXPECT_NEAR(deviation(vp), deviation(real_vp), 0.15 * deviation(real_vp));
    const auto rho = sorted(rocks.rho);
    EXPECT_LT(distance(rho, real_rho), 60);  // of 2241 kg/m3
    EXPECT_NEAR(mean(rho), mean(real_rho), 0.03 * mean(real_rho));
    EXPECT_NEAR(deviation(rho), deviation(real_rho), 0.35 * deviation(real_rho));
    for (const bool along_x : {false, true}) {
      const double ratio = correlation_length(rocks.vp, along_x) / real_lengths[along_x];
      EXPECT_GT(ratio, 0.5) << along_x;
      EXPECT_LT(ratio, 2) << along_x;
    }
    EXPECT_NEAR(reflectivity(rocks.vp, rocks.rho) / real_reflectivity, 1, 0.3);
    EXPECT_LT(resemblance(rocks.vp, real_.vp), 0.5);
  }
  for (std::size_t a = 0; a < drawn_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_LT(resemblance(drawn_[a].vp, drawn_[b].vp), 0.5) << a << b;
}

}  // namespace slipwave::model_likeness_test
