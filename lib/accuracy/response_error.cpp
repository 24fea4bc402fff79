// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/response_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "accuracy/grazing.hpp"
#include "accuracy/patch_slip.hpp"
#include "accuracy/straight_way.hpp"
#include "base/error.hpp"
#include "grid/locate.hpp"
#include "model/anisotropy.hpp"
#include "model/cluster_edge.hpp"
#include "model/parted_faces.hpp"
#include "model/single_fracture.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;
using Tensor = SymmetricTensor<2, double>;

constexpr std::size_t shots_followed = 2, receivers_followed = 10;
/// Patches of a shot at most, and their size in dominant wavelengths of the slowest wave.
constexpr double most_patches = 250, patch_wavelengths = 0.25;
/// Directions of travel, over a quarter circle, that dispersion is computed for, and frequencies.
constexpr std::size_t directions = 7, frequencies = 24;
/// Logarithm of the factor on waves that are not on the grid at all.
constexpr double lost = -1e3;

// Fitted to the errors of drawn scenes against converged ones (docs/accuracy.md).
/// (S32): errors of what a patch sends out by the time step, in second order of the centred correction and of
/// springs, and in first order of the others; and by the cells.
constexpr double late_centred = 0.8, late_others = 0.6, late_springs = 1.6;
constexpr double of_cells = 0.156, of_cells_springs = 0.08, cells_power = 1.5;
/// Behind springs that slow a wave down fractures add the late wave less the one without them: the energy of
/// two waves, of which one has the error of the time step.
constexpr double of_transmitted = 0.7;
/// How many times as much as the rock springs give that hardly let waves out again.
constexpr double kept_in = 50;
/// Friction that this is of, and the power of another; and the least that counts.
constexpr double usual_friction = 0.3, friction_power = 0.65, least_friction = 0.05;
/// Where planes carry little of the shear stress of a wave errors of all of it count, up to so many times.
constexpr double most_sheared = 2.5;
/// Without a static stress what edges send back, however little, decides whether planes that have slid hold
/// or continue: of their waves, for edges of one wavelength of P waves.
constexpr double of_edges = 0.004;
/// What (S9) leaves of a row of cells, over the rows that lie across the cluster.
constexpr double of_row = 0.19, of_row_first = 0.64;
/// Cells over which single fractures feel what they send out (S33a), fitted to boundary elements
/// (docs/slip.md). The mean distance of two points drawn from the shares of (S30) is 0.57.
constexpr double felt_over = 0.45;

double dot(const Point<2>& a, const Point<2>& b) { return a[0] * b[0] + a[1] * b[1]; }
Point<2> across(const Point<2>& n) { return {n[1], -n[0]}; }
template <class Number>
std::array<Number, 2> times(const SymmetricTensor<2, Number>& tensor, const Point<2>& n) {
  return {tensor(0, 0) * n[0] + tensor(0, 1) * n[1], tensor(1, 0) * n[0] + tensor(1, 1) * n[1]};
}

/// Part of a cluster or of single fractures, taken as one source in its middle.
struct Patch {
  Point<2> middle_m{};
  double cells = 0;     // of a cluster
  double rows = 0;      // of fractured cells across the cluster, summed over the cells
  std::size_t set = 0;  // of the model
  std::vector<FracturePiece> pieces = {};
};
using PatchKey = std::array<std::int64_t, 3>;
PatchKey patch_at(std::size_t set, const Point<2>& point, double side_m) {
  return {std::int64_t(set), std::int64_t(std::floor(point[0] / side_m)),
          std::int64_t(std::floor(point[1] / side_m))};
}

/// Media of ways: those whose speeds differ by less than a tenth count as one.
class Media {
 public:
  std::size_t index_of(double vp, double vs) {
    const auto [at, is_new] = known_.try_emplace({class_of(vp), class_of(vs)}, speeds_.size());
    if (is_new) speeds_.push_back({vp, vs});
    return at->second;
  }
  const std::vector<Speeds>& speeds() const { return speeds_; }

 private:
  static int class_of(double speed) { return speed > 0 ? int(std::lround(std::log(speed) / 0.1)) : -1; }
  std::map<std::pair<int, int>, std::size_t> known_;
  std::vector<Speeds> speeds_;
};

/// A straight way of one kind of wave.
struct Leg {
  std::vector<std::pair<std::size_t, double>> media;  // seconds in each
  WaveKind kind = WaveKind::p;
  double time_s = 0;
  Point<2> direction{};
  double in_springs_s = 0;  // time in springs of clusters, times how much more than the rock they give
  double slower = 1;        // at most, there
};

/// A wave that comes to a patch.
struct Incoming {
  Leg leg;
  double arrives_s = 0;  // after t = 0
  Tensor stress;         // per unit of the history, Pa
};

/// Where slip gathers: of planes along the rim of a cluster, or across it, which let no shear stress in.
struct Rim {
  double askew = 1;        // the square of the sine of twice their angle from it; 1: no slip gathers
  double relaxes_s = 0;    // time of relaxation of the shear stress on them under pressure
  double dry_share = 0;    // of the time, in tension
  double shear_speed = 0;  // m/s
};

