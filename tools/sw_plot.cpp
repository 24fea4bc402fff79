#include "base/error.hpp"
#include "base/input_bytes.hpp"
#include "base/netcdf_container.hpp"
#include "base/netcdf_file.hpp"
#include "base/output_file.hpp"
#include "cli/tool.hpp"
#include "model/model_report.hpp"
#include "plot/gather_picture.hpp"
#include "plot/model_picture.hpp"
#include "segy/reader.hpp"
#include "segy/sniff.hpp"
#include "trace_input.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string file = "-";
  std::string output = "-";
  plot::PageSettings page;
  std::string map = "auto", clip_text, range, x, y;
  plot::Look look;
  // gathers
  std::string component, axis = "auto", style = "density";
  std::optional<double> shot;
  double gain_power = 0;
  TraceInput traces;
  // models
  std::string property = "vp", survey;
};

void declare(cli::Options& options, Settings& settings) {
  options.positional(settings.file, "FILE");
  options.add("output,o", settings.output, "FILE",
              "the picture, by its ending .png, .pdf or .svg; - is a PNG");
  options.add("size", settings.page.size, "SIZE", "of the picture, 16x10cm or 1200x800px");
  options.add("dpi", settings.page.dpi, "N", "pixels per inch");
  options.add("title", settings.page.title, "TEXT", "above the picture");
  options.add("map", settings.map, "NAME", "colours: uniform, grey, white-black, blue-red, red-blue");
  options.add("clip", settings.look.clip_percent, "PERCENT", "full colour at this percentile of magnitudes");
  options.add("range", settings.range, "LOW:HIGH", "full colour at these values instead");
  options.add("x", settings.x, "LOW:HIGH", "part of the horizontal axis");
  options.add("y", settings.y, "LOW:HIGH", "part of the vertical axis");
  options.add("component", settings.component, "NAME", "gather: vx, vz, p, ...");
  options.add("shot", settings.shot, "N", "gather: this shot only");
  options.add_choice("axis", settings.axis, {"auto", "x", "offset", "depth", "trace"},
                     "gather: what traces stand at");
  options.add_choice("style", settings.style, {"density", "wiggle", "both"},
                     "gather: colours, lines or both");
  options.add("gain-power", settings.gain_power, "P", "gather: samples times time to this power");
  options.add_choice("property", settings.property, {"vp", "vs", "rho", "fractures"}, "model: what is drawn");
  options.add("survey", settings.survey, "GATHER", "model: marks its sources and receivers");
  settings.traces.declare(options);
}

plot::Picture gather_picture(const Settings& settings, const std::vector<char>& taken,
                             const plot::Page& page) {
  plot::TraceChoice choice;
  if (!settings.component.empty())
    choice.component = in_place("--component", [&] { return component_named(settings.component); });
  if (settings.shot) choice.shot = std::int64_t(*settings.shot);
  const plot::GatherStyle style{settings.style != "wiggle", settings.style != "density",
                                plot::trace_axis_named(settings.axis), settings.gain_power};
  segy::Reader reader(settings.file, settings.traces.read_options(), {taken.begin(), taken.end()});
  return plot::draw_gather(plot::read_section(reader, choice), style, settings.look, page);
}

plot::Picture netcdf_picture(const Settings& settings, const NetcdfFile& file, const plot::Page& page) {
  if (kind_of(file) != "model") throw Error(file.shown_name() + ": is no model, expected one");
  const bool as_sets = settings.property == "fractures";
  const auto section = plot::read_model_section(file, as_sets ? "vp" : settings.property);
  plot::SurveyMarks marks;
  if (!settings.survey.empty()) {
    segy::Reader reader(settings.survey, settings.traces.read_options());
    marks = plot::read_survey(reader);
  }
  return plot::draw_model(section, as_sets, marks, settings.look, page);
}

plot::Picture picture_of(const Settings& settings, const plot::Page& page) {
  const InputStart start(settings.file, 3600);
  const auto& first = start.bytes();
  if (begins_netcdf({first.data(), first.size()})) {
    return netcdf_picture(settings,
                          start.is_regular() ? NetcdfFile::open(settings.file)
                                             : NetcdfFile::open(read_all(settings.file, start.taken()),
                                                                shown_input(settings.file)),
                          page);
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (settings.traces.su || segy::looks_like_segy(bytes))
    return gather_picture(settings, start.taken(), page);
  throw Error(shown_input(settings.file) + ": is " +
              (first.empty() ? "empty" : "no netCDF, SEG-Y or Seismic Unix file") +
              ", expected a model, snapshots, spectra or a gather");
}

void run(Settings& settings, const cli::Context& context) {
  in_place("--title", [&] { plot::check_text(settings.page.title); });
  settings.page.history = context.command_line;
  const auto page = plot::page_of(plot::format_of(settings.output), settings.page);
  if (settings.map != "auto") settings.look.map = settings.map;
  const auto limits = [](const std::string& option, const std::string& text,
                         std::optional<plot::Limits>& to) {
    if (!text.empty()) to = in_place(option, [&] { return plot::parse_limits(text); });
  };
  limits("--range", settings.range, settings.look.colours);
  limits("--x", settings.x, settings.look.x);
  limits("--y", settings.y, settings.look.y);
  OutputFile out(settings.output, OutputFile::Content::binary);
  const auto picture = picture_of(settings, page);
  for (const auto& note : picture.notes) context.warn(note);
  out.write(picture.bytes.data(), picture.bytes.size());
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-plot", "Draws models, gathers, snapshots and spectra.", "[options] [FILE] [-o PICTURE]",
       "sw-plot response.sgy --component vz --clip 98 -o response.png"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
