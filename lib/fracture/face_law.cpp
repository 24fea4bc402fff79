// SPDX-License-Identifier: BSD-3-Clause
#include "fracture/face_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/friction_laws.hpp"

namespace slipwave {
namespace {

/// Stiffer springs than this, beside Z, are none.
constexpr double stiffest = 1e30;

bool welded(const FaceLoad& load) { return load.relaxation >= stiffest; }

/// A traction that goes exponentially to another one at that rate, for that part of the sweep.
struct Piece {
  double end, sum;  // sum: its integral
};
Piece relax(double from, double to, double rate, double time) {
  if (rate >= stiffest) return {to, to * time};
  const double lag = rate * time;
  const double lost = -std::expm1(-lag);
  const double mean_kept = lag > 0 ? lost / lag : 1;
  return {to + (from - to) * (1 - lost), (to + (from - to) * mean_kept) * time};
}

/// Returns the time at which a traction that goes from one side of a bound to the other comes there, at that
/// rate; infinite where it does not.
double time_to(double bound, double from, double to, double rate) {
  const double left = (bound - to) / (from - to);
  if (!(left > 0) || left >= 1) return std::numeric_limits<double>::infinity();
  return -std::log(left) / rate;
}
/// Returns the time of time_to() for a bound that is not behind the traction, even where the traction stands
/// there already but for rounding.
double time_on_to(double bound, double from, double to, double rate) {
  const double left = (bound - to) / (from - to);
  return left > 0 ? -std::log(std::min(left, 1.)) / rate : std::numeric_limits<double>::infinity();
}

/// Rate of a spring in series with what holds back (compliances add up).
double in_series(double spring, double held) {
  if (spring >= stiffest) return held;
  return held > 0 ? spring * held / (spring + held) : 0;
}

/// Along the way: what is left of the sweep, and what has been summed up.
struct Way {
  double traction, left = 1, sum = 0;

