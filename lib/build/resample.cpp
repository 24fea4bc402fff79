// SPDX-License-Identifier: BSD-3-Clause
#include "build/resample.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "geology/layers.hpp"
#include "model/cluster_shares.hpp"
#include "model/single_fracture.hpp"
#include "model/split_faces.hpp"
#include "rock/averaging.hpp"
#include "rock/elasticity.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

/// Along one axis, where the centre of a new cell lies among the old ones.
struct Foot {
  std::int64_t nearest = 0;        // the old cell it lies in
  std::int64_t low = 0, high = 0;  // the old centres on either side; -1 outside
  double share = 0;                // of `high`
};

std::vector<Foot> feet_of(std::int64_t old_count, double old_step, std::int64_t new_count, double new_step) {
  std::vector<Foot> feet(std::size_t(new_count), Foot{});
  for (std::int64_t i = 0; i < new_count; ++i) {
    const double at = (double(i) + 0.5) * new_step / old_step;  // in old cells from the edge
    Foot& foot = feet[std::size_t(i)];
    // A centre on a face (to rounding) belongs to the far cell.
    foot.nearest = std::clamp<std::int64_t>(std::int64_t(std::floor(at + 1e-9)), 0, old_count - 1);
    const double low = std::floor(at - 0.5);
    foot.share = at - 0.5 - low;
    foot.low = std::int64_t(low);
    foot.high = foot.low + 1 < old_count ? foot.low + 1 : -1;
  }
  return feet;
}

/// A corner of the cube of old centres round a new one.
struct Corner {
  std::size_t cell = 0;
  double weight = 0;
};

/// The corners of the kind of `nearest`, their weights summing to 1.
template <int D>
std::vector<Corner> corners_of(const Medium<D>& medium, const std::array<const Foot*, D>& feet,
                               std::size_t nearest) {
  const Material kind = material_of(medium, nearest);
  std::vector<Corner> corners;
  double sum = 0;
  for (int corner = 0; corner < 1 << D; ++corner) {
    Index<D> at{};
    double weight = 1;
    bool inside = true;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const bool high = corner >> axis & 1;
      at[axis] = high ? feet[axis]->high : feet[axis]->low;
      weight *= high ? feet[axis]->share : 1 - feet[axis]->share;
      inside = inside && at[axis] >= 0;
    }
    if (!inside || weight == 0) continue;
    const auto cell = std::size_t(medium.grid().flat(at));
    if (!same_kind(material_of(medium, cell), kind)) continue;
    corners.push_back({cell, weight});
    sum += weight;
  }
  // The nearest cell is one of the corners but for rounding on a face.
  if (corners.empty()) return {{nearest, 1}};
  for (auto& corner : corners) corner.weight /= sum;
  return corners;
}

/// Linear in the property, or in its inverse where that is what averages.
template <int D>
float blend(const Field<D>& field, const std::vector<Corner>& corners, Mean rule) {
  if (rule == Mean::harmonic) {
    ScalarMean mean(rule, field[corners.front().cell]);
    for (const auto& corner : corners)
      if (corner.weight > 0) mean.add(field[corner.cell], corner.weight);
    return float(mean.mean());
  }
  // Sums of differences keep a constant exactly constant.
  const double base = double(field[corners.front().cell]);
  double value = base;
  for (const auto& corner : corners) value += corner.weight * (double(field[corner.cell]) - base);
  return float(value);
}

/// Makes what was blended the rock of the constants that are linear between those of all corners, where one
/// of them has elastic constants.
template <int D>
void blend_constants(const Medium<D>& medium, const std::vector<Corner>& corners, Medium<D>& to,
                     std::size_t cell) {
  if (std::none_of(corners.begin(), corners.end(),
                   [&](const Corner& corner) { return has_constants(medium, corner.cell); }))
    return;
  Elasticity<3> stiffness;
  for (const auto& [from, weight] : corners)
    stiffness.voigt = sum_of(stiffness.voigt, elasticity_of<3>(material_of(medium, from)).voigt, weight);
  put(to, cell, rock_of_constants(stiffness, double(to.rho[cell])));
}

/// Planes with friction on faces keep the prestress of both sides, which stands in the cells beside them
/// alone.
void keep_prestress_of_faces(const Model<2>& from, Model<2>& to) {
  const auto& old = from.grid();
  for (auto set : from.fracture_sets) {
    if (from.prestress_pa.empty() || !set.on_faces || !slides(set)) continue;
    for (const auto& trace : std::exchange(set.traces, {})) {
      set.traces = {trace};
      const auto of = faces_of(old, trace);
      const auto across = std::size_t(of.axis), along = 1 - across;
      for (const auto& face : split_faces(to, set))
        for (const std::int64_t side : {1, 0}) {
          const auto at = side == 1 ? face.before() : face.behind;
          const auto cell = std::size_t(to.grid().flat(at));
          if (to.fracture[cell] != 0) continue;
          Index<2> source{};
          source[across] = of.face - side;
          // New faces may reach beyond the old ones at tips.
          source[along] =
              std::clamp(std::int64_t((double(at[along]) + 0.5) * to.grid().spacing_m / old.spacing_m),
                         std::max(std::int64_t(std::floor(of.first)), std::int64_t(0)),
                         std::min(std::int64_t(std::ceil(of.last)), old.shape[along]) - 1);
          for (std::size_t c = 0; c < from.prestress_pa.size(); ++c)
            to.prestress_pa[c][cell] = from.prestress_pa[c][std::size_t(old.flat(source))];
        }
    }
  }
}
void keep_prestress_of_faces(const Model<3>&, Model<3>&) {}

