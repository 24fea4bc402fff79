// SPDX-License-Identifier: BSD-3-Clause
#include "geology/marmousi.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geology/marmousi_strata.hpp"
#include "parallel/threads.hpp"

namespace slipwave {
namespace {

using marmousi::Bed;

const Material water{1500, 0, 1010};
constexpr std::uint64_t water_body = 0;

/// What is under a point of the surface. Depth decides in two steps: the bed, which many points share, and
/// its material.
class Column {
 public:
  Column(const MarmousiSettings& settings, double x_m)
      : settings_(settings), section_(settings.seed, x_m / settings.scale) {}
  Bed bed_at(double z_m) const {
    if (z_m < settings_.water_m) return {water_body};
    return marmousi::bed_at(settings_.seed, section_, place_at(z_m));
  }
  Material material_of(const Bed& bed, double z_m) const {
    if (bed.body == water_body) return water;
    auto material = marmousi::material_of(bed, section_, place_at(z_m));
    if (settings_.vp_over_vs) material.vs = material.vp / *settings_.vp_over_vs;
    return material;
  }

 private:
  marmousi::Place place_at(double z_m) const {
    return section_.at((z_m - settings_.water_m) / settings_.scale);
  }

  const MarmousiSettings& settings_;
  marmousi::Section section_;
};

/// The beds at the centres of the cells at one place along x. The sea floor is level, and so are rows.
std::vector<Bed> beds_of(const Grid<2>& grid, const Column& column) {
  std::vector<Bed> beds(std::size_t(grid.shape[1]));
  for (std::size_t k = 0; k < beds.size(); ++k) beds[k] = column.bed_at(grid.depth({0, std::int64_t(k)}));
  return beds;
}

/// Is a body other than the cell's own at the centre of one of the eight cells around it?
bool is_cut(const std::array<std::vector<Bed>, 3>& beds, std::size_t k) {
  for (const auto& column : beds) {
    for (std::size_t n = k > 0 ? k - 1 : 0; n < std::min(k + 2, column.size()); ++n) {
      if (column[n].body != beds[1][k].body) return true;
    }
  }
  return false;
}

constexpr int points_x = 4, points_z = 8;

/// The mean over points spread evenly through a cell. Those of one bed differ by its gradient only, so one
/// stands for all; and what lies between two points of a bed, one below the other, is taken for that bed too.
class CellMean {
 public:
  explicit CellMean(const Grid<2>& grid) : grid_(grid) {}
  Material operator()(std::int64_t k, const Material& centre, const std::array<Column, points_x>& columns) {
    parts_.clear();
    for (const auto& column : columns) {
      const auto z_of = [&](int n) {
        const double share = (n + 0.5) / points_z;
        if (!grid_.rows) return grid_.origin_m[1] + (double(k) + share) * grid_.spacing_m;
        const double upper = grid_.rows->corner({0, k}), lower = grid_.rows->corner({0, k + 1});
        return upper + share * (lower - upper);
      };
      std::array<Bed, points_z> beds;
      beds.front() = column.bed_at(z_of(0));
      beds.back() = column.bed_at(z_of(points_z - 1));
      fill_between(beds, 0, points_z - 1, [&](int n) { return column.bed_at(z_of(n)); });
      for (int n = 0; n < points_z; ++n) {
        const auto& bed = beds[std::size_t(n)];
        auto part =
            std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.body == bed.body; });
        if (part == parts_.end()) part = parts_.insert(part, {bed.body, column.material_of(bed, z_of(n)), 0});
        part->points += 1;
      }
    }
    MaterialMean mean(centre);
    for (const auto& part : parts_) mean.add(part.material, part.points);
    return mean.mean();
  }

 private:
  struct Part {
    std::uint64_t body;
    Material material;
    double points;
  };

  template <class BedAt>
  static void fill_between(std::array<Bed, points_z>& beds, int from, int to, const BedAt& bed_at) {
    if (to - from < 2) return;
    if (beds[std::size_t(from)].body == beds[std::size_t(to)].body) {
      std::fill(beds.begin() + from + 1, beds.begin() + to, beds[std::size_t(from)]);
      return;
    }
    const int middle = (from + to) / 2;
    beds[std::size_t(middle)] = bed_at(middle);
    fill_between(beds, from, middle, bed_at);
    fill_between(beds, middle, to, bed_at);
  }

  const Grid<2>& grid_;
  std::vector<Part> parts_;
};

void check_settings(const Grid<2>& grid, const MarmousiSettings& settings) {
  const auto refuse = [](const std::string& name, double value, const std::string& expected) {
    throw Error("found a " + name + " of " + shown(value) + ", expected " + expected, ErrorKind::usage);
  };
  if (!(settings.water_m >= 0)) refuse("depth of water", settings.water_m, "it not below zero");
  if (!(settings.scale > 0)) refuse("scale", settings.scale, "it above zero");
  // Beds and provinces are counted by whole numbers.
  constexpr double widest_m = 1e9;
  for (const double length : {grid.end(0), grid.end(1), settings.water_m}) {
    if (!(length / settings.scale <= widest_m))
      refuse("length", length, "it at most " + shown(widest_m) + " m times the scale");
  }
  if (settings.vp_over_vs && !(*settings.vp_over_vs >= std::sqrt(2.)))
    refuse("vp/vs", *settings.vp_over_vs, "at least sqrt(2)");
}

}  // namespace

Fit<2> fit_marmousi(const Grid<2>& regular, const MarmousiSettings& settings, const FitChoice& choice) {
  check_settings(regular, settings);
  std::vector<FitHorizon> horizons;
  if (settings.water_m > 0 && settings.water_m < regular.end(1)) {
    const std::vector<double> depths(corner_columns(regular).size(), settings.water_m);
    horizons.push_back({"floor", "floor at " + shown(settings.water_m) + " m", "floor", true, false, depths});
  }
  return fit_grid(regular, horizons, choice);
}

Medium<2> marmousi_medium(const Grid<2>& grid, const MarmousiSettings& settings, bool average) {
  check_settings(grid, settings);
  Medium<2> medium(grid);
  const auto column_at = [&](double cells) {
    return Column(settings, grid.origin_m[0] + cells * grid.spacing_m);
  };
  const auto fill = [&](std::int64_t begin, std::int64_t end, int) {
    // Those to the left, here and to the right; beyond the edges too.
    std::array<std::vector<Bed>, 3> beds;
    for (std::size_t n = 1; n < 3; ++n) beds[n] = beds_of(grid, column_at(double(begin) + double(n) - 1.5));
    CellMean mean_of(grid);
    for (std::int64_t i = begin; i < end; ++i) {
      std::rotate(beds.begin(), beds.begin() + 1, beds.end());
      beds[2] = beds_of(grid, column_at(double(i) + 1.5));
      const auto column = column_at(double(i) + 0.5);
      const std::array<Column, points_x> columns{column_at(double(i) + 0.125), column_at(double(i) + 0.375),
                                                 column_at(double(i) + 0.625), column_at(double(i) + 0.875)};
      for (std::int64_t k = 0; k < grid.shape[1]; ++k) {
        const auto centre = column.material_of(beds[1][std::size_t(k)], grid.depth({i, k}));
        put(medium, std::size_t(grid.flat({i, k})),
            average && is_cut(beds, std::size_t(k)) ? mean_of(k, centre, columns) : centre);
      }
    }
  };
  parallel_for(grid.shape[0], 16, fill);
  return medium;
}

}  // namespace slipwave