/// The planes of a patch under a wave.
struct Planes {
  bool single = false;
  bool slide = false;
  double sheared = 1;   // the wave's largest shear stress over that on the planes
  double friction = 0;  // the largest
  double soft = 0;      // of springs, the share of a strain that they take
  Rim rim = {};
};

/// From the source by a patch to a receiver.
struct Contribution {
  std::size_t in, out;  // legs
  std::size_t patch, receiver;
  double speed;                             // of the wave that goes out
  Point<2> moves;                           // unit vector
  std::array<Complex, frequencies> wave{};  // along it
  std::array<Complex, frequencies> off{};   // what smearing takes of it, per metre
  Point<2> slowness;                        // by which its time changes with the place of the patch, s/m
  std::size_t planes;
};

/// Cells in a row and in a column of one set through each fractured cell; the fewer of both: how many rows
/// of cells lie across the cluster there.
std::vector<std::int64_t> rows_across(const Model<2>& model) {
  const auto& grid = model.grid();
  std::vector<std::int64_t> fewest(model.fracture.size(), 0);
  for (const int axis : {0, 1}) {
    const auto along = std::size_t(axis), other = 1 - along;
    for (std::int64_t line = 0; line < grid.shape[other]; ++line)
      for (std::int64_t n = 0, end = 0; n < grid.shape[along]; n = end) {
        const auto cell = [&](std::int64_t at) {
          Index<2> index{};
          index[along] = at, index[other] = line;
          return std::size_t(grid.flat(index));
        };
        const auto code = model.fracture[cell(n)];
        for (end = n; end < grid.shape[along] && model.fracture[cell(end)] == code;) ++end;
        if (code == 0) continue;
        for (auto at = n; at < end; ++at) {
          auto& count = fewest[cell(at)];
          count = axis == 0 ? end - n : std::min(count, end - n);
        }
      }
  }
  return fewest;
}

/// Whether a cell is one of a cluster, not beside a single fracture.
bool is_of_cluster(const Model<2>& model, std::size_t cell) {
  const auto code = model.fracture[cell];
  return code != 0 && model.fracture_sets[code - 1U].traces.empty();
}

/// Single fractures in pieces of at most a side.
void add_pieces(const FractureSet<2>& set, std::size_t number, double side_m,
                std::map<PatchKey, Patch>& found) {
  for (const auto& trace : set.traces) {
    const double whole_m = length_of(trace);
    for (std::size_t n = 1; n < trace.size(); ++n) {
      const auto &from = trace[n - 1], &to = trace[n];
      const double length_m = std::hypot(to[0] - from[0], to[1] - from[1]);
      const int parts = int(std::ceil(length_m / side_m));
      const Point<2> normal = {(from[1] - to[1]) / length_m, (to[0] - from[0]) / length_m};
      for (int part = 0; part < parts; ++part) {
        const double at = (part + 0.5) / parts;
        const Point<2> middle = {from[0] + at * (to[0] - from[0]), from[1] + at * (to[1] - from[1])};
        auto& patch = found[patch_at(number, middle, side_m)];
        // Until all pieces are known, sums over their lengths.
        for (const std::size_t axis : {0, 1}) patch.middle_m[axis] += middle[axis] * length_m / parts;
        patch.set = number;
        patch.pieces.push_back({normal, length_m / parts, whole_m});
      }
    }
  }
}

std::vector<Patch> patches_of(const Model<2>& model, double side_m) {
  const auto& grid = model.grid();
  const auto rows = rows_across(model);
  std::map<PatchKey, Patch> found;
  for (std::size_t n = 0; n < model.fracture_sets.size(); ++n)
    add_pieces(model.fracture_sets[n], n, side_m, found);
  for (std::size_t n = 0; n < model.fracture.size(); ++n) {
    if (!is_of_cluster(model, n)) continue;
    const auto at = grid.index(std::int64_t(n));
    const Point<2> middle = {grid.centre(0, at[0]), grid.depth(at)};
    const std::size_t set = model.fracture[n] - std::size_t{1};
    auto& patch = found[patch_at(set, middle, side_m)];
    const double share = fracture_share_of(model, n);
    for (const std::size_t axis : {0, 1}) patch.middle_m[axis] += share * middle[axis];
    patch.cells += share;
    patch.rows += double(rows[n]);
    patch.set = set;
  }
  std::vector<Patch> patches;
  for (auto& [key, patch] : found) {
    double whole = patch.cells;
    for (const auto& piece : patch.pieces) whole += piece.length_m;
    for (auto& place : patch.middle_m) place /= whole;
    patches.push_back(patch);
  }
  return patches;
}

UniformMedium rock_at(const Medium<2>& medium, const Point<2>& point) {
  const auto cell = std::size_t(medium.grid().flat(cell_of(medium.grid(), point)));
  return {double(medium.vp[cell]), double(medium.vs[cell]), double(medium.rho[cell])};
}

/// The stress of a wave of unit velocity that travels along n.
Tensor stress_of(const UniformMedium& rock, WaveKind kind, const Point<2>& n, double velocity) {
  const double mu = rock.mu(), lambda = rock.lambda();
  Tensor stress;
  const auto t = across(n);
  for (const int i : {0, 1})
    for (int j = i; j < 2; ++j) {
      const auto a = std::size_t(i), b = std::size_t(j);
      stress(i, j) =
          -velocity * (kind == WaveKind::p ? ((i == j ? lambda : 0) + 2 * mu * n[a] * n[b]) / rock.vp
                                           : mu * (n[a] * t[b] + t[a] * n[b]) / rock.vs);
    }
  return stress;
}

