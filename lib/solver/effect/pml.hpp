// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/archive.hpp"
#include "parallel/ranks.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// How a PML differs from that of a point source.
struct PmlSettings {
  std::int64_t idle_cells = 0;  // at its outer end, where fields are prescribed
  bool lying = false;           // x of the domain is the last axis of the scene (2-D)
};

/// A convolutional perfectly matched layer (PML) on the increments of the sweeps (theory.md (E14)). In a zone
/// outside an absorbing edge the derivative across the edge is divided by 1 + d/(alpha + i omega): with the
/// memory phi of the increments r (per second) of a field in sweeps along that axis,
///   u' = r - d phi,   phi' = r - (d + alpha) phi.
/// A sweep stands between two halves of the damping, solved exactly: the second comes right after it, the
/// first after the sweep before it along another axis. Waves of all kinds enter it in all directions without
/// reflection; alpha keeps slow and grazing fields from lasting. Where the layer cuts through plates (solid
/// between two reflectors), or through anisotropic rock whose waves turn (theory.md (V6)), damping of all
/// fields keeps waves from growing; elsewhere there is none, since it reflects at an angle.
template <int D, class Real>
class Pml : public Effect<D, Real> {
 public:
  /// `slow_hz`: the frequency of the source, below half of which the stretching decreases.
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
  /// Takes increments into the memory and damps the fields over half the sweep. Throws an Error where the
  /// splitting has another sweep at that time.
  void filter(const SweptCells<D, Real>& swept) override;
  NextSweep next(const SweepTime& time, Real fraction) const override;
  /// Damps the fields over half the sweep.
  void prepare(const SweptCells<D, Real>& swept) override;
  void serialize(Archive& archive) override {
    for (auto& axis : axes_) archive.fixed(axis.memory.data(), std::size_t(axis.memory.size()));
  }
  /// Outside the layers above and below.
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override;

 private:
  /// The factors of one sweep, by slot: the factor of the memory in what is subtracted and its decay over
  /// half the sweep, and what fields lose in thick plates and elsewhere where waves would grow over all of
  /// it.
  struct Factors {
    std::vector<Real> loss, left, lost_in_thick_plates, lost_growing;
    PmlFactors<Real> from(std::int64_t slot) const {
      return {loss.data() + slot, left.data() + slot, lost_in_thick_plates.data() + slot,
              lost_growing.data() + slot};
    }
  };
  /// Along the edge: how much is lost in thick plates, and elsewhere where waves would grow; else 0.
  struct Damping {
    std::vector<Real> in_thick_plates, growing;
    PmlDamping<Real> from(std::int64_t cell) const {
      return {in_thick_plates.data() + cell, growing.data() + cell};
    }
  };
  struct Axis {
    std::int64_t cells = 0, low = 0, high = 0;
    std::vector<Factors> factors;  // [sweep of the step], slots: low zone, then high zone, by cells
    Buffer<Real> memory;
    std::array<Damping, 2> damping;  // low and high zone
    /// The integrals of d over both zones in cells by steps: over a Courant number, of d/c.
    std::array<double, 2> damped{};
    std::int64_t slot(std::int64_t cell) const { return cell < low ? cell : cell - (cells - high) + low; }
    bool holds(std::int64_t cell) const { return cell < low || cell >= cells - high; }
  };
  /// A sweep along x, the first of two that are one over the end of a step.
  bool begins_pair(const SweepTime& time, Real fraction) const {
    return time.sweep + 1 == sweeps_.size() && fraction == Real(sweeps_.back().fraction);
  }
  /// The factors of a sweep along an axis of the domain, from a cell of the layer on.
  PmlFactors<Real> factors_of(const SweptCells<D, Real>& swept) const;
  struct Times {
    double dt_s, slow_hz;
  };
  /// Over which part of a step a sweep damps: the first and the last are one over the end of a step.
  double fraction_of(std::size_t sweep) const {
    return (sweep == 0 || sweep + 1 == sweeps_.size() ? 2 : 1) * sweeps_[sweep].fraction;
  }
  static std::int64_t inner_width(std::int64_t zone, const PmlSettings& settings) {
    return std::max<std::int64_t>(zone - settings.idle_cells, 1);
  }
  double largest_damping(std::int64_t width, double h, double dt_s, double vp_max) const;
  /// `largest`: d of the low and the high zone at its outer end, per second.
  Factors make_factors(int axis, std::size_t sweep, const std::array<double, 2>& largest, const Times& times,
                       const PmlSettings& settings) const;
  std::int64_t along_edge(int axis, const Index<D>& at) const;
  void find_growing(int axis, const Domain<D>& domain, double alpha, Ranks* ranks);
  void find_plates(int axis, int side, int across, const Domain<D>& domain, double alpha, Ranks* ranks);
  void find_turning(int axis, int side, const Domain<D>& domain);
  void find_slopes(int axis, int side, const Domain<D>& domain);
  double most_damped(int axis) const;
  /// Returns the first value of the first of the field rows of a row of cells, and the distance from one
  /// field row to the next.
  std::pair<Real*, std::int64_t> memory_of(int axis, const Index<D>& line, std::int64_t first);

  Layout<D> layout_;
  std::vector<SweepFraction> sweeps_;  // of a step, along axes of the domain
  std::int64_t cells_;
  const PmlKernels<Real>& kernels_;
  std::array<Axis, std::size_t(D)> axes_;
};

}  // namespace slipwave::solver
