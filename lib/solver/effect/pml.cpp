// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/pml.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/instantiate.hpp"
#include "base/memory.hpp"
#include "rock/anisotropy.hpp"
#include "scene/splitting.hpp"

namespace slipwave::solver {
namespace {

/// Growth of d into the layer.
constexpr int power = 2;
/// What is left in theory of a wave whose offset is that many times its distance to the edge.
constexpr double grazing_offset = 15, grazing_leak = 0.01;
/// Largest d times the length of a sweep: sweep and damping are composed to second order in half of it.
constexpr double most_damped_a_sweep = 2;
/// alpha in terms of the source's 2 pi f (Komatitsch & Martin 2007: at most pi f).
constexpr double alpha_share = 0.5;
/// Unit of the damping of all fields where waves would grow besides the complex stretching, as a share of d.
constexpr double damping_unit = 0.05;
/// That in plates, as a share of d: as fast as modes of plates grow (theory.md (E14c)).
constexpr double plate_damping = 0.1;
/// In thick plates it sets in with this power of the depth, so deep that waves have gone before: the largest
/// one tried that lets nothing grow (theory/sources.md).
constexpr int thick_plate_power = 4;
/// What waves may grow by in a layer whose rows have a slope: rounding in single precision, 6e-8 of them,
/// stays below a thousandth.
constexpr double most_growth = 1e4;
/// Ratio of impedances from which an interface counts as a reflector that may bound a plate.
constexpr double reflector_ratio = 3;

/// Whether an interface between these impedances of P and S waves reflects nearly all. Void has neither.
bool reflects(const std::array<double, 2>& one, const std::array<double, 2>& other) {
  for (const Wave wave : {wave_p, wave_s})
    if (std::max(one[wave], other[wave]) > reflector_ratio * std::min(one[wave], other[wave])) return true;
  return false;
}

/// The frequency shift of the stretching, per second.
double alpha_of(double slow_hz) { return alpha_share * 2 * std::numbers::pi * slow_hz; }

/// The sweeps of a step along axes of the domain.
std::vector<SweepFraction> sweeps_of(int dimension, int time_order, bool lying) {
  auto sweeps = splitting(dimension, time_order);
  for (auto& sweep : sweeps)
    if (lying) sweep.axis = dimension - 1 - sweep.axis;
  return sweeps;
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

/// The damping of all fields, in terms of d, with which no wave grows by more than most_growth on its way out
/// through a layer whose rows have a slope (theory.md (F10a)). `damped`: the integral of d/c over the layer,
/// with c the speed of the slowest wave; infinite where that is not known, so that nothing grows.
double damping_of_slope(double slope, double damped) {
  constexpr int angles = 90;
  static const auto directions = [] {
    std::array<std::array<double, 2>, angles> all{};  // cosine and sine
    for (int n = 0; n < angles; ++n) {
      const double angle = n * std::numbers::pi / (2 * angles);
      all[std::size_t(n)] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  const double allowed = std::log(most_growth) / damped;
  double needed = 0;
  for (const auto& [cosine, sine] : directions)
    needed = std::max(needed, cosine * (slope * sine - cosine - allowed));
  return needed;
}

}  // namespace

template <int D, class Real>
Pml<D, Real>::Pml(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max,
                  double slow_hz, int time_order, Ranks* ranks, const PmlSettings& settings)
    : layout_(layout),
      sweeps_(sweeps_of(D, time_order, settings.lying)),
      cells_(domain.grid.size() - domain.model_grid.size()),
      kernels_(pml_kernels<Real>()) {
  for (int n = 0; n < D; ++n) {
    auto& axis = axes_[std::size_t(n)];
    axis.cells = domain.grid.shape[std::size_t(n)];
    axis.low = domain.low_zone[std::size_t(n)];
    axis.high = domain.high_zone[std::size_t(n)];
    const auto largest = [&](std::int64_t zone) {
      return largest_damping(inner_width(zone, settings), domain.grid.spacing_m, dt_s, vp_max);
    };
    const std::array<double, 2> damping{largest(axis.low), largest(axis.high)};
    for (std::size_t k = 0; k < sweeps_.size(); ++k)
      axis.factors.push_back(make_factors(n, k, damping, {dt_s, slow_hz}, settings));
    for (const int side : {0, 1})
      axis.damped[std::size_t(side)] = damping[std::size_t(side)] * dt_s / (power + 1) *
                                       double(inner_width(side ? axis.high : axis.low, settings));
    std::int64_t rows = layout.rows();
    if (n > 0) rows *= axis.low + axis.high;
    for (int other = 1; other < D; ++other)
      if (other != n) rows *= layout.shape()[std::size_t(other)];
    const auto values = rows * (n == 0 ? axis.low + axis.high : layout.padded_nx());
    axis.memory = Buffer<Real>(values);
    clear_and_release(std::as_writable_bytes(std::span(axis.memory.data(), std::size_t(values))));
    find_growing(n, domain, alpha_of(slow_hz) * dt_s, ranks);
  }
}

/// The largest d, per second, of a layer of `width` cells: d integrated over the layer and back takes a P
/// wave that grazes down to what may leak, unless sweeps are too long for that.
template <int D, class Real>
double Pml<D, Real>::largest_damping(std::int64_t width, double h, double dt_s, double vp_max) const {
  const double length = double(width) * h, cosine = 2 / grazing_offset;
  double longest = 0;
  for (std::size_t k = 0; k < sweeps_.size(); ++k)
    longest = std::max(longest, std::abs(fraction_of(k)) * dt_s);
  return std::min((power + 1) * vp_max * -std::log(grazing_leak) / (2 * length * cosine),
                  most_damped_a_sweep / longest);
}

template <int D, class Real>
auto Pml<D, Real>::make_factors(int axis, std::size_t sweep, const std::array<double, 2>& largest,
                                const Times& times, const PmlSettings& settings) const -> Factors {
  const auto& layer = axes_[std::size_t(axis)];
  Factors factors;
  // A sweep back in time undoes what one forward would damp: all together are one step.
  const double time = fraction_of(sweep) * times.dt_s;
  const double alpha = alpha_of(times.slow_hz);
  for (std::int64_t slot = 0; slot < layer.low + layer.high; ++slot) {
    const bool low = slot < layer.low;
    const auto width = inner_width(low ? layer.low : layer.high, settings);
    const auto inside = low ? layer.low - 1 - slot : slot - layer.low;
    const double depth = std::min((double(inside) + 0.5) / double(width), 1.);
    const double d = largest[low ? 0 : 1] * std::pow(depth, power), sum = d + alpha;
    const double lost = -std::expm1(-sum * time / 2);
    // Where fields are prescribed there is nothing to damp.
    factors.loss.push_back(Real(inside < width ? lost * d / sum : 0));
    factors.left.push_back(Real(1 - lost));
    factors.lost_growing.push_back(Real(-std::expm1(-damping_unit * d * time)));
    factors.lost_in_thick_plates.push_back(
        Real(-std::expm1(-damping_unit * d * std::pow(depth, thick_plate_power) * time)));
  }
  return factors;
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

/// Marks the cells along the edges of an axis where waves would grow. `alpha`: in a step.
template <int D, class Real>
void Pml<D, Real>::find_growing(int axis, const Domain<D>& domain, double alpha, Ranks* ranks) {
  Index<D> last = layout_.shape();
  for (auto& n : last) --n;
  for (const int side : {0, 1}) {
    auto& damping = axes_[std::size_t(axis)].damping[std::size_t(side)];
    for (auto* const of : {&damping.in_thick_plates, &damping.growing})
      of->assign(std::size_t(along_edge(axis, last) + layout_.padded_nx()), 0);
    if ((side ? domain.high_zone : domain.low_zone)[std::size_t(axis)] == 0) continue;
    for (int across = 0; across < D; ++across)
      // A slice one cell thick between mirrors stands for all of the space: no plate.
      if (across != axis && layout_.shape()[std::size_t(across)] > 1)
        find_plates(axis, side, across, domain, alpha, ranks);
    if (domain.anisotropic()) find_turning(axis, side, domain);
    if (axis < D - 1 && !domain.curvilinear_rows.empty()) find_slopes(axis, side, domain);
  }
}

/// The largest damping where waves turn, in terms of lost_growing: at the outer end most is lost.
template <int D, class Real>
double Pml<D, Real>::most_damped(int axis) const {
  constexpr double most_lost = 0.9;
  double most = std::numeric_limits<double>::infinity();
  for (const auto& factors : axes_[std::size_t(axis)].factors)
    for (std::size_t slot = 0; slot < factors.lost_growing.size(); ++slot)
      if (factors.lost_growing[slot] > 0)
        most = std::min(most, most_lost / double(factors.lost_growing[slot]));
  return most;
}

/// Marks cells along an edge beyond which rows keep a slope: in row coordinates all waves turn there.
template <int D, class Real>
void Pml<D, Real>::find_slopes(int axis, int side, const Domain<D>& domain) {
  auto& of_edge = axes_[std::size_t(axis)].damping[std::size_t(side)].growing;
  const double most = most_damped(axis), damped = axes_[std::size_t(axis)].damped[std::size_t(side)];
  const auto zone = (side ? domain.high_zone : domain.low_zone)[std::size_t(axis)];
  Grid<D> edge = domain.grid;
  edge.shape[std::size_t(axis)] = 1;
  for (std::int64_t n = 0; n < edge.size(); ++n) {
    auto at = edge.index(n);
    if (!domain.curvilinear(at[D - 1])) continue;
    at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - zone : zone - 1;
    auto next = at;
    ++next[std::size_t(axis)];
    const double slope = std::abs(corner_depth(domain, next) - corner_depth(domain, at));
    const double courant = domain.courant(at, axis, domain.impedance(wave_s)(at) > 0 ? 1 : 0);
    const double turning = damping_of_slope(slope, damped / courant);
    auto& of_cell = of_edge[std::size_t(along_edge(axis, at))];
    of_cell = std::max(of_cell, Real(std::min(turning / damping_unit, most)));
  }
}

/// Marks cells along an edge whose waves would grow in the layer by the damping that they need (V6), in terms
/// of lost_growing.
template <int D, class Real>
void Pml<D, Real>::find_turning(int axis, int side, const Domain<D>& domain) {
  auto& of_edge = axes_[std::size_t(axis)].damping[std::size_t(side)].growing;
  const double most = most_damped(axis);
  Grid<D> edge = domain.grid;
  edge.shape[std::size_t(axis)] = 1;
  BackwardGroupVelocity<D> turning_of(axis);
  for (std::int64_t n = 0; n < edge.size(); ++n) {
    auto at = edge.index(n);
    at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - 1 : 0;
    if (domain.impedance(wave_s)(at) == 0) continue;
    const double turning = turning_of(domain, at);
    auto& of_cell = of_edge[std::size_t(along_edge(axis, at))];
    of_cell = std::max(of_cell, Real(std::min(turning / damping_unit, most)));
  }
}

/// Marks the solid cells between two reflectors (edges that do not absorb, void, strong interfaces) along one
/// other axis, `across`, at one side of an axis. A plate is thick if S takes at least 1/alpha across it.
/// Along z it is collective.
template <int D, class Real>
void Pml<D, Real>::find_plates(int axis, int side, int across, const Domain<D>& domain, double alpha,
                               Ranks* ranks) {
  auto& damping = axes_[std::size_t(axis)].damping[std::size_t(side)];
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
  const IndexRange mine =
      shared_out ? domain.own_and_other_cells() : IndexRange{0, layout_.shape()[std::size_t(across)]};
  constexpr std::int64_t values = 3;  // of a cell: impedances of P and S, steps that S takes across it
  std::vector<double> found;          // [cell][run][value]
  for (auto cell = mine.first; cell < mine.last; ++cell)
    for (std::int64_t run = 0; run < runs; ++run) {
      const auto at = place(run, cell);
      const double of_s = domain.impedance(wave_s)(at),
                   courant = of_s > 0 ? domain.courant(at, across, 1) : 0;
      found.insert(found.end(), {domain.impedance(wave_p)(at), of_s, courant > 0 ? 1 / courant : 0});
    }
  if (shared_out) found = allgather(ranks, found);
  const std::int64_t cells = std::int64_t(found.size()) / (values * runs);
  // Those gathered begin with the first row that any rank has.
  const std::int64_t held = domain.grid.first[std::size_t(across)];
  const std::int64_t before =
      shared_out ? held - allgather(ranks, std::vector{held + mine.first}).front() : 0;
  const auto& laws = domain.whole_edges[across];
  for (std::int64_t run = 0; run < runs; ++run) {
    const auto of = [&](std::int64_t cell) { return &found[std::size_t(values * (cell * runs + run))]; };
    const auto z = [&](std::int64_t cell) {
      return std::array<double, 2>{of(cell)[wave_p], of(cell)[wave_s]};
    };
    double steps = 0;
    // Between two mirrors rock is a part of a space without end.
    const bool mirrored = laws[0] == EdgeLaw::mirror && laws[1] == EdgeLaw::mirror;
    bool begins_at_reflector = laws[0] != EdgeLaw::absorbing;
    for (std::int64_t begin = 0, cell = 0; cell < cells; ++cell) {
      steps += of(cell)[2];
      const bool ends = cell + 1 == cells,
                 reflector = ends ? laws[1] != EdgeLaw::absorbing : reflects(z(cell), z(cell + 1));
      if (!ends && !reflector) continue;
      if (begins_at_reflector && reflector && !(mirrored && begin == 0 && ends))
        for (std::int64_t inside = begin; inside <= cell; ++inside) {
          const auto here = inside - before;
          if (z(inside)[wave_s] == 0 || here < 0 || here >= layout_.shape()[std::size_t(across)]) continue;
          auto& plate = alpha * steps >= 1 ? damping.in_thick_plates : damping.growing;
          plate[std::size_t(along_edge(axis, place(run, here)))] = Real(plate_damping / damping_unit);
        }
      begins_at_reflector = reflector;
      begin = cell + 1;
      steps = 0;
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
std::pair<Real*, std::int64_t> Pml<D, Real>::memory_of(int axis, const Index<D>& line, std::int64_t first) {
  auto& layer = axes_[std::size_t(axis)];
  std::int64_t number = 0;
  for (int other = D - 1; other > 0; --other) {
    const bool own = other == axis;
    number = number * (own ? layer.low + layer.high : layout_.shape()[std::size_t(other)]) +
             (own ? layer.slot(line[std::size_t(other)]) : line[std::size_t(other)]);
  }
  const auto pitch = axis == 0 ? layer.low + layer.high : layout_.padded_nx();
  return {layer.memory.data() + number * layout_.rows() * pitch + (axis == 0 ? layer.slot(first) : first),
          pitch};
}

template <int D, class Real>
PmlFactors<Real> Pml<D, Real>::factors_of(const SweptCells<D, Real>& swept) const {
  if (swept.time.sweep >= sweeps_.size() || sweeps_[swept.time.sweep].axis != swept.axis)
    throw Error("the PML knows no sweep along " + std::string(1, axis_names<D>()[std::size_t(swept.axis)]) +
                " as number " + std::to_string(swept.time.sweep + 1) + " of a step");
  const auto& layer = axes_[std::size_t(swept.axis)];
  const auto cell = swept.axis > 0 ? swept.row[std::size_t(swept.axis)] : swept.cells.first;
  return layer.factors[swept.time.sweep].from(layer.slot(cell));
}

template <int D, class Real>
NextSweep Pml<D, Real>::next(const SweepTime& time, Real fraction) const {
  if (begins_pair(time, fraction)) return {};
  const bool over_end = time.sweep + 1 == sweeps_.size();
  const auto number = over_end ? 1 : time.sweep + 1;
  return {sweeps_[number].axis, {time.step + over_end, number}};
}

template <int D, class Real>
void Pml<D, Real>::filter(const SweptCells<D, Real>& swept) {
  const auto factors = factors_of(swept);
  const auto [memory, memory_pitch] = memory_of(swept.axis, swept.row, swept.cells.first);
  const auto n = swept.cells.count();
  const bool begins = begins_pair(swept.time, swept.fraction);
  // The damping of this row, or for an axis across that of its cells.
  const auto& layer = axes_[std::size_t(swept.axis)];
  const auto cell = swept.axis > 0 ? swept.row[std::size_t(swept.axis)] : swept.cells.first;
  const auto damping = layer.damping[cell < layer.low ? 0 : 1].from(
      along_edge(swept.axis, swept.row) + (swept.axis > 0 ? swept.cells.first - swept.row[0] : 0));
  const Real* before = swept.before;
  for (const int row : swept.field_rows) {
    Real *const u = swept.now + row * swept.pitch, *const phi = memory + row * memory_pitch;
    if (begins)
      kernels_.collect(n, before, u, phi);
    else if (swept.axis > 0)
      kernels_.damp_across(n, factors, damping, before, u, phi);
    else
      kernels_.damp_along(n, factors, damping, before, u, phi);
    before += swept.before_pitch;
  }
}

template <int D, class Real>
void Pml<D, Real>::prepare(const SweptCells<D, Real>& swept) {
  const auto factors = factors_of(swept);
  const auto [memory, memory_pitch] = memory_of(swept.axis, swept.row, swept.cells.first);
  const auto loop = swept.axis > 0 ? kernels_.prepare_across : kernels_.prepare_along;
  for (const int row : swept.field_rows)
    loop(swept.cells.count(), factors, swept.now + row * swept.pitch, memory + row * memory_pitch);
}

template <int D, class Real>
std::int64_t Pml<D, Real>::memory_bytes() const {
  std::int64_t values = 0;
  for (const auto& axis : axes_) values += axis.memory.size();
  return values * std::int64_t(sizeof(Real));
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Pml);

}  // namespace slipwave::solver
