// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/effect/point_source.hpp"
#include "solver/kernels/relaxation_kernels.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Every so many steps stress relaxes: in steps of second order every other one, which keeps it cheap, in
/// those of fourth order, which are long, in each.
inline int relaxation_steps(const Numerics& numerics) { return numerics.time_order == 2 ? 2 : 1; }
/// Returns the relaxation of a scene that attenuates, over the steps of relaxation_steps(). The result keeps
/// a reference to the scene's medium.
template <int D>
StepwiseRelaxation<D> relaxation_by_steps(const Scene<D>& scene, double dt_s) {
  return {scene.model.medium, scene.attenuation->mechanisms, relaxation_steps(scene.numerics) * dt_s};
}

/// Relaxation of stress in cells with a finite qp or qs (theory.md (Q1)-(Q10)), at the strain of one moment
/// inside the step. It keeps what each mechanism has relaxed so far; cells outside the model relax as the
/// nearest one of the model. Keeps references.
template <int D, class Real>
class RelaxingStress : public Effect<D, Real> {
 public:
  /// The medium of the scene must be unrelaxed (unrelax()), that of the domain StepwiseRelaxation::medium().
  /// What sources inject does not relax.
  RelaxingStress(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene, double dt_s,
                 InjectedStress<D, Real> injected);

  EffectDeclaration declaration() const override {
    return {ActsOn::nothing, false, all_stresses<D>, all_stresses<D>, true, true};
  }
  std::string name() const override;
  std::int64_t cells() const override { return cells_; }
  void apply_between(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells) override;
  void serialize(Archive& archive) override { archive.fixed(memory_.data(), std::size_t(memory_.size())); }
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override {
    return std::int64_t(sizeof(Real)) * (memory_.size() + shares_.size() + axes_.size());
  }

 private:
  /// Neighbouring cells of a row, whole blocks of them that relax alike, from column `first` on; `place`
  /// cells are stored before them, and `axes` numbers of axes.
  struct Segment {
    std::int64_t first, last, place, axes;
    Relaxing what;
    RelaxationKernel<Real> relax;
  };
  std::span<const Segment> segments(std::int64_t line) const {
    return {segments_.data() + starts_[std::size_t(line)],
            starts_[std::size_t(line) + 1] - starts_[std::size_t(line)]};
  }
  void find_segments(const Domain<D>& domain, const Medium<D>& medium);
  void fill_shares(const Domain<D>& domain, const Medium<D>& medium, const StepwiseRelaxation<D>& relaxation);
  /// Fills axes_ with what relaxation along the axes of rock needs in the cells of segments; `medium` is the
  /// one that sweeps advance.
  void fill_axes(const Domain<D>& domain, const Medium<D>& medium);
  /// How the cells of a block relax, of which some attenuate.
  Relaxing what_relaxes_in(const Domain<D>& domain, const Medium<D>& medium, std::int64_t line,
                           std::int64_t first) const;
  Index<D> place_of(std::int64_t line, std::int64_t x) const;
  std::size_t model_cell(const Domain<D>& domain, std::int64_t line, std::int64_t x) const;
  /// Whether the solver takes a tilted mean for an isotropic one (Domain::anisotropic_cells()).
  bool is_taken_for_isotropic(const Domain<D>& domain, const Medium<D>& medium, std::int64_t line,
                              std::int64_t x) const;

  const Layout<D>& layout_;
  InjectedStress<D, Real> injected_;
  int every_, mechanisms_, parts_, moduli_;
  Relaxing what_;
  std::int64_t cells_ = 0, stored_ = 0, axes_stored_ = 0;
  std::vector<Segment> segments_;
  std::vector<std::size_t> starts_;  // of each line, and the end
  Buffer<Real> memory_, shares_;     // [block][mechanism, part][cell], [block][modulus, mechanism][cell]
  Buffer<Real> axes_;                // [block][axis_values()][cell] of segments that have any; else empty
  RelaxationRows<Real> rows_{};      // what all cells have in common
};

}  // namespace slipwave::solver