/// Rims of boxes lie along the axes. `stress`: the largest of the wave.
Rim rim_of(const FractureSet<2>& set, const UniformMedium& rock, const Tensor& stress,
           const Tensor& prestress) {
  Rim rim;
  for (const auto& system : set.systems) {
    const double askew = std::min(1., std::pow(2 * system.normal[0] * system.normal[1], 2));
    if (!system.slides() || askew > rim.askew) continue;
    Point<2> tau{};
    const double wave = std::abs(resolve<2, double>(system.normal, stress, tau)),
                 before = resolve<2, double>(system.normal, prestress, tau);
    const double strength = system.friction * std::max(wave / 2 - before, 0.) + system.strength_pa;
    rim = {askew, system.viscosity_s * strength / rock.mu(), wave > -before ? 0.5 : 0, rock.vs};
  }
  return rim;
}

Planes planes_of(const FractureSet<2>& set, const UniformMedium& rock, const Tensor& stress) {
  Planes planes{!set.traces.empty(), slides(set)};
  if (planes.single) return planes;
  const double most = std::hypot((stress(0, 0) - stress(1, 1)) / 2, stress(0, 1));
  double on_planes = 0;
  for (const auto& system : set.systems) {
    Point<2> tau{};
    resolve<2, double>(system.normal, stress, tau);
    on_planes = std::max(on_planes, length<2, double>(tau));
    planes.friction = std::max(planes.friction, system.friction);
    const auto springs = compliance_in(system.compliance, rock.lambda(), rock.mu());
    for (const double give :
         {rock.mu() * springs.tangential, (rock.lambda() + 2 * rock.mu()) * springs.normal})
      planes.soft = std::max(planes.soft, give / (1 + give));
  }
  planes.sheared = most / std::max(on_planes, most / most_sheared);
  return planes;
}

}  // namespace

struct FractureResponse::Shot {
  std::vector<Patch> patches;
  std::vector<Point<2>> receivers_m;
  std::vector<Leg> legs;
  std::vector<Contribution> contributions;
  std::vector<Planes> planes;
  Media media;
  std::vector<double> hz;
  WaveHistory history;
  double patch_m = 0, nominal_hz = 0;
  double slowest = 0;   // S waves in fractured rock, m/s
  double fastest = 0;   // P waves
  double across_m = 0;  // of the cluster
  double own_spacing_m = 0;
  bool springs = false;  // of any cluster
  struct Edge {
    std::size_t axis;
    double place_m;
  };
  std::vector<Edge> absorbing;

  Shot(const Scene<2>& scene, std::size_t shot);

  /// Squared errors, times the energy, and that.
  struct Sums {
    double energy = 0;
    double incoming = 0, p = 0, s = 0, dispersion = 0;  // that of all together last
    double late = 0, cells = 0, rows = 0, edges = 0;
    double sliding = 0;        // the part of the energy that planes send out which slide
    double contributions = 0;  // the same, whatever their phases
    Sums& operator+=(const Sums& other);
  };
  Sums sums(const ResponseSetting& setting) const;
  /// Whether anything of it comes to a receiver in time.
  bool is_heard() const;
  /// Whether a wave would, if the planes slipped or gave way under the waves that come to them.
  bool is_in_time() const { return !contributions.empty(); }

 private:
  void add_contributions(const Scene<2>& scene, std::size_t patch, const std::vector<Incoming>& waves);
  /// Of all of the patch, under a wave of that stress per unit of its history.
  SmearedMoment moment_of(const Patch& patch, const FractureSet<2>& set, const UniformMedium& rock,
                          const Tensor& stress, const Tensor& prestress) const;
  std::vector<Incoming> incoming(const Scene<2>& scene, const Source<2>& source, const Patch& patch);
  /// From a place, or to it where waves are plane and come from outside.
  std::optional<Leg> leg(const Scene<2>& scene, WayOfWave way, WaveKind kind, const Point<2>& along,
                         const Point<2>& from, double length_m);
  double at_edges(const Contribution& of, const ResponseSetting& setting) const;
};

std::optional<Leg> FractureResponse::Shot::leg(const Scene<2>& scene, WayOfWave way, WaveKind kind,
                                               const Point<2>& along, const Point<2>& from, double length_m) {
  if (way.empty()) return std::nullopt;
  Leg leg{{}, kind, 0, along};
  const auto& model = scene.model;
  const double h = model.grid().spacing_m;
  const auto parts = springs ? std::int64_t(std::ceil(length_m / h)) : 0;
  for (std::int64_t n = 0; n < parts; ++n) {
    const double at_m = (double(n) + 0.5) / double(parts) * length_m;
    const Point<2> at = {from[0] + at_m * along[0], from[1] + at_m * along[1]};
    const auto cell = std::size_t(model.grid().flat(cell_of(model.grid(), at)));
    if (!is_of_cluster(model, cell)) continue;
    const auto rock = rock_at(model.medium, at);
    const auto slower =
        slower_in_springs(model.fracture_sets[model.fracture[cell] - 1U], rock, along, nominal_hz);
    const double times = kind == WaveKind::p ? slower.p : slower.s;
    if (times == 1) continue;
    const double rock_s = length_m / double(parts) / (kind == WaveKind::p ? rock.vp : rock.vs);
    // What springs add; the way through the rock is there.
    way.add(rock.vp / slower.p, rock.vs / slower.s, rock_s * (times - 1));
    leg.in_springs_s += rock_s * times * (times * times - 1);
    leg.slower = std::max(leg.slower, times);
  }
  leg.time_s = way.time_s();
  for (const auto& medium : way.media())
    leg.media.emplace_back(media.index_of(medium.vp, medium.vs), medium.time_s);
  return leg;
}

