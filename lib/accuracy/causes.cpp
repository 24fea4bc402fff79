// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/causes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "accuracy/beyond_sides.hpp"
#include "accuracy/grazing.hpp"
#include "accuracy/local_stack.hpp"
#include "accuracy/upright_plane.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;
using enum Representation;
using Kind = LocalInterface::Kind;

constexpr std::size_t shots_followed = 2, receivers_followed = 12;
/// Directions of travel, over a quarter circle, that dispersion is taken for.
constexpr std::size_t directions = 6;
/// Frequencies at which it is computed.
constexpr std::size_t frequencies = 40;

// Fitted to the errors of 400 drawn scenes of layers against exact traces (docs/accuracy.md).
/// What linear terms leave out of dispersion, and at orders 9 and 11, in fewer cells.
constexpr double dispersion_margin = 1.1, of_high_orders = 1.2;
/// Apparent shift of interfaces on faces, in cells times the square of cells per dominant wavelength.
constexpr double shift_on_faces = 3.7, shift_of_surface = 1.3, shift_of_floor = 3.4, shift_of_ramps = 2.3;
/// At order 7 and above; orders 9 and 11 fall to 5 beside an interface, which is felt by the S waves of a
/// force and at a free surface.
constexpr double order_7_on_faces = 0.5, high_order_of_forces = 2, high_order_at_surfaces = 1.5;
/// The same of other representations, in cells: with means, in stairs, and within less than two rows.
constexpr double shift_of_means = 0.13, shift_of_gentle_means = 0.087, shift_of_stairs = 0.38,
                 shift_of_few_stairs = 0.3;
/// Fluid that stairs make resist motion of the solid along them, and at a free surface the solid itself, in
/// cells.
constexpr double drag_of_stairs = 1.5, drag_of_surface_stairs = 0.3;
/// Apparent shift of interfaces that rows follow round bends, in cells over the square of the curvature times
/// the cell.
constexpr double shift_in_bends = 0.3;
/// Of an interface known to lie beside its face, the share of the way that counts.
constexpr double share_of_offset = 0.6;
/// By how much near fields are worse at order 3, and in the pressure of a force, which is weak beside it.
constexpr double near_of_order_3 = 5, near_in_pressure = 3;
/// Cells per wavelength from which cells that are anisotropic about the normal of an interface err less than
/// means that are not: their error falls with the square of cells.
constexpr double cells_of_tilted_means = 7.7;
/// What comes back along a fitted surface from where it becomes level beyond the sides, by its slope: of
/// water, of rock, and of waves bound to rock.
constexpr double bent_water = 0.018, bent_rock = 0.018, bent_bound = 0.01;
/// What comes back from where an interface becomes level beyond a side, by its slope and how well it
/// reflects; and the share of it where rows follow it, which dip further (theory.md (F10)).
constexpr double bent_interface = 0.055, bent_fitted = 0.6;
/// What zones take of the amplitude that such an interface, straight on, would send back from beyond the
/// side.
constexpr double taken_by_sides = 0.5;
/// Error per wavelength of waves bound to a free surface or to an interface of fluid and solid, in stairs and
/// where it is corrected (theory.md (E11a)), at 24 cells per wavelength of the slower wave; it falls with
/// their cube.
constexpr double bound_to_surface = 0.01, bound_to_stairs = 0.028, bound_to_floor = 0.011,
                 bound_to_bent_floor = 0.02;
/// Of those bound to stairs of a free surface, whose teeth slow them; in proportion to cells, and to the dip
/// up to this one, degrees.
constexpr double bound_to_surface_stairs = 0.5, steep_stairs_deg = 12;
/// Of those of an explosion in hard rock.
constexpr double bound_by_explosion = 0.4;
/// Of those at order 7: along floors, floors where rows bend, and free surfaces.
constexpr double bound_at_order_7 = 0.5, bent_at_order_7 = 0.8, surface_at_order_7 = 0.75;
/// At order 3, of those bound to a free surface.
constexpr double bound_at_order_3 = 4;
/// Error of all that an explosion sends out from up to 2.6 cells below a free surface of rock, at 24 cells
/// per wavelength of S; it falls with their square, whatever the order.
constexpr double beside_surface = 0.0135;
/// Decay of bound waves with the distance from their interface, over the wave number.
constexpr double bound_decay = 0.3;
/// The part of what is recorded beside an edge that grazes it, as in a full space.
constexpr double all_graze = 0.85;
/// What receivers in corners of stairs record too much, as part of what they should.
constexpr double too_much_in_corners = 2.8;
/// Stairs that count as such, in rows.
constexpr double few_stairs = 1.5;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// By how much an interface seems to be moved, as a share of a cell: `share` over cells per wavelength of the
/// slowest wave beside it to this power.
struct Shift {
  double share, power;
};
Shift shift_of(const LocalInterface& interface) {
  switch (interface.representation) {
    case on_faces:
    case fitted:
      return {interface.kind == Kind::inner     ? shift_on_faces
              : interface.kind == Kind::surface ? shift_of_surface
                                                : shift_of_floor,
              2};
    case gradual:
      return {shift_of_ramps, 2};
    case averaged:
      // Where it is nearly level or bends, its errors differ from place to place and cancel.
      return {interface.stairs > 1 && (interface.steepest_deg < 10 || interface.is_curved())
                  ? shift_of_gentle_means
                  : shift_of_means,
              0};
    case staircase:
      return {interface.stairs < few_stairs ? shift_of_few_stairs : shift_of_stairs, 0};
  }
  return {1, 0};
}

bool has_drag(const LocalInterface& interface) {
  return interface.representation == staircase && interface.stairs >= few_stairs &&
         interface.kind != Kind::inner;
}

double slowest_of(const UniformMedium& rock) { return rock.vs > 0 ? rock.vs : rock.vp; }
double slowest_beside(const LayeredPlaces& places, std::size_t face) {
  const auto below = places.free_surface ? face : face + 1;
  const double speed = slowest_of(places.layers[below]);
  return below > 0 ? std::min(speed, slowest_of(places.layers[below - 1])) : speed;
}

/// Beside an interface of solids fields are read at equal distances, which are unequal times: the error is
/// that of the slower side, on whichever the source stands.
double slower_behind(const LayeredPlaces& places, std::size_t face) {
  const auto below = places.free_surface ? face : face + 1;
  if (below == 0) return 1;
  const auto side = places.source_layer() >= below ? below : below - 1;
  return slowest_of(places.layers[side]) / slowest_beside(places, face);
}

std::string percent(double share) { return shown(100 * share, 2) + " %"; }

/// Where an interface is, for messages.
std::string range_of(const LocalInterface& interface) {
  if (!interface.x_is_known) return "";
  return " between x=" + shown(interface.from_x_m, 4) + " and " + shown(interface.to_x_m, 4);
}

/// How an interface is put at its true place.
std::string fit_of(Kind kind, Maker maker) {
  const bool inner = kind == Kind::inner, floor = kind == Kind::fluid_solid;
  if (maker == Maker::sw_marmousi)
    return inner ? "make it in smaller cells (sw-marmousi --step)" : "fit it (sw-marmousi --fit floor)";
  if (maker == Maker::sw_import)
    return inner ? "" : "fit it (sw-import " + std::string(floor ? "--floor found" : "--surface FILE") + ")";
  return "fit it (sw-layers --fit " + std::string(inner ? "all" : floor ? "floor" : "surface") + ")";
}