/// `model` on cells of another size: no values yet, and per axis where their centres lie.
template <int D>
struct Regridding {
  Model<D> model;
  std::array<std::vector<Foot>, D> feet;

  Regridding(const Model<D>& from, double spacing_m, Extent extent = Extent::kept) {
    const auto& old = from.grid();
    Point<D> size{};
    for (std::size_t axis = 0; axis < D; ++axis) size[axis] = double(old.shape[axis]) * old.spacing_m;
    Grid<D> grid = extent == Extent::kept ? grid_of_size<D>(size, spacing_m) : grid_over<D>(size, spacing_m);
    grid.origin_m = old.origin_m;
    for (std::size_t axis = 0; axis < D; ++axis)
      feet[axis] = feet_of(old.shape[axis], old.spacing_m, grid.shape[axis], spacing_m);
    model = without_values(from, grid);
    // Where interfaces lie in old cells is not known.
    drop_tilted_means(model.medium);
  }

  /// Calls fill(new cell, its index, the old cell its centre lies in) and takes over the fractures and their
  /// prestress.
  template <class Fill>
  Model<D> filled(const Model<D>& from, Fill&& fill) {
    for (std::int64_t n = 0; n < model.grid().size(); ++n) {
      const auto at = model.grid().index(n);
      Index<D> nearest{};
      for (std::size_t axis = 0; axis < D; ++axis) nearest[axis] = feet[axis][std::size_t(at[axis])].nearest;
      const auto source = std::size_t(from.grid().flat(nearest)), cell = std::size_t(n);
      if (!from.fracture.empty()) model.fracture[cell] = from.fracture[source];
      if (!from.fracture_share.empty()) model.fracture_share[cell] = from.fracture_share[source];
      for (std::size_t c = 0; c < from.prestress_pa.size(); ++c)
        model.prestress_pa[c][cell] = from.prestress_pa[c][source];
      fill(cell, at, source);
    }
    place_single_fractures(model);
    keep_prestress_of_faces(from, model);
    return std::move(model);
  }
};

/// Along one axis, the old cells that a new one overlaps, and the length of each overlap in old cells.
struct Overlap {
  std::int64_t first = 0;
  std::vector<double> lengths;
};

std::vector<Overlap> overlaps_of(std::int64_t old_count, double old_step, std::int64_t new_count,
                                 double new_step) {
  constexpr double rounding = 1e-6;  // what grid_of_size lets pass as a whole number
  std::vector<Overlap> overlaps(std::size_t(new_count), Overlap{});
  for (std::int64_t i = 0; i < new_count; ++i) {
    const double low = double(i) * new_step / old_step, high = double(i + 1) * new_step / old_step;
    const auto first = std::min(std::int64_t(std::floor(low + rounding)), old_count - 1);
    const auto last = std::min(std::int64_t(std::ceil(high - rounding)), old_count);
    Overlap& overlap = overlaps[std::size_t(i)];
    overlap.first = first;
    for (std::int64_t old = first; old < last; ++old)
      overlap.lengths.push_back(std::min(high, double(old + 1)) - std::max(low, double(old)));
  }
  return overlaps;
}

template <int D>
void check_regular(const Grid<D>& grid) {
  if (grid.rows) throw Error("found rows that follow horizons, expected a regular grid");
}

}  // namespace

