#include "solver/background.hpp"

#include <algorithm>
#include <cmath>

#include "scene/splitting.hpp"
#include "solver/sweeps.hpp"

namespace slipwave::solver {
namespace {

/// Two-way amplitude of what crosses a zone at the speed vp_max at normal incidence.
constexpr double zone_leak = 0.2;
/// Growth of the damping rate into the zone.
constexpr double zone_power = 2.5;
/// The outermost cells take the background outright: that is how an incoming wave enters.
constexpr std::int64_t zone_given = max_reach;

/// The closed form: every field is a constant times the wavelet at the time the front has passed the cell.
class PlaneForm {
 public:
  using Rows = FieldRows<2>;
  PlaneForm(const Source<2>& source, double vp, double vs, double rho)
      : wavelet_(source.wavelet), origin_(source.position_m) {
    const auto direction = std::get<PlaneWave<2>>(source.mechanism).direction;
    slowness_ = {direction[0] / vp, direction[1] / vp};
    const double mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
    const double strain = -source.amplitude / vp;  // e = -v/vp along the direction of travel
    factor_[Rows::velocity(0)] = source.amplitude * direction[0];
    factor_[Rows::velocity(1)] = source.amplitude * direction[1];
    factor_[Rows::normal_stress(0)] = strain * (lambda + 2 * mu * direction[0] * direction[0]);
    factor_[Rows::normal_stress(1)] = strain * (lambda + 2 * mu * direction[1] * direction[1]);
    factor_[Rows::shear_stress(0, 1)] = strain * 2 * mu * direction[0] * direction[1];
  }
  double value(int row, double x, double z, double t) const {
    return factor_[std::size_t(row)] *
           wavelet_(t - (x - origin_[0]) * slowness_[0] - (z - origin_[1]) * slowness_[1]);
  }

 private:
  Wavelet wavelet_;
  Point<2> origin_, slowness_;
  std::array<double, 5> factor_{};
};

/// The wave of t = 0 in every cell; it has not met anything yet.
template <class Real>
void begin_with(const PlaneForm& form, const Grid<2>& grid, State<2, Real>& state) {
  Index<2> line{};
  for (line[1] = 0; line[1] < grid.shape[1]; ++line[1])
    for (int row = 0; row < FieldRows<2>::count; ++row) {
      Real* u = state.field_row(line, row);
      for (std::int64_t i = 0; i < grid.shape[0]; ++i)
        u[i] = Real(form.value(row, grid.centre(0, i), grid.centre(1, line[1]), 0));
    }
}

Medium<2> column_of(const Medium<2>& medium, std::int64_t x) {
  const auto& grid = medium.grid();
  Grid<2> narrow = grid;
  narrow.shape[0] = 1;
  narrow.origin_m[0] += double(x) * grid.spacing_m;
  Medium<2> column{Field<2>(narrow), Field<2>(narrow), Field<2>(narrow)};
  for (std::int64_t k = 0; k < grid.shape[1]; ++k) {
    column.vp({0, k}) = medium.vp({x, k});
    column.vs({0, k}) = medium.vs({x, k});
    column.rho({0, k}) = medium.rho({x, k});
  }
  return column;
}

/// A vertical wave in a column of cells whose neighbours are all alike: sweeps along z alone, with the main
/// grid's own scheme, zones and incoming wave.
template <class Real>
class Column {
 public:
  Column(const Scene<2>& scene, int zone_cells, std::int64_t x, const PlaneForm& form, double dt_s,
         double vp_max)
      : medium_(column_of(scene.model.medium, x)),
        domain_(make_domain(medium_, edges_of(scene), zone_cells)),
        state_(make_state<2, Real>(domain_.grid.shape)),
        sweeps_(state_, domain_, scene.numerics.order),
        splitting_(splitting(2, scene.numerics.time_order)),
        factors_(zone_factors(domain_, 1, dt_s, vp_max)),
        form_(form) {
    fill_material(state_, domain_, medium_, dt_s);
    begin_with(form_, domain_.grid, state_);
  }
  /// `from_top`: the wave comes in through the top zone, else through the bottom one.
  void advance(std::int64_t step, double t, bool from_top) {
    for (const auto& sweep : splitting_)
      if (sweep.axis == 1) sweeps_.along(1, Real(sweep.part));
    const auto last = std::int64_t(factors_.size()) - 1;
    for (std::int64_t k = 0; k <= last; ++k) {
      const double factor = factors_[std::size_t(k)];
      if (factor == 1) continue;
      const bool entry = from_top == (k < last / 2);
      for (int row = 0; row < FieldRows<2>::count; ++row) {
        Real& u = state_.field_row({0, k}, row)[0];
        const double target = entry ? form_.value(row, 0, domain_.grid.centre(1, k), t) : 0;
        u = Real(target + factor * (double(u) - target));
      }
    }
    auto& now = kept_[std::size_t(step % Pass::most_steps_under_way)];
    now.clear();
    for (std::int64_t k = 0; k <= last; ++k)
      for (int row = 0; row < FieldRows<2>::count; ++row) now.push_back(state_.field_row({0, k}, row)[0]);
  }
  void keep(Archive& archive) { archive.fixed(state_.fields.data(), std::size_t(state_.fields.size())); }
  Real value(std::int64_t step, std::int64_t k, int row) const {
    return kept_[std::size_t(step % Pass::most_steps_under_way)][std::size_t(k * FieldRows<2>::count + row)];
  }

