// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic rock of every kind gives the same bits in tiles and plainly, on ranks and in pieces.
#include <gtest/gtest.h>

#include <span>
#include <variant>

#include "anisotropic_rocks.hpp"
#include "continued.hpp"
#include "fitted_scenes.hpp"
#include "geology/layers.hpp"
#include "parallel/threads.hpp"
#include "plain_and_tiled.hpp"
#include "rock/tilted_mean.hpp"
#include "shared_out.hpp"

namespace slipwave::solver::anisotropic_bits_test {
namespace {

/// In several columns of tiles, or of so many rows that several ranks take their part.
enum class Cut { columns, rows };

/// In the long form there are more columns on all sides.
template <int D>
Index<D> shape_for(Cut cut, std::int64_t rows) {
  if constexpr (D == 2)
    return long_form() ? Index<2>{150, 200} : cut == Cut::columns ? Index<2>{60, 44} : Index<2>{40, rows};
  if constexpr (D == 3)
    return long_form()           ? Index<3>{86, 12, cut == Cut::columns ? 34 : rows}
           : cut == Cut::columns ? Index<3>{32, 10, 18}
                                 : Index<3>{18, 12, rows};
}

template <int D>
void set_times(Scene<D>& scene, double seconds) {
  scene.recording.duration_s = long_form() ? 2 * seconds : seconds;
  scene.recording.interval_s = 0.001;
}

/// The other numbers of a scene: in double precision, of order 7 and of fourth order in time.
template <int D>
Scene<D> in_double(Scene<D> scene) {
  scene.numerics.double_precision = true, scene.numerics.order = 7, scene.numerics.time_order = 4;
  return scene;
}

/// Blocks of rocks and water between a free surface and layers that absorb, a force amid them. For ranks the
/// first of them hold water and isotropic rock only.
template <int D>
Scene<D> blocks(const std::vector<Material>& rocks, Cut cut) {
  const auto shape = shape_for<D>(cut, D == 2 ? 100 : 66);
  Index<D> block;
  block.fill(7), block[0] = 11;
  Scene<D> scene;
  scene.model.medium = blocks_below_water<D>(rocks, shape, block);
  const auto at = [&](double x, double z) {
    Point<D> place;
    place.fill(5 * 0.6 * double(shape[1]));
    place[0] = 5 * x * double(shape[0]), place[D - 1] = 5 * z * double(shape[D - 1]);
    return place;
  };
  scene.survey.sources = {{at(0.45, 0.6), parse_mechanism<D>(D == 2 ? "force:1,1" : "force:1,1,1"),
                           parse_wavelet("ricker:40"), 1e9}};
  scene.survey.receivers_m = {at(0.6, 0.7), at(0.2, 0.3), at(0.5, 0.97)};
  for (int axis = 0; axis < D; ++axis) {
    const auto law = axis == 1 && D == 3 ? EdgeLaw::mirror : EdgeLaw::absorbing;
    scene.edges[axis] = {law, law};
  }
  scene.edges[D - 1][0] = EdgeLaw::free;
  scene.recording.components = {Component::vx, Component::vz, Component::p};
  if (D == 3) scene.recording.components.push_back(Component::vy);
  scene.numerics.zone_cells = 6;
  set_times(scene, cut == Cut::columns ? (D == 2 ? 0.05 : 0.008) : 0.03);
  if (cut == Cut::rows) make_isotropic(scene.model.medium, std::size_t(scene.model.grid().size() * 3 / 5));
  return scene;
}

/// Level planes that slip in a part of blocks.
Scene<2> slipping(Scene<2> scene) {
  const auto& grid = scene.model.grid();
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto [i, k] = grid.index(n);
    scene.model.fracture[std::size_t(n)] = 4 * k >= 2 * grid.shape[1] && 4 * k < 3 * grid.shape[1] &&
                                           4 * i >= grid.shape[0] && i < grid.shape[0] * 3 / 4;
  }
  scene.model.fracture_sets = {{"cracks", {{{0, 1}, 0.5, 1000, 0}}}};
  return scene;
}

/// Gives blocks Q by cell, in lumps of which some are elastic.
template <int D>
Scene<D> attenuating(Scene<D> scene) {
  auto& medium = scene.model.medium;
  attenuate(scene, {60, 30});
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    const auto kind = (at[0] / 9 + at[D - 1] / 9) % 3;
    const auto set = [&](Property property, double q) {
      auto& value = medium[property][std::size_t(n)];
      if (std::isfinite(value)) value = float(q);
    };
    if (kind == 0) set(Property::qp, PropertyRow::infinite), set(Property::qs, PropertyRow::infinite);
    if (kind == 1) set(Property::qp, 25), set(Property::qs, 40);
  }
  set_attenuation(scene);
  return scene;
}

