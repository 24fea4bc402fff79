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
    switch (step.code) {
      case Code::add:
        stack.push_back(a + b);
        break;
      case Code::subtract:
        stack.push_back(a - b);
        break;
      case Code::multiply:
        stack.push_back(a * b);
        break;
      case Code::divide:
        stack.push_back(a / b);
        break;
      case Code::remainder:
        stack.push_back(a - b * std::floor(a / b));
        break;
      case Code::equal:
        stack.push_back(same(a, b));
        break;
      case Code::less:
        stack.push_back(a < b && !same(a, b));
        break;
      case Code::not_greater:
        stack.push_back(a < b || same(a, b));
        break;
      case Code::in_steps: {
        const double steps = (pop() - a) / b;
        stack.push_back(std::fabs(steps - std::nearbyint(steps)) <= 1e-6);
        break;
      }
      case Code::both:
        stack.push_back(a != 0 && b != 0);
        break;
      default:
        stack.push_back(a != 0 || b != 0);
        break;
    }
  }
  return stack.back();
}

}  // namespace slipwave
