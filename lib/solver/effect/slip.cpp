// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/slip.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "scene/subdomains.hpp"

namespace slipwave::solver {

template <int D, class Real>
Slip<D, Real>::Slip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s,
                    double unit)
    : state_(state), domain_(domain), dt_s_(dt_s), unit_(unit), correction_(scene.numerics.correction) {
  const auto askew = askew_sets(scene);
  for (std::size_t set = 0; set < scene.model.fracture_sets.size(); ++set) {
    if (!slides(scene.model.fracture_sets[set])) continue;
    for (const auto kind : {CellKind::whole, CellKind::cut}) {
      if (kind == CellKind::cut && scene.model.fracture_share.empty()) continue;
      SlipGroup<D, Real> group(state.layout, domain, scene, {set, kind, askew[set][kind == CellKind::cut]},
                               dt_s, unit);
      if (group.cells() == 0) continue;
      if (scene.slip_diary) diary_.emplace_back(std::size_t(group.stored_cells()));
      group.rest();
      opens_ |= group.opens();
      groups_.push_back(std::move(group));
    }
  }
}

/// Applies these acts, one after the other, to all segments of fracture cells in these columns. Columns end
/// between two vectors or with the row.
template <int D, class Real>
void Slip<D, Real>::each_segment(const RowFields<Real>& fields, const IndexRange& columns,
                                 std::initializer_list<SlipAct> acts) {
  const std::int64_t end =
      columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last;
  const std::int64_t line = fields.row, pitch = fields.pitch;
  Real* const stress = fields.field(FieldRows<D>::normal_stress(0));
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const auto& segment : groups_[g].segments(line)) {
      const std::int64_t first = std::max(segment.first, columns.first), last = std::min(segment.last, end);
      if (first >= last) continue;
      const auto place = segment.place + std::size_t(first - segment.first);
      if (diary_.empty()) {
        for (const auto act : acts) groups_[g].act(act, stress + first, pitch, place, last - first);
        continue;
      }
      constexpr std::int64_t piece = 64;
      Real before[SymmetricTensor<D, Real>::components * piece];
      for (std::int64_t done = 0; done < last - first; done += piece) {
        const std::int64_t n = std::min(piece, last - first - done);
        Real* const now = stress + first + done;
        for (const auto act : acts) {
          for (int c = 0; c < SymmetricTensor<D, Real>::components; ++c)
            std::copy(now + c * pitch, now + c * pitch + n, before + c * piece);
          groups_[g].act(act, now, pitch, place + std::size_t(done), n);
          record(g, place + std::size_t(done), n, before, now, pitch, act);
        }
      }
    }
}

/// The decrease of stress by the planes of n cells is a strain, and stress times that an energy (S14).
template <int D, class Real>
void Slip<D, Real>::record(std::size_t group, std::size_t place, std::int64_t n, const Real* before,
                           const Real* after, std::int64_t pitch, SlipAct act) {
  constexpr int components = SymmetricTensor<D, Real>::components;
  const std::int64_t piece = 64;
  const bool centred = correction_ == SlipCorrection::centred;
  for (std::int64_t i = 0; i < n; ++i) {
    const auto at = place + std::size_t(i);
    const double mu = groups_[group].shear_modulus(at), lambda = groups_[group].lambda(at);
    if (!(mu > 0)) continue;
    if (const auto* const stiffness = groups_[group].stiffness(at)) {
      record_askew(group, at, *stiffness, i, before, after, pitch, act);
      continue;
    }
    auto& entry = diary_[group][at];
    const auto prestress = groups_[group].prestress(at);
    double square = 0, mean = 0, of_prestress = 0;
    double off_trace = 0, mean_trace = 0, prestress_trace = 0;
    for (int c = 0; c < components; ++c) {
      const double twice = c < D ? 1 : 2;  // off-diagonal components stand for two
      const double was = before[c * piece + i], is = after[c * pitch + i], off = was - is;
      const double stays = prestress.values[std::size_t(c)];
      auto& ahead = entry.taken_ahead.values[std::size_t(c)];
      const double in_step = centred && act == SlipAct::slip ? ahead + off : off;
      if (centred && act == SlipAct::begin) ahead = off;
      square += twice * in_step * in_step;
      mean += twice * off * (was + is) / 2;
      of_prestress += twice * off * stays;
      if (c >= D) continue;
      off_trace += off, mean_trace += (was + is) / 2, prestress_trace += stays;
    }
    // Slip does not change the trace of the stress; opening does.
    const double share = off_trace * lambda / (2 * mu + D * lambda);
    entry.out_of_waves += (mean - share * mean_trace) / (2 * mu);
    entry.heat += (mean + of_prestress - share * (mean_trace + prestress_trace)) / (2 * mu);
    // What is taken off ahead is no slip yet.
    if (act == SlipAct::open || (centred && act == SlipAct::begin)) continue;
    const double strain = std::sqrt(square / 2) / mu;
    if (act == SlipAct::slip) entry.in_step = entry.ahead + strain;
    entry.ahead = act == SlipAct::slip ? 0 : strain;
    entry.slip += strain;
  }
}