template <int D>
Model<D> regridded(const Model<D>& model, double spacing_m, Extent extent) {
  if (model.grid().rows) return refitted(model, spacing_m, extent);
  Regridding<D> to(model, spacing_m, extent);
  const auto& from = model.grid();
  auto by_themselves = model.medium.properties();  // those whose means depend on nothing else
  std::erase_if(by_themselves, [](Property property) { return row_of(property).mean == Mean::elastic; });
  std::array<std::vector<Overlap>, D> overlaps;
  for (std::size_t axis = 0; axis < D; ++axis) {
    overlaps[axis] = overlaps_of(from.shape[axis], from.spacing_m, to.model.grid().shape[axis], spacing_m);
  }
  ClusterShares<D> shares(model, to.model);
  return to.filled(model, [&](std::size_t cell, const Index<D>& at, std::size_t source) {
    Grid<D> block;  // the old cells that the new one overlaps
    for (std::size_t axis = 0; axis < D; ++axis)
      block.shape[axis] = std::int64_t(overlaps[axis][std::size_t(at[axis])].lengths.size());
    MaterialMean mean(material_of(model.medium, source), model.medium.has(Property::c33));
    std::vector<ScalarMean> scalars;
    for (const Property property : by_themselves)
      scalars.emplace_back(row_of(property).mean, model.medium[property][source]);
    for (std::int64_t n = 0; n < block.size(); ++n) {
      Index<D> old = block.index(n);
      double volume = 1;
      for (std::size_t axis = 0; axis < D; ++axis) {
        const Overlap& overlap = overlaps[axis][std::size_t(at[axis])];
        volume *= overlap.lengths[std::size_t(old[axis])];
        old[axis] += overlap.first;
      }
      const auto part = std::size_t(from.flat(old));
      shares.add(part, volume);
      if (!mean.add(material_of(model.medium, part), volume)) continue;
      for (std::size_t n = 0; n < scalars.size(); ++n)
        scalars[n].add(model.medium[by_themselves[n]][part], volume);
    }
    put(to.model.medium, cell, mean.mean());
    for (std::size_t n = 0; n < scalars.size(); ++n)
      to.model.medium[by_themselves[n]][cell] = float(scalars[n].mean());
    shares.put(cell);
  });
}

template <int D>
Model<D> resampled(const Model<D>& model, double spacing_m, bool average, Extent extent) {
  check_regular(model.grid());
  if (average && spacing_m > model.grid().spacing_m) return regridded(model, spacing_m, extent);
  Regridding<D> to(model, spacing_m, extent);
  const auto properties = to.model.medium.properties();
  return to.filled(model, [&](std::size_t cell, const Index<D>& at, std::size_t source) {
    std::array<const Foot*, D> round{};
    for (std::size_t axis = 0; axis < D; ++axis) round[axis] = &to.feet[axis][std::size_t(at[axis])];
    const auto corners = corners_of<D>(model.medium, round, source);
    for (const Property property : properties)
      to.model.medium[property][cell] = blend(model.medium[property], corners, row_of(property).mean);
    blend_constants(model.medium, corners, to.model.medium, cell);
  });
}

template <int D>
Model<D> cropped(const Model<D>& model, const Box<D>& box) {
  check_regular(model.grid());
  const auto& from = model.grid();
  Grid<D> grid = from;
  Index<D> first{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double h = from.spacing_m, slack = 1e-6 * h;
    const int a = int(axis);
    if (box.low_m[axis] < from.origin_m[axis] - slack || box.high_m[axis] > from.end(a) + slack) {
      throw Error(std::string("found ") + axis_names<D>()[axis] + " from " + shown(box.low_m[axis]) + " to " +
                      shown(box.high_m[axis]) + ", expected it within the model, " +
                      shown(from.origin_m[axis]) + " to " + shown(from.end(a)),
                  ErrorKind::usage);
    }
    const auto low = std::int64_t(std::ceil((box.low_m[axis] - from.origin_m[axis] - slack) / h - 0.5));
    const auto high = std::int64_t(std::floor((box.high_m[axis] - from.origin_m[axis] + slack) / h - 0.5));
    first[axis] = std::max<std::int64_t>(low, 0);
    grid.shape[axis] = std::min(high, from.shape[axis] - 1) - first[axis] + 1;
    if (grid.shape[axis] < 1)
      throw Error("the box holds no cell centre, expected at least one", ErrorKind::usage);
    grid.origin_m[axis] = from.origin_m[axis] + double(first[axis]) * h;
  }
  grid.origin_m[D - 1] = 0;
  auto result = without_values(model, grid);
  // Depths count from another top.
  result.geology.layers.clear();
  result.geology.marmousi.reset();
  for (auto& set : result.fracture_sets)
    for (auto& trace : set.traces)
      for (auto& vertex : trace) vertex[D - 1] -= double(first[D - 1]) * from.spacing_m;
  const auto properties = model.medium.properties();
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    auto at = grid.index(n);
    for (std::size_t axis = 0; axis < D; ++axis) at[axis] += first[axis];
    const auto source = std::size_t(from.flat(at)), cell = std::size_t(n);
    for (const Property property : properties) result.medium[property][cell] = model.medium[property][source];
    if (!model.fracture.empty()) result.fracture[cell] = model.fracture[source];
    if (!model.fracture_share.empty()) result.fracture_share[cell] = model.fracture_share[source];
    for (std::size_t c = 0; c < model.prestress_pa.size(); ++c)
      result.prestress_pa[c][cell] = model.prestress_pa[c][source];
  }
  return result;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, regridded);
SLIPWAVE_INSTANTIATE_D(FUNCTION, resampled);
SLIPWAVE_INSTANTIATE_D(FUNCTION, cropped);

}  // namespace slipwave
