// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/linear_slip.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/instantiate.hpp"
#include "base/last_found.hpp"
#include "base/small_matrix.hpp"
#include "model/cluster_edge.hpp"
#include "model/single_fracture.hpp"
#include "rock/anisotropy.hpp"
#include "scene/subdomains.hpp"
#include "solver/effect/slip_planes.hpp"

namespace slipwave::solver {
namespace {

/// Compliance of planes in a rock. Of cracks it is that in the isotropic rock with its vertical speeds.
template <int D>
CellCompliance compliance_in_rock(const SlipSystem<D>& system, bool below_friction,
                                  const Elasticity<D>& rock) {
  return compliance_of<D>(system, below_friction, rock(3, 3) - 2 * rock(5, 5), rock(5, 5));
}

template <int D>
using Tensor = SymmetricTensor<D, double>;

/// The rock of a cell: in the plane of x and z about its axis and, where that does not say all, as it lies in
/// the grid: in 2-D where the axis is tilted, in 3-D where rock is anisotropic.
template <int D>
struct Rock {
  Elasticity<D> upright;
  std::optional<Elasticity<D>> in_grid;
};
template <int D>
Rock<D> rock_in_grid(const Medium<D>& medium, std::size_t cell) {
  const auto material = material_of(medium, cell);
  Rock<D> rock{upright_elasticity<D>(material), {}};
  if (D == 2 ? has_tilted_axis(medium, cell) : is_anisotropic(medium, cell))
    rock.in_grid = elasticity_of<D>(material);
  return rock;
}

/// A strain with its shear components doubled, and back.
template <int D>
auto doubled_shear(Tensor<D> strain, double by = 2) {
  for (std::size_t c = D; c < strain.values.size(); ++c) strain.values[c] *= by;
  return strain.values;
}

/// Stress that belongs to a strain.
template <int D>
Tensor<D> stress_of(const Tensor<D>& strain, const Rock<D>& of) {
  if (of.in_grid) return {stress_of_strain<D>(*of.in_grid, doubled_shear(strain))};
  const Elasticity<D>& rock = of.upright;
  Tensor<D> stress;
  double trace = 0;
  for (int i = 0; i < D; ++i) trace += strain(i, i);
  for (std::size_t c = 0; c < strain.values.size(); ++c) stress.values[c] = 2 * rock(5, 5) * strain.values[c];
  for (int i = 0; i < D; ++i) {
    const double modulus = i + 1 == D ? rock(3, 3) : rock(1, 1);
    stress(i, i) = rock(1, 3) * (trace - strain(i, i)) + modulus * strain(i, i);
  }
  return stress;
}

/// Strain that belongs to a stress.
template <int D>
Tensor<D> strain_of(const Tensor<D>& stress, const Rock<D>& of) {
  if (of.in_grid) return {doubled_shear(Tensor<D>{strain_of_stress<D>(*of.in_grid, stress.values)}, 0.5)};
  const Elasticity<D>& rock = of.upright;
  Tensor<D> strain;
  for (std::size_t c = D; c < strain.values.size(); ++c)
    strain.values[c] = stress.values[c] / (2 * rock(5, 5));
  if constexpr (D == 2) {
    const double determinant = rock(1, 1) * rock(3, 3) - rock(1, 3) * rock(1, 3);
    strain(0, 0) = (rock(3, 3) * stress(0, 0) - rock(1, 3) * stress(1, 1)) / determinant;
    strain(1, 1) = (rock(1, 1) * stress(1, 1) - rock(1, 3) * stress(0, 0)) / determinant;
  } else {
    const double trace = stress(0, 0) + stress(1, 1) + stress(2, 2);
    for (int i = 0; i < D; ++i)
      strain(i, i) =
          (stress(i, i) - rock(1, 3) * trace / (3 * rock(1, 3) + 2 * rock(5, 5))) / (2 * rock(5, 5));
  }
  return strain;
}

/// Returns the modulus of a strain along the normal of planes, which are level or upright where rock is
/// anisotropic.
template <int D>
double modulus_across(const Point<D>& normal, const Elasticity<D>& rock) {
  return std::abs(normal[D - 1]) > 0.5 ? rock(3, 3) : rock(1, 1);
}

/// Strain of the planes of all families under a stress, dashpots at rest.
template <int D>
Tensor<D> strain_of_planes(const FractureSet<D>& set, const Tensor<D>& stress, const Elasticity<D>& rock) {
  Tensor<D> strain;
  for (const auto& system : set.systems) {
    const auto of = compliance_in_rock(system, slides(set), rock);
    const auto& n = system.normal;
    Point<D> tau;
    const double s_n = resolve<D, double>(n, stress, tau);
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t j = i; j < D; ++j)
        strain(int(i), int(j)) +=
            of.normal * s_n * n[i] * n[j] + of.tangential * (tau[i] * n[j] + n[i] * tau[j]) / 2;
  }
  return strain;
}

/// The strain of planes of a cell that the edge of the set cuts, as its mean: the stress s' in the part that
/// has planes is that of the cell less what the rest holds of their strain, s' + (1 - share) Q(Z s') = s
/// (S38). In anisotropic rock, and below friction, the part has the stress of the cell.
template <int D>
Tensor<D> strain_of_part(const FractureSet<D>& set, const Model<D>& model, std::size_t cell,
                         const Tensor<D>& stress) {
  const auto rock = upright_elasticity<D>(material_of(model.medium, cell));
  const double share = fracture_share_of(model, cell);
  const auto scaled = [share](Tensor<D> strain) {
    for (double& value : strain.values) value *= share;
    return strain;
  };
  if (slides(set) || is_anisotropic(model.medium, cell))
    return scaled(strain_of_planes<D>(set, stress, rock));
  const auto edge = edge_normal(model, cell);
  constexpr std::size_t n = std::size_t(Tensor<D>::components);
  SmallMatrix<n> of_part{};
  for (std::size_t k = 0; k < n; ++k) {
    Tensor<D> unit;
    unit.values[k] = 1;
    const auto held =
        held_strain<D, double>(strain_of_planes<D>(set, unit, rock), edge, rock(1, 3) / rock(3, 3));
    for (std::size_t c = 0; c < n; ++c)
      of_part[c][k] = unit.values[c] + (1 - share) * 2 * rock(5, 5) * held.values[c];
  }
  const Tensor<D> inside{solved(of_part, stress.values)};
  return scaled(strain_of_planes<D>(set, inside, rock));
}

/// Whether under every stress planes give way by more than the rock, times softness_without_stress.
template <int D>
bool carries_no_stress(const FractureSet<D>& set, const Medium<D>& medium, std::size_t cell) {
  constexpr std::size_t n = std::size_t(Tensor<D>::components);
  const auto rock = rock_in_grid(medium, cell);
  SmallMatrix<n> left{};
  for (std::size_t k = 0; k < n; ++k) {
    Tensor<D> unit;
    unit.values[k] = 1;
    const auto planes = doubled_shear(strain_of_planes<D>(set, unit, rock.upright));
    const auto alone = doubled_shear(strain_of<D>(unit, rock));
    for (std::size_t c = 0; c < n; ++c) left[c][k] = planes[c] - softness_without_stress * alone[c];
  }
  return is_positive(left);
}

/// The stiffness of rock and springs together (S26b), in the axes of the grid.
template <int D>
Elasticity<D> stiffness_with_springs(const FractureSet<D>& set, const Medium<D>& medium, std::size_t cell) {
  constexpr std::size_t n = Elasticity<D>::components;
  const auto rock = rock_in_grid(medium, cell);
  const auto each_pair = [](const auto& with) {
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) with(i, j, Elasticity<D>::pair(i, j));
  };
  SmallMatrix<n> compliance{};
  each_pair([&](int k, int l, std::size_t of_stress) {
    Tensor<D> unit;
    unit(k, l) = 1;
    const auto alone = strain_of<D>(unit, rock), of_planes = strain_of_planes<D>(set, unit, rock.upright);
    each_pair([&](int i, int j, std::size_t of_strain) {
      compliance[of_strain][of_stress] = (i == j ? 1 : 2) * (alone(i, j) + of_planes(i, j));
    });
  });
  Elasticity<D> stiffness;
  for (std::size_t k = 0; k < n; ++k) {
    std::array<double, n> unit{};
    unit[k] = 1;
    stiffness.voigt[k] = solved(compliance, unit);
  }
  return stiffness;
}

}  // namespace

