#include "solver/sweep/interface_corrections.hpp"

#include <algorithm>
#include <cmath>

#include "scene/edges.hpp"
#include "solver/kernels/bent_formulas.hpp"
#include "solver/sweep/interface_stencils.hpp"

namespace slipwave::solver {
namespace {

/// As along free surfaces (free_surface.cpp).
constexpr std::array<int, 4> offsets = {-2, -1, 1, 2};
constexpr std::array<double, 4> difference_weights = {-0.125, -0.25, 0.25, 0.125};
/// Ratio of P impedances from which a fluid is too light to hold a wave at the interface: over gas the energy
/// of thousands of steps would rise by a few millionths of what is left.
constexpr double gas_ratio = 100;
/// Cells of one medium needed on either side: no stencil may reach another extension as well.
constexpr auto fewest_across = std::int64_t(2) * max_reach;

template <int D>
bool alike(const Domain<D>& domain, const Index<D>& one, const Index<D>& other) {
  for (const Wave wave : {wave_p, wave_s}) {
    const double a = domain.impedance(wave)(one), b = domain.impedance(wave)(other);
    if (a != b && (a >= strong_interface_ratio * b || b >= strong_interface_ratio * a)) return false;
  }
  return true;
}

/// Whether the cells before and behind the face before `below` meet at a fluid-solid interface that stays
/// on one row of faces as far as the corrections read.
template <int D>
bool corrected(const Domain<D>& domain, const Index<D>& below) {
  constexpr int z = D - 1;
  Index<D> above = below;
  --above[z];
  const auto carries = [&](Wave wave, const Index<D>& at) { return domain.impedance(wave)(at) > 0; };
  if (!carries(wave_p, above) || !carries(wave_p, below)) return false;
  if (carries(wave_s, above) == carries(wave_s, below)) return false;
  const double z_above = domain.impedance(wave_p)(above), z_below = domain.impedance(wave_p)(below);
  if (z_above > gas_ratio * z_below || z_below > gas_ratio * z_above) return false;
  for (const int side : {0, 1}) {
    Index<D> at = side ? below : above;
    for (std::int64_t n = 1; n < fewest_across; ++n) {
      Index<D> next = at;
      next[z] += side ? 1 : -1;
      if (next[z] < 0 || next[z] >= domain.grid.shape[z] || !alike(domain, at, next)) return false;
      at = next;
    }
    for (int axis = 0; axis < z; ++axis)
      for (const int offset : offsets) {
        Index<D> beside = side ? below : above;
        beside[axis] += offset;
        if (beside[axis] < 0 || beside[axis] >= domain.grid.shape[axis]) return false;
        if (!alike(domain, side ? below : above, beside)) return false;
      }
  }
  return true;
}

}  // namespace

template <int D, class Real>
InterfaceCorrections<D, Real>::InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain,
                                                    const Metric<D, Real>& metric)
    : padded_nx_(state.layout.padded_nx()), material_pitch_(state.material_layout.row_pitch()) {
  constexpr int z = D - 1;
  const auto& shape = domain.grid.shape;
  Grid<D> plane = domain.grid;
  plane.shape[z] = 1;
  const bool fluid = std::any_of(domain.impedance(wave_s).begin(), domain.impedance(wave_s).end(),
                                 [](float impedance) { return impedance == 0; });
  first_.assign(2, 0);
  for (std::int64_t row = 1; row < shape[z]; ++row) {
    for (std::int64_t n = 0; fluid && n < plane.size(); ++n) {
      Index<D> at = plane.index(n);
      at[z] = row;
      if (!corrected(domain, at)) continue;
      Slot slot{row, D == 2 ? at[0] : at[1] * padded_nx_ + at[0], {}, {}};
      const bool bent = metric.bent_row(row) && metric.bent_row(row - 1);
      for (int axis = 0; axis < z && bent; ++axis) {
        Index<D> line = at;
        line[0] = 0;
        const auto of = metric.across(line, at[0]);
        slot.normal[std::size_t(axis)] = of.n_face[axis * of.pitch];
      }
      for (const int side : {0, 1}) {
        Index<D> cell = at;
        cell[z] += side - 1;
        auto& to = slot.sides[std::size_t(side)];
        for (int axis = 0; axis < z; ++axis)
          for (std::size_t k = 0; k < offsets.size(); ++k) {
            Index<D> beside = cell;
            beside[axis] += offsets[k];
            to.cells[std::size_t(axis) * offsets.size() + k] = state.layout.cell(beside);
          }
        to.b = state.material_layout.cell(cell);
        to.j = metric.volume(cell);
      }
      slots_.push_back(slot);
    }
    first_.push_back(slots_.size());
  }
  for (auto* lists : {&velocities_, &tractions_})
    for (auto& list : *lists) list.assign(slots_.size(), 0);
}

