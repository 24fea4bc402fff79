#pragma once

#include "gather/trace.hpp"
#include "scene/scene.hpp"
#include "solver/domain.hpp"
#include "solver/pass.hpp"
#include "solver/recorder.hpp"

namespace slipwave::solver {

/// Looks at all velocities every `every` steps; throws an Error of kind unstable that says when and where
/// once one of them is not finite or beyond what any source could make.
template <int D, class Real>
class Monitor : public Pass {
 public:
  static constexpr std::int64_t every = 50;
  Monitor(const State<D, Real>& state, const Domain<D>& domain) : state_(state), domain_(domain) {}
  void run(const StepTime& time) override;
  std::string name() const override { return "stability watch"; }
  std::int64_t cells() const override { return domain_.grid.size() / every; }

 private:
  const State<D, Real>& state_;
  const Domain<D>& domain_;
};

/// The model's part of one component of the wave field, line by line as it stands whole.
template <int D, class Real>
Field<D> field_of(const Layout<D>& layout, const Domain<D>& domain, const WholeLine<Real>& whole_line,
                  Component component);

}  // namespace slipwave::solver
