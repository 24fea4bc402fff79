// SPDX-License-Identifier: BSD-3-Clause
#include "scene/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "grid/locate.hpp"
#include "rock/coefficients.hpp"

namespace slipwave {
namespace {

/// Cells round the diverged one in which effects are searched for.
constexpr std::int64_t near_cells = 10;

/// The largest difference of indices along an axis.
template <int D>
std::int64_t cells_apart(const Index<D>& a, const Index<D>& b) {
  std::int64_t most = 0;
  for (std::size_t axis = 0; axis < D; ++axis) most = std::max(most, std::abs(a[axis] - b[axis]));
  return most;
}

/// Effects by name, each with its distance in cells: the nearest place where it was added.
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

/// The name of the interface between two neighbouring cells, empty where there is none.
template <int D>
std::string interface_between(const Medium<D>& medium, std::size_t a, std::size_t b) {
  if (medium.is_void(a) || medium.is_void(b))
    return medium.is_void(a) == medium.is_void(b) ? "" : "a free surface inside the model";
  if (medium.is_fluid(a) != medium.is_fluid(b)) return "a fluid-solid interface";
  const auto ratio = [](double x, double y) { return x > y ? x / y : y / x; };
  double largest = ratio(double(medium.rho[a]) * medium.vp[a], double(medium.rho[b]) * medium.vp[b]);
  if (medium.is_solid(a))
    largest =
        std::max(largest, ratio(double(medium.rho[a]) * medium.vs[a], double(medium.rho[b]) * medium.vs[b]));
  return largest >= strong_interface_ratio ? "an interface" : "";
}

/// The free, rigid or mirror edges of the whole model and its PML; `at` in cells of the model,
/// beyond its ends in the layer outside it.
template <int D>
void add_edges(Nearby& nearby, const Scene<D>& scene, const Index<D>& at) {
  const auto whole = scene.subdomain.whole(scene.model.grid());
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1}) {
      const auto past = side ? whole.shape[std::size_t(axis)] - 1 - at[std::size_t(axis)]
                             : at[std::size_t(axis)];  // cells between it and the edge; negative: outside
      const EdgeLaw law = scene.edges[axis][side];
      const std::string edge = law == EdgeLaw::rigid ? "a rigid edge" : "a mirror";
      if (law == EdgeLaw::absorbing)
        nearby.add("the PML", std::max<std::int64_t>(past + 1, 0));
      else
        nearby.add(law != EdgeLaw::free         ? edge
                   : axis == D - 1 && side == 0 ? "the free surface"
                                                : "a free edge",
                   past);
    }
}

/// Fractures, interfaces and free surfaces in the cells round `at`.
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
      if (!model.prestress_pa.empty()) nearby.add("fractures under prestress", away);
    }
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (cell[axis] == high[axis]) continue;
      Index<D> next = cell;
      ++next[axis];
      const auto interface = interface_between(model.medium, n, std::size_t(grid.flat(next)));
      if (!interface.empty()) nearby.add(interface, std::min(away, cells_apart<D>(next, at)));
    }
    std::size_t axis = 0;
    for (; axis < D && cell[axis] == high[axis]; ++axis) cell[axis] = low[axis];
    if (axis == D) return;
    ++cell[axis];
  }
}

}  // namespace

template <int D>
std::string surroundings(const Scene<D>& scene, std::size_t shot, const Index<D>& at) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  Index<D> nearest;
  for (std::size_t axis = 0; axis < D; ++axis)
    nearest[axis] = std::clamp<std::int64_t>(at[axis], 0, grid.shape[axis] - 1);
  const auto inside = std::size_t(grid.flat(nearest));
  Nearby nearby;
  Index<D> of_whole = at;
  of_whole[D - 1] += grid.first[D - 1];
  add_edges(nearby, scene, of_whole);
  add_cells(nearby, scene, at);
  const auto& source = scene.survey.sources[shot - 1];
  if (point_injection(source))
    nearby.add("the source",
               cells_apart<D>(cell_of(scene.subdomain.whole(grid), source.position_m), of_whole));
  const std::string anisotropy =
      !is_anisotropic(medium, inside) ? ""
      : has_constants(medium, inside)
          ? " and other elastic constants"
          : " epsilon=" + shown(medium.value(Property::epsilon, inside)) +
                " delta=" + shown(medium.value(Property::delta, inside)) +
                (D == 3 ? " gamma=" + shown(medium.value(Property::gamma, inside)) : "") +
                (has_tilted_axis(medium, inside)
                     ? " tilt=" + shown(medium.value(Property::tilt, inside)) +
                           (D == 3 ? " azimuth=" + shown(medium.value(Property::azimuth, inside)) +
                                         " rotation=" + shown(medium.value(Property::rotation, inside))
                                   : "")
                     : "");
  return "vp=" + shown(medium.vp[inside]) + " vs=" + shown(medium.vs[inside]) +
         " rho=" + shown(medium.rho[inside]) + anisotropy + nearby.text(grid.spacing_m);
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, surroundings);

}  // namespace slipwave
