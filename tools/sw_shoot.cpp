#include <optional>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "model/model_netcdf.hpp"
#include "shot_output.hpp"
#include "solver/plan.hpp"

using namespace slipwave;

namespace {

struct Settings {
  std::string model = "-";
  std::vector<std::string> sources, receivers;
  std::string kind = "explosion", wavelet, record = "vz,vx,p";
  std::string top = "free", sides = "absorbing", bottom = "absorbing";
  std::string order = "5", correction = "second", precision = "float", without;
  double amplitude = 1, duration_s = 0, interval_s = 0.001, cfl = 0.9;
  std::optional<double> time_step_s, every_s;
  int edge_width = 0;
  bool plan = false;
  MediumLimits limits;
  ShotOutput output;
};

void declare(cli::Options& options, Settings& s) {
  const std::vector<std::string> edges = {"free", "absorbing", "rigid", "mirror"};
  options.positional(s.model, "MODEL");
  options.add("source", s.sources, "X,Z", "where the source is, m; repeated: several shots");
  options.add("kind", s.kind, "KIND",
              "explosion, force:AX,AZ, moment:MXX,MZZ,MXZ or plane:ANGLE (0 = down, degrees)");
  options.add("wavelet", s.wavelet, "W", "ricker:F, sine:F[:CYCLES], gauss:F or file:PATH; F in Hz");
  options.add("amplitude", s.amplitude, "A", "explosion, moment: N m/s per m; force: N/m; plane: m/s");
  options.add("receivers", s.receivers, "X0:X1:DX,Z", "line of receivers or one X,Z, m; may be repeated");
  options.add("time", s.duration_s, "T", "length of the traces, s");
  options.add("dt", s.interval_s, "DT", "sampling interval of the traces, s");
  options.add("record", s.record, "LIST", "of vx, vz, p, sxx, szz, sxz");
  options.add_choice("top", s.top, edges, "the surface z = 0");
  options.add_choice("sides", s.sides, edges, "the left and right edges");
  options.add_choice("bottom", s.bottom, edges, "the bottom edge");
  options.add("edge-width", s.edge_width, "CELLS",
              "width of the absorbing layers outside the model; 0: 20, or 40 for plane waves");
  options.add_choice("order", s.order, {"1", "3", "5", "7"}, "order of the scheme in space");
  options.add_choice("correction", s.correction, {"first", "second"}, "order of the slip correction in time");
  options.add_choice("without", s.without, {"slip"}, "switch an effect of the model off");
  options.add_choice("precision", s.precision, {"float", "double"}, "of the computation");
  options.add("cfl", s.cfl, "C", "time step over its stability limit");
  options.add("time-step", s.time_step_s, "S", "time step in s, instead of --cfl");
  options.add("snapshots", s.output.snapshots, "FILE", "write whole wave fields to this netCDF file");
  options.add("every", s.every_s, "S", "time between snapshots, s");
  options.add("fields", s.output.snapshot_fields, "LIST", "of vx, vz, p, sxx, szz, sxz, div, curl");
  options.add("plan", s.plan, "print what would be computed, and stop");
  options.add("allow-auxetic", s.limits.allow_auxetic, "let vs exceed vp/sqrt(2)");
  options.add("output,o", s.output.traces, "GATHER",
              "SEG-Y; {component} and {shot} in the name split the traces; - is standard output");
  for (const char* name : {"source", "wavelet", "time"}) options.require(name);
  options.add_threads();
}

EdgeLaw edge_law(const std::string& name) {
  return name == "free"     ? EdgeLaw::free
         : name == "rigid"  ? EdgeLaw::rigid
         : name == "mirror" ? EdgeLaw::mirror
                            : EdgeLaw::absorbing;
}

Survey<2> make_survey(const Settings& s) {
  Survey<2> survey;
  const auto wavelet = in_place("--wavelet", [&] { return parse_wavelet(s.wavelet); });
  const auto mechanism = in_place("--kind", [&] { return parse_mechanism<2>(s.kind); });
  for (const auto& text : s.sources)
    survey.sources.push_back(
        {in_place("--source", [&] { return parse_point<2>(text); }), mechanism, wavelet, s.amplitude});
  for (const auto& text : s.receivers)
    for (const auto& point : in_place("--receivers", [&] { return parse_line<2>(text); }))
      survey.receivers_m.push_back(point);
  return survey;
}

Scene<2> make_scene(const Settings& s) {
  Scene<2> scene;
  scene.survey = make_survey(s);
  for (const auto& name : split(s.record, ','))
    scene.recording.components.push_back(in_place("--record", [&] { return component_named(name); }));
  scene.recording.duration_s = s.duration_s;
  scene.recording.interval_s = s.interval_s;
  scene.edges[0] = {edge_law(s.sides), edge_law(s.sides)};
  scene.edges[1] = {edge_law(s.top), edge_law(s.bottom)};
  scene.numerics = {std::stoi(s.order),
                    s.cfl,
                    s.time_step_s,
                    s.edge_width,
                    s.correction == "first" ? SlipCorrection::first : SlipCorrection::second,
                    s.precision == "double"};
  scene.with_slip = s.without != "slip";
  if (!s.output.snapshots.empty()) {
    if (!s.every_s)
      throw Error("found --snapshots without --every, expected the time between them", ErrorKind::usage);
    scene.snapshot_every_s = s.every_s;
  }
  s.output.check(scene.survey.sources.size());
  if (scene.survey.receivers_m.empty() && s.output.snapshots.empty() && !s.plan)
    throw Error("found neither --receivers nor --snapshots, expected what to record", ErrorKind::usage);
  scene.model = read_model<2>(s.model);
  in_place(s.model == "-" ? "standard input" : s.model, [&] { check(scene.model, s.limits); });
  check(scene);
  return scene;
}

void run(const Settings& settings, const cli::Context& context) {
  const Scene<2> scene = make_scene(settings);
  for (const auto& sentence : warnings(scene)) context.warn(sentence);
  if (settings.plan) {
    const std::string text = report_of(plan(scene)).lines();
    OutputFile out(settings.output.traces, OutputFile::Content::text);
    out.write(text.data(), text.size());
    return out.commit();
  }
  std::string history = scene.model.history;
  append_history(history, context.command_line);
  settings.output.shoot_all(scene, history, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-shoot", "Shoots a model: what a survey over it would record.", "[options] MODEL [-o GATHER]",
       "sw-shoot model.nc --source 1250,5 --wavelet ricker:30 --receivers 0:2500:25,5 --time 1 "
       "-o shot.sgy"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
