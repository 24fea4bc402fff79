// SPDX-License-Identifier: BSD-3-Clause
#include "model/split_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "model/fracture.hpp"

namespace slipwave {
namespace {

/// A shorter fracture is nothing but tips.
constexpr double fewest_cells = 3;
/// Rows are as high as cells are wide but for so little: what depths lose to rounding.
constexpr double rounding = 1e-6;
/// A tip opens as far as the trace reaches with these springs (S37): fitted to boundary elements.
constexpr double tip_compliance = 4.5, normal_share = 1.2;

/// Springs one behind the other in stiffness: what both leave.
double together(double one_m_per_pa, double other_m_per_pa) {
  if (one_m_per_pa == 0 || other_m_per_pa == 0) return 0;
  return 1 / (1 / one_m_per_pa + 1 / other_m_per_pa);
}

/// A tip that holds back slip on a face with a spring of that compliance: the plane and it are as compliant
/// as the tip where nothing holds the plane, and as both springs where friction does (S42).
double holding(double tip_m_per_pa, double both_m_per_pa) {
  return std::isinf(tip_m_per_pa) ? 0 : 1 / (tip_m_per_pa - both_m_per_pa);
}

/// Returns the friction of a set on faces; the stress of cells on both sides holds for the face between them.
FaceLaw law_of(const Model<2>& model, const SlipSystem<2>& system, int axis,
               const std::array<std::size_t, 2>& cells) {
  FaceLaw law;
  law.friction_law = system.law, law.opens = system.opens;
  if (!law.slides()) return law;
  law.friction = constants_of<2, double>(system, 1);
  if (system.viscosity_s > 0) law.viscosity_s_m = system.viscosity_s / system.compliance.spacing_m;
  if (model.prestress_pa.empty()) return law;
  // Components are sxx, szz, sxz.
  const std::array<std::size_t, 2> components{axis == 0 ? 0U : 1U, 2U};
  for (const std::size_t pair : {0, 1})
    for (const auto cell : cells)
      law.prestress_pa[pair] += double(model.prestress_pa[components[pair]][cell]) / 2;
  return law;
}

/// mu/(1 - nu), by which a static crack in plane strain opens.
double modulus_of_cracks(const Medium<2>& medium, std::size_t cell) {
  const double vs2 = double(medium.vs[cell]) * medium.vs[cell],
               vp2 = double(medium.vp[cell]) * medium.vp[cell];
  return 2 * medium.rho[cell] * vs2 * (vp2 - vs2) / vp2;
}

void add_faces(const Model<2>& model, const FacesOfTrace& of, const SlipSystem<2>& system,
               std::vector<SplitFace<2>>& faces, std::int64_t& left) {
  const auto& compliance = system.compliance;
  const auto& grid = model.grid();
  const auto across = std::size_t(of.axis), along = 1 - across;
  const std::int64_t face = of.face - grid.first[across];
  if (face < 0 || face >= grid.shape[across]) return;
  const auto first = std::max(std::int64_t(std::floor(of.first)), grid.first[along]);
  const auto last = std::min(std::int64_t(std::ceil(of.last)), grid.first[along] + grid.shape[along]);
  for (auto n = first; n < last; ++n) {
    SplitFace<2> one;
    one.axis = of.axis;
    one.behind[across] = face, one.behind[along] = n - grid.first[along];
    // The first row of a part of the model: its face belongs to the part above, too.
    const auto low = std::size_t(grid.flat(one.before())), high = std::size_t(grid.flat(one.behind));
    if (!model.medium.is_solid(low) || !model.medium.is_solid(high)) {
      ++left;
      continue;
    }
    // How far the nearer tip is from the inner end of the face.
    const double inside = std::min(double(n + 1) - of.first, of.last - double(n));
    const double covered = std::min(double(n + 1), of.last) - std::max(double(n), of.first);
    double tip = std::numeric_limits<double>::infinity();
    if (inside < 2)
      tip = tip_compliance * inside / ((2 - inside) * (2 - inside)) * grid.spacing_m * 2 /
            (modulus_of_cracks(model.medium, low) + modulus_of_cracks(model.medium, high));
    const double tip_normal = tip * normal_share, tip_tangential = tip / normal_share;
    one.normal_m_per_pa = together(compliance.normal_m_per_pa * covered, tip_normal);
    one.tangential_m_per_pa = together(compliance.tangential_m_per_pa * covered, tip_tangential);
    one.law = law_of(model, system, of.axis, {low, high});
    if (one.law.opens) one.law.held_pa_m[0] = holding(tip_normal, one.normal_m_per_pa);
    if (one.law.slides()) one.law.held_pa_m[1] = holding(tip_tangential, one.tangential_m_per_pa);
    faces.push_back(one);
  }
}

/// Where a point is, in rows from the top of a model whose rows are not all alike.
double place_in_rows(const Grid<2>& grid, const Point<2>& at) {
  const double row = grid.rows->row_position({grid.in_cells(at)[0], at[1]});
  return std::abs(row - std::round(row)) < rounding ? std::round(row) : row;
}

/// Whether a fracture is above or below the rows there are: it is in another band of cells.
bool lies_outside(const Grid<2>& grid, const FractureTrace<2>& trace) {
  if (!grid.rows) return false;
  const auto [top, bottom] =
      std::minmax({place_in_rows(grid, trace.front()), place_in_rows(grid, trace.back())});
  return bottom < 0 || top > double(grid.rows->cells()[1]);
}

/// Whether the rows that a fracture between these places, counted in rows, crosses and those next to them are
/// level and as high as cells are wide.
bool is_regular(const Grid<2>& grid, double top, double bottom) {
  const auto count = grid.rows->cells()[1];
  const auto first = std::int64_t(std::floor(top)) - 1,
             last = std::min(std::int64_t(std::ceil(bottom)) + 1, count);
  for (auto row = std::max<std::int64_t>(first, 0); row < last; ++row) {
    const double height_m = grid.depth_of_face(row + 1) - grid.depth_of_face(row);
    if (!grid.rows->row_is_level(row) || !grid.rows->row_is_level(row + 1) ||
        std::abs(height_m - grid.spacing_m) > rounding * grid.spacing_m)
      return false;
  }
  return true;
}

void add_faces(const Model<2>& model, const FractureSet<2>& set, std::vector<SplitFace<2>>& faces,
               std::int64_t& left) {
  if (!parts_faces(set)) return;
  for (const auto& trace : set.traces)
    if (!lies_outside(model.grid(), trace))
      add_faces(model, faces_of(model.grid(), trace), set.systems.front(), faces, left);
}

/// Joins fractures that share a face: their compliances add up; strengths do not. Throws an Error where one
/// of them has friction.
void join(const Grid<2>& grid, std::vector<SplitFace<2>>& faces) {
  const auto place = [&](const SplitFace<2>& face) { return std::pair(face.axis, grid.flat(face.behind)); };
  std::stable_sort(faces.begin(), faces.end(),
                   [&](const auto& one, const auto& other) { return place(one) < place(other); });
  std::vector<SplitFace<2>> joined;
  for (const auto& face : faces) {
    if (joined.empty() || place(joined.back()) != place(face)) {
      joined.push_back(face);
      continue;
    }
    if (joined.back().law.any() || face.law.any())
      throw Error("found two fractures on the face before the cell at " +
                  place_of(grid, grid.flat(face.behind)) +
                  ", one of them with friction, expected no other fracture there");
    joined.back().normal_m_per_pa += face.normal_m_per_pa;
    joined.back().tangential_m_per_pa += face.tangential_m_per_pa;
  }
  faces = std::move(joined);
}

}  // namespace

FacesOfTrace faces_of(const Grid<2>& grid, const FractureTrace<2>& trace) {
  const auto refuse = [](const std::string& what) { throw Error(what, ErrorKind::usage); };
  const bool level = trace.front()[1] == trace.back()[1], upright = trace.front()[0] == trace.back()[0];
  if (trace.size() != 2 || level == upright)
    refuse(
        "found a fracture that dips or bends, expected a level or an upright one: only those lie on faces "
        "between cells; give others a --compliance without --open and --faces");
  FacesOfTrace of;
  of.axis = level ? 1 : 0;
  const auto across = std::size_t(of.axis), along = 1 - across;
  const auto in_cells = [&](std::size_t axis, double place_m) {
    if (axis == 0 || !grid.rows) return (place_m - grid.origin_m[axis]) / grid.spacing_m;
    return place_in_rows(grid, {trace.front()[0], place_m});
  };
  const double place_m = trace.front()[across], place = in_cells(across, place_m);
  of.face = std::int64_t(std::lround(place));
  of.moved_m = (double(of.face) - place) * grid.spacing_m;
  of.first = in_cells(along, std::min(trace[0][along], trace[1][along]));
  of.last = in_cells(along, std::max(trace[0][along], trace[1][along]));
  if (of.last - of.first < fewest_cells * (1 - 1e-9))
    refuse("found a fracture of " + shown(of.last - of.first, 3) + " cells on faces, expected at least " +
           shown(fewest_cells));
  const auto [top, bottom] = level ? std::pair(place, place) : std::pair(of.first, of.last);
  if (grid.rows && !is_regular(grid, top, bottom))
    refuse(
        "found a fracture on faces where rows follow a horizon, expected rows there that are level and as "
        "high as cells are wide (--fit none)");
  return of;
}

FacesOfTrace check_on_faces(const Grid<2>& grid, const FractureTrace<2>& trace) {
  const auto of = faces_of(grid, trace);
  if (of.face < 1 || of.face >= grid.shape[std::size_t(of.axis)])
    throw Error(
        "found a fracture on faces along the edge of the model, expected it half a cell or more inside",
        ErrorKind::usage);
  return of;
}

template <>
std::vector<SplitFace<2>> split_faces(const Model<2>& model, std::int64_t* left) {
  std::vector<SplitFace<2>> faces;
  std::int64_t count = 0;
  for (const auto& set : model.fracture_sets) add_faces(model, set, faces, count);
  join(model.grid(), faces);
  if (left) *left = count;
  return faces;
}
template <>
std::vector<SplitFace<3>> split_faces(const Model<3>&, std::int64_t* left) {
  if (left) *left = 0;
  return {};
}
template <>
std::vector<SplitFace<2>> split_faces(const Model<2>& model, const FractureSet<2>& set) {
  std::vector<SplitFace<2>> faces;
  std::int64_t left = 0;
  add_faces(model, set, faces, left);
  return faces;
}
template <>
std::vector<SplitFace<3>> split_faces(const Model<3>&, const FractureSet<3>&) {
  return {};
}

}  // namespace slipwave
