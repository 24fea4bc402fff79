// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "model/model.hpp"
#include "rock/attenuation.hpp"

namespace slipwave {

/// A model in cells of other sizes, finer or coarser, whatever they are, as its builder would have filled
/// them: from where horizons and beds are, as far as the model knows (Geology) and still is what was built,
/// else from the old cells: regridded(), or resampled() where the builder had interpolated for smaller ones.
/// Cells begin where those of the model do; where its extent is no whole number of them it is covered
/// (Extent). Where all horizons lie on faces of the model's cells, rows of other cells follow them. Clusters
/// are as regridded() has them, single fractures stay where they are.
template <int D>
class ModelInCells {
 public:
  /// `unrelaxed`: how the medium was made the unrelaxed one (unrelax()), if it was; so is that in other cells
  /// then. Model and attenuation outlive this.
  explicit ModelInCells(const Model<D>& model, const std::optional<Attenuation>& unrelaxed = {});
  ModelInCells(const Model<D>&&, const std::optional<Attenuation>& = {}) = delete;

  /// Whether the model's geology gives all its cells, to the bit: as long as nothing but effects was taken
  /// out of it and fractures added. Then other cells have their own geometry.
  bool as_built() const { return as_built_; }
  /// Whether it does and rows follow fewer kinds of horizons than they might (fitted()).
  bool could_be_fitted() const;
  /// How many horizons rows of other cells cannot follow, though they were to; 0 where nothing is known.
  std::size_t left_out(double spacing_m) const;
  /// Whether horizons cut cells, which no rows follow or which these leave out: where they do so differs from
  /// size to size, and no more than first order is kept.
  bool tops_cut_cells() const { return tops_cut_cells_; }
  /// How otherwise level horizons lie in cells of another size, as the part of a cell, 1/2 at most: 0 where
  /// all of them cut cells as they do in those of `own_m`, or lie on faces in both. They are the tops that no
  /// rows follow; in models without their geometry, wherever fluid, solid and void part.
  double lie_otherwise(double own_m, double other_m) const;
  /// Throws a usage Error where the size is not above zero or the model would not fit the memory, an Error as
  /// regridded() where a fitted grid cannot be made anew.
  Model<D> of(double spacing_m) const;
  /// Returns the model in cells of that size with rows that follow all horizons they can; as_built() only.
  Model<D> fitted(double spacing_m) const;

 private:
  Fit<D> fit_in(double spacing_m, const FitChoice& choice) const;
  void find_geology();
  void find_cut_tops();
  void find_level_faces();
  Medium<D> medium_of_geology(double spacing_m, const FitChoice& choice) const;
  Model<D> of_cells(double spacing_m) const;
  Model<D> with_medium(Medium<D> medium) const;

  const Model<D>& model_;
  std::optional<Attenuation> unrelaxed_;
  FitChoice fit_;                    // which horizons rows of other cells follow
  std::vector<Property> taken_out_;  // of what was built
  bool as_built_ = false, tops_cut_cells_ = false;
  std::vector<double> level_m_;  // where level horizons are, from the low corner along their axis
};

/// ModelInCells::of(), once.
template <int D>
Model<D> in_cells_of(const Model<D>& model, double spacing_m,
                     const std::optional<Attenuation>& unrelaxed = {}) {
  return ModelInCells<D>(model, unrelaxed).of(spacing_m);
}

extern template class ModelInCells<2>;
extern template class ModelInCells<3>;

}  // namespace slipwave
