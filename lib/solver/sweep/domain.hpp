// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "model/split_faces.hpp"
#include "rock/elasticity.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/edges.hpp"
#include "scene/subdomain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// A cell of the computed grid whose rock is more than the loops of its row know, and the number of its
/// medium: one that an interface cuts (an equivalent TTI cell), or rock whose axes are turned from those of
/// the grid; in curvilinear rows all anisotropic rock.
struct AnisotropicCell {
  std::int64_t cell;
  std::int32_t medium;
};
/// What cells of one medium share: its elasticity, and that which the loops take it for.
template <int D>
struct AnisotropicMedium {
  double rho;
  Elasticity<D> elasticity, of_loops;
  bool turned;  // whether sweeps along the grid couple its pairs
  bool mean;    // an equivalent TTI cell
};

/// How rows of a fitted grid continue beyond a side of the model (theory.md (F10)), in cells: as they are for
/// some, then they become level within others.
struct SideRows {
  double straight = 0, bend = 10;
};

/// The computed grid: the model and, outside its absorbing edges, zones (of the PML) with the
/// medium of the edge.
template <int D>
class Domain {
 public:
  Grid<D> model_grid;
  Grid<D> grid;             // zones included
  Index<D> low_zone{};      // cells added below the model along each axis
  Index<D> high_zone{};     // and above
  EdgeLaws<D> edges;        // absorbing, without a zone, where other processes continue
  EdgeLaws<D> whole_edges;  // of the whole model
  Subdomain subdomain;
  IndexRange own;                   // rows of the computed grid that this process owns
  IndexRange band;                  // of which they are some: those of its cells, with no bands all
  std::vector<SplitFace<D>> split;  // of the computed grid, by axis and cell: no uniform run crosses these
  std::vector<std::int64_t> soft;   // cells that carry next to no stress (soft_cells())
  /// The stiffness of a cell outside the model in which planes give way; empty where there are none. Refers
  /// to the model, and is held as long as impedances are.
  std::function<std::optional<Elasticity<D>>(const Index<D>& at)> among_planes;
  int order = 1;  // of the reconstruction, at most
  /// The steps that a shot is simulated in; no medium where that is not known. Held as long as impedances
  /// are.
  struct Steps {
    const Medium<D>* medium = nullptr;
    double dt_s = 0;
    int time_order = 2;
  } steps;
  /// These two are of a fitted grid, by row (in 3-D plane) of the computed grid: whether it or one that
  /// stencils reach from it is not level, and the height of level ones in cells. They are empty where no row
  /// is curvilinear, or all heights are one cell.
  std::vector<char> curvilinear_rows;
  std::vector<double> row_heights;
  /// How rows continue beyond each side of the model.
  std::array<std::array<SideRows, 2>, std::size_t(D)> side_rows{};
  std::array<bool, 2> level_ends{};  // whether the first and the last row of the model are level
  bool curvilinear(std::int64_t row) const {
    return !curvilinear_rows.empty() && curvilinear_rows[std::size_t(row)];
  }
  double height(std::int64_t row) const { return row_heights.empty() ? 1 : row_heights[std::size_t(row)]; }

