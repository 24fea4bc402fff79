// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/surface_tractions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.hpp"
#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/motion_along.hpp"
#include "solver/sweep/row_waves.hpp"

namespace slipwave::solver {
namespace {

/// A difference along the surface: offsets in cells and weights.
template <int D>
struct Difference {
  struct Part {
    Index<D> offset{};
    double weight = 0;
  };
  std::array<Part, 5> parts{};
  std::size_t count = 0;
  void add(const Index<D>& offset, double weight) { parts[count++] = {offset, weight}; }
};

template <int D>
Difference<D> first_difference(int along) {
  Difference<D> difference;
  for (std::size_t k = 0; k < offsets_along.size(); ++k) {
    Index<D> offset{};
    offset[std::size_t(along)] = offsets_along[k];
    difference.add(offset, weights_along[k]);
  }
  return difference;
}

/// Along two axes; along one the mean of those over two and over four cells.
template <int D>
Difference<D> second_difference(int along, int other) {
  Difference<D> difference;
  Index<D> offset{};
  if (along == other) {
    for (const auto& [cells, weight] : {std::pair{-2, 0.125}, {-1, 0.5}, {0, -1.25}, {1, 0.5}, {2, 0.125}}) {
      offset[std::size_t(along)] = cells;
      difference.add(offset, weight);
    }
    return difference;
  }
  for (const int one : {-1, 1})
    for (const int two : {-1, 1}) {
      offset[std::size_t(along)] = one, offset[std::size_t(other)] = two;
      difference.add(offset, 0.25 * one * two);
    }
  return difference;
}

/// The end of a cell: on a side (0 low, 1 high) of an axis.
struct End {
  int axis, side;
};

/// Sums of fields round a cell of the surface.
template <int D>
class Sums {
 public:
  struct Term {
    SurfaceTerm<D> of;  // in a cell of the surface
    int behind;         // 1: the one behind that
  };
  Sums(const Domain<D>& domain, const Index<D>& at, const End& end) : domain_(domain), at_(at), end_(end) {}

  /// Adds a difference of a field, of the cells of the surface or (1) of those behind; false where there is
  /// none.
  bool add(const Difference<D>& difference, int row, double factor, int behind = 0) {
    for (std::size_t n = 0; n < difference.count; ++n) {
      auto offset = difference.parts[n].offset;
      offset[std::size_t(end_.axis)] += behind * inward();
      auto term = surface_term(domain_, at_, offset, row, factor * difference.parts[n].weight);
      if (!term) return false;
      term->cell[std::size_t(end_.axis)] -= behind * inward();
      if (!ends_at_free_surface(domain_, term->cell, end_.axis, end_.side)) return false;
      terms_.push_back({*term, behind});
    }
    return true;
  }
  const std::vector<Term>& terms() const { return terms_; }

 private:
  std::int64_t inward() const { return end_.side ? -1 : 1; }
  const Domain<D>& domain_;
  Index<D> at_;
  End end_;
  std::vector<Term> terms_;
};

/// Shares of the terms of (E11b) and (E11c) over x = (vs/vp)^2: the normal one fitted to the speed of the
/// discrete wave at vp/vs of 1.4 to 8, where all are less in soft rock so that no wave grows. In curvilinear
/// rows there is no tangential one.
struct Shares {
  double normal, tangential, bend;
};
Shares shares_of(double x, bool curvilinear) {
  x = std::max(x, 0.01);
  const double soft = std::min(1., 8 * x);
  const double bend = std::min(1., 3.6 * x);
  if (curvilinear) return {0.85 * soft * (0.2326 - 0.1551 * x - 0.0242 / x), 0, bend};
  return {soft * (0.1689 - 0.0465 * x - 0.0267 / x - 0.1472 * x * x), 0.1, bend};
}

/// Terms of one pair, from a cell of the surface on.
template <int D>
struct PairSums {
  Sums<D> stresses, velocities, bend;
  bool found = true;

