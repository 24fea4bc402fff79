// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "scene/plane_wave.hpp"
#include "scene/scene.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// How far sweeps along each axis have advanced fields, s, and how many of those along the last axis there
/// were.
template <int D>
struct Clocks {
  std::array<double, std::size_t(D)> axis_s{};
  std::int64_t along_last = 0;
};

/// The clocks before and after the sweeps of a time step.
template <int D>
class SweepClocks {
 public:
  SweepClocks(std::vector<SweepFraction> sweeps, double dt_s);
  /// Returns the clocks of fields that such a sweep begins with.
  Clocks<D> before(const SweepTime& time) const;
  /// Returns the clocks of fields that it leaves, when it has covered such a fraction of the step.
  Clocks<D> after(const SweepTime& time, double fraction) const;
  /// Sweeps of a step along the last axis.
  std::int64_t along_last() const { return along_last_; }

 private:
  std::vector<SweepFraction> sweeps_;
  double dt_s_;
  std::int64_t along_last_ = 0;
};

/// The incident wave field of a plane wave in the zones outside the model, between any two sweeps.
template <int D, class Real>
class IncidentWave {
 public:
  static constexpr int rows = FieldRows<D>::count;
  virtual ~IncidentWave() = default;
  /// Sets the fields of the computed grid to the wave of t = 0.
  virtual void begin(State<D, Real>& state) = 0;
  /// Advances it to time.end_s(), step after step. It still holds the steps in progress (Effect).
  virtual void advance(const StepTime&) {}
  /// Whether there is such a wave in the zone of `axis`, `side` (0 low, 1 high).
  virtual bool enters(int axis, int side) const = 0;
  /// Whether it may be other than zero in the zones of a line during a step, or in the first sweep of the
  /// next.
  virtual bool reaches(const StepTime& time, const Index<D>& line) const = 0;
  /// Its values in `count` cells of a line from x_first on, which lie in such a zone: field row after field
  /// row, `pitch` apart. Returns false where it is zero in all of them; `to` is then not set.
  virtual bool values(const Clocks<D>& clocks, int axis, int side, const Index<D>& line, std::int64_t x_first,
                      std::int64_t count, Real* to, std::int64_t pitch) const = 0;
  /// Writes or reads what it retains from one step to the next; called when no step is in progress.
  virtual void serialize(Archive&) {}
  virtual std::int64_t memory_bytes() const { return 0; }
};

/// Cells whose values are asked for at once, at most.
inline constexpr std::int64_t incident_piece = 64;

/// Sets the fields of all cells: `values` as IncidentWave::values(), without clocks and zone.
template <int D, class Real, class Values>
void set_cells(State<D, Real>& state, Values&& values) {
  constexpr auto piece = incident_piece;
  const auto& layout = state.layout;
  std::vector<Real> cells(std::size_t(piece * FieldRows<D>::count));
  for (std::int64_t line = 0; line < layout.lines(); ++line) {
    const auto at = layout.line_index(line);
    const auto fields = state.row_fields(line);
    for (std::int64_t i = 0; i < layout.shape()[0]; i += piece) {
      const auto count = std::min(piece, layout.shape()[0] - i);
      if (!values(at, i, count, cells.data(), piece)) continue;
      for (int row = 0; row < layout.rows(); ++row)
        std::copy_n(cells.begin() + row * piece, count, fields.field(row) + i);
    }
  }
}

/// The incident wave of a scene with a plane wave that check(scene) has passed: a vertical one in 2-D along
/// each side as the column of cells there lets it through, computed with the scheme itself; any other in
/// closed form (LayeredWave). `of_bands` (else null) is what it travels through where the scene is a band of
/// cells.
template <int D, class Real>
std::unique_ptr<IncidentWave<D, Real>> make_incident_wave(const Scene<D>& scene, const Source<D>& source,
                                                          const Domain<D>& domain, double dt_s,
                                                          const PlaneWaveGround<D>* of_bands = nullptr);

}  // namespace slipwave::solver
