// SPDX-License-Identifier: BSD-3-Clause
#include "traces/section_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "segy/geometry.hpp"
#include "traces/section.hpp"

namespace slipwave {
namespace {

using Place = std::array<double, 2>;

Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1]}; }
double length(const Place& a) { return std::hypot(a[0], a[1]); }
double cross(const Place& a, const Place& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1]; }

/// Words that place a trace: where it is said, and in which bytes.
struct PlaceBytes {
  segy::FieldName<segy::TraceLayout> x, y;
  const char* bytes;
};
constexpr std::array<PlaceBytes, 3> place_bytes = {
    {{"cdpx", "cdpy", "181 to 188"}, {"sx", "sy", "73 to 80"}, {"gx", "gy", "81 to 88"}}};
struct LineBytes {
  segy::FieldName<segy::TraceLayout> line, cross_line;
  const char *line_byte, *cross_byte;
};
constexpr std::array<LineBytes, 2> line_bytes = {
    {{"iline", "xline", "189", "193"}, {"fldr", "cdp", "9", "21"}}};

/// A trace as a column of cells.
struct Column {
  std::vector<float> samples;
  std::array<Place, place_bytes.size()> places_m{};
  std::array<std::pair<std::int64_t, std::int64_t>, line_bytes.size()> numbers{};
};

/// How columns lie: column number of (i along x, j along y) is order[j nx + i].
struct Lattice {
  std::size_t nx = 0, ny = 1;
  std::vector<std::size_t> order;
  std::size_t at(std::size_t i, std::size_t j) const { return order[j * nx + i]; }
};

class SectionReader {
 public:
  SectionReader(segy::Reader& reader, double step_m, bool trusted)
      : reader_(reader), step_m_(step_m), trusted_(trusted) {}

  ImportedField read() {
    for (segy::Trace trace; reader_.next(trace);) in_place(reader_.name(), [&] { take(trace); });
    return in_place(reader_.name(), [&] { return laid_out(); });
  }

 private:
  ImportedField laid_out() {
    if (columns_.empty()) throw Error("found no samples, expected a section");
    Lattice lattice;
    lattice.nx = columns_.size();
    for (std::size_t n = 0; n < columns_.size(); ++n) lattice.order.push_back(n);
    if (trusted_) {
      check_offsets();
      lattice = find_lattice(std::move(lattice));
      check_places(lattice);
      check_interval();
    }
    return field_of(lattice);
  }
  void take(const segy::Trace& trace);
  void check_offsets() const;
  bool varies(std::size_t kind) const;
  Lattice find_lattice(Lattice line) const;
  std::optional<Lattice> by_numbers(std::size_t kind) const;
  std::optional<Lattice> by_places(std::size_t kind) const;
  void check_places(Lattice& lattice);
  void check_even(const Lattice& lattice, std::size_t kind, const Place& along, const Place& across) const;
  void check_step(const Place& along, std::size_t count, const std::string& what, std::size_t kind) const;
  void turn(Lattice& lattice, Place& along, Place& across) const;
  void say_place(const Lattice& lattice, std::size_t kind, const Place& along, const Place& across);
  void check_interval();
  ImportedField field_of(const Lattice& lattice) const;
  double unit_m() const { return reader_.header().feet ? 0.3048 : 1; }

  segy::Reader& reader_;
  double step_m_;
  bool trusted_;
  std::vector<Column> columns_;
  std::vector<std::string> said_;
  double resolution_m_ = 0, top_m_ = 0, least_offset_m_ = 0, largest_offset_m_ = 0;
  bool in_arc_ = false;
};

void SectionReader::take(const segy::Trace& trace) {
  const auto& words = trace.words;
  const auto number = std::to_string(columns_.size() + 1);
  Column column;
  column.samples.assign(trace.samples.begin(), trace.samples.end());
  const auto scalar = words.get("scalco");
  for (std::size_t kind = 0; kind < place_bytes.size(); ++kind)
    column.places_m[kind] = {unit_m() * segy::scaled(words.get(place_bytes[kind].x), scalar),
                             unit_m() * segy::scaled(words.get(place_bytes[kind].y), scalar)};
  for (std::size_t kind = 0; kind < line_bytes.size(); ++kind)
    column.numbers[kind] = {words.get(line_bytes[kind].line), words.get(line_bytes[kind].cross_line)};
  resolution_m_ = std::max(resolution_m_, unit_m() * std::abs(segy::scaled(1, scalar)));
  in_arc_ = in_arc_ || words.get("counit") > 1;
  const double offset = unit_m() * double(words.get("offset"));
  const double top = unit_m() * reader_.axis_of(trace).start_s / seconds_a_metre;
  if (columns_.empty()) {
    least_offset_m_ = largest_offset_m_ = offset;
    top_m_ = top;
  } else if (column.samples.size() != columns_.front().samples.size()) {
    throw Error("trace " + number + ": found " + std::to_string(column.samples.size()) +
                " samples, expected " + std::to_string(columns_.front().samples.size()) + " as in the first");
  }
  if (top != top_m_)
    throw Error("trace " + number + ": begins at a depth of " + shown(top, 6) +
                " m (byte 109, 1 ms for 1 m), " + "expected " + shown(top_m_, 6) + " m as of the first");
  least_offset_m_ = std::min(least_offset_m_, offset);
  largest_offset_m_ = std::max(largest_offset_m_, offset);
  columns_.push_back(std::move(column));
}

