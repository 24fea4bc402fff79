// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "segy/ibm_float.hpp"
#include "segy/sample_format.hpp"

namespace slipwave::segy {
namespace {

constexpr std::uint8_t swapped(std::uint8_t word) { return word; }
constexpr std::uint16_t swapped(std::uint16_t word) { return __builtin_bswap16(word); }
constexpr std::uint32_t swapped(std::uint32_t word) { return __builtin_bswap32(word); }
constexpr std::uint64_t swapped(std::uint64_t word) { return __builtin_bswap64(word); }

/// Three bytes have no word of their own: these are the low ones of 32 bits.
struct Word24 {};

template <class Word>
struct Stored {
  using Value = Word;
  static constexpr std::size_t bytes = sizeof(Word);
  template <Endian endian>
  static Word load(const std::uint8_t* from) {
    Word word;
    std::memcpy(&word, from, sizeof word);
    return endian == native_endian ? word : swapped(word);
  }
  template <Endian endian>
  static void store(std::uint8_t* to, Word word) {
    if (endian != native_endian) word = swapped(word);
    std::memcpy(to, &word, sizeof word);
  }
};

template <>
struct Stored<Word24> {
  using Value = std::uint32_t;
  static constexpr std::size_t bytes = 3;
  template <Endian endian>
  static Value load(const std::uint8_t* from) {
    return static_cast<Value>(load_bytes(from, 3, endian));
  }
  template <Endian endian>
  static void store(std::uint8_t* to, Value word) {
    store_bytes(to, 3, endian, word);
  }
};

template <class Word, Endian endian, class Convert>
void decode_in(const std::uint8_t* from, std::span<double> into, Convert convert) {
  double* const to = into.data();
  const std::size_t count = into.size();
  for (std::size_t i = 0; i < count; ++i)
    to[i] = convert(Stored<Word>::template load<endian>(from + i * Stored<Word>::bytes));
}

template <class Word, class Convert>
void decode(const std::uint8_t* from, Endian endian, std::span<double> into, Convert convert) {
  if (endian == Endian::big)
    decode_in<Word, Endian::big>(from, into, convert);
  else
    decode_in<Word, Endian::little>(from, into, convert);
}

/// A sample on its way out: whether the format holds it, and the word.
template <class Value>
struct Encoded {
  Value word;
  bool fits;
};

/// All of them without a branch; where one did not fit, the first such is looked for. Returns its index, or
/// the number of samples.
template <class Word, Endian endian, class Convert>
std::size_t encode_in(std::span<const double> samples, std::uint8_t* to, Convert convert) {
  bool all = true;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto encoded = convert(samples[i]);
    all &= encoded.fits;
    Stored<Word>::template store<endian>(to + i * Stored<Word>::bytes, encoded.word);
  }
  if (all) return samples.size();
  std::size_t first = 0;
  while (convert(samples[first]).fits) ++first;
  return first;
}

template <class Word, class Convert>
std::size_t encode(std::span<const double> samples, Endian endian, std::uint8_t* to, Convert convert) {
  return endian == Endian::big ? encode_in<Word, Endian::big>(samples, to, convert)
                               : encode_in<Word, Endian::little>(samples, to, convert);
}

/// double to float rounds to nearest; from half a unit above the largest float on it gives infinity.
Encoded<std::uint32_t> float_word(double value) {
  const bool fits = std::fabs(value) < 0x1.ffffffp127;
  return {std::bit_cast<std::uint32_t>(static_cast<float>(fits ? value : 0.0)), fits};
}

Encoded<std::uint64_t> double_word(double value) {
  return {std::bit_cast<std::uint64_t>(value), std::fabs(value) <= std::numeric_limits<double>::max()};
}

/// Nearest integer, ties to even. Adding 2^52 + 2^51 and taking it off rounds what 52 bits hold.
template <int Bits, bool Signed>
struct ToInteger {
  Encoded<std::uint32_t> operator()(double value) const {
    constexpr double magic = 0x1.8p52;
    constexpr double lowest = Signed ? -0x1p0 * (std::uint64_t{1} << (Bits - 1)) : 0.0;
    constexpr double beyond = static_cast<double>(std::uint64_t{1} << (Signed ? Bits - 1 : Bits));
    const double rounded = value + magic - magic;
    const bool fits = rounded >= lowest && rounded < beyond && std::fabs(value) < 0x1p40;
    const double held = fits ? rounded : 0.0;
    return {Signed ? static_cast<std::uint32_t>(static_cast<std::int32_t>(held))
                   : static_cast<std::uint32_t>(static_cast<std::int64_t>(held)),
            fits};
  }
};

template <bool Signed>
Encoded<std::uint64_t> long_word(double value) {
  const double rounded = std::nearbyint(value);
  const bool fits = rounded >= (Signed ? -0x1p63 : 0.0) && rounded < (Signed ? 0x1p63 : 0x1p64);
  const double held = fits ? rounded : 0.0;
  return {
      Signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(held)) : static_cast<std::uint64_t>(held),
      fits};
}

template <class Word, int Bits, bool Signed>
std::size_t encode_integers(std::span<const double> samples, Endian endian, std::uint8_t* to) {
  using Value = typename Stored<Word>::Value;
  return encode<Word>(samples, endian, to, [](double value) {
    const auto encoded = ToInteger<Bits, Signed>{}(value);
    return Encoded<Value>{static_cast<Value>(encoded.word), encoded.fits};
  });
}

