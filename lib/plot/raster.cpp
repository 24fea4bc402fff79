// SPDX-License-Identifier: BSD-3-Clause
#include "plot/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace slipwave::plot {
namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

template <class Value, class Add>
void over_cells(const Value* line, const std::vector<Cells>& columns, const Add& add) {
  for (std::size_t column = 0; column < columns.size(); ++column) {
    for (auto i = columns[column].first; i < columns[column].last; ++i) {
      const auto value = float(line[i]);
      if (!std::isnan(value)) add(column, value);
    }
  }
}

}  // namespace

std::vector<double> even_edges(double low, double step, std::int64_t count) {
  std::vector<double> edges(std::size_t(count) + 1);
  for (std::size_t n = 0; n < edges.size(); ++n) edges[n] = low + double(n) * step;
  return edges;
}

std::vector<double> usual_distances(const std::vector<double>& places) {
  constexpr std::size_t reach = 4;
  std::vector<double> usual;
  for (std::size_t n = 0; n + 1 < places.size(); ++n) {
    std::vector<double> near;
    const std::size_t end = std::min(n + reach + 1, places.size() - 1);
    for (std::size_t k = n < reach ? 0 : n - reach; k < end; ++k) near.push_back(places[k + 1] - places[k]);
    const auto middle = near.begin() + std::ptrdiff_t((near.size() - 1) / 2);
    std::nth_element(near.begin(), middle, near.end());
    usual.push_back(*middle);
  }
  return usual;
}

PlaceCells cells_round(const std::vector<double>& places) {
  constexpr double far = 1.5;  // half way from the next place to the one after it
  const auto usual = usual_distances(places);
  const double first = usual.empty() ? 1 : usual.front(), last = usual.empty() ? 1 : usual.back();
  PlaceCells cells{{places[0] - first / 2}, {}, {}};
  const auto add = [&](double edge, double middle, std::int64_t place) {
    cells.edges.push_back(edge);
    cells.middles.push_back(middle);
    cells.place.push_back(place);
  };
  for (std::size_t n = 0; n < places.size(); ++n) {
    const bool ends = n + 1 == places.size();
    const double next = ends ? places[n] + last : places[n + 1], usually = ends ? last : usual[n];
    if (next - places[n] <= far * usually) {
      add((places[n] + next) / 2, places[n], std::int64_t(n));
      continue;
    }
    add(places[n] + usually / 2, places[n], std::int64_t(n));
    add(next - usually / 2, (places[n] + next) / 2, PlaceCells::gap);
  }
  return cells;
}

std::vector<double> middles_of(const std::vector<double>& edges) {
  std::vector<double> middles(edges.size() - 1);
  for (std::size_t n = 0; n < middles.size(); ++n) middles[n] = (edges[n] + edges[n + 1]) / 2;
  return middles;
}

std::vector<Cells> cells_of_pixels(const Scale& scale, double begin_pt, double end_pt, int pixels,
                                   const std::vector<double>& edges) {
  const auto middles = middles_of(edges);
  const auto first_from = [&](double value) {
    return std::lower_bound(middles.begin(), middles.end(), value) - middles.begin();
  };
  std::vector<Cells> found(static_cast<std::size_t>(pixels));
  const double pixel = (end_pt - begin_pt) / pixels;
  for (int n = 0; n < pixels; ++n) {
    double from = scale.value(begin_pt + n * pixel), to = scale.value(begin_pt + (n + 1) * pixel);
    const double middle = scale.value(begin_pt + (n + 0.5) * pixel);
    if (from > to) std::swap(from, to);
    if (middle < edges.front() || middle > edges.back()) continue;
    Cells& cells = found[std::size_t(n)];
    cells = {first_from(from), first_from(to)};
    if (cells.first < cells.last) continue;
    const auto above = std::upper_bound(edges.begin(), edges.end() - 1, middle) - edges.begin();
    cells = {above - 1, above};
  }
  return found;
}

std::vector<Mix> mixes_of_pixels(const Scale& scale, double begin_pt, double end_pt, int pixels,
                                 const std::vector<double>& edges, const std::vector<double>& middles) {
  std::vector<Mix> found;
  const double pixel = (end_pt - begin_pt) / pixels;
  for (const auto& cells : cells_of_pixels(scale, begin_pt, end_pt, pixels, edges)) {
    const double at = scale.value(begin_pt + (double(found.size()) + 0.5) * pixel);
    found.push_back({cells, {}});
    const auto own = std::size_t(cells.first);
    const bool narrow = std::fabs(scale.place(edges[own + 1]) - scale.place(edges[own])) <= std::fabs(pixel);
    if (cells.last - cells.first != 1 || narrow) continue;
    const auto first = at < middles[std::size_t(cells.first)] ? cells.first - 1 : cells.first;
    if (first < 0 || first + 1 >= std::int64_t(middles.size())) continue;  // outside the outermost middles
    const double low = middles[std::size_t(first)], high = middles[std::size_t(first) + 1];
    found.back() = {{first, first + 2}, (at - low) / (high - low)};
  }
  return found;
}

