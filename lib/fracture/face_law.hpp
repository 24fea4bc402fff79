// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "fracture/friction_policy.hpp"

/// What a plane with friction on a face between cells does to the waves of a sweep (docs/theory.md, section
/// 2.8, (S40) to (S42)): along the plane a slider behind a spring, across it two sides that touch or part.
///
/// Within a sweep the waves that arrive at a face are constant. Everything is told in their units: tractions
/// in Pa; time in sweeps; compliances, stiffnesses and the drag of viscosity as they stand beside the
/// impedance Z of both sides together, 1/Z = 1/Z_l + 1/Z_r; slip and opening as the traction Z u/dt that
/// holds a jump u/dt of velocity. Tractions are those of waves and prestress together.
namespace slipwave {

/// A plane on a face, besides the springs it gives way as. Normal before tangential.
struct FaceLaw {
  FrictionLaw friction_law = FrictionLaw::none;
  FrictionConstants<double> friction;
  bool opens = false;
  /// By which share of the strength a slip rate of 1 m/s raises the traction, s/m.
  double viscosity_s_m = 0;
  std::array<double, 2> prestress_pa{};  // tension positive
  /// Beside a tip: by how much rock beyond it holds back what the plane parts and slips (S37), Pa/m.
  std::array<double, 2> held_pa_m{};

  bool slides() const { return friction_law != FrictionLaw::none; }
  bool any() const { return slides() || opens; }
  /// Whether its strength depends on the slip so far.
  bool has_state() const;
  /// Strength of the shut plane under that normal traction, before it has slipped.
  double strength_pa(double normal_pa) const;
};

/// What one traction of a face finds in a sweep.
struct FaceLoad {
  double welded = 0;  // that of a face which nothing parts
  double before = 0;  // at the beginning
  /// 1/(C Z) times the time of the sweep: infinite without a spring.
  double relaxation = 0;
  double held = 0;  // FaceLaw::held_pa_m beside Z
};

/// What is left of it.
struct FaceMotion {
  double mean = 0, end = 0;  // traction
  double moved = 0;          // slip or opening of the sweep
  bool loose = false;        // slides or stands open at the end
};

/// Returns the motion of a plane under a traction across it, that has opened so far: it carries no tension.
FaceMotion part_face(const FaceLoad& load, double opening);

/// Returns the motion of a plane along which a traction of more than the strength slides; `drag` is what the
/// viscosity makes of the strength beside Z.
FaceMotion slide_face(const FaceLoad& load, double slip, double strength, double drag);

/// How far a plane has slid before a sweep, and Z.
struct FaceSlip {
  double slip = 0;    // to either side, as a traction
  double path_m = 0;  // all of it
  double m_per_pa = 0, impedance = 0;
};

/// Motion along a plane under that of the traction across it, at the strength that its law gives it at the
/// mean normal traction and the mean slip of the sweep (S40).
FaceMotion slide_face(const FaceLaw& law, const FaceLoad& load, const FaceMotion& across,
                      const FaceSlip& so_far);

/// Returns the motion of a spring alone (S35).
FaceMotion give_face(const FaceLoad& load);

}  // namespace slipwave
