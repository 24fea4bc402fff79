#include "solver/effect/incident_wave.hpp"

#include <algorithm>
#include <cmath>

#include "scene/splitting.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {
namespace {

/// Two-way amplitude of a wave that crosses a zone at the speed vp_max at normal incidence.
constexpr double zone_leak = 0.2;
/// Growth of the damping rate into the zone.
constexpr double zone_power = 2.5;

using Rows = FieldRows<2>;

/// The closed form: every field is a constant times the wavelet at the time since the front passed the cell.
class PlaneForm {
 public:
  PlaneForm(const Source<2>& source, double vp, double vs, double rho)
      : wavelet_(source.wavelet), origin_(source.position_m) {
    const auto& wave = std::get<PlaneWave<2>>(source.mechanism);
    const auto& direction = wave.direction;
    const double c = wave.speed(vp, vs);
    slowness_ = {direction[0] / c, direction[1] / c};
    const double mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
    const double strain = -source.amplitude / c;  // grad v = -d v'/c
    if (wave.shear) {
      const Point<2> across = {direction[1], -direction[0]};
      factor_[Rows::velocity(0)] = source.amplitude * across[0];
      factor_[Rows::velocity(1)] = source.amplitude * across[1];
      factor_[Rows::normal_stress(0)] = strain * 2 * mu * direction[0] * across[0];
      factor_[Rows::normal_stress(1)] = strain * 2 * mu * direction[1] * across[1];
      factor_[Rows::shear_stress(0, 1)] = strain * mu * (direction[0] * across[1] + direction[1] * across[0]);
      return;
    }
    factor_[Rows::velocity(0)] = source.amplitude * direction[0];
    factor_[Rows::velocity(1)] = source.amplitude * direction[1];
    factor_[Rows::normal_stress(0)] = strain * (lambda + 2 * mu * direction[0] * direction[0]);
    factor_[Rows::normal_stress(1)] = strain * (lambda + 2 * mu * direction[1] * direction[1]);
    factor_[Rows::shear_stress(0, 1)] = strain * 2 * mu * direction[0] * direction[1];
  }
  /// The waveform that all fields are multiples of, at most 1.
  double wave(double x, double z, double t) const { return wavelet_(phase(x, z, t)); }
  double factor(int row) const { return factor_[std::size_t(row)]; }
  /// Whether the wave is nowhere between two points.
  bool is_zero(const Point<2>& one, const Point<2>& other, double t) const {
    const double at_one = phase(one[0], one[1], t), at_other = phase(other[0], other[1], t);
    return std::max(at_one, at_other) < 0 || std::min(at_one, at_other) > wavelet_.duration_s();
  }

