// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/bent_tilted_cells.hpp"

#include <algorithm>
#include <utility>

#include "solver/kernels/bent_formulas.hpp"
#include "solver/kernels/reconstruction.hpp"

namespace slipwave::solver {
namespace {

/// Cells whose waves are reconstructed at once.
constexpr std::int64_t at_once = 64;
constexpr int most_places = 2 * max_reach + 1;

/// The pairs of both waves of some cells (WavePair) at all places of their stencils.
template <class Real>
struct Pairs {
  WavePair<Real> of[2][at_once];
  Real v[2][most_places][at_once], s[2][most_places][at_once];

  /// At a place, from the components of velocity and traction there.
  template <class At>
  void combine(std::int64_t n, int place, const At& at) {
    for (std::int64_t i = 0; i < n; ++i) {
      Real v_along, v_across, t_along, t_across;
      at(i, v_along, v_across, t_along, t_across);
      for (const std::size_t wave : {0, 1}) {
        const auto sum = [&](const typename WavePair<Real>::Sum& by) {
          return by.v_along * v_along + by.v_across * v_across + by.t_along * t_along +
                 by.t_across * t_across;
        };
        v[wave][place][i] = sum(of[wave][i].v), s[wave][place][i] = sum(of[wave][i].s);
      }
    }
  }
};

}  // namespace

template <class Real>
IndexRange BentTiltedCells<Real>::Places::in(std::int64_t row, const IndexRange& columns) const {
  const auto begin = x.begin() + first[std::size_t(row)], end = x.begin() + first[std::size_t(row) + 1];
  return {std::lower_bound(begin, end, columns.first) - x.begin(),
          std::lower_bound(begin, end, columns.last) - x.begin()};
}

template <class Real>
std::int64_t BentTiltedCells<Real>::Places::end_of_run(std::int64_t begin, std::int64_t end) const {
  auto n = begin + 1;
  while (n < end && x[std::size_t(n)] - x[std::size_t(begin)] == n - begin) ++n;
  return n;
}

template <class Real>
BentTiltedCells<Real>::BentTiltedCells(const State<2, Real>& state, const Domain<2>& domain,
                                       const Metric<2, Real>& metric, int reach,
                                       const std::array<InterfaceStencils, 2>& along_x)
    : reach_(reach) {
  if (!metric.any_bent() || domain.tilted().empty()) return;
  const auto rows = std::size_t(domain.grid.shape[1]);
  cells_.first.assign(rows + 1, 0);
  for (const auto& tilted : domain.tilted()) {
    const auto row = domain.grid.index(tilted.cell)[1];
    if (!domain.bent(row)) continue;
    add_cell(state, domain, metric, tilted, along_x);
    cells_.first[std::size_t(row) + 1] = std::int64_t(cells_.x.size());
  }
  if (empty()) return;
  for (std::size_t row = 1; row <= rows; ++row)
    cells_.first[row] = std::max(cells_.first[row], cells_.first[row - 1]);
  for (const int axis : {0, 1}) add_faces(domain, metric, axis);
}

template <class Real>
void BentTiltedCells<Real>::add_cell(const State<2, Real>& state, const Domain<2>& domain,
                                     const Metric<2, Real>& metric, const TiltedMedium& tilted,
                                     const std::array<InterfaceStencils, 2>& along_x) {
  const auto at = domain.grid.index(tilted.cell);
  cells_.x.push_back(std::int32_t(at[0]));
  const auto along = waves_along(tilted, 0);
  motion_along_[0].push_back(Real(along.cosine)), motion_along_[1].push_back(Real(along.sine));
  const auto of = metric.across({0, at[1]}, at[0]);
  const auto across = waves_across_rows(plane_stiffness_at(domain, at), of);
  for (const std::size_t side : {0, 1}) {
    const auto& face = across.faces[side];
    std::size_t n = 0;
    for (const double value : {face.along, face.across, face.z[0], face.z[1]})
      of_faces_[side][n++].push_back(Real(value));
  }
  for (const std::size_t wave : {0, 1}) {
    z_along_[wave].push_back(Real(along.z[wave]));
    courant_z_[wave].push_back(Real(across.courant_z[wave]));
  }
  // What the loops take it for: isotropic rock with the impedances of sweeps across level rows.
  const auto material = state.material_from({0, at[1]}, at[0]);
  const double b = double(material.b[0]), step = b * tilted.rho, zp = double(material.zp[0]),
               zs = double(material.zs[0]), p = zp * zp * b, mu = zs * zs * b;
  const auto& c = tilted.stiffness;
  std::size_t n = 0;
  for (const double value : {c.c11 * step - p, c.c13 * step - (p - 2 * mu), c.c15 * step, c.c33 * step - p,
                             c.c35 * step, c.c55 * step - mu})
    more_[n++].push_back(Real(value));
  Ending ending{reach_, {}};
  bool ends = false;
  for (const std::size_t wave : {0, 1}) {
    const auto* const found = along_x[wave].find(at[1], at[0]);
    ends = ends || found;
    ending.stencils[wave] = found ? *found : whole_stencil(cells_.x.back(), reach_);
    ending.reach = std::min(ending.reach, int(ending.stencils[wave].reach));
  }
  ending_.push_back(ends ? std::int32_t(endings_.size()) : none);
  if (ends) endings_.push_back(ending);
}

/// Those beside each cell, and of rows that are level beside bent ones, too.
template <class Real>
void BentTiltedCells<Real>::add_faces(const Domain<2>& domain, const Metric<2, Real>& metric, int axis) {
  auto& faces = axis == 0 ? along_ : across_;
  const auto& shape = domain.grid.shape;
  const auto inside = [&](const Index<2>& at) {
    return at[0] >= 0 && at[0] < shape[0] && at[1] >= 0 && at[1] < shape[1];
  };
  const std::int64_t rows = shape[1] + (axis == 1 ? 1 : 0), columns = shape[0] + (axis == 0 ? 1 : 0);
  faces.first.assign(1, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    const bool bent = axis == 0 ? domain.bent(row)
                                : (row > 0 && domain.bent(row - 1)) || (row < shape[1] && domain.bent(row));
    for (std::int64_t x = 0; bent && x < columns; ++x) {
      const Index<2> behind{x, row};
      Index<2> before = behind;
      --before[std::size_t(axis)];
      const std::array<Index<2>, 2> cells{before, behind};
      const auto listed = [&](const Index<2>& at) { return inside(at) && domain.is_tilted(at); };
      if (!listed(before) && !listed(behind)) continue;
      const double nx = axis == 0 ? 0 : double(normal_of_face(metric.across({0, row}, x), 0));
      const auto impedance = [&](const Index<2>& at) {
        const auto stiffness = plane_stiffness_at(domain, at);
        if (axis == 1) return impedance_across_rows(stiffness, nx);
        const auto z = root_of(acoustic_tensor(stiffness, 1, 0));
        return PlaneTensor{z.xx, z.zx, z.zz};
      };
      faces.x.push_back(std::int32_t(x));
      for (const std::size_t side : {0, 1}) {
        PlaneTensor z;
        if (inside(cells[side])) {
          z = impedance(cells[side]);
        } else if (const auto law = domain.edges[axis][side]; law != EdgeLaw::free) {
          z = impedance(cells[1 - side]);
          if (law == EdgeLaw::mirror) z = {z.zz, 0, 0};
        }
        std::size_t n = 0;
        for (const double value : {z.zz, z.zx, z.xx}) faces.z[side][n++].push_back(Real(value));
      }
      faces.by_lower.push_back(
          listed(behind) && !(inside(before) && domain.impedance(wave_s)(before) > 0) ? Real(1) : Real(0));
    }
    faces.first.push_back(std::int64_t(faces.x.size()));
  }
}

template <class Real>
void BentTiltedCells<Real>::reconstruct_along(std::int64_t row, const IndexRange& columns,
                                              const Kernels<Real>& kernels, const Along& from, Real scale,
                                              OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const Real sign = scale < 0 ? -1 : 1;
  const auto cells = cells_.in(row, columns);
  Pairs<Real> pairs;
  Real up[2][at_once], down[2][at_once];
  for (auto first = cells.first; first < cells.last;) {
    const auto last = std::min(cells_.end_of_run(first, cells.last), first + at_once);
    const auto n = last - first, to = cells_.x[std::size_t(first)] - columns.first;
    for (std::int64_t i = 0; i < n; ++i) {
      const auto cell = std::size_t(first + i);
      const auto face = [&](Real j) {
        return typename BentWaves<Real>::Face{
            motion_along_[0][cell], motion_along_[1][cell], {j * z_along_[0][cell], j * z_along_[1][cell]}};
      };
      const auto before = face(height_of_face(from.metric, to + i, 0)),
                 behind = face(height_of_face(from.metric, to + i, 1));
      for (const std::size_t wave : {0, 1})
        pairs.of[wave][i] = wave_pair<Real>(before, behind, z_along_[wave][cell], wave, sign);
    }
    for (int k = -reach_; k <= reach_; ++k) {
      const auto at = to + k;
      pairs.combine(n, k + reach_, [&](std::int64_t i, Real& v, Real& w, Real& s, Real& t) {
        const Real j = height_of_cell(from.metric, at + i);
        v = from.pairs[0].v[at + i], w = from.pairs[1].v[at + i];
        s = j * from.pairs[0].s[at + i], t = j * from.pairs[1].s[at + i];
      });
    }
    for (const std::size_t wave : {0, 1})
      kernels.reconstruct(n, at_once, pairs.v[wave][reach_], pairs.s[wave][reach_],
                          z_along_[wave].data() + first, from.b + to, scale, up[wave], down[wave]);
    for (std::int64_t i = 0; i < n; ++i) {
      const auto cell = std::size_t(first + i);
      const Real along = motion_along_[0][cell], across = motion_along_[1][cell];
      outgoing.up(0)[to + i] = along * up[0][i] - across * up[1][i];
      outgoing.up(1)[to + i] = across * up[0][i] + along * up[1][i];
      outgoing.down(0)[to + i] = along * down[0][i] - across * down[1][i];
      outgoing.down(1)[to + i] = across * down[0][i] + along * down[1][i];
      if (const auto ending = ending_[cell]; ending != none) {
        const auto as = [&]<std::size_t... N>(std::index_sequence<N...>) {
          ((endings_[std::size_t(ending)].reach == reach_of(orders[N])
                ? reconstruct_ending<orders[N]>(cell, from, to + i, scale, outgoing)
                : void()),
           ...);
        };
        as(std::make_index_sequence<std::size_t(order_count)>());
      }
    }
    first = last;
  }
}

/// One cell whose stencils end.
template <class Real>
template <int Order>
void BentTiltedCells<Real>::reconstruct_ending(std::size_t n, const Along& from, std::int64_t at, Real scale,
                                               OutgoingWaves<Real> outgoing) const {
  constexpr int reach = reach_of(Order), count = 2 * reach + 1;
  const Ending& ending = endings_[std::size_t(ending_[n])];
  const auto& metric = from.metric;
  Real v[2][count], s[2][count];
  for (const std::size_t p : {0, 1})
    extended_pair(ending.stencils[p], reach, 1, from.pairs[p].v + at, from.pairs[p].s + at,
                  from.pairs[p].corrections, scale, v[p], s[p], metric.half_x + at, metric.stride);
  const Real sign = scale < 0 ? -1 : 1;
  Real up[2] = {0, 0}, down[2] = {0, 0};
  for (const std::size_t wave : {0, 1}) {
    const Real along = wave == 0 ? motion_along_[0][n] : -motion_along_[1][n],
               across = wave == 0 ? motion_along_[1][n] : motion_along_[0][n], z = z_along_[wave][n];
    Real v_of[count], s_of[count], of_up = 0, of_down = 0, other = 0;
    for (int k = 0; k < count; ++k) {
      v_of[k] = along * v[0][k] + across * v[1][k];
      s_of[k] = along * s[0][k] + across * s[1][k];
    }
    const Real courant = sign * scale * (z * from.b[at]);
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * height_of_face(metric, at, 1), courant,
                            of_up, other);
    reconstruct_cell<Order>(v_of + reach, s_of + reach, 1, sign * z * height_of_face(metric, at, 0), courant,
                            other, of_down);
    up[0] += along * of_up, up[1] += across * of_up;
    down[0] += along * of_down, down[1] += across * of_down;
  }
  for (const int p : {0, 1}) outgoing.up(p)[at] = up[p], outgoing.down(p)[at] = down[p];
}

