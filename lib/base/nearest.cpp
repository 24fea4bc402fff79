// SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace slipwave {
namespace {

/// Capitals of ASCII are no mistake worth counting.
char small(char letter) { return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter; }

/// How many letters have to be put in, left out, replaced or swapped with the next (optimal string
/// alignment).
std::size_t slips(const std::string& word, const std::string& wanted) {
  std::vector<std::size_t> before, above(wanted.size() + 1), row(wanted.size() + 1);
  std::iota(above.begin(), above.end(), 0);
  for (std::size_t i = 1; i <= word.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= wanted.size(); ++j) {
      const char here = small(word[i - 1]), there = small(wanted[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (here != there)});
      const bool swapped = i > 1 && j > 1 && here == small(wanted[j - 2]) && small(word[i - 2]) == there;
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above.back();
}

}  // namespace

std::string nearest_of(const std::vector<std::string>& words, const std::string& word) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : words) {
    std::size_t distance = slips(word, candidate);
    // A word begun rightly counts as one slip away.
    if (word.size() >= 2 && candidate.compare(0, word.size(), word) == 0)
      distance = std::min<std::size_t>(distance, 1);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace slipwave
