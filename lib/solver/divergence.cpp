#include "solver/divergence.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "grid/locate.hpp"
#include "solver/shot_simulation.hpp"

namespace slipwave::solver {
namespace {

/// Cells round the bad one in which effects are looked for.
constexpr std::int64_t near_cells = 10;

/// The largest difference of indices along an axis.
template <int D>
std::int64_t cells_apart(const Index<D>& a, const Index<D>& b) {
  std::int64_t most = 0;
  for (std::size_t axis = 0; axis < D; ++axis) most = std::max(most, std::abs(a[axis] - b[axis]));
  return most;
}

/// Effects by name, each with how many cells it is away: the nearest of those that are told of.
class Nearby {
 public:
  void add(const std::string& name, std::int64_t cells) {
    if (cells > near_cells) return;
    const auto [known, is_new] = cells_away_.try_emplace(name, cells);
    if (!is_new) known->second = std::min(known->second, cells);
  }
  std::string text(double spacing_m) const {
    std::vector<std::pair<std::int64_t, std::string>> nearest;
    for (const auto& [name, cells] : cells_away_) nearest.emplace_back(cells, name);
    std::sort(nearest.begin(), nearest.end());
    std::string text;
    for (const auto& [cells, name] : nearest)
      text += ", " + (cells == 0 ? "at " : shown(double(cells) * spacing_m) + " m from ") + name;
    return text.empty() ? ", nothing else within " + shown(double(near_cells) * spacing_m) + " m" : text;
  }

 private:
  std::map<std::string, std::int64_t> cells_away_;
};

/// What is between two cells that touch: nothing, or an effect.
template <int D>
std::string contact_of(const Medium<D>& medium, std::size_t a, std::size_t b) {
  if (medium.is_void(a) || medium.is_void(b))
    return medium.is_void(a) == medium.is_void(b) ? "" : "a free face";
  if (medium.is_fluid(a) != medium.is_fluid(b)) return "a contact of fluid and rock";
  const auto ratio = [](double x, double y) { return x > y ? x / y : y / x; };
  double largest = ratio(double(medium.rho[a]) * medium.vp[a], double(medium.rho[b]) * medium.vp[b]);
  if (medium.is_solid(a))
    largest =
        std::max(largest, ratio(double(medium.rho[a]) * medium.vs[a], double(medium.rho[b]) * medium.vs[b]));
  return largest >= strong_interface_ratio ? "a contact" : "";
}

/// The free, rigid or mirror edges of the whole model and its sponge; `at` in cells of it, outside
/// it in the zones.
template <int D>
void add_edges(Nearby& nearby, const Scene<D>& scene, std::size_t shot, const Index<D>& at) {
  const bool plane = !point_injection(scene.survey.sources[shot - 1]);
  const auto whole = scene.subdomain.whole(scene.model.grid());
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      const auto past = side ? whole.shape[std::size_t(axis)] - 1 - at[std::size_t(axis)]
                             : at[std::size_t(axis)];  // cells between it and the edge; negative: outside
      const EdgeLaw law = scene.edges[axis][side];
      const std::string edge = law == EdgeLaw::rigid ? "a rigid edge" : "a mirror";
      if (law == EdgeLaw::absorbing)
        nearby.add(plane ? "the zones of the plane wave" : "the matched layer",
                   std::max<std::int64_t>(past + 1, 0));
      else
        nearby.add(law != EdgeLaw::free         ? edge
                   : axis == D - 1 && side == 0 ? "the free surface"
                                                : "a free edge",
                   past);
    }
}

/// Fractures, contacts and voids in the cells round `at`.
template <int D>
void add_cells(Nearby& nearby, const Scene<D>& scene, const Index<D>& at) {
  const auto& model = scene.model;
  const auto& grid = model.grid();
  Index<D> low, high;
  for (std::size_t axis = 0; axis < D; ++axis) {
    low[axis] = std::max<std::int64_t>(at[axis] - near_cells, 0);
    high[axis] = std::min(at[axis] + near_cells, grid.shape[axis] - 1);
    if (low[axis] > high[axis]) return;
  }
  for (Index<D> cell = low;;) {
    const auto n = std::size_t(grid.flat(cell));
    const auto away = cells_apart<D>(cell, at);
    if (model.medium.is_fluid(n) && away == 0) nearby.add("fluid", 0);
    if (scene.slips() && model.fracture[n] > 0) {
      nearby.add("fracture set " + model.fracture_sets[model.fracture[n] - 1u].name, away);
      if (!model.prestress_pa.empty()) nearby.add("fractures under static stress", away);
    }
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (cell[axis] == high[axis]) continue;
      Index<D> next = cell;
      ++next[axis];
      const auto contact = contact_of(model.medium, n, std::size_t(grid.flat(next)));
      if (!contact.empty()) nearby.add(contact, std::min(away, cells_apart<D>(next, at)));
    }
    std::size_t axis = 0;
    for (; axis < D && cell[axis] == high[axis]; ++axis) cell[axis] = low[axis];
    if (axis == D) return;
    ++cell[axis];
  }
}

}  // namespace

