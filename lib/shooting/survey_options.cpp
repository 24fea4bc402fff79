// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/survey_options.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "acquisition/sps.hpp"
#include "acquisition/survey_table.hpp"
#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/input_bytes.hpp"
#include "segy/sniff.hpp"
#include "shooting/geometry_segy.hpp"
#include "shooting/injection.hpp"

namespace slipwave {
namespace {

std::vector<Place> places_of(const std::string& text, int dimension, bool of_receivers) {
  return dimension == 2 ? parse_places<2>(text, of_receivers) : parse_places<3>(text, of_receivers);
}

bool is_table(const std::string& text) { return text.size() > 1 && text.front() == '@'; }

/// Receivers that options and tables name for all shots, and those of tables for one shot each.
struct Receivers {
  std::vector<TableReceiver> of_all;
  std::map<std::int64_t, std::vector<TableReceiver>> of_shot;
};

Receivers read_receiver_options(const std::vector<std::string>& options, int dimension) {
  Receivers receivers;
  for (const auto& text : options) {
    if (!is_table(text)) {
      for (const auto& place : in_place("--receivers", [&] { return places_of(text, dimension, true); }))
        receivers.of_all.push_back({place, 0, 0, ""});
      continue;
    }
    Table table(text.substr(1));
    for (auto& receiver : read_receivers(table, dimension))
      if (receiver.shot == 0)
        receivers.of_all.push_back(std::move(receiver));
      else
        receivers.of_shot[receiver.shot].push_back(std::move(receiver));
  }
  return receivers;
}

/// Every receiver belongs to a shot that there is, and every shot has receivers.
void check_shots(const GivenSurvey& survey, const Receivers& receivers) {
  if (receivers.of_shot.empty()) return;
  std::set<std::int64_t> numbers;
  for (std::size_t n = 0; n < survey.shots.size(); ++n) {
    const auto number = survey.numbered ? survey.shots[n].number : std::int64_t(n) + 1;
    numbers.insert(number);
    if (receivers.of_all.empty() && receivers.of_shot.count(number) == 0)
      throw Error("--receivers: found no receiver of shot " + std::to_string(number) + ", expected some");
  }
  for (const auto& [number, of_shot] : receivers.of_shot)
    if (numbers.count(number) == 0)
      throw Error(of_shot.front().from + ": found a receiver of shot " + std::to_string(number) +
                  ", which has no source");
}

/// Channels are given for all receivers of a shot or for none, and each once.
void check_channels(const std::vector<TableReceiver>& receivers, const std::string& of_shot) {
  std::map<std::int64_t, std::string> channels;  // where each was given
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    const auto channel = receivers[n].channel;
    if ((channel == 0) != (receivers.front().channel == 0))
      throw Error("--receivers: found receiver " + std::to_string(n + 1) + of_shot +
                  (channel == 0 ? " without" : " with") + " a channel, expected all with one or none");
    if (channel == 0) continue;
    const auto [first, is_new] = channels.try_emplace(channel, receivers[n].from);
    if (!is_new)
      throw Error(receivers[n].from + ": found channel " + std::to_string(channel) + of_shot +
                  " again (first: " + first->second + "), expected it once");
  }
}

/// Adds receivers that are the same for all shots: one run, as many shots as there are.
void add_common_receivers(GivenSurvey& survey, const Receivers& receivers) {
  check_channels(receivers.of_all, "");
  const bool channels = !receivers.of_all.empty() && receivers.of_all.front().channel != 0;
  if (!channels) {
    for (const auto& receiver : receivers.of_all) survey.places.push_back(receiver.place);
    if (!survey.places.empty()) survey.runs.push_back({0, std::uint32_t(survey.places.size()), 1, 1, -1});
  } else {
    survey.told_apart = true;
    ReceiverCollector collector(survey);
    collector.begin(0);
    for (const auto& receiver : receivers.of_all) collector.add(receiver.place, receiver.channel);
    collector.end();
  }
  for (auto& shot : survey.shots) {
    shot.first_run = 0;
    shot.last_run = survey.runs.size();
  }
}

void add_receivers_by_shot(GivenSurvey& survey, const Receivers& receivers) {
  survey.told_apart = true;
  ReceiverCollector collector(survey);
  for (std::size_t n = 0; n < survey.shots.size(); ++n) {
    const auto number = survey.numbered ? survey.shots[n].number : std::int64_t(n) + 1;
    auto all = receivers.of_all;
    if (const auto own = receivers.of_shot.find(number); own != receivers.of_shot.end())
      all.insert(all.end(), own->second.begin(), own->second.end());
    check_channels(all, " of shot " + std::to_string(number));
    collector.begin(n);
    for (std::size_t k = 0; k < all.size(); ++k)
      collector.add(all[k].place, all[k].channel != 0 ? all[k].channel : std::int64_t(k) + 1);
    collector.end();
  }
}

/// "3" or "10:20".
std::pair<std::int64_t, std::int64_t> range_of(const std::string& text) {
  const auto ends = split(text, ':');
  const auto first = parse_integer(ends.front()), last = parse_integer(ends.back());
  if (ends.size() > 2 || last < first)
    throw Error("found '" + excerpt(text) + "', expected a number or FIRST:LAST", ErrorKind::usage);
  return {first, last};
}

/// Leaves those of these numbers; they keep them.
void select_shots(GivenSurvey& survey, const std::string& list) {
  if (!survey.numbered)
    for (std::size_t n = 0; n < survey.shots.size(); ++n) survey.shots[n].number = std::int64_t(n) + 1;
  settle_numbers(survey);
  const auto by_number = [](const GivenShot& one, const GivenShot& other) {
    return one.number < other.number;
  };
  const auto [least, most] = std::minmax_element(survey.shots.begin(), survey.shots.end(), by_number);
  std::vector<GivenShot> selected;
  for (const auto& text : split(list, ',')) {
    const auto [first, last] = range_of(text);
    const auto before = selected.size();
    for (const auto& shot : survey.shots)
      if (shot.number >= first && shot.number <= last) selected.push_back(shot);
    if (selected.size() == before)
      throw Error("found no shot " + text + " in the survey, whose shots are numbered " +
                      std::to_string(least->number) + " to " + std::to_string(most->number),
                  ErrorKind::usage);
  }
  survey.shots = std::move(selected);
  settle_numbers(survey);
  if (!survey.distinct)
    throw Error("found a shot twice in '" + excerpt(list) + "' or in the survey, expected each once");
}

enum class GeometryKind { traces, sps, table };

GeometryKind kind_of(const InputStart& start, std::optional<std::uint64_t> size) {
  const auto& bytes = start.bytes();
  const std::vector<std::uint8_t> first(bytes.begin(), bytes.end());
  const std::string_view text(bytes.data(), bytes.size());
  if (looks_like_sps(text)) return GeometryKind::sps;
  if (segy::looks_like_segy(first, size)) return GeometryKind::traces;
  const auto is_control = [](std::uint8_t byte) {
    return byte < ' ' && byte != '\t' && byte != '\r' && byte != '\n';
  };
  if (std::any_of(first.begin(), first.end(), is_control))
    throw Error("expected traces in SEG-Y or SU, a CSV table or SPS, found none of them");
  return GeometryKind::table;
}

}  // namespace

