// SPDX-License-Identifier: BSD-3-Clause
#include "traces/expression_tokens.hpp"

#include <array>
#include <cctype>
#include <string_view>

#include "base/error.hpp"

namespace slipwave {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

constexpr std::array<std::string_view, 5> double_signs = {"==", "!=", "<>", "<=", ">="};

}  // namespace

bool ExpressionTokens::at_number() const { return !at_end() && (is_digit(token_[0]) || token_[0] == '.'); }

bool ExpressionTokens::at_name() const { return !at_end() && in_name(token_[0]) && !is_digit(token_[0]); }

std::size_t ExpressionTokens::end_of_token(std::size_t at) const {
  if (at == text_.size()) return at;
  std::size_t end = at;
  const auto exponent_sign = [&] {  // the one in 1e-3
    return (text_[end] == '-' || text_[end] == '+') && (text_[end - 1] == 'e' || text_[end - 1] == 'E');
  };
  if (is_digit(text_[at]) || text_[at] == '.') {
    while (end < text_.size() && (in_name(text_[end]) || text_[end] == '.' || (end > at && exponent_sign())))
      ++end;
    return end;
  }
  while (end < text_.size() && in_name(text_[end])) ++end;
  if (end > at) return end;
  for (const std::string_view sign : double_signs)
    if (text_.compare(at, 2, sign) == 0) return at + 2;
  return at + 1;
}

void ExpressionTokens::advance() {
  at_ = end_;
  while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  end_ = end_of_token(at_);
  token_ = text_.substr(at_, end_ - at_);
}

bool ExpressionTokens::take(const char* token) {
  if (token_ != token) return false;
  advance();
  return true;
}

void ExpressionTokens::refuse_at(std::size_t at, const std::string& what) const {
  const std::string shown = text_.substr(at, end_of_token(at) - at);
  throw Error(
      "character " + std::to_string(at + 1) + (shown.empty() ? ", the end: " : ", '" + shown + "': ") + what,
      ErrorKind::usage);
}

}  // namespace slipwave
