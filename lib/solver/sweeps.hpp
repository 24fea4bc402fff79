#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "scene/edges.hpp"
#include "solver/domain.hpp"
#include "solver/free_edge.hpp"
#include "solver/matched_layer.hpp"
#include "solver/span_ends.hpp"
#include "solver/state.hpp"

namespace slipwave::solver {

/// Grid-characteristic sweeps in flux form along each axis (theory.md (E3)-(E10)). A sweep moves the fields
/// by `scale` of the time step, back in time where it is negative, under the part of the equations with
/// derivatives along its axis. Lines of a
/// sweep along x, and columns of a sweep across, do not depend on each other: threads share them out and the
/// result does not depend on their number.
template <int D, class Real>
class Sweeps {
 public:
  /// Shear is left out of every loop when the domain holds no solid cell. Keeps a reference to the state
  /// only.
  Sweeps(State<D, Real>& state, const Domain<D>& domain, int order);
  /// From now on sweeps are stretched in this layer (null: nowhere), which must outlive them.
  void use(MatchedLayer<D, Real>* layer) { layer_ = layer; }

  /// Along x, on every line for which part(line) gives a scale that is not 0.
  void along_x(const std::function<Real(std::int64_t line)>& part);
  /// The fields of a line (all rows, as in the state, from its cell 0 in row 0) `scale` of a step further
  /// along x than the state has them, written to `to`; the state stays as it is. Lines are shared out to
  /// threads.
  void ahead_along_x(std::span<const std::int64_t> lines, Real scale,
                     const std::function<Real*(std::int64_t line)>& to);
  /// Along y or z.
  void across(int axis, Real scale);
  /// Along any axis, on every line.
  void along(int axis, Real scale);
  /// Cells beside contacts, voids and span ends, which stencils do not run across: all axes and waves.
  std::int64_t span_end_cells() const;

 private:
  /// A wave family along one axis on one row: its fields, material and span ends.
  struct Pair {
    Wave wave;
    int v, s;  // rows of the line
    const SpanEnds* ends;
  };
  void sweep_line(std::int64_t line, Real* fields, Real scale, Real* scratch, bool remember);
  void sweep_columns(int axis, const Index<D>& first, std::int64_t width, Real scale, Real* scratch);
  void measure_free_edges(int axis);
  void fill_ghost_cells(std::int64_t line, Real* v, Real* s, int pair, Wave wave, Real scale) const;
  void fill_ghost_lines(int axis, const Index<D>& first, std::int64_t width, int number, const Pair& pair,
                        Real scale);
  void update(const Index<D>& at, Real* fields, int axis, const Pair& pair, std::int64_t width, Real scale,
              const Real* v_lo, const Real* v_hi, const Real* s_lo, const Real* s_hi, Real* spare,
              bool remember);
  std::array<Pair, D> pairs(int axis) const;
  int pair_count() const { return shear_ ? D : 1; }
  std::int64_t stripe_width() const;

  State<D, Real>& state_;
  const Kernels<Real>& kernels_;
  MatchedLayer<D, Real>* layer_ = nullptr;
  EdgeLaws<D> edges_;
  int order_, reach_;
  bool shear_;
  std::array<std::array<SpanEnds, 2>, D> ends_;                 // [axis][wave]
  std::array<std::array<FreeEdge<D, Real>, 2>, D> free_edges_;  // [axis][side]
  std::vector<Buffer<Real>> scratch_;                           // one a thread
};

/// What enters the grid through its low (up) or high (down) edge, given what leaves it there (E11).
/// The impedance of the ghost beyond the edge is part of the law (fill_material).
template <class Real>
void edge_state(EdgeLaw law, Wave wave, std::int64_t n, const Real* leaving, Real* entering);

}  // namespace slipwave::solver