/// Name and remedy of the error of an interface.
ErrorCause cause_of(const LocalInterface& interface, Maker maker, bool finer_geometry, bool beside_face) {
  ErrorCause cause;
  const bool represented = interface.representation == on_faces || interface.representation == fitted ||
                           interface.representation == gradual;
  const bool known = represented && !beside_face;
  cause.curable = known || finer_geometry;
  if (!known) cause.remedy = fit_of(interface.kind, maker);
  cause.name = interface.name();
  if (interface.representation == staircase)
    cause.name +=
        range_of(interface) + ", a staircase of up to " + shown(interface.steepest_deg, 2) + " degrees";
  if (interface.representation == averaged)
    cause.name += range_of(interface) + ", means in the cells it cuts";
  if (interface.representation == fitted) cause.name += ", fitted";
  if (interface.representation == gradual) cause.name += range_of(interface) + ", over several cells";
  if (interface.representation == on_faces)
    cause.name += beside_face ? ", " + shown(std::abs(interface.true_depth_m - interface.depth_m), 2) +
                                    " m beside the face that stands for it"
                              : ", on a face";
  return cause;
}

/// Error of what arrives straight above a shallow force in rock under a free surface, hardly less in smaller
/// cells: a source `depth_m` deep, receivers between it and the surface, `aside_m` from it.
double shallow_error(double depth_m, double aside_m, double wavelength_m) {
  return 0.7 * std::exp(-7 * depth_m / wavelength_m - 1.3 * aside_m / std::max(depth_m, 0.01 * wavelength_m));
}
/// The same of an explosion, as many cells deep and aside.
double shallow_explosion(double depth, double aside) {
  return 0.27 * std::pow(std::max(depth, 0.5), -1.4) * std::exp(-0.5 * aside / std::max(depth, 0.5));
}

/// Kinds of sources by their near fields: those of explosions in rock are balanced (theory.md (A8)).
enum class NearField { of_explosion_in_rock, of_explosion_in_fluid, of_force, of_uneven_moment };

/// Error of the short waves that long steps of fourth order in time sustain, `away` cells from a force: where
/// they turn by a whole period in a step they follow the source as if they were static, and a reconstruction
/// damps them the less the higher its order.
double sustained_by_force(const Discretisation& cells, double away, double per_wave, double courant) {
  if (cells.time_order < 4) return 0;
  const double shorter = std::max(0., 1.9 - courant), of_order = cells.order <= 7   ? 0.2
                                                                 : cells.order == 9 ? 0.22
                                                                                    : 0.42;
  return of_order * std::pow(10 / per_wave, 2) * std::exp(-3 * shorter - (0.16 + 0.5 * shorter) * away);
}

/// What an explosion in few cells sends out as S waves, `away` cells from it, `per_wave` being the cells per
/// wavelength of P.
double shear_of_explosion(double away, double per_wave) {
  return 0.006 * (1 + 5 / away) * std::pow(14.7 / per_wave, 6);
}

/// Error of the near field where normal moments differ by all of them.
double uneven_near_error(double away, double per_wave) { return 300 * per_wave / std::pow(away, 4); }

/// Error of the near field `away` cells from a source in a medium of `per_wave` cells per wavelength and of
/// this Courant number: near fields are static, so the longer waves are, the more counts that the smallest
/// lose.
double near_error(NearField kind, double away, double per_wave, double courant, const Discretisation& cells) {
  const double cubed = per_wave / std::pow(away, 3), shorter = std::clamp(0.9 / courant, 1., 10.);
  switch (kind) {
    case NearField::of_explosion_in_rock:
      return (cells.order >= 9   ? 1.1
              : cells.order >= 7 ? 0.8
                                 : 1.5) *
             cubed / away * std::sqrt(shorter) *
             (cells.time_order < 4 ? 1 : 1 + 1.5 * std::exp(-6 * std::max(0., 1.9 - courant)));
    case NearField::of_explosion_in_fluid:
      return cubed * (1.05 / away + 0.021 * per_wave * std::max(0., 0.9 - courant));
    case NearField::of_force:
      return std::hypot(0.15 * cubed * std::min(3., std::pow(shorter, 1.3)),
                        sustained_by_force(cells, away, per_wave, courant));
    case NearField::of_uneven_moment:
      return uneven_near_error(away, per_wave);
  }
  return 0;
}

/// The largest error of near fields of an explosion in fluid, from one cell away on: beside the source 10 to
/// 35 % of each component were found, whatever the cells. Nearer all may be wrong.
double most_of_near_field(NearField kind, double away) {
  return kind == NearField::of_explosion_in_fluid && away >= 1 ? 0.35 : 1;
}

template <int D>
std::string name_of_edge(int axis, int side) {
  if (axis == D - 1) return side == 0 ? "upper" : "lower";
  if (axis == 0) return side == 0 ? "left" : "right";
  return side == 0 ? "front" : "rear";
}

/// The error of the waves that slipping fractures send out, and their share of all: first estimates, from the
/// figures of docs/accuracy.md. Of the response itself FractureResponse says more.
double slip_error(double cells_per_wavelength, double courant) {
  return 0.11 * std::pow(7.5 / cells_per_wavelength, 1.7) * (0.3 + 0.86 * courant * courant);
}
constexpr double slip_share = 0.1;

}  // namespace

struct ErrorSources::Shot {
  /// What a plane does not know of its scene.
  struct Whole {
    double stable_time_step_s;
    bool slips, in_3d, x_is_known;
  };
  std::vector<FollowedReceiver> followed;
  LocalStack stack;
  const StackResponse& response;  // of the stack
  Recorded recorded = Recorded::velocity;
  double nominal_hz, highest_hz;
  double own_spacing_m;
  bool finer_geometry;
  std::vector<double> weights;           // of receivers, as waves spread besides
  std::vector<double> energies;          // of receivers
  double energy = 0;                     // of all
  std::vector<double> by_face, by_drag;  // squared error per squared metre, at nominal_hz
  double stable_speed = 0;               // of the fastest wave in the model
  bool slips = false;
  double fit_of_quality = 0;             // squared error, times the energy
  double from_beyond = 0;                // of beyond_sides(), the same
  std::optional<Mechanisms> mechanisms;  // of rock that attenuates
  double at_source = 0;                  // change_at_source()
  double unevenness = 0;                 // unevenness_at_source()
  Point<2> source_m{};
  std::vector<Point<2>> receivers_m;  // in 3-D in the plane
  bool in_3d = false, x_is_known = true;
  struct Corners {
    std::size_t first = 0, count = 0;  // number of the first receiver, from 1
    double share = 0;                  // of all receivers
    std::string place;
  } corners;
  struct Edge {
    std::string name;
    double zone_cells;
    std::vector<std::array<double, 2>> along_and_mean_m;  // of receivers
  };
  std::vector<Edge> edges;

