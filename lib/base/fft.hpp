// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace slipwave {

/// The smallest even length >= `length` whose prime factors are 2, 3, 5 and 7: transforms of such lengths are
/// fast. Throws Error when it is not below 2^31.
std::size_t fast_transform_length(std::size_t length);

/// Discrete Fourier transform of `length` real numbers, and back:
///   forward   X_k = sum_n x_n exp(-2 pi i k n / N),  k = 0 .. N/2
///   backward  x_n = 1/N sum_k X_k exp(+2 pi i k n / N)   (X_{N-k} = conj X_k)
/// The plan is chosen without timing, so that equal input gives equal bits from run to run.
/// One object serves one thread at a time; different objects are independent.
class RealTransform {
 public:
  /// length >= 1, below 2^31; throws Error otherwise, and when the machine has not the memory.
  explicit RealTransform(std::size_t length);
  RealTransform(RealTransform&&) noexcept;
  RealTransform& operator=(RealTransform&&) noexcept;
  ~RealTransform();

  std::size_t length() const noexcept;
  /// length()/2 + 1
  std::size_t bins() const noexcept;

  /// samples.size() <= length(), the rest counts as zero. The answer, bins() numbers, stays until the next
  /// call.
  std::span<const std::complex<double>> forward(std::span<const double> samples);
  /// spectrum.size() == bins(); imaginary parts of the first (and, even length, last) bin are ignored.
  /// The answer, length() numbers, stays until the next call.
  std::span<const double> backward(std::span<const std::complex<double>> spectrum);

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// Discrete Fourier transform of `rows` rows of `length` real numbers along both axes, in place:
///   X_jk = sum_m sum_n x_mn exp(-2 pi i (j m / rows + k n / length)),  j = 0 .. rows-1,  k = 0 .. length/2
/// Plans as for RealTransform.
class RealTransform2 {
 public:
  /// Both 1 to 2^31 - 1. Throws Error otherwise, and when the machine has not the memory, bytes_for().
  RealTransform2(std::size_t rows, std::size_t length);
  RealTransform2(RealTransform2&&) noexcept;
  RealTransform2& operator=(RealTransform2&&) noexcept;
  ~RealTransform2();

  std::size_t rows() const noexcept;
  std::size_t length() const noexcept;
  /// length()/2 + 1
  std::size_t bins() const noexcept;
  /// Some 8 bytes per sample, transformed in place.
  static double bytes_for(std::size_t rows, std::size_t length);

  /// Samples of row m, to be filled before forward(); all zero after clear().
  std::span<double> samples(std::size_t row);
  void clear();
  void forward();
  /// X_j0, X_j1, ... after forward().
  std::span<const std::complex<double>> spectrum(std::size_t row) const;
  std::span<std::complex<double>> spectrum(std::size_t row);
  /// The samples again, from the spectra: x_mn = 1/(rows length) sum X_jk exp(+2 pi i (...)).
  void backward();

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace slipwave
