// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/injection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/error.hpp"
#include "io/input_bytes.hpp"
#include "segy/reader.hpp"

namespace slipwave {
namespace {

/// Returns, as --kind takes it, what is injected with the samples of a component as its wavelet.
std::string kind_of(Component component, int dimension) {
  const bool space = dimension == 3;
  switch (component) {
    case Component::p:
      return "explosion";
    case Component::vx:
      return space ? "force:1,0,0" : "force:1,0";
    case Component::vz:
      return space ? "force:0,0,1" : "force:0,1";
    case Component::vy:
      if (space) return "force:0,1,0";
      [[fallthrough]];
    default:
      throw Error("records " + std::string(name_of(component)) +
                  ", expected velocities, which are injected as "
                  "forces, or pressure; sw-select --where component=vz leaves others out");
  }
}

/// Samples at the times at which they are injected; nothing before and after them.
shape::Sampled injected(const SampleAxis& axis, std::vector<double> samples, bool reversed, double end_s) {
  std::vector<double> times_s;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double recorded_s = axis.start_s + double(reversed ? samples.size() - 1 - n : n) * axis.interval_s;
    times_s.push_back(reversed ? end_s - recorded_s : recorded_s);
  }
  if (reversed) std::reverse(samples.begin(), samples.end());
  return {std::move(times_s), std::move(samples), 0};
}

class InjectionReader {
 public:
  InjectionReader(const std::string& path, bool reversed, int dimension)
      : reader_(path), reversed_(reversed), dimension_(dimension) {}

  GivenSurvey read() {
    segy::Trace trace;
    reader_.axis_with_interval();
    while (reader_.next(trace))
      in_place(reader_.name() + ": trace " + std::to_string(reader_.delivered()), [&] { take(trace); });
    // What is injected is the whole of such a shot: it is not shot in doubt.
    for (const auto& doubt : reader_.doubts()) throw Error(doubt);
    if (survey_.shots.empty())
      throw Error(reader_.name() + ": found nothing to inject, expected a trace with samples other than 0");
    settle_numbers(survey_);
    survey_.numbered = true;
    survey_.from_map = true;
    return std::move(survey_);
  }

 private:
  void take(segy::Trace& trace) {
    const auto header = reader_.si_header(trace);
    const auto axis = reader_.axis_of(trace);
    check_finite(trace.samples);
    GivenSource source;
    source.kind = kind_of(header.component, dimension_);
    if (axis.start_s < 0)
      throw Error("begins at " + shown(axis.start_s) + " s, expected 0 or later; sw-select --time cuts it");
    if (axis.count < 2) throw Error("has one sample, expected at least two");
    const bool any = std::any_of(trace.samples.begin(), trace.samples.end(), [](double v) { return v != 0; });
    if (!any) return;
    source.place.at_m = header.receiver_m;
    source.from = reader_.name() + ": trace " + std::to_string(reader_.delivered());
    // Traces of a file end together; where they do not, each comes when it was recorded.
    const auto& first = reader_.axis();
    const double end_s = first.start_s + double(first.count - 1) * first.interval_s;
    const double last_s = axis.start_s + double(axis.count - 1) * axis.interval_s;
    if (reversed_ && last_s > end_s + axis.interval_s / 2)
      throw Error("ends at " + shown(last_s) +
                  " s, later than the first trace, expected traces of one length");
    source.recorded.emplace(injected(axis, trace.samples, reversed_, end_s),
                            source.from + (reversed_ ? ", reversed" : ""));
    shot_of(header.shot).sources.push_back(std::move(source));
  }

  GivenShot& shot_of(std::int64_t number) {
    const auto [at, is_new] = shots_.try_emplace(number, survey_.shots.size());
    if (is_new) survey_.shots.emplace_back().number = number;
    return survey_.shots[at->second];
  }

  segy::Reader reader_;
  bool reversed_;
  int dimension_;
  GivenSurvey survey_;
  std::map<std::int64_t, std::size_t> shots_;
};

}  // namespace

GivenSurvey read_injection(const std::string& path, bool reversed, int dimension) {
  return InjectionReader(path, reversed, dimension).read();
}

}  // namespace slipwave
