// SPDX-License-Identifier: BSD-3-Clause
#include "bit_scenes.hpp"

#include <random>

#include "fitted_scenes.hpp"
#include "grid/locate.hpp"
#include "long_form.hpp"
#include "model/fracture.hpp"
#include "model/planar_fracture.hpp"
#include "model/single_fracture.hpp"
#include "scene_of_faces.hpp"

namespace slipwave::solver {
namespace {

using enum EdgeLaw;
constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000}, brine{2000, 0, 1300}, soft{2500, 1200, 2000},
    nothing{0, 0, 0};
const double mu = rock.mu();

/// Calls of(cell) for every cell of a medium and puts the rock there that it returns.
template <int D, class Of>
void fill(Medium<D>& medium, Of&& of) {
  for (std::int64_t n = 0; n < medium.grid().size(); ++n)
    put(medium, medium.grid().index(n), of(medium.grid().index(n)));
}

/// The first waves pass the fractures and all cuts of rows and columns.
template <int D>
void make_short(Scene<D>& scene, double duration_s) {
  for (auto& of_shot : scene.survey.blended)
    for (auto& source : of_shot) source.wavelet = parse_wavelet("ricker:80");
  scene.survey.sources[0].wavelet = parse_wavelet(D == 2 ? "ricker:80" : "ricker:160");
  scene.recording.duration_s = long_form() ? 3 * duration_s : duration_s;
}

/// A source between fractures that take patches of rows and others that take whole rows (Patches).
Scene<2> with_clusters(Scene<2> scene) {
  auto& model = scene.model;
  model.fracture = {};
  fracture_rows(model, 230, 290, 76, 96, 1);
  fracture_rows(model, 150, 170, 36, 50, 2);
  scene.survey.sources[0].position_m = {333, 203};
  scene.survey.receivers_m = {{230, 130}, {462.5, 261.3}, {440, 333}, {55, 182}, {700, 301}, {505, 118}};
  // Another one beside the zone at a side, whose waves come back to a receiver there.
  auto beside = scene.survey.sources[0];
  beside.position_m = {42, 203};
  scene.survey.blended = {{beside}};
  make_short(scene, 0.03);
  return scene;
}

/// Water over two rocks below a free surface, fractures. In lines wider than a usual stripe there is a wider
/// cluster, too, and a narrow one beside it.
Scene<2> sea(std::int64_t nx = long_form() ? 330 : 150) {
  auto scene = fitted_sea(200, 90);
  scene.model.medium = uniform_medium(nx, 90, 5, rock);
  fill(scene.model.medium, [](const Index<2>& at) {
    return at[1] < 20 + at[0] / 40 ? water : at[1] > 62 ? soft : rock;
  });
  scene = with_clusters(std::move(scene));
  if (nx < 400) return scene;
  fracture_rows(scene.model, 230, 280, 160, 270, 1);
  fracture_rows(scene.model, 230, 280, nx - 120, nx - 115, 1);
  scene.survey.sources[0].position_m = {1110, 203};
  scene.survey.receivers_m = {{790, 230}, {1302.5, 271.3}, {1362, 243}};
  return scene;
}

/// One rock between absorbing edges with the fractures of the sea.
Scene<2> in_one_rock(std::int64_t nx = long_form() ? 330 : 150) {
  auto scene = sea(nx);
  scene.model.medium = uniform_medium(scene.model.grid().shape[0], 90, 5, rock);
  scene.edges[1][0] = absorbing;
  return scene;
}

enum class Ground { level, sea, hills };

Scene<2> over(Ground ground) {
  const std::int64_t nx = long_form() ? 220 : 150;
  if (ground == Ground::level) return sea();
  return with_clusters(ground == Ground::sea ? fitted_sea(nx, 90) : fitted_hills(nx, 90));
}

/// How waves are swept over a ground and what leaves it at its edges.
struct Swept {
  const char* name;
  Ground ground;
  int order, time_order;
  EdgeLaw sides, top, bottom;
  SlipCorrection correction;
  bool twice;  // the precision
  const char* mechanism;
  bool snapshots, diary;
};

std::vector<Swept> all_swept() {
  using enum Ground;
  using enum SlipCorrection;
  constexpr const char *bang = "explosion", *force = "force:1,2", *moment = "moment:1,2,3";
  return {
      {"Order1", level, 1, 2, rigid, free, free, second, false, bang, true, false},
      {"Order3", level, 3, 4, mirror, free, absorbing, first, false, moment, false, false},
      {"Order5", level, 5, 2, absorbing, free, absorbing, second, false, bang, false, false},
      {"Order5FreeInTime4", level, 5, 4, free, free, absorbing, second, false, force, true, true},
      {"Order7", level, 7, 2, free, free, rigid, exponential, false, force, false, true},
      {"Order7InTime4", level, 7, 4, absorbing, free, absorbing, centred, false, force, true, false},
      {"Order9", level, 9, 2, mirror, mirror, mirror, centred, false, bang, true, true},
      {"Order11", level, 11, 2, absorbing, free, free, first, false, force, false, false},
      {"DoubleOrder1", level, 1, 4, free, free, absorbing, centred, true, force, false, true},
      {"DoubleOrder3", level, 3, 2, absorbing, absorbing, absorbing, exponential, true, bang, true, false},
      {"DoubleOrder5", level, 5, 2, free, free, free, second, true, moment, false, false},
      {"DoubleOrder7", level, 7, 4, mirror, free, absorbing, first, true, bang, true, false},
      {"DoubleOrder9", level, 9, 2, rigid, rigid, rigid, second, true, force, false, true},
      {"DoubleOrder11", level, 11, 2, mirror, free, free, exponential, true, bang, false, false},
      {"FittedOrder1", sea, 1, 2, mirror, free, absorbing, first, false, bang, false, false},
      {"FittedOrder3", hills, 3, 2, rigid, rigid, rigid, second, true, force, true, true},
      {"FittedOrder5", sea, 5, 2, absorbing, free, absorbing, exponential, false, bang, true, true},
      {"FittedOrder5Free", hills, 5, 2, free, free, free, second, false, force, false, false},
      {"FittedOrder5Rigid", hills, 5, 2, rigid, rigid, rigid, exponential, true, force, false, false},
      {"FittedOrder7", sea, 7, 4, free, free, absorbing, first, false, force, false, true},
      {"FittedOrder7Mirrored", sea, 7, 4, mirror, free, absorbing, centred, false, force, true, false},
      {"FittedOrder7Absorbed", hills, 7, 4, absorbing, absorbing, absorbing, second, false, force, false,
       false},
      {"FittedOrder9", hills, 9, 2, absorbing, free, absorbing, exponential, false, bang, false, false},
      {"FittedOrder11", sea, 11, 2, absorbing, free, absorbing, second, false, bang, false, false}};
}

Scene<2> scene_of(const Swept& of) {
  auto scene = over(of.ground);
  scene.edges[0] = {of.sides, of.sides};
  scene.edges[1] = {of.top, of.bottom};
  auto& numerics = scene.numerics;
  numerics.order = of.order, numerics.time_order = of.time_order;
  numerics.correction = of.correction, numerics.double_precision = of.twice;
  scene.survey.sources[0].mechanism = parse_mechanism<2>(of.mechanism);
  if (of.snapshots) scene.snapshot_every_s = 0.013;
  scene.slip_diary = of.diary;
  return scene;
}

using BitScenes = std::vector<BitScene>;
constexpr SlipCorrection all_corrections[] = {SlipCorrection::first, SlipCorrection::second,
                                              SlipCorrection::exponential, SlipCorrection::centred};

Scene<2> monotone(int order) {
  auto scene = sea();
  scene.numerics.order = order, scene.numerics.monotone = true;
  return scene;
}

/// Planes that part under stress there was before the waves.
Scene<2> opening(Ground ground, SlipCorrection correction) {
  auto scene = over(ground);
  for (auto& set : scene.model.fracture_sets)
    for (auto& system : set.systems) system.opens = true, system.strength_pa = 10;
  scene.model.prestress_pa.assign(3, Field<2>(scene.model.grid(), -20.F));
  scene.model.prestress_pa[2] = Field<2>(scene.model.grid(), 3.F);
  scene.numerics.correction = correction;
  scene.numerics.double_precision = correction == SlipCorrection::exponential;
  scene.slip_diary = correction != SlipCorrection::first;
  return scene;
}

/// Blocks, one system of which weakens, crossing planes and single ones.
Scene<2> weakening(SlipCorrection correction) {
  auto scene = sea();
  SlipSystem<2> weak{{0.6, 0.8}, 0.5, 10, 0};
  weak.law = FrictionLaw::slip_weakening, weak.slip_distance_m = 1e-6;
  scene.model.fracture_sets = {{"blocks", {weak, {{-0.8, 0.6}, 0.4, 0, 0}}},
                               {"crossing", {weak, {{1, 0}, 0.4, 0, 0}}},
                               {"one", {weak}}};
  fracture_rows(scene.model, 250, 270, 76, 96, 3);
  scene.numerics.correction = correction;
  return scene;
}

/// A plane wave through layers, one rock, or a rock between them.
Scene<2> plane_wave(const char* mechanism, double from_m, double lower_from_m, EdgeLaw top = absorbing) {
  auto scene = in_one_rock();
  fill(scene.model.medium, [=](const Index<2>& at) {
    const bool between = at[0] >= 100 && at[0] < 120 && at[1] == 56;
    return double(at[1]) * 5 < lower_from_m || between ? rock : soft;
  });
  scene.edges[1][0] = top;
  scene.survey.sources = {{{330, from_m}, parse_mechanism<2>(mechanism), parse_wavelet("ricker:80"), 1}};
  scene.survey.blended = {};
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.3, 1000, 0}}},
                               {"more", {{{0.8, -0.6}, 0.2, 0, 0}}}};
  scene.numerics.zone_cells = 10;
  scene.slip_diary = top == absorbing;
  if (top != free) return scene;
  scene.model.fracture = {}, scene.model.fracture_sets = {};
  scene.numerics.time_order = 4, scene.numerics.cfl = 1.5;
  return scene;
}

