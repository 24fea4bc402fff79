// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "fitted_scenes.hpp"
#include "half_space.hpp"
#include "solver/record/component_weights.hpp"
#include "solver/simulation.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/point_weights.hpp"
#include "unit/curvilinear_grid.hpp"
#include "viscoelastic.hpp"

// What is recorded beside velocity and stress: displacement, acceleration, strain rates, div, curl, DAS.
namespace slipwave::solver::solver_records_test {
namespace {

using enum Component;
constexpr Rock rock{3900, 2250, 2500};
constexpr double peak_hz = 20, interval_s = 0.001, force_n = 3e6;
constexpr Fibre fibre{60, 0, 25};
const std::vector<Component> recorded = {ux, uz, ax, az, exx, ezz, exz, div, Component::curl, das};

/// The medium on a grid whose low corner is at `origin`.
Medium<2> moved_to(const Medium<2>& medium, const Point<2>& origin_m) {
  Grid<2> grid = medium.grid();
  grid.origin_m = origin_m;
  const auto moved = [&](const Field<2>& field) {
    Field<2> all(grid);
    std::copy(field.begin(), field.end(), all.begin());
    return all;
  };
  return {moved(medium.vp), moved(medium.vs), moved(medium.rho)};
}

/// Velocity at an offset from a source, by frequency.
using VelocityAt = std::function<std::array<std::complex<double>, 2>(double omega, double dx, double dz)>;

/// That of a line force (1, 2) N/m.
std::array<std::complex<double>, 2> of_force(double omega, double dx, double dz) {
  const auto one = force_motion(rock, omega, dx, dz, 0), other = force_motion(rock, omega, dx, dz, 1);
  return {one[0] + 2. * other[0], one[1] + 2. * other[1]};
}

/// All that is recorded at the offset x, z, by the closed form of velocity: derivatives in space by
/// differences over a thousandth of a wavelength.
std::vector<std::vector<double>> exact_traces(const VelocityAt& velocity, double x, double z,
                                              std::int64_t count) {
  const auto motion = [&](double omega) {
    if (omega == 0) return std::vector<std::complex<double>>(recorded.size());
    const double step = 0.1;
    const std::complex<double> i_omega(0, omega);
    const auto v = velocity(omega, x, z);
    const auto low_x = velocity(omega, x - step, z), high_x = velocity(omega, x + step, z);
    const auto low_z = velocity(omega, x, z - step), high_z = velocity(omega, x, z + step);
    const auto slope = [&](const auto& low, const auto& high, int axis) {
      return (high[std::size_t(axis)] - low[std::size_t(axis)]) / (2 * step);
    };
    const auto d = direction_of<2>(fibre);
    const Point<2> half = {d[0] * fibre.gauge_m / 2, d[1] * fibre.gauge_m / 2};
    const auto low = velocity(omega, x - half[0], z - half[1]),
               high = velocity(omega, x + half[0], z + half[1]);
    const auto xx = slope(low_x, high_x, 0), zz = slope(low_z, high_z, 1), xz = slope(low_z, high_z, 0),
               zx = slope(low_x, high_x, 1);
    return std::vector<std::complex<double>>{
        v[0] / i_omega,
        v[1] / i_omega,
        v[0] * i_omega,
        v[1] * i_omega,
        xx,
        zz,
        (xz + zx) / 2.,
        xx + zz,
        xz - zx,
        (d[0] * (high[0] - low[0]) + d[1] * (high[1] - low[1])) / fibre.gauge_m};
  };
  std::vector<std::vector<double>> traces;
  for (const std::size_t first : {0, 5}) {
    const auto half = ricker_response(peak_hz, interval_s, count, [&](double omega) {
      const auto all = motion(omega);
      Motion five;
      for (std::size_t n = 0; n < 5; ++n) five[n] = all[first + n];
      return five;
    });
    traces.insert(traces.end(), half.begin(), half.end());
  }
  // The sum lacks its mean, which displacement has.
  for (const std::size_t row : {0, 1})
    for (std::size_t n = traces[row].size(); n-- > 0;) traces[row][n] -= traces[row][0];
  return traces;
}

Scene<2> full_space(double cells_a_wavelength, double half_width_m) {
  const double h = rock.vs / peak_hz / cells_a_wavelength;
  const auto n = std::int64_t(2 * half_width_m / h);
  Scene<2> scene;
  scene.model.medium = moved_to(uniform_medium(n, n, h, rock), {-double(n) * h / 2, -double(n) * h / 2});
  scene.survey.sources = {
      {{1.7, -0.9}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:20"), force_n}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.order = 7;
  // At 1.9 P waves alone, as div holds, lag by a percent.
  scene.numerics.cfl = 1.6;
  scene.numerics.time_order = 4;
  scene.recording = {recorded, 0.36, interval_s, fibre};
  return scene;
}

/// Every component at every receiver against its closed form, relative to the largest trace of its kind.
void expect_closed_form(const Scene<2>& scene, double bound, const VelocityAt& velocity = of_force) {
  check(scene);
  const Gather gather = shoot(scene, 1);
  const auto receivers = scene.survey.receivers_m.size();
  for (std::size_t receiver = 0; receiver < receivers; ++receiver) {
    const auto& at = scene.survey.receivers_m[receiver];
    const auto exact = exact_traces(velocity, at[0] - 1.7, at[1] + 0.9, gather.axis.count);
    // Vectors, and the strain rates, are measured by the largest of their kind.
    const std::vector<std::vector<std::size_t>> kinds = {{0, 1}, {2, 3}, {4, 5, 6}, {7}, {8}, {9}};
    for (const auto& kind : kinds) {
      std::vector<double> found, wanted;
      for (const auto row : kind) {
        for (const double sample : gather.traces[row * receivers + receiver].samples)
          found.push_back(sample / force_n);
        wanted.insert(wanted.end(), exact[row].begin(), exact[row].end());
      }
      EXPECT_LT(100 * relative_error(found, wanted), bound)
          << name_of(recorded[kind.front()]) << " at " << at[0] << ' ' << at[1];
    }
  }
}

// Proves (A9), (A12), (A13).
TEST(Records, OfAFullSpaceAreThoseOfTheClosedForm) {
  auto scene = full_space(16, 560);
  scene.survey.receivers_m = {{203.3, 57.1}, {25.7, 201.9}, {-211.2, 171.4}};
  expect_closed_form(scene, 1);
}

void attenuate(Scene<2>& scene, double qp, double qs) {
  auto& medium = scene.model.medium;
  medium[Property::qp] = Field<2>(medium.grid(), float(qp));
  medium[Property::qs] = Field<2>(medium.grid(), float(qs));
  set_attenuation(scene);
}

TEST(Records, OfAnAttenuatingFullSpaceAreThoseOfComplexModuli) {
  auto scene = full_space(16, 560);
  scene.survey.receivers_m = {{-111.2, 171.4}};
  attenuate(scene, 30, 20);
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto p = standard_linear(mechanisms, 30, peak_hz), s = standard_linear(mechanisms, 20, peak_hz);
  expect_closed_form(scene, 1, [&](double omega, double dx, double dz) {
    const LossyRock lossy(rock, omega, p, s);
    const auto one = lossy_force<2>(lossy, omega, {dx, dz}, 0),
               other = lossy_force<2>(lossy, omega, {dx, dz}, 1);
    return std::array{one[0] + 2. * other[0], one[1] + 2. * other[1]};
  });
}

/// How much the strain rate across a free surface of attenuating rock lacks, relative to what complex moduli
/// make of that along it.
double error_across_the_surface(double qp, double qs) {
  const double h = rock.vs / peak_hz / 16;
  const auto n = std::int64_t(800 / h);
  Scene<2> scene;
  scene.model.medium = moved_to(uniform_medium(n, n / 2, h, rock), {-400, 0});
  scene.survey.sources = {{{0, 60}, Explosion{}, parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = {{151.3, 0}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.order = 7;
  scene.recording = {{exx, ezz, exz}, 0.5, interval_s};
  attenuate(scene, qp, qs);
  check(scene);
  const auto gather = shoot(scene, 1);
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto p = standard_linear(mechanisms, qp, peak_hz), s = standard_linear(mechanisms, qs, peak_hz);
  const auto at = [&](std::size_t trace, double omega) {
    std::complex<double> sum = 0;
    const auto& samples = gather.traces[trace].samples;
    for (std::size_t k = 0; k < samples.size(); ++k)
      sum += samples[k] * std::polar(1., -omega * double(k) * interval_s);
    return sum;
  };
  double difference = 0, size = 0, shear = 0;
  for (double hz = 5; hz <= 45; hz += 1) {
    const double omega = 2 * std::numbers::pi * hz;
    const LossyRock lossy(rock, omega, p, s);
    const auto ratio = 1. - 2. * lossy.mu() / lossy.p_modulus();
    difference += std::norm(at(1, omega) + ratio * at(0, omega));
    size += std::norm(ratio * at(0, omega));
    shear += std::norm(at(2, omega));
  }
  EXPECT_LT(std::sqrt(shear / size), 1e-6);
  return std::sqrt(difference / size);
}

TEST(Records, OnAFreeSurfaceOfAttenuatingRockShrinkByItsUnrelaxedModuli) {
  // That error is of the order of 1/Q (docs/attenuation.md).
  EXPECT_LT(error_across_the_surface(40, 20), 0.09);
  EXPECT_LT(error_across_the_surface(160, 80), 0.023);
}

/// Velocity of a moment tensor whose rate is the wavelet: minus the slope of what forces do, since the source
/// moves the other way, per i omega.
std::array<std::complex<double>, 2> moment_motion(const SymmetricTensor<2, double>& moment, double omega,
                                                  double x, double z) {
  const double step = 0.1;
  std::array<std::complex<double>, 2> sum{};
  for (int force = 0; force < 2; ++force)
    for (int along = 0; along < 2; ++along) {
      const double dx = along == 0 ? step : 0, dz = along == 0 ? 0 : step;
      const auto low = force_motion(rock, omega, x - dx, z - dz, force),
                 high = force_motion(rock, omega, x + dx, z + dz, force);
      for (std::size_t n = 0; n < 2; ++n)
        sum[n] -= moment(force, along) * (high[n] - low[n]) / (2 * step) / std::complex<double>(0, omega);
    }
  return sum;
}

TEST(Sources, OfADoubleCoupleMoveTheRockAsInTheClosedForm) {
  auto scene = full_space(16, 560);
  scene.survey.sources[0].mechanism = parse_mechanism<2>("double-couple:25");
  scene.survey.receivers_m = {{153.3, 107.1}, {25.7, 201.9}, {-151.2, 131.4}};
  scene.recording = {{vx, vz}, 0.36, interval_s};
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto moment = point_injection(scene.survey.sources[0])->moment_rate;
  for (std::size_t receiver = 0; receiver < 3; ++receiver) {
    const auto& at = scene.survey.receivers_m[receiver];
    const auto exact = ricker_response(peak_hz, interval_s, gather.axis.count, [&](double omega) {
      const auto v = moment_motion(moment, omega, at[0] - 1.7, at[1] + 0.9);
      return Motion{v[0], v[1]};
    });
    std::vector<double> found, wanted;
    for (const std::size_t row : {0, 1}) {
      const auto& samples = gather.traces[row * 3 + receiver].samples;
      found.insert(found.end(), samples.begin(), samples.end());
      wanted.insert(wanted.end(), exact[row].begin(), exact[row].end());
    }
    EXPECT_LT(100 * relative_error(found, wanted), 1) << receiver;
  }
}

TEST(Sources, HaveTheFarFieldsOfTheTable) {
  // docs/sources.md in frequency, 400 P wavelengths away: the near field is some thousandths.
  const double omega = 2 * std::numbers::pi * peak_hz, r = 400 * rock.vp / peak_hz;
  const Point<2> g = {std::sin(0.4), std::cos(0.4)};
  const auto half = [&](double c) {
    return std::sqrt(std::complex<double>(0, omega)) * std::polar(1., -omega * r / c) /
           std::sqrt(8 * std::numbers::pi * c * r);
  };
  const auto p = half(rock.vp) / rock.vp, s = half(rock.vs) / rock.vs;
  const auto expect_near = [](const auto& found, const std::array<std::complex<double>, 2>& wanted) {
    for (std::size_t n = 0; n < 2; ++n)
      EXPECT_LT(std::abs(found[n] - wanted[n]), 5e-3 * std::hypot(std::abs(wanted[0]), std::abs(wanted[1])));
  };
  const auto explosion = p / (rock.rho * rock.vp);
  expect_near(explosion_motion(rock, omega, r * g[0], r * g[1]), {g[0] * explosion, g[1] * explosion});
  expect_near(force_motion(rock, omega, r * g[0], r * g[1], 0),
              {(g[0] * g[0] * p + (1 - g[0] * g[0]) * s) / rock.rho, g[1] * g[0] * (p - s) / rock.rho});
  const auto moment =
      point_injection<2>({{}, parse_mechanism<2>("double-couple:25"), parse_wavelet("ricker:20")})
          ->moment_rate;
  const Point<2> mg = {moment(0, 0) * g[0] + moment(0, 1) * g[1], moment(0, 1) * g[0] + moment(1, 1) * g[1]};
  const double radial = mg[0] * g[0] + mg[1] * g[1];
  const auto at = [&](std::size_t n) {
    return (g[n] * radial * p / rock.vp + (mg[n] - g[n] * radial) * s / rock.vs) / rock.rho;
  };
  expect_near(moment_motion(moment, omega, r * g[0], r * g[1]), {at(0), at(1)});
}

/// The velocity of a field that is given at places, in a cell of the computed grid.
double velocity_in(const Domain<2>& domain, Index<2> cell, int row,
                   const std::function<Point<2>(const Point<2>&)>& velocity) {
  for (std::size_t axis = 0; axis < 2; ++axis) cell[axis] -= domain.low_zone[axis];
  return velocity({domain.model_grid.centre(0, cell[0]), domain.model_grid.depth(cell)})[std::size_t(row)];
}

/// The sum of the weighted velocities of a field that is given at places.
double recorded_of(const Domain<2>& domain, const Point<2>& point, Component component,
                   const std::function<Point<2>(const Point<2>&)>& velocity) {
  const Layout<2> layout(domain.grid.shape, FieldRows<2>::count);
  double sum = 0;
  for (const auto& weight : component_weights<2>(layout, domain, point, component)) {
    const auto at = layout.line_index(weight.line);
    const auto row = int(weight.place / layout.row_pitch());
    sum += weight.weight * velocity_in(domain, {layout.column(weight.place), at[1]}, row, velocity);
  }
  return sum;
}

// Proves (A10).
TEST(Records, OfLinearVelocitiesAreExactInAnyGrid) {
  const auto linear = [](const Point<2>& at) {
    return Point<2>{3 + 2 * at[0] - 5 * at[1], 1 + 7 * at[0] + 4 * at[1]};
  };
  const auto medium = uniform_medium(60, 50, 5, rock);
  const auto rolling = bent<2>(medium.grid(), [](double x, double, double zeta) {
    return zeta * (1 + 0.1 * std::sin(x / 40)) + 6 * std::cos(x / 60) + 0.0004 * zeta * zeta;
  });
  for (const auto& grid : {medium.grid(), rolling}) {
    const Medium<2> same{Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)),
                         Field<2>(grid, float(rock.rho))};
    auto edges = edges_all(EdgeLaw::absorbing);
    const auto domain = make_domain(same, edges, 20);
    for (const Point<2> at : {Point<2>{151.2, 120.7}, {152.5, 122.5}, {120, 61.3}}) {
      const auto value = [&](Component component) { return recorded_of(domain, at, component, linear); };
      EXPECT_NEAR(value(exx), 2, 1e-7);
      EXPECT_NEAR(value(ezz), 4, 1e-7);
      EXPECT_NEAR(value(exz), 1, 1e-7);
      EXPECT_NEAR(value(div), 6, 1e-7);
      EXPECT_NEAR(value(Component::curl), -12, 1e-7);
    }
  }
}

/// Rock under a free surface that falls towards +x, in cells of 5 m.
Domain<2> under_a_free_surface(double slope) {
  const auto flat = uniform_medium(60, 50, 5, rock);
  const auto grid =
      slope == 0 ? flat.grid()
                 : bent<2>(flat.grid(), [=](double x, double, double zeta) { return zeta + 20 + slope * x; });
  const Medium<2> medium{Field<2>(grid, float(rock.vp)), Field<2>(grid, float(rock.vs)),
                         Field<2>(grid, float(rock.rho))};
  auto edges = edges_all(EdgeLaw::absorbing);
  edges[1][0] = EdgeLaw::free;
  return make_domain(medium, edges, 20);
}

// Proves (A11).
TEST(Records, OnAFreeSurfaceHaveTheSlopesWithWhichSweepsContinueIt) {
  // Both are exact for linear fields, whatever traction these would leave.
  const auto linear = [](const Point<2>& at) {
    return Point<2>{3 + 2 * at[0] - 5 * at[1], 1 + 7 * at[0] + 4 * at[1]};
  };
  for (const double slope : {0., 0.3}) {
    const auto domain = under_a_free_surface(slope);
    const Point<2> at = {152.5, slope == 0 ? 0 : 20 + slope * 152.5};
    const auto recorded = [&](Component component) { return recorded_of(domain, at, component, linear); };
    const auto continued = [&](std::size_t component) {
      double sum = 0;
      const auto slopes = surface_slopes(domain, cell_at(domain, at), 1, 0);
      for (const auto& term : slopes[component])
        sum += term.weight * velocity_in(domain, term.cell, term.row, linear);
      return sum;
    };
    // Per cell of 5 m, upwards.
    EXPECT_NEAR(continued(0), -5 * (recorded(exz) + recorded(Component::curl) / 2), 1e-6);
    EXPECT_NEAR(continued(1), -5 * recorded(ezz), 1e-6);
    EXPECT_GT(std::abs(recorded(ezz)), 0.5);
  }
}

// Proves (A11).
TEST(Records, OnAFreeSurfaceOfAnySlopeHaveNoTraction) {
  // A field of arbitrary curvature: on the surface the solver's own strain rates leave it without traction.
  const auto wave = [](const Point<2>& at) {
    return Point<2>{std::sin(at[0] / 30 + at[1] / 50), std::cos(at[0] / 45 - at[1] / 35)};
  };
  for (const double slope : {0., 0.3}) {
    const auto domain = under_a_free_surface(slope);
    for (const double x : {152.5, 163.1}) {
      const Point<2> at = {x, slope == 0 ? 0 : 20 + slope * x};
      const double xx = recorded_of(domain, at, exx, wave), zz = recorded_of(domain, at, ezz, wave),
                   xz = recorded_of(domain, at, exz, wave), length = std::hypot(slope, 1);
      const Point<2> normal = {slope / length, -1 / length};
      const double trace = rock.lambda() * (xx + zz);
      EXPECT_GT(std::abs(xx) + std::abs(zz), 1e-3);
      EXPECT_NEAR((trace + 2 * rock.mu() * xx) * normal[0] + 2 * rock.mu() * xz * normal[1], 0,
                  1e-11 * rock.mu());
      EXPECT_NEAR(2 * rock.mu() * xz * normal[0] + (trace + 2 * rock.mu() * zz) * normal[1], 0,
                  1e-11 * rock.mu());
      // Rock that is stretched along the surface, and free to shrink across it.
      const double ratio = rock.lambda() / (rock.lambda() + 2 * rock.mu());
      const Point<2> along = {-normal[1], normal[0]};
      const auto stretched = [&](const Point<2>& place) {
        const double a = place[0] * along[0] + place[1] * along[1],
                     n = -ratio * (place[0] * normal[0] + place[1] * normal[1]);
        return Point<2>{a * along[0] + n * normal[0], a * along[1] + n * normal[1]};
      };
      for (const double depth : {0., 1., 2.5, 6., 14.}) {
        const Point<2> below = {at[0], at[1] + depth};
        EXPECT_NEAR(recorded_of(domain, below, exx, stretched),
                    along[0] * along[0] - ratio * normal[0] * normal[0], 1e-7);
        EXPECT_NEAR(recorded_of(domain, below, ezz, stretched),
                    along[1] * along[1] - ratio * normal[1] * normal[1], 1e-7);
        EXPECT_NEAR(recorded_of(domain, below, exz, stretched),
                    along[0] * along[1] - ratio * normal[0] * normal[1], 1e-7);
        EXPECT_NEAR(recorded_of(domain, below, Component::curl, stretched), 0, 1e-7);
      }
    }
  }
}

// Proves (A11), (A13).
TEST(Records, OfAnExplosionUnderTheSurfaceAreThoseOfGarvinsClosedForm) {
  const double wavelength = rock.vs / peak_hz, h = wavelength / 16, duration_s = 0.4;
  const auto n = std::int64_t(1200 / h);
  Scene<2> scene;
  scene.model.medium = moved_to(uniform_medium(n, n / 2, h, rock), {-500, 0});
  scene.survey.sources = {{{0, wavelength}, Explosion{}, parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = {{101.3, 0}, {240, 0}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.cfl = 0.5;
  scene.recording = {{exx, ezz, exz, ax, az, das}, duration_s, interval_s, Fibre{90, 0, 20}};
  check(scene);
  const auto gather = shoot(scene, 1);
  const double ratio = rock.lambda() / (rock.lambda() + 2 * rock.mu());
  for (std::size_t receiver = 0; receiver < 2; ++receiver) {
    const double x = scene.survey.receivers_m[receiver][0];
    const auto at = [&](double place) {
      return garvin(rock, place, wavelength, {peak_hz}, interval_s, gather.axis.count)[0];
    };
    const auto samples = [&](std::size_t row) { return gather.traces[2 * row + receiver].samples; };
    auto strain = at(x + 0.5), mean = at(x + 10);
    const auto low = at(x - 0.5), low_mean = at(x - 10);
    double largest = 0;
    for (std::size_t k = 0; k < strain.size(); ++k) {
      strain[k] = 1e6 * (strain[k] - low[k]);
      mean[k] = 1e6 * (mean[k] - low_mean[k]) / 20;
      largest = std::max(largest, std::abs(strain[k]));
    }
    EXPECT_LT(100 * relative_error(samples(0), strain), 1) << x;
    EXPECT_LT(100 * relative_error(samples(5), mean), 1) << x;
    for (std::size_t k = 0; k < strain.size(); ++k) {
      EXPECT_NEAR(samples(1)[k], -ratio * samples(0)[k], 1e-10 * largest);
      EXPECT_NEAR(samples(2)[k], 0, 1e-10 * largest);
    }
  }
}

/// A P wave comes up from below to the free surface, where it doubles; ezz at any depth, in cells.
// Proves (A11).
TEST(Records, OfAWaveAndItsEchoFromTheSurfaceAreThoseOfTheClosedForm) {
  const double h = 5, hz = 30;  // 26 cells a P wavelength
  Scene<2> scene;
  scene.model.medium = uniform_medium(24, 100, h, rock);
  scene.survey.sources = {{{0, 500}, parse_mechanism<2>("plane:180"), parse_wavelet("ricker:30"), 0.01}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.cfl = 0.6;
  const std::vector<double> depths_m = {0, 1.3, 2.5, 4.1, 5, 9.9, 14.2, 33.3};
  for (const double z : depths_m) scene.survey.receivers_m.push_back({60.2, z});
  scene.recording = {{ezz, exx, exz, az, uz}, 0.3, interval_s};
  check(scene);
  const auto gather = shoot(scene, 1);
  const auto count = depths_m.size();
  const RickerForm wavelet{hz};
  double largest = 0;
  for (const double sample : gather.traces[count - 1].samples) largest = std::max(largest, std::abs(sample));
  for (std::size_t n = 0; n < count; ++n) {
    const double z = depths_m[n];
    std::vector<double> strain, acceleration, displacement;
    for (std::int64_t k = 0; k < gather.axis.count; ++k) {
      const double t = double(k) * interval_s, up = t - (500 - z) / rock.vp, down = t - (500 + z) / rock.vp;
      strain.push_back(-0.01 / rock.vp * (wavelet.slope(up) - wavelet.slope(down)));
      acceleration.push_back(-0.01 * (wavelet.slope(up) + wavelet.slope(down)));
      displacement.push_back(-0.01 * (wavelet.integral(up) + wavelet.integral(down)));
    }
    for (std::size_t k = 0; k < strain.size() && z == 0; ++k)
      EXPECT_LT(std::abs(gather.traces[0].samples[k]), 1e-5 * largest);
    double wrong = 0, size = 0;
    for (std::size_t k = 0; k < strain.size(); ++k) {
      wrong = std::max(wrong, std::abs(gather.traces[n].samples[k] - strain[k]));
      size = std::max(size, 0.02 / rock.vp * std::abs(wavelet.slope(double(k) * interval_s)));
    }
    EXPECT_LT(100 * wrong / size, 1) << z;
    EXPECT_LT(100 * relative_error(gather.traces[3 * count + n].samples, acceleration), 1) << z;
    EXPECT_LT(100 * relative_error(gather.traces[4 * count + n].samples, displacement), 1) << z;
  }
}

/// Rock and hills, a source near the surface, all that can be recorded.
Scene<2> hills() {
  auto scene = fitted_hills(220, 110);
  scene.survey.sources[0].position_m = {602, 160};
  scene.survey.receivers_m = {{630, 150}, {562.5, 201.3}, {540, 183}, {502, 251}, {605, 208}};
  scene.recording = {recorded, 0.07, interval_s, Fibre{30, 0, 62}};
  scene.recording.components.insert(scene.recording.components.begin() + 3, vz);
  return scene;
}

TEST(Records, AreTheSameInSingleAndDoublePrecision) {
  auto scene = hills();
  const auto single = samples_of(shoot(scene, 1));
  scene.numerics.double_precision = true;
  EXPECT_LT(relative_error(single, samples_of(shoot(scene, 1))), 1e-4);
}

// Proves (A13).
TEST(Records, DoNotChangeWhatElseIsRecorded) {
  auto scene = hills();
  const auto receivers = scene.survey.receivers_m.size();
  const auto all = shoot(scene, 1);
  scene.recording = {{vz}, 0.07, interval_s};
  const auto alone = shoot(scene, 1);
  for (std::size_t n = 0; n < receivers; ++n)
    EXPECT_TRUE(alone.traces[n].samples == all.traces[3 * receivers + n].samples);
}

/// An explosion in the corner of three mirrors: one of eight times its strength in a full space.
// Proves (A9), (A12), (A13).
TEST(CubeRecords, OfAFullSpaceAreThoseOfTheClosedForm) {
  const double h = 5, amplitude = 8e9;
  const Rock stone{4000, 2300, 2500};
  const RickerForm wavelet{40};  // 20 cells a P wavelength
  const std::int64_t n = 52;
  const std::vector<Point<3>> receivers = {{61, 47, 33}, {17, 21, 107}};
  const std::vector<Component> all = {ux,
                                      uy,
                                      uz,
                                      ax,
                                      ay,
                                      az,
                                      exx,
                                      eyy,
                                      ezz,
                                      exy,
                                      exz,
                                      eyz,
                                      div,
                                      Component::curl_x,
                                      Component::curl_y,
                                      Component::curl_z,
                                      das};
  auto scene = scene_of(uniform_cube({n, n, n}, h, stone), edges_all_3d(EdgeLaw::mirror), {0, 0, 0},
                        "explosion", "ricker:40", receivers, all, 0.085, interval_s);
  scene.recording.fibre = Fibre{50, 70, 22};
  scene.numerics.order = 7;
  scene.numerics.cfl = 0.6;
  check(scene);
  const auto gather = shoot(scene, 1);
  // v = A grad of -w(t - r/vp)/(4 pi rho vp^2 r); f of that potential is w, its integral or its derivative.
  const auto vector = [&](const Point<3>& at, double t, int order) {
    const double r = std::hypot(at[0], at[1], at[2]), s = t - r / stone.vp;
    const double value = order < 0 ? wavelet.integral(s) : order == 0 ? wavelet(s) : wavelet.slope(s);
    const double slope = order < 0 ? wavelet(s) : order == 0 ? wavelet.slope(s) : wavelet.bend(s);
    const double radial = amplitude / (4 * std::numbers::pi * stone.rho * stone.vp * stone.vp) *
                          (value / (r * r) + slope / (stone.vp * r));
    return Point<3>{radial * at[0] / r, radial * at[1] / r, radial * at[2] / r};
  };
  const auto slope = [&](const Point<3>& at, double t, std::size_t of, std::size_t along) {
    const double step = 0.05;
    auto low = at, high = at;
    low[along] -= step, high[along] += step;
    return (vector(high, t, 0)[of] - vector(low, t, 0)[of]) / (2 * step);
  };
  const auto direction = direction_of<3>(*scene.recording.fibre);
  const auto exact = [&](Component component, const Point<3>& at, double t) {
    const auto& row = slipwave::row_of(component);
    if (component == das) {
      auto low = at, high = at;
      for (std::size_t axis = 0; axis < 3; ++axis)
        low[axis] -= 11 * direction[axis], high[axis] += 11 * direction[axis];
      double sum = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        sum += direction[axis] * (vector(high, t, 0)[axis] - vector(low, t, 0)[axis]) / 22;
      return sum;
    }
    double sum = 0;
    for (const auto& term : row.terms_in(3)) {
      const auto of = std::size_t(term.field.axis);
      sum += term.sign * (term.along >= 0 ? slope(at, t, of, std::size_t(term.along))
                                          : vector(at, t, row.in_time == InTime::integral ? -1 : 1)[of]);
    }
    return row.is_sum ? sum : sum / row.term_count;
  };
  for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver)
    for (const auto& [first, last, scale] : {std::array<std::size_t, 3>{0, 3, 0},
                                             {3, 6, 3},
                                             {6, 12, 6},
                                             {12, 13, 12},
                                             {13, 16, 12},
                                             {16, 17, 16}}) {
      double wrong = 0, size = 0;
      for (std::size_t row = first; row < last; ++row)
        for (std::int64_t k = 0; k < gather.axis.count; ++k) {
          const double t = double(k) * interval_s,
                       found = gather.traces[row * 2 + receiver].samples[std::size_t(k)];
          const double wanted = exact(all[row], receivers[receiver], t);
          wrong += std::pow(found - wanted, 2);
          size += std::pow(first == scale ? wanted : exact(all[scale], receivers[receiver], t), 2);
        }
      EXPECT_LT(100 * std::sqrt(wrong / size), 1) << name_of(all[first]) << " at receiver " << receiver;
    }
}

}  // namespace
}  // namespace slipwave::solver::solver_records_test
