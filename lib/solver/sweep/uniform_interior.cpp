// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/uniform_interior.hpp"

#include "base/instantiate.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {
namespace {

/// A call for fewer cells costs more than their faces.
constexpr std::int64_t fewest_cells = 2 * Layout<2>::block;

/// The runs that both rows share with the same material.
template <class Real>
std::vector<UniformRun<Real>> common(std::span<const UniformRun<Real>> one,
                                     std::span<const UniformRun<Real>> other) {
  std::vector<UniformRun<Real>> both;
  for (auto a = one.begin(), b = other.begin(); a != one.end() && b != other.end();) {
    const auto first = std::max(a->first, b->first), last = std::min(a->last, b->last);
    if (first < last && a->same(*b)) {
      both.push_back(*a);
      both.back().first = first, both.back().last = last;
    }
    a->last < b->last ? ++a : ++b;
  }
  return both;
}

}  // namespace

void UniformInterior::add_line(std::span<const IndexRange> runs) {
  runs_.insert(runs_.end(), runs.begin(), runs.end());
  first_.push_back(runs_.size());
}

template <int D, class Real>
std::array<UniformInterior, std::size_t(D)> find_uniform_interior(const State<D, Real>& state) {
  constexpr std::int64_t block = Layout<D>::block;
  const auto& layout = state.layout;
  std::array<UniformInterior, D> all;
  std::vector<IndexRange> runs;
  for (int axis = 0; axis < D; ++axis)
    for (std::int64_t line = 0; line < layout.lines(); ++line) {
      runs.clear();
      const auto keep = [&](std::span<const UniformRun<Real>> found, std::int64_t beside) {
        for (const auto& of : found) {
          const IndexRange run{(of.first + beside + block - 1) / block * block,
                               (of.last - beside) / block * block};
          // The impedance of void cannot be divided by.
          if (run.count() >= fewest_cells && of.zp > 0) runs.push_back(run);
        }
      };
      const auto of_line = state.uniform_runs_of(line);
      auto at = layout.line_index(line);
      const auto row = at[std::size_t(axis)];
      const auto beside = [&](std::int64_t k) {
        at[std::size_t(axis)] = k;
        return state.uniform_runs_of(layout.line_number(at));
      };
      if (axis == 0)
        keep(of_line, 1);
      else if (!of_line.empty() && row > 0 && row + 1 < layout.shape()[std::size_t(axis)])
        keep(common<Real>(common(of_line, beside(row - 1)), beside(row + 1)), 0);
      all[std::size_t(axis)].add_line(runs);
    }
  return all;
}

SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, find_uniform_interior);

}  // namespace slipwave::solver
