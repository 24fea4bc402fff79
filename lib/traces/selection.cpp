// SPDX-License-Identifier: BSD-3-Clause
#include "traces/selection.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace slipwave {

SelectionCounts count_selected(segy::Reader& reader, const Expression& condition) {
  SelectionCounts counts;
  segy::RawTrace trace;
  std::int64_t shot = 0, of_shot = 0;
  while (reader.next(trace)) {
    const TraceView view = view_of(reader, trace);
    const bool holds = in_place(reader.name() + ": trace " + std::to_string(reader.delivered()),
                                [&] { return condition.value(view) != 0; });
    if (!holds) continue;
    of_shot = counts.traces > 0 && view.header.shot == shot ? of_shot + 1 : 1;
    shot = view.header.shot;
    ++counts.traces;
    counts.per_shot = std::max(counts.per_shot, of_shot);
  }
  return counts;
}

}  // namespace slipwave
