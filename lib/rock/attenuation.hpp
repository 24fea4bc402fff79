// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rock/anisotropy.hpp"
#include "rock/medium.hpp"

namespace slipwave {

inline constexpr int fewest_mechanisms = 2, most_mechanisms = 5;

/// What the mechanisms of a modulus relax, Y_l of theory.md (Q1), as shares of the unrelaxed modulus; the
/// first `count` count.
using RelaxedShares = std::array<double, most_mechanisms>;

/// Mechanisms of a generalised standard linear solid that together lose the same share of the energy per
/// cycle all over a band: their rates are spread over it once, their shares follow from Q by least squares
/// (theory.md (Q2), (Q3)).
class Mechanisms {
 public:
  /// fewest_mechanisms to most_mechanisms of them for 0 < low_hz < high_hz. Throws a usage Error.
  Mechanisms(int count, double low_hz, double high_hz);

  int count() const { return count_; }
  double low_hz() const { return low_hz_; }
  double high_hz() const { return high_hz_; }
  /// Returns the rate of mechanism l, in 1/s.
  double rate(int l) const { return rates_[std::size_t(l)]; }
  /// Least squares for a constant Q; all zero where it is infinite.
  RelaxedShares shares(double q) const;
  /// The modulus at a frequency over the unrelaxed one (Q1).
  std::complex<double> modulus(const RelaxedShares& shares, double hz) const;
  /// Returns the modulus of a plane wave at a frequency over the unrelaxed one, where stress relaxes every
  /// `interval_s` only, as in the scheme (Q8a).
  std::complex<double> stepwise_modulus(const RelaxedShares& shares, double hz, double interval_s) const;
  /// The quality factor at a frequency.
  double quality(const RelaxedShares& shares, double hz) const;
  /// Returns the frequency at which (Q4) holds for a speed given at a frequency: there, or for one beside the
  /// band in its middle.
  double speed_known_at(double hz) const {
    return hz < low_hz_ || hz > high_hz_ ? std::sqrt(low_hz_ * high_hz_) : hz;
  }
  /// The speed of the unrelaxed medium over that at a frequency (Q4); from one beside the band to its middle
  /// speeds change as those of a constant Q do (Q4a).
  double unrelaxed_speed(double q, double hz) const;
  /// The largest relative deviation of Q from the wanted one in the band.
  double largest_error(double q) const;
  /// Largest deviation that is let through: 3 %, or twice that of weak attenuation where it is more.
  double error_limit() const { return error_limit_; }
  /// The smallest Q that is fitted so.
  double least_quality() const { return least_quality_; }

 private:
  using Matrix = std::array<std::array<double, most_mechanisms>, most_mechanisms>;
  void spread(double half_width);

  int count_;
  double low_hz_, high_hz_, error_limit_ = 0, least_quality_ = 0;
  std::array<double, most_mechanisms> rates_{};
  // Normal equations of (Q2): (Q^2 squares_ + Q products_ + ones_) Y = Q sum_of_losses_ + sum_of_stores_.
  Matrix squares_{}, products_{}, ones_{};
  RelaxedShares sum_of_losses_{}, sum_of_stores_{};
};

/// Returns the factor by which phase speeds of a constant Q grow from a frequency to another (Kjartansson
/// 1979).
double faster_by_constant_quality(double q, double from_hz, double to_hz);

/// How a medium attenuates: the mechanisms, and the frequency at which waves have the speeds given.
struct Attenuation {
  Mechanisms mechanisms;
  double reference_hz;
};

/// What stands for an infinite Q in files whose values are finite: from here on a cell is elastic.
inline constexpr float elastic_quality = 1e9F;

/// Whether a cell has a finite qp or qs.
template <int D>
bool attenuates(const Medium<D>& medium, std::size_t cell);
/// How many do.
template <int D>
std::int64_t attenuating_cells(const Medium<D>& medium);

/// Turns speeds at the reference frequency into those of the unrelaxed medium, the highest of any frequency
/// (Q4), and the deltas of anisotropic rock (Q10), (Q12). Where qp is larger than shear loss alone makes it,
/// it becomes that (Q6); absent or infinite it may be. Returns a sentence on cells whose finite qp was
/// lowered by more than 3 %, empty where there are none. Throws Error naming cell, value and remedy where qp
/// or qs is below least_quality().
template <int D>
std::string unrelax(Medium<D>& medium, const Attenuation& attenuation);

/// What of the bulk and of the shear modulus of a cell relaxes (Q5). In 2-D the bulk modulus is that of plane
/// strain, lambda + mu; of anisotropic rock they are the parts of (Q9), in 3-D of (Q11).
struct CellShares {
  RelaxedShares bulk{}, shear{};
};

/// How the stress in anisotropic rock of 2-D is taken apart before it relaxes (Q9): with m and h half the sum
/// and half the difference of the normal stresses along and across its beds, its parts are even m + odd h,
/// even h + odd m, and the shear stress of the beds. The beds dip by half the angle of cosine and sine.
struct RelaxingAxis {
  double even = 1, odd = 0, cosine = 1, sine = 0;
};
RelaxingAxis relaxing_axis(const Material& rock);

/// What a plane wave feels of rock that attenuates, by its complex stiffness about its own axis (theory.md
/// (Q1), (Q9)), Pa; of isotropic rock and fluid, too.
struct ComplexStiffness {
  std::complex<double> c11, c13, c33, c55;
};
/// Phase speeds and quality factors of plane waves; of S waves 0 in fluid.
struct LossyWaves {
  PlaneSpeeds speed, quality;
};
/// Returns the waves whose fronts move at this angle from the axis: (V3) with complex stiffnesses.
LossyWaves lossy_waves(const ComplexStiffness& stiffness, double rho, double angle_rad);

/// An unrelaxed medium whose stress relaxes at one moment of every `interval_s`, for all of that time: its
/// speeds and shares are such that waves have the moduli of a medium that relaxes all the time (Q8). With an
/// interval of 0 it is that medium.
template <int D>
class StepwiseRelaxation {
 public:
  /// Keeps a reference.
  StepwiseRelaxation(const Medium<D>& medium, const Mechanisms& mechanisms, double interval_s);
  /// Its own shares; `isotropic`: of an interface's cell that the solver takes for its isotropic mean.
  CellShares shares(std::size_t cell, bool isotropic = false) const;
  /// Returns what gives the same of cells one after the other, to one thread; it keeps a reference.
  std::function<CellShares(std::size_t cell, bool isotropic)> shares_in_turn() const;
  /// The stiffness of plane waves at a frequency; in 3-D of those in the plane of the rock's axes 1 and 3.
  ComplexStiffness stiffness(std::size_t cell, double hz) const;
  /// The medium with its own speeds.
  Medium<D> medium() const;
  /// 1 - exp(-rate interval): how far mechanism l comes in an interval.
  double decay(int l) const;

 private:
  /// What the shares of a cell depend on; the rock if it is not isotropic.
  struct Key {
    double qp, qs, vp, vs;
    std::optional<Material> rock;
    bool operator==(const Key& other) const = default;
  };
  Key key_of(std::size_t cell, bool isotropic) const;
  CellShares continuous(const Key& of) const;
  CellShares shares(const Key& of) const;
  double kept(const RelaxedShares& shares) const;

  const Medium<D>* medium_;
  Mechanisms mechanisms_;
  double interval_s_;
  std::array<double, most_mechanisms> parts_{};  // of the shares, that relax by steps
};

}  // namespace slipwave
