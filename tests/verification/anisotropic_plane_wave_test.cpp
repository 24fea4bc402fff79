// SPDX-License-Identifier: BSD-3-Clause
// Plane waves that fall on anisotropic rock against closed forms of their own, and themselves in wider
// models.
#include <gtest/gtest.h>

#include "anisotropic_scene.hpp"
#include "complex_system.hpp"
#include "parallel/threads.hpp"

namespace slipwave::solver::anisotropic_plane_wave_test {
namespace {

/// One wave that a plane wave makes: its velocity and its slowness.
template <int D>
struct Arrival {
  Point<D> velocity, slowness;
};

/// The error of all traces against waves above and below a face, the first above being the incident one.
template <int D>
double error_of_arrivals(const Scene<D>& scene, const std::vector<Arrival<D>>& above,
                         const std::vector<Arrival<D>>& below, double face_m) {
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto& at = scene.survey.receivers_m;
  const auto& source = scene.survey.sources[0];
  std::vector<double> wanted;
  for (std::size_t n = 0; n < gather.traces.size(); ++n) {
    const auto& place = at[n % at.size()];
    const std::size_t axis = D == 2 && n >= at.size() ? 1 : n / at.size();
    for (std::size_t k = 0; k < std::size_t(gather.axis.count); ++k) {
      double value = 0;
      for (const auto& wave : !below.empty() && place[D - 1] > face_m ? below : above) {
        double later = above[0].slowness[D - 1] * (face_m - source.position_m[D - 1]) +
                       wave.slowness[D - 1] * (place[D - 1] - face_m);
        for (std::size_t i = 0; i + 1 < D; ++i) later += wave.slowness[i] * (place[i] - source.position_m[i]);
        value += wave.velocity[axis] * source.wavelet(double(k) * 0.001 - later);
      }
      wanted.push_back(value);
    }
  }
  return relative_error(samples_of(gather), wanted);
}

/// Waves of real slowness down, or up, with their velocities and tractions, as the reference of wave-number
/// integrals has them, per unit of velocity.
std::vector<std::pair<Arrival<2>, std::array<double, 4>>> real_waves(const Material& rock, double along,
                                                                     bool down) {
  const Complex omega(1, -1e-9), i(0, 1);
  std::vector<std::pair<Arrival<2>, std::array<double, 4>>> all;
  for (const auto& wave : AnisotropicStack::waves(AnisotropicStack::RealPlane(elasticity_of<2>(rock)),
                                                  rock.rho, down, omega, along)) {
    // exp(-m z) down, exp(m z) up, is exp(-i omega q z).
    const auto slowness = (down ? 1. : -1.) * wave.m / (i * omega);
    if (std::abs(slowness.imag()) > 1e-6 * std::abs(slowness.real())) continue;  // evanescent
    // Velocity is i omega u; its phase goes.
    const auto& u = std::norm(wave.fields[0]) > std::norm(wave.fields[1]) ? wave.fields[0] : wave.fields[1];
    const double size = std::sqrt(std::norm(wave.fields[0]) + std::norm(wave.fields[1]));
    const auto unit = i * omega * u / std::abs(u) * size;
    std::array<double, 4> fields;
    for (std::size_t n = 0; n < 4; ++n)
      fields[n] = ((n < 2 ? i * omega : Complex(1)) * wave.fields[n] / unit).real();
    all.push_back({{{fields[0], fields[1]}, {along, slowness.real()}}, fields});
  }
  return all;
}

/// The error of a plane wave through a rock, or on another below it.
double error_in_plane(const Material& over, const Material& under, double angle_deg, bool shear) {
  auto scene = plane_wave_in<2>({{over, 30}, {under, 0}}, {60, 60},
                                (shear ? "plane-s:" : "plane:") + std::to_string(angle_deg), -200,
                                shear ? 0.45 : 0.32);
  scene.survey.sources[0].wavelet = parse_wavelet("ricker:20");
  if (!long_form()) scene.numerics.zone_cells = 10;
  scene.survey.receivers_m = {{-87.5, 72.5}, {92.5, 107.5}, {-72.5, 222.5}, {112.5, 252.5}};
  const double x = std::sin(angle_deg * degree), z = std::cos(angle_deg * degree),
               c = phase_speeds<2>(elasticity_of<2>(over), over.rho, {x, z})[shear];
  const auto down = real_waves(over, x / c, true);
  const auto& [incident, fields] =
      *std::min_element(down.begin(), down.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.first.slowness[1] - z / c) < std::abs(b.first.slowness[1] - z / c);
      });
  EXPECT_NEAR(incident.slowness[1], z / c, 1e-6 / c);
  // P moves forward, S towards +x where it travels down.
  const auto& [vx, vz] = incident.velocity;
  const double sign = (shear ? vx * z - vz * x : vx * x + vz * z) < 0 ? -1 : 1;
  std::vector<Arrival<2>> above = {{{sign * vx, sign * vz}, incident.slowness}}, below;
  if (under == over) return error_of_arrivals<2>(scene, above, {}, 150);
  const auto up = real_waves(over, x / c, false), through = real_waves(under, x / c, true);
  EXPECT_EQ(up.size() + through.size(), 4U);
  ComplexSystem system;
  for (std::size_t field = 0; field < 4; ++field) {
    const double scale = field < 2 ? 1 : 1 / (over.rho * over.vp);
    auto& equation = system.emplace_back();
    for (const auto& wave : up) equation.push_back(scale * wave.second[field]);
    for (const auto& wave : through) equation.push_back(-scale * wave.second[field]);
    equation.push_back(-scale * sign * fields[field]);
  }
  const auto found = solved(std::move(system));
  for (std::size_t n = 0; n < 4; ++n) {
    auto wave = (n < 2 ? up[n] : through[n - 2]).first;
    for (auto& part : wave.velocity) part *= found[n].real();
    (n < 2 ? above : below).push_back(wave);
  }
  return error_of_arrivals<2>(scene, above, below, 150);
}

