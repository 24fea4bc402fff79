// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/bent_stencils.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "solver/kernels/bent_formulas.hpp"
#include "solver/sweep/motion_along.hpp"

namespace slipwave::solver {
namespace {

/// Impedances from a cell outwards along z.
template <int D>
class Column {
 public:
  Column(const Domain<D>& domain, const Index<D>& from, int step) : domain_(domain), at_(from), step_(step) {}
  bool leaves_grid(int n) const {
    const auto row = at_[D - 1] + n * step_;
    return row < 0 || row >= domain_.grid.shape[D - 1];
  }
  double operator()(Wave wave, int n) const {
    Index<D> at = at_;
    at[D - 1] += n * step_;
    return domain_.impedance(wave)(at);
  }
  /// Whether the impedances of cells n and n + 1 differ by more than a factor.
  bool differ(int n, double ratio) const {
    for (const Wave wave : {wave_p, wave_s}) {
      const double a = (*this)(wave, n), b = (*this)(wave, n + 1);
      if (a > ratio * b || b > ratio * a) return true;
    }
    return false;
  }

 private:
  const Domain<D>& domain_;
  Index<D> at_;
  int step_;
};

float share(double own, double other) { return own + other > 0 ? float(other / (own + other)) : 0.f; }

/// One side of a cell; `inside`: its interface is inside the grid.
template <int D>
BentStencil::Side side_of(const Column<D>& z, EdgeLaw edge, int reach, bool& inside) {
  BentStencil::Side side;
  for (; side.cells < reach; ++side.cells) {
    const int own{side.cells}, next{own + 1};
    if (z.leaves_grid(next)) {
      side.p = extension_of(edge, wave_p), side.s = extension_of(edge, wave_s);
      return side;
    }
    if (z(wave_p, next) == 0) {
      side.p = side.s = Extension::traction_free;
      inside = true;
      return side;
    }
    if (!z.differ(own, strong_interface_ratio)) continue;
    side.p = side.s = Extension::interface;
    side.share_p = share(z(wave_p, own), z(wave_p, next));
    side.share_s = share(z(wave_s, own), z(wave_s, next));
    inside = true;
    for (side.beyond = 1; side.beyond < reach; ++side.beyond) {
      const int further = next + side.beyond;
      if (z.leaves_grid(further) || z(wave_p, further) == 0 || z.differ(further - 1, strong_interface_ratio))
        break;
    }
    return side;
  }
  return side;
}

/// Cells of the sides that end at `law`: the fewest, or `reach`.
int fewest_cells_to(Extension law, const BentStencil::Side& low, const BentStencil::Side& high, int reach) {
  if (low.p == law) reach = std::min(reach, int{low.cells});
  return high.p == law ? std::min(reach, int{high.cells}) : reach;
}

int reach_within(const BentStencil::Side& low, const BentStencil::Side& high, int reach) {
  const int to_void = fewest_cells_to(Extension::traction_free, low, high, reach);
  return solver::reach_within((low.p == Extension::interface) + (high.p == Extension::interface),
                              fewest_cells_to(Extension::interface, low, high, reach),
                              low.p != Extension::none && high.p != Extension::none, low.cells + high.cells,
                              reach_up_to(to_void, most_reach_at_mirrors, reach));
}

/// Cells to one side up to the next contrast, at most `reach`.
template <int D>
int cells_to_contrast(const Column<D>& z, int reach) {
  for (int n = 1; n <= reach && !z.leaves_grid(n); ++n)
    if (z.differ(n - 1, contrast_ratio)) return n - 1;
  return reach;
}

/// Velocity and traction of a cell.
template <int D, class Real>
struct Motion {
  RowVector<D, Real> v, t;
};

template <int D, class Real>
Motion<D, Real> load(const BentFields<const Real>& fields, const BentAcross<Real>& metric, int offset) {
  const Real* const cell = fields.first + offset * fields.stride;
  return {
      row_velocity<D>(cell, fields.pitch),
      row_traction<D>(cell, fields.pitch,
                      cell_normal<D>(metric.half_n + offset * metric.stride, metric.pitch, metric.stride))};
}

template <int D, class Real>
RowVector<D, Real> through(const SmallMatrix<std::size_t(D), Real>& share, const RowVector<D, Real>& v) {
  return row_vector<D>(product_of(share, components<D>(v)));
}
/// Of tractions: the vector less what the transposed matrix makes of it.
template <int D, class Real>
RowVector<D, Real> tractions_through(const SmallMatrix<std::size_t(D), Real>& share,
                                     const RowVector<D, Real>& t) {
  return t - through<D>(transposed(share), t);
}

/// What (E11a) adds in a ghost. `scale`: negative beyond the upper end.
template <bool Anisotropic, int D, class Real>
void add_correction(const BentStencil& stencil, const BentStencil::Side& side,
                    const RowVector<D, Real>& normal, const InterfaceCorrections<D, Real>& corrections,
                    int ghost, Real scale, const typename AnisotropicStencil<D, Real>::Weld* weld,
                    Motion<D, Real>& at) {
  const auto of = [&](auto&& component) {
    RowVector<D, Real> vector;
    vector.z = component(0)[side.slot], vector.x = component(1)[side.slot];
    if constexpr (D == 3) vector.y = component(2)[side.slot];
    return vector;
  };
  // A fluid slides along the face.
  const Real solid = stencil.solid ? 1 : 0;
  at.v = at.v + Real(2 * ghost + 1) *
                    scaled(normal, Real(1), solid, of([&](int c) { return corrections.velocity(c); }));
  if constexpr (Anisotropic)
    if (weld) {
      at.t = at.t + (2 * scale) *
                        tractions_through<D>(weld->share, of([&](int c) { return corrections.traction(c); }));
      return;
    }
  at.t = at.t + scale * scaled(normal, 2 - 2 * Real(side.share_p), solid * (2 - 2 * Real(side.share_s)),
                               of([&](int c) { return corrections.traction(c); }));
}

/// At a stencil offset, extended beyond the ends of the stencil. `Anisotropic`: beside anisotropic rock.
template <bool Anisotropic, int D, class Real>
Motion<D, Real> extended(const BentStencil& stencil, const BentFields<const Real>& fields,
                         const BentAcross<Real>& metric, const InterfaceCorrections<D, Real>& corrections,
                         Real scale, const AnisotropicStencil<D, Real>* anisotropic, int offset) {
  const bool below = offset < -stencil.low.cells;
  if (!below && offset <= stencil.high.cells) return load<D>(fields, metric, offset);
  const auto& side = below ? stencil.low : stencil.high;
  if (side.p == Extension::constant) return load<D>(fields, metric, below ? -side.cells : side.cells);
  // The mirror image lies nearer to the cell with each fold, so this ends.
  const int mirrored = below ? -2 * side.cells - 1 - offset : 2 * side.cells + 1 - offset;
  auto at = extended<Anisotropic, D>(stencil, fields, metric, corrections, scale, anisotropic, mirrored);
  const int face = below ? -side.cells : side.cells + 1;
  const auto normal = face_normal<D>(metric.half_n + face * metric.stride, metric.pitch);
  const auto sign = [](Extension law, Extension odd) { return Real(law == odd ? -1 : 1); };
  const int ghost = below ? -side.cells - 1 - offset : offset - side.cells - 1;
  const typename AnisotropicStencil<D, Real>::Weld* weld = nullptr;
  if constexpr (Anisotropic)
    if (const auto& of = anisotropic->welds[below ? 0 : 1]; of.holds) weld = &of;
  if (side.p != Extension::interface) {
    at = {
        scaled(normal, sign(side.p, Extension::motionless), sign(side.s, Extension::motionless), at.v),
        scaled(normal, sign(side.p, Extension::traction_free), sign(side.s, Extension::traction_free), at.t)};
  } else {
    auto across =
        load<D>(fields, metric,
                below ? std::max(offset, face - side.beyond) : std::min(offset, face + side.beyond - 1));
    // A fluid has no traction along the face.
    const Real solid = stencil.solid ? 1 : 0;
    Real beyond_is_solid = side.share_s > 0 ? solid : 0;
    if constexpr (Anisotropic)
      if (weld && side.share_s > 0) beyond_is_solid = 1;
    at.t = scaled(normal, Real(1), solid, at.t);
    across.t = scaled(normal, Real(1), beyond_is_solid, across.t);
    const Real p = 2 * Real(side.share_p), s = 2 * Real(side.share_s);
    if (!Anisotropic || !weld)
      at = {at.v + scaled(normal, p, s, across.v - at.v),
            at.t + scaled(normal, 2 - p, solid * (2 - s), across.t - at.t)};
    if constexpr (Anisotropic)
      if (weld)
        at = {at.v + Real(2) * through<D>(weld->share, across.v - at.v),
              at.t + Real(2) * tractions_through<D>(weld->share, across.t - at.t)};
  }
  if (side.slot >= 0)
    add_correction<Anisotropic>(stencil, side, normal, corrections, ghost, below ? scale : -scale, weld, at);
  return at;
}

template <int D, class Real>
void put_outgoing(const RowVector<D, Real>& up, const RowVector<D, Real>& down,
                  OutgoingWaves<Real> outgoing) {
  const auto all_up = components<D>(up), all_down = components<D>(down);
  for (int c = 0; c < D; ++c)
    outgoing.up(c)[0] = all_up[std::size_t(c)], outgoing.down(c)[0] = all_down[std::size_t(c)];
}

/// The outgoing waves of an anisotropic cell (F12), (F15), from velocities and tractions at the places of its
/// stencil.
template <int Order, int D, class Real>
void reconstruct_anisotropic(const RowWaves<D, Real>& waves,
                             const std::array<Motion<D, Real>, std::size_t(Order)>& at, Real scale, Real b,
                             const BentAcross<Real>& metric, OutgoingWaves<Real> outgoing) {
  constexpr int reach = reach_of(Order);
  const Real sign = scale < 0 ? -1 : 1;
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
    reconstruct_cell<Order>(v + reach, s + reach, 1, sign * z, sign * scale * (z * b), up, down);
    for (std::size_t c = 0; c < D; ++c)
      all_up[c] += behind.motions[wave][c] * up, all_down[c] += before.motions[wave][c] * down;
  }
  const auto resolved = [&](const std::array<Real, std::size_t(D)>& all, std::int64_t face) {
    const auto of = bent_face<D>(face_normal<D>(metric.half_n + face, metric.pitch));
    return resolved_on_face<D>(row_vector<D>(all), of.normal, of.over);
  };
  put_outgoing<D>(resolved(all_up, metric.stride), resolved(all_down, 0), outgoing);
}

template <int Order, bool Anisotropic, int D, class Real>
void correct_cell(const BentStencil& stencil, Real scale, const BentFields<const Real>& fields, Real b,
                  Real zp, Real zs, const BentAcross<Real>& metric,
                  const InterfaceCorrections<D, Real>& corrections,
                  const AnisotropicStencil<D, Real>* anisotropic, OutgoingWaves<Real> outgoing) {
  constexpr int reach = reach_of(Order);
  std::array<Motion<D, Real>, 2 * reach + 1> at;
  for (int k = -reach; k <= reach; ++k) {
    const int position = k + reach;
    at[std::size_t(position)] =
        extended<Anisotropic, D>(stencil, fields, metric, corrections, scale, anisotropic, k);
  }
  if constexpr (Anisotropic)
    if (anisotropic->own_waves)
      return reconstruct_anisotropic<Order>(anisotropic->waves, at, scale, b, metric, outgoing);
  const Real sign = scale < 0 ? -1 : 1;
  const Real courant = sign * scale * b * metric.stretch[0];
  const BentCell<D, Real> cell = {face_normal<D>(metric.half_n, metric.pitch),
                                  face_normal<D>(metric.half_n + metric.stride, metric.pitch),
                                  courant * zp,
                                  courant * zs,
                                  sign * zp,
                                  sign * zs,
                                  zs > 0};
  RowVector<D, Real> up, down;
  reconstruct_bent_cell<Order, D>([&](long k) { return at[std::size_t(k + reach)].v; },
                                  [&](long k) { return at[std::size_t(k + reach)].t; }, cell, up, down);
  put_outgoing<D>(up, down, outgoing);
}

template <int D, class Real>
using CorrectCell = void(const BentStencil&, Real, const BentFields<const Real>&, Real, Real, Real,
                         const BentAcross<Real>&, const InterfaceCorrections<D, Real>&,
                         const AnisotropicStencil<D, Real>*, OutgoingWaves<Real>);
template <bool Anisotropic, int D, class Real, int... N>
constexpr std::array<CorrectCell<D, Real>*, sizeof...(N)> correctors(std::integer_sequence<int, N...>) {
  return {correct_cell<orders[N], Anisotropic, D, Real>...};
}

}  // namespace