template <class Real>
void BentTiltedCells<Real>::reconstruct_across(std::int64_t row, const IndexRange& columns,
                                               const Kernels<Real>& kernels,
                                               const BentFields<const Real>& fields,
                                               const BentAcross<Real>& metric, const Real* b, Real scale,
                                               OutgoingWaves<Real> outgoing) const {
  if (empty()) return;
  const Real sign = scale < 0 ? -1 : 1;
  const auto cells = cells_.in(row, columns);
  Pairs<Real> pairs;
  typename BentWaves<Real>::Face face[2][at_once];
  Real up[2][at_once], down[2][at_once];
  for (auto first = cells.first; first < cells.last;) {
    const auto last = std::min(cells_.end_of_run(first, cells.last), first + at_once);
    const auto n = last - first, to = cells_.x[std::size_t(first)] - columns.first;
    for (std::int64_t i = 0; i < n; ++i) {
      const auto cell = std::size_t(first + i);
      for (const std::size_t side : {0, 1}) {
        const auto& of = of_faces_[side];
        face[side][i] = {of[0][cell], of[1][cell], {of[2][cell], of[3][cell]}};
      }
      for (const std::size_t wave : {0, 1})
        pairs.of[wave][i] = wave_pair<Real>(face[0][i], face[1][i], courant_z_[wave][cell], wave, sign);
    }
    for (int k = -reach_; k <= reach_; ++k) {
      const Real* const field = fields.first + to + k * fields.stride;
      pairs.combine(n, k + reach_, [&](std::int64_t i, Real& v, Real& w, Real& s, Real& t) {
        const auto velocity = row_velocity<2>(field + i, fields.pitch);
        const Real nx = normal_of_cell(metric, to + i + k * metric.stride);
        const auto traction = row_traction<2>(field + i, fields.pitch, RowVector<2, Real>{1, nx});
        v = velocity.z, w = velocity.x, s = traction.z, t = traction.x;
      });
    }
    for (const std::size_t wave : {0, 1})
      kernels.reconstruct(n, at_once, pairs.v[wave][reach_], pairs.s[wave][reach_],
                          courant_z_[wave].data() + first, b + to, scale, up[wave], down[wave]);
    const auto resolve = [&](const Real(&waves)[2][at_once], std::size_t side, Real* along, Real* across) {
      for (std::int64_t i = 0; i < n; ++i) {
        const auto& of = face[side][i];
        const auto next = to + i + std::int64_t(side) * metric.stride;
        resolve_on_face<Real>(of, waves[0][i], waves[1][i], normal_of_face(metric, next),
                              metric.over_face[next], along[i], across[i]);
      }
    };
    resolve(up, 1, outgoing.up(0) + to, outgoing.up(1) + to);
    resolve(down, 0, outgoing.down(0) + to, outgoing.down(1) + to);
    first = last;
  }
}

