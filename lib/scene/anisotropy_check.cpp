#include "scene/anisotropy_check.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "model/anisotropy.hpp"
#include "model/fracture.hpp"

namespace slipwave {
namespace {

const char* const isotropic_instead = " or --without anisotropy";

/// What keeps the planes of a set from slipping in an anisotropic cell, or "".
template <int D>
std::string fault_of(const FractureSet<D>& set, bool askew) {
  const auto any = [&](const auto& is) { return std::any_of(set.systems.begin(), set.systems.end(), is); };
  if (any([](const auto& system) { return system.opens; })) return "open, expected closed ones";
  if (!askew) return "";
  const std::string askew_to_axes = D == 2 ? " and lie askew to the axes of rock" : "",
                    expected = D == 2 ? ", expected along both or in isotropic rock"
                                      : ", expected one level family in rock of level beds with gamma2 = "
                                        "gamma, or isotropic rock";
  if (gives(set)) {
    if (D == 3 && !set.traces.empty()) return "are springs of single fractures, expected isotropic rock";
    if (set.on_faces) return "are springs on faces" + askew_to_axes + expected;
    if (any([](const auto& system) { return system.slides() || system.compliance.damped(); }))
      return "are springs that slide or have dashpots" + askew_to_axes + expected;
  }
  if (set.systems.size() > 1 &&
      any([](const auto& system) { return system.law == FrictionLaw::slip_weakening; }))
    return "cross" + std::string(D == 2 ? ", weaken with slip" : " and weaken with slip") + askew_to_axes +
           expected;
  return "";
}

template <int D>
void check_cell(const Scene<D>& scene, std::size_t cell) {
  const auto& model = scene.model;
  const auto azimuth = [&](std::size_t of) {
    return D == 3 ? ", azimuth " + shown(model.medium.value(Property::azimuth, of), 6) : std::string();
  };
  const auto refuse = [&](const std::string& what) {
    throw Error("the cell at " + place_of(model.grid(), std::int64_t(cell)) + " is anisotropic (epsilon " +
                shown(model.medium.value(Property::epsilon, cell), 6) + ", delta " +
                shown(model.medium.value(Property::delta, cell), 6) +
                (D == 3 ? ", gamma " + shown(model.medium.value(Property::gamma, cell), 6) : "") +
                (has_tilted_axis(model.medium, cell)
                     ? ", tilt " + shown(model.medium.value(Property::tilt, cell), 6) + azimuth(cell)
                     : "") +
                ") and " + what);
  };
  if (!scene.slips() || model.fracture.empty() || model.fracture[cell] == 0) return;
  const auto& set = model.fracture_sets[model.fracture[cell] - 1U];
  if (const auto fault = fault_of(set, lie_askew(set, model.medium, cell)); !fault.empty())
    refuse("the planes of its fracture set '" + set.name + "' " + fault + "; use --without " +
           (fault.starts_with("open") ? "opening" : "slip") + isotropic_instead);
}

}  // namespace

template <int D>
void check_anisotropy(const Scene<D>& scene) {
  const auto& medium = scene.model.medium;
  // Ranks with other rows refuse what concerns the whole model, too.
  if (!scene.subdomain.anisotropic && anisotropic_cells(medium) == 0) return;
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
    if (is_anisotropic(medium, cell)) check_cell(scene, cell);
}

template void check_anisotropy(const Scene<2>&);
template void check_anisotropy(const Scene<3>&);

}  // namespace slipwave
