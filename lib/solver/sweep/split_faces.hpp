// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/archive.hpp"
#include "solver/sweep/domain.hpp"
#include "solver/sweep/face_treatment.hpp"
#include "solver/sweep/interface_stencils.hpp"
#include "solver/sweep/shot_report.hpp"
#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// Faces between cells that single fractures split (theory/fractures.md): each side has its own velocity, and
/// the traction is that of a spring between them, none where it is open, at most its strength where it has
/// friction (S40). Sweeps take such faces for welded ones; add() then gives both sides what is left of that
/// (S35). The stencils beside them read images() (S36). Retains the tractions, slip and opening, and how far
/// a face whose strength depends on it has slid.
template <int D, class Real>
class SplitFaces : public FaceTreatment<D, Real> {
 public:
  /// Keeps a reference to the state; `unit` of its fields.
  SplitFaces(const State<D, Real>& state, const Domain<D>& domain, double dt_s, double unit);

  /// Whether any is across this axis.
  bool any(int axis) const;
  bool beside(int axis, std::int64_t line) const override;
  /// Whether no face before these cells of a line retains a traction.
  bool at_rest(std::int64_t line, const IndexRange& columns) const;
  void add(int axis, std::int64_t line, const IndexRange& columns, Real scale, InterfaceStates<Real> lo,
           InterfaceStates<Real> hi, const SweptRows<Real>& rows, bool remember) override;

  /// Returns the images of a pair, by slot: the slot is twice the place of the face in the domain's list,
  /// plus 1 for the side behind it.
  const SplitImage<Real>* images(int pair) const { return images_[std::size_t(pair)].data(); }
  /// Computes them for a sweep along the last axis, of the faces before row `row` in these columns, from
  /// velocities as they are before the sweep up to free_surface_reach cells beside them.
  void update(std::int64_t row, const IndexRange& columns);
  void update_all();
  /// Computes the images for a sweep along x of a line; its velocities and those of lines beside it are as
  /// retain() found them, since sweeps change line after line.
  void update_line(std::int64_t line, const IndexRange& columns);
  void retain(std::int64_t line, const IndexRange& columns);

  /// Writes or reads all that it retains from one step to the next.
  void serialize(Archive& archive);
  /// Gives access to what it retains of these rows of the last axis (in 3-D planes), for neighbouring
  /// subdomains.
  void exchange(const IndexRange& rows, const std::function<void(Real* values, std::int64_t count)>& to);
  std::int64_t memory_bytes() const override;
  /// How many faces there are, and how many that slide or open.
  std::vector<EffectShare> shares() const;
  /// Adds the energy of the springs to what is left in the model, and the work of slip.
  void report(ShotReport& report) const;
  /// Returns the energy stored in the springs of faces in the rows that this process owns, in J (in 2-D J/m).
  double stored_energy() const;

 private:
  struct Face {
    int axis;
    std::int64_t line, x;               // of the cell behind it
    bool inside;                        // not at the first row of a part of the model
    std::array<std::int64_t, 2> cells;  // before and behind it, in the fields
    std::array<std::int32_t, 2> along;  // faces beside it at offsets_along; -1: one is missing
    std::array<Real, D> relaxation;     // of a pair in a step: dt/(C Z)
    std::array<double, D> compliance;   // C, m/Pa
    std::array<double, D> impedance;    // Z of both sides together
    std::array<Real, D> half_cell;      // time that a wave takes through it, in steps
    FaceLaw law;
  };
  /// The state of a face with friction, from step to step.
  struct Slip {
    Real opening = 0, slip = 0;       // m times the unit of the fields
    std::array<Real, 2> stiffness{};  // SplitImage::stiffness, as the plane sticks or slides
    Real slid = 0;                    // 1: it has
  };
  static constexpr int reals_of_slip = 5;
  /// What slip has done since the beginning, in J/m2.
  struct Work {
    double heat = 0, out_of_waves = 0;
  };
  /// What a sweep does to the tractions of a face with friction.
  struct Swept {
    std::array<FaceMotion, 2> motion;
    std::array<double, 2> moved_m;
    std::array<Real, 2> stiffness;
    std::array<Real, D> change;  // of the mean traction
  };
  static std::array<Real, D> tractions_at(InterfaceStates<Real> face);
  std::array<Real, D> changes_of(std::size_t n, const std::array<Real, D>& welded, Real size) const;
  Swept solve(std::size_t n, const std::array<Real, D>& welded, Real size) const;
  void advance(std::size_t n, const Swept& swept);
  bool owns(std::size_t n) const;
  void place(Face& face, const Domain<D>& domain, const SplitFace<D>& split, double dt_s);
  void find_along(Face& face) const;
  bool crossed(const Face& face) const;
  void put_images(std::size_t n);
  void add_to_cell(std::size_t n, std::int64_t line, std::int64_t x, Real scale, InterfaceStates<Real> face,
                   std::int64_t i, Real side, const SweptRows<Real>& rows) const;
  /// Places of the first face of an axis whose cell behind is in these columns of a line, and of the one
  /// after the last.
  std::array<std::size_t, 2> find(int axis, std::int64_t line, const IndexRange& columns) const;
  IndexRange whole_line() const { return {0, state_.layout.shape()[0]}; }

  const State<D, Real>& state_;
  double spacing_m_, unit_, dt_s_;
  IndexRange own_;
  std::vector<Face> faces_;      // by axis, line, x
  std::vector<Real> tractions_;  // D of each
  std::vector<Slip> slips_;      // of each, or of none where no face has friction
  std::vector<Work> work_;
  std::vector<Real> paths_m_;   // of each, or of none where no law has a state
  std::vector<Real> retained_;  // velocities before and behind each across x
  std::array<std::vector<SplitImage<Real>>, D> images_;
};

}  // namespace slipwave::solver
