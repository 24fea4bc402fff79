#include "solver/monitor.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "solver/point_access.hpp"

namespace slipwave::solver {

template <int D, class Real>
void Monitor<D, Real>::look(const StepTime& time) const {
  const Real beyond = Real(1e30 * unit_);
  const std::int64_t lines = state_.layout.lines(), nx = state_.layout.shape()[0];
  std::vector<char> bad_lines(std::size_t(lines), 0);
  parallel_for(lines, 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      bool bad = false;
      for (int axis = 0; axis < D; ++axis) {
        const Real* v = state_.field_row(state_.layout.line_index(line), FieldRows<D>::velocity(axis));
        for (std::int64_t i = 0; i < nx; ++i) bad |= !(std::abs(v[i]) < beyond);
      }
      bad_lines[std::size_t(line)] = bad;
    }
  });
  const std::int64_t first_bad = std::find(bad_lines.begin(), bad_lines.end(), 1) - bad_lines.begin();
  if (first_bad == lines) return;
  Index<D> at = state_.layout.line_index(first_bad);
  for (int axis = 0; axis < D; ++axis) {
    const Real* v = state_.field_row(state_.layout.line_index(first_bad), FieldRows<D>::velocity(axis));
    for (at[0] = 0; at[0] < nx; ++at[0]) {
      if (std::abs(v[at[0]]) < beyond) continue;
      throw Error("the simulation became unstable: v" + std::string(1, axis_names<D>()[std::size_t(axis)]) +
                      " is " + shown(double(v[at[0]]) / unit_) + " at " +
                      place_of(domain_.grid, domain_.grid.flat(at)) + ", t=" + shown(time.end_s()) +
                      " s (step " + std::to_string(time.step + 1) + "), expected it finite",
                  ErrorKind::unstable);
    }
  }
}

template <int D, class Real>
Field<D> field_of(const Layout<D>& layout, const Domain<D>& domain, const WholeLine<Real>& whole_line,
                  Component component, double unit) {
  Field<D> field(domain.model_grid);
  const std::int64_t nx = domain.model_grid.shape[0], lines = domain.model_grid.size() / nx;
  const auto pitch = layout.row_pitch();
  parallel_for(lines, 8, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t line = begin; line < end; ++line) {
      const Index<D> first = domain.computed_cell(domain.model_grid.index(line * nx));
      const Real* cells = whole_line(layout.line_number(first)) + first[0];
      auto out = field.line(line);
      for (std::int64_t i = 0; i < nx; ++i) {
        double value = 0;
        if (component == Component::p) {
          for (int axis = 0; axis < D; ++axis)
            value -= cells[FieldRows<D>::normal_stress(axis) * pitch + i] / D;
        } else {
          value = cells[row_of<D>(component) * pitch + i];
        }
        out[std::size_t(i)] = float(value / unit);
      }
    }
  });
  return field;
}

template class Monitor<2, float>;
template class Monitor<2, double>;
template Field<2> field_of(const Layout<2>&, const Domain<2>&, const WholeLine<float>&, Component, double);
template Field<2> field_of(const Layout<2>&, const Domain<2>&, const WholeLine<double>&, Component, double);

}  // namespace slipwave::solver