void SurveyOptions::check() const {
  const auto refuse = [](const std::string& sentence) { throw Error(sentence, ErrorKind::usage); };
  if (!geometry.empty() && !sources.empty()) refuse("found --geometry and --source, expected one of them");
  if (!geometry.empty() && !receivers.empty())
    refuse("found --geometry and --receivers, expected one of them");
  for (const auto& [given, name] :
       {std::pair(!origin.empty(), "--origin"), std::pair(azimuth_deg.has_value(), "--azimuth"),
        std::pair(!source_depth.empty(), "--source-depth"),
        std::pair(!receiver_depth.empty(), "--receiver-depth")})
    if (given && geometry.empty() && inject.empty())
      refuse(std::string("found ") + name + " without --geometry, expected both");
  if (!inject.empty() && (!sources.empty() || !geometry.empty()))
    refuse("found --inject and " + std::string(sources.empty() ? "--geometry" : "--source") +
           ", expected one of them");
}

MapFrame SurveyOptions::frame() const {
  MapFrame frame;
  if (!origin.empty()) frame.origin_m = in_place("--origin", [&] { return parse_point<2>(origin); });
  if (azimuth_deg && !(*azimuth_deg >= -360 && *azimuth_deg <= 360))
    throw Error("--azimuth: found " + shown(*azimuth_deg) + ", expected -360 to 360 degrees",
                ErrorKind::usage);
  frame.azimuth_deg = azimuth_deg.value_or(frame.azimuth_deg);
  return frame;
}