/// (T5) of a run of faces; `over` is 1 over their size, by which velocities are less, or null.
template <class Real>
void BentTiltedCells<Real>::solve(const Faces& faces, std::int64_t first, std::int64_t count,
                                  const Real* up_p, const Real* up_s, const Real* down_p, const Real* down_s,
                                  const Real* over, std::array<Real*, 4> to) const {
  const auto from = [&](std::size_t side, std::size_t n) { return faces.z[side][n].data() + first; };
  const Real *const lo_along = from(0, 0), *const lo_mixed = from(0, 1), *const lo_across = from(0, 2);
  const Real *const hi_along = from(1, 0), *const hi_mixed = from(1, 1), *const hi_across = from(1, 2);
  const Real* const by_lower = faces.by_lower.data() + first;
  for (std::int64_t k = 0; k < count; ++k) {
    const Real a = lo_along[k] + hi_along[k], b = lo_mixed[k] + hi_mixed[k], c = lo_across[k] + hi_across[k];
    const Real p = up_p[k] + down_p[k], s = up_s[k] + down_s[k], share = 1 / (a * c - b * b);
    const Real v = (c * p - b * s) * share, w = (a * s - b * p) * share;
    const Real lower = by_lower[k], upper = 1 - lower;
    to[2][k] = lower * (lo_along[k] * v + lo_mixed[k] * w - up_p[k]) +
               upper * (down_p[k] - hi_along[k] * v - hi_mixed[k] * w);
    to[3][k] = lower * (lo_mixed[k] * v + lo_across[k] * w - up_s[k]) +
               upper * (down_s[k] - hi_mixed[k] * v - hi_across[k] * w);
    const Real size = over ? over[k] : Real(1);
    to[0][k] = size * v, to[1][k] = size * w;
  }
}