  void go(double to, double rate, double time) {
    const auto piece = relax(traction, to, rate, time);
    traction = piece.end, sum += piece.sum, left -= time;
  }
  void stay(double time) { sum += traction * time, left -= time; }
};

/// What of the jump the spring does not take is slip or opening: the waves leave load - traction of it.
FaceMotion motion_of(const FaceLoad& load, const Way& way, bool loose) {
  const double sprung = welded(load) ? 0 : (way.traction - load.before) / load.relaxation;
  return {way.sum, way.traction, load.welded - way.sum - sprung, loose};
}

/// Without a spring: the slip follows the load at once or, held back or with viscosity, exponentially.
FaceMotion slide_welded(const FaceLoad& load, double slip, double strength, double drag) {
  const double excess = load.welded - load.held * slip;
  if (std::abs(excess) <= strength) return {load.welded, load.welded, 0, false};
  const double rate = load.held / (1 + drag);
  const double pace = (excess - std::copysign(strength, excess)) / (1 + drag);
  const double lost = -std::expm1(-rate);
  const double moved = pace * (rate > 0 ? lost / rate : 1);
  return {load.welded - moved, load.welded - pace * (1 - lost), moved, true};
}

/// A spring, viscosity and what holds back a tip, all at once: the slip of the end of the sweep (implicit
/// Euler), which no load makes grow.
FaceMotion slide_slowly(const FaceLoad& load, double slip, double strength, double drag) {
  const double compliance = 1 / load.relaxation;
  const auto excess = [&](double traction) { return traction - load.held * slip; };
  const auto stuck = give_face(load);
  const double most =
      std::abs(excess(stuck.end)) > std::abs(excess(load.before)) ? excess(stuck.end) : excess(load.before);
  if (std::abs(most) <= strength) return stuck;
  const double bound = load.held * slip + std::copysign(strength, most);
  const double moved = (load.welded + compliance * load.before - (1 + compliance) * bound) /
                       (1 + (1 + compliance) * (drag + load.held));
  if (!(moved * most > 0)) return stuck;
  const double traction = bound + (drag + load.held) * moved;
  return {traction, traction, moved, true};
}

/// A spring before a slider without viscosity: sticks, reaches the strength, slides.
FaceMotion slide_dry(const FaceLoad& load, double slip, double strength) {
  Way way{load.before};
  double moved = 0;
  const auto excess = [&] { return way.traction - load.held * (slip + moved); };
  // The strength fell below the traction: the spring goes back at once, and slip takes its place.
  double reached = 0;
  if (std::abs(excess()) > strength) {
    reached = std::copysign(1, excess());
    const double change = (reached * strength - excess()) / (1 + load.held / load.relaxation);
    way.traction += change;
    moved -= change / load.relaxation;
  }
  const double side = load.welded < way.traction ? -1 : 1;
  const double bound = load.held * (slip + moved) + side * strength;
  double stuck = way.left;
  if (load.welded != way.traction)
    stuck = side == reached ? 0 : time_on_to(bound, way.traction, load.welded, load.relaxation);
  const bool slides = stuck < way.left;
  way.go(load.welded, load.relaxation, std::min(stuck, way.left));
  if (slides)
    way.go(load.held > 0 ? load.welded : way.traction, in_series(load.relaxation, load.held), way.left);
  auto motion = motion_of(load, way, slides);
  if (!slides && reached == 0) motion.moved = 0;  // but for rounding
  return motion;
}

/// A spring before a slider with viscosity: of two rates, below the strength and above it.
FaceMotion slide_in_pieces(const FaceLoad& load, double strength, double drag) {
  Way way{load.before};
  const double faster = load.relaxation * (1 + 1 / drag);
  bool slides = false, slid = false;
  // From above the strength of one side to that of the other at most.
  for (int piece = 0; piece < 3 && way.left > 0; ++piece) {
    const double side = way.traction < 0 || (way.traction == 0 && load.welded < 0) ? -1 : 1;
    const double outward = side * (load.welded - way.traction), at = side * way.traction;
    slides = at > strength || (at == strength && outward > 0);
    const double to = slides ? (load.welded * drag + side * strength) / (1 + drag) : load.welded;
    const double rate = slides ? faster : load.relaxation;
    // Stuck planes may reach the strength of either side.
    const double bound = slides ? side * strength : (load.welded < way.traction ? -strength : strength);
    const double time = std::min(time_to(bound, way.traction, to, rate), way.left);
    way.go(to, rate, time);
    if (way.left > 0) way.traction = bound;
    slid |= slides;
  }
  auto motion = motion_of(load, way, slides);
  if (!slid) motion.moved = 0;  // but for rounding
  return motion;
}

}  // namespace

FaceMotion give_face(const FaceLoad& load) {
  const auto piece = relax(load.before, load.welded, load.relaxation, 1);
  return {piece.sum, piece.end, 0, false};
}

FaceMotion slide_face(const FaceLoad& load, double slip, double strength, double drag) {
  if (welded(load)) return slide_welded(load, slip, strength, drag);
  if (!(drag > 0)) return slide_dry(load, slip, strength);
  if (load.held > 0) return slide_slowly(load, slip, strength, drag);
  return slide_in_pieces(load, strength, drag);
}

bool FaceLaw::has_state() const {
  return with_friction_law(friction_law, [](auto of) { return decltype(of)::has_state; });
}

double FaceLaw::strength_pa(double normal_pa) const {
  return with_friction_law(friction_law,
                           [&](auto of) { return decltype(of)::strength(friction, normal_pa, 0.); });
}

FaceMotion slide_face(const FaceLaw& law, const FaceLoad& load, const FaceMotion& across,
                      const FaceSlip& so_far) {
  auto constants = law.friction;
  if (across.loose) constants.cohesion_pa = 0;
  const auto slide = [&](double strength) {
    return slide_face(load, so_far.slip, strength, law.viscosity_s_m * strength / so_far.impedance);
  };
  return with_friction_law(law.friction_law, [&](auto of) {
    using Law = decltype(of);
    const double before = Law::strength(constants, across.mean, so_far.path_m);
    const auto motion = slide(before);
    if constexpr (Law::has_state) {
      // As in cells (S18), of half the slip of the sweep; what a change of the strength takes off the slip
      // depends on springs and tips, and is found by one.
      const double half_m_per_pa = so_far.m_per_pa / 2, loss = std::abs(motion.moved);
      const double now =
          Law::strength(constants, across.mean, Law::slip_after(so_far.path_m, half_m_per_pa, loss));
      if (now == before) return motion;
      const double share = (std::abs(slide(now).moved) - loss) / (before - now);
      return slide(Law::strength_at_end(constants, across.mean, so_far.path_m, half_m_per_pa, loss, share));
    }
    return motion;
  });
}

FaceMotion part_face(const FaceLoad& load, double opening) {
  Way way{welded(load) && opening <= 0 ? std::min(load.welded, 0.) : load.before};
  const double rate = in_series(load.relaxation, load.held);
  bool open = opening > 0;
  double gap = opening;
  // Shut, open, shut again at most.
  for (int piece = 0; piece < 3 && way.left > 0; ++piece) {
    double time = way.left;
    if (!open) {
      if (load.welded > 0)
        time = welded(load) || way.traction >= 0 ? 0 : time_to(0, way.traction, load.welded, load.relaxation);
      open = time < way.left;
      way.go(load.welded, load.relaxation, std::min(time, way.left));
      if (open) way.traction = 0, gap = 0;
    } else if (load.held > 0) {
      // Rock beyond the tip pulls it shut: a spring of the gap.
      way.traction = welded(load) ? load.held * gap : way.traction;
      if (load.welded < 0) time = way.traction > 0 ? time_to(0, way.traction, load.welded, rate) : 0;
      open = !(time < way.left);
      way.go(load.welded, rate, std::min(time, way.left));
      if (!open) way.traction = 0;
    } else {
      way.traction = 0;
      if (load.welded < 0) time = gap / -load.welded;
      open = !(time < way.left);
      way.stay(std::min(time, way.left));
    }
  }
  auto motion = motion_of(load, way, open);
  if (!open) motion.moved = -opening;
  return motion;
}

}  // namespace slipwave
