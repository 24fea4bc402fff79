// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/curvilinear_stencils.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "base/instantiate.hpp"
#include "solver/kernels/curvilinear_formulas.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/stencils.hpp"

namespace slipwave::solver {
namespace {

/// Velocity and traction of the cells of a column as extended() reads them.
template <int D, class Real>
struct ExtendedColumn {
  using Vector = RowVector<D, Real>;
  using At = MotionAt<Vector>;
  static constexpr bool splits = false;
  const CurvilinearFields<const Real>& fields;
  const CurvilinearAcross<Real>& metric;
  std::int64_t column;
  Real scale;
  const InterfaceCorrections<D, Real>& corrections;
  const WeldedFace<D, Real>* welds;

  At at(std::int64_t offset) const {
    const Real* const cell = fields.first + column + offset * fields.stride;
    const Real* const half_n = metric.half_n + column + offset * metric.stride;
    return {row_velocity<D>(cell, fields.pitch),
            row_traction<D>(cell, fields.pitch, cell_normal<D>(half_n, metric.pitch, metric.stride))};
  }
  template <class Side>
  Vector normal(const Side& side, const Ghost& ghost) const {
    const int face = ghost.below ? -side.cells : side.cells + 1;
    return face_normal<D>(metric.half_n + column + face * metric.stride, metric.pitch);
  }
  template <class Side>
  void mirror(const Side& side, const Ghost& ghost, At& at) const {
    const auto turn = [&](Extension odd, Vector& vector) {
      const Real p = side.laws[0] == odd ? -1 : 1, s = side.laws[1] == odd ? -1 : 1;
      vector = p == s ? p * vector : scaled(normal(side, ghost), p, s, vector);
    };
    turn(Extension::motionless, at.v), turn(Extension::traction_free, at.t);
  }
  /// R of the cell's side of a face times velocities, and 1 - R^T times tractions.
  static Vector share(const WeldedFace<D, Real>& of, bool below, const Vector& v) {
    const auto product = row_vector<D>(product_of(of.share, components<D>(v)));
    return below ? v - product : product;
  }
  static Vector rest(const WeldedFace<D, Real>& of, bool below, const Vector& t) {
    const auto product = row_vector<D>(product_of(transposed(of.share), components<D>(t)));
    return below ? product : t - product;
  }
  template <class Side>
  void weld(const Side& side, const Ghost& ghost, At& at) const {
    const auto& face = welds[side.weld];
    At across = this->at(ghost.across);
    // A fluid has no traction along the face.
    if (!face.solid[ghost.below]) at.t = scaled(normal(side, ghost), Real(1), Real(0), at.t);
    if (!face.solid[!ghost.below]) across.t = scaled(normal(side, ghost), Real(1), Real(0), across.t);
    at.v = at.v + Real(2) * share(face, ghost.below, across.v - at.v);
    at.t = at.t + Real(2) * rest(face, ghost.below, across.t - at.t);
  }
  /// Adds what (E11a) and (E11d) correct in a ghost.
  template <class Side>
  void correct(const Side& side, const Ghost& ghost, At& at) const {
    const auto of = [&](auto&& component) {
      std::array<Real, std::size_t(D)> all;
      for (int c = 0; c < D; ++c) all[std::size_t(c)] = component(c)[side.slot];
      return row_vector<D>(all);
    };
    auto v = of([&](int c) { return corrections.velocity(c); }),
         t = of([&](int c) { return corrections.traction(c); });
    if (scale == 1) {
      v = v + of([&](int c) { return corrections.velocity_of_step(c); });
      t = t + of([&](int c) { return corrections.traction_of_step(c); }) +
          mean_of_parabola(Real(2 * ghost.number + 1)) * of([&](int c) { return corrections.curvature(c); });
    }
    if (side.law() == Extension::interface) {
      const auto& face = welds[side.weld];
      // A fluid slides along the face.
      if (!face.solid[ghost.below]) v = scaled(normal(side, ghost), Real(1), Real(0), v);
      t = rest(face, ghost.below, t);
    }
    at.v = at.v + Real(2 * ghost.number + 1) * v;
    at.t = at.t + (ghost.below ? 2 : -2) * scale * t;
  }
};

template <int D, class Real>
void put_outgoing(const RowVector<D, Real>& up, const RowVector<D, Real>& down,
                  OutgoingWaves<Real> outgoing) {
  const auto all_up = components<D>(up), all_down = components<D>(down);
  for (int c = 0; c < D; ++c)
    outgoing.up(c)[0] = all_up[std::size_t(c)], outgoing.down(c)[0] = all_down[std::size_t(c)];
}

/// What reconstruction reads of a cell besides motions: scale, b, impedances, and the metric from it on.
template <int D, class Real>
struct CellAcross {
  Real scale, b, zp, zs, stretch;
  std::array<RowVector<D, Real>, 2> normals;  // of the faces before and behind it
};

/// The outgoing waves of an anisotropic cell (F12), (F15), from velocities and tractions at the places of its
/// stencil.
template <int Order, int D, class Real>
void reconstruct(const RowWaves<D, Real>& waves,
                 const std::array<MotionAt<RowVector<D, Real>>, std::size_t(Order)>& at,
                 const CellAcross<D, Real>& cell, OutgoingWaves<Real> outgoing) {
  constexpr int reach = reach_of(Order);
  const Real sign = cell.scale < 0 ? -1 : 1;
  const auto& [before, behind] = waves.faces;
  std::array<Real, std::size_t(D)> all_up{}, all_down{};
  for (std::size_t wave = 0; wave < D; ++wave) {
    const Real z = waves.courant_z[wave];
    const auto pair = wave_pair<D, Real>(before.motions[wave].data(), before.z[wave],
                                         behind.motions[wave].data(), behind.z[wave], 1, z, sign);
    Real v[Order] = {}, s[Order] = {}, up = 0, down = 0;
    for (std::size_t k = 0; k < std::size_t(Order); ++k) {
      const auto velocity = components<D>(at[k].v), traction = components<D>(at[k].t);
      for (std::size_t c = 0; c < D; ++c) {
        v[k] += pair.v[c] * velocity[c] + pair.v[D + c] * traction[c];
        s[k] += pair.s[c] * velocity[c] + pair.s[D + c] * traction[c];
      }
    }
    reconstruct_cell<Order>(v + reach, s + reach, 1, sign * z, sign * cell.scale * (z * cell.b), up, down);
    for (std::size_t c = 0; c < D; ++c)
      all_up[c] += behind.motions[wave][c] * up, all_down[c] += before.motions[wave][c] * down;
  }
  const auto resolved = [&](const std::array<Real, std::size_t(D)>& all, const RowVector<D, Real>& normal) {
    const auto of = curvilinear_face<D>(normal);
    return resolved_on_face<D>(row_vector<D>(all), of.normal, of.over);
  };
  put_outgoing<D>(resolved(all_up, cell.normals[1]), resolved(all_down, cell.normals[0]), outgoing);
}

/// Reconstructs the outgoing waves of an isotropic cell (F4).
template <int Order, int D, class Real>
void reconstruct(const std::array<MotionAt<RowVector<D, Real>>, std::size_t(Order)>& at,
                 const CellAcross<D, Real>& cell, OutgoingWaves<Real> outgoing) {
  constexpr int reach = reach_of(Order);
  const Real sign = cell.scale < 0 ? -1 : 1, courant = sign * cell.scale * cell.b * cell.stretch;
  const CurvilinearCell<D, Real> formula = {cell.normals[0],   cell.normals[1], courant * cell.zp,
                                            courant * cell.zs, sign * cell.zp,  sign * cell.zs,
                                            cell.zs > 0};
  RowVector<D, Real> up, down;
  reconstruct_curvilinear_cell<Order, D>([&](long k) { return at[std::size_t(k + reach)].v; },
                                         [&](long k) { return at[std::size_t(k + reach)].t; }, formula, up,
                                         down);
  put_outgoing<D>(up, down, outgoing);
}

/// R of the face with the vector N between two cells.
template <int D>
SmallMatrix<std::size_t(D)> share_at(const Domain<D>& domain, const Index<D>& before, const Index<D>& behind,
                                     const RowVector<D, double>& normal) {
  if (domain.anisotropic() &&
      (anisotropic_across_rows(domain, before) || anisotropic_across_rows(domain, behind))) {
    const auto impedance = [&](const Index<D>& at) {
      return impedance_across<D>(elasticity_at(domain, at), normal_in_grid<D>(normal));
    };
    const auto other = impedance(behind);
    return product_of(inverse_of(sum_of(impedance(before), other, 1.)), other);
  }
  const auto share = [&](Wave wave) {
    const double own = domain.impedance(wave)(before), other = domain.impedance(wave)(behind);
    return own + other > 0 ? other / (own + other) : 0;
  };
  const double p = share(wave_p), s = share(wave_s);
  const auto n = components<D>(normal);
  SmallMatrix<std::size_t(D)> of;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k)
      of[i][k] = (p - s) * n[i] * n[k] / dot(normal, normal) + (i == k ? s : 0);
  return of;
}

}  // namespace

