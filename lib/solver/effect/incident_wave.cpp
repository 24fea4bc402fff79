// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/incident_wave.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/plane_wave.hpp"
#include "scene/subdomains.hpp"
#include "solver/effect/incident_pml.hpp"
#include "solver/effect/layered_wave.hpp"
#include "solver/effect/plane_form.hpp"
#include "solver/effect/turned_wave.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {
namespace {

/// Sets all cells to a wave of one medium at t = 0.
template <int D, class Real>
void begin_with(const PlaneForm<D>& form, const Grid<D>& grid, const std::vector<double>& depths,
                State<D, Real>& state) {
  set_cells<D>(state,
               [&](const Index<D>& at, std::int64_t first, std::int64_t count, Real* to, std::int64_t pitch) {
                 return form.cells(grid.centre(0, 0), grid.spacing_m, first, count,
                                   depths[std::size_t(at[D - 1])], 0, 0, to, pitch);
               });
}

template <int D>
double ahead_s(const Clocks<D>& clocks) {
  const double ahead = clocks.axis_s[0] - clocks.axis_s[D - 1];
  // Half a sweep, or rounding.
  return std::abs(ahead) < 1e-9 * clocks.axis_s[0] ? 0 : ahead;
}

/// A wave in one medium, in closed form.
template <int D, class Real>
class UniformWave : public IncidentWave<D, Real> {
 public:
  UniformWave(const PlaneForm<D>& form, const Domain<D>& domain, const PlaneWaveWay<D>& way)
      : form_(form),
        grid_(domain.grid),
        depths_(depths_of_rows(domain)),
        by_entry_only_(way.by_entry_only),
        entry_(way.entry_side) {}
  void begin(State<D, Real>& state) override { begin_with(form_, grid_, depths_, state); }
  bool enters(int axis, int side) const override {
    return !by_entry_only_ || (axis == D - 1 && side == entry_);
  }
  bool reaches(const StepTime& time, const Index<D>& line) const override {
    // Sweeps of a step advance fields by more than a step nowhere.
    const double middle = time.end_s() - time.dt_s / 2, beside = 3 * time.dt_s;
    return form_.is_there({grid_.origin_m[0], grid_.end(0)}, depths_[std::size_t(line[D - 1])], middle,
                          beside, beside);
  }
  bool values(const Clocks<D>& clocks, int, int, const Index<D>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override {
    return form_.cells(grid_.centre(0, 0), grid_.spacing_m, x_first, count, depths_[std::size_t(line[D - 1])],
                       clocks.axis_s[D - 1], ahead_s(clocks), to, pitch);
  }

 private:
  PlaneForm<D> form_;
  Grid<D> grid_;
  std::vector<double> depths_;
  bool by_entry_only_;
  int entry_;
};

/// Turns the rocks of a column with it: x and z change places.
void transpose_rocks(Medium<2>& column) {
  complete_anisotropy(column);
  for (std::size_t cell = 0; cell < column.vp.size(); ++cell) {
    auto rock = material_of(column, cell);
    if (!rock.is_anisotropic()) continue;
    if (rock.constants) {
      auto c = upright_elasticity<2>(rock);
      std::swap(c.voigt[0], c.voigt[1]);
      for (auto& row : c.voigt) std::swap(row[0], row[1]);
      rock = rock_of_constants(c, rock.rho);
    } else if (rock.tilt != 0) {
      rock.tilt = rock.tilt > 0 ? 90 - rock.tilt : -90 - rock.tilt;
    } else {
      const auto c = upright_elasticity<2>(rock);
      rock = material_of(vertical_symmetry(c(3, 3), c(1, 3), c(1, 1), c(5, 5)), rock.rho);
    }
    put(column, cell, rock);
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
    for (const auto property : column.properties())
      if (is_elastic_constant(property)) column[property][cell] = float(column[property][cell] / height);
  }
  // Interfaces do not dip in a column.
  drop_tilted_means(column);
  transpose_rocks(column);
  return column;
}

/// The field row of a transposed column that holds this field row.
int row_lying(int row) {
  using Rows = FieldRows<2>;
  for (const int axis : {0, 1}) {
    if (row == Rows::velocity(axis)) return Rows::velocity(1 - axis);
    if (row == Rows::normal_stress(axis)) return Rows::normal_stress(1 - axis);
  }
  return row;
}

/// The incident wave of a transposed column, in the zone it enters by.
template <class Real>
class LyingEntry : public IncidentWave<2, Real> {
 public:
  LyingEntry(const PlaneForm<2>& form, std::vector<double> depths, bool from_top)
      : form_(form), depths_(std::move(depths)), from_top_(from_top) {}
  void begin(State<2, Real>& state) override {
    set_cells<2>(state, [&](const Index<2>&, std::int64_t first, std::int64_t count, Real* to,
                            std::int64_t pitch) { return write(0, first, count, to, pitch); });
  }
  bool enters(int axis, int side) const override { return axis == 0 && side == (from_top_ ? 0 : 1); }
  bool reaches(const StepTime&, const Index<2>&) const override { return true; }
  bool values(const Clocks<2>& clocks, int, int, const Index<2>&, std::int64_t first, std::int64_t count,
              Real* to, std::int64_t pitch) const override {
    return write(clocks.axis_s[1], first, count, to, pitch);
  }

