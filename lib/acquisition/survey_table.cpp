// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/survey_table.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

/// Columns that hold a place: "x y z depth", or with a letter in front.
class PlaceColumns {
 public:
  PlaceColumns(const Table& table, const std::string& prefix, int dimension, bool of_receivers)
      : table_(table), of_receivers_(of_receivers) {
    x_ = table.find(prefix + "x");
    y_ = table.find(prefix + "y");
    z_ = table.find(prefix + "z");
    depth_ = table.find(prefix + "depth");
    if (!x_) refuse(prefix + "x");
    if (dimension == 3 && !y_) refuse(prefix + "y");
    if (!z_ && !depth_) refuse(prefix + "z or " + prefix + "depth");
    if (z_ && depth_)
      throw Error(table.name() + ": found columns " + prefix + "z and " + prefix +
                  "depth, expected one of them");
  }

  Place place() const {
    Place place;
    set_coordinate(place, 0, *x_);
    if (y_) set_coordinate(place, 1, *y_);
    try {
      const auto depth = parse_depth(table_.text(z_ ? *z_ : *depth_));
      if (!z_ && depth.from != DepthFrom::datum)
        throw Error("found '" + excerpt(std::string(table_.text(*depth_))) + "', expected a number");
      place.depth_from = z_ ? depth.from : DepthFrom::surface;
      place.at_m[2] = table_.in_unit(z_ ? *z_ : *depth_, depth.below_m);
    } catch (const Error& error) {
      table_.refuse(z_ ? *z_ : *depth_, error.what());
    }
    return place;
  }

 private:
  /// One that begins with + is counted from the source, where there can be such.
  void set_coordinate(Place& place, std::size_t axis, std::size_t column) const {
    auto text = table_.text(column);
    if (of_receivers_ && text.size() > 1 && text.front() == '+') {
      text.remove_prefix(1);
      place.relative |= std::uint8_t(1U << axis);
    }
    try {
      place.at_m[axis] = table_.in_unit(column, parse_number(text));
    } catch (const Error& error) {
      table_.refuse(column, error.what());
    }
  }
  [[noreturn]] void refuse(const std::string& missing) const {
    throw Error(table_.name() + ": found no column " + missing + ", expected one");
  }
  const Table& table_;
  bool of_receivers_;
  std::optional<std::size_t> x_, y_, z_, depth_;
};

/// Columns of a table without header: two or, in 3-D, three coordinates.
void name_plain_columns(Table& table, int dimension, const std::vector<std::string>& more) {
  const std::vector<std::string> names =
      dimension == 2 ? std::vector<std::string>{"x", "z"} : std::vector<std::string>{"x", "y", "z"};
  if (table.columns().empty()) {
    if (table.width() != names.size())
      throw Error(table.name() + ": found " + std::to_string(table.width()) +
                  " columns without a header line, expected " + (dimension == 2 ? "X Z" : "X Y Z") +
                  " or names above the columns");
    return table.name_columns(names);
  }
  std::vector<Table::Known> known = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"depth", "m"}, {"shot"}};
  for (const auto& name : more) known.push_back({name, name == "delay" ? "s" : ""});
  table.expect_columns(known);
}

std::int64_t positive(const Table& table, std::size_t column, const std::string& what) {
  const auto value = table.integer(column);
  if (value < 1 || value > std::numeric_limits<std::int32_t>::max())
    table.refuse(column, "found " + what + ' ' + std::to_string(value) + ", expected 1 to 2147483647");
  return value;
}

double amplitude_of(const Table& table, std::size_t column) {
  const double amplitude = table.number(column);
  if (amplitude == 0) table.refuse(column, "found an amplitude of 0, expected another number");
  return amplitude;
}

}  // namespace

