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

/// Growth of d into a layer that does not match the steps.
constexpr int power = 2;
/// What both edges together give back in theory of a wave whose offset is that many times its distance to
/// them.
constexpr double grazing_offset = 15, grazing_leak = 0.01;
/// Largest d times the length of a sweep: sweep and damping are composed to second order in half of it.
constexpr double most_damped_a_sweep = 2;
/// Largest (d + alpha) times the step, Courant number and vs/vp where the damping matches the steps, and what
/// is kept of recent increments from step to step: with more, or with less of the last, the shortest waves
/// would grow (theory/sources.md).
constexpr double most_damped_a_matched_step = 0.8, most_matched_courant = 0.9, most_matched_ratio = 2. / 3,
                 recent_kept = 0.25;
/// Their share that is not lost again, with which nothing is gained from waves of two steps a period.
constexpr double recent_share = (1 + recent_kept) * (1 + recent_kept) / 4;
/// What speeds and elasticities, that a model has in single precision, may differ by.
constexpr double rounding = 1e-5;
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
    if (domain.among_planes)
      if (const auto c = domain.among_planes(at)) {
        if (*c != last_) last_ = *c, of_last_ = find(*c);
        return of_last_;
      }
    if (!domain.anisotropic()) return 0;
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

/// Whether rock is isotropic as far as single precision tells.
template <int D>
bool is_isotropic(const Domain<D>& domain, const Index<D>& at) {
  if (!domain.anisotropic()) return true;
  const auto c = elasticity_at(domain, at), of = isotropic<D>(c(3, 3), c(5, 5));
  for (std::size_t i = 0; i < c.voigt.size(); ++i)
    for (std::size_t j = 0; j < c.voigt.size(); ++j)
      if (std::abs(c.voigt[i][j] - of.voigt[i][j]) > rounding * c(3, 3)) return false;
  return true;
}

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

/// What a sweep does in a cell of the layer: with the increments r of a field, its memory phi and that of
/// recent increments, the field loses before*phi before the sweep and after*phi + of_increments*r after it;
/// then
///   phi = left phi + of_recent recent + of_newest r,   recent = recent_left recent + r - 2 after phi.
struct Losses {
  double before, after, of_increments, left, of_recent, of_newest, recent_left;
  /// Damping and sweep as two flows, the damping solved exactly (theory.md (E14a)); here the memory is that
  /// just after the sweep, where the decay between both halves is in the factors. `damped`, `shift`: d and
  /// alpha times the length of the sweep; `before`: the sweep before it along the axis, in terms of its
  /// length.
  static Losses split(double damped, double shift, double before) {
    const double sum = damped + shift, half = std::exp(-sum / 2), half_before = std::exp(-sum * before / 2);
    const double loss = (1 - half) * damped / sum;
    return {loss * half_before, loss * half_before * half, loss, half_before * half, 0, 1, 0};
  }
  /// As much lost before a sweep as after it, which matches the steps (theory.md (E14d)).
  static Losses matched(double damped, double shift) {
    return {damped / 2,
            damped / 2,
            0,
            1 - shift - (1 - recent_share) * damped,
            recent_share * (1 - shift - recent_kept),
            1 - recent_share,
            recent_kept};
  }
};

}  // namespace