template <class Real>
void BentTiltedCells<Real>::solve_along(std::int64_t row, const IndexRange& columns,
                                        OutgoingWaves<Real> below, OutgoingWaves<Real> above,
                                        const Real* half_face, InterfaceStates<Real> faces) const {
  if (empty()) return;
  const auto all = along_.in(row, columns);
  Real over[at_once];
  for (auto first = all.first; first < all.last;) {
    const auto last = std::min(along_.end_of_run(first, all.last), first + at_once);
    const auto i = along_.x[std::size_t(first)] - columns.first;
    // Impedances are J times as large as those that are kept: so are tractions, but not velocities.
    for (std::int64_t k = 0; k < last - first; ++k) over[k] = 1 / (half_face[i + k] + half_face[i + k]);
    solve(along_, first, last - first, below.up(0) + i, below.up(1) + i, above.down(0) + i, above.down(1) + i,
          over, {faces.v(0) + i, faces.v(1) + i, faces.s(0) + i, faces.s(1) + i});
    first = last;
  }
}

template <class Real>
void BentTiltedCells<Real>::solve_across(std::int64_t row, const IndexRange& columns,
                                         const BentSolve<Real>& at, Real sign, bool fluid) const {
  if (empty()) return;
  const auto all = across_.in(row, columns);
  Real v[at_once], w[at_once], t[at_once], u[at_once];
  for (auto first = all.first; first < all.last;) {
    const auto last = std::min(across_.end_of_run(first, all.last), first + at_once);
    const auto i = across_.x[std::size_t(first)] - columns.first;
    solve(across_, first, last - first, at.below.up(0) + i, at.below.up(1) + i, at.above.down(0) + i,
          at.above.down(1) + i, nullptr, {v, w, t, u});
    for (std::int64_t k = 0; k < last - first; ++k) {
      const Real nx = normal_of_face(at.metric, i + k), over = at.metric.over_face[i + k];
      // A fluid slides along the face (F7).
      const auto seen_by = [&](const MaterialRows<Real>& material, const BentFields<const Real>& fields) {
        if (!(material.zp[i + k] > 0) || material.zs[i + k] > 0) return w[k];
        const auto own = row_velocity<2>(fields.first + i + k, fields.pitch);
        return sign * over * (own.x - nx * own.z);
      };
      const Real below = fluid ? seen_by(at.lo, at.fields_lo) : w[k];
      at.faces.v(0)[i + k] = over * (v[k] - nx * below);
      at.faces.v(1)[i + k] = over * (nx * v[k] + below);
      at.faces.s(0)[i + k] = over * (t[k] - nx * u[k]);
      at.faces.s(1)[i + k] = over * (nx * t[k] + u[k]);
      if (!fluid) continue;
      const Real above = seen_by(at.hi, at.fields_hi);
      at.seen_above[i + k] = over * (v[k] - nx * above);
      at.seen_above[at.seen_pitch + i + k] = over * (nx * v[k] + above);
    }
    first = last;
  }
}