void SectionReader::check_offsets() const {
  if (least_offset_m_ == largest_offset_m_) return;
  throw Error("found offsets from " + shown(least_offset_m_) + " to " + shown(largest_offset_m_) +
              " m (byte 37), which gathers have; expected a model, a trace a column; --allow-rough takes it "
              "for one");
}

bool SectionReader::varies(std::size_t kind) const {
  return std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) {
    return column.places_m[kind] != columns_.front().places_m[kind];
  });
}

/// Whether numbers of lines have one step from each to the next.
bool is_even(const std::map<std::int64_t, std::size_t>& numbers) {
  const auto first = numbers.begin(), second = std::next(first);
  const auto step = second->first - first->first;
  std::int64_t expected = first->first;
  return std::all_of(numbers.begin(), numbers.end(), [&](const auto& number) {
    const bool fits = number.first == expected;
    expected += step;
    return fits;
  });
}

std::optional<Lattice> SectionReader::by_numbers(std::size_t kind) const {
  std::map<std::int64_t, std::size_t> lines, crosses;  // number: how many traces, then its rank
  for (const auto& column : columns_) {
    ++lines[column.numbers[kind].first];
    ++crosses[column.numbers[kind].second];
  }
  const std::size_t ny = lines.size(), nx = crosses.size();
  if (nx < 2 || ny < 2) return {};
  std::string sizes;
  const bool full = nx * ny == columns_.size();
  // A line through a volume passes few of its places, and may pass any.
  const bool is_volume = full || (kind == 0 && columns_.size() > nx + ny);
  if (!is_volume) return {};
  const auto refuse = [&](const std::string& what) {
    throw Error("found " + std::to_string(ny) + " in-lines (byte " + line_bytes[kind].line_byte + ") and " +
                std::to_string(nx) + " cross-lines (byte " + line_bytes[kind].cross_byte + ") in " +
                std::to_string(columns_.size()) + " traces, " + what +
                "; expected a volume with a trace at each place, evenly numbered");
  };
  std::size_t rank = 0;
  for (auto& line : lines) line.second = rank++;
  rank = 0;
  for (auto& line : crosses) line.second = rank++;
  Lattice lattice;
  lattice.nx = nx;
  lattice.ny = ny;
  constexpr auto none = std::size_t(-1);
  lattice.order.assign(nx * ny, none);
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    const auto& [line, cross_line] = columns_[n].numbers[kind];
    auto& at = lattice.order[lines[line] * nx + crosses[cross_line]];
    if (at != none) {
      if (kind != 0) return {};
      refuse("in-line " + std::to_string(line) + " cross-line " + std::to_string(cross_line) + " twice");
    }
    at = n;
  }
  if (!full) refuse("not one for each");
  if (!is_even(lines) || !is_even(crosses)) {
    if (kind != 0) return {};
    refuse("with gaps in their numbers");
  }
  return lattice;
}

/// Lines of equal length, one behind the other.
std::optional<Lattice> SectionReader::by_places(std::size_t kind) const {
  const auto place = [&](std::size_t n) { return columns_[n].places_m[kind]; };
  const double tolerance = 2 * resolution_m_ + 1e-3 * step_m_;
  const Place along = place(1) - place(0);
  std::size_t nx = 2;
  while (nx < columns_.size() && length(place(nx) - place(nx - 1) - along) <= tolerance) ++nx;
  if (nx == columns_.size() || columns_.size() % nx != 0) return {};
  const Place across = place(nx) - place(0);
  if (std::abs(cross(along, across)) <= 1e-3 * length(along) * length(across)) return {};
  for (std::size_t n = nx; n < columns_.size(); ++n)
    if (length(place(n) - place(n - nx) - across) > tolerance) return {};
  Lattice lattice;
  lattice.nx = nx;
  lattice.ny = columns_.size() / nx;
  for (std::size_t n = 0; n < columns_.size(); ++n) lattice.order.push_back(n);
  return lattice;
}

