// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include "grid/field.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/uniform_interior.hpp"

namespace slipwave::solver {

/// Requests large pages for memory that has not been touched yet; affects speed only (3-D by 3 %: each sweep
/// along z reads from as many pages as planes).
void prefer_large_pages(void* first, std::size_t bytes);

/// Memory aligned for the widest vectors.
template <class Real>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::int64_t count) : count_(count) {
    const auto bytes = std::size_t(count) * sizeof(Real);
    const bool large = bytes >= 2 * std::size_t(page);
    const auto alignment = large ? page : line;
    values_ = {static_cast<Real*>(::operator new(bytes, alignment)), Free{alignment}};
    if (large) prefer_large_pages(values_.get(), bytes);
  }
  Real* data() { return values_.get(); }
  const Real* data() const { return values_.get(); }
  std::int64_t size() const { return count_; }

 private:
  static constexpr std::align_val_t line{64}, page{std::size_t(1) << 21};
  struct Free {
    std::align_val_t alignment = line;
    void operator()(Real* values) const { ::operator delete(values, alignment); }
  };
  std::unique_ptr<Real[], Free> values_;
  std::int64_t count_ = 0;
};

/// Makes memory that has not been written zero: it is taken where it is written first, near the thread that
/// does.
template <class Real>
void clear_untouched(Buffer<Real>& buffer);

/// A layout says where values are stored: lines along x, each holding one row of every field,
/// [line][field][x]. Rows are padded to whole vectors; `max_reach` ghost lines stand round the grid on the
/// other axes and at least 16 ghost values at both ends of a row.
template <int D>
class Layout {
 public:
  static constexpr std::int64_t lead = 16;
  static constexpr std::int64_t block = 16;  // values of the widest vector
  static constexpr std::int64_t ghost_lines = max_reach + 1;

  Layout() = default;
  Layout(const Index<D>& shape, int rows_a_line);

  const Index<D>& shape() const { return shape_; }
  /// Rows of a line.
  int rows() const { return rows_; }
  /// Cells of a row rounded up to whole vectors: what kernels are given.
  std::int64_t padded_nx() const { return padded_nx_; }
  std::int64_t row_pitch() const { return row_pitch_; }
  /// From a cell to its neighbour along `axis`, in values.
  std::int64_t stride(int axis) const { return strides_[axis]; }
  /// Values in all, ghosts included.
  std::int64_t total() const { return total_; }
  std::int64_t lines() const;
  /// Returns where row 0 of the line at these indices (x ignored, ghosts allowed) starts: its cell x = 0.
  std::int64_t line(const Index<D>& at) const {
    std::int64_t offset = lead;
    for (int axis = 1; axis < D; ++axis) offset += (at[axis] + ghost_lines) * strides_[axis];
    return offset;
  }
  std::int64_t cell(const Index<D>& at) const { return line(at) + at[0]; }
  /// x of a value counted from cell 0 of row 0 of its line.
  std::int64_t column(std::int64_t place) const { return place % row_pitch_; }
  /// Indices of line number n (x fastest of the others), its x = 0.
  Index<D> line_index(std::int64_t n) const;
  std::int64_t line_number(const Index<D>& at) const {
    return D == 2 ? at[1] : at[D - 1] * shape_[1] + at[1];
  }

 private:
  Index<D> shape_{};
  Index<D> strides_{};
  std::int64_t padded_nx_ = 0, row_pitch_ = 0, total_ = 0;
  int rows_ = 0;
};

/// What the cells of a domain are: all fluid, or isotropic, or some are anisotropic; in 3-D alike in all
/// horizontal directions, or orthorhombic.
enum class MaterialKind { fluid, isotropic, anisotropic, orthorhombic };

/// Rows of a line of the wave field: velocities, normal stresses, shear stresses (xz | xy, xz, yz). Where all
/// is fluid a line ends with the first normal stress: there all of them are the same, the pressure with its
/// sign changed, and no shear stress is stored.
template <int D>
struct FieldRows {
  static constexpr int count = D + D * (D + 1) / 2, count_in_fluid = D + 1;
  static constexpr int of(MaterialKind material) {
    return material == MaterialKind::fluid ? count_in_fluid : count;
  }
  static constexpr int velocity(int axis) { return axis; }
  static constexpr int normal_stress(int axis) { return D + axis; }
  static constexpr int shear_stress(int axis_a, int axis_b) {
    return D == 2 ? 4 : 5 + axis_a + axis_b;  // xy 6, xz 7, yz 8
  }
  static constexpr int stress(int axis_a, int axis_b) {
    return axis_a == axis_b ? normal_stress(axis_a) : shear_stress(axis_a, axis_b);
  }
  /// Whether a row is a component of the traction on faces across an axis.
  static constexpr bool is_traction(int axis, int row) {
    for (int along = 0; along < D; ++along)
      if (row == stress(axis, along)) return true;
    return false;
  }
  static bool is_stored(const Layout<D>& layout, int row) { return row < 2 * D || row < layout.rows(); }
  /// The row of a line that holds one that is stored.
  static int stored(const Layout<D>& layout, int row) { return std::min(row, layout.rows() - 1); }
  /// How many normal stresses are stored.
  static int normal_stresses(const Layout<D>& layout) { return layout.rows() == count ? D : 1; }
};

