// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/pml.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/anisotropy.hpp"
#include "scene/splitting.hpp"

namespace slipwave::solver {
namespace {

// Chosen by measuring the reflection of 20 cells for P and S waves at all angles, and what grows (theory.md).
/// Growth of d into the layer.
constexpr int power = 2;
/// alpha at the model in terms of the source's 2 pi f.
constexpr double alpha_share = 2;
/// Damping of all fields besides the complex stretching, as a share of d: everywhere, and more in plates.
constexpr double damping_share = 0.002, plate_damping_share = 0.05;
/// Ratio of impedances from which an interface counts as a reflector that may bound a plate.
constexpr double reflector_ratio = 3;

/// Whether an interface between these impedances of P and S waves reflects nearly all. Void has neither.
bool reflects(const std::array<double, 2>& one, const std::array<double, 2>& other) {
  for (const Wave wave : {wave_p, wave_s})
    if (std::max(one[wave], other[wave]) > reflector_ratio * std::min(one[wave], other[wave])) return true;
  return false;
}

/// Fractions of a step that sweeps along an axis are over, each once.
std::vector<double> fractions_along(int axis, int dimension, int time_order) {
  const auto sweeps = splitting(dimension, time_order);
  std::vector<double> all;
  if (axis == 0) all.push_back(2 * sweeps.front().fraction);  // the last of a step and the first of the next
  for (const auto& sweep : sweeps)
    if (sweep.axis == axis && std::find(all.begin(), all.end(), sweep.fraction) == all.end())
      all.push_back(sweep.fraction);
  return all;
}

/// (V6) at a cell along an axis: found once for a medium, and for neighbours of like rock.
template <int D>
class BackwardGroupVelocity {
 public:
  explicit BackwardGroupVelocity(int axis) : axis_(axis) {}
  double operator()(const Domain<D>& domain, const Index<D>& at) {
    if (const auto* const cell = domain.anisotropic_cell(at)) {
      const auto& media = domain.anisotropic_media();
      if (of_media_.empty()) of_media_.assign(media.size(), not_known);
      auto& of = of_media_[std::size_t(cell->medium)];
      if (of == not_known) of = find(media[std::size_t(cell->medium)].elasticity);
      return of;
    }
    // Times the density; only ratios count.
    const auto c = elasticity_of_loops(domain, at);
    if (c == last_) return of_last_;
    last_ = c;
    // Where horizontal directions are alike in a plane, since the SH wave never moves back.
    const bool in_plane = D == 3 && domain.material_kind() != MaterialKind::orthorhombic;
    of_last_ = in_plane ? backward_group_velocity<2>(vertical_symmetry(c(1, 1), c(1, 3), c(3, 3), c(5, 5)),
                                                     axis_ / (D - 1))
                        : find(c);
    return of_last_;
  }