 private:
  bool write(double time_s, std::int64_t first, std::int64_t count, Real* to, std::int64_t pitch) const {
    bool any = false;
    for (std::int64_t i = 0; i < count; ++i) {
      std::array<Real, std::size_t(FieldRows<2>::count)> fields{};
      any |= form_.cells(form_.origin()[0], 0, 0, 1, depths_[std::size_t(first + i)], time_s, 0,
                         fields.data(), 1);
      for (int row = 0; row < FieldRows<2>::count; ++row)
        to[row_lying(row) * pitch + i] = fields[std::size_t(row)];
    }
    return any;
  }
  PlaneForm<2> form_;
  std::vector<double> depths_;
  bool from_top_;
};

/// A vertical wave in a column of cells with identical neighbours: sweeps along z alone, with the scheme and
/// the PML of the main grid.
template <class Real>
class Column {
 public:
  Column(const Scene<2>& scene, const Source<2>& source, const Domain<2>& main, std::int64_t x,
         const PlaneForm<2>& form, double dt_s, double vp_max)
      : sweeps_of_step_(splitting(2, scene.numerics.time_order)),
        medium_(column_of(scene.model.medium, x)),
        domain_(make_domain(medium_, edges_of(scene), int(std::max(main.low_zone[1], main.high_zone[1])), {},
                            main.order)),
        state_(make_filled_state<2, Real>(domain_, medium_, dt_s)),
        sweeps_(state_, domain_, scene.numerics.order),
        work_(sweeps_.make_workspace(state_.layout.padded_nx())),
        pml_(make_pml(scene, source, depths_of_rows(main), form, dt_s, vp_max)),
        cells_(domain_.grid.shape[0]),
        slots_(std::size_t((most_steps_in_progress + 1) * SweepClocks<2>(sweeps_of_step_, dt_s).along_last() +
                           1)) {
    domain_.release_impedances();
    sweeps_.use(pml_.get());
    for (auto& slot : slots_) slot.assign(std::size_t(cells_ * FieldRows<2>::count), 0);
    pml_->initialize(state_);
    store();
  }
  void advance(std::int64_t step) {
    const IndexRange all{0, cells_};
    for (std::size_t n = 0; n < sweeps_of_step_.size(); ++n) {
      if (sweeps_of_step_[n].axis != 1) continue;
      if (sweeps_.corrects_surface(0)) sweeps_.retain(0, 0, all);
      sweeps_.correct_side_surfaces(0, all);
      work_.time() = {step, n};
      sweeps_.prepare_along_x(0, all, work_.time());
      sweeps_.along_x(0, all, Real(sweeps_of_step_[n].fraction), boundary_, work_);
      ++made_;
      store();
    }
  }
  void serialize(Archive& archive) {
    archive.value(made_);
    archive.fixed(state_.fields.data(), std::size_t(state_.fields.size()));
    pml_->serialize(archive);
    store();
  }
  /// Returns all fields after that many sweeps along z, one field row after another of cells() values each.
  const Real* fields(std::int64_t sweeps_made) const {
    return slots_[std::size_t(sweeps_made) % slots_.size()].data();
  }
  std::int64_t cells() const { return cells_; }
  /// Whether any is other than zero in a cell.
  bool any(std::int64_t sweeps_made, std::int64_t cell) const {
    const Real* const here = fields(sweeps_made) + cell;
    for (int row = 0; row < FieldRows<2>::count; ++row)
      if (here[row * cells_] != 0) return true;
    return false;
  }
  std::int64_t memory_bytes() const {
    return std::int64_t(slots_.size() * slots_.front().size() * sizeof(Real));
  }

