#pragma once

#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/effect/slip_group.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver {

/// The slip correction of all fracture cells at the end of a step (theory.md (S4)), in the order the scene
/// asks for. Cells of the absorbing zones do not slip. Keeps references.
template <int D, class Real>
class Slip : public Effect {
 public:
  /// Fields are `unit` times SI.
  Slip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s, double unit = 1);

  void run(const StepTime&, std::int64_t line, const IndexRange& columns) override;
  void run_after_record(const StepTime&, std::int64_t line, const IndexRange& columns) override;
  /// The same in a copy of the fields of these columns: cell 0 of row 0 and the way to the next row.
  void run_in(Real* fields, std::int64_t pitch, std::int64_t line, const IndexRange& columns);
  void run_after_in(Real* fields, std::int64_t pitch, std::int64_t line, const IndexRange& columns);
  std::string name() const override;
  std::int64_t cells() const override;
  std::vector<EffectShare> effects() const override;
  void serialize(Archive& archive) override;
  /// Shows what the cells of a line remember from one step to the next, the diary apart.
  void show(std::int64_t line, const std::function<void(Real* values, std::int64_t count)>& to) {
    for (auto& group : groups_) group.show(line, to);
  }

  /// A field of the diary on the model's grid: see SlipField. The scene must keep a diary, but for `opening`.
  Field<D> field(SlipField which) const;
  SlipTotals totals() const;

 private:
  /// What is stored of a cell for the diary.
  struct Entry {
    double slip = 0, ahead = 0, in_step = 0;  // strain; of it what the next step began with, and of one step
    double heat = 0, out_of_waves = 0;        // J/m3
  };                                          // as the fields are
  void each_stretch(Real* fields, std::int64_t pitch, std::int64_t line, const IndexRange& columns,
                    std::initializer_list<SlipAct> active);
  void note(std::size_t group, std::size_t place, std::int64_t n, const Real* before, const Real* after,
            std::int64_t pitch, SlipAct act);

  State<D, Real>& state_;
  const Domain<D>& domain_;
  double dt_s_, unit_;
  SlipCorrection correction_;
  bool opens_ = false;
  std::vector<SlipGroup<D, Real>> groups_;
  std::vector<std::vector<Entry>> diary_;  // [group][cell], empty: none
};

}  // namespace slipwave::solver