/// Layers whose interfaces cut cells, which are tilted means there, below water: they dip both ways and meet.
Scene<2> cut_cells(const std::vector<const char*>& layers, Cut cut) {
  auto scene = blocks<2>({plain}, cut);
  std::vector<Layer> all;
  for (const auto* layer : layers) all.push_back(parse_layer(layer));
  scene.model.medium = layered_medium(scene.model.grid(), all, Average::tilted);
  // An interface of solids cuts a cell of most columns.
  EXPECT_GT(4 * tilted_means(scene.model.medium),
            std::min<std::int64_t>(180, 3 * scene.model.grid().shape[0]));
  return scene;
}
Scene<2> wedges(Cut cut) {
  if (cut == Cut::rows)
    return cut_cells(
        {"-10000:1500:0:1000", "100:2000:1150:2000", "150:4000:2300:2300:18", "330:2500:1200:2100:-25"}, cut);
  return cut_cells(
      {"-10000:1500:0:1000", "40:2000:1150:2000", "60:4000:2300:2300:18", "180:2500:1200:2100:-25"}, cut);
}
Scene<2> attenuating_layers(Cut cut) {
  auto scene = cut == Cut::rows
                   ? cut_cells({"-1000:1500:0:1000", "60:2000:1000:2000:8 qp=30 qs=20",
                                "130:3000:1600:2300:-6 qp=60 qs=30",
                                "220:3000:1600:2300 epsilon=0.2 delta=0.1 tilt=30 qp=40 qs=25",
                                "330:3200:1700:2400 epsilon=-0.05 delta=0.2 qp=80", "400:3500:1900:2400:4"},
                               cut)
                   : cut_cells({"-1000:1500:0:1000", "40:2000:1000:2000:8 qp=30 qs=20",
                                "130:3000:1600:2300:-6 qp=60 qs=30",
                                "150:3000:1600:2300 epsilon=0.2 delta=0.1 tilt=30 qp=40 qs=25",
                                "175:3200:1700:2400 epsilon=-0.05 delta=0.2 qp=80", "190:3500:1900:2400:4"},
                               cut);
  set_attenuation(scene);
  return scene;
}

/// Beds of a shale that dip, amid them planes that slide along them.
Scene<2> slipping_beds(Cut cut) {
  auto scene = blocks<2>({dipping_shale}, cut);
  const auto middle = scene.survey.sources[0].position_m;
  // The first of several ranks has planes in isotropic rock only, of which cells remember less.
  const double radius_m = cut == Cut::rows ? 100 : 60;
  add_fractures<2>(scene.model, {"beds", {{normal_of_dip(30), 0.2, 200, 0}}}, [&](const Point<2>& place) {
    return std::hypot(place[0] - middle[0], place[1] - middle[1]) < radius_m;
  });
  return scene;
}

/// Fractures askew amid a cube of one rock, which for ranks is that above and tilted rock below.
Scene<3> in_cluster(const Material& rock, const FractureSet<3>& set, Cut cut) {
  auto scene = cluster(rock, set, shape_for<3>(cut, 46));
  const auto& grid = scene.model.grid();
  const Point<3> size = {double(grid.shape[0]) * 5, double(grid.shape[1]) * 5, double(grid.shape[2]) * 5};
  scene.survey.sources[0].position_m = {0.45 * size[0], 0.45 * size[1], 0.4 * size[2]};
  scene.survey.receivers_m = {{0.5 * size[0], 0.55 * size[1], 0.6 * size[2]}};
  scene.edges[0] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  scene.numerics.zone_cells = 6;
  set_times(scene, cut == Cut::columns ? 0.02 : 0.03);
  return scene;
}