 private:
  double phase(double x, double z, double t) const {
    return t - (x - origin_[0]) * slowness_[0] - (z - origin_[1]) * slowness_[1];
  }
  Wavelet wavelet_;
  Point<2> origin_, slowness_;
  std::array<double, 5> factor_{};
};

/// Depths of the centres of rows, all of them level, m.
std::vector<double> depths_of_rows(const Domain<2>& domain) {
  std::vector<double> depths;
  for (std::int64_t k = 0; k < domain.grid.shape[1]; ++k)
    depths.push_back(domain.row_heights.empty()
                         ? domain.grid.centre(1, k)
                         : (corner_depth(domain, {0, k}) + corner_depth(domain, {0, k + 1})) / 2 *
                               domain.grid.spacing_m);
  return depths;
}

/// Sets the wave of t = 0 in every cell; it has not reached any interface yet.
template <class Real>
void begin_with(const PlaneForm& form, const Grid<2>& grid, const std::vector<double>& depths,
                State<2, Real>& state) {
  Index<2> line{};
  for (line[1] = 0; line[1] < grid.shape[1]; ++line[1])
    for (std::int64_t i = 0; i < grid.shape[0]; ++i) {
      const double wave = form.wave(grid.centre(0, i), depths[std::size_t(line[1])], 0);
      for (int row = 0; row < Rows::count; ++row)
        state.field_row(line, row)[i] = Real(form.factor(row) * wave);
    }
}

/// A column of cells transposed: z becomes x, where cells follow each other in memory. Cells of another
/// height become cells of one height that waves cross in the same time, of the same impedance and mass.
Medium<2> column_of(const Medium<2>& medium, std::int64_t x) {
  const auto& grid = medium.grid();
  const Grid<2> lying{{grid.shape[1], 1},
                      grid.spacing_m,
                      {grid.origin_m[1], grid.origin_m[0]},
                      {grid.first[1], grid.first[0]}};
  Medium<2> column(lying, medium);
  for (const auto property : medium.properties())
    for (std::int64_t k = 0; k < grid.shape[1]; ++k) column[property]({k, 0}) = medium[property]({x, k});
  for (std::int64_t k = 0; grid.rows && k < grid.shape[1]; ++k) {
    const double height = grid.height({x, k}) / grid.spacing_m;
    const auto cell = std::size_t(k);
    column.vp[cell] = float(column.vp[cell] / height);
    column.vs[cell] = float(column.vs[cell] / height);
    column.rho[cell] = float(column.rho[cell] * height);
  }
  return column;
}

/// The field row of a transposed column that holds this field row.
int row_lying(int row) {
  for (const int axis : {0, 1}) {
    if (row == Rows::velocity(axis)) return Rows::velocity(1 - axis);
    if (row == Rows::normal_stress(axis)) return Rows::normal_stress(1 - axis);
  }
  return row;
}

/// Values of all rows in the cells of a column at the ends of the steps in progress.
template <class Real>
class ColumnValues {
 public:
  explicit ColumnValues(std::int64_t cells) : cells_(cells) {
    for (auto& values : values_) values.assign(std::size_t(cells * Rows::count), 0);
  }
  Real* row(std::int64_t step, int row) { return values_[slot(step)].data() + row * cells_; }
  IncidentValues<Real> at(std::int64_t step, std::int64_t cell) const {
    return {values_[slot(step)].data() + cell, cells_, false};
  }

 private:
  static std::size_t slot(std::int64_t step) {
    return std::size_t(step % Effect<2, Real>::most_steps_in_progress);
  }
  std::int64_t cells_;
  std::array<std::vector<Real>, std::size_t(Effect<2, Real>::most_steps_in_progress)> values_;  // [row][cell]
};

/// A vertical wave in a column of cells with identical neighbours: sweeps along z alone, with the
/// scheme, sponge and incident wave of the main grid.
template <class Real>
class Column {
 public:
  Column(const Scene<2>& scene, int zone_cells, std::int64_t x, const PlaneForm& form,
         const std::vector<double>& depths, double dt_s, double vp_max)
      : medium_(column_of(scene.model.medium, x)),
        domain_(make_domain(medium_, edges_of(scene), zone_cells, {}, scene.numerics.order)),
        state_(make_filled_state<2, Real>(domain_, medium_, dt_s)),
        sweeps_(state_, domain_, scene.numerics.order),
        work_(sweeps_.make_workspace(state_.layout.padded_nx())),
        splitting_(splitting(2, scene.numerics.time_order)),
        factors_(zone_factors(domain_, 0, dt_s, vp_max)),
        values_(domain_.grid.shape[0]) {
    for (std::int64_t k = 0; k < domain_.grid.shape[0]; ++k) {
      const double wave = form.wave(0, depths[std::size_t(k)], 0);
      for (int row = 0; row < Rows::count; ++row) field(row)[k] = Real(form.factor(row) * wave);
    }
  }
  /// `incoming`: the wave at the end of that step in the zones, 0 where waves only leave.
  void advance(std::int64_t step, const PlaneForm& form, const std::vector<double>& incoming) {
    const IndexRange all{0, domain_.grid.shape[0]};
    for (const auto& sweep : splitting_)
      if (sweep.axis == 1) {
        if (sweeps_.corrects_surface(0)) sweeps_.retain(0, 0, all);
        sweeps_.correct_side_surfaces(0);
        sweeps_.along_x(0, all, Real(sweep.fraction), boundary_, work_);
      }
    for (int row = 0; row < Rows::count; ++row) {
      Real* const u = field(row);
      for (std::int64_t k = 0; k < all.last; ++k) {
        const double factor = factors_[std::size_t(k)];
        if (factor == 1) continue;
        const double target = form.factor(row) * incoming[std::size_t(k)];
        u[k] = Real(target + factor * (double(u[k]) - target));
      }
      std::copy(u, u + all.last, values_.row(step, row));
    }
  }
  void serialize(Archive& archive) { archive.fixed(state_.fields.data(), std::size_t(state_.fields.size())); }
  const ColumnValues<Real>& values() const { return values_; }

