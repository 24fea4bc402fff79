// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/band_face.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {
namespace {

/// Lines along x of a row of cells.
template <std::size_t D>
std::int64_t lines_in(const std::array<std::int64_t, D>& shape) {
  return D == 3 ? shape[D - 2] : 1;
}

/// The field row that a state of a face is of, in the order of InterfaceStates.
template <int D>
int field_of_state(std::int64_t state) {
  constexpr int z = D - 1;
  const int pair = int(state / 2);
  if (pair >= D) return 0;  // what comes after the pairs has no edge law
  const int motion = pair == 0 ? z : axis_of_pair<D>(z, pair);
  if (state % 2 == 0) return FieldRows<D>::velocity(motion);
  return pair == 0 ? FieldRows<D>::normal_stress(z) : FieldRows<D>::shear_stress(motion, z);
}

/// Rows of the grid with wide columns that a part of one is found from, on each side of it.
constexpr int rows_beside_part = 2;

/// Weights of the means over 2 rows_beside_part + 1 rows in that of part `part` of `ratio` of the middle one:
/// of the polynomial whose integrals over the rows are theirs.
std::vector<double> weights_of_part(std::int64_t ratio, std::int64_t part) {
  constexpr int rows = 2 * rows_beside_part + 1;
  const double from = double(part) / double(ratio), to = double(part + 1) / double(ratio);
  std::vector<double> weights(rows, 0.);
  // Sums of rows at the faces -rows_beside_part to rows_beside_part + 1 and their Lagrange polynomials.
  for (int face = 1; face <= rows; ++face) {
    double integral = 0;
    for (const auto& [at, sign] : {std::pair(to, 1.), std::pair(from, -1.)}) {
      double value = 1;
      for (int other = 0; other <= rows; ++other)
        if (other != face) value *= (at + rows_beside_part - other) / double(face - other);
      integral += sign * value;
    }
    // The sum at a face is of all rows before it.
    for (int row = 0; row < face; ++row) weights[std::size_t(row)] += integral * double(ratio);
  }
  return weights;
}

}  // namespace

template <int D, class Real>
BandFace<D, Real>::BandFace(const Side& above, const Side& below, const EdgeLaws<D>& edges, int reach,
                            bool own_heights)
    : above_(above),
      below_(below),
      narrows_up_(shape(above)[0] > shape(below)[0]),
      own_heights_(own_heights),
      reach_(reach),
      edges_(edges) {
  wide().shared->given = true;
  for (int axis = 0; axis < D - 1; ++axis)
    columns_.emplace_back(int(shape(narrow())[axis] / shape(wide())[axis]), shape(wide())[axis]);
}

template <int D, class Real>
void BandFace<D, Real>::interpolate(bool narrows, int field_row, std::vector<Real>& values) {
  const auto signs = [&](int axis) {
    return typename BandColumns<Real>::Images{Real(image_sign<D>(edges_[axis][0], axis, field_row)),
                                              Real(image_sign<D>(edges_[axis][1], axis, field_row))};
  };
  const auto change = [&](int axis, const Real* from, std::int64_t stride_from, Real* to,
                          std::int64_t stride_to, std::int64_t lanes) {
    auto& columns = columns_[std::size_t(axis)];
    narrows ? columns.to_narrow(from, stride_from, to, stride_to, lanes, signs(axis))
            : columns.to_wide(from, stride_from, to, stride_to, lanes, signs(axis));
  };
  const auto nx_from = narrows ? columns_[0].wide() : columns_[0].narrow(),
             nx_to = narrows ? columns_[0].narrow() : columns_[0].wide();
  std::int64_t lines = 1;
  if constexpr (D == 3) {
    lines = narrows ? columns_[1].narrow() : columns_[1].wide();
    lines_.resize(std::size_t(lines * nx_from));
    change(1, values.data(), nx_from, lines_.data(), nx_from, nx_from);
    values.swap(lines_);
  }
  lines_.resize(std::size_t(lines * nx_to));
  for (std::int64_t line = 0; line < lines; ++line)
    change(0, values.data() + line * nx_from, 1, lines_.data() + line * nx_to, 1, 1);
  values.swap(lines_);
}

