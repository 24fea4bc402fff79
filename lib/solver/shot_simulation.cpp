// SPDX-License-Identifier: BSD-3-Clause
#include "solver/shot_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/memory.hpp"
#include "grid/locate.hpp"
#include "model/model_zeros.hpp"
#include "rock/attenuation.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/largest_velocity.hpp"
#include "scene/surroundings.hpp"
#include "solver/effect/attenuation.hpp"
#include "solver/effect/linear_slip.hpp"

namespace slipwave::solver {
namespace {

/// The largest velocity that a source adds in a step, in terms of the unit.
constexpr double largest_addition = 1e-20;

/// The unit of the fields: a power of two times SI. In single precision all values below 10^-18 of the field
/// at the source then count as zero, so that the cells in front of the waves are zero and can be skipped
/// (ActiveCells). 1 where that gains nothing; at most 1 with fractures, whose strengths must stay normal
/// numbers. The same with slip and without, so that the difference of both is the work of slip alone.
/// `rate` is rate_added() of all ranks or bands.
template <int D>
double unit_of(const Scene<D>& scene, double dt_s, double rate) {
  if (scene.numerics.double_precision || !(rate > 0)) return 1;
  const double unit = std::exp2(std::round(std::log2(largest_addition / (dt_s * rate))));
  return scene.model.fracture_sets.empty() ? unit : std::min(unit, 1.);
}

/// The largest rate at which point sources in the cells of a scene change a velocity there, m/s2, with a
/// wavelet of 1; 0 where it has none.
template <int D>
double rate_added(const Scene<D>& scene, std::size_t shot) {
  const auto& medium = scene.model.medium;
  double largest = 0;
  for (const auto* source : scene.survey.sources_of(shot)) {
    if (!point_injection(*source)) return 0;
    if (!scene.subdomain.owns(medium.grid(), source->position_m)) continue;
    const auto injection = point_injection(*source);
    const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), source->position_m)));
    const double rho = medium.rho[cell], impedance = rho * medium.vp[cell];
    for (int i = 0; i < D; ++i) {
      largest = std::max(largest, std::abs(injection->force[std::size_t(i)]) / rho);
      for (int j = 0; j < D; ++j)
        largest = std::max(largest, std::abs(injection->moment_rate(i, j)) / impedance);
    }
  }
  return largest / std::pow(medium.grid().spacing_m, D);
}

/// The medium whose stress relaxes by steps; nothing where the scene does not attenuate.
template <int D>
std::optional<Medium<D>> attenuating_medium(const Scene<D>& scene, double dt_s) {
  if (!scene.attenuates()) return {};
  return relaxation_by_steps(scene, dt_s).medium();
}

/// The computed grid of a shot. Cells that interfaces cut and that slip are isotropic means.
template <int D>
Domain<D> domain_of(const Scene<D>& scene, const Medium<D>& medium, std::size_t shot, double dt_s) {
  auto domain =
      make_domain(medium, scene.edges, zone_cells(scene, scene.survey.sources[shot - 1]), scene.subdomain,
                  scene.numerics.order, largest_cfl(scene.numerics) * stable_time_step_s(scene) / dt_s);
  domain.steps = {&medium, dt_s, scene.numerics.time_order};
  const auto& model = scene.model;
  if (scene.with_slip) domain.split = split_faces(model), domain.soft = soft_cells(domain, model);
  for (auto& face : domain.split) face.behind = domain.computed_cell(face.behind);
  if (scene.slips())
    domain.drop_anisotropic_cells(
        [&](std::size_t cell) { return model.fracture[cell] != 0 && is_tilted_mean(model.medium, cell); });
  return domain;
}

}  // namespace

ShotReport of_all(const ShotReport& mine, Ranks* ranks) {
  if (!ranks) return mine;
  ShotReport all;
  const SlipTotals slip = mine.slip.value_or(SlipTotals{});
  const SlipTotals totals = {sum_of(ranks, slip.cells), sum_of(ranks, slip.slipped),
                             sum_of(ranks, slip.dissipated), sum_of(ranks, slip.out_of_waves)};
  if (largest_of(ranks, int(mine.slip.has_value()))) all.slip = totals;
  const double work = sum_of(ranks, mine.source_work.value_or(0));
  if (largest_of(ranks, int(mine.source_work.has_value()))) all.source_work = work;
  all.energy_left = sum_of(ranks, mine.energy_left);
  return all;
}

template <int D>
void SharedCheck<D>::operator()(const std::function<void()>& check, const StepTime& time, bool last) {
  if (!ranks_) return check();
  try {
    if (!seen_) check();
  } catch (const DivergedFields<D>& seen) {
    seen_.emplace(seen);
  }
  if ((time.step + 1) % exchanged_every != 0 && !last) return;
  constexpr auto never = std::numeric_limits<std::int64_t>::max();
  const auto steps = allgather(ranks_, std::vector{seen_ ? seen_->first().time.step : never});
  const auto first = std::min_element(steps.begin(), steps.end());
  if (*first == never) return;
  const auto texts = allgather_texts(*ranks_, seen_ ? seen_->what() : "");
  Divergence<D> divergence;
  divergence.time = {*first, time.dt_s};
  throw DivergedFields<D>(texts[std::size_t(first - steps.begin())], divergence);
}

