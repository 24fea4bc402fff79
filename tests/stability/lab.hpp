// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "falling_energy.hpp"
#include "long_form.hpp"
#include "media.hpp"
#include "parallel/threads.hpp"
#include "rock/anisotropy.hpp"
#include "rock/tilted_mean.hpp"
#include "scene/scene.hpp"
#include "scene/splitting.hpp"
#include "solver/effect/effect.hpp"
#include "solver/effect/linear_slip.hpp"
#include "solver/effect/pml.hpp"
#include "solver/sweep/sweeps.hpp"
#include "sponge.hpp"

namespace slipwave {

/// Of a list of cases the short form takes each third from `first` on, the long one every other. Suites that
/// go through the same list begin at different ones: together they have all of it.
template <class Case>
std::vector<Case> share_of(const std::vector<Case>& cases, std::size_t first = 0) {
  std::vector<Case> taken;
  const std::size_t step = std::min<std::size_t>(long_form() ? 2 : 3, cases.size());
  for (std::size_t n = first % step; n < cases.size(); n += step) taken.push_back(cases[n]);
  return taken;
}

/// All pairs of two lists; in the short form each of the first with one of the second, which are taken in
/// turn and begin at another one for each `turn`.
template <class First, class Second>
std::vector<std::tuple<First, Second>> share_of_pairs(const std::vector<First>& firsts,
                                                      const std::vector<Second>& seconds,
                                                      std::size_t turn = 0) {
  std::vector<std::tuple<First, Second>> taken;
  for (std::size_t n = 0; n < firsts.size(); ++n)
    for (std::size_t m = 0; m < seconds.size(); ++m)
      if (long_form() || (n + m + turn) % seconds.size() == 0) taken.emplace_back(firsts[n], seconds[m]);
  return taken;
}

/// The number of a case in the third of a list that it stands in (share_of()): by it the short form chooses
/// which of several numbers the case is run with, so that all cases together have all of them.
template <class Case>
std::size_t turn_of(const Case& one, const std::vector<Case>& cases) {
  return std::size_t(std::find(cases.begin(), cases.end(), one) - cases.begin()) / 3;
}

/// All orders, or in the short form one low, the usual one and the highest.
std::vector<int> orders_tried();

/// The same law on all edges.
template <int D = 2>
EdgeLaws<D> all_edges(EdgeLaw law) {
  EdgeLaws<D> edges;
  for (int axis = 0; axis < D; ++axis) edges[axis] = {law, law};
  return edges;
}

/// Energy of a cell, J/m3: kinetic and elastic in plane strain; of fluid only the pressure counts.
double energy_density(double vp, double vs, double rho, double vx, double vz, double sxx, double szz,
                      double sxz);

/// vx, vz, sxx, szz and sxz of a cell.
using CellFields = std::array<double, 5>;

/// The same of an anisotropic cell.
double energy_density(const Elasticity<2>& stiffness, double rho, const CellFields& fields);

/// A wave field of random values in every cell, that evolves freely: sweeps, PML and slip as a shot has
/// them, without a source, or a sponge in place of the PML. Fields in the sponge start random too, in the PML
/// at rest.
template <class Real>
class Lab {
 public:
  struct Setup {
    Medium<2> medium;
    EdgeLaws<2> edges = all_edges(EdgeLaw::free);
    int order = 5;
    double cfl = 1;
    int time_order = 2;
    int zone_cells = 8;
    double layer_hz = 0;   // absorbing edges: 0 for the sponge, else the PML for such a source
    double amplitude = 1;  // velocities up to half of it, m/s; stresses such as belong to them
    std::vector<FractureSet<2>> fracture_sets;
    Field<2, std::uint8_t> fracture;
    Field<2> fracture_share;
    SlipCorrection correction = SlipCorrection::second;
    std::vector<Field<2>> prestress_pa;  // as in a Model
    /// In place of random values, before `amplitude` is put on them.
    std::function<CellFields(int i, int k)> fields;
    bool along_z_only = false;  // no sweeps along x
    bool monotone = false;      // sweeps keep to the criterion of monotonicity
    unsigned seed = 1;
  };
  explicit Lab(const Setup& setup);

  void step();
  /// Of the whole computed grid, zones and springs of planes included, J per metre; NaN where a field is.
  double energy() const;
  /// Of motion alone, J per metre.
  double kinetic_energy() const;
  /// The same as energy() with the prestress on top of that of the waves; faces that part have no springs.
  double energy_with_prestress() const;
  /// energy() less the work that the prestress has done by slip and opening: the potential energy of all
  /// stress under loads that stay, up to a constant.
  double potential() const { return energy() - work_of_prestress_; }
  double time_step_s() const { return dt_s_; }
  void expect_no_growth(int steps, double rounding, double floor = 0) {
    slipwave::expect_no_growth(*this, steps, rounding, 1, floor);
  }
  void expect_fall_in_the_long_run(int steps, double rounding = 0, double gain = 0) {
    slipwave::expect_fall_in_the_long_run(*this, steps, rounding, gain);
  }

 private:
  enum class Stress { of_waves, all };
  double sum(Stress which) const;
  void fill_energies();
  template <class Act>
  void slip(const Act& act);

  Scene<2> scene_;
  solver::Domain<2> domain_;
  double dt_s_;
  solver::State<2, Real> state_;
  std::unique_ptr<solver::Sweeps<2, Real>> sweeps_;
  std::unique_ptr<solver::Pml<2, Real>> layer_;
  std::unique_ptr<Sponge<2, Real>> sponge_;
  std::unique_ptr<solver::Effect<2, Real>> slip_;
  std::unique_ptr<solver::LinearSlip<2, Real>> springs_;
  /// What (vx2 + vz2), (sxx + szz)2, (sxx - szz)2 and sxz2 count for in the energy of isotropic cells.
  struct CellEnergy {
    double kinetic, even, odd, shear;
    bool isotropic;
  };
  std::vector<CellEnergy> energies_;  // of the computed grid: the energy is asked for after every step
  bool along_z_only_;
  double work_of_prestress_ = 0;
  std::vector<SweepFraction> splitting_;
  std::int64_t steps_ = 0;
};

/// What rounding may add to the energy over a run of ten thousand steps, as a share of it.
template <class Real>
constexpr double rounding() {
  return sizeof(Real) == 4 ? 1e-5 : 1e-11;
}

extern template class Lab<float>;
extern template class Lab<double>;

}  // namespace slipwave
