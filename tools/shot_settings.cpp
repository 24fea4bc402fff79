#include "shot_settings.hpp"

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/model_netcdf.hpp"
#include "solver/schedule/subdomains.hpp"

namespace slipwave {
namespace {

EdgeLaw edge_law(const std::string& name) {
  return name == "free"     ? EdgeLaw::free
         : name == "rigid"  ? EdgeLaw::rigid
         : name == "mirror" ? EdgeLaw::mirror
                            : EdgeLaw::absorbing;
}

template <int D>
Survey<D> make_survey(const ShotSettings& s) {
  Survey<D> survey;
  const auto wavelet = in_place("--wavelet", [&] { return parse_wavelet(s.wavelet); });
  const auto mechanism = in_place("--kind", [&] { return parse_mechanism<D>(s.kind); });
  for (const auto& text : s.sources)
    survey.sources.push_back(
        {in_place("--source", [&] { return parse_point<D>(text); }), mechanism, wavelet, s.amplitude});
  for (const auto& text : s.receivers)
    for (const auto& point : in_place("--receivers", [&] { return parse_line<D>(text); }))
      survey.receivers_m.push_back(point);
  return survey;
}

}  // namespace

void ShotSettings::declare_scene(cli::Options& options) {
  const std::vector<std::string> edges = {"free", "absorbing", "rigid", "mirror"};
  options.positional(model, "MODEL");
  options.add("source", sources, "X,Z", "position of the source, m; repeat for several shots; in 3-D X,Y,Z");
  options.add("kind", kind, "KIND",
              "explosion, force:AX,AZ, moment:MXX,MZZ,MXZ or plane:ANGLE (degrees, 0 is down); in 3-D "
              "force:AX,AY,AZ, moment:MXX,MYY,MZZ,MXY,MXZ,MYZ");
  options.add("wavelet", wavelet, "W", "ricker:F, sine:F[:CYCLES], gauss:F or file:PATH; F in Hz");
  options.add("amplitude", amplitude, "A",
              "explosion, moment: N m/s per m; force: N/m; plane: m/s; in 3-D N m/s and N");
  options.add("receivers", receivers, "X0:X1:DX,Z",
              "line of receivers, or one at X,Z, m; repeatable; in 3-D also an area, "
              "X0:X1:DX,Y0:Y1:DY,Z");
  options.add("time", duration_s, "T", "length of the traces, s");
  options.add("dt", interval_s, "DT", "sampling interval of the traces, s");
  options.add("record", record, "LIST",
              "components: vx, vz, p, sxx, szz, sxz; in 3-D also vy, syy, sxy, syz");
  options.add_choice("top", top, edges, "boundary at the surface, z = 0");
  options.add_choice("sides", sides, edges, "left and right boundaries, in 3-D all four");
  options.add_choice("bottom", bottom, edges, "boundary at the bottom");
  options.add("edge-width", edge_width, "CELLS",
              "width of the absorbing zones outside the model; 0: 20, or 40 for plane waves");
  options.add("without", without, "LIST",
              "effects to switch off: slip, friction, viscosity, cohesion, opening, prestress");
  options.add_choice("precision", precision, {"float", "double"}, "floating-point precision");
  options.add("allow-auxetic", limits.allow_auxetic, "allow vs above vp/sqrt(2)");
}

void ShotSettings::declare_numerics(cli::Options& options) {
  options.add_choice("order", order, {"1", "3", "5", "7"}, "order of the scheme in space");
  options.add_choice("time-order", time_order, {"2", "4"},
                     "order in time; 4: six times the work per step, --cfl up to 2");
  options.add_choice("correction", correction, {"first", "second", "exponential"},
                     "time integration of slip: first order, second order, or exact per step");
  options.add("cfl", cfl, "C", "Courant number: time step over h/vp_max");
  options.add("time-step", time_step_s, "S", "time step, s, instead of --cfl");
}

template <int D>
Scene<D> ShotSettings::without_model() const {
  Scene<D> scene;
  scene.survey = make_survey<D>(*this);
  for (const auto& name : split(record, ','))
    scene.recording.components.push_back(in_place("--record", [&] { return component_named(name); }));
  scene.recording.duration_s = duration_s;
  scene.recording.interval_s = interval_s;
  for (int axis = 0; axis < D - 1; ++axis) scene.edges[axis] = {edge_law(sides), edge_law(sides)};
  scene.edges[D - 1] = {edge_law(top), edge_law(bottom)};
  scene.numerics.order = std::stoi(order);
  scene.numerics.cfl = cfl;
  scene.numerics.time_step_s = time_step_s;
  scene.numerics.zone_cells = edge_width;
  scene.numerics.correction = correction == "first"    ? SlipCorrection::first
                              : correction == "second" ? SlipCorrection::second
                                                       : SlipCorrection::exponential;
  scene.numerics.double_precision = precision == "double";
  scene.numerics.time_order = std::stoi(time_order);
  for (const auto effect : effects_without()) scene.with_slip &= effect != SlipEffect::slip;
  return scene;
}

std::vector<SlipEffect> ShotSettings::effects_without() const {
  std::vector<SlipEffect> effects;
  if (without.empty()) return effects;
  for (const auto& name : split(without, ','))
    effects.push_back(in_place("--without", [&] { return slip_effect_named(name); }));
  return effects;
}

template <int D>
void ShotSettings::check_model(Model<D>& read) const {
  in_place(model == "-" ? "standard input" : model, [&] { check(read, limits); });
  for (const auto effect : effects_without()) remove_effect(read, effect);
  // What is left must still hold together: planes without friction may slip under the static stress.
  if (!without.empty()) in_place("--without " + without, [&] { check(read, limits); });
}

template <int D>
void ShotSettings::read_model_into(Scene<D>& scene, const NetcdfFile& file) const {
  scene.model = read_model<D>(file);
  check_model(scene.model);
  check(scene);
}

template <int D>
void ShotSettings::read_part_into(Scene<D>& scene, const NetcdfFile& file, Ranks& all, Ranks* group) const {
  collective_try(&all, [&] {
    if (group) {
      const auto grid = read_model_grid<D>(file);
      check(scene.survey, grid);
      scene.subdomain = subdomain_for(scene, grid, group->number(), group->count());
      const auto [first, last] = rows_held(scene.subdomain);
      scene.model = read_model_rows<D>(file, first, last);
    } else {
      scene.model = read_model<D>(file);
    }
    check_model(scene.model);
  });
  if (group) join(scene, *group);
  collective_try(&all, [&] { check(scene); });
}

template Scene<2> ShotSettings::without_model() const;
template Scene<3> ShotSettings::without_model() const;
template void ShotSettings::read_part_into(Scene<2>&, const NetcdfFile&, Ranks&, Ranks*) const;
template void ShotSettings::read_part_into(Scene<3>&, const NetcdfFile&, Ranks&, Ranks*) const;
template void ShotSettings::read_model_into(Scene<2>&, const NetcdfFile&) const;
template void ShotSettings::read_model_into(Scene<3>&, const NetcdfFile&) const;

}  // namespace slipwave
