// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/look.hpp"
#include "plot/magnitudes.hpp"
#include "plot/picture.hpp"
#include "plot/section.hpp"
#include "plot/survey_marks.hpp"

namespace slipwave::plot {

/// A wave field at one time.
struct Snapshot {
  std::string name, unit;  // "vz", "m/s"
  double time_s = 0;
  Field<2> values;
  std::array<const char*, 2> axes = {"x", "depth"};  // across and down
  Limits extent = {0, 0};                            // of all values on this scale, for the colour bar
};

/// "m/s" for "m s-1": units of files as pictures show them.
std::string shown_unit(const std::string& file_unit);

/// The field in colours that are full at `full`, or over a model: its property in grey, its fractures
/// outlined, and the wave the less transparent the stronger. The time stands in the title. A pixel shows the
/// one of its cells that is farthest from zero. Both axes have one scale unless the page has a given size.
Picture draw_snapshot(const Snapshot& snapshot, double full, const std::optional<ModelSection>& model,
                      const SurveyMarks& marks, const Look& look, Page page);

/// A volume on three planes at one time; `models`: nothing, or what lies below each. `full` as above.
struct SnapshotVolume {
  std::vector<Snapshot> snapshots;
  std::vector<Slice> planes;
};
Picture draw_snapshot_volume(const SnapshotVolume& volume, double full,
                             const std::vector<ModelSection>& models, const std::vector<SurveyMarks>& marks,
                             const Look& look, Page page);

}  // namespace slipwave::plot
