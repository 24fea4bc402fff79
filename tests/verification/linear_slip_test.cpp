// SPDX-License-Identifier: BSD-3-Clause
// Planes that give way as springs, one row of cells of them, are an interface of Schoenberg's (1980): P and S
// waves that fall onto it at an angle, against his closed form (docs/slip.md).
#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <numbers>

#include "lab.hpp"
#include "long_form.hpp"
#include "scene/scene.hpp"
#include "solver/effect/linear_slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver::linear_slip_test {
namespace {

using Complex = std::complex<double>;
constexpr Complex i1{0, 1};
constexpr Rock rock{4500, 2250, 2500};
constexpr double pi = std::numbers::pi;
const double mu = rock.mu(), modulus = rock.rho * rock.vp * rock.vp, lambda = modulus - 2 * mu;

/// A plane wave exp(i (kx x + kz z - w t)): its velocity and the traction on level planes.
struct Wave {
  Complex vx, vz, szz, sxz, sxx;
};
Wave wave_of(bool of_s, double omega, double kx, Complex kz) {
  const double k = omega / (of_s ? rock.vs : rock.vp);
  const Complex vx = (of_s ? kz : Complex(kx)) / k, vz = (of_s ? Complex(-kx) : kz) / k;
  const Complex trace = kx * vx + kz * vz;
  return {vx, vz, -(lambda * trace + 2 * mu * kz * vz) / omega, -mu * (kx * vz + kz * vx) / omega,
          -(lambda * trace + 2 * mu * kx * vx) / omega};
}
Complex across(bool of_s, double omega, double kx) {
  const double k = omega / (of_s ? rock.vs : rock.vp);
  return std::sqrt(Complex(k * k - kx * kx));
}

/// Compliance and dashpot of the plane, normal and tangential.
struct Plane {
  double z_n, z_t, d_n = 0, d_t = 0;
};
/// Velocities of the P and S waves that go off upwards and downwards, of an incident wave of velocity 1.
struct Coefficients {
  Complex p_up, s_up, p_down, s_down;
};

/// Schoenberg's boundary conditions, solved: tractions are the same on both sides, displacements differ by
/// compliance times traction.
Coefficients closed_form(bool of_s, double omega, double kx, const Plane& plane) {
  const Complex kp = across(false, omega, kx), ks = across(true, omega, kx);
  const Wave in = wave_of(of_s, omega, kx, of_s ? ks : kp);
  const Wave out[4] = {wave_of(false, omega, kx, -kp), wave_of(true, omega, kx, -ks),
                       wave_of(false, omega, kx, kp), wave_of(true, omega, kx, ks)};
  const auto give = [&](double compliance, double dashpot) {
    return compliance == 0 ? 0 : -i1 * omega / (1 / compliance - i1 * omega * dashpot);
  };
  const Complex n = give(plane.z_n, plane.d_n), t = give(plane.z_t, plane.d_t);
  Complex a[4][5];
  for (int k = 0; k < 4; ++k) {
    const double side = k < 2 ? -1 : 1;
    const Complex below = k < 2 ? 0 : 1;
    a[0][k] = side * out[k].szz;
    a[1][k] = side * out[k].sxz;
    a[2][k] = side * out[k].vz - below * n * out[k].szz;
    a[3][k] = side * out[k].vx - below * t * out[k].sxz;
  }
  a[0][4] = in.szz, a[1][4] = in.sxz, a[2][4] = in.vz, a[3][4] = in.vx;
  // Rows differ by the size of a stress: elimination by the largest of rows so scaled.
  for (int row = 0; row < 2; ++row)
    for (auto& entry : a[row]) entry /= rock.rho * rock.vp;
  for (int k = 0; k < 4; ++k) {
    int pivot = k;
    for (int row = k; row < 4; ++row)
      if (std::abs(a[row][k]) > std::abs(a[pivot][k])) pivot = row;
    std::swap(a[k], a[pivot]);
    for (int row = 0; row < 4; ++row) {
      if (row == k) continue;
      const Complex factor = a[row][k] / a[k][k];
      for (int column = k; column < 5; ++column) a[row][column] -= factor * a[k][column];
    }
  }
  return {a[0][4] / a[0][0], a[1][4] / a[1][1], a[2][4] / a[2][2], a[3][4] / a[3][3]};
}

/// Between two mirrors `nx` cells apart a wave and its mirror image make a standing wave along x, of one
/// wave number: for a frequency one angle, without ends and without diffraction.
struct Setup {
  bool of_s;
  double hz;
  std::int64_t nx;
  double h;
  int order = 7;
  double cfl = 0.9;
  SlipCorrection correction = SlipCorrection::second;

