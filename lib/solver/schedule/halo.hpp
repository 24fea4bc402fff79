// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The rows (in 3-D planes) beyond a process's own. It computes them too, so that within a time tile no
/// process waits for a neighbour; they go stale from their outer end and are refreshed with the neighbour's
/// own rows before the next tile reaches them. A rank needs the rows above it first and those below it last:
/// neighbours below run a little behind, by as much as a message takes, and then none waits for another
/// (docs/scaling.md).
template <int D, class Real>
class Halo {
 public:
  /// Gives access to the values of some rows that last from step to step.
  using Exchange =
      std::function<void(const IndexRange& rows, const std::function<void(Real*, std::int64_t)>& to)>;
  /// Keeps references. `memory` gives access to what effects retain of rows.
  Halo(Ranks& ranks, const Domain<D>& domain, State<D, Real>& state, const Exchange& memory);
  ~Halo();
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// Before a tile reaches these rows: refreshes those that neighbours own. Returns them, above and below.
  std::array<IndexRange, 2> before(const IndexRange& rows);
  /// Sends the neighbours the rows they wait for, when a tile has finished all rows before `now`, and had
  /// finished those before `earlier` at the last call.
  void after(std::int64_t earlier, std::int64_t now);
  /// Rows that are still valid after so many steps of a tile, when stale values spread by `spread` in each.
  IndexRange valid_rows(std::int64_t steps, const IndexRange& spread) const;
  std::int64_t memory_bytes() const;

 private:
  struct Side {
    int rank = -1;  // none: the grid ends here
    int tag_out = 0, tag_in = 0;
    IndexRange rows_out, rows_in;
    std::vector<std::span<Real>> out, in;
    std::array<std::vector<Real>, 2> sent;  // by turns
    std::array<std::unique_ptr<Message>, 2> sending;
    std::vector<Real> received;
    std::unique_ptr<Message> receiving;
    std::int64_t tiles_sent = 0;
    bool begun = false;  // nothing is received before the first tile: all fields are zero
  };
  void prepare(Side& side, int rank, State<D, Real>& state, const Exchange& memory);
  void receive(Side& side);
  void unpack(Side& side);
  void send(Side& side);

  Ranks& ranks_;
  IndexRange own_;
  std::int64_t exchanged_;
  std::array<Side, 2> sides_;  // above and below
};

}  // namespace slipwave::solver
