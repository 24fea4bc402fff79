#include "plot/gather_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "segy/reader.hpp"

namespace slipwave::plot {
namespace {

struct AxisName {
  TraceAxis axis;
  const char* name;
};
constexpr std::array<AxisName, 6> axis_names = {{{TraceAxis::automatic, "auto"},
                                                 {TraceAxis::x, "x"},
                                                 {TraceAxis::midpoint, "midpoint"},
                                                 {TraceAxis::offset, "offset"},
                                                 {TraceAxis::depth, "depth"},
                                                 {TraceAxis::number, "trace"}}};

double place_of(const TraceHeader& header, TraceAxis axis, std::size_t number) {
  switch (axis) {
    case TraceAxis::x:
      return header.receiver_m[0];
    case TraceAxis::midpoint:
      return (header.receiver_m[0] + header.source_m[0]) / 2;
    case TraceAxis::offset:
      return header.receiver_m[0] - header.source_m[0];
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
  if (all_differ(section, TraceAxis::x)) return TraceAxis::x;
  return all_differ(section, TraceAxis::depth) ? TraceAxis::depth : TraceAxis::number;
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
  std::string list;
  for (const auto& row : axis_names) {
    if (name == row.name) return row.axis;
    list += (list.empty() ? "" : ", ") + std::string(row.name);
  }
  throw Error("found the axis '" + name + "', expected one of " + list, ErrorKind::usage);
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
  section.other_components = components.size() > 1;
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
