#include "traces/section.hpp"

#include <cmath>

#include "base/error.hpp"
#include "gather/trace.hpp"
#include "grid/grid.hpp"
#include "segy/geometry.hpp"
#include "segy/text.hpp"

namespace slipwave {
namespace {

std::int64_t unit_code(const std::string& unit) { return unit == "Pa" ? 1 : unit == "m/s" ? 6 : -1; }

std::vector<std::string> text_of(const Grid<2>& grid, const SectionFacts& facts,
                                 const segy::SurveyLayout& layout) {
  std::vector<std::string> entries = facts.entries;
  const double h = grid.spacing_m;
  entries.push_back("Section in depth: " + facts.quantity + (facts.unit.empty() ? "" : ", " + facts.unit));
  entries.push_back("Sample interval in us = step in m times 1000: 1 ms stands for 1 m");
  entries.push_back("Step " + shown(h) + " m, first sample at depth " + shown(grid.centre(1, 0)) + " m");
  entries.push_back("Bytes: trace number 21 (and 193), x at 73, 81 and 181, scalar (byte 71) " +
                    std::to_string(layout.coordinate_scalar));
  return entries;
}

/// Header of column i, numbered from 1 in every way software looks for it.
segy::TraceWords words_of(const TraceHeader& header, const segy::SurveyLayout& layout, std::int64_t number,
                          std::int64_t unit) {
  segy::TraceWords words = segy::words_from_si(header, layout);
  words.set("cdp", number);
  words.set("ep", number);
  words.set("sp", number);
  words.set("xline", number);
  words.set("cdpt", 1);
  words.set("iline", 1);
  words.set("unit", unit);
  words.set("tracl", number);
  return words;
}

}  // namespace

void write_section(OutputFile& out, const Field<2>& section, const SectionFacts& facts,
                   const segy::FileFormat& format) {
  const Grid<2>& grid = section.grid();
  const auto columns = static_cast<std::size_t>(grid.shape[0]);
  const auto rows = static_cast<std::size_t>(grid.shape[1]);
  std::vector<TraceHeader> headers(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    headers[i].channel = static_cast<std::int64_t>(i) + 1;
    headers[i].source_m[0] = headers[i].receiver_m[0] = grid.centre(0, static_cast<std::int64_t>(i));
  }
  for (std::size_t cell = 0; cell < section.size(); ++cell)
    if (!std::isfinite(section[cell]))
      throw Error(facts.quantity + " at " + place_of(grid, static_cast<std::int64_t>(cell)) + " is " +
                  (std::isnan(section[cell]) ? "NaN" : shown(section[cell])) + ", expected a finite number");
  segy::FileInfo info;
  info.format = format;
  info.axis = {grid.shape[1], grid.spacing_m * seconds_a_metre, 0};
  info.layout = segy::layout_of(headers);
  info.text = segy::lay_out_text(text_of(grid, facts, info.layout), format.revision);
  segy::Writer writer(out, info);
  segy::Trace trace;
  for (std::size_t i = 0; i < columns; ++i) {
    trace.words = words_of(headers[i], info.layout, static_cast<std::int64_t>(i) + 1, unit_code(facts.unit));
    trace.samples.resize(rows);
    for (std::size_t k = 0; k < rows; ++k) trace.samples[k] = static_cast<double>(section[k * columns + i]);
    writer.write(trace, false);
  }
}

}  // namespace slipwave
