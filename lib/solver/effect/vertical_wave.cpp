// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/vertical_wave.hpp"

#include <algorithm>

#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"
#include "rock/coefficients.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/subdomains.hpp"
#include "solver/effect/incident_pml.hpp"
#include "solver/sweep/sweeps.hpp"

namespace slipwave::solver {
namespace {

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

bool travels_down(const Source<2>& source) {
  return std::get<PlaneWave<2>>(source.mechanism).direction[1] > 0;
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
  LyingEntry(const IncidentWave<2, Real>& entering, bool from_top)
      : entering_(entering), from_top_(from_top) {}
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
      any |= entering_.values({{time_s, time_s}, 0}, 1, from_top_ ? 0 : 1, {0, first + i}, 0, 1,
                              fields.data(), 1);
      for (int row = 0; row < FieldRows<2>::count; ++row)
        to[row_lying(row) * pitch + i] = fields[std::size_t(row)];
    }
    return any;
  }
  const IncidentWave<2, Real>& entering_;
  bool from_top_;
};

/// A vertical wave in a column of cells with identical neighbours: sweeps along z alone, with the scheme and
/// the PML of the main grid.
template <class Real>
class Column {
 public:
  Column(const Scene<2>& scene, const Source<2>& source, const Domain<2>& main, std::int64_t x,
         const IncidentWave<2, Real>& entering, double dt_s)
      : sweeps_of_step_(splitting(2, scene.numerics.time_order)),
        medium_(column_of(scene.model.medium, x)),
        domain_(make_domain(medium_, edges_of(scene), int(std::max(main.low_zone[1], main.high_zone[1])), {},
                            main.order)),
        state_(make_filled_state<2, Real>(domain_, medium_, dt_s)),
        sweeps_(state_, domain_, scene.numerics.order),
        work_(sweeps_.make_workspace(state_.layout.padded_nx())),
        pml_(make_pml(scene, source, entering, dt_s)),
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
                                                 const IncidentWave<2, Real>& entering, double dt_s) const {
    auto settings = pml_of_plane_wave(scene);
    settings.lying = true;
    return std::make_unique<IncidentPml<2, Real>>(
        state_.layout, domain_,
        std::make_unique<Pml<2, Real>>(
            state_.layout, domain_, dt_s, fastest_speed(scene.model.medium, scene.subdomain),
            source.wavelet.nominal_hz(), scene.numerics.time_order, nullptr, settings),
        settings, std::make_unique<LyingEntry<Real>>(entering, travels_down(source)),
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
  VerticalWave(const Scene<2>& scene, const Source<2>& source,
               std::unique_ptr<IncidentWave<2, Real>> entering, const Domain<2>& domain, double dt_s)
      : entering_(std::move(entering)),
        entry_(travels_down(source) ? 0 : 1),
        along_z_(SweepClocks<2>(splitting(2, scene.numerics.time_order), dt_s).along_last()) {
    const std::int64_t last = domain.model_grid.shape[0] - 1;
    for (const int side : {0, 1})
      if (domain.edges[0][side] == EdgeLaw::absorbing)
        columns_[std::size_t(side)] =
            std::make_unique<Column<Real>>(scene, source, domain, side ? last : 0, *entering_, dt_s);
  }
  void begin(State<2, Real>& state) override { entering_->begin(state); }
  void advance(const StepTime& time) override {
    for (auto& column : columns_)
      if (column) column->advance(time.step);
  }
  bool enters(int axis, int side) const override { return axis == 0 || side == entry_; }
  bool reaches(const StepTime& time, const Index<2>& line) const override {
    if (entering_->reaches(time, line)) return true;
    for (const auto& column : columns_)
      for (auto n = time.step * along_z_; column && n <= (time.step + 1) * along_z_; ++n)
        if (column->any(n, line[1])) return true;
    return false;
  }
  bool values(const Clocks<2>& clocks, int axis, int side, const Index<2>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override {
    if (axis == 1) return entering_->values(clocks, axis, side, line, x_first, count, to, pitch);
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
  std::unique_ptr<IncidentWave<2, Real>> entering_;
  int entry_;
  std::int64_t along_z_;  // sweeps of a step
  std::array<std::unique_ptr<Column<Real>>, 2> columns_;
};

}  // namespace

template <class Real>
std::unique_ptr<IncidentWave<2, Real>> make_vertical_wave(const Scene<2>& scene, const Source<2>& source,
                                                          std::unique_ptr<IncidentWave<2, Real>> entering,
                                                          const Domain<2>& domain, double dt_s) {
  return std::make_unique<VerticalWave<Real>>(scene, source, std::move(entering), domain, dt_s);
}

SLIPWAVE_INSTANTIATE_REAL(FUNCTION, make_vertical_wave);

}  // namespace slipwave::solver
