// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/active_cells.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

using Words = std::uint64_t __attribute__((vector_size(16)));

/// Whether any of `count` values of these rows is not zero. Written in vectors: compilers leave it scalar.
template <class Real>
bool any_nonzero(const Real* first, std::int64_t count, std::int64_t pitch, int rows) {
  constexpr auto values = std::int64_t(sizeof(Words) / sizeof(Real));
  Words words{};
  for (int row = 0; row < rows; ++row) {
    const Real* const cells = first + row * pitch;
    std::int64_t i = 0;
    Words of{};
    for (; i + values <= count; i += values) {
      std::memcpy(&of, cells + i, sizeof of);
      words |= of;
    }
    if (i == count) continue;
    of = Words{};
    std::memcpy(&of, cells + i, std::size_t(count - i) * sizeof(Real));
    words |= of;
  }
  // The signs of zeros do not count.
  constexpr std::uint64_t sign = std::uint64_t{1} << 63, signs = sizeof(Real) == 8 ? sign : sign | sign >> 32;
  return ((words[0] | words[1]) & ~signs) != 0;
}

}  // namespace

template <int D, class Real>
void ActiveCells<D, Real>::mark(std::int64_t line, const IndexRange& columns, const Sweeps<D, Real>& sweeps) {
  char* const active = active_.data() + line * blocks_;
  const std::int64_t first = columns.first / block,
                     last = std::min((columns.last + block - 1) / block, blocks_);
  if (last <= first || !std::memchr(active + first, 0, std::size_t(last - first))) return;
  const Real* const fields = state_.field_row(state_.layout.line_index(line), 0);
  for (std::int64_t n = first; n < last; ++n) {
    if (active[n]) continue;
    // The last block of a row holds ghost cells, too.
    const std::int64_t count = std::min(block, state_.layout.shape()[0] - n * block);
    const bool any = any_nonzero(fields + n * block, count, state_.layout.row_pitch(), state_.layout.rows());
    active[n] = any || !sweeps.faces_at_rest(line, {n * block, n * block + count});
    if (active[n]) lines_[std::size_t(line)].add({std::int32_t(n), std::int32_t(n + 1)});
  }
}

template <int D, class Real>
void ActiveCells<D, Real>::serialize(Archive& archive) {
  archive.fixed(active_);
  for (std::size_t n = 0; n < active_.size(); ++n) {
    const auto block = std::int32_t(std::int64_t(n) % blocks_);
    if (active_[n]) lines_[n / std::size_t(blocks_)].add({block, block + 1});
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class ActiveCells);

}  // namespace slipwave::solver
