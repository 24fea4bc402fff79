// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace slipwave::plot {

/// A quantity along an edge of a panel, from `low` at its left or upper end to `high` at the other one, for
/// an axis that points up from `low` at its lower end.
struct Axis {
  std::string name;  // "depth"
  std::string unit;  // "m"; "" for none
  double low = 0, high = 1;
  bool log = false;     // 0 < low < high
  bool whole = false;   // counts something: no ticks between whole numbers
  bool upwards = true;  // of a vertical axis: `low` is at the bottom
  double shared = 0;    // the largest number of an axis that takes the same unit
};

/// From values to places along an edge.
class Scale {
 public:
  Scale() = default;
  Scale(const Axis& axis, double begin_pt, double end_pt);
  double place(double value) const;
  double value(double place_pt) const;

 private:
  bool log_ = false;
  double low_ = 0, high_ = 1, begin_ = 0, end_ = 1;
};

/// What stands at an axis: round numbers at their values, and the words beside them.
struct AxisMarks {
  std::vector<double> values;  // of the labels
  std::vector<std::string> labels;
  std::vector<double> minor;
  std::string caption;  // "depth (km)", "vz (10⁻⁹ m/s)"
  double widest_pt = 0;
};

/// Marks of an axis of that length, as many as stand clear of each other in text of `text_pt`: along the axis
/// their widths count (horizontal) or their heights.
AxisMarks marks_of(const Axis& axis, double length_pt, double text_pt, bool horizontal);

/// The range widened to round numbers where `axis.log`: down and up to the next 1, 2 or 5 times a power of
/// ten; else by `part` of itself to both sides. A range without length becomes one.
void widen(Axis& axis, double part);

}  // namespace slipwave::plot
