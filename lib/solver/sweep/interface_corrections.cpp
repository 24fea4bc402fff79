// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/interface_corrections.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "scene/edges.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/row_waves.hpp"

namespace slipwave::solver {
namespace {

/// Ratio of P impedances from which a fluid is too light to hold a wave at the interface: over gas the energy
/// of thousands of steps would rise by a few millionths of what is left.
constexpr double gas_ratio = 100;
/// Cells of the interface needed to both sides along each axis: a shorter one holds no wave.
constexpr int fewest_along = 8;

/// Whether enough cells like this one lie behind it along z (`step` 1 or -1) and beside it.
template <int D>
bool extends_far(const Domain<D>& domain, const Index<D>& from, int step) {
  constexpr int z = D - 1;
  Index<D> at = from;
  const bool is_void = domain.impedance(wave_p)(from) == 0;
  for (std::int64_t n = 1; n < fewest_across && !is_void; ++n) {
    Index<D> next = at;
    next[z] += step;
    if (next[z] < 0 || next[z] >= domain.grid.shape[z] || !alike(domain, at, next)) return false;
    at = next;
  }
  for (int axis = 0; axis < z; ++axis) {
    const std::int64_t last = domain.grid.shape[std::size_t(axis)] - 1;
    if (thin(domain, axis)) {
      if (ends_free(domain, axis)) return false;
      continue;
    }
    const auto place = from[std::size_t(axis)];
    if (place + offsets_along.front() < 0 || place + offsets_along.back() > last) return false;
    for (auto n = std::max<std::int64_t>(0, place - fewest_along); n <= std::min(last, place + fewest_along);
         ++n) {
      Index<D> beside = from;
      beside[std::size_t(axis)] = n;
      if (!alike(domain, from, beside)) return false;
    }
  }
  return true;
}

/// Whether the face before a row bends.
template <int D>
bool curvilinear_face(const Domain<D>& domain, std::int64_t row) {
  return domain.curvilinear(row - 1) || domain.curvilinear(row);
}

/// Whether the faces before a row (in 3-D plane) part fluid from solid along all of it.
template <int D>
bool spans_grid(const Domain<D>& domain, std::int64_t row) {
  Grid<D> plane = domain.grid;
  plane.shape[D - 1] = 1;
  for (std::int64_t n = 0; n < plane.size(); ++n) {
    Index<D> below = plane.index(n), above = below;
    below[D - 1] = row, above[D - 1] = row - 1;
    if ((domain.impedance(wave_s)(above) > 0) == (domain.impedance(wave_s)(below) > 0)) return false;
  }
  return true;
}

/// Whether the cells before and behind the face before `below` meet at a fluid-solid interface, or in
/// curvilinear rows at the free surface of a solid, that extends far enough.
template <int D>
bool corrected(const Domain<D>& domain, const Index<D>& below) {
  Index<D> above = below;
  --above[D - 1];
  const auto carries = [&](Wave wave, const Index<D>& at) { return domain.impedance(wave)(at) > 0; };
  if (carries(wave_s, above) == carries(wave_s, below)) return false;
  const double z_above = domain.impedance(wave_p)(above), z_below = domain.impedance(wave_p)(below);
  if (z_above == 0 || z_below == 0) {
    // Level rows have FreeSurface.
    if (!domain.curvilinear(below[D - 1] - (z_below == 0 ? 1 : 0))) return false;
  } else if (z_above > gas_ratio * z_below || z_below > gas_ratio * z_above) {
    return false;
  }
  return extends_far(domain, above, -1) && extends_far(domain, below, 1);
}

/// Whether rows (in 3-D planes) of faces may be corrected: stairs of a regular grid are of first order
/// anyway, and its axes are alike.
template <int D>
bool followed(const Domain<D>& domain, std::int64_t row) {
  return curvilinear_face(domain, row) || spans_grid(domain, row);
}

template <int D>
Index<D> above(Index<D> at) {
  --at[D - 1];
  return at;
}
/// The difference of the velocity along an axis, between these cells.
template <int D, class Real>
std::array<Real, std::size_t(D)> difference_along(const std::int64_t* cells, const Real* fields,
                                                  std::int64_t pitch) {
  RowVector<D, Real> along{};
  for (std::size_t k = 0; k < offsets_along.size(); ++k)
    along = along + Real(weights_along[k]) * row_velocity<D>(fields + cells[k], pitch);
  return components<D>(along);
}

}  // namespace

template <int D>
bool corrects_interface(const Domain<D>& domain, const Index<D>& below) {
  return corrected(domain, below) && followed(domain, below[D - 1]);
}

template <int D, class Real>
InterfaceCorrections<D, Real>::InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain,
                                                    const Metric<D, Real>& metric)
    : padded_nx_(state.layout.padded_nx()) {
  constexpr int z = D - 1;
  const auto& shape = domain.grid.shape;
  Grid<D> plane = domain.grid;
  plane.shape[z] = 1;
  const auto& s_waves = domain.impedance(wave_s);
  const bool any = std::any_of(s_waves.begin(), s_waves.end(), [](float z) { return z == 0; });
  first_.assign(2, 0);
  for (std::int64_t row = 1; row < shape[z]; ++row) {
    const bool wanted = any && followed(domain, row);
    for (std::int64_t n = 0; wanted && n < plane.size(); ++n) {
      Index<D> at = plane.index(n);
      at[z] = row;
      if (!corrected(domain, at)) continue;
      Slot slot{row, D == 2 ? at[0] : at[1] * padded_nx_ + at[0], 0, {}};
      for (const int side : {0, 1}) {
        Index<D> cell = at;
        cell[z] += side - 1;
        auto& to = slot.sides[std::size_t(side)];
        for (int axis = 0; axis < z; ++axis)
          for (std::size_t k = 0; k < offsets_along.size(); ++k) {
            Index<D> beside = cell;
            if (!thin(domain, axis)) beside[axis] += offsets_along[k];
            to.cells[std::size_t(axis) * offsets_along.size() + k] = state.layout.cell(beside);
          }
        to.b = state.material_layout.cell(cell);
      }
      const auto matrices = matrices_of(domain, metric, at);
      // Cells along level rows share them.
      if (matrices_.empty() || !(matrices_.back() == matrices)) matrices_.push_back(matrices);
      slot.matrices = std::int32_t(matrices_.size()) - 1;
      slots_.push_back(slot);
    }
    first_.push_back(slots_.size());
  }
  for (auto* lists : {&velocities_, &tractions_})
    for (auto& list : *lists) list.assign(slots_.size(), 0);
}

