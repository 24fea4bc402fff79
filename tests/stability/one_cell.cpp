// SPDX-License-Identifier: BSD-3-Clause
#include "one_cell.hpp"

#include <cmath>
#include <numbers>

#include "fracture/slip_law.hpp"

namespace slipwave {
namespace {

double load(double step) { return 3 * std::sin(2 * std::numbers::pi * step / 100); }

/// Strength 1, so that `relaxation` is c/S.
double towards_zero(double tau, double by) { return tau - std::copysign(by, tau); }

double first(double tau, double grown, double relaxation) {
  double over;
  return std::copysign(slip::relaxed(std::abs(tau + grown), 1., relaxation, over), tau + grown);
}

double trapezoidal(double tau, double grown, double relaxation) {
  double over;
  const double loaded = towards_zero(tau, relaxation / 2 * std::max(std::abs(tau) - 1, 0.)) + grown;
  return std::copysign(slip::relaxed(std::abs(loaded), 1., relaxation / 2, over), loaded);
}

double second(double tau, double grown, double relaxation) {
  double over;
  const double loaded = towards_zero(tau, slip::explicit_half(std::abs(tau), 1., relaxation, 1)) + grown;
  return std::copysign(slip::relaxed(std::abs(loaded), 1., slip::relaxation_of_end(relaxation, 1., 1), over),
                       loaded);
}

double exponential(double tau, double grown, double relaxation) {
  const double from = towards_zero(tau, slip::unloaded_loss(std::abs(tau), 1., relaxation / 2)),
               loaded = from + grown;
  if (!(std::abs(loaded) > 1)) return loaded;
  const double way = loaded < 0 ? -1 : 1, start = way * tau, begun = way * from;
  const double before = (start > 1 ? start : begun) - 1;
  const double excess = slip::excess_after(before, std::abs(loaded) - begun, 1., relaxation);
  return way * std::max(std::min(1 + excess, std::abs(loaded)), 0.);
}

template <class Rule>
History history(const char* name, int steps, int parts, double relaxation, const Rule& rule) {
  History all{name, {}};
  double tau = 0;
  for (int n = 0; n < steps; ++n) {
    for (int part = 0; part < parts; ++part) {
      const double begin = n + double(part) / parts, end = n + double(part + 1) / parts;
      tau = rule(tau, load(end) - load(begin), relaxation / parts);
    }
    all.rate.push_back(std::copysign(relaxation * std::max(std::abs(tau) - 1, 0.), tau));
  }
  return all;
}

}  // namespace

std::vector<History> histories(double relaxation, int steps) {
  const double relaxation_pa = 1 / relaxation;
  return {history("the law", steps, 1000, relaxation_pa, first),
          history("first order", steps, 1, relaxation_pa, first),
          history("trapezoidal", steps, 1, relaxation_pa, trapezoidal),
          history("second order", steps, 1, relaxation_pa, second),
          history("exponential", steps, 1, relaxation_pa, exponential)};
}

}  // namespace slipwave
