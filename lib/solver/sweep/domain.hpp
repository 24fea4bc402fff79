// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "model/parted_faces.hpp"
#include "model/space_stiffness.hpp"
#include "model/tilted_mean.hpp"
#include "scene/edges.hpp"
#include "scene/subdomain.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// A cell of the computed grid that is a tilted mean, or rock whose axis of symmetry is tilted.
struct TiltedMedium {
  std::int64_t cell;
  double rho;
  PlaneStiffness stiffness;
  bool mean = false;
};

/// In 3-D: the number of its medium, and that.
struct TiltedCellInSpace {
  std::int64_t cell;
  std::int32_t medium;
};
struct TiltedMediumInSpace {
  double rho;
  SpaceStiffness stiffness;
  bool turned = true;  // whether sweeps along the grid couple its pairs
};
template <int D>
using TiltedCell = std::conditional_t<D == 2, TiltedMedium, TiltedCellInSpace>;

/// The waves of such a cell in 2-D in sweeps along an axis: the motion of the faster one along the axis and
/// across it, the impedances of both, and the impedance as a matrix of these components (theory.md (T3)).
struct TiltedWaves {
  double cosine, sine;
  std::array<double, 2> z;
  double along, mixed, across;
};
TiltedWaves waves_along(const TiltedMedium& medium, int axis);

/// A symmetric tensor of components along z and x, the order of the pairs of a sweep along z.
struct PlaneTensor {
  double zz = 0, zx = 0, xx = 0;
};
/// The acoustic tensor N.C.N of a face with this vector, of any length.
PlaneTensor acoustic_tensor(const PlaneStiffness& stiffness, double nx, double nz);
/// The root of one that is not negative: the impedances of the waves across that face, where the stiffness is
/// times the density (theory.md (T3)).
PlaneTensor root_of(const PlaneTensor& tensor);

/// What strains along an edge leave of strains across it where no traction acts there: strain across =
/// -normal times strain along, shear strain = -shear times that. lambda/(lambda + 2 mu) and 0 in isotropic
/// media (theory.md (V4), (V7)).
struct EdgeCoupling {
  double normal = 0, shear = 0;
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
  IndexRange own;                     // rows of the computed grid that this process owns
  std::vector<PartedFace<D>> parted;  // of the computed grid, by axis and cell
  std::vector<std::int64_t> soft;     // cells that carry next to no stress (soft_cells())
  int order = 1;                      // of the reconstruction, at most
  /// Of a fitted grid, by row (in 3-D plane) of the computed grid: whether it or one that stencils reach from
  /// it is not level, and the height of level ones in cells. Empty where none is bent, or all are one cell.
  std::vector<char> bent_rows;
  std::vector<double> row_heights;
  /// How rows continue beyond each side of the model.
  std::array<std::array<SideRows, 2>, std::size_t(D)> side_rows{};
  std::array<bool, 2> level_ends{};  // whether the first and the last row of the model are level
  bool bent(std::int64_t row) const { return !bent_rows.empty() && bent_rows[std::size_t(row)]; }
  double height(std::int64_t row) const { return row_heights.empty() ? 1 : row_heights[std::size_t(row)]; }

  /// Impedance of a wave along an axis in each cell, kg/(m2 s), 0 where it is not carried. Only while sweeps,
  /// effects and records are built: throws std::logic_error after release_impedances().
  const Field<D>& impedance(Wave wave, int axis = D - 1) const;
  /// That of a pair of sweeps along an axis (axis_of_pair()), which differ in anisotropic rock in space.
  const Field<D>& impedance_of_pair(int axis, int pair) const;
  /// Whether the S pairs of an axis may have different ones.
  bool splits_shear() const { return D == 3 && anisotropic(); }
  /// Whether any cell, of any process, is anisotropic.
  bool anisotropic() const { return anisotropic_; }
  /// The density times c13 of a cell of an anisotropic medium (wave_coupling()), in 3-D that of these axes.
  double coupling(const Index<D>& cell, int one = 0, int other = D - 1) const {
    return more_[std::size_t(coupling_row<D>(material_kind_, one, other))](cell);
  }
  /// Of the edge across an axis, to motion along another.
  EdgeCoupling coupling_at_edge(const Index<D>& cell, int axis, int along) const;
  /// Tilted means and cells of rock whose axis is tilted, by cell; in bent rows all anisotropic cells.
  /// Tilted means of zones are isotropic, and those in bent rows and beside them.
  const std::vector<TiltedCell<D>>& tilted() const { return tilted_; }
  bool is_tilted(const Index<D>& at) const { return tilted_at(at) != nullptr; }
  /// Null where a cell is none.
  const TiltedCell<D>* tilted_at(const Index<D>& at) const;
  void set_tilted(std::vector<TiltedCell<D>> cells) { tilted_ = std::move(cells); }
  /// In 3-D: the distinct media of those cells; of any part whether it has some; null where a cell is none.
  const std::vector<TiltedMediumInSpace>& tilted_media() const { return tilted_media_; }
  bool any_tilted_in_space() const { return D == 3 && (subdomain.tilted || !tilted_.empty()); }
  const TiltedMediumInSpace* tilted_medium(const Index<D>& at) const;
  void set_tilted_media(std::vector<TiltedMediumInSpace> media) { tilted_media_ = std::move(media); }
  /// Takes those cells of the model for isotropic ones.
  void drop_tilted(const std::function<bool(std::size_t cell)>& which) {
    std::erase_if(tilted_, [&](const TiltedCell<D>& of) {
      return which(std::size_t(model_grid.flat(model_cell(grid.index(of.cell)))));
    });
  }
  /// Frees their memory.
  void release_impedances() {
    impedances_ = {}, more_ = {};
    if (D == 3) tilted_ = {}, tilted_media_ = {};
  }
  void set_impedances(std::array<Field<D>, 2> of_waves) { impedances_ = std::move(of_waves); }
  /// Of an anisotropic medium, besides: the other rows of its material, by MaterialRow.
  using Rows = std::array<Field<D>, std::size_t(most_material_rows)>;
  void set_anisotropy(MaterialKind kind, Rows more) {
    anisotropic_ = true;
    material_kind_ = kind;
    more_ = std::move(more);
  }

