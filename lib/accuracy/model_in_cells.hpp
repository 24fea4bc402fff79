#pragma once

#include <memory>
#include <optional>

#include "model/fit.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// The model of a scene in cells of other sizes, finer or coarser. Where sw-layers made its medium it is made
/// anew from the tops of the layers: other cells have their own geometry, not parts or means of the old ones.
/// The history of the model names the command, which must give the medium again, bit for bit. Elsewhere, and
/// fractures in any case, it is regridded() to cover the same extent. Tops that lie on faces of the cells are
/// followed by rows in cells of other sizes.
template <int D>
class ModelInCells {
 public:
  /// The scene outlives this.
  explicit ModelInCells(const Scene<D>& scene);
  ~ModelInCells();

  /// Whether other cells are filled from the tops of layers.
  bool from_layers() const { return command_ != nullptr; }
  /// Whether the model is of layers whose tops no rows follow, though they could.
  bool could_be_fitted() const;
  /// Whether tops cut cells, which no rows follow: where they do so differs from size to size, and no more
  /// than first order is kept.
  bool tops_cut_cells() const { return tops_cut_cells_; }
  /// How many tops rows of other cells can not follow, though they were to; 0 where there are none.
  std::size_t left_out(double spacing_m) const;
  /// Throws an Error where it cannot be made.
  Model<D> of(double spacing_m) const;
  /// The same with rows that follow every top they can; from_layers() only.
  Model<D> fitted(double spacing_m) const;

 private:
  struct Command;
  bool on_faces() const;
  Medium<D> medium_of(double spacing_m, const FitChoice& choice, bool covered) const;
  Model<D> with_medium(Medium<D> medium, double spacing_m) const;

  const Scene<D>& scene_;
  std::unique_ptr<Command> command_;
  bool tops_cut_cells_ = false;
};

}  // namespace slipwave
