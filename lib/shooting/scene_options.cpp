// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/scene_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "acquisition/interpolation.hpp"
#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "io/netcdf_file.hpp"
#include "model/model_netcdf.hpp"
#include "scene/bands.hpp"
#include "scene/model_ground.hpp"
#include "scene/subdomains.hpp"
#include "shooting/trace_wavelet.hpp"

namespace slipwave {
namespace {

EdgeLaw edge_law(const std::string& name) {
  return name == "free"     ? EdgeLaw::free
         : name == "rigid"  ? EdgeLaw::rigid
         : name == "mirror" ? EdgeLaw::mirror
                            : EdgeLaw::absorbing;
}

/// Reads each text once: many sources share theirs.
template <class Value>
class Once {
 public:
  template <class Parse>
  const Value& get(const std::string& text, const std::string& place, const Parse& parse) {
    const auto at = known_.find(text);
    if (at != known_.end()) return at->second;
    try {
      return known_.emplace(text, parse(text)).first->second;
    } catch (const Error& error) {
      // What stands in a file is data.
      throw Error(place + ": " + error.what(), place.starts_with("--") ? error.kind() : ErrorKind::data);
    }
  }

 private:
  std::map<std::string, Value> known_;
};

/// Lets delays count from the first source that fires before the record begins, to a whole number of samples;
/// returns by how much before.
template <int D>
double begin_early(Survey<D>& survey, double interval_s) {
  double earliest_s = 0;
  const auto each = [&](const auto& take) {
    for (auto& source : survey.sources) take(source);
    for (auto& others : survey.blended)
      for (auto& source : others) take(source);
  };
  each([&](const Source<D>& source) { earliest_s = std::min(earliest_s, source.delay_s); });
  if (!(earliest_s < 0 && interval_s > 0)) return 0;
  const double before_s = std::ceil(-earliest_s / interval_s - 1e-9) * interval_s;
  each([&](Source<D>& source) { source.delay_s = std::max(0., source.delay_s + before_s); });
  return before_s;
}

/// What is said of all sources has an effect where one of them lacks it.
void refuse_idle(bool idle, const std::string& option) {
  if (idle)
    throw Error("found " + option + " and a column of its own for every source, expected one of them",
                ErrorKind::usage);
}

/// Sources without their positions, which the model's ground may decide.
template <int D>
Survey<D> make_survey(const SceneOptions& s) {
  Survey<D> survey;
  if (!s.survey.inject.empty() && (!s.wavelet.empty() || s.kind != SceneOptions().kind))
    throw Error("found --inject and " + std::string(s.wavelet.empty() ? "--kind" : "--wavelet") +
                    ", expected one of them: traces are wavelets, their components say the kind",
                ErrorKind::usage);
  auto given = s.survey.read(D);
  Once<Wavelet> wavelets;
  Once<Mechanism<D>> kinds;
  const bool any_wavelet = std::any_of(given.shots.begin(), given.shots.end(), [](const GivenShot& shot) {
    return std::any_of(shot.sources.begin(), shot.sources.end(),
                       [](const GivenSource& source) { return !source.wavelet.empty(); });
  });
  bool default_wavelet = false, default_kind = false,
       default_amplitude = false;  // whether a source needs them
  const auto source_of = [&](const GivenSource& source) {
    const bool own_wavelet = !source.wavelet.empty(), own_kind = !source.kind.empty();
    default_wavelet = default_wavelet || !own_wavelet;
    default_kind = default_kind || !own_kind;
    default_amplitude = default_amplitude || !source.amplitude;
    const auto& kind =
        kinds.get(own_kind ? source.kind : s.kind, own_kind ? source.from : "--kind", parse_mechanism<D>);
    const double amplitude = source.amplitude.value_or(s.amplitude) * source.factor;
    if (source.recorded) return Source<D>{{}, kind, *source.recorded, amplitude, source.delay_s};
    if (!own_wavelet && s.wavelet.empty())
      throw Error(any_wavelet ? source.from + ": found no wavelet, expected one there or --wavelet W"
                              : "--wavelet is missing; expected --wavelet W",
                  ErrorKind::usage);
    const auto& wavelet = wavelets.get(own_wavelet ? source.wavelet : s.wavelet,
                                       own_wavelet ? source.from : "--wavelet", wavelet_named);
    return Source<D>{{}, kind, wavelet, amplitude, source.delay_s};
  };
  bool any_blended = false;
  for (const auto& shot : given.shots) {
    survey.sources.push_back(source_of(shot.sources.front()));
    any_blended = any_blended || shot.sources.size() > 1;
  }
  if (any_blended) survey.blended.resize(survey.sources.size());
  for (std::size_t shot = 0; any_blended && shot < survey.sources.size(); ++shot)
    for (std::size_t n = 1; n < given.shots[shot].sources.size(); ++n)
      survey.blended[shot].push_back(source_of(given.shots[shot].sources[n]));
  for (auto& shot : given.shots)
    for (auto& source : shot.sources) source.recorded.reset();  // the sources have it now
  const SceneOptions unset;
  refuse_idle(s.wavelet != unset.wavelet && !default_wavelet, "--wavelet");
  refuse_idle(s.kind != unset.kind && !default_kind, "--kind");
  refuse_idle(s.amplitude != unset.amplitude && !default_amplitude, "--amplitude");
  if (!given.in_files) survey.misplaced = ErrorKind::usage;
  survey.spreads.emplace(std::move(given));
  return survey;
}

template <int D>
void add_component(const std::string& name, Recording& recording) {
  const bool fibre = name == "das" || name.starts_with("das:");
  if (fibre && recording.fibre)
    throw Error(
        "found das more than once, expected one fibre: exx, ezz and exz give the strain rate along any",
        ErrorKind::usage);
  if (fibre) recording.fibre = parse_fibre<D>(name);
  recording.components.push_back(fibre ? Component::das : component_named(name, D));
}

/// The ground of a model file, read row by row only as deep as it goes.
template <int D>
Ground<D> read_ground(const NetcdfFile& file, const Grid<D>& grid, bool needed) {
  Ground<D> ground(grid);
  constexpr std::int64_t rows_at_once = 32;
  const std::int64_t rows = grid.shape[D - 1];
  for (std::int64_t first = 0; needed && first < rows; first += rows_at_once)
    if (see(ground, read_model_rows<D>(file, first, std::min(first + rows_at_once, rows)).medium)) break;
  return ground;
}

/// Places the survey by the ground of the model that is there.
template <int D>
void place_on_model(Scene<D>& scene) {
  Ground<D> ground(scene.model.grid());
  if (needs_ground(scene.survey)) see(ground, scene.model.medium);
  place(scene.survey, std::move(ground));
}

}  // namespace

template <int D>
Scene<D> SceneOptions::without_model() const {
  Scene<D> scene;
  scene.survey = make_survey<D>(*this);
  for (const auto& name : split(record, ','))
    in_place("--record", [&] { add_component<D>(name, scene.recording); });
  scene.recording.interval_s = interval_s;
  scene.recording.before_s = begin_early(scene.survey, interval_s);
  scene.recording.duration_s = duration_s + scene.recording.before_s;
  for (int axis = 0; axis < D - 1; ++axis) scene.edges[axis] = {edge_law(sides), edge_law(sides)};
  scene.edges[D - 1] = {edge_law(top), edge_law(bottom)};
  scene.numerics.order = std::stoi(order);
  scene.numerics.cfl = cfl;
  scene.numerics.time_step_s = time_step_s;
  scene.numerics.zone_cells = edge_width;
  scene.numerics.correction = correction == "first"     ? SlipCorrection::first
                              : correction == "second"  ? SlipCorrection::second
                              : correction == "centred" ? SlipCorrection::centred
                                                        : SlipCorrection::exponential;
  scene.numerics.double_precision = precision == "double";
  scene.numerics.tiling.plain = executor == "plain";
  scene.numerics.time_order = std::stoi(time_order);
  scene.numerics.monotone = monotone;
  scene.numerics.bands = parse_bands(bands);
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
std::vector<std::string> SceneOptions::check_model(Model<D>& read, double resolution) const {
  in_place(model == "-" ? "standard input" : model, [&] { check(read, limits); });
  // Cells that lose their planes by --without are swept as with them: the response is a difference of the
  // two.
  auto inert = leave_out_inert(read, resolution);
  for (const auto effect : effects_without()) remove_effect(read, effect);
  // What is left must still hold together: planes without friction may slip under the prestress.
  if (!without.empty()) in_place("--without " + without, [&] { check(read, limits); });
  return inert;
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

/// Adds warnings of wavelets that a record cuts off, each once.
template <int D>
void add_wavelet_warnings(std::vector<std::string>& warnings, const Scene<D>& scene) {
  const double before_s = scene.recording.before_s;
  const auto see = [&](const Source<D>& source) {
    const auto warning =
        beyond_record(source.wavelet, source.delay_s - before_s, scene.recording.duration_s - before_s);
    if (!warning.empty() && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  };
  for (const auto& source : scene.survey.sources) see(source);
  for (const auto& blended : scene.survey.blended)
    for (const auto& source : blended) see(source);
}

/// Checks the model and lets it attenuate.
template <int D>
std::vector<std::string> SceneOptions::prepare_model(Scene<D>& scene) const {
  const auto in_double = std::numeric_limits<double>::epsilon(),
             in_single = double(std::numeric_limits<float>::epsilon());
  const auto inert = check_model(scene.model, scene.numerics.double_precision ? in_double : in_single);
  const auto choice = attenuation();
  try {
    auto warnings = set_attenuation(scene, choice);
    add_wavelet_warnings(warnings, scene);
    for (const auto& name : inert)
      warnings.push_back("the planes of " + name +
                         " have no effect: no wave moves them by what numbers resolve");
    return warnings;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::usage) throw;
    throw error.within(model == "-" ? "standard input" : model);
  }
}

/// Returns sentences on options that change nothing in this scene.
template <int D>
std::vector<std::string> SceneOptions::idle(const Scene<D>& scene) const {
  std::vector<std::string> sentences;
  const auto effects = effects_without();
  const bool elastic = std::count(effects.begin(), effects.end(), ModelEffect::attenuation) > 0;
  const SceneOptions usual;
  for (const auto& [given, option] :
       {std::pair(q_frequency_hz.has_value(), "--q-frequency"), std::pair(!q_band.empty(), "--q-band"),
        std::pair(q_mechanisms != usual.q_mechanisms, "--q-mechanisms")})
    if (given && !scene.attenuation)
      sentences.push_back(
          std::string(option) + " has no effect" +
          (elastic ? " beside --without attenuation" : ": no cell of the model has a finite qp or qs"));
  for (const auto& [given, option] :
       {std::pair(interval_s != usual.interval_s, "--dt"), std::pair(record != usual.record, "--record")})
    if (given && !scene.survey.any_receiver())
      sentences.push_back(std::string(option) + " has no effect: there are no receivers");
  if (correction != usual.correction && !scene.slips())
    sentences.push_back("--correction has no effect: nothing in the scene slips");
  if (edge_width != 0 && top != "absorbing" && sides != "absorbing" && bottom != "absorbing" &&
      ground != "absorbing")
    sentences.push_back("--edge-width has no effect: no boundary is absorbing");
  return sentences;
}

/// The edges of the model are about its box. Where rows begin at the ground, void above is left out, and it
/// is no edge.
template <int D>
void SceneOptions::set_ground(Scene<D>& scene, const Grid<D>& grid) const {
  const auto begins_at_ground = [&] {
    if (!grid.rows) return false;
    const auto& horizons = grid.rows->horizons();
    const auto top = grid.rows->row(0);
    return std::any_of(horizons.begin(), horizons.end(),
                       [](const auto& horizon) { return horizon.row == 0 && horizon.role == "surface"; }) &&
           std::any_of(top.begin(), top.end(),
                       [&](double depth_m) { return depth_m > on_face * grid.spacing_m; });
  };
  if (begins_at_ground())
    scene.edges[D - 1][0] = edge_law(ground);
  else if (ground != "free")
    throw Error("--ground: found '" + ground +
                    "' in a model whose rows do not begin at a ground below void, expected free; build the "
                    "model with --fit surface",
                ErrorKind::usage);
}

template <int D>
std::vector<std::string> SceneOptions::read_model_into(Scene<D>& scene, const NetcdfFile& file) const {
  scene.model = read_model<D>(file);
  set_ground(scene, scene.model.grid());
  std::vector<std::string> warnings;
  for (const auto effect : effects_without())
    if (!has_effect(scene.model, effect))
      warnings.push_back("--without " + name_of(effect) + " has no effect: the model has none");
  for (const auto& more : {prepare_model(scene), idle(scene)})
    warnings.insert(warnings.end(), more.begin(), more.end());
  place_on_model(scene);
  note_speeds(scene);
  check(scene);
  return warnings;
}

template <int D>
void SceneOptions::place_again(Scene<D>& scene) const {
  auto survey = make_survey<D>(*this);
  if (!needs_ground(survey)) return;
  begin_early(survey, interval_s);
  scene.survey = std::move(survey);
  place_on_model(scene);
}

template <int D>
std::vector<std::string> SceneOptions::read_part_into(Scene<D>& scene, const NetcdfFile& file, Ranks& all,
                                                      Ranks* group) const {
  std::vector<std::string> warnings;
  const auto read_rows = [&](const Grid<D>& grid) {
    scene.subdomain = subdomain_for(scene, grid, group->number(), group->count());
    const auto [first, last] = rows_held(scene.subdomain);
    scene.model = read_model_rows<D>(file, first, last);
  };
  collective_try(&all, [&] {
    if (group) {
      const auto grid = read_model_grid<D>(file);
      set_ground(scene, grid);
      place(scene.survey, read_ground(file, grid, needs_ground(scene.survey)));
      check(scene.survey, grid);
      // Fractures on faces widen what ranks exchange.
      if (file.has_variable("fracture")) scene.model.fracture_sets = read_fracture_sets<D>(file);
      read_rows(grid);
    } else {
      scene.model = read_model<D>(file);
      set_ground(scene, scene.model.grid());
    }
  });
  // Void or a wall of water anywhere widens it, too.
  const bool anywhere = group && largest_of(group, corrects_inside(scene.model.medium) ? 1 : 0) > 0;
  collective_try(&all, [&] {
    if (anywhere) {
      scene.subdomain.corrects_inside = true;
      read_rows(read_model_grid<D>(file));
    }
    warnings = prepare_model(scene);
    if (!group) place_on_model(scene);
  });
  if (group)
    join(scene, *group);
  else
    note_speeds(scene);
  collective_try(&all, [&] { check(scene); });
  return warnings;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, SceneOptions::without_model);
SLIPWAVE_INSTANTIATE_D(FUNCTION, SceneOptions::place_again);
SLIPWAVE_INSTANTIATE_D(FUNCTION, SceneOptions::read_part_into);
SLIPWAVE_INSTANTIATE_D(FUNCTION, SceneOptions::read_model_into);

}  // namespace slipwave