template <int D>
InAllBands<D> in_all_bands(const Scene<D>& scene, const std::vector<Scene<D>>& bands, std::size_t shot) {
  double rate = 0, velocity = 0;
  for (const auto& band : bands) {
    rate = std::max(rate, rate_added(band, shot));
    velocity += largest_velocity(band, shot, nullptr);
  }
  InAllBands<D> all{unit_of(bands.front(), time_step_s(bands.front()), rate), velocity, {}};
  const auto& source = scene.survey.sources[shot - 1];
  if (std::holds_alternative<PlaneWave<D>>(source.mechanism))
    all.ground = ground_of_plane_wave(scene, source, bands);
  return all;
}

template <int D, class Real>
ShotSimulation<D, Real>::ShotSimulation(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& sink,
                                        Ranks* ranks, const InAllBands<D>* bands)
    : ranks_(ranks),
      scene_(&scene),
      shot_(shot),
      dt_s_(time_step_s(scene)),
      steps_(Recorder<D, Real>::steps_needed(scene.recording, dt_s_)),
      unit_(bands ? bands->unit : unit_of(scene, dt_s_, largest_of(ranks, rate_added(scene, shot)))),
      attenuating_(attenuating_medium(scene, dt_s_)),
      domain_(domain_of(scene, medium(), shot, dt_s_)),
      state_(make_filled_state<D, Real>(domain_, medium(), dt_s_)),
      sweeps_(state_, domain_, scene.numerics.order),
      effects_(make_effects(bands)),
      recorder_(state_.layout, domain_, scene, shot, unit_, ranks),
      sink_(sink),
      snapshots_(state_.layout, domain_, sink ? scene.snapshot_every_s : std::nullopt,
                 scene.recording.duration_s, unit_),
      step_(builder().time_step(sweeps_, effects_, records(), steps_)),
      halo_(make_halo()),
      executor_(builder().executor(sweeps_, step_, halo_.get())),
      stability_(state_, domain_, unit_,
                 bands ? bands->largest_velocity : largest_velocity(scene, shot, ranks)),
      check_(ranks) {
  // Everything that depends on them is built.
  domain_.release_impedances();
  attenuating_.reset();
  release_zeros(scene.model);
  release_freed_memory();
  bool changed = false;
  for (auto& effect : effects_) changed |= effect->initialize(state_);
  if (changed) executor_->fields_changed();
}

/// Faces that fractures split are there before what exchanges memory with other ranks asks how much there is.
template <int D, class Real>
Effects<D, Real> ShotSimulation<D, Real>::make_effects(const InAllBands<D>* bands) {
  sweeps_.split_faces(domain_, dt_s_, unit_);
  if (scene_->slips()) domain_.among_planes = stiffness_among_planes(domain_, scene_->model);
  return builder().effects(shot_, unit_, ranks_, bands && bands->ground ? &*bands->ground : nullptr);
}

template <int D, class Real>
std::vector<Record<D, Real>*> ShotSimulation<D, Real>::records() {
  std::vector<Record<D, Real>*> records = {&recorder_};
  if (sink_ && scene_->snapshot_every_s) records.push_back(&snapshots_);
  return records;
}

template <int D, class Real>
std::unique_ptr<Halo<D, Real>> ShotSimulation<D, Real>::make_halo() {
  if (!ranks_) return nullptr;
  return std::make_unique<Halo<D, Real>>(*ranks_, domain_, state_,
                                         [this](const IndexRange& rows, const auto& to) {
                                           for (auto& effect : effects_) effect->exchange(rows, to);
                                           if (auto* const faces = sweeps_.split()) faces->exchange(rows, to);
                                         });
}

template <int D, class Real>
void ShotSimulation<D, Real>::run_to(std::int64_t last, const Progress& progress,
                                     const std::function<bool()>& pause) {
  tell(&progress);
  for (bool paused = false; done_ < last && !paused; paused = pause && pause()) {
    const auto stretch = stretch_to(last);
    done_ = executor_->run(done_, stretch.until, pause);
    if (stretch.snapshot && done_ == stretch.until) take_snapshot();
    if (check_is_due()) check_together();
  }
  tell(nullptr);
}

template <int D, class Real>
auto ShotSimulation<D, Real>::stretch_to(std::int64_t last) -> Stretch {
  const auto until = std::min(last, StabilityCheck<D, Real>::next_after(done_) + 1);
  const bool snapshot = snapshots_.prepare(done_, until, dt_s_);
  return {snapshot ? snapshots_.step() + 1 : until, snapshot};
}

template <int D, class Real>
void ShotSimulation<D, Real>::serialize(Archive& archive) {
  archive.value(done_);
  if (done_ < 0 || done_ > steps_)
    throw Error("found step " + std::to_string(done_) + ", expected 0 to " + std::to_string(steps_));
  archive.fixed(state_.fields.data(), std::size_t(state_.fields.size()));
  executor_->serialize(archive);
  for (const auto& effect : effects_) effect->serialize(archive);
  if (auto* const faces = sweeps_.split()) faces->serialize(archive);
  recorder_.serialize(archive, done_);
}

