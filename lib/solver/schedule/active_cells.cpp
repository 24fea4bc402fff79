// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/active_cells.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }
std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

template <int D, class Real>
void ActiveCells<D, Real>::mark(std::int64_t line, const IndexRange& columns, const Sweeps<D, Real>& sweeps) {
  using Bits = decltype(bits_of(Real()));
  char* const active = active_.data() + line * blocks_;
  const std::int64_t first = columns.first / block,
                     last = std::min((columns.last + block - 1) / block, blocks_);
  if (last <= first || !std::memchr(active + first, 0, std::size_t(last - first))) return;
  const Real* const fields = state_.field_row(state_.layout.line_index(line), 0);
  for (std::int64_t n = first; n < last; ++n) {
    if (active[n]) continue;
    // The last block of a row holds ghost cells, too.
    const std::int64_t count = std::min(block, state_.layout.shape()[0] - n * block);
    Bits any = 0;
    for (int row = 0; row < state_.layout.rows() && any == 0; ++row) {
      const Real* const cells = fields + row * state_.layout.row_pitch() + n * block;
      for (std::int64_t i = 0; i < count; ++i) any |= Bits(bits_of(cells[i]) << 1);  // all but the signs
    }
    active[n] = any != 0 || !sweeps.faces_at_rest(line, {n * block, n * block + count});
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
