// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/stack_response.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// How cells represent an interface.
enum class Representation {
  on_faces,  // of the grid, level
  fitted,    // rows of cells follow it
  averaged,  // cells that it cuts have the mean of both rocks
  gradual,   // rock changes over several cells, as the model's history says that it was interpolated
  staircase  // of whole cells: fluid, solid or void by their centre
};

/// An interface of a model, as found in its cells from a source to its receivers.
struct LocalInterface {
  enum class Kind { surface, fluid_solid, inner };
  Kind kind = Kind::inner;
  Representation representation = Representation::on_faces;
  bool tilted = false;     // averaged: cells that it cuts are anisotropic about its normal (theory.md 1.11)
  bool sea_floor = false;  // of the first layer, a fluid, and a solid
  double depth_m = 0;      // below the source
  double dip_deg = 0;      // of the straight line nearest to it
  double steepest_deg = 0;
  /// Curvature d2z/dx2 of one that rows follow, 1/m: the fourth root of the mean of its fourth power.
  double curvature_per_m = 0;
  double stairs = 0;  // rows of cells that it crosses
  double cut = 0;     // where it is level, the share of the cells it cuts that lies above it
  /// Cells a side that are alike, as after a model was split: what geometry is known to.
  std::int64_t block = 1;
  double from_x_m = 0, to_x_m = 0;  // where it was followed
  bool x_is_known = true;           // that these are places of the model
  /// Where it leaves the model on the left and on the right, and its slope there: beyond, cells are as at the
  /// side, so it is level.
  struct Side {
    Point<2> at_m;
    double slope;
  };
  std::vector<Side> sides;
  /// Its true depth where it is level and the history of the model says it, m; that of the cells otherwise.
  double true_depth_m = 0;
  double contrast = 1;  // ratio of impedances of P, above 1; of S where that is larger
  bool is_curved() const { return steepest_deg > std::abs(dip_deg) + 3; }
  /// "sea floor at 400 m", "free surface", "interface at 700 m".
  std::string name() const;
};

/// What cells of a model were filled by, as far as its history tells: it knows how to do better.
enum class Maker { sw_layers, sw_marmousi, sw_import };

/// The layers round a source, flattened: each shot is taken as one over parallel layers with the dip that
/// the strongest interface has there.
struct LocalStack {
  std::vector<LocalInterface> interfaces;  // those of places.faces_m
  LayeredPlaces places;
  double dip_deg = 0;
  Maker maker = Maker::sw_layers;
  /// An interface too weak to be among those that are followed.
  struct LeftOut {
    double contrast = 1, away_m = 0;  // from the source
    double vp = 0, vs = 0;            // of the slower side
  };
  std::vector<LeftOut> left_out;
  /// A body of another matter that the source does not lie above: fluid in rock, rock in fluid, a cave.
  struct Body {
    double from_x_m, to_x_m;  // where it is found between source and receivers
    Point<2> nearest_m;       // its place nearest to the source
    double contrast = 1;      // ratio of impedances of P, above 1; infinite: of a cave
    double wide_m() const { return to_x_m - from_x_m; }
  };
  std::optional<Body> body;
  /// 1/qp and 1/qs of each layer where the scene attenuates; empty elsewhere.
  std::vector<std::array<double, 2>> losses;
};

/// One of the receivers of a shot and how many of them it stands for.
struct FollowedReceiver {
  std::size_t index;
  double count;
};
/// Each of those nearest to the source, which may record most, and ever fewer of those farther away: some
/// 10 + `most` in all, in their order.
std::vector<FollowedReceiver> followed_receivers(const Scene<2>& scene, std::size_t shot, std::size_t most);

/// Receivers in cells of fluid that have solid beside and above or below them: in corners of a staircase,
/// where they can move several times too much.
std::vector<std::size_t> receivers_in_corners(const Scene<2>& scene, std::size_t shot);

/// By which part what a source sends out is uncertain where rock changes from cell to cell: a twelfth of
/// the change between the neighbours of its cell of 1/(rho vp^3), which an explosion is in proportion to, or
/// of 1/rho.
double change_at_source(const Scene<2>& scene, std::size_t shot);
/// By which part the normal moments of an explosion in rock come to differ where softer rock lies beside its
/// cell, the nearer the more.
double unevenness_at_source(const Scene<2>& scene, std::size_t shot);

/// Of a shot with a point source and those receivers.
LocalStack local_stack(const Scene<2>& scene, std::size_t shot,
                       const std::vector<FollowedReceiver>& receivers);

}  // namespace slipwave
