// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace slipwave {

/// The words, numbers and signs of an expression, one after the other. Every refusal is a usage Error that
/// says at which character of the text, counted from 1, and in front of what.
class ExpressionTokens {
 public:
  /// `text` must outlive this.
  explicit ExpressionTokens(const std::string& text) : text_(text) { advance(); }

  /// "" at the end.
  const std::string& token() const { return token_; }
  bool at_end() const { return token_.empty(); }
  bool at_number() const;
  bool at_name() const;
  /// Returns the character at which the token begins, from 0.
  std::size_t at() const { return at_; }

  void advance();
  /// Passes over `token` if it comes next.
  bool take(const char* token);

  /// "character 8, 'ofset': unknown name ..."
  [[noreturn]] void refuse(const std::string& what) const { refuse_at(at_, what); }
  /// Likewise for what begins elsewhere.
  [[noreturn]] void refuse_at(std::size_t at, const std::string& what) const;

 private:
  std::size_t end_of_token(std::size_t at) const;

  const std::string& text_;
  std::string token_;
  std::size_t at_ = 0, end_ = 0;
};

}  // namespace slipwave