/// Rows that follow a floor, or a surface, of one rock; in 2-D slip is among them.
Scene<2> fitted_in_plane(bool hills, Cut cut) {
  const Index<2> shape = long_form()           ? Index<2>{120, 190}
                         : cut == Cut::columns ? Index<2>{80, 76}
                                               : Index<2>{60, 190};
  auto scene = hills ? fitted_hills(shape[0], shape[1]) : fitted_sea(shape[0], shape[1]);
  put_rocks(scene.model.medium, turned_by(shale, hills || cut == Cut::rows ? 25 : 0), turned_by(crossed, 0),
            3300);
  scene.survey.sources[0].position_m[0] = 203;
  scene.survey.receivers_m = {{230, 150}, {262.5, 230.3}, {240, 253}, {40, 172}};
  if (cut == Cut::rows) scene.survey.receivers_m.push_back({33, 901});
  scene.numerics.zone_cells = 10;
  set_times(scene, cut == Cut::columns ? 0.02 : 0.1);
  return scene;
}
Scene<3> fitted_in_3d(bool hills, Cut cut) {
  const Material rock = hills              ? turned_by(cracked, 30, 20, 15)
                        : cut == Cut::rows ? turned_by(shale, 30, 40)
                                           : shale;
  const Index<3> shape = cut == Cut::rows ? long_form() ? Index<3>{24, 20, 110} : Index<3>{14, 8, 100}
                         : long_form() ? Index<3>{54, 14, 40}
                                          : Index<3>{24, 8, 34};
  auto scene = fitted_sea_3d(shape);
  if (!long_form()) scene.numerics.zone_cells = 4;
  scene.model.fracture = {}, scene.model.fracture_sets = {}, scene.with_slip = false;
  const auto floor = [](double x, double y) {
    return 63 + 0.1 * x - 0.15 * y + 4 * std::sin(x / 25 + y / 30);
  };
  const Rock solid{rock.vp, rock.vs, rock.rho};
  // For ranks below the floor another rock that is isotropic, so that the last of them hold no other.
  std::vector<Below> layers = {water_above, below(floor, solid),
                               below(dipping(253, 0.07), {3600, 1900, 2450})};
  if (hills) layers.erase(layers.begin());
  if (cut == Cut::columns) layers.pop_back();
  scene.model.medium = fitted_medium<3>(Grid<3>{shape, 5, {}}, layers, hills);
  put_rocks(scene.model.medium, rock, {3600, 1900, 2450}, 3300);
  scene.survey.sources[0].position_m = {42, 31, 122};
  scene.survey.receivers_m = {{61, 32, 120}, {52, 25, 143}};
  if (cut == Cut::rows) scene.survey.receivers_m.push_back({42, 35, 423});
  set_times(scene, cut == Cut::columns ? 0.006 : 0.06);
  return scene;
}

/// A plane wave in layers with a body in them.
template <int D>
Scene<D> plane_wave_past_a_body() {
  using Layers = std::vector<std::pair<Material, std::int64_t>>;
  auto shape = shape_for<D>(Cut::columns, 0);
  if constexpr (D == 3)
    if (!long_form()) shape = {10, 10, 24};
  const auto middle = shape[D - 1] / 2;
  const auto layers = D == 2 ? Layers{{sea, 8}, {shale, middle - 8}, {dipping_shale, middle / 2}, {hard, 0}}
                             : Layers{{askew, middle}, {shale, 0}};
  auto scene = plane_wave_in<D>(layers, shape, D == 2 ? "plane:155" : "plane:25,40",
                                D == 2 ? double(shape[1]) * 5 + 20 : -30, 0);
  Point<D> at{};
  at[0] = 21, at[D - 1] = 5 * double(middle) - 13;
  scene.survey.receivers_m = {at, {}};
  scene.survey.receivers_m[1][D - 1] = 5 * double(middle) + 22;
  for (std::int64_t n = 0; n < scene.model.grid().size(); ++n) {
    const auto cell = scene.model.grid().index(n);
    if (D == 2 && cell[1] == middle - 2 && cell[0] > 25 && cell[0] < 40)
      put(scene.model.medium, std::size_t(n), hard);
  }
  scene.numerics.zone_cells = 6;
  // So short that traces still show where the series of some stages begin before those of others.
  set_times(scene, D == 2 ? 0.1 : 0.03);
  return scene;
}

