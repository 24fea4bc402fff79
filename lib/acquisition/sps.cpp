// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/sps.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {
namespace {

/// Columns of a record, from 1, both included.
struct Columns {
  int first, last;
  const char* what;
};

// The fixed columns of SPS 2.1 (SEG Technical Standards, Shell Processing Support format).
constexpr Columns line_name{2, 11, "line name"}, point_number{12, 21, "point number"},
    point_index{24, 24, "point index"}, point_depth{31, 34, "point depth"},
    easting{47, 55, "map grid easting"}, northing{56, 65, "map grid northing"},
    elevation{66, 71, "surface elevation"};
constexpr Columns record_number{8, 15, "field record number"}, source_line{18, 27, "line name"},
    source_point{28, 37, "point number"}, source_index{38, 38, "point index"},
    from_channel{39, 43, "from channel"}, to_channel{44, 48, "to channel"},
    channel_step{49, 49, "channel increment"}, receiver_line{50, 59, "line name"},
    from_receiver{60, 69, "from receiver"}, to_receiver{70, 79, "to receiver"},
    receiver_index{80, 80, "receiver index"};

/// One record and where it stands.
class Record {
 public:
  Record(const std::string& file, std::int64_t line, std::string_view text)
      : file_(file), line_(line), text_(text) {}

  std::string place() const { return file_ + ": line " + std::to_string(line_); }
  std::string_view text(const Columns& columns) const {
    const auto first = std::min(std::size_t(columns.first - 1), text_.size());
    auto part = text_.substr(first, std::size_t(columns.last) - first);
    const auto begin = part.find_first_not_of(' ');
    if (begin == std::string_view::npos) return {};
    return part.substr(begin, part.find_last_not_of(" \r") - begin + 1);
  }
  [[noreturn]] void refuse(const Columns& columns, const std::string& sentence) const {
    const bool one = columns.first == columns.last;
    throw Error(place() + ": column" + (one ? " " : "s ") + std::to_string(columns.first) +
                (one ? "" : "-" + std::to_string(columns.last)) + " (" + columns.what + "): " + sentence);
  }
  double number(const Columns& columns) const {
    try {
      return parse_number(text(columns));
    } catch (const Error& error) {
      refuse(columns, error.what());
    }
  }
  double number_or(const Columns& columns, double otherwise) const {
    return text(columns).empty() ? otherwise : number(columns);
  }
  std::int64_t integer(const Columns& columns) const {
    try {
      return parse_integer(text(columns));
    } catch (const Error& error) {
      refuse(columns, error.what());
    }
  }
  std::int64_t integer_or(const Columns& columns, std::int64_t otherwise) const {
    return text(columns).empty() ? otherwise : integer(columns);
  }

 private:
  const std::string& file_;
  std::int64_t line_;
  std::string_view text_;
};

/// What names a point: its line, its number and, where it was occupied more than once, its index.
struct PointName {
  double line = 0, point = 0;
  std::int64_t index = 1;
  bool operator==(const PointName&) const = default;
};
struct PointHash {
  std::size_t operator()(const PointName& name) const {
    std::uint64_t sum = std::bit_cast<std::uint64_t>(name.line + 0.0) * 0x9e3779b97f4a7c15U;
    sum = (sum ^ (sum >> 29U) ^ std::bit_cast<std::uint64_t>(name.point + 0.0)) * 0xbf58476d1ce4e5b9U;
    return std::size_t((sum ^ (sum >> 32U)) + std::uint64_t(name.index));
  }
};

std::string text_of(const PointName& name) {
  return "line " + shown(name.line) + " point " + shown(name.point) +
         (name.index == 1 ? "" : " index " + std::to_string(name.index));
}

/// Points of one kind.
struct Points {
  std::unordered_map<PointName, std::uint32_t, PointHash> numbers;
  std::vector<PointName> names;
  std::vector<Place> places;

  void add(const Record& record) {
    const PointName name{record.number(line_name), record.number(point_number),
                         record.integer_or(point_index, 1)};
    Place place;
    place.at_m = {record.number(easting), record.number(northing),
                  record.number_or(point_depth, 0) - record.number_or(elevation, 0)};
    const auto [same, is_new] = numbers.try_emplace(name, std::uint32_t(places.size()));
    if (!is_new && places[same->second] == place) return;
    if (!is_new)
      throw Error(record.place() + ": found " + text_of(name) + " at two places, expected it at one");
    names.push_back(name);
    places.push_back(place);
  }
};

class SpsReader {
 public:
  void take_points(const Record& record, char kind) {
    if (kind == 'S') sources_.add(record);
    if (kind == 'R') receivers_.add(record);
  }
  void take_relation(const Record& record);
  void take_header(const Record& record);
  double metres_of_unit() const;
  void expect_points(const std::string& names) const;
  GivenSurvey finish(const std::string& names) &&;

