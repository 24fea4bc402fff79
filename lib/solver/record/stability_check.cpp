// SPDX-License-Identifier: BSD-3-Clause
#include "solver/record/stability_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver {
namespace {

template <class Real>
bool sound(Real velocity, Real beyond) {
  return std::abs(velocity) <= beyond;  // NaN is not
}

template <int D>
std::int64_t apart(const Index<D>& a, const Index<D>& b) {
  std::int64_t sum = 0;
  for (std::size_t axis = 0; axis < D; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

}  // namespace

template <int D, class Real>
void StabilityCheck<D, Real>::check(const StepTime& time) const {
  using Limits = std::numeric_limits<Real>;
  const double limit = limit_ * unit_;
  const Real beyond = limit < Limits::max() ? std::max(Real(limit), Limits::min()) : Limits::max();
  const std::int64_t lines = state_.layout.lines(), nx = state_.layout.shape()[0];
  std::vector<char> bad_lines(std::size_t(lines), 0);
  parallel_for(lines, 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      if (!domain_.owns(state_.layout.line_index(line)[D - 1])) continue;
      bool bad = false;
      for (int axis = 0; axis < D; ++axis) {
        const Real* v = state_.field_row(state_.layout.line_index(line), FieldRows<D>::velocity(axis));
        for (std::int64_t i = 0; i < nx; ++i) bad |= !sound(v[i], beyond);
      }
      bad_lines[std::size_t(line)] = bad;
    }
  });
  if (std::find(bad_lines.begin(), bad_lines.end(), 1) == bad_lines.end()) return;
  Divergence<D> first = first_of(bad_lines, beyond);
  first.time = time;
  throw DivergedFields<D>("the simulation became unstable at " +
                              place_of(domain_.grid, domain_.grid.flat(first.at)) +
                              ", t=" + shown(time.end_s(), 6) + " s (step " + std::to_string(time.step + 1) +
                              "): v" + std::string(1, axis_names<D>()[std::size_t(first.axis)]) + " is " +
                              (std::isfinite(first.value) ? shown(first.value, 3) + " m/s" : "not finite") +
                              " (limit " + shown(first.limit, 3) + " m/s)",
                          first);
}

template <int D, class Real>
Divergence<D> StabilityCheck<D, Real>::first_of(const std::vector<char>& bad_lines, Real beyond) const {
  const auto each_bad = [&](auto&& see) {
    for (std::int64_t line = 0; line < std::int64_t(bad_lines.size()); ++line) {
      if (!bad_lines[std::size_t(line)]) continue;
      Index<D> at = state_.layout.line_index(line);
      for (int axis = 0; axis < D; ++axis) {
        const Real* v = state_.field_row(state_.layout.line_index(line), FieldRows<D>::velocity(axis));
        for (at[0] = 0; at[0] < state_.layout.shape()[0]; ++at[0])
          if (!sound(v[at[0]], beyond)) see(at, axis, double(v[at[0]]));
      }
    }
  };
  Divergence<D> first;
  first.limit = limit_;
  std::array<Index<D>, 2> not_finite;
  bool any = false, any_not_finite = false;
  const auto widen = [](std::array<Index<D>, 2>& box, bool& begun, const Index<D>& at) {
    for (std::size_t axis = 0; axis < D; ++axis) {
      box[0][axis] = begun ? std::min(box[0][axis], at[axis]) : at[axis];
      box[1][axis] = begun ? std::max(box[1][axis], at[axis]) : at[axis];
    }
    begun = true;
  };
  const auto take = [&](const Index<D>& at, int axis, double value) {
    first.at = at;
    first.axis = axis;
    first.value = value / unit_;
  };
  double fastest = 0;
  each_bad([&](const Index<D>& at, int axis, double value) {
    widen(first.box, any, at);
    if (!std::isfinite(value)) return widen(not_finite, any_not_finite, at);
    if (std::abs(value) > std::exchange(fastest, std::max(fastest, std::abs(value)))) take(at, axis, value);
  });
  if (!any_not_finite) return first;
  Index<D> middle;
  for (std::size_t axis = 0; axis < D; ++axis) middle[axis] = (not_finite[0][axis] + not_finite[1][axis]) / 2;
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  each_bad([&](const Index<D>& at, int axis, double value) {
    if (std::isfinite(value) || apart<D>(at, middle) >= nearest) return;
    nearest = apart<D>(at, middle);
    take(at, axis, value);
  });
  return first;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class StabilityCheck);

}  // namespace slipwave::solver
