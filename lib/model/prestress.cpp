// SPDX-License-Identifier: BSD-3-Clause
#include "model/prestress.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"
#include "fracture/coulomb.hpp"
#include "model/split_faces.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

constexpr double gravity_m_s2 = 9.80665;
// Room for the rounding of stresses to float: planes at the verge of slip are welcome.
constexpr double rounding_share = 1e-6;

/// Mass above the centre of each cell on a unit area, kg/m2. z is the last axis.
template <int D>
std::vector<double> mass_above(const Medium<D>& medium) {
  const auto& grid = medium.grid();
  std::vector<double> mass(medium.rho.size());
  for (std::int64_t n = 0; n < grid.size(); ++n) {
    auto at = grid.index(n);
    const double half = 0.5 * grid.height(at) * double(medium.rho[std::size_t(n)]);
    mass[std::size_t(n)] = half;
    if (--at[D - 1] < 0) continue;
    const auto above = std::size_t(grid.flat(at));
    mass[std::size_t(n)] += mass[above] + 0.5 * grid.height(at) * double(medium.rho[above]);
  }
  return mass;
}

double k0_of_uniaxial_strain(const Material& of, int axis) {
  const auto c = upright_elasticity<3>(of);
  if (axis == 1 && (of.orthorhombic || of.constants)) return c(2, 3) / c(3, 3);
  if (of.is_anisotropic()) return c(1, 3) / c(3, 3);
  return 1 - 2 * (of.vs / of.vp) * (of.vs / of.vp);
}

Lithostatic parse_lithostatic(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {};
  const double k0 = parse_number(text.substr(colon + 1));
  if (!(k0 >= 0)) throw Error("found K0 of " + shown(k0) + ", expected it not below zero", ErrorKind::usage);
  return {k0};
}

}  // namespace

template <>
const std::vector<std::string>& stress_names<2>() {
  static const std::vector<std::string> names = {"sxx", "szz", "sxz"};
  return names;
}

template <>
const std::vector<std::string>& stress_names<3>() {
  static const std::vector<std::string> names = {"sxx", "syy", "szz", "sxy", "sxz", "syz"};
  return names;
}

template <int D>
Prestress<D> parse_prestress(const std::string& text) {
  if (text == "none") return std::monostate{};
  if (text == "lithostatic" || text.starts_with("lithostatic:")) return parse_lithostatic(text);
  std::vector<double> numbers;
  try {
    numbers = parse_numbers(text, ',');
  } catch (const Error&) {
    numbers.clear();  // said below, with all there is to choose from
  }
  SymmetricTensor<D, double> stress;
  if (numbers.size() == 1) {
    for (int i = 0; i < D; ++i) stress(i, i) = -numbers[0];
    return stress;
  }
  if (numbers.size() != stress.values.size()) {
    std::string all;
    for (const auto& name : stress_names<D>()) all += (all.empty() ? "" : ",") + name;
    throw Error(
        "found '" + text + "', expected none, lithostatic, lithostatic:K0, a pressure or " + all + " in Pa",
        ErrorKind::usage);
  }
  std::copy(numbers.begin(), numbers.end(), stress.values.begin());
  return stress;
}

namespace {

/// Returns the cells of a set, ascending; of one on faces those beside its faces without a set of their own.
template <int D>
std::vector<std::size_t> cells_under_prestress(const Model<D>& model, std::size_t code) {
  std::vector<std::size_t> cells;
  if (!model.fracture_sets[code - 1].on_faces) {
    for (std::size_t cell = 0; cell < model.fracture.size(); ++cell)
      if (model.fracture[cell] == code) cells.push_back(cell);
    return cells;
  }
  for (const auto& face : split_faces(model, model.fracture_sets[code - 1]))
    for (const auto& at : {face.before(), face.behind}) {
      const auto cell = std::size_t(model.grid().flat(at));
      if (model.fracture[cell] == 0) cells.push_back(cell);
    }
  return cells;
}

}  // namespace

