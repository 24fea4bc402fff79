// SPDX-License-Identifier: BSD-3-Clause
#include "gather/taper.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

double flank(double since_s, double length_s) {
  return since_s < length_s ? (1 - std::cos(std::numbers::pi * since_s / length_s)) / 2 : 1;
}

}  // namespace

TaperLengths parse_taper(std::string_view text) {
  const auto lengths = parse_numbers(text, ',');
  if (lengths.size() > 2 || lengths.front() < 0 || lengths.back() < 0)
    throw Error("found '" + std::string(text) + "', expected T or START,END in s, none negative",
                ErrorKind::usage);
  return {lengths.front(), lengths.back()};
}

std::vector<double> taper_weights(const SampleAxis& axis, const TaperLengths& lengths) {
  const double record_s = static_cast<double>(axis.count - 1) * axis.interval_s;
  for (const double length_s : {lengths.start_s, lengths.end_s})
    if (length_s > record_s * (1 + 1e-9))
      throw Error("found a taper of " + shown(length_s) + " s, expected at most the " + shown(record_s) +
                      " s of the traces",
                  ErrorKind::usage);
  std::vector<double> weights;
  for (std::int64_t n = 0; n < axis.count; ++n) {
    const double since_s = static_cast<double>(n) * axis.interval_s;
    const double until_s = static_cast<double>(axis.count - 1 - n) * axis.interval_s;
    weights.push_back(flank(since_s, lengths.start_s) * flank(until_s, lengths.end_s));
  }
  return weights;
}

void multiply(std::span<double> samples, std::span<const double> weights) {
  if (samples.size() != weights.size())
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(weights.size()) +
                " as in the first trace");
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] *= weights[n];
}

}  // namespace slipwave
