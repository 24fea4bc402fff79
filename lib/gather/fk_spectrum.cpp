// SPDX-License-Identifier: BSD-3-Clause
#include "gather/fk_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "gather/phase_velocity.hpp"
#include "gather/receiver_line.hpp"

namespace slipwave {
namespace {

constexpr double evenness = 1e-3;  // of the spacing, between gathers

std::string receivers_shown(std::size_t count, double spacing_m) {
  return std::to_string(count) + " receivers every " + shown(spacing_m, 6) + " m";
}

}  // namespace

FkTransform::FkTransform(const SampleAxis& axis, std::size_t receivers, double spacing_m,
                         const SpectrumSettings& settings)
    : interval_s_(axis.interval_s),
      spacing_m_(spacing_m),
      power_(settings.power),
      along_(
          window_weights(settings.window, static_cast<std::size_t>(std::max<std::int64_t>(axis.count, 0)))),
      across_(window_weights(settings.window, receivers)),
      transform_(padded_length(receivers, settings.pad), padded_length(along_.size(), settings.pad)) {
  if (!(interval_s_ > 0) || !(spacing_m_ > 0))
    throw Error("an f-k spectrum of samples every " + shown(interval_s_) + " s and receivers every " +
                shown(spacing_m_) + " m, expected both above 0");
}

std::vector<double> FkTransform::frequencies_hz() const {
  std::vector<double> frequencies(transform_.bins());
  for (std::size_t n = 0; n < frequencies.size(); ++n)
    frequencies[n] = static_cast<double>(n) / (static_cast<double>(transform_.length()) * interval_s_);
  return frequencies;
}

std::vector<double> FkTransform::wavenumbers_per_m() const {
  const auto rows = static_cast<std::int64_t>(transform_.rows());
  std::vector<double> wavenumbers;
  for (std::int64_t row = -(rows / 2); row < rows - rows / 2; ++row)
    wavenumbers.push_back(static_cast<double>(row) / (static_cast<double>(rows) * spacing_m_));
  return wavenumbers;
}

void FkTransform::add(std::span<const std::vector<double>> traces, std::span<double> sum) {
  if (traces.size() != across_.size() || sum.size() != transform_.rows() * transform_.bins())
    throw Error(std::to_string(traces.size()) + " traces, expected " + std::to_string(across_.size()));
  transform_.clear();
  for (std::size_t m = 0; m < traces.size(); ++m) {
    if (traces[m].size() != along_.size())
      throw Error(std::to_string(traces[m].size()) + " samples, expected " + std::to_string(along_.size()));
    const auto row = transform_.samples(m);
    for (std::size_t n = 0; n < along_.size(); ++n) row[n] = across_[m] * along_[n] * traces[m][n];
  }
  transform_.forward();
  const std::size_t rows = transform_.rows();
  const std::size_t bins = transform_.bins();
  for (std::size_t out = 0; out < rows; ++out) {
    // the transform's exponent is negative along both axes: its row j is the wavenumber -j
    const std::size_t j = (rows + rows / 2 - out) % rows;
    const auto spectrum = transform_.spectrum(j);
    for (std::size_t k = 0; k < bins; ++k) {
      const double magnitude = interval_s_ * spacing_m_ * std::abs(spectrum[k]);
      const bool alone = k == 0 || 2 * k == transform_.length();
      sum[out * bins + k] += power_ ? (alone ? 1 : 2) * magnitude * magnitude : magnitude;
    }
  }
}

FkSpectra::FkSpectra(const SampleAxis& axis, const SpectrumSettings& settings,
                     const std::optional<PhaseVelocityChoice>& over_velocity)
    : axis_(axis), settings_(settings), over_velocity_(over_velocity) {}

FkSpectra::~FkSpectra() = default;

std::vector<double> FkSpectra::velocities() const {
  return image_ ? image_->velocities() : std::vector<double>();
}

void FkSpectra::add(const TraceHeader& header, std::span<const double> samples) {
  if (static_cast<std::int64_t>(samples.size()) != axis_.count)
    throw Error(std::to_string(samples.size()) + " samples, expected " + std::to_string(axis_.count) +
                " as in the first trace");
  if (gathers_.empty() || header.shot != shot_) {
    finish_shot();
    shot_ = header.shot;
    if (!shots_.insert(shot_).second)
      throw Error("shot " + std::to_string(shot_) +
                  " comes again after another one, expected its traces together (sw-sort --key shot)");
  }
  held_ += samples.size();
  most_held_ = std::max(most_held_, held_);
  gathers_[header.component].push_back({header.receiver_m, {samples.begin(), samples.end()}});
}

void FkSpectra::finish() {
  finish_shot();
  if (means_.empty()) throw Error("has no traces, expected at least one");
  for (auto& [component, mean] : means_)
    for (double& value : mean.values) value /= static_cast<double>(mean.gathers);
}

void FkSpectra::finish_shot() {
  for (auto& [component, placed] : gathers_)
    in_place("shot " + std::to_string(shot_) + ", " + name_of(component),
             [&, of = component] { finish_gather(of, gathers_[of]); });
  gathers_.clear();
  held_ = 0;
}

double FkSpectra::bytes() const {
  double bytes = 8.0 * static_cast<double>(most_held_) + (transform_ ? transform_->bytes() : 0);
  for (const auto& [component, mean] : means_) bytes += 8.0 * static_cast<double>(mean.values.size());
  return bytes;
}

void FkSpectra::finish_gather(Component component, std::vector<Placed>& placed) {
  std::vector<std::array<double, 3>> receivers_m;
  for (const Placed& one : placed) receivers_m.push_back(one.receiver_m);
  const auto line = line_of(receivers_m, transform_ ? &direction_ : nullptr);
  direction_ = line.axis;
  const double spacing_m = line.spacing_m;
  if (!transform_) transform_.emplace(axis_, placed.size(), spacing_m, settings_);
  if (placed.size() != transform_->receivers() ||
      std::fabs(spacing_m - transform_->spacing_m()) > evenness * spacing_m)
    throw Error(receivers_shown(placed.size(), spacing_m) + ", expected " +
                receivers_shown(transform_->receivers(), transform_->spacing_m()) +
                " as in the first gather");
  std::vector<std::vector<double>> traces;
  for (const std::size_t n : line.order) traces.push_back(std::move(placed[n].samples));
  if (over_velocity_ && !image_) begin_image(traces);
  Mean& mean = means_[component];
  const auto rows = image_ ? image_->velocities().size() : transform_->wavenumbers_per_m().size();
  mean.values.resize(transform_->frequencies_hz().size() * rows);
  ++mean.gathers;
  if (image_)
    image_->add(traces, mean.values);
  else
    transform_->add(traces, mean.values);
}

/// The first gather chooses velocities where none are given.
void FkSpectra::begin_image(const std::vector<std::vector<double>>& traces) {
  auto velocities = over_velocity_->velocities;
  if (velocities.empty()) {
    SpectrumSettings settings = settings_;
    settings.power = true;
    FkTransform transform(axis_, transform_->receivers(), transform_->spacing_m(), settings);
    std::vector<double> energy(transform.frequencies_hz().size() * transform.wavenumbers_per_m().size());
    transform.add(traces, energy);
    velocities = velocities_of_energy(transform, energy).values();
  }
  image_ = std::make_unique<PhaseVelocityTransform>(axis_, transform_->receivers(), transform_->spacing_m(),
                                                    settings_, std::move(velocities));
}

}  // namespace slipwave
