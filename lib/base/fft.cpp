// SPDX-License-Identifier: BSD-3-Clause
#include "base/fft.hpp"

#include <fftw3.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <string>

#include "base/error.hpp"

namespace slipwave {
namespace {

/// FFTW's planner shares tables between plans; everything but executing a plan takes this lock.
std::unique_lock<std::mutex> planner() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

struct Freed {
  void operator()(void* memory) const { fftw_free(memory); }
};
struct Destroyed {
  void operator()(fftw_plan plan) const {
    const auto lock = planner();
    fftw_destroy_plan(plan);
  }
};
using Plan = std::unique_ptr<fftw_plan_s, Destroyed>;

/// Memory that is not there would be given all the same, and the process ended when it is used.
void check_memory(double bytes, const std::string& size) {
  const double there =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  if (there > 0 && bytes > there)
    throw Error("a Fourier transform of " + size + " samples takes " + shown(bytes / (1 << 30), 3) +
                " GiB, this machine has " + shown(there / (1 << 30), 3) + " GiB");
}

}  // namespace

std::size_t fast_transform_length(std::size_t length) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  for (std::size_t even = length + length % 2; even <= most; even += 2) {
    std::size_t rest = std::max<std::size_t>(even, 2);
    for (const std::size_t factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return std::max<std::size_t>(even, 2);
  }
  throw Error("a Fourier transform of " + std::to_string(length) + " samples, expected 1 to 2147483647");
}

struct RealTransform::Plans {
  std::size_t length;
  std::unique_ptr<double, Freed> real;
  std::unique_ptr<fftw_complex, Freed> complex;
  Plan forward;
  Plan backward;

  std::complex<double>* bins() const { return reinterpret_cast<std::complex<double>*>(complex.get()); }
};

RealTransform::RealTransform(std::size_t length) {
  if (length < 1 || length > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error("a Fourier transform of " + std::to_string(length) + " samples, expected 1 to 2147483647");
  check_memory(16 * static_cast<double>(length), std::to_string(length));
  plans_.reset(new Plans{length, nullptr, nullptr, nullptr, nullptr});
  plans_->real.reset(fftw_alloc_real(length));
  plans_->complex.reset(fftw_alloc_complex(length / 2 + 1));
  if (!plans_->real || !plans_->complex)
    throw Error("no memory for a Fourier transform of " + std::to_string(length) + " samples");
  const int n = static_cast<int>(length);
  const auto lock = planner();
  plans_->forward.reset(fftw_plan_dft_r2c_1d(n, plans_->real.get(), plans_->complex.get(), FFTW_ESTIMATE));
  plans_->backward.reset(fftw_plan_dft_c2r_1d(n, plans_->complex.get(), plans_->real.get(), FFTW_ESTIMATE));
}

RealTransform::RealTransform(RealTransform&&) noexcept = default;
RealTransform& RealTransform::operator=(RealTransform&&) noexcept = default;
RealTransform::~RealTransform() = default;

std::size_t RealTransform::length() const noexcept { return plans_->length; }
std::size_t RealTransform::bins() const noexcept { return plans_->length / 2 + 1; }

std::span<const std::complex<double>> RealTransform::forward(std::span<const double> samples) {
  if (samples.size() > length())
    throw Error("Fourier transform of " + std::to_string(length()) + " samples given " +
                std::to_string(samples.size()));
  double* const end = std::copy(samples.begin(), samples.end(), plans_->real.get());
  std::fill(end, plans_->real.get() + length(), 0.0);
  fftw_execute(plans_->forward.get());
  return {plans_->bins(), bins()};
}

std::span<const double> RealTransform::backward(std::span<const std::complex<double>> spectrum) {
  if (spectrum.size() != bins())
    throw Error("inverse Fourier transform of " + std::to_string(bins()) + " frequencies given " +
                std::to_string(spectrum.size()));
  std::copy(spectrum.begin(), spectrum.end(), plans_->bins());
  fftw_execute(plans_->backward.get());
  double* const samples = plans_->real.get();
  const double scale = 1.0 / static_cast<double>(length());
  std::for_each(samples, samples + length(), [scale](double& sample) { sample *= scale; });
  return {samples, length()};
}

struct RealTransform2::Plan {
  std::size_t rows, length;
  std::unique_ptr<fftw_complex, Freed> complex;  // rows of bins; before the transform the samples lie in them
  slipwave::Plan forward, backward;

  std::size_t bins() const { return length / 2 + 1; }
};

double RealTransform2::bytes_for(std::size_t rows, std::size_t length) {
  const std::size_t frequencies = length / 2 + 1;
  return 16.0 * static_cast<double>(rows) * static_cast<double>(frequencies);
}

RealTransform2::RealTransform2(std::size_t rows, std::size_t length) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  const std::string size = std::to_string(rows) + " x " + std::to_string(length);
  if (rows < 1 || length < 1 || rows > most || length > most)
    throw Error("a Fourier transform of " + size + " samples, expected 1 to 2147483647 along each axis");
  check_memory(bytes_for(rows, length), size);
  plan_.reset(new Plan{rows, length, nullptr, nullptr, nullptr});
  // FFTW ends the program where its planner finds no memory; this throws.
  ::operator delete(::operator new(std::size_t(8) << 20));
  plan_->complex.reset(fftw_alloc_complex(rows * plan_->bins()));
  if (!plan_->complex) throw Error("no memory for a Fourier transform of " + size + " samples");
  {
    const auto lock = planner();
    plan_->forward.reset(fftw_plan_dft_r2c_2d(static_cast<int>(rows), static_cast<int>(length),
                                              reinterpret_cast<double*>(plan_->complex.get()),
                                              plan_->complex.get(), FFTW_ESTIMATE));
    plan_->backward.reset(
        fftw_plan_dft_c2r_2d(static_cast<int>(rows), static_cast<int>(length), plan_->complex.get(),
                             reinterpret_cast<double*>(plan_->complex.get()), FFTW_ESTIMATE));
  }
  clear();
}

RealTransform2::RealTransform2(RealTransform2&&) noexcept = default;
RealTransform2& RealTransform2::operator=(RealTransform2&&) noexcept = default;
RealTransform2::~RealTransform2() = default;

std::size_t RealTransform2::rows() const noexcept { return plan_->rows; }
std::size_t RealTransform2::length() const noexcept { return plan_->length; }
std::size_t RealTransform2::bins() const noexcept { return plan_->bins(); }

std::span<double> RealTransform2::samples(std::size_t row) {
  return {reinterpret_cast<double*>(plan_->complex.get()) + 2 * row * bins(), length()};
}

void RealTransform2::clear() {
  double* const first = reinterpret_cast<double*>(plan_->complex.get());
  std::fill(first, first + 2 * rows() * bins(), 0.0);
}

void RealTransform2::forward() { fftw_execute(plan_->forward.get()); }

std::span<const std::complex<double>> RealTransform2::spectrum(std::size_t row) const {
  return {reinterpret_cast<const std::complex<double>*>(plan_->complex.get()) + row * bins(), bins()};
}

std::span<std::complex<double>> RealTransform2::spectrum(std::size_t row) {
  return {reinterpret_cast<std::complex<double>*>(plan_->complex.get()) + row * bins(), bins()};
}

void RealTransform2::backward() {
  fftw_execute(plan_->backward.get());
  const double scale = 1 / (static_cast<double>(rows()) * static_cast<double>(length()));
  for (std::size_t row = 0; row < rows(); ++row)
    for (double& sample : samples(row)) sample *= scale;
}

}  // namespace slipwave
