// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gather_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr std::array<AxisName, 7> axis_names = {{{TraceAxis::automatic, "auto"},
                                                 {TraceAxis::x, "x"},
                                                 {TraceAxis::y, "y"},
                                                 {TraceAxis::midpoint, "midpoint"},
                                                 {TraceAxis::offset, "offset"},
                                                 {TraceAxis::depth, "depth"},
                                                 {TraceAxis::number, "trace"}}};

double offset_of(const TraceHeader& header) {
  const double dx = header.receiver_m[0] - header.source_m[0], dy = header.receiver_m[1] - header.source_m[1];
  if (dy == 0) return dx;
  return std::copysign(std::hypot(dx, dy), dx != 0 ? dx : dy);
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
    case TraceAxis::depth:
      return header.receiver_m[2];
    default:
      return double(number + 1);
  }
}

bool all_differ(const GatherSection& section, TraceAxis axis) {
  std::set<double> seen;
  for (std::size_t n = 0; n < section.traces(); ++n) {
    if (!seen.insert(place_of(section.headers[n], axis, n)).second) return false;
  }
  return true;
}

TraceAxis automatic_axis(const GatherSection& section) {
  if (section.shots != 1 || section.traces() < 2) return TraceAxis::number;
  for (const auto axis : {TraceAxis::x, TraceAxis::y})
    if (all_differ(section, axis)) return axis;
  return all_differ(section, TraceAxis::depth) ? TraceAxis::depth : TraceAxis::number;
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

void find_runs(const GatherSection& section, TracePlaces& places) {
  auto shots = runs_of(0, section.traces(), [&](std::size_t n) { return section.headers[n].shot; });
  if (shots.size() == 1) {
    std::tie(places.run_name, places.runs) = lines_of(section, 0, section.traces());
    return;
  }
  if (2 * shots.size() > section.traces()) return;  // near-offset sections, gathers of a midpoint
  places.run_name = "shot";
  for (const auto& shot : shots) {
    for (const auto& line : lines_of(section, shot.first, shot.count).second)
      if (line.first != shot.first) places.line_starts.push_back(line.first);
  }
  places.runs = std::move(shots);
}

[[noreturn]] void refuse_choice(const segy::Reader& reader, const TraceChoice& choice,
                                const std::set<Component>& components, const std::set<std::int64_t>& shots) {
  if (components.empty()) throw Error(reader.name() + ": has no traces, expected at least one");
  std::string wanted = choice.component ? name_of(*choice.component) : "trace";
  if (choice.shot) wanted += " of shot " + std::to_string(*choice.shot);
  std::string list;
  for (const auto component : components)
    list += (list.empty() ? "" : ", ") + std::string(name_of(component));
  throw Error(reader.name() + ": has no " + wanted + ", it holds " + list + " of shots " +
              std::to_string(*shots.begin()) + " to " + std::to_string(*shots.rbegin()));
}

}  // namespace

TraceAxis trace_axis_named(const std::string& name) {
  for (const auto& row : axis_names)
    if (name == row.name) return row.axis;
  throw Error("found the axis '" + name + "', expected one of " + joined(trace_axis_names()),
              ErrorKind::usage);
}

std::vector<std::string> trace_axis_names() {
  std::vector<std::string> names;
  for (const auto& row : axis_names) names.emplace_back(row.name);
  return names;
}

GatherSection read_section(segy::Reader& reader, const TraceChoice& choice) {
  GatherSection section;
  section.axis = reader.axis_with_interval();
  std::optional<Component> component = choice.component;
  std::set<Component> components;
  std::set<std::int64_t> shots;
  std::int64_t last_shot = 0;
  segy::Trace trace;
  while (reader.next(trace)) {
    const auto header = reader.si_header(trace);
    components.insert(header.component);
    shots.insert(header.shot);
    if (choice.shot && header.shot != *choice.shot) continue;
    if (!component) component = header.component;
    if (header.component != *component) continue;
    const auto differs = sampling_difference(reader.axis_of(trace), section.axis);
    if (!differs.empty())
      throw Error(reader.name() + ": trace " + std::to_string(reader.delivered()) + ": " + differs +
                  " as in the first trace");
    if (section.headers.empty() || header.shot != last_shot) ++section.shots;
    last_shot = header.shot;
    section.headers.push_back(header);
    section.samples.insert(section.samples.end(), trace.samples.begin(), trace.samples.end());
  }
  if (section.headers.empty()) refuse_choice(reader, choice, components, shots);
  section.component = *component;
  section.others_unasked = components.size() > 1 && !choice.component;
  section.first_shot = section.headers.front().shot;
  return section;
}

void apply_gain(GatherSection& section, double power) {
  if (power == 0) return;
  std::vector<float> gain(std::size_t(section.axis.count));
  for (std::size_t n = 0; n < gain.size(); ++n) {
    const double time = section.axis.start_s + double(n) * section.axis.interval_s;
    gain[n] = time > 0 ? float(std::pow(time, power)) : 0;
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