  /// After all points were taken: relations use them by number.
  void settle();

 private:
  struct ShotRuns {
    std::int64_t number;
    PointName source;
    std::string place;
    std::vector<ReceiverRun> runs;
  };
  std::uint32_t point(const Points& points, const PointName& name, const Record& record,
                      const Columns& columns, const char* kind) const;
  void add_receivers(const Record& record, ShotRuns& shot, const ReceiverRun& channels);

  Points sources_, receivers_;
  GivenSurvey survey_;
  std::vector<ShotRuns> shots_;
  std::unordered_map<std::int64_t, std::size_t> by_number_;
  std::optional<double> factor_;  // metres in the unit of lengths (H201)
  std::string unit_name_, factor_place_, unit_place_;
};

void SpsReader::settle() {
  const double unit_m = metres_of_unit();
  for (auto* points : {&sources_, &receivers_})
    for (auto& place : points->places)
      for (double& part : place.at_m) part *= unit_m;
  survey_.places = receivers_.places;
}

std::uint32_t SpsReader::point(const Points& points, const PointName& name, const Record& record,
                               const Columns& columns, const char* kind) const {
  const auto found = points.numbers.find(name);
  if (found == points.numbers.end())
    record.refuse(columns, "found " + text_of(name) + ", which has no " + std::string(kind) + " record");
  return found->second;
}

/// One run where the receivers of the record follow each other among the R records, else one a receiver.
void SpsReader::add_receivers(const Record& record, ShotRuns& shot, const ReceiverRun& channels) {
  const PointName from{record.number(receiver_line), record.number(from_receiver),
                       record.integer_or(receiver_index, 1)};
  const double to = record.number(to_receiver);
  const std::uint32_t first = point(receivers_, from, record, from_receiver, "R");
  const double step = channels.count > 1 ? (to - from.point) / double(channels.count - 1) : 0;
  if (channels.count == 1 ? to != from.point : step == 0)
    record.refuse(to_receiver, "found receivers " + shown(from.point) + " to " + shown(to) + " for " +
                                   std::to_string(channels.count) + " channels, expected as many");
  const auto name_of = [&](std::uint32_t n) {
    // Point numbers have two decimals.
    return PointName{from.line, std::nearbyint((from.point + n * step) * 100) / 100, from.index};
  };
  bool in_order = std::size_t(first) + channels.count <= receivers_.names.size();
  for (std::uint32_t n = 0; in_order && n < channels.count; ++n) {
    const auto& name = receivers_.names[first + n];
    in_order = name.line == from.line && name.index == from.index &&
               std::abs(name.point - (from.point + n * step)) < 0.005;
  }
  if (in_order) {
    shot.runs.push_back({first, channels.count, channels.channel, channels.channel_step, -1});
    return;
  }
  for (std::uint32_t n = 0; n < channels.count; ++n)
    shot.runs.push_back({point(receivers_, name_of(n), record, from_receiver, "R"), 1,
                         std::int32_t(channels.channel + std::int64_t(n) * channels.channel_step), 1, -1});
}

void SpsReader::take_relation(const Record& record) {
  const auto number = record.integer(record_number);
  const PointName source{record.number(source_line), record.number(source_point),
                         record.integer_or(source_index, 1)};
  point(sources_, source, record, source_point, "S");
  const auto from = record.integer(from_channel), to = record.integer(to_channel),
             step = std::max<std::int64_t>(1, record.integer_or(channel_step, 1));
  if (from < 1) record.refuse(from_channel, "found " + std::to_string(from) + ", expected 1 or more");
  if (to < from || (to - from) % step != 0)
    record.refuse(to_channel, "found channels " + std::to_string(from) + " to " + std::to_string(to) +
                                  " in steps of " + std::to_string(step) + ", expected whole steps upwards");
  const auto [at, is_new] = by_number_.try_emplace(number, shots_.size());
  if (is_new) shots_.push_back({number, source, record.place(), {}});
  auto& shot = shots_[at->second];
  if (!(shot.source == source))
    record.refuse(source_point, "found field record " + std::to_string(number) +
                                    " with another source than (" + shot.place + "), expected one");
  add_receivers(record, shot,
                {0, std::uint32_t((to - from) / step + 1), std::int32_t(from), std::int32_t(step), -1});
}

/// The version that a text names: "SPS 2.1;", "SPS2.1", "2.1"; nothing where it names none. The names of the
/// files before them, "SPS001,10.10.90", have a running number.
std::optional<double> version_in(std::string_view text) {
  if (const auto word = text.find("SPS"); word != std::string_view::npos) text.remove_prefix(word + 3);
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto first = std::find_if(text.begin(), text.end(), is_digit);
  const auto last = std::find_if(first, text.end(), [&](char c) { return !is_digit(c) && c != '.'; });
  if (first == last) return {};
  const std::string number(first, last);
  if (number.size() > 1 && number[0] == '0') return 1;
  return parse_number(number.back() == '.' ? number.substr(0, number.size() - 1) : number);
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = char(std::toupper(static_cast<unsigned char>(c)));
  while (!result.empty() && (result.back() == ';' || result.back() == ' ')) result.pop_back();
  return result;
}

/// Metres in a unit by its name in H20; nothing where it may be several ("FEET" of a survey or international)
/// or is none of length.
std::optional<double> metres_in(const std::string& name) {
  const auto holds = [&](const char* part) { return name.find(part) != std::string::npos; };
  const bool feet = holds("FEET") || holds("FOOT") || name == "FT";
  if (feet && (holds("SURVEY") || holds("US"))) return 1200. / 3937;
  if (feet && holds("INTERNATIONAL")) return 0.3048;
  if (!feet && (holds("METRE") || holds("METER") || name == "M")) return 1;
  return {};
}

void SpsReader::take_header(const Record& record) {
  constexpr Columns code{1, 3, "header code"}, long_code{1, 4, "header code"}, value{33, 80, "value"},
      version{33, 80, "format version"}, unit{33, 56, "description of grid units"},
      factor{33, 46, "factor to metre"};
  const auto of = record.text(long_code);
  if (record.text(code) == "H00" && !record.text(version).empty()) {
    const auto found = version_in(upper(record.text(version)));
    if (!found || *found < 2 || *found >= 3)
      record.refuse(version,
                    "found '" + excerpt(std::string(record.text(version))) +
                        "', expected SPS 2.1, whose lines and points have other columns than those of "
                        "SPS 1; export it as SPS 2.1");
  } else if (of == "H201") {
    auto text = upper(record.text(value));
    const double found = in_place(record.place() + ": columns 33-46 (factor to metre)", [&] {
      try {
        return parse_number(text);
      } catch (const Error& error) {
        throw Error(error.what());
      }
    });
    if (!(found > 0)) record.refuse(factor, "found " + shown(found) + ", expected it above 0");
    if (factor_ && *factor_ != found)
      record.refuse(factor, "found " + shown(found) + " metres, expected " + shown(*factor_) +
                                " as before (" + factor_place_ + ")");
    if (!factor_) factor_place_ = record.place();
    factor_ = found;
  } else if (of == "H20" || (record.text(code) == "H20" && of.size() == 4 && std::isdigit(of[3]) == 0)) {
    const auto name = upper(record.text(unit));
    if (name.empty()) return;
    if (!unit_name_.empty() && unit_name_ != name)
      record.refuse(unit, "found '" + excerpt(name) + "', expected '" + excerpt(unit_name_) +
                              "' as before (" + unit_place_ + ")");
    if (unit_name_.empty()) unit_place_ = record.place();
    unit_name_ = name;
  }
}

/// Metres in the unit of all lengths: H201, which must agree with the name in H20.
double SpsReader::metres_of_unit() const {
  if (unit_name_.empty()) return factor_.value_or(1);
  const auto named = metres_in(unit_name_);
  if (!factor_ && !named)
    throw Error(unit_place_ + ": columns 33-56 (description of grid units): found '" + excerpt(unit_name_) +
                "' without a factor to metre (H201), expected metres, or H201: 0.3048 of international feet, "
                "0.30480061 of US survey feet");
  // International and US survey feet differ by 2 in a million; factors are written with 7 digits or more.
  if (factor_ && named && std::abs(*factor_ / *named - 1) > 1e-5)
    throw Error(factor_place_ + ": columns 33-46 (factor to metre): found " + shown(*factor_) +
                ", expected " + shown(*named, 8) + ", as the grid units are '" + excerpt(unit_name_) + "' (" +
                unit_place_ + ")");
  return factor_.value_or(named.value_or(1));
}

/// Channels of the runs of a shot that another run has, too.
std::optional<std::int64_t> channel_twice(const std::vector<ReceiverRun>& runs) {
  std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
  for (const auto& run : runs)
    if (run.channel_step == 1)
      ranges.emplace_back(run.channel, run.channel + std::int64_t(run.count) - 1);
    else
      for (std::uint32_t n = 0; n < run.count; ++n) {
        const auto channel = run.channel + std::int64_t(n) * run.channel_step;
        ranges.emplace_back(channel, channel);
      }
  std::sort(ranges.begin(), ranges.end());
  for (std::size_t n = 1; n < ranges.size(); ++n)
    if (ranges[n].first <= ranges[n - 1].second) return ranges[n].first;
  return {};
}

void SpsReader::expect_points(const std::string& names) const {
  std::string missing;
  if (sources_.places.empty()) missing += "S (sources) ";
  if (receivers_.places.empty()) missing += "R (receivers) ";
  if (!missing.empty())
    throw Error(names + ": found no record " + missing +
                "in SPS, expected --geometry for each of the S, R and "
                "X files");
}

GivenSurvey SpsReader::finish(const std::string& names) && {
  if (shots_.empty())
    throw Error(names +
                ": found no record X (relations) in SPS, expected --geometry for each of the S, R and X "
                "files");
  survey_.told_apart = true;
  ReceiverCollector collector(survey_);
  for (auto& shot : shots_) {
    if (const auto channel = channel_twice(shot.runs))
      throw Error(shot.place + ": found channel " + std::to_string(*channel) + " twice in field record " +
                  std::to_string(shot.number) + ", expected it once");
    GivenShot added;
    added.number = shot.number;
    GivenSource source;
    source.place = sources_.places[sources_.numbers.at(shot.source)];
    source.from = shot.place;
    added.sources.push_back(std::move(source));
    survey_.shots.push_back(std::move(added));
    collector.begin(survey_.shots.size() - 1);
    for (const auto& run : shot.runs) collector.add(run);
    collector.end();
    shot.runs = {};
  }
  settle_numbers(survey_);
  return std::move(survey_);
}

/// Calls `take` with every record and its kind.
template <class Take>
void each_record(const std::string& name, std::string_view text, const Take& take) {
  for (std::int64_t line = 1; !text.empty(); ++line) {
    const auto end = text.find('\n');
    auto record = text.substr(0, end);
    while (!record.empty() && (record.back() == '\r' || record.back() == ' ')) record.remove_suffix(1);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (!record.empty() && record.front() != '\x1a') take(Record(name, line, record), record.front());
  }
}

}  // namespace

