#include <string>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "cli/tool.hpp"
#include "gather/difference.hpp"
#include "segy/pair.hpp"
#include "segy/reader.hpp"
#include "segy/writer.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string a;
  std::string b;
  std::string output = "-";
  TraceInput input_options;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.a, "A");
  options.positional(settings.b, "B");
  options.require("A");
  options.require("B");
  options.add("output,o", settings.output, "FILE", "where A - B goes, - is standard output");
  settings.input_options.declare(options);
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.a == "-" && settings.b == "-")
    throw Error("A and B are both standard input, expected two inputs", ErrorKind::usage);
  const segy::ReadOptions options = settings.input_options.read_options();
  segy::Reader a(settings.a, options);
  segy::Reader b(settings.b, options);
  segy::PairReader pair(a, b);
  OutputFile out(settings.output, OutputFile::Content::binary);
  const segy::FileInfo info = segy::info_like(a, context.command_line);
  segy::Writer writer(out, info);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  const Progress progress = context.progress("subtracting");
  segy::Trace trace_a;
  segy::Trace trace_b;
  while (pair.next(trace_a, trace_b)) {
    subtract(trace_a.samples, trace_b.samples);
    writer.write(trace_a, a.header().su);
    if (progress && a.size())
      progress(static_cast<std::int64_t>(a.position()), static_cast<std::int64_t>(*a.size()));
  }
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{"sw-diff", "A minus B, trace by trace: gathers of the same sampling and geometry",
                           "[options] A B [-o OUTPUT]", "sw-diff fractured.sgy elastic.sgy -o response.sgy"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