  PairSums(const Domain<D>& domain, const Index<D>& at, const End& end)
      : stresses(domain, at, end), velocities(domain, at, end), bend(domain, at, end) {}
  std::array<const Sums<D>*, 3> lists() const { return {&stresses, &velocities, &bend}; }
  void add(Sums<D>& sums, const Difference<D>& difference, int row, double factor, int behind = 0) {
    found = found && sums.add(difference, row, factor, behind);
  }
};

/// The axes along a surface along which waves may travel.
template <int D>
std::vector<int> axes_along(const Domain<D>& domain, int across) {
  std::vector<int> axes;
  for (int axis = 0; axis < D; ++axis)
    if (axis != across && !thin(domain, axis)) axes.push_back(axis);
  return axes;
}

/// Second differences along the surface of the stresses in it. On a curvilinear row those of their horizontal
/// components, which are the contravariant ones along the rows where there is no traction.
template <int D>
PairSums<D> normal_sums(const Domain<D>& domain, const Index<D>& at, const End& end) {
  PairSums<D> sums(domain, at, end);
  for (const int along : axes_along(domain, end.axis))
    for (const int other : axes_along(domain, end.axis))
      sums.add(sums.stresses, second_difference<D>(along, other), FieldRows<D>::stress(along, other),
               1 / (cell_along(domain, at, along) * cell_along(domain, at, other)));
  return sums;
}

/// The difference along an axis of the acceleration across the surface, which its normal stress half a cell
/// below it gives; and over lambda what sweeps along it have put there since the step began.
template <int D>
PairSums<D> tangential_sums(const Domain<D>& domain, const Index<D>& at, const End& end, int along) {
  using Rows = FieldRows<D>;
  PairSums<D> sums(domain, at, end);
  if (thin(domain, along)) return sums;
  const double outward =
      (end.side ? 1 : -1) / (cell_along(domain, at, end.axis) * cell_along(domain, at, along));
  sums.add(sums.stresses, first_difference<D>(along), Rows::normal_stress(end.axis), 2 * outward);
  for (const int other : axes_along(domain, end.axis))
    sums.add(sums.velocities, second_difference<D>(along, other), Rows::velocity(other),
             outward / cell_along(domain, at, other));
  return sums;
}

/// The bend of a component of velocity (E11c): half a step of the difference, along the surface, of the slope
/// that stresses have across it.
template <int D>
void add_bend(const Domain<D>& domain, const Index<D>& at, const End& end, int component, PairSums<D>& sums) {
  Index<D> second = at;
  second[std::size_t(end.axis)] += end.side ? -1 : 1;
  const double height = cell_along(domain, at, end.axis);
  const double per_cell = 2 * height / (height + cell_along(domain, second, end.axis));
  for (const int along : axes_along(domain, end.axis))
    for (const int behind : {0, 1})
      sums.add(sums.bend, first_difference<D>(along), FieldRows<D>::stress(along, component),
               (behind ? -0.5 : 0.5) * per_cell / cell_along(domain, at, along), behind);
}

/// What a normal traction adds to the waves that enter at a face with the vector N, in the order of pairs, as
/// the Riemann solution takes them: in 2-D along N, times |N|, in 3-D as a vector.
template <int D>
Point<D> entering_per_normal_traction(const Point<D>& normal) {
  return D == 2 ? Point<D>{std::sqrt(dot_product(normal, normal))} : normal;
}

}  // namespace

template <int D, class Real>
SurfaceTractions<D, Real>::SurfaceTractions(int axis, int side, std::int64_t cells)
    : size_(cells), axis_(axis), side_(side) {}

template <int D, class Real>
void SurfaceTractions<D, Real>::add(const Domain<D>& domain, const Index<D>& at, std::int64_t number,
                                    std::int64_t place, std::int64_t b, const Offset& offset) {
  const End end{axis_, side_};
  const bool curvilinear = domain.curvilinear(at[D - 1]);
  if ((curvilinear && axis_ < D - 1) || domain.anisotropic_cell(at)) return;
  std::vector<PairSums<D>> pairs = {normal_sums(domain, at, end)};
  if (curvilinear) add_bend(domain, at, end, axis_, pairs[0]);
  for (int pair = 1; pair < D; ++pair) {
    const int along = axis_of_pair<D>(axis_, pair);
    pairs.push_back(curvilinear ? PairSums<D>(domain, at, end) : tangential_sums(domain, at, end, along));
    if (!thin(domain, along)) add_bend(domain, at, end, along, pairs.back());
  }
  if (!std::all_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair.found; })) return;
  const double zp = domain.impedance(wave_p)(at), zs = domain.impedance(wave_s)(at);
  const Shares shares = shares_of(zs * zs / (zp * zp), curvilinear);
  const auto c = elasticity_at(domain, at);
  const auto surface = in_pairs<D>(surface_at(domain, at, axis_, side_).first, axis_);
  Cell cell{number,
            place,
            b,
            {},
            Real(shares.tangential * zs * zs),
            Real(c.voigt[std::size_t(axis_)][std::size_t(axis_of_pair<D>(axis_, 1))]),
            Real(shares.bend),
            in_numbers<Real>(row_vector<D>(surface)),
            0};
  const auto entering = entering_per_normal_traction<D>(surface);
  for (std::size_t pair = 0; pair < D; ++pair)
    cell.normal[pair] = Real(shares.normal * zs * zs * entering[pair]);
  Pattern pattern;
  for (std::size_t pair = 0; pair < pairs.size(); ++pair)
    for (std::size_t list = 0; list < 3; ++list)
      for (const auto& [of, behind] : pairs[pair].lists()[list]->terms())
        pattern[pair][list].push_back({offset(of.cell, behind, of.row), Real(of.weight)});
  // Neighbours have the same but at the sides.
  const auto [found, is_new] = number_of_pattern_.try_emplace(pattern, std::int32_t(patterns_.size()));
  if (is_new) patterns_.push_back(std::move(pattern));
  cell.pattern = found->second;
  cells_.push_back(cell);
}

