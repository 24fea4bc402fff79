// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "acquisition/interpolation.hpp"
#include "acquisition/spreads.hpp"
#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "grid/grid.hpp"
#include "grid/tensor.hpp"

namespace slipwave {

/// Pushes outward alike in all directions: M' = w in every normal stress.
struct Explosion {};

/// A force w times this vector on the medium.
template <int D>
struct PointForce {
  Point<D> vector{};
};

/// A moment whose rate is w times this tensor.
template <int D>
struct MomentTensor {
  SymmetricTensor<D, double> tensor;
};

/// A plane P wave, or an S wave polarized in the vertical plane of travel (SV), that comes in from outside.
template <int D>
struct PlaneWave {
  double angle_deg = 0;
  Point<D> direction{};  // of travel; unit vector
  bool shear = false;
  double azimuth_deg = 0;               // 3-D: of the plane of travel, from x towards y
  std::array<double, 2> along{1., 0.};  // the same as a unit vector along x and y

  /// The part of `direction` along the azimuth.
  double across() const { return D == 2 ? direction[0] : direction[0] * along[0] + direction[1] * along[1]; }
  bool in_x_z() const { return along[0] == 1; }

  double speed(double vp, double vs) const { return shear ? vs : vp; }
};

template <int D>
using Mechanism = std::variant<Explosion, PointForce<D>, MomentTensor<D>, PlaneWave<D>>;

/// What sets the medium in motion (theory.md (A4)-(A7)). w(t) is the wavelet, dimensionless, A = amplitude:
///   explosion  moment rate A w, N m/s in 3-D, N m/s per metre of the line source in 2-D
///   force      A w times the vector, N (2-D: N/m)
///   moment     moment rate A w times the tensor, N m/s (2-D: N m/s per m)
///   plane      particle velocity A w along the direction of travel, or across it (S waves), m/s; w(0) is at
///              the wavefront that runs through position_m at t = 0
template <int D>
struct Source {
  Point<D> position_m{};
  Mechanism<D> mechanism;
  Wavelet wavelet;
  double amplitude = 1;
  double delay_s = 0;  // of its wavelet after the begin of the record, 0 or more
};

/// Shots into receivers. Shots count from 1.
template <int D>
struct Survey {
  std::vector<Source<D>> sources;     // one of each shot
  std::vector<Point<D>> receivers_m;  // of every shot, where there are no spreads
  /// Further sources of a shot that are recorded with its first (a blended shot); empty: none of any.
  std::vector<std::vector<Source<D>>> blended = {};
  /// The spreads of shots with receivers, channels or numbers of their own; none: channels count from 1,
  /// shots too.
  std::optional<Spreads<D>> spreads = {};
  /// What a place is that cannot be in the model: options' misuse, or wrong data of files.
  ErrorKind misplaced = ErrorKind::data;

  std::vector<Receiver<D>> receivers_of(std::size_t shot) const;
  std::size_t receiver_count(std::size_t shot) const {
    return spreads ? spreads->count_of(shot) : receivers_m.size();
  }
  /// Whether any shot has one.
  bool any_receiver() const;
  /// Number of the field record of a shot.
  std::int64_t number_of(std::size_t shot) const;
  /// What messages and names of files call a shot: its number where no other has it, else its place in order.
  std::int64_t label_of(std::size_t shot) const;
  /// "source 3", or where it was given.
  std::string name_of_source(std::size_t shot, std::size_t which) const;
  /// The first source of a shot and those that are blended with it.
  std::vector<const Source<D>*> sources_of(std::size_t shot) const;
};

/// Runs `body`; an Error leaving it is of the kind of misplaced places.
template <int D, class Body>
void placing(const Survey<D>& survey, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    throw Error(error.what(), survey.misplaced);
  }
}

/// Calls `see` with every place where a receiver stands, and a shot (from 1) and number (from 1) that it has
/// there; a place where one stands in many shots is seen once.
template <int D>
void each_receiver(const Survey<D>& survey,
                   const std::function<void(const Point<D>&, std::size_t shot, std::size_t number)>& see);
/// "receiver 3", or "shot 12: receiver 3 (channel 7)", and where it is on the map if it came from one.
template <int D>
std::string name_of_receiver(const Survey<D>& survey, std::size_t shot, std::size_t number);

/// Puts the places of a survey that options gave (its spreads) into a model of that ground: sources get their
/// positions, receivers are found or, where all shots have the same and channels from 1, listed. Throws an
/// Error naming what cannot be placed.
template <int D>
void place(Survey<D>& survey, Ground<D> ground);

/// Whether depths can be told only by a look at the model's cells.
template <int D>
bool needs_ground(const Survey<D>& survey);

/// What a point source does, per unit of its wavelet and before it is spread over cells of volume V = h^D:
///   v_i' += force_i w/(rho V),   s_ij' -= moment_ij w/V   (tension positive: M > 0 pushes outward)
template <int D>
struct PointInjection {
  Point<D> force{};
  SymmetricTensor<D, double> moment_rate;
  /// Whether it is the same for every direction: it must not make shear of its own, however it is spread over
  /// cells.
  bool isotropic = false;
};

/// Nothing for a plane wave.
template <int D>
std::optional<PointInjection<D>> point_injection(const Source<D>& source);
/// Whether a source has a moment of which something stays behind its wavelet, as that of an earthquake does.
template <int D>
Moment moment_of(const Source<D>& source);

/// "explosion", "force:AX,AZ", "moment:MXX,MZZ,MXZ", "plane:ANGLE", "double-couple:DIP" or "plane-s:ANGLE";
/// in 3-D "force:AX,AY,AZ", "moment:MXX,MYY,MZZ,MXY,MXZ,MYZ", "double-couple:STRIKE,DIP,RAKE" and, of plane
/// waves, "ANGLE,AZIMUTH" too, the azimuth from x towards y, 0 where it is left out. ANGLE in
/// degrees: 0 travels straight down, positive angles tilt towards +x, 90 travels towards +x, 180 up. Vector
/// and tensor are taken as they are, not normalised, and must not vanish. A double couple has unit moment:
/// STRIKE from x towards y, the plane dips to the right of it, RAKE is the direction in which the upper side
/// slips, from STRIKE, upwards positive (Aki & Richards 2002, with x as north and y as east). In 2-D the
/// plane dips towards +x and the upper side moves up it: STRIKE 270, RAKE 90. Throws a usage Error.
template <int D>
Mechanism<D> parse_mechanism(const std::string& text);

/// "explosion", "force", "moment", "plane" or "plane-s" (acquisition/source_kind.hpp).
template <int D>
const char* name_of(const Mechanism<D>& mechanism);

/// Whether a point is in the grid; its faces belong to it.
template <int D>
bool is_inside(const Point<D>& point_m, const Grid<D>& grid);

/// Throws an Error "WHAT at x=.. lies outside the model, expected .." where a point is not in the grid, with
/// the remedy where it lies beside the model.
template <int D>
void check_inside(const std::string& what, const Point<D>& point_m, const Grid<D>& grid,
                  const std::string& remedy = {});

/// Throws an Error naming the first source or receiver that is not in the grid (its faces belong to it) or
/// not finite. The position of a plane wave is only a point of reference and may lie anywhere.
template <int D>
void check(const Survey<D>& survey, const Grid<D>& grid);

extern template struct Survey<2>;
extern template struct Survey<3>;

}  // namespace slipwave