/// Waves of a point source come with its radiation and spreading.
std::vector<Incoming> FractureResponse::Shot::incoming(const Scene<2>& scene, const Source<2>& source,
                                                       const Patch& patch) {
  const auto& medium = scene.model.medium;
  const auto here = rock_at(medium, patch.middle_m);
  const auto& at = source.position_m;
  const Point<2> way_m = {patch.middle_m[0] - at[0], patch.middle_m[1] - at[1]};
  std::vector<Incoming> waves;
  if (const auto* plane = std::get_if<PlaneWave<2>>(&source.mechanism)) {
    const auto kind = plane->shear ? WaveKind::s : WaveKind::p;
    const auto& n = plane->direction;
    const auto way = way_in_of_plane_wave(scene, source, *plane, patch.middle_m);
    const double inside_m = way_in_model_m(scene.model.grid(), patch.middle_m, n);
    const Point<2> entry = {patch.middle_m[0] - inside_m * n[0], patch.middle_m[1] - inside_m * n[1]};
    if (const auto in = leg(scene, way, kind, n, entry, inside_m))
      waves.push_back({*in, dot(way_m, n) / plane->speed(here.vp, here.vs) + in->time_s - way.time_s(),
                       stress_of(here, kind, n, source.amplitude)});
    return waves;
  }
  const double r = std::max(std::hypot(way_m[0], way_m[1]), 1e-3);
  const Point<2> n = {way_m[0] / r, way_m[1] / r};
  const auto injection = *point_injection(source);
  const auto there = rock_at(medium, at);
  const auto pull = times(injection.moment_rate, n);
  for (const auto kind : {WaveKind::p, WaveKind::s}) {
    const double c = kind == WaveKind::p ? there.vp : there.vs;
    const auto in = leg(scene, straight_way(medium, at, patch.middle_m, kind), kind, n, at, r);
    if (!in || !(c > 0)) continue;
    const auto moves = kind == WaveKind::p ? n : across(n);
    // Far field of (A4) and (A5): |H0(2)(k r)|/4, and a factor k of a moment.
    const double size =
        (dot(injection.force, moves) * std::pow(c, -1.5) + dot(pull, moves) * std::pow(c, -2.5)) * 0.25 *
        std::sqrt(2 / (std::numbers::pi * r)) / there.rho;
    if (size != 0) waves.push_back({*in, in->time_s, stress_of(here, kind, n, size)});
  }
  return waves;
}

SmearedMoment FractureResponse::Shot::moment_of(const Patch& patch, const FractureSet<2>& set,
                                                const UniformMedium& rock, const Tensor& stress,
                                                const Tensor& prestress) const {
  SmearedMoment sum{MomentSpectrum(frequencies), MomentSpectrum(frequencies)};
  const auto add = [](MomentSpectrum& to, const MomentSpectrum& from, double times_it) {
    for (std::size_t f = 0; f < frequencies; ++f)
      for (std::size_t c = 0; c < 3; ++c) to[f].values[c] += times_it * from[f].values[c];
  };
  for (const auto& piece : patch.pieces) {
    const auto one = moment_rate_of_single(set.systems[0].compliance, piece, rock, stress, history);
    add(sum.rate, one.rate, piece.length_m);
    add(sum.off, one.off, piece.length_m);
  }
  if (patch.cells > 0)
    add(sum.rate, moment_rate_of(set, rock, stress, prestress, history),
        patch.cells * own_spacing_m * own_spacing_m);
  return sum;
}

