// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace slipwave {

/// What happens at an edge of the model.
enum class EdgeLaw : std::uint8_t {
  free,       // no traction: the free surface
  absorbing,  // nothing comes back: a zone of damped cells outside the model, a characteristic edge behind it
  rigid,      // no motion
  mirror,     // a plane of symmetry: no motion across it, no shear traction
};

/// "free", "absorbing", "rigid" or "mirror", as options name it.
constexpr const char* name_of(EdgeLaw law) {
  return law == EdgeLaw::free     ? "free"
         : law == EdgeLaw::rigid  ? "rigid"
         : law == EdgeLaw::mirror ? "mirror"
                                  : "absorbing";
}

/// Laws of the low ([axis][0]) and high ([axis][1]) edges; the low edge of the last axis is the top.
template <int D>
struct EdgeLaws {
  std::array<std::array<EdgeLaw, 2>, D> law{};
  auto& operator[](int axis) { return law[std::size_t(axis)]; }
  const auto& operator[](int axis) const { return law[std::size_t(axis)]; }
};

/// Cells along a free surface that its corrections read beside each.
inline constexpr std::int64_t free_surface_reach = 2;

}  // namespace slipwave
