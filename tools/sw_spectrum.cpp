// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/history.hpp"
#include "cli/tool.hpp"
#include "gather/fk_file.hpp"
#include "gather/phase_velocity.hpp"
#include "gather/spectrum.hpp"
#include "gather/spectrum_file.hpp"
#include "io/output_file.hpp"
#include "segy/history.hpp"
#include "segy/reader.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string window = "none";
  SpectrumSettings spectrum;
  std::string velocities;
  bool each = false, fk = false, phase_velocity = false;
  bool text = false;
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "A");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("each", settings.each, "one spectrum per trace, not the mean of each component");
  options.add("fk", settings.fk, "over wavenumber and frequency; mean over the shots of each component");
  options.add("phase-velocity", settings.phase_velocity,
              "with --fk: over phase velocity instead of wavenumber (a dispersion image)");
  options.add("velocities", settings.velocities, "V1:V2[:DV]",
              "with --phase-velocity: these, m/s, negative towards falling positions [where the energy is]");
  options.add("power", settings.spectrum.power, "energy density instead of amplitude");
  options.add_choice("window", settings.window, window_names(),
                     "taper of the samples, with --fk also of the receivers");
  options.add("pad", settings.spectrum.pad, "FACTOR",
              "zero padding: length of the transform over that of the trace (and line)");
  options.add("text", settings.text, "columns of numbers instead of netCDF");
  options.excludes("fk", {"each"}, "a gather has one f-k spectrum");
  options.needs("phase-velocity", {"fk"});
  options.needs("velocities", {"phase-velocity"});
  settings.input_options.declare(options);
}

std::vector<std::string> source_of(const segy::Reader& reader) {
  if (reader.header().su) return {};
  return segy::shown_lines(reader.header().text);
}

/// Commands up to this one.
std::string history_of(const segy::Reader& reader, const cli::Context& context) {
  const auto before = segy::history_of(reader.header());
  std::string history = before.complete ? before.commands : "";
  append_history(history, context.command_line);
  return history;
}

/// Hands every trace to `take`; there must be one.
void for_each_trace(segy::Reader& reader, const Progress& progress,
                    const std::function<void(const TraceHeader&, std::span<const double>)>& take) {
  segy::Trace trace;
  while (reader.next(trace)) {
    in_place(reader.name() + ": trace " + std::to_string(reader.delivered()), [&] {
      check_finite(trace.samples);
      take(reader.si_header(trace), trace.samples);
    });
    if (progress && reader.size())
      progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
  }
  if (reader.delivered() == 0) throw Error(reader.name() + ": has no traces, expected at least one");
}

void write_spectra(segy::Reader& reader, const Settings& settings, OutputFile& out,
                   const cli::Context& context) {
  const SampleAxis axis = reader.axis_with_interval();
  SpectrumTransform transform(axis, settings.spectrum);
  const SpectrumFacts facts{transform.frequencies_hz(), settings.spectrum.power,
                            definition_of(axis, settings.spectrum, transform.length()),
                            history_of(reader, context), source_of(reader)};
  const auto file = settings.text ? spectrum_text(out, facts) : spectrum_netcdf(out, facts);
  std::map<Component, SpectrumMean> means;
  for_each_trace(reader, context.progress("transforming"),
                 [&](const TraceHeader& header, std::span<const double> samples) {
                   const auto values = transform.of(samples);
                   if (settings.each)
                     file->add(header, values);
                   else
                     means[header.component].add(values);
                 });
  if (!settings.each) file->add_means(means);
  file->finish();
}

std::optional<PhaseVelocityChoice> choice_of(const Settings& settings) {
  if (!settings.phase_velocity) return std::nullopt;
  if (settings.velocities.empty()) return PhaseVelocityChoice{};
  return in_place("--velocities",
                  [&] { return PhaseVelocityChoice{parse_velocity_range(settings.velocities).values()}; });
}

void write_fk(segy::Reader& reader, const Settings& settings, OutputFile& out, const cli::Context& context) {
  const SampleAxis axis = reader.axis_with_interval();
  FkSpectra spectra(axis, settings.spectrum, choice_of(settings));
  for_each_trace(
      reader, context.progress("transforming"),
      [&](const TraceHeader& header, std::span<const double> samples) { spectra.add(header, samples); });
  in_place(reader.name(), [&] { spectra.finish(); });
  context.note("took " + shown(spectra.bytes() / (1 << 20), 3) +
               " MiB for a shot, its transform and the spectra");
  const FkFacts facts{axis, settings.spectrum, history_of(reader, context), source_of(reader)};
  if (settings.text)
    write_fk_text(out, facts, spectra);
  else
    write_fk_netcdf(out, facts, spectra);
}

void run(Settings& settings, const cli::Context& context) {
  settings.spectrum.window = window_named(settings.window);
  segy::Reader reader(settings.input, settings.input_options.to_damage());
  OutputFile out(settings.output, settings.text ? OutputFile::Content::text : OutputFile::Content::binary);
  if (settings.fk)
    write_fk(reader, settings, out, context);
  else
    write_spectra(reader, settings, out, context);
  for (const auto& sentence : reader.doubts()) context.warn(sentence);
  reader.expect_whole();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{
      "sw-spectrum",
      "Computes amplitude or energy spectra of traces, over frequency or wavenumber and frequency.",
      "[options] [A] [-o OUTPUT]", "sw-spectrum response.sgy --window hann --pad 4 --text"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
