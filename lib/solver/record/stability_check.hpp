#pragma once

#include <array>
#include <functional>

#include "base/error.hpp"
#include "gather/trace.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/effect/effect.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// A velocity that can not be, and where it was seen.
template <int D>
struct Divergence {
  StepTime time;                  // the step at whose end it was seen
  Index<D> at{};                  // cell of the computed grid
  int axis = 0;                   // of the velocity
  double value = 0, limit = 0;    // m/s
  std::array<Index<D>, 2> box{};  // all such cells are in it, first and last cell
};

/// What the fields of a run that became unstable make of it.
template <int D>
class DivergedFields : public Error {
 public:
  DivergedFields(const std::string& what, const Divergence<D>& first)
      : Error(what, ErrorKind::unstable), first_(first) {}
  const Divergence<D>& first() const { return first_; }

 private:
  Divergence<D> first_;
};

/// Looks at all velocities every `every` steps; throws UnsoundFields once one of them is not finite or beyond
/// what the energy of the shot could make of it.
template <int D, class Real>
class StabilityCheck {
 public:
  static constexpr std::int64_t every = 50;
  /// `limit` in m/s: largest_velocity().
  StabilityCheck(const State<D, Real>& state, const Domain<D>& domain, double unit, double limit)
      : state_(state), domain_(domain), unit_(unit), limit_(limit) {}
  /// To be called when no step is in progress. Names the fastest cell, or where any is not finite the one in
  /// the middle of those: what is not finite spreads alike to all sides.
  void check(const StepTime& time) const;
  /// The first step after `step` that ends with a look.
  static std::int64_t next_after(std::int64_t step) { return (step / every + 1) * every - 1; }
  /// Steps made at the last look before so many were made.
  static std::int64_t last_before(std::int64_t steps) { return (steps - 1) / every * every; }

 private:
  Divergence<D> first_of(const std::vector<char>& bad_lines, Real beyond) const;

  const State<D, Real>& state_;
  const Domain<D>& domain_;
  double unit_, limit_;
};

/// No cell of a shot can move faster, m/s, with a factor of 100 to spare: all energy there is, in one cell of
/// the lightest material. With V = h^D, w the wavelet and I the integral of |w| over the run,
///   force F:           |F|^2 I^2/(2 rho V),   as dE/dt = F.v w <= |F w| (2 E/(rho V))^1/2
///   moment rate M':    |M'|^2 I^2/(2 rho c^2 V),   c the slowest wave of the source's cell
///   plane wave:        rho A^2 w^2 V in each cell, and as much again through the edges in each step
///   static stress:     |s|^2 V/(2 rho vs^2) in each cell of a fracture
/// v^2 = 2 E/(rho_min V). Collective where there are ranks (may be null).
template <int D>
double largest_velocity(const Scene<D>& scene, std::size_t shot, Ranks* ranks = nullptr);

}  // namespace slipwave::solver
