// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/archive.hpp"
#include "parallel/ranks.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// How a PML differs from that of a point source.
struct PmlSettings {
  /// Amplitude of a P wave after crossing the layer and back at normal incidence.
  double leak = 1e-3;
  std::int64_t idle_cells = 0;  // at its outer end, where fields are prescribed
  bool lying = false;           // x of the domain is the last axis of the scene (2-D)
};

/// A convolutional perfectly matched layer (PML) on the increments of the sweeps (theory.md (E14)). In a zone
/// outside an absorbing edge the derivative across the edge is divided by 1 + d/(alpha + i omega): the
/// increment of a field in a sweep along that axis, over the fraction `fraction` of a step, loses the memory
/// phi of earlier increments,
///   u' = r - phi,   phi' = -(d + alpha) phi + d r,   r = increment of the sweep per second,
/// solved exactly for a constant r. Waves of all kinds enter it in all directions without reflection; alpha,
/// largest at the model and zero at the outer end, keeps slow and grazing fields from lasting. Where the
/// layer cuts through plates (solid between two reflectors), or through anisotropic rock whose waves turn
/// (theory.md (V6)), damping of all fields keeps waves from growing; elsewhere there is hardly any, since it
/// reflects at an angle.
template <int D, class Real>
class Pml : public Effect<D, Real> {
 public:
  /// `slow_hz`: the frequency below which the stretching decreases, that of the source.
  /// `time_order`: of the splitting the sweeps follow. Collective where there are ranks (may be null).
  Pml(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max, double slow_hz,
      int time_order = 2, Ranks* ranks = nullptr, const PmlSettings& settings = {});

  EffectDeclaration declaration() const override {
    return {ActsOn::nothing, true, all_fields<D>, all_fields<D>, true};
  }
  std::string name() const override { return "PML"; }
  std::int64_t cells() const override { return cells_; }
  /// The cells of the layer of this axis.
  std::array<IndexRange, 2> filtered(int axis, const Index<D>& row, const IndexRange& cells) const override;
  /// Subtracts the memory term from increments. Throws an Error where no sweep of the splitting is over that
  /// fraction of the step.
  void filter(const SweptCells<D, Real>& swept, bool remember) override;
  void serialize(Archive& archive) override {
    for (auto& axis : axes_) archive.fixed(axis.memory.data(), std::size_t(axis.memory.size()));
  }
  /// Outside the layers above and below.
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override;

 private:
  /// Of one fraction of the step, by slot: the factor of the memory and that of the increment in what is
  /// subtracted, the decay of the memory and the factor of the increment added to it, the damping of the
  /// field and its additional loss in plates.
  struct Factors {
    std::vector<Real> of_memory, of_change, left, added, kept, lost_in_plates;
    PmlFactors<Real> from(std::int64_t slot) const {
      return {of_memory.data() + slot, of_change.data() + slot, left.data() + slot,
              added.data() + slot,     kept.data() + slot,      lost_in_plates.data() + slot};
    }
  };
  struct Axis {
    std::int64_t cells = 0, low = 0, high = 0;
    std::vector<Real> fractions;   // of a step that sweeps along this axis are over
    std::vector<Factors> factors;  // [fraction], slots: low zone, then high zone, by cells
    Buffer<Real> memory;
    /// Low and high zone, along the edge: 1 in plates, more where waves turn back, else 0.
    std::array<std::vector<Real>, 2> plates;
    std::int64_t slot(std::int64_t cell) const { return cell < low ? cell : cell - (cells - high) + low; }
    bool holds(std::int64_t cell) const { return cell < low || cell >= cells - high; }
  };
  std::int64_t along_edge(int axis, const Index<D>& at) const;
  void find_plates(int axis, const Domain<D>& domain, Ranks* ranks);
  void find_plates(int axis, int side, int across, const Domain<D>& domain, Ranks* ranks);
  void find_turning(int axis, int side, const Domain<D>& domain);
  void find_slopes(int axis, int side, const Domain<D>& domain);
  double most_damped(int axis) const;
  /// Of the field rows of a row of cells: the first value of the first of them, and from one to the next.
  std::pair<Real*, std::int64_t> memory_of(int axis, const Index<D>& line);

  Layout<D> layout_;
  std::int64_t cells_;
  const PmlKernels<Real>& kernels_;
  std::array<Axis, std::size_t(D)> axes_;
};

}  // namespace slipwave::solver
