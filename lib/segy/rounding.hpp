// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gather/component.hpp"
#include "segy/sample_format.hpp"

namespace slipwave::segy {

/// What a sample format makes of samples that it rounds, by component: each has a magnitude of its own.
class Rounding {
 public:
  explicit Rounding(const SampleFormat& format) : format_(&format) {}

  /// A trace of that component and the same as it was encoded.
  void see(Component component, std::span<const double> samples, std::span<const std::uint8_t> encoded,
           Endian endian);
  /// Sentences about traces that became zeros and components that the format holds coarsely. Throws Error
  /// where nothing but zeros is left.
  std::vector<std::string> sentences() const;

 private:
  struct OfComponent {
    double largest = 0, squares = 0, squares_lost = 0;
    std::int64_t traces = 0, zeroed = 0;  // that had samples other than 0, and those of them that have none
  };
  std::string remedy(double largest) const;

  const SampleFormat* format_;
  std::map<Component, OfComponent> components_;
  std::vector<double> decoded_;
};

}  // namespace slipwave::segy