  using Responses = std::vector<std::unique_ptr<const StackResponse>>;
  /// Its response is kept in `responses`.
  Shot(const Scene<2>& scene, std::size_t shot, bool finer, Responses& responses)
      : Shot(scene, shot, finer, responses, Whole{stable_time_step_s(scene), scene.slips(), false, true}) {
    const auto all = scene.survey.receivers_of(shot + 1);
    source_m = scene.survey.sources[shot].position_m;
    at_source = change_at_source(scene, shot);
    unevenness = explodes_in_rock() ? unevenness_at_source(scene, shot) : 0;
    for (const auto& receiver : followed) receivers_m.push_back(all[receiver.index].point_m);
    if (const auto found = receivers_in_corners(scene, shot); !found.empty()) {
      const auto& at = all[found[0]].point_m;
      corners = {found[0] + 1, found.size(), double(found.size()) / double(all.size()),
                 "x=" + shown(at[0], 5) + " z=" + shown(at[1], 5)};
    }
    add_edges(scene, scene.survey.sources[shot], receivers_m);
  }
  /// Of some receivers of a shot in 3-D.
  Shot(const Scene<3>& scene, std::size_t shot, const UprightPlane& plane, Responses& responses)
      : Shot(plane.scene, 0, false, responses,
             Whole{stable_time_step_s(scene), scene.slips(), true, plane.along_x}) {
    source_m = plane.scene.survey.sources[0].position_m;
    const auto all = plane.scene.survey.receivers_of(1);
    std::vector<Point<3>> receivers;
    for (const auto& receiver : followed) {
      receivers.push_back(plane.receivers_m[receiver.index]);
      receivers_m.push_back(all[receiver.index].point_m);
    }
    add_edges(scene, scene.survey.sources[shot], receivers);
  }

  /// Takes what of the records counts.
  void count(Recorded what, const std::optional<Attenuation>& attenuation);

  struct Dispersion {
    double p = 0, s = 0, both = 0;
  };
  /// Squared errors, times the energy; unless `by_wave` of all waves together only, in a third of the time.
  Dispersion dispersion(const Discretisation& cells, bool by_wave) const;
  double face_error(std::size_t face, const Discretisation& cells) const;
  double near_field(const Discretisation& cells) const;
  double edge_error(const Edge& edge, const Discretisation& cells) const;
  double slip(const Discretisation& cells) const;
  /// Of waves bound to an interface, where source and receivers are near it.
  double bound_wave(std::size_t face, const Discretisation& cells) const;
  double bent_sides(const LocalInterface& interface) const;
  /// Of an interface that bends where it leaves the model.
  double bent_interfaces(const LocalInterface& interface) const;
  /// Of an interface that dips at a side: what it would reflect from beyond it.
  double beyond_sides(std::size_t face) const;
  /// Squared error, times the energy, of what relaxes at steps alone.
  double relaxation_error(const Discretisation& cells) const;
  double weak_interfaces(const Discretisation& cells) const;
  /// Of a body of another matter beside the way of the waves.
  double body(const Discretisation& cells) const;
  std::string name_of_body() const {
    return "a body of another matter" + (x_is_known ? " between x=" + shown(stack.body->from_x_m, 4) +
                                                          " and " + shown(stack.body->to_x_m, 4)
                                                    : "");
  }
  /// Size of the cells that show where interfaces are, of which `block` a side are alike.
  double geometry_m(const Discretisation& cells, std::int64_t block) const {
    return double(block) * (finer_geometry ? cells.spacing_m : own_spacing_m);
  }
  double shallow_source(const Discretisation& cells) const;
  /// Of an explosion few cells below a free surface, which takes most of what it sends out.
  double weak_explosion(const Discretisation& cells) const;
  bool source_is_force() const { return stack.places.force[0] != 0 || stack.places.force[1] != 0; }
  bool explodes_in_rock() const {
    const auto& places = stack.places;
    return !source_is_force() && places.layers[places.source_layer()].vs > 0;
  }
  NearField near_kind() const {
    const auto& places = stack.places;
    if (source_is_force()) return NearField::of_force;
    if (!(places.layers[places.source_layer()].vs > 0)) return NearField::of_explosion_in_fluid;
    const auto& m = places.moment_rate;
    const double normal = std::abs(m(0, 0) - m(1, 1)), size = std::abs(m(0, 0)) + std::abs(m(1, 1));
    if (normal > 1e-9 * size) return NearField::of_uneven_moment;
    return m(0, 1) == 0 ? NearField::of_explosion_in_rock : NearField::of_force;
  }
  /// How far an interface is from the face that stands for it.
  double offset_m(std::size_t face, const Discretisation& cells) const {
    const auto& interface = stack.interfaces[face];
    const double own = std::abs(interface.true_depth_m - interface.depth_m);
    if (own < 1e-6 * own_spacing_m) return 0;
    if (!finer_geometry) return own;
    const double rows = interface.true_depth_m / cells.spacing_m;
    return std::abs(rows - std::round(rows)) * cells.spacing_m;
  }

 private:
  Shot(const Scene<2>& scene, std::size_t shot, bool finer, Responses& responses, const Whole& whole)
      : followed(followed_receivers(scene, shot, receivers_followed)),
        stack(stack_of(scene, shot, whole, followed)),
        response(*responses.emplace_back(
            std::make_unique<StackResponse>(stack.places, scene.survey.sources[shot].wavelet,
                                            scene.survey.sources[shot].wavelet.highest_frequency_hz(0.01)))),
        nominal_hz(scene.survey.sources[shot].wavelet.nominal_hz()),
        highest_hz(scene.survey.sources[shot].wavelet.highest_frequency_hz(0.01)),
        own_spacing_m(scene.model.grid().spacing_m),
        finer_geometry(finer),
        stable_speed(own_spacing_m / whole.stable_time_step_s),
        slips(whole.slips),
        in_3d(whole.in_3d),
        x_is_known(whole.x_is_known) {
    for (std::size_t r = 0; r < stack.places.receivers.size(); ++r) {
      const auto& at = stack.places.receivers[r];
      weights.push_back(followed[r].count *
                        (whole.in_3d ? 1 / std::max(std::hypot(at.a_m, at.b_m), own_spacing_m) : 1));
    }
  }
  static LocalStack stack_of(const Scene<2>& scene, std::size_t shot, const Whole& whole,
                             const std::vector<FollowedReceiver>& followed);
  /// Of a spectrum at a receiver.
  double energy_of(const RecordSpectrum& spectrum, std::size_t receiver) const {
    return weights[receiver] * response.energy(spectrum, recorded);
  }
  void add_face(std::size_t face);
  /// The absorbing edges, for the receivers that are followed.
  template <int D>
  void add_edges(const Scene<D>& scene, const Source<D>& source, const std::vector<Point<D>>& receivers);
  template <class Of>
  double error_of_speeds(const Of& of) const;
  double quality_error(const Attenuation& attenuation) const;
  /// What a step does to each wave: [direction][2 layer + wave][bin], the logarithm of the factor on it.
  using Steps = std::vector<std::vector<std::vector<Complex>>>;
  Steps steps(const Discretisation& cells) const;
};

void ErrorSources::Shot::count(Recorded what, const std::optional<Attenuation>& attenuation) {
  recorded = what;
  energies.clear();
  by_face.clear();
  by_drag.clear();
  for (std::size_t r = 0; r < weights.size(); ++r) energies.push_back(energy_of(response.records(r), r));
  energy = std::accumulate(energies.begin(), energies.end(), 0.);
  from_beyond = 0;
  for (std::size_t face = 0; face < stack.interfaces.size(); ++face) {
    add_face(face);
    from_beyond += beyond_sides(face);
  }
  if (attenuation) {
    fit_of_quality = quality_error(*attenuation);
    mechanisms = attenuation->mechanisms;
  }
}

