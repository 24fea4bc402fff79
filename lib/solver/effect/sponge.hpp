#pragma once

#include <memory>
#include <vector>

#include "solver/effect/incident_wave.hpp"

namespace slipwave::solver {

/// Absorbing sponge of a scene with a plane wave: all fields decay towards the incident wave at the same
/// rate, which leaves the impedance, so that nothing else is reflected at normal incidence and little at
/// others (theory.md (E13)).
template <int D, class Real>
class Sponge : public Effect<D, Real> {
 public:
  /// `incident` may be null: the sponge then damps to zero. Keeps references.
  Sponge(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max,
         std::unique_ptr<IncidentWave<D, Real>> incident);
  EffectDeclaration declaration() const override {
    return {rows_.empty() ? ActsOn::all_cells : ActsOn::rows, false, all_fields<D>, all_fields<D>,
            incident_ != nullptr};
  }
  std::string name() const override { return incident_ ? "sponge, incident wave" : "sponge"; }
  std::int64_t cells() const override { return domain_.grid.size() - domain_.model_grid.size(); }
  std::span<const std::int64_t> rows() const override { return rows_; }
  bool injects(const StepTime&, std::int64_t) const override { return incident_ != nullptr; }
  bool initialize(State<D, Real>& state) override;
  void begin(const StepTime& time) override {
    if (incident_) incident_->advance(time);
  }
  void apply(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells) override;
  void serialize(Archive& archive) override {
    if (incident_) incident_->serialize(archive);
  }

 private:
  void damp(const StepTime& time, int axis, int side, const RowFields<Real>& fields, const IndexRange& cells,
            Real factor);

  Layout<D> layout_;
  const Domain<D>& domain_;
  std::unique_ptr<IncidentWave<D, Real>> incident_;
  const SpongeKernels<Real>& kernels_;
  std::array<std::vector<Real>, D> factors_;
  std::vector<std::int64_t> rows_;
};

}  // namespace slipwave::solver
