#include "solver/sweep/surface_tractions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/sweep/free_surface.hpp"
#include "solver/sweep/motion_along.hpp"

namespace slipwave::solver {
namespace {

/// A difference along the surface: offsets in cells and weights.
template <int D>
struct Difference {
  struct Part {
    Index<D> offset;
    double weight;
  };
  std::vector<Part> parts;
};

template <int D>
Difference<D> first_difference(int along) {
  Difference<D> difference;
  for (std::size_t k = 0; k < offsets_along.size(); ++k) {
    Index<D> offset{};
    offset[std::size_t(along)] = offsets_along[k];
    difference.parts.push_back({offset, weights_along[k]});
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
      difference.parts.push_back({offset, weight});
    }
    return difference;
  }
  for (const int one : {-1, 1})
    for (const int two : {-1, 1}) {
      offset[std::size_t(along)] = one, offset[std::size_t(other)] = two;
      difference.parts.push_back({offset, 0.25 * one * two});
    }
  return difference;
}

/// Sums of fields round a cell of the surface.
template <int D>
class Sums {
 public:
  Sums(const Domain<D>& domain, const Index<D>& at) : domain_(domain), at_(at) {}

  /// Adds a difference of a field; false where there is none.
  bool add(const Difference<D>& difference, int row, double factor) {
    for (const auto& part : difference.parts)
      if (!add_term(domain_, at_, part.offset, row, factor * part.weight, terms_)) return false;
    return true;
  }
  const std::vector<SurfaceTerm<D>>& terms() const { return terms_; }

 private:
  const Domain<D>& domain_;
  Index<D> at_;
  std::vector<SurfaceTerm<D>> terms_;
};

/// Shares of the terms of (E11b) and (E11c) over x = (vs/vp)^2: the normal one fitted to the speed of the
/// discrete wave at vp/vs of 1.4 to 8, where all are less in soft rock so that no wave grows. In bent rows
/// there is no tangential one.
struct Shares {
  double normal, tangential, bend;
};
Shares shares_of(double x, bool bent) {
  x = std::max(x, 0.01);
  const double soft = std::min(1., 8 * x);
  const double bend = std::min(1., 3.6 * x);
  if (bent) return {0.85 * soft * (0.2326 - 0.1551 * x - 0.0242 / x), 0, bend};
  return {soft * (0.1689 - 0.0465 * x - 0.0267 / x - 0.1472 * x * x), 0.1, bend};
}

/// Terms of one pair, from a cell of the surface on.
template <int D>
struct PairSums {
  Sums<D> stresses, velocities, bend;
  bool found = true;