/// Squared error, times the energy, of waves in layers that attenuate whose speeds are wrong by a factor of
/// the frequency, of(2 layer + wave)(hz).
template <class Of>
double ErrorSources::Shot::error_of_speeds(const Of& of) const {
  std::vector<std::vector<Complex>> faster(2 * stack.losses.size());
  for (std::size_t n = 0; n < faster.size(); ++n) {
    if (!(stack.losses[n / 2][n % 2] > 0)) continue;
    const auto factor = of(n);
    for (std::size_t bin = 0; bin < response.bins(); ++bin)
      faster[n].push_back(factor(response.omega(bin).real() / (2 * std::numbers::pi)) - 1.);
  }
  double sum = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    RecordSpectrum wrong(response.bins());
    for (std::size_t n = 0; n < faster.size(); ++n) {
      if (faster[n].empty()) continue;
      const auto& change = response.by_speed(n / 2, int(n % 2), r);
      for (std::size_t bin = 0; bin < wrong.size(); ++bin)
        for (const std::size_t c : {0, 1, 2}) wrong[bin][c] += faster[n][bin] * change[bin][c];
    }
    sum += energy_of(wrong, r);
  }
  return sum;
}

/// Waves as they are with relaxation at steps, and what is recorded and put in up to half a step of it early
/// or late.
double ErrorSources::Shot::relaxation_error(const Discretisation& cells) const {
  if (!mechanisms) return 0;
  const double interval_s = cells.time_order == 2 ? 2 * cells.time_step_s : cells.time_step_s;
  const double of_waves = error_of_speeds([&](std::size_t n) {
    return [&, shares = mechanisms->shares(1 / stack.losses[n / 2][n % 2])](double hz) {
      return std::sqrt(mechanisms->stepwise_modulus(shares, hz, interval_s) /
                       mechanisms->modulus(shares, hz));
    };
  });
  const auto& at_source = stack.losses[stack.places.source_layer()];
  const double late = 2 * std::numbers::pi * nominal_hz * interval_s / 8 *
                      std::max(at_source[0], source_is_force() ? at_source[1] : 0);
  return of_waves + late * late * energy;
}

void ErrorSources::Shot::add_face(std::size_t face) {
  double moved = 0, dragged = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    auto change = response.by_face(face, r);
    for (std::size_t bin = 0; bin < change.size(); ++bin) {
      const double hz = response.omega(bin).real() / (2 * std::numbers::pi);
      const double by = std::pow(hz / nominal_hz, shift_of(stack.interfaces[face]).power);
      for (auto& part : change[bin]) part *= by;
    }
    moved += energy_of(change, r);
    if (has_drag(stack.interfaces[face])) dragged += energy_of(response.by_drag(face, r), r);
  }
  by_face.push_back(moved);
  by_drag.push_back(dragged);
}

template <int D>
void ErrorSources::Shot::add_edges(const Scene<D>& scene, const Source<D>& source,
                                   const std::vector<Point<D>>& receivers) {
  const auto& grid = scene.model.grid();
  const auto from = grid.row_coordinates(source.position_m);
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      if (scene.edges[axis][side] != EdgeLaw::absorbing) continue;
      const auto across = std::size_t(axis);
      Edge edge{name_of_edge<D>(axis, side), double(zone_cells(scene, source)), {}};
      const double place = side == 0 ? grid.origin_m[across] : grid.end(axis);
      for (const auto& receiver : receivers) {
        const auto to = grid.row_coordinates(receiver);
        double square = 0;
        for (std::size_t other = 0; other < D; ++other)
          if (other != across) square += std::pow(to[other] - from[other], 2);
        edge.along_and_mean_m.push_back(
            {std::sqrt(square), (std::abs(to[across] - place) + std::abs(from[across] - place)) / 2});
      }
      edges.push_back(std::move(edge));
    }
}

LocalStack ErrorSources::Shot::stack_of(const Scene<2>& scene, std::size_t shot, const Whole& whole,
                                        const std::vector<FollowedReceiver>& followed) {
  auto stack = local_stack(scene, shot, followed);
  auto& places = stack.places;
  places.point_source = whole.in_3d;
  for (auto& interface : stack.interfaces) {
    interface.x_is_known = whole.x_is_known;
    places.drags.push_back(has_drag(interface));
  }
  if (scene.attenuates())
    for (const auto& losses : stack.losses) {
      auto& of = places.losses.emplace_back();
      for (const std::size_t wave : {0, 1})
        of[wave] = [mechanisms = scene.attenuation->mechanisms,
                    shares = scene.attenuation->mechanisms.shares(1 / losses[wave])](double hz) {
          return std::sqrt(mechanisms.modulus(shares, hz));
        };
    }
  return stack;
}

/// Squared error, times the energy, of the difference between mechanisms and a Q that is the same at all
/// frequencies (Kjartansson 1979), with the same speeds at the reference frequency.
double ErrorSources::Shot::quality_error(const Attenuation& attenuation) const {
  return error_of_speeds([&](std::size_t n) {
    const auto& factor = stack.places.losses[n / 2][n % 2];
    const double power = std::atan(stack.losses[n / 2][n % 2]) / std::numbers::pi;
    const auto constant = [power, hz_0 = attenuation.reference_hz](double hz) {
      return std::pow(Complex(0, hz / hz_0), power);
    };
    const auto speed_at = [](const Complex& complex) { return 1 / (1. / complex).real(); };
    // Beside the band speeds are those of a constant Q.
    const double alike_hz = attenuation.mechanisms.speed_known_at(attenuation.reference_hz);
    const double scale = speed_at(factor(alike_hz)) / speed_at(constant(alike_hz));
    return [&factor, constant, scale](double hz) { return factor(hz) / (scale * constant(hz)); };
  });
}

double ErrorSources::Shot::face_error(std::size_t face, const Discretisation& cells) const {
  const auto& interface = stack.interfaces[face];
  const auto shift = shift_of(interface);
  // Cells that are split keep the geometry that there was.
  const double h =
      shift.power > 0 ? cells.spacing_m : std::max(geometry_m(cells, interface.block), cells.spacing_m);
  double slowest = slowest_beside(stack.places, face);
  // Of what an explosion in fluid sends to a soft floor most stays in the fluid.
  if (const auto& fluid = stack.places.layers[stack.places.source_layer()];
      interface.kind == Kind::fluid_solid && !(fluid.vs > 0) && slowest < fluid.vp)
    slowest = std::sqrt(slowest * fluid.vp);
  const double per_wave = slowest / nominal_hz / h;
  double by = shift.share * h * std::pow(per_wave, -shift.power);
  if (shift.power > 0 && interface.kind == Kind::inner) by *= slower_behind(stack.places, face);
  // Long stencils end at interfaces with less harm.
  if (shift.power > 0 && cells.order >= 7) by *= order_7_on_faces;
  if (shift.power > 0 && cells.order >= 9)
    by *= interface.kind == Kind::surface                      ? high_order_at_surfaces
          : interface.kind == Kind::inner && source_is_force() ? high_order_of_forces
                                                               : 1;
  // The long stairs of a plane surface scatter less where waves are longer than some of them.
  if (interface.representation == staircase && interface.kind == Kind::surface &&
      interface.steepest_deg < 14 && !interface.is_curved() &&
      std::tan(radians(interface.steepest_deg)) * per_wave > 2)
    by *= std::min(1., 10 / per_wave);
  if (interface.tilted) by *= std::min(1., cells_of_tilted_means / per_wave);
  if (interface.representation == averaged && interface.stairs < 1e-3)
    by *= std::max(0.1, 4 * interface.cut * (1 - interface.cut));
  const double offset = share_of_offset * offset_m(face, cells),
               bends = shift_in_bends * cells.spacing_m *
                       std::pow(cells.spacing_m * interface.curvature_per_m, 2),
               drag = (interface.kind == Kind::surface ? drag_of_surface_stairs : drag_of_stairs) * h;
  return by_face[face] * (by * by + offset * offset + bends * bends) + by_drag[face] * drag * drag;
}

