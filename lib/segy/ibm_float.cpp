#include <array>
#include <cmath>

#include "base/error.hpp"
#include "segy/sample_format.hpp"

// A System/360 float: sign, 7 bits of exponent e, 24 bits of fraction f; (-1)^s f 2^-24 16^(e - 64).

namespace slipwave::segy {
namespace {

constexpr int exponents = 128;
constexpr int fraction_bits = 24;
constexpr int bias = 64;

std::array<double, exponents> powers() {
  std::array<double, exponents> table{};
  for (int e = 0; e < exponents; ++e)
    table[static_cast<std::size_t>(e)] = std::ldexp(1.0, 4 * (e - bias) - fraction_bits);
  return table;
}

}  // namespace

double double_from_ibm(std::uint32_t word) {
  static const std::array<double, exponents> scale = powers();
  const double magnitude = static_cast<double>(word & 0xffffffU) * scale[word >> fraction_bits & 0x7fU];
  return (word >> 31) != 0 ? -magnitude : magnitude;
}

std::uint32_t ibm_from_double(double value) {
  if (!std::isfinite(value)) throw Error(shown(value) + " has no IBM float");
  const std::uint32_t sign = std::signbit(value) ? 0x80000000U : 0;
  if (value == 0) return sign;
  int exponent2 = 0;
  std::frexp(value, &exponent2);
  // 16^(exponent16 - 1) <= |value| < 16^exponent16, so that the leading hexadecimal digit is not 0
  int exponent16 = (exponent2 + (exponent2 > 0 ? 3 : 0)) / 4;
  if (exponent16 < -bias) exponent16 = -bias;
  double fraction = std::nearbyint(std::ldexp(std::fabs(value), fraction_bits - 4 * exponent16));
  if (fraction == std::ldexp(1.0, fraction_bits)) {  // rounded up to the next power of 16
    fraction /= 16;
    ++exponent16;
  }
  if (exponent16 >= exponents - bias)
    throw Error(shown(value) + " is beyond the largest IBM float, 7.237e75");
  return sign | static_cast<std::uint32_t>(exponent16 + bias) << fraction_bits |
         static_cast<std::uint32_t>(fraction);
}

}  // namespace slipwave::segy
