#pragma once

#include <memory>
#include <vector>

#include "solver/effect/incident_wave.hpp"

namespace slipwave::solver {

/// Absorbing zones of a scene with a wave that comes in from outside: all fields decay towards that
/// background at the same rate, which leaves the impedance, so that nothing else is reflected at normal
/// incidence and little at others (theory.md (E13)).
template <int D, class Real>
class Sponge : public Effect {
 public:
  /// `background` may be null: the zones then damp to zero. Keeps references.
  Sponge(State<D, Real>& state, const Domain<D>& domain, double dt_s, double vp_max,
         IncidentWave<D, Real>* background);
  void begin(const StepTime& time) override {
    if (background_) background_->advance(time);
  }
  void run(const StepTime& time, std::int64_t line, const IndexRange& columns) override;
  std::string name() const override {
    return background_ ? "absorbing zones, incoming wave" : "absorbing zones";
  }
  std::int64_t cells() const override;
  bool injects(const StepTime&, std::int64_t) const override { return background_ != nullptr; }
  std::span<const std::int64_t> lines() const override { return lines_; }
  bool acts_between_steps() const override { return lines_.empty(); }
  void serialize(Archive& archive) override {
    if (background_) background_->serialize(archive);
  }

 private:
  void damp(const StepTime& time, int axis, int side, const Index<D>& line, const IndexRange& columns,
            Real factor);

  State<D, Real>& state_;
  const Domain<D>& domain_;
  IncidentWave<D, Real>* background_;
  const SpongeKernels<Real>& kernels_;
  std::array<std::vector<Real>, D> factors_;
  std::vector<std::int64_t> lines_;
};

}  // namespace slipwave::solver