 private:
  double find(const Elasticity<D>& c) const { return backward_group_velocity<D>(c, axis_); }
  int axis_;
  Elasticity<D> last_;
  double of_last_ = 0;
  static constexpr double not_known = -1;
  std::vector<double> of_media_;
};

}  // namespace

template <int D, class Real>
Pml<D, Real>::Pml(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max,
                  double slow_hz, int time_order, Ranks* ranks, const PmlSettings& settings)
    : layout_(layout), cells_(domain.grid.size() - domain.model_grid.size()), kernels_(pml_kernels<Real>()) {
  for (int n = 0; n < D; ++n) {
    auto& axis = axes_[std::size_t(n)];
    axis.cells = domain.grid.shape[std::size_t(n)];
    axis.low = domain.low_zone[std::size_t(n)];
    axis.high = domain.high_zone[std::size_t(n)];
    for (const double fraction : fractions_along(settings.lying ? D - 1 - n : n, D, time_order)) {
      axis.fractions.push_back(Real(fraction));
      auto& factors = axis.factors.emplace_back();
      // A sweep back in time undoes what one forward would damp: all together are one step.
      const double time = fraction * dt_s;
      for (std::int64_t slot = 0; slot < axis.low + axis.high; ++slot) {
        const auto zone = slot < axis.low ? axis.low : axis.high;
        const auto width = std::max<std::int64_t>(zone - settings.idle_cells, 1);
        const auto inside = std::min(slot < axis.low ? axis.low - 1 - slot : slot - axis.low, width - 1);
        const double depth = (double(inside) + 0.5) / double(width);
        const double length = double(width) * domain.grid.spacing_m;
        const double d =
            -(power + 1) * vp_max * std::log(settings.leak) / (2 * length) * std::pow(depth, power);
        const double alpha = alpha_share * 2 * std::numbers::pi * slow_hz * (1 - depth);
        const double sum = d + alpha, lost = -std::expm1(-sum * time);
        factors.kept.push_back(Real(std::exp(-damping_share * d * time)));
        factors.lost_in_plates.push_back(
            Real(std::exp(-damping_share * d * time) * -std::expm1(-plate_damping_share * d * time)));
        factors.of_memory.push_back(Real(lost / (sum * dt_s)));
        factors.of_change.push_back(Real(d / sum * (1 - lost / (sum * time))));
        factors.left.push_back(Real(1 - lost));
        factors.added.push_back(Real(lost * d / sum * dt_s / time));
      }
    }
    std::int64_t rows = layout.rows();
    if (n > 0) rows *= axis.low + axis.high;
    for (int other = 1; other < D; ++other)
      if (other != n) rows *= layout.shape()[std::size_t(other)];
    const auto values = rows * (n == 0 ? axis.low + axis.high : layout.padded_nx());
    axis.memory = Buffer<Real>(values);
    std::fill(axis.memory.data(), axis.memory.data() + values, Real(0));
    find_plates(n, domain, ranks);
  }
}

/// Number of a cell in the plane along the edge, x fastest.
template <int D, class Real>
std::int64_t Pml<D, Real>::along_edge(int axis, const Index<D>& at) const {
  std::int64_t number = 0;
  for (int other = D - 1; other >= 0; --other)
    if (other != axis)
      number = number * (other == 0 ? layout_.padded_nx() : layout_.shape()[std::size_t(other)]) +
               at[std::size_t(other)];
  return number;
}

/// Marks the solid cells along the edges of an axis that lie between two reflectors: edges that do not
/// absorb, void, strong interfaces.
template <int D, class Real>
void Pml<D, Real>::find_plates(int axis, const Domain<D>& domain, Ranks* ranks) {
  Index<D> last = layout_.shape();
  for (auto& n : last) --n;
  for (const int side : {0, 1}) {
    axes_[std::size_t(axis)].plates[std::size_t(side)].assign(
        std::size_t(along_edge(axis, last) + layout_.padded_nx()), 0);
    if ((side ? domain.high_zone : domain.low_zone)[std::size_t(axis)] == 0) continue;
    for (int across = 0; across < D; ++across)
      // A slice one cell thick between mirrors stands for all of the space: no plate.
      if (across != axis && layout_.shape()[std::size_t(across)] > 1)
        find_plates(axis, side, across, domain, ranks);
    if (domain.anisotropic()) find_turning(axis, side, domain);
    if (axis < D - 1 && !domain.bent_rows.empty()) find_slopes(axis, side, domain);
  }
}

/// The largest damping, in terms of that of plates: at the outer end most is lost.
template <int D, class Real>
double Pml<D, Real>::most_damped(int axis) const {
  constexpr double most_lost = 0.9;
  double most = std::numeric_limits<double>::infinity();
  for (const auto& factors : axes_[std::size_t(axis)].factors)
    for (std::size_t slot = 0; slot < factors.kept.size(); ++slot)
      most = std::min(most, most_lost * double(factors.kept[slot] / factors.lost_in_plates[slot]));
  return most;
}

/// Marks cells along an edge beyond which rows keep a slope: in row coordinates all waves turn there
/// (theory.md (F10a)).
template <int D, class Real>
void Pml<D, Real>::find_slopes(int axis, int side, const Domain<D>& domain) {
  auto& plates = axes_[std::size_t(axis)].plates[std::size_t(side)];
  const double most = most_damped(axis);
  const auto zone = (side ? domain.high_zone : domain.low_zone)[std::size_t(axis)];
  Grid<D> edge = domain.grid;
  edge.shape[std::size_t(axis)] = 1;
  for (std::int64_t n = 0; n < edge.size(); ++n) {
    auto at = edge.index(n);
    if (!domain.bent(at[D - 1])) continue;
    at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - zone : zone - 1;
    auto next = at;
    ++next[std::size_t(axis)];
    const double slope = corner_depth(domain, next) - corner_depth(domain, at);
    const double turning = (std::sqrt(1 + slope * slope) - 1) / 2;
    auto& plate = plates[std::size_t(along_edge(axis, at))];
    plate = std::max(plate, Real(std::min(turning / plate_damping_share, most)));
  }
}

/// Marks cells along an edge whose waves would grow in the layer by the damping that they need (V6), in terms
/// of that of plates.
template <int D, class Real>
void Pml<D, Real>::find_turning(int axis, int side, const Domain<D>& domain) {
  auto& plates = axes_[std::size_t(axis)].plates[std::size_t(side)];
  const double most = most_damped(axis);
  Grid<D> edge = domain.grid;
  edge.shape[std::size_t(axis)] = 1;
  BackwardGroupVelocity<D> turning_of(axis);
  for (std::int64_t n = 0; n < edge.size(); ++n) {
    auto at = edge.index(n);
    at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - 1 : 0;
    if (domain.impedance(wave_s)(at) == 0) continue;
    const double turning = turning_of(domain, at);
    auto& plate = plates[std::size_t(along_edge(axis, at))];
    plate = std::max(plate, Real(std::min(turning / plate_damping_share, most)));
  }
}

/// The same of runs across one other axis. What lies along z is collective.
template <int D, class Real>
void Pml<D, Real>::find_plates(int axis, int side, int across, const Domain<D>& domain, Ranks* ranks) {
  auto& plates = axes_[std::size_t(axis)].plates[std::size_t(side)];
  const bool shared_out = ranks && across == D - 1;
  const int other = D == 2 ? axis : 3 - axis - across;  // in 2-D there is none
  const std::int64_t runs = D == 2 ? 1 : layout_.shape()[std::size_t(other)];
  const auto place = [&](std::int64_t run, std::int64_t cell) {
    Index<D> at{};
    if (D == 3) at[std::size_t(other)] = run;
    at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - 1 : 0;
    at[std::size_t(across)] = cell;
    return at;
  };
  const IndexRange mine = shared_out ? domain.own : IndexRange{0, layout_.shape()[std::size_t(across)]};
  std::vector<double> impedances;  // [cell][run][wave]
  for (auto cell = mine.first; cell < mine.last; ++cell)
    for (std::int64_t run = 0; run < runs; ++run)
      for (const Wave wave : {wave_p, wave_s}) impedances.push_back(domain.impedance(wave)(place(run, cell)));
  if (shared_out) impedances = allgather(ranks, impedances);
  const std::int64_t cells = std::int64_t(impedances.size()) / (2 * runs);
  const std::int64_t before = shared_out ? domain.grid.first[std::size_t(across)] : 0;
  const auto& laws = domain.whole_edges[across];
  for (std::int64_t run = 0; run < runs; ++run) {
    const auto z = [&](std::int64_t cell) {
      const auto first = std::size_t(2 * (cell * runs + run));
      return std::array<double, 2>{impedances[first], impedances[first + 1]};
    };
    bool begins_at_reflector = laws[0] != EdgeLaw::absorbing;
    for (std::int64_t begin = 0, cell = 0; cell < cells; ++cell) {
      const bool ends = cell + 1 == cells,
                 reflector = ends ? laws[1] != EdgeLaw::absorbing : reflects(z(cell), z(cell + 1));
      if (!ends && !reflector) continue;
      if (begins_at_reflector && reflector)
        for (std::int64_t inside = begin; inside <= cell; ++inside) {
          const auto here = inside - before;
          if (z(inside)[wave_s] > 0 && here >= 0 && here < layout_.shape()[std::size_t(across)])
            plates[std::size_t(along_edge(axis, place(run, here)))] = 1;
        }
      begins_at_reflector = reflector;
      begin = cell + 1;
    }
  }
}

/// For all axes but the last, whose layers lie above and below.
template <int D, class Real>
void Pml<D, Real>::exchange(const IndexRange& rows, const std::function<void(Real*, std::int64_t)>& to) {
  for (int n = 0; n + 1 < D; ++n) {
    auto& memory = axes_[std::size_t(n)].memory;
    const std::int64_t a_row = memory.size() / layout_.shape()[D - 1];
    if (a_row > 0) to(memory.data() + rows.first * a_row, rows.count() * a_row);
  }
}

template <int D, class Real>
std::array<IndexRange, 2> Pml<D, Real>::filtered(int axis, const Index<D>& line,
                                                 const IndexRange& columns) const {
  const auto& layer = axes_[std::size_t(axis)];
  if (axis > 0) return {layer.holds(line[std::size_t(axis)]) ? columns : IndexRange{}, IndexRange{}};
  return {IndexRange{columns.first, std::min(columns.last, layer.low)},
          IndexRange{std::max(columns.first, layer.cells - layer.high), std::min(columns.last, layer.cells)}};
}

template <int D, class Real>
std::pair<Real*, std::int64_t> Pml<D, Real>::memory_of(int axis, const Index<D>& line) {
  auto& layer = axes_[std::size_t(axis)];
  std::int64_t number = 0;
  for (int other = D - 1; other > 0; --other) {
    const bool own = other == axis;
    number = number * (own ? layer.low + layer.high : layout_.shape()[std::size_t(other)]) +
             (own ? layer.slot(line[std::size_t(other)]) : line[std::size_t(other)]);
  }
  const auto pitch = axis == 0 ? layer.low + layer.high : layout_.padded_nx();
  return {layer.memory.data() + number * layout_.rows() * pitch, pitch};
}

template <int D, class Real>
void Pml<D, Real>::filter(const SweptCells<D, Real>& swept, bool remember) {
  const auto& layer = axes_[std::size_t(swept.axis)];
  const auto known = std::find(layer.fractions.begin(), layer.fractions.end(), swept.fraction);
  if (known == layer.fractions.end())
    throw Error("the PML knows no sweep along " + std::string(1, axis_names<D>()[std::size_t(swept.axis)]) +
                " over " + std::to_string(double(swept.fraction)) + " of a step");
  const auto first = swept.cells.first, cell = swept.axis > 0 ? swept.row[std::size_t(swept.axis)] : first;
  const auto slot = layer.slot(cell);
  const auto factors = layer.factors[std::size_t(known - layer.fractions.begin())].from(slot);
  // Plates of this row, or for an axis across of its cells.
  const Real* const plates = layer.plates[cell < layer.low ? 0 : 1].data() +
                             along_edge(swept.axis, swept.row) + (swept.axis > 0 ? first - swept.row[0] : 0);
  const auto [memory, memory_pitch] = memory_of(swept.axis, swept.row);
  Real* const phi = memory + (swept.axis > 0 ? first : slot);
  const Real* before = swept.before;
  for (const int field_row : swept.field_rows) {
    Real* const now = swept.now + field_row * swept.pitch;
    if (swept.axis > 0)
      kernels_.across(swept.cells.count(), factors, plates, before, now, phi + field_row * memory_pitch,
                      remember);
    else
      kernels_.along(swept.cells.count(), factors, *plates, before, now, phi + field_row * memory_pitch,
                     remember);
    before += swept.before_pitch;
  }
}

template <int D, class Real>
std::int64_t Pml<D, Real>::memory_bytes() const {
  std::int64_t values = 0;
  for (const auto& axis : axes_) values += axis.memory.size();
  return values * std::int64_t(sizeof(Real));
}

template class Pml<2, float>;
template class Pml<2, double>;
template class Pml<3, float>;
template class Pml<3, double>;

}  // namespace slipwave::solver
