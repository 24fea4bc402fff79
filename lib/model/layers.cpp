#include "model/layers.hpp"

#include <unistd.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/cut_cell.hpp"

namespace slipwave {
namespace {

// vp, vs, rho, the fracture code, and what writing them needs.
constexpr double bytes_a_cell = 16;

std::string short_number(double value) { return shown(std::round(value * 1000) / 1000); }

void check_pile(const std::vector<Layer>& layers) {
  if (layers.empty()) throw Error("found no layer, expected at least one", ErrorKind::usage);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!(std::abs(layers[i].dip_deg) < 90)) {
      throw Error("found a dip of " + shown(layers[i].dip_deg) + " degrees, expected it between -90 and 90",
                  ErrorKind::usage);
    }
    if (i > 0 && layers[i].depth_m < layers[i - 1].depth_m) {
      throw Error("the layer at " + shown(layers[i].depth_m) + " m stands after the one at " +
                      shown(layers[i - 1].depth_m) + " m, expected them from the top down",
                  ErrorKind::usage);
    }
  }
}

}  // namespace

Layer parse_layer(std::string_view text) {
  const auto parts = split(text, ':');
  if (parts.size() != 4 && parts.size() != 5) {
    throw Error("found '" + std::string(text) + "', expected DEPTH:VP:VS:RHO[:DIP]", ErrorKind::usage);
  }
  const auto values = in_place('\'' + std::string(text) + "'", [&] {
    std::vector<double> numbers;
    for (const auto& part : parts) numbers.push_back(parse_number(part));
    return numbers;
  });
  return {values[0], values[1], values[2], values[3], values.size() == 5 ? values[4] : 0};
}

template <int D>
Grid<D> grid_of_size(const Point<D>& size_m, double spacing_m) {
  if (!(spacing_m > 0))
    throw Error("found a step of " + shown(spacing_m) + " m, expected it above zero", ErrorKind::usage);
  Grid<D> grid;
  grid.spacing_m = spacing_m;
  double cells = 1;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double steps = size_m[axis] / spacing_m;
    const double whole = std::round(steps);
    if (whole < 1 || std::abs(steps - whole) > 1e-6) {
      throw Error(shown(size_m[axis]) + " m are " + short_number(steps) + " steps of " + shown(spacing_m) +
                      " m, expected a whole number",
                  ErrorKind::usage);
    }
    cells *= whole;
    grid.shape[axis] = whole < 9e15 ? std::int64_t(whole) : 0;
  }
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (cells * bytes_a_cell > memory) {
    throw Error("found " + shown(cells) + " cells, expected at most " +
                    shown(std::floor(memory / bytes_a_cell / 1e6) * 1e6) +
                    ", what fits the memory of this machine",
                ErrorKind::usage);
  }
  return grid;
}

template <int D>
Medium<D> layered_medium(const Grid<D>& grid, const std::vector<Layer>& layers, bool average) {
  check_pile(layers);
  Medium<D> medium{Field<D>(grid), Field<D>(grid), Field<D>(grid)};
  std::vector<double> slope;
  for (const auto& layer : layers) slope.push_back(std::tan(layer.dip_deg * std::numbers::pi / 180));
  const auto top = [&](std::size_t i, double x) { return layers[i].depth_m + slope[i] * x; };
  std::vector<Cut> cuts(layers.size());
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    const double x = grid.centre(0, at[0]), z = grid.centre(D - 1, at[D - 1]), h = grid.spacing_m;
    std::size_t centre = layers.size();
    while (centre > 0 && top(centre - 1, x) > z) --centre;
    if (centre == 0) continue;  // void
    MaterialMean mean(layers[centre - 1].material());
    if (average) {
      for (std::size_t i = 0; i < layers.size(); ++i)
        cuts[i] = {(top(i, x - h / 2) - z) / h + 0.5, (top(i, x + h / 2) - z) / h + 0.5};
      const auto shares = shares_of_cell(cuts);
      for (std::size_t i = 0; i < layers.size(); ++i) mean.add(layers[i].material(), shares[i]);
    }
    put(medium, std::size_t(cell), mean.mean());
  }
  return medium;
}

template Grid<2> grid_of_size<2>(const Point<2>&, double);
template Grid<3> grid_of_size<3>(const Point<3>&, double);
template Medium<2> layered_medium(const Grid<2>&, const std::vector<Layer>&, bool);
template Medium<3> layered_medium(const Grid<3>&, const std::vector<Layer>&, bool);

}  // namespace slipwave
