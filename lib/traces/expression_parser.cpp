// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/nearest.hpp"
#include "base/parse.hpp"
#include "traces/expression.hpp"
#include "traces/expression_tokens.hpp"

namespace slipwave {

/// Recursive descent over the text, a function for each level of binding, loosest first. Each gives the steps
/// that compute its part and the kind of what they leave.
class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, Expression& into) : tokens_(text), into_(into) {}

  void parse() {
    if (tokens_.at_end()) tokens_.refuse("expected a condition or a number");
    Part whole = any_of();
    if (!tokens_.at_end())
      tokens_.refuse(whole.kind == Kind::truth ? "expected and, or, or the end"
                                               : "expected an operator or the end");
    into_.steps_ = std::move(whole.steps);
    into_.kind_ = whole.kind;
  }

 private:
  using Kind = Expression::Kind;
  using Code = Expression::Step::Code;
  using Steps = std::vector<Expression::Step>;

  struct Part {
    Steps steps;
    Kind kind = Kind::number;
    std::size_t at = 0;  // where it begins
  };

  static constexpr int deepest = 200;  // parentheses and signs within each other

  void want(const Part& part, Kind kind, const std::string& expected) const {
    if (part.kind == kind) return;
    const char* found = part.kind == Kind::truth    ? "is a condition"
                        : part.kind == Kind::number ? "is a number"
                                                    : "is a component";
    tokens_.refuse_at(part.at, found + (", expected " + expected));
  }

  static Part joined(Part a, const Part& b, Code code, Kind kind) {
    a.steps.insert(a.steps.end(), b.steps.begin(), b.steps.end());
    a.steps.push_back({code, 0});
    a.kind = kind;
    return a;
  }
  static void append(Part& part, Code code) { part.steps.push_back({code, 0}); }

  Part any_of() {
    Part part = all_of();
    while (tokens_.token() == "or") {
      want(part, Kind::truth, "a condition before or");
      tokens_.advance();
      const Part next = all_of();
      want(next, Kind::truth, "a condition after or");
      part = joined(std::move(part), next, Code::either, Kind::truth);
    }
    return part;
  }

  Part all_of() {
    Part part = not_any();
    while (tokens_.token() == "and") {
      want(part, Kind::truth, "a condition before and");
      tokens_.advance();
      const Part next = not_any();
      want(next, Kind::truth, "a condition after and");
      part = joined(std::move(part), next, Code::both, Kind::truth);
    }
    return part;
  }

  Part not_any() {
    if (tokens_.token() != "not") return comparison();
    const Nesting nesting(*this);
    const std::size_t at = tokens_.at();
    tokens_.advance();
    Part part = not_any();
    want(part, Kind::truth, "a condition after not");
    append(part, Code::opposite);
    part.at = at;
    return part;
  }

  bool at_comparison() const {
    for (const char* sign : {"=", "==", "!=", "<>", "<", "<=", ">", ">="})
      if (tokens_.token() == sign) return true;
    return false;
  }

  Part comparison() {
    Part left = sum();
    if (!at_comparison()) return left;
    std::optional<Part> whole;
    while (at_comparison()) {
      const std::string sign = tokens_.token();
      if (left.kind == Kind::truth) want(left, Kind::number, "a number to compare");
      tokens_.advance();
      Part right;
      Part one;
      if (sign == "=" || sign == "==" || sign == "!=" || sign == "<>") {
        one = one_of(left, right);
        if (sign == "!=" || sign == "<>") append(one, Code::opposite);
      } else {
        want(left, Kind::number, "a number to compare by size");
        right = sum();
        want(right, Kind::number, "a number to compare by size");
        const bool swapped = sign[0] == '>';
        one = joined(swapped ? right : left, swapped ? left : right,
                     sign.size() == 1 ? Code::less : Code::not_greater, Kind::truth);
      }
      one.at = left.at;
      whole = whole ? joined(std::move(*whole), one, Code::both, Kind::truth) : one;
      left = std::move(right);
    }
    return *whole;
  }

  /// What follows x =: items between commas. `last` becomes the last plain one, for chains.
  Part one_of(const Part& left, Part& last) {
    std::optional<Part> whole;
    do {
      const Part one = item(left, last);
      whole = whole ? joined(std::move(*whole), one, Code::either, Kind::truth) : one;
    } while (tokens_.take(","));
    return *whole;
  }

  /// y, LOW:HIGH, LOW:, :HIGH or LOW:HIGH:STEP as a condition on `left`.
  Part item(const Part& left, Part& last) {
    std::optional<Part> low, high;
    if (tokens_.token() != ":") {
      low = sum();
      if (low->kind != left.kind)
        want(*low, left.kind, left.kind == Kind::component ? "a component" : "a number");
      last = *low;
      if (tokens_.token() != ":") return joined(left, *low, Code::equal, Kind::truth);
    }
    want(left, Kind::number, "a number for a range");
    tokens_.advance();
    const bool more = !tokens_.at_end() && tokens_.token() != "," && tokens_.token() != ")" &&
                      tokens_.token() != "and" && tokens_.token() != "or" && tokens_.token() != ":";
    if (more) high = number_of_range();
    if (!low && !high) tokens_.refuse("expected LOW:HIGH, LOW: or :HIGH");
    std::optional<Part> whole;
    if (low) whole = joined(*low, left, Code::not_greater, Kind::truth);
    if (high) {
      const Part below = joined(left, *high, Code::not_greater, Kind::truth);
      whole = whole ? joined(std::move(*whole), below, Code::both, Kind::truth) : below;
    }
    if (tokens_.take(":")) {
      if (!low) tokens_.refuse("expected a range with LOW before its step");
      const Part step = number_of_range();
      Part hit = left;
      hit.steps.insert(hit.steps.end(), low->steps.begin(), low->steps.end());
      hit = joined(std::move(hit), step, Code::in_steps, Kind::truth);
      whole = joined(std::move(*whole), hit, Code::both, Kind::truth);
    }
    return *whole;
  }
  Part number_of_range() {
    Part part = sum();
    want(part, Kind::number, "a number for a range");
    return part;
  }

  Part sum() {
    Part part = product();
    while (tokens_.token() == "+" || tokens_.token() == "-") {
      const Code code = tokens_.token() == "+" ? Code::add : Code::subtract;
      part = calculated(std::move(part), code, &ExpressionParser::product);
    }
    return part;
  }

  Part product() {
    Part part = sign();
    while (tokens_.token() == "*" || tokens_.token() == "/" || tokens_.token() == "%") {
      const Code code = tokens_.token() == "*"   ? Code::multiply
                        : tokens_.token() == "/" ? Code::divide
                                                 : Code::remainder;
      part = calculated(std::move(part), code, &ExpressionParser::sign);
    }
    return part;
  }

  Part calculated(Part left, Code code, Part (ExpressionParser::*operand)()) {
    want(left, Kind::number, "a number to calculate with");
    tokens_.advance();
    const Part right = (this->*operand)();
    want(right, Kind::number, "a number to calculate with");
    return joined(std::move(left), right, code, Kind::number);
  }

  Part sign() {
    if (tokens_.token() != "-" && tokens_.token() != "+") return primary();
    const Nesting nesting(*this);
    const std::size_t at = tokens_.at();
    const bool minus = tokens_.token() == "-";
    tokens_.advance();
    Part part = sign();
    want(part, Kind::number, "a number behind its sign");
    if (minus) append(part, Code::negate);
    part.at = at;
    return part;
  }

  Part primary() {
    const std::size_t at = tokens_.at();
    if (tokens_.take("(")) {
      const Nesting nesting(*this);
      Part part = any_of();
      if (!tokens_.take(")")) tokens_.refuse("expected ) for the ( at character " + std::to_string(at + 1));
      part.at = at;
      return part;
    }
    if (tokens_.at_number()) return number(at);
    if (!tokens_.at_name()) tokens_.refuse("expected a number or a name");
    const std::string word = tokens_.token();
    tokens_.advance();
    if (word == "abs" && tokens_.token() == "(") {
      Part part = primary();
      want(part, Kind::number, "a number for abs");
      append(part, Code::abs);
      part.at = at;
      return part;
    }
    return named(word, at);
  }

  Part number(std::size_t at) {
    double value = 0;
    try {
      value = parse_number(tokens_.token());
    } catch (const Error&) {
      tokens_.refuse("expected a number");
    }
    tokens_.advance();
    return {{{Code::number, value}}, Kind::number, at};
  }

  Part named(const std::string& word, std::size_t at) {
    if (const auto key = HeaderKey::named(word)) {
      into_.keys_.push_back(*key);
      const auto index = static_cast<double>(into_.keys_.size() - 1);
      return {{{Code::key, index}}, key->is_component() ? Kind::component : Kind::number, at};
    }
    std::vector<std::string> known = HeaderKey::names();
    for (int index = 0; index <= static_cast<int>(Component::other); ++index) {
      const auto component = static_cast<Component>(index);
      if (word == name_of(component)) return {{{Code::number, double(index)}}, Kind::component, at};
      known.emplace_back(name_of(component));
    }
    const std::string meant = nearest_of(known, word);
    tokens_.refuse_at(at, "unknown name" + (meant.empty() ? ", expected one of a trace header"
                                                          : ", did you mean " + meant + "?"));
  }

  /// Counts how deep the descent is, so that no text can exhaust the stack.
  struct Nesting {
    explicit Nesting(ExpressionParser& parser) : parser_(parser) {
      if (++parser_.depth_ > deepest) parser_.tokens_.refuse("is nested more than 200 deep");
    }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    ~Nesting() { --parser_.depth_; }
    ExpressionParser& parser_;
  };

  ExpressionTokens tokens_;
  Expression& into_;
  int depth_ = 0;
};

Expression::Expression(const std::string& text) { ExpressionParser(text, *this).parse(); }

}  // namespace slipwave
