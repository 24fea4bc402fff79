// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_in_cells.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "model/layers.hpp"
#include "model/resample.hpp"
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
  if (!model.geology.knows_places()) return;
  try {
    auto own = medium_of_geology(model.grid().spacing_m, fit_);
    for (const auto property : own.properties())
      if (!model.medium.has(property)) taken_out_.push_back(property), own[property] = {};
    as_built_ = equal(own, model.medium);
    if (as_built_ && on_faces())
      fit_ = {};
    else
      tops_cut_cells_ = as_built_ && !model.grid().rows;
  } catch (const Error&) {
    // It cannot be built so any more.
  }
}

/// Whether every horizon lies on faces of the cells as they are. In other cells that takes rows that follow.
template <int D>
bool ModelInCells<D>::on_faces() const {
  if (model_.grid().rows) return false;
  auto geology = model_.geology;
  geology.fit = {};
  const auto fit = fit_of(geology, covering(model_.grid(), model_.grid().spacing_m));
  return !fit.grid.rows && fit.left_out.empty();
}

template <int D>
std::size_t ModelInCells<D>::left_out(double spacing_m) const {
  if (!as_built_) return 0;
  auto geology = model_.geology;
  geology.fit = fit_;
  return fit_of(geology, covering(model_.grid(), spacing_m)).left_out.size();
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

template class ModelInCells<2>;
template class ModelInCells<3>;

}  // namespace slipwave