/// Records the slip of one cell in which planes lie askew to the axes of anisotropic rock; they do not open.
template <int D, class Real>
void Slip<D, Real>::record_askew(std::size_t group, std::size_t at, const Elasticity<D>& stiffness,
                                 std::int64_t i, const Real* before, const Real* after, std::int64_t pitch,
                                 SlipAct act) {
  constexpr std::int64_t piece = 64;
  const bool centred = correction_ == SlipCorrection::centred;
  auto& entry = diary_[group][at];
  const auto prestress = groups_[group].prestress(at);
  constexpr std::size_t components = SymmetricTensor<D, Real>::components;
  std::array<double, components> off{}, mean{}, in_step{};
  for (std::size_t c = 0; c < components; ++c) {
    const double was = double(before[std::int64_t(c) * piece + i]),
                 is = double(after[std::int64_t(c) * pitch + i]);
    auto& ahead = entry.taken_ahead.values[c];
    off[c] = was - is, mean[c] = (was + is) / 2;
    in_step[c] = centred && act == SlipAct::slip ? ahead + off[c] : off[c];
    if (centred && act == SlipAct::begin) ahead = off[c];
  }
  // Shear strains are doubled.
  const auto strain = strain_of_stress<D>(stiffness, off), slip = strain_of_stress<D>(stiffness, in_step);
  for (std::size_t c = 0; c < components; ++c) {
    entry.out_of_waves += strain[c] * mean[c];
    entry.heat += strain[c] * (mean[c] + double(prestress.values[c]));
  }
  if (act == SlipAct::open || (centred && act == SlipAct::begin)) return;
  double along_axes = 0, shear = 0;
  for (std::size_t c = 0; c < components; ++c) (c < D ? along_axes : shear) += slip[c] * slip[c];
  const double size = std::sqrt(2 * along_axes + shear);
  if (act == SlipAct::slip) entry.in_step = entry.ahead + size;
  entry.ahead = act == SlipAct::slip ? 0 : size;
  entry.slip += size;
}

template <int D, class Real>
void Slip<D, Real>::apply(const StepTime&, const RowFields<Real>& fields, const IndexRange& cells) {
  if (opens_)
    each_segment(fields, cells, {SlipAct::open, SlipAct::slip});
  else
    each_segment(fields, cells, {SlipAct::slip});
}

template <int D, class Real>
void Slip<D, Real>::apply_after_record(const StepTime&, const RowFields<Real>& fields,
                                       const IndexRange& cells) {
  if (correction_ == SlipCorrection::first && diary_.empty()) return;
  each_segment(fields, cells, {SlipAct::begin});
}

template <int D, class Real>
void Slip<D, Real>::exchange(const IndexRange& rows, const std::function<void(Real*, std::int64_t)>& to) {
  const auto lines_a_row = state_.layout.lines() / state_.layout.shape()[D - 1];
  for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
    for (auto& group : groups_) group.exchange(line, to);
}

template <int D, class Real>
std::string Slip<D, Real>::name() const {
  return std::string("slip, ") + name_of(correction_);
}

template <int D, class Real>
std::int64_t Slip<D, Real>::cells() const {
  std::int64_t sum = 0;
  for (const auto& group : groups_) sum += group.cells();
  return sum;
}