template <int D, class Real>
void ShotSimulation<D, Real>::take_snapshot() {
  sink_(StepTime{snapshots_.step(), dt_s_}.end_s(),
        [&](const FieldKey& key) { return allgather_field(local_field(key)); });
  release_snapshot();
}

template <int D, class Real>
Field<D> ShotSimulation<D, Real>::local_field(const FieldKey& key) const {
  if (const auto* component = std::get_if<Component>(&key)) return snapshots_.field(*component);
  Field<D> field(domain_.model_grid);
  for (const auto& effect : effects_)
    if (effect->fill(std::get<SlipField>(key), field)) break;
  return field;
}

/// One process alone says later what lies round the place (simulation.cpp).
template <int D, class Real>
void ShotSimulation<D, Real>::check_together() {
  const auto check = [this] { ranks_ ? check_and_say_where() : check_stability(); };
  check_(check, {done_ - 1, dt_s_}, done_ == steps_);
}

template <int D, class Real>
void ShotSimulation<D, Real>::check_and_say_where() const {
  try {
    check_stability();
  } catch (const DivergedFields<D>& seen) {
    throw DivergedFields<D>(
        seen.what() + std::string("; ") + surroundings(*scene_, shot_, domain_.from_model(seen.first().at)),
        seen.first());
  }
}

/// The field of the whole model on the first rank, that of their own subdomain on the others.
template <int D, class Real>
Field<D> ShotSimulation<D, Real>::allgather_field(Field<D> mine) const {
  if (!ranks_) return mine;
  const auto a_row = mine.grid().size() / mine.grid().shape[D - 1];
  const auto& part = domain_.subdomain;
  const std::span<const float> own(mine.data() + (part.first - mine.grid().first[D - 1]) * a_row,
                                   std::size_t((part.last - part.first) * a_row));
  const auto all = gather_on_first(*ranks_, std::as_bytes(own));
  if (all.empty()) return mine;
  Field<D> whole(part.whole(mine.grid()));
  std::memcpy(whole.data(), all.data(), all.size());
  return whole;
}

template <int D, class Real>
ShotReport ShotSimulation<D, Real>::report() const {
  ShotReport report;
  for (const auto& effect : effects_) effect->report(report);
  if (const auto* const faces = sweeps_.split()) faces->report(report);
  report.energy_left += energy(state_, domain_, scene_->model.medium) / (unit_ * unit_);
  return of_all(report, ranks_);
}

template <int D, class Real>
double ShotSimulation<D, Real>::computed_share() const {
  double swept = 0;
  for (const auto& sweep : step_.sweeps()) swept += sweep.axis == D - 1;
  return double(executor_->swept_cells()) /
         (double(domain_.grid.size()) * swept * double(std::max<std::int64_t>(done_, 1)));
}

template <int D, class Real>
std::vector<PlannedEntry> ShotSimulation<D, Real>::planned() const {
  const auto all = double(domain_.grid.size());
  std::vector<PlannedEntry> entries;
  for (int axis = 0; axis < D; ++axis)
    entries.push_back({std::string("sweep along ") + axis_names<D>()[std::size_t(axis)] +
                           (sweeps_.shear() ? ", P and S" : ", P only"),
                       1});
  const auto add = [&](const std::vector<EffectShare>& shares) {
    for (const auto& share : shares) entries.push_back({share.name, double(share.cells) / all});
  };
  for (const auto& effect : effects_) add(effect->shares());
  if (const auto* const faces = sweeps_.split()) add(faces->shares());
  entries.push_back({"stability check", 1. / StabilityCheck<D, Real>::every});
  entries.push_back({"receivers", double(recorder_.cells()) / all});
  return entries;
}

template <int D, class Real>
std::int64_t ShotSimulation<D, Real>::memory_bytes() const {
  std::int64_t bytes = state_.memory_bytes() + sweeps_.memory_bytes() + executor_->memory_bytes() +
                       (halo_ ? halo_->memory_bytes() : 0);
  for (const auto& effect : effects_) bytes += effect->memory_bytes();
  return bytes;
}

/// Impedances, and the medium whose stress relaxes by steps: what of them does not fit where the fields will
/// be.
template <int D, class Real>
std::int64_t ShotSimulation<D, Real>::building_bytes() const {
  const auto& medium = scene_->model.medium;
  const std::int64_t of_medium =
      scene_->attenuates() ? medium.grid().size() * std::int64_t(medium.properties().size()) : 0;
  const auto building = (2 * domain_.grid.size() + of_medium) * std::int64_t(sizeof(float));
  return std::max<std::int64_t>(0, building - state_.fields.size() * std::int64_t(sizeof(Real)));
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, in_all_bands);
SLIPWAVE_INSTANTIATE_D(TYPE, class SharedCheck);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class ShotSimulation);

}  // namespace slipwave::solver