template <int D>
std::function<std::optional<Elasticity<D>>(const Index<D>&)> stiffness_among_planes(const Domain<D>& domain,
                                                                                    const Model<D>& model) {
  if (model.fracture.empty()) return {};
  using Key = std::pair<std::size_t, Material>;  // the set's number and the rock
  return [&, last = LastFound<Key, Elasticity<D>>()](
             const Index<D>& at) mutable -> std::optional<Elasticity<D>> {
    const auto cell = std::size_t(model.grid().flat(domain.model_cell(at)));
    const std::size_t code = model.fracture[cell];
    if (code == 0 || !continues_outside(model, code - 1)) return {};
    return last({code, material_of(model.medium, cell)}, [&](const Key&) {
      return stiffness_with_springs(model.fracture_sets[code - 1], model.medium, cell);
    });
  };
}

template <int D>
std::vector<std::int64_t> soft_cells(const Domain<D>& domain, const Model<D>& model) {
  std::vector<std::int64_t> cells;
  std::vector<char> undamped;  // by set: clusters of such springs
  for (const auto& set : model.fracture_sets)
    undamped.push_back(gives(set) && set.is_cluster() &&
                       std::none_of(set.systems.begin(), set.systems.end(),
                                    [](const auto& system) { return system.compliance.damped(); }));
  if (std::none_of(undamped.begin(), undamped.end(), [](char of) { return of; })) return cells;
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
    const std::size_t code = model.fracture[cell];
    if (code == 0 || !undamped[code - 1] || is_cut(model, cell)) continue;
    if (!carries_no_stress(model.fracture_sets[code - 1], model.medium, cell)) continue;
    domain.each_like(model.grid().index(std::int64_t(cell)), continues_outside(model, code - 1),
                     [&](const Index<D>& at) { cells.push_back(domain.grid.flat(at)); });
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

template <int D, class Real>
LinearSlip<D, Real>::LinearSlip(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                double dt_s, double unit, InjectedStress<D, Real> injected)
    : state_(state),
      domain_(domain),
      model_(scene.model),
      unit_(unit),
      injected_(std::move(injected)),
      ahead_(scene.numerics.correction == SlipCorrection::first ? Real(0) : Real(0.5)) {
  const auto askew = askew_sets(scene);
  for (std::size_t number = 0; number < model_.fracture_sets.size(); ++number) {
    const auto& set = model_.fracture_sets[number];
    if (!gives(set) || set.on_faces) continue;
    for (const auto kind : {CellKind::whole, CellKind::cut})
      if (kind == CellKind::whole || (!model_.fracture_share.empty() && set.is_cluster()))
        add(set, FractureCells<D>(state.layout, domain, model_, number, kind), kind,
            askew[number][kind == CellKind::cut], dt_s);
  }
}

template <int D, class Real>
void LinearSlip<D, Real>::add(const FractureSet<D>& set, FractureCells<D> cells, CellKind kind, bool askew,
                              double dt_s) {
  if (cells.cells() == 0) return;
  Group group{std::move(cells), &set, {}, {}, {}, {}, {}};
  const auto any = [&](const auto& has) { return std::any_of(set.systems.begin(), set.systems.end(), has); };
  group.of = {D, set.systems.size() == 1 && set.is_cluster(),
              any([](const auto& s) { return s.compliance.damped(); }),
              any([](const auto& s) { return s.slides(); })};
  // The rest of a cell holds springs of its part in all directions; and strains across planes askew and along
  // them are not independent.
  if ((kind == CellKind::cut || askew) && !group.of.damped && !group.of.slides) group.of.one_family = false;
  group.planes = planes_of<D, Real>(set.systems, unit_);
  group.kernels = linear_slip_kernels<Real>(group.of);
  group.memory.assign(group.places.stored() * std::size_t(group.of.memory_rows()), 0);
  group.coefficients.assign(group.places.stored() * std::size_t(group.of.coefficient_rows()), 0);
  !set.is_cluster() ? add_single(group) : group.of.one_family ? add_family(group, dt_s) : add_crossing(group);
  groups_.push_back(std::move(group));
}

template <int D, class Real>
void LinearSlip<D, Real>::add_family(Group& group, double dt_s) const {
  group.places.each(state_.layout, domain_, model_, [&](std::size_t place, std::size_t cell, bool) {
    const auto rock = upright_elasticity<D>(material_of(model_.medium, cell));
    const auto& system = group.set->systems[0];
    const double modulus = modulus_across<D>(system.normal, rock), mu = rock(5, 5);
    const auto of =
        in_share(compliance_in_rock(system, group.of.slides, rock), fracture_share_of(model_, cell));
    const auto normal = slip::spring_step(modulus, of.normal, of.normal_damping, dt_s);
    const auto tangential = slip::spring_step(mu, of.tangential, of.tangential_damping, dt_s);
    std::size_t at = place;
    const auto put = [&](double value) {
      group.coefficients[at] = Real(value);
      at += group.places.stored();
    };
    put(rock(1, 3) / modulus);
    put(normal.of_end), put(tangential.of_end);
    if (group.of.damped)
      for (const auto& each : {normal, tangential}) put(each.left), put(each.of_start);
    if (group.of.slides) put(tangential.follows);
  });
}

/// r of a stress s is G s, with G the stiffness of the rock times the compliance of all planes; of the stress
/// of welded planes it is G (1 + G)^-1 (S22). Hands out each entry of both: its component, that of the
/// stress, and the entries of the latter and of G.
template <int D, class StrainOf, class Put>
static void each_entry(const Rock<D>& rock, const StrainOf& strain_of, const Put& put) {
  constexpr std::size_t n = std::size_t(Tensor<D>::components);
  SmallMatrix<n> taken{}, with_rock{};
  for (std::size_t k = 0; k < n; ++k) {
    Tensor<D> stress;
    stress.values[k] = 1;
    const auto off = stress_of<D>(strain_of(stress), rock);
    for (std::size_t c = 0; c < n; ++c) taken[c][k] = off.values[c];
  }
  with_rock = taken;
  for (std::size_t k = 0; k < n; ++k) with_rock[k][k] += 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::array<double, n> column{};
    for (std::size_t c = 0; c < n; ++c) column[c] = taken[c][k];
    column = solved(with_rock, column);
    for (std::size_t c = 0; c < n; ++c) put(c, k, column[c], taken[c][k]);
  }
}

