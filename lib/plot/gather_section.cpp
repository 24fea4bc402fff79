// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gather_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "gather/difference.hpp"
#include "segy/reader.hpp"

namespace slipwave::plot {
namespace {

struct AxisName {
  TraceAxis axis;
  const char* name;
};
constexpr std::array<AxisName, 8> named_axes = {{{TraceAxis::automatic, "auto"},
                                                 {TraceAxis::x, "x"},
                                                 {TraceAxis::y, "y"},
                                                 {TraceAxis::midpoint, "midpoint"},
                                                 {TraceAxis::offset, "offset"},
                                                 {TraceAxis::azimuth, "azimuth"},
                                                 {TraceAxis::depth, "depth"},
                                                 {TraceAxis::number, "trace"}}};

double offset_of(const TraceHeader& header) {
  const double dx = header.receiver_m[0] - header.source_m[0], dy = header.receiver_m[1] - header.source_m[1];
  if (dy == 0) return dx;
  return std::copysign(std::hypot(dx, dy), dx != 0 ? dx : dy);
}

double azimuth_of(const TraceHeader& header) {
  const double dx = header.receiver_m[0] - header.source_m[0], dy = header.receiver_m[1] - header.source_m[1];
  const double degrees = std::atan2(dy, dx) * 180 / std::numbers::pi;
  return degrees < 0 ? degrees + 360 : degrees;
}

double place_of(const TraceHeader& header, TraceAxis axis, std::size_t number) {
  switch (axis) {
    case TraceAxis::x:
      return header.receiver_m[0];
    case TraceAxis::y:
      return header.receiver_m[1];
    case TraceAxis::midpoint:
      return (header.receiver_m[0] + header.source_m[0]) / 2;
    case TraceAxis::offset:
      return offset_of(header);
    case TraceAxis::azimuth:
      return azimuth_of(header);
    case TraceAxis::depth:
      return header.receiver_m[2];
    default:
      return double(number + 1);
  }
}

/// Places of all traces on an axis, ascending.
std::vector<double> sorted_places(const GatherSection& section, TraceAxis axis) {
  std::vector<double> places;
  for (std::size_t n = 0; n < section.traces(); ++n) places.push_back(place_of(section.headers[n], axis, n));
  std::sort(places.begin(), places.end());
  return places;
}

bool all_differ(const GatherSection& section, TraceAxis axis) {
  const auto places = sorted_places(section, axis);
  return std::adjacent_find(places.begin(), places.end()) == places.end();
}

double extent_of(const GatherSection& section, TraceAxis axis) {
  const auto places = sorted_places(section, axis);
  return places.back() - places.front();
}

/// Do receivers stand round the source, all as far from it but for 1 %? On a straight line such receivers
/// span 2 arccos 0.99 = 16.2 degrees at most.
bool is_ring(const GatherSection& section) {
  constexpr double most_on_a_line = 16.3;
  if (!all_differ(section, TraceAxis::azimuth)) return false;
  double nearest = INFINITY, farthest = 0;
  for (const auto& header : section.headers) {
    const double distance = std::fabs(offset_of(header));
    nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
  }
  const auto azimuths = sorted_places(section, TraceAxis::azimuth);
  double widest_gap = azimuths.front() + 360 - azimuths.back();
  for (std::size_t n = 1; n < azimuths.size(); ++n)
    widest_gap = std::max(widest_gap, azimuths[n] - azimuths[n - 1]);
  return nearest > 0.99 * farthest && 360 - widest_gap > most_on_a_line;
}

/// Runs of equal numbers from trace `first` on, `count` in all.
template <class Key>
std::vector<TraceRun> runs_of(std::size_t first, std::size_t count, const Key& key) {
  std::vector<TraceRun> runs;
  for (std::size_t n = first; n < first + count; ++n) {
    if (n == first || key(n) != key(n - 1)) runs.push_back({n, 0, shown(key(n))});
    ++runs.back().count;
  }
  return runs;
}

/// Lines of receivers: the coordinate that is the same along each, in the order y, x, depth, and has another
/// value in the next. Nothing where there are not two lines of two traces.
std::pair<std::string, std::vector<TraceRun>> lines_of(const GatherSection& section, std::size_t first,
                                                       std::size_t count) {
  const std::pair<std::size_t, const char*> axes[] = {{1, "y (m)"}, {0, "x (m)"}, {2, "depth (m)"}};
  for (const auto& [axis, name] : axes) {
    auto runs =
        runs_of(first, count, [&, at = axis](std::size_t n) { return section.headers[n].receiver_m[at]; });
    std::set<std::string> different;
    bool lines = runs.size() > 1;
    for (const auto& run : runs) lines = lines && run.count > 1 && different.insert(run.label).second;
    if (lines) return {name, std::move(runs)};
  }
  return {};
}

TraceAxis automatic_axis(const GatherSection& section) {
  if (section.traces() < 2) return TraceAxis::number;
  if (section.shots > 1) {
    if (section.shots != std::int64_t(section.traces())) return TraceAxis::number;
    for (const auto shared : {TraceAxis::midpoint, TraceAxis::x})
      if (extent_of(section, shared) == 0 && all_differ(section, TraceAxis::offset)) return TraceAxis::offset;
    return all_differ(section, TraceAxis::midpoint) ? TraceAxis::midpoint : TraceAxis::number;
  }
  if (is_ring(section)) return TraceAxis::azimuth;
  TraceAxis longest = TraceAxis::number;
  double length = 0;
  for (const auto axis : {TraceAxis::x, TraceAxis::y, TraceAxis::depth}) {
    if (!all_differ(section, axis) || extent_of(section, axis) <= length) continue;
    length = extent_of(section, axis);
    longest = axis;
  }
  if (longest != TraceAxis::number || !lines_of(section, 0, section.traces()).second.empty()) return longest;
  return all_differ(section, TraceAxis::offset) ? TraceAxis::offset : TraceAxis::number;
}

/// "offset 100 to 2500 m" where the runs begin and end there to a hundredth of that length, all of them.
std::string shared_range(const GatherSection& section, const std::vector<TraceRun>& runs, TraceAxis axis,
                         const std::string& name) {
  const auto at = [&](std::size_t n) { return place_of(section.headers[n], axis, n); };
  const double first = at(runs.front().first), last = at(runs.front().first + runs.front().count - 1);
  const double slack = 0.01 * std::fabs(last - first);
  for (const auto& run : runs)
    if (std::fabs(at(run.first) - first) > slack || std::fabs(at(run.first + run.count - 1) - last) > slack)
      return "";
  return first == last ? "" : name + " " + shown(first, 4) + " to " + shown(last, 4) + " m";
}

void find_runs(const GatherSection& section, TracePlaces& places) {
  auto shots = runs_of(0, section.traces(), [&](std::size_t n) { return section.headers[n].shot; });
  if (shots.size() == 1) {
    std::tie(places.run_name, places.runs) = lines_of(section, 0, section.traces());
    if (places.runs.empty()) return;
    const bool along_y = places.run_name.starts_with("x");
    places.in_each_run = shared_range(section, places.runs, along_y ? TraceAxis::y : TraceAxis::x,
                                      along_y ? "receiver y" : "receiver x");
    return;
  }
  if (2 * shots.size() > section.traces()) return;  // near-offset sections, gathers of a midpoint
  places.run_name = "shot";
  for (const auto& shot : shots) {
    for (const auto& line : lines_of(section, shot.first, shot.count).second)
      if (line.first != shot.first) places.line_starts.push_back(line.first);
  }
  places.runs = std::move(shots);
  if (!places.line_starts.empty()) return;
  places.in_each_run = shared_range(section, places.runs, TraceAxis::offset, "offset");
  if (places.in_each_run.empty())
    places.in_each_run = shared_range(section, places.runs, TraceAxis::x, "receiver x");
}

[[noreturn]] void refuse_choice(const segy::Reader& reader, const TraceChoice& choice,
                                const std::set<Component>& components, const std::set<std::int64_t>& shots) {
  if (components.empty()) throw Error(reader.name() + ": has no traces, expected at least one");
  std::string wanted = "trace";
  for (const auto component : choice.of.components)
    if (!components.count(component)) {
      wanted = name_of(component);
      break;
    }
  if (choice.shot) wanted += " of shot " + std::to_string(*choice.shot);
  std::string list;
  for (const auto component : components)
    list += (list.empty() ? "" : ", ") + std::string(name_of(component));
  throw Error(reader.name() + ": has no " + wanted + ", it holds " + list + " of shots " +
                  std::to_string(*shots.begin()) + " to " + std::to_string(*shots.rbegin()),
              ErrorKind::usage);
}

}  // namespace

TraceAxis trace_axis_named(const std::string& name) {
  for (const auto& row : named_axes)
    if (name == row.name) return row.axis;
  throw Error("found the axis '" + name + "', expected one of " + joined(trace_axis_names()),
              ErrorKind::usage);
}

std::vector<std::string> trace_axis_names() {
  std::vector<std::string> names;
  for (const auto& row : named_axes) names.emplace_back(row.name);
  return names;
}

bool ComponentChoice::has(Component component) const {
  return std::find(components.begin(), components.end(), component) != components.end();
}

ComponentChoice parse_components(const std::string& text) {
  ComponentChoice choice;
  choice.all = text == "all";
  if (choice.all || text.empty()) return choice;
  for (const auto& name : split(text, ',')) {
    const auto component = component_named(name);
    if (choice.has(component)) throw Error("found " + name + " twice, expected it once", ErrorKind::usage);
    choice.components.push_back(component);
  }
  return choice;
}

std::vector<GatherSection> read_sections(segy::Reader& reader, const TraceChoice& choice) {
  const auto axis = reader.axis_with_interval();
  auto of = choice.of;
  const bool asked = of.all || !of.components.empty();
  std::map<Component, GatherSection> sections;
  std::set<Component> components;
  std::set<std::int64_t> shots;
  segy::Trace trace;
  while (reader.next(trace)) {
    const auto header = reader.si_header(trace);
    components.insert(header.component);
    shots.insert(header.shot);
    if (choice.shot && header.shot != *choice.shot) continue;
    if ((of.all || of.components.empty()) && !of.has(header.component))
      of.components.push_back(header.component);
    if (!of.has(header.component)) continue;
    const auto differs = sampling_difference(reader.axis_of(trace), axis);
    if (!differs.empty())
      throw Error(reader.name() + ": trace " + std::to_string(reader.delivered()) + ": " + differs +
                  " as in the first trace");
    auto& section = sections[header.component];
    if (section.headers.empty() || header.shot != section.headers.back().shot) ++section.shots;
    section.headers.push_back(header);
    section.samples.insert(section.samples.end(), trace.samples.begin(), trace.samples.end());
  }
  if (of.components.empty() || sections.size() < of.components.size())
    refuse_choice(reader, choice, components, shots);
  std::vector<GatherSection> all;
  for (const auto component : of.components) {
    auto& section = all.emplace_back(std::move(sections[component]));
    section.component = component;
    section.axis = axis;
    section.others_unasked = components.size() > 1 && !asked;
    section.first_shot = section.headers.front().shot;
  }
  return all;
}

void apply_gain(GatherSection& section, double power) {
  if (power == 0) return;
  std::vector<float> gain(std::size_t(section.axis.count));
  for (std::size_t n = 0; n < gain.size(); ++n) {
    const double time = section.axis.start_s + double(n) * section.axis.interval_s;
    gain[n] = time > 0 ? float(std::pow(time, power)) : 0;
    if (time > 0 && !std::isnormal(gain[n]))
      throw Error("found --gain-power " + shown(power) + ", which gives no number in single precision at " +
                      shown(time) + " s; expected a power nearer to 0",
                  ErrorKind::usage);
  }
  for (std::size_t trace = 0; trace < section.traces(); ++trace) {
    float* samples = section.samples.data() + trace * gain.size();
    for (std::size_t n = 0; n < gain.size(); ++n) samples[n] *= gain[n];
  }
}

TracePlaces order_traces(GatherSection& section, TraceAxis axis) {
  TracePlaces result{axis == TraceAxis::automatic ? automatic_axis(section) : axis, {}};
  std::vector<double> places(section.traces());
  for (std::size_t n = 0; n < places.size(); ++n) places[n] = place_of(section.headers[n], result.axis, n);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return places[a] < places[b]; });
  for (std::size_t n = 1; n < order.size(); ++n) {
    if (places[order[n]] == places[order[n - 1]])
      throw Error("--axis: two traces stand at " + shown(places[order[n]]) +
                      " m, expected different places; choose a --shot, or trace for the axis",
                  ErrorKind::usage);
  }
  for (const auto n : order) result.places.push_back(places[n]);
  if (result.axis == TraceAxis::number) find_runs(section, result);
  if (std::is_sorted(order.begin(), order.end())) return result;
  std::vector<TraceHeader> headers;
  std::vector<float> samples;
  headers.reserve(order.size());
  samples.reserve(section.samples.size());
  for (const auto n : order) {
    headers.push_back(section.headers[n]);
    samples.insert(samples.end(), section.trace(n), section.trace(n) + section.axis.count);
  }
  section.headers = std::move(headers);
  section.samples = std::move(samples);
  return result;
}

}  // namespace slipwave::plot