double ErrorSources::Shot::near_field(const Discretisation& cells) const {
  const auto& places = stack.places;
  const auto& rock = places.layers[places.source_layer()];
  const double h = cells.spacing_m, courant = rock.vp * cells.time_step_s / h;
  const double per_wave = slowest_of(rock) / nominal_hz / h;
  // Of lower orders it is far less than dispersion.
  const bool sheared = cells.order >= 9 && near_kind() == NearField::of_explosion_in_rock;
  const double worse = (cells.order == 3 ? near_of_order_3 : 1) *
                       (source_is_force() && recorded == Recorded::pressure ? near_in_pressure : 1);
  double sum = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const auto& at = places.receivers[r];
    const double own_way = std::hypot(at.a_m, at.b_m) / h, way = std::max(own_way, 1.);
    const double share = near_error(near_kind(), way, per_wave, courant, cells) * worse;
    const double s_waves = sheared ? shear_of_explosion(way, rock.vp / nominal_hz / h) : 0;
    const double uneven =
        unevenness * uneven_near_error(way, per_wave) * std::sqrt(std::max(1., 0.9 / courant));
    sum +=
        std::pow(std::min(most_of_near_field(near_kind(), own_way), std::hypot(share, s_waves, uneven)), 2) *
        energies[r];
  }
  return sum;
}

/// Of waves bound to an interface, over that at order 5.
double bound_at_order(int order, bool floor, bool bent) {
  if (order == 3 && !floor) return bound_at_order_3;
  if (order < 7) return 1;
  if (!floor) return surface_at_order_7;
  return bent && order == 7 ? bent_at_order_7 : bound_at_order_7;
}

double ErrorSources::Shot::bound_wave(std::size_t face, const Discretisation& cells) const {
  const auto& interface = stack.interfaces[face];
  const auto& places = stack.places;
  const auto& below = places.layers[places.free_surface ? face : face + 1];
  const auto& above = places.layers[places.free_surface && face > 0 ? face - 1 : face];
  if (interface.kind == Kind::inner || (interface.kind == Kind::surface && !(below.vs > 0))) return 0;
  const double wavelength = 0.93 * slowest_beside(places, face) / nominal_hz;
  const double coarser = 24 * 0.93 * cells.spacing_m / wavelength;
  const bool floor = interface.kind == Kind::fluid_solid, stairs = interface.representation == staircase;
  const bool bent = !stairs && interface.steepest_deg > 1;
  // Short steps make those along fluid worse.
  const double courant = stable_speed * cells.time_step_s / cells.spacing_m;
  const double steps = floor ? 1 + (bent ? 0.7 : 1.6) * std::max(0., 0.9 - courant) : 1;
  const double at_floor = stairs ? bound_to_stairs : bent ? bound_to_bent_floor : bound_to_floor;
  const bool force = source_is_force();
  // Orders 9 and 11, which fall to 5 there, leave what falls with the square.
  const double finer =
      cells.order >= 9 ? (bent && !force ? 2.4 : 3) * std::pow(coarser, 2) : std::pow(coarser, 3);
  double rate =
      (floor ? at_floor : bound_to_surface) * finer * steps * bound_at_order(cells.order, floor, bent);
  const auto& rock = places.layers[places.source_layer()];
  // An explosion in rock sends out less of them, the less the harder the rock is.
  if (!force && rock.vs > 0)
    rate *= floor ? std::clamp(std::pow(slowest_beside(places, face) / rock.vs, 2), bound_by_explosion, 1.)
                  : bound_by_explosion;
  if (stairs && !floor)
    rate = std::max(
        rate, bound_to_surface_stairs * coarser * std::min(1., interface.steepest_deg / steep_stairs_deg));
  // The slower they are the less far they reach into the fluid.
  const double in_fluid =
      floor ? std::max(bound_decay,
                       std::sqrt(std::max(0., 1 - std::pow(wavelength * nominal_hz / above.vp, 2))))
            : bound_decay;
  const auto decay = [&](double above_m) {
    return above_m > 0 ? in_fluid * above_m : -bound_decay * above_m;
  };
  double sum = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const auto& at = places.receivers[r];
    const double error = rate * std::abs(at.a_m) / wavelength *
                         std::exp(-2 * std::numbers::pi / wavelength *
                                  (decay(places.faces_m[face]) + decay(places.faces_m[face] - at.b_m)));
    sum += std::pow(saturated(error * error), 2) * energies[r];
  }
  return sum;
}

/// Where a fitted surface dips, what comes back from the sides.
double ErrorSources::Shot::bent_sides(const LocalInterface& interface) const {
  const auto& rock = stack.places.layers.front();
  const double depth = std::abs(stack.places.faces_m[0]),
               k = 2 * std::numbers::pi * nominal_hz / slowest_of(rock);
  const double all = rock.vs > 0 ? bent_rock + bent_bound * std::exp(-bound_decay * k * depth) : bent_water;
  const double share = all * std::tan(radians(interface.steepest_deg));
  return share * share * energy;
}

double reflection_of(double contrast) { return 1 - 2 / (contrast + 1); }

double ErrorSources::Shot::bent_interfaces(const LocalInterface& interface) const {
  // Planes of 3-D end elsewhere than the model.
  if (in_3d) return 0;
  const auto& places = stack.places;
  const double wavelength = places.layers[places.source_layer()].vp / nominal_hz;
  double sum = 0;
  for (const auto& side : interface.sides) {
    const double share = bent_interface * (interface.representation == fitted ? bent_fitted : 1) *
                         std::min(std::abs(side.slope), 1.) * reflection_of(interface.contrast);
    const double to_side = std::hypot(side.at_m[0] - source_m[0], side.at_m[1] - source_m[1]);
    for (std::size_t r = 0; r < receivers_m.size(); ++r) {
      const auto& at = receivers_m[r];
      const double back = std::hypot(side.at_m[0] - at[0], side.at_m[1] - at[1]);
      const double way = std::hypot(at[0] - source_m[0], at[1] - source_m[1]);
      if (to_side + back > stable_speed * places.duration_s) continue;
      // As waves spread from the source and from the bend, against the direct ones.
      sum += share * share * energies[r] * wavelength * std::max(way, wavelength) /
             (std::max(to_side, wavelength) * std::max(back, wavelength));
    }
  }
  return sum;
}