float mixed(const std::function<float(std::int64_t)>& value, const Mix& mix, Take take) {
  if (mix.share) {
    const float first = value(mix.cells.first), second = value(mix.cells.first + 1);
    if (std::isnan(first) || std::isnan(second)) return *mix.share < 0.5 ? first : second;
    return float(double(first) + *mix.share * (double(second) - double(first)));
  }
  Reduction reduction(take);
  for (auto n = mix.cells.first; n < mix.cells.last; ++n) reduction.add(value(n));
  return reduction.value();
}

Raster interpolated(const std::function<const float*(std::int64_t)>& row, const std::vector<Mix>& columns,
                    const std::vector<Mix>& rows, Take take) {
  Raster raster{int(columns.size()), int(rows.size()), {}};
  raster.values.reserve(columns.size() * rows.size());
  std::map<std::int64_t, std::vector<float>> lines;  // by row, each as wide as the raster
  for (const auto& mix : rows) {
    lines.erase(lines.begin(), lines.lower_bound(mix.cells.first));
    for (auto k = mix.cells.first; k < mix.cells.last; ++k) {
      auto& line = lines[k];
      if (!line.empty()) continue;
      const auto at = [values = row(k)](std::int64_t n) { return values[n]; };
      for (const auto& column : columns) line.push_back(mixed(at, column, take));
    }
    for (std::size_t column = 0; column < columns.size(); ++column)
      raster.values.push_back(mixed([&](std::int64_t k) { return lines.at(k)[column]; }, mix, take));
  }
  return raster;
}

void Reduction::add(float value) {
  if (std::isnan(value)) return;
  sum_ += double(value);
  ++count_;
  const bool farther =
      take_ == Take::greatest ? !(chosen_ >= value) : !(std::fabs(chosen_) >= std::fabs(value));
  if (farther) chosen_ = value;
}

float Reduction::value() const {
  if (take_ != Take::mean) return chosen_;
  return count_ > 0 ? float(sum_ / double(count_)) : no_value;
}

template <class Value>
Raster reduced(const std::function<const Value*(std::int64_t)>& row, const std::vector<Cells>& columns,
               const std::vector<Cells>& rows, Take take) {
  Raster raster{int(columns.size()), int(rows.size()), {}};
  raster.values.reserve(columns.size() * rows.size());
  std::vector<float> line(columns.size());
  std::vector<double> sum(columns.size());
  std::vector<std::int64_t> count(columns.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Cells& cells = rows[n];
    if (n > 0 && cells.first == rows[n - 1].first && cells.last == rows[n - 1].last) {
      raster.values.insert(raster.values.end(), line.begin(), line.end());
      continue;
    }
    std::fill(line.begin(), line.end(), no_value);
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(count.begin(), count.end(), 0);
    for (auto k = cells.first; k < cells.last; ++k) {
      const Value* values = row(k);
      if (take == Take::mean) {
        over_cells(values, columns, [&](std::size_t at, float value) {
          sum[at] += double(value);
          ++count[at];
        });
      } else if (take == Take::greatest) {
        over_cells(values, columns, [&](std::size_t at, float value) {
          if (!(line[at] >= value)) line[at] = value;
        });
      } else {
        over_cells(values, columns, [&](std::size_t at, float value) {
          if (!(std::fabs(line[at]) >= std::fabs(value))) line[at] = value;
        });
      }
    }
    if (take == Take::mean) {
      for (std::size_t at = 0; at < line.size(); ++at) {
        if (count[at] > 0) line[at] = float(sum[at] / double(count[at]));
      }
    }
    raster.values.insert(raster.values.end(), line.begin(), line.end());
  }
  return raster;
}

int pixels_along(double length_pt, const Page& page) {
  return std::max(1, int(std::lround(length_pt * page.scale())));
}

template Raster reduced<float>(const std::function<const float*(std::int64_t)>&, const std::vector<Cells>&,
                               const std::vector<Cells>&, Take);
template Raster reduced<std::uint8_t>(const std::function<const std::uint8_t*(std::int64_t)>&,
                                      const std::vector<Cells>&, const std::vector<Cells>&, Take);

}  // namespace slipwave::plot
