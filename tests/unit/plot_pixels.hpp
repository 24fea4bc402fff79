// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace slipwave {

/// A PNG as libpng reads it.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;  // red, green, blue

  std::uint32_t at(int x, int y) const {
    const auto* pixel = bytes.data() + 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
    return std::uint32_t(pixel[0]) << 16 | std::uint32_t(pixel[1]) << 8 | pixel[2];
  }
  bool operator==(const Pixels&) const = default;
};

inline Pixels decoded(const std::vector<char>& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Pixels pixels;
  if (!png_image_begin_read_from_memory(&image, png.data(), png.size())) {
    ADD_FAILURE() << "no PNG: " << image.message;
    return pixels;
  }
  image.format = PNG_FORMAT_RGB;
  pixels.width = int(image.width);
  pixels.height = int(image.height);
  pixels.bytes.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, pixels.bytes.data(), 0, nullptr))
    ADD_FAILURE() << "damaged PNG: " << image.message;
  return pixels;
}

/// The pixels of a colour, 0xRRGGBB: how many, and between which columns and rows they lie.
struct Patch {
  std::int64_t count = 0;
  int left = 0, right = -1, top = 0, bottom = -1;  // ends included
};

inline Patch patch_where(const Pixels& pixels, const std::function<bool(std::uint32_t)>& is) {
  Patch patch{0, pixels.width, -1, pixels.height, -1};
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      if (!is(pixels.at(x, y))) continue;
      ++patch.count;
      patch.left = std::min(patch.left, x);
      patch.right = std::max(patch.right, x);
      patch.top = std::min(patch.top, y);
      patch.bottom = std::max(patch.bottom, y);
    }
  }
  return patch;
}

/// The same colour to rounding.
inline bool alike(std::uint32_t one, std::uint32_t other) {
  const auto near = [&](int shift) {
    return std::abs(int(one >> shift & 0xff) - int(other >> shift & 0xff)) <= 2;
  };
  return near(16) && near(8) && near(0);
}

/// Of an area of that colour: pixels all of whose neighbours have it, and these neighbours. Edges of letters,
/// which come in every grey, are none.
inline Patch patch_of(const Pixels& pixels, std::uint32_t colour) {
  Patch patch{0, pixels.width, -1, pixels.height, -1};
  for (int y = 1; y + 1 < pixels.height; ++y) {
    for (int x = 1; x + 1 < pixels.width; ++x) {
      bool solid = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) solid = solid && pixels.at(x + dx, y + dy) == colour;
      }
      if (!solid) continue;
      ++patch.count;
      patch = {patch.count, std::min(patch.left, x - 1), std::max(patch.right, x + 1),
               std::min(patch.top, y - 1), std::max(patch.bottom, y + 1)};
    }
  }
  return patch;
}

}  // namespace slipwave
