// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <numbers>

#include "lab.hpp"
#include "scene/scene.hpp"
#include "usual_rock.hpp"

// Plane waves straight through a layer of slipping cells in uniform rock. The strength S does not change with
// time, so that the slip rate is g = (|tau|/S - 1)_+ tau/(eta |tau|) (theory.md (S3)). A layer is told by its
// thickness L and the ratio r of the time that S waves take through it to twice the relaxation time
// t_r = eta S/mu: 0.1 is nearly stuck, 100 nearly dry.
namespace slipwave::solver {

inline const double z_s = rock.rho * rock.vs, mu = rock.mu(), modulus_p = rock.rho * rock.vp * rock.vp;
inline constexpr double peak_pa = 1e6, strength_pa = 0.3e6, peak_hz = 30;

inline double relaxation_s(double thickness_m, double r) { return thickness_m / rock.vs / (2 * r); }
inline double viscosity_s(double thickness_m, double r) {
  return relaxation_s(thickness_m, r) * mu / strength_pa;
}

/// Shear traction of the incident wave where it passes its source, |t| < 1.5 periods: a Ricker wavelet.
inline double incident(double t) {
  const double a = std::numbers::pi * peak_hz * t;
  return peak_pa * (1 - 2 * a * a) * std::exp(-a * a);
}

struct Waves {
  std::vector<double> through, back;  // Pa, of the stress that the waves carry
};

/// Outgoing S waves at the faces of a layer (S8) whose slip all happens in its middle: 2 tau_i = 2 tau + Z L
/// g, so that |tau| = (|tau_i| + r S)/(1 + r) where |tau_i| > S. For layers much thinner than a wave. Times
/// are counted as the incident wave at the upper face counts them.
inline Waves of_interface(const std::vector<double>& times_s, double thickness_m, double r) {
  Waves waves;
  for (const double t : times_s) {
    const double tau_i = incident(t - thickness_m / rock.vs), size = std::abs(tau_i);
    const double tau = size <= strength_pa ? tau_i : std::copysign((size + r * strength_pa) / (1 + r), tau_i);
    waves.through.push_back(tau);
    waves.back.push_back(tau - tau_i);
  }
  return waves;
}

/// One-dimensional reference for a layer: invariants are carried from node to node in one step, exactly, and
/// between two steps the traction on the planes relaxes by the closed form of (S3) without waves. Strang's
/// splitting, nodes in the middles of their parts of the layer: of second order.
class Layer {
 public:
  /// tau is `share` of the stress of a wave, slip that takes 1 off tau takes `return_share` off that stress.
  struct Kind {
    double share, return_share;
  };
  Layer(Kind kind, double transit_s, double relaxation_s, int nodes)
      : kind_(kind),
        dt_s_(transit_s / nodes),
        decay_(std::exp(-dt_s_ / 2 / relaxation_s)),
        nodes_(std::size_t(nodes)) {}

  /// Outgoing waves at the faces at ascending times, for the incident stress incident(t)/share at the upper
  /// face.
  Waves at(const std::vector<double>& times_s) {
    Waves waves;
    double t = -0.1, through = 0, back = 0;
    for (const double wanted : times_s) {
      for (; t - dt_s_ / 2 < wanted; t += dt_s_) {
        before_ = {through, back};
        step(incident(t + dt_s_ / 2) / kind_.share, through, back);
      }
      // What left last did so at t - dt/2.
      const double rest = (t - dt_s_ / 2 - wanted) / dt_s_;
      waves.through.push_back(through + rest * (before_[0] - through));
      waves.back.push_back(back + rest * (before_[1] - back));
    }
    return waves;
  }

 private:
  struct Node {
    double down = 0, up = 0;  // stress of the waves either way
    double own = 0;           // what of tau no wave carries
  };
  void relax() {
    for (auto& node : nodes_) {
      const double tau = kind_.share * (node.down + node.up) + node.own;
      const double excess = std::max(std::abs(tau) - strength_pa, 0.);
      const double change = -std::copysign(excess * (1 - decay_), tau);
      // Velocity stays, so both waves change alike.
      node.down += kind_.return_share * change / 2;
      node.up += kind_.return_share * change / 2;
      node.own += (1 - kind_.share * kind_.return_share) * change;
    }
  }
  void step(double enters, double& through, double& back) {
    relax();
    through = nodes_.back().down;
    back = nodes_.front().up;
    for (std::size_t n = nodes_.size(); --n > 0;) nodes_[n].down = nodes_[n - 1].down;
    nodes_.front().down = enters;
    for (std::size_t n = 0; n + 1 < nodes_.size(); ++n) nodes_[n].up = nodes_[n + 1].up;
    nodes_.back().up = 0;
    relax();
  }

  Kind kind_;
  double dt_s_, decay_;
  std::vector<Node> nodes_;
  std::array<double, 2> before_{};
};

/// Horizontal planes in an S wave.
inline constexpr Layer::Kind shear{1, 1};
/// Planes at 45 degrees in a P wave: tau = (sxx - szz)/2 = -mu/(lambda + 2 mu) szz of the wave, and what slip
/// takes off tau it adds to szz.
inline const Layer::Kind pressure{-mu / modulus_p, -1};

struct Setup {
  double thickness_m, r;
  SlipCorrection correction;
  int order = 5;
};

/// Relative L2 errors in percent.
struct Errors {
  double through, back;
};
inline Errors errors(const Waves& found, const Waves& exact) {
  return {100 * relative_error(found.through, exact.through), 100 * relative_error(found.back, exact.back)};
}

/// Errors at h = 5, 2.5 and 1.25 m: a tenth above those measured.
struct Bounds {
  SlipCorrection correction;
  double r;
  Errors at[3];
  double order;  // in which the wave back converges, at least
};

}  // namespace slipwave::solver
