// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "base/parse.hpp"
#include "cli/parser.hpp"
#include "geology/layers.hpp"
#include "geology/points_file.hpp"
#include "geology/region.hpp"
#include "memory_file.hpp"
#include "traces/sorting.hpp"
#include "traces/time_window.hpp"

// Everything that people write as text. The first letter of an input says which of it the rest is.

namespace {

using namespace slipwave;
using fuzz::fail;
using Bytes = std::span<const std::uint8_t>;

/// Runs `body`; an Error must name the place, and nothing else may be thrown.
template <class Body>
void answers(const std::string& place, Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    const std::string said = error.what();
    if (!said.starts_with(place)) fail("names no place: " + said);
  }
}

void expect(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

void read_wavelets(const std::string& path) {
  answers(path + ": ", [&] {
    const auto samples = read_wavelet(path);
    const auto& times = samples.times_s();
    expect(times.size() >= 2 && times.size() == samples.values().size(), "times and values differ");
    for (std::size_t n = 0; n < times.size(); ++n) {
      expect(std::isfinite(times[n]) && times[n] >= 0, "a time is not finite or below zero");
      expect(n == 0 || times[n] > times[n - 1], "times do not grow");
      expect(std::isfinite(samples.value(times[n])), "a value is not finite");
      if (n > 0)
        expect(std::isfinite(samples.value((times[n] + times[n - 1]) / 2)),
               "between values it is not finite");
    }
    const Wavelet wavelet(samples, "file:");
    expect(std::isfinite(wavelet.highest_frequency_hz()), "the highest frequency is not finite");
    expect(std::isfinite(wavelet.nominal_hz()), "the nominal frequency is not finite");
  });
}

void read_point_files(const std::string& path) {
  answers(path + ": ", [&] {
    for (const auto& point : read_points(path)) {
      expect(std::isfinite(point.at[0]) && std::isfinite(point.at[1]), "a point is not finite");
      expect(point.line > 0, "a point stands on no line");
    }
  });
  answers(path + ": ", [&] {
    const auto region = read_polygon(path);
    region.contains({0, 0});
    region.contains({1.5, -2});
  });
  for (const std::string kind : {"@", "smooth@"})
    answers("", [&] {
      const auto horizon = Horizon::parse(kind + path, 10);
      expect(horizon.from_m() < horizon.to_m(), "a horizon has no length");
      const double to_y = horizon.is_grid() ? horizon.to_m(1) : 0,
                   from_y = horizon.is_grid() ? horizon.from_m(1) : 0;
      expect(!horizon.is_grid() || from_y < to_y, "a grid has no width");
      for (const double share : {0., 0.3, 1.})
        horizon.at(horizon.from_m() + share * (horizon.to_m() - horizon.from_m()),
                   from_y + share * (to_y - from_y));
    });
}

void read_configs(const std::string& path) {
  std::string text = "a", choice = "one";
  double number = 1;
  std::optional<double> maybe;
  int count = 1;
  bool on = false;
  std::vector<std::string> many;
  cli::Parser parser({"sw-x", "tries options", "[options]", "sw-x"});
  auto& options = parser.options();
  options.add("output,o", text, "FILE", "text");
  options.add("time", number, "T", "a number");
  options.add("dt", maybe, "DT", "a number or none");
  options.add("order", count, "N", "a whole number");
  options.add("plan", on, "a switch");
  options.add("source", many, "X,Z", "many");
  options.add_choice("top", choice, {"one", "two"}, "a choice");
  options.add_threads();
  options.pass_over({"size"});
  parser.declare_common();
  const std::vector<const char*> words = {"sw-x", "--config", path.c_str()};
  answers(path + ": ", [&] { parser.parse(int(words.size()), words.data()); });
  expect(std::isfinite(number) && (!maybe || std::isfinite(*maybe)), "a number is not finite");
  expect(choice == "one" || choice == "two", "a choice that there is not");
}

void read_notations(const std::string& text) {
  const auto finite = [](const auto& point) {
    for (const double value : point) expect(std::isfinite(value), "a coordinate is not finite");
  };
  answers("", [&] { finite(std::array{parse_number(text)}); });
  answers("", [&] { parse_integer(text); });
  answers("", [&] { finite(parse_numbers(text, ',')); });
  answers("", [&] { finite(parse_point<2>(text)); });
  answers("", [&] {
    const auto points = parse_line<2>(text);
    expect(!points.empty(), "a line without points");
    finite(points.front());
    finite(points.back());
  });
  answers("", [&] { parse_line<3>(text); });
  answers("", [&] { finite(parse_box<2>(text).high_m); });
  answers("", [&] { finite(parse_size<2>(text)); });
  answers("", [&] { parse_shape<3>(text); });
  answers("", [&] { finite(parse_point<3>(text)); });
  answers("", [&] { finite(parse_box<3>(text).high_m); });
  answers("", [&] { finite(parse_size<3>(text)); });
  answers("", [&] { parse_ellipse<3>(text).contains({1, 2, 3}); });
  answers("", [&] { parse_slab<3>(text).contains({1, 2, 3}); });
  answers("", [&] { parse_ellipse(text).contains({1, 2}); });
  answers("", [&] { parse_slab(text).contains({1, 2}); });
  answers("", [&] { parse_time_window(text); });
  if (text.find('@') == std::string::npos)
    answers("", [&] { expect(!std::isnan(parse_layer(text).top.at(3)), "a top that is not a number"); });
  if (text.find("file:") == std::string::npos)
    answers("", [&] { expect(parse_wavelet(text).duration_s() > 0, "a wavelet without duration"); });
}

void read_expressions(const std::string& text) {
  answers("", [&] { Expression condition(text); });
  answers("", [&] { parse_sort_keys(text); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile file;
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  const std::string text(rest.begin(), rest.end());
  switch (data[0]) {
    case 'w':
      read_wavelets(file.holding(rest));
      break;
    case 'p':
      read_point_files(file.holding(rest));
      break;
    case 'c':
      read_configs(file.holding(rest));
      break;
    case 'n':
      read_notations(text);
      break;
    case 'e':
      read_expressions(text);
      break;
    default:
      return -1;  // kept out of the corpus
  }
  return 0;
}