  double kx() const { return pi / (double(nx) * h); }
  double omega() const { return 2 * pi * hz; }
  double angle_deg() const { return std::asin(kx() * (of_s ? rock.vs : rock.vp) / omega()) * 180 / pi; }
};

/// vx and vz of the standing wave at that frequency, above and below the row.
struct Amplitudes {
  Complex vx[2], vz[2];
};

/// Cells from the row to where waves are measured: where P waves die away with the distance not so far that
/// they are lost in the errors of the others.
std::int64_t cells_away(const Setup& of) {
  const double decay = across(false, of.omega(), of.kx()).imag();
  return decay > 0 ? std::clamp<std::int64_t>(std::llround(1 / (decay * of.h)), 3, 10) : 10;
}

Amplitudes run(const Setup& of, const Plane& plane) {
  const double kz = across(of.of_s, of.omega(), of.kx()).real(), speed = of.of_s ? rock.vs : rock.vp;
  // The wave is a Gaussian group of waves that ends before it comes to the row.
  const double width_m = 0.8 * 2 * pi / kz, h = of.h;
  // Twice the wavelength along z, and from one end to the other waves fall by exp(-5), whatever the cells.
  const auto taper = std::int64_t(std::max(1.3 * rock.vp / of.hz, 13 / kz) / h);
  const double speed_along_z = speed * speed * kz / of.omega();
  const auto row = std::int64_t(9.5 * width_m / h) + taper, nz = row + std::int64_t(2 * width_m / h) + taper;
  Scene<2> scene;
  scene.model.medium = uniform_medium(of.nx, nz, h, rock);
  scene.numerics.correction = of.correction;
  SlipSystem<2> system{{0, 1}, 0, 0, 0, false, FrictionLaw::none};
  system.compliance = {plane.z_n, plane.z_t, plane.d_n, plane.d_t, h};
  scene.model.fracture_sets = {{"row", {system}}};
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t i = 0; i < of.nx; ++i) scene.model.fracture({i, row}) = 1;
  const double dt_s = of.cfl * h / rock.vp;
  const auto away = cells_away(of);
  using L = Lab<float>;
  L lab(scene.model.medium, edges_all(EdgeLaw::mirror), of.order, dt_s);
  const bool gives = system.compliance.gives();
  LinearSlip<2, float> slip(lab.state(), lab.domain(), scene, dt_s);
  const double from = -4.75 * width_m;
  const auto z_of = [&](std::int64_t k) { return double(k - row) * h; };
  std::vector<Wave> group(std::size_t(nz), Wave{});
  for (double q = std::max(1e-3, kz - 5 / width_m); q < kz + 5 / width_m; q += 0.02 / width_m) {
    const double size = std::exp(-std::pow((q - kz) * width_m, 2) / 2);
    const Wave wave = wave_of(of.of_s, speed * std::hypot(of.kx(), q), of.kx(), q);
    for (std::int64_t k = 0; k < nz; ++k) {
      const Complex at = size * std::polar(1., q * (z_of(k) - from));
      auto& sum = group[std::size_t(k)];
      sum.vx += at * wave.vx, sum.vz += at * wave.vz, sum.szz += at * wave.szz;
      sum.sxz += at * wave.sxz, sum.sxx += at * wave.sxx;
    }
  }
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < of.nx; ++i) {
      const double x = of.kx() * (double(i) + 0.5) * h;
      const auto& at = group[std::size_t(k)];
      lab(L::vx, i, k) = float((i1 * at.vx).real() * std::sin(x));
      lab(L::vz, i, k) = float(at.vz.real() * std::cos(x));
      lab(L::sxx, i, k) = float(at.sxx.real() * std::cos(x));
      lab(L::szz, i, k) = float(at.szz.real() * std::cos(x));
      lab(L::sxz, i, k) = float((i1 * at.sxz).real() * std::sin(x));
    }
  const double end_s = 9.5 * width_m / speed_along_z;
  const double damping_per_s = 15 * speed_along_z / (double(taper) * h);
  Amplitudes found{};
  for (std::int64_t n = 0; double(n) * dt_s < end_s; ++n) {
    lab.step();
    if (gives) run_everywhere(slip, {n, dt_s}, lab.state());
    for (const int side : {0, 1}) {
      const std::int64_t k = row + (side ? away : -away);
      const Complex turn = std::polar(2. / double(of.nx), of.omega() * double(n + 1) * dt_s);
      for (std::int64_t i = 0; i < of.nx; ++i) {
        const double x = of.kx() * (double(i) + 0.5) * h;
        found.vx[side] += turn * std::sin(x) * double(lab(L::vx, i, k)) / i1;
        found.vz[side] += turn * std::cos(x) * double(lab(L::vz, i, k));
      }
    }
    if (gives) run_after_everywhere(slip, {n, dt_s}, lab.state());
    for (std::int64_t k = 0; k < nz; ++k) {
      const auto depth = double(std::max(taper - k, k - (nz - 1 - taper))) / double(taper);
      if (depth <= 0) continue;
      const auto keep = float(std::exp(-damping_per_s * dt_s * depth * depth));
      for (const auto field : {L::vx, L::vz, L::sxx, L::szz, L::sxz})
        for (std::int64_t i = 0; i < of.nx; ++i) lab(field, i, k) *= keep;
    }
  }
  return found;
}

