// SPDX-License-Identifier: BSD-3-Clause
// Constants of planes that give way: on command lines, in files, in checks, and the viscosities that go with
// waves (docs/slip.md).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>

#include "base/error.hpp"
#include "checkpoint/identity.hpp"
#include "lab.hpp"
#include "model/compliance.hpp"
#include "model/fracture.hpp"
#include "model/model_netcdf.hpp"
#include "model/slip_regime.hpp"
#include "planning/expected_slip.hpp"
#include "scratch.hpp"

namespace slipwave::compliance_model_test {
namespace {

const solver::Rock rock{4500, 2250, 2500};

Model<2> model_with(const SlipSystem<2>& system) {
  Model<2> model;
  model.medium = solver::uniform_medium(20, 20, 10, rock);
  model.fracture = Field<2, std::uint8_t>(model.grid());
  for (std::int64_t i = 0; i < 20; ++i) model.fracture({i, 10}) = 1;
  model.fracture_sets = {{"set", {system}}};
  return model;
}
SlipSystem<2> springs() {
  SlipSystem<2> system{{0, 1}};
  system.law = FrictionLaw::none;
  system.compliance = {1e-12, 2e-12, 3, 4, 5};
  return system;
}
std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ComplianceModel, ComesBackFromAFile) {
  auto cracks = springs();
  cracks.normal = {1, 0};
  cracks.compliance = {};
  cracks.compliance.crack_density = 0.05, cracks.compliance.aspect = 1e-3, cracks.compliance.fill_pa = 2e9;
  auto model = model_with(springs());
  model.fracture_sets.push_back({"cracks", {cracks}});
  const Scratch scratch;
  const auto path = scratch.file("m.nc");
  write_model(model, path);
  const auto found = read_model<2>(path);
  for (const std::size_t k : {0, 1}) {
    const auto &is = found.fracture_sets[k].systems[0], &was = model.fracture_sets[k].systems[0];
    EXPECT_EQ(is.law, FrictionLaw::none);
    for (const auto value :
         {&LinearCompliance::normal_m_per_pa, &LinearCompliance::tangential_m_per_pa,
          &LinearCompliance::normal_dashpot_pa_s_m, &LinearCompliance::tangential_dashpot_pa_s_m,
          &LinearCompliance::spacing_m, &LinearCompliance::crack_density, &LinearCompliance::aspect,
          &LinearCompliance::fill_pa})
      EXPECT_EQ(is.compliance.*value, was.compliance.*value);
  }
}

TEST(ComplianceModel, IsRefusedWhereItCanNotBe) {
  const auto found = [](const std::function<void(SlipSystem<2>&)>& spoil) {
    auto system = springs();
    spoil(system);
    return error_of([&] { check(model_with(system)); });
  };
  EXPECT_EQ(found([](auto&) {}), "");
  EXPECT_EQ(found([](auto& s) { s.compliance.normal_m_per_pa = -1; }),
            "fracture set 1 'set': normal compliance is -1, expected a finite number not below zero");
  EXPECT_EQ(found([](auto& s) { s.compliance.tangential_dashpot_pa_s_m = std::nan(""); }),
            "fracture set 1 'set': tangential dashpot is nan, expected a finite number not below zero");
  EXPECT_EQ(found([](auto& s) { s.compliance.spacing_m = 0; }),
            "fracture set 1 'set': spacing of planes is 0, expected it above zero, in metres");
  EXPECT_EQ(found([](auto& s) { s.compliance.fill_pa = 1e9; }),
            "fracture set 1 'set': aspect ratio of cracks is 0, expected it above zero and at most 1");
  EXPECT_EQ(found([](auto& s) { s.opens = true; }),
            "fracture set 1 'set': planes that open carry no tension, planes with a compliance do; give one "
            "of both");
  const auto two = [](bool slides, const Point<2>& normal, double dashpot) {
    auto model = model_with(springs());
    auto& systems = model.fracture_sets[0].systems;
    systems.push_back(systems[0]);
    systems[1].normal = normal;
    for (auto& system : systems) {
      if (slides) system.law = FrictionLaw::coulomb;
      system.compliance.normal_dashpot_pa_s_m = system.compliance.tangential_dashpot_pa_s_m = dashpot;
    }
    return error_of([&] { check(model); });
  };
  EXPECT_EQ(two(false, {0.6, 0.8}, 0), "");
  EXPECT_EQ(two(true, {1, 0}, 0), "");
  EXPECT_EQ(
      two(true, {0.6, 0.8}, 0),
      "fracture set 1 'set': friction together with compliance needs one family of planes, in 2-D or two at "
      "right angles; give the others a set of their own");
  EXPECT_EQ(two(false, {1, 0}, 1), "fracture set 1 'set': dashpots need one family of planes, found 2");
}

TEST(ComplianceModel, ParsesCompliancesStiffnessesAndCracks) {
  const auto of = parse_compliance({"1e-12,2e-12", "", "3,4", 5., {}, {}, {}});
  EXPECT_EQ(of.normal_m_per_pa, 1e-12);
  EXPECT_EQ(of.tangential_m_per_pa, 2e-12);
  EXPECT_EQ(of.tangential_dashpot_pa_s_m, 4);
  EXPECT_EQ(of.spacing_m, 5);
  EXPECT_EQ(parse_compliance({"", "1e10,4e9", "", 5., {}, {}, {}}).tangential_m_per_pa, 0.25e-9);
  EXPECT_EQ(parse_compliance({"", "", "", {}, 0.1, 1e-3, 2e9}).fill_pa, 2e9);
  const auto error = [](const ComplianceText& text) { return error_of([&] { parse_compliance(text); }); };
  EXPECT_EQ(error({"1,1", "1,1", "", 5., {}, {}, {}}),
            "found --compliance and --stiffness, give one of both");
  EXPECT_EQ(error({"1,1", "", "", {}, {}, {}, {}}), "--spacing is missing");
  EXPECT_EQ(error({"1,1", "", "", 0., {}, {}, {}}),
            "--spacing: found 0, expected it above zero, the distance between planes in m");
  EXPECT_EQ(error({"-1,1", "", "", 1., {}, {}, {}}),
            "--compliance: found '-1,1', expected two numbers not below zero");
  EXPECT_EQ(error({"0,0", "", "", 1., {}, {}, {}}),
            "--compliance: found '0,0', expected one of both above zero");
  EXPECT_EQ(error({"", "0,1", "", 1., {}, {}, {}}),
            "--stiffness: found '0,1', expected both above zero, Pa/m");
  EXPECT_EQ(error({"", "", "", {}, -0.1, {}, {}}), "--crack-density: found -0.1, expected it above zero");
  EXPECT_EQ(error({"", "", "", {}, 0.1, {}, 2e9}),
            "--fill needs --aspect: thin cracks are stiffer when filled");
  const std::string of_dry =
      "--aspect needs a --fill above zero: the compliance of dry cracks does not depend on their thickness";
  EXPECT_EQ(error({"", "", "", {}, 0.1, 1e-3, {}}), of_dry);
  EXPECT_EQ(error({"", "", "", {}, 0.1, 1e-3, 0.}), of_dry);
  EXPECT_EQ(error({"", "", "", {}, {}, 0.1, {}}), "--aspect and --fill need --crack-density");
  EXPECT_NE(error({"1,1", "", "", 1., 0.1, {}, {}}), "");
}

TEST(ComplianceModel, OfAnotherStiffnessIsAnotherRun) {
  const auto identity = [](double compliance) {
    Scene<2> scene;
    auto system = springs();
    system.compliance.normal_m_per_pa = compliance;
    scene.model = model_with(system);
    return identity_of(scene);
  };
  EXPECT_EQ(difference_of(identity(1e-12), identity(1e-12)), std::nullopt);
  EXPECT_EQ(difference_of(identity(1e-12), identity(2e-12)), "another model");
}

// Proves (S24).
TEST(CompetingSlip, IsWhereTheRelaxationTakesARadian) {
  SlipSystem<2> system{{0, 1}, 0.5, 1};
  auto model = model_with(system);
  const WaveOnPlanes wave = {30, 1e-5};
  const double omega = 60 * std::numbers::pi, modulus = rock.rho * rock.vp * rock.vp;
  // The frequency cancels where the wave's own pressure is all there is.
  EXPECT_NEAR(competing_slip(model, 1, wave).competing_viscosity_s, rock.mu() / (0.5 * modulus * 1e-5), 1);
  model.prestress_pa.assign(3, Field<2>(model.grid(), -1e6F));
  const auto pressed = competing_slip(model, 1, wave);
  EXPECT_NEAR(pressed.strength_pa, 5e5, 1e-3);
  // eta S/mu, the relaxation time, is 1/omega.
  EXPECT_NEAR(pressed.competing_viscosity_s * pressed.strength_pa / rock.mu() * omega, 1, 1e-9);
  model.fracture_sets[0].systems[0].friction = 0;
  EXPECT_NE(error_of([&] { competing_slip(model, 1, wave); }), "");
}

/// Rate at which the waves exp(i k.x) of the linearised law grow: vn, vt, snn, stt and snt in the frame of
/// normal and slip, integrated by the classical Runge-Kutta rule. `relaxation_s` 0: dry planes.
double growth_rate(double k, double angle, double friction, double relaxation_s, double vp, double vs) {
  using Wave = std::array<std::complex<double>, 5>;
  const double mu = vs * vs, lambda = vp * vp - 2 * mu;  // of a density of 1
  const std::complex<double> kn(0, k * std::cos(angle)), kt(0, k * std::sin(angle));
  const auto rate = [&](const Wave& w) {
    const auto pull = (lambda + 2 * mu) * kn * w[0] + lambda * kt * w[1];
    const auto shear = mu * (kt * w[0] + kn * w[1]);
    // mu times the rate of slip: it keeps dry planes at their strength, viscous ones relax to it.
    const auto slip = relaxation_s > 0 ? (w[4] + friction * w[2]) / relaxation_s : shear + friction * pull;
    return Wave{kn * w[2] + kt * w[4], kn * w[4] + kt * w[3], pull,
                lambda * kn * w[0] + (lambda + 2 * mu) * kt * w[1], shear - slip};
  };
  const auto plus = [](const Wave& a, double factor, const Wave& b) {
    Wave sum = a;
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += factor * b[n];
    return sum;
  };
  const auto size = [&](const Wave& w) {
    double sum = 0;
    for (std::size_t n = 0; n < w.size(); ++n) sum += std::norm(w[n]) / (n < 2 ? 1 : vp * vp);
    return std::sqrt(sum);
  };
  Wave wave = {1, 0.3, vp, 0.5 * vp, -0.2 * vp};
  const double dt_s = 0.3 / (vp * k);
  const int steps = 4000;
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    const auto a = rate(wave), b = rate(plus(wave, dt_s / 2, a)), c = rate(plus(wave, dt_s / 2, b)),
               d = rate(plus(wave, dt_s, c));
    wave = plus(plus(plus(plus(wave, dt_s / 6, a), dt_s / 3, b), dt_s / 3, c), dt_s / 6, d);
    const double now = size(wave);
    if (n >= steps / 2) sum += std::log(now);
    for (auto& value : wave) value /= now;
  }
  return sum / (steps - steps / 2) / dt_s;
}

