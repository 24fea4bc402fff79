// SPDX-License-Identifier: BSD-3-Clause
// Single fractures of models in 3-D, discs that cells beside them share, against closed forms and 2-D
// (docs/theory.md (S30)).
#include <gtest/gtest.h>

#include <cstdlib>

#include "cube_extruded.hpp"
#include "disc_radiation.hpp"
#include "model/planar_fracture.hpp"
#include "model/single_fracture.hpp"
#include "shared_out.hpp"

namespace slipwave::solver::disc_test {
namespace {

constexpr double pi = std::numbers::pi, slow_m = 75;  // of S waves at the peak of 30 Hz

void add(Model<3>& model, const FractureTrace<3>& polygon, double z_n, double z_t) {
  SlipSystem<3> system{normal_of_polygon(polygon), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {z_n, z_t, 0, 0, 0};
  add_single_fractures(model, {"one", {system}, {polygon}});
}

/// The same of one that may reach beyond the model.
void add_beyond(Model<3>& model, const FractureTrace<3>& polygon, double z_n, double z_t) {
  SlipSystem<3> system{normal_of_polygon(polygon), 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {z_n, z_t, 0, 0, 0};
  model.fracture_sets.push_back({"one", {system}, {polygon}});
  if (model.fracture.empty()) model.fracture = Field<3, std::uint8_t>(model.grid());
  place_single_fractures(model);
}

Complex spectrum(const std::vector<double>& samples, double omega, double interval_s = 0.001) {
  Complex sum = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    sum += samples[n] * std::polar(interval_s, omega * double(n) * interval_s);
  return sum;
}

/// What a disc about the origin sends off, of an explosion and to receivers near it. Planes of symmetry,
/// across y and where `level` across x, stand for the rest of space; nothing is back from the other edges, so
/// many wavelengths of S waves away, before the last sample. So many cells in such a wavelength.
struct DiscScene {
  CompliantDisc disc;
  bool level = false;
  int cells = 16;
  Point<3> source = {20, 0, -90};
  int wavelengths = 5;
  double duration_s = 0.18;
  bool absorbing = false;  // the edges, so that few wavelengths do

  double images() const { return level ? 4 : 2; }
  Scene<3> scene(bool with_disc) const {
    const double h = slow_m / cells;
    const auto n = std::int64_t(wavelengths * cells);
    const Index<3> shape = {level ? n : 2 * n, n, 2 * n};
    const Point<3> origin = {level ? 0 : -double(n) * h, 0, -double(n) * h};
    auto edges = edges_all_3d(absorbing ? EdgeLaw::absorbing : EdgeLaw::free);
    edges[1][0] = EdgeLaw::mirror;
    if (level) edges[0][0] = EdgeLaw::mirror;
    auto scene = scene_of(uniform_cube(shape, h, rock, origin), edges, source, "explosion", "ricker:30",
                          {{75, 3, 4}, {2, 70, -20}, {5, 4, 72}, {50, 45, 35}, {40, 30, -50}, {20, 60, 40}},
                          {Component::vx, Component::vy, Component::vz}, duration_s, 0.001);
    if (with_disc)
      add_beyond(scene.model, disc_of(disc.centre_m, disc.radius_m, disc.normal), disc.normal_m_per_pa,
                 disc.tangential_m_per_pa);
    scene.numerics.order = 7;
    scene.numerics.zone_cells = 10;
    scene.numerics.double_precision = true;
    return scene;
  }
  /// All receivers, three components, at 20, 30 and 40 Hz.
  double error() const {
    const auto disturbed = scene(true);
    const auto with = shoot(disturbed, 1), without = shoot(scene(false), 1);
    std::vector<double> wavelet;
    for (int n = 0; n < 150; ++n) wavelet.push_back(disturbed.survey.sources[0].wavelet(n * 0.001));
    const auto& receivers = disturbed.survey.receivers_m;
    double off = 0, all = 0;
    for (const double hz : {20., 30., 40.}) {
      const double omega = 2 * pi * hz;
      const auto u = scattered_by(disc, rock, omega, source, receivers);
      // Velocity of an explosion of the moment rate w is the displacement of one of the moment w.
      const Complex strength = images() * 1e9 * spectrum(wavelet, omega);
      for (std::size_t n = 0; n < 3 * receivers.size(); ++n) {
        const auto found =
            spectrum(with.traces[n].samples, omega) - spectrum(without.traces[n].samples, omega);
        const auto wanted = strength * u[n % receivers.size()][n / receivers.size()];
        off += std::norm(found - wanted);
        all += std::norm(wanted);
      }
    }
    return std::sqrt(off / all);
  }
};

/// Of 90 m across, about a point a little off the centres and the corners of cells.
CompliantDisc dipping(double dip_deg, double normal, double tangential) {
  const double dip = dip_deg * pi / 180;
  return {{1, 0, -1}, {std::sin(dip), 0, std::cos(dip)}, 45, normal, tangential};
}

TEST(DiscRadiation, IsThatOfTheClosedFormsItIsMadeOf) {
  // An explosion among moments is the gradient of phi; its stress is Hooke's of that.
  const double omega = 2 * pi * 30, step = 1e-3;
  const Point<3> x = {70, -40, 55};
  Matrix explosion{};
  for (std::size_t i = 0; i < 3; ++i) explosion[i][i] = 1;
  Matrix gradient{};
  for (std::size_t j = 0; j < 3; ++j) {
    auto high = x, low = x;
    high[j] += step, low[j] -= step;
    const auto u = displacement_of_moment(rock, omega, explosion, high),
               v = displacement_of_moment(rock, omega, explosion, low);
    for (std::size_t i = 0; i < 3; ++i) gradient[i][j] = (u[i] - v[i]) / (2 * step);
  }
  const auto stress = stress_of_explosion(rock, omega, x);
  const Complex trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_LT(std::abs(stress[i][j] - rock.mu() * (gradient[i][j] + gradient[j][i]) -
                         (i == j ? rock.lambda() * trace : 0.)),
                1e-6 * std::abs(stress[0][0]));
}

// Proves (S30).
TEST(Disc, ScattersAsTheMomentOfItsJumpRadiates) {
  // Little compliance, in shear and in tension: waves that the disc sends to itself are a tenth of a percent.
  // S waves have passed the receivers 75 m away after 0.14 s.
  EXPECT_LT((DiscScene{dipping(30, 2e-12, 1e-12), false, 12, {20, 0, -90}, 2, 0.14, true}.error()), 0.05);
}

TEST(Disc, ThatIsLevelScattersAsTheMomentOfItsJumpRadiatesLong) {
  DiscScene level{dipping(0, 2e-12, 2e-12), true, 16, {0, 0, -90}};
  level.disc.centre_m[0] = 0;
  EXPECT_LT(level.error(), 0.03);
}

// The table of docs/slip.md: dip, and whether planes shear or part.
class DiscInSmallerCells : public ::testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(DiscInSmallerCells, ScattersCloserToTheClosedFormLong) {
  const auto [dip, shear] = GetParam();
  const auto disc = dipping(dip, shear ? 0 : 2e-12, shear ? 2e-12 : 0);
  // Waves that come along a disc would shear it little.
  const Point<3> from = dip == 90 ? Point<3>{60, 0, -70} : Point<3>{20, 0, -90};
  const double coarse = DiscScene{disc, false, 8, from}.error(),
               fine = DiscScene{disc, false, 16, from}.error();
  std::printf("dip %g, %s: 8 cells %.2f %%, 16 cells %.2f %%\n", dip, shear ? "shear" : "tension",
              100 * coarse, 100 * fine);
  EXPECT_GT(observed_order(coarse, fine), 1.5);
  // Before a disc much is S waves that go back along the normal, of which (S33a) leaves 0.93 at 40 Hz.
  EXPECT_LT(fine, dip < 90 ? 0.03 : shear ? 0.07 : 0.035);
}
INSTANTIATE_TEST_SUITE_P(Dips, DiscInSmallerCells,
                         ::testing::Combine(::testing::Values(0., 30., 90.), ::testing::Bool()));

/// Some discs that cross, soft and stiff.
Scene<3> crossing_scene(const Index<3>& shape) {
  auto scene = scene_of(uniform_cube(shape, 5, rock), edges_all_3d(EdgeLaw::free), {41, 32, 38},
                        "force:3,1,2", "ricker:40", {{34, 41, 92}, {57, 85, 73}},
                        {Component::vx, Component::vy, Component::vz}, 0.06, 0.001);
  add(scene.model, parse_disc("55,50,65:33:35:20"), 1e-10, 3e-10);
  add(scene.model, parse_disc("60,55,60:30:80:-70"), 1e-8, 1e-9);
  add(scene.model, parse_rectangle("50,52,63:50,40"), 1e-11, 0);
  return scene;
}

TEST(Discs, HaveTheSameTracesWhereAxesAreTurned) {
  // x, y, z become y, z, x: what is left is of sweeps along the axes in their order, of second order.
  const auto scene = crossing_scene({22, 21, 24});
  const auto turned = [](const Point<3>& at) { return Point<3>{at[2], at[0], at[1]}; };
  auto other = crossing_scene({24, 22, 21});
  other.model.fracture_sets.clear(), other.model.fracture = {};
  for (auto set : scene.model.fracture_sets) {
    for (auto& vertex : set.traces[0]) vertex = turned(vertex);
    add(other.model, set.traces[0], set.systems[0].compliance.normal_m_per_pa,
        set.systems[0].compliance.tangential_m_per_pa);
  }
  other.survey.sources[0].position_m = turned(scene.survey.sources[0].position_m);
  other.survey.sources[0].mechanism = parse_mechanism<3>("force:2,3,1");
  for (auto& receiver : other.survey.receivers_m) receiver = turned(receiver);
  const auto difference = [](Scene<3> of, Scene<3> turned_one, double cfl) {
    of.numerics.cfl = turned_one.numerics.cfl = cfl;
    of.numerics.double_precision = turned_one.numerics.double_precision = true;
    const auto one = shoot(of, 1), two = shoot(turned_one, 1);
    const auto count = of.survey.receivers_m.size();
    std::vector<double> found, wanted;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t n = 0; n < count; ++n) {
        const auto &a = one.traces[axis * count + n].samples,
                   &b = two.traces[(axis + 1) % 3 * count + n].samples;
        wanted.insert(wanted.end(), a.begin(), a.end());
        found.insert(found.end(), b.begin(), b.end());
      }
    return relative_error(found, wanted);
  };
  const double coarse = difference(scene, other, 0.4), fine = difference(scene, other, 0.2);
  EXPECT_LT(fine, 0.01);
  EXPECT_GT(observed_order(coarse, fine), 1.5);
}

// Proves (S30), (S33a).
TEST(Disc, ThatIsLevelWithoutEndReflectsAsSchoenbergsInterface) {
  // At normal incidence -i omega Z rho c/2 over 1 - i omega Z rho c/2, of P waves with Z_N, of S waves with
  // Z_T.
  const double h = 4.6875, away = 20.3 * h;
  for (const bool shear : {false, true}) {
    // S waves move along walls that would hold them: not even P waves come from these before the end.
    const Index<3> shape = {shear ? 400 : 1, 1, 108};
    const double speed = shear ? rock.vs : rock.vp, z = shear ? 6e-11 : 3e-11, depth = 44.25 * h,
                 x = double(shape[0]) / 2 * h;
    auto scene = scene_of(uniform_cube(shape, h, rock), edges_all_3d(EdgeLaw::mirror), {x, h / 2, 20 * h},
                          shear ? "plane-s:0" : "plane:0", "ricker:30",
                          {{x, h / 2, depth - away}, {x, h / 2, depth + away}},
                          {shear ? Component::vx : Component::vz}, 0.2, 0.001);
    scene.edges[2] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
    if (shear) scene.edges[0] = scene.edges[2];
    scene.survey.sources[0].amplitude = 1;
    scene.numerics.order = 7;
    scene.numerics.double_precision = true;
    check(scene);
    const auto without = shoot(scene, 1);
    const double far = 1e4;
    add_beyond(scene.model, {{-far, -far, depth}, {far, -far, depth}, {far, far, depth}, {-far, far, depth}},
               shear ? 0 : z, shear ? z : 0);
    const auto with = shoot(scene, 1);
    for (const double hz : {15., 30., 45.}) {
      const double omega = 2 * pi * hz;
      const Complex half(0, -omega * z * rock.rho * speed / 2);
      const auto incident = spectrum(without.traces[0].samples, omega);
      for (const std::size_t side : {0, 1}) {
        const auto found =
            (spectrum(with.traces[side].samples, omega) - spectrum(without.traces[side].samples, omega)) /
            incident;
        // Of what comes back the shares of cells leave as much as of the wave number 2 k (S33a).
        const double kh = omega * h / speed, left = side == 0 ? std::pow(std::sin(kh) / kh, 3) : 1;
        // From the receiver above to the plane and back, or on to the one below; traction changes sign.
        const auto wanted =
            (side == 0 ? left : -1.) * half / (1. + half) * std::polar(1., omega * 2 * away / speed);
        EXPECT_LT(std::abs(found - wanted), 0.03 * std::abs(wanted))
            << (shear ? "S " : "P ") << hz << " Hz, side " << side << found << wanted;
      }
    }
  }
}

TEST(Discs, AreRockWithoutTheirCompliance) {
  auto whole = crossing_scene({22, 21, 24}), without = whole;
  whole.with_slip = false;
  remove_effect(without.model, ModelEffect::compliance);
  EXPECT_TRUE(samples_of(shoot(without, 1)) == samples_of(shoot(whole, 1)));
}

// Proves (S30).
TEST(Discs, AlongYGiveTheTracesOfLinesIn2D) {
  // A slice one cell thick: rectangles across it are lines, which (S30) cuts into other pieces.
  auto both = extruded({0, 2}, edges_of(EdgeLaw::free, EdgeLaw::absorbing, EdgeLaw::absorbing), "force:1,2",
                       "force:1,0,2", {Component::vx, Component::vz, Component::sxz},
                       {Component::vx, Component::vz, Component::sxz});
  SlipSystem<2> line{{0, 1}, 0, 0, 0, false, FrictionLaw::none};
  line.compliance = {2e-10, 5e-10, 0, 0, 0};
  const FractureTrace<2> trace = {{120.7, 120.2}, {271.3, 181.6}};
  auto intact = both.flat;
  add_single_fractures(both.flat.model, {"line", {line}, {trace}});
  // As wide as makes all points count to the one cell by whole shares.
  const double far = 20;
  add_beyond(both.deep.model,
             {{trace[0][0], -far, trace[0][1]},
              {trace[1][0], -far, trace[1][1]},
              {trace[1][0], far, trace[1][1]},
              {trace[0][0], far, trace[0][1]}},
             2e-10, 5e-10);
  EXPECT_GT(relative_error(samples_of(shoot(both.flat, 1)), samples_of(shoot(intact, 1))), 0.05);
  EXPECT_LT(largest_error(both), 1e-3);
}

}  // namespace
}  // namespace slipwave::solver::disc_test
