#include "solver/shot_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "grid/locate.hpp"
#include "solver/effect/sponge.hpp"

namespace slipwave::solver {
namespace {

/// What a source adds to a velocity in a step, at the largest, is this much of the unit.
constexpr double largest_addition = 1e-20;

/// What fields are kept in: a power of two times SI. In single precision all that is 10^-18 of what the
/// source does where it stands then counts as zero, so that the cells in front of the waves are zero and can
/// be left out (ActiveCells). 1 where that gains nothing; at most 1 with fractures, whose strengths are to
/// stay numbers that can be counted with. The same with slip and without, so that the difference of both is
/// the work of slip alone. Collective where there are ranks.
template <int D>
double unit_of(const Scene<D>& scene, const Source<D>& source, double dt_s, Ranks* ranks) {
  const auto injection = point_injection(source);
  if (!injection || scene.numerics.double_precision) return 1;
  const auto& medium = scene.model.medium;
  const double volume = std::pow(medium.grid().spacing_m, D);
  double largest = 0;
  if (scene.subdomain.owns(medium.grid(), source.position_m)) {
    const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), source.position_m)));
    const double rho = medium.rho[cell], impedance = rho * medium.vp[cell];
    for (int i = 0; i < D; ++i) {
      largest = std::max(largest, std::abs(injection->force[std::size_t(i)]) / rho);
      for (int j = 0; j < D; ++j)
        largest = std::max(largest, std::abs(injection->moment_rate(i, j)) / impedance);
    }
  }
  largest = largest_of(ranks, largest);
  if (!(largest > 0)) return 1;
  const double unit = std::exp2(std::round(std::log2(largest_addition * volume / (dt_s * largest))));
  return scene.model.fracture_sets.empty() ? unit : std::min(unit, 1.);
}

template <int D>
bool any_zone(const Scene<D>& scene, const Source<D>& source) {
  bool any = false;
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) any |= scene.edges[axis][side] == EdgeLaw::absorbing;
  return any && zone_cells(scene, source) > 0;
}

}  // namespace

template <int D, class Real>
ShotSimulation<D, Real>::ShotSimulation(const Scene<D>& scene, std::size_t shot,
                                        const SnapshotSink<D>& snapshots, Ranks* ranks)
    : ranks_(ranks),
      dt_s_(time_step_s(scene)),
      time_order_(scene.numerics.time_order),
      scene_(&scene),
      shot_(shot),
      unit_(unit_of(scene, scene.survey.sources[shot - 1], dt_s_, ranks)),
      domain_(make_domain(scene.model.medium, scene.edges, zone_cells(scene, scene.survey.sources[shot - 1]),
                          scene.subdomain)),
      state_(make_filled_state<D, Real>(domain_, scene.model.medium, dt_s_)),
      sweeps_(state_, domain_, scene.numerics.order),
      pipeline_(sweeps_, state_, scene.numerics.time_order, dt_s_, *this, scene.numerics.tiling,
                domain_.rows_beside()),
      whole_(std::size_t(Effect::most_steps_in_progress)),
      monitor_(state_, domain_, unit_, largest_velocity(scene, shot, ranks)),
      snapshot_every_s_(snapshots ? scene.snapshot_every_s : std::nullopt),
      keeps_diary_(scene.slip_diary),
      duration_s_(scene.recording.duration_s),
      snapshots_(snapshots),
      steps_(Recorder<D, Real>::steps_needed(scene.recording, dt_s_)) {
  build_step(scene, shot);
  if (background_) {
    background_->begin(state_);
    pipeline_.find_active_cells();
  }
  if (ranks_) use_halo();
}

