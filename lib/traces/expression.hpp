// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "traces/header_key.hpp"

namespace slipwave {

/// A condition on traces, or a number that follows from their headers, in the language
///
///   condition   a and b, a or b, not a, (a); `not` binds closest, then `and`
///   comparison  x = y, x != y (or ==, <>), x < y, x <= y, x > y, x >= y, also in chains: 100 <= offset < 500
///   list        x = y,z and x != y,z: any of them, none of them
///   range       in place of y: LOW:HIGH, ends included, LOW:, :HIGH, or LOW:HIGH:STEP
///   number      12.5, 1e3, a name of HeaderKey, a + b, a - b, a * b, a / b, a % b, -a, abs(a), (a)
///   component   vx, vz, p, ...: only with = and !=
///
/// Two numbers that differ by less than 1e-12 of the larger one are equal.
class Expression {
 public:
  enum class Kind { truth, number, component };

  /// The whole text; a usage Error says what is wrong at which character.
  explicit Expression(const std::string& text);

  Kind kind() const { return kind_; }
  /// 1 or 0 for conditions.
  double value(const TraceView& view) const;

 private:
  friend class ExpressionParser;
  /// One instruction of a machine with a stack: takes its operands from it and leaves its result there.
  struct Step {
    enum class Code {
      number,  // pushes `number`
      key,     // pushes the value of keys_[number]
      negate,
      abs,
      add,
      subtract,
      multiply,
      divide,
      remainder,
      equal,
      less,
      not_greater,
      in_steps,  // v low step: is v a whole number of steps above low
      both,
      either,
      opposite
    };
    Code code = Code::number;
    double number = 0;
  };

  /// Returns the result of a step that takes two numbers, the one below and the one on top of the stack.
  static double result_of(Step::Code code, double a, double b);

  std::vector<Step> steps_;
  std::vector<HeaderKey> keys_;
  Kind kind_ = Kind::truth;
};

}  // namespace slipwave