template <int D, class Real>
CurvilinearStencils<D, Real>::CurvilinearStencils(const Domain<D>& domain, int reach,
                                                  const InterfaceCorrections<D, Real>& corrections,
                                                  const Metric<D, Real>& metric) {
  if (domain.curvilinear_rows.empty()) return;
  const auto& grid = domain.grid;
  const StencilSearch<D, 2> search{.impedances = {&domain.impedance(wave_p), &domain.impedance(wave_s)},
                                   .waves = {wave_p, wave_s},
                                   .edges = domain.edges,
                                   .axis = D - 1,
                                   .reach = reach,
                                   .rises_from = [](auto&&...) { return true; },
                                   .slot_beside =
                                       [&](Index<D> at, int side) {
                                         at[D - 1] += side;
                                         return corrections.slot(at);
                                       }};
  // All stencils that end at a face share what is known of it.
  std::map<std::int64_t, std::int32_t> welds;
  const auto weld_of = [&](const Walk<D, 2>& z, int n) {
    const auto behind = z.behind_face(n);
    const auto [found, is_new] = welds.try_emplace(grid.flat(behind), std::int32_t(welds_.size()));
    if (!is_new) return found->second;
    auto before = behind, line = behind;
    --before[D - 1], line[0] = 0;
    const auto of = metric.across(line, behind[0]);
    const auto share =
        share_at(domain, before, behind, in_numbers<double>(face_normal<D>(of.half_n, of.pitch)));
    auto& weld = welds_.emplace_back();
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) weld.share[i][k] = Real(share[i][k]);
    weld.solid = {domain.impedance(wave_s)(before) > 0, domain.impedance(wave_s)(behind) > 0};
    return found->second;
  };
  for (std::int64_t line = 0; line < grid.size() / grid.shape[0]; ++line) {
    auto at = grid.index(line * grid.shape[0]);
    for (at[0] = 0; at[0] < grid.shape[0] && domain.curvilinear(at[D - 1]); ++at[0])
      if (const auto found = find_stencil<Side>(search, at, weld_of)) list_.cells.push_back(*found);
    list_.end_line();
  }
}

