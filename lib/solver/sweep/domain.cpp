// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/tensor.hpp"
#include "parallel/threads.hpp"
#include "rock/coefficients.hpp"
#include "scene/subdomains.hpp"

namespace slipwave::solver {
namespace {

/// Impedance of the ghost beyond an edge, as a factor on that of the cell before it: 0 means no traction.
int ghost_impedance(EdgeLaw law, Wave wave) {
  return extension_of(law, wave) == Extension::traction_free ? 0 : 1;
}

/// Shorter uniform runs are not worth loops of their own.
constexpr std::int64_t shortest_run = 64;

/// Depth in m of a corner in the columns of the model, counted in the corners of the whole model.
template <int D>
double depth_in_column(const Domain<D>& domain, Index<D> corner) {
  const auto& rows = *domain.model_grid.rows;
  const std::int64_t at = corner[D - 1];
  const std::int64_t nearest = std::clamp<std::int64_t>(at, 0, rows.cells()[D - 1]);
  corner[D - 1] = nearest;
  const double edge = rows.corner(corner);
  if (at == nearest) return edge;
  // Rows beyond level ones are as high as they: a column of them is what plane waves enter by (Column).
  corner[D - 1] += at < 0 ? 1 : -1;
  const bool level = domain.level_ends[at < 0 ? 0 : 1];
  return edge + double(at - nearest) * (level ? std::abs(edge - rows.corner(corner)) : domain.grid.spacing_m);
}

/// A corner beyond a side of the model: on which side of an axis (0 low, 1 high), and by how many columns.
struct BeyondSide {
  int axis, side;
  std::int64_t away;
};

/// Depth there in m, from that of the last column of the model, and of the one before it: columns continue as
/// `side_rows` says (theory.md (F10)).
template <int D>
double depth_beyond(const Domain<D>& domain, const BeyondSide& of, double depth, double before) {
  const double slope = depth - before;
  const auto& [straight, bend] = domain.side_rows[std::size_t(of.axis)][std::size_t(of.side)];
  const double away = double(of.away);
  // Of what bends, the integral of (1 - t/bend)^2.
  const double left = std::clamp(1 - (away - straight) / bend, 0., 1.);
  return depth + slope * (std::min(away, straight) + bend / 3 * (1 - left * left * left));
}

/// Depth in m of a corner counted in those of the whole model, from `axis` on.
template <int D>
double corner_of_rows(const Domain<D>& domain, Index<D> corner, int axis) {
  if (axis == D - 1) return depth_in_column(domain, corner);
  auto& place = corner[std::size_t(axis)];
  const std::int64_t at = place;
  place = std::clamp<std::int64_t>(at, 0, domain.model_grid.rows->cells()[std::size_t(axis)]);
  const BeyondSide beyond{axis, at < 0 ? 0 : 1, std::abs(at - place)};
  const double depth = corner_of_rows(domain, corner, axis + 1);
  if (beyond.away == 0) return depth;
  place += at < 0 ? 1 : -1;
  return depth_beyond(domain, beyond, depth, corner_of_rows(domain, corner, axis + 1));
}

/// How much faster waves cross a cell of the model's or of a zone's rows than a regular one; infinite where
/// rows fold.
template <int D>
double stretch_of_cell(const Domain<D>& domain, const Index<D>& at) {
  constexpr int corners = 1 << D, z = 1 << (D - 1);
  std::array<double, std::size_t(corners)> depth{};
  double least = std::numeric_limits<double>::infinity(), height = 0, square = 1;
  for (int n = 0; n < corners; ++n) {
    Index<D> corner = at;
    for (int axis = 0; axis < D; ++axis) corner[std::size_t(axis)] += (n >> axis) & 1;
    depth[std::size_t(n)] = corner_depth(domain, corner);
    if (n < z) continue;
    const double edge = depth[std::size_t(n)] - depth[std::size_t(n - z)];
    least = std::min(least, edge);
    height += edge / z;
  }
  if (least <= 0) return std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < D - 1; ++axis) {
    double slope = 0;
    for (int n = 0; n < corners; ++n) slope += ((n >> axis) & 1 ? 1 : -1) * depth[std::size_t(n)] / z;
    square += slope * slope;
  }
  return std::sqrt(square) / height;
}

/// How much lower rows beyond a side may become than beside it, but for the time step; void cells have none.
constexpr double least_room = 1.02, room = 1.5, room_of_void = 10;

/// Finds how rows continue beyond the sides: straight through the zone, where waves are absorbed before they
/// can come back from a bend, or as far as no row becomes so low that the time step of the model is too long.
template <int D>
class SideRowsFinder {
 public:
  SideRowsFinder(Domain<D>& domain, const Medium<D>& medium, double longer_steps)
      : domain_(domain),
        fastest_(longer_steps * fastest_across_cells(medium, domain.subdomain)),
        speeds_(domain.subdomain.is_whole() ? side_speeds(medium, domain.subdomain)
                                            : domain.subdomain.side_speeds) {}
  void find() {
    for (int axis = 0; axis < D - 1; ++axis)
      for (const int side : {0, 1}) {
        auto& rows = domain_.side_rows[std::size_t(axis)][std::size_t(side)];
        rows.straight = double(zone(axis, side));
        while ((rows.straight > 0 || rows.bend > 0.5) && !keeps_heights(axis, side))
          if (rows.straight >= 1)
            rows.straight = std::floor(0.7 * rows.straight);
          else
            rows.bend *= 0.7;
      }
  }

