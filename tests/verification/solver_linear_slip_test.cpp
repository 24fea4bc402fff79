// SPDX-License-Identifier: BSD-3-Clause
// The linear limit of slip, a row of cells that slips at a rate that goes with its traction, is an interface
// of Schoenberg's (1980) whose compliance is that of a dashpot (docs/slip.md).
#include <gtest/gtest.h>

#include <complex>

#include "slip_layer.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::solver_linear_slip_test {
namespace {

/// Of P waves (a) and S waves (b) from the normal of the row: sin(a)/vp = sin(b)/vs.
struct Angles {
  double sin_a, cos_a, sin_b, cos_b;
};
Angles angles(bool of_s, double angle_deg) {
  const double sine = std::sin(angle_deg * std::numbers::pi / 180), slower = rock.vs / rock.vp;
  const double sin_a = of_s ? sine / slower : sine, sin_b = of_s ? sine : sine * slower;
  return {sin_a, std::sqrt(1 - sin_a * sin_a), sin_b, std::sqrt(1 - sin_b * sin_b)};
}

/// Sizes of the P and S waves that go off, of the velocity of the wave that comes in.
struct Coefficients {
  double p, s;
};
Coefficients closed_form(bool of_s, double angle_deg, double ratio) {
  const auto [sin_a, cos_a, sin_b, cos_b] = angles(of_s, angle_deg);
  const double slower = rock.vs / rock.vp, cos_2b = 1 - 2 * sin_b * sin_b;
  const double z = cos_2b * cos_2b / cos_b + 4 * slower * sin_b * sin_b * cos_a;
  const double tau = of_s ? cos_2b : slower * 2 * sin_a * cos_a;
  const double jump = 2 * ratio / (1 + z * ratio) * tau;
  return {slower * slower * sin_a * jump, cos_2b / (2 * cos_b) * jump};
}

constexpr double h = 5, wave_hz = 20;
constexpr std::int64_t nx = 440, nz = 300, row = 170, above = row - 8, below = row + 8;

/// vx and vz at the receivers above and below the row, at all steps.
struct Record {
  std::vector<double> vx[2], vz[2];
};

/// A plane wave (Ricker) on its way down to the row, in a piece of rock whose edges are too far away to be
/// seen.
Record run(bool of_s, double angle_deg, double viscosity_times_strength, double dt_s) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, h, rock);
  scene.numerics.correction = SlipCorrection::second;
  constexpr double strength = 1e-3;
  scene.model.fracture_sets = {{"row", {{{0, 1}, 0, viscosity_times_strength / strength, strength}}}};
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t i = 0; i < nx; ++i) scene.model.fracture({i, row}) = viscosity_times_strength > 0;
  using L = Lab<float>;
  L lab(scene.model.medium, edges_all(EdgeLaw::absorbing), 5, dt_s);
  std::unique_ptr<Slip<2, float>> slip;
  if (viscosity_times_strength > 0)
    slip = std::make_unique<Slip<2, float>>(lab.state(), lab.domain(), scene, dt_s);
  const auto of = angles(of_s, angle_deg);
  const double speed = of_s ? rock.vs : rock.vp, lambda = modulus_p - 2 * mu;
  const double dx = of_s ? of.sin_b : of.sin_a, dz = of_s ? of.cos_b : of.cos_a;
  const double ux = of_s ? dz : dx, uz = of_s ? -dx : dz;
  // Wavelengths between the wave's middle and the middle of the row: what slips first is far from the
  // receivers.
  const double lead = of_s ? 3 : 2;
  const auto zone = lab.domain().low_zone;
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      const double s = ((double(i) - nx / 2.) * dx + (double(k) - row) * dz) * h + lead * speed / wave_hz;
      const double a = std::numbers::pi * wave_hz * s / speed, v = (1 - 2 * a * a) * std::exp(-a * a);
      const double exx = -dx * ux * v / speed, ezz = -dz * uz * v / speed, trace = exx + ezz;
      const double exz = -(dx * uz + dz * ux) * v / speed / 2;
      const std::int64_t x = i + zone[0], z = k + zone[1];
      lab(L::vx, x, z) = float(ux * v);
      lab(L::vz, x, z) = float(uz * v);
      lab(L::sxx, x, z) = float(lambda * trace + 2 * mu * exx);
      lab(L::szz, x, z) = float(lambda * trace + 2 * mu * ezz);
      lab(L::sxz, x, z) = float(2 * mu * exz);
    }
  Record record;
  const double end_s = (lead + 1.7) / wave_hz;
  for (std::int64_t n = 0; double(n) * dt_s < end_s; ++n) {
    lab.step();
    if (slip) run_everywhere(*slip, {n, dt_s}, lab.state());
    for (const std::size_t side : {0, 1}) {
      const std::int64_t k = (side ? below : above) + zone[1], x = nx / 2 + zone[0];
      record.vx[side].push_back(lab(L::vx, x, k));
      record.vz[side].push_back(lab(L::vz, x, k));
    }
    if (slip) run_after_everywhere(*slip, {n, dt_s}, lab.state());
  }
  return record;
}

