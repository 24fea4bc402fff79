// SPDX-License-Identifier: BSD-3-Clause
// Plane waves that fall on anisotropic rock, against closed forms of their own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "anisotropic_scene.hpp"
#include "complex_system.hpp"
#include "plain_and_tiled.hpp"
#include "shared_out.hpp"

namespace slipwave::solver {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr Material flat{3000, 1600, 2300, 0.2, 0.1}, dipping{3000, 1600, 2300, 0.2, 0.1, 30},
    steep{3200, 1700, 2400, -0.05, 0.2, -60}, hard{4200, 2300, 2600, 0.1, 0.15}, water{1500, 0, 1000};

/// One wave that a plane wave makes: its velocity, and its slowness down.
struct Arrival {
  double vx, vz, down;
};

/// All of one slowness along x in rocks above and below an interface.
struct Waves {
  double along = 0;
  std::vector<Arrival> above, below;  // the incident one is the first
};

using Wave = AnisotropicStack::Wave;

/// Waves of real slowness down, or up, as the reference of wave-number integrals has them, per unit of
/// velocity.
std::vector<std::pair<Arrival, std::array<double, 4>>> real_waves(const Material& rock, double along,
                                                                  bool down) {
  const Complex omega(1, -1e-9);
  std::vector<std::pair<Arrival, std::array<double, 4>>> all;
  for (const auto& wave : AnisotropicStack::waves(AnisotropicStack::RealPlane(elasticity_of<2>(rock)),
                                                  rock.rho, down, omega, along)) {
    // exp(-m z) down, exp(m z) up, is exp(-i omega q z).
    const auto slowness = (down ? 1. : -1.) * wave.m / (Complex(0, 1) * omega);
    if (std::abs(slowness.imag()) > 1e-6 * std::abs(slowness.real())) continue;  // evanescent
    // Velocity is i omega u; its phase goes.
    const auto& u = std::norm(wave.fields[0]) > std::norm(wave.fields[1]) ? wave.fields[0] : wave.fields[1];
    const double size = std::sqrt(std::norm(wave.fields[0]) + std::norm(wave.fields[1]));
    const auto unit = Complex(0, 1) * omega * u / std::abs(u) * size;
    std::array<double, 4> fields;
    for (std::size_t n = 0; n < 4; ++n)
      fields[n] = ((n < 2 ? Complex(0, 1) * omega : Complex(1)) * wave.fields[n] / unit).real();
    all.push_back({{fields[0], fields[1], slowness.real()}, fields});
  }
  return all;
}

/// What comes of a plane wave in a rock: itself alone, or with what an interface to another rock makes of it.
Waves waves_of(const Material& rock, const std::optional<Material>& under, double angle_deg, bool shear) {
  const double x = std::sin(angle_deg * degree), z = std::cos(angle_deg * degree);
  const double c = phase_speeds<2>(elasticity_of<2>(rock), rock.rho, {x, z})[shear];
  Waves waves;
  waves.along = x / c;
  const auto down = real_waves(rock, waves.along, true);
  const auto& incident = *std::min_element(down.begin(), down.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.first.down - z / c) < std::abs(b.first.down - z / c);
  });
  EXPECT_NEAR(incident.first.down, z / c, 1e-6 / c);
  const auto& [vx, vz, q] = incident.first;
  // P moves forward, S towards +x where it travels down.
  const double sign = (shear ? vx * z - vz * x : vx * x + vz * z) < 0 ? -1 : 1;
  waves.above.push_back({sign * vx, sign * vz, q});
  if (!under) return waves;
  const auto up = real_waves(rock, waves.along, false), through = real_waves(*under, waves.along, true);
  ComplexSystem system;
  const double impedance = rock.rho * rock.vp;
  for (std::size_t field = 0; field < 4; ++field) {
    const double scale = field < 2 ? 1 : 1 / impedance;
    auto& equation = system.emplace_back();
    for (const auto& wave : up) equation.push_back(scale * wave.second[field]);
    for (const auto& wave : through) equation.push_back(-scale * wave.second[field]);
    equation.push_back(-scale * sign * incident.second[field]);
  }
  EXPECT_EQ(up.size() + through.size(), 4U);
  const auto found = solved(std::move(system));
  for (std::size_t n = 0; n < 4; ++n) {
    const auto& [x_part, z_part, slowness] = (n < 2 ? up[n] : through[n - 2]).first;
    (n < 2 ? waves.above : waves.below)
        .push_back({found[n].real() * x_part, found[n].real() * z_part, slowness});
  }
  return waves;
}

/// A box of a rock, and from some depth on another, that absorbs.
struct Box {
  Material rock;
  std::optional<Material> under;
  double angle_deg = 0;
  bool shear = false;

