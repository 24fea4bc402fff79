// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace slipwave {

/// What ended a tool, as its exit status (docs: tools, "exit status").
enum class ErrorKind { data = 1, usage = 2, unstable = 3 };

/// The one exception of the library: a sentence that says what was found and what was expected.
/// Callers that know the place (file, trace, option) add it in front with `within`.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what, ErrorKind kind = ErrorKind::data)
      : std::runtime_error(what), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }
  /// Returns this error with `place` put in front of its sentence: "model.nc: vs at x=1200 ...".
  Error within(const std::string& place) const { return Error(place + ": " + what(), kind_); }

 private:
  ErrorKind kind_;
};

/// Runs `body`; an Error leaving it gets `place` in front of its sentence.
template <class Body>
decltype(auto) in_place(const std::string& place, Body&& body) {
  try {
    return std::forward<Body>(body)();
  } catch (const Error& error) {
    throw error.within(place);
  }
}

/// What a message quotes of a text: its first 60 bytes, made printable, and "..." where more follow.
std::string excerpt(const std::string& text);
/// On one line of printable characters: control characters and bytes that are no UTF-8 become '?', so that
/// nothing read from a file can drive a terminal.
std::string printable(const std::string& text);

/// A number as a message shows it: shortest form that reads back as the same double ("12.5", "1e-300").
std::string shown(double value);
/// Rounded to so many digits, the rest left out: 160, 1.67, 0.0042.
std::string shown(double value, int digits);
/// Rounded to thousandths: of lengths in m to mm.
std::string shown_to_thousandths(double value);

/// Throws a usage Error.
[[noreturn]] void refuse(const std::string& sentence);

}  // namespace slipwave
