// SPDX-License-Identifier: BSD-3-Clause
// Planes that give way as springs: what they make of the stress of a cell, of the speeds of a cluster, and of
// friction above them (docs/theory/fractures.md).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "lab.hpp"
#include "shared_out.hpp"
#include "solver/effect/linear_slip.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::linear_slip_cells_test {
namespace {

constexpr Rock rock{4500, 2250, 2500};
const double mu = rock.mu(), modulus = rock.rho * rock.vp * rock.vp, lambda = modulus - 2 * mu;
constexpr double pi = std::numbers::pi, dt_s = 1e-3;

template <int D>
using Tensor = SymmetricTensor<D, double>;

template <int D>
SlipSystem<D> spring(const Point<D>& normal, double z_n, double z_t, double d_n = 0, double d_t = 0) {
  SlipSystem<D> system;
  system.normal = normal;
  system.law = FrictionLaw::none;
  system.compliance = {z_n, z_t, d_n, d_t, 1};
  return system;
}

/// Some cells of rock, all of one set, whose effects are applied by hand: double precision.
template <int D>
class Cells {
 public:
  Cells(const std::vector<SlipSystem<D>>& systems, SlipCorrection correction) {
    Grid<D> grid;
    for (auto& n : grid.shape) n = 5;
    grid.spacing_m = 1;
    scene_.model.medium = {Field<D>(grid, float(rock.vp)), Field<D>(grid, float(rock.vs)),
                           Field<D>(grid, float(rock.rho))};
    scene_.model.fracture = Field<D, std::uint8_t>(grid, 1);
    scene_.model.fracture_sets = {{"set", systems}};
    check(scene_.model);
    scene_.numerics.correction = correction;
    EdgeLaws<D> edges;
    for (int axis = 0; axis < D; ++axis) edges[axis] = {EdgeLaw::rigid, EdgeLaw::rigid};
    domain_ = make_domain(scene_.model.medium, edges, 1);
    state_ = make_state<D, double>(domain_.grid.shape);
    if (gives(scene_.model.fracture_sets[0]))
      springs_ = std::make_unique<LinearSlip<D, double>>(state_, domain_, scene_, dt_s);
    if (slides(scene_.model.fracture_sets[0]))
      slip_ = std::make_unique<Slip<D, double>>(state_, domain_, scene_, dt_s);
  }
  /// A step in which the strain of all cells grows by that much; returns the stress at its end.
  Tensor<D> strain(const Tensor<D>& by) {
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += by(i, i);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) add(i, j, 2 * mu * by(i, j) + (i == j ? lambda * trace : 0));
    if (springs_) run_everywhere(*springs_, time_, state_);
    if (slip_) run_everywhere(*slip_, time_, state_);
    const auto found = stress();
    if (slip_) run_after_everywhere(*slip_, time_, state_);
    if (springs_) run_after_everywhere(*springs_, time_, state_);
    return found;
  }

 private:
  double& at(int i, int j) {
    Index<D> row;
    row.fill(2);
    row[0] = 0;
    return state_.field_row(row, FieldRows<D>::normal_stress(0) + Tensor<D>::place(i, j))[3];
  }
  void add(int i, int j, double change) { at(i, j) += change; }
  Tensor<D> stress() {
    Tensor<D> s;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) s(i, j) = at(i, j);
    return s;
  }
  Scene<D> scene_;
  Domain<D> domain_;
  State<D, double> state_;
  std::unique_ptr<LinearSlip<D, double>> springs_;
  std::unique_ptr<Slip<D, double>> slip_;
  StepTime time_{0, dt_s};
};

/// Compliance of rock and planes: strain of a stress.
template <int D>
Tensor<D> strain_of(const Tensor<D>& s, const std::vector<SlipSystem<D>>& systems) {
  Tensor<D> e;
  double trace = 0;
  for (int i = 0; i < D; ++i) trace += s(i, i);
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      e(i, j) = (s(i, j) - (i == j ? lambda * trace / (D * lambda + 2 * mu) : 0)) / (2 * mu);
  for (const auto& system : systems) {
    const auto of = compliance_in(system.compliance, lambda, mu);
    const auto& n = system.normal;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        double s_n = 0, t_i = 0, t_j = 0;
        for (int a = 0; a < D; ++a) {
          t_i += s(i, a) * n[std::size_t(a)], t_j += s(j, a) * n[std::size_t(a)];
          for (int b = 0; b < D; ++b) s_n += n[std::size_t(a)] * s(a, b) * n[std::size_t(b)];
        }
        const double n_i = n[std::size_t(i)], n_j = n[std::size_t(j)];
        e(i, j) += of.normal * s_n * n_i * n_j +
                   of.tangential * ((t_i - s_n * n_i) * n_j + n_i * (t_j - s_n * n_j)) / 2;
      }
  }
  return e;
}