  double error() const {
    constexpr double h = 5, size = 300, face = 150;
    Scene<2> scene;
    const Grid<2> grid{{std::int64_t(size / h), std::int64_t(size / h)}, h, {0, 0}};
    Medium<2> medium(grid);
    for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
      medium[property] = Field<2>(grid);
    for (std::int64_t n = 0; n < grid.size(); ++n)
      put(medium, std::size_t(n), under && grid.centre(1, grid.index(n)[1]) > face ? *under : rock);
    scene.model.medium = medium;
    const Point<2> from{size / 2, -200};
    scene.survey.sources = {{from,
                             parse_mechanism<2>((shear ? "plane-s:" : "plane:") + std::to_string(angle_deg)),
                             parse_wavelet("ricker:20"), 1}};
    scene.survey.receivers_m = {{62.5, 72.5}, {242.5, 107.5}, {77.5, 222.5}, {262.5, 252.5}};
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.numerics.order = 7;
    scene.recording = {{Component::vx, Component::vz}, shear ? 0.45 : 0.32, 0.001};
    check(scene);
    const auto gather = shoot(scene, 1);
    const auto waves = waves_of(rock, under, angle_deg, shear);
    const auto& wavelet = scene.survey.sources[0].wavelet;
    const double at_face = waves.above.front().down * (face - from[1]);
    std::vector<double> found, wanted;
    for (std::size_t n = 0; n < 8; ++n) {
      const auto& at = scene.survey.receivers_m[n % 4];
      const auto& of = under && at[1] > face ? waves.below : waves.above;
      for (std::size_t k = 0; k < std::size_t(gather.axis.count); ++k) {
        double value = 0;
        for (const auto& wave : of)
          value += (n < 4 ? wave.vx : wave.vz) * wavelet(double(k) * 0.001 - waves.along * (at[0] - from[0]) -
                                                         at_face - wave.down * (at[1] - face));
        wanted.push_back(value);
      }
      const auto& samples = gather.traces[n].samples;
      found.insert(found.end(), samples.begin(), samples.end());
    }
    return relative_error(found, wanted);
  }
};

// Proves (A17).
TEST(AnisotropicPlaneWave, GoesThroughARockUndisturbed) {
  for (const auto& rock : {flat, dipping, steep})
    for (const double angle : {0., 25., -40.})
      for (const bool shear : {false, true}) {
        if (!std::getenv("SLIPWAVE_LONG") && (rock == steep || angle == (rock == flat ? 0 : -40))) continue;
        // 16 cells per S wave of the peak.
        EXPECT_LT((Box{rock, {}, angle, shear}.error()), shear ? 0.03 : 0.003)
            << rock.tilt << ' ' << angle << ' ' << shear;
      }
}

// Proves (A17).
TEST(AnisotropicPlaneWave, IsReflectedConvertedAndTransmittedAsPlaneWavesAre) {
  const Material sand{2500, 1300, 2200};
  for (const auto& [over, under] : {std::pair{flat, hard}, {dipping, steep}, {sand, dipping}})
    for (const double angle : {0., 25., -25.}) {
      if (!std::getenv("SLIPWAVE_LONG") && (over != dipping || angle > 0)) continue;
      EXPECT_LT((Box{over, under, angle, false}.error()), 0.02) << over.tilt << ' ' << angle;
    }
}

/// Shale with a body in it over rock, below water.
Scene<2> layers(std::int64_t nx, const std::string& kind) {
  Scene<2> scene;
  const Grid<2> grid{{nx, 60}, 5, {0, 0}};
  Medium<2> medium(grid);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(grid);
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    const auto row = grid.index(n)[1];
    put(medium, std::size_t(n), row < 12 ? water : row < 30 ? flat : row < 45 ? dipping : hard);
  }
  scene.model.medium = medium;
  const double middle = double(nx) * 2.5;
  scene.survey.sources = {{{middle, 500}, parse_mechanism<2>(kind), parse_wavelet("ricker:15"), 1}};
  scene.survey.receivers_m = {{middle - 30, 32}, {middle + 30, 122}, {middle, 202}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
  check(scene);
  return scene;
}

/// Evanescent and multiply reflected waves: no closed form in time, but the same traces however wide the
/// model is.
// Proves (A17).
TEST(AnisotropicPlaneWave, InLayersIsTheSameHoweverWideTheModelIs) {
  for (const std::string kind : {"plane:155", "plane-s:215", "plane-s:180"}) {
    if (!std::getenv("SLIPWAVE_LONG") && kind != "plane-s:215") continue;
    const auto narrow = all_samples(shoot(layers(30, kind), 1)),
               wide = all_samples(shoot(layers(70, kind), 1));
    EXPECT_LT(relative_error(narrow, wide), 0.01) << kind;
  }
}

}  // namespace
}  // namespace slipwave::solver