template <int D, class Real>
std::int32_t InterfaceCorrections<D, Real>::slot(const Index<D>& below) const {
  const auto row = std::size_t(below[D - 1]);
  if (slots_.empty() || below[D - 1] < 1 || row + 1 >= first_.size()) return none;
  const std::int64_t column = D == 2 ? below[0] : below[1] * padded_nx_ + below[0];
  const auto begin = slots_.begin() + std::ptrdiff_t(first_[row]),
             end = slots_.begin() + std::ptrdiff_t(first_[row + 1]);
  const auto found = std::lower_bound(
      begin, end, column, [](const Slot& slot, std::int64_t wanted) { return slot.column < wanted; });
  return found != end && found->column == column ? std::int32_t(found - slots_.begin()) : none;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update(const State<D, Real>& state, std::int64_t row,
                                           const IndexRange& columns) {
  if (slots_.empty() || row < 1 || std::size_t(row) + 1 >= first_.size()) return;
  for (auto n = first_[std::size_t(row)]; n < first_[std::size_t(row) + 1]; ++n)
    if (slots_[n].column >= columns.first && slots_[n].column < columns.last) update_slot(state, n);
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_all(const State<D, Real>& state) {
  for (std::size_t n = 0; n < slots_.size(); ++n) update_slot(state, n);
}

/// On either side the rates of the stresses that follow from motion along the interface alone put a traction
/// t on it. Velocities bend so that it stays what it is, by a = -J t/(modulus N^2) a cell; and half of a
/// sweep along the interface has put t dt/2 on it.
template <int D, class Real>
void InterfaceCorrections<D, Real>::update_slot(const State<D, Real>& state, std::size_t n) {
  using Vector = RowVector<D, Real>;
  const Slot& slot = slots_[n];
  const Vector normal = row_normal<D>(slot.normal.data(), 1);
  const Real square = dot(normal, normal);
  const std::int64_t pitch = state.layout.row_pitch();
  Vector velocity{}, traction{};
  Real sum_p = 0, sum_s = 0;
  for (const int which : {0, 1}) {
    const Side& side = slot.sides[std::size_t(which)];
    const Real* const material = state.material.data() + side.b;
    const Real b = material[0], zp = material[row_zp * material_pitch_],
               zs = material[row_zs * material_pitch_];
    // Differences along x and y of the velocities.
    std::array<Vector, std::size_t(D - 1)> along{};
    for (std::size_t axis = 0; axis < D - 1; ++axis)
      for (std::size_t k = 0; k < offsets.size(); ++k)
        along[axis] = along[axis] +
                      Real(difference_weights[k]) *
                          row_velocity<D>(state.fields.data() + side.cells[axis * offsets.size() + k], pitch);
    // Moduli times dt/h. The stress of these gradients, and its traction on the face.
    const Real p = zp * zp * b, mu = zs * zs * b, lambda = p - 2 * mu;
    Vector t;
    if constexpr (D == 2) {
      const Real dx = along[0].x, shear = mu * along[0].z;
      t = {lambda * dx + slot.normal[0] * shear, shear + slot.normal[0] * (p * dx)};
    } else {
      const Real dxx = along[0].x, dyy = along[1].y, dxy = mu * (along[0].y + along[1].x);
      const Real xz = mu * along[0].z, yz = mu * along[1].z, trace = lambda * (dxx + dyy);
      t = {trace + slot.normal[0] * xz + slot.normal[1] * yz,
           xz + slot.normal[0] * (trace + 2 * mu * dxx) + slot.normal[1] * dxy,
           yz + slot.normal[0] * dxy + slot.normal[1] * (trace + 2 * mu * dyy)};
    }
    const Vector t_p = (dot(normal, t) / square) * normal, t_s = t - t_p;
    const Real sign = which ? Real(-1) : Real(1);  // Z_l a_l - Z_r a_r
    velocity = velocity + (-sign * side.j / square * (zp / p)) * t_p;
    if (zs > 0) velocity = velocity + (-sign * side.j / square * (zs / mu)) * t_s;
    traction = traction + (Real(-0.5) * sign) * (zs > 0 ? t : t_p);
    sum_p += zp, sum_s += zs;
  }
  const Vector of_p = (dot(normal, velocity) / square) * normal, of_s = velocity - of_p;
  const Vector v = (1 / sum_p) * of_p + (1 / sum_s) * of_s;
  velocities_[0][n] = v.z, velocities_[1][n] = v.x;
  tractions_[0][n] = traction.z, tractions_[1][n] = traction.x;
  if constexpr (D == 3) velocities_[2][n] = v.y, tractions_[2][n] = traction.y;
}

template class InterfaceCorrections<2, float>;
template class InterfaceCorrections<2, double>;
template class InterfaceCorrections<3, float>;
template class InterfaceCorrections<3, double>;

}  // namespace slipwave::solver
