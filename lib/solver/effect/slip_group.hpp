// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "fracture/friction_laws.hpp"
#include "fracture/joint_slip.hpp"
#include "rock/anisotropy.hpp"
#include "rock/elasticity.hpp"
#include "scene/scene.hpp"
#include "solver/effect/fracture_cells.hpp"
#include "solver/effect/held_slip.hpp"
#include "solver/kernels/slip_kernels.hpp"

namespace slipwave::solver {

/// The acts of slip on cells: planes open or close, slip to the end of a step, take the explicit half of the
/// next step.
enum class SlipAct { open, slip, begin };

/// Cells of one fracture set (0-based) of the model, and whether its planes lie askew in the rock of any of
/// them, in any process: then all of them slip one by one.
struct CellsOfSet {
  std::size_t set;
  CellKind kind;
  bool askew;
};

/// The cells of one fracture set, whole ones or those that its edge cuts: their places, constants and state.
/// Cells of a row form segments of whole vectors; cells of other sets or none among them have c = 0 and do
/// not slip.
template <int D, class Real>
class SlipGroup {
 public:
  /// Stress is `unit` times Pa, gaps `unit` times strain.
  SlipGroup(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene, const CellsOfSet& of,
            double dt_s, double unit);

  using Segment = typename FractureCells<D>::Segment;
  /// Returns the segments of that row, ascending.
  std::span<const Segment> segments(std::int64_t line) const { return places_.segments(line); }
  /// Acts on n cells from number `place` on; `stress` is the first component of the first of them, the others
  /// `pitch` apart. At the end of a step planes open before they slip.
  void act(SlipAct act, Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n);

  /// Sets the state of the cells to that after a step at rest.
  void rest();

  const FractureSet<D>& set() const { return *set_; }
  /// Cells that belong to the set, and all that are stored.
  std::int64_t cells() const { return places_.cells(); }
  std::int64_t stored_cells() const { return std::int64_t(count_); }
  bool has_prestress() const { return !prestress_.empty(); }
  SymmetricTensor<D, Real> prestress(std::size_t place) const;
  bool opens() const;
  /// Strain by which the widest plane of a cell is open.
  Real gap(std::size_t place) const;
  /// Whether a cell belongs to the set.
  bool holds(std::size_t place) const;
  /// mu of a cell, Pa, 0 outside the set; where springs give way, too, what is left of it above them.
  Real shear_modulus(std::size_t place) const { return mu_.empty() ? Real(0) : mu_[place]; }
  /// lambda of a cell, Pa, where planes open; else 0.
  Real lambda(std::size_t place) const { return lambda_.empty() ? Real(0) : lambda_[place]; }
  /// Stiffness of a cell in whose anisotropic rock planes of this set may lie askew; null where none do. In
  /// 3-D only where a diary is written.
  const Elasticity<D>* stiffness(std::size_t place) const {
    return stiffness_.empty() ? nullptr : &stiffness_[place];
  }
  std::int64_t memory_bytes() const;
  /// All that changes from step to step.
  std::vector<std::vector<Real>*> memory();
  /// Gives access to that of the cells of a row.
  void exchange(std::int64_t line, const std::function<void(Real* values, std::int64_t count)>& to);

 private:
  void fill(const Domain<D>& domain, const Scene<D>& scene, const Layout<D>& layout, bool askew, double dt_s);
  void choose_kernels(SlipCorrection correction);
  /// What an edge that cuts a cell makes of its slip: mu of the part in place of that of the rock.
  double put_edge(const Model<D>& model, std::size_t place, std::size_t cell, double lambda, double mu);
  /// What of a held slip acts on the planes, for all systems (S39).
  double held_share_of_all(const Point<D>& edge, double lambda, double mu) const;
  void act_on(SlipAct act, Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n);
  /// Stores the response of the planes of all systems at a place, (S34), (S34a). Returns the modulus of each
  /// that its relaxation counts.
  std::vector<double> put_response(std::size_t place, const Elasticity<D>& stiffness);
  void open(Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n);
  /// The law for all systems: one that covers those of each.
  FrictionLaw law() const;
  template <class Law>
  void add_joint(SlipCorrection correction);
  void slip_jointly(std::monostate, Real*, std::int64_t, std::size_t, std::int64_t, bool) {}
  template <class Law>
  void slip_jointly(const JointSlip<D, Real, Law>& joint, Real* stress, std::int64_t pitch, std::size_t place,
                    std::int64_t n, bool begins);
  SlipRows<Real> rows(Real* stress, std::int64_t pitch, std::size_t place);
  /// These two give what is retained of component c of the stress of a cell, for systems without a kernel and
  /// the centred rule: what is taken off ahead, and the explicit half of the law.
  Real& ahead(std::size_t c, std::size_t place) { return retained_[c * count_ + place]; }
  Real& explicit_half(std::size_t c, std::size_t place) {
    return retained_[(SymmetricTensor<D, Real>::components + c) * count_ + place];
  }

  const FractureSet<D>* set_;
  double unit_;
  FractureCells<D> places_;
  std::size_t count_;          // cells that are stored
  SlipPlanes<Real> planes_{};  // of all systems, for s_n and opening
  SlipKernels<Real> kernels_{};
  GapKernel<Real> open_ = nullptr;
  // For systems without a kernel.
  template <class... Laws>
  using JointOf = std::variant<std::monostate, JointSlip<D, Real, Laws>...>;
  OfFrictionLaws<JointOf> joint_;
  bool centred_ = false;
  std::vector<std::vector<Real>> relaxation_;  // [system][cell], as stress
  std::vector<std::vector<Real>> gaps_;        // [system][cell], of systems that open; else empty
  std::vector<Real> shut_;                     // the gap of the others, where kernels read gaps
  std::vector<Real> lambda_, modulus_, mu_;    // Pa, where planes open or a diary is written
  std::vector<Real> prestress_;                // row after row; empty: none
  std::vector<Real> resolved_;                 // prestress resolved on planes, as in SlipRows
  std::vector<Real> retained_;                 // rows that kernels retain from step to step
  std::vector<std::vector<Real>> slips_m_;     // [system][cell], where the law has a state; else empty
  std::vector<Real> slip_per_pa_;              // h/mu, where the law has a state
  // Where planes lie askew in anisotropic rock: [cell][system], and by cell.
  std::vector<PlaneResponse<D, Real>> responses_;
  std::vector<Elasticity<D>> stiffness_;
  std::optional<HeldSlip<D, Real>> cut_;  // of cells that the edge cuts
};

}  // namespace slipwave::solver
