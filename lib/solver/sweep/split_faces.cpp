// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/split_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/instantiate.hpp"
#include "solver/sweep/motion_along.hpp"

namespace slipwave::solver {
namespace {

/// Stiffer fractures are welded, as far as numbers go.
constexpr double most_stiffness = 1e6;

/// How stiff a plane is for what stencils read across it (S36). One that slides or stands open moves by
/// itself: what they may read across is what holds back a tip, behind its spring.
template <class Real>
Real stiffness_to_stencils(double spring, double held, bool loose) {
  if (!loose) return Real(std::min(spring, most_stiffness));
  if (!(held > 0)) return 0;
  return Real(std::min(1 / (1 / spring + 1 / held), most_stiffness));
}

}  // namespace

template <int D, class Real>
SplitFaces<D, Real>::SplitFaces(const State<D, Real>& state, const Domain<D>& domain, double dt_s,
                                double unit)
    : state_(state), spacing_m_(domain.grid.spacing_m), unit_(unit), dt_s_(dt_s), own_(domain.own) {
  for (auto& of_pair : images_) of_pair.resize(2 * domain.split.size());
  for (const auto& split : domain.split) {
    Face face{};
    place(face, domain, split, dt_s);
    faces_.push_back(face);
  }
  for (auto& face : faces_) find_along(face);
  tractions_.assign(faces_.size() * D, 0);
  retained_.assign(faces_.size() * 2 * D, 0);
  if (std::none_of(faces_.begin(), faces_.end(), [](const Face& face) { return face.law.any(); })) return;
  slips_.resize(faces_.size());
  work_.resize(faces_.size());
  if (std::any_of(faces_.begin(), faces_.end(), [](const Face& face) { return face.law.has_state(); }))
    paths_m_.assign(faces_.size(), 0);
  // As a sweep leaves them at rest, to the last bit: sweeps pass over rock that no wave has reached.
  for (std::size_t n = 0; n < faces_.size(); ++n) slips_[n].stiffness = solve(n, {}, 1).stiffness;
}

template <int D, class Real>
void SplitFaces<D, Real>::place(Face& face, const Domain<D>& domain, const SplitFace<D>& split, double dt_s) {
  const auto& layout = state_.layout;
  const auto before = split.before();
  face.axis = split.axis;
  face.inside = split.behind[std::size_t(split.axis)] > 0;
  face.line = layout.line_number(split.behind), face.x = split.behind[0];
  face.cells = {layout.cell(before), layout.cell(split.behind)};
  face.compliance.fill(split.tangential_m_per_pa);
  face.compliance[0] = split.normal_m_per_pa;
  face.law = split.law;
  const auto b_of = [&](Index<D> at) {
    const auto x = at[0];
    at[0] = 0;
    return double(state_.material_row(at, row_b)[x]);
  };
  for (std::size_t pair = 0; pair < D; ++pair) {
    const auto& impedance = domain.impedance_of_pair(split.axis, int(pair));
    const double lo = impedance(before), hi = impedance(split.behind);
    const double relaxation = dt_s / (face.compliance[pair] * lo * hi / (lo + hi));
    face.relaxation[pair] = Real(std::min(relaxation, double(std::numeric_limits<float>::max())));
    // Mean time in steps that the wave takes through half a cell, of both sides.
    const double half_cell = (1 / (lo * b_of(before)) + 1 / (hi * b_of(split.behind))) / 4;
    face.impedance[pair] = lo * hi / (lo + hi), face.half_cell[pair] = Real(half_cell);
    for (const std::size_t side : {0, 1}) {
      auto& image = images_[pair][2 * faces_.size() + side];
      image.stiffness = Real(std::min(relaxation * half_cell, most_stiffness));
      image.share_v = Real(2 * (side == 0 ? hi : lo) / (lo + hi));
      image.share_s = Real(2 - image.share_v);
    }
  }
}

/// Differences along the face need its neighbours, and no other fracture that crosses between them.
template <int D, class Real>
void SplitFaces<D, Real>::find_along(Face& face) const {
  const auto along = std::size_t(face.axis == 0 ? D - 1 : 0);
  auto line = state_.layout.line_index(face.line);
  line[0] = face.x;
  bool all = !crossed(face);
  for (std::size_t k = 0; k < offsets_along.size(); ++k) {
    auto at = line;
    at[along] += offsets_along[k];
    const auto x = at[0];
    at[0] = 0;
    const bool is_there = at[along] >= 0 && at[along] < state_.layout.shape()[along];
    const auto [first, last] =
        is_there ? find(face.axis, state_.layout.line_number(at), {x, x + 1}) : std::array<std::size_t, 2>{};
    all = all && first < last;
    face.along[k] = std::int32_t(first);
  }
  if (!all) face.along.fill(-1);
}

/// Whether a fracture across the other axis lies within reach of the differences along a face, on either
/// side.
template <int D, class Real>
bool SplitFaces<D, Real>::crossed(const Face& face) const {
  const int other = face.axis == 0 ? D - 1 : 0;
  const auto across = std::size_t(face.axis), along = std::size_t(other);
  for (const int side : {-1, 0})
    for (int n = offsets_along.front() + 1; n <= offsets_along.back(); ++n) {
      auto at = state_.layout.line_index(face.line);
      at[0] = face.x;
      at[across] += side, at[along] += n;
      const auto x = at[0];
      at[0] = 0;
      if (at[D - 1] < 0 || at[D - 1] >= state_.layout.shape()[D - 1]) continue;
      const auto [first, last] = find(other, state_.layout.line_number(at), {x, x + 1});
      if (first < last) return true;
    }
  return false;
}

template <int D, class Real>
std::array<std::size_t, 2> SplitFaces<D, Real>::find(int axis, std::int64_t line,
                                                     const IndexRange& columns) const {
  const auto at = [&](std::int64_t x) {
    const auto found = std::lower_bound(
        faces_.begin(), faces_.end(), std::tie(axis, line, x),
        [](const Face& face, const auto& wanted) { return std::tie(face.axis, face.line, face.x) < wanted; });
    return std::size_t(found - faces_.begin());
  };
  return {at(columns.first), at(columns.last)};
}

template <int D, class Real>
bool SplitFaces<D, Real>::any(int axis) const {
  return std::any_of(faces_.begin(), faces_.end(), [axis](const Face& face) { return face.axis == axis; });
}

template <int D, class Real>
bool SplitFaces<D, Real>::beside(int axis, std::int64_t line) const {
  auto next = state_.layout.line_index(line);
  const auto [first, last] = find(axis, line, whole_line());
  if (first < last || axis == 0) return first < last;
  if (++next[std::size_t(axis)] >= state_.layout.shape()[std::size_t(axis)]) return false;
  const auto [of_next, end] = find(axis, state_.layout.line_number(next), whole_line());
  return of_next < end;
}

template <int D, class Real>
bool SplitFaces<D, Real>::at_rest(std::int64_t line, const IndexRange& columns) const {
  for (int axis = 0; axis < D; ++axis) {
    const auto [first, last] = find(axis, line, columns);
    if (std::any_of(tractions_.begin() + std::ptrdiff_t(first * D),
                    tractions_.begin() + std::ptrdiff_t(last * D),
                    [](Real traction) { return traction != 0; }))
      return false;
  }
  return true;
}

/// What the images gain from motion along the face, as at a free surface (E11), and from the spring.
template <int D, class Real>
void SplitFaces<D, Real>::put_images(std::size_t n) {
  using Rows = FieldRows<D>;
  const Face& face = faces_[n];
  if (!face.inside) return;
  const int along = face.axis == 0 ? D - 1 : 0;
  const auto pitch = state_.layout.row_pitch();
  const auto velocity = [&](std::size_t of, std::size_t side, int row) {
    return face.axis == 0 ? retained_[(2 * of + side) * D + std::size_t(row)]
                          : state_.fields.data()[faces_[of].cells[side] + row * pitch];
  };
  for (const std::size_t side : {0, 1}) {
    const auto slope = [&](int row) {
      Real sum = 0;
      for (std::size_t k = 0; face.along[k] >= 0 && k < offsets_along.size(); ++k)
        sum += Real(weights_along[k]) * velocity(std::size_t(face.along[k]), side, row);
      return sum;
    };
    auto line = state_.layout.line_index(face.line);
    auto x = face.x;
    if (side == 0) face.axis == 0 ? --x : --line[std::size_t(face.axis)];
    const auto material = state_.material_from(line, x, face.axis);
    const Real zp = *material.zp, zs = *material.zs, b = *material.b, outward = side == 0 ? -1 : 1;
    const Real lambda = zp * zp - 2 * zs * zs;
    const Real stretched = slope(Rows::velocity(along)), turned = slope(Rows::velocity(face.axis));
    const std::array<Real, 2> bend{lambda / (zp * zp) * stretched, turned};
    const std::array<Real, 2> traction{b * lambda * stretched, b * zs * zs * turned};
    for (const std::size_t pair : {0, 1}) {
      auto& image = images_[pair][2 * n + side];
      image.v = outward * bend[pair];
      image.swept = traction[pair];
      image.s = 2 * tractions_[n * D + pair];
      if (face.law.any()) image.stiffness = slips_[n].stiffness[pair];
    }
  }
}

template <int D, class Real>
void SplitFaces<D, Real>::update(std::int64_t row, const IndexRange& columns) {
  Index<D> at{};
  at[D - 1] = row;
  if (row >= state_.layout.shape()[D - 1]) return;
  const auto [first, last] = find(D - 1, state_.layout.line_number(at), columns);
  for (auto n = first; n < last; ++n) put_images(n);
}

template <int D, class Real>
void SplitFaces<D, Real>::update_all() {
  for (std::size_t n = 0; n < faces_.size(); ++n)
    if (faces_[n].axis == D - 1) put_images(n);
}

template <int D, class Real>
void SplitFaces<D, Real>::update_line(std::int64_t line, const IndexRange& columns) {
  const auto [first, last] = find(0, line, columns);
  for (auto n = first; n < last; ++n) put_images(n);
}

template <int D, class Real>
void SplitFaces<D, Real>::retain(std::int64_t line, const IndexRange& columns) {
  const auto [first, last] = find(0, line, columns);
  for (auto n = first; n < last; ++n)
    for (const std::size_t side : {0, 1})
      for (int row = 0; row < D; ++row)
        retained_[(2 * n + side) * D + std::size_t(row)] =
            state_.fields.data()[faces_[n].cells[side] + row * state_.layout.row_pitch()];
}

/// Solves a face with friction whose traction is that of `welded` rock, in a sweep over `size` of the step.
template <int D, class Real>
typename SplitFaces<D, Real>::Swept SplitFaces<D, Real>::solve(std::size_t n,
                                                               const std::array<Real, D>& welded,
                                                               Real size) const {
  const Face& face = faces_[n];
  const auto& law = face.law;
  const double time_s = dt_s_ * double(size);
  const auto load = [&](std::size_t pair) {
    const double resting = law.prestress_pa[pair];
    return FaceLoad{
        double(welded[pair]) / unit_ + resting, double(tractions_[n * D + pair]) / unit_ + resting,
        double(face.relaxation[pair]) * double(size), law.held_pa_m[pair] * time_s / face.impedance[pair]};
  };
  // Traction that holds a jump of 1 m in the sweep.
  const auto per_m = [&](std::size_t pair) { return face.impedance[pair] / time_s; };
  const auto across = load(0), along = load(1);
  const double opening_m = double(slips_[n].opening) / unit_, slip_m = double(slips_[n].slip) / unit_;
  Swept swept{};
  swept.motion[0] = law.opens ? part_face(across, opening_m * per_m(0)) : give_face(across);
  const double path_m = paths_m_.empty() ? 0 : double(paths_m_[n]);
  swept.motion[1] =
      slide_face(law, along, swept.motion[0], {slip_m * per_m(1), path_m, 1 / per_m(1), face.impedance[1]});
  for (const std::size_t pair : {0, 1}) {
    const auto& motion = swept.motion[pair];
    const double half_cell = double(face.half_cell[pair]);
    const double held = law.held_pa_m[pair] * dt_s_ / face.impedance[pair] * half_cell;
    swept.moved_m[pair] = motion.moved / per_m(pair);
    swept.stiffness[pair] =
        stiffness_to_stencils<Real>(double(face.relaxation[pair]) * half_cell, held, motion.loose);
    swept.change[pair] = Real((motion.mean - (pair == 0 ? across : along).welded) * unit_);
  }
  return swept;
}

/// The mean traction during the sweep less that of the welded face.
template <int D, class Real>
std::array<Real, D> SplitFaces<D, Real>::changes_of(std::size_t n, const std::array<Real, D>& welded,
                                                    Real size) const {
  if (faces_[n].law.any()) return solve(n, welded, size).change;
  std::array<Real, D> changes{};
  for (std::size_t pair = 0; pair < D; ++pair) {
    if (faces_[n].compliance[pair] == 0) continue;
    const Real lag = faces_[n].relaxation[pair] * size;
    const Real kept = lag > 0 ? -std::expm1(-lag) / lag : Real(1);
    changes[pair] = kept * (tractions_[n * D + pair] - welded[pair]);
  }
  return changes;
}

template <int D, class Real>
void SplitFaces<D, Real>::advance(std::size_t n, const Swept& swept) {
  const Face& face = faces_[n];
  auto& slip = slips_[n];
  auto& work = work_[n];
  for (const std::size_t pair : {0, 1}) {
    const auto& motion = swept.motion[pair];
    const double resting = face.law.prestress_pa[pair];
    const double held = face.law.held_pa_m[pair], moved = swept.moved_m[pair];
    auto& so_far = pair == 0 ? slip.opening : slip.slip;
    // What holds back a tip stores its part.
    const double stored = held * (double(so_far) / unit_ + moved / 2);
    work.heat += (motion.mean - stored) * moved;
    work.out_of_waves += (motion.mean - resting - stored) * moved;
    so_far = Real(double(so_far) + moved * unit_);
    tractions_[n * D + pair] = Real((motion.end - resting) * unit_);
    slip.stiffness[pair] = swept.stiffness[pair];
    if (pair == 1 && motion.loose) slip.slid = 1;
  }
  if (!paths_m_.empty())
    paths_m_[n] = Real(std::min(double(paths_m_[n]) + std::abs(swept.moved_m[1]), most_slip_m));
  // What rounding leaves of it would be a plane that stands open.
  if (!swept.motion[0].loose) slip.opening = 0;
}

/// Puts that mean on one of its cells; `side` is 1 before the face and -1 behind it. Both cells see their own
/// wave come back.
template <int D, class Real>
void SplitFaces<D, Real>::add_to_cell(std::size_t n, std::int64_t line, std::int64_t x, Real scale,
                                      InterfaceStates<Real> face, std::int64_t i, Real side,
                                      const SweptRows<Real>& rows) const {
  const auto material = state_.material_from(state_.layout.line_index(line), x, faces_[n].axis);
  const Real b = *material.b, zp = *material.zp, zs = *material.zs, size = std::abs(scale);
  const auto changes = changes_of(n, tractions_at(face), size);
  for (std::size_t pair = 0; pair < D; ++pair) {
    if (changes[pair] == 0) continue;
    const Real moved = side * scale * b * changes[pair], strained = size * b * changes[pair];
    if (pair == 0) {
      rows.v[i] += moved;
      rows.s[i] += zp * strained;
      rows.passive[i] += (zp * zp - 2 * zs * zs) / zp * strained;
    } else {
      rows.vt[i] += moved;
      rows.st[i] += zs * strained;
    }
  }
}

/// Returns the tractions of all pairs of a face state.
template <int D, class Real>
std::array<Real, D> SplitFaces<D, Real>::tractions_at(InterfaceStates<Real> face) {
  std::array<Real, D> all;
  for (int pair = 0; pair < D; ++pair) all[std::size_t(pair)] = *face.s(pair);
  return all;
}

template <int D, class Real>
void SplitFaces<D, Real>::add(int axis, std::int64_t line, const IndexRange& columns, Real scale,
                              InterfaceStates<Real> lo, InterfaceStates<Real> hi, const SweptRows<Real>& rows,
                              bool remember) {
  auto next = state_.layout.line_index(line);
  const std::int64_t shift = axis == 0 ? 1 : 0;
  if (axis > 0) ++next[std::size_t(axis)];
  // The cells before their faces first: they need the tractions of the beginning.
  if (next[std::size_t(axis)] < state_.layout.shape()[std::size_t(axis)]) {
    const auto [first, last] =
        find(axis, state_.layout.line_number(next), {columns.first + shift, columns.last + shift});
    for (auto n = first; n < last; ++n) {
      const auto x = faces_[n].x - shift, i = x - columns.first;
      add_to_cell(n, line, x, scale, hi.at(i), i, 1, rows);
    }
  }
  const auto [first, last] = find(axis, line, columns);
  for (auto n = first; n < last; ++n) {
    if (!faces_[n].inside) continue;
    const auto i = faces_[n].x - columns.first;
    add_to_cell(n, line, faces_[n].x, scale, lo.at(i), i, -1, rows);
    if (!remember) continue;
    if (faces_[n].law.any()) {
      advance(n, solve(n, tractions_at(lo.at(i)), std::abs(scale)));
      continue;
    }
    for (int pair = 0; pair < D; ++pair) {
      Real& traction = tractions_[n * D + std::size_t(pair)];
      const Real welded = lo.s(pair)[i];
      const Real left = std::exp(-faces_[n].relaxation[std::size_t(pair)] * std::abs(scale));
      traction = welded + left * (traction - welded);
    }
  }
}

template <int D, class Real>
void SplitFaces<D, Real>::exchange(const IndexRange& rows,
                                   const std::function<void(Real*, std::int64_t)>& to) {
  const auto lines_a_row = state_.layout.lines() / state_.layout.shape()[D - 1];
  for (const int axis : {0, D - 1}) {
    const auto first = find(axis, rows.first * lines_a_row, whole_line())[0],
               last = find(axis, rows.last * lines_a_row, whole_line())[0];
    if (first == last) continue;
    to(tractions_.data() + first * D, std::int64_t(last - first) * D);
    if (slips_.empty()) continue;
    static_assert(sizeof(Slip) == reals_of_slip * sizeof(Real));
    to(&slips_[first].opening, std::int64_t(last - first) * reals_of_slip);
    if (!paths_m_.empty()) to(&paths_m_[first], std::int64_t(last - first));
  }
}

template <int D, class Real>
void SplitFaces<D, Real>::serialize(Archive& archive) {
  archive.fixed(tractions_);
  if (slips_.empty()) return;
  archive.fixed(slips_);
  archive.fixed(work_);
  if (!paths_m_.empty()) archive.fixed(paths_m_);
}

template <int D, class Real>
std::vector<EffectShare> SplitFaces<D, Real>::shares() const {
  std::vector<EffectShare> all = {{"fractures on faces", std::int64_t(faces_.size())}};
  const auto count = [&](const auto& has) {
    return std::int64_t(std::count_if(faces_.begin(), faces_.end(), has));
  };
  if (const auto sliding = count([](const Face& face) { return face.law.slides(); }); sliding > 0)
    all.push_back({"  friction", sliding});
  if (const auto weak = count([](const Face& face) { return face.law.has_state(); }); weak > 0)
    all.push_back({"  slip weakening", weak});
  if (const auto opening = count([](const Face& face) { return face.law.opens; }); opening > 0)
    all.push_back({"  opening", opening});
  return all;
}

template <int D, class Real>
void SplitFaces<D, Real>::report(ShotReport& report) const {
  report.energy_left += stored_energy();
  if (slips_.empty()) return;
  SlipTotals totals = report.slip.value_or(SlipTotals{});
  const double area = std::pow(spacing_m_, D - 1);
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    if (!faces_[n].law.any() || !owns(n)) continue;
    ++totals.cells;
    totals.slipped += slips_[n].slid > 0;
    totals.dissipated += area * work_[n].heat;
    totals.out_of_waves += area * work_[n].out_of_waves;
  }
  report.slip = totals;
}