Lattice SectionReader::find_lattice(Lattice line) const {
  for (std::size_t kind = 0; kind < line_bytes.size(); ++kind)
    if (const auto lattice = by_numbers(kind)) return *lattice;
  for (std::size_t kind = 0; kind < place_bytes.size() && columns_.size() > 3; ++kind)
    if (!in_arc_ && varies(kind))
      if (const auto lattice = by_places(kind)) return *lattice;
  return line;
}

void SectionReader::check_step(const Place& along, std::size_t count, const std::string& what,
                               std::size_t kind) const {
  const double found = length(along), steps = double(count - 1);
  if (std::abs(found - step_m_) * steps <= 1.5 * resolution_m_ + 1e-3 * step_m_ * steps) return;
  throw Error(what + " are " + shown(found, 6) + " m apart (bytes " + place_bytes[kind].bytes +
              "), expected " + shown(step_m_) + " m as --step says: give --step " + shown(found, 6) +
              ", then --resample for other cells; --allow-rough takes --step all the same");
}

/// Every place must be where the lattice has it, to the rounding of header words.
void SectionReader::check_even(const Lattice& lattice, std::size_t kind, const Place& along,
                               const Place& across) const {
  const Place& first = columns_[lattice.at(0, 0)].places_m[kind];
  const double tolerance = 1.5 * resolution_m_ + 1e-2 * step_m_;
  for (std::size_t j = 0; j < lattice.ny; ++j)
    for (std::size_t i = 0; i < lattice.nx; ++i) {
      const auto n = lattice.at(i, j);
      const Place expected = {first[0] + double(i) * along[0] + double(j) * across[0],
                              first[1] + double(i) * along[1] + double(j) * across[1]};
      const Place& found = columns_[n].places_m[kind];
      if (length(found - expected) <= tolerance) continue;
      throw Error("trace " + std::to_string(n + 1) + ": lies at " + shown(found[0]) + ", " + shown(found[1]) +
                  " m (bytes " + place_bytes[kind].bytes + "), expected " + shown(expected[0], 9) + ", " +
                  shown(expected[1], 9) + " m, evenly between the first and the last of its line" +
                  (lattice.ny > 1 ? " and its cross-line" : "") +
                  "; --allow-rough takes traces for columns all the same");
    }
}

/// x along the map's x where one of the lines is, else along cross-lines; y to its left.
void SectionReader::turn(Lattice& lattice, Place& along, Place& across) const {
  const auto is_parallel = [](const Place& line, std::size_t axis) {
    return std::abs(line[1 - axis]) <= 1e-3 * std::abs(line[axis]);
  };
  const bool is_volume = lattice.ny > 1;
  if (is_volume && is_parallel(along, 1) && is_parallel(across, 0)) {
    Lattice other{lattice.ny, lattice.nx, {}};
    for (std::size_t j = 0; j < other.ny; ++j)
      for (std::size_t i = 0; i < other.nx; ++i) other.order.push_back(lattice.at(j, i));
    lattice = std::move(other);
    std::swap(along, across);
  }
  if (is_parallel(along, 0) && along[0] < 0) {
    for (std::size_t j = 0; j < lattice.ny; ++j)
      std::reverse(lattice.order.begin() + std::ptrdiff_t(j * lattice.nx),
                   lattice.order.begin() + std::ptrdiff_t((j + 1) * lattice.nx));
    along = {-along[0], -along[1]};
  }
  if (!is_volume || cross(along, across) >= 0) return;
  Lattice other{lattice.nx, lattice.ny, {}};
  for (std::size_t j = lattice.ny; j-- > 0;)
    for (std::size_t i = 0; i < lattice.nx; ++i) other.order.push_back(lattice.at(i, j));
  lattice = std::move(other);
  across = {-across[0], -across[1]};
}

