// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "gather/trace.hpp"
#include "solver/record/record.hpp"
#include "solver/sweep/domain.hpp"

namespace slipwave::solver {

/// Copies all fields at the end of one step at a time: the first after each multiple of an
/// interval.
template <int D, class Real>
class SnapshotRecorder : public Record<D, Real> {
 public:
  /// No snapshot is due where `every_s` is empty. Fields are `unit` times SI. Keeps references.
  SnapshotRecorder(const Layout<D>& layout, const Domain<D>& domain, std::optional<double> every_s,
                   double duration_s, double unit)
      : layout_(layout), domain_(domain), every_s_(every_s), duration_s_(duration_s), unit_(unit) {}

  /// Allocates memory for the next snapshot that is due at the end of a step first <= n < last; false where
  /// none is.
  bool prepare(std::int64_t first, std::int64_t last, double dt_s);
  /// The step of the snapshot.
  std::int64_t step() const { return step_; }
  /// A component on the model's grid in SI units; `field` of the copied fields.
  Field<D> field(Component component) const;
  void release() { fields_ = {}; }
  /// What it holds where a snapshot is due, and what copies of a field and the libraries of the file take
  /// until it is written.
  std::int64_t memory_bytes() const {
    constexpr std::int64_t copies = 6, libraries = std::int64_t(4) << 20;
    return every_s_ ? libraries + layout_.total() * std::int64_t(sizeof(Real)) +
                          copies * domain_.model_grid.size() * std::int64_t(sizeof(float))
                    : 0;
  }

  bool reads(const StepTime& time, std::int64_t) const override { return time.step == step_; }
  Box box() const override { return {{0, layout_.shape()[D - 1]}, {0, layout_.shape()[D - 2]}}; }
  void read(const StepTime& time, const RowFields<const Real>& fields, const IndexRange& cells) override;

 private:
  bool due(const StepTime& time) const;
  const Layout<D>& layout_;
  const Domain<D>& domain_;
  std::optional<double> every_s_;
  double duration_s_, unit_;
  std::int64_t step_ = -1;
  Buffer<Real> fields_;  // laid out as the state
};

}  // namespace slipwave::solver
