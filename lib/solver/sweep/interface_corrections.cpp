// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/interface_corrections.hpp"

#include <algorithm>
#include <set>

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

/// Whether enough cells like this one lie behind it along an axis (`step` 1 or -1) and beside it.
template <int D>
bool extends_far(const Domain<D>& domain, const Index<D>& from, int across, int step) {
  Index<D> at = from;
  const bool is_void = domain.impedance(wave_p)(from) == 0;
  for (std::int64_t n = 1; n < fewest_across && !is_void; ++n) {
    Index<D> next = at;
    auto& place = next[std::size_t(across)];
    place += step;
    if (place < 0 || place >= domain.grid.shape[std::size_t(across)] || !alike(domain, at, next))
      return false;
    at = next;
  }
  for (int axis = 0; axis < D; ++axis) {
    if (axis == across) continue;
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

template <int D>
Index<D> before(Index<D> at, int axis) {
  --at[std::size_t(axis)];
  return at;
}

}  // namespace

template <int D>
bool corrects_interface(const Domain<D>& domain, const Index<D>& behind, int axis) {
  const auto ahead = before<D>(behind, axis);
  const auto carries = [&](Wave wave, const Index<D>& at) { return domain.impedance(wave)(at) > 0; };
  if (carries(wave_s, ahead) == carries(wave_s, behind)) return false;
  // Across the last axis alone rows have a metric.
  if (axis < D - 1 && !domain.curvilinear_rows.empty()) return false;
  const double z_ahead = domain.impedance(wave_p)(ahead), z_behind = domain.impedance(wave_p)(behind);
  if (z_ahead == 0 || z_behind == 0) {
    // Level rows have FreeSurface.
    if (axis < D - 1 || !domain.curvilinear(behind[D - 1] - (z_behind == 0 ? 1 : 0))) return false;
  } else if (z_ahead > gas_ratio * z_behind || z_behind > gas_ratio * z_ahead) {
    return false;
  }
  return extends_far(domain, ahead, axis, -1) && extends_far(domain, behind, axis, 1);
}

template <int D, class Real>
InterfaceCorrections<D, Real>::InterfaceCorrections(const State<D, Real>& state, const Domain<D>& domain,
                                                    const Metric<D, Real>& metric, int axis)
    : axis_(axis), layout_(state.layout) {
  const auto& s_waves = domain.impedance(wave_s);
  const bool any = std::any_of(s_waves.begin(), s_waves.end(), [](float z) { return z == 0; });
  const auto& grid = domain.grid;
  std::int64_t stride = 1;
  for (int other = 0; other < axis; ++other) stride *= grid.shape[std::size_t(other)];
  const float* const z = s_waves.data();
  std::vector<Index<D>> corrected;
  for (std::int64_t n = stride; any && n < grid.size(); ++n) {
    if ((z[n] > 0) == (z[n - stride] > 0)) continue;
    const auto at = grid.index(n);
    if (at[std::size_t(axis)] > 0 && corrects_interface(domain, at, axis)) corrected.push_back(at);
  }
  if (copies()) hold(domain, corrected);
  for (const auto& at : corrected) {
    const auto matrices = matrices_of(domain, metric, at);
    // Cells along level rows share them.
    if (matrices_.empty() || !(matrices_.back() == matrices)) matrices_.push_back(matrices);
    slots_.end_lines_before(layout_.line_number(at));
    slots_.cells.push_back({at[0],
                            std::int32_t(matrices_.size()) - 1,
                            {side_of(state, domain, at, 0), side_of(state, domain, at, 1)}});
  }
  slots_.end_lines_before(layout_.lines());
  for (auto* lists : {&velocities_, &tractions_, &velocities_of_step_, &tractions_of_step_, &curvatures_})
    for (auto& list : *lists) list.assign(slots_.cells.size(), 0);
}

/// Cells beyond the grid are replaced by the last ones in it.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::around_face(const Domain<D>& domain, const Index<D>& behind) const
    -> Around {
  Around cells;
  std::size_t number = 0;
  const auto beside = [&](Index<D> at, int pair, int offset) {
    const int axis = axis_of_pair<D>(axis_, pair);
    auto& place = at[std::size_t(axis)];
    if (!thin(domain, axis))
      place = std::clamp<std::int64_t>(place + offset, 0, domain.grid.shape[std::size_t(axis)] - 1);
    return at;
  };
  for (int pair = 1; pair < D; ++pair)
    for (const int offset : offsets_beside) cells[number++] = beside(behind, pair, offset);
  cells[number++] = behind;
  for (const int one : offsets_along)
    for (const int two : offsets_along)
      if constexpr (D == 3) cells[number++] = beside(beside(behind, 1, one), 2, two);
  return cells;
}

/// Notes the faces that differences along these read.
template <int D, class Real>
void InterfaceCorrections<D, Real>::hold(const Domain<D>& domain, const std::vector<Index<D>>& corrected) {
  std::set<std::int64_t> read;
  for (const auto& at : corrected)
    for (const auto& cell : around_face(domain, at)) read.insert(domain.grid.flat(cell));
  for (const auto cell : read) {
    const auto behind = domain.grid.index(cell);
    held_.end_lines_before(layout_.line_number(behind));
    held_.cells.push_back({behind[0], layout_.cell(behind)});
  }
  held_.end_lines_before(layout_.lines());
  retained_.assign(held_.cells.size() * 2 * FieldRows<D>::count, 0);
}

template <int D, class Real>
auto InterfaceCorrections<D, Real>::side_of(const State<D, Real>& state, const Domain<D>& domain,
                                            Index<D> behind, int side) const -> Side {
  Side found{};
  const auto cells = around_face(domain, behind);
  for (std::size_t number = 0; number < around; ++number) {
    Index<D> at = cells[number];
    if (copies()) {
      found.cells[number] = (held_.from(layout_.line_number(at), at[0]) * 2 + side) * FieldRows<D>::count;
    } else {
      at[std::size_t(axis_)] += side - 1;
      found.cells[number] = layout_.cell(at);
    }
  }
  behind[std::size_t(axis_)] += side - 1;
  found.b = state.material_layout.cell(behind);
  return found;
}

/// N of the face before a cell.
template <int D, class Real>
Point<D> InterfaceCorrections<D, Real>::normal_before(const Metric<D, Real>& metric,
                                                      const Index<D>& behind) const {
  constexpr int z = D - 1;
  const std::int64_t row = behind[z];
  auto normal = unit_vector<std::size_t(D)>(std::size_t(axis_));
  const bool bends = axis_ == z && metric.curvilinear_row(row) && metric.curvilinear_row(row - 1);
  for (int axis = 0; axis < z && bends; ++axis) {
    Index<D> line = behind;
    line[0] = 0;
    const auto of = metric.across(line, behind[0]);
    normal[std::size_t(axis)] = 2 * double(of.half_n[axis * of.pitch]);
  }
  return normal;
}

/// On either side motion along the interface alone puts a traction on it. Velocities bend so that it stays
/// what it is, and half of a sweep along the interface has put half a step of it there.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::matrices_of(const Domain<D>& domain, const Metric<D, Real>& metric,
                                                const Index<D>& behind) const -> Matrices {
  using Square = SmallMatrix<std::size_t(D)>;
  constexpr int z = D - 1;
  constexpr std::size_t axes = D - 1;
  const auto in_grid = normal_before(metric, behind);
  const auto n = in_pairs<D>(in_grid, axis_);
  const double square = dot_product(n, n);
  Square sum{};
  std::array<Loads, 2> load{}, bend{};
  std::array<Square, 2> impedances{};
  std::size_t solid = 0;
  bool beside_void = false;
  Matrices found{};
  for (const std::size_t side : {0, 1}) {
    const auto cell = side ? behind : before<D>(behind, axis_);
    if (domain.impedance(wave_p)(cell) == 0) {
      beside_void = true;
      continue;
    }
    const auto c = elasticity_at(domain, cell);
    const auto impedance = impedances[side] = impedance_across<D>(c, in_grid, axis_);
    sum = sum_of(sum, impedance, 1.);
    double trace = 0;
    for (std::size_t i = 0; i < D; ++i) trace += impedance[i][i];
    // (T3): Z over the tensor is the density times the inverse of Z; of a fluid along the normal alone.
    Square of_fluid{};
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) of_fluid[i][k] = n[i] * n[k] / (trace * square);
    const bool is_solid = domain.impedance(wave_s)(cell) > 0;
    if (is_solid) solid = side;
    const auto over = is_solid ? inverse_of(impedance) : of_fluid;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const int along = axis_of_pair<D>(axis_, int(axis) + 1);
      const double wide = cell_along(domain, behind, along);
      auto slope = unit_vector<std::size_t(D)>(std::size_t(along));
      slope[std::size_t(along)] /= wide;
      load[side][axis] = in_pairs<D>(tractions<D>(c, in_grid, slope), axis_);
      bend[side][axis] = product_of(over, load[side][axis]);
    }
  }
  const auto share = inverse_of(sum);
  for (const std::size_t side : {0, 1}) {
    const auto cell = side ? behind : before<D>(behind, axis_);
    const double sign = side ? -1 : 1, j = axis_ == z ? double(metric.volume(cell)) : 1,
                 part = beside_void ? 1 : traction_share;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto velocity = product_of(share, bend[side][axis]);
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t k = 0; k < D; ++k) {
          const auto place = axis * D + k;
          found.sides[side].velocity[i][place] = Real(-sign * j * velocity[i][k]);
          found.sides[side].traction[i][place] = Real(-sign / 2 * part * load[side][axis][i][k]);
        }
    }
  }
  if (!beside_void)
    found.swept = swept_of(domain, metric, behind, solid, share, impedances[solid], load[solid]);
  return found;
}