template <int D>
void expect_effective_stiffness(const std::vector<SlipSystem<D>>& systems, SlipCorrection correction) {
  Cells<D> cells(systems, correction);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1e-5, 1e-5);
  Tensor<D> total;
  for (int step = 0; step < 30; ++step) {
    Tensor<D> by;
    for (auto& value : by.values) value = uniform(engine);
    const auto strain = strain_of<D>(cells.strain(by), systems);
    for (std::size_t c = 0; c < by.values.size(); ++c) {
      total.values[c] += by.values[c];
      EXPECT_NEAR(strain.values[c], total.values[c], 1e-12) << "step " << step << ", component " << c;
    }
  }
}

constexpr SlipCorrection all_corrections[] = {SlipCorrection::first, SlipCorrection::second,
                                              SlipCorrection::exponential, SlipCorrection::centred};

// Proves (S19), (S20), (S22).
TEST(SpringCell, HasTheStiffnessOfRockAndPlanesTogether) {
  for (const auto correction : all_corrections) {
    for (const double soft : {1e-3, 1., 300.}) {
      expect_effective_stiffness<2>({spring<2>({0.6, 0.8}, soft / mu, 0.3 * soft / mu)}, correction);
      expect_effective_stiffness<2>({spring<2>({0, 1}, 0, soft / mu)}, correction);
      expect_effective_stiffness<2>(
          {spring<2>({0.6, 0.8}, soft / mu, 2 * soft / mu), spring<2>({1, 0}, 0.1 / mu, 0)}, correction);
      expect_effective_stiffness<3>({spring<3>({0.48, 0.64, 0.6}, soft / mu, 0.3 * soft / mu)}, correction);
      expect_effective_stiffness<3>(
          {spring<3>({0.48, 0.64, 0.6}, soft / mu, 0.3 / mu), spring<3>({1, 0, 0}, 0, soft / mu),
           spring<3>({0, 0.6, 0.8}, 1 / mu, 1 / mu)},
          correction);
    }
  }
}

// Proves (S21).
TEST(SpringCell, OfCracksIsThatOfTheirPlanes) {
  SlipSystem<2> cracks = spring<2>({0.6, 0.8}, 0, 0);
  cracks.compliance = {};
  cracks.compliance.crack_density = 0.05;
  expect_effective_stiffness<2>({cracks}, SlipCorrection::second);
  // Dry: Z_N/Z_T = 1 - nu/2 (Sayers & Kachanov 1995). Filled with what hardly gives: no normal compliance.
  const auto dry = compliance_in(cracks.compliance, lambda, mu);
  EXPECT_NEAR(dry.normal / dry.tangential, 1 - lambda / (lambda + mu) / 4, 1e-12);
  // In first order of their density Hudson's stiffness: c_nn falls by (lambda + 2 mu)^2/mu U_n times it.
  EXPECT_NEAR(dry.normal, 0.05 * 4 / 3 * modulus / (lambda + mu) / mu, 1e-12 * dry.normal);
  cracks.compliance.aspect = 1e-4;
  cracks.compliance.fill_pa = 2.2e9;
  const auto wet = compliance_in(cracks.compliance, lambda, mu);
  EXPECT_EQ(wet.tangential, dry.tangential);
  EXPECT_NEAR(wet.normal / dry.normal, 1 / (1 + 2.2e9 * modulus / (pi * 1e-4 * mu * (lambda + mu))), 1e-12);
}

// Proves (S20).
TEST(SpringCell, WithDashpotsIsExactUnderASteadyLoadHoweverLongTheStep) {
  // t = K e + D e', t = m (strain - e): e' = (m s t - (K + m) e)/D for a strain s t.
  for (const double steps_of_relaxation : {0.01, 1., 100.})
    for (const bool shears : {false, true}) {
      const double m = shears ? mu : modulus, stiffness = 0.5 * m;
      const double damping = steps_of_relaxation * dt_s * (stiffness + m);
      const double z = 1 / stiffness;
      Cells<2> cells({spring<2>({0, 1}, z, z, damping, damping)}, SlipCorrection::second);
      const double rate = 1e-3, time_s = damping / (stiffness + m);
      for (int n = 1; n <= 20; ++n) {
        Tensor<2> by;
        by(shears ? 0 : 1, 1) = rate * dt_s / (shears ? 2 : 1);
        const auto s = cells.strain(by);
        const double t = n * dt_s;
        const double e = m * rate / (stiffness + m) * (t - time_s * (1 - std::exp(-t / time_s)));
        EXPECT_NEAR(shears ? s(0, 1) : s(1, 1), m * (rate * t - e), 1e-10 * m * rate * t) << n;
      }
    }
}

