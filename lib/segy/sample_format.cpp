#include "segy/sample_format.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace slipwave::segy {
namespace {

constexpr SampleFormat formats[] = {
    {1, 4, "ibm", "4-byte IBM float", 0},
    {2, 4, "int32", "4-byte integer", 0},
    {3, 2, "int16", "2-byte integer", 0},
    {5, 4, "ieee", "4-byte IEEE float", 1},
    {6, 8, "double", "8-byte IEEE float", 2},
    {7, 3, "int24", "3-byte integer", 2},
    {8, 1, "int8", "1-byte integer", 1},
    {9, 8, "int64", "8-byte integer", 2},
    {10, 4, "uint32", "4-byte unsigned integer", 2},
    {11, 2, "uint16", "2-byte unsigned integer", 2},
    {12, 8, "uint64", "8-byte unsigned integer", 2},
    {15, 3, "uint24", "3-byte unsigned integer", 2},
    {16, 1, "uint8", "1-byte unsigned integer", 2},
};

/// load<Bytes>, unrolled by the compiler and turned into a load and a byte swap.
template <int Bytes>
std::uint64_t load(const std::uint8_t* from, Endian endian) {
  std::uint64_t big = 0;
  std::uint64_t little = 0;
  for (int i = 0; i < Bytes; ++i) big = big << 8 | from[i];
  for (int i = Bytes - 1; i >= 0; --i) little = little << 8 | from[i];
  return endian == Endian::big ? big : little;
}

template <int Bytes, class Convert>
void decode_each(const std::uint8_t* from, Endian endian, std::span<double> into, Convert convert) {
  if (endian == Endian::big)
    for (double& sample : into) sample = convert(load<Bytes>(from, Endian::big)), from += Bytes;
  else
    for (double& sample : into) sample = convert(load<Bytes>(from, Endian::little)), from += Bytes;
}

template <int Bytes>
void decode_integers(const std::uint8_t* from, Endian endian, std::span<double> into, bool with_sign) {
  if (with_sign)
    decode_each<Bytes>(from, endian, into,
                       [](std::uint64_t w) { return static_cast<double>(sign_extended(w, Bytes)); });
  else
    decode_each<Bytes>(from, endian, into, [](std::uint64_t w) { return static_cast<double>(w); });
}

template <int Bytes, class Convert>
void encode_each(std::span<const double> samples, Endian endian, std::uint8_t* to, Convert convert) {
  std::size_t i = 0;
  try {
    for (; i < samples.size(); ++i, to += Bytes)
      store_bytes(to, Bytes, endian, static_cast<std::uint64_t>(convert(samples[i])));
  } catch (const Error& error) {
    throw error.within("sample " + std::to_string(i + 1));
  }
}

/// Nearest integer in the range of `bytes` bytes, as the word to store.
std::uint64_t integer_word(double value, int bytes, bool with_sign) {
  const double rounded = std::nearbyint(value);
  const double span = std::ldexp(1.0, 8 * bytes);
  const double lowest = with_sign ? -span / 2 : 0;
  const double beyond = with_sign ? span / 2 : span;  // the upper end itself is one too many
  if (!(rounded >= lowest && rounded < beyond))
    throw Error(shown(value) + " does not fit " + (with_sign ? "a signed" : "an unsigned") + " integer of " +
                std::to_string(8 * bytes) + " bits");
  if (with_sign) return static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded));
  return static_cast<std::uint64_t>(rounded);
}

std::uint32_t float_word(double value) {
  if (!std::isfinite(value)) throw Error(shown(value) + ", expected a finite number");
  // double to float rounds to nearest; the last half unit above the largest float would become infinity
  const float narrowed = std::fabs(value) < 3.5e38 ? static_cast<float>(value) : HUGE_VALF;
  if (!std::isfinite(narrowed)) throw Error(shown(value) + " is beyond the largest IEEE float, 3.403e38");
  return std::bit_cast<std::uint32_t>(narrowed);
}

std::uint64_t double_word(double value) {
  if (!std::isfinite(value)) throw Error(shown(value) + ", expected a finite number");
  return std::bit_cast<std::uint64_t>(value);
}

/// Bytes and sign of the integer formats; {0, false} for the floats.
std::pair<int, bool> integer_kind(int code) {
  switch (code) {
    case 2:
      return {4, true};
    case 3:
      return {2, true};
    case 7:
      return {3, true};
    case 8:
      return {1, true};
    case 9:
      return {8, true};
    case 10:
      return {4, false};
    case 11:
      return {2, false};
    case 12:
      return {8, false};
    case 15:
      return {3, false};
    case 16:
      return {1, false};
    default:
      return {0, false};
  }
}

}  // namespace

const char* name_of(Endian endian) { return endian == Endian::big ? "big" : "little"; }

std::span<const SampleFormat> sample_formats() { return formats; }

const SampleFormat* find_format(std::int64_t code) {
  for (const SampleFormat& format : formats)
    if (format.code == code) return &format;
  return nullptr;
}

const SampleFormat& format_named(const std::string& name) {
  std::string known;
  for (const SampleFormat& format : formats) {
    if (name == format.name || name == std::to_string(format.code)) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw Error("sample format \"" + name + "\", expected one of " + known, ErrorKind::usage);
}

void decode_samples(std::span<const std::uint8_t> bytes, const SampleFormat& format, Endian endian,
                    std::span<double> into) {
  assert(bytes.size() == into.size() * static_cast<std::size_t>(format.bytes));
  const std::uint8_t* const from = bytes.data();
  switch (format.code) {
    case 1:
      return decode_each<4>(from, endian, into,
                            [](std::uint64_t w) { return double_from_ibm(static_cast<std::uint32_t>(w)); });
    case 5:
      return decode_each<4>(from, endian, into, [](std::uint64_t w) {
        return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(w)));
      });
    case 6:
      return decode_each<8>(from, endian, into, [](std::uint64_t w) { return std::bit_cast<double>(w); });
    default:
      break;
  }
  const auto [width, with_sign] = integer_kind(format.code);
  switch (width) {
    case 1:
      return decode_integers<1>(from, endian, into, with_sign);
    case 2:
      return decode_integers<2>(from, endian, into, with_sign);
    case 3:
      return decode_integers<3>(from, endian, into, with_sign);
    case 4:
      return decode_integers<4>(from, endian, into, with_sign);
    default:
      return decode_integers<8>(from, endian, into, with_sign);
  }
}

void encode_samples(std::span<const double> samples, const SampleFormat& format, Endian endian,
                    std::span<std::uint8_t> into) {
  assert(into.size() == samples.size() * static_cast<std::size_t>(format.bytes));
  std::uint8_t* const to = into.data();
  switch (format.code) {
    case 1:
      return encode_each<4>(samples, endian, to, ibm_from_double);
    case 5:
      return encode_each<4>(samples, endian, to, float_word);
    case 6:
      return encode_each<8>(samples, endian, to, double_word);
    default:
      break;
  }
  const auto [width, with_sign] = integer_kind(format.code);
  const auto word = [width = width, with_sign = with_sign](double value) {
    return integer_word(value, width, with_sign);
  };
  switch (width) {
    case 1:
      return encode_each<1>(samples, endian, to, word);
    case 2:
      return encode_each<2>(samples, endian, to, word);
    case 3:
      return encode_each<3>(samples, endian, to, word);
    case 4:
      return encode_each<4>(samples, endian, to, word);
    default:
      return encode_each<8>(samples, endian, to, word);
  }
}

}  // namespace slipwave::segy