/// Water with a void over brine: the state holds one stress.
Scene<2> fluid(int order, EdgeLaw sides) {
  auto scene = sea();
  fill(scene.model.medium, [](const Index<2>& at) {
    const bool in_void = at[0] >= 60 && at[0] < 64 && at[1] >= 20 && at[1] < 30;
    return in_void ? nothing : at[1] > 50 + at[0] / 40 ? brine : water;
  });
  scene.model.fracture = {}, scene.model.fracture_sets = {};
  scene.edges[0] = {sides, sides};
  scene.numerics.order = order;
  if (order == 1) scene.snapshot_every_s = 0.05;
  scene.recording.duration_s *= 3;
  return scene;
}

/// Random Q from 5 to 1000 in blocks of cells, some of which do not attenuate.
template <int D>
Scene<D> attenuated(Scene<D> scene, unsigned seed, bool twice_in_time_4 = false) {
  auto& medium = scene.model.medium;
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> power(std::log(5.), std::log(1000.));
  for (const auto property : {Property::qp, Property::qs}) {
    medium[property] = Field<D>(medium.grid(), float(PropertyRow::infinite));
    for (std::size_t first = 0; first < medium.vp.size(); first += 20) {
      const bool elastic = engine() % 4 == 0;
      const auto q = float(std::exp(power(engine)));
      for (std::size_t cell = first; cell < std::min(first + 20, medium.vp.size()); ++cell)
        if (!elastic && (property == Property::qp ? !medium.is_void(cell) : medium.is_solid(cell)))
          medium[property][cell] = q;
    }
  }
  scene.numerics.double_precision = twice_in_time_4;
  if (twice_in_time_4) scene.numerics.time_order = 4;
  set_attenuation(scene);
  return scene;
}