  /// Impedance of a wave along an axis in each cell, kg/(m2 s), 0 where it is not carried. Only while sweeps,
  /// effects and records are built: throws std::logic_error after release_impedances().
  const Field<D>& impedance(Wave wave, int axis = D - 1) const;
  /// Returns the impedance of a pair of sweeps along an axis (axis_of_pair()); pairs differ in anisotropic
  /// rock in 3-D.
  const Field<D>& impedance_of_pair(int axis, int pair) const;
  /// Returns the Courant number of the wave of a pair in a whole step: of the steps, 0 where they are not
  /// known.
  double courant(const Index<D>& cell, int axis, int pair) const;
  /// Whether a single fracture parts the face before a cell along an axis.
  bool is_split(const Index<D>& behind, int axis) const;
  /// Whether the S pairs of an axis may have different ones.
  bool splits_shear() const { return D == 3 && anisotropic(); }
  /// Whether any cell, of any process, is anisotropic.
  bool anisotropic() const { return anisotropic_; }
  /// The density times c13 of a cell of an anisotropic medium (wave_coupling()), in 3-D that of these axes.
  double coupling(const Index<D>& cell, int one = 0, int other = D - 1) const {
    return more_[std::size_t(coupling_row<D>(material_kind_, one, other))](cell);
  }
  /// By cell, ascending. Equivalent TTI cells of zones are isotropic, and those in curvilinear rows and
  /// beside them.
  const std::vector<AnisotropicCell>& anisotropic_cells() const { return cells_; }
  const std::vector<AnisotropicMedium<D>>& anisotropic_media() const { return media_; }
  /// Null where a cell is none of them.
  const AnisotropicCell* anisotropic_cell(const Index<D>& at) const;
  const AnisotropicMedium<D>* anisotropic_medium(const Index<D>& at) const {
    const auto* const of = anisotropic_cell(at);
    return of ? &media_[std::size_t(of->medium)] : nullptr;
  }
  void set_anisotropic_cells(std::vector<AnisotropicCell> cells, std::vector<AnisotropicMedium<D>> media) {
    cells_ = std::move(cells), media_ = std::move(media);
  }
  /// Whether sweeps in 3-D change the shear stress across their axis: any process has such cells.
  bool changes_shear_across() const { return D == 3 && (subdomain.tilted || !cells_.empty()); }
  /// Takes those cells of the model for what loops take them for.
  void drop_anisotropic_cells(const std::function<bool(std::size_t cell)>& which) {
    std::erase_if(cells_, [&](const AnisotropicCell& of) {
      return which(std::size_t(model_grid.flat(model_cell(grid.index(of.cell)))));
    });
  }
  /// Frees their memory.
  void release_impedances() {
    impedances_ = {}, more_ = {}, steps = {}, among_planes = {};
    if (D == 3) cells_ = {}, media_ = {};
  }
  void set_impedances(std::array<Field<D>, 2> of_waves) { impedances_ = std::move(of_waves); }
  /// The other rows of the material of an anisotropic medium, by MaterialRow.
  using Rows = std::array<Field<D>, std::size_t(most_material_rows)>;
  void set_anisotropy(MaterialKind kind, Rows more) {
    anisotropic_ = true;
    material_kind_ = kind;
    more_ = std::move(more);
  }

  /// Whether any cell carries S waves.
  bool shear() const;
  /// Returns the kind of medium of all processes together. What lies in curvilinear rows does not count as
  /// fluid: they couple all fields.
  MaterialKind material_kind() const { return material_kind_; }
  void find_material_kind() {
    const bool shears = subdomain.shear || !curvilinear_rows.empty() || shear();
    if (!anisotropic_) material_kind_ = shears ? MaterialKind::isotropic : MaterialKind::fluid;
  }
  bool owns(std::int64_t row) const { return row >= own.first && row < own.last; }
  /// Whether a row has a face that two bands of cells share.
  bool beside_band(std::int64_t row) const {
    const auto shared = [&](int side) {
      const auto face = side ? band.last : band.first;
      return subdomain.other_cells[std::size_t(side)] > 0 && (row == face || row + 1 == face);
    };
    return shared(0) || shared(1);
  }
  bool in_band(std::int64_t row) const { return row >= band.first && row < band.last; }
  /// Its own rows and those of other bands that it holds: what is found of all rows, each counted once.
  IndexRange own_and_other_cells() const {
    return {subdomain.ends_at_band(0) ? 0 : own.first,
            subdomain.ends_at_band(1) ? grid.shape[D - 1] : own.last};
  }
  /// Rows of neighbouring subdomains that it holds on either side, at most.
  std::int64_t rows_beside() const { return std::max(own.first, grid.shape[D - 1] - own.last); }
  /// Cell of the model whose medium a cell of the computed grid has.
  Index<D> model_cell(Index<D> at) const;
  /// A cell of the computed grid counted from the first of the model: outside the model in zones.
  Index<D> from_model(Index<D> at) const {
    for (int axis = 0; axis < D; ++axis) at[axis] -= low_zone[axis];
    return at;
  }
  /// Cell of the computed grid of a cell of the model.
  Index<D> computed_cell(Index<D> at) const {
    for (int axis = 0; axis < D; ++axis) at[axis] += low_zone[axis];
    return at;
  }
  bool in_model(const Index<D>& at) const { return computed_cell(model_cell(at)) == at; }
  /// Calls with(at) for a cell of the model in the computed grid, with `zones` for those of zones that are
  /// like it, too, ascending.
  template <class With>
  void each_like(const Index<D>& model_cell, bool zones, const With& with) const {
    const Index<D> first = computed_cell(model_cell);
    std::array<IndexRange, std::size_t(D)> cells;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const bool low = zones && model_cell[axis] == 0,
                 high = zones && model_cell[axis] + 1 == model_grid.shape[axis];
      cells[axis] = {low ? 0 : first[axis], high ? grid.shape[axis] : first[axis] + 1};
    }
    auto at = first;
    const auto along = [&](const auto& self, int axis) -> void {
      if (axis < 0) return with(std::as_const(at));
      const auto& range = cells[std::size_t(axis)];
      for (at[axis] = range.first; at[axis] < range.last; ++at[axis]) self(self, axis - 1);
    };
    along(along, D - 1);
  }

 private:
  std::array<Field<D>, 2> impedances_;
  bool anisotropic_ = false;
  MaterialKind material_kind_ = MaterialKind::isotropic;
  Rows more_;
  std::vector<AnisotropicCell> cells_;
  std::vector<AnisotropicMedium<D>> media_;
};