 private:
  std::int64_t zone(int axis, int side) const {
    return (side ? domain_.high_zone : domain_.low_zone)[std::size_t(axis)];
  }
  /// Whether rows are level along an axis where they leave the model on a side, at a cell whose place along
  /// that axis does not count: beyond the side they stay as they are.
  bool is_level(Index<D> at, int axis, int side) const {
    const auto& rows = *domain_.model_grid.rows;
    for (int other = 0; other < D; ++other) at[std::size_t(other)] -= domain_.low_zone[other];
    for (int n = 0; n < 1 << D; ++n) {
      auto corner = at;
      for (int other = 0; other < D; ++other) corner[std::size_t(other)] += n >> other & 1;
      auto& place = corner[std::size_t(axis)];
      place = side ? rows.cells()[std::size_t(axis)] : 0;
      const double edge = rows.corner(corner);
      place += side ? -1 : 1;
      if (rows.corner(corner) != edge) return false;
    }
    return true;
  }
  bool keeps_heights(int axis, int side) const {
    Index<D> shape = domain_.model_grid.rows->cells();
    shape[std::size_t(axis)] = 1;
    const auto& speeds = speeds_[std::size_t(axis)][std::size_t(side)];
    for (std::size_t n = 0; n < speeds.size(); ++n) {
      Index<D> at{};
      for (std::int64_t rest = std::int64_t(n), other = 0; other < D; ++other) {
        at[std::size_t(other)] = rest % shape[std::size_t(other)] + domain_.low_zone[int(other)];
        rest /= shape[std::size_t(other)];
      }
      if (is_level(at, axis, side)) continue;
      // Counted in the rows that are held.
      at[D - 1] -= domain_.model_grid.first[D - 1];
      const std::int64_t edge = side ? domain_.model_grid.shape[axis] - 1 : 0;
      const auto stretch = [&](std::int64_t away) {
        at[std::size_t(axis)] = domain_.low_zone[axis] + edge + (side ? away : -away);
        return stretch_of_cell(domain_, at);
      };
      const double own = stretch(0);
      const double largest = speeds[n] > 0
                                 ? std::max(least_room * own, std::min(room * own, fastest_ / speeds[n]))
                                 : room_of_void * own;
      // Heights change steadily while rows are straight, and where they bend within ten columns.
      const auto straight = std::int64_t(domain_.side_rows[std::size_t(axis)][std::size_t(side)].straight);
      for (const std::int64_t away : {1, 2, 4, 7, 10})
        if (stretch(away) > largest ||
            (straight + away <= zone(axis, side) && stretch(straight + away) > largest))
          return false;
      if (stretch(zone(axis, side)) > largest) return false;
    }
    return true;
  }

