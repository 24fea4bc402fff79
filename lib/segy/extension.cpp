// SPDX-License-Identifier: BSD-3-Clause
#include "segy/extension.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "segy/text.hpp"

namespace slipwave::segy {

std::optional<ExtensionWords> extension_of(std::span<const std::uint8_t> headers, Endian endian) {
  constexpr std::string_view name = "SEG00001";
  if (headers.size() < ExtensionLayout::size) return std::nullopt;
  const auto first = headers.first<ExtensionLayout::size>();
  const auto named = first.last<name.size()>();
  for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii})
    if (decode_text(named, encoding) == name) return ExtensionWords(first, endian);
  return std::nullopt;
}

double real_or(const std::optional<ExtensionWords>& extension, FieldName<ExtensionLayout> name,
               double standard) {
  if (!extension) return standard;
  const double value = extension->get_real(name);
  return std::isfinite(value) && value != 0 ? value : standard;
}

void set_sampling(std::vector<std::uint8_t>& headers, Endian endian, std::int64_t samples,
                  double interval_us) {
  auto extension = extension_of(headers, endian);
  if (!extension) return;
  if (extension->get("xns") != 0) extension->set("xns", samples);
  if (extension->get_real("xdt") != 0) extension->set_real("xdt", interval_us);
  const auto bytes = extension->in_file_order(endian);
  std::copy(bytes.begin(), bytes.end(), headers.begin());
}

}  // namespace slipwave::segy
