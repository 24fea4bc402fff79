// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/plane_wave.hpp"
#include "solver/effect/incident_wave.hpp"
#include "solver/effect/stack_response.hpp"
#include "solver/effect/time_series.hpp"

namespace slipwave::solver {

/// The incident wave of a plane wave in one medium, in closed form, or in level layers of any symmetry, from
/// their exact solution (theory.md (A7), (A15) to (A19)). In a row of cells its fields are functions of the
/// time less the slowness along the rows times the way along them: the waves along x that they are made of
/// are stored as series, and read at the times to which sweeps have moved them.
template <int D, class Real>
class LayeredWave : public IncidentWave<D, Real> {
 public:
  /// Keeps no reference. In layers where the way says so, else in the rock of the boundary it enters by.
  LayeredWave(const Scene<D>& scene, const Source<D>& source, const Domain<D>& domain,
              PlaneWaveGround<D> ground, double dt_s);

  void begin(State<D, Real>& state) override;
  bool enters(int axis, int side) const override { return !only_ || (axis == D - 1 && side == *only_); }
  bool reaches(const StepTime& time, const Index<D>& line) const override;
  bool values(const Clocks<D>& clocks, int axis, int side, const Index<D>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override;
  std::int64_t memory_bytes() const override;

 private:
  /// A series, and the fields that its values are multiplied by when it is read earlier_s later.
  struct Read {
    std::size_t series = 0;
    double earlier_s = 0;
    WaveFields<D> fields{};
  };
  /// How much further than sweeps along the last axis those along each other axis have advanced fields, s.
  using Ahead = std::array<double, std::size_t(D - 1)>;
  /// A wave along an axis that fields are made of: its size is the sum of `weights` times them. A sweep along
  /// the axis moves it as a whole.
  struct AxisWave {
    WaveFields<D> weights{}, fields{};
    double velocity = 0;  // m/s
    double size(const WaveFields<D>& all) const;
  };
  static std::vector<AxisWave> axis_waves(const Elasticity<D>& stiffness, double rho, std::size_t axis);
  std::vector<Read> reads_of(std::vector<Read> reads, const Material& rock, const Ahead& ahead,
                             std::size_t first_axis) const;
  void set_in_one_medium(const Material& rock, const Source<D>& source, const Point<D>& motion,
                         const std::vector<double>& depths_m);
  void set_in_layers(LayerStack<D> stack, const Scene<D>& scene, const Source<D>& source,
                     const std::vector<double>& depths_m);
  void sum_long_reads();
  static TimeSeries sum_of(const std::vector<Read>& reads, const std::vector<TimeSeries>& series,
                           std::size_t field);
  static Ahead ahead_of(const Clocks<D>& clocks);
  std::optional<std::size_t> stage_of(const Ahead& ahead) const;
  const std::vector<TimeSeries>& series_of(const Index<D>& line) const {
    return series_[series_.size() == 1 ? 0 : std::size_t(line[D - 1])];
  }
  double later_by(const Index<D>& line) const;

  Grid<D> grid_;
  Point<D> at_m_;
  Point<D> slowness_{};  // s/m
  std::optional<int> only_;
  double beside_steps_ = 0;
  double rounding_s_;
  std::vector<Ahead> stages_;
  std::vector<std::vector<std::vector<Read>>> reads_;  // [stage][layer]
  std::vector<std::size_t> layers_;                    // of each row
  std::vector<double> later_s_;                        // of each row
  /// They are the waves along x of each row, or one of all rows, and behind them sums of their reads.
  std::vector<std::vector<TimeSeries>> series_;
};

}  // namespace slipwave::solver