  Domain<D>& domain_;
  double fastest_;                                            // that the time step allows in regular cells
  std::array<std::array<std::vector<double>, 2>, 2> speeds_;  // of the whole model
};

/// Finds curvilinear rows, and the heights of others.
template <int D>
void find_curvilinear_rows(Domain<D>& domain) {
  if (!domain.model_grid.rows) return;
  const auto& rows = *domain.model_grid.rows;
  const std::int64_t count = domain.grid.shape[D - 1];
  const auto last = rows.cells()[D - 1];
  domain.level_ends = {rows.row_is_level(0) && rows.row_is_level(1),
                       rows.row_is_level(last) && rows.row_is_level(last - 1)};
  std::vector<char> level(std::size_t(count) + 1, 0);
  for (std::int64_t k = 0; k <= count; ++k) {
    const auto of_model = k - domain.low_zone[D - 1] + domain.model_grid.first[D - 1];
    level[std::size_t(k)] = rows.row_is_level(std::clamp<std::int64_t>(of_model, 0, rows.cells()[D - 1]));
  }
  const std::int64_t near = nearness_of(domain.order);
  domain.curvilinear_rows.assign(std::size_t(count), 0);
  domain.row_heights.assign(std::size_t(count), 1);
  for (std::int64_t k = 0; k < count; ++k) {
    auto& curvilinear = domain.curvilinear_rows[std::size_t(k)];
    for (std::int64_t n = k - near; n <= k + near + 1; ++n)
      curvilinear = char(curvilinear || !level[std::size_t(std::clamp<std::int64_t>(n, 0, count))]);
    if (curvilinear) continue;
    Index<D> upper{}, lower{};
    upper[D - 1] = k, lower[D - 1] = k + 1;
    domain.row_heights[std::size_t(k)] = corner_depth(domain, lower) - corner_depth(domain, upper);
  }
  for (const int side : {0, 1})
    if (domain.edges[D - 1][side] == EdgeLaw::mirror && !level[std::size_t(side ? count : 0)])
      throw Error("found a mirror along rows that are not level, expected another edge", ErrorKind::usage);
  if (std::none_of(domain.curvilinear_rows.begin(), domain.curvilinear_rows.end(),
                   [](char curvilinear) { return curvilinear; }))
    domain.curvilinear_rows.clear();
}

/// Impedances beside a tilted mean differ by no more: beyond, the reconstruction across its faces can feed
/// waves with energy.
constexpr double strongest_tilted = 4;

/// Whether impedances of a wave that all carry differ by more about a cell.
bool contrast_is_too_strong(const Domain<2>& domain, const Index<2>& at) {
  for (const Wave wave : {wave_p, wave_s}) {
    const auto& impedance = domain.impedance(wave);
    double least = std::numeric_limits<double>::max(), largest = 0;
    for (std::int64_t k = at[1] - 1; k <= at[1] + 1; ++k)
      for (std::int64_t i = at[0] - 1; i <= at[0] + 1; ++i) {
        if (i < 0 || k < 0 || i >= domain.grid.shape[0] || k >= domain.grid.shape[1]) continue;
        const double one = impedance(Index<2>{i, k});
        if (one == 0) continue;
        least = std::min(least, one), largest = std::max(largest, one);
      }
    if (largest > strongest_tilted * least) return true;
  }
  return false;
}

/// Less, as a share of c33, is rounding.
constexpr double least_coupling = 1e-12;

/// Whether sweeps along the grid couple the pairs of a medium: axes turned by right angles do not.
template <int D>
bool couples_pairs(const Elasticity<D>& c) {
  const auto along_grid = c.along_grid();
  for (std::size_t i = 0; i < c.components; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(c.voigt[i][j] - along_grid.voigt[i][j]) > least_coupling * c(3, 3)) return true;
  return false;
}

/// Numbers the distinct media of anisotropic cells.
template <int D>
class AnisotropicMedia {
 public:
  /// `mean`: an equivalent TTI cell; `curvilinear`: in curvilinear rows.
  std::int32_t number(const Material& material, bool mean, bool curvilinear) {
    const auto extra =
        material.orthorhombic.value_or(Orthorhombic{material.epsilon, material.delta, 0, material.gamma});
    const auto constants = material.constants.values();
    Key key{material.vp,    material.vs,   material.rho,     material.epsilon,  material.delta,
            material.gamma, material.tilt, material.azimuth, material.rotation, extra.epsilon1,
            extra.delta1,   extra.delta3,  extra.gamma2,     double(mean),      double(curvilinear)};
    std::copy_backward(constants.begin(), constants.end(), key.end());
    if (key == last_ && !media_.empty()) return number_;
    last_ = key;
    const auto [found, is_new] = numbers_.try_emplace(key, std::int32_t(media_.size()));
    if (is_new) {
      const auto c = elasticity_of<D>(material);
      const double p = material.rho * material.vp * material.vp,
                   mu = material.rho * material.vs * material.vs;
      media_.push_back({material.rho, c,
                        curvilinear ? isotropic<D>(c(3, 3), c(5, 5))
                        : mean      ? isotropic<D>(p, mu)
                                    : c.along_grid(),
                        couples_pairs(c), mean});
    }
    return number_ = found->second;
  }
  const AnisotropicMedium<D>& operator[](std::int32_t number) const { return media_[std::size_t(number)]; }
  std::vector<AnisotropicMedium<D>> take() { return std::move(media_); }