template <int D, class Real>
std::vector<EffectShare> Slip<D, Real>::shares() const {
  std::vector<EffectShare> all = {{name(), cells()}};
  const auto add = [&](const std::string& what, const auto& has) {
    std::int64_t sum = 0;
    for (const auto& group : groups_) sum += has(group) ? group.cells() : 0;
    if (sum > 0) all.push_back({what, sum});
  };
  const auto any = [](const auto& group, const auto& of_system) {
    return std::any_of(group.set().systems.begin(), group.set().systems.end(), of_system);
  };
  add("  friction", [&](const auto& g) { return any(g, [](const auto& s) { return s.friction > 0; }); });
  add("  viscosity", [&](const auto& g) { return any(g, [](const auto& s) { return s.viscosity_s > 0; }); });
  add("  cohesion", [&](const auto& g) { return any(g, [](const auto& s) { return s.strength_pa > 0; }); });
  add("  slip weakening", [&](const auto& g) {
    return any(g, [](const auto& s) { return s.law == FrictionLaw::slip_weakening; });
  });
  add("  blocks", [](const auto& g) { return g.set().systems.size() > 1; });
  add("  prestress", [](const auto& g) { return g.has_prestress(); });
  add("  opening", [](const auto& g) { return g.opens(); });
  if (!diary_.empty()) all.push_back({"  slip diary", cells()});
  return all;
}

template <int D, class Real>
void Slip<D, Real>::serialize(Archive& archive) {
  for (auto& group : groups_)
    for (auto* const memory : group.memory()) archive.fixed(*memory);
  for (auto& entries : diary_) archive.fixed(entries);
}

template <int D, class Real>
Field<D> Slip<D, Real>::field(SlipField which) const {
  Field<D> field(domain_.model_grid);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::int64_t line = 0; line < state_.layout.lines(); ++line)
      for (const auto& segment : groups_[g].segments(line))
        for (std::int64_t x = segment.first; x < std::min(segment.last, state_.layout.shape()[0]); ++x) {
          const auto place = segment.place + std::size_t(x - segment.first);
          if (!groups_[g].holds(place)) continue;
          auto at = state_.layout.line_index(line);
          at[0] = x;
          if (!domain_.in_model(at)) continue;
          const Entry none;
          const auto& entry = diary_.empty() ? none : diary_[g][place];
          field(domain_.model_cell(at)) =
              float(which == SlipField::slip         ? (entry.slip - entry.ahead) / unit_
                    : which == SlipField::slip_rate  ? entry.in_step / dt_s_ / unit_
                    : which == SlipField::dissipated ? entry.heat / (unit_ * unit_)
                                                     : double(groups_[g].gap(place)) / unit_);
        }
  return field;
}

template <int D, class Real>
SlipTotals Slip<D, Real>::totals() const {
  SlipTotals totals;
  const double square = std::pow(domain_.grid.spacing_m, D - 1);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::int64_t line = 0; line < state_.layout.lines(); ++line) {
      if (!domain_.owns(state_.layout.line_index(line)[D - 1])) continue;
      for (const auto& segment : groups_[g].segments(line))
        for (auto place = segment.place; place < segment.place + std::size_t(segment.last - segment.first);
             ++place) {
          auto cell = state_.layout.line_index(line);
          cell[0] = segment.first + std::int64_t(place - segment.place);
          if (!domain_.in_model(cell)) continue;
          totals.cells += groups_[g].holds(place);
          if (diary_.empty()) continue;
          const auto& entry = diary_[g][place];
          totals.slipped += entry.slip > 0;
          const double volume =
              square * domain_.model_grid.height(domain_.model_cell(cell)) / (unit_ * unit_);
          totals.dissipated += volume * entry.heat;
          totals.out_of_waves += volume * entry.out_of_waves;
        }
    }
  return totals;
}

template <int D, class Real>
std::int64_t Slip<D, Real>::memory_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& group : groups_) bytes += group.memory_bytes();
  for (const auto& diary : diary_) bytes += std::int64_t(diary.size() * sizeof(Entry));
  return bytes;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Slip);

}  // namespace slipwave::solver
