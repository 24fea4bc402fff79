#pragma once

#include <memory>

#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Values of all field rows in some cells of a row: of each field one for all cells, or one per cell.
template <class Real>
struct IncidentValues {
  const Real* values;  // of row 0
  std::int64_t pitch;  // to the next row
  bool by_cell;
};

/// The incident wave field, known in the sponge, which damps the fields towards it. In scenes without such a
/// wave there is none and the sponge damps to zero.
template <int D, class Real>
class IncidentWave {
 public:
  virtual ~IncidentWave() = default;
  /// Sets the fields of the computed grid to the wave of t = 0.
  virtual void begin(State<D, Real>& state) = 0;
  /// Advances it to time.end_s(), step after step. It still holds the steps in progress (Effect).
  virtual void advance(const StepTime& time) = 0;
  /// Its values at that step in `count` cells of a line from x_first on, which lie in the zone of `axis`,
  /// `side` (0 low, 1 high). They last until most_steps_in_progress steps later (Effect), or are stored in
  /// `room`, for `count` cells of all fields.
  virtual IncidentValues<Real> values(const StepTime& time, int axis, int side, const Index<D>& line,
                                      std::int64_t x_first, std::int64_t count, Real* room) const = 0;
  /// Whether the sponge needs the fields at the exact end of a step, with its half sweeps split.
  virtual bool needs_whole_step() const = 0;
  /// Writes or reads what it retains from one step to the next; called when no step is in progress.
  virtual void serialize(Archive& archive) = 0;
};

/// Damping of each cell of an axis over one step, 1 outside the zones (theory.md (E13)).
template <int D>
std::vector<double> zone_factors(const Domain<D>& domain, int axis, double dt_s, double vp_max);

/// A plane P or SV wave in one medium, in closed form (theory.md (A7)). 2-D.
/// Everywhere in scenes whose edges are uniform; with `columns`, at the sides the solution of the column of
/// cells along each side edge, which follows a vertical wave through any layers.
template <class Real>
std::unique_ptr<IncidentWave<2, Real>> make_plane_wave(const Scene<2>& scene, const Source<2>& source,
                                                       const Domain<2>& domain, double dt_s);

}  // namespace slipwave::solver