template <class Real>
void BentTiltedCells<Real>::add_stress_along(std::int64_t row, const IndexRange& columns, Real size,
                                             InterfaceStates<Real> lo, InterfaceStates<Real> hi,
                                             const SweptRows<Real>& rows) const {
  if (empty()) return;
  const auto cells = cells_.in(row, columns);
  for (auto n = cells.first; n < cells.last; ++n) {
    const auto cell = std::size_t(n);
    const auto i = cells_.x[cell] - columns.first;
    const Real x = size * (hi.v(0)[i] - lo.v(0)[i]), z = size * (hi.v(1)[i] - lo.v(1)[i]);
    rows.s[i] += more_[0][cell] * x + more_[2][cell] * z;
    rows.passive[i] += more_[1][cell] * x + more_[4][cell] * z;
    rows.st[i] += more_[2][cell] * x + more_[5][cell] * z;
  }
}

template <class Real>
void BentTiltedCells<Real>::add_stress_across(std::int64_t row, const IndexRange& columns, Real size,
                                              const BentUpdate<Real>& of) const {
  if (empty()) return;
  const auto cells = cells_.in(row, columns);
  const auto pitch = of.fields.pitch;
  for (auto n = cells.first; n < cells.last; ++n) {
    const auto cell = std::size_t(n);
    const auto i = cells_.x[cell] - columns.first;
    const Real moved = size * of.metric.over_j[i], nx = normal_of_cell(of.metric, i);
    const Real dz = moved * (of.hi.v(0)[i] - of.v_lo[i]),
               dx = moved * (of.hi.v(1)[i] - of.v_lo[of.v_lo_pitch + i]);
    const Real xx = nx * dx, zz = dz, xz = nx * dz + dx;
    Real* const stress = of.fields.first + i + 2 * pitch;
    stress[0] += more_[0][cell] * xx + more_[1][cell] * zz + more_[2][cell] * xz;
    stress[pitch] += more_[1][cell] * xx + more_[3][cell] * zz + more_[4][cell] * xz;
    stress[2 * pitch] += more_[2][cell] * xx + more_[4][cell] * zz + more_[5][cell] * xz;
  }
}

template <class Real>
std::int64_t BentTiltedCells<Real>::memory_bytes() const {
  constexpr std::size_t values = 20, of_faces = 7;
  const auto faces = along_.x.size() + across_.x.size();
  return std::int64_t(cells_.x.size() * (values * sizeof(Real) + 2 * sizeof(std::int32_t)) +
                      faces * (of_faces * sizeof(Real) + sizeof(std::int32_t)) +
                      endings_.size() * sizeof(Ending));
}

template class BentTiltedCells<float>;
template class BentTiltedCells<double>;

}  // namespace slipwave::solver