/// What happens at the end of a step, after the sweeps. Source and slip work partly before and partly after
/// what is recorded, so that the step is symmetric about it.
template <int D, class Real>
void ShotSimulation<D, Real>::build_step(const Scene<D>& scene, std::size_t shot) {
  const auto& source = scene.survey.sources[shot - 1];
  const auto add = [this](std::unique_ptr<Effect> pass) {
    works_beside_ |= pass->acts_between_steps();
    passes_.push_back(std::move(pass));
  };
  const double vp_max = std::max(fastest_wave(scene.model.medium), scene.subdomain.fastest);
  const bool zones = any_zone(scene, source);
  // Plane waves are known in 2-D only; check(scene) has seen to it.
  if constexpr (D == 2) {
    if (std::holds_alternative<PlaneWave<D>>(source.mechanism))
      background_ = make_plane_wave<Real>(scene, source, domain_, dt_s_);
    if (background_ && zones)
      add(std::make_unique<Sponge<D, Real>>(state_, domain_, dt_s_, vp_max, background_.get()));
  }
  if (!background_ && zones) {
    layer_ = std::make_unique<Pml<D, Real>>(state_.layout, domain_, dt_s_, vp_max,
                                            source.wavelet.nominal_hz(), scene.numerics.time_order, ranks_);
    sweeps_.use(layer_.get());
  }
  if (point_injection(source)) {
    auto pass = std::make_unique<PointSource<D, Real>>(state_, domain_, scene, source, unit_, ranks_);
    if (!pass->lines().empty()) {
      source_ = pass.get();
      add(std::move(pass));
    }
  }
  if (scene.slips()) {
    auto slip = std::make_unique<Slip<D, Real>>(state_, domain_, scene, dt_s_, unit_);
    slip_ = slip.get();
    add(std::move(slip));
  }
  recorder_ = std::make_unique<Recorder<D, Real>>(state_.layout, domain_, scene, shot, unit_, ranks_);
  patches_ = Patches<D>(state_.layout, domain_, scene.model);
  pipeline_.use(&patches_);
  // All that was built from them is there.
  domain_.impedance = {};
}

template <int D, class Real>
bool ShotSimulation<D, Real>::snapshot_due(const StepTime& time) const {
  if (!snapshot_every_s_ || time.end_s() > duration_s_ + time.dt_s) return false;
  // A hair of tolerance keeps a step that ends on a multiple from being taken for one before it.
  const auto multiple = [&](double t) { return std::floor(t / *snapshot_every_s_ + 1e-9); };
  return multiple(time.end_s()) > multiple(time.end_s() - time.dt_s);
}

template <int D, class Real>
void ShotSimulation<D, Real>::run_to(std::int64_t last, const Progress& progress,
                                     const std::function<bool()>& pause) {
  progress_ = &progress;
  for (bool paused = false; done_ < last && !paused; paused = pause && pause()) {
    // Nothing is under way where all fields are looked at.
    std::int64_t until = std::min(last, StabilityCheck<D, Real>::next_after(done_) + 1);
    for (snapshot_step_ = done_; snapshot_step_ < until; ++snapshot_step_)
      if (snapshot_due({snapshot_step_, dt_s_})) break;
    const bool snapshot = snapshot_step_ < until;
    if (snapshot) {
      until = snapshot_step_ + 1;
      snapshot_ = Buffer<Real>(state_.fields.size());
    }
    done_ = pipeline_.run(done_, until, pause);
    const StepTime time{done_ - 1, dt_s_};
    if (snapshot && done_ == until) take_snapshot(time);
    if (done_ % StabilityCheck<D, Real>::every == 0 || done_ == steps_) check_together();
  }
}

template <int D, class Real>
void ShotSimulation<D, Real>::serialize(Archive& archive) {
  archive.value(done_);
  if (done_ < 0 || done_ > steps_)
    throw Error("found step " + std::to_string(done_) + ", expected 0 to " + std::to_string(steps_));
  archive.fixed(state_.fields.data(), std::size_t(state_.fields.size()));
  pipeline_.serialize(archive);
  if (layer_) layer_->serialize(archive);
  for (const auto& pass : passes_) pass->serialize(archive);
  recorder_->serialize(archive);
}

template <int D, class Real>
void ShotSimulation<D, Real>::take_snapshot(const StepTime& time) {
  const WholeLine<Real> line = [this](std::int64_t n) {
    return snapshot_.data() + state_.layout.line(state_.layout.line_index(n));
  };
  snapshots_(time.end_s(), [&](const FieldKey& key) {
    if (const auto* slip = std::get_if<SlipField>(&key))
      return joined_field(slip_ ? slip_->field(*slip) : Field<D>(domain_.model_grid));
    return joined_field(field_of(state_.layout, domain_, line, std::get<Component>(key), unit_));
  });
  snapshot_ = {};
}

template <int D, class Real>
void ShotSimulation<D, Real>::begin(const StepTime& time) {
  auto& whole = whole_[std::size_t(time.step % Effect::most_steps_in_progress)];
  whole.assign(std::size_t(state_.layout.lines()), 0);
  for (const auto line : patches_.whole_lines()) whole[std::size_t(line)] = 1;
  for (const auto& pass : passes_) {
    pass->begin(time);
    if (!pass->active(time)) continue;
    for (const auto line : pass->lines()) whole[std::size_t(line)] = 1;
  }
}

template <int D, class Real>
bool ShotSimulation<D, Real>::injects(const StepTime& time, std::int64_t line) const {
  return std::any_of(passes_.begin(), passes_.end(),
                     [&](const auto& pass) { return pass->injects(time, line); });
}