bool looks_like_sps(std::string_view first) {
  const auto line = first.substr(0, first.find_first_of("\r\n"));
  if (line.size() > 3 && line[0] == 'H' && std::isdigit(static_cast<unsigned char>(line[1])) != 0)
    return true;
  return line.size() >= 60 && std::string_view("SRX").find(line[0]) != std::string_view::npos &&
         line.find(',') == std::string_view::npos;
}

GivenSurvey survey_of_sps(const std::vector<std::string>& names, const std::vector<std::string>& texts) {
  SpsReader reader;
  bool relations = false;
  for (std::size_t n = 0; n < texts.size(); ++n)
    each_record(names[n], texts[n], [&](const Record& record, char kind) {
      if (kind == 'H') return reader.take_header(record);
      if (std::string_view("SRX").find(kind) == std::string_view::npos)
        throw Error(record.place() + ": column 1: found '" + printable(std::string(1, kind)) +
                    "', expected a record H, S, R or X");
      relations = relations || kind == 'X';
      reader.take_points(record, kind);
    });
  const std::string all = joined(names);
  reader.expect_points(all);
  reader.settle();
  for (std::size_t n = 0; relations && n < texts.size(); ++n)
    each_record(names[n], texts[n], [&](const Record& record, char kind) {
      if (kind == 'X') reader.take_relation(record);
    });
  return std::move(reader).finish(all);
}

GivenSurvey read_sps(const std::vector<std::string>& paths) {
  std::vector<std::string> names, texts;
  for (const auto& path : paths) {
    names.push_back(shown_input(path));
    const auto bytes = read_all(path);
    texts.emplace_back(bytes.begin(), bytes.end());
  }
  return survey_of_sps(names, texts);
}

}  // namespace slipwave