void FractureResponse::Shot::add_contributions(const Scene<2>& scene, std::size_t number,
                                               const std::vector<Incoming>& waves) {
  const auto& patch = patches[number];
  const auto rock = rock_at(scene.model.medium, patch.middle_m);
  const auto& set = scene.model.fracture_sets[patch.set];
  const auto cell = std::size_t(scene.model.grid().flat(cell_of(scene.model.grid(), patch.middle_m)));
  Tensor prestress;
  for (std::size_t c = 0; c < scene.model.prestress_pa.size(); ++c)
    prestress.values[c] = double(scene.model.prestress_pa[c][cell]);
  for (std::size_t in = 0; in < waves.size(); ++in) {
    const auto moment = moment_of(patch, set, rock, waves[in].stress, prestress);
    const auto leg_in = legs.size();
    legs.push_back(waves[in].leg);
    planes.push_back(planes_of(set, rock, waves[in].stress));
    if (planes.back().slide) {
      auto largest = waves[in].stress;
      for (auto& value : largest.values) value *= history.largest();
      planes.back().rim = rim_of(set, rock, largest, prestress);
    }
    const double c_in = waves[in].leg.kind == WaveKind::p ? rock.vp : rock.vs;
    for (std::size_t r = 0; r < receivers_m.size(); ++r) {
      const Point<2> way_m = {receivers_m[r][0] - patch.middle_m[0], receivers_m[r][1] - patch.middle_m[1]};
      const double length_m = std::max(std::hypot(way_m[0], way_m[1]), 1e-3);
      const Point<2> n = {way_m[0] / length_m, way_m[1] / length_m};
      for (const auto kind : {WaveKind::p, WaveKind::s}) {
        const auto out = leg(scene, straight_way(scene.model.medium, patch.middle_m, receivers_m[r], kind),
                             kind, n, patch.middle_m, length_m);
        if (!out || waves[in].arrives_s + out->time_s > scene.recording.duration_s) continue;
        const double c = kind == WaveKind::p ? rock.vp : rock.vs;
        const auto& d = waves[in].leg.direction;
        Contribution one{leg_in,
                         legs.size(),
                         number,
                         r,
                         c,
                         kind == WaveKind::p ? n : across(n),
                         {},
                         {},
                         {d[0] / c_in - n[0] / c, d[1] / c_in - n[1] / c},
                         planes.size() - 1};
        legs.push_back(*out);
        // Far field of a moment; factors that all share are left out.
        const double size = std::pow(c, -2.5) / std::sqrt(length_m) / rock.rho;
        for (std::size_t f = 0; f < frequencies; ++f) {
          const auto sent = [&](const SymmetricTensor<2, Complex>& of) {
            const auto pull = times(of, n);
            return size * std::sqrt(hz[f]) * (one.moves[0] * pull[0] + one.moves[1] * pull[1]) *
                   std::polar(1., -2 * std::numbers::pi * hz[f] * (waves[in].arrives_s + out->time_s));
          };
          one.wave[f] = sent(moment.rate[f]);
          one.off[f] = sent(moment.off[f]);
        }
        contributions.push_back(one);
      }
    }
  }
}

FractureResponse::Shot::Shot(const Scene<2>& scene, std::size_t shot)
    : nominal_hz(scene.survey.sources[shot].wavelet.nominal_hz()),
      own_spacing_m(scene.model.grid().spacing_m) {
  const auto& source = scene.survey.sources[shot];
  const auto& model = scene.model;
  const auto& grid = model.grid();
  double cells = 0, of_clusters = 0;
  for (std::size_t n = 0; n < model.fracture.size(); ++n) {
    if (model.fracture[n] == 0) continue;
    cells += 1;
    of_clusters += is_of_cluster(model, n);
    const double vs = double(model.medium.vs[n]);
    slowest = slowest > 0 ? std::min(slowest, vs) : vs;
    fastest = std::max(fastest, double(model.medium.vp[n]));
  }
  patch_m = std::max({own_spacing_m, patch_wavelengths * slowest / nominal_hz,
                      own_spacing_m * std::sqrt(cells / most_patches)});
  patches = patches_of(model, patch_m);
  for (const auto& patch : patches)
    if (patch.rows > 0) across_m += patch.rows / of_clusters * own_spacing_m;
  springs = std::any_of(model.fracture_sets.begin(), model.fracture_sets.end(),
                        [](const auto& set) { return set.traces.empty() && gives(set); });
  const auto all = scene.survey.receivers_of(shot + 1);
  const auto stride = std::max<std::size_t>(1, (all.size() + receivers_followed - 1) / receivers_followed);
  for (std::size_t n = stride / 2; n < all.size(); n += stride) receivers_m.push_back(all[n].point_m);
  for (std::size_t n = 0; n < frequencies; ++n)
    hz.push_back(2 * nominal_hz * (double(n) + 0.5) / frequencies);
  history = history_of(source.wavelet, bool(point_injection(source)), hz);
  for (const std::size_t axis : {0, 1})
    for (const std::size_t side : {0, 1})
      if (scene.edges[int(axis)][side] == EdgeLaw::absorbing)
        absorbing.push_back({axis, side == 0 ? grid.origin_m[axis] : grid.end(int(axis))});
  for (std::size_t n = 0; n < patches.size(); ++n)
    add_contributions(scene, n, incoming(scene, source, patches[n]));
}

namespace {

double sinc(double x) { return std::abs(x) < 1e-6 ? 1 : std::sin(x) / x; }

/// The logarithm of the factor on waves of a second's way, by medium, kind and direction, at each frequency.
class Dispersion {
 public:
  Dispersion(const std::vector<Speeds>& media, const std::vector<double>& hz, const Discretisation& cells) {
    const double h = cells.spacing_m, dt = cells.time_step_s;
    for (const auto& rock : media)
      for (const auto kind : {WaveKind::p, WaveKind::s})
        for (std::size_t n = 0; n <= directions; ++n) {
          auto& of = all_.emplace_back();
          const double speed = kind == WaveKind::p ? rock.vp : rock.vs;
          if (!(speed > 0)) continue;
          const double angle = double(n) / directions * std::numbers::pi / 2;
          const UniformScheme scheme{cells.order, rock.vp * dt / h, rock.vs * dt / h, cells.time_order};
          for (std::size_t f = 0; f < hz.size(); ++f) {
            const double per_wave = speed / hz[f] / h;
            // Waves shorter than two cells are not on the grid at all.
            of[f] =
                per_wave <= 2.05 ? Complex(lost) : std::conj(step_error(scheme, kind, per_wave, angle)) / dt;
          }
        }
  }
  /// Of a leg.
  std::array<Complex, frequencies> of(const Leg& leg) const {
    std::array<Complex, frequencies> sum{};
    const double at = std::atan2(std::abs(leg.direction[0]), std::abs(leg.direction[1])) /
                      (std::numbers::pi / 2) * double(directions);
    const auto low = std::min(directions - 1, std::size_t(at));
    const double high = at - double(low);
    for (const auto& [medium, time_s] : leg.media) {
      const auto row = (2 * medium + (leg.kind == WaveKind::p ? 0 : 1)) * (directions + 1) + low;
      for (std::size_t f = 0; f < frequencies; ++f)
        sum[f] += time_s * ((1 - high) * all_[row][f] + high * all_[row + 1][f]);
    }
    return sum;
  }