/// Rows of a line of the material: b = dt/(rho h) and the impedances rho c of P and S, 0 in cells that do not
/// carry the wave. Z b is the Courant number c dt/h and Z Z b the modulus times dt/h. Anisotropic media have
/// two more: zp is that of sweeps along z, the next that of other sweeps, and the last is wave_coupling(). In
/// 3-D zs and the coupling are those of the plane of x and z, and there are two more of that of x and y;
/// where rock is orthorhombic, three of y and of the plane of y and z, which otherwise are as of x.
enum MaterialRow : int {
  row_b,
  row_zp,
  row_zs,
  material_rows,
  row_zp_across = material_rows,
  row_coupling,
  row_zs_level,
  row_coupling_level,
  row_zp_y,
  row_zs_y,
  row_coupling_y,
  most_material_rows
};
/// How many there are; where all is fluid no zs.
template <int D>
constexpr int material_rows_of(MaterialKind material) {
  switch (material) {
    case MaterialKind::fluid:
      return row_zs;
    case MaterialKind::isotropic:
      return material_rows;
    case MaterialKind::anisotropic:
      return D == 2 ? row_zs_level : row_zp_y;
    case MaterialKind::orthorhombic:
      break;
  }
  return most_material_rows;
}
/// The row of the impedance of P in sweeps along an axis.
template <int D>
constexpr int p_row(MaterialKind material, int axis) {
  if (material == MaterialKind::orthorhombic && axis == 1) return row_zp_y;
  return material >= MaterialKind::anisotropic && axis < D - 1 ? row_zp_across : row_zp;
}
/// Returns the one of three material rows that belongs to the plane of two axes: s_row() that of the
/// impedance of S, coupling_row() that of the coupling.
template <int D>
constexpr int plane_row(MaterialKind material, int one, int other, int upright, int level, int of_y) {
  if (D == 2 || material < MaterialKind::anisotropic || one + other == 2) return upright;
  if (one + other == 1) return level;
  return material == MaterialKind::orthorhombic ? of_y : upright;
}
template <int D>
constexpr int s_row(MaterialKind material, int one, int other) {
  return plane_row<D>(material, one, other, row_zs, row_zs_level, row_zs_y);
}
template <int D>
constexpr int coupling_row(MaterialKind material, int one, int other) {
  return plane_row<D>(material, one, other, row_coupling, row_coupling_level, row_coupling_y);
}
/// The axis of motion of an S pair of sweeps along an axis: in 3-D there are two.
template <int D>
constexpr int axis_of_pair(int axis, int pair) {
  return pair - 1 < axis ? pair - 1 : pair;
}
/// The pair of the velocity along an axis in sweeps along another, or the same (0).
template <int D>
constexpr int pair_of(int axis, int velocity) {
  return velocity == axis ? 0 : velocity < axis ? velocity + 1 : velocity;
}

/// A uniform run: cells first <= x < last of a row that have one material.
template <class Real>
struct UniformRun {
  std::int64_t first, last;
  Real b, zp, zs;
  Real zp_across = zp, coupling = 0;  // of anisotropic media
  // In 3-D.
  Real zs_level = zs, coupling_level = coupling, zp_y = zp_across, zs_y = zs, coupling_y = coupling;
  /// For sweeps along an axis.
  template <int D>
  MaterialRows<Real> rows(int axis) const {
    if constexpr (D == 2) return {&b, axis == 0 ? &zp_across : &zp, &zs, &coupling};
    if (axis == 2) return {&b, &zp, &zs, &coupling, &zs_y, &coupling_y};
    if (axis == 1) return {&b, &zp_y, &zs_level, &coupling_level, &zs_y, &coupling_y};
    return {&b, &zp_across, &zs_level, &coupling_level, &zs, &coupling};
  }
  bool same(const UniformRun& other) const {
    return b == other.b && zp == other.zp && zs == other.zs && zp_across == other.zp_across &&
           coupling == other.coupling && zs_level == other.zs_level &&
           coupling_level == other.coupling_level && zp_y == other.zp_y && zs_y == other.zs_y &&
           coupling_y == other.coupling_y;
  }
};