  /// Whether any cell carries S waves.
  bool shear() const;
  /// That of all processes. What lies in bent rows does not count as fluid: they couple all fields.
  MaterialKind material_kind() const { return material_kind_; }
  void find_material_kind() {
    const bool shears = subdomain.shear || !bent_rows.empty() || shear();
    if (!anisotropic_) material_kind_ = shears ? MaterialKind::isotropic : MaterialKind::fluid;
  }
  bool owns(std::int64_t row) const { return row >= own.first && row < own.last; }
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

 private:
  std::array<Field<D>, 2> impedances_;
  bool anisotropic_ = false;
  MaterialKind material_kind_ = MaterialKind::isotropic;
  Rows more_;
  std::vector<TiltedCell<D>> tilted_;
  std::vector<TiltedMediumInSpace> tilted_media_;
};

/// Of a free edge across an axis of a tilted medium in space: what a difference of the velocity along another
/// leaves of that across it where no traction acts there, as a matrix of x, y and z: the difference across is
/// minus the matrix times that along (theory.md (O9)).
std::array<SpaceVector, 3> coupling_at_edge_in_space(const SpaceStiffness& stiffness, int axis, int along);
/// The rows of C_iajb, axis a: its acoustic tensor for b = a, else what motion along b puts on the face.
std::array<SpaceVector, 3> tractions_of_motion(const SpaceStiffness& stiffness, int axis, int along);
/// What a symmetric positive matrix times it is `right`.
template <class Real>
std::array<Real, 3> solved(const std::array<std::array<Real, 3>, 3>& m, const std::array<Real, 3>& right) {
  const Real a = m[1][1] * m[2][2] - m[1][2] * m[1][2], b = m[0][2] * m[1][2] - m[0][1] * m[2][2],
             c = m[0][1] * m[1][2] - m[0][2] * m[1][1], d = m[0][0] * m[2][2] - m[0][2] * m[0][2],
             e = m[0][1] * m[0][2] - m[0][0] * m[1][2], f = m[0][0] * m[1][1] - m[0][1] * m[0][1];
  const Real share = 1 / (m[0][0] * a + m[0][1] * b + m[0][2] * c);
  return {share * (a * right[0] + b * right[1] + c * right[2]),
          share * (b * right[0] + d * right[1] + e * right[2]),
          share * (c * right[0] + e * right[1] + f * right[2])};
}

/// The stiffness of a cell of an anisotropic domain times the density, tilted ones as upright.
template <int D>
auto stiffness_at(const Domain<D>& domain, const Index<D>& cell) {
  const auto square = [&](int axis, int pair) {
    const double z = domain.impedance_of_pair(axis, pair)(cell);
    return z * z;
  };
  if constexpr (D == 2)
    return Stiffness{square(0, 0), domain.coupling(cell), square(1, 0), square(1, 1)};
  else
    return OrthorhombicStiffness{square(0, 0),
                                 square(1, 0),
                                 square(2, 0),
                                 square(2, 2),
                                 square(2, 1),
                                 square(0, 1),
                                 domain.coupling(cell, 0, 1),
                                 domain.coupling(cell, 0, 2),
                                 domain.coupling(cell, 1, 2)};
}

/// That in the plane of x and z of any cell in 2-D, times the density.
PlaneStiffness plane_stiffness_at(const Domain<2>& domain, const Index<2>& cell);
/// That of any cell in 3-D, times the density.
SpaceStiffness space_stiffness_at(const Domain<3>& domain, const Index<3>& cell);
/// Whether a cell in 3-D is listed as tilted(), or S waves along z have two speeds there.
bool anisotropic_across_rows(const Domain<3>& domain, const Index<3>& cell);

/// Depth in cells of a corner of the computed grid of a fitted model. Beyond the sides of the model rows bend
/// until they are level, so that absorbing zones there act on a regular grid; above and below it they keep
/// their shape.
template <int D>
double corner_depth(const Domain<D>& domain, Index<D> corner);

/// `medium` is that of the model or of the rows that this process holds; `edges` are those of the whole
/// model; `order` is that of the reconstruction, or a higher one.
template <int D>
Domain<D> make_domain(const Medium<D>& medium, const EdgeLaws<D>& edges, int zone_cells,
                      const Subdomain& part = {}, int order = 7);

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