 private:
  std::vector<std::array<Complex, frequencies>> all_;
};

/// What comes to springs of a cluster and from them, of waves that are so many times slower there than in the
/// rock beside: the amplitude that rims let through, at right angles, and out of very soft ones hardly any.
double let_through_by_rims(double slower_in, double slower_out) {
  const auto rim = [](double slower) { return 2 * std::sqrt(slower) / (1 + slower); };
  const double least = std::min(slower_in, slower_out), give = (least * least - 1) / kept_in;
  return rim(slower_in) * rim(slower_out) / (1 + give * give);
}

/// The logarithm of the factor on waves of the time step in springs (S32a).
Complex late_in_springs(const Leg& leg, const ResponseSetting& setting, double omega) {
  const double angle = omega * setting.cells.time_step_s, radians = omega * leg.in_springs_s;
  return setting.correction == SlipCorrection::first ? Complex(-radians * angle / 4)
                                                     : Complex(0, -radians * angle * angle / 6);
}

/// What that changes of a wave that fractures send out.
Complex late_on_ways(const Leg& in, const Leg& out, const ResponseSetting& setting, double omega) {
  const auto both = late_in_springs(in, setting, omega) + late_in_springs(out, setting, omega);
  return of_transmitted * (std::exp(both) - 1.);
}

/// The error of what planes send out by the time step, at an angular frequency (S32).
double late_error(const Planes& planes, const ResponseSetting& setting, double omega) {
  if (planes.single) return 0;
  const double angle = omega * setting.cells.time_step_s;
  const bool first = setting.correction == SlipCorrection::first;
  if (!planes.slide) return late_springs * std::sqrt(planes.soft) * (first ? angle : angle * angle);
  const double of = setting.correction == SlipCorrection::centred ? late_centred * angle : late_others;
  return of * angle * planes.sheared;
}
/// The same by cells; `wave_number` is that of the slowest wave.
double cell_error(const Planes& planes, const ResponseSetting& setting, double wave_number) {
  if (planes.single) return 0;
  const double cells = wave_number * setting.cells.spacing_m;
  if (!planes.slide) return of_cells_springs * cells * cells;
  return of_cells * std::pow(std::max(planes.friction, least_friction) / usual_friction, friction_power) *
         planes.sheared * std::pow(cells, cells_power);
}

/// What a rim sends back of shear along it (S33b).
Complex sent_back(const Rim& rim, double relaxes_s, double omega) {
  const Complex relaxed = Complex(0, omega * relaxes_s);
  const Complex impedance = std::sqrt(rim.askew + (1 - rim.askew) * relaxed / (1. + relaxed));
  return (1. - impedance) / (1. + impedance);
}
/// How much of that cells let into a cluster by its rim: they relax later by (S9).
double rim_error(const Rim& rim, double rows, double omega, double h) {
  if (!(rim.askew < 1)) return 0;
  const double later_s = rows * h / (2 * rim.shear_speed);
  const auto let_in = [&](double relaxes_s) {
    const auto exact = sent_back(rim, relaxes_s, omega);
    return std::norm((sent_back(rim, relaxes_s + later_s, omega) - exact) / exact);
  };
  return (1 - rim.askew) * std::sqrt(rim.dry_share * let_in(0) + (1 - rim.dry_share) * let_in(rim.relaxes_s));
}

/// What is left of a wave whose source cells share as a spline says (S33a).
double left_of_shared(const Contribution& of, double omega, double h) {
  double left = 1;
  for (const double slowness : of.slowness) left *= std::pow(sinc(omega * slowness * h / 2), 3);
  return left;
}

/// Spectra of the motion of a receiver: as it is, and what changes it.
enum Part : std::size_t {
  exact,
  on_way_in,
  p_waves,
  s_waves,
  dispersion,
  late,
  late_on_way,
  in_cells,
  shared,
  at_rim,
  parts
};
using Spectra = std::array<std::array<std::array<Complex, 2>, frequencies>, parts>;

}  // namespace

