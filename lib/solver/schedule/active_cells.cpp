#include "solver/schedule/active_cells.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace slipwave::solver {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }
std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

template <int D, class Real>
void ActiveCells<D, Real>::mark(std::int64_t line, const IndexRange& columns) {
  using Bits = decltype(bits_of(Real()));
  char* const active = active_.data() + line * blocks_;
  const std::int64_t last = std::min((columns.last + block - 1) / block, blocks_);
  const Real* const fields = state_.field_row(state_.layout.line_index(line), 0);
  for (std::int64_t n = columns.first / block; n < last; ++n) {
    if (active[n]) continue;
    // The last block of a row holds ghost cells, too.
    const std::int64_t count = std::min(block, state_.layout.shape()[0] - n * block);
    Bits any = 0;
    for (int row = 0; row < FieldRows<D>::count; ++row) {
      const Real* const cells = fields + row * state_.layout.row_pitch() + n * block;
      for (std::int64_t i = 0; i < count; ++i) any |= bits_of(cells[i]);
    }
    active[n] = Bits(any << 1) != 0;  // all but the signs
  }
}

template class ActiveCells<2, float>;
template class ActiveCells<2, double>;
template class ActiveCells<3, float>;
template class ActiveCells<3, double>;

}  // namespace slipwave::solver