/// The fields of a row of cells, in the state or in a copy: cell 0 of field row 0, and the pitch to the next
/// field row.
template <class Real>
struct RowFields {
  std::int64_t row;  // number of the line (Layout)
  Real* first;
  std::int64_t pitch;
  Real* field(int field_row) const { return first + field_row * pitch; }
  operator RowFields<const Real>() const requires(!std::is_const_v<Real>) { return {row, first, pitch}; }
};

/// Wave field and material of the computed grid: the model and the PML round it.
template <int D, class Real>
struct State {
  Layout<D> layout, material_layout;
  MaterialKind kind = MaterialKind::isotropic;
  bool anisotropic = false;  // its material has the rows of anisotropic media
  bool fluid = false;        // it has the rows of fluid alone
  Buffer<Real> fields, material;
  /// Uniform runs, row after row, and where each row begins (fill_material). Sweeps over such a run read
  /// nothing else of the material.
  std::vector<UniformRun<Real>> uniform_runs;
  std::vector<std::size_t> first_uniform_run;
  /// By axis, of these runs.
  std::array<UniformInterior, D> uniform_interior;

  std::int64_t memory_bytes() const {
    std::int64_t bytes = (fields.size() + material.size()) * std::int64_t(sizeof(Real)) +
                         bytes_of(uniform_runs) + bytes_of(first_uniform_run);
    for (const auto& of_axis : uniform_interior) bytes += of_axis.memory_bytes();
    return bytes;
  }
  /// Returns a field row that is stored, from its cell x = 0 on.
  Real* field_row(const Index<D>& at, int row) {
    return fields.data() + layout.line(at) + FieldRows<D>::stored(layout, row) * layout.row_pitch();
  }
  const Real* field_row(const Index<D>& at, int row) const {
    return fields.data() + layout.line(at) + FieldRows<D>::stored(layout, row) * layout.row_pitch();
  }
  RowFields<Real> row_fields(std::int64_t line) {
    return {line, field_row(layout.line_index(line), 0), layout.row_pitch()};
  }
  Real* material_row(const Index<D>& at, int row) {
    return material.data() + material_layout.line(at) + row * material_layout.row_pitch();
  }
  const Real* material_row(const Index<D>& at, int row) const {
    return material.data() + material_layout.line(at) + row * material_layout.row_pitch();
  }
  /// From a cell of a line on, for sweeps along an axis; the line before the first and the one after the last
  /// are there.
  MaterialRows<Real> material_from(const Index<D>& line, std::int64_t x, int axis = D - 1) const {
    const Real* b = material_row(line, row_b) + x;
    const auto pitch = material_layout.row_pitch();
    if constexpr (D == 3)
      if (anisotropic) {
        const int one = axis_of_pair<D>(axis, 1), two = axis_of_pair<D>(axis, 2);
        return {b,
                b + zp_row(axis) * pitch,
                b + s_row<D>(kind, axis, one) * pitch,
                b + coupling_row<D>(kind, axis, one) * pitch,
                b + s_row<D>(kind, axis, two) * pitch,
                b + coupling_row<D>(kind, axis, two) * pitch};
      }
    // The loops of fluid do not use zs.
    return {b, b + zp_row(axis) * pitch, b + (fluid ? row_zp : row_zs) * pitch,
            anisotropic ? b + row_coupling * pitch : nullptr};
  }
  /// The row of the impedance of P in sweeps along an axis.
  int zp_row(int axis) const { return p_row<D>(kind, axis); }
  /// Returns the uniform runs of a row, in the order of its cells.
  std::span<const UniformRun<Real>> uniform_runs_of(std::int64_t line) const {
    const auto first = first_uniform_run[std::size_t(line)];
    return {uniform_runs.data() + first, first_uniform_run[std::size_t(line) + 1] - first};
  }
  /// The run that holds all cells first <= x < last of a row, null where there is none.
  const UniformRun<Real>* uniform_run(std::int64_t line, std::int64_t first, std::int64_t last) const {
    for (const auto& of : uniform_runs_of(line)) {
      if (of.first > first) break;
      if (last <= of.last) return &of;
    }
    return nullptr;
  }
};

/// By axis, of a state whose uniform runs are known.
template <int D, class Real>
std::array<UniformInterior, std::size_t(D)> find_uniform_interior(const State<D, Real>& state);

/// State with zero fields and zero material, memory touched first by the threads that own its lines.
template <int D, class Real>
State<D, Real> make_state(const Index<D>& shape, MaterialKind material = MaterialKind::isotropic);

}  // namespace slipwave::solver
