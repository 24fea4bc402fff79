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
#include "solver/effect/stack_response.hpp"

namespace slipwave::solver {

/// The times that a wave in them is asked for: `slowness` along x and y, and down, where it comes from; its
/// amplitude is counted at depth reference_m.
template <int D>
SeriesWindow window_of(const Scene<D>& scene, const Source<D>& source, const Domain<D>& domain,
                       const std::array<double, 2>& slowness, double down, double reference_m);

/// The exact solution of an oblique plane wave in the layers of a scene, in each row of cells.
template <int D>
class LayeredSeries {
 public:
  using Complex = std::complex<double>;
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
