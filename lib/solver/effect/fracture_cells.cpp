// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/fracture_cells.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "model/cluster_edge.hpp"

namespace slipwave::solver {

template <int D>
FractureCells<D>::FractureCells(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model,
                                std::size_t set, CellKind kind)
    : set_(set), kind_(kind), continues_(continues_outside(model, set)) {
  std::vector<std::pair<std::int64_t, std::int64_t>> blocks;  // line, block of columns
  constexpr auto block = Layout<D>::block;
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    if (!belongs(model, cell)) continue;
    domain.each_like(model.grid().index(std::int64_t(cell)), continues_, [&](const Index<D>& at) {
      const std::pair in{layout.line_number(at), at[0] / block};
      if (blocks.empty() || blocks.back() != in) blocks.push_back(in);
      ++cells_;
    });
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  starts_.assign(std::size_t(layout.lines()) + 1, 0);
  std::int64_t line = -1, last = -1;
  for (const auto& [of_line, number] : blocks) {
    if (of_line != line || number * block != last) {
      segments_.push_back({number * block, 0, stored_});
      ++starts_[std::size_t(of_line) + 1];
    }
    line = of_line;
    segments_.back().last = last = (number + 1) * block;
    stored_ += std::size_t(block);
  }
  for (std::size_t n = 1; n < starts_.size(); ++n) starts_[n] += starts_[n - 1];
}

template <int D>
bool FractureCells<D>::belongs(const Model<D>& model, std::size_t cell) const {
  return model.fracture[cell] == set_ + 1 &&
         (kind_ == CellKind::all || is_cut(model, cell) == (kind_ == CellKind::cut));
}

template <int D>
void FractureCells<D>::each(const Layout<D>& layout, const Domain<D>& domain, const Model<D>& model,
                            const std::function<void(std::size_t, std::size_t, bool)>& with) const {
  for (std::int64_t line = 0; line < layout.lines(); ++line)
    for (const auto& segment : segments(line))
      for (std::int64_t x = segment.first; x < std::min(segment.last, layout.shape()[0]); ++x) {
        auto at = layout.line_index(line);
        at[0] = x;
        const auto cell = std::size_t(domain.model_grid.flat(domain.model_cell(at)));
        const bool inside = domain.in_model(at);
        if ((inside || continues_) && belongs(model, cell))
          with(segment.place + std::size_t(x - segment.first), cell, inside);
      }
}

SLIPWAVE_INSTANTIATE_D(TYPE, class FractureCells);

}  // namespace slipwave::solver
