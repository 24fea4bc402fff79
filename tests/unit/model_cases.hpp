// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "model/model.hpp"

namespace slipwave {

inline Grid<2> grid_of(std::int64_t nx, std::int64_t nz, double spacing_m) {
  Grid<2> grid;
  grid.shape = {nx, nz};
  grid.spacing_m = spacing_m;
  return grid;
}

/// Of all cells, kg (2-D: kg per metre).
template <int D>
double mass_of(const Medium<D>& medium) {
  double mass = 0;
  for (const double rho : medium.rho) mass += rho;
  return mass * std::pow(medium.grid().spacing_m, D);
}

/// Rock below `fluid_rows` rows of water.
inline Model<2> water_over_rock(const Grid<2>& grid, std::int64_t fluid_rows) {
  Model<2> model;
  model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const bool fluid = grid.index(cell)[1] < fluid_rows;
    model.medium.vp[std::size_t(cell)] = fluid ? 1500 : 3000;
    model.medium.vs[std::size_t(cell)] = fluid ? 0 : 1500;
    model.medium.rho[std::size_t(cell)] = fluid ? 1000 : 2200;
  }
  return model;
}

inline std::string sentence_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A text file that is there for one test.
class TextFile {
 public:
  explicit TextFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() /
              ("slipwave_" + std::to_string(getpid()) + "_" + std::to_string(std::uintptr_t(this)))) {
    std::ofstream(path_) << content;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace slipwave
