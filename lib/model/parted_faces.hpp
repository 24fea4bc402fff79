#pragma once

#include <algorithm>
#include <vector>

#include "model/model.hpp"

/// Single fractures on faces between cells (docs/theory.md 2.8): the rock on both sides moves apart there.
namespace slipwave {

/// A face where a single fracture parts the rock, before the cell `behind` along an axis, and its
/// compliances, m/Pa: infinite where it is open.
template <int D>
struct PartedFace {
  Index<D> behind{};
  int axis = 0;
  double normal_m_per_pa = 0, tangential_m_per_pa = 0;
};

/// Where a level or upright fracture lies among the faces of the whole model.
struct FacesOfTrace {
  int axis = 0;                // across it
  std::int64_t face = 0;       // before the cell of that number along the axis
  double first = 0, last = 0;  // its tips along the other axis, in cells from the corner of the model
  double moved_m = 0;          // from where it is given to this face
};

/// Throws a usage Error where it is neither level nor upright, bends, is shorter than three cells, or rows
/// follow horizons; the grid may be part of that of the model.
FacesOfTrace faces_of(const Grid<2>& grid, const FractureTrace<2>& trace);
/// The same of a whole model; also throws where it lies along the edge of the model.
FacesOfTrace check_on_faces(const Grid<2>& grid, const FractureTrace<2>& trace);

/// The first set whose fractures part faces; null where none does.
template <int D>
const FractureSet<D>* first_on_faces(const std::vector<FractureSet<D>>& sets) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [](const auto& set) { return set.on_faces && gives(set); });
  return found == sets.end() ? nullptr : &*found;
}

/// The faces that the fractures on faces of all sets part in the part of the model that the grid holds, by
/// axis and cell; those at which rock ends on one side or both are left out and counted. Near tips they are
/// springs, so that the fracture ends where its trace does (S37). In 3-D there are none.
template <int D>
std::vector<PartedFace<D>> parted_faces(const Model<D>& model, std::int64_t* left = nullptr);

}  // namespace slipwave
