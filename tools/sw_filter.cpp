// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "cli/tool.hpp"
#include "gather/trace_filter.hpp"
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
  options.add("resample", settings.interval_s, "DT",
              "new sampling interval, s, by band-limited interpolation");
  options.add("gain", settings.gains, "GAIN",
              "power:P, exp:A, agc:T, rms, peak, scale:C or clip:C; repeat to chain gains");
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

void run(const Settings& settings, const cli::Context& context) {
  if (settings.zero_delay && settings.wavelet.empty())
    throw Error("--zero-delay needs --convolve", ErrorKind::usage);
  segy::Reader reader(settings.input, settings.input_options.read_options());
  const SampleAxis& axis = reader.axis_with_interval();
  TraceFilter filter(axis, steps_of(settings, axis));
  OutputFile out(settings.output, OutputFile::Content::binary);
  segy::FileInfo info = segy::info_like(reader, context.command_line, settings.output);
  info.axis = filter.axis();
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  const Progress progress = context.progress("filtering");
  segy::Trace trace;
  while (reader.next(trace)) {
    in_place(reader.name() + ": trace " + std::to_string(reader.delivered()),
             [&] { filter.apply(trace.samples, reader.axis_of(trace).start_s); });
    writer.write(trace, reader.header().su);
    if (progress && reader.size())
      progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
  }
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{
      "sw-filter", "Tapers, convolves, band-passes, resamples and scales traces, in this order.",
      "[options] [A] [-o OUTPUT]", "sw-filter gather.sgy --band 3,6,30,40 --gain agc:0.5 -o filtered.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