 private:
  static EdgeLaws<2> edges_of(const Scene<2>& scene) {
    EdgeLaws<2> edges = scene.edges;
    edges[0] = edges[1];
    edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
    return edges;
  }
  Real* field(int row) { return state_.field_row({0, 0}, row_lying(row)); }
  Medium<2> medium_;
  Domain<2> domain_;
  State<2, Real> state_;
  Sweeps<2, Real> sweeps_;
  Workspace<Real> work_;
  StripeBoundary<Real> boundary_{};
  std::vector<SweepFraction> splitting_;
  std::vector<double> factors_;
  ColumnValues<Real> values_;
};

/// A wave travelling straight down or up.
template <class Real>
class VerticalWave : public IncidentWave<2, Real> {
 public:
  VerticalWave(const Scene<2>& scene, const PlaneForm& form, const Domain<2>& domain, bool from_top,
               double dt_s, double vp_max)
      : form_(form),
        grid_(domain.grid),
        depths_(depths_of_rows(domain)),
        entry_(from_top ? IndexRange{0, domain.low_zone[1]}
                        : IndexRange{grid_.shape[1] - domain.high_zone[1], grid_.shape[1]}),
        incoming_(std::size_t(grid_.shape[1]), 0.),
        values_(grid_.shape[1]) {
    const std::int64_t last = domain.model_grid.shape[0] - 1;
    for (const int side : {0, 1})
      if (domain.edges[0][side] == EdgeLaw::absorbing)
        columns_[std::size_t(side)] =
            std::make_unique<Column<Real>>(scene, int(std::max(domain.low_zone[1], domain.high_zone[1])),
                                           side ? last : 0, form, depths_, dt_s, vp_max);
  }
  void begin(State<2, Real>& state) override { begin_with(form_, grid_, depths_, state); }
  void advance(const StepTime& time) override {
    for (std::int64_t k = entry_.first; k < entry_.last; ++k) {
      const double wave = form_.wave(0, depths_[std::size_t(k)], time.end_s());
      incoming_[std::size_t(k)] = wave;
      for (int row = 0; row < Rows::count; ++row)
        values_.row(time.step, row)[k] = Real(form_.factor(row) * wave);
    }
    for (auto& column : columns_)
      if (column) column->advance(time.step, form_, incoming_);
  }
  IncidentValues<Real> values(const StepTime& time, int axis, int side, const Index<2>& line, std::int64_t,
                              std::int64_t, Real*) const override {
    const auto& values = axis == 0 ? columns_[std::size_t(side)]->values() : values_;
    return values.at(time.step, line[1]);
  }
  bool needs_whole_step() const override { return false; }
  void serialize(Archive& archive) override {
    for (auto& column : columns_)
      if (column) column->serialize(archive);
  }

