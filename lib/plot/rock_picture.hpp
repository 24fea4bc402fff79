// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"
#include "plot/page.hpp"
#include "plot/picture.hpp"
#include "rock/attenuation.hpp"
#include "rock/averaging.hpp"

namespace slipwave::plot {

/// What a model is made of at a point.
struct RockAt {
  Material material;   // of a cell that an interface cuts its mean about the normal
  double qp, qs;       // infinite where it does not attenuate
  std::string place;   // as words tell it
  bool in_3d = false;  // of a model in 3-D

  bool attenuates() const;
};

/// Returns the rock of the cell that holds a point in 2-D or 3-D. Throws a usage Error where there is none,
/// or void.
template <int D>
RockAt rock_at(const Model<D>& model, const Point<D>& point_m);

/// Phase speeds of waves by the angle of their fronts from the vertical (theory.md (V3)), in 3-D of all
/// three in the planes of x and z and of y and z (O3); with `attenuation`,
/// where the rock attenuates, the quality factors and the speeds by frequency of the mechanisms that sweeps
/// would relax ((Q1)-(Q6)), along the axis of anisotropic rock, and its quality factors by angle (Q9), in
/// space in the plane of its axes 1 and 3.
Picture draw_rock(const RockAt& rock, const std::optional<Attenuation>& attenuation, Page page);

}  // namespace slipwave::plot