/// Sources that do not begin together: rows near them are swept in two halves.
Scene<2> blended() {
  auto scene = in_one_rock();
  scene.model.fracture = {}, scene.model.fracture_sets = {};
  auto other = scene.survey.sources[0];
  other.position_m = {357, 245}, other.delay_s = 0.008;
  scene.survey.blended = {{other}};
  scene = attenuated(std::move(scene), 6);
  scene.numerics.double_precision = true;
  return scene;
}

SlipSystem<2> spring(const Point<2>& normal, double z_n, double z_t, double d_n = 0, double d_t = 0) {
  SlipSystem<2> system;
  system.normal = normal;
  system.law = FrictionLaw::none;
  system.compliance = {z_n, z_t, d_n, d_t, 1};
  return system;
}

/// Clusters of springs of all kinds; the last ones are so soft that their cells have stencils of their own.
BitScenes springs() {
  auto sliding = spring({0.6, 0.8}, 0.2 / mu, 0.5 / mu, 1e-3 * mu, 1e-3 * mu);
  sliding.law = FrictionLaw::coulomb, sliding.friction = 0.2, sliding.viscosity_s = 10;
  auto across = spring({-0.8, 0.6}, 0.1 / mu, 0);
  across.law = FrictionLaw::slip_weakening, across.friction = 0.5, across.slip_distance_m = 1e-9;
  auto block = sliding;
  block.compliance.normal_dashpot_pa_s_m = block.compliance.tangential_dashpot_pa_s_m = 0;
  struct Springs {
    const char* name;
    std::vector<SlipSystem<2>> systems;
    SlipCorrection correction;
    int time_order = 2;
    bool to_the_edges = false;
  };
  BitScenes all;
  for (const auto& of : std::vector<Springs>{
           {"One", {spring({0.6, 0.8}, 0.4 / mu, 0.7 / mu)}, SlipCorrection::second},
           {"TwoInTime4",
            {spring({0, 1}, 0.4 / mu, 0.7 / mu), spring({0.8, 0.6}, 0, 2 / mu)},
            SlipCorrection::exponential,
            4},
           {"ToTheEdges", {spring({0.6, 0.8}, 0.4 / mu, 0.7 / mu)}, SlipCorrection::second, 2, true},
           {"ViscousToTheEdges", {{{0.6, 0.8}, 0, 10, 0}}, SlipCorrection::second, 2, true},
           {"Sliding", {sliding}, SlipCorrection::first},
           {"SlidingBlocks", {block, across}, SlipCorrection::second},
           {"SlidingCentred", {sliding}, SlipCorrection::centred},
           {"SlidingBlocksCentred", {block, across}, SlipCorrection::centred},
           {"Soft",
            {spring({0.6, 0.8}, 300 / mu, 300 / mu), spring({1, 0}, 300 / mu, 300 / mu)},
            SlipCorrection::centred}})
    all.push_back({"Springs" + std::string(of.name), [=] {
                     auto scene = in_one_rock();
                     for (auto& code : scene.model.fracture)
                       code = of.to_the_edges ? 1 : std::min<std::uint8_t>(code, 1);
                     scene.model.fracture_sets = {{"springs", of.systems}};
                     scene.numerics.correction = of.correction;
                     scene.numerics.time_order = of.time_order;
                     scene.survey.sources[0].mechanism = parse_mechanism<2>("force:1,2");
                     return scene;
                   }});
  return all;
}

