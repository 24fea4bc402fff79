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

/// The share that is taken out of what half a sweep along the interface of fluid and solid leaves on it: with
/// one half waves bound to it keep their speed best (theory.md (E11a)). At free surfaces it is all.
constexpr double traction_share = 0.5;
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
bool bent_face(const Domain<D>& domain, std::int64_t row) {
  return domain.bent(row - 1) || domain.bent(row);
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

/// Whether the cells before and behind the face before `below` meet at a fluid-solid interface, or in bent
/// rows at the free surface of a solid, that extends far enough.
template <int D>
bool corrected(const Domain<D>& domain, const Index<D>& below) {
  Index<D> above = below;
  --above[D - 1];
  const auto carries = [&](Wave wave, const Index<D>& at) { return domain.impedance(wave)(at) > 0; };
  if (carries(wave_s, above) == carries(wave_s, below)) return false;
  const double z_above = domain.impedance(wave_p)(above), z_below = domain.impedance(wave_p)(below);
  if (z_above == 0 || z_below == 0) {
    // Level rows have FreeSurface.
    if (!domain.bent(below[D - 1] - (z_below == 0 ? 1 : 0))) return false;
  } else if (z_above > gas_ratio * z_below || z_below > gas_ratio * z_above) {
    return false;
  }
  return extends_far(domain, above, -1) && extends_far(domain, below, 1);
}

template <int D>
Index<D> above(Index<D> at) {
  --at[D - 1];
  return at;
}
/// Differences of the velocity along x and, in 3-D, y.
template <int D, class Real, std::size_t N>
std::array<RowVector<D, Real>, std::size_t(D - 1)> differences_along(const std::array<std::int64_t, N>& cells,
                                                                     const Real* fields, std::int64_t pitch) {
  std::array<RowVector<D, Real>, std::size_t(D - 1)> along{};
  for (std::size_t axis = 0; axis < D - 1; ++axis)
    for (std::size_t k = 0; k < offsets_along.size(); ++k)
      along[axis] = along[axis] + Real(weights_along[k]) *
                                      row_velocity<D>(fields + cells[axis * offsets_along.size() + k], pitch);
  return along;
}

}  // namespace

template <int D, class Real>
InterfaceCorrections<D, Real>::InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain,
                                                    const Metric<D, Real>& metric)
    : padded_nx_(state.layout.padded_nx()),
      material_pitch_(state.material_layout.row_pitch()),
      zs_y_row_(s_row<D>(state.kind, 1, D - 1)),
      coupling_y_row_(coupling_row<D>(state.kind, 1, D - 1)) {
  constexpr int z = D - 1;
  const auto& shape = domain.grid.shape;
  Grid<D> plane = domain.grid;
  plane.shape[z] = 1;
  const auto& s_waves = domain.impedance(wave_s);
  const bool any = std::any_of(s_waves.begin(), s_waves.end(), [](float z) { return z == 0; });
  first_.assign(2, 0);
  for (std::int64_t row = 1; row < shape[z]; ++row) {
    // Stairs of a regular grid are of first order anyway, and its axes are alike.
    const bool wanted = any && (bent_face(domain, row) || spans_grid(domain, row));
    for (std::int64_t n = 0; wanted && n < plane.size(); ++n) {
      Index<D> at = plane.index(n);
      at[z] = row;
      if (!corrected(domain, at)) continue;
      Slot slot{row, D == 2 ? at[0] : at[1] * padded_nx_ + at[0], none, {}, {}};
      const bool bent = metric.bent_row(row) && metric.bent_row(row - 1);
      for (int axis = 0; axis < z && bent; ++axis) {
        Index<D> line = at;
        line[0] = 0;
        const auto of = metric.across(line, at[0]);
        slot.normal[std::size_t(axis)] = 2 * of.half_n[axis * of.pitch];
      }
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
        to.j = metric.volume(cell);
        to.coupled = domain.anisotropic() && !bent_face(domain, row);
      }
      // Level rows know what upright rock does.
      const auto by_matrices = [&](const Index<D>& cell) {
        return bent_face(domain, row) ? anisotropic_across_rows(domain, cell)
                                      : domain.anisotropic_cell(cell) != nullptr;
      };
      if (by_matrices(at) || by_matrices(above<D>(at))) {
        RowVector<D, double> normal{};
        normal.z = 1, normal.x = double(slot.normal[0]);
        if constexpr (D == 3) normal.y = double(slot.normal[1]);
        slot.matrices = add_matrices(state, domain, metric, at, normal);
      }
      slots_.push_back(slot);
    }
    first_.push_back(slots_.size());
  }
  for (auto* lists : {&velocities_, &tractions_})
    for (auto& list : *lists) list.assign(slots_.size(), 0);
}

