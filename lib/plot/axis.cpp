// SPDX-License-Identifier: BSD-3-Clause
#include "plot/axis.hpp"

#include <algorithm>
#include <cmath>

#include "plot/canvas.hpp"
#include "plot/ticks.hpp"

namespace slipwave::plot {
namespace {

/// Numbers are divided by 10^exponent, and the unit says so.
struct Division {
  int exponent = 0;
  std::string unit;
};

Division division_of(const Axis& axis) {
  const double largest = std::max({std::fabs(axis.low), std::fabs(axis.high), axis.shared});
  if (axis.log || axis.whole) return {0, axis.unit};
  if (axis.unit == "m" && largest >= 9999) return {3, "km"};
  const int exponent = axis_exponent(largest);
  return {exponent, multiplied_unit(exponent, axis.unit)};
}

/// Are labels `gap_pt` apart from each other, at least?
bool stand_clear(const AxisMarks& marks, const Scale& scale, double text_pt, bool horizontal, double gap_pt) {
  for (std::size_t n = 1; n < marks.values.size(); ++n) {
    const double apart = std::fabs(scale.place(marks.values[n]) - scale.place(marks.values[n - 1]));
    const double taken =
        horizontal ? (text_width(marks.labels[n - 1], text_pt) + text_width(marks.labels[n], text_pt)) / 2
                   : cap_height * text_pt;
    if (apart < taken + gap_pt) return false;
  }
  return true;
}

AxisMarks linear_marks(const Axis& axis, double step, int exponent) {
  const double divisor = std::pow(10.0, exponent);
  auto ticks = linear_ticks(axis.low / divisor, axis.high / divisor, step);
  // Zero may be as near to the low end as makes no difference otherwise.
  if (axis.log)
    for (auto* values : {&ticks.major, &ticks.minor})
      std::erase_if(*values, [](double value) { return !(value > 0); });
  AxisMarks marks;
  marks.labels = linear_labels(ticks.major, step);
  marks.values = std::move(ticks.major);
  marks.minor = std::move(ticks.minor);
  if (axis.whole) std::erase_if(marks.minor, [](double value) { return value != std::round(value); });
  for (auto* values : {&marks.values, &marks.minor}) {
    for (double& value : *values) value *= divisor;
  }
  for (std::size_t n = 0; axis.log && n < marks.values.size(); ++n)
    marks.labels[n] = log_label(marks.values[n]);
  return marks;
}

/// One label, where there is no room for two; the other ticks stay without.
AxisMarks only_the_middle(AxisMarks marks) {
  if (marks.values.size() < 2) return marks;
  const auto middle = std::ptrdiff_t(marks.values.size() / 2);
  const double value = marks.values[std::size_t(middle)];
  const std::string label = marks.labels[std::size_t(middle)];
  marks.values.erase(marks.values.begin() + middle);
  marks.minor = marks.values;
  marks.values = {value};
  marks.labels = {label};
  return marks;
}

/// The finest ticks whose labels are `gap_pt` apart.
AxisMarks finest_linear(const Axis& axis, const Scale& scale, double text_pt, bool horizontal, double gap_pt,
                        int exponent) {
  const double span = (axis.high - axis.low) / std::pow(10.0, exponent);
  double step = round_step(span / 40);
  if (axis.whole) step = std::max(step, 1.0);
  AxisMarks last;
  for (;; step = next_step(step)) {
    auto marks = linear_marks(axis, step, exponent);
    if (marks.values.size() == 1 || stand_clear(marks, scale, text_pt, horizontal, gap_pt)) {
      return marks.values.empty() ? only_the_middle(last) : marks;
    }
    last = std::move(marks);
  }
}

AxisMarks finest_log(const Axis& axis, const Scale& scale, double text_pt, bool horizontal, double gap_pt) {
  for (const int density : {5, 2, 1, -1, -2, -3, -5, -10, -20, -50}) {
    auto ticks = log_ticks(axis.low, axis.high, density);
    AxisMarks marks;
    marks.values = std::move(ticks.major);
    marks.minor = std::move(ticks.minor);
    for (const double value : marks.values) marks.labels.push_back(log_label(value));
    if (marks.values.size() < 2) break;
    if (stand_clear(marks, scale, text_pt, horizontal, gap_pt)) return marks;
  }
  return finest_linear(axis, scale, text_pt, horizontal, gap_pt, 0);
}

}  // namespace

Scale::Scale(const Axis& axis, double begin_pt, double end_pt)
    : log_(axis.log),
      low_(axis.log ? std::log10(axis.low) : axis.low),
      high_(axis.log ? std::log10(axis.high) : axis.high),
      begin_(begin_pt),
      end_(end_pt) {}

double Scale::place(double value) const {
  const double along = log_ ? std::log10(value) : value;
  return begin_ + (along - low_) / (high_ - low_) * (end_ - begin_);
}

double Scale::value(double place_pt) const {
  const double along = low_ + (place_pt - begin_) / (end_ - begin_) * (high_ - low_);
  return log_ ? std::pow(10.0, along) : along;
}

AxisMarks marks_of(const Axis& axis, double length_pt, double text_pt, bool horizontal) {
  const Scale scale(axis, 0, length_pt);
  const auto division = division_of(axis);
  AxisMarks marks;
  // Comfortably far apart, and not many; closer where that would leave too few to read the axis by.
  for (const double gap_pt : {std::max(2.2 * text_pt, length_pt / 10), 1.2 * text_pt, 0.6 * text_pt}) {
    marks = axis.log ? finest_log(axis, scale, text_pt, horizontal, gap_pt)
                     : finest_linear(axis, scale, text_pt, horizontal, gap_pt, division.exponent);
    if (marks.values.size() >= 3) break;
  }
  marks.caption = axis.name;
  if (!division.unit.empty()) marks.caption += " (" + division.unit + ")";
  for (const auto& label : marks.labels)
    marks.widest_pt = std::max(marks.widest_pt, text_width(label, text_pt));
  return marks;
}

void widen(Axis& axis, double part) {
  if (axis.log) {
    const auto round_up = [](double value) { return round_step(value * (1 - 1e-9)); };
    if (axis.low == axis.high) axis.low /= 2, axis.high *= 2;
    axis.low = 1 / round_up(1 / axis.low);  // 1, 2, 5 turned over are 1, 0.5, 0.2
    axis.high = round_up(axis.high);
    return;
  }
  if (axis.low == axis.high) {
    const double reach = axis.low == 0 ? 1 : std::fabs(axis.low) / 2;
    axis.low -= reach;
    axis.high += reach;
  }
  const double more = part * (axis.high - axis.low);
  axis.low -= more;
  axis.high += more;
}

}  // namespace slipwave::plot
