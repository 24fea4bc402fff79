// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/patches.hpp"

#include <algorithm>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

constexpr std::int64_t block = Layout<2>::block;
/// Patches closer to each other, or to an end of the line, than this are one, or not worth it. Counted from
/// cells and not from blocks: a mirrored scene has mirrored patches.
constexpr std::int64_t least_gap = 4 * block;

}  // namespace

template <int D>
Patches<D>::Patches(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model) {
  // Cells by which a sweep spreads: those that are near the next cell.
  const std::int64_t reach = nearness_of(domain.order) + 1;
  std::vector<std::vector<IndexRange>> all(std::size_t(layout.lines()));
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    if (model.fracture[cell] == 0) continue;
    const bool continues = continues_outside(model, model.fracture[cell] - 1u);
    domain.each_like(model.grid().index(std::int64_t(cell)), continues, [&](const Index<D>& at) {
      auto& of_line = all[std::size_t(layout.line_number(at))];
      if (of_line.empty() || at[0] - reach - of_line.back().last >= least_gap)
        of_line.push_back({at[0] - reach, 0});
      of_line.back().last = at[0] + reach + 1;
    });
  }
  // Copies of a line know neither its ends nor the memory of the PML there.
  const std::int64_t nx = layout.shape()[0], low = domain.low_zone[0];
  const IndexRange inside = {std::max(low + 2 * margin, least_gap),
                             std::min(low + domain.model_grid.shape[0] - 2 * margin, nx - least_gap)};
  for (std::int64_t line = 0; line < layout.lines(); ++line) {
    starts_.push_back(patches_.size());
    const auto& of_line = all[std::size_t(line)];
    if (of_line.empty()) continue;
    std::int64_t work = 0;
    for (const auto& cells : of_line) work += 2 * (cells.count() + least_gap);
    if (work > nx || of_line.front().first < inside.first || of_line.back().last > inside.last) {
      whole_lines_.push_back(line);
      continue;
    }
    for (const auto& cells : of_line)
      patches_.push_back({cells, {cells.first / block * block, (cells.last + block - 1) / block * block}});
  }
  starts_.push_back(patches_.size());
}

SLIPWAVE_INSTANTIATE_D(TYPE, class Patches);

}  // namespace slipwave::solver
