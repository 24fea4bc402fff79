// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "plot/gather_section.hpp"
#include "plot/page.hpp"
#include "plot/section.hpp"

namespace slipwave::plot {

inline Page page_of_size(const std::string& size, const std::string& title = "") {
  return page_of(Format::png, {size, {}, title, ""});
}

/// 40 x 20 cells of 10 m: void above 50 m, then 1000 m/s, from x = 100 m on 2000, from 300 m on 3000.
inline ModelSection three_blocks() {
  ModelSection section;
  section.property = "vp";
  section.unit = "m/s";
  const Grid<2> grid{{40, 20}, 10, {0, 0}};
  section.values = Field<2>(grid);
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    section.values[std::size_t(cell)] = at[1] < 5    ? NAN
                                        : at[0] < 10 ? 1000.0f
                                        : at[0] < 30 ? 2000.0f
                                                     : 3000.0f;
  }
  return section;
}

/// The same with a set of vertical fractures in x 120 to 280 m, z 100 to 150 m.
inline ModelSection fractured_blocks() {
  ModelSection section = three_blocks();
  const auto grid = section.grid();
  section.fracture = Field<2, std::uint8_t>(grid);
  section.sets = {{"cluster", {{{1, 0}, 0.1, 1e3, 0}}}};
  for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
    const auto at = grid.index(cell);
    section.fracture[std::size_t(cell)] = at[0] >= 12 && at[0] < 28 && at[1] >= 10 && at[1] < 15;
  }
  return section;
}

/// `traces` of 101 samples of 10 ms at x = 0, 25, ... m, silent but for one sample.
inline GatherSection with_spike(std::size_t traces, std::size_t trace, std::size_t sample, float value) {
  GatherSection section;
  section.component = Component::vz;
  section.axis = {101, 0.01, 0};
  for (std::size_t n = 0; n < traces; ++n) {
    TraceHeader header;
    header.component = Component::vz;
    header.channel = std::int64_t(n + 1);
    header.receiver_m = {25.0 * double(n), 0, 5};
    section.headers.push_back(header);
  }
  section.samples.assign(traces * 101, 0.0f);
  section.samples[trace * 101 + sample] = value;
  section.first_shot = section.shots = 1;
  return section;
}

}  // namespace slipwave::plot
