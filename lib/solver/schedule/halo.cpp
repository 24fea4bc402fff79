// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/halo.hpp"

#include <algorithm>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave::solver {

template <int D, class Real>
Halo<D, Real>::Halo(Ranks& ranks, const Domain<D>& domain, State<D, Real>& state, const Exchange& memory)
    : ranks_(ranks), own_(domain.own), exchanged_(domain.subdomain.exchanged) {
  auto& [above, below] = sides_;
  above.rows_in = {own_.first - exchanged_, own_.first};
  above.rows_out = {own_.first, own_.first + exchanged_};
  below.rows_in = {own_.last, own_.last + exchanged_};
  below.rows_out = {own_.last - exchanged_, own_.last};
  // Up goes under one tag, down under the other.
  above.tag_out = below.tag_in = 0;
  below.tag_out = above.tag_in = 1;
  if (domain.subdomain.continues(0)) prepare(above, ranks.number() - 1, state, memory);
  if (domain.subdomain.continues(1)) prepare(below, ranks.number() + 1, state, memory);
}

template <int D, class Real>
void Halo<D, Real>::prepare(Side& side, int rank, State<D, Real>& state, const Exchange& memory) {
  side.rank = rank;
  const auto all_of = [&](const IndexRange& rows, std::vector<std::span<Real>>& to) {
    const auto add = [&](Real* values, std::int64_t count) { to.emplace_back(values, std::size_t(count)); };
    const auto& layout = state.layout;
    const auto lines_a_row = layout.lines() / layout.shape()[D - 1];
    for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
      add(state.field_row(layout.line_index(line), 0), layout.rows() * layout.row_pitch() - Layout<D>::lead);
    memory(rows, add);
  };
  all_of(side.rows_out, side.out);
  all_of(side.rows_in, side.in);
  const auto values = [](const auto& spans) {
    std::size_t sum = 0;
    for (const auto& span : spans) sum += span.size();
    return sum;
  };
  for (auto& sent : side.sent) sent.resize(values(side.out));
  side.received.resize(values(side.in));
  receive(side);
}

template <int D, class Real>
Halo<D, Real>::~Halo() {
  // The last tile has been sent like the others.
  for (auto& side : sides_) {
    if (side.receiving && side.tiles_sent > 0) wait_for(*side.receiving);
    for (auto& message : side.sending)
      if (message) wait_for(*message);
  }
}

template <int D, class Real>
void Halo<D, Real>::receive(Side& side) {
  side.receiving =
      ranks_.receive(side.rank, side.tag_in, std::as_writable_bytes(std::span<Real>(side.received)));
}

template <int D, class Real>
void Halo<D, Real>::unpack(Side& side) {
  wait_for(*side.receiving);
  const Real* from = side.received.data();
  for (const auto& span : side.in) {
    std::copy(from, from + span.size(), span.begin());
    from += span.size();
  }
  receive(side);
}

template <int D, class Real>
void Halo<D, Real>::send(Side& side) {
  const auto turn = std::size_t(side.tiles_sent++ % 2);
  if (side.sending[turn]) wait_for(*side.sending[turn]);
  Real* to = side.sent[turn].data();
  for (const auto& span : side.out) to = std::copy(span.begin(), span.end(), to);
  side.sending[turn] =
      ranks_.send(side.rank, side.tag_out, std::as_bytes(std::span<const Real>(side.sent[turn])));
}

template <int D, class Real>
std::array<IndexRange, 2> Halo<D, Real>::before(const IndexRange& rows) {
  std::array<IndexRange, 2> refreshed{};
  for (std::size_t n = 0; n < sides_.size(); ++n) {
    auto& side = sides_[n];
    const auto first = side.rows_in.first;
    if (side.rank < 0 || first < rows.first || first >= rows.last) continue;
    if (std::exchange(side.begun, true)) {
      unpack(side);
      refreshed[n] = side.rows_in;
    }
  }
  return refreshed;
}

template <int D, class Real>
void Halo<D, Real>::after(std::int64_t earlier, std::int64_t now) {
  for (auto& side : sides_)
    if (side.rank >= 0 && earlier < side.rows_out.last && now >= side.rows_out.last) send(side);
}

template <int D, class Real>
IndexRange Halo<D, Real>::valid_rows(std::int64_t steps, const IndexRange& spread) const {
  IndexRange rows = own_;
  if (sides_[0].rank >= 0) rows.first -= exchanged_ - steps * spread.first;
  if (sides_[1].rank >= 0) rows.last += exchanged_ - steps * spread.last;
  return rows;
}

template <int D, class Real>
std::int64_t Halo<D, Real>::memory_bytes() const {
  std::size_t values = 0;
  for (const auto& side : sides_) values += side.received.size() + side.sent[0].size() + side.sent[1].size();
  return std::int64_t(values * sizeof(Real));
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Halo);

}  // namespace slipwave::solver
