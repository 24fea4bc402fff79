// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "closed_forms.hpp"
#include "planning/wanted_error.hpp"

// Errors as they are measured against those found by closed forms.
namespace slipwave::solver::measured_error_test {
namespace {

/// How many promises are too small, how many too large, and how many are as they should be.
class Score {
 public:
  void add(const std::string& name, double promised, double found) {
    ++scenes_;
    const double ratio = promised / found;
    within_ += ratio >= 0.9 && ratio <= 3;
    EXPECT_GE(ratio, 0.7) << name << ": promised " << 100 * promised << " %, found " << 100 * found << " %";
    if (std::getenv("SLIPWAVE_SHOW"))
      std::printf("%-70s promised %6.3g found %6.3g ratio %.2f\n", name.c_str(), 100 * promised, 100 * found,
                  ratio);
  }
  /// One of less than ten, too.
  void expect_one_in_ten_outside() const {
    testing::Test::RecordProperty("within", within_);
    EXPECT_LE(scenes_ - within_, std::max(scenes_ / 10, 1)) << within_ << " of " << scenes_;
  }

 private:
  int scenes_ = 0, within_ = 0;
};

template <int D>
void add(const ClosedForm<D>& closed, Score& score) {
  const auto scene = closed.scene();
  SceneRuns<D> runs(scene, {{1}, false});
  const auto measured = measured_error(runs, setting_of(scene));
  const auto found = gather_error(runs.run(setting_of(scene)).observed, closed.exact());
  if (std::getenv("SLIPWAVE_SHOW"))
    for (const auto& [component, error] : found.components)
      std::printf("%s %.3g, ", std::string(name_of(component)).c_str(), 100 * error);
  score.add(closed.name, measured.error.whole, found.whole);
}

void add_closed_forms(Score& score, bool quick) {
  for (const auto& closed : closed_forms())
    if (!quick || closed.quick) add(closed, score);
  for (const auto& closed : closed_forms_in_3d())
    if (!quick || closed.quick) add(closed, score);
}

TEST(MeasuredError, IsThatOfClosedForms) {
  Score score;
  add_closed_forms(score, true);
  score.expect_one_in_ten_outside();
}

TEST(MeasuredError, IsThatOfClosedFormsAndOfStacksDrawnAfreshLong) {
  using enum DrawnStack::Kind;
  Score score;
  add_closed_forms(score, false);
  for (const auto kind : {any, shallow, near_floor, on_floor, deep_water})
    for (std::uint64_t n = 0; n < (kind == any ? 8 : 3); ++n) {
      const DrawnStack drawn(first_seed() + n, kind);
      add<2>({drawn.stack().name, true, [&] { return drawn.stack().scene(); },
              [&] { return drawn.stack().exact(); }},
             score);
    }
  score.expect_one_in_ten_outside();
}

}  // namespace
}  // namespace slipwave::solver::measured_error_test