template <int D, class Real>
void SurfaceTractions<D, Real>::finish() {
  number_of_pattern_.clear();
  if (cells_.empty()) return;
  for (auto& list : tractions_) list.assign(std::size_t(size_), 0);
  for (auto& list : bends_) list.assign(std::size_t(size_), 0);
}

template <int D, class Real>
std::int64_t SurfaceTractions<D, Real>::memory_bytes() const {
  auto bytes = bytes_of(cells_) + bytes_of(patterns_) + bytes_of(tractions_) + bytes_of(bends_);
  for (const auto& pattern : patterns_)
    for (const auto& of_pair : pattern) bytes += bytes_of(of_pair);
  return bytes;
}

template <int D, class Real>
void SurfaceTractions<D, Real>::update(const Real* all_fields, const Real* material, std::int64_t first,
                                       std::int64_t last) {
  auto cell = std::lower_bound(cells_.begin(), cells_.end(), first,
                               [](const Cell& one, std::int64_t number) { return one.number < number; });
  for (; cell != cells_.end() && cell->number < last; ++cell) {
    const Real* const fields = all_fields + cell->place;
    const Pattern& pattern = patterns_[std::size_t(cell->pattern)];
    const auto sum = [&](std::size_t pair, std::size_t list) {
      Real total = 0;
      for (const auto& term : pattern[pair][list]) total += term.weight * fields[term.offset];
      return total;
    };
    const auto number = std::size_t(cell->number);
    const Real b = material[cell->b], normal = sum(0, 0);
    std::array<Real, std::size_t(D)> bend;
    for (std::size_t pair = 0; pair < D; ++pair) bend[pair] = sum(pair, 2);
    // Only the velocity along the surface.
    bend = components<D>(scaled(cell->direction, Real(0), b * cell->bend, row_vector<D>(bend)));
    for (std::size_t pair = 0; pair < D; ++pair) {
      bends_[pair][number] = bend[pair];
      Real traction = cell->normal[pair] * normal;
      if (pair > 0) traction += cell->tangential * (sum(pair, 0) - b * cell->lambda * sum(pair, 1));
      tractions_[pair][number] = b * b * traction;
    }
  }
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class SurfaceTractions);

}  // namespace slipwave::solver