// Proves (S23).
TEST(FrictionAboveSprings, SticksElasticallyAndSlidesAtItsStrength) {
  for (const auto correction : all_corrections)
    for (const double damping : {0., 1e-9}) {
      auto system = spring<2>({0, 1}, 0, 2 / mu, 0, damping * mu);
      system.law = FrictionLaw::coulomb;
      system.strength_pa = 1e5;
      Cells<2> cells({system}, correction);
      const double stiffness = mu / 3;
      double tau = 0;
      for (int step = 0; step < 60; ++step) {
        Tensor<2> by;
        const double gamma = step / 20 % 2 == 0 ? 2e-6 : -2e-6;
        by(0, 1) = gamma / 2;
        tau = std::clamp(tau + stiffness * gamma, -1e5, 1e5);
        EXPECT_NEAR(cells.strain(by)(0, 1), tau, 1e-6 * 1e5) << step << ", " << name_of(correction);
      }
    }
}

// Proves (S23).
TEST(FrictionAboveSprings, SlidesAtTheRateOfItsViscosity) {
  // Steady: tau = S (1 + eta g), all of the strain rate is slip.
  for (const auto correction : all_corrections) {
    auto system = spring<2>({0, 1}, 0, 2 / mu);
    system.law = FrictionLaw::coulomb;
    system.strength_pa = 1e5, system.viscosity_s = 500;
    Cells<2> cells({system}, correction);
    Tensor<2> by, s;
    by(0, 1) = 1e-3 * dt_s / 2;
    for (int step = 0; step < 20000; ++step) s = cells.strain(by);
    EXPECT_NEAR(s(0, 1), 1e5 * (1 + 500 * 1e-3), 1);
  }
}

