#pragma once

#include <memory>

#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Values of all field rows in some cells of a line: of each row one for all cells, or one a cell.
template <class Real>
struct IncidentValues {
  const Real* values;  // of row 0
  std::int64_t pitch;  // to the next row
  bool by_cell;
};

/// The wave field that comes in from outside, known in the sponge: what the zones damp the fields
/// to. In scenes without such a wave there is none and the zones damp to zero.
template <int D, class Real>
class IncidentWave {
 public:
  virtual ~IncidentWave() = default;
  /// Puts the wave of t = 0 into the fields of the computed grid.
  virtual void begin(State<D, Real>& state) = 0;
  /// Brings it to time.end_s(), step after step. It still knows the steps in progress (Pass).
  virtual void advance(const StepTime& time) = 0;
  /// Its values at that step in `count` cells of a line from x_first on, which lie in the zone of `axis`,
  /// `side` (0 low, 1 high). They last until another line of the same number of a step `most_steps_under_way`
  /// later, or stand in `room`, for `count` cells of all rows.
  virtual IncidentValues<Real> values(const StepTime& time, int axis, int side, const Index<D>& line,
                                      std::int64_t x_first, std::int64_t count, Real* room) const = 0;
  /// Whether it needs the fields whole (not split between sweeps) where it is compared with them.
  virtual bool needs_whole_step() const = 0;
  /// Gives what it remembers from one step to the next; called when no step is in progress.
  virtual void serialize(Archive& archive) = 0;
};

/// Damping of each cell of an axis over one step, 1 outside the zones (theory.md (E13)).
template <int D>
std::vector<double> zone_factors(const Domain<D>& domain, int axis, double dt_s, double vp_max);

/// A plane P wave in one medium, in closed form (theory.md (A7)). 2-D.
/// Everywhere in scenes whose edges are uniform; with `columns`, at the sides the solution of the column of
/// cells along each side edge, which follows a vertical wave through any layers.
template <class Real>
std::unique_ptr<IncidentWave<2, Real>> make_plane_wave(const Scene<2>& scene, const Source<2>& source,
                                                       const Domain<2>& domain, double dt_s);

}  // namespace slipwave::solver