 private:
  using Key = std::array<double, 15 + std::tuple_size_v<ElasticConstants>>;
  std::map<Key, std::int32_t> numbers_;
  std::vector<AnisotropicMedium<D>> media_;
  Key last_{};
  std::int32_t number_ = 0;
};

/// Rock continues beyond the edges of the model as it is. In level rows sweeps need no more of some than
/// their stiffnesses along the grid.
template <int D>
void find_anisotropic_cells(Domain<D>& domain, const Medium<D>& medium) {
  AnisotropicMedia<D> media;
  std::vector<AnisotropicCell> cells;
  const bool any = any_tilted_axes(medium) || (domain.anisotropic() && !domain.curvilinear_rows.empty());
  for (std::int64_t n = 0; any && n < domain.grid.size(); ++n) {
    const auto at = domain.grid.index(n);
    const auto cell = std::size_t(domain.model_grid.flat(domain.model_cell(at)));
    const bool curvilinear = domain.curvilinear(at[D - 1]);
    if (!has_tilted_axis(medium, cell) && !(curvilinear && is_anisotropic(medium, cell))) continue;
    const auto of = media.number(material_of(medium, cell), false, curvilinear);
    if (curvilinear || media[of].turned) cells.push_back({n, of});
  }
  if constexpr (D == 2) {
    const std::int64_t last = domain.grid.shape[1] - 1;
    for (const auto cell : cells_of_tilted_means(medium)) {
      const auto at = domain.computed_cell(domain.model_grid.index(std::int64_t(cell)));
      if (domain.curvilinear(std::max<std::int64_t>(at[1] - 1, 0)) || domain.curvilinear(at[1]) ||
          domain.curvilinear(std::min(at[1] + 1, last)) || contrast_is_too_strong(domain, at))
        continue;
      cells.push_back({domain.grid.flat(at), media.number(tilted_mean_of(medium, cell), true, false)});
    }
    std::sort(cells.begin(), cells.end(),
              [](const auto& one, const auto& other) { return one.cell < other.cell; });
  }
  domain.set_anisotropic_cells(std::move(cells), media.take());
}

/// The run of cells first <= x < last of a row that are like the first.
template <int D, class Real>
UniformRun<Real> run_of(const State<D, Real>& state, const Index<D>& line, std::int64_t first,
                        std::int64_t last) {
  const auto value = [&](int row) { return state.material_row(line, row)[first]; };
  const auto kind = state.kind;
  UniformRun<Real> run{first, last, value(row_b), value(row_zp), state.fluid ? Real(0) : value(row_zs)};
  if (!state.anisotropic) return run;
  run.zp_across = value(row_zp_across), run.coupling = value(row_coupling);
  if constexpr (D == 3) {
    run.zs_level = value(s_row<D>(kind, 0, 1)), run.coupling_level = value(coupling_row<D>(kind, 0, 1));
    run.zp_y = value(p_row<D>(kind, 1)), run.zs_y = value(s_row<D>(kind, 1, 2));
    run.coupling_y = value(coupling_row<D>(kind, 1, 2));
  }
  return run;
}

/// On both sides of split faces, ascending: their faces are not those of one material.
template <int D>
std::vector<std::int64_t> cells_beside_split(const Domain<D>& domain) {
  std::vector<std::int64_t> cells;
  for (const auto& face : domain.split) {
    auto before = face.behind;
    if (before[std::size_t(face.axis)] > 0) --before[std::size_t(face.axis)];
    for (const auto& at : {before, face.behind}) cells.push_back(domain.grid.flat(at));
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <int D, class Real>
void find_uniform_runs(State<D, Real>& state, const Domain<D>& domain) {
  const std::int64_t nx = state.layout.shape()[0];
  const auto same_anisotropy = [&](const Index<D>& line, std::int64_t i, std::int64_t j) {
    for (int row = row_zp_across; row < state.material_layout.rows(); ++row)
      if (state.material_row(line, row)[i] != state.material_row(line, row)[j]) return false;
    return true;
  };
  const auto& anisotropic = domain.anisotropic_cells();
  std::vector<char> own_loops(std::size_t(nx), 1);
  const auto split = cells_beside_split(domain);
  auto next_split = split.begin();
  auto next = anisotropic.begin();
  for (std::int64_t line = 0; line < state.layout.lines(); ++line) {
    const auto at = state.layout.line_index(line);
    const auto material = state.material_from(at, 0);
    while (next != anisotropic.end() && next->cell < line * nx) ++next;
    std::fill(own_loops.begin(), own_loops.end(), 1);
    for (auto of = next; of != anisotropic.end() && of->cell < (line + 1) * nx; ++of)
      own_loops[std::size_t(of->cell - line * nx)] = 0;
    for (; next_split != split.end() && *next_split < (line + 1) * nx; ++next_split)
      own_loops[std::size_t(*next_split - line * nx)] = 0;
    const auto same = [&](std::int64_t i, std::int64_t j) {
      return own_loops[std::size_t(i)] && own_loops[std::size_t(j)] && material.b[i] == material.b[j] &&
             material.zp[i] == material.zp[j] && material.zs[i] == material.zs[j] &&
             (!state.anisotropic || same_anisotropy(at, i, j));
    };
    // In curvilinear rows no two cells are alike; faces to another band are all solved.
    const std::int64_t last = domain.curvilinear(at[D - 1]) || domain.beside_band(at[D - 1]) ? 0 : nx;
    for (std::int64_t first = 0, x = 1; x <= last; ++x) {
      if (x < nx && same(first, x)) continue;
      if (x - first >= std::min(shortest_run, nx) && own_loops[std::size_t(first)])
        state.uniform_runs.push_back(run_of(state, at, first, x));
      first = x;
    }
    state.first_uniform_run[std::size_t(line) + 1] = state.uniform_runs.size();
  }
}

/// What the rows of the material hold of cells, but b, in their order: asked for once of neighbours that are
/// alike.
template <int D>
class RowValues {
 public:
  using Values = std::array<double, std::size_t(most_material_rows)>;
  RowValues(const Medium<D>& medium, bool anisotropic) : medium_(medium), anisotropic_(anisotropic) {
    for (const auto property : medium.properties())
      if (row_of(property).mean == Mean::elastic) fields_.push_back(&medium[property]);
  }

  const Values& operator()(std::size_t cell) {
    if (!anisotropic_) {
      const double rho = medium_.rho[cell];
      values_[row_zp] = rho * double(medium_.vp[cell]), values_[row_zs] = rho * double(medium_.vs[cell]);
      return values_;
    }
    const auto differs = [&](const Field<D>* field) { return (*field)[cell] != (*field)[last_]; };
    if (!known_ || std::any_of(fields_.begin(), fields_.end(), differs)) find(cell);
    known_ = true, last_ = cell;
    return values_;
  }

 private:
  void find(std::size_t cell) {
    const double rho = medium_.rho[cell];
    values_[row_zp] = wave_impedance(medium_, cell, D - 1, wave_p);
    values_[row_zs] = wave_impedance(medium_, cell, D - 1, wave_s);
    values_[row_zp_across] = wave_impedance(medium_, cell, 0, wave_p);
    values_[row_coupling] = wave_coupling(medium_, cell);
    if constexpr (D == 3) {
      values_[row_zs_level] = rho * shear_speed(medium_, cell, 0, 1);
      values_[row_coupling_level] = wave_coupling(medium_, cell, 0, 1);
      values_[row_zp_y] = wave_impedance(medium_, cell, 1, wave_p);
      values_[row_zs_y] = rho * shear_speed(medium_, cell, 1, 2);
      values_[row_coupling_y] = wave_coupling(medium_, cell, 1, 2);
    }
  }
  const Medium<D>& medium_;
  bool anisotropic_, known_ = false;
  std::vector<const Field<D>*> fields_;
  std::size_t last_ = 0;
  Values values_{};
};

/// What sweeps know of the medium, in zones that of the edge of the model.
template <int D>
void set_impedances(Domain<D>& domain, const Medium<D>& medium) {
  std::array<Field<D>, 2> impedance;
  for (auto& z : impedance) z = Field<D>(domain.grid);
  const bool anisotropic = domain.subdomain.anisotropic || anisotropic_cells(medium) > 0;
  const auto kind = any_orthorhombic(medium) || (D == 3 && any_tilted_axes(medium))
                        ? MaterialKind::orthorhombic
                        : MaterialKind::anisotropic;
  typename Domain<D>::Rows more;
  for (int row = row_zp_across; anisotropic && row < material_rows_of<D>(kind); ++row)
    more[std::size_t(row)] = Field<D>(domain.grid);
  const std::int64_t nx = domain.grid.shape[0], model_nx = domain.model_grid.shape[0];
  parallel_for(domain.grid.size() / nx, 64, [&](std::int64_t begin, std::int64_t end, int) {
    RowValues<D> values_of(medium, anisotropic);
    for (std::int64_t line = begin; line < end; ++line) {
      auto first = domain.model_cell(domain.grid.index(line * nx));
      first[0] = 0;
      const std::int64_t of_line = domain.model_grid.flat(first);
      for (std::int64_t x = 0; x < nx; ++x) {
        const auto cell =
            std::size_t(of_line + std::clamp<std::int64_t>(x - domain.low_zone[0], 0, model_nx - 1));
        const auto to = std::size_t(line * nx + x);
        const auto& values = values_of(cell);
        impedance[wave_p][to] = float(values[row_zp]), impedance[wave_s][to] = float(values[row_zs]);
        if (!anisotropic) continue;
        for (auto row = std::size_t(row_zp_across); row < std::size_t(material_rows_of<D>(kind)); ++row)
          more[row][to] = float(values[row]);
      }
    }
  });
  domain.set_impedances(std::move(impedance));
  if (anisotropic) domain.set_anisotropy(kind, std::move(more));
}

}  // namespace

template <int D>
Elasticity<D> elasticity_of_loops(const Domain<D>& domain, const Index<D>& cell) {
  Elasticity<D> c;
  const auto modulus = [&](int axis, int pair) {
    const double z = domain.impedance_of_pair(axis, pair)(cell);
    return z * z;
  };
  for (int one = 0; one < D; ++one) {
    c.voigt[std::size_t(one)][std::size_t(one)] = modulus(one, 0);
    for (int pair = 1; pair < D; ++pair) {
      const int other = axis_of_pair<D>(one, pair);
      const auto both = c.pair(one, other);
      c.voigt[std::size_t(one)][std::size_t(other)] =
          domain.coupling(cell, std::min(one, other), std::max(one, other));
      // Sweeps along z have both of its planes.
      if (one == D - 1 || other != D - 1) c.voigt[both][both] = modulus(one, pair);
    }
  }
  return c;
}

template <int D>
Elasticity<D> elasticity_at(const Domain<D>& domain, const Index<D>& cell) {
  if (const auto* const medium = domain.anisotropic_medium(cell))
    return medium->elasticity.times(medium->rho);
  const double zp = domain.impedance(wave_p)(cell), zs = domain.impedance(wave_s)(cell);
  // A fluid that is rounded would carry some shear across rows that dip.
  return domain.anisotropic() && zs > 0 ? elasticity_of_loops(domain, cell) : isotropic<D>(zp * zp, zs * zs);
}

template <int D>
Index<D> Domain<D>::model_cell(Index<D> at) const {
  for (int axis = 0; axis < D; ++axis)
    at[axis] = std::clamp<std::int64_t>(at[axis] - low_zone[axis], 0, model_grid.shape[axis] - 1);
  return at;
}

template <int D>
const Field<D>& Domain<D>::impedance(Wave wave, int axis) const {
  if (impedances_[wave].empty()) throw std::logic_error("the impedances of the domain were released");
  const int row = p_row<D>(material_kind_, axis);
  return anisotropic_ && wave == wave_p && row != row_zp ? more_[std::size_t(row)] : impedances_[wave];
}

template <int D>
const Field<D>& Domain<D>::impedance_of_pair(int axis, int pair) const {
  if (pair == 0) return impedance(wave_p, axis);
  const int row = s_row<D>(material_kind_, axis, axis_of_pair<D>(axis, pair));
  return splits_shear() && row != row_zs ? more_[std::size_t(row)] : impedance(wave_s);
}

template <int D>
double Domain<D>::courant(const Index<D>& cell, int axis, int pair) const {
  if (!steps.medium) return 0;
  const double cell_m = grid.spacing_m * (axis == D - 1 ? height(cell[D - 1]) : 1);
  return impedance_of_pair(axis, pair)(cell) / steps.medium->rho(model_cell(cell)) * steps.dt_s / cell_m;
}

template <int D>
bool Domain<D>::is_split(const Index<D>& behind, int axis) const {
  const auto place = [this](const SplitFace<D>& face) {
    return std::pair(face.axis, grid.flat(face.behind));
  };
  const std::pair wanted(axis, grid.flat(behind));
  const auto found =
      std::lower_bound(split.begin(), split.end(), wanted,
                       [&](const SplitFace<D>& face, const auto& of) { return place(face) < of; });
  return found != split.end() && place(*found) == wanted;
}

template <int D>
const AnisotropicCell* Domain<D>::anisotropic_cell(const Index<D>& at) const {
  if (cells_.empty()) return nullptr;
  const auto cell = grid.flat(at);
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), cell,
                       [](const AnisotropicCell& of, std::int64_t wanted) { return of.cell < wanted; });
  return found != cells_.end() && found->cell == cell ? &*found : nullptr;
}