template <int D, class Real>
bool SplitFaces<D, Real>::owns(std::size_t n) const {
  const auto row = state_.layout.line_index(faces_[n].line)[D - 1];
  return row >= own_.first && row < own_.last;
}

template <int D, class Real>
std::int64_t SplitFaces<D, Real>::memory_bytes() const {
  return bytes_of(faces_) + bytes_of(slips_) + bytes_of(work_) + bytes_of(paths_m_) + bytes_of(tractions_) +
         bytes_of(retained_) + bytes_of(images_);
}

/// Half of traction times jump, that is C times traction, of each face, and of what holds back tips. An open
/// one has no traction.
template <int D, class Real>
double SplitFaces<D, Real>::stored_energy() const {
  double energy = 0;
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    if (!owns(n)) continue;
    for (std::size_t pair = 0; pair < D; ++pair) {
      const double traction = double(tractions_[n * D + pair]) / unit_;
      if (traction != 0) energy += faces_[n].compliance[pair] * traction * traction / 2;
    }
    if (!faces_[n].law.any()) continue;
    const auto& held = faces_[n].law.held_pa_m;
    const double opening_m = double(slips_[n].opening) / unit_, slip_m = double(slips_[n].slip) / unit_;
    energy += (held[0] * opening_m * opening_m + held[1] * slip_m * slip_m) / 2;
  }
  return energy * std::pow(spacing_m_, D - 1);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class SplitFaces);

}  // namespace slipwave::solver
