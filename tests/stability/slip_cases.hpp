// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab.hpp"

namespace slipwave {

/// Which cells (i, k) of a square of n slip, and in what medium that is hard.
struct Cluster {
  const char* name;
  std::function<bool(int i, int k, int n)> holds;
  const char* medium;
};
const std::vector<Cluster>& clusters();
const Cluster& cluster_named(const std::string& name);

/// What stands in a fracture set: angles of the planes and what goes beyond the simplest.
struct Planes {
  const char* name;
  std::vector<double> angles_deg;
  bool equal;           // strengths of all systems
  bool open;            // planes open under tension
  bool weaken = false;  // friction falls to a tenth by slip
};
const std::vector<Planes>& kinds_of_planes();

/// Friction and viscosity, s.
struct Law {
  double friction, viscosity_s;
};
/// None, little and enormous of both: from planes without strength through dry friction to what never slips.
const std::vector<Law>& laws();

const std::vector<SlipCorrection>& corrections();
/// "OneThatOpensFirst"
std::string name_of_case(const Planes& planes, SlipCorrection correction);

/// n = (sin angle, -cos angle).
SlipSystem<2> system_of(double angle_deg, const Law& law, double strength_pa = 0, bool opens = false);
/// Where the strengths differ, the second system has four times the friction and a cohesion.
FractureSet<2> set_of(const Planes& planes, const Law& law, double strength_pa = 0);
/// Lets friction fall by slip, to that share of it.
void weaken(SlipSystem<2>& system, double share, double distance_m);

struct PlaneStress {
  double xx, zz, xz;
};
/// Pressure, and of the shear along the first system that all systems of all sets just bear a share: with all
/// of it one system is at the verge of slip.
PlaneStress at_the_verge(const std::vector<FractureSet<2>>& sets, double pressure_pa, double share = 1);
/// The same in every cell, as Model::prestress_pa has it.
std::vector<Field<2>> uniform_stress(const Grid<2>& grid, const PlaneStress& stress);

/// A scene of the laboratory whose solid cells in `cluster` slip.
template <class Real>
typename Lab<Real>::Setup fractured(const Medium<2>& medium, const Cluster& cluster,
                                    const FractureSet<2>& set);

/// Numbers the cases of a test and says what else they have: so that few runs meet all orders of space and
/// time, edges and Courant numbers with everything.
class Rotation {
 public:
  void next() { ++number_; }
  int order() const { return orders[number_ % order_count]; }
  /// Numbers that share no factor meet in all pairs.
  int time_order() const { return number_ % 5 == 1 ? 4 : 2; }
  double cfl() const { return time_order() == 4 ? 1.9 : number_ % 3 == 0 ? 0.9 : 1; }
  EdgeLaw edge() const {
    return std::vector{EdgeLaw::free,      EdgeLaw::rigid, EdgeLaw::mirror, EdgeLaw::free,
                       EdgeLaw::absorbing, EdgeLaw::rigid, EdgeLaw::mirror}[number_ % 7];
  }
  bool in_double() const { return number_ % 11 % 2 == 0; }
  /// Puts all of that in, but for the precision.
  template <class Setup>
  void into(Setup& setup) const {
    setup.order = order();
    setup.time_order = time_order();
    setup.cfl = cfl();
    setup.edges = all_edges(edge());
  }
  std::string shown() const;

 private:
  unsigned number_ = 0;
};

}  // namespace slipwave
