// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "cli/tool.hpp"
#include "gather/receiver_line.hpp"
#include "gather/trace_filter.hpp"
#include "gather/velocity_filter.hpp"
#include "io/output_file.hpp"
#include "segy/reader.hpp"
#include "segy/writer.hpp"
#include "shooting/trace_wavelet.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string taper, wavelet, band;
  bool zero_delay = false;
  std::optional<double> interval_s;
  std::vector<std::string> gains;
  std::string velocity, wavenumber;
  bool reject = false;
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "A");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("taper", settings.taper, "T[,END]", "cosine taper at both ends, s; or START,END");
  options.add("convolve", settings.wavelet, "W",
              "convolve with a wavelet: ricker:F, sine:F[:CYCLES], gauss:F or file:PATH[:TRACE]; F in Hz");
  options.add("zero-delay", settings.zero_delay, "shift the wavelet's own time zero to t = 0");
  options.add("band", settings.band, "F1,F2,F3,F4", "zero-phase band-pass with linear slopes (Ormsby), Hz");
  options.add(
      "velocity", settings.velocity, "V1,V2[,V3,V4]",
      "keep apparent velocities along the receivers of each shot, m/s; with linear slopes V1 to V2 and "
      "V3 to V4; inf is one, signs + or - keep one way of travel");
  options.add("wavenumber", settings.wavenumber, "K1,K2,K3,K4", "likewise a band of wavenumbers, 1/m");
  options.add("reject", settings.reject, "remove what --velocity and --wavenumber keep, and keep the rest");
  options.add("resample", settings.interval_s, "DT",
              "new sampling interval, s, by band-limited interpolation");
  options.add("gain", settings.gains, "GAIN",
              "power:P, exp:A, agc:T, rms, peak, scale:C or clip:C; repeat to chain gains");
  options.needs("zero-delay", {"convolve"});
  options.needs("reject", {"velocity", "wavenumber"});
  settings.input_options.declare(options);
}

/// The part of the wavelet that a trace is long enough to feel.
Kernel kernel_of(const Settings& settings, const SampleAxis& axis) {
  const Wavelet wavelet = in_place("--convolve", [&] { return wavelet_named(settings.wavelet); });
  const double shift_s = settings.zero_delay ? wavelet.delay_s() : 0;
  const double longest_s = static_cast<double>(axis.count) * axis.interval_s;
  return sampled_kernel([&](double t_s) { return wavelet(t_s + shift_s); }, std::max(-shift_s, -longest_s),
                        std::min(wavelet.duration_s() - shift_s, longest_s), axis.interval_s);
}

/// In the order in which TraceFilter takes them.
FilterSteps steps_of(const Settings& settings, const SampleAxis& axis) {
  FilterSteps steps;
  if (!settings.taper.empty()) steps.taper = in_place("--taper", [&] { return parse_taper(settings.taper); });
  if (!settings.wavelet.empty()) steps.convolution = kernel_of(settings, axis);
  if (!settings.band.empty()) steps.band = in_place("--band", [&] { return parse_ormsby(settings.band); });
  steps.interval_s = settings.interval_s;
  for (const auto& gain : settings.gains)
    steps.gains.push_back(in_place("--gain", [&] { return parse_gain(gain); }));
  return steps;
}

FkFilterSettings fk_settings_of(const Settings& settings) {
  FkFilterSettings fk;
  if (!settings.velocity.empty())
    fk.fan = in_place("--velocity", [&] { return parse_velocity_fan(settings.velocity); });
  if (!settings.wavenumber.empty())
    fk.wavenumbers_per_m =
        in_place("--wavenumber", [&] { return parse_wavenumber_band(settings.wavenumber); });
  fk.reject = settings.reject;
  return fk;
}

/// Filters the traces of a shot together, each component along the line of its receivers, in the memory of a
/// shot.
class ShotFilter {
 public:
  using Put = std::function<void(const segy::Trace&)>;
  ShotFilter(const FkFilterSettings& settings, const SampleAxis& axis, std::vector<Gain> gains)
      : settings_(settings), axis_(axis), gains_(std::move(gains)) {}

  /// Puts the traces of the shot before once one of another comes.
  void add(const TraceHeader& header, const segy::Trace& trace, double start_s, const Put& put) {
    if (!traces_.empty() && header.shot != shot_) finish(put);
    shot_ = header.shot;
    lines_[header.component].push_back(traces_.size());
    places_.push_back(header.receiver_m);
    starts_s_.push_back(start_s);
    traces_.push_back(trace);
  }
  void finish(const Put& put) {
    for (const auto& [component, traces] : lines_)
      in_place("shot " + std::to_string(shot_) + ", " + name_of(component),
               [&, &of = traces] { filter(of); });
    for (std::size_t n = 0; n < traces_.size(); ++n) {
      gains_.apply(traces_[n].samples, {axis_.count, axis_.interval_s, starts_s_[n]});
      put(traces_[n]);
    }
    lines_.clear();
    places_.clear();
    starts_s_.clear();
    traces_.clear();
  }

