#include "base/nearest.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace slipwave {
namespace {

/// Capitals of ASCII are no mistake worth counting.
char small(char letter) { return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter; }

}  // namespace

std::string nearest_of(const std::vector<std::string>& words, const std::string& word) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : words) {
    // Levenshtein distance, one row at a time; a word begun rightly counts as one slip away.
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (small(word[i - 1]) != small(candidate[j - 1]));
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
      }
    }
    std::size_t distance = row.back();
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
