// SPDX-License-Identifier: BSD-3-Clause
#include "traces/section.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "gather/trace.hpp"
#include "grid/grid.hpp"
#include "segy/geometry.hpp"
#include "segy/text.hpp"

namespace slipwave {
namespace {

std::int64_t unit_code(const std::string& unit) { return unit == "Pa" ? 1 : unit == "m/s" ? 6 : -1; }

template <int D>
std::vector<std::string> text_of(const Grid<D>& grid, const SectionFacts& facts,
                                 const segy::SurveyLayout& layout) {
  std::vector<std::string> entries = facts.entries;
  for (auto& command : split(facts.history, '\n'))
    if (!command.empty()) entries.push_back(std::move(command));
  const std::string scalar = std::to_string(layout.coordinate_scalar);
  entries.push_back((D == 2 ? "Section in depth: " : "Volume in depth: ") + facts.quantity +
                    (facts.unit.empty() ? "" : ", " + facts.unit));
  entries.push_back("Sample interval in us = step in m times 1000: 1 ms stands for 1 m");
  entries.push_back("Step " + shown(grid.spacing_m) + " m, first sample at depth " +
                    shown(grid.centre(D - 1, 0)) + " m");
  if (D == 2)
    entries.push_back("Bytes: trace number 21 (and 193), x at 73, 81 and 181, scalar (byte 71) " + scalar);
  else
    entries.push_back("Bytes: in-line (y) 189, cross-line (x) 193, x at 73, 81 and 181, y 4 bytes on, " +
                      ("scalar (byte 71) " + scalar));
  return entries;
}

/// Header of a column of cells, numbered from 1 in every way software looks for it.
segy::TraceWords words_of(const TraceHeader& header, const segy::SurveyLayout& layout,
                          std::int64_t inline_number, std::int64_t crossline, std::int64_t unit) {
  segy::TraceWords words = segy::words_from_si(header, layout);
  words.set("cdp", header.channel);
  words.set("ep", crossline);
  words.set("sp", crossline);
  words.set("xline", crossline);
  words.set("cdpt", 1);
  words.set("iline", inline_number);
  words.set("unit", unit);
  words.set("tracl", header.channel);
  return words;
}

/// Returns the headers of all columns, x fastest.
template <int D>
std::vector<TraceHeader> headers_of(const Grid<D>& grid) {
  std::vector<TraceHeader> headers(std::size_t(grid.size() / grid.shape[D - 1]));
  for (std::size_t n = 0; n < headers.size(); ++n) {
    const auto at = grid.index(static_cast<std::int64_t>(n));
    headers[n].channel = static_cast<std::int64_t>(n) + 1;
    for (int axis = 0; axis < D - 1; ++axis)
      headers[n].source_m[std::size_t(axis)] = headers[n].receiver_m[std::size_t(axis)] =
          grid.centre(axis, at[std::size_t(axis)]);
  }
  return headers;
}

template <int D>
void check_values(const Field<D>& section, const std::string& quantity) {
  for (std::size_t cell = 0; cell < section.size(); ++cell)
    if (!std::isfinite(section[cell]))
      throw Error(quantity + " at " + place_of(section.grid(), static_cast<std::int64_t>(cell)) + " is " +
                  (std::isnan(section[cell]) ? "NaN" : shown(section[cell])) + ", expected a finite number");
}

}  // namespace

template <int D>
std::vector<std::string> write_section(OutputFile& out, const Field<D>& section, const SectionFacts& facts,
                                       const segy::FileFormat& format) {
  const Grid<D>& grid = section.grid();
  check_values(section, facts.quantity);
  const auto headers = headers_of(grid);
  const auto rows = static_cast<std::size_t>(grid.shape[D - 1]);
  segy::FileInfo info;
  info.format = format;
  info.axis = {grid.shape[D - 1], grid.spacing_m * seconds_a_metre, 0};
  info.layout = segy::layout_of(headers);
  info.history = facts.history;
  info.text = segy::lay_out_text(text_of(grid, facts, info.layout), format.revision);
  segy::Writer writer(out, info);
  segy::Trace trace;
  for (std::size_t n = 0; n < headers.size(); ++n) {
    const auto at = grid.index(static_cast<std::int64_t>(n));
    const std::int64_t line = D == 3 ? at[1] + 1 : 1;
    trace.words = words_of(headers[n], info.layout, line, at[0] + 1, unit_code(facts.unit));
    trace.samples.resize(rows);
    for (std::size_t k = 0; k < rows; ++k)
      trace.samples[k] = static_cast<double>(section[k * headers.size() + n]);
    writer.write(trace, false);
  }
  return writer.finish();
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, write_section);

}  // namespace slipwave
