// SPDX-License-Identifier: BSD-3-Clause
// Time accuracy of the slip corrections against the slip law itself, tau' = E' - mu g, solved by other means.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "fracture_slip_cell.hpp"

namespace slipwave::fracture_slip_order_test {
namespace {

constexpr double pi = std::numbers::pi;

/// Prescribed elastic loading of one plane: what the shear and the normal stress would do without slip.
struct Loading {
  std::function<double(double)> shear, normal;
};

struct Rock {
  double mu = 1.2e10, eta = 2e3, friction = 0.3, cohesion = 50.;
  double strength(double s_n) const { return friction * std::max(-s_n, 0.) + cohesion; }
};

/// Slip starts, stops and reverses; s_n varies smoothly and never reaches zero.
const Loading shaking{
    [](double t) { return 9e4 * std::sin(2 * pi * 3 * t) + 4e4 * std::sin(2 * pi * 7.3 * t); },
    [](double t) { return -6e4 * (1 + 0.4 * std::cos(2 * pi * 2 * t)); }};
/// The plane slips in one direction all the time.
const Loading pulling{[](double t) { return 6e5 * t + 2e4 * std::sin(2 * pi * 4 * t); },
                      [](double t) { return -1e4 * (1 + 0.5 * std::sin(2 * pi * 3 * t)); }};

/// The plane opens and closes: its relaxation time falls to 8 microseconds, far below any step, and comes
/// back.
const Loading gaping{[](double t) { return 5e4 * std::sin(2 * pi * 5 * t + 0.4); },
                     [](double t) { return -5e4 * std::sin(2 * pi * 3 * t + 1); }};

/// The ODE by the classical fourth-order Runge-Kutta rule with tiny steps. The law's kink at |tau| = S lowers
/// its order in the few steps that cross it, which at this step leaves an error of about 1e-9 of the answer.
double reference(const Rock& rock, const Loading& loading, double end) {
  const int steps = 400000;
  const double dt = end / steps;
  // y = tau - E(t): only the slip is integrated.
  const auto rate = [&](double t, double y) {
    const double tau = y + loading.shear(t) - loading.shear(0);
    const double over = std::abs(tau) / rock.strength(loading.normal(t)) - 1;
    return over > 0 ? -rock.mu * std::copysign(over / rock.eta, tau) : 0.;
  };
  double y = 0;
  for (int n = 0; n < steps; ++n) {
    const double t = n * dt;
    const double k1 = rate(t, y), k2 = rate(t + dt / 2, y + dt / 2 * k1),
                 k3 = rate(t + dt / 2, y + dt / 2 * k2), k4 = rate(t + dt, y + dt * k3);
    y += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return y + loading.shear(end) - loading.shear(0);
}

/// The same by the correction, on the full stress of a cell whose planes have normal n and are sheared along
/// m.
template <class Correction, int D>
double corrected(const Rock& rock, const Loading& loading, double end, int steps,
                 const Traction<D, double>& n, const Traction<D, double>& m) {
  const double dt = end / steps;
  const double d = slip_d(rock.eta, rock.mu, dt);
  const SlipStrength<double> law{rock.friction, rock.cohesion};
  Stress<D, double> s;
  typename Correction::template Memory<D, double> memory{};
  const auto add = [&](double shear, double normal) {
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) s(i, j) += normal * n[i] * n[j] + shear * (n[i] * m[j] + m[i] * n[j]);
  };
  add(0, loading.normal(0));
  for (int step = 0; step < steps; ++step) {
    const double t = step * dt;
    begin<Correction, D, double>(law, n, d, s, memory);
    add(loading.shear(t + dt) - loading.shear(t), loading.normal(t + dt) - loading.normal(t));
    correct<Correction, D, double>(law, n, d, s, memory);
  }
  double tau = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) tau += m[i] * s(i, j) * n[j];
  return tau;
}

struct Plane {
  Traction<2, double> n, m;
};

Plane plane(double degrees) {
  const double a = degrees * pi / 180;
  return {{std::cos(a), std::sin(a)}, {-std::sin(a), std::cos(a)}};
}

/// Errors relative to the strength when the number of steps is doubled, starting from `coarsest`.
template <class Correction>
std::vector<double> errors(const Loading& loading, double degrees, int coarsest, int doublings) {
  const Rock rock;
  const double end = 0.4;
  // For all planes and corrections the same.
  static std::map<const Loading*, double> known;
  const auto [at, is_new] = known.try_emplace(&loading);
  if (is_new) at->second = reference(rock, loading, end);
  const double exact = at->second;
  const auto [n, m] = plane(degrees);
  std::vector<double> found;
  for (int k = 0; k <= doublings; ++k)
    found.push_back(std::abs(corrected<Correction, 2>(rock, loading, end, coarsest << k, n, m) - exact) /
                    rock.strength(loading.normal(end)));
  return found;
}

double order(const std::vector<double>& e) { return std::log2(e.front() / e.back()) / double(e.size() - 1); }

TEST(SlipReference, SlipsInTheLoadingsUsed) {
  // The orders below would be those of the elastic step, that is exact, were there no slip.
  const Rock rock;
  for (const auto& loading : {shaking, pulling, gaping}) {
    const double elastic = loading.shear(0.4) - loading.shear(0);
    EXPECT_GT(std::abs(reference(rock, loading, 0.4) - elastic), 0.3 * rock.strength(loading.normal(0.4)));
  }
}

// Proves (S5).
TEST(FirstOrderSlip, ConvergesWithOrderOneForAnyNormal) {
  for (const double degrees : {0., 90., 45., 30., -72.5}) {
    const auto pulled = errors<FirstOrder>(pulling, degrees, 400, 4);
    EXPECT_NEAR(order(pulled), 1, 0.1) << degrees;
    EXPECT_LT(pulled.back(), 2e-3) << degrees;
    EXPECT_NEAR(order(errors<FirstOrder>(shaking, degrees, 400, 4)), 1, 0.15) << degrees;
  }
}

// Proves (S6).
TEST(SecondOrderSlip, ConvergesWithOrderTwoForAnyNormal) {
  for (const double degrees : {0., 90., 45., 30., -72.5}) {
    const auto pulled = errors<SecondOrder>(pulling, degrees, 400, 4);
    EXPECT_NEAR(order(pulled), 2, 0.1) << degrees;
    EXPECT_LT(pulled.back(), 2e-6) << degrees;
    // Starts and stops of slip fall between steps: the error is second order but not a smooth function of dt.
    EXPECT_NEAR(order(errors<SecondOrder>(shaking, degrees, 400, 5)), 2, 0.3) << degrees;
  }
}

// Proves (S10).
TEST(ExponentialSlip, ConvergesWithOrderTwoForAnyNormal) {
  for (const double degrees : {0., 90., 45., 30., -72.5}) {
    const auto pulled = errors<Exponential>(pulling, degrees, 400, 4);
    EXPECT_NEAR(order(pulled), 2, 0.1) << degrees;
    EXPECT_LT(pulled.back(), 2e-6) << degrees;
    EXPECT_NEAR(order(errors<Exponential>(shaking, degrees, 400, 5)), 2, 0.3) << degrees;
  }
}

// Proves (S10).
TEST(ExponentialSlip, IsExactUnderAConstantLoadingRateHoweverLongTheStep) {
  const Rock rock;
  const double s = rock.strength(-2e5), rate = 1e6, relaxation = rock.eta * s / rock.mu;
  const Loading ramp{[&](double t) { return rate * t; }, [](double) { return -2e5; }};
  for (const double lasts : {0.3, 1.7, 30.}) {
    const double start = s / rate, end = start + lasts * relaxation;
    const double exact = s + rate * relaxation * (1 - std::exp(-lasts));
    const auto [n, m] = plane(-20);
    for (const int steps : {1, 7, 50})
      EXPECT_NEAR((corrected<Exponential, 2>(rock, ramp, end, steps, n, m)), exact, 1e-9 * exact) << steps;
  }
}

// Proves (S10).
TEST(ExponentialSlip, StopsInTheMiddleOfAStepWhereTheLawDoes) {
  // Loaded to slip, then unloaded in one step: from the instant at which tau falls to S the plane is stuck.
  const Rock rock;
  const double s = rock.strength(-2e5), relaxation = rock.eta * s / rock.mu, rate = -4 * s / relaxation;
  const double dt = 0.2 * relaxation, d = slip_d(rock.eta, rock.mu, dt), before = 0.2 * s;
  const auto [n, m] = plane(30);
  const double until = relaxation * std::log(1 + before / (-rate * relaxation));
  ASSERT_LT(until, dt);
  double tau = s + before;
  Stress<2, double> stress;
  for (int i = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j) stress(i, j) = -2e5 * n[i] * n[j] + tau * (n[i] * m[j] + m[i] * n[j]);
  std::array<double, 8> memory{};
  const SlipStrength<double> law{rock.friction, rock.cohesion};
  begin<Exponential, 2, double>(law, n, d, stress, memory);
  for (int i = 0; i < 2; ++i)
    for (int j = i; j < 2; ++j) stress(i, j) += rate * dt * (n[i] * m[j] + m[i] * n[j]);
  correct<Exponential, 2, double>(law, n, d, stress, memory);
  tau = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) tau += m[i] * stress(i, j) * n[j];
  // The half of the slip that was taken first may have been too much: never more than that.
  const double exact = s + rate * (dt - until), taken = before * (1 - std::exp(-dt / relaxation / 2));
  EXPECT_LE(tau, exact + 1e-9 * s);
  EXPECT_GT(tau, exact - taken);
}