template <int D, class Real>
BentStencils<D, Real>::BentStencils(const Domain<D>& domain, int reach,
                                    const InterfaceCorrections<D, Real>& corrections,
                                    const Metric<D, Real>& metric) {
  if (domain.bent_rows.empty()) return;
  const auto& grid = domain.grid;
  const std::int64_t nx = grid.shape[0], lines = grid.size() / nx;
  starts_.assign(1, 0);
  for (std::int64_t line = 0; line < lines; ++line) {
    auto at = grid.index(line * nx);
    for (at[0] = 0; at[0] < nx && domain.bent(at[D - 1]); ++at[0]) {
      const Column<D> up(domain, at, -1), down(domain, at, +1);
      const double z_p = domain.impedance(wave_p)(at), z_s = domain.impedance(wave_s)(at);
      if (z_p == 0) {
        cells_.push_back({std::int32_t(at[0]), not_carried, false, {}, {}});
        continue;
      }
      bool inside = false;
      auto low = side_of(up, domain.edges[D - 1][0], reach, inside);
      auto high = side_of(down, domain.edges[D - 1][1], reach, inside);
      for (auto* side : {&low, &high}) {
        Index<D> face = at;
        face[D - 1] += side == &low ? -low.cells : high.cells + 1;
        if (side->p != Extension::none) side->slot = corrections.slot(face);
      }
      const int to_contrast = std::min(cells_to_contrast(up, reach), cells_to_contrast(down, reach));
      if (inside) {
        int within = reach_within(low, high, reach_up_to(to_contrast, most_reach_at_mirrors, reach));
        for (const auto* side : {&low, &high})
          if (side->slot >= 0) within = reach_up_to(side->cells, most_reach_at_contrasts, within);
        cells_.push_back({std::int32_t(at[0]), std::int8_t(within), z_s > 0, low, high});
        continue;
      }
      const int to_free = fewest_cells_to(Extension::traction_free, low, high, reach);
      const int within = reach_up_to(std::min(to_contrast, to_free), most_reach_at_contrasts, reach);
      if (within < reach) {
        BentStencil::Side open;
        open.cells = std::int8_t(reach);
        cells_.push_back({std::int32_t(at[0]), std::int8_t(within), z_s > 0, open, open});
      }
    }
    starts_.push_back(std::int64_t(cells_.size()));
  }
  find_anisotropic(domain, metric);
}

