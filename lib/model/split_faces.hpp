// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "fracture/face_law.hpp"
#include "model/model.hpp"

/// Single fractures on faces between cells (docs/theory/fractures.md): the rock on both sides moves apart
/// there.
namespace slipwave {

/// A face where a single fracture parts the rock, before the cell `behind` along an axis, its compliances,
/// m/Pa, infinite where it is open, and its friction.
template <int D>
struct SplitFace {
  Index<D> behind{};
  int axis = 0;
  double normal_m_per_pa = 0, tangential_m_per_pa = 0;
  FaceLaw law = {};

  /// Whether both sides may move apart across it (pair 0) or along it.
  bool parts(int pair) const {
    return pair == 0 ? normal_m_per_pa > 0 || law.opens : tangential_m_per_pa > 0 || law.slides();
  }
  /// Whether the sides pull each other back.
  bool springs() const {
    const auto spring = [](double compliance) { return compliance > 0 && std::isfinite(compliance); };
    return spring(normal_m_per_pa) || spring(tangential_m_per_pa);
  }
  /// The cell on the other side; that behind it at the first row of a part of the model.
  Index<D> before() const {
    auto at = behind;
    if (at[std::size_t(axis)] > 0) --at[std::size_t(axis)];
    return at;
  }
};

/// This is where a level or upright fracture lies among the faces of the whole model.
struct FacesOfTrace {
  int axis = 0;                // across it
  std::int64_t face = 0;       // before the cell of that number along the axis
  double first = 0, last = 0;  // its tips along the other axis, in cells from the corner of the model
  double moved_m = 0;          // from where it is given to this face
};

/// Throws a usage Error where it is neither level nor upright, bends, is shorter than three cells, or rows at
/// it are not level and as high as cells are wide; the grid may be part of that of the model.
FacesOfTrace faces_of(const Grid<2>& grid, const FractureTrace<2>& trace);
/// Returns the faces of a fracture in a whole model; also throws where it lies along the edge of the model.
FacesOfTrace check_on_faces(const Grid<2>& grid, const FractureTrace<2>& trace);

/// Whether single fractures of a set part faces.
template <int D>
bool parts_faces(const FractureSet<D>& set) {
  return set.on_faces && (gives(set) || slides(set));
}
/// The first such set; null where none does.
template <int D>
const FractureSet<D>* first_on_faces(const std::vector<FractureSet<D>>& sets) {
  const auto found = std::find_if(sets.begin(), sets.end(), parts_faces<D>);
  return found == sets.end() ? nullptr : &*found;
}

/// The faces that the fractures on faces of all sets part in the part of the model that the grid holds, by
/// axis and cell; those at which rock ends on one side or both are left out and counted. Near tips they are
/// springs, so that the fracture ends where its trace does (S37). In 3-D there are none. Throws an Error
/// where one with friction shares a face with another.
template <int D>
std::vector<SplitFace<D>> split_faces(const Model<D>& model, std::int64_t* left = nullptr);
template <>
std::vector<SplitFace<2>> split_faces(const Model<2>& model, std::int64_t* left);
template <>
std::vector<SplitFace<3>> split_faces(const Model<3>& model, std::int64_t* left);
/// Returns the faces that one set splits.
template <int D>
std::vector<SplitFace<D>> split_faces(const Model<D>& model, const FractureSet<D>& set);
template <>
std::vector<SplitFace<2>> split_faces(const Model<2>& model, const FractureSet<2>& set);
template <>
std::vector<SplitFace<3>> split_faces(const Model<3>& model, const FractureSet<3>& set);

}  // namespace slipwave