/// Adds the matrices of a face beside anisotropic cells and returns their number: the sums of update_slot()
/// with impedances and tensors of the vector N.
template <int D, class Real>
std::int32_t InterfaceCorrections<D, Real>::add_matrices(const State<D, Real>& state, const Domain<D>& domain,
                                                         const Metric<D, Real>& metric, const Index<D>& below,
                                                         const RowVector<D, double>& normal) {
  using Square = SmallMatrix<std::size_t(D)>;
  constexpr std::size_t axes = D - 1;
  const auto n = components<D>(normal);
  const auto in_grid = normal_in_grid<D>(normal);
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
    const auto z = impedance_across_rows<D>(c, in_grid);
    sum = sum_of(sum, z, 1.);
    double trace = 0;
    for (std::size_t i = 0; i < D; ++i) trace += z[i][i];
    // (T3): Z over the tensor is the density times the inverse of Z; of a fluid along the normal alone.
    Square of_fluid{};
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) of_fluid[i][k] = n[i] * n[k] / (trace * dot(normal, normal));
    const auto over = domain.impedance(wave_s)(cell) > 0 ? inverse_of(z) : of_fluid;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      load[side][axis] = in_pairs<D>(tractions<D>(c, in_grid, unit_vector<std::size_t(D)>(axis)));
      bend[side][axis] = product_of(over, load[side][axis]);
    }
  }
  const auto share = inverse_of(sum);
  for (const std::size_t side : {0, 1}) {
    const auto cell = side ? below : above<D>(below);
    const double sign = side ? -1 : 1, j = double(metric.volume(cell)),
                 b = double(state.material.data()[state.material_layout.cell(cell)]);
    const double part = beside_void ? 1 : traction_share;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto velocity = product_of(share, bend[side][axis]);
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t k = 0; k < D; ++k) {
          const auto place = (side * axes + axis) * D + k;
          found.velocity[i][place] = Real(-sign * j * velocity[i][k]);
          found.traction[i][place] = Real(-sign / 2 * part * b * load[side][axis][i][k]);
        }
    }
  }
  matrices_.push_back(found);
  return std::int32_t(matrices_.size()) - 1;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_by_matrices(const State<D, Real>& state, std::size_t n) {
  const Slot& slot = slots_[n];
  const Matrices& of = matrices_[std::size_t(slot.matrices)];
  std::array<Real, Matrices::differences> along{};
  std::size_t place = 0;
  for (const auto& side : slot.sides)
    for (const auto& difference :
         differences_along<D>(side.cells, state.fields.data(), state.layout.row_pitch())) {
      for (const Real part : components<D>(difference)) along[place++] = part;
    }
  for (std::size_t i = 0; i < D; ++i) {
    Real velocity = 0, traction = 0;
    for (std::size_t k = 0; k < Matrices::differences; ++k)
      velocity += of.velocity[i][k] * along[k], traction += of.traction[i][k] * along[k];
    velocities_[i][n] = velocity, tractions_[i][n] = traction;
  }
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

/// On either side motion along the interface alone puts a traction t on it in a unit of time. Velocities bend
/// so that it stays what it is, by a = -J t/(modulus N^2) a cell; and half of a sweep along the interface has
/// put t dt/2 on it.
template <int D, class Real>
void InterfaceCorrections<D, Real>::update_slot(const State<D, Real>& state, std::size_t n) {
  using Vector = RowVector<D, Real>;
  const Slot& slot = slots_[n];
  if (slot.matrices != none) return update_by_matrices(state, n);
  const Vector normal = row_normal<D>(slot.normal.data(), 1);
  const Real square = dot(normal, normal);
  const std::int64_t pitch = state.layout.row_pitch();
  Vector velocity{}, traction{};
  Real sum_p = 0, sum_s = 0, sum_s_y = 0;
  bool beside_void = false;
  for (const int which : {0, 1}) {
    const Side& side = slot.sides[std::size_t(which)];
    const Real* const material = state.material.data() + side.b;
    const Real b = material[0], zp = material[row_zp * material_pitch_],
               zs = material[row_zs * material_pitch_];
    if (zp == 0) {
      beside_void = true;
      continue;
    }
    const auto along = differences_along<D>(side.cells, state.fields.data(), pitch);
    const Real sign = which ? Real(-1) : Real(1);  // Z_l a_l - Z_r a_r
    // Moduli times dt/h.
    const Real p = zp * zp * b, mu = zs * zs * b;
    const Real zs_y = side.coupled ? material[zs_y_row_ * material_pitch_] : zs;
    const Vector t = side.coupled
                         ? traction_on_level_face<D>(material[row_coupling * material_pitch_] * b, mu,
                                                     material[coupling_y_row_ * material_pitch_] * b,
                                                     zs_y * zs_y * b, along)
                         : traction_of_motion_along<D>(normal, p, mu, along);
    const Vector t_p = (dot(normal, t) / square) * normal, t_s = t - t_p;
    velocity = velocity + (-sign * side.j / square * (zp / p)) * t_p;
    if (zs > 0) velocity = velocity + (-sign * side.j / square * (zs / mu)) * t_s;
    if constexpr (D == 3)
      if (zs > 0 && zs_y != zs) velocity.y += -sign * side.j * (1 / (zs_y * b) - zs / mu) * t_s.y;
    traction = traction + (-sign / 2) * (zs > 0 ? t : t_p);
    sum_p += zp, sum_s += zs, sum_s_y += zs_y;
  }
  const Vector of_p = (dot(normal, velocity) / square) * normal, of_s = velocity - of_p;
  Vector v = (1 / sum_p) * of_p + (1 / sum_s) * of_s;
  velocities_[0][n] = v.z, velocities_[1][n] = v.x;
  if (!beside_void) traction = Real(traction_share) * traction;
  tractions_[0][n] = traction.z, tractions_[1][n] = traction.x;
  if constexpr (D == 3) {
    if (sum_s_y != sum_s) v.y = (1 / sum_s_y) * velocity.y;
    velocities_[2][n] = v.y, tractions_[2][n] = traction.y;
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class InterfaceCorrections);

}  // namespace slipwave::solver
