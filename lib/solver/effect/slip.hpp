// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/effect/slip_group.hpp"

namespace slipwave::solver {

/// The slip correction of all fracture cells at the end of a step (theory.md (S4)), in the order of
/// accuracy that the scene sets. Cells outside the model do not slip. Keeps references.
template <int D, class Real>
class Slip : public Effect<D, Real> {
 public:
  /// Fields are `unit` times SI.
  Slip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s, double unit = 1);

  EffectDeclaration declaration() const override {
    return {ActsOn::fracture_cells, false, all_stresses<D>, all_stresses<D>, true};
  }
  std::string name() const override;
  std::int64_t cells() const override;
  std::vector<EffectShare> shares() const override;
  void apply(const StepTime&, const RowFields<Real>& fields, const IndexRange& cells) override;
  void apply_after_record(const StepTime&, const RowFields<Real>& fields, const IndexRange& cells) override;
  void serialize(Archive& archive) override;
  /// What it retains of the cells of these rows from one step to the next, without the diary.
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override;
  void report(ShotReport& report) const override { report.slip = totals(); }
  bool fill(SlipField which, Field<D>& field) const override {
    field = this->field(which);
    return true;
  }

  /// A field of the diary on the model's grid: see SlipField. Except for `opening` the scene must keep a
  /// diary.
  Field<D> field(SlipField which) const;
  SlipTotals totals() const;

 private:
  /// The diary of a cell.
  struct Entry {
    double slip = 0, ahead = 0, in_step = 0;  // strain: in all, of it in the explicit half, and of one step
    double heat = 0, out_of_waves = 0;        // J/m3
    // Centred rule: what the beginning of a step took off the stress ahead.
    SymmetricTensor<D, double> taken_ahead;
  };  // as the fields are
  void each_segment(const RowFields<Real>& fields, const IndexRange& cells,
                    std::initializer_list<SlipAct> acts);
  void record(std::size_t group, std::size_t place, std::int64_t n, const Real* before, const Real* after,
              std::int64_t pitch, SlipAct act);
  void record_askew(std::size_t group, std::size_t at, const Elasticity<D>& stiffness, std::int64_t i,
                    const Real* before, const Real* after, std::int64_t pitch, SlipAct act);

  State<D, Real>& state_;
  const Domain<D>& domain_;
  double dt_s_, unit_;
  SlipCorrection correction_;
  bool opens_ = false;
  std::vector<SlipGroup<D, Real>> groups_;
  std::vector<std::vector<Entry>> diary_;  // [group][cell], empty: none
};

}  // namespace slipwave::solver
