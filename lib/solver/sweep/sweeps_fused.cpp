#include <algorithm>

#include "solver/sweep/sweeps.hpp"

// Rows of sweeps across that need one loop only.
namespace slipwave::solver {

/// A row across in one loop, unless something comes between its parts: then it does nothing.
template <int D, class Real>
bool Sweeps<D, Real>::fused_row(int axis, const Index<D>& at, std::int64_t row, const IndexRange& columns,
                                Real scale, Ring<Real>& ring, Workspace<Real>& work) {
  const auto& layout = state_.layout;
  const std::int64_t x = columns.first, done = row - std::max(reach_, 1);
  if (D != 2 || !shear_ || done < 0 || row >= layout.shape()[axis]) return false;
  Index<D> here = at, below = at, brought = at;
  here[axis] = row, below[axis] = row - 1, brought[axis] = done;
  const auto number = layout.line_number(here);
  // One material is better off with loops of its own.
  if (state_.stretch(number, x, columns.last)) return false;
  // What leaves downwards is not kept, which cells inside one material would need.
  for (const auto& line : {here, below, brought})
    for (const auto& run : state_.uniform_interior[std::size_t(axis)].of(layout.line_number(line)))
      if (run.first < columns.last && run.last > columns.first) return false;
  for (const auto& ends : ends_[axis])
    if (ends.any(number, columns)) return false;
  if (layer_)
    for (const auto& part : layer_->covered(axis, brought, columns))
      if (!part.empty()) return false;
  const auto field = [&](int n) { return state_.field_row(here, changed_[axis][n]) + x; };
  const auto material = [&](const Index<D>& line) { return state_.material_row(line, row_b) + x; };
  const auto from = ring.leaving(row - 1, x), to = ring.leaving(row, x);
  const auto faces = ring.faces(row, x);
  work.coming().prefetch_one(), work.coming().prefetch_one();
  kernels_[false]->across(columns.count(), scale,
                          {{field(0), field(1), field(2), field(3), field(4)},
                           layout.stride(axis),
                           state_.material_layout.row_pitch(),
                           to.up(1) - to.up(0),
                           faces.pitch,
                           material(below),
                           material(here),
                           material(brought),
                           from.up(0),
                           to.up(0),
                           faces.first,
                           ring.faces(done, x).first,
                           ring.faces(done + 1, x).first});
  work.coming().prefetch_one(), work.coming().prefetch_one();
  return true;
}

template bool Sweeps<2, float>::fused_row(int, const Index<2>&, std::int64_t, const IndexRange&, float,
                                          Ring<float>&, Workspace<float>&);
template bool Sweeps<2, double>::fused_row(int, const Index<2>&, std::int64_t, const IndexRange&, double,
                                           Ring<double>&, Workspace<double>&);
template bool Sweeps<3, float>::fused_row(int, const Index<3>&, std::int64_t, const IndexRange&, float,
                                          Ring<float>&, Workspace<float>&);
template bool Sweeps<3, double>::fused_row(int, const Index<3>&, std::int64_t, const IndexRange&, double,
                                           Ring<double>&, Workspace<double>&);

}  // namespace slipwave::solver