template <int D, class Real>
void LinearSlip<D, Real>::add_crossing(Group& group) const {
  constexpr std::size_t n = std::size_t(Tensor<D>::components);
  group.places.each(state_.layout, domain_, model_, [&](std::size_t place, std::size_t cell, bool) {
    const auto rock = rock_in_grid(model_.medium, cell);
    const auto strain_of = [&](const Tensor<D>& stress) {
      return is_cut(model_, cell) ? strain_of_part<D>(*group.set, model_, cell, stress)
                                  : strain_of_planes<D>(*group.set, stress, rock.upright);
    };
    each_entry<D>(rock, strain_of, [&](std::size_t c, std::size_t k, double of_welded, double taken) {
      group.coefficients[(c * n + k) * group.places.stored() + place] = Real(of_welded);
      if (group.of.slides)
        group.coefficients[(n * n + c * n + k) * group.places.stored() + place] = Real(taken);
    });
  });
}

/// Compliances of fractures of all sets add up where they cross (S30).
template <int D, class Real>
void LinearSlip<D, Real>::add_single(Group& group) const {
  constexpr std::size_t n = CrossedCell<D>::components;
  std::unordered_map<std::size_t, CrossedCell<D>> cells;
  for (const auto& set : model_.fracture_sets)
    for (const auto& crossed : cells_crossed(model_.grid(), set)) {
      auto& sum = cells[crossed.cell];
      for (std::size_t k = 0; k < n * n; ++k) sum.strain[k] += crossed.strain[k];
    }
  group.places.each(state_.layout, domain_, model_, [&](std::size_t place, std::size_t cell, bool) {
    const auto rock = rock_in_grid(model_.medium, cell);
    const auto& of = cells[cell];
    const auto strain_of = [&](const Tensor<D>& stress) {
      Tensor<D> strain;
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t k = 0; k < n; ++k) strain.values[c] += of.strain[c * n + k] * stress.values[k];
      return strain;
    };
    const auto put = [&](std::size_t row, double value) {
      group.coefficients[row * group.places.stored() + place] = Real(value);
    };
    each_entry<D>(rock, strain_of,
                  [&](std::size_t c, std::size_t k, double of_welded, double) { put(c * n + k, of_welded); });
  });
}

