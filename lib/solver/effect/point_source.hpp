// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "acquisition/interpolation.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/point_weights.hpp"

namespace slipwave::solver {

/// The injection of a point source, half before and half after recording, so that the recorded fields lie in
/// the middle (trapezoidal rule in time). Keeps references.
template <int D, class Real>
class PointSource : public Effect<D, Real> {
 public:
  /// Collective where there are `ranks` (may be null): the one that owns the cell of the source computes
  /// the weights of the cells round it for all. Where no row of this process is near it, rows() is empty and
  /// there is nothing to do.
  PointSource(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, const Source<D>& source,
              double unit, Ranks* ranks = nullptr);

  EffectDeclaration declaration() const override {
    return {ActsOn::rows, false, work_.empty() ? 0 : all_fields<D>, writes_, !work_.empty()};
  }
  std::string name() const override { return "source"; }
  std::int64_t cells() const override { return std::int64_t(values_.size()); }
  std::span<const std::int64_t> rows() const override { return rows_; }
  /// Its rows take two half sweeps a step as long as it acts. Round a moment that lasts they continue so: one
  /// whole sweep holds another stress in balance, and to change over would send out waves.
  bool active(const StepTime& time) const override { return moment_ == Moment::lasting || gives(time); }
  bool injects(const StepTime& time, std::int64_t row) const override {
    return active(time) && row >= rows_.front() && row <= rows_.back();
  }
  void apply(const StepTime& time, const RowFields<Real>& fields, const IndexRange& cells) override;
  void apply_after_record(const StepTime& time, const RowFields<Real>& fields,
                          const IndexRange& cells) override {
    apply(time, fields, cells);
  }
  /// Adds `times` all that it has put into the stress of these cells after so many steps, of which half a one
  /// is that before recording; false where that was nothing.
  bool add_stress(double steps, const RowFields<Real>& fields, const IndexRange& cells, double times);
  void serialize(Archive& archive) override { archive.fixed(work_); }
  /// The energy put into the waves so far, J (2-D: J per metre); 0 unless the scene keeps a diary.
  void report(ShotReport& report) const override;

 private:
  bool gives(const StepTime& time) const { return time.end_s() - delay_s_ <= wavelet_.duration_s(); }
  void weigh(const Source<D>& source);
  void share(Ranks& ranks);
  void add_force(const Source<D>& source, int axis, double newtons, double volume);
  void add_moment(const Source<D>& source, const std::vector<std::array<int, 2>>& stresses, int like,
                  double strength);
  void add(const std::vector<ValueWeight>& weights, int rows_on, double strength);
  void find_rows();
  std::span<const ValueWeight> values_of(std::int64_t row) const;
  template <class Chosen>
  bool add_to(const RowFields<Real>& fields, const IndexRange& cells, double amount, const Chosen& chosen);
  double energy_of(std::int64_t row, const IndexRange& cells) const;

  State<D, Real>& state_;
  const Domain<D>& domain_;
  const Medium<D>& medium_;
  Wavelet wavelet_;
  double delay_s_;
  double unit_;
  Moment moment_ = Moment::passing;
  Side side_ = Side::solid;                  // of an interface of fluid and solid that it is on
  Index<D> centre_{};                        // the cell of the source, which may lie beyond this subdomain
  std::int64_t reach_ = widest_stencil / 2;  // of the weights of a source in that cell, in cells
  std::vector<ValueWeight> values_;
  std::vector<std::int64_t> rows_;
  unsigned writes_ = 0;
  std::vector<double> given_;  // per unit of weight by all steps before each, up to the last that gives
  std::vector<double> work_;   // by line; empty: not counted
};

/// The stress that point sources have put into cells. It is no strain of the rock: where the rock gives way
/// to its stress, by attenuation or as springs, it gives way to what is left without that.
template <int D, class Real>
class InjectedStress {
 public:
  InjectedStress() = default;
  explicit InjectedStress(std::vector<PointSource<D, Real>*> sources) : sources_(std::move(sources)) {}

  /// Calls act() while these cells are without what was put in after so many steps (PointSource::add_stress).
  template <class Act>
  void without(double steps, const RowFields<Real>& fields, const IndexRange& cells, const Act& act) const {
    bool any = false;
    for (auto* source : sources_) any |= source->add_stress(steps, fields, cells, -1);
    act();
    if (!any) return;
    for (auto* source : sources_) source->add_stress(steps, fields, cells, 1);
  }

 private:
  std::vector<PointSource<D, Real>*> sources_;
};

}  // namespace slipwave::solver
