#pragma once

#include <functional>

#include "gather/trace.hpp"
#include "scene/scene.hpp"
#include "solver/domain.hpp"
#include "solver/pass.hpp"

namespace slipwave::solver {

/// Looks at all velocities every `every` steps; throws an Error of kind unstable that says when and where
/// once one of them is not finite or beyond what any source could make.
template <int D, class Real>
class Monitor {
 public:
  static constexpr std::int64_t every = 50;
  Monitor(const State<D, Real>& state, const Domain<D>& domain, double unit)
      : state_(state), domain_(domain), unit_(unit) {}
  /// To be called when no step is under way.
  void look(const StepTime& time) const;
  /// The first step after `step` that ends with a look.
  static std::int64_t next_after(std::int64_t step) { return (step / every + 1) * every - 1; }

 private:
  const State<D, Real>& state_;
  const Domain<D>& domain_;
  double unit_;
};

/// Where the fields of a line stand whole at the end of a step: cell 0 of row 0.
template <class Real>
using WholeLine = std::function<const Real*(std::int64_t line)>;

/// The model's part of one component of the wave field, line by line as it stands whole.
template <int D, class Real>
Field<D> field_of(const Layout<D>& layout, const Domain<D>& domain, const WholeLine<Real>& whole_line,
                  Component component, double unit);

}  // namespace slipwave::solver