 private:
  PlaneForm form_;
  Grid<2> grid_;
  std::vector<double> depths_;
  IndexRange entry_;              // rows of the zone it enters through
  std::vector<double> incoming_;  // of each row at the end of the newest step
  ColumnValues<Real> values_;     // in the zones above and below
  std::array<std::unique_ptr<Column<Real>>, 2> columns_;
};

/// An oblique wave: all zones lie in one medium.
template <class Real>
class ObliqueWave : public IncidentWave<2, Real> {
 public:
  ObliqueWave(const PlaneForm& form, const Domain<2>& domain)
      : form_(form), grid_(domain.grid), depths_(depths_of_rows(domain)) {}
  void begin(State<2, Real>& state) override { begin_with(form_, grid_, depths_, state); }
  void advance(const StepTime&) override {}
  IncidentValues<Real> values(const StepTime& time, int, int, const Index<2>& line, std::int64_t x_first,
                              std::int64_t count, Real* room) const override {
    const double z = depths_[std::size_t(line[1])], t = time.end_s();
    const auto x = [&](std::int64_t i) { return grid_.centre(0, x_first + i); };
    if (form_.is_zero({x(0), z}, {x(count - 1), z}, t)) return {zeros_.data(), 1, false};
    for (std::int64_t i = 0; i < count; ++i) {
      const double wave = form_.wave(x(i), z, t);
      for (int row = 0; row < Rows::count; ++row) room[row * count + i] = Real(form_.factor(row) * wave);
    }
    return {room, count, true};
  }
  bool needs_whole_step() const override { return true; }
  void serialize(Archive&) override {}

 private:
  PlaneForm form_;
  Grid<2> grid_;
  std::vector<double> depths_;
  std::array<Real, Rows::count> zeros_{};
};

}  // namespace

template <int D>
std::vector<double> zone_factors(const Domain<D>& domain, int axis, double dt_s, double vp_max) {
  std::vector<double> factors(std::size_t(domain.grid.shape[axis]), 1.);
  for (const int side : {0, 1}) {
    const auto width = side ? domain.high_zone[axis] : domain.low_zone[axis];
    const double strongest =
        -(zone_power + 1) * vp_max * std::log(zone_leak) / (2 * double(width) * domain.grid.spacing_m);
    for (std::int64_t j = 0; j < width; ++j) {
      const double depth = (double(j) + 0.5) / double(width);
      const auto cell = side ? domain.grid.shape[axis] - width + j : width - 1 - j;
      // The outermost cells, all that the next ones read, are set to the incident wave: that is how it enters.
      const bool prescribed = width - j <= nearness_of(domain.order);
      factors[std::size_t(cell)] = prescribed ? 0 : std::exp(-strongest * std::pow(depth, zone_power) * dt_s);
    }
  }
  return factors;
}

template <class Real>
std::unique_ptr<IncidentWave<2, Real>> make_plane_wave(const Scene<2>& scene, const Source<2>& source,
                                                       const Domain<2>& domain, double dt_s) {
  const auto& medium = scene.model.medium;
  const auto direction = std::get<PlaneWave<2>>(source.mechanism).direction;
  const bool vertical = std::abs(direction[0])<1e-9, from_top = direction[1]> 0;
  // A cell of the edge by which the wave enters; check(scene) has made sure that the edge is uniform.
  Index<2> entry{};
  if (vertical && !from_top) entry[1] = medium.grid().shape[1] - 1;
  if (!vertical && scene.edges[1][0] != EdgeLaw::absorbing) {
    if (scene.edges[0][direction[0] > 0 ? 0 : 1] == EdgeLaw::absorbing && direction[0] < 0)
      entry[0] = medium.grid().shape[0] - 1;
    entry[1] = medium.grid().shape[1] - 1;
  }
  const PlaneForm form(source, medium.vp(entry), medium.vs(entry), medium.rho(entry));
  if (vertical)
    return std::make_unique<VerticalWave<Real>>(scene, form, domain, from_top, dt_s, fastest_speed(medium));
  return std::make_unique<ObliqueWave<Real>>(form, domain);
}

template std::vector<double> zone_factors(const Domain<2>&, int, double, double);
template std::unique_ptr<IncidentWave<2, float>> make_plane_wave(const Scene<2>&, const Source<2>&,
                                                                 const Domain<2>&, double);
template std::unique_ptr<IncidentWave<2, double>> make_plane_wave(const Scene<2>&, const Source<2>&,
                                                                  const Domain<2>&, double);

}  // namespace slipwave::solver
