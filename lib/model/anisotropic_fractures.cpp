// SPDX-License-Identifier: BSD-3-Clause
#include "model/anisotropic_fractures.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "model/fracture.hpp"
#include "model/split_faces.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

const char* const planes_open = "open, expected closed ones";

/// Says of planes that lie askew why this is not computed, and what would be.
template <int D>
std::string askew(const std::string& what, const std::string& and_what, bool tilted) {
  if (D == 3)
    return what + ", expected one level family in rock of level beds with gamma2 = gamma, or isotropic rock";
  if (tilted) return what + " in rock whose axes are tilted, expected axes along the grid or isotropic rock";
  return and_what + " and lie askew to the axes of rock, expected along both or in isotropic rock";
}

/// What keeps the planes of a set from slipping in an anisotropic cell, or "".
template <int D>
std::string fault_of(const FractureSet<D>& set, const Medium<D>& medium, std::size_t cell) {
  const auto any = [&](const auto& is) { return std::any_of(set.systems.begin(), set.systems.end(), is); };
  if (any([](const auto& system) { return system.opens; })) return planes_open;
  if (!lie_askew(set, medium, cell)) return "";
  const bool tilted = has_tilted_axis(medium, cell);
  if (gives(set)) {
    if (D == 3 && !set.is_cluster()) return "are springs of single fractures, expected isotropic rock";
    const std::string springs = "are springs that slide or have dashpots";
    if (any([](const auto& system) { return system.slides() || system.compliance.damped(); }))
      return askew<D>(springs, springs, tilted);
  }
  if (set.systems.size() > 1 &&
      any([](const auto& system) { return system.law == FrictionLaw::slip_weakening; }))
    return askew<D>("cross and weaken with slip", "cross, weaken with slip", tilted);
  return "";
}

template <int D>
std::string shown_anisotropy(const Medium<D>& medium, std::size_t cell) {
  const auto value = [&](Property property) { return shown(medium.value(property, cell), 6); };
  if (has_constants(medium, cell)) return "(by elastic constants)";
  return "(epsilon " + value(Property::epsilon) + ", delta " + value(Property::delta) +
         (D == 3 ? ", gamma " + value(Property::gamma) : "") +
         (has_tilted_axis(medium, cell) ? ", tilt " + value(Property::tilt) : "") +
         (D == 3 && has_tilted_axis(medium, cell) ? ", azimuth " + value(Property::azimuth) : "") + ")";
}

}  // namespace

template <int D>
std::optional<AnisotropicFault> fault_in_anisotropic_rock(const Model<D>& model) {
  const auto& medium = model.medium;
  if (anisotropic_cells(medium) == 0) return std::nullopt;
  const auto& grid = model.grid();
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    if (model.fracture[cell] == 0 || !is_anisotropic(medium, cell)) continue;
    const auto& set = model.fracture_sets[model.fracture[cell] - 1U];
    const auto fault = fault_of(set, medium, cell);
    if (fault.empty()) continue;
    return AnisotropicFault{"the cell at " + place_of(grid, std::int64_t(cell)) + " is anisotropic " +
                                shown_anisotropy(medium, cell) + " and the planes of its fracture set '" +
                                set.name + "' " + fault,
                            fault == planes_open};
  }
  const auto* const on_faces = first_on_faces(model.fracture_sets);
  if (!on_faces) return std::nullopt;
  for (const auto& face : split_faces(model)) {
    const auto cell = grid.flat(face.behind);
    if (is_anisotropic(medium, std::size_t(cell)))
      return AnisotropicFault{"found anisotropic rock at " + place_of(grid, cell) +
                              " in a model whose fractures '" + on_faces->name +
                              "' lie on faces, expected isotropic rock there"};
  }
  return std::nullopt;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, fault_in_anisotropic_rock);

}  // namespace slipwave