// Proves (S6).
TEST(SecondOrderSlip, KeepsItsOrderWherePlanesOpenAndClose) {
  const auto found = errors<SecondOrder>(gaping, 30, 400, 4);
  EXPECT_NEAR(order(found), 2, 0.2);
  EXPECT_LT(found.back(), 2e-6);
}

// Proves (S6).
TEST(SecondOrderSlip, IsTheTrapezoidalRuleOfThePaperWhereItsStepResolvesTheRelaxation) {
  // The scalar formula with |Sigma| stored: Sigma = tau_e - B, B = (|Sigma| - S)_+/(1 + 2 d S),
  // |tau| = S (1 + 2 d |Sigma|)/(1 + 2 d S).
  const Rock rock;
  const int steps = 3000;
  const double end = 0.4, d = slip_d(rock.eta, rock.mu, end / steps);
  double tau = 0, b = 0;
  for (int n = 0; n < steps; ++n) {
    const double t = n * end / steps, after = t + end / steps;
    const double sigma = tau + pulling.shear(after) - pulling.shear(t) - b;
    const double s = rock.strength(pulling.normal(after));
    ASSERT_GT(4 * d * s, 1);
    tau = std::abs(sigma) > s ? std::copysign(s * (1 + 2 * d * std::abs(sigma)) / (1 + 2 * d * s), sigma)
                              : sigma;
    b = std::copysign(std::max(std::abs(sigma) - s, 0.) / (1 + 2 * d * s), sigma);
  }
  const auto [n, m] = plane(30);
  EXPECT_NEAR((corrected<SecondOrder, 2>(rock, pulling, end, steps, n, m)), tau, 1e-9 * std::abs(tau));
}

