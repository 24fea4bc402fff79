// SPDX-License-Identifier: BSD-3-Clause
#include "gather/trace_filter.hpp"

#include <string>
#include <utility>

#include "base/error.hpp"

namespace slipwave {

TraceFilter::TraceFilter(const SampleAxis& axis, FilterSteps steps)
    : from_(axis), to_(axis), gains_(std::move(steps.gains)) {
  if (steps.taper) taper_ = taper_weights(axis, *steps.taper);
  if (steps.convolution) convolutions_.emplace_back(static_cast<std::size_t>(axis.count), *steps.convolution);
  if (steps.band) in_place("--band", [&] { convolutions_.push_back(band_pass(axis, *steps.band)); });
  if (steps.interval_s && *steps.interval_s != axis.interval_s) {
    in_place("--resample", [&] { resampling_.emplace(axis, *steps.interval_s); });
    to_ = resampling_->axis();
  }
}

void TraceFilter::apply(std::vector<double>& samples, double start_s) {
  if (static_cast<std::int64_t>(samples.size()) != from_.count)
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(from_.count) +
                " as in the first trace");
  check_finite(samples);
  if (!taper_.empty()) multiply(samples, taper_);
  for (Convolution& convolution : convolutions_) convolution.apply(samples);
  if (resampling_) samples = resampling_->of(samples);
  gains_.apply(samples, {to_.count, to_.interval_s, start_s});
}

}  // namespace slipwave
