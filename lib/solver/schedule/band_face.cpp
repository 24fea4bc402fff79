// SPDX-License-Identifier: BSD-3-Clause
#include "solver/schedule/band_face.hpp"

#include <algorithm>

namespace slipwave::solver {
namespace {

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

}  // namespace

template <int D, class Real>
BandFace<D, Real>::BandFace(const Side& above, const Side& below, const EdgeLaws<D>& edges, int reach)
    : above_(above),
      below_(below),
      narrows_up_(shape(above)[0] > shape(below)[0]),
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
void BandFace<D, Real>::fill(const Side& from, const Side& to, std::int64_t row_from, std::int64_t row_to) {
  const bool narrows = from.state == wide().state;
  const auto each_line = [](const Side& side, std::int64_t row, auto&& act) {
    const auto& of = side.state->layout.shape();
    Index<D> at{};
    at[D - 1] = row;
    for (std::int64_t line = 0; line < (D == 3 ? of[1] : 1); ++line) {
      if (D == 3) at[1] = line;
      act(at, line * of[0], of[0]);
    }
  };
  for (int field = 0; field < from.state->layout.rows(); ++field) {
    values_.resize(std::size_t(shape(from)[0] * (D == 3 ? shape(from)[1] : 1)));
    each_line(from, row_from, [&](const Index<D>& at, std::int64_t first, std::int64_t nx) {
      const Real* const row = from.state->field_row(at, field);
      std::copy(row, row + nx, values_.begin() + first);
    });
    interpolate(narrows, field, values_);
    each_line(to, row_to, [&](const Index<D>& at, std::int64_t first, std::int64_t nx) {
      std::copy(values_.begin() + first, values_.begin() + first + nx, to.state->field_row(at, field));
    });
  }
}

/// Rows above the face are those of the band above.
template <int D, class Real>
void BandFace<D, Real>::fill_rows() {
  for (std::int64_t n = -1 - reach_; n <= reach_; ++n) {
    const auto &from = n < 0 ? above_ : below_, &to = n < 0 ? below_ : above_;
    fill(from, to, from.shared->row + n, to.shared->row + n);
  }
}

template <int D, class Real>
void BandFace<D, Real>::give_states() {
  auto &from = *narrow().shared, &to = *wide().shared;
  const auto &shape_from = shape(narrow()), &shape_to = shape(wide());
  for (std::int64_t state = 0; state < std::min(from.rows, to.rows); ++state) {
    values_.clear();
    for (std::int64_t line = 0; line < (D == 3 ? shape_from[1] : 1); ++line) {
      const Real* const first = from.of_line(line) + state * from.pitch;
      values_.insert(values_.end(), first, first + shape_from[0]);
    }
    interpolate(false, field_of_state<D>(state), values_);
    for (std::int64_t line = 0; line < (D == 3 ? shape_to[1] : 1); ++line)
      std::copy_n(values_.begin() + line * shape_to[0], shape_to[0], to.of_line(line) + state * to.pitch);
  }
}

template class BandFace<2, float>;
template class BandFace<2, double>;
template class BandFace<3, float>;
template class BandFace<3, double>;

}  // namespace slipwave::solver