template <int D, class Real>
RowWaves<D, Real> BentStencils<D, Real>::own_waves(const Domain<D>& domain, const Index<D>& at,
                                                   const BentAcross<Real>& of) {
  const auto waves = waves_across_rows<D>(elasticity_at(domain, at), of);
  RowWaves<D, Real> rounded;
  for (std::size_t wave = 0; wave < D; ++wave) {
    rounded.courant_z[wave] = Real(waves.courant_z[wave]);
    for (const std::size_t side : {0, 1}) {
      rounded.faces[side].z[wave] = Real(waves.faces[side].z[wave]);
      for (std::size_t c = 0; c < D; ++c)
        rounded.faces[side].motions[wave][c] = Real(waves.faces[side].motions[wave][c]);
    }
  }
  return rounded;
}

template <int D, class Real>
void BentStencils<D, Real>::find_weld(const Domain<D>& domain, const Index<D>& near, const Index<D>& beyond,
                                      const RowVector<D, Real>& normal, typename Anisotropic::Weld& weld) {
  weld.holds = true;
  const auto impedance = [&](const Index<D>& at) {
    return impedance_across_rows<D>(elasticity_at(domain, at), normal_in_grid<D>(normal));
  };
  const auto other = impedance(beyond);
  const auto share = product_of(inverse_of(sum_of(impedance(near), other, 1.)), other);
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) weld.share[i][k] = Real(share[i][k]);
}