/// The elasticity that loops of sweeps take a cell of an anisotropic domain for, times the density.
template <int D>
Elasticity<D> elasticity_of_loops(const Domain<D>& domain, const Index<D>& cell);
/// Returns the elasticity of any cell, times the density.
template <int D>
Elasticity<D> elasticity_at(const Domain<D>& domain, const Index<D>& cell);
/// Whether a cell is one of anisotropic_cells(), or in 3-D S waves along z have two speeds there.
template <int D>
bool anisotropic_across_rows(const Domain<D>& domain, const Index<D>& cell) {
  if (domain.anisotropic_cell(cell)) return true;
  const double one = domain.impedance_of_pair(D - 1, 1)(cell),
               other = domain.impedance_of_pair(D - 1, D - 1)(cell);
  constexpr double rounding = 1e-6;
  return std::abs(one - other) > rounding * one;
}

/// Depth in cells of a corner of the computed grid of a fitted model. Beyond the sides of the model rows bend
/// until they are level, so that absorbing zones there act on a regular grid; above and below it they keep
/// their shape.
template <int D>
double corner_depth(const Domain<D>& domain, Index<D> corner);
/// Returns those of all corners of the computed grid, x fastest.
template <int D>
std::vector<double> corner_depths(const Domain<D>& domain);

/// `medium` is that of the model or of the rows that this process holds; `edges` are those of the whole
/// model; `order` is that of the reconstruction, or a higher one; steps of so many times the time step would
/// be stable in the model, which leaves rows beyond its sides room to become lower.
template <int D>
Domain<D> make_domain(const Medium<D>& medium, const EdgeLaws<D>& edges, int zone_cells,
                      const Subdomain& part = {}, int order = 7, double longer_steps = 1);

/// Writes b and the impedances of every cell and of the ghost cells beyond the edges into the state.
template <int D, class Real>
void fill_material(State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium, double dt_s);
/// A state with zero fields and that material.
template <int D, class Real>
State<D, Real> make_filled_state(const Domain<D>& domain, const Medium<D>& medium, double dt_s) {
  auto state = make_state<D, Real>(domain.grid.shape, domain.material_kind());
  fill_material(state, domain, medium, dt_s);
  return state;
}

/// Kinetic and elastic energy of a cell of the computed grid, J (2-D: J per metre).
template <int D, class Real>
double energy_of_cell(const State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium,
                      Index<D> at);

/// Kinetic and elastic energy of the model's cells, J (2-D: J per metre), zones left out: the sum over cells
/// of h^D/2 (rho v.v + s:C^-1:s). Zero in void.
template <int D, class Real>
double energy(const State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium);

}  // namespace slipwave::solver