/// Index of the first sample that does not fit, or samples.size().
std::size_t encode_all(std::span<const double> samples, int code, Endian endian, std::uint8_t* to) {
  switch (code) {
    case 1:
      return encode<std::uint32_t>(samples, endian, to, ibm_word_of);
    case 2:
      return encode_integers<std::uint32_t, 32, true>(samples, endian, to);
    case 3:
      return encode_integers<std::uint16_t, 16, true>(samples, endian, to);
    case 5:
      return encode<std::uint32_t>(samples, endian, to, float_word);
    case 6:
      return encode<std::uint64_t>(samples, endian, to, double_word);
    case 7:
      return encode_integers<Word24, 24, true>(samples, endian, to);
    case 8:
      return encode_integers<std::uint8_t, 8, true>(samples, endian, to);
    case 9:
      return encode<std::uint64_t>(samples, endian, to, long_word<true>);
    case 10:
      return encode_integers<std::uint32_t, 32, false>(samples, endian, to);
    case 11:
      return encode_integers<std::uint16_t, 16, false>(samples, endian, to);
    case 12:
      return encode<std::uint64_t>(samples, endian, to, long_word<false>);
    case 15:
      return encode_integers<Word24, 24, false>(samples, endian, to);
    default:
      return encode_integers<std::uint8_t, 8, false>(samples, endian, to);
  }
}

std::string why_not(double value, const SampleFormat& format) {
  if (!std::isfinite(value)) return shown(value) + ", expected a finite number";
  if (format.code == 1) return shown(value) + " is beyond the largest IBM float, 7.237e75";
  if (format.code == 5) return shown(value) + " is beyond the largest IEEE float, 3.403e38";
  return shown(value) + " does not fit " + (format.code >= 10 ? "an unsigned" : "a signed") + " integer of " +
         std::to_string(8 * format.bytes) + " bits";
}

/// Index of the first word all of whose exponent bits are set, or count.
template <class Word>
std::size_t first_special(const std::uint8_t* from, std::size_t count, Endian endian, Word exponent) {
  const Word mask = endian == native_endian ? exponent : swapped(exponent);
  const auto is_special = [&](std::size_t i) {
    Word word;
    std::memcpy(&word, from + i * sizeof word, sizeof word);
    return (word & mask) == mask;
  };
  Word any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= is_special(i) ? Word{1} : Word{0};
  if (any == 0) return count;
  std::size_t first = 0;
  while (!is_special(first)) ++first;
  return first;
}

}  // namespace

double double_from_ibm(std::uint32_t word) { return double_of_ibm_word(word); }

std::uint32_t ibm_from_double(double value) {
  const IbmWord ibm = ibm_word_of(value);
  if (!ibm.fits) throw Error(why_not(value, *find_format(1)));
  return ibm.word;
}

void decode_samples(std::span<const std::uint8_t> bytes, const SampleFormat& format, Endian endian,
                    std::span<double> into) {
  assert(bytes.size() == into.size() * static_cast<std::size_t>(format.bytes));
  const std::uint8_t* const from = bytes.data();
  switch (format.code) {
    case 1:
      return decode<std::uint32_t>(from, endian, into, double_of_ibm_word);
    case 2:
      return decode<std::uint32_t>(from, endian, into, [](auto w) { return double(std::int32_t(w)); });
    case 3:
      return decode<std::uint16_t>(from, endian, into, [](auto w) { return double(std::int16_t(w)); });
    case 5:
      return decode<std::uint32_t>(from, endian, into,
                                   [](auto w) { return double(std::bit_cast<float>(w)); });
    case 6:
      return decode<std::uint64_t>(from, endian, into, [](auto w) { return std::bit_cast<double>(w); });
    case 7:
      return decode<Word24>(from, endian, into, [](auto w) { return double(std::int32_t(w << 8) >> 8); });
    case 8:
      return decode<std::uint8_t>(from, endian, into, [](auto w) { return double(std::int8_t(w)); });
    case 9:
      return decode<std::uint64_t>(from, endian, into, [](auto w) { return double(std::int64_t(w)); });
    case 11:
      return decode<std::uint16_t>(from, endian, into, [](auto w) { return double(w); });
    case 12:
      return decode<std::uint64_t>(from, endian, into, [](auto w) { return double(w); });
    case 15:
      return decode<Word24>(from, endian, into, [](auto w) { return double(w); });
    case 16:
      return decode<std::uint8_t>(from, endian, into, [](auto w) { return double(w); });
    default:
      return decode<std::uint32_t>(from, endian, into, [](auto w) { return double(w); });
  }
}

void encode_samples(std::span<const double> samples, const SampleFormat& format, Endian endian,
                    std::span<std::uint8_t> into) {
  assert(into.size() == samples.size() * static_cast<std::size_t>(format.bytes));
  const std::size_t first = encode_all(samples, format.code, endian, into.data());
  if (first < samples.size())
    throw Error("sample " + std::to_string(first + 1) + ": " + why_not(samples[first], format));
}

void check_samples(std::span<const std::uint8_t> bytes, const SampleFormat& format, Endian endian) {
  const std::size_t count = bytes.size() / static_cast<std::size_t>(format.bytes);
  std::size_t first = count;
  if (format.code == 5) first = first_special<std::uint32_t>(bytes.data(), count, endian, 0x7f800000);
  if (format.code == 6) first = first_special<std::uint64_t>(bytes.data(), count, endian, 0x7ff0000000000000);
  if (first == count) return;
  std::vector<double> value(1);
  const auto width = static_cast<std::size_t>(format.bytes);
  decode_samples(bytes.subspan(first * width, width), format, endian, value);
  throw Error("sample " + std::to_string(first + 1) + ": " + why_not(value[0], format));
}

}  // namespace slipwave::segy