template <int D, class Real>
void BentStencils<D, Real>::find_anisotropic(const Domain<D>& domain, const Metric<D, Real>& metric) {
  if (!domain.anisotropic()) return;
  const auto unlike_isotropic = [&](const Index<D>& at) { return anisotropic_across_rows(domain, at); };
  anisotropic_of_.assign(cells_.size(), -1);
  for (std::int64_t line = 0; line + 1 < std::int64_t(starts_.size()); ++line) {
    const auto first_of_line = domain.grid.index(line * domain.grid.shape[0]);
    for (auto n = std::size_t(starts_[std::size_t(line)]), end = std::size_t(starts_[std::size_t(line) + 1]);
         n < end; ++n) {
      const auto& cell = cells_[n];
      if (cell.reach == not_carried) continue;
      auto at = first_of_line;
      at[0] = cell.x;
      const auto of = metric.across(first_of_line, at[0]);
      Anisotropic found;
      found.own_waves = domain.anisotropic_cell(at);
      if (found.own_waves) found.waves = own_waves(domain, at, of);
      bool welded = false;
      for (const std::size_t side : {0, 1}) {
        const auto& end_of = side ? cell.high : cell.low;
        if (end_of.p != Extension::interface) continue;
        auto near = at, beyond = at;
        near[D - 1] += side ? end_of.cells : -end_of.cells;
        beyond[D - 1] = near[D - 1] + (side ? 1 : -1);
        if (!unlike_isotropic(near) && !unlike_isotropic(beyond)) continue;
        const auto face = (side ? beyond : near)[D - 1] - at[D - 1];
        find_weld(domain, near, beyond, face_normal<D>(of.half_n + face * of.stride, of.pitch),
                  found.welds[side]);
        welded = true;
      }
      if (!found.own_waves && !welded) continue;
      anisotropic_of_[n] = std::int32_t(anisotropic_.size());
      anisotropic_.push_back(found);
    }
  }
}