using AnyScene = std::variant<Scene<2>, Scene<3>>;
struct Case {
  const char* name;
  std::function<AnyScene(Cut)> scene;
  bool of_ranks = true;
  bool in_short = true;
};
void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

const std::vector<Material>
    level_rocks = {shale, crossed, sandstone, {3000, 1500, 2200}},
    tilted_rocks = {dipping_shale, steep, {3100, 1650, 2350, 0.15, 0.05}, {3000, 1500, 2200}},
    upright_in_3d = {shale, crossed, shale}, orthorhombic_in_3d = {shale, crossed, cracked},
    tilted_in_3d = {turned_by(shale, 30, 20),
                    {2900, 1500, 2200},
                    turned_by(cracked, -40, 60, 15),
                    turned_by(crossed, 70, -30)},
    all_in_3d = {
        turned_by(shale, 30, 20), {2900, 1500, 2200}, cracked, turned_by(cracked, -40, 60, 15), shale};

const std::vector<Material> any_rocks = {sheared, dipping_shale, plain, by_constants<2>(steep)},
                            any_rocks_in_3d = {triclinic, turned_by(shale, 30, 20), plain,
                                               by_constants<3>(askew)};

template <int D>
Scene<D> by(SlipCorrection correction, Scene<D> scene) {
  scene.numerics.correction = correction;
  return scene;
}
const auto two_families = families({{35, 20}, {90, 80}}, 0.2, 200);
const auto tilted_shale = turned_by(shale, 25, 35), tilted_cracked = turned_by(cracked, 25, 35, 50);

const std::vector<Case> cases = {
    {"Level", [](Cut cut) { return slipping(blocks<2>(level_rocks, cut)); }},
    {"LevelInDouble", [](Cut cut) { return in_double(slipping(blocks<2>(level_rocks, cut))); }, false},
    {"Tilted", [](Cut cut) { return blocks<2>(tilted_rocks, cut); }},
    {"TiltedInDouble", [](Cut cut) { return in_double(blocks<2>(tilted_rocks, cut)); }, false},
    {"Means", [](Cut cut) { return wedges(cut); }},
    {"MeansInDouble", [](Cut cut) { return in_double(wedges(cut)); }, false},
    {"Attenuating", [](Cut cut) { return attenuating_layers(cut); }},
    {"AttenuatingInDouble", [](Cut cut) { return in_double(attenuating_layers(cut)); }, false},
    {"Slip", [](Cut cut) { return slipping_beds(cut); }},
    {"SlipSecond", [](Cut cut) { return by(SlipCorrection::second, slipping_beds(cut)); }, false},
    {"PlaneWave", [](Cut) { return plane_wave_past_a_body<2>(); }, false},
    {"FittedSea", [](Cut cut) { return fitted_in_plane(false, cut); }},
    {"FittedHills", [](Cut cut) { return in_double(fitted_in_plane(true, cut)); }, false},
    {"AnyRock", [](Cut cut) { return slipping(blocks<2>(any_rocks, cut)); }},
    {"AnyRockInSpace", [](Cut cut) { return blocks<3>(any_rocks_in_3d, cut); }},
    {"UprightInSpace", [](Cut cut) { return blocks<3>(upright_in_3d, cut); }, false},
    {"OrthorhombicInSpace", [](Cut cut) { return blocks<3>(orthorhombic_in_3d, cut); }},
    {"OrthorhombicInSpaceInDouble", [](Cut cut) { return in_double(blocks<3>(orthorhombic_in_3d, cut)); },
     false, false},
    {"TiltedInSpace", [](Cut cut) { return blocks<3>(tilted_in_3d, cut); }},
    {"TiltedInSpaceInDouble", [](Cut cut) { return in_double(blocks<3>(tilted_in_3d, cut)); }, false},
    {"AttenuatingInSpace", [](Cut cut) { return attenuating(blocks<3>(all_in_3d, cut)); }},
    {"AttenuatingInSpaceInDouble", [](Cut cut) { return in_double(attenuating(blocks<3>(all_in_3d, cut))); },
     false},
    {"SlipInSpace",
     [](Cut cut) { return in_cluster(cut == Cut::rows ? tilted_shale : tilted_cracked, two_families, cut); }},
    {"SlipSecondInSpace",
     [](Cut cut) { return by(SlipCorrection::second, in_cluster(tilted_cracked, two_families, cut)); },
     false},
    {"SpringsInSpace",
     [](Cut cut) {
       if (cut == Cut::columns)
         return in_cluster(tilted_cracked, springs({{35, 20}, {90, 80}}, 0.4, 0.7), cut);
       // Level planes meet rock that is alike in all horizontal directions above and tilted rock below.
       auto scene = in_cluster(tilted_shale, springs({{0, 0}}, 0.4, 0.7), cut);
       auto& medium = scene.model.medium;
       for (std::size_t cell = 0; cell < medium.vp.size() / 2; ++cell) put(medium, cell, shale);
       return scene;
     }},
    {"PlaneWaveInSpace", [](Cut) { return plane_wave_past_a_body<3>(); }, false},
    {"FittedSeaInSpace", [](Cut cut) { return fitted_in_3d(false, cut); }},
    {"FittedHillsInSpace", [](Cut cut) { return in_double(fitted_in_3d(true, cut)); }, false},
};