/// On either side motion along the interface alone puts a traction on it. Velocities bend so that it stays
/// what it is, and half of a sweep along the interface has put half a step of it there.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::matrices_of(const Domain<D>& domain, const Metric<D, Real>& metric,
                                                const Index<D>& below) -> Matrices {
  using Square = SmallMatrix<std::size_t(D)>;
  constexpr int z = D - 1;
  constexpr std::size_t axes = D - 1;
  const std::int64_t row = below[z];
  Point<D> in_grid = unit_vector<std::size_t(D)>(std::size_t(z));
  for (int axis = 0; axis < z && metric.curvilinear_row(row) && metric.curvilinear_row(row - 1); ++axis) {
    Index<D> line = below;
    line[0] = 0;
    const auto of = metric.across(line, below[0]);
    in_grid[std::size_t(axis)] = 2 * double(of.half_n[axis * of.pitch]);
  }
  const auto n = in_pairs<D>(in_grid);
  const double square = dot_product(n, n);
  Square sum{};
  std::array<std::array<Square, axes>, 2> load{}, bend{};
  bool beside_void = false;
  Matrices found{};
  for (const std::size_t side : {0, 1}) {
    const auto cell = side ? below : above<D>(below);
    if (domain.impedance(wave_p)(cell) == 0) {
      beside_void = true;
      continue;
    }
    const auto c = elasticity_at(domain, cell);
    const auto impedance = impedance_across_rows<D>(c, in_grid);
    sum = sum_of(sum, impedance, 1.);
    double trace = 0;
    for (std::size_t i = 0; i < D; ++i) trace += impedance[i][i];
    // (T3): Z over the tensor is the density times the inverse of Z; of a fluid along the normal alone.
    Square of_fluid{};
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) of_fluid[i][k] = n[i] * n[k] / (trace * square);
    const auto over = domain.impedance(wave_s)(cell) > 0 ? inverse_of(impedance) : of_fluid;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      load[side][axis] = in_pairs<D>(tractions<D>(c, in_grid, unit_vector<std::size_t(D)>(axis)));
      bend[side][axis] = product_of(over, load[side][axis]);
    }
  }
  const auto share = inverse_of(sum);
  for (const std::size_t side : {0, 1}) {
    const auto cell = side ? below : above<D>(below);
    const double sign = side ? -1 : 1, j = double(metric.volume(cell)),
                 part = beside_void ? 1 : traction_share;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto velocity = product_of(share, bend[side][axis]);
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t k = 0; k < D; ++k) {
          const auto place = axis * D + k;
          found[side].velocity[i][place] = Real(-sign * j * velocity[i][k]);
          found[side].traction[i][place] = Real(-sign / 2 * part * load[side][axis][i][k]);
        }
    }
  }
  return found;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_slot(const State<D, Real>& state, std::size_t n) {
  const Slot& slot = slots_[n];
  std::array<Real, std::size_t(D)> velocity{}, traction{};
  for (const std::size_t which : {0, 1}) {
    const Side& side = slot.sides[which];
    const auto& of = matrices_[std::size_t(slot.matrices)][which];
    const Real b = state.material.data()[side.b];
    std::array<Real, differences> along;
    for (std::size_t axis = 0; axis < D - 1; ++axis) {
      const auto difference = difference_along<D>(side.cells.data() + axis * offsets_along.size(),
                                                  state.fields.data(), state.layout.row_pitch());
      std::copy(difference.begin(), difference.end(), along.begin() + std::ptrdiff_t(axis * D));
    }
    for (std::size_t i = 0; i < D; ++i) {
      Real bend = 0, load = 0;
      for (std::size_t k = 0; k < differences; ++k)
        bend += of.velocity[i][k] * along[k], load += of.traction[i][k] * along[k];
      velocity[i] += bend, traction[i] += b * load;
    }
  }
  for (std::size_t i = 0; i < D; ++i) velocities_[i][n] = velocity[i], tractions_[i][n] = traction[i];
}

