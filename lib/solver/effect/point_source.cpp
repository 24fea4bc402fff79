// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/point_source.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "acquisition/interpolation.hpp"
#include "base/instantiate.hpp"
#include "solver/sweep/surface_errors.hpp"

namespace slipwave::solver {

template <int D, class Real>
PointSource<D, Real>::PointSource(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                  const Source<D>& source, double unit, Ranks* ranks)
    : state_(state),
      domain_(domain),
      medium_(scene.model.medium),
      wavelet_(source.wavelet),
      delay_s_(source.delay_s),
      unit_(unit),
      moment_(moment_of(source)) {
  const bool isotropic = point_injection(source)->isotropic;
  if (owns_point(domain, source.position_m, isotropic ? Side::fluid : Side::solid)) weigh(source);
  if (ranks) share(*ranks);
  find_rows();
  std::stable_sort(values_.begin(), values_.end(),
                   [](const ValueWeight& one, const ValueWeight& other) { return one.line < other.line; });
  const double dt_s = time_step_s(scene);
  double given = 0;
  for (StepTime time{0, dt_s}; gives(time) && time.end_s() <= scene.recording.duration_s + dt_s;
       ++time.step) {
    given_.push_back(given);
    given += unit * dt_s * wavelet_(time.end_s() - delay_s_);
  }
  given_.push_back(given);
  if (scene.slip_diary) work_.assign(std::size_t(state.layout.lines()), 0);
}

/// The values it adds to, and their weights.
template <int D, class Real>
void PointSource<D, Real>::weigh(const Source<D>& source) {
  using Rows = FieldRows<D>;
  const auto injection = *point_injection(source);
  side_ = injection.isotropic ? Side::fluid : Side::solid;
  centre_ = cell_at(domain_, source.position_m, side_);
  const double volume = std::pow(domain_.grid.spacing_m, D);
  const bool fluid = domain_.impedance(wave_s)(centre_) == 0;
  const int stored = Rows::normal_stresses(state_.layout);
  if (injection.isotropic) {
    std::vector<std::array<int, 2>> normal;
    for (int i = 0; i < stored; ++i) normal.push_back({i, i});
    add_moment(source, normal, Rows::normal_stress(D - 1), -injection.moment_rate(0, 0) / volume);
  }
  for (int i = 0; i < D; ++i) {
    add_force(source, i, injection.force[std::size_t(i)], volume);
    const auto add = [&](int j) {
      add_moment(source, {{i, j}}, Rows::stress(i, j), -injection.moment_rate(i, j) / volume);
    };
    if (!injection.isotropic && i < stored) add(i);
    for (int j = i + 1; j < D && !fluid; ++j) add(j);
  }
}

/// Distributes the weights that one rank has computed; each keeps those on its rows.
template <int D, class Real>
void PointSource<D, Real>::share(Ranks& ranks) {
  const std::int64_t lines_a_row = state_.layout.lines() / state_.layout.shape()[D - 1];
  const std::int64_t before = domain_.grid.first[D - 1];
  std::vector<Index<D>> centre;
  std::vector<std::int64_t> reach;
  if (!values_.empty()) {
    centre.push_back(centre_);
    centre.back()[D - 1] += before;
    reach.push_back(reach_);
  }
  for (auto& value : values_) value.line += before * lines_a_row;
  centre = allgather(&ranks, centre);
  if (centre.empty()) return;  // it lies in another band
  centre_ = centre.front();
  centre_[D - 1] -= before;
  reach_ = allgather(&ranks, reach).at(0);
  const auto all = allgather(&ranks, values_);
  values_.clear();
  for (auto value : all) {
    value.line -= before * lines_a_row;
    if (value.line >= 0 && value.line < state_.layout.lines()) values_.push_back(value);
  }
}

template <int D, class Real>
void PointSource<D, Real>::apply(const StepTime& time, const RowFields<Real>& fields,
                                 const IndexRange& cells) {
  if (!gives(time)) return;
  add_to(fields, cells, unit_ * 0.5 * time.dt_s * wavelet_(time.end_s() - delay_s_),
         [](const auto&) { return true; });
}

template <int D, class Real>
std::span<const ValueWeight> PointSource<D, Real>::values_of(std::int64_t row) const {
  if (values_.empty() || row < values_.front().line || row > values_.back().line) return {};
  const auto [first, last] = std::equal_range(
      values_.begin(), values_.end(), ValueWeight{.line = row},
      [](const ValueWeight& one, const ValueWeight& other) { return one.line < other.line; });
  return {first, last};
}

template <int D, class Real>
bool PointSource<D, Real>::add_stress(double steps, const RowFields<Real>& fields, const IndexRange& cells,
                                      double times) {
  const auto step = std::min(std::size_t(steps), given_.size() - 1),
             next = std::min(step + 1, given_.size() - 1);
  const double given =
      times * (given_[step] + (steps - double(std::size_t(steps))) * (given_[next] - given_[step]));
  if (given == 0) return false;
  const auto first_stress = FieldRows<D>::normal_stress(0) * state_.layout.row_pitch();
  return add_to(fields, cells, given, [&](const ValueWeight& value) { return value.place >= first_stress; });
}

/// Adds an amount times the weights of chosen values of these cells, and counts the work; whether there were
/// any.
template <int D, class Real>
template <class Chosen>
bool PointSource<D, Real>::add_to(const RowFields<Real>& fields, const IndexRange& cells, double amount,
                                  const Chosen& chosen) {
  const auto values = values_of(fields.row);
  if (values.empty()) return false;
  const bool counts = !work_.empty() && domain_.owns(state_.layout.line_index(fields.row)[D - 1]);
  const double before = counts ? energy_of(fields.row, cells) : 0;
  bool any = false;
  for (const auto& value : values) {
    const std::int64_t x = state_.layout.column(value.place);
    if (x < cells.first || x >= cells.last || !chosen(value)) continue;
    // Copies of a line have a pitch of their own.
    fields.field(int(value.place / state_.layout.row_pitch()))[x] += Real(amount * value.weight);
    any = true;
  }
  if (counts) work_[std::size_t(fields.row)] += energy_of(fields.row, cells) - before;
  return any;
}

/// Returns the energy of the cells of these columns that the source may reach.
template <int D, class Real>
double PointSource<D, Real>::energy_of(std::int64_t line, const IndexRange& columns) const {
  std::int64_t first = columns.last, last = columns.first;
  for (const auto& value : values_) {
    if (value.line != line) continue;
    first = std::min(first, state_.layout.column(value.place));
    last = std::max(last, state_.layout.column(value.place) + 1);
  }
  auto at = state_.layout.line_index(line);
  double sum = 0;
  for (at[0] = std::max(first, columns.first); at[0] < std::min(last, columns.last); ++at[0])
    sum += energy_of_cell(state_, domain_, medium_, at);
  return sum / (unit_ * unit_);
}

template <int D, class Real>
void PointSource<D, Real>::report(ShotReport& report) const {
  report.source_work = std::accumulate(work_.begin(), work_.end(), report.source_work.value_or(0));
}

/// Spreads a force along an axis with the weights with which receivers read the velocity: each cell takes up
/// its share with its own mass, so that source and receiver can be exchanged.
template <int D, class Real>
void PointSource<D, Real>::add_force(const Source<D>& source, int axis, double newtons, double volume) {
  using Rows = FieldRows<D>;
  if (newtons == 0) return;
  for (const auto& value :
       source_weights(state_.layout, domain_, source.position_m, FieldRows<D>::velocity(axis))) {
    const auto cell = domain_.model_cell(cell_of_value(state_.layout, value));
    const double rho = medium_.rho(cell);
    const int row = int(value.place / state_.layout.row_pitch());
    if (row < D) {
      add({value}, 0, newtons / (rho * volume));
      continue;
    }
    // In the energy a stress is over its stiffness, and back in time it keeps its sign where motion turns.
    const double mu = rho * medium_.vs(cell) * medium_.vs(cell),
                 lambda = rho * medium_.vp(cell) * medium_.vp(cell) - 2 * mu, given = -newtons / volume;
    const bool shear = row >= Rows::normal_stress(0) + D;
    if (shear) add({value}, 0, given * mu);
    for (int i = 0; !shear && i < D; ++i)
      add({value}, Rows::normal_stress(i) - row,
          given * (lambda + (Rows::normal_stress(i) == row ? 2 * mu : 0)));
  }
}

/// Spreads `strength` over cells of stresses with the weights of a source in row `like`: smoothly, if the
/// moment is isotropic or lasts and its rock is large enough.
template <int D, class Real>
void PointSource<D, Real>::add_moment(const Source<D>& source,
                                      const std::vector<std::array<int, 2>>& stresses, int like,
                                      double strength) {
  using Rows = FieldRows<D>;
  if (strength == 0) return;
  std::vector<ValueWeight> weights;
  if (side_ == Side::fluid || moment_ == Moment::lasting)
    weights = smooth_source_weights(state_.layout, domain_, source.position_m, like, side_, moment_);
  if (weights.empty())
    weights = source_weights(state_.layout, domain_, source.position_m, like, side_);
  else
    reach_ = widest_spread(moment_) / 2;
  for (const auto& [i, j] : stresses) {
    add(weights, Rows::stored(state_.layout, Rows::stress(i, j)) - Rows::stored(state_.layout, like),
        strength);
    if (domain_.impedance(wave_s)(centre_) > 0)
      add(moment_corrections(state_.layout, domain_, centre_, weights, i, j), 0, strength);
  }
}

template <int D, class Real>
void PointSource<D, Real>::add(const std::vector<ValueWeight>& weights, int rows_on, double strength) {
  for (auto value : weights) {
    value.place += rows_on * state_.layout.row_pitch();
    value.weight *= strength;
    if (domain_.model_grid.rows)
      value.weight *= domain_.grid.spacing_m /
                      domain_.model_grid.height(domain_.model_cell(cell_of_value(state_.layout, value)));
    values_.push_back(value);
  }
}

/// All rows that a source in this cell can reach, wherever in the cell it is: rows that are acted on take
/// two half sweeps a step, and which ones do must not depend on the place, or traces would change with it.
template <int D, class Real>
void PointSource<D, Real>::find_rows() {
  rows_ = lines_of(values_);
  for (std::int64_t line = 0; line < state_.layout.lines(); ++line) {
    const auto at = state_.layout.line_index(line);
    bool near = true;
    for (std::size_t axis = 1; axis < D; ++axis) near &= std::abs(at[axis] - centre_[axis]) <= reach_;
    if (near) rows_.push_back(line);
  }
  std::sort(rows_.begin(), rows_.end());
  rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
  for (const auto& value : values_) writes_ |= 1U << (value.place / state_.layout.row_pitch());
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class PointSource);

}  // namespace slipwave::solver