/// Columns end between two vectors or with the row.
template <int D, class Real>
void LinearSlip<D, Real>::each_segment(
    const StepTime& time, const RowFields<Real>& fields, const IndexRange& columns,
    typename LinearSlipKernels<Real>::Kernel LinearSlipKernels<Real>::*kernel) {
  const std::int64_t end =
      columns.last == state_.layout.shape()[0] ? state_.layout.padded_nx() : columns.last;
  Real* const stress = fields.field(FieldRows<D>::normal_stress(0));
  for (auto& group : groups_)
    for (const auto& segment : group.places.segments(fields.row)) {
      const std::int64_t first = std::max(segment.first, columns.first), last = std::min(segment.last, end);
      if (first >= last) continue;
      const auto place = segment.place + std::size_t(first - segment.first);
      const auto act = [&] {
        (group.kernels.*kernel)(
            last - first, group.planes,
            {stress + first, fields.pitch, group.memory.data() + place, group.coefficients.data() + place,
             std::int64_t(group.places.stored()), ahead_});
      };
      if (group.set->is_cluster() && !group.of.slides)
        injected_.without(double(time.step) + 0.5, fields, {first, last}, act);
      else
        act();
    }
}

template <int D, class Real>
void LinearSlip<D, Real>::apply(const StepTime& time, const RowFields<Real>& fields,
                                const IndexRange& cells) {
  each_segment(time, fields, cells, &LinearSlipKernels<Real>::end);
}

