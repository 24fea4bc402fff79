#include "model/layers.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/cut_cell.hpp"

namespace slipwave {
namespace {

// vp, vs, rho, the fracture code, and what writing them needs.
constexpr double bytes_a_cell = 16;

std::string short_number(double value) { return shown(std::round(value * 1000) / 1000); }

/// Tops of all layers at one x.
std::vector<double> tops_at(const std::vector<Layer>& layers, double x_m) {
  std::vector<double> tops;
  for (const auto& layer : layers) tops.push_back(layer.top.at(x_m));
  return tops;
}

template <int D>
void check_pile(const Grid<D>& grid, const std::vector<Layer>& layers) {
  if (layers.empty()) throw Error("found no layer, expected at least one", ErrorKind::usage);
  const double first = grid.centre(0, 0), last = grid.centre(0, grid.shape[0] - 1);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& top = layers[i].top;
    if (!(top.from_m() <= first && top.to_m() >= last)) {
      throw Error(top.name() + " reaches from x = " + shown(top.from_m()) + " to " + shown(top.to_m()) +
                  " m, expected at least " + shown(first) + " to " + shown(last) +
                  ", the centres of the outer cells");
    }
    if (i == 0) continue;
    const auto& before = layers[i - 1].top;
    if (top.is_plane() && before.is_plane()) {
      if (top.depth_m() >= before.depth_m()) continue;
      throw Error("the layer at " + top.name() + " stands after the one at " + before.name() +
                      ", expected them from the top down",
                  ErrorKind::usage);
    }
    bool above = true;
    for (std::int64_t n = 0; n < grid.shape[0] && above; ++n)
      above = top.at(grid.centre(0, n)) < before.at(grid.centre(0, n));
    if (above) {
      throw Error("the layer at " + top.name() + " lies above the one before it, at " + before.name() +
                      ", all along the model; expected them from the top down",
                  ErrorKind::usage);
    }
  }
}

/// "A", "A+K" or "A-K": a value at the top, and what it gains with depth.
struct Trend {
  double value = 0, gradient = 0;
};

Trend parse_trend(std::string_view text) {
  for (std::size_t n = text.size(); n-- > 1;) {
    if (text[n] != '+' && text[n] != '-') continue;
    if (text[n - 1] == 'e' || text[n - 1] == 'E') continue;  // an exponent's sign
    const double size = parse_number(text.substr(n + 1));
    return {parse_number(text.substr(0, n)), text[n] == '-' ? -size : size};
  }
  return {parse_number(text), 0};
}

}  // namespace

Material Layer::at_depth(double below_top_m) const {
  const double depth = std::max(below_top_m, 0.);
  return {material.vp + gradient.vp * depth, material.vs + gradient.vs * depth,
          material.rho + gradient.rho * depth};
}

Layer parse_layer(std::string_view text) {
  const auto parts = split(text, ':');
  if (parts.size() != 4 && parts.size() != 5) {
    throw Error("found '" + std::string(text) + "', expected DEPTH:VP:VS:RHO[:DIP]", ErrorKind::usage);
  }
  return in_place('\'' + std::string(text) + "'", [&] {
    const auto vp = parse_trend(parts[1]), vs = parse_trend(parts[2]), rho = parse_trend(parts[3]);
    const double dip_deg = parts.size() == 5 ? parse_number(parts[4]) : 0;
    return Layer(Horizon::parse(parts[0], dip_deg), {vp.value, vs.value, rho.value},
                 {vp.gradient, vs.gradient, rho.gradient});
  });
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
  check_pile(grid, layers);
  Medium<D> medium{Field<D>(grid), Field<D>(grid), Field<D>(grid)};
  const double h = grid.spacing_m;
  const std::int64_t columns = grid.shape[0], lines = grid.size() / columns;
  std::vector<std::vector<double>> centre_tops, face_tops;  // face_tops[n] is below cell n, [n + 1] beyond it
  for (std::int64_t n = 0; n < columns; ++n) centre_tops.push_back(tops_at(layers, grid.centre(0, n)));
  for (std::int64_t n = 0; n <= columns; ++n) face_tops.push_back(tops_at(layers, grid.centre(0, n) - h / 2));
  std::vector<Cut> cuts(layers.size());
  for (std::int64_t line = 0; line < lines; ++line) {
    const double z = grid.centre(D - 1, grid.index(line * columns)[D - 1]);
    for (std::int64_t n = 0; n < columns; ++n) {
      const auto &tops = centre_tops[n], &low = face_tops[n], &high = face_tops[n + 1];
      std::size_t centre = layers.size();
      while (centre > 0 && tops[centre - 1] > z) --centre;
      if (centre == 0) continue;  // void
      MaterialMean mean(layers[centre - 1].at_depth(z - tops[centre - 1]));
      bool cut = false;
      for (std::size_t i = 0; i < layers.size(); ++i) {
        cuts[i] = {(low[i] - z) / h + 0.5, (high[i] - z) / h + 0.5};
        cut = cut || (std::min(cuts[i].low, cuts[i].high) < 1 && std::max(cuts[i].low, cuts[i].high) > 0);
      }
      if (average && cut) {
        const auto shares = shares_of_cell(cuts);
        for (std::size_t i = 0; i < layers.size(); ++i) mean.add(layers[i].at_depth(z - tops[i]), shares[i]);
      }
      put(medium, std::size_t(line * columns + n), mean.mean());
    }
  }
  return medium;
}

template <int D>
std::vector<std::string> cut_off_layers(const Grid<D>& grid, const std::vector<Layer>& layers) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
    double from = 0, to = 0;
    std::size_t by = 0;  // the layer that first cuts this one off; 0: none
    for (std::int64_t n = 0; n < grid.shape[0]; ++n) {
      const double x = grid.centre(0, n), top = layers[i].top.at(x);
      for (std::size_t k = i + 1; k < layers.size(); ++k) {
        if (layers[i].top.is_plane() && layers[k].top.is_plane()) continue;
        if (!(layers[k].top.at(x) < top)) continue;
        if (by == 0) by = k, from = x;
        to = x;
      }
    }
    if (by == 0) continue;
    sentences.push_back("the layer at " + layers[i].top.name() + " is cut off by the one at " +
                        layers[by].top.name() + " between x=" + shown(from) + " and x=" + shown(to));
  }
  return sentences;
}

template Grid<2> grid_of_size<2>(const Point<2>&, double);
template Grid<3> grid_of_size<3>(const Point<3>&, double);
template Medium<2> layered_medium(const Grid<2>&, const std::vector<Layer>&, bool);
template Medium<3> layered_medium(const Grid<3>&, const std::vector<Layer>&, bool);

template std::vector<std::string> cut_off_layers(const Grid<2>&, const std::vector<Layer>&);
template std::vector<std::string> cut_off_layers(const Grid<3>&, const std::vector<Layer>&);

}  // namespace slipwave