/// The error of one through a rock of 3-D, by the Christoffel equation of the nine or more stiffnesses.
double error_in_3d(const Material& rock, double angle_deg, double azimuth_deg, bool shear) {
  const double x = std::sin(angle_deg * degree), z = std::cos(angle_deg * degree),
               c = std::cos(azimuth_deg * degree), s = std::sin(azimuth_deg * degree);
  const Point<3> direction = {x * c, x * s, z}, usual = {z * c, z * s, -x};
  const auto waves = slipwave::waves_along<3>(elasticity_of<3>(rock), direction);
  const auto share = [&](std::size_t wave, const Point<3>& of) {
    const auto& v = waves.vectors[wave];
    return v[0] * of[0] + v[1] * of[1] + v[2] * of[2];
  };
  const std::size_t wave = !shear ? 0 : std::abs(share(1, usual)) > std::abs(share(2, usual)) ? 1 : 2;
  const double sign = share(wave, shear ? usual : direction) < 0 ? -1 : 1,
               speed = std::sqrt(waves.values[wave] / rock.rho);
  Arrival<3> arrival;
  for (std::size_t i = 0; i < 3; ++i)
    arrival.velocity[i] = sign * waves.vectors[wave][i], arrival.slowness[i] = direction[i] / speed;
  const std::int64_t across = long_form() ? 12 : 8, deep = long_form() ? 32 : 16;
  const double from = long_form() ? -60 : -30, last = long_form() ? 142 : 66;
  auto scene = plane_wave_in<3>(
      {{rock, 0}}, {across, across, deep},
      (shear ? "plane-s:" : "plane:") + std::to_string(angle_deg) + "," + std::to_string(azimuth_deg), from,
      (last - from) / speed * z + 0.1);
  scene.survey.receivers_m = {{-12, 11, 33}, {14, -13, last}};
  if (!long_form()) scene.numerics.zone_cells = 6;
  if (long_form()) scene.survey.receivers_m = {{-21, 14, 33}, {24, -13, 71}, {6, 22, 118}, {-12, -8, last}};
  return error_of_arrivals<3>(scene, {arrival}, {}, 0);
}