/// The square of the share of a contribution that absorbing edges send back.
double FractureResponse::Shot::at_edges(const Contribution& of, const ResponseSetting& setting) const {
  const auto& from = patches[of.patch].middle_m;
  const auto& to = receivers_m[of.receiver];
  const double zone_m = setting.zone_cells * setting.cells.spacing_m;
  double square = 0;
  if (!absorbing.empty() && planes[of.planes].rim.dry_share > 0)
    square += std::pow(of_edges * fastest / nominal_hz / zone_m, 2);
  for (const auto& edge : absorbing) {
    const double along_m = std::abs(to[1 - edge.axis] - from[1 - edge.axis]),
                 away_m = std::abs(from[edge.axis] - edge.place_m) + std::abs(to[edge.axis] - edge.place_m);
    square += std::pow(grazing_share(along_m, away_m / 2, of.speed / nominal_hz, zone_m), 2);
  }
  return square;
}

bool FractureResponse::Shot::is_heard() const {
  return std::any_of(contributions.begin(), contributions.end(), [](const Contribution& of) {
    return std::any_of(of.wave.begin(), of.wave.end(), [](const Complex& wave) { return wave != 0.; });
  });
}

FractureResponse::Shot::Sums& FractureResponse::Shot::Sums::operator+=(const Sums& other) {
  energy += other.energy, incoming += other.incoming, p += other.p, s += other.s;
  dispersion += other.dispersion, late += other.late, cells += other.cells, rows += other.rows;
  edges += other.edges;
  return *this;
}

FractureResponse::Shot::Sums FractureResponse::Shot::sums(const ResponseSetting& setting) const {
  const Dispersion of_ways(media.speeds(), hz, setting.cells);
  std::vector<std::array<Complex, frequencies>> exponents;
  for (const auto& leg : legs) exponents.push_back(of_ways.of(leg));
  std::vector<Spectra> all(receivers_m.size());
  Sums sums;
  const double h = setting.cells.spacing_m;
  const double of_rows = setting.correction == SlipCorrection::first ? of_row_first : of_row;
  for (const auto& of : contributions) {
    const auto& in = exponents[of.in];
    const auto& out = exponents[of.out];
    const bool p = legs[of.out].kind == WaveKind::p, single = planes[of.planes].single;
    const double let_through = let_through_by_rims(legs[of.in].slower, legs[of.out].slower);
    auto& spectra = all[of.receiver];
    double size = 0;
    for (std::size_t f = 0; f < frequencies; ++f) {
      const double omega = 2 * std::numbers::pi * hz[f], wave_number = omega / slowest;
      const auto wave = of.wave[f] * sinc(omega * of.slowness[0] * patch_m / 2) *
                        sinc(omega * of.slowness[1] * patch_m / 2);
      const auto way_out = let_through * (std::exp(out[f]) - 1.);
      const std::array<Complex, parts> by = {
          1.,
          let_through * (std::exp(in[f]) - 1.),
          p ? way_out : 0.,
          p ? 0. : way_out,
          let_through * (std::exp(in[f] + out[f]) - 1.),
          late_error(planes[of.planes], setting, omega),
          let_through * late_on_ways(legs[of.in], legs[of.out], setting, omega),
          cell_error(planes[of.planes], setting, wave_number),
          single ? 1 - left_of_shared(of, omega, h) : 0.,
          rim_error(planes[of.planes].rim, of_rows, omega, h)};
      for (std::size_t part = 0; part < parts; ++part)
        for (const std::size_t c : {0, 1}) spectra[part][f][c] += wave * of.moves[c] * by[part];
      if (single)
        for (const std::size_t c : {0, 1}) spectra[in_cells][f][c] += of.off[f] * felt_over * h * of.moves[c];
      size += std::norm(wave);
    }
    sums.contributions += size;
    sums.edges += size * at_edges(of, setting);
    if (planes[of.planes].slide) sums.sliding += size;
  }
  const auto energy = [&](Part part) {
    double sum = 0;
    for (const auto& spectra : all)
      for (const auto& motion : spectra[part]) sum += std::norm(motion[0]) + std::norm(motion[1]);
    return sum;
  };
  sums.energy = energy(exact);
  sums.incoming = energy(on_way_in), sums.p = energy(p_waves), sums.s = energy(s_waves);
  sums.dispersion = energy(dispersion);
  // Of all, what does not cancel.
  const double left = sums.contributions > 0 ? sums.energy / sums.contributions : 0;
  sums.sliding *= left;
  sums.edges *= left;
  sums.late = energy(late) + energy(late_on_way);
  sums.cells = energy(in_cells) + energy(shared) + energy(at_rim);
  if (sums.sliding > 0) sums.rows = sums.sliding * std::pow(of_rows * h / across_m, 2);
  return sums;
}