template <int D>
bool Domain<D>::shear() const {
  const auto& z_s = impedance(wave_s);
  return std::any_of(z_s.begin(), z_s.end(), [](float z) { return z > 0; });
}

template <int D>
double corner_depth(const Domain<D>& domain, Index<D> corner) {
  for (int axis = 0; axis < D; ++axis) corner[axis] += domain.model_grid.first[axis] - domain.low_zone[axis];
  return corner_of_rows(domain, corner, 0) / domain.grid.spacing_m;
}

template <int D>
std::vector<double> corner_depths(const Domain<D>& domain) {
  Grid<D> corners;
  Index<D> last = domain.model_grid.rows->cells(), from{};  // of the whole model; the first corner there
  for (std::size_t axis = 0; axis < D; ++axis) {
    corners.shape[axis] = domain.grid.shape[axis] + 1;
    from[axis] = domain.model_grid.first[axis] - domain.low_zone[axis];
  }
  std::vector<double> depths(std::size_t(corners.size()), 0);
  const std::int64_t lines = D == 2 ? 1 : corners.shape[1], line = corners.shape[0];
  // Columns of the model, then lines beyond it, then what is beyond the ends of lines.
  parallel_for(corners.shape[D - 1], 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto row = begin; row < end; ++row) {
      double* const plane = depths.data() + row * lines * line;
      Index<D> at{};
      at[D - 1] = from[D - 1] + row;
      const auto each_beyond = [&](int axis, std::int64_t count, const auto& with) {
        const auto first = -from[std::size_t(axis)], end_of_model = first + last[std::size_t(axis)];
        for (std::int64_t n = 0; n < first; ++n) with(n, first, first + 1, BeyondSide{axis, 0, first - n});
        for (auto n = end_of_model + 1; n < count; ++n)
          with(n, end_of_model, end_of_model - 1, BeyondSide{axis, 1, n - end_of_model});
      };
      for (std::int64_t y = 0; y < lines; ++y) {
        if constexpr (D == 3) at[1] = from[1] + y;
        if (D == 3 && (at[1] < 0 || at[1] > last[1])) continue;
        for (at[0] = 0; at[0] <= last[0]; ++at[0])
          plane[y * line + at[0] - from[0]] = depth_in_column(domain, at);
      }
      if (D == 3)
        each_beyond(1, lines, [&](auto y, auto edge, auto before, const BeyondSide& of) {
          for (auto x = -from[0]; x <= last[0] - from[0]; ++x)
            plane[y * line + x] = depth_beyond(domain, of, plane[edge * line + x], plane[before * line + x]);
        });
      for (std::int64_t y = 0; y < lines; ++y)
        each_beyond(0, line,
                    [&, of_line = plane + y * line](auto x, auto edge, auto before, const BeyondSide& of) {
                      of_line[x] = depth_beyond(domain, of, of_line[edge], of_line[before]);
                    });
      for (std::int64_t n = 0; n < lines * line; ++n) plane[n] /= domain.grid.spacing_m;
    }
  });
  return depths;
}

