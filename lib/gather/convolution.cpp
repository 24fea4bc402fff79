// SPDX-License-Identifier: BSD-3-Clause
#include "gather/convolution.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace slipwave {
namespace {

constexpr double longest = 2147483647.0;

/// Lags that two samples of a trace can have.
struct Lags {
  std::int64_t first, last;
};

Lags used_lags(std::size_t count, const Kernel& kernel) {
  const auto most = static_cast<std::int64_t>(count) - 1;
  const std::int64_t last = kernel.first_lag + static_cast<std::int64_t>(kernel.values.size()) - 1;
  return {std::max(kernel.first_lag, -most), std::min(last, most)};
}

/// Long enough that no lag between two samples meets the kernel a second time, a period away.
std::size_t transform_length(std::size_t count, const Kernel& kernel) {
  const Lags lags = used_lags(count, kernel);
  const std::int64_t reach = std::max<std::int64_t>({lags.last, -lags.first, 0});
  return fast_transform_length(count + static_cast<std::size_t>(reach));
}

}  // namespace

Kernel sampled_kernel(const std::function<double(double)>& h, double from_s, double to_s, double interval_s) {
  const double first = std::ceil(from_s / interval_s - 1e-9);
  const double last = std::floor(to_s / interval_s + 1e-9);
  if (!(last - first < longest))
    throw Error("a filter of " + shown(to_s - from_s) + " s, expected fewer than 2147483647 samples of " +
                shown(interval_s) + " s");
  Kernel kernel{{}, static_cast<std::int64_t>(first)};
  for (double lag = first; lag <= last; ++lag) kernel.values.push_back(interval_s * h(lag * interval_s));
  return kernel;
}

Convolution::Convolution(std::size_t count, const Kernel& kernel)
    : count_(count), transform_(transform_length(count, kernel)) {
  std::vector<double> periodic(transform_.length());
  const auto period = static_cast<std::int64_t>(periodic.size());
  const Lags lags = used_lags(count, kernel);
  for (std::int64_t lag = lags.first; lag <= lags.last; ++lag)
    periodic[static_cast<std::size_t>((lag + period) % period)] =
        kernel.values[static_cast<std::size_t>(lag - kernel.first_lag)];
  const auto response = transform_.forward(periodic);
  response_.assign(response.begin(), response.end());
  spectrum_.resize(response_.size());
}

void Convolution::apply(std::span<double> samples) {
  if (samples.size() != count_)
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(count_) +
                " as in the first trace");
  const auto spectrum = transform_.forward(samples);
  for (std::size_t k = 0; k < spectrum_.size(); ++k) spectrum_[k] = spectrum[k] * response_[k];
  const auto filtered = transform_.backward(spectrum_);
  std::copy_n(filtered.begin(), count_, samples.begin());
}

}  // namespace slipwave
