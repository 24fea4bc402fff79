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
/// A sweep stands between two halves of the damping: the second comes right after it, the first after the
/// sweep before it along another axis. In one rock both match the steps (E14d), elsewhere each is solved
/// exactly (E14a). Waves of all kinds enter the layer in all directions without reflection; alpha keeps slow
/// and grazing fields from lasting. Where the layer cuts through plates (solid between two reflectors), or
/// through anisotropic rock whose waves turn (theory.md (V6)), damping of all fields keeps waves from
/// growing; elsewhere there is none, since it reflects at an angle.
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
    for (auto& axis : axes_)
      for (auto& memory : axis.memory) archive.fixed(memory.data(), std::size_t(memory.size()));
  }
  /// Outside the layers above and below.
  void exchange(const IndexRange& rows,
                const std::function<void(Real* values, std::int64_t count)>& to) override;
  std::int64_t memory_bytes() const override;

 private:
  /// The factors of one sweep, by slot: what fields lose of the memory before and after it and of what it
  /// adds, what is left of the memory, and what fields lose in thick plates and elsewhere where waves would
  /// grow.
  struct Factors {
    std::vector<Real> before, after, of_increments, left, of_recent, of_newest, recent_left,
        lost_in_thick_plates, lost_growing;
    PmlFactors<Real> from(std::int64_t slot) const {
      return {before.data() + slot,        after.data() + slot,
              of_increments.data() + slot, left.data() + slot,
              of_recent.data() + slot,     of_newest.data() + slot,
              recent_left.data() + slot,   lost_in_thick_plates.data() + slot,
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
  /// d, per second, in a layer: outer (depth)^2, or where the damping matches the steps (E14d) rising to
  /// inner in the first third, and from there in the last third to outer, which need not match.
  struct Profile {
    bool matched = false;
    double inner = 0, outer = 0;
    double at(double depth) const;
    double mean() const;
    bool matches(double depth) const { return matched && (depth <= 2. / 3 || outer == inner); }
  };
  struct Axis {
    std::int64_t cells = 0, low = 0, high = 0;
    std::vector<Factors> factors;  // [sweep of the step], slots: low zone, then high zone, by cells
    /// What fields lose of, in terms of before and after; recent increments; those of the first half of a
    /// sweep.
    enum Memory { lost, recent, held };
    std::array<Buffer<Real>, 3> memory;
    std::array<Damping, 2> damping;  // low and high zone
    /// The integrals of d over both zones in cells by steps: over a Courant number, of d/c.
    std::array<double, 2> damped{};
    std::array<Profile, 2> profiles;
    std::int64_t slot(std::int64_t cell) const { return cell < low ? cell : cell - (cells - high) + low; }
    bool holds(std::int64_t cell) const { return cell < low || cell >= cells - high; }
  };
  /// A sweep along x, the first of two that are one over the end of a step.
  bool begins_pair(const SweepTime& time, Real fraction) const {
    return time.sweep + 1 == sweeps_.size() && fraction == Real(sweeps_.back().fraction);
  }
  /// The second of them.
  bool ends_pair(const SweepTime& time, Real fraction) const {
    return time.sweep == 0 && fraction == Real(sweeps_.front().fraction);
  }
  /// The factors of a sweep along an axis of the domain, from a cell of the layer on.
  PmlFactors<Real> factors_of(const SweptCells<D, Real>& swept) const;
  struct Times {
    double dt_s, slow_hz, vp_max, spacing_m;
  };
  /// Over which part of a step a sweep damps: the first and the last are one over the end of a step.
  double fraction_of(std::size_t sweep) const {
    return (sweep == 0 || sweep + 1 == sweeps_.size() ? 2 : 1) * sweeps_[sweep].fraction;
  }
  static std::int64_t inner_width(std::int64_t zone, const PmlSettings& settings) {
    return std::max<std::int64_t>(zone - settings.idle_cells, 1);
  }
  Profile profile_of(bool matched, std::int64_t width, const Times& times) const;
  void set_factors(int axis, const std::array<bool, 2>& matched, const Times& times,
                   const PmlSettings& settings);
  Factors make_factors(int axis, std::size_t sweep, const Times& times, const PmlSettings& settings) const;
  std::int64_t along_edge(int axis, const Index<D>& at) const;
  void find_growing(int axis, const Domain<D>& domain, double alpha, Ranks* ranks);
  void find_plates(int axis, int side, int across, const Domain<D>& domain, double alpha, Ranks* ranks);
  void find_turning(int axis, int side, const Domain<D>& domain);
  void find_slopes(int axis, int side, const Domain<D>& domain);
  double most_damped(int axis) const;
  std::array<bool, 2> sides_that_match(int axis, const Domain<D>& domain, Ranks* ranks) const;
  /// The place of the first of the field rows of a row of cells in the memory of an axis, and the distance
  /// from one field row to the next.
  std::array<std::int64_t, 2> place_in_memory(int axis, const Index<D>& line, std::int64_t first) const;

  Layout<D> layout_;
  std::vector<SweepFraction> sweeps_;  // of a step, along axes of the domain
  std::int64_t cells_;
  const PmlKernels<Real>& kernels_;
  std::array<Axis, std::size_t(D)> axes_;
};

}  // namespace slipwave::solver