 private:
  void filter(const std::vector<std::size_t>& traces) {
    std::vector<std::array<double, 3>> places;
    for (const auto n : traces) places.push_back(places_[n]);
    const auto line = line_of(places);
    if (!filter_ || filter_->receivers() != traces.size() || filter_->spacing_m() != line.spacing_m)
      filter_.emplace(axis_, traces.size(), line.spacing_m, settings_);
    std::vector<std::vector<double>*> samples;
    for (const auto n : line.order) samples.push_back(&traces_[traces[n]].samples);
    filter_->apply(samples);
  }

  FkFilterSettings settings_;
  SampleAxis axis_;
  Gains gains_;
  std::optional<FkFilter> filter_;
  std::int64_t shot_ = 0;
  std::map<Component, std::vector<std::size_t>> lines_;
  std::vector<std::array<double, 3>> places_;
  std::vector<double> starts_s_;
  std::vector<segy::Trace> traces_;
};

/// A new interval must fit the file that is written.
void check_interval(const Settings& settings, const segy::Reader& reader) {
  if (!settings.interval_s || !(*settings.interval_s > 0)) return;
  segy::FileInfo info = segy::info_like(reader, "", settings.output);
  const double samples =
      static_cast<double>(info.axis.count - 1) * info.axis.interval_s / *settings.interval_s;
  info.axis = {static_cast<std::int64_t>(std::min(samples, 1e9)) + 1, *settings.interval_s, 0};
  if (info.format.revision < 2 && samples < 1e9 && segy::needs_revision_2(info.axis))
    throw Error(
        "--resample: found " + shown(*settings.interval_s) +
            " s; before revision 2 SEG-Y holds 65535 samples at whole microseconds up to 65535 (sw-convert "
            "--revision 2 first)",
        ErrorKind::usage);
}

bool has_signal(const segy::Trace& trace) {
  return std::any_of(trace.samples.begin(), trace.samples.end(), [](double sample) { return sample != 0; });
}

void check_any_filter(const Settings& settings) {
  const bool any = !settings.taper.empty() || !settings.wavelet.empty() || !settings.band.empty() ||
                   !settings.velocity.empty() || !settings.wavenumber.empty() || settings.interval_s ||
                   !settings.gains.empty();
  if (!any)
    throw Error(
        "found no filter, expected --taper, --convolve, --band, --velocity, --wavenumber, --resample or "
        "--gain",
        ErrorKind::usage);
}

void run(const Settings& settings, const cli::Context& context) {
  segy::Reader reader(settings.input, settings.input_options.to_damage());
  const SampleAxis& axis = reader.axis_with_interval();
  check_any_filter(settings);
  check_interval(settings, reader);
  const auto over_traces = fk_settings_of(settings);
  auto steps = steps_of(settings, axis);
  auto gains = over_traces.any() ? std::exchange(steps.gains, {}) : std::vector<Gain>();
  TraceFilter filter(axis, steps);
  OutputFile out(settings.output, OutputFile::Content::binary);
  segy::FileInfo info = segy::info_like(reader, context.command_line, settings.output);
  info.axis = filter.axis();
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  const Progress progress = context.progress("filtering");
  bool any_left = false;
  const auto put = [&](const segy::Trace& trace) {
    any_left = any_left || has_signal(trace);
    writer.write(trace, reader.header().su);
  };
  ShotFilter shots(over_traces, filter.axis(), gains);
  segy::Trace trace;
  bool any_signal = false;
  while (reader.next(trace)) {
    any_signal = any_signal || has_signal(trace);
    in_place(reader.name() + ": trace " + std::to_string(reader.delivered()), [&] {
      const double start_s = reader.axis_of(trace).start_s;
      filter.apply(trace.samples, start_s);
    });
    if (over_traces.any())
      in_place(reader.name(),
               [&] { shots.add(reader.si_header(trace), trace, reader.axis_of(trace).start_s, put); });
    else
      put(trace);
    if (progress && reader.size())
      progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
  }
  in_place(reader.name(), [&] { shots.finish(put); });
  for (const std::string& sentence : writer.finish()) context.warn(sentence);
  if (any_signal && !any_left) context.warn(reader.name() + ": the filter leaves nothing but zeros");
  out.commit();
  for (const auto& sentence : reader.doubts()) context.warn(sentence);
  reader.expect_whole();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{
      "sw-filter",
      "Tapers, convolves, band-passes, resamples, filters over f-k and scales traces, in this order.",
      "[options] [A] [-o OUTPUT]", "sw-filter gather.sgy --band 3,6,30,40 --gain agc:0.5 -o filtered.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