/// A slab of planes that dips, so that its edges cut cells everywhere.
BitScenes cut_cells() {
  SlipSystem<2> dry{normal_of_dip(50), 0.2, 300, 100}, across{normal_of_dip(-10), 0.3, 0, 50};
  auto weak = dry, opens = dry, springs = dry, springs_across = dry;
  weak.law = FrictionLaw::slip_weakening, weak.dynamic_friction = 0.05, weak.slip_distance_m = 1e-7;
  opens.opens = true;
  springs.law = FrictionLaw::none, springs.compliance = {1e-11, 3e-11, 0, 0, 1};
  springs_across = springs, springs_across.normal = across.normal;
  auto sliding = springs;
  sliding.law = FrictionLaw::coulomb;
  BitScenes all;
  for (const auto& [name, systems] : std::vector<std::pair<std::string, std::vector<SlipSystem<2>>>>{
           {"Friction", {dry}},
           {"Blocks", {dry, across}},
           {"Weakening", {weak}},
           {"Opening", {opens}},
           {"Springs", {springs}},
           {"TwoSprings", {springs, springs_across}},
           {"SlidingSprings", {sliding}}})
    all.push_back({"CutCells" + name, [systems = systems] {
                     auto scene = in_one_rock();
                     scene.model.fracture = {}, scene.model.fracture_sets = {};
                     add_fractures<2>(scene.model, {"slab", systems}, parse_slab("350,240:130,57:25"));
                     scene.slip_diary = systems[0].slides();
                     scene.snapshot_every_s = 0.02;
                     return scene;
                   }});
  // Its rows are patches, in a copy, once the source is over; what that has left in the stress stays.
  all.push_back({"CutCellsAfterTheirSource", [=] {
                   auto scene = in_one_rock(330);
                   scene.model.fracture = {}, scene.model.fracture_sets = {};
                   add_fractures<2>(scene.model, {"slab", {springs}}, parse_slab("350,240:130,57:25"));
                   scene.survey.blended = {};
                   scene.survey.sources[0].wavelet = parse_wavelet("ricker:240");
                   return scene;
                 }});
  return all;
}