// Proves (S28), (S29).
TEST(BandGrowth, IsThatOfTheLinearisedLaw) {
  for (const double vs : {2250., 1500.})
    for (const double friction : {0.1, 0.6}) {
      const double vp = 4500, k = 0.5, relaxation_s = 20 / (vp * k);
      double dry = 0, viscous = 0;
      for (double angle = 0; angle <= 0.5 * std::numbers::pi; angle += 0.02) {
        dry = std::max(dry, growth_rate(k, angle, friction, 0, vp, vs));
        viscous = std::max(viscous, growth_rate(k, angle, friction, relaxation_s, vp, vs));
      }
      const auto of = band_growth(friction, vp, vs);
      EXPECT_NEAR(of.dry_m_s * k, dry, 0.03 * dry) << friction;
      // A bound, reached by short waves. Those that hardly grow would want many more steps.
      if (friction < 0.5) continue;
      EXPECT_LT(viscous, of.relaxing / relaxation_s) << friction;
      EXPECT_GT(viscous, 0.8 * of.relaxing / relaxation_s) << friction;
    }
  EXPECT_EQ(band_growth(0, 4500, 2250).dry_m_s, 0);
}

// Proves (S29).
TEST(CellDependence, IsSaidWherePlanesSlideUnderPressureAndViscosityDoesNotBoundTheGrowth) {
  // A P wave of 1 cm/s straight down on planes at 45 degrees: a third of its pressure is shear at vp/vs = 2.
  Scene<2> scene;
  scene.survey.sources = {{{100, 0}, parse_mechanism<2>("plane:0"), parse_wavelet("sine:30:1"), 0.01}};
  const double half = std::sqrt(0.5);
  const auto said = [&](double friction, double viscosity_s, double h) {
    scene.model = {};
    scene.model.medium = solver::uniform_medium(20, 20, h, {4500, 2250, 2500});
    scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid(), 1);
    scene.model.fracture_sets = {{"cluster", {{{half, half}, friction, viscosity_s, 0}}}};
    const auto all = cell_dependence(scene);
    return all.empty() ? std::string() : all.front();
  };
  const auto exponent = [](const std::string& text) {
    const auto at = text.find("exp(");
    return at == std::string::npos ? 0. : std::stod(text.substr(at + 4));
  };
  // The scene of theory/slip.md: exp(4) at 1.25 m, and by the rate of waves of eight cells.
  EXPECT_NEAR(exponent(said(0.2, 0, 1.25)), 4, 0.4);
  const double rate = band_growth(0.2, 4500, 2250).dry_m_s * 2 * std::numbers::pi / (8 * 2.5);
  EXPECT_NEAR(exponent(said(0.2, 0, 2.5)), rate / 60, 0.05 * rate / 60);
  // Large cells do not let such waves grow within half a period; planes of more friction stick under
  // pressure; those without friction are open under tension alone.
  EXPECT_EQ(said(0.2, 0, 10), "");
  EXPECT_EQ(said(0.4, 0, 1.25), "");
  EXPECT_EQ(said(0, 0, 1.25), "");
  // That of quickstart bounds the growth, and what is proposed does.
  EXPECT_EQ(said(0.2, 3800, 1.25), "");
  const auto text = said(0.2, 0, 1.25);
  const auto at = text.find("a viscosity of ");
  ASSERT_NE(at, std::string::npos) << text;
  const double bounding = std::stod(text.substr(at + 15));
  EXPECT_GT(bounding, 0);
  EXPECT_EQ(said(0.2, 1.05 * bounding, 1.25), "");
  EXPECT_NE(said(0.2, bounding / 20, 1.25), "");
  scene.with_slip = false;
  EXPECT_TRUE(cell_dependence(scene).empty());
}

TEST(ExpectedSlip, SpeaksOnlyOfPlanesThatStickOrAreDry) {
  Scene<2> scene;
  scene.survey.sources = {{{100, 0}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:30"), 1e9}};
  const auto said = [&](double friction, double viscosity_s, double cohesion_pa) {
    scene.model = model_with({{0, 1}, friction, viscosity_s, cohesion_pa});
    const auto all = expected_slip(scene);
    return all.empty() ? "" : all.front();
  };
  const auto holds = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(holds, said(0.1, 0, 0), "slip like dry friction");
  EXPECT_PRED2(holds, said(0.1, 1e30, 0), "hardly slip");
  EXPECT_PRED2(holds, said(0.1, 1, 1e12), "cannot slip");
  EXPECT_EQ(said(0, 1, 0), "");
  // Somewhere between there is silence, and what is proposed lies there.
  const auto text = said(0.1, 0, 0);
  const auto at = text.find("about ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(said(0.1, std::stod(text.substr(at + 6)), 0), "");
  scene.with_slip = false;
  EXPECT_EQ(said(0.1, 0, 0), "");
}

}  // namespace
}  // namespace slipwave::compliance_model_test