template <int D, class Real>
std::int32_t InterfaceCorrections<D, Real>::slot(const Index<D>& below) const {
  const auto row = std::size_t(below[D - 1]);
  if (slots_.empty() || below[D - 1] < 1 || row + 1 >= first_.size()) return none;
  const std::int64_t column = D == 2 ? below[0] : below[1] * padded_nx_ + below[0];
  const auto found = first_at(row, column);
  return found < first_[row + 1] && slots_[found].column == column ? std::int32_t(found) : none;
}

/// The first slot of a row at this column or behind it.
template <int D, class Real>
std::size_t InterfaceCorrections<D, Real>::first_at(std::size_t row, std::int64_t column) const {
  const auto begin = slots_.begin() + std::ptrdiff_t(first_[row]),
             end = slots_.begin() + std::ptrdiff_t(first_[row + 1]);
  return std::size_t(
      std::lower_bound(begin, end, column,
                       [](const Slot& slot, std::int64_t wanted) { return slot.column < wanted; }) -
      slots_.begin());
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update(const State<D, Real>& state, std::int64_t row,
                                           const IndexRange& columns) {
  if (slots_.empty() || row < 1 || std::size_t(row) + 1 >= first_.size()) return;
  for (auto n = first_at(std::size_t(row), columns.first), end = first_[std::size_t(row) + 1];
       n < end && slots_[n].column < columns.last; ++n)
    update_slot(state, n);
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_all(const State<D, Real>& state) {
  for (std::size_t n = 0; n < slots_.size(); ++n) update_slot(state, n);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, corrects_interface);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class InterfaceCorrections);

}  // namespace slipwave::solver