template <int D, class Real>
Pml<D, Real>::Pml(const Layout<D>& layout, const Domain<D>& domain, double dt_s, double vp_max,
                  double slow_hz, int time_order, Ranks* ranks, const PmlSettings& settings)
    : layout_(layout),
      sweeps_(sweeps_of(D, time_order, settings.lying)),
      cells_(domain.grid.size() - domain.model_grid.size()),
      kernels_(pml_kernels<Real>()) {
  const Times times{dt_s, slow_hz, vp_max, domain.grid.spacing_m};
  const bool may_match = time_order == 2 && settings.idle_cells == 0 && !settings.lying;
  for (int n = 0; n < D; ++n) {
    auto& axis = axes_[std::size_t(n)];
    axis.cells = domain.grid.shape[std::size_t(n)];
    axis.low = domain.low_zone[std::size_t(n)];
    axis.high = domain.high_zone[std::size_t(n)];
    set_factors(n, {false, false}, times, settings);
    std::int64_t rows = layout.rows();
    if (n > 0) rows *= axis.low + axis.high;
    for (int other = 1; other < D; ++other)
      if (other != n) rows *= layout.shape()[std::size_t(other)];
    const auto values = rows * (n == 0 ? axis.low + axis.high : layout.padded_nx());
    const auto reserve = [&](typename Axis::Memory kind) {
      auto& memory = axis.memory[kind];
      memory = Buffer<Real>(values);
      clear_and_release(std::as_writable_bytes(std::span(memory.data(), std::size_t(values))));
    };
    reserve(Axis::lost);
    if (n == sweeps_.front().axis) reserve(Axis::held);
    find_growing(n, domain, alpha_of(slow_hz) * dt_s, ranks);
    const auto match = may_match ? sides_that_match(n, domain, ranks) : std::array<bool, 2>{};
    if (!match[0] && !match[1]) continue;
    set_factors(n, match, times, settings);
    reserve(Axis::recent);
  }
}

/// At `depth`, from 0 to 1 in the layer.
template <int D, class Real>
double Pml<D, Real>::Profile::at(double depth) const {
  if (!matched) return outer * std::pow(depth, power);
  if (depth > 2. / 3) return inner + (outer - inner) * (3 * depth - 2);
  const double t = std::min(3 * depth, 1.);
  return inner * t * t * t * (10 - 15 * t + 6 * t * t);
}

template <int D, class Real>
double Pml<D, Real>::Profile::mean() const {
  return matched ? (4 * inner + outer) / 6 : outer / (power + 1);
}

/// d of a layer of `width` cells: integrated over the layer and back it takes a P wave that grazes down to
/// what may leak, unless sweeps are too long for that.
template <int D, class Real>
auto Pml<D, Real>::profile_of(bool matched, std::int64_t width, const Times& times) const -> Profile {
  const double length = double(width) * times.spacing_m, cosine = 2 / grazing_offset;
  const double mean = times.vp_max * -std::log(grazing_leak / 2) / (2 * length * cosine);
  double longest = 0;
  for (std::size_t k = 0; k < sweeps_.size(); ++k)
    longest = std::max(longest, std::abs(fraction_of(k)) * times.dt_s);
  const double most = most_damped_a_sweep / longest;
  if (!matched) return {false, 0, std::min((power + 1) * mean, most)};
  const double even = mean * 6 / 5,
               most_even = std::max(most_damped_a_matched_step / times.dt_s - alpha_of(times.slow_hz), 0.);
  if (even <= most_even) return {true, even, even};
  return {true, most_even, std::clamp(6 * mean - 4 * most_even, most_even, most)};
}

/// Sets what sweeps along an axis do in its layers, by the sides that match the steps.
template <int D, class Real>
void Pml<D, Real>::set_factors(int axis, const std::array<bool, 2>& matched, const Times& times,
                               const PmlSettings& settings) {
  auto& layer = axes_[std::size_t(axis)];
  for (const std::size_t side : {0, 1}) {
    const auto width = inner_width(side ? layer.high : layer.low, settings);
    layer.profiles[side] = profile_of(matched[side], width, times);
    layer.damped[side] = layer.profiles[side].mean() * times.dt_s * double(width);
  }
  layer.factors.clear();
  for (std::size_t k = 0; k < sweeps_.size(); ++k)
    layer.factors.push_back(make_factors(axis, k, times, settings));
}

