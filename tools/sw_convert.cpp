// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "io/output_file.hpp"
#include "segy/conversion.hpp"
#include "segy/sniff.hpp"
#include "traces/cube_numbers.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string input = "-";
  std::string output = "-";
  std::string format = "same";
  std::string revision = "same";
  std::string endian = "same";
  std::string text = "same";
  bool su = false;
  bool cube = false;
  bool area = false;
  std::string input_format = "auto";
  std::string input_endian = "auto";
  bool input_su = false;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.input, "A");
  options.add("output,o", settings.output, "FILE", "output file; - is standard output");
  options.add("format", settings.format, "NAME", "sample format: ibm, ieee, double, int16, ... or its code");
  options.add_choice("revision", settings.revision, {"same", "0", "1", "2"},
                     "revision of SEG-Y; 2 is written as 2.1");
  options.add_choice("endian", settings.endian, {"same", "big", "little"}, "byte order");
  options.add_choice("text", settings.text, {"same", "ebcdic", "ascii"}, "code of the textual headers");
  options.add("su", settings.su,
              "write Seismic Unix: IEEE floats in the machine's byte order, no reel headers");
  options.add("cube", settings.cube,
              "number in-lines by shot and cross-lines by channel, for programs that expect a cube");
  options.add("area", settings.area,
              "number in-lines and cross-lines by the y and x of receivers that cover an area, likewise");
  options.add("input-format", settings.input_format, "NAME",
              "sample format of the input, overriding its header");
  options.add_choice("input-endian", settings.input_endian, {"auto", "big", "little"},
                     "byte order of the input");
  options.add("input-su", settings.input_su, "read the input as Seismic Unix");
  options.excludes("cube", {"area"});
}

int format_code(const std::string& option, const std::string& name) {
  return in_place(option, [&] { return segy::format_named(name).code; });
}

segy::Endian endian_named(const std::string& name) {
  return name == "big" ? segy::Endian::big : segy::Endian::little;
}

segy::ReadOptions read_options(const Settings& settings) {
  segy::ReadOptions options;
  options.to_damage = true;
  options.su = settings.input_su;
  if (settings.input_endian != "auto") options.endian = endian_named(settings.input_endian);
  if (settings.input_format != "auto") options.format = format_code("--input-format", settings.input_format);
  return options;
}

/// The input's format, as far as the options say nothing else.
segy::FileFormat wanted_format(const Settings& settings, const segy::Reader& reader) {
  segy::FileFormat format = segy::format_of(reader);
  const bool from_su = format.su;
  format.su = settings.su || segy::names_su(settings.output);
  if (format.su) {
    format.code = 5;
    format.revision = 1;
    format.endian = segy::native_endian;
  } else if (from_su) {
    format.endian = segy::Endian::big;
  }
  if (settings.format != "same") format.code = format_code("--format", settings.format);
  if (settings.endian != "same") format.endian = endian_named(settings.endian);
  if (settings.text != "same")
    format.encoding = settings.text == "ascii" ? segy::TextEncoding::ascii : segy::TextEncoding::ebcdic;
  if (settings.revision != "same") format.revision = std::stoi(settings.revision);
  return format;
}

void refuse_with_su(const Settings& settings) {
  const auto refuse = [&](const std::string& option) {
    throw Error("found " + (settings.su ? std::string("--su") : "-o " + settings.output) + " and " + option +
                    ", expected one of them: Seismic Unix has no such thing",
                ErrorKind::usage);
  };
  if (settings.revision != "same") refuse("--revision");
  if (settings.text != "same") refuse("--text");
  if (settings.cube) refuse("--cube");
  if (settings.area) refuse("--area");
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.su || segy::names_su(settings.output)) refuse_with_su(settings);
  const segy::ReadOptions options = read_options(settings);
  if (settings.format != "same") format_code("--format", settings.format);
  segy::Reader reader(settings.input, options);
  const segy::FileHeader& header = reader.header();
  const segy::FileFormat format = wanted_format(settings, reader);
  const segy::FileInfo info = segy::info_as(reader, context.command_line, format);
  OutputFile out(settings.output, OutputFile::Content::binary);
  for (const std::string& sentence : segy::losses_of(reader, format)) context.warn(sentence);
  for (const std::string& sentence : segy::warnings_of(info)) context.warn(sentence);
  segy::Writer writer(out, info);
  const Progress progress = context.progress("converting");
  CubeNumbers cube;
  AreaNumbers area;
  const auto copy = [&](auto trace) {
    while (reader.next(trace)) {
      in_place(reader.name(), [&] {
        if (settings.cube) cube.number(trace.words);
        if (settings.area) area.number(trace.words);
        writer.write(trace, header.su);
      });
      if (progress && reader.size())
        progress(static_cast<std::int64_t>(reader.position()), static_cast<std::int64_t>(*reader.size()));
    }
  };
  if (format.code == header.format->code && format.endian == header.endian)
    copy(segy::RawTrace());
  else
    copy(segy::Trace());
  in_place(reader.name(), [&] {
    cube.finish();
    area.finish();
  });
  for (const std::string& sentence : writer.finish()) context.warn(sentence);
  out.commit();
  for (const auto& sentence : reader.doubts()) context.warn(sentence);
  reader.expect_whole();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  const cli::ToolInfo info{
      "sw-convert", "Converts traces to another sample format, revision, byte order, or for Seismic Unix.",
      "[options] [A] [-o OUTPUT]", "sw-convert gather.sgy --su | suxwigb"};
  return cli::run_tool(
      argc, argv, info, [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
