// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/state.hpp"

#include <sys/mman.h>

#include <span>

#include "base/instantiate.hpp"
#include "base/memory.hpp"

namespace slipwave::solver {
namespace {

std::int64_t rounded_up(std::int64_t n, std::int64_t to) { return (n + to - 1) / to * to; }

}  // namespace

void prefer_large_pages(void* first, std::size_t bytes) {
  // Where the system has none, all stays as it is.
  (void)madvise(first, bytes, MADV_HUGEPAGE);
}

template <int D>
Layout<D>::Layout(const Index<D>& shape, int rows_a_line) : shape_(shape), rows_(rows_a_line) {
  padded_nx_ = rounded_up(shape[0], block);
  row_pitch_ = lead + padded_nx_ + block;
  // Rows a multiple of 4 KiB apart would fall into the same few sets of the cache.
  while (row_pitch_ % 1024 == 0 || (rows_a_line * row_pitch_) % 1024 == 0) row_pitch_ += block;
  std::int64_t stride = rows_a_line * row_pitch_;
  strides_[0] = 1;
  for (int axis = 1; axis < D; ++axis) {
    strides_[axis] = stride;
    stride *= shape[axis] + 2 * ghost_lines;
  }
  total_ = stride;
}

template <int D>
std::int64_t Layout<D>::lines() const {
  std::int64_t count = 1;
  for (int axis = 1; axis < D; ++axis) count *= shape_[axis];
  return count;
}

template <int D>
Index<D> Layout<D>::line_index(std::int64_t n) const {
  Index<D> at{};
  for (int axis = 1; axis + 1 < D; ++axis) {
    at[axis] = n % shape_[axis];
    n /= shape_[axis];
  }
  at[D - 1] = n;
  return at;
}

template <class Real>
void clear_untouched(Buffer<Real>& buffer) {
  clear_and_release(std::as_writable_bytes(std::span(buffer.data(), std::size_t(buffer.size()))));
}

template <int D, class Real>
State<D, Real> make_state(const Index<D>& shape, MaterialKind material) {
  State<D, Real> state;
  state.kind = material;
  state.anisotropic = material >= MaterialKind::anisotropic;
  state.fluid = material == MaterialKind::fluid;
  state.layout = Layout<D>(shape, FieldRows<D>::of(material));
  state.material_layout = Layout<D>(shape, material_rows_of<D>(material));
  state.fields = Buffer<Real>(state.layout.total());
  state.material = Buffer<Real>(state.material_layout.total());
  clear_untouched(state.fields);
  clear_untouched(state.material);
  state.first_uniform_run.assign(std::size_t(state.layout.lines()) + 1, 0);
  return state;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class Layout);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, make_state);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, clear_untouched);

}  // namespace slipwave::solver
