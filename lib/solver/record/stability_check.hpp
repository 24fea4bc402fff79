#pragma once

#include <array>
#include <functional>

#include "base/error.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/sweep_filter.hpp"

namespace slipwave::solver {

/// An impossible velocity, and where it was found.
template <int D>
struct Divergence {
  StepTime time;                  // the step at whose end it was found
  Index<D> at{};                  // cell of the computed grid
  int axis = 0;                   // of the velocity
  double value = 0, limit = 0;    // m/s
  std::array<Index<D>, 2> box{};  // all such cells are in it, first and last cell
};

/// Thrown when the fields have diverged.
template <int D>
class DivergedFields : public Error {
 public:
  DivergedFields(const std::string& what, const Divergence<D>& first)
      : Error(what, ErrorKind::unstable), first_(first) {}
  const Divergence<D>& first() const { return first_; }

 private:
  Divergence<D> first_;
};

/// Checks all velocities every `every` steps; throws DivergedFields once one of them is not finite or beyond
/// what the energy of the shot allows.
template <int D, class Real>
class StabilityCheck {
 public:
  static constexpr std::int64_t every = 50;
  /// `limit` in m/s: largest_velocity() (scene/largest_velocity.hpp).
  StabilityCheck(const State<D, Real>& state, const Domain<D>& domain, double unit, double limit)
      : state_(state), domain_(domain), unit_(unit), limit_(limit) {}
  /// To be called when no step is in progress. Names the fastest cell, or where any is not finite the one in
  /// the middle of those: they spread alike to all sides.
  void check(const StepTime& time) const;
  /// The first step after `step` that ends with a check.
  static std::int64_t next_after(std::int64_t step) { return (step / every + 1) * every - 1; }
  /// Steps made at the last check before so many were made.
  static std::int64_t last_before(std::int64_t steps) { return (steps - 1) / every * every; }

 private:
  Divergence<D> first_of(const std::vector<char>& bad_lines, Real beyond) const;

  const State<D, Real>& state_;
  const Domain<D>& domain_;
  double unit_, limit_;
};

}  // namespace slipwave::solver
