// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "scene/edges.hpp"
#include "scene/plane_wave.hpp"
#include "solver/effect/incident_wave.hpp"
#include "solver/effect/plane_form.hpp"
#include "solver/effect/stack_series.hpp"

namespace slipwave::solver {

/// A stack of layers on which a plane wave falls; the first and the last are half-spaces where their end
/// absorbs. Fluid where vs = 0.
struct PlaneStack {
  std::vector<Material> layers;   // downwards
  std::vector<double> depths_m;   // top of each layer and, behind the last, its bottom
  std::array<EdgeLaw, 2> ends{};  // of top and bottom
  bool from_top = true;
  bool shear = false;   // the incident wave: SV, else P
  double slowness = 0;  // along the layers, s/m
  double down = 0;      // of the incident wave downwards, s/m
};

/// All waves in such a stack for one angular frequency, by continuity of motion and traction at all
/// interfaces (theory.md (A16)). Per unit of the incident wave's particle velocity at the first interface it
/// comes to, or the end where there is none. Time factor exp(i omega t); omega may lie below the real axis.
class PlaneStackResponse {
 public:
  using Complex = std::complex<double>;
  explicit PlaneStackResponse(const PlaneStack& stack) : stack_(stack) { list_waves(); }
  /// Amplitudes of all waves(); the last is that of the incident wave.
  std::vector<Complex> solve(Complex omega) const;

  /// Its fields are vx, vz, sxx, szz, sxz.
  struct Wave : StackWave {
    std::array<Complex, 5> fields;
  };
  const std::vector<Wave>& waves() const { return waves_; }
  /// Of the incident wave, at which its amplitude is 1.
  double reference_m() const { return waves_.back().reference_m; }

 private:
  void list_waves();
  Wave make(std::size_t layer, bool shear, bool down) const;
  Wave make_in_anisotropic(std::size_t layer, bool shear, bool down) const;
  Wave make_incident() const;
  /// Where the amplitude of a wave is 1: at the face that it leaves, in half-spaces at their face.
  double reference_of(std::size_t layer, bool down) const;

  const PlaneStack& stack_;
  std::vector<Wave> waves_;
  std::vector<std::size_t> first_wave_;  // of each layer and behind the last
};

/// The layers of the column of cells that holds them; of each row of the computed grid the one it is in.
struct ColumnOfLayers {
  std::vector<Material> layers;
  std::vector<double> depths_m;  // as in a PlaneStack
  std::vector<std::size_t> of_row;
};
template <int D>
ColumnOfLayers layers_of(const Scene<D>& scene, const Domain<D>& domain, const PlaneWaveWay<D>& way);

/// The times that a wave in them is asked for: `slowness` along x and y, and down, where it comes from; its
/// amplitude is counted at depth reference_m.
template <int D>
SeriesWindow window_of(const Scene<D>& scene, const Source<D>& source, const Domain<D>& domain,
                       const std::array<double, 2>& slowness, double down, double reference_m);

/// The exact solution of an oblique plane wave in the layers of a scene, in each row of cells.
template <int D>
class LayeredSeries {
 public:
  using Complex = PlaneStackResponse::Complex;
  LayeredSeries(const Scene<D>& scene, const Source<D>& source, const PlaneForm<D>& form,
                const Domain<D>& domain, const PlaneWaveWay<D>& way);
  ~LayeredSeries();
  LayeredSeries(const LayeredSeries&) = delete;
  LayeredSeries& operator=(const LayeredSeries&) = delete;

  MotionAlongX medium(std::size_t row) const;
  /// The waves along x, as functions of time less the slowness along the layers times the way along them.
  std::array<TimeSeries, std::size_t(along_x_count)> waves_at(std::size_t row) const;
  /// The fields, as spectra.
  std::array<std::vector<Complex>, 5> fields_at(std::size_t row) const;
  /// The sum of parts of these fields: `factors` of each field in a part, and how much earlier a part is
  /// read.
  TimeSeries sum_of(const std::array<std::vector<Complex>, 5>& spectra,
                    const std::vector<std::array<double, 5>>& factors,
                    const std::vector<double>& earlier_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The incident wave of an oblique plane wave in layers: in each row of cells the exact solution, as a
/// function of time less the slowness along x times x.
template <int D, class Real>
std::unique_ptr<IncidentWave<D, Real>> make_layered_wave(const Scene<D>& scene, const Source<D>& source,
                                                         const PlaneForm<D>& form, const Domain<D>& domain,
                                                         const PlaneWaveWay<D>& way);

}  // namespace slipwave::solver