template <int D>
Domain<D> make_domain(const Medium<D>& medium, const EdgeLaws<D>& edges, int zone_cells,
                      const Subdomain& part, int order, double longer_steps) {
  constexpr int z = D - 1;
  Domain<D> domain;
  domain.order = order;
  domain.model_grid = domain.grid = medium.grid();
  domain.subdomain = part;
  domain.edges = domain.whole_edges = edges;
  for (int axis = 0; axis < D; ++axis) {
    domain.low_zone[axis] = edges[axis][0] == EdgeLaw::absorbing ? zone_cells : 0;
    domain.high_zone[axis] = edges[axis][1] == EdgeLaw::absorbing ? zone_cells : 0;
    domain.grid.shape[axis] += domain.low_zone[axis] + domain.high_zone[axis];
    domain.grid.origin_m[axis] -= double(domain.low_zone[axis]) * domain.grid.spacing_m;
  }
  // Places are counted from the whole computed grid, zones included.
  if (part.cut(0)) {
    domain.grid.first[z] += domain.low_zone[z];
    domain.grid.shape[z] -= std::exchange(domain.low_zone[z], 0);
    domain.edges[z][0] = EdgeLaw::absorbing;
  }
  if (part.cut(1)) {
    domain.grid.shape[z] -= std::exchange(domain.high_zone[z], 0);
    domain.edges[z][1] = EdgeLaw::absorbing;
  }
  // Its rows are those of the model, not of a grid of that size.
  domain.grid.rows = nullptr;
  if (domain.model_grid.rows) SideRowsFinder<D>(domain, medium, longer_steps).find();
  find_curvilinear_rows(domain);
  domain.own = {0, domain.grid.shape[z]};
  const auto held = domain.model_grid.first[z];
  if (part.cut(0)) domain.own.first = part.first - held;
  if (part.cut(1)) domain.own.last = part.last - held + domain.low_zone[z];
  domain.band = {0, domain.grid.shape[z]};
  if (part.other_cells[0] > 0) domain.band.first = part.face(0) - held;
  if (part.other_cells[1] > 0) domain.band.last = part.face(1) - held + domain.low_zone[z];
  set_impedances(domain, medium);
  domain.find_material_kind();
  find_anisotropic_cells(domain, medium);
  return domain;
}