/// Fractures on faces, at an order.
Scene<2> faces(Scene<2> scene, int order) {
  make_short(scene, 0.05);
  // Amid springs tractions begin before velocities are large enough for a number.
  scene.survey.sources[0].position_m = {order == 11 ? 203. : 380., 261};
  scene.survey.sources[0].amplitude = 1e7;
  scene.slip_diary = order != 11;
  scene.numerics.order = order;
  scene.numerics.double_precision = order == 1;
  return scene;
}

/// Along springs the order is lower in some rows on both sides, whichever ranks have them.
Scene<2> springs_everywhere() {
  auto scene = two_rocks();
  std::vector<FractureTrace<2>> springs;
  for (double depth = 60; depth < 760; depth += 20) springs.push_back({{150, depth}, {300, depth}});
  add_faces(scene.model, 2e-11, 5e-11, springs);
  return scene;
}

/// Rock and hills, a source near the surface, all that can be recorded.
Scene<2> recorded(int time_order, bool twice) {
  using enum Component;
  auto scene = fitted_hills(150, 110);
  scene.survey.sources[0].position_m = {602, 160};
  scene.survey.receivers_m = {{630, 150}, {562.5, 201.3}, {540, 183}, {502, 251}, {605, 208}};
  scene.recording = {{ux, uz, ax, vz, az, exx, ezz, exz, div, curl, das}, 0, 0.001, Fibre{30, 0, 62}};
  make_short(scene, 0.03);
  scene.numerics.time_order = time_order, scene.numerics.double_precision = twice;
  if (time_order == 4) scene.numerics.cfl = 1.5;
  return scene;
}