template <int D, class Real>
void BandFace<D, Real>::fill(const Side& from, const std::vector<Row>& sum, const Side& to,
                             std::int64_t row) {
  const bool narrows = from.state == wide().state;
  const auto each_line = [](const Side& side, std::int64_t of, auto&& act) {
    const auto& cells = shape(side);
    Index<D> at{};
    at[D - 1] = of;
    for (std::int64_t line = 0; line < lines_in(cells); ++line) {
      if (D == 3) at[1] = line;
      act(at, line * cells[0], cells[0]);
    }
  };
  // Sweeps along the last axis read no other fields of rows beyond their own.
  for (std::int64_t state = 0; state < (from.state->fluid ? 2 : 2 * D); ++state) {
    const int field = field_of_state<D>(state);
    values_.assign(std::size_t(shape(from)[0] * lines_in(shape(from))), Real(0));
    for (const auto& [of, weight] : sum)
      each_line(from, of, [&, weight = weight](const Index<D>& at, std::int64_t first, std::int64_t nx) {
        const Real* const values = from.state->field_row(at, field);
        for (std::int64_t i = 0; i < nx; ++i) values_[std::size_t(first + i)] += weight * values[i];
      });
    interpolate(narrows, field, values_);
    each_line(to, row, [&](const Index<D>& at, std::int64_t first, std::int64_t nx) {
      std::copy_n(values_.begin() + first, nx, to.state->field_row(at, field));
    });
  }
}

/// Rows above the face are those of the band above.
template <int D, class Real>
void BandFace<D, Real>::fill_rows() {
  if (own_heights_) return fill_as_high();
  for (std::int64_t n = -1 - reach_; n <= reach_; ++n) {
    const auto &from = n < 0 ? above_ : below_, &to = n < 0 ? below_ : above_;
    fill(from, {{from.shared->row + n, Real(1)}}, to, to.shared->row + n);
  }
}

/// A row of the grid with wide columns is as high as some of the other: it is their mean, and they are means
/// of a polynomial through sums over its rows (theory.md (B5)).
template <int D, class Real>
void BandFace<D, Real>::fill_as_high() {
  const auto ratio = std::int64_t(shape(narrow())[0] / shape(wide())[0]);
  // Row n of a grid, counted from the face into the other one.
  const auto row_of = [&](const Side& side, std::int64_t n) {
    const bool above = &side == &above_;
    return above ? side.shared->row + n : side.shared->row - 1 - n;
  };
  std::vector<Row> sum;
  for (std::int64_t n = 0; n <= std::max(reach_, rows_beside_part - 1); ++n) {
    sum.clear();
    for (auto of = -1 - n * ratio; of > -1 - (n + 1) * ratio; --of)
      sum.emplace_back(row_of(narrow(), of), 1 / Real(ratio));
    fill(narrow(), sum, wide(), row_of(wide(), n));
  }
  for (std::int64_t n = 0; n <= reach_; ++n) {
    sum.clear();
    const auto weights = weights_of_part(ratio, n % ratio);
    for (std::size_t m = 0; m < weights.size(); ++m)
      sum.emplace_back(row_of(wide(), -1 - n / ratio - (std::int64_t(m) - std::int64_t(weights.size()) / 2)),
                       Real(weights[m]));
    fill(wide(), sum, narrow(), row_of(narrow(), n));
  }
}

template <int D, class Real>
void BandFace<D, Real>::give_states() {
  auto &from = *narrow().shared, &to = *wide().shared;
  const auto &shape_from = shape(narrow()), &shape_to = shape(wide());
  for (std::int64_t state = 0; state < std::min(from.rows, to.rows); ++state) {
    values_.clear();
    for (std::int64_t line = 0; line < lines_in(shape_from); ++line) {
      const Real* const first = from.of_line(line) + state * from.pitch;
      values_.insert(values_.end(), first, first + shape_from[0]);
    }
    interpolate(false, field_of_state<D>(state), values_);
    for (std::int64_t line = 0; line < lines_in(shape_to); ++line)
      std::copy_n(values_.begin() + line * shape_to[0], shape_to[0], to.of_line(line) + state * to.pitch);
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class BandFace);

}  // namespace slipwave::solver
