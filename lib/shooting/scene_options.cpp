#include "shooting/scene_options.hpp"

#include "base/error.hpp"
#include "base/parse.hpp"
#include "model/model_netcdf.hpp"
#include "scene/subdomains.hpp"

namespace slipwave {
namespace {

EdgeLaw edge_law(const std::string& name) {
  return name == "free"     ? EdgeLaw::free
         : name == "rigid"  ? EdgeLaw::rigid
         : name == "mirror" ? EdgeLaw::mirror
                            : EdgeLaw::absorbing;
}

template <int D>
Survey<D> make_survey(const SceneOptions& s) {
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

template <int D>
Scene<D> SceneOptions::without_model() const {
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
  scene.numerics.tiling.plain = executor == "plain";
  scene.numerics.time_order = std::stoi(time_order);
  for (const auto effect : effects_without()) scene.with_slip &= effect != ModelEffect::slip;
  return scene;
}

std::vector<ModelEffect> SceneOptions::effects_without() const {
  std::vector<ModelEffect> effects;
  if (without.empty()) return effects;
  for (const auto& name : split(without, ','))
    effects.push_back(in_place("--without", [&] { return model_effect_named(name); }));
  return effects;
}

template <int D>
void SceneOptions::check_model(Model<D>& read) const {
  in_place(model == "-" ? "standard input" : model, [&] { check(read, limits); });
  for (const auto effect : effects_without()) remove_effect(read, effect);
  // What is left must still hold together: planes without friction may slip under the prestress.
  if (!without.empty()) in_place("--without " + without, [&] { check(read, limits); });
}

AttenuationChoice SceneOptions::attenuation() const {
  AttenuationChoice choice;
  choice.mechanisms = q_mechanisms;
  choice.reference_hz = q_frequency_hz;
  if (!q_band.empty()) {
    const auto band = in_place("--q-band", [&] { return parse_numbers(q_band, ','); });
    if (band.size() != 2)
      throw Error("--q-band: found '" + q_band + "', expected F1,F2 in Hz", ErrorKind::usage);
    choice.band_hz = {band[0], band[1]};
  }
  return choice;
}

/// Checks the model and lets it attenuate.
template <int D>
std::vector<std::string> SceneOptions::prepare_model(Scene<D>& scene) const {
  check_model(scene.model);
  const auto choice = attenuation();
  try {
    return set_attenuation(scene, choice);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::usage) throw;
    throw error.within(model == "-" ? "standard input" : model);
  }
}

template <int D>
std::vector<std::string> SceneOptions::read_model_into(Scene<D>& scene, const NetcdfFile& file) const {
  scene.model = read_model<D>(file);
  auto warnings = prepare_model(scene);
  check(scene);
  return warnings;
}

template <int D>
std::vector<std::string> SceneOptions::read_part_into(Scene<D>& scene, const NetcdfFile& file, Ranks& all,
                                                      Ranks* group) const {
  std::vector<std::string> warnings;
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
    warnings = prepare_model(scene);
  });
  if (group) join(scene, *group);
  collective_try(&all, [&] { check(scene); });
  return warnings;
}

template Scene<2> SceneOptions::without_model() const;
template Scene<3> SceneOptions::without_model() const;
template std::vector<std::string> SceneOptions::read_part_into(Scene<2>&, const NetcdfFile&, Ranks&,
                                                               Ranks*) const;
template std::vector<std::string> SceneOptions::read_part_into(Scene<3>&, const NetcdfFile&, Ranks&,
                                                               Ranks*) const;
template std::vector<std::string> SceneOptions::read_model_into(Scene<2>&, const NetcdfFile&) const;
template std::vector<std::string> SceneOptions::read_model_into(Scene<3>&, const NetcdfFile&) const;

}  // namespace slipwave