void read_sources(Table& table, int dimension, GivenSurvey& survey) {
  name_plain_columns(table, dimension, {"delay", "amplitude", "kind", "wavelet"});
  const PlaceColumns places(table, "", dimension, false);
  const auto shot = table.find("shot"), delay = table.find("delay"), amplitude = table.find("amplitude"),
             kind = table.find("kind"), wavelet = table.find("wavelet");
  std::map<std::int64_t, std::size_t> shots;
  while (table.next()) {
    GivenSource source;
    source.place = places.place();
    source.from = table.place();
    if (table.has(delay)) source.delay_s = table.number(*delay);
    if (table.has(amplitude)) source.amplitude = amplitude_of(table, *amplitude);
    if (table.has(kind)) source.kind = table.text(*kind);
    if (table.has(wavelet)) source.wavelet = table.text(*wavelet);
    std::int64_t number = 0;
    if (shot) number = positive(table, *shot, "shot");
    const auto [same, is_new] = shots.try_emplace(number, survey.shots.size());
    if (number == 0 || is_new) {
      auto& added = survey.shots.emplace_back();
      added.number = number;
      added.sources.push_back(std::move(source));
    } else {
      survey.shots[same->second].sources.push_back(std::move(source));
    }
  }
}

std::vector<TableReceiver> read_receivers(Table& table, int dimension) {
  name_plain_columns(table, dimension, {"channel"});
  const PlaceColumns places(table, "", dimension, true);
  const auto shot = table.find("shot"), channel = table.find("channel");
  std::vector<TableReceiver> receivers;
  while (table.next()) {
    auto& receiver = receivers.emplace_back();
    receiver.place = places.place();
    receiver.from = table.place();
    if (shot) receiver.shot = positive(table, *shot, "shot");
    if (channel) receiver.channel = positive(table, *channel, "channel");
  }
  return receivers;
}

namespace {

/// A trace of a table: its row among the rows of its shot.
struct TraceRow {
  Place place;
  std::int64_t channel = 0, bin = 0, line = 0;
};

struct ShotRows {
  std::int64_t number = 0;
  Place source;
  std::string from;
  std::vector<TraceRow> traces;
};

}  // namespace

GivenSurvey read_survey(Table& table, int dimension) {
  if (table.columns().empty())
    throw Error(table.name() + ": found no header line, expected names above the columns: sx, sz, gx, gz");
  std::vector<Table::Known> known;
  for (const char* place : {"sx", "sy", "sz", "sdepth", "gx", "gy", "gz", "gdepth"})
    known.push_back({place, "m"});
  for (const char* number : {"shot", "channel", "cdp"}) known.push_back({number});
  table.expect_columns(known);
  const PlaceColumns sources(table, "s", dimension, false), receivers(table, "g", dimension, false);
  const auto shot = table.find("shot"), channel = table.find("channel"), bin = table.find("cdp");
  std::vector<ShotRows> shots;
  std::map<std::tuple<std::int64_t, double, double, double>, std::size_t> of_source;
  while (table.next()) {
    const auto source = sources.place();
    const std::int64_t number = shot ? positive(table, *shot, "shot") : 0;
    // Without numbers a shot is told by its place.
    const auto key = shot ? std::tuple(number, 0., 0., 0.)
                          : std::tuple(std::int64_t(0), source.at_m[0], source.at_m[1], source.at_m[2]);
    const auto [at, is_new] = of_source.try_emplace(key, shots.size());
    if (is_new) shots.push_back({number, source, table.place(), {}});
    auto& rows = shots[at->second];
    if (!(rows.source == source))
      throw Error(table.place() + ": found another source of shot " + std::to_string(number) +
                  " than before (" + rows.from + "), expected one place for a shot");
    rows.traces.push_back({receivers.place(), channel ? positive(table, *channel, "channel") : 0,
                           bin ? table.integer(*bin) : 0, table.line()});
  }
  GivenSurvey survey;
  survey.told_apart = true;
  ReceiverCollector collector(survey);
  for (auto& rows : shots) {
    auto& added = survey.shots.emplace_back();
    added.number = rows.number;
    auto& source = added.sources.emplace_back();
    source.place = rows.source;
    source.from = rows.from;
    collector.begin(survey.shots.size() - 1);
    std::map<std::int64_t, std::int64_t> lines;  // of channels
    for (std::size_t n = 0; n < rows.traces.size(); ++n) {
      const auto& trace = rows.traces[n];
      const auto number = channel ? trace.channel : std::int64_t(n) + 1;
      if (const auto [same, is_new] = lines.try_emplace(number, trace.line); !is_new)
        throw Error(table.name() + ": line " + std::to_string(trace.line) + ": found channel " +
                    std::to_string(number) + " twice in a shot, first on line " +
                    std::to_string(same->second) + "; expected it once");
      collector.add(trace.place, number, bin ? std::optional(trace.bin) : std::nullopt);
    }
    collector.end();
    rows.traces.clear();
    rows.traces.shrink_to_fit();
  }
  settle_numbers(survey);
  return survey;
}

