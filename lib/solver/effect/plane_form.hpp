// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "acquisition/survey.hpp"
#include "solver/kernels/kernels.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// What decides how a plane wave moves along x in a cell: speeds of P and S waves along it, impedances, and
/// the share of s_xx that a P wave along x has across it. Fluid: no S.
struct MotionAlongX {
  double vp = 0, vs = 0, zp = 0, zs = 0, passive = 0;
  /// These three are of rock whose axis is tilted: the motion of the faster wave, along x and z, and the
  /// normal stress across x that the slower one has as a share of its traction.
  double cosine = 1, sine = 0, passive_s = 0;
  MotionAlongX() = default;
  explicit MotionAlongX(const Material& rock);
  bool turned() const { return sine != 0; }
};

/// The waves along x that fields are made of: P and S towards +x and -x, and what sweeps along x leave alone.
enum AlongX { p_forth, p_back, s_forth, s_back, at_rest };
inline constexpr int along_x_count = 5;
/// vx, vz, sxx, szz, sxz of a wave whose motion is in the x-z plane and does not depend on y.
using PlaneFields = std::array<double, 5>;
enum PlaneField { plane_vx, plane_vz, plane_sxx, plane_szz, plane_sxz };
using WavesAlongX = std::array<double, std::size_t(along_x_count)>;

WavesAlongX waves_along_x(const MotionAlongX& medium, const PlaneFields& fields);

/// A place of a plane wave in time: how far sweeps along z have advanced it, and how much further those along
/// x have. `slowness` is that along x, s/m.
struct PlaneMoment {
  double time_s = 0, ahead_s = 0, slowness = 0;
  /// The time at which a wave along x has the value that the fields hold at this moment: a sweep along x over
  /// ahead_s moves f(t - slowness x) of a wave of velocity c along x to f(t + slowness c ahead_s - ...).
  double time_of(const MotionAlongX& medium, int wave) const {
    const double c[] = {medium.vp, -medium.vp, medium.vs, -medium.vs, 0};
    return time_s + slowness * c[wave] * ahead_s;
  }
};

/// Values of all waves along x in some cells at once.
template <class Real>
struct CellsAlongX {
  static constexpr std::int64_t most = 64;
  Real wave[along_x_count][most];
};

/// The field rows of D dimensions, `pitch` apart, of `count` cells of one row.
template <int D, class Real>
void add_up(const MotionAlongX& medium, const CellsAlongX<Real>& waves, std::int64_t count, Real* to,
            std::int64_t pitch);

/// Depth of the corners above a row of the computed grid, m; all rows are level.
template <int D>
double top_of_row(const Domain<D>& domain, std::int64_t row);
/// Depths of the centres of rows, m.
template <int D>
std::vector<double> depths_of_rows(const Domain<D>& domain);

/// Samples at equal intervals, interpolated by quintics; zero before the first and after the last.
class TimeSeries {
 public:
  TimeSeries() = default;
  TimeSeries(std::vector<float> samples, double first_s, double interval_s)
      : samples_(std::move(samples)), first_s_(first_s), interval_s_(interval_s) {}
  /// `factor` times the values at t_s + (first + i) step_s, of i from 0 to count - 1.
  template <class Real>
  void values(double t_s, double step_s, std::int64_t first, std::int64_t count, double factor,
              Real* to) const;
  /// Whether it is zero everywhere between two times.
  bool is_zero(double from_s, double to_s) const {
    return to_s < first_s_ || from_s > first_s_ + interval_s_ * double(samples_.size());
  }
  /// What interpolation may spread a value by.
  double beside_s() const { return 6 * interval_s_; }
  std::int64_t memory_bytes() const { return std::int64_t(samples_.capacity() * sizeof(float)); }

 private:
  std::vector<float> samples_;
  double first_s_ = 0, interval_s_ = 1;
};

/// A plane P or SV wave in one medium (theory.md (A7), (A15), (A17)): every field is a constant times the
/// wavelet at the time since the front passed. Its x axis is the way it travels along the layers: of a 3-D
/// wave with an azimuth turned from the model's.
template <int D>
class PlaneForm {
 public:
  PlaneForm(const Source<D>& source, const Material& rock);
  /// Fields per unit of the wavelet.
  const PlaneFields& factors() const { return factors_; }
  const MotionAlongX& medium() const { return medium_; }
  /// Along x and z, s/m.
  const std::array<double, 2>& slowness() const { return slowness_; }
  /// Returns the time at which the front passes, in s.
  double arrival_s(double x, double z) const {
    return (x - origin_[0]) * slowness_[0] + (z - origin_[1]) * slowness_[1];
  }
  /// x and z of the source.
  const std::array<double, 2>& origin() const { return origin_; }
  /// Whether the wave is anywhere between two x at that depth, or has been or will be `beside_s` before or
  /// after.
  bool is_there(const std::array<double, 2>& x, double z, double time_s, double ahead_s,
                double beside_s = 0) const;
  /// All field rows, `pitch` apart, of `count` cells (CellsAlongX::most at most) from number `first` on, of
  /// which cell 0 is at x and the next `spacing` further. Returns whether the wave is there; else nothing is
  /// written.
  template <class Real>
  bool cells(double x, double spacing, std::int64_t first, std::int64_t count, double z, double time_s,
             double ahead_s, Real* to, std::int64_t pitch) const;

 private:
  Wavelet wavelet_;
  TimeSeries table_;
  std::array<double, 2> origin_{}, slowness_{};
  MotionAlongX medium_;
  PlaneFields factors_{};
  WavesAlongX waves_{};
};

}  // namespace slipwave::solver
