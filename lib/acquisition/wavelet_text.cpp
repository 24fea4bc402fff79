// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "acquisition/wavelet.hpp"
#include "base/error.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"
#include "io/column_header.hpp"
#include "io/input_bytes.hpp"

namespace slipwave {

namespace {

constexpr const char* expected_wavelets =
    "expected ricker:F, gauss:F, sine:F[:CYCLES] (F in Hz) or file:PATH";

double positive_frequency(const std::string& text, const std::string& number) {
  const double hz = in_place("wavelet '" + text + "'", [&] { return parse_number(number); });
  if (!(hz >= 1e-6 && hz <= 1e9))
    throw Error("wavelet '" + text + "': found a frequency of " + shown(hz) + " Hz, expected 1e-6 to 1e9",
                ErrorKind::usage);
  return hz;
}

double whole_half_cycles(const std::string& text, const std::string& number) {
  const double cycles = in_place("wavelet '" + text + "'", [&] { return parse_number(number); });
  // Any other number would end with a jump.
  if (!(cycles > 0) || cycles > 1e4 || 2 * cycles != std::floor(2 * cycles))
    throw Error("wavelet '" + text + "': found " + shown(cycles) +
                    " cycles, expected a multiple of 0.5 above 0 and up to 10000",
                ErrorKind::usage);
  return cycles;
}

/// Columns between blanks, tabs or one comma or semicolon with blanks round it.
std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> columns;
  for (;;) {
    const auto end = line.find_first_of(" \t,;");
    columns.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return columns;
    line = trimmed(line.substr(end));
    if (line.starts_with(',') || line.starts_with(';')) line = trimmed(line.substr(1));
  }
}

/// The number after "dt=" in a comment line, if that is what the comment is.
std::optional<double> interval_in(std::string_view comment) {
  comment = trimmed(comment.substr(1));
  if (!comment.starts_with("dt")) return {};
  comment = trimmed(comment.substr(2));
  if (!comment.starts_with('=')) return {};
  const double interval = parse_number(trimmed(comment.substr(1)));
  if (!(interval > 0)) throw Error("found dt=" + shown(interval) + ", expected a sample interval above 0 s");
  return interval;
}

// What splines and spectra can be made of in doubles, far beyond all that sources do.
constexpr double most_seconds = 1e9, largest_value = 1e100, shortest_step_s = 1e-15, finest_step = 1e-12;

void check_sample(double time, double value) {
  if (std::abs(time) > most_seconds || std::abs(value) > largest_value)
    throw Error("found " + shown(value) + " at " + shown(time) + " s, expected values up to " +
                shown(largest_value) + " and times up to " + shown(most_seconds) + " s");
}

/// Samples as they stand in a file, line by line.
class SampleReader {
 public:
  void take(std::string_view line) {
    line = trimmed(line);
    if (line.empty()) return;
    if (line.starts_with('#')) {
      if (const auto interval = interval_in(line)) {
        if (!values_.empty()) throw Error("found dt= after the first sample, expected it before");
        interval_ = interval;
      }
      return;
    }
    const auto columns = columns_of(line);
    if (values_.empty() && !header_ && are_headers(columns)) return take_header(column_headers(columns));
    const std::size_t expected = interval_ ? 1 : 2;
    if (columns.size() != expected)
      throw Error("found " + std::to_string(columns.size()) + (columns.size() == 1 ? " column" : " columns") +
                  ", expected " +
                  (interval_ ? "one (a value, as dt= is given)"
                             : "two (time and value; or a line '# dt=SECONDS' and one column)"));
    const double time =
        interval_ ? double(values_.size()) * *interval_ : in_seconds_(parse_number(columns[time_column_]));
    if (!times_.empty() && !(time > times_.back()))
      throw Error("found time " + shown(time) + " s after " + shown(times_.back()) +
                  " s, expected growing times");
    const double value = parse_number(columns[interval_ ? 0 : 1 - time_column_]);
    check_sample(time, value);
    times_.push_back(time);
    values_.push_back(value);
  }

  shape::Sampled finish() && { return sampled_wavelet(std::move(times_), std::move(values_)); }

 private:
  /// Names above the columns: of the time, in any unit of time, and of the values.
  void take_header(const std::vector<ColumnHeader>& headers) {
    header_ = true;
    if (interval_) return;
    const auto time = std::find_if(headers.begin(), headers.end(), [](const ColumnHeader& header) {
      return header.name == "time" || header.name == "t";
    });
    if (headers.size() != 2 || time == headers.end())
      throw Error("found " + std::to_string(headers.size()) +
                  " columns with names, expected two, one of them time (or t)");
    time_column_ = std::size_t(time - headers.begin());
    in_seconds_ = time->conversion("s");
  }

  bool header_ = false;
  std::size_t time_column_ = 0;
  UnitConversion in_seconds_;
  std::optional<double> interval_;
  std::vector<double> times_, values_;
};

}  // namespace

shape::Sampled sampled_wavelet(std::vector<double> times, std::vector<double> values) {
  if (values.size() < 2)
    throw Error("found " + std::to_string(values.size()) + (values.size() == 1 ? " sample" : " samples") +
                ", expected at least 2");
  if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; }))
    throw Error("found only zeros, expected a wavelet");
  if (values.front() != 0) {
    times.insert(times.begin(), 2 * times[0] - times[1]);
    values.insert(values.begin(), 0);
  }
  if (values.back() != 0) {
    times.push_back(2 * times.back() - times[times.size() - 2]);
    values.push_back(0);
  }
  const double delay = std::max(0., -times.front());
  for (auto& time : times) time += delay;
  const double shortest = std::max(shortest_step_s, finest_step * (times.back() - times.front()));
  for (std::size_t n = 1; n < times.size(); ++n)
    if (!(times[n] - times[n - 1] >= shortest))
      throw Error("found samples " + shown(times[n] - times[n - 1]) + " s apart, expected at least " +
                  shown(shortest) + " s in a wavelet of " + shown(times.back() - times.front()) + " s");
  return shape::Sampled(std::move(times), std::move(values), delay);
}

shape::Sampled read_wavelet(const std::string& path) {
  const auto text = read_text(path);
  SampleReader reader;
  std::string_view rest(text);
  for (int number = 1; !rest.empty(); ++number) {
    const auto end = rest.find('\n');
    try {
      reader.take(rest.substr(0, end));
    } catch (const Error& error) {
      // What the number parser calls a usage error is bad data here.
      throw Error(shown_input(path) + ": line " + std::to_string(number) + ": " + error.what());
    }
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return in_place(shown_input(path), [&] { return std::move(reader).finish(); });
}

Wavelet parse_wavelet(const std::string& text) {
  const auto parts = split(text, ':');
  if (parts[0] == "file" && text.size() > 5) return {read_wavelet(text.substr(5)), text};
  if (parts[0] == "ricker" && parts.size() == 2)
    return {shape::Ricker{positive_frequency(text, parts[1])}, text};
  if (parts[0] == "gauss" && parts.size() == 2)
    return {shape::Gaussian{positive_frequency(text, parts[1])}, text};
  if (parts[0] == "sine" && (parts.size() == 2 || parts.size() == 3)) {
    const double hz = positive_frequency(text, parts[1]);
    return {shape::Sine{hz, parts.size() == 3 ? whole_half_cycles(text, parts[2]) : 1}, text};
  }
  throw Error("wavelet: found '" + text + "', " + expected_wavelets, ErrorKind::usage);
}

}  // namespace slipwave