class AnisotropicScene : public testing::TestWithParam<Case> {};
class SharedAnisotropicScene : public testing::TestWithParam<Case> {};

// Proves (V1), (T4), (T5), (Q10), (Q12), (O1), (O8), (F14), (F16), (S34), (S34a), (S34b), (A17), (A19).
TEST_P(AnisotropicScene, GivesTheBitsOfThePlainExecutorInTiles) {
  std::visit([](const auto& scene) { expect_same(scene); }, GetParam().scene(Cut::columns));
}

// Proves (Q12).
TEST_P(SharedAnisotropicScene, ContinuesFromACheckpointWithTheSameBits) {
  const ThreadLimit one_thread(1);
  std::visit([](const auto& scene) { expect_to_continue(scene); }, GetParam().scene(Cut::columns));
}

// Proves (V1), (T4), (T5), (Q10), (Q12), (O1), (O8), (F14), (F16), (S34), (S34a), (S34b).
TEST_P(SharedAnisotropicScene, GivesTheBitsOfOneProcessOnSeveral) {
  const ThreadLimit one_thread(1);
  std::visit(
      [](const auto& scene) {
        check(scene);
        const auto alone = samples_of(shoot(scene, 1));
        // Where every point moves in the last samples, ranks tell each other of it.
        ASSERT_GT(*std::max_element(alone.begin(), alone.end()), 0);
        for (const int ranks : {2, 3}) {
          if (ranks == 2 && !long_form()) continue;
          EXPECT_TRUE(samples_of(shared_out(scene, ranks)) == alone) << ranks;
        }
      },
      GetParam().scene(Cut::rows));
}

/// The scene with the elastic constants of its anisotropic rocks, and the same time step.
template <int D>
Scene<D> by_constants_of(const Scene<D>& scene) {
  auto of = scene;
  const auto& medium = scene.model.medium;
  std::vector<Material> rocks;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    rocks.push_back(by_constants<D>(material_of(medium, cell)));
  of.model.medium = medium_of(medium.grid(), rocks,
                              [&](const Index<D>& at) { return rocks[std::size_t(medium.grid().flat(at))]; });
  of.numerics.cfl *= stable_time_step_s(scene) / stable_time_step_s(of);
  return of;
}