template <int D, class Real>
void fill_material(State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium, double dt_s) {
  const auto& layout = state.layout;
  const double courant = dt_s / domain.grid.spacing_m;
  const auto pitch = state.material_layout.row_pitch(), last_of_model = domain.model_grid.shape[0] - 1;
  // So many cells of a line as those of a line of the domain.
  const auto write = [&](RowValues<D>& values_of, const Index<D>& at, const Index<D>& from,
                         std::int64_t count, bool ghost, int p_factor, int s_factor) {
    auto first = domain.model_cell(from), line = at;
    first[0] = line[0] = 0;
    const auto of_line = domain.model_grid.flat(first), x = from[0] - domain.low_zone[0];
    Real* const to = state.material_row(line, 0) + at[0];
    for (std::int64_t n = 0; n < count; ++n) {
      const auto cell = std::size_t(of_line + std::clamp<std::int64_t>(x + n, 0, last_of_model));
      auto values = values_of(cell);
      values[row_b] = ghost || medium.is_void(cell) ? 0 : courant / double(medium.rho[cell]);
      for (const auto row : {row_zp, row_zp_across, row_zp_y}) values[row] *= p_factor;
      for (const auto row : {row_zs, row_zs_level, row_zs_y}) values[row] *= s_factor;
      for (int row = 0; row < state.material_layout.rows(); ++row)
        to[row * pitch + n] = Real(values[std::size_t(row)]);
    }
  };
  const std::int64_t lines = layout.lines(), nx = layout.shape()[0];
  parallel_for(lines, 16, [&](std::int64_t begin, std::int64_t end, int) {
    RowValues<D> values_of(medium, state.anisotropic);
    for (std::int64_t line = begin; line < end; ++line) {
      Index<D> at = layout.line_index(line);
      write(values_of, at, at, nx, false, 1, 1);
      for (const int side : {0, 1}) {
        Index<D> from = at;
        from[0] = side ? nx - 1 : 0;
        at[0] = side ? nx : -1;
        const EdgeLaw law = domain.edges[0][side];
        write(values_of, at, from, 1, true, ghost_impedance(law, wave_p), ghost_impedance(law, wave_s));
      }
      // Ghost lines beyond the edges of the other axes repeat the line before them.
      for (int axis = 1; axis < D; ++axis) {
        Index<D> cell = layout.line_index(line);
        if (cell[axis] != 0 && cell[axis] != layout.shape()[axis] - 1) continue;
        for (const int side : {0, 1}) {
          if (cell[axis] != (side ? layout.shape()[axis] - 1 : 0)) continue;
          const EdgeLaw law = domain.edges[axis][side];
          Index<D> ghost = cell;
          ghost[axis] += side ? 1 : -1;
          write(values_of, ghost, cell, nx, true, ghost_impedance(law, wave_p), ghost_impedance(law, wave_s));
        }
      }
    }
  });
  find_uniform_runs(state, domain);
  state.uniform_interior = find_uniform_interior(state);
}