Coefficients measured(const Setup& of, const Plane& plane) {
  const auto with = run(of, plane), without = run(of, {0, 0});
  const double omega = of.omega(), kx = of.kx(), distance = double(cells_away(of)) * of.h;
  const Complex kp = across(false, omega, kx), ks = across(true, omega, kx), k_in = of.of_s ? ks : kp;
  Complex p[2], s[2];
  for (const int side : {0, 1}) {
    const double way = side ? 1 : -1;
    // What the row sends off: of the edges' reflections of the incident wave nothing is left.
    const Complex vx = with.vx[side] - without.vx[side], vz = with.vz[side] - without.vz[side];
    const Wave in = wave_of(of.of_s, omega, kx, k_in);
    // By the larger component, at the depth of the row.
    const Complex came =
        (std::abs(in.vx) > std::abs(in.vz) ? without.vx[side] / in.vx : without.vz[side] / in.vz) *
        std::exp(-i1 * k_in * (way * distance));
    const Wave of_p = wave_of(false, omega, kx, way * kp), of_s_wave = wave_of(true, omega, kx, way * ks);
    const Complex determinant = of_p.vx * of_s_wave.vz - of_p.vz * of_s_wave.vx;
    p[side] = (vx * of_s_wave.vz - vz * of_s_wave.vx) / determinant * std::exp(-i1 * kp * distance) / came;
    s[side] = (of_p.vx * vz - of_p.vz * vx) / determinant * std::exp(-i1 * ks * distance) / came;
  }
  (of.of_s ? s : p)[1] += 1;
  return {p[0], s[0], p[1], s[1]};
}

/// Compliance of which r = omega Z rho vs/2 is that at 30 Hz.
double compliance(double r) { return 2 * r / (2 * pi * 30 * rock.rho * rock.vs); }

/// Prints sizes found, of the closed form and of their difference: P and S upwards, P and S downwards.
double worst(const Setup& of, const Plane& plane) {
  const auto exact = closed_form(of.of_s, of.omega(), of.kx(), plane);
  const auto found = measured(of, plane);
  const std::pair<Complex, Complex> pairs[] = {{found.p_up, exact.p_up},
                                               {found.s_up, exact.s_up},
                                               {found.p_down, exact.p_down},
                                               {found.s_down, exact.s_down}};
  double most = 0;
  std::printf("%s %4.1f Hz %5.1f deg:", of.of_s ? "S" : "P", of.hz, of.angle_deg());
  for (const auto& [is, should] : pairs) {
    most = std::max(most, std::abs(is - should));
    std::printf("  %.4f %.4f (%.4f)", std::abs(is), std::abs(should), std::abs(is - should));
  }
  std::printf("\n");
  return most;
}

/// The width at which waves of that frequency come in near that angle.
Setup setup(bool of_s, double hz, double angle_deg, double h) {
  const double speed = of_s ? rock.vs : rock.vp;
  const double k = 2 * pi * hz / speed * std::sin(std::max(angle_deg, 1.) * pi / 180);
  return {of_s, hz, std::max<std::int64_t>(std::llround(pi / k / h), 3), h};
}

struct Case {
  bool of_s;
  double hz, angle_deg;
};

// Proves (S25).
TEST(SpringRow, ReflectsAndTransmitsAsSchoenbergsInterface) {
  std::vector<Case> cases = {{false, 30, 40}, {true, 60, 40}};
  if (long_form()) {
    cases.clear();
    for (const bool of_s : {false, true})
      for (const double hz : {10., 30., 60.})
        for (const double angle_deg : {1., 40., 70.})
          if ((hz == 30) == (angle_deg == 40)) cases.push_back({of_s, hz, angle_deg});
  }
  for (const auto& [of_s, hz, angle_deg] : cases) {
    const auto of = setup(of_s, hz, angle_deg, hz > 25 ? 2.5 : 5);
    SCOPED_TRACE((of_s ? "S, " : "P, ") + std::to_string(hz) + " Hz, " + std::to_string(of.angle_deg()));
    EXPECT_LT(worst(of, {compliance(0.05), compliance(0.1)}), 0.02);
  }
}

TEST(SpringRow, WithDashpotsDoesSoToo) {
  const double z = compliance(0.2), dashpot = 0.5 / (z * 2 * pi * 30);
  EXPECT_LT(worst(setup(true, 30, 20, 2.5), {z, z, dashpot, dashpot}), 0.02);
}

}  // namespace
}  // namespace slipwave::solver::linear_slip_test
