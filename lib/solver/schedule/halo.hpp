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

/// The rows (in 3-D planes) beyond a process's own. It computes them too, so that within a pass nobody waits
/// for a neighbour; what is stale in them is refreshed with the neighbour's own rows before the next
/// pass comes to them. A rank needs the rows above it first and those below it last: neighbours below run a
/// little behind, by as much as a message takes, and then none waits for another (docs/scaling.md).
template <int D, class Real>
class Halo {
 public:
  /// Shows values of some rows that go from step to step.
  using Show =
      std::function<void(const IndexRange& rows, const std::function<void(Real*, std::int64_t)>& to)>;
  /// Keeps references. `memory` shows what passes remember of rows, fields apart.
  Halo(Ranks& ranks, const Domain<D>& domain, State<D, Real>& state, const Show& memory);
  ~Halo();
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// Before a pass comes to these rows: refreshes those of them that are the neighbours'. They are returned,
  /// above and below.
  std::array<IndexRange, 2> before(const IndexRange& rows);
  /// When a pass has brought all rows before `now` to its end, and had those before `earlier` at the last
  /// call: hands those to the neighbours that they wait for.
  void after(std::int64_t earlier, std::int64_t now);
  /// Rows that are still right after so many steps of a pass, where what is wrong spreads by so many in each.
  IndexRange right_after(std::int64_t steps, const IndexRange& spread) const;
  std::int64_t memory_bytes() const;

 private:
  struct Side {
    int rank = -1;  // none: the grid ends here
    int tag_out = 0, tag_in = 0;
    IndexRange rows_out, rows_in;
    std::vector<std::span<Real>> out, in;
    std::array<std::vector<Real>, 2> sent;  // by turns
    std::array<std::unique_ptr<Message>, 2> sending;
    std::vector<Real> come;
    std::unique_ptr<Message> coming;
    std::int64_t passes_out = 0;
    bool begun = false;  // nothing comes before the first pass: all fields are zero
  };
  void prepare(Side& side, int rank, State<D, Real>& state, const Show& memory);
  void expect(Side& side);
  void take(Side& side);
  void hand_out(Side& side);

  Ranks& ranks_;
  IndexRange own_;
  std::int64_t exchanged_;
  std::array<Side, 2> sides_;  // above and below
};

}  // namespace slipwave::solver