/// Rock below ground in steps up and down, with an overhang.
Scene<2> steps(int order) {
  auto scene = in_one_rock();
  std::mt19937 engine(2);
  std::vector<std::int64_t> tops;
  for (std::int64_t top = 12; tops.size() < 400; tops.insert(tops.end(), 1 + engine() % 14, top))
    top = std::clamp<std::int64_t>(top + std::int64_t(engine() % 7) - 3, 6, 20);
  fill(scene.model.medium, [&](const Index<2>& at) {
    const bool cave = at[0] >= 60 && at[0] < 66 && at[1] >= 22 && at[1] < 31;
    return at[1] < tops[std::size_t(at[0])] || cave ? nothing : rock;
  });
  scene.model.fracture = {}, scene.model.fracture_sets = {};
  scene.edges[0] = {free, free}, scene.edges[1][0] = free;
  scene.survey.sources[0].position_m = {248, 172};
  scene.survey.receivers_m = {{120, 145}, {377, 136}, {470, 143}};
  scene.numerics.order = order;
  return scene;
}

/// An upright sheet of water in rock, from the top to the bottom.
Scene<2> walls(int order, int time_order) {
  auto scene = in_one_rock();
  fill(scene.model.medium, [](const Index<2>& at) { return at[0] >= 60 && at[0] < 80 ? water : rock; });
  scene.model.fracture = {}, scene.model.fracture_sets = {};
  scene.survey.sources[0].position_m = {268, 172};
  scene.survey.receivers_m = {{295, 145}, {303, 190}, {290, 260}};
  scene.numerics.order = order, scene.numerics.time_order = time_order;
  scene.numerics.double_precision = time_order == 4;
  return scene;
}

BitScenes of_effects() {
  BitScenes all;
  const auto add = [&](const std::string& name, auto make) { all.push_back({name, std::move(make)}); };
  add("Monotone3", [] { return monotone(3); });
  add("Monotone7", [] { return monotone(7); });
  for (const auto correction : all_corrections) {
    const auto number = std::to_string(int(correction));
    add("Opening" + number, [=] { return opening(Ground::level, correction); });
    add("Weakening" + number, [=] { return weakening(correction); });
  }
  add("FittedOpening", [] { return opening(Ground::sea, SlipCorrection::second); });
  add("PlaneWaveDown", [] { return plane_wave("plane:0", 0, 300); });
  add("PlaneWaveAslant", [] { return plane_wave("plane:20", 0, 1e9); });
  add("PlaneWaveInLayers", [] { return plane_wave("plane:25", 0, 300); });
  add("PlaneWaveUpwards", [] { return plane_wave("plane-s:200", 440, 300, free); });
  add("FluidOrder1", [] { return fluid(1, mirror); });
  add("FluidOrder1Pml", [] { return fluid(1, absorbing); });
  add("FluidOrder5", [] { return fluid(5, mirror); });
  add("FluidOrder5Pml", [] { return fluid(5, absorbing); });
  add("Attenuation", [] { return attenuated(sea(), 1); });
  add("AttenuationInTime4", [] { return attenuated(sea(), 1, true); });
  add("AttenuationInFluid", [] { return attenuated(fluid(5, absorbing), 2); });
  add("AttenuationOfBlended", [] { return blended(); });
  for (const int order : {1, 7}) {
    add("FacesOrder" + std::to_string(order), [=] { return faces(cracked(), order); });
    add("FrictionOnFacesOrder" + std::to_string(order), [=] { return faces(faulted(), order); });
  }
  add("FacesOrder11", [] { return faces(springs_everywhere(), 11); });
  add("Records", [] { return recorded(2, false); });
  add("RecordsInTime4", [] { return recorded(4, false); });
  add("RecordsDouble", [] { return recorded(4, true); });
  for (const int time_order : {2, 4})
    add("WideInTime" + std::to_string(time_order), [=] {
      auto scene = sea(640);
      scene.numerics.time_order = time_order;
      return scene;
    });
  for (const int order : {3, 7}) add("StepsOrder" + std::to_string(order), [=] { return steps(order); });
  add("WallsOrder5", [] { return walls(5, 2); });
  add("WallsOrder7InTime4", [] { return walls(7, 4); });
  // Whose rows take half sweeps to the end.
  add("LastingMoment", [] {
    auto scene = in_one_rock();
    scene.model.fracture = {}, scene.model.fracture_sets = {};
    scene.survey.sources[0].mechanism = parse_mechanism<2>("double-couple:30");
    scene.survey.sources[0].wavelet = parse_wavelet("gauss:80");
    return scene;
  });
  add("Intact", [] {
    auto scene = sea();
    scene.model.fracture = {}, scene.model.fracture_sets = {};
    return scene;
  });
  return all;
}

