#include "base/fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <limits>
#include <mutex>

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

}  // namespace slipwave