/// Each of them counts as moved like those that are followed, by what it reflects: a wave that meets it at
/// the angle a from its normal is late by 2 d cos a of the way there, at the speed that rock has there.
double ErrorSources::Shot::beyond_sides(std::size_t face) const {
  const auto& places = stack.places;
  const std::size_t first = places.free_surface ? 1 : 0;
  if (in_3d || face < first) return 0;
  const auto impedance = [&](std::size_t layer) {
    return places.layers[layer].rho * places.layers[layer].vp;
  };
  const double above = impedance(face - first), below = impedance(face - first + 1);
  const double speed = places.layers[places.source_layer()].vp;
  double sum = 0;
  for (const auto& side : stack.interfaces[face].sides) {
    const LineBeyondSide line{side.at_m,
                              side.at_m[0] > source_m[0],
                              side.slope,
                              std::abs(below - above) / (below + above),
                              places.free_surface && face == first,
                              places.free_surface ? source_m[1] + places.faces_m[0] : 0};
    for (std::size_t r = 0; r < receivers_m.size(); ++r)
      sum += energies[r] * reflected_from_beyond(line, source_m, receivers_m[r], speed * places.duration_s,
                                                 speed / nominal_hz);
  }
  return taken_by_sides * taken_by_sides * sum;
}
double ErrorSources::Shot::weak_interfaces(const Discretisation& cells) const {
  const auto& places = stack.places;
  const bool from_fluid = !(places.layers[places.source_layer()].vs > 0);
  const double d = shift_of_means * std::max(geometry_m(cells, 1), cells.spacing_m);
  double sum = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const double way = std::hypot(places.receivers[r].a_m, places.receivers[r].b_m);
    for (const auto& weak : stack.left_out) {
      const double speed = from_fluid || !(weak.vs > 0) ? weak.vp : weak.vs;
      const double back = std::hypot(way, 2 * weak.away_m);
      if (!(back > 0) || back > stable_speed * places.duration_s) continue;
      const double late = 2 * d * (2 * weak.away_m / back) / speed;
      sum += std::pow(2 * std::numbers::pi * nominal_hz * late * reflection_of(weak.contrast), 2) * way /
             back * energies[r];
    }
  }
  return sum;
}

double ErrorSources::Shot::body(const Discretisation& cells) const {
  if (!stack.body) return 0;
  const auto& body = *stack.body;
  const auto& places = stack.places;
  const double h = std::max(geometry_m(cells, 1), cells.spacing_m);
  double slowest = places.layers.front().vp;
  for (const auto& rock : places.layers) slowest = std::min(slowest, rock.vp);
  const double k = 2 * std::numbers::pi * nominal_hz / slowest;
  const double moved = 2 * k * shift_of_stairs * h, reflects = reflection_of(body.contrast);
  const double away = std::hypot(body.nearest_m[0] - source_m[0], body.nearest_m[1] - source_m[1]);
  double sum = 0;
  for (std::size_t r = 0; r < receivers_m.size(); ++r) {
    const auto& at = receivers_m[r];
    const double back = std::hypot(body.nearest_m[0] - at[0], body.nearest_m[1] - at[1]);
    const double way = std::hypot(at[0] - source_m[0], at[1] - source_m[1]);
    if (away + back > stable_speed * places.duration_s) continue;
    // Less than a Fresnel zone reflects in proportion to its width, from its top and its bottom.
    const double zone = std::sqrt(2 * std::numbers::pi / k * std::max(away * back / (away + back), h));
    const double seen = std::min(1., body.wide_m() / zone);
    sum += 2 * std::pow(moved * reflects * seen, 2) * std::max(way, h) / (away + back) * energies[r];
  }
  return sum;
}

double ErrorSources::Shot::shallow_source(const Discretisation& cells) const {
  const auto& places = stack.places;
  if (!places.free_surface || !(places.layers[0].vs > 0) || places.source_layer() > 0) return 0;
  const double depth = std::abs(places.faces_m[0]), wavelength = places.layers[0].vs / nominal_hz;
  double sum = 0;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const auto& at = places.receivers[r];
    const double aside = std::abs(at.a_m), h = cells.spacing_m;
    const double error = explodes_in_rock() ? shallow_explosion(depth / h, aside / h)
                                            : shallow_error(depth, aside, wavelength);
    if (at.b_m < 0) sum += error * error * energies[r];
  }
  return sum;
}

double ErrorSources::Shot::weak_explosion(const Discretisation& cells) const {
  const auto& places = stack.places;
  if (!places.free_surface || places.source_layer() > 0 || !explodes_in_rock()) return 0;
  const double depth = std::abs(places.faces_m[0]) / cells.spacing_m;
  const double per_wave = places.layers[0].vs / nominal_hz / cells.spacing_m;
  const double share =
      beside_surface * std::pow(24 / per_wave, 2) * std::min(1., std::pow(2.6 / std::max(depth, 1e-3), 1.6));
  return share * share * energy;
}

double ErrorSources::Shot::edge_error(const Edge& edge, const Discretisation& cells) const {
  double sum = 0;
  const double wavelength = stack.places.layers[stack.places.source_layer()].vp / nominal_hz;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const auto& [along, mean] = edge.along_and_mean_m[r];
    const double zone = edge.zone_cells * cells.spacing_m,
                 of_s = source_is_force() ? grazing_share_of_force(along, mean, wavelength, zone) : 0;
    sum +=
        std::pow(all_graze * std::hypot(grazing_share(along, mean, wavelength, zone), of_s), 2) * energies[r];
  }
  return sum;
}

double ErrorSources::Shot::slip(const Discretisation& cells) const {
  if (!slips) return 0;
  double slowest = stack.places.layers.front().vp;
  for (const auto& rock : stack.places.layers)
    if (rock.vs > 0) slowest = std::min(slowest, rock.vs);
  const double courant = stable_speed * cells.time_step_s / cells.spacing_m;
  return std::pow(slip_share * slip_error(slowest / nominal_hz / cells.spacing_m, courant), 2) * energy;
}

ErrorSources::Shot::Steps ErrorSources::Shot::steps(const Discretisation& cells) const {
  const double per_cell = cells.time_step_s / cells.spacing_m;
  Steps all(directions);
  for (std::size_t n = 0; n < directions; ++n) {
    const double angle = (double(n) + 0.5) / directions * std::numbers::pi / 2;
    for (const auto& rock : stack.places.layers)
      for (const auto kind : {WaveKind::p, WaveKind::s}) {
        auto& of = all[n].emplace_back(response.bins());
        const double speed = kind == WaveKind::p ? rock.vp : rock.vs;
        if (!(speed > 0)) continue;
        const UniformScheme scheme{cells.order, rock.vp * per_cell, rock.vs * per_cell, cells.time_order};
        const auto at = [&](std::size_t bin) {
          const double per_wave = 2 * std::numbers::pi * speed / response.omega(bin).real() / cells.spacing_m;
          // Waves shorter than two cells are not on the grid at all: they are lost.
          return per_wave <= 2.05 ? Complex(-1, 0) : std::conj(step_error(scheme, kind, per_wave, angle));
        };
        // From one of some frequencies to the next on a straight line.
        const auto apart = 1 + of.size() / frequencies;
        for (std::size_t bin = 0; bin < of.size(); ++bin) {
          const auto from = bin % apart;
          if (from == 0) of[bin] = at(bin);
          const auto next = std::min(bin - from + apart, of.size() - 1);
          if (from == 0 && next > bin) of[next] = at(next);
          if (from > 0 && bin < next)
            of[bin] =
                of[bin - from] + double(from) / double(next - (bin - from)) * (of[next] - of[bin - from]);
        }
      }
  }
  return all;
}

