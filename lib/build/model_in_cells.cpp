// SPDX-License-Identifier: BSD-3-Clause
#include "build/model_in_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "build/resample.hpp"
#include "geology/layers.hpp"
#include "model/single_fracture.hpp"

namespace slipwave {
namespace {

template <int D>
bool equal(const Medium<D>& a, const Medium<D>& b) {
  if (!(a.grid() == b.grid())) return false;
  const auto properties = a.properties();
  return properties == b.properties() && std::all_of(properties.begin(), properties.end(), [&](Property of) {
           return std::equal(a[of].begin(), a[of].end(), b[of].begin(), b[of].end());
         });
}

/// The regular grid that covers a model, from which rows of a fitted one bend.
template <int D>
Grid<D> covering(const Grid<D>& grid, double spacing_m) {
  Point<D> size_m{};
  for (std::size_t axis = 0; axis < D; ++axis) size_m[axis] = grid.end(int(axis)) - grid.origin_m[axis];
  if (grid.rows) size_m[D - 1] = grid.end(D - 1);
  auto regular = grid_over<D>(size_m, spacing_m);
  regular.origin_m = grid.origin_m;
  if (grid.rows) regular.origin_m[D - 1] = 0;
  return regular;
}

/// Fractures are in rock alone.
template <int D>
void clear_beside_rock(Model<D>& model) {
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell)
    if (!model.medium.is_solid(cell)) model.fracture[cell] = 0;
}

}  // namespace

template <int D>
ModelInCells<D>::ModelInCells(const Model<D>& model, const std::optional<Attenuation>& unrelaxed)
    : model_(model), unrelaxed_(unrelaxed), fit_(model.geology.fit) {
  find_geology();
  find_level_faces();
}

template <int D>
void ModelInCells<D>::find_geology() {
  if (!model_.geology.knows_places()) return;
  try {
    auto own = medium_of_geology(model_.grid().spacing_m, fit_);
    for (const auto property : own.properties())
      if (!model_.medium.has(property)) taken_out_.push_back(property), own[property] = {};
    as_built_ = equal(own, model_.medium);
    if (as_built_) find_cut_tops();
  } catch (const Error&) {
    // It cannot be built so any more.
  }
}

template <int D>
void ModelInCells<D>::find_cut_tops() {
  const auto& grid = model_.grid();
  const auto all = fit_in(grid.spacing_m, {}), own = fit_in(grid.spacing_m, fit_);
  // Where every horizon lies on faces of the cells as they are, that takes rows that follow in others.
  if (!grid.rows && !all.grid.rows && all.left_out.empty()) {
    fit_ = {};
    return;
  }
  tops_cut_cells_ = !grid.rows || !own.left_out.empty();
  const double low_m = grid.rows ? 0 : grid.origin_m[D - 1], high_m = grid.end(D - 1);
  const auto columns = corner_columns(covering(grid, grid.spacing_m));
  for (std::size_t n = 0; n < model_.geology.layers.size(); ++n) {
    const auto& top = model_.geology.layers[n].top;
    const bool inside = std::any_of(columns.begin(), columns.end(), [&](const Point<D>& at) {
      const double depth_m = top.at(at[0], D == 3 ? at[1] : 0);
      return depth_m > low_m && depth_m < high_m;
    });
    if (own.rows[n] >= 0 || !inside) continue;
    tops_cut_cells_ = true;
    if (!grid.rows && top.is_plane() && top.shape().dip_deg == 0) level_m_.push_back(top.depth_m() - low_m);
  }
}

/// Faces of cells where matter changes its kind.
template <int D>
void ModelInCells<D>::find_level_faces() {
  if (as_built_) return;
  const auto& grid = model_.grid();
  const auto& medium = model_.medium;
  const auto kind = [&](std::size_t cell) {
    return medium.is_void(cell) ? 0 : medium.is_fluid(cell) ? 1 : 2;
  };
  for (int axis = 0; axis < D; ++axis) {
    // Rows follow their horizons in all cells.
    if (grid.rows && axis == D - 1) continue;
    std::vector<bool> parts(std::size_t(grid.shape[std::size_t(axis)]));
    for (std::int64_t cell = 0; cell < grid.size(); ++cell) {
      auto at = grid.index(cell);
      const auto plane = std::size_t(at[std::size_t(axis)]);
      if (plane == 0 || parts[plane]) continue;
      --at[std::size_t(axis)];
      parts[plane] = kind(std::size_t(cell)) != kind(std::size_t(grid.flat(at)));
    }
    for (std::size_t plane = 0; plane < parts.size(); ++plane)
      if (parts[plane]) level_m_.push_back(double(plane) * grid.spacing_m);
  }
}

template <int D>
double ModelInCells<D>::lie_otherwise(double own_m, double other_m) const {
  double most = 0;
  for (const double at_m : level_m_) {
    const double cells = at_m / own_m - at_m / other_m;
    most = std::max(most, std::abs(cells - std::round(cells)));
  }
  return most;
}

template <int D>
std::size_t ModelInCells<D>::left_out(double spacing_m) const {
  return as_built_ ? fit_in(spacing_m, fit_).left_out.size() : 0;
}

template <int D>
Fit<D> ModelInCells<D>::fit_in(double spacing_m, const FitChoice& choice) const {
  auto geology = model_.geology;
  geology.fit = choice;
  return fit_of(geology, covering(model_.grid(), spacing_m));
}

/// What was changed in all cells that were built is changed again.
template <int D>
Medium<D> ModelInCells<D>::medium_of_geology(double spacing_m, const FitChoice& choice) const {
  auto geology = model_.geology;
  geology.fit = choice;
  auto medium = medium_of(geology, covering(model_.grid(), spacing_m));
  for (const auto property : taken_out_) medium[property] = {};
  if (unrelaxed_) unrelax(medium, *unrelaxed_);
  return medium;
}

template <int D>
bool ModelInCells<D>::could_be_fitted() const {
  return as_built_ && !(fit_.surfaces && fit_.floors && fit_.layers);
}

template <int D>
Model<D> ModelInCells<D>::of(double spacing_m) const {
  if (spacing_m == model_.grid().spacing_m) return model_;
  return as_built_ ? with_medium(medium_of_geology(spacing_m, fit_)) : of_cells(spacing_m);
}

template <int D>
Model<D> ModelInCells<D>::fitted(double spacing_m) const {
  return with_medium(medium_of_geology(spacing_m, {}));
}

template <int D>
Model<D> ModelInCells<D>::of_cells(double spacing_m) const {
  const bool smooth = model_.geology.resampling == CellResampling::interpolated && !model_.grid().rows;
  return smooth ? resampled(model_, spacing_m, true, Extent::covered)
                : regridded(model_, spacing_m, Extent::covered);
}

template <int D>
Model<D> ModelInCells<D>::with_medium(Medium<D> medium) const {
  if (model_.fracture_sets.empty()) {
    Model<D> built;
    built.medium = std::move(medium);
    built.title = model_.title, built.source = model_.source, built.history = model_.history;
    built.geology = model_.geology;
    return built;
  }
  auto changed = of_cells(medium.grid().spacing_m);
  // Rows that follow horizons otherwise than before leave no cell where clusters had it.
  if (changed.grid().shape != medium.grid().shape) return changed;
  changed.medium = std::move(medium);
  clear_beside_rock(changed);
  place_single_fractures(changed);
  return changed;
}

SLIPWAVE_INSTANTIATE_D(TYPE, class ModelInCells);

}  // namespace slipwave
