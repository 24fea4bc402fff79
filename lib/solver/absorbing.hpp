#pragma once

#include <memory>
#include <vector>

#include "solver/background.hpp"

namespace slipwave::solver {

/// Absorbing zones of a scene with a wave that comes in from outside: all fields decay towards that
/// background at the same rate, which leaves the impedance, so that nothing else is reflected at normal
/// incidence and little at others (theory.md (E13)).
template <int D, class Real>
class AbsorbingZones : public Pass {
 public:
  /// `background` may be null: the zones then damp to zero. Keeps references.
  AbsorbingZones(State<D, Real>& state, const Domain<D>& domain, double dt_s, double vp_max,
                 Background<D, Real>* background);
  void begin(const StepTime& time) override {
    if (background_) background_->advance(time);
  }
  void run(const StepTime& time, std::int64_t line, const Columns& columns) override;
  std::string name() const override {
    return background_ ? "absorbing zones, incoming wave" : "absorbing zones";
  }
  std::int64_t cells() const override;
  bool stirs(const StepTime&, std::int64_t) const override { return background_ != nullptr; }
  std::span<const std::int64_t> lines() const override { return lines_; }
  bool works_beside() const override { return lines_.empty(); }
  void keep(Archive& archive) override {
    if (background_) background_->keep(archive);
  }

 private:
  void damp(const StepTime& time, int axis, int side, const Index<D>& line, const Columns& columns,
            Real factor);

  State<D, Real>& state_;
  const Domain<D>& domain_;
  Background<D, Real>* background_;
  const DampKernels<Real>& kernels_;
  std::array<std::vector<Real>, D> factors_;
  std::vector<std::int64_t> lines_;
};

}  // namespace slipwave::solver
