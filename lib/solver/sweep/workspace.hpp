// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/sweep/state.hpp"

namespace slipwave::solver {

/// The values that a piece of a sweep along x stores for the next piece of the row: the interface states of
/// the cells that are still to be updated, the outgoing wave upwards of the last of them and, where uniform
/// runs leave out faces, the outgoing waves of each of them and, upwards, of the cell before them.
template <class Real>
struct StripeBoundary {
  static constexpr std::int64_t cells = 16;
  static constexpr int most_pairs = 3;
  Real last_up[most_pairs][1], up[most_pairs][cells], down[most_pairs][cells];
  Real v[most_pairs][cells], s[most_pairs][cells];
};

/// The ring buffer of a sweep across the rows: interface states of the rows that are still to be updated, and
/// outgoing waves of the newest rows, at least two. Columns from `first` on, of `pairs` pairs (2, in 3-D 3).
template <class Real>
class Ring {
 public:
  Ring(std::int64_t first, std::int64_t width, int outgoing_rows, int face_rows, int pairs)
      : first_(first),
        pitch_(width + 2 * gap),
        outgoing_rows_(outgoing_rows),
        face_rows_(face_rows),
        pairs_(pairs),
        values_(pitch_ * 2 * pairs * (outgoing_rows + face_rows)),
        last_(std::size_t(width / gap + 1), before_all) {
    std::fill(values_.data(), values_.data() + values_.size(), Real(0));
  }
  /// From column x on, of row -1 or a later one.
  OutgoingWaves<Real> outgoing(std::int64_t row, std::int64_t x) {
    const int first = 2 * pairs_ * int((row + 1) % outgoing_rows_);
    return {at(first, x), pitch_};
  }
  InterfaceStates<Real> faces(std::int64_t row, std::int64_t x) {
    const int first = 2 * pairs_ * (outgoing_rows_ + int(row % face_rows_));
    return {at(first, x), pitch_};
  }
  int pairs() const { return pairs_; }
  std::int64_t memory_bytes() const { return values_.size() * std::int64_t(sizeof(Real)); }

  /// A sweep begins: what the ring holds is of another one.
  void begin() { std::fill(last_.begin(), last_.end(), before_all); }
  /// A row is about to be put into these columns, whole blocks. Rows before it that were passed over are
  /// zeros: calls zero(row, columns) for those that the ring should hold.
  template <class Zero>
  void take(std::int64_t row, const IndexRange& columns, Zero&& zero) {
    const std::int64_t held = std::max(outgoing_rows_, face_rows_);
    for (auto x = columns.first; x < columns.last; x += gap) {
      auto& last = last_[std::size_t((x - first_) / gap)];
      for (auto passed = std::max(last + 1, row - held); passed < row; ++passed)
        zero(passed, IndexRange{x, std::min(x + gap, columns.last)});
      last = row;
    }
  }

 private:
  static constexpr std::int64_t gap = 16;
  Real* at(int row, std::int64_t x) { return values_.data() + row * pitch_ + gap + x - first_; }
  std::int64_t first_, pitch_;
  int outgoing_rows_, face_rows_, pairs_;
  Buffer<Real> values_;
  static constexpr std::int64_t before_all = -(std::int64_t{1} << 32);
  std::vector<std::int64_t> last_;  // row that was put into a block of columns
};

/// Rows of memory to prefetch, half a row after each loop over a piece: stripes are too short for the
/// processor's own prefetcher, and more requests at once would wait for each other.
template <class Real>
class PrefetchQueue {
 public:
  void clear() { left_ = 0; }
  /// `count` rows of `width` values, `pitch` apart.
  void add(const Real* first, std::int64_t width, std::int64_t pitch, int count) {
    half_ = (width + 1) / 2;
    for (int row = 0; row < count; ++row)
      for (const std::int64_t from : {std::int64_t(0), half_})
        if (left_ < most) halves_[left_++] = first + row * pitch + from;
  }
  void prefetch(int halves) {
    for (int n = 0; n < halves; ++n) prefetch_one();
  }
  void prefetch_one() {
    if (left_ == 0) return;
    const Real* const half = halves_[--left_];
    for (std::int64_t x = 0; x < half_; x += 64 / std::int64_t(sizeof(Real))) __builtin_prefetch(half + x);
  }

 private:
  static constexpr int most = 64;  // of 14 rows, fields and material, and of those of the metric
  const Real* halves_[most] = {};
  int left_ = 0;
  std::int64_t half_ = 0;
};

/// Which sweep of which time step: number `sweep` of its list (TimeStep). The first sweep of a step that is
/// merged with the last of the step before counts as that one.
struct SweepTime {
  std::int64_t step = 0;
  std::size_t sweep = 0;
};

/// Scratch memory of one thread for pieces of at most `widest` columns of `pairs` pairs.
template <class Real>
class Workspace {
 public:
  Workspace(std::int64_t widest, int field_rows, int pairs)
      : pitch_(widest + 6 * gap), pairs_(pairs), values_(pitch_ * (4 * pairs + most_changed + field_rows)) {
    std::fill(values_.data(), values_.data() + values_.size(), Real(0));
  }
  OutgoingWaves<Real> outgoing() { return {row(0), pitch_}; }
  InterfaceStates<Real> faces() { return {row(2 * pairs_), pitch_}; }
  /// Fields before the update, while filters need them: the first of those that a sweep changes.
  Real* before() { return row(4 * pairs_); }
  /// A copy of all fields of a piece.
  Real* copy() { return row(4 * pairs_ + most_changed); }
  PrefetchQueue<Real>& prefetch() { return prefetch_; }
  /// Returns the time of the sweep, for filters that depend on it.
  SweepTime& time() { return time_; }
  /// From a field to the next; room for 32 cells before and behind the piece.
  std::int64_t pitch() const { return pitch_; }

 private:
  static constexpr std::int64_t gap = 16;
  static constexpr int most_changed = 9;  // fields that a sweep changes
  Real* row(int n) { return values_.data() + n * pitch_ + 2 * gap; }
  std::int64_t pitch_;
  int pairs_;
  Buffer<Real> values_;
  PrefetchQueue<Real> prefetch_;
  SweepTime time_;
};

}  // namespace slipwave::solver