 private:
  static EdgeLaws<2> edges_of(const Scene<2>& scene) {
    EdgeLaws<2> edges = scene.edges;
    edges[0] = edges[1];
    edges[1] = {EdgeLaw::mirror, EdgeLaw::mirror};
    return edges;
  }
  std::unique_ptr<IncidentPml<2, Real>> make_pml(const Scene<2>& scene, const Source<2>& source,
                                                 std::vector<double> depths, const PlaneForm<2>& form,
                                                 double dt_s, double vp_max) const {
    auto settings = pml_of_plane_wave(scene);
    settings.lying = true;
    return std::make_unique<IncidentPml<2, Real>>(
        state_.layout, domain_,
        std::make_unique<Pml<2, Real>>(state_.layout, domain_, dt_s, vp_max, source.wavelet.nominal_hz(),
                                       scene.numerics.time_order, nullptr, settings),
        settings,
        std::make_unique<LyingEntry<Real>>(form, std::move(depths),
                                           std::get<PlaneWave<2>>(source.mechanism).direction[1] > 0),
        SweepClocks<2>(sweeps_of_step_, dt_s));
  }
  void store() {
    auto& slot = slots_[std::size_t(made_) % slots_.size()];
    for (int row = 0; row < FieldRows<2>::count; ++row) {
      if (!FieldRows<2>::is_stored(state_.layout, row)) continue;
      const Real* const from = state_.field_row({0, 0}, row_lying(row));
      std::copy(from, from + cells_, slot.begin() + row * cells_);
    }
  }
  std::vector<SweepFraction> sweeps_of_step_;
  Medium<2> medium_;
  Domain<2> domain_;
  State<2, Real> state_;
  Sweeps<2, Real> sweeps_;
  Workspace<Real> work_;
  StripeBoundary<Real> boundary_{};
  std::unique_ptr<IncidentPml<2, Real>> pml_;
  std::int64_t cells_, made_ = 0;
  std::vector<std::vector<Real>> slots_;  // [sweeps made, in a ring][row][cell]
};

/// A wave travelling straight down or up.
template <class Real>
class VerticalWave : public IncidentWave<2, Real> {
 public:
  VerticalWave(const Scene<2>& scene, const Source<2>& source, const PlaneForm<2>& form,
               const Domain<2>& domain, double dt_s, double vp_max)
      : form_(form),
        grid_(domain.grid),
        depths_(depths_of_rows(domain)),
        entry_(std::get<PlaneWave<2>>(source.mechanism).direction[1] > 0 ? 0 : 1) {
    const std::int64_t last = domain.model_grid.shape[0] - 1;
    for (const int side : {0, 1})
      if (domain.edges[0][side] == EdgeLaw::absorbing)
        columns_[std::size_t(side)] =
            std::make_unique<Column<Real>>(scene, source, domain, side ? last : 0, form, dt_s, vp_max);
    for (const auto& sweep : splitting(2, scene.numerics.time_order)) along_z_ += sweep.axis == 1;
  }
  void begin(State<2, Real>& state) override { begin_with(form_, grid_, depths_, state); }
  void advance(const StepTime& time) override {
    for (auto& column : columns_)
      if (column) column->advance(time.step);
  }
  bool enters(int axis, int side) const override { return axis == 0 || side == entry_; }
  bool reaches(const StepTime& time, const Index<2>& line) const override {
    const double x = form_.origin()[0], beside = 3 * time.dt_s;
    if (form_.is_there({x, x}, depths_[std::size_t(line[1])], time.end_s(), 0, beside)) return true;
    for (const auto& column : columns_)
      for (auto n = time.step * along_z_; column && n <= (time.step + 1) * along_z_; ++n)
        if (column->any(n, line[1])) return true;
    return false;
  }
  bool values(const Clocks<2>& clocks, int axis, int side, const Index<2>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override {
    if (axis == 1)
      return form_.cells(grid_.centre(0, 0), grid_.spacing_m, x_first, count, depths_[std::size_t(line[1])],
                         clocks.axis_s[1], 0, to, pitch);
    const auto& column = *columns_[std::size_t(side)];
    const Real* const from = column.fields(clocks.along_last) + line[1];
    for (int row = 0; row < FieldRows<2>::count; ++row)
      std::fill(to + row * pitch, to + row * pitch + count, from[row * column.cells()]);
    return true;
  }
  void serialize(Archive& archive) override {
    for (auto& column : columns_)
      if (column) column->serialize(archive);
  }
  std::int64_t memory_bytes() const override {
    std::int64_t bytes = 0;
    for (const auto& column : columns_)
      if (column) bytes += column->memory_bytes();
    return bytes;
  }

 private:
  PlaneForm<2> form_;
  Grid<2> grid_;
  std::vector<double> depths_;
  int entry_;
  std::int64_t along_z_ = 0;  // sweeps of a step
  std::array<std::unique_ptr<Column<Real>>, 2> columns_;
};

}  // namespace

template <int D>
SweepClocks<D>::SweepClocks(std::vector<SweepFraction> sweeps, double dt_s)
    : sweeps_(std::move(sweeps)), dt_s_(dt_s) {
  for (const auto& sweep : sweeps_) along_last_ += sweep.axis == D - 1;
}

template <int D>
Clocks<D> SweepClocks<D>::before(const SweepTime& time) const {
  Clocks<D> clocks;
  std::array<double, std::size_t(D)> fractions{};
  clocks.along_last = time.step * along_last_;
  for (std::size_t n = 0; n < time.sweep; ++n) {
    fractions[std::size_t(sweeps_[n].axis)] += sweeps_[n].fraction;
    clocks.along_last += sweeps_[n].axis == D - 1;
  }
  for (std::size_t axis = 0; axis < D; ++axis)
    clocks.axis_s[axis] = (double(time.step) + fractions[axis]) * dt_s_;
  return clocks;
}

template <int D>
Clocks<D> SweepClocks<D>::after(const SweepTime& time, double fraction) const {
  auto clocks = before(time);
  const auto axis = sweeps_[time.sweep].axis;
  clocks.axis_s[std::size_t(axis)] += fraction * dt_s_;
  clocks.along_last += axis == D - 1;
  return clocks;
}

template <int D, class Real>
std::unique_ptr<IncidentWave<D, Real>> make_incident_wave(const Scene<D>& scene, const Source<D>& source,
                                                          const Domain<D>& domain, double dt_s) {
  const auto& medium = scene.model.medium;
  const auto way = way_of_plane_wave(scene, source);
  const PlaneForm<D> form(source, material_of(medium, std::size_t(medium.grid().flat(way.entry))));
  if constexpr (D == 2)
    if (way.kind == PlaneWaveKind::vertical)
      return std::make_unique<VerticalWave<Real>>(scene, source, form, domain, dt_s,
                                                  fastest_speed(medium, scene.subdomain));
  if constexpr (D == 3)
    if (!std::get<PlaneWave<3>>(source.mechanism).in_x_z() || travels_in_anisotropic_rock(scene, domain, way))
      return make_turned_wave<Real>(scene, source, form, domain, way, dt_s);
  if (way.kind == PlaneWaveKind::layered) return make_layered_wave<D, Real>(scene, source, form, domain, way);
  return std::make_unique<UniformWave<D, Real>>(form, domain, way);
}

SLIPWAVE_INSTANTIATE_D(TYPE, class SweepClocks);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, make_incident_wave);

}  // namespace slipwave::solver