ErrorSources::Shot::Dispersion ErrorSources::Shot::dispersion(const Discretisation& cells,
                                                              bool by_wave) const {
  const auto& places = stack.places;
  const auto all = steps(cells);
  const double dt = cells.time_step_s, margin = cells.order >= 9 ? of_high_orders : dispersion_margin;
  Dispersion sum;
  for (std::size_t r = 0; r < energies.size(); ++r) {
    const auto& at = places.receivers[r];
    const double way = std::max(std::hypot(at.a_m, at.b_m), cells.spacing_m);
    // The direction of the direct wave from the vertical counts as much as all others.
    const double own = std::asin(std::abs(std::sin(std::atan2(at.a_m, at.b_m) - radians(stack.dip_deg))));
    const auto direct = std::min(directions - 1, std::size_t(own / (std::numbers::pi / 2) * directions));
    for (std::size_t n = 0; n < directions; ++n) {
      std::array<RecordSpectrum, 3> wrong;
      wrong.fill(RecordSpectrum(response.bins()));
      for (std::size_t m = 0; m < all[n].size(); ++m) {
        const auto& rock = places.layers[m / 2];
        const double speed = m % 2 == 0 ? rock.vp : rock.vs;
        if (!(speed > 0)) continue;
        const double count = way / speed / dt;
        const auto& change = response.by_speed(m / 2, int(m % 2), r);
        for (std::size_t bin = 0; bin < response.bins(); ++bin) {
          // By which share the wave is slower: the imaginary part is loss. No wave is more wrong than absent.
          const auto whole = count * all[n][m][bin];
          const double size = std::abs(whole);
          const auto limited =
              whole * (size < 0.1 ? 1 + whole.real() / 2 : std::abs(std::exp(whole) - 1.) / size);
          const auto slower = limited / (count * dt) * Complex(0, 1) / response.omega(bin).real();
          for (const auto of : {m % 2, std::size_t(2)})
            for (const std::size_t c : {0, 1, 2}) wrong[of][bin][c] -= slower * change[bin][c];
        }
      }
      const double weight = (0.5 / directions + (n == direct ? 0.5 : 0)) * margin * margin;
      sum.both += weight * energy_of(wrong[2], r);
      if (!by_wave) continue;
      sum.p += weight * energy_of(wrong[0], r);
      sum.s += weight * energy_of(wrong[1], r);
    }
  }
  return sum;
}

namespace {

/// Pressure counts by itself, all else as velocities do.
std::vector<Recorded> counted(const std::vector<Component>& components) {
  const auto pressures = std::count(components.begin(), components.end(), Component::p);
  std::vector<Recorded> all;
  if (pressures < std::ptrdiff_t(components.size()) || components.empty()) all.push_back(Recorded::velocity);
  if (pressures > 0) all.push_back(Recorded::pressure);
  return all;
}

}  // namespace

ErrorSources::ErrorSources(const Scene<2>& scene, bool finer_geometry) {
  const auto& sources = scene.survey.sources;
  if (scene.survey.any_receiver()) {
    const std::size_t stride =
        std::max<std::size_t>(1, (sources.size() + shots_followed - 1) / shots_followed);
    for (std::size_t n = stride / 2; n < sources.size(); n += stride)
      if (point_injection(sources[n])) add(Shot(scene, n, finer_geometry, responses_), scene);
    if (shots_.empty()) not_covered_.emplace_back("interfaces and reflected waves of a plane wave");
  }
  note_left_out(scene.recording.duration_s);
  if (scene.slips())
    not_covered_.emplace_back("how strong the waves of slipping fractures are (taken as 10 %)");
}

ErrorSources::ErrorSources(const Scene<3>& scene) {
  const auto& sources = scene.survey.sources;
  bool across = false;
  if (scene.survey.any_receiver()) {
    const std::size_t stride =
        std::max<std::size_t>(1, (sources.size() + shots_followed - 1) / shots_followed);
    for (std::size_t n = stride / 2; n < sources.size(); n += stride)
      for (const auto& plane : upright_planes(scene, n, receivers_followed)) {
        across = across || plane.moves_across;
        if (!plane.still) add(Shot(scene, n, plane, responses_), scene);
      }
    if (shots_.empty() && !across)
      not_covered_.emplace_back("interfaces and reflected waves of a plane wave");
  }
  note_left_out(scene.recording.duration_s);
  if (!shots_.empty()) not_covered_.emplace_back("slopes across the vertical planes of source and receivers");
  const auto dips = [](const auto& shot) {
    const auto& all = shot->stack.interfaces;
    return std::any_of(all.begin(), all.end(), [](const auto& face) { return face.steepest_deg > 1; });
  };
  if (std::any_of(shots_.begin(), shots_.end(), dips))
    not_covered_.emplace_back("interfaces that bend at the sides of the model");
  if (across) not_covered_.emplace_back("SH waves");
  if (scene.slips())
    not_covered_.emplace_back("how strong the waves of slipping fractures are (taken as 10 %)");
}

template <int D>
void ErrorSources::add(const Shot& shot, const Scene<D>& scene) {
  recorded_ = counted(scene.recording.components);
  const auto attenuation = scene.attenuates() ? scene.attenuation : std::nullopt;
  for (const auto what : recorded_)
    shots_.emplace_back(std::make_unique<Shot>(shot))->count(what, attenuation);
}

/// What the layers round the sources do not tell.
void ErrorSources::note_left_out(double duration_s) {
  std::size_t left_out = 0;
  bool curved = false, cut = false;
  for (const auto& shot : shots_) {
    left_out = std::max(left_out, shot->stack.left_out.size());
    for (const auto& interface : shot->stack.interfaces) curved = curved || interface.is_curved();
    if (shot->response.seconds() < 0.999 * duration_s && !cut)
      not_covered_.push_back("waves after " + shown(shot->response.seconds(), 2) + " s");
    cut = cut || shot->response.seconds() < 0.999 * duration_s;
  }
  for (const auto& shot : shots_) {
    const auto& corners = shot->corners;
    if (corners.count == 0) continue;
    const auto others = corners.count > 1 ? " and " + std::to_string(corners.count - 1) + " others" : "";
    not_covered_.push_back("how wrong receiver " + std::to_string(corners.first) + " at " + corners.place +
                           others + (corners.count > 1 ? " are" : " is") +
                           ", in a corner of a staircase where motion can be several times too large: " +
                           fit_of(Kind::fluid_solid, shot->stack.maker));
    break;
  }
  for (const auto& shot : shots_)
    if (shot->stack.body) {
      not_covered_.push_back("waves that stay within " + shot->name_of_body());
      break;
    }
  if (left_out > 0)
    not_covered_.push_back(std::to_string(left_out) + " weak interfaces or parts of gradients");
  if (curved) not_covered_.emplace_back("focusing by curved interfaces");
}
ErrorSources::~ErrorSources() = default;
ErrorSources::ErrorSources(ErrorSources&&) noexcept = default;
ErrorSources& ErrorSources::operator=(ErrorSources&&) noexcept = default;

