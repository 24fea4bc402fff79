// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "solver/effect/incident_wave.hpp"
#include "solver/effect/pml.hpp"

namespace slipwave::solver {

/// Returns the settings of the PML in plane-wave scenes: its outermost cells hold the incident wave.
template <int D>
PmlSettings pml_of_plane_wave(const Scene<D>& scene);

/// The PML of a scene with a plane wave: it acts on the scattered field, the fields less the incident wave
/// (theory.md (E13)). Where that is known, the outermost cells are set to it: there it enters.
template <int D, class Real>
class IncidentPml : public Effect<D, Real> {
 public:
  /// Takes a PML with such settings. Keeps a reference to the domain.
  IncidentPml(const Layout<D>& layout, const Domain<D>& domain, std::unique_ptr<Pml<D, Real>> pml,
              const PmlSettings& settings, std::unique_ptr<IncidentWave<D, Real>> incident,
              SweepClocks<D> clocks);

  EffectDeclaration declaration() const override {
    auto declared = pml_->declaration();
    declared.enters_sweeps = true;
    return declared;
  }
  std::string name() const override { return "PML, incident wave"; }
  std::int64_t cells() const override { return pml_->cells(); }
  bool initialize(State<D, Real>& state) override;
  void begin(const StepTime& time) override { incident_->advance(time); }
  std::array<IndexRange, 2> filtered(int axis, const Index<D>& row, const IndexRange& cells) const override {
    return pml_->filtered(axis, row, cells);
  }
  bool enters(const StepTime& time, std::int64_t row, const IndexRange& columns) const override;
  void filter(const SweptCells<D, Real>& swept) override;
  NextSweep next(const SweepTime& time, Real fraction) const override { return pml_->next(time, fraction); }
  void prepare(const SweptCells<D, Real>& swept) override { pml_->prepare(swept); }
  void serialize(Archive& archive) override;
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override {
    pml_->exchange(rows, to);
  }
  std::int64_t memory_bytes() const override { return pml_->memory_bytes() + incident_->memory_bytes(); }

 private:
  void filter_piece(const SweptCells<D, Real>& swept, int side);
  bool prescribed(int axis, std::int64_t cell) const;

  const Domain<D>& domain_;
  Layout<D> layout_;
  std::unique_ptr<Pml<D, Real>> pml_;
  std::int64_t idle_cells_;
  std::unique_ptr<IncidentWave<D, Real>> incident_;
  SweepClocks<D> clocks_;
};

}  // namespace slipwave::solver
