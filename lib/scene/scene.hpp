// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/fibre.hpp"
#include "acquisition/survey.hpp"
#include "fracture/slip_law.hpp"
#include "gather/trace.hpp"
#include "model/model.hpp"
#include "rock/attenuation.hpp"
#include "scene/edges.hpp"
#include "scene/orders.hpp"
#include "scene/subdomain.hpp"

namespace slipwave {

/// "first order", "second order" or "exponential".
const char* name_of(SlipCorrection correction);

/// What slip has done in a cell: slip as a strain, its rate in the last step, 1/s, the energy that friction
/// turned into heat, J/m3, and the strain by which planes stand open.
enum class SlipField { slip, slip_rate, dissipated, opening };

/// How time steps are executed; it changes speed, never a result. 0: as measured best.
struct Tiling {
  int steps = 0;            // time steps in one time tile
  int stripe_cells = 0;     // columns swept together, a multiple of 16
  bool everywhere = false;  // compute also cells that no wave has reached or that affect no receiver
  bool plain = false;       // no tiles: each sweep and effect on the whole grid, one after the other
};

/// A range of depths with cells of their own: from a depth, m, on to the next band or the bottom.
struct Band {
  double from_m = 0;
  double spacing_m = 0;
};

/// How the scene is computed. Defaults are those of sw-shoot.
struct Numerics {
  int order = 5;                      // of the reconstruction: one of `orders`
  double cfl = 0.9;                   // time step over h/vp_max
  std::optional<double> time_step_s;  // instead of cfl
  int zone_cells = 0;  // width of the absorbing layers; 0: as their kind needs, see zone_cells()
  SlipCorrection correction = SlipCorrection::centred;
  bool double_precision = false;
  int time_order = 2;     // of the splitting in time: one of `time_orders`
  bool monotone = false;  // sweeps keep to the criterion of monotonicity
  Tiling tiling;
  std::vector<Band> bands{};  // top to bottom, two or more; empty: all in the cells of the model
};

/// What is recorded at the receivers: traces of every component from t = 0 to duration, ends included. Where
/// sources fire before the record begins, t = 0 is `before_s` ahead of that, a whole number of samples, and
/// delays of sources count from there; in_record() leaves what was before.
struct Recording {
  std::vector<Component> components;
  double duration_s = 0;
  double interval_s = 0;
  std::optional<Fibre> fibre{};  // of Component::das
  double before_s = 0;
  std::int64_t samples() const;
  std::int64_t samples_before() const { return std::llround(before_s / interval_s); }
};

/// Everything a run depends on.
template <int D>
struct Scene {
  Model<D> model;
  Subdomain subdomain;  // of the model that this process computes
  Survey<D> survey;
  EdgeLaws<D> edges;
  Numerics numerics;
  Recording recording;
  std::optional<double> snapshot_every_s;  // whole fields at the first step after each multiple of it
  bool with_slip = true;                   // false: fracture sets of the model stay intact
  bool slip_diary = false;                 // keep slip and what it dissipates, cell by cell, and energies
  /// How cells with a finite qp or qs attenuate; the medium is then the unrelaxed one (set_attenuation()).
  /// Nothing: qp and qs do nothing.
  std::optional<Attenuation> attenuation = {};

  /// Whether waves are attenuated anywhere.
  bool attenuates() const;
  /// Whether slip happens anywhere.
  bool slips() const;
};

template <int D>
class ModelInCells;

/// Returns the same scene over another model.
template <int D>
Scene<D> with_model(const Scene<D>& scene, Model<D> model);

/// A scene in cells of another size, whatever that is: its model is made anew as by ModelInCells,
/// the unrelaxed one where the scene attenuates, and a time step given in seconds keeps its Courant number;
/// everything else stays. Of a whole model (Subdomain). Throws as that. `models` are of its own.
template <int D>
Scene<D> in_cells_of(const Scene<D>& scene, const ModelInCells<D>& models, double spacing_m);

/// How attenuation is wanted; what is not said follows from the wavelets.
struct AttenuationChoice {
  int mechanisms = 3;
  std::optional<double> reference_hz;            // where speeds are as given; else the peak of the wavelets
  std::optional<std::array<double, 2>> band_hz;  // where Q is constant; else a fifth to 2.5 times the peak
};

/// Lets a scene attenuate whose medium has a finite qp or qs anywhere, else only checks the choice: chooses
/// mechanisms for its wavelets and makes its medium unrelaxed. Returns warnings. Throws Error as Mechanisms
/// and unrelax(). The survey is there already; of several processes each does it with its part of the model.
template <int D>
std::vector<std::string> set_attenuation(Scene<D>& scene, const AttenuationChoice& choice = {});

/// h/vp_max, s: the time step at Courant number 1.
template <int D>
double stable_time_step_s(const Scene<D>& scene);
/// Largest c dt/h that is taken: no sweep moves a wave by more than a cell, with 13 % to spare at time
/// order 4.
double largest_cfl(const Numerics& numerics);
/// The time step of the run, s.
template <int D>
double time_step_s(const Scene<D>& scene);

/// Width in cells of the PML of a shot, unless numerics say otherwise: 20; of a plane wave two thirds of a
/// wavelength of the fastest wave, at least 20, and the cells that hold the incident wave (theory.md (E13)).
template <int D>
int zone_cells(const Scene<D>& scene, const Source<D>& source);

/// Throws an Error on the first thing that cannot be computed, the model's values apart (check(model)): a
/// source or receiver outside the model or in void, a time step above the limit, a component the dimension
/// does not have, a plane wave through edges that do not let it in. Nothing checks again later.
template <int D>
void check(const Scene<D>& scene);

/// The slowest wave in m/s of any cell that is not void: vs of solids, vp of fluids; and where.
struct SlowestWave {
  double speed = 0;
  std::int64_t cell = 0;
};
template <int D>
SlowestWave slowest_wave(const Medium<D>& medium);

/// Highest frequency that matters, Hz: above it lies 1 % of the energy of the wavelets.
template <int D>
double highest_frequency_hz(const Survey<D>& survey);

}  // namespace slipwave