template <int D>
std::string surroundings(const Scene<D>& scene, const Domain<D>& domain, std::size_t shot,
                         const Index<D>& at) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const auto inside = std::size_t(grid.flat(domain.model_cell(at)));
  Index<D> of_model = at;
  for (std::size_t axis = 0; axis < D; ++axis) of_model[axis] -= domain.low_zone[axis];
  Nearby nearby;
  Index<D> of_whole = of_model;
  of_whole[D - 1] += grid.first[D - 1];
  add_edges(nearby, scene, shot, of_whole);
  add_cells(nearby, scene, of_model);
  const auto& source = scene.survey.sources[shot - 1];
  if (point_injection(source))
    nearby.add("the source",
               cells_apart<D>(cell_of(scene.subdomain.whole(grid), source.position_m), of_whole));
  return "vp=" + shown(medium.vp[inside]) + " vs=" + shown(medium.vs[inside]) +
         " rho=" + shown(medium.rho[inside]) + nearby.text(grid.spacing_m);
}

template <int D, class Real>
std::optional<DivergedFields<D>> first_divergence(const Scene<D>& scene, std::size_t shot,
                                                  const Divergence<D>& seen, bool snapshots) {
  // As many cells are computed as the first time: all of them where there were snapshots.
  const auto nowhere = [](double, const FieldReader<D>&) {};
  ShotSimulation<D, Real> again(scene, shot, snapshots ? SnapshotSink<D>(nowhere) : SnapshotSink<D>());
  const std::int64_t bad = seen.time.step + 1;
  if (double(bad) * double(again.domain().grid.size()) > most_again) return std::nullopt;
  try {
    again.run_to(StabilityCheck<D, Real>::last_before(bad));
    while (again.done() < bad) {
      again.run_to(again.done() + 1);
      again.check_stability();
    }
  } catch (const DivergedFields<D>& first) {
    return first;
  }
  return std::nullopt;
}

template std::string surroundings(const Scene<2>&, const Domain<2>&, std::size_t, const Index<2>&);
template std::optional<DivergedFields<2>> first_divergence<2, float>(const Scene<2>&, std::size_t,
                                                                     const Divergence<2>&, bool);
template std::optional<DivergedFields<2>> first_divergence<2, double>(const Scene<2>&, std::size_t,
                                                                      const Divergence<2>&, bool);
template std::string surroundings(const Scene<3>&, const Domain<3>&, std::size_t, const Index<3>&);
template std::optional<DivergedFields<3>> first_divergence<3, float>(const Scene<3>&, std::size_t,
                                                                     const Divergence<3>&, bool);
template std::optional<DivergedFields<3>> first_divergence<3, double>(const Scene<3>&, std::size_t,
                                                                      const Divergence<3>&, bool);

}  // namespace slipwave::solver