namespace {

/// Whether two shots have the same receivers.
bool same_receivers(const GivenSurvey& survey, const GivenShot& one, const GivenShot& other) {
  if (one.first_run == other.first_run && one.last_run == other.last_run) return true;
  const auto runs = [&](const GivenShot& shot) {
    return std::pair(survey.runs.begin() + std::ptrdiff_t(shot.first_run),
                     survey.runs.begin() + std::ptrdiff_t(shot.last_run));
  };
  const auto [first, last] = runs(one);
  const auto [other_first, other_last] = runs(other);
  return std::equal(first, last, other_first, other_last, [](const ReceiverRun& a, const ReceiverRun& b) {
    return a.first_place == b.first_place && a.count == b.count && a.channel == b.channel &&
           (a.count == 1 || a.channel_step == b.channel_step);
  });
}

}  // namespace

void blend(Table& table, GivenSurvey& survey) {
  if (table.columns().empty())
    throw Error(table.name() +
                ": found no header line, expected names above the columns: record, shot, delay");
  table.expect_columns({{"record"}, {"shot"}, {"delay", "s"}, {"amplitude"}});
  const auto record = table.find("record"), shot = table.find("shot"), delay = table.find("delay"),
             amplitude = table.find("amplitude");
  for (const auto& [column, name] : {std::pair(record, "record"), std::pair(shot, "shot")})
    if (!column) throw Error(table.name() + ": found no column " + name + ", expected one");
  if (!survey.distinct && survey.numbered)
    throw Error(table.name() + ": found shots of the same number in the survey, expected each once");
  std::map<std::int64_t, std::size_t> shots;
  for (std::size_t n = 0; n < survey.shots.size(); ++n)
    shots[survey.numbered ? survey.shots[n].number : std::int64_t(n) + 1] = n;
  std::map<std::int64_t, std::size_t> records;
  std::vector<GivenShot> blended;
  while (table.next()) {
    const auto number = positive(table, *record, "record"), fired = positive(table, *shot, "shot");
    const auto found = shots.find(fired);
    if (found == shots.end())
      table.refuse(*shot, "found shot " + std::to_string(fired) + ", which the survey does not have");
    auto added = survey.shots[found->second];
    for (auto& source : added.sources) {
      if (table.has(delay)) source.delay_s += table.number(*delay);
      // Its own amplitude, or that of the options, which is not known here, is the other factor.
      if (table.has(amplitude)) source.factor *= amplitude_of(table, *amplitude);
    }
    const auto [at, is_new] = records.try_emplace(number, blended.size());
    if (is_new) {
      added.number = number;
      blended.push_back(std::move(added));
      continue;
    }
    auto& of_record = blended[at->second];
    if (!same_receivers(survey, of_record, added))
      throw Error(table.place() + ": shot " + std::to_string(fired) + " has other receivers than record " +
                  std::to_string(number) + ", expected the same in all shots of a record");
    of_record.sources.insert(of_record.sources.end(), added.sources.begin(), added.sources.end());
  }
  survey.shots = std::move(blended);
  settle_numbers(survey);
}

}  // namespace slipwave