template <int D, class Real>
auto Pml<D, Real>::make_factors(int axis, std::size_t sweep, const Times& times,
                                const PmlSettings& settings) const -> Factors {
  const auto& layer = axes_[std::size_t(axis)];
  Factors factors;
  // A sweep back in time undoes what one forward would damp: all together are one step.
  const double time = fraction_of(sweep) * times.dt_s;
  const double shift = alpha_of(times.slow_hz) * time;
  // The first sweep of a step and the last are one.
  auto before = sweep == 0 ? sweeps_.size() - 1 : sweep;
  do before = (before + sweeps_.size() - 1) % sweeps_.size();
  while (sweeps_[before].axis != sweeps_[sweep].axis);
  const double length_before = fraction_of(before) / fraction_of(sweep);
  for (std::int64_t slot = 0; slot < layer.low + layer.high; ++slot) {
    const bool low = slot < layer.low;
    const auto width = inner_width(low ? layer.low : layer.high, settings);
    const auto inside = low ? layer.low - 1 - slot : slot - layer.low;
    const double depth = std::min((double(inside) + 0.5) / double(width), 1.);
    const auto& profile = layer.profiles[low ? 0 : 1];
    const double damped = profile.at(depth) * time;
    const auto of =
        profile.matches(depth) ? Losses::matched(damped, shift) : Losses::split(damped, shift, length_before);
    // Where fields are prescribed there is nothing to damp.
    const double damps = inside < width ? 1 : 0;
    factors.before.push_back(Real(damps * of.before));
    factors.after.push_back(Real(damps * of.after));
    factors.of_increments.push_back(Real(damps * of.of_increments));
    factors.left.push_back(Real(of.left));
    factors.of_recent.push_back(Real(of.of_recent));
    factors.of_newest.push_back(Real(of.of_newest));
    factors.recent_left.push_back(Real(of.recent_left));
    factors.lost_growing.push_back(Real(-std::expm1(-damping_unit * damped)));
    factors.lost_in_thick_plates.push_back(
        Real(-std::expm1(-damping_unit * damped * std::pow(depth, thick_plate_power))));
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
    if (domain.anisotropic() || domain.among_planes) find_turning(axis, side, domain);
    if (axis < D - 1 && !domain.curvilinear_rows.empty()) find_slopes(axis, side, domain);
  }
}