namespace {

/// What no secondary source tells of, or nothing at all.
std::string why_not_at_all(const Scene<2>& scene) {
  const auto& sets = scene.model.fracture_sets;
  const auto& marked = scene.model.fracture;
  if (const auto* const set = first_on_faces(sets))
    return "fractures '" + set->name + "' lie on faces between cells, whose error is not known";
  if (std::none_of(marked.begin(), marked.end(), [](auto code) { return code != 0; }))
    return "the model has no fractures whose response could have an error";
  if (!scene.survey.any_receiver()) return "the survey has no receivers";
  for (const auto& set : sets) {
    for (const auto& system : set.systems) {
      if (system.opens) return "fractures '" + set.name + "' open, whose error is not known";
      if (system.law == FrictionLaw::slip_weakening)
        return "fractures '" + set.name + "' weaken with slip, whose error is not known";
    }
  }
  return "";
}

std::vector<std::string> left_out_of(const Scene<2>& scene, std::size_t media) {
  std::vector<std::string> sentences;
  std::size_t single = 0;
  for (const auto& set : scene.model.fracture_sets) single += set.traces.size();
  if (single > 1) sentences.emplace_back("waves that single fractures send to each other");
  if (media > 1 || scene.edges[1][0] == EdgeLaw::free)
    sentences.emplace_back("waves that come to fractures or leave them by reflection or conversion");
  if (anisotropic_cells(scene.model.medium) > 0)
    sentences.emplace_back("anisotropy, but for the speeds of its slowest directions");
  if (scene.attenuates()) sentences.emplace_back("attenuation");
  if (!scene.survey.blended.empty()) sentences.emplace_back("sources of a blended shot after its first");
  if (scene.numerics.monotone) sentences.emplace_back(flattened_extrema);
  return sentences;
}

/// Why nothing is heard of fractures that have been followed: `in_time`, whether anything would be if they
/// slipped or gave way.
std::string why_silent(bool in_time, const std::vector<FractureSet<2>>& sets) {
  if (!in_time) return "no wave of the fractures is expected at a receiver before the traces end";
  const auto any = [&](const auto& is) { return std::any_of(sets.begin(), sets.end(), is); };
  if (any(slides<2>) && !any(gives<2>))
    return "the fractures do not slip: the waves bring their planes no shear traction above the strength; "
           "see --amplitude here, --prestress, --friction and --strength of sw-fracture";
  return "the waves make the planes of the fractures neither slip nor give way";
}

}  // namespace

FractureResponse::FractureResponse(const Scene<2>& scene) : why_not_(why_not_at_all(scene)) {
  if (!why_not_.empty()) return;
  bool in_time = false;
  if (anisotropic_cells(scene.model.medium) > 0) {
    auto isotropic = scene;
    isotropic.model.medium = in_slowest_directions(scene.model.medium);
    in_time = add_shots(isotropic);
  } else {
    in_time = add_shots(scene);
  }
  std::size_t media = 0;
  for (const auto& shot : shots_) media = std::max(media, shot->media.speeds().size());
  if (shots_.empty()) why_not_ = why_silent(in_time, scene.model.fracture_sets);
  not_covered_ = left_out_of(scene, media);
}

bool FractureResponse::add_shots(const Scene<2>& scene) {
  bool in_time = false;
  const auto count = scene.survey.sources.size();
  const auto stride = std::max<std::size_t>(1, (count + shots_followed - 1) / shots_followed);
  for (std::size_t n = stride / 2; n < count; n += stride) {
    auto shot = std::make_unique<Shot>(scene, n);
    in_time = in_time || shot->is_in_time();
    if (shot->is_heard()) shots_.push_back(std::move(shot));
  }
  return in_time;
}

ResponseError FractureResponse::promised(const ResponseSetting& setting) const {
  const double h = setting.cells.spacing_m;
  const bool centred = setting.correction == SlipCorrection::centred;
  ResponseError error;
  Shot::Sums sums;
  double all = 0, cells_of_s = 0;
  for (const auto& shot : shots_) {
    sums += shot->sums(setting);
    cells_of_s = shot->slowest / shot->nominal_hz / h;
    error.below_hz = std::max(error.below_hz, 2 * shot->nominal_hz);
  }
  if (!(sums.energy > 0)) return error;
  const auto add = [&](std::string name, std::string remedy, double square) {
    error.causes.push_back({std::move(name), std::move(remedy), saturated(square / sums.energy), true});
  };
  add("dispersion of the waves that come to fractures", "", sums.incoming);
  add("dispersion of the P waves that fractures send out", "", sums.p);
  add("dispersion of the S waves that fractures send out, " + shown(cells_of_s, 2) +
          " cells per dominant wavelength",
      "", sums.s);
  add("the time step of slip", centred ? "a smaller --cfl" : "--correction centred, a smaller --cfl",
      sums.late);
  add("slip in cells of " + shown(h, 4) + " m", "", sums.cells + sums.rows);
  add("what absorbing edges send back", "a larger --edge-width", sums.edges);
  all = sums.dispersion + sums.late + sums.cells + sums.rows + sums.edges;
  error.error = saturated(all / sums.energy);
  std::stable_sort(error.causes.begin(), error.causes.end(),
                   [](const ErrorCause& a, const ErrorCause& b) { return a.error > b.error; });
  return error;
}

bool FractureResponse::any() const { return !shots_.empty(); }
const std::string& FractureResponse::why_not() const { return why_not_; }
const std::vector<std::string>& FractureResponse::not_covered() const { return not_covered_; }
FractureResponse::~FractureResponse() = default;
FractureResponse::FractureResponse(FractureResponse&&) noexcept = default;
FractureResponse& FractureResponse::operator=(FractureResponse&&) noexcept = default;

ResponseSetting response_setting(const Scene<2>& scene) {
  return {{scene.numerics.order, time_step_s(scene), scene.model.grid().spacing_m, scene.numerics.time_order},
          scene.numerics.correction,
          zone_cells(scene, scene.survey.sources.front())};
}

}  // namespace slipwave