// Proves (S3).
TEST(Slip, FollowsTheClosedFormUnderAConstantLoadingRate) {
  // |tau| - S = R t_r (1 - exp(-(t - t0)/t_r)), t_r = eta S/mu, from the instant t0 at which tau reaches S.
  const Rock rock;
  const double s = rock.strength(-2e5), rate = 1e6, relaxation = rock.eta * s / rock.mu;
  const Loading ramp{[&](double t) { return rate * t; }, [](double) { return -2e5; }};
  const double start = s / rate, end = start + 1.7 * relaxation;
  const double exact = s + rate * relaxation * (1 - std::exp(-(end - start) / relaxation));
  const auto [n, m] = plane(-20);
  EXPECT_NEAR((corrected<FirstOrder, 2>(rock, ramp, end, 4000, n, m)), exact, 2e-4 * exact);
  EXPECT_NEAR((corrected<SecondOrder, 2>(rock, ramp, end, 4000, n, m)), exact, 2e-7 * exact);
}

// Proves (S3).
TEST(Slip, IsTheSameIn3D) {
  const Rock rock;
  const auto [n2, m2] = plane(0);
  const double c = std::sqrt(1 / 3.), a = std::sqrt(1 / 6.);
  const Traction<3, double> n{c, c, c}, m{a, a, -2 * a};
  const double plane_2d = corrected<SecondOrder, 2>(rock, shaking, 0.4, 2000, n2, m2);
  EXPECT_NEAR((corrected<SecondOrder, 3>(rock, shaking, 0.4, 2000, n, m)), plane_2d,
              1e-9 * std::abs(plane_2d));
  const double first_2d = corrected<FirstOrder, 2>(rock, shaking, 0.4, 2000, n2, m2);
  EXPECT_NEAR((corrected<FirstOrder, 3>(rock, shaking, 0.4, 2000, n, m)), first_2d,
              1e-9 * std::abs(first_2d));
}

}  // namespace
}  // namespace slipwave::fracture_slip_order_test