template <int D, class Real>
void CurvilinearStencils<D, Real>::correct(int order, std::int64_t line, const IndexRange& columns,
                                           const Row& row, const InterfaceCorrections<D, Real>& corrections,
                                           const AnisotropicCellsAcross<D, Real>& anisotropic,
                                           OutgoingWaves<Real> outgoing) const {
  const auto& [fields, metric, material, scale] = row;
  for (auto n = list_.from(line, columns.first), end = list_.end(line); n < end && list_[n].x < columns.last;
       ++n) {
    const auto& stencil = list_[n];
    const auto i = stencil.x - columns.first;
    if (stencil.reach == not_carried) {
      for (int c = 0; c < D; ++c) outgoing.up(c)[i] = outgoing.down(c)[i] = 0;
      continue;
    }
    const ExtendedColumn<D, Real> column{fields, metric, i, scale, corrections, welds_.data()};
    const auto normal = [of = metric.half_n + i, pitch = metric.pitch](std::int64_t face) {
      return face_normal<D>(of + face, pitch);
    };
    const CellAcross<D, Real> cell{scale,          material.b[i],     material.zp[i],
                                   material.zs[i], metric.stretch[i], {normal(0), normal(metric.stride)}};
    const auto waves = anisotropic.waves_of(line, stencil.x);
    at_order_reaching(std::min<int>(stencil.reach, reach_of(order)), [&]<int Order>() {
      const auto at = extended_about<reach_of(Order)>(stencil, column);
      if (waves)
        reconstruct<Order, D>(*waves, at, cell, outgoing.at(i));
      else
        reconstruct<Order, D>(at, cell, outgoing.at(i));
    });
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class CurvilinearStencils);

}  // namespace slipwave::solver
