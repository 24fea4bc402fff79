// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/tilted_contrasts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/instantiate.hpp"

namespace slipwave::solver {
namespace {

/// A symmetric matrix of components along the axes of the grid.
template <int D>
using Tensor = SmallMatrix<std::size_t(D)>;

template <int D>
bool differ(const Tensor<D>& one, const Tensor<D>& other, double ratio) {
  const double square = ratio * ratio;
  return !is_positive(sum_of(times(one, square), other, -1.)) ||
         !is_positive(sum_of(times(other, square), one, -1.));
}

/// Whether waves along an axis of the grid move along one.
template <int D>
bool is_diagonal(const Tensor<D>& tensor) {
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(tensor[i][j]) > rounding * tensor[i][i]) return false;
  return true;
}

/// Rock, not the equivalent TTI cell of an interface.
template <int D>
bool is_rock(const Domain<D>& domain, const Index<D>& cell) {
  const auto* const of = domain.anisotropic_medium(cell);
  return of && !of->mean;
}

/// Returns the contrast of the face between two cells, one of which is tilted rock.
template <int D>
TiltedContrast contrast_of(const Domain<D>& domain, const Index<D>& before, const Index<D>& behind,
                           int axis) {
  const auto& s_waves = domain.impedance(wave_s);
  if (s_waves(before) == 0 || s_waves(behind) == 0) return TiltedContrast::none;
  // The square of impedances along the axis.
  const auto tensor_of = [&](const Index<D>& cell) {
    return christoffel<D>(elasticity_at(domain, cell), unit_vector<std::size_t(D)>(std::size_t(axis)));
  };
  const auto one = tensor_of(before), other = tensor_of(behind);
  if (is_diagonal<D>(one) && is_diagonal<D>(other)) return TiltedContrast::none;
  return differ<D>(one, other, strong_interface_ratio)  ? TiltedContrast::strong
         : differ<D>(one, other, tilted_contrast_ratio) ? TiltedContrast::weak
                                                        : TiltedContrast::none;
}

/// The faces of tilted rock across an axis, by the cell behind them; those of two such cells once.
template <int D>
std::vector<Index<D>> faces_of_rock(const Domain<D>& domain, int axis) {
  const auto along = std::size_t(axis);
  std::vector<Index<D>> faces;
  for (const auto& tilted : domain.anisotropic_cells()) {
    auto at = domain.grid.index(tilted.cell);
    if (!is_rock(domain, at)) continue;
    if (at[along] > 0) faces.push_back(at);
    if (++at[along] < domain.grid.shape[along] && !is_rock(domain, at)) faces.push_back(at);
  }
  return faces;
}

}  // namespace

template <int D>
TiltedContrasts<D> tilted_contrasts(const Domain<D>& domain, int axis, int reach) {
  const auto along = std::size_t(axis);
  TiltedContrasts<D> contrasts;
  std::vector<std::pair<std::int64_t, TiltedContrast>> faces;
  for (const auto& behind : faces_of_rock(domain, axis)) {
    auto near = behind;
    --near[along];
    const auto contrast = contrast_of(domain, near, behind, axis);
    if (contrast == TiltedContrast::none) continue;
    faces.emplace_back(domain.grid.flat(behind), contrast);
    const auto first = std::max<std::int64_t>(behind[along] - reach, 0),
               last = std::min(behind[along] + reach, domain.grid.shape[along]);
    for (near[along] = first; near[along] < last; ++near[along])
      contrasts.near.push_back(domain.grid.flat(near));
  }
  if (faces.empty()) return contrasts;
  std::sort(contrasts.near.begin(), contrasts.near.end());
  contrasts.near.erase(std::unique(contrasts.near.begin(), contrasts.near.end()), contrasts.near.end());
  std::sort(faces.begin(), faces.end());
  contrasts.before = [faces = std::move(faces), grid = domain.grid](const Index<D>& behind) {
    const std::pair wanted{grid.flat(behind), TiltedContrast::none};
    const auto found = std::lower_bound(faces.begin(), faces.end(), wanted);
    return found != faces.end() && found->first == wanted.first ? found->second : TiltedContrast::none;
  };
  return contrasts;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, tilted_contrasts);

}  // namespace slipwave::solver
