// SPDX-License-Identifier: BSD-3-Clause
#include "plot/error_series.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace slipwave::plot {

std::vector<ErrorSeries> series_of(const AccuracyTable& table) {
  std::vector<ErrorSeries> all;
  for (std::size_t n = 0; n < table.rows.size(); ++n) {
    const auto& row = table.rows[n];
    if (!(row.seconds > 0 && row.error > 0)) continue;
    const double courant = row.courant > 0 ? row.courant : 0;  // else not known
    const Method method{row.order, row.time_order, row.slip_order, courant, row.monotone};
    auto series = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.method == method; });
    if (series == all.end()) series = all.insert(all.end(), {method, {}});
    series->points.push_back({row.spacing_m, row.seconds, 100 * row.error, table.chosen == n});
  }
  for (auto& series : all) {
    std::stable_sort(series.points.begin(), series.points.end(),
                     [](const auto& a, const auto& b) { return a.spacing_m > b.spacing_m; });
  }
  return all;
}

std::string name_of(const Method& method, const std::vector<Method>& methods) {
  const auto differ = [&](auto member) {
    return std::any_of(methods.begin(), methods.end(),
                       [&](const Method& other) { return other.*member != method.*member; });
  };
  std::string name = "order " + std::to_string(method.order);
  if (differ(&Method::time_order)) name += ", " + std::to_string(method.time_order) + " in time";
  if (differ(&Method::slip_order))
    name += method.slip_order == 0   ? ", no slip"
            : method.slip_order == 3 ? ", exponential slip"
                                     : ", slip order " + std::to_string(method.slip_order);
  if (method.monotone) name += ", monotone";
  if (method.courant > 0 && differ(&Method::courant)) name += ", Courant " + shown(method.courant);
  return name;
}

}  // namespace slipwave::plot
