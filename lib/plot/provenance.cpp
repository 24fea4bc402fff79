// SPDX-License-Identifier: BSD-3-Clause
#include "plot/provenance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace slipwave::plot {
namespace {

void append_word(std::string& bytes, std::uint32_t word) {
  for (const int shift : {24, 16, 8, 0}) bytes += char(word >> shift & 0xff);
}

/// ISO 3309, as PNG asks for it.
std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffu;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xedb88320u : sum >> 1;
  }
  return ~sum;
}

std::string chunk(const std::string& kind, const std::string& content) {
  std::string bytes;
  append_word(bytes, std::uint32_t(content.size()));
  bytes += kind + content;
  append_word(bytes, checksum(kind + content));
  return bytes;
}

/// International text: PNG's tEXt is ISO 8859-1 only.
std::string text_chunk(const std::string& key, const std::string& text) {
  const auto zeros = [](std::size_t count) { return std::string(count, char(0)); };
  const bool plain =
      std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
  return plain ? chunk("tEXt", key + zeros(1) + text) : chunk("iTXt", key + zeros(5) + text);
}

std::string in_png(const Page& page) {
  std::string resolution;
  for (int axis = 0; axis < 2; ++axis) append_word(resolution, std::uint32_t(std::lround(page.dpi / 0.0254)));
  std::string chunks = chunk("pHYs", resolution + char(1)) + text_chunk("Software", "slipwave");
  if (!page.title.empty()) chunks += text_chunk("Title", page.title);
  if (!page.history.empty()) chunks += text_chunk("History", page.history);
  return chunks;
}

std::string in_svg(const Page& page) {
  const auto element = [](const std::string& name, const std::string& text) {
    return text.empty() ? std::string() : "<" + name + ">" + xml_text(text) + "</" + name + ">\n";
  };
  return element("title", page.title) + element("desc", page.history);
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else
      escaped += c;
  }
  return escaped;
}

std::vector<char> with_provenance(std::vector<char> bytes, const Page& page) {
  if (page.format == Format::png) {
    constexpr std::ptrdiff_t header = 8 + 25;  // signature and IHDR
    const std::string chunks = in_png(page);
    bytes.insert(bytes.begin() + header, chunks.begin(), chunks.end());
  } else if (page.format == Format::svg) {
    constexpr std::string_view opening = "<svg";
    const auto start = std::search(bytes.begin(), bytes.end(), opening.begin(), opening.end());
    const auto end = std::find(start, bytes.end(), '\n');
    const std::string elements = in_svg(page);
    if (end != bytes.end()) bytes.insert(end + 1, elements.begin(), elements.end());
  }
  return bytes;
}

}  // namespace slipwave::plot