template <int D, class Real>
double energy_of_cell(const State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium,
                      Index<D> at) {
  using Rows = FieldRows<D>;
  const auto cell = std::size_t(medium.grid().flat(domain.model_cell(at)));
  if (medium.is_void(cell)) return 0;
  const auto whole = at;
  const auto x = at[0];
  at[0] = 0;
  const auto value = [&](int row) { return double(state.field_row(at, row)[x]); };
  const bool anisotropic = is_anisotropic(medium, cell);
  const double rho = medium.rho[cell], mu = rho * medium.vs[cell] * medium.vs[cell];
  const double lambda = rho * medium.vp[cell] * medium.vp[cell] - 2 * mu;
  double kinetic = 0, squares = 0, trace = 0, shear = 0;
  for (int axis = 0; axis < D; ++axis) {
    kinetic += rho * value(Rows::velocity(axis)) * value(Rows::velocity(axis));
    const double s = value(Rows::normal_stress(axis));
    squares += s * s;
    trace += s;
    for (int other = axis + 1; other < D && !state.fluid; ++other) {
      const double t = value(Rows::shear_stress(axis, other));
      shear += t * t;
    }
  }
  const double height = domain.model_grid.height(domain.model_cell(whole));
  const auto energy_with = [&](double elastic) {
    return 0.5 * (kinetic + elastic) * std::pow(domain.grid.spacing_m, D - 1) * height;
  };
  const auto* const of = domain.anisotropic_medium(whole);
  if (anisotropic || of) {
    SymmetricTensor<D, double> s;
    for (int axis = 0; axis < D; ++axis)
      for (int other = axis; other < D; ++other) s(axis, other) = value(Rows::stress(axis, other));
    return energy_with(complementary<D>(of ? of->elasticity : elasticity_along_grid(medium, cell), s.values));
  }
  // s:C^-1:s; in plane strain C acts on the in-plane components alone.
  return energy_with(mu > 0
                         ? (squares - lambda / (D * lambda + 2 * mu) * trace * trace) / (2 * mu) + shear / mu
                         : trace * trace / (D * D * lambda));
}

template <int D, class Real>
double energy(const State<D, Real>& state, const Domain<D>& domain, const Medium<D>& medium) {
  double total = 0;
  for (std::int64_t n = 0; n < domain.model_grid.size(); ++n) {
    const auto at = domain.computed_cell(domain.model_grid.index(n));
    if (domain.owns(at[D - 1])) total += energy_of_cell(state, domain, medium, at);
  }
  return total;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, elasticity_of_loops);
SLIPWAVE_INSTANTIATE_D(FUNCTION, elasticity_at);
SLIPWAVE_INSTANTIATE_D(TYPE, class Domain);
SLIPWAVE_INSTANTIATE_D(FUNCTION, corner_depth);
SLIPWAVE_INSTANTIATE_D(FUNCTION, corner_depths);
SLIPWAVE_INSTANTIATE_D(FUNCTION, make_domain);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, fill_material);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, energy_of_cell);
SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, energy);

}  // namespace slipwave::solver