void SectionReader::say_place(const Lattice& lattice, std::size_t kind, const Place& along,
                              const Place& across) {
  const Place& first = columns_[lattice.at(0, 0)].places_m[kind];
  Place origin = {first[0] - along[0] / 2 - across[0] / 2, first[1] - along[1] / 2 - across[1] / 2};
  // Words are rounded: what is an origin within that is 0.
  for (double& part : origin) part = std::abs(part) <= resolution_m_ ? 0 : part;
  const double azimuth = std::atan2(along[0], along[1]) * 180 / std::numbers::pi;
  const bool turned = std::abs(azimuth - 90) > 0.05;
  const bool at_origin =
      std::abs(origin[0]) < step_m_ / 2 && (lattice.ny == 1 || std::abs(origin[1]) < step_m_ / 2);
  if (at_origin && !turned) return;
  said_.push_back("x = 0 of the model is at " + shown(origin[0], 9) + "," + shown(origin[1], 9) +
                  " on the map of the traces (bytes " + place_bytes[kind].bytes + "): sw-shoot --origin " +
                  shown(origin[0], 9) + "," + shown(origin[1], 9) +
                  (turned ? " --azimuth " + shown(azimuth, 5) : "") + " brings a survey into it");
}

void SectionReader::check_places(Lattice& lattice) {
  if (in_arc_) {
    said_.emplace_back("coordinates of the traces are in arc (byte 89) and were not compared with --step");
    return;
  }
  std::optional<std::size_t> best;
  for (std::size_t kind = 0; kind < place_bytes.size(); ++kind) {
    if (!varies(kind)) continue;
    const auto place = [&](std::size_t i, std::size_t j) {
      return columns_[lattice.at(i, j)].places_m[kind];
    };
    const auto share = [](const Place& a, std::size_t count) {
      return count < 2 ? Place{} : Place{a[0] / double(count - 1), a[1] / double(count - 1)};
    };
    Place along = share(place(lattice.nx - 1, 0) - place(0, 0), lattice.nx);
    Place across = share(place(0, lattice.ny - 1) - place(0, 0), lattice.ny);
    check_even(lattice, kind, along, across);
    if (lattice.ny == 1) {
      check_step(along, lattice.nx, "traces", kind);
    } else {
      check_step(along, lattice.nx, "traces of an in-line", kind);
      check_step(across, lattice.ny, "in-lines", kind);
      if (std::abs(dot(along, across)) > 1e-2 * length(along) * length(across))
        throw Error("in-lines and cross-lines are not at right angles (bytes " +
                    std::string(place_bytes[kind].bytes) + "), expected cells that are cubes");
    }
    if (!best) {
      best = kind;
      turn(lattice, along, across);
      say_place(lattice, kind, along, across);
    }
  }
  if (best) return;
  const auto stays = std::find_if(place_bytes.begin(), place_bytes.end(), [&](const PlaceBytes& kind) {
    return columns_.front().places_m[std::size_t(&kind - place_bytes.data())] != Place{};
  });
  if (stays != place_bytes.end() && columns_.size() > 1)
    throw Error("all traces lie at one place (bytes " + std::string(stays->bytes) +
                "), expected columns of a model; --allow-rough takes them for some");
}

/// 1 ms for 1 m is what most write; others write metres, decimetres or centimetres as they are.
void SectionReader::check_interval() {
  const double interval_us = reader_.axis().interval_s * 1e6;
  if (!(interval_us > 0)) return;
  for (const double us_a_metre : {1000, 100, 10, 1})
    if (std::abs(unit_m() * interval_us - us_a_metre * step_m_) <= 2e-3 * us_a_metre * step_m_) return;
  said_.push_back("samples are " + shown(unit_m() * interval_us / 1000, 6) +
                  " m apart if the interval (byte 3217, " + shown(interval_us, 9) +
                  " us) has 1 ms for 1 m; taken " + shown(step_m_) + " m apart, as --step says");
}

ImportedField SectionReader::field_of(const Lattice& lattice) const {
  Grid<3> grid;
  const auto depths = std::int64_t(columns_.front().samples.size());
  grid.shape = {std::int64_t(lattice.nx), std::int64_t(lattice.ny), depths};
  grid.spacing_m = step_m_;
  grid.origin_m = {0, 0, top_m_};
  ImportedField field;
  field.is_section = lattice.ny == 1;
  field.values = Field<3>(grid);
  field.said = said_;
  const std::size_t columns = lattice.order.size();
  for (std::size_t n = 0; n < columns; ++n) {
    const auto& samples = columns_[lattice.order[n]].samples;
    for (std::size_t k = 0; k < samples.size(); ++k) field.values[k * columns + n] = samples[k];
  }
  return field;
}

}  // namespace

ImportedField read_section(segy::Reader& reader, double step_m, bool trusted) {
  return SectionReader(reader, step_m, trusted).read();
}

}  // namespace slipwave