/// The scene with the next number in single precision for each vp, and the same time step: friction makes of
/// any rounding what it makes of this.
template <int D>
Scene<D> next_in_single_precision(const Scene<D>& scene) {
  auto of = scene;
  for (auto& vp : of.model.medium.vp) vp = std::nextafter(vp, 2 * vp);
  of.numerics.cfl *= stable_time_step_s(scene) / stable_time_step_s(of);
  return of;
}

/// Several constants of a rock are rounded each, where the other scene rounds one speed.
constexpr double few_roundings = 10;

/// How far `found` is from `wanted` and the bound of that, for one component: its traces one after the other,
/// each up to the sample from which on rounding alone, that is `rounded`, could reach the bound.
struct Apart {
  double furthest = 0, bound = 0;
  std::size_t samples = 0;  // that were compared
};

Apart apart(std::span<const double> found, std::span<const double> wanted, std::span<const double> rounded,
            std::size_t of_trace, double share_of_peak) {
  Apart apart;
  for (const double sample : wanted) apart.bound = std::max(apart.bound, share_of_peak * std::abs(sample));
  for (std::size_t begin = 0; begin < wanted.size(); begin += of_trace)
    for (auto n = begin; n < begin + of_trace; ++n) {
      if (few_roundings * std::abs(rounded[n] - wanted[n]) > apart.bound) break;
      apart.furthest = std::max(apart.furthest, std::abs(found[n] - wanted[n]));
      ++apart.samples;
    }
  return apart;
}

class ByElasticConstants : public testing::TestWithParam<Case> {};

// Proves (T2), (O6).
TEST_P(ByElasticConstants, ASceneGivesTheTracesOfItsParameters) {
  const ThreadLimit one_thread(1);
  std::visit(
      [](const auto& scene) {
        const auto wanted = samples_of(shoot(scene, 1)), found = samples_of(shoot(by_constants_of(scene), 1));
        const bool slips = !scene.model.fracture_sets.empty();
        // Friction amplifies rounding, over the time of the long form beyond any bound.
        const auto rounded =
            slips && long_form() ? samples_of(shoot(next_in_single_precision(scene), 1)) : wanted;
        const auto of_component = wanted.size() / scene.recording.components.size();
        for (std::size_t first = 0; first < wanted.size(); first += of_component) {
          const auto of = [&](const std::vector<double>& samples) {
            return std::span(samples).subspan(first, of_component);
          };
          const auto found_apart = apart(of(found), of(wanted), of(rounded),
                                         std::size_t(scene.recording.samples()), slips ? 1e-4 : 1e-5);
          EXPECT_LT(found_apart.furthest, found_apart.bound) << first / of_component;
          EXPECT_GT(found_apart.samples, of_component / 4) << first / of_component;
        }
      },
      GetParam().scene(Cut::columns));
}

const auto name_of_case = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Of, AnisotropicScene, testing::ValuesIn(of_this_form(cases)), name_of_case);
INSTANTIATE_TEST_SUITE_P(Of, SharedAnisotropicScene, testing::ValuesIn([] {
                           std::vector<Case> shared;
                           std::copy_if(std::begin(cases), std::end(cases), std::back_inserter(shared),
                                        [](const Case& of) { return of.of_ranks; });
                           return shared;
                         }()),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(
    Of, ByElasticConstants, testing::ValuesIn([] {
      const auto is_without = [](const Case& of, const char* word) {
        return std::string(of.name).find(word) == std::string::npos;
      };
      std::vector<Case> compared;
      std::copy_if(std::begin(cases), std::end(cases), std::back_inserter(compared), [&](const Case& of) {
        // Planes slip along the beds of level rock by other kernels.
        return is_without(of, "Means") && is_without(of, "Attenuating") && is_without(of, "Level") &&
               (long_form() || (is_without(of, "SpaceInDouble") && is_without(of, "WaveInSpace")));
      });
      return compared;
    }()),
    name_of_case);

}  // namespace
}  // namespace slipwave::solver::anisotropic_bits_test