namespace {

/// Causes by name, with squared errors times energies.
class Sum {
 public:
  void add(ErrorCause cause, double squared) {
    for (auto& known : causes_)
      if (known.name == cause.name) {
        known.error += squared;
        return;
      }
    cause.error = squared;
    causes_.push_back(std::move(cause));
  }
  /// `floor` and `all` get the sums over causes that are not curable and over all.
  std::vector<ErrorCause> take(double energy) {
    for (auto& cause : causes_) cause.error = saturated(cause.error / energy);
    std::stable_sort(causes_.begin(), causes_.end(),
                     [](const ErrorCause& a, const ErrorCause& b) { return a.error > b.error; });
    std::erase_if(causes_, [](const ErrorCause& cause) { return !(cause.error > 0); });
    return std::move(causes_);
  }

 private:
  std::vector<ErrorCause> causes_;
};

std::string cells_per_wave(const LayeredPlaces& places, bool shear, double hz, double spacing_m) {
  double slowest = 1e30;
  for (const auto& rock : places.layers) {
    const double speed = shear ? rock.vs : rock.vp;
    if (speed > 0) slowest = std::min(slowest, speed);
  }
  return std::string(shear ? "S" : "P") + " waves, " + shown(slowest / hz / spacing_m, 2) +
         " cells per shortest wavelength";
}

}  // namespace

/// What all causes add up to: squared errors times energies.
struct ErrorSources::Sums {
  double energy = 0, all = 0, floor = 0, slip = 0, sides = 0;
  Sum causes;
  void add(ErrorCause cause, double squared) {
    all += squared;
    if (!cause.curable) floor += squared;
    causes.add(std::move(cause), squared);
  }
  double without_slip() const { return energy > 0 ? saturated((all - slip - sides) / energy) : 0; }
};

void ErrorSources::add_dispersion(const Shot& shot, const Discretisation& cells, Sums& sums) {
  const auto of = shot.dispersion(cells, true);
  const auto& places = shot.stack.places;
  sums.all += of.both;
  sums.causes.add({cells_per_wave(places, false, shot.highest_hz, cells.spacing_m), "", 0, true}, of.p);
  sums.causes.add({cells_per_wave(places, true, shot.highest_hz, cells.spacing_m), "", 0, true}, of.s);
}

void ErrorSources::add_interfaces(const Shot& shot, const Discretisation& cells, Sums& sums) {
  const auto& stack = shot.stack;
  for (std::size_t face = 0; face < shot.by_face.size(); ++face)
    sums.add(
        cause_of(stack.interfaces[face], stack.maker, shot.finer_geometry, shot.offset_m(face, cells) > 0),
        shot.face_error(face, cells));
  for (std::size_t face = 0; face < shot.by_face.size(); ++face)
    sums.add({"waves along the " + stack.interfaces[face].name(), "", 0, true}, shot.bound_wave(face, cells));
  for (const auto& interface : stack.interfaces)
    if (interface.kind == Kind::surface && interface.representation == fitted && interface.steepest_deg > 1)
      sums.add(
          {"waves along the fitted surface that come back from the sides", "move the sides away", 0, false},
          shot.bent_sides(interface));
  sums.sides += shot.from_beyond;
  sums.add({"reflections from beyond the sides of the model, where interfaces dip", "move the sides away", 0,
            false},
           shot.from_beyond);
  for (const auto& interface : stack.interfaces) {
    const double bent = shot.bent_interfaces(interface);
    sums.sides += bent;
    sums.add({"interfaces that are level beyond the sides of the model, and bend there",
              "move the sides away", 0, false},
             bent);
  }
  sums.add({"weak interfaces", "", 0, shot.finer_geometry}, shot.weak_interfaces(cells));
  if (stack.body)
    sums.add({shot.name_of_body() + ", a staircase", "smaller cells of the model", 0, shot.finer_geometry},
             shot.body(cells));
}

void ErrorSources::add_all_else(const Shot& shot, const Discretisation& cells, Sums& sums) {
  sums.add({"waves straight up from a shallow source", "", 0, shot.explodes_in_rock()},
           shot.shallow_source(cells));
  sums.add({"an explosion beside a free surface", "", 0, true}, shot.weak_explosion(cells));
  sums.add({"near fields of the source", "", 0, true}, shot.near_field(cells));
  sums.add({"rock that changes within a cell of the source", "move it, or make the model in smaller cells", 0,
            shot.finer_geometry},
           std::pow(shot.at_source, 2) * shot.energy);
  if (shot.corners.count > 0)
    sums.add({"receivers in corners of a staircase", fit_of(Kind::fluid_solid, shot.stack.maker), 0, false},
             std::pow(too_much_in_corners, 2) * shot.corners.share * shot.energy);
  for (const auto& edge : shot.edges)
    sums.add({"waves that graze the " + edge.name + " absorbing edge", "move the edge away", 0, false},
             shot.edge_error(edge, cells));
  sums.add({"attenuation, which acts once a step", "", 0, true}, shot.relaxation_error(cells));
  sums.add({"fit of Q by mechanisms", "--q-mechanisms, --q-band", 0, false}, shot.fit_of_quality);
  const double slip = shot.slip(cells);
  sums.slip += slip;
  sums.add({"slip of fractures", "shorter time steps", 0, true}, slip);
}

ErrorSources::Sums ErrorSources::sums_apart_from_dispersion(Recorded what,
                                                            const Discretisation& cells) const {
  Sums sums;
  for (const auto& shot : shots_) {
    if (shot->recorded != what) continue;
    sums.energy += shot->energy;
    add_interfaces(*shot, cells, sums);
    add_all_else(*shot, cells, sums);
  }
  return sums;
}

PromisedError ErrorSources::promised(const Discretisation& cells) const {
  PromisedError promise;
  double without_slip = 0;
  for (const auto what : recorded_) {
    auto sums = sums_apart_from_dispersion(what, cells);
    if (!(sums.energy > 0)) continue;
    for (const auto& shot : shots_)
      if (shot->recorded == what) add_dispersion(*shot, cells, sums);
    without_slip = std::max(without_slip, sums.without_slip());
    if (const double error = saturated(sums.all / sums.energy); error > promise.error)
      promise = {error, 0, saturated(sums.slip / sums.energy), saturated(sums.floor / sums.energy),
                 sums.causes.take(sums.energy)};
  }
  promise.without_slip = without_slip;
  return promise;
}

double ErrorSources::without_slip(const Discretisation& cells, double most) const {
  double error = 0;
  for (const auto what : recorded_) {
    auto sums = sums_apart_from_dispersion(what, cells);
    for (const auto& shot : shots_) {
      error = std::max(error, sums.without_slip());
      if (error > most) return error;
      if (shot->recorded == what) sums.all += shot->dispersion(cells, false).both;
    }
    error = std::max(error, sums.without_slip());
  }
  return error;
}

double ErrorSources::apart_from_dispersion(const Discretisation& cells) const {
  double most = 0;
  for (const auto what : recorded_)
    most = std::max(most, sums_apart_from_dispersion(what, cells).without_slip());
  return most;
}

std::string sentence_of(const ErrorCause& cause) {
  return percent(cause.error) + ": " + cause.name + (cause.curable ? "" : ", however fine the cells") +
         (cause.remedy.empty() ? "" : "; " + cause.remedy);
}

}  // namespace slipwave