  PairSums(const Domain<D>& domain, const Index<D>& at)
      : stresses(domain, at), velocities(domain, at), bend(domain, at) {}
  std::array<const Sums<D>*, 3> lists() const { return {&stresses, &velocities, &bend}; }
  void add(Sums<D>& sums, const Difference<D>& difference, int row, double factor) {
    found = found && sums.add(difference, row, factor);
  }
};

/// Second differences along the surface of the stresses in it. On a bent row those of their horizontal
/// components, which are the contravariant ones along the rows where there is no traction.
template <int D>
PairSums<D> normal_sums(const Domain<D>& domain, const Index<D>& at) {
  using Rows = FieldRows<D>;
  constexpr int z = D - 1;
  PairSums<D> sums(domain, at);
  for (int along = 0; along < z; ++along)
    for (int other = 0; other < z; ++other)
      if (!thin(domain, along) && !thin(domain, other))
        sums.add(sums.stresses, second_difference<D>(along, other),
                 along == other ? Rows::normal_stress(along) : Rows::shear_stress(along, other), 1);
  return sums;
}

/// The difference along an axis of the acceleration across the surface, which its normal stress half a row
/// below it gives; and over lambda what sweeps along it have put there since the step began.
template <int D>
PairSums<D> tangential_sums(const Domain<D>& domain, const Index<D>& at, int side, int along) {
  using Rows = FieldRows<D>;
  constexpr int z = D - 1;
  PairSums<D> sums(domain, at);
  if (thin(domain, along)) return sums;
  const double outward = (side ? 1 : -1) / domain.height(at[z]);
  sums.add(sums.stresses, first_difference<D>(along), Rows::normal_stress(z), 2 * outward);
  for (int other = 0; other < z; ++other)
    if (!thin(domain, other))
      sums.add(sums.velocities, second_difference<D>(along, other), Rows::velocity(other), outward);
  return sums;
}

/// The bend of a component of velocity (E11c): half a step of the difference, along the surface, of the slope
/// that stresses have across it.
template <int D>
void add_bend(const Domain<D>& domain, const Index<D>& at, int side, int component, PairSums<D>& sums) {
  using Rows = FieldRows<D>;
  constexpr int z = D - 1;
  Index<D> second = at;
  second[z] += side ? -1 : 1;
  const double height = domain.height(at[z]);
  const double per_cell = 2 * height / (height + domain.height(second[z]));
  for (int along = 0; along < z; ++along)
    for (const std::int64_t row : {0, 1}) {
      if (thin(domain, along)) continue;
      auto difference = first_difference<D>(along);
      for (auto& part : difference.parts) part.offset[z] = side ? -row : row;
      sums.add(sums.bend, difference,
               component == along
                   ? Rows::normal_stress(along)
                   : Rows::shear_stress(std::min(along, component), std::max(along, component)),
               (row ? -0.5 : 0.5) * per_cell);
    }
}

/// What a normal traction adds to the waves that enter at a face, as the Riemann solution takes them: in bent
/// rows in 2-D along N, times |N|, in 3-D as a vector.
template <int D>
std::array<double, std::size_t(D)> entering_per_normal_traction(const Domain<D>& domain, const Index<D>& at,
                                                                int side) {
  if (!domain.bent(at[D - 1])) return {1};
  const auto normal = end_of_rows(domain, at, side).first;
  if constexpr (D == 2)
    return {std::sqrt(dot(normal, normal)), 0};
  else
    return {normal.z, normal.x, normal.y};
}

/// N of the surface, whose z is 1.
template <int D, class Real>
RowVector<D, Real> surface_normal(const Domain<D>& domain, const Index<D>& at, int side) {
  RowVector<D, Real> normal{};
  normal.z = 1;
  if (!domain.bent(at[D - 1])) return normal;
  const auto found = end_of_rows(domain, at, side).first;
  normal.x = Real(found.x);
  if constexpr (D == 3) normal.y = Real(found.y);
  return normal;
}

/// Whether the extension beyond the surface is corrected there.
template <int D>
bool corrected(const Domain<D>& domain, const Index<D>& at, int side) {
  for (int axis = 0; axis < D; ++axis)
    if ((axis == D - 1 || !thin(domain, axis)) &&
        surface_slope(domain, at, D - 1, side, FieldRows<D>::velocity(axis)).empty())
      return false;
  return true;
}

}  // namespace

