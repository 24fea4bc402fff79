#include "solver/dispersion.hpp"

#include <cmath>
#include <numbers>

#include "solver/kernels.hpp"
#include "solver/reconstruction.hpp"

namespace slipwave::solver {
namespace {

/// F_up of a wave exp(i k x) that is 1 at the cell.
template <int Order>
std::complex<double> flux(double courant, double phase) {
  constexpr int reach = reach_of(Order);
  double real[2 * reach + 1], imaginary[2 * reach + 1];
  for (int n = -reach; n <= reach; ++n) {
    real[n + reach] = std::cos(n * phase);
    imaginary[n + reach] = std::sin(n * phase);
  }
  double even, odd, even_imaginary, odd_imaginary;
  even_odd<Order>(real + reach, 1, courant, even, odd);
  even_odd<Order>(imaginary + reach, 1, courant, even_imaginary, odd_imaginary);
  return {even + odd, even_imaginary + odd_imaginary};
}

}  // namespace

std::complex<double> amplification(int order, double courant, double cells) {
  const double phase = 2 * std::numbers::pi / cells;
  const auto f = order == 1   ? flux<1>(courant, phase)
                 : order == 3 ? flux<3>(courant, phase)
                 : order == 5 ? flux<5>(courant, phase)
                              : flux<7>(courant, phase);
  return 1.0 - courant * f * (1.0 - std::polar(1.0, -phase));
}

double loss_per_wavelength(int order, double courant, double cells) {
  return 1 - std::pow(std::abs(amplification(order, courant, cells)), cells / courant);
}

}  // namespace slipwave::solver
