#include "model/effective_medium.hpp"

#include <cmath>

#include "base/error.hpp"

namespace slipwave {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw Error(sentence, ErrorKind::usage); }

void check(const SlipSystem<2>& system) {
  if (!system.compliance.gives()) refuse("these planes do not give way, expected a compliance");
  if (system.slides()) refuse("an effective medium does not slide, expected planes without friction");
  if (system.compliance.damped()) refuse("an effective medium has no dashpots, expected springs alone");
  if (std::abs(system.normal[0] * system.normal[1]) > 1e-9)
    refuse("planes dip by " + shown(dip_of_normal(system.normal), 4) +
           " degrees, expected level or upright ones (0 or 90); planes that dip are springs");
}

}  // namespace

Stiffness effective_stiffness(const Stiffness& rock, const std::vector<SlipSystem<2>>& systems) {
  const double determinant = rock.c11 * rock.c33 - rock.c13 * rock.c13;
  double s11 = rock.c33 / determinant, s33 = rock.c11 / determinant, s55 = 1 / rock.c55;
  const double s13 = -rock.c13 / determinant;
  for (const auto& system : systems) {
    check(system);
    const auto of = compliance_in(system.compliance, rock.c33 - 2 * rock.c55, rock.c55);
    (std::abs(system.normal[0]) > 0.5 ? s11 : s33) += of.normal;
    s55 += of.tangential;
  }
  const double inverse = s11 * s33 - s13 * s13;
  return {s33 / inverse, -s13 / inverse, s11 / inverse, 1 / s55};
}

FractureCount make_effective(Model<2>& model, const std::vector<SlipSystem<2>>& systems,
                             const std::function<bool(const Point<2>&)>& inside) {
  FractureCount count;
  const auto cells = find_solid_cells(model, inside, count);
  auto& medium = model.medium;
  for (const auto property : {Property::epsilon, Property::delta})
    if (!medium.has(property)) medium[property] = Field<2>(medium.grid());
  for (const auto cell : cells) {
    if (has_tilted_axis(medium, cell))
      refuse("the rock of the cell at " + place_of(model.grid(), std::int64_t(cell)) +
             " has a tilted axis, expected an upright one or isotropic rock; leave --effective out, or the "
             "tilt");
    const auto stiffness = effective_stiffness(stiffness_of(medium, cell), systems);
    if (stiffness.c33 <= stiffness.c55)
      refuse("in the cell at " + place_of(model.grid(), std::int64_t(cell)) +
             " P waves across the planes would be slower than S waves; expected less normal compliance, or "
             "leave --effective out and the planes are springs");
    put(medium, cell, material_of_stiffness(stiffness, double(medium.rho[cell])));
  }
  return count;
}

}  // namespace slipwave