/// What reaches a receiver before the end, or is part of a snapshot.
template <int D, class Real>
Box ShotSimulation<D, Real>::needed(const StepTime& time, const Box& growth) const {
  const Box all{{0, domain_.grid.shape[D - 1]}, {0, domain_.grid.shape[D - 2]}};
  if (snapshot_every_s_ || keeps_diary_) return all;
  // The sweep along x that the first step begins with is one more.
  const auto steps = steps_ - time.step + 1;
  const auto spread = [steps](const IndexRange& read, const IndexRange& by) {
    return IndexRange{read.first - steps * by.first, read.last + steps * by.last};
  };
  const Box& read = recorder_->box();
  return {spread(read.rows, growth.rows), spread(read.columns, growth.columns)};
}

template <int D, class Real>
double ShotSimulation<D, Real>::computed_share() const {
  double swept = 0;
  for (const auto& sweep : splitting(D, time_order_)) swept += sweep.axis == D - 1;
  return double(pipeline_.swept_cells()) /
         (double(domain_.grid.size()) * swept * double(std::max<std::int64_t>(done_, 1)));
}

template <int D, class Real>
void ShotSimulation<D, Real>::look(const StepTime& time, std::int64_t line, const IndexRange& columns,
                                   const Real* fields, std::int64_t pitch) {
  recorder_->sample(time, line, columns, fields, pitch);
  if (time.step != snapshot_step_) return;
  Real* const to = snapshot_.data() + state_.layout.line(state_.layout.line_index(line));
  for (int row = 0; row < FieldRows<D>::count; ++row)
    std::copy(fields + row * pitch + columns.first, fields + row * pitch + columns.last,
              to + row * state_.layout.row_pitch() + columns.first);
}

template <int D, class Real>
void ShotSimulation<D, Real>::run(const StepTime& time, std::int64_t line, const IndexRange& columns) {
  const bool all = whole(time, line);
  for (const auto& pass : passes_)
    if (all || pass->acts_between_steps()) pass->run(time, line, columns);
}

template <int D, class Real>
void ShotSimulation<D, Real>::run_after_record(const StepTime& time, std::int64_t line,
                                               const IndexRange& columns) {
  // The other way round: what came last before looking comes first after it.
  const bool all = whole(time, line);
  for (auto pass = passes_.rbegin(); pass != passes_.rend(); ++pass)
    if (all || (*pass)->acts_between_steps()) (*pass)->run_after_record(time, line, columns);
}

template <int D, class Real>
void ShotSimulation<D, Real>::run_patch(const StepTime&, std::int64_t line, const IndexRange& columns,
                                        Real* fields, std::int64_t pitch) {
  if (slip_) slip_->run_in(fields, pitch, line, columns);
}

template <int D, class Real>
void ShotSimulation<D, Real>::run_patch_after(const StepTime&, std::int64_t line, const IndexRange& columns,
                                              Real* fields, std::int64_t pitch) {
  if (slip_) slip_->run_after_in(fields, pitch, line, columns);
}

template <int D, class Real>
void ShotSimulation<D, Real>::finish(const StepTime& time) {
  recorder_->finish(time);
  if (*progress_) (*progress_)(time.step + 1, steps_);
}

template <int D, class Real>
std::vector<PlannedEntry> ShotSimulation<D, Real>::planned() const {
  const auto all = double(domain_.grid.size());
  std::vector<PlannedEntry> passes;
  for (int axis = 0; axis < D; ++axis)
    passes.push_back({std::string("sweep along ") + axis_names<D>()[std::size_t(axis)] +
                          (sweeps_.shear() ? ", P and S" : ", P only"),
                      1});
  if (layer_)
    passes.push_back({"matched layer", double(domain_.grid.size() - domain_.model_grid.size()) / all});
  for (const auto& pass : passes_)
    for (const auto& effect : pass->effects()) passes.push_back({effect.name, double(effect.cells) / all});
  passes.push_back({"stability watch", 1. / StabilityCheck<D, Real>::every});
  passes.push_back({"receivers", double(recorder_->cells()) / all});
  return passes;
}

template <int D, class Real>
std::int64_t ShotSimulation<D, Real>::memory_bytes() const {
  return (state_.fields.size() + state_.material.size()) * std::int64_t(sizeof(Real)) +
         std::int64_t(state_.stretches.size() * sizeof(Stretch<Real>)) + pipeline_.memory_bytes() +
         (layer_ ? layer_->memory_bytes() : 0) + (halo_ ? halo_->memory_bytes() : 0);
}

template class ShotSimulation<2, float>;
template class ShotSimulation<2, double>;
template class ShotSimulation<3, float>;
template class ShotSimulation<3, double>;

}  // namespace slipwave::solver
