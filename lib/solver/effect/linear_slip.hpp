// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/effect/effect.hpp"
#include "solver/effect/fracture_cells.hpp"
#include "solver/effect/point_source.hpp"
#include "solver/kernels/linear_slip_kernels.hpp"

namespace slipwave::solver {

/// Ratio of the strain of fracture planes to that of the rock, under any stress, above which a cell carries
/// next to no stress.
constexpr double softness_without_stress = 100;

/// Cells of the computed grid, ascending, where springs of clusters do, without dashpots: it takes two
/// families, in 3-D three.
template <int D>
std::vector<std::int64_t> soft_cells(const Domain<D>& domain, const Model<D>& model);

/// Returns what is Domain::among_planes of these; it keeps references.
template <int D>
std::function<std::optional<Elasticity<D>>(const Index<D>& at)> stiffness_among_planes(
    const Domain<D>& domain, const Model<D>& model);

/// Planes that give way as springs, with or without dashpots, in all fracture cells that have such planes
/// (theory/fractures.md). It acts before slip at the end of a step and after it at the beginning of the next,
/// so that friction is above the springs. Keeps references.
template <int D, class Real>
class LinearSlip : public Effect<D, Real> {
 public:
  /// A moment in a cluster is one of its effective medium: springs do not give way to what sources inject
  /// (S26a). Below friction they do, as friction does, and beside single fractures it is one of the rock.
  LinearSlip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s,
             double unit = 1, InjectedStress<D, Real> injected = {});

  EffectDeclaration declaration() const override {
    return {ActsOn::fracture_cells, false, all_stresses<D>, all_stresses<D>, true};
  }
  std::string name() const override { return "linear slip"; }
  std::int64_t cells() const override;
  std::vector<EffectShare> shares() const override;
  void apply(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells) override;
  void apply_after_record(const StepTime& time, const RowFields<Real>& fields,
                          const IndexRange& cells) override;
  void serialize(Archive& archive) override;
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override;
  /// Adds the energy in the springs to what is left in the model.
  void report(ShotReport& report) const override { report.energy_left += stored_energy(); }

  /// Returns the energy stored in the springs of the cells of the model that this process owns, in J (in 2-D
  /// J/m).
  double stored_energy() const;

 private:
  /// The cells of one set.
  struct Group {
    FractureCells<D> places;
    const FractureSet<D>* set;
    LinearSlipCase of;
    SlipPlanes<Real> planes;
    LinearSlipKernels<Real> kernels;
    std::vector<Real> memory, coefficients;  // rows of all stored cells, one after the other
  };
  void add(const FractureSet<D>& set, FractureCells<D> cells, CellKind kind, bool askew, double dt_s);
  void add_family(Group& group, double dt_s) const;
  void add_crossing(Group& group) const;
  void add_single(Group& group) const;
  double stored_energy(const Group& group, std::size_t place, std::size_t cell) const;
  void each_segment(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells,
                    typename LinearSlipKernels<Real>::Kernel LinearSlipKernels<Real>::*kernel);

  State<D, Real>& state_;
  const Domain<D>& domain_;
  const Model<D>& model_;
  double unit_;
  InjectedStress<D, Real> injected_;
  Real ahead_;
  std::vector<Group> groups_;
};

}  // namespace slipwave::solver