template <int D, class Real>
void LinearSlip<D, Real>::apply_after_record(const StepTime& time, const RowFields<Real>& fields,
                                             const IndexRange& cells) {
  each_segment(time, fields, cells, &LinearSlipKernels<Real>::begin);
}

template <int D, class Real>
void LinearSlip<D, Real>::serialize(Archive& archive) {
  for (auto& group : groups_) archive.fixed(group.memory);
}

template <int D, class Real>
void LinearSlip<D, Real>::exchange(const IndexRange& rows,
                                   const std::function<void(Real*, std::int64_t)>& to) {
  const auto lines_a_row = state_.layout.lines() / state_.layout.shape()[D - 1];
  for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
    for (auto& group : groups_)
      for (const auto& segment : group.places.segments(line))
        for (auto place = segment.place; place < group.memory.size(); place += group.places.stored())
          to(group.memory.data() + place, segment.last - segment.first);
}

template <int D, class Real>
std::int64_t LinearSlip<D, Real>::memory_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& group : groups_)
    bytes += std::int64_t((group.memory.size() + group.coefficients.size()) * sizeof(Real)) +
             group.places.memory_bytes();
  return bytes;
}

template <int D, class Real>
std::int64_t LinearSlip<D, Real>::cells() const {
  std::int64_t sum = 0;
  for (const auto& group : groups_) sum += group.places.cells();
  return sum;
}

template <int D, class Real>
std::vector<EffectShare> LinearSlip<D, Real>::shares() const {
  std::vector<EffectShare> all = {{name(), cells()}};
  const auto add = [&](const std::string& what, const auto& has) {
    std::int64_t sum = 0;
    for (const auto& group : groups_) sum += has(group.of) ? group.places.cells() : 0;
    if (sum > 0) all.push_back({what, sum});
  };
  add("  dashpots", [](const auto& of) { return of.damped; });
  add("  crossing planes", [](const auto& of) { return !of.one_family; });
  add("  below friction", [](const auto& of) { return of.slides; });
  return all;
}

/// J/m3. Traction times strain, half: of one family the strain is what the planes take off over the modulus;
/// of several, which have no dashpots, strain is compliance times stress.
template <int D, class Real>
double LinearSlip<D, Real>::stored_energy(const Group& group, std::size_t place, std::size_t cell) const {
  const auto of_cell = rock_in_grid(model_.medium, cell);
  const auto& rock = of_cell.upright;
  const auto taken = [&](std::size_t row) {
    return double(group.memory[row * group.places.stored() + place]) / unit_;
  };
  double energy = 0;
  if (group.of.one_family) {
    const auto& system = group.set->systems[0];
    const auto of =
        in_share(compliance_in_rock(system, group.of.slides, rock), fracture_share_of(model_, cell));
    for (std::size_t k = 0; k < D; ++k) {
      const double modulus = k == 0 ? modulus_across<D>(system.normal, rock) : rock(5, 5);
      const double compliance = k == 0 ? of.normal : of.tangential;
      if (compliance > 0) energy += std::pow(taken(k) / modulus, 2) / compliance / 2;
    }
    return energy;
  }
  Tensor<D> off;
  for (std::size_t c = 0; c < off.values.size(); ++c) off.values[c] = taken(c);
  const auto strain = strain_of<D>(off, of_cell);
  auto at = domain_.computed_cell(model_.grid().index(std::int64_t(cell)));
  const auto x = at[0];
  at[0] = 0;
  for (std::size_t c = 0; c < off.values.size(); ++c) {
    const double stress = double(state_.field_row(at, FieldRows<D>::normal_stress(0) + int(c))[x]) / unit_;
    energy += (c < D ? 0.5 : 1) * stress * strain.values[c];
  }
  return energy;
}

template <int D, class Real>
double LinearSlip<D, Real>::stored_energy() const {
  double energy = 0;
  for (const auto& group : groups_)
    group.places.each(
        state_.layout, domain_, model_, [&](std::size_t place, std::size_t cell, bool in_model) {
          const auto at = domain_.computed_cell(model_.grid().index(std::int64_t(cell)));
          if (!in_model || !domain_.owns(at[D - 1])) return;
          const double height = domain_.model_grid.height(domain_.model_cell(at));
          energy += std::pow(domain_.grid.spacing_m, D - 1) * height * stored_energy(group, place, cell);
        });
  return energy;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, soft_cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, stiffness_among_planes);
SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class LinearSlip);

}  // namespace slipwave::solver