/// The sides of an axis at which the damping may match the steps: where the layer lies in level rows of one
/// isotropic rock that continues beyond the other edges, too, and nothing grows there by the speeds of its
/// waves. Collective.
template <int D, class Real>
std::array<bool, 2> Pml<D, Real>::sides_that_match(int axis, const Domain<D>& domain, Ranks* ranks) const {
  const auto& layer = axes_[std::size_t(axis)];
  // Each band has a layer of its own beside it.
  bool may = axis == D - 1 || !(domain.subdomain.ends_at_band(0) || domain.subdomain.ends_at_band(1));
  for (int other = 0; other < D; ++other)
    for (const EdgeLaw law : domain.whole_edges[other])
      may = may && (other == axis || law == EdgeLaw::absorbing || law == EdgeLaw::mirror);
  if (!may) return {};
  // Courant numbers by axis, the impedances, and whether it is more than that.
  using Rock = std::array<double, D + 3>;
  const auto rock_at = [&](const Index<D>& at) {
    Rock rock{};
    for (int along = 0; along < D; ++along) rock[std::size_t(along)] = domain.courant(at, along, 0);
    rock[D] = domain.impedance(wave_p)(at), rock[D + 1] = domain.impedance(wave_s)(at);
    rock[D + 2] = domain.curvilinear(at[D - 1]) || !is_isotropic(domain, at) ||
                  (domain.among_planes && domain.among_planes(at));
    return rock;
  };
  const auto fits = [](const Rock& rock) {
    return std::all_of(rock.begin(), rock.begin() + D,
                       [](double courant) { return courant <= most_matched_courant * (1 + rounding); }) &&
           rock[D + 1] <= rock[D] * most_matched_ratio && rock[D + 2] == 0;
  };
  std::array<bool, 2> match{};
  for (const std::size_t side : {0, 1}) {
    std::vector<Rock> rocks;  // up to the first that differs
    Grid<D> edge = domain.grid;
    edge.shape[std::size_t(axis)] = 1;
    // What no layer continues is another rank's.
    if ((side ? layer.high : layer.low) > 0)
      for (std::int64_t n = 0; n < edge.size() && rocks.size() < 2; ++n) {
        auto at = edge.index(n);
        at[std::size_t(axis)] = side ? layout_.shape()[std::size_t(axis)] - 1 : 0;
        if (const auto rock = rock_at(at); rocks.empty() || rock != rocks.front()) rocks.push_back(rock);
      }
    rocks = allgather(ranks, rocks);
    match[side] = std::all_of(rocks.begin(), rocks.end(),
                              [&](const Rock& rock) { return fits(rock) && rock == rocks.front(); });
  }
  return match;
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
    double slowest = domain.courant(at, axis, 0);
    for (int pair = 1; pair < D && domain.impedance(wave_s)(at) > 0; ++pair)
      slowest = std::min(slowest, domain.courant(at, axis, pair));
    const double turning = damping_of_slope(slope, damped / slowest);
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
    for (auto& memory : axes_[std::size_t(n)].memory) {
      const std::int64_t a_row = memory.size() / layout_.shape()[D - 1];
      if (a_row > 0) to(memory.data() + rows.first * a_row, rows.count() * a_row);
    }
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
std::array<std::int64_t, 2> Pml<D, Real>::place_in_memory(int axis, const Index<D>& line,
                                                          std::int64_t first) const {
  const auto& layer = axes_[std::size_t(axis)];
  std::int64_t number = 0;
  for (int other = D - 1; other > 0; --other) {
    const bool own = other == axis;
    number = number * (own ? layer.low + layer.high : layout_.shape()[std::size_t(other)]) +
             (own ? layer.slot(line[std::size_t(other)]) : line[std::size_t(other)]);
  }
  const auto pitch = axis == 0 ? layer.low + layer.high : layout_.padded_nx();
  return {number * layout_.rows() * pitch + (axis == 0 ? layer.slot(first) : first), pitch};
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
  const auto [place, memory_pitch] = place_in_memory(swept.axis, swept.row, swept.cells.first);
  const auto n = swept.cells.count();
  const bool begins = begins_pair(swept.time, swept.fraction);
  // The damping of this row, or for an axis across that of its cells.
  auto& layer = axes_[std::size_t(swept.axis)];
  const auto cell = swept.axis > 0 ? swept.row[std::size_t(swept.axis)] : swept.cells.first;
  const auto damping = layer.damping[cell < layer.low ? 0 : 1].from(
      along_edge(swept.axis, swept.row) + (swept.axis > 0 ? swept.cells.first - swept.row[0] : 0));
  const bool ends = ends_pair(swept.time, swept.fraction);
  // A row across needs recent increments where it matches the steps, one along in some of its cells.
  const bool remembers = swept.axis > 0 ? *factors.recent_left > 0 : layer.memory[Axis::recent].size() > 0;
  const auto damp = (swept.axis > 0 ? kernels_.damp_across : kernels_.damp_along)[remembers];
  const Real* before = swept.before;
  for (const int row : swept.field_rows) {
    const auto at = place + row * memory_pitch;
    Real* const u = swept.now + row * swept.pitch;
    const Real* from = before;
    if (begins || ends) {
      Real* const held = layer.memory[Axis::held].data() + at;
      for (std::int64_t i = 0; i < n; ++i) held[i] = begins ? u[i] - before[i] : before[i] - held[i];
      from = held;
    }
    if (!begins)
      damp(n, factors, damping, from, u, layer.memory[Axis::lost].data() + at,
           remembers ? layer.memory[Axis::recent].data() + at : nullptr);
    before += swept.before_pitch;
  }
}

template <int D, class Real>
void Pml<D, Real>::prepare(const SweptCells<D, Real>& swept) {
  const auto factors = factors_of(swept);
  const auto [place, memory_pitch] = place_in_memory(swept.axis, swept.row, swept.cells.first);
  auto& memory = axes_[std::size_t(swept.axis)].memory[Axis::lost];
  const auto loop = swept.axis > 0 ? kernels_.prepare_across : kernels_.prepare_along;
  for (const int row : swept.field_rows)
    loop(swept.cells.count(), factors, swept.now + row * swept.pitch,
         memory.data() + place + row * memory_pitch);
}

template <int D, class Real>
std::int64_t Pml<D, Real>::memory_bytes() const {
  std::int64_t values = 0;
  for (const auto& axis : axes_)
    for (const auto& memory : axis.memory) values += memory.size();
  return values * std::int64_t(sizeof(Real));
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Pml);

}  // namespace slipwave::solver
