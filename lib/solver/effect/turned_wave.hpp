// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "scene/plane_wave.hpp"
#include "solver/effect/incident_wave.hpp"
#include "solver/effect/plane_form.hpp"
#include "solver/effect/stack_response.hpp"

namespace slipwave::solver {

/// A part of a plane wave's fields, and how much earlier it is read.
struct ShiftedFields {
  WaveFields<3> fields{};
  double earlier_s = 0;
};

/// How far sweeps along x and y have advanced fields further than those along z, s.
struct SweepsAhead {
  double x_s = 0, y_s = 0;
};

/// What becomes of the fields f(t - p.x) of a plane wave in one medium when sweeps along x, then along y, go
/// ahead: each moves the waves along its axis that the fields are made of, so the fields are those of some
/// parts at times of their own. `slowness` is along x and y, s/m.
std::vector<ShiftedFields> parts_ahead(const MotionAlongX& medium, const WaveFields<3>& fields,
                                       const std::array<double, 2>& slowness, const SweepsAhead& ahead);

/// Overload for a rock of any symmetry (theory.md (A19)).
std::vector<ShiftedFields> parts_ahead(const Elasticity<3>& stiffness, double rho,
                                       const WaveFields<3>& fields, const std::array<double, 2>& slowness,
                                       const SweepsAhead& ahead);

/// Fields of a wave that travels in the x-z plane, turned about z from x towards y.
WaveFields<3> turned(const MotionAlongX& medium, const PlaneFields& fields,
                     const std::array<double, 2>& along);

/// Whether any rock that the incident wave of a scene is known in is anisotropic.
bool travels_in_anisotropic_rock(const Scene<3>& scene, const Domain<3>& domain, const PlaneWaveWay<3>& way);

/// The incident wave of a 3-D plane wave whose plane of travel is not x-z, or in anisotropic rock: of one
/// medium, or in layers. Its fields after any of the sweeps of a step are series in time, one a field, in
/// layers of each row.
template <class Real>
std::unique_ptr<IncidentWave<3, Real>> make_turned_wave(const Scene<3>& scene, const Source<3>& source,
                                                        const PlaneForm<3>& form, const Domain<3>& domain,
                                                        const PlaneWaveWay<3>& way, double dt_s);

}  // namespace slipwave::solver