/// A shot through a box of planes.
Scene<2> scene_with(const std::vector<SlipSystem<2>>& systems) {
  Scene<2> scene;
  constexpr std::int64_t nx = 80, nz = 90;
  scene.model.medium = uniform_medium(nx, nz, 5, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 30; k < 70; ++k)
    for (std::int64_t i = 20; i < 55; ++i)
      if ((i + k) % 7) scene.model.fracture({i, k}) = 1;
  for (std::int64_t k = 50; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) scene.model.medium.vs({i, k}) = 1700;
  scene.model.fracture_sets = {{"cracks", systems}};
  scene.survey.sources = {{{190, 110}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  scene.survey.receivers_m = {{100, 30}, {202.5, 201.3}, {320, 333}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.12, 0.001};
  return scene;
}
std::vector<double> traces_of(const Scene<2>& scene) { return samples_of(shoot(scene, 1)); }

/// Root mean square of the difference over that of the second.
double difference(const std::vector<double>& a, const std::vector<double>& b) { return relative_error(a, b); }

// Proves (S20).
TEST(SpringLimits, StiffPlanesAreRockAndSoftOnesCarryNothing) {
  const auto rock_alone = traces_of(scene_with({spring<2>({0.6, 0.8}, 0, 0)}));
  for (const auto& other :
       {std::vector{spring<2>({0.6, 0.8}, 1e-9 / mu, 1e-9 / mu)},
        std::vector{spring<2>({0.6, 0.8}, 1e-9 / mu, 0), spring<2>({1, 0}, 0, 1e-9 / mu)}}) {
    const double error = difference(traces_of(scene_with(other)), rock_alone);
    EXPECT_GT(difference(traces_of(scene_with({spring<2>({0.6, 0.8}, 1e-3 / mu, 0)})), rock_alone), 1e-5);
    EXPECT_LT(error, 1e-6);
  }
  // Planes that are free to shear are planes without strength, where both act at the end of a step alone.
  auto free = scene_with({spring<2>({0.6, 0.8}, 0, 0)}),
       soft = scene_with({spring<2>({0.6, 0.8}, 0, 1e12 / mu)});
  free.model.fracture_sets[0].systems[0].law = FrictionLaw::coulomb;
  free.numerics.correction = soft.numerics.correction = SlipCorrection::first;
  EXPECT_LT(difference(traces_of(soft), traces_of(free)), 1e-4);
  Cells<2> cells({spring<2>({0.6, 0.8}, 1e12 / mu, 1e12 / mu)}, SlipCorrection::second);
  Tensor<2> by, s;
  by.values = {1e-6, -2e-6, 3e-6};
  for (int step = 0; step < 10; ++step) s = cells.strain(by);
  EXPECT_NEAR(s(0, 0) * 0.6 + s(0, 1) * 0.8, 0, 1e-6 * mu * 1e-5);
  EXPECT_NEAR(s(0, 1) * 0.6 + s(1, 1) * 0.8, 0, 1e-6 * mu * 1e-5);
}

// Proves (S23).
TEST(SpringLimits, StiffSpringsLeaveFrictionAndEndlessFrictionLeavesSprings) {
  for (const auto correction : all_corrections)
    for (const bool blocks : {false, true}) {
      std::vector<SlipSystem<2>> friction = {spring<2>({0.6, 0.8}, 0, 0)};
      if (blocks) friction.push_back(spring<2>({-0.8, 0.6}, 0, 0));
      for (auto& system : friction)
        system.law = FrictionLaw::coulomb, system.friction = 0.3, system.viscosity_s = 1;
      auto both = friction, springs = friction, endless = friction;
      for (auto& system : both) system.compliance = {1e-30 / mu, 1e-30 / mu, 0, 0, 1};
      for (auto& system : springs) {
        system.compliance = {0.4 / mu, 0.7 / mu, 0, 0, 1};
        system.law = FrictionLaw::none, system.friction = 0, system.viscosity_s = 0;
      }
      endless = springs;
      for (auto& system : endless) system.law = FrictionLaw::coulomb, system.strength_pa = 1e20;
      const auto run = [&](const std::vector<SlipSystem<2>>& systems) {
        auto scene = scene_with(systems);
        scene.numerics.correction = correction;
        return traces_of(scene);
      };
      EXPECT_TRUE(run(both) == run(friction)) << name_of(correction);
      EXPECT_LT(difference(run(endless), run(springs)), 1e-5) << name_of(correction);
      EXPECT_GT(difference(run(friction), run(springs)), 0.01);
    }
}

// Proves (S25).
TEST(SoftCells, AreThoseThatCarryNoStress) {
  constexpr double much = 2.5 * softness_without_stress;
  const auto soft = [](const Point<2>& normal) { return spring<2>(normal, much / modulus, much / mu); };
  const Point<2> one{0.6, 0.8}, other{1, 0};
  auto slides = soft(other);
  slides.law = FrictionLaw::coulomb, slides.friction = 0.2, slides.viscosity_s = 10;
  auto damped = soft(other);
  damped.compliance.tangential_dashpot_pa_s_m = mu;
  FractureSet<2> single{"single", {soft(one)}};
  single.traces = {{{0.5, 0.5}, {2.5, 0.5}}};
  Model<2> model;
  model.medium = uniform_medium(9, 2, 1, rock);
  // One family leaves the stress along its planes, and those that shear alone the one across them.
  model.fracture_sets = {{"one", {soft(one)}},
                         {"two", {soft(one), soft(other)}},
                         {"two that shear", {spring<2>(one, 0, much / mu), spring<2>(other, 0, much / mu)}},
                         {"stiffer", {spring<2>(one, 0.3 * much / modulus, 0.3 * much / mu), soft(other)}},
                         {"damped", {soft(one), damped}},
                         {"slides", {soft(one), slides}},
                         {"three", {soft(one), soft(other), soft({0, 1})}},
                         single};
  model.fracture = Field<2, std::uint8_t>(model.grid());
  for (std::uint8_t code = 0; code < 9; ++code) model.fracture[9U + code] = code;
  const auto domain = make_domain(model.medium, edges_all(EdgeLaw::rigid), 3);
  std::vector<std::int64_t> expected;
  for (const std::int64_t code : {2, 6, 7})
    expected.push_back(domain.grid.flat(domain.computed_cell({code, 1})));
  EXPECT_EQ(soft_cells(domain, model), expected);
  // A cell that the edge of its cluster cuts is rock in part.
  model.fracture_share = Field<2>(model.grid(), 1);
  model.fracture_share[9U + 6] = 0.9F;
  expected.erase(expected.begin() + 1);
  EXPECT_EQ(soft_cells(domain, model), expected);
}

/// Speeds and polarizations of the two plane waves along z in rock full of planes.
struct Waves {
  double speed[2];    // the slow one first
  Point<2> along[2];  // velocity
};
Waves waves_in(const std::vector<SlipSystem<2>>& systems) {
  double s[3][3];
  for (int c = 0; c < 3; ++c) {
    Tensor<2> unit;
    unit.values[std::size_t(c)] = 1;
    const auto e = strain_of<2>(unit, systems);
    for (int r = 0; r < 3; ++r) s[r][c] = e.values[std::size_t(r)];
  }
  // Elasticity<2> for strains zz and xz without strain xx: what is left of the compliance when sxx is solved
  // for.
  const auto minor = [&](int r, int c) { return s[r][c] * s[0][0] - s[r][0] * s[0][c]; };
  const double zz_zz = minor(1, 1), zz_xz = minor(1, 2), xz_zz = minor(2, 1), xz_xz = minor(2, 2);
  const double determinant = (zz_zz * xz_xz - zz_xz * xz_zz) / s[0][0];
  // Christoffel's matrix: e_xz is half the derivative of u_x.
  const double xx = zz_zz / determinant / 2, xz = -xz_zz / determinant, zz = xz_xz / determinant;
  Waves waves{};
  for (const int n : {0, 1}) {
    const double root = std::hypot((xx - zz) / 2, xz), value = (xx + zz) / 2 + (n ? root : -root);
    waves.speed[n] = std::sqrt(value / rock.rho);
    const Point<2> a = {xz, value - xx}, b = {value - zz, xz};
    const auto& longer = std::hypot(a[0], a[1]) > std::hypot(b[0], b[1]) ? a : b;
    const double size = std::hypot(longer[0], longer[1]);
    waves.along[n] = size > 1e-9 * value ? Point<2>{longer[0] / size, longer[1] / size}
                     : n                 ? Point<2>{0, 1}
                                         : Point<2>{1, 0};
  }
  return waves;
}

/// What a group of plane waves along z has become after six wavelengths: phase speed, and amplitude over that
/// of the beginning.
struct Travelled {
  double speed, left;
};
Travelled travel(const std::vector<SlipSystem<2>>& systems, int which, int cells_a_wavelength,
                 SlipCorrection correction = SlipCorrection::second) {
  constexpr std::int64_t nx = 4;
  constexpr double h = 5;
  const std::int64_t nz = 30 * cells_a_wavelength;
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 1);
  scene.model.fracture_sets = {{"all", systems}};
  scene.numerics.correction = correction;
  const auto waves = waves_in(systems);
  const double speed = waves.speed[which];
  const auto& along = waves.along[which];
  const double step_s = 0.9 * h / rock.vp, k = 2 * pi / cells_a_wavelength;
  using L = Lab<double>;
  L lab(scene.model.medium, edges_all(EdgeLaw::rigid), 7, step_s);
  LinearSlip<2, double> springs(lab.state(), lab.domain(), scene, step_s);
  for (std::int64_t n = 0; n < nz; ++n) {
    const double z = double(n) - 11. * cells_a_wavelength;
    const double v = std::cos(k * z) * std::exp(-std::pow(z / (2.5 * cells_a_wavelength), 2) / 2);
    const double ezz = -along[1] * v / speed, twice_exz = -along[0] * v / speed;
    for (std::int64_t i = 0; i < nx; ++i) {
      lab(L::vx, i, n) = along[0] * v, lab(L::vz, i, n) = along[1] * v;
      lab(L::szz, i, n) = modulus * ezz, lab(L::sxx, i, n) = lambda * ezz, lab(L::sxz, i, n) = mu * twice_exz;
    }
  }
  // That is the stress of welded planes. They give way, and forget again that they did it in one step.
  for (int n = 0; n < 60; ++n) run_everywhere(springs, {0, step_s}, lab.state());
  const auto sum = [&] {
    std::complex<double> all;
    for (std::int64_t n = 0; n < nz; ++n)
      all += (along[0] * lab(L::vx, 1, n) + along[1] * lab(L::vz, 1, n)) * std::polar(1., -k * double(n));
    return all;
  };
  const auto before = sum();
  const auto steps = std::llround(6 * cells_a_wavelength * h / speed / step_s);
  for (std::int64_t n = 0; n < steps; ++n) {
    run_after_everywhere(springs, {n, step_s}, lab.state());
    lab.sweep(1, 1);
    run_everywhere(springs, {n, step_s}, lab.state());
  }
  const auto ratio = sum() / before;
  const double should = k * speed * double(steps) * step_s / h;
  // The phase is that of so many turns, and what is over them.
  const double turned = should - std::arg(ratio * std::polar(1., should));
  return {speed * turned / should, std::abs(ratio)};
}

// Proves (S20).
TEST(SpringMedium, HasTheSpeedsOfSchoenbergAndSayers) {
  // Wavelengths of 30 cells, planes along, across and at 45 degrees to the wave; families that cross.
  for (const auto& systems :
       {std::vector{spring<2>({0, 1}, 0.3 / mu, 0.5 / mu)},
        std::vector{spring<2>({1, 0}, 0.3 / mu, 0.5 / mu)},
        std::vector{spring<2>({std::sqrt(0.5), std::sqrt(0.5)}, 0.3 / mu, 0.5 / mu)},
        std::vector{spring<2>({0.6, 0.8}, 0.3 / mu, 0.5 / mu), spring<2>({1, 0}, 0.1 / mu, 0.4 / mu)}})
    for (const int which : {0, 1}) {
      const auto waves = waves_in(systems);
      const auto found = travel(systems, which, 30);
      SCOPED_TRACE(std::to_string(systems[0].normal[1]) + (which ? " P" : " S"));
      EXPECT_NEAR(found.speed / waves.speed[which], 1, 0.005);
      EXPECT_NEAR(found.left, 1, 0.03);
    }
}

// Proves (S20).
TEST(SpringMedium, ConvergesWithSecondOrder) {
  const std::vector systems{spring<2>({0.6, 0.8}, 0.3 / mu, 0.5 / mu)};
  const auto error = [&](int cells, SlipCorrection correction) {
    const auto found = travel(systems, 0, cells, correction);
    return std::hypot(found.speed / waves_in(systems).speed[0] - 1, (found.left - 1) / (12 * pi));
  };
  EXPECT_GT(observed_order(error(15, SlipCorrection::second), error(30, SlipCorrection::second)), 1.7);
  EXPECT_GT(observed_order(error(15, SlipCorrection::first), error(30, SlipCorrection::first)), 0.7);
  EXPECT_LT(error(30, SlipCorrection::second), 0.1 * error(30, SlipCorrection::first));
}

// Proves (S32a).
TEST(SpringMedium, IsLateByWhatItsSpringsGive) {
  // (S32a): level planes that give as much as the rock, and three times as much, in S waves along their
  // normal.
  constexpr int cells = 40;
  for (const double give : {1., 3.}) {
    const std::vector systems{spring<2>({0, 1}, 0.1 / mu, give / mu)};
    const double speed = waves_in(systems).speed[0];
    // Of a radian's way, at the time step of travel().
    const double angle = 2 * pi / cells * speed * 0.9 / rock.vp;
    const double late = give * angle * angle / 6, lost = give * angle / 4;
    const auto second = travel(systems, 0, cells, SlipCorrection::second),
               first = travel(systems, 0, cells, SlipCorrection::first);
    EXPECT_NEAR(1 - second.speed / speed, late, 0.15 * late) << give;
    EXPECT_NEAR(-std::log(first.left) / (12 * pi), lost, 0.15 * lost) << give;
  }
}

// Proves (S21).
TEST(SpringMedium, HasThomsensParametersOfWeakFractures) {
  // Of level planes, in first order of their weaknesses (epsilon = 2 g (1 - g) D_N, delta = 2 g (D_N - D_T)):
  // g = (vs/vp)^2.
  const double g = 0.25, weak_n = 0.05, weak_t = 0.1;
  const auto at = [&](const Point<2>& normal, int which) {
    return travel({spring<2>(normal, weak_n / (1 - weak_n) / modulus, weak_t / (1 - weak_t) / mu)}, which, 20)
        .speed;
  };
  const double along = at({1, 0}, 1), across = at({0, 1}, 1), half = at({std::sqrt(0.5), std::sqrt(0.5)}, 1);
  const double epsilon = (along * along / (across * across) - 1) / 2;
  EXPECT_NEAR(epsilon, 2 * g * (1 - g) * weak_n, 0.1 * 2 * g * (1 - g) * weak_n);
  // Thomsen (1986): vp(45 degrees) = vp(0) (1 + delta/4 + epsilon/4).
  const double delta = 4 * (half / across - 1) - epsilon;
  const double exact = 2 * g * (weak_n - weak_t);
  EXPECT_NEAR(delta, exact, 0.1 * std::abs(exact) + 0.002);
}

}  // namespace
}  // namespace slipwave::solver::linear_slip_cells_test