template <int D, class Real>
SurfaceTractions<D, Real>::SurfaceTractions(const Layout<D>& layout, const Domain<D>& domain, int side) {
  constexpr int z = D - 1;
  if (domain.edges[z][side] != EdgeLaw::free) return;
  const Layout<D> material(domain.grid.shape, material_rows_of<D>(domain.material_kind()));
  Grid<D> surface = domain.grid;
  surface.shape[z] = 1;
  std::int64_t number = 0;
  for (std::int64_t n = 0; n < surface.size(); ++n) {
    Index<D> at = surface.index(n);
    at[z] = side ? domain.grid.shape[z] - 1 : 0;
    number = (D == 3 ? at[1] * layout.padded_nx() : 0) + at[0];
    if (domain.anisotropic_cell(at) || !corrected(domain, at, side)) continue;
    const bool bent = domain.bent(at[z]);
    std::vector<PairSums<D>> pairs = {normal_sums(domain, at)};
    if (bent) add_bend(domain, at, side, z, pairs[0]);
    for (int along = 0; along < z; ++along) {
      pairs.push_back(bent ? PairSums<D>(domain, at) : tangential_sums(domain, at, side, along));
      if (!thin(domain, along)) add_bend(domain, at, side, along, pairs.back());
    }
    if (!std::all_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair.found; })) continue;
    const double zp = domain.impedance(wave_p)(at), zs = domain.impedance(wave_s)(at);
    const Shares shares = shares_of(zs * zs / (zp * zp), bent);
    Cell cell{number,
              layout.cell(at),
              material.cell(at) + row_b * material.row_pitch(),
              {},
              Real(shares.tangential * zs * zs),
              Real(domain.coupling_at_edge(at, z, 0) * zp * zp),
              Real(shares.bend),
              surface_normal<D, Real>(domain, at, side),
              0};
    const auto entering = entering_per_normal_traction(domain, at, side);
    for (std::size_t pair = 0; pair < D; ++pair)
      cell.normal[pair] = Real(shares.normal * zs * zs * entering[pair]);
    Pattern pattern;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair)
      for (std::size_t list = 0; list < 3; ++list)
        for (const auto& term : pairs[pair].lists()[list]->terms())
          pattern[pair][list].push_back(
              {layout.cell(term.cell) + term.row * layout.row_pitch() - layout.cell(at), Real(term.weight)});
    // Neighbours have the same but at the sides.
    auto found = std::find(patterns_.rbegin(), patterns_.rend(), pattern);
    if (found == patterns_.rend()) {
      patterns_.push_back(std::move(pattern));
      found = patterns_.rbegin();
    }
    cell.pattern = std::int32_t(patterns_.rend() - found - 1);
    cells_.push_back(cell);
  }
  if (cells_.empty()) return;
  for (auto& list : tractions_) list.assign(std::size_t(number + layout.padded_nx()), 0);
  for (auto& list : bends_) list.assign(std::size_t(number + layout.padded_nx()), 0);
}

template <int D, class Real>
std::int64_t SurfaceTractions<D, Real>::memory_bytes() const {
  auto bytes = bytes_of(cells_) + bytes_of(patterns_) + bytes_of(tractions_) + bytes_of(bends_);
  for (const auto& pattern : patterns_)
    for (const auto& of_pair : pattern) bytes += bytes_of(of_pair);
  return bytes;
}

template <int D, class Real>
void SurfaceTractions<D, Real>::update(const State<D, Real>& state, std::int64_t first, std::int64_t last) {
  auto cell = std::lower_bound(cells_.begin(), cells_.end(), first,
                               [](const Cell& one, std::int64_t number) { return one.number < number; });
  for (; cell != cells_.end() && cell->number < last; ++cell) {
    const Real* const fields = state.fields.data() + cell->place;
    const Pattern& pattern = patterns_[std::size_t(cell->pattern)];
    const auto sum = [&](std::size_t pair, std::size_t list) {
      Real total = 0;
      for (const auto& term : pattern[pair][list]) total += term.weight * fields[term.offset];
      return total;
    };
    const auto number = std::size_t(cell->number);
    const Real b = state.material.data()[cell->b], normal = sum(0, 0);
    RowVector<D, Real> bend{};
    bend.z = sum(0, 2), bend.x = sum(1, 2);
    if constexpr (D == 3) bend.y = sum(2, 2);
    // Only the velocity along the surface.
    bend = scaled(cell->direction, Real(0), b * cell->bend, bend);
    bends_[0][number] = bend.z, bends_[1][number] = bend.x;
    if constexpr (D == 3) bends_[2][number] = bend.y;
    for (std::size_t pair = 0; pair < D; ++pair) {
      Real traction = cell->normal[pair] * normal;
      if (pair > 0) traction += cell->tangential * (sum(pair, 0) - b * cell->lambda * sum(pair, 1));
      tractions_[pair][number] = b * b * traction;
    }
  }
}

template class SurfaceTractions<2, float>;
template class SurfaceTractions<2, double>;
template class SurfaceTractions<3, float>;
template class SurfaceTractions<3, double>;

}  // namespace slipwave::solver