GivenSurvey SurveyOptions::read_lines(int dimension) const {
  GivenSurvey survey;
  if (!inject.empty()) {
    survey = read_injection(inject, reverse, dimension);
    survey.frame = frame();
  }
  survey.in_files = !inject.empty() || std::any_of(sources.begin(), sources.end(), is_table) ||
                    std::any_of(receivers.begin(), receivers.end(), is_table);
  for (const auto& text : sources) {
    if (is_table(text)) {
      Table table(text.substr(1));
      read_sources(table, dimension, survey);
      continue;
    }
    for (const auto& place : in_place("--source", [&] { return places_of(text, dimension, false); })) {
      auto& shot = survey.shots.emplace_back();
      auto& source = shot.sources.emplace_back();
      source.place = place;
    }
  }
  settle_numbers(survey);
  if (survey.numbered)
    for (const auto& shot : survey.shots)
      if (shot.number == 0 || !survey.distinct)
        throw Error("--source: found " +
                    std::string(shot.number == 0 ? "shots without a number" : "a number twice") +
                    " among those of several tables or options, expected a number of its own for each shot");
  const auto all = read_receiver_options(receivers, dimension);
  check_shots(survey, all);
  if (survey.shots.empty()) return survey;
  if (all.of_shot.empty())
    add_common_receivers(survey, all);
  else
    add_receivers_by_shot(survey, all);
  return survey;
}

GivenSurvey SurveyOptions::read_geometry(int dimension) const {
  std::optional<GeometryKind> kind;
  std::vector<char> taken;
  for (const auto& path : geometry) {
    const InputStart start(path, 3600);
    std::optional<std::uint64_t> size;
    if (start.is_regular()) size = InputFile(path).size();
    kind = in_place(shown_input(path), [&] { return kind_of(start, size); });
    taken = start.taken();
    if (*kind != GeometryKind::sps && geometry.size() > 1)
      throw Error("--geometry: " + shown_input(path) +
                      " is no SPS file, expected one file of another kind or "
                      "the S, R and X files of SPS",
                  ErrorKind::usage);
    if (!start.is_regular() && geometry.size() > 1)
      throw Error("--geometry: " + shown_input(path) + " cannot be read twice, expected a file",
                  ErrorKind::usage);
  }
  GivenSurvey survey;
  if (*kind == GeometryKind::traces) {
    survey = read_trace_geometry(geometry.front(), {taken.begin(), taken.end()});
  } else if (*kind == GeometryKind::sps) {
    survey = read_sps(geometry);
  } else {
    const auto bytes = read_all(geometry.front(), std::move(taken));
    Table table(shown_input(geometry.front()), {bytes.begin(), bytes.end()});
    survey = read_survey(table, dimension);
  }
  survey.in_files = true;
  survey.frame = frame();
  survey.from_map = true;
  const auto set_depth = [](Place& place, const GivenDepth& depth) {
    place.depth_from = depth.from;
    place.at_m[2] = depth.below_m;
  };
  if (!source_depth.empty()) {
    const auto depth = in_place("--source-depth", [&] { return parse_depth(source_depth); });
    for (auto& shot : survey.shots)
      for (auto& source : shot.sources) set_depth(source.place, depth);
  }
  if (!receiver_depth.empty()) {
    const auto depth = in_place("--receiver-depth", [&] { return parse_depth(receiver_depth); });
    for (auto& place : survey.places) set_depth(place, depth);
  }
  return survey;
}

GivenSurvey SurveyOptions::read(int dimension) const {
  check();
  auto survey = geometry.empty() ? read_lines(dimension) : read_geometry(dimension);
  if (!blend.empty()) {
    Table table(blend);
    slipwave::blend(table, survey);
  }
  if (!shots.empty()) in_place("--shots", [&] { select_shots(survey, shots); });
  return survey;
}

}  // namespace slipwave
