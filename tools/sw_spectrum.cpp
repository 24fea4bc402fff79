#include <map>
#include <string>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "cli/tool.hpp"
#include "gather/spectrum.hpp"
#include "gather/spectrum_file.hpp"
#include "segy/reader.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string window = "none";
  SpectrumSettings spectrum;
  bool each = false;
  bool text = false;
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "A");
  options.add("output,o", settings.output, "FILE", "where the spectra go, - is standard output");
  options.add("each", settings.each, "a spectrum for each trace, not the mean of each component");
  options.add("power", settings.spectrum.power, "energy spectral density, not amplitude");
  options.add_choice("window", settings.window, window_names(), "weights on the samples");
  options.add("pad", settings.spectrum.pad, "FACTOR",
              "transform length over trace length, filled with zeros");
  options.add("text", settings.text, "columns of numbers, not netCDF");
  settings.input_options.declare(options);
}

void run(const Settings& settings, const cli::Context& context) {
  const segy::ReadOptions options = settings.input_options.read_options();
  segy::Reader reader(settings.input, options);
  SpectrumSettings wanted = settings.spectrum;
  wanted.window = window_named(settings.window);
  const SampleAxis axis = reader.axis_with_interval();
  SpectrumTransform transform(axis, wanted);
  SpectrumFacts facts{transform.frequencies_hz(),
                      wanted.power,
                      definition_of(axis, wanted, transform.length()),
                      context.command_line,
                      {}};
  if (!reader.header().su) facts.source = segy::shown_lines(reader.header().text);
  OutputFile out(settings.output, settings.text ? OutputFile::Content::text : OutputFile::Content::binary);
  const auto file = settings.text ? spectrum_text(out, facts) : spectrum_netcdf(out, facts);
  std::map<Component, SpectrumMean> means;
  segy::Trace trace;
  while (reader.next(trace)) {
    const TraceHeader header = reader.si_header(trace);
    const auto values = in_place(reader.name() + ": trace " + std::to_string(reader.delivered()),
                                 [&] { return transform.of(trace.samples); });
    if (settings.each)
      file->add(header, values);
    else
      means[header.component].add(values);
  }
  if (reader.delivered() == 0) throw Error(reader.name() + ": has no traces, expected at least one");
  if (!settings.each) file->add_means(means);
  file->finish();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-spectrum", "Amplitude or energy spectra of traces",
                           "[options] [A] [-o OUTPUT]",
                           "sw-spectrum response.sgy --window hann --pad 4 --text"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