/// What is the same for all scenes in space.
Scene<3> in_3d(Medium<3> medium, EdgeLaw sides, const char* mechanism) {
  auto scene = solver::scene_of(std::move(medium), edges_all_3d(sides), {87, 47, 112}, mechanism, "ricker:80",
                                {{112.5, 52.5, 137.5}, {41, 33.4, 51}, {62, 40, 188}},
                                {Component::vx, Component::vy, Component::syz, Component::p}, 0, 0.001);
  scene.edges[2][0] = free;
  scene.numerics.zone_cells = 4;
  make_short(scene, 0.01);
  return scene;
}

/// Lumps of rock, softer rock, water and void, with fractures round the source.
Scene<3> lumps_with(EdgeLaw sides, int order, int time_order, const char* mechanism) {
  const Index<3> shape = long_form() ? Index<3>{70, 24, 64} : Index<3>{26, 16, 64};
  auto scene = in_3d(lumps(shape, 5, 7), sides, mechanism);
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 18; k < 36; ++k)
    for (std::int64_t j = 6; j < 15; ++j)
      for (std::int64_t i = 12; i < 24; ++i) {
        put(scene.model.medium, {i, j, k}, rock);
        scene.model.fracture({i, j, k}) = i != 17 || j != 9;
      }
  for (const auto& at : scene.survey.receivers_m)
    put(scene.model.medium, cell_of(scene.model.grid(), at), rock);
  scene.model.fracture_sets = {{"cracks", {{{0, 0.6, 0.8}, 0.4, 1000, 0}}}};
  scene.numerics.order = order, scene.numerics.time_order = time_order;
  scene.slip_diary = sides != mirror;
  if (sides == mirror) scene.snapshot_every_s = 0.004;
  return scene;
}

Scene<3> fitted(EdgeLaw sides) {
  auto scene = fitted_sea_3d(long_form() ? Index<3>{40, 22, 60} : Index<3>{34, 16, sides == free ? 44 : 60});
  for (int axis = 0; axis < 3; ++axis) scene.edges[axis] = {sides, sides};
  scene.edges[2][0] = free;
  scene.numerics.zone_cells = 4;
  make_short(scene, sides == free ? 0.006 : 0.008);
  scene.numerics.order = sides == free ? 7 : 5, scene.numerics.time_order = sides == free ? 4 : 2;
  scene.numerics.double_precision = sides == absorbing;
  scene.slip_diary = true;
  return scene;
}

/// Some discs that cross, soft and stiff.
Scene<3> discs(int time_order) {
  auto scene = in_3d(uniform_cube({22, 18, 44}, 5, rock), free, "force:3,1,2");
  scene.survey.receivers_m = {{34, 41, 142}, {57, 85, 123}};
  const auto add = [&](const FractureTrace<3>& polygon, double z_n, double z_t) {
    SlipSystem<3> system{normal_of_polygon(polygon), 0, 0, 0, false, FrictionLaw::none};
    system.compliance = {z_n, z_t, 0, 0, 0};
    add_single_fractures(scene.model, {"one", {system}, {polygon}});
  };
  add(parse_disc("55,50,125:33:35:20"), 1e-10, 3e-10);
  add(parse_disc("60,55,120:30:80:-70"), 1e-8, 1e-9);
  add(parse_rectangle("50,52,123:50,40"), 1e-11, 0);
  scene.numerics.time_order = time_order;
  scene.snapshot_every_s = 0.004;
  return scene;
}

