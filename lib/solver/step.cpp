#include "solver/step.hpp"

#include <cmath>
#include <numeric>

#include "solver/absorbing.hpp"
#include "solver/monitor.hpp"
#include "solver/slip_pass.hpp"
#include "solver/source_pass.hpp"

namespace slipwave::solver {

template <int D, class Real>
Step<D, Real>::Step(const Scene<D>& scene, std::size_t shot, const SnapshotSink<D>& snapshots)
    : dt_s_(time_step_s(scene)),
      splitting_(splitting(D, scene.numerics.time_order)),
      domain_(
          make_domain(scene.model.medium, scene.edges, zone_cells(scene, scene.survey.sources[shot - 1]))),
      state_(make_state<D, Real>(domain_.grid.shape)),
      sweeps_(state_, domain_, scene.numerics.order),
      ahead_(std::size_t(state_.layout.lines())),
      snapshot_every_s_(snapshots ? scene.snapshot_every_s : std::nullopt),
      duration_s_(scene.recording.duration_s),
      snapshots_(snapshots),
      steps_(Recorder<D, Real>::steps_needed(scene.recording, dt_s_)) {
  all_lines_.resize(ahead_.size());
  std::iota(all_lines_.begin(), all_lines_.end(), 0);
  fill_material(state_, domain_, scene.model.medium, dt_s_);
  build_step(scene, shot);
  if (background_) background_->begin(state_);
}

/// What happens at the end of a step, after the sweeps. Source and slip work partly before and partly after
/// what is recorded, so that the step is symmetric about it.
template <int D, class Real>
void Step<D, Real>::build_step(const Scene<D>& scene, std::size_t shot) {
  const auto& source = scene.survey.sources[shot - 1];
  if constexpr (D == 2)
    if (std::holds_alternative<PlaneWave<D>>(source.mechanism))
      background_ = make_plane_wave<Real>(scene, source, domain_, dt_s_);
  const auto add = [this](std::unique_ptr<Pass> pass) { passes_.push_back(std::move(pass)); };
  const double vp_max = fastest_wave(scene.model.medium);
  if (domain_.grid.size() > domain_.model_grid.size()) {
    if (background_) {
      add(std::make_unique<AbsorbingZones<D, Real>>(state_, domain_, dt_s_, vp_max, background_.get()));
    } else {
      layer_ = std::make_unique<MatchedLayer<D, Real>>(
          state_.layout, domain_, dt_s_, vp_max, source.wavelet.nominal_hz(), scene.numerics.time_order);
      sweeps_.use(layer_.get());
    }
  }
  if (point_injection(source)) {
    add(make_source_pass(state_, domain_, scene, source));
  }
  if (scene.slips()) add(make_slip_pass(state_, domain_, scene, dt_s_));
  add(std::make_unique<Monitor<D, Real>>(state_, domain_));
  recorder_ = std::make_unique<Recorder<D, Real>>(state_.layout, domain_, scene, shot);
  // The same sweeps with and without slip: their difference must be the work of slip alone.
  fracture_lines_ = fracture_lines(state_.layout, domain_, scene.model);
}

template <int D, class Real>
void Step<D, Real>::find_whole_lines(const StepTime& time) {
  std::vector<char> acting;
  for (const auto& pass : passes_) acting.push_back(pass->acts(time));
  if (acting == acting_) return;
  acting_ = acting;
  whole_.assign(std::size_t(state_.layout.lines()), 0);
  for (const auto line : fracture_lines_) whole_[std::size_t(line)] = 1;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    if (acting[n])
      for (const auto line : passes_[n]->lines()) whole_[std::size_t(line)] = 1;
}

template <int D, class Real>
bool Step<D, Real>::snapshot_due(const StepTime& time) const {
  if (!snapshot_every_s_ || time.end_s() > duration_s_ + time.dt_s) return false;
  // A hair of tolerance keeps a step that ends on a multiple from being taken for one before it.
  const auto multiple = [&](double t) { return std::floor(t / *snapshot_every_s_ + 1e-9); };
  return multiple(time.end_s()) > multiple(time.end_s() - time.dt_s);
}

template <int D, class Real>
void Step<D, Real>::read_ahead(std::span<const std::int64_t> lines) {
  reading_.clear();
  for (const auto line : lines) {
    if (whole_[std::size_t(line)]) continue;
    reading_.push_back(line);
    auto& copy = ahead_[std::size_t(line)];
    if (copy.size() == 0)
      copy = Buffer<Real>(FieldRows<D>::count * state_.layout.row_pitch() + Layout<D>::lead);
  }
  sweeps_.ahead_along_x(reading_, Real(splitting_.front().part), [this](std::int64_t line) {
    return ahead_[std::size_t(line)].data() + Layout<D>::lead;
  });
}

template <int D, class Real>
void Step<D, Real>::run(std::int64_t step) {
  const StepTime time{step, dt_s_};
  // The last sweep of a step and the first of the next are alike.
  const Real end = Real(splitting_.front().part);
  if (step == 0) sweeps_.along_x([end](std::int64_t) { return end; });
  for (std::size_t n = 1; n + 1 < splitting_.size(); ++n)
    sweeps_.along(splitting_[n].axis, Real(splitting_[n].part));

  find_whole_lines(time);
  const bool snapshot = snapshot_due(time);
  read_ahead(snapshot ? std::span<const std::int64_t>(all_lines_) : recorder_->lines());
  // Where nothing acts on the line now, this sweep and the first of the next step are one.
  sweeps_.along_x([&](std::int64_t line) { return whole_[std::size_t(line)] ? end : 2 * end; });
  for (const auto& pass : passes_) pass->run(time);

  const WholeLine<Real> whole_line = [this](std::int64_t line) -> const Real* {
    if (!whole_[std::size_t(line)]) return ahead_[std::size_t(line)].data() + Layout<D>::lead;
    return state_.field_row(state_.layout.line_index(line), 0);
  };
  recorder_->run(time, whole_line);
  if (snapshot) {
    snapshots_(time.end_s(),
               [&](Component component) { return field_of(state_.layout, domain_, whole_line, component); });
    // Only the recorder's copies are needed again soon.
    for (auto& copy : ahead_) copy = {};
  }
  for (const auto& pass : passes_) pass->run_after(time);
  sweeps_.along_x([&](std::int64_t line) { return whole_[std::size_t(line)] ? end : Real(0); });
}

template <int D, class Real>
std::vector<PlannedPass> Step<D, Real>::planned() const {
  const auto all = double(domain_.grid.size());
  std::vector<PlannedPass> passes;
  for (int axis = 0; axis < D; ++axis)
    passes.push_back({std::string("sweep along ") + axis_names<D>()[std::size_t(axis)] +
                          (domain_.shear() ? ", P and S" : ", P only"),
                      1});
  if (layer_)
    passes.push_back({"matched layer", double(domain_.grid.size() - domain_.model_grid.size()) / all});
  for (const auto& pass : passes_) passes.push_back({pass->name(), double(pass->cells()) / all});
  passes.push_back({"receivers", double(recorder_->cells()) / all});
  return passes;
}

template <int D, class Real>
std::int64_t Step<D, Real>::memory_bytes() const {
  return (state_.fields.size() + state_.material.size()) * std::int64_t(sizeof(Real)) +
         (layer_ ? layer_->memory_bytes() : 0);
}

template class Step<2, float>;
template class Step<2, double>;

}  // namespace slipwave::solver
