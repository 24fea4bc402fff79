// SPDX-License-Identifier: BSD-3-Clause
#include "traces/expression.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave {
namespace {

bool same(double a, double b) {
  // infinite numbers are equal to themselves alone
  if (a == b || std::isinf(a) || std::isinf(b)) return a == b;
  return std::fabs(a - b) <= 1e-12 * std::max(std::fabs(a), std::fabs(b));
}

}  // namespace

double Expression::result_of(Step::Code code, double a, double b) {
  using Code = Step::Code;
  switch (code) {
    case Code::add:
      return a + b;
    case Code::subtract:
      return a - b;
    case Code::multiply:
      return a * b;
    case Code::divide:
      return a / b;
    case Code::remainder:
      return a - b * std::floor(a / b);
    case Code::equal:
      return same(a, b);
    case Code::less:
      return a < b && !same(a, b);
    case Code::not_greater:
      return a < b || same(a, b);
    case Code::both:
      return a != 0 && b != 0;
    default:
      return a != 0 || b != 0;
  }
}

double Expression::value(const TraceView& view) const {
  std::vector<double> stack;
  stack.reserve(steps_.size());
  const auto pop = [&] {
    const double top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Step& step : steps_) {
    using Code = Step::Code;
    if (step.code == Code::number) {
      stack.push_back(step.number);
      continue;
    }
    if (step.code == Code::key) {
      stack.push_back(keys_[static_cast<std::size_t>(step.number)].value(view));
      continue;
    }
    const double b = pop();
    if (step.code == Code::negate || step.code == Code::abs || step.code == Code::opposite) {
      stack.push_back(step.code == Code::negate ? -b
                      : step.code == Code::abs  ? std::fabs(b)
                      : b == 0                  ? 1
                                                : 0);
      continue;
    }
    const double a = pop();
    if (step.code == Code::in_steps) {
      const double steps = (pop() - a) / b;
      stack.push_back(std::fabs(steps - std::nearbyint(steps)) <= 1e-6);
      continue;
    }
    stack.push_back(result_of(step.code, a, b));
  }
  return stack.back();
}

}  // namespace slipwave