template <int D, class Real>
void BentStencils<D, Real>::correct(int order, std::int64_t line, const IndexRange& columns, Real scale,
                                    const BentFields<const Real>& fields, const MaterialRows<Real>& material,
                                    const BentAcross<Real>& metric,
                                    const InterfaceCorrections<D, Real>& corrections,
                                    OutgoingWaves<Real> outgoing) const {
  constexpr auto all_orders = std::make_integer_sequence<int, order_count>();
  static constexpr auto correct_as = correctors<false, D, Real>(all_orders),
                        correct_anisotropic_as = correctors<true, D, Real>(all_orders);
  const auto stop = cells_.begin() + starts_[std::size_t(line) + 1];
  auto cell = std::lower_bound(cells_.begin() + starts_[std::size_t(line)], stop, columns.first,
                               [](const BentStencil& stencil, std::int64_t x) { return stencil.x < x; });
  for (; cell != stop && cell->x < columns.last; ++cell) {
    const auto i = cell->x - columns.first;
    if (cell->reach == not_carried) {
      for (int c = 0; c < D; ++c) outgoing.up(c)[i] = outgoing.down(c)[i] = 0;
      continue;
    }
    const auto within = std::size_t(std::min<int>(cell->reach, reach_of(order)));
    const auto place = anisotropic_of_.empty() ? -1 : anisotropic_of_[std::size_t(cell - cells_.begin())];
    (place < 0 ? correct_as : correct_anisotropic_as)[within](
        *cell, scale, {fields.first + i, fields.pitch, fields.stride}, material.b[i], material.zp[i],
        material.zs[i], {metric.half_n + i, metric.pitch, metric.stride, metric.stretch + i}, corrections,
        place < 0 ? nullptr : &anisotropic_[std::size_t(place)], outgoing.at(i));
  }
}

template class BentStencils<2, float>;
template class BentStencils<2, double>;
template class BentStencils<3, float>;
template class BentStencils<3, double>;

}  // namespace slipwave::solver
