#pragma once

#include <algorithm>

#include "solver/state.hpp"

namespace slipwave::solver {

/// What a piece of a sweep along x leaves for the next one of the line: what leaves its last cell upwards and
/// the faces of the cells that wait for it.
template <class Real>
struct Carry {
  static constexpr std::int64_t faces = 16;
  static constexpr int most_pairs = 3;
  Real up[most_pairs];
  Real v[most_pairs][faces], s[most_pairs][faces];
};

/// What a sweep across the rows keeps between them: what leaves the newest row upwards (and the one before),
/// and the faces of the rows that are still to be brought forward. Columns from `first` on, of `pairs` pairs
/// (2, in 3-D 3).
template <class Real>
class Ring {
 public:
  Ring(std::int64_t first, std::int64_t width, int face_rows, int pairs = 2)
      : first_(first),
        pitch_(width + 2 * gap),
        face_rows_(face_rows),
        pairs_(pairs),
        values_(pitch_ * rows(face_rows, pairs)) {
    std::fill(values_.data(), values_.data() + values_.size(), Real(0));
  }
  /// From column x on. What leaves downwards is met at once: there is one row of it.
  Leaving<Real> leaving(std::int64_t row, std::int64_t x) {
    const int turn = int(row & 1);
    if (pairs_ == 2) return {at(turn, x), at(2, x), at(3 + turn, x), at(5, x)};
    return {at(turn, x), at(2, x), at(3 + turn, x), at(5, x), at(6 + turn, x), at(8, x)};
  }
  Faces<Real> faces(std::int64_t row, std::int64_t x) {
    const int first = 3 * pairs_ + 2 * pairs_ * int(row % face_rows_);
    if (pairs_ == 2) return {at(first, x), at(first + 1, x), at(first + 2, x), at(first + 3, x)};
    return {at(first, x),     at(first + 1, x), at(first + 2, x),
            at(first + 3, x), at(first + 4, x), at(first + 5, x)};
  }
  std::int64_t memory_bytes() const { return values_.size() * std::int64_t(sizeof(Real)); }

 private:
  static constexpr std::int64_t gap = 16;
  static int rows(int face_rows, int pairs) { return (3 + 2 * face_rows) * pairs; }
  Real* at(int row, std::int64_t x) { return values_.data() + row * pitch_ + gap + x - first_; }
  std::int64_t first_, pitch_;
  int face_rows_, pairs_;
  Buffer<Real> values_;
};

/// Rows of memory that are asked for before they are needed, half a row after each loop over a piece: stripes
/// are too short for the processor to guess what comes next, and more at once would wait for each other.
template <class Real>
class Coming {
 public:
  void clear() { left_ = 0; }
  /// `count` rows of `width` values, `pitch` apart.
  void add(const Real* first, std::int64_t width, std::int64_t pitch, int count) {
    half_ = (width + 1) / 2;
    for (int row = 0; row < count; ++row)
      for (const std::int64_t from : {std::int64_t(0), half_}) halves_[left_++] = first + row * pitch + from;
  }
  void ask_for_one() {
    if (left_ == 0) return;
    const Real* const half = halves_[--left_];
    for (std::int64_t x = 0; x < half_; x += 64 / std::int64_t(sizeof(Real))) __builtin_prefetch(half + x);
  }

 private:
  static constexpr int most = 16;  // of eight rows, fields and material
  const Real* halves_[most] = {};
  int left_ = 0;
  std::int64_t half_ = 0;
};

/// Scratch memory of one thread for pieces of at most `widest` columns of `pairs` pairs.
template <class Real>
class Workspace {
 public:
  Workspace(std::int64_t widest, int field_rows, int pairs)
      : pitch_(widest + 6 * gap), pairs_(pairs), values_(pitch_ * (4 * pairs + most_changed + field_rows)) {
    std::fill(values_.data(), values_.data() + values_.size(), Real(0));
  }
  Leaving<Real> leaving() {
    if (pairs_ == 2) return {row(0), row(1), row(2), row(3)};
    return {row(0), row(1), row(2), row(3), row(8), row(9)};
  }
  Faces<Real> faces() {
    if (pairs_ == 2) return {row(4), row(5), row(6), row(7)};
    return {row(4), row(5), row(6), row(7), row(10), row(11)};
  }
  /// Fields as they were, while the matched layer needs them.
  Real* before(int n) { return row(4 * pairs_ + n); }
  /// A copy of all fields of a piece.
  Real* copy() { return row(4 * pairs_ + most_changed); }
  Coming<Real>& coming() { return coming_; }
  /// From a row of the copy to the next; room for 32 cells before and behind the piece.
  std::int64_t pitch() const { return pitch_; }

 private:
  static constexpr std::int64_t gap = 16;
  static constexpr int most_changed = 8;  // fields that a sweep changes
  Real* row(int n) { return values_.data() + n * pitch_ + 2 * gap; }
  std::int64_t pitch_;
  int pairs_;
  Buffer<Real> values_;
  Coming<Real> coming_;
};

}  // namespace slipwave::solver
