// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "gather/difference.hpp"
#include "io/output_file.hpp"
#include "segy/writer.hpp"
#include "trace_pair.hpp"
#include "traces/float_difference.hpp"

using namespace slipwave;

namespace {

struct Settings {
  TracePair inputs;
  std::string output = "-";
};

void declare(cli::Options& options, Settings& settings) {
  settings.inputs.declare(options);
  options.add("output,o", settings.output, "FILE", "output file for A - B; - is standard output");
  settings.inputs.input_options.declare(options);
}

/// A number that is none can come from either file.
std::string place_of(const OpenPair& pair) { return pair.a.name() + " minus " + pair.b.name(); }

/// Floats are subtracted as they lie in the files.
void subtract_floats(OpenPair& pair, segy::Writer& writer, const std::function<void()>& progress) {
  const segy::Endian order_of_a = pair.a.header().endian, order_of_b = pair.b.header().endian;
  segy::RawTrace a, b;
  std::vector<std::uint8_t> difference;
  while (pair.both.next(a, b)) {
    difference.resize(a.samples.size());
    slipwave::subtract_floats(a.samples, order_of_a, b.samples, order_of_b, difference);
    a.samples = difference;
    in_place(place_of(pair), [&] { writer.write(a, pair.a.header().su); });
    progress();
  }
}

void subtract_numbers(OpenPair& pair, segy::Writer& writer, const std::function<void()>& progress) {
  segy::Trace a, b;
  while (pair.both.next(a, b)) {
    subtract(a.samples, b.samples);
    in_place(place_of(pair), [&] { writer.write(a, pair.a.header().su); });
    progress();
  }
}

void run(const Settings& settings, const cli::Context& context) {
  OpenPair pair(settings.inputs);
  OutputFile out(settings.output, OutputFile::Content::binary);
  const segy::FileInfo info = segy::info_like(pair.a, context.command_line, settings.output);
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  const Progress progress = context.progress("subtracting");
  const auto after_each = [&] {
    if (progress && pair.a.size())
      progress(static_cast<std::int64_t>(pair.a.position()), static_cast<std::int64_t>(*pair.a.size()));
  };
  const bool floats = pair.a.header().format->code == 5 && pair.b.header().format->code == 5;
  if (floats && info.format.code == 5)
    subtract_floats(pair, writer, after_each);
  else
    subtract_numbers(pair, writer, after_each);
  for (const std::string& sentence : writer.finish()) context.warn(sentence);
  out.commit();
  pair.warn_of_doubts(context);
  pair.expect_whole();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-diff", "Subtracts gather B from gather A, trace by trace.",
                           "[options] A B [-o OUTPUT]", "sw-diff fractured.sgy elastic.sgy -o response.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