template <int D>
void set_prestress(Model<D>& model, std::size_t code, const Prestress<D>& prestress) {
  using Tensor = SymmetricTensor<D, double>;
  if (model.prestress_pa.empty()) {
    if (std::holds_alternative<std::monostate>(prestress)) return;
    model.prestress_pa.assign(Tensor::components, Field<D>(model.grid()));
  }
  const auto* const tensor = std::get_if<Tensor>(&prestress);
  const auto* const weight = std::get_if<Lithostatic>(&prestress);
  const auto mass = weight ? mass_above(model.medium) : std::vector<double>();
  const auto cells = cells_under_prestress(model, code);
  for (const auto cell : cells) {
    Tensor stress;
    if (tensor) stress = *tensor;
    if (weight) {
      const double vertical = -gravity_m_s2 * mass[cell];
      const auto of = material_of(model.medium, cell);
      for (int i = 0; i < D; ++i)
        stress(i, i) = i == D - 1 ? vertical : weight->k0.value_or(k0_of_uniaxial_strain(of, i)) * vertical;
    }
    for (std::size_t c = 0; c < stress.values.size(); ++c)
      model.prestress_pa[c][cell] = float(stress.values[c]);
  }
}

namespace {

/// Checks the prestress of planes on faces.
template <int D>
void check_prestress_of_faces(const Model<D>& model) {
  for (const auto& face : split_faces(model)) {
    const auto& law = face.law;
    if (!law.any()) continue;
    const auto [normal, shear] = law.prestress_pa;
    const double rounding = rounding_share * (std::abs(normal) + std::abs(shear));
    const auto refuse = [&](const std::string& found) {
      throw Error("the prestress at " + place_of(model.grid(), model.grid().flat(face.behind)) + ' ' + found);
    };
    if (!std::isfinite(normal + shear)) refuse("of a fracture on faces is not finite, expected numbers");
    if (law.opens && normal > rounding)
      refuse("pulls a fracture on faces apart by " + shown(normal, 4) +
             " Pa; planes that may open must be under compression");
    if (std::abs(shear) > law.strength_pa(normal) + rounding)
      refuse("shears a fracture on faces by " + shown(std::abs(shear), 4) +
             " Pa, expected at most its strength of " + shown(law.strength_pa(normal), 4) + " Pa");
  }
}

}  // namespace

template <int D>
void check_prestress(const Model<D>& model) {
  if (model.prestress_pa.empty() || model.fracture.empty()) return;
  check_prestress_of_faces(model);
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    const std::size_t code = model.fracture[cell];
    if (code == 0) continue;
    SymmetricTensor<D, double> stress;
    double largest = 0;
    bool finite = true;
    for (std::size_t c = 0; c < stress.values.size(); ++c) {
      stress.values[c] = double(model.prestress_pa[c][cell]);
      finite &= std::isfinite(stress.values[c]);
      largest = std::max(largest, std::abs(stress.values[c]));
    }
    const auto refuse = [&](const std::string& verb, const std::string& rest) {
      throw Error("the prestress at " + place_of(model.grid(), std::int64_t(cell)) + ' ' + verb +
                  " the planes of fracture set " + std::to_string(code) + " '" +
                  model.fracture_sets[code - 1].name + "' " + rest);
    };
    if (!finite) refuse("on", "is not finite, expected numbers");
    for (const auto& system : model.fracture_sets[code - 1].systems) {
      if (!system.slides()) continue;
      Point<D> traction{};
      const double normal = resolve<D, double>(system.normal, stress, traction);
      const double shear = length<D, double>(traction), rounding = rounding_share * largest;
      const double strength = Coulomb::strength<double>(
          {.friction = system.friction, .cohesion_pa = system.strength_pa}, normal, 0);
      if (system.opens && normal > rounding)
        refuse("pulls",
               "apart by " + shown(normal, 4) + " Pa; planes that may open must be under compression");
      if (shear > strength + rounding)
        refuse("shears", "by " + shown(shear, 4) + " Pa, expected at most their strength of " +
                             shown(strength, 4) + " Pa");
    }
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_prestress);
SLIPWAVE_INSTANTIATE_D(FUNCTION, set_prestress);
SLIPWAVE_INSTANTIATE_D(FUNCTION, check_prestress);

}  // namespace slipwave