double amplitude(const std::vector<double>& samples, double dt_s, double hz) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < samples.size(); ++n)
    sum += samples[n] * std::polar(1., -2 * std::numbers::pi * hz * double(n) * dt_s);
  return std::abs(sum);
}

std::vector<double> mixed(const std::vector<double>& a, double of_a, const std::vector<double>& b,
                          double of_b) {
  std::vector<double> sum;
  for (std::size_t n = 0; n < a.size(); ++n) sum.push_back(of_a * a[n] + of_b * b[n]);
  return sum;
}

class LinearSlip : public ::testing::TestWithParam<std::tuple<bool, double>> {};

TEST_P(LinearSlip, SendsOffPAndSWavesAsSchoenbergsInterfaceAtAllFrequencies) {
  const auto [of_s, angle_deg] = GetParam();
  constexpr double ratio = 0.2, strip = 0.19;  // k of (S9) at this Courant number and order
  const double dt_s = 0.9 * h / rock.vp;
  const auto with = run(of_s, angle_deg, z_s * h / (2 * ratio), dt_s);
  const auto without = run(of_s, angle_deg, 0, dt_s);
  const auto exact = closed_form(of_s, angle_deg, 1 / (1 / ratio + strip));
  const auto of = angles(of_s, angle_deg);
  for (const double hz : {12., 16., 20., 25., 30.})
    for (const std::size_t side : {0, 1}) {
      SCOPED_TRACE(std::to_string(hz) + (side ? " Hz below" : " Hz above"));
      const double way = side ? 1 : -1;
      const auto vx = mixed(with.vx[side], 1, without.vx[side], -1);
      const auto vz = mixed(with.vz[side], 1, without.vz[side], -1);
      const auto came =
          mixed(without.vx[side], of_s ? of.cos_b : of.sin_a, without.vz[side], of_s ? -of.sin_b : of.cos_a);
      // P waves move along (sin a, way cos a), S waves along (cos b, -way sin b).
      const double both = of.cos_a * of.cos_b + of.sin_a * of.sin_b;
      const auto p = mixed(vx, of.sin_b / both, vz, way * of.cos_b / both);
      const auto s = mixed(vx, of.cos_a / both, vz, -way * of.sin_a / both);
      const double size = amplitude(came, dt_s, hz);
      EXPECT_NEAR(amplitude(p, dt_s, hz) / size, exact.p, 0.04 * exact.s);
      EXPECT_NEAR(amplitude(s, dt_s, hz) / size, exact.s, 0.04 * exact.s);
    }
}

INSTANTIATE_TEST_SUITE_P(Waves, LinearSlip,
                         ::testing::Values(std::tuple{false, 40.}, std::tuple{true, 0.},
                                           std::tuple{true, 22.}),
                         [](const auto& info) {
                           std::string name = std::get<0>(info.param) ? "S" : "P";
                           return name += std::to_string(int(std::get<1>(info.param)));
                         });

}  // namespace
}  // namespace slipwave::solver::solver_linear_slip_test