/// The traction that a sweep across has in the mean over a step, of a solid that half a sweep along the
/// interface has set in motion, belongs to the step's splitting alone. The field is taken to begin the sweep
/// with as much less, so that none is left for the fluid.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::swept_of(const Domain<D>& domain, const Metric<D, Real>& metric,
                                             const Index<D>& behind, std::size_t solid,
                                             const SmallMatrix<std::size_t(D)>& share,
                                             const SmallMatrix<std::size_t(D)>& impedance,
                                             const Loads& load) const -> Swept {
  Swept swept;
  swept.solid = solid;
  const auto n = in_pairs<D>(normal_before(metric, behind), axis_);
  const double square = dot_product(n, n);
  const auto cell = solid ? behind : before<D>(behind, axis_);
  const double j = axis_ == D - 1 ? double(metric.volume(cell)) : 1;
  const auto across = product_of(product_of(share, impedance), n);
  // Z^2 n, times the density.
  const auto stiffness = dot_product(n, product_of(impedance, product_of(impedance, n))) / square;
  const auto cells = around_face(domain, behind);
  for (std::size_t axis = 0; axis < load.size(); ++axis) {
    const int along = axis_of_pair<D>(axis_, int(axis) + 1);
    const double per_cell = 1 / cell_along(domain, behind, along);
    swept.per_cell[axis] = Real(per_cell);
    for (std::size_t k = 0; k < D; ++k) {
      double loaded = k == axis + 1 ? stiffness * per_cell : 0;
      for (std::size_t i = 0; i < D; ++i) loaded -= n[i] * load[axis][i][k];
      for (std::size_t i = 0; i < D; ++i)
        swept.traction[i][axis * D + k] = Real(n[i] * loaded / (6 * j * square));
    }
    for (std::size_t k = 0; k < offsets_beside.size(); ++k) {
      const auto number = axis * offsets_beside.size() + k;
      const auto of = normal_before(metric, cells[number]);
      for (std::size_t i = 0; i < D; ++i) swept.normals[number][i] = Real(weights_beside[k] * of[i]);
    }
  }
  for (std::size_t i = 0; i < D; ++i) {
    swept.velocity[i] = Real(-across[i] / square);
    swept.curvature[i] = Real(-2 * n[i] / square);
  }
  return swept;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::retain(const State<D, Real>& state, std::int64_t line,
                                           const IndexRange& columns) {
  if (held_.empty()) return;
  const auto [first, last] = held_.in(line, columns);
  for (auto n = first; n < last; ++n)
    for (const int side : {0, 1})
      for (int row = 0; row < FieldRows<D>::count; ++row)
        retained_[std::size_t((n * 2 + side) * FieldRows<D>::count + row)] =
            state.fields
                .data()[held_[n].cell + (side - 1) * layout_.stride(axis_) + row * layout_.row_pitch()];
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_slot(const State<D, Real>& state, std::int64_t n) {
  const Slot& slot = slots_[n];
  const Real* const fields = copies() ? retained_.data() : state.fields.data();
  const std::int64_t pitch = field_pitch();
  const auto axes = axes_of_pairs<D>(axis_);
  std::array<Real, std::size_t(D)> velocity{}, traction{};
  for (const std::size_t which : {0, 1}) {
    const Side& side = slot.sides[which];
    const auto& of = matrices_[std::size_t(slot.matrices)].sides[which];
    const Real b = state.material.data()[side.b];
    std::array<Real, differences> along{};
    for (std::size_t place = 0; place < differences; ++place)
      for (std::size_t k = 0; k < offsets_along.size(); ++k)
        along[place] +=
            Real(weights_along[k]) *
            fields[side.cells[place / D * offsets_beside.size() + 1 + k] + axes[place % D] * pitch];
    for (std::size_t i = 0; i < D; ++i) {
      Real bend = 0, load = 0;
      for (std::size_t k = 0; k < differences; ++k)
        bend += of.velocity[i][k] * along[k], load += of.traction[i][k] * along[k];
      velocity[i] += bend, traction[i] += b * load;
    }
  }
  for (std::size_t i = 0; i < D; ++i)
    velocities_[i][std::size_t(n)] = velocity[i], tractions_[i][std::size_t(n)] = traction[i];
  update_swept(fields, state.material.data(), n);
}

/// Returns those of the traction of the solid in its first row less that of the fluid.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::differences_of_tractions(const Slot& slot, const Swept& swept,
                                                             const Real* fields) const -> Differences {
  const auto &solid = slot.sides[swept.solid].cells, &fluid = slot.sides[1 - swept.solid].cells;
  const auto pitch = field_pitch();
  const auto axes = axes_of_pairs<D>(axis_);
  Differences found{};
  for (std::size_t place = 0; place < differences; ++place)
    for (std::size_t k = 0; k < offsets_beside.size(); ++k) {
      const auto number = place / D * offsets_beside.size() + k;
      for (int i = 0; i < D; ++i) {
        const auto row = FieldRows<D>::stress(i, axes[place % D]) * pitch;
        found[place] += swept.normals[number][std::size_t(i)] *
                        (fields[solid[number] + row] - fields[fluid[number] + row]);
      }
    }
  return found;
}

/// Returns those of the velocities that half a sweep along the face has added in the solid, over b/2.
template <int D, class Real>
auto InterfaceCorrections<D, Real>::swept_velocities(const Slot& slot, const Swept& swept,
                                                     const Real* fields) const -> Differences {
  const auto& solid = slot.sides[swept.solid].cells;
  const auto pitch = field_pitch();
  const auto axes = axes_of_pairs<D>(axis_);
  Differences found{};
  for (std::size_t axis = 0; axis < D - 1; ++axis)
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t other = 0; other < D - 1; ++other) {
        const auto row = FieldRows<D>::stress(axes[k], axes[other + 1]) * pitch;
        const auto stress = [&](std::size_t number) { return fields[solid[number] + row]; };
        // As differences of differences, which those of the velocities are.
        Real twice = 0;
        if (axis == other) {
          const auto first = axis * offsets_beside.size();
          twice = stress(first) - 2 * stress(itself) + stress(first + 3);
        } else if constexpr (D == 3) {
          twice = stress(itself + 1) - stress(itself + 2) - stress(itself + 3) + stress(itself + 4);
        }
        found[axis * D + k] += swept.per_cell[other] * twice / 4;
      }
  return found;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update_swept(const Real* fields, const Real* material, std::int64_t n) {
  const Slot& slot = slots_[n];
  const auto& matrices = matrices_[std::size_t(slot.matrices)];
  const Swept& swept = matrices.swept;
  if (swept.per_cell[0] == 0) return;  // beside void
  const OfSide& of = matrices.sides[swept.solid];
  const auto tractions = differences_of_tractions(slot, swept, fields),
             velocities = swept_velocities(slot, swept, fields);
  Real across = 0;
  for (std::size_t axis = 0; axis < D - 1; ++axis)
    across += swept.per_cell[axis] * tractions[axis * D + axis + 1];
  const Real b = material[slot.sides[swept.solid].b];
  for (std::size_t i = 0; i < D; ++i) {
    Real slope = swept.velocity[i] * across, mean = 0;
    for (std::size_t place = 0; place < differences; ++place) {
      slope -= of.velocity[i][place] * velocities[place] / 2;
      // Stiffness times density, which would overflow with large stresses, is a number with b^2.
      mean += b * of.traction[i][place] * b * velocities[place] / Real(12 * traction_share) +
              b * swept.traction[i][place] * b * tractions[place];
    }
    velocities_of_step_[i][std::size_t(n)] = b * slope;
    tractions_of_step_[i][std::size_t(n)] = -mean;
    curvatures_[i][std::size_t(n)] = swept.curvature[i] * across;
  }
}

template <int D, class Real>
std::int32_t InterfaceCorrections<D, Real>::slot(const Index<D>& behind) const {
  if (slots_.empty() || behind[std::size_t(axis_)] < 1) return none;
  const auto* const found = slots_.find(layout_.line_number(behind), behind[0]);
  return found ? std::int32_t(found - slots_.cells.data()) : none;
}

template <int D, class Real>
void InterfaceCorrections<D, Real>::update(const State<D, Real>& state, const IndexRange& lines,
                                           const IndexRange& columns) {
  if (slots_.empty()) return;
  for (auto line = lines.first; line < std::min(lines.last, layout_.lines()); ++line) {
    const auto [first, last] = slots_.in(line, columns);
    for (auto n = first; n < last; ++n) update_slot(state, n);
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, corrects_interface);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class InterfaceCorrections);

}  // namespace slipwave::solver