// Proves (A17), (A19).
TEST(AnisotropicPlaneWave, GoesThroughARockUndisturbed) {
  const ThreadLimit one_thread(1);
  for (const auto& rock : {in_plane(shale), dipping_shale, steep, sheared})
    for (const double angle : {0., 25., -40.})
      for (const bool shear : {false, true}) {
        if (!long_form() && (rock == steep || angle == (rock.tilt == 0 ? 0 : -40))) continue;
        if (!long_form() && (shear == (angle == 25) || (rock == sheared && shear))) continue;
        // 16 cells per S wave of the peak.
        EXPECT_LT(error_in_plane(rock, rock, angle, shear), shear ? 0.03 : 0.003)
            << rock.tilt << ' ' << angle << shear;
      }
  for (const auto& rock : {shale, askew, triclinic})
    for (const bool shear : {false, true}) {
      if (!long_form() && (shear != (rock == shale) || rock == askew)) continue;
      EXPECT_LT(error_in_3d(rock, 25, 40, shear), shear ? 0.05 : 0.01) << rock.tilt << shear;
    }
}

// Proves (A17).
TEST(AnisotropicPlaneWave, IsReflectedConvertedAndTransmittedAsPlaneWavesAre) {
  const ThreadLimit one_thread(1);
  const Material sand{2500, 1300, 2200};
  for (const auto& [over, under] :
       {std::pair{in_plane(shale), hard}, {dipping_shale, steep}, {sand, dipping_shale}})
    for (const double angle : {0., 25., -25.}) {
      if (!long_form() && (over != dipping_shale || angle >= 0)) continue;
      EXPECT_LT(error_in_plane(over, under, angle, false), 0.02) << over.tilt << ' ' << angle;
    }
}

/// Evanescent and multiply reflected waves: no closed form in time, but the same traces however wide the
/// model is. What interfaces make of it must enter by the sides as the grid has it inside.
template <int D>
void expect_same_in_wide_model(const std::vector<std::pair<Material, std::int64_t>>& layers,
                               const std::string& kind, std::int64_t deep,
                               const std::array<std::int64_t, 2>& widths, double from_m, double duration_s,
                               const std::vector<Point<D>>& receivers, double bound) {
  std::vector<double> samples[2];
  for (const std::size_t n : {0, 1}) {
    Index<D> shape;
    shape.fill(widths[n]), shape[D - 1] = deep;
    auto scene = plane_wave_in<D>(layers, shape, kind, from_m, duration_s);
    if (D == 2) scene.survey.sources[0].wavelet = parse_wavelet("ricker:15"), scene.numerics.order = 5;
    if (!long_form()) scene.numerics.zone_cells = D == 2 ? 10 : 6;
    scene.survey.receivers_m = receivers;
    check(scene);
    samples[n] = samples_of(shoot(scene, 1));
  }
  EXPECT_LT(relative_error(samples[0], samples[1]), bound) << kind;
}

// Proves (A17), (A19).
TEST(AnisotropicPlaneWave, InLayersIsTheSameHoweverWideTheModelIs) {
  const ThreadLimit one_thread(1);
  for (const std::string kind : {"plane:155", "plane-s:215", "plane-s:180"}) {
    if (!long_form() && kind != "plane-s:215") continue;
    expect_same_in_wide_model<2>({{sea, 12}, {shale, 18}, {dipping_shale, 15}, {hard, 0}}, kind, 60,
                                 {30, long_form() ? 70 : 50}, 500, long_form() ? 0.5 : 0.4,
                                 {{-30, 32}, {30, 122}, {0, 202}}, 0.01);
  }
  for (const std::string kind : {"plane:25,40", "plane-s:-20,110"}) {
    if (!long_form() && kind[5] == '-') continue;
    if (long_form())
      expect_same_in_wide_model<3>({{askew, 16}, {shale, 0}}, kind, 32, {12, 40}, -60, 0.2,
                                   {{-21, 14, 33}, {24, -13, 71}, {6, 22, 118}, {-12, -8, 142}}, 0.015);
    else
      expect_same_in_wide_model<3>({{askew, 10}, {shale, 0}}, kind, 20, {6, 10}, -30, 0.11,
                                   {{-11, 10, 23}, {12, -9, 41}, {6, 12, 78}}, 0.015);
  }
}

}  // namespace
}  // namespace slipwave::solver::anisotropic_plane_wave_test
