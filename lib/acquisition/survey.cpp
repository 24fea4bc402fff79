#include "acquisition/survey.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {

template <int D>
void check_inside(const std::string& what, const Point<D>& point, const Grid<D>& grid) {
  const Point<D> at = grid.row_coordinates(point);
  bool inside = true;
  for (int axis = 0; axis < D; ++axis)
    inside = inside && at[axis] >= grid.origin_m[axis] && at[axis] <= grid.end(axis);
  if (inside) return;
  std::string place, extent;
  for (int axis = 0; axis < D; ++axis) {
    const std::string name(1, axis_names<D>()[axis]), separator = axis == 0 ? "" : " ";
    place += separator + name + "=" + shown(point[axis]);
    const bool bent = axis == D - 1 && grid.rows;
    const auto depths = bent ? grid.depths_at(point) : std::array{grid.origin_m[axis], grid.end(axis)};
    extent += separator + name + "=" + shown(depths[0]) + ".." + shown(depths[1]) + (bent ? " there" : "");
  }
  throw Error(what + " at " + place + " lies outside the model, expected " + extent);
}

template <int D>
void check(const Survey<D>& survey, const Grid<D>& grid) {
  for (std::size_t n = 0; n < survey.sources.size(); ++n) {
    const auto& source = survey.sources[n];
    if (!std::isfinite(source.amplitude))
      throw Error("source " + std::to_string(n + 1) +
                  ": found an amplitude that is not finite, expected a number");
    if (!std::holds_alternative<PlaneWave<D>>(source.mechanism))
      check_inside<D>("source " + std::to_string(n + 1), source.position_m, grid);
  }
  for (std::size_t n = 0; n < survey.receivers_m.size(); ++n)
    check_inside<D>("receiver " + std::to_string(n + 1), survey.receivers_m[n], grid);
}

template void check_inside<2>(const std::string&, const Point<2>&, const Grid<2>&);
template void check_inside<3>(const std::string&, const Point<3>&, const Grid<3>&);
template void check<2>(const Survey<2>&, const Grid<2>&);
template void check<3>(const Survey<3>&, const Grid<3>&);

}  // namespace slipwave