 private:
  static EdgeLaws<2> edges_of(const Scene<2>& scene) {
    EdgeLaws<2> edges = scene.edges;
    edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    return edges;
  }
  Medium<2> medium_;
  Domain<2> domain_;
  State<2, Real> state_;
  Sweeps<2, Real> sweeps_;
  std::vector<SweepPart> splitting_;
  std::vector<double> factors_;
  PlaneForm form_;
  std::array<std::vector<Real>, std::size_t(Pass::most_steps_under_way)> kept_;  // [step][cell][row]
};

/// A wave travelling straight down or up.
template <class Real>
class VerticalWave : public Background<2, Real> {
 public:
  VerticalWave(const Scene<2>& scene, const PlaneForm& form, const Domain<2>& domain, bool from_top,
               double dt_s, double vp_max)
      : form_(form), grid_(domain.grid), from_top_(from_top) {
    const std::int64_t last = domain.model_grid.shape[0] - 1;
    for (const int side : {0, 1})
      if (domain.edges[0][side] == EdgeLaw::absorbing)
        columns_[std::size_t(side)] =
            std::make_unique<Column<Real>>(scene, int(std::max(domain.low_zone[1], domain.high_zone[1])),
                                           side ? last : 0, form, dt_s, vp_max);
  }
  void begin(State<2, Real>& state) override { begin_with(form_, grid_, state); }
  void advance(const StepTime& time) override {
    for (auto& column : columns_)
      if (column) column->advance(time.step, time.end_s(), from_top_);
  }
  void values(const StepTime& time, int axis, int side, const Index<2>& line, std::int64_t,
              std::int64_t count, int field_row, Real* out) const override {
    double value = 0;
    if (axis == 0)
      value = columns_[std::size_t(side)]->value(time.step, line[1], field_row);
    else if (from_top_ == (side == 0))
      value = form_.value(field_row, 0, grid_.centre(1, line[1]), time.end_s());
    std::fill(out, out + count, Real(value));
  }
  bool needs_whole_step() const override { return false; }
  void keep(Archive& archive) override {
    for (auto& column : columns_)
      if (column) column->keep(archive);
  }

 private:
  PlaneForm form_;
  Grid<2> grid_;
  bool from_top_;
  std::array<std::unique_ptr<Column<Real>>, 2> columns_;
};

/// An oblique wave: all zones lie in one medium.
template <class Real>
class ObliqueWave : public Background<2, Real> {
 public:
  ObliqueWave(const PlaneForm& form, const Domain<2>& domain) : form_(form), grid_(domain.grid) {}
  void begin(State<2, Real>& state) override { begin_with(form_, grid_, state); }
  void advance(const StepTime&) override {}
  void values(const StepTime& time, int, int, const Index<2>& line, std::int64_t x_first, std::int64_t count,
              int field_row, Real* out) const override {
    const double z = grid_.centre(1, line[1]);
    for (std::int64_t i = 0; i < count; ++i)
      out[i] = Real(form_.value(field_row, grid_.centre(0, x_first + i), z, time.end_s()));
  }
  bool needs_whole_step() const override { return true; }
  void keep(Archive&) override {}

 private:
  PlaneForm form_;
  Grid<2> grid_;
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
      const bool given = width - j <= zone_given;
      factors[std::size_t(cell)] = given ? 0 : std::exp(-strongest * std::pow(depth, zone_power) * dt_s);
    }
  }
  return factors;
}

template <class Real>
std::unique_ptr<Background<2, Real>> make_plane_wave(const Scene<2>& scene, const Source<2>& source,
                                                     const Domain<2>& domain, double dt_s) {
  const auto& medium = scene.model.medium;
  const auto direction = std::get<PlaneWave<2>>(source.mechanism).direction;
  const bool vertical = std::abs(direction[0])<1e-9, from_top = direction[1]> 0;
  // A cell of the edge by which the wave enters; check(scene) has seen that all of it is alike.
  Index<2> entry{};
  if (vertical && !from_top) entry[1] = medium.grid().shape[1] - 1;
  if (!vertical && scene.edges[1][0] != EdgeLaw::absorbing) {
    if (scene.edges[0][direction[0] > 0 ? 0 : 1] == EdgeLaw::absorbing && direction[0] < 0)
      entry[0] = medium.grid().shape[0] - 1;
    entry[1] = medium.grid().shape[1] - 1;
  }
  const PlaneForm form(source, medium.vp(entry), medium.vs(entry), medium.rho(entry));
  if (vertical)
    return std::make_unique<VerticalWave<Real>>(scene, form, domain, from_top, dt_s, fastest_wave(medium));
  return std::make_unique<ObliqueWave<Real>>(form, domain);
}

template std::vector<double> zone_factors(const Domain<2>&, int, double, double);
template std::unique_ptr<Background<2, float>> make_plane_wave(const Scene<2>&, const Source<2>&,
                                                               const Domain<2>&, double);
template std::unique_ptr<Background<2, double>> make_plane_wave(const Scene<2>&, const Source<2>&,
                                                                const Domain<2>&, double);

}  // namespace slipwave::solver