Scene<3> pool() {
  auto scene = in_3d(uniform_cube({26, 16, 64}, 5, water), absorbing, "explosion");
  fill(scene.model.medium, [](const Index<3>& at) { return at[2] > 30 + at[0] / 4 ? brine : water; });
  scene.survey.receivers_m[0][0] = 102;
  scene.recording.duration_s *= 2;
  return scene;
}

/// Water beside rock along x and along y.
Scene<3> walls_in_space() {
  auto scene = in_3d(uniform_cube({40, 18, 64}, 5, rock), absorbing, "force:3,1,2");
  fill(scene.model.medium, [](const Index<3>& at) { return at[0] < 10 || at[1] < 8 ? water : rock; });
  return scene;
}

/// A plane wave in layers that comes along none of the axes.
Scene<3> plane_wave_with_an_azimuth() {
  auto scene = in_3d(uniform_cube({12, 10, 40}, 5, rock), absorbing, "plane-s:20,60");
  fill(scene.model.medium, [](const Index<3>& at) { return at[2] < 12 ? rock : soft; });
  scene.edges[2][0] = absorbing;
  scene.survey.sources[0].position_m = {25, 30, 10};
  scene.survey.receivers_m = {{42.5, 12.5, 42.5}};
  scene.model.fracture = Field<3, std::uint8_t>(scene.model.grid());
  return scene;
}

BitScenes in_three_dimensions() {
  const char *force = "force:1,2,3", *moment = "moment:1,2,3,4,5,6";
  BitScenes all = {{"SpaceOrder7", [=] { return lumps_with(free, 7, 2, force); }},
                   {"SpaceOrder5", [=] { return lumps_with(absorbing, 5, 2, "explosion"); }},
                   {"SpaceOrder3InTime4", [=] { return lumps_with(mirror, 3, 4, moment); }},
                   {"SpaceAttenuation", [=] { return attenuated(lumps_with(absorbing, 5, 2, moment), 3); }},
                   {"SpaceFitted", [] { return fitted(absorbing); }},
                   {"SpaceFittedInTime4", [] { return fitted(free); }},
                   {"SpaceDiscs", [] { return discs(2); }},
                   {"SpaceFluid", [] { return pool(); }},
                   {"SpaceWalls", [] { return walls_in_space(); }},
                   {"SpacePlaneWave", [] { return plane_wave_with_an_azimuth(); }}};
  if (long_form()) all.push_back({"SpaceDiscsInTime4", [] { return discs(4); }});
  return all;
}

}  // namespace

std::vector<BitScene> bit_scenes() {
  BitScenes all;
  for (const auto& of : all_swept()) all.push_back({of.name, [of] { return scene_of(of); }});
  for (const auto& more : {of_effects(), springs(), cut_cells(), in_three_dimensions()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

template <int D>
bool remove_effect_of(Scene<D>& scene) {
  auto& model = scene.model;
  bool weakens = false;
  for (auto& set : model.fracture_sets)
    for (auto& system : set.systems)
      if (system.law == FrictionLaw::slip_weakening) system.law = FrictionLaw::coulomb, weakens = true;
  if (!model.fracture_share.empty())
    model.fracture_share = {};
  else if (scene.attenuation)
    scene.attenuation = {};
  else if (scene.numerics.monotone)
    scene.numerics.monotone = false;
  else if (!weakens && model.fracture_sets.empty())
    return false;
  else if (!weakens)
    scene.with_slip = false;
  return true;
}
template bool remove_effect_of(Scene<2>& scene);
template bool remove_effect_of(Scene<3>& scene);

}  // namespace slipwave::solver
