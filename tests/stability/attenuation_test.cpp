// SPDX-License-Identifier: BSD-3-Clause
// Attenuation only takes energy: that of the waves and of what has relaxed, together, never rises.
#include <gtest/gtest.h>

#include <random>

#include "lab.hpp"
#include "rock/anisotropy.hpp"
#include "rock/bulk_part.hpp"
#include "solver/effect/attenuation.hpp"

namespace slipwave::attenuation_test {
namespace {

using solver::FieldRows;

/// Takes what an effect retains.
class ToValues : public Archive {
 public:
  explicit ToValues(std::vector<double>& values) : values_(values) {}
  void bytes(void* first, std::size_t count) override {
    const auto* from = static_cast<const double*>(first);
    values_.assign(from, from + count / sizeof(double));
  }
  std::size_t count(std::size_t now, std::size_t) override { return now; }

 private:
  std::vector<double>& values_;
};

/// A random wave field in a medium of random Q, 5 to 1000, between edges of one law.
template <int D>
class AttenuatingBox {
 public:
  AttenuatingBox(const Medium<D>& given, unsigned seed, int time_order, EdgeLaw edges, int order = 5)
      : scene_(scene_of(given, seed, time_order)),
        dt_s_(scene_.numerics.time_order == 4 ? 1.6 * stable_time_step_s(scene_)
                                              : stable_time_step_s(scene_)),
        relaxation_(solver::relaxation_by_steps(scene_, dt_s_)),
        medium_(relaxation_.medium()),
        domain_(solver::make_domain(medium_, everywhere(edges), 1, {}, order)),
        state_(solver::make_filled_state<D, double>(domain_, medium_, dt_s_)),
        sweeps_(state_, domain_, order),
        effect_(state_.layout, domain_, scene_, dt_s_, {}),
        splitting_(splitting(D, time_order)) {
    using Rows = FieldRows<D>;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> random(-0.5, 0.5);
    for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
      const auto at = domain_.grid.index(n);
      const auto cell = std::size_t(n);
      const double impedance = medium_.rho[cell] * medium_.vp[cell];
      for (int row = 0; row < Rows::count; ++row) {
        const bool shear = row >= 2 * D;
        if (shear && state_.fluid) continue;
        const double size = medium_.is_void(cell) || (shear && !medium_.is_solid(cell)) ? 0
                            : row < D                                                   ? 1
                                                                                        : impedance;
        value(row, at) = size * random(engine);
      }
      for (int row = D + 1; row < 2 * D && !medium_.is_solid(cell); ++row) value(row, at) = value(D, at);
    }
  }
  void step() {
    std::size_t along_last = 0;
    const auto all = std::size_t(
        std::count_if(splitting_.begin(), splitting_.end(), [](const auto& s) { return s.axis == D - 1; }));
    for (const auto& [axis, fraction] : splitting_) {
      sweeps_.along(axis, fraction);
      if (axis != D - 1 || along_last++ != (all - 1) / 2) continue;
      for (std::int64_t row = 0; row < state_.layout.lines(); ++row)
        effect_.apply_between({steps_, dt_s_}, state_.row_fields(row), {0, state_.layout.shape()[0]});
    }
    ++steps_;
  }
  /// Of the fields, and of what has relaxed over and above that: for each part of the stress
  /// sum z_l^2/(Y_l M) - (sum z_l)^2/M, halved.
  double energy() {
    double sum = solver::energy(state_, domain_, medium_);
    std::vector<double> relaxed;
    ToValues to(relaxed);
    effect_.serialize(to);
    constexpr std::int64_t block = solver::relaxation_block;
    const auto nx = domain_.grid.shape[0];
    std::size_t place = 0;
    for (std::int64_t line = 0; line < domain_.grid.size() / nx; ++line)
      for (std::int64_t first = 0; first < nx; first += block) {
        bool any = false, anisotropic = false;
        const auto last = std::min(first + block, nx);
        for (auto i = first; i < last; ++i) {
          const auto cell = std::size_t(line * nx + i);
          any |= attenuates(medium_, cell);
          anisotropic |= attenuates(medium_, cell) && is_anisotropic(medium_, cell);
        }
        if (!any) continue;
        for (auto i = first; i < last; ++i)
          sum += of_cell(std::size_t(line * nx + i), &relaxed[place + std::size_t(i - first)], anisotropic);
        place += std::size_t(block) * 3 * parts;
      }
    EXPECT_EQ(place, relaxed.size());
    return sum;
  }

 private:
  static constexpr std::int64_t parts = solver::relaxing_parts(D, solver::Relaxing::all);
  static EdgeLaws<D> everywhere(EdgeLaw law) {
    EdgeLaws<D> edges;
    for (int axis = 0; axis < D; ++axis) edges[axis] = {law, law};
    return edges;
  }
  double& value(int row, Index<D> at) {
    const auto x = at[0];
    at[0] = 0;
    return state_.field_row(at, row)[x];
  }
  static Scene<D> scene_of(const Medium<D>& given, unsigned seed, int time_order) {
    Scene<D> scene;
    scene.model.medium = given;
    scene.numerics.time_order = time_order;
    auto& medium = scene.model.medium;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> power(std::log(5.), std::log(1000.));
    for (const auto property : {Property::qp, Property::qs}) {
      medium[property] = Field<D>(medium.grid(), float(PropertyRow::infinite));
      for (std::size_t cell = 0; cell < medium.vp.size(); ++cell)
        if (property == Property::qp ? !medium.is_void(cell) : medium.is_solid(cell))
          medium[property][cell] = float(std::exp(power(engine)));
    }
    // The band of a source whose waves are some cells long.
    scene.attenuation.emplace(Attenuation{Mechanisms(3, 10, 125), 50});
    unrelax(medium, *scene.attenuation);
    return scene;
  }
  /// Moduli of the three parts of the stress: of isotropic rock lambda + mu, mu and mu.
  std::array<double, 3> moduli(std::size_t cell) const {
    const auto c = upright_elasticity<2>(material_of(medium_, cell));
    const double mean = std::sqrt(c(1, 1) * c(3, 3));
    return {(mean + c(1, 3)) / 2, (mean - c(1, 3)) / 2, c(5, 5)};
  }
  double of_cell(std::size_t cell, const double* relaxed, bool anisotropic) const {
    if (medium_.is_void(cell)) return 0;
    const double volume = std::pow(domain_.grid.spacing_m, D);
    if constexpr (D == 3)
      return volume * of_cell_in_3d(cell, relaxed, anisotropic);
    else
      return volume * of_cell_in_plane(cell, relaxed);
  }
  double of_cell_in_plane(std::size_t cell, const double* relaxed) const {
    constexpr std::int64_t block = solver::relaxation_block;
    const auto shares = relaxation_.shares(cell);
    const auto of_parts = moduli(cell);
    double sum = 0;
    for (int part = 0; part < 3; ++part) {
      const auto& of = part == 0 ? shares.bulk : shares.shear;
      const double modulus = of_parts[std::size_t(part)];
      double all = 0;
      for (int l = 0; l < 3; ++l) {
        const double z = relaxed[(l * 3 + part) * block];
        all += z;
        if (of[std::size_t(l)] > 0) sum += z * z / (of[std::size_t(l)] * modulus) / 2;
      }
      if (modulus > 0) sum -= all * all / modulus / 2;
    }
    return sum;
  }
  /// The two parts of (Q11). Blocks without anisotropic cells hold the mean and what is left of the stress.
  double of_cell_in_3d(std::size_t cell, const double* relaxed, bool anisotropic) const {
    using Tensor = std::array<double, 6>;
    constexpr std::int64_t block = solver::relaxation_block;
    const auto shares = relaxation_.shares(cell);
    const auto rock = material_of(medium_, cell);
    const bool solid = medium_.is_solid(cell);
    const auto tensors = is_anisotropic(medium_, cell) ? bulk_tensors(rock) : BulkTensors{};
    const auto stiffness = elasticity_of<3>(rock);
    // B counts from the c33 of the upright rock.
    const double bulk =
        rock.rho * rock.vp * rock.vp * (solid ? bulk_part(upright_elasticity<3>(rock)).share : 1);
    const auto energies = [&](const Tensor& z) {
      double size = 0;
      for (std::size_t c = 0; c < 6; ++c) size += tensors.weights[c] * z[c];
      Tensor rest;
      for (std::size_t c = 0; c < 6; ++c) rest[c] = z[c] - size * tensors.stress[c];
      const double of_bulk = size * size / bulk / 2;
      return std::array{of_bulk, solid ? complementary<3>(stiffness, rest) / 2 : 0};
    };
    Tensor all{};
    double sum = 0;
    for (std::size_t l = 0; l < 3; ++l) {
      Tensor z;
      for (std::size_t c = 0; c < 6; ++c) z[c] = relaxed[std::int64_t(l * 6 + c) * block];
      if (!anisotropic) z = {z[0] + z[1], z[0] + z[2], z[0] - z[1] - z[2], z[3], z[4], z[5]};
      for (std::size_t c = 0; c < 6; ++c) all[c] += z[c];
      const auto [of_bulk, of_rest] = energies(z);
      if (shares.bulk[l] > 0) sum += of_bulk / shares.bulk[l];
      if (shares.shear[l] > 0) sum += of_rest / shares.shear[l];
    }
    const auto [of_bulk, of_rest] = energies(all);
    return sum - of_bulk - of_rest;
  }
  Scene<D> scene_;
  double dt_s_;
  StepwiseRelaxation<D> relaxation_;
  Medium<D> medium_;
  solver::Domain<D> domain_;
  solver::State<D, double> state_;
  solver::Sweeps<D, double> sweeps_;
  solver::RelaxingStress<D, double> effect_;
  std::vector<SweepFraction> splitting_;
  std::int64_t steps_ = 0;
};

template <int D>
void expect_falling_energy(AttenuatingBox<D>& box, int steps, double left) {
  const double first = box.energy();
  double lowest = first;
  for (int step = 0; step < steps; ++step) {
    box.step();
    if (step % 10 != 9 && step > 20) continue;
    const double now = box.energy();
    ASSERT_LE(now, lowest + 1e-11 * first) << "step " << step;
    lowest = std::min(lowest, now);
  }
  EXPECT_LT(lowest, left * first);
}

/// Gives the solid cells of a medium epsilon, delta and tilt at random, block by block.
void make_anisotropic(Medium<2>& medium, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> random(0, 1);
  for (const auto property : {Property::epsilon, Property::delta, Property::tilt})
    medium[property] = Field<2>(medium.grid());
  for (std::size_t cell = 0; cell < medium.vp.size(); ++cell) {
    if (!medium.is_solid(cell) || random(engine) < 0.2) continue;
    auto rock = material_of(medium, cell);
    do {
      rock.epsilon = -0.2 + 0.6 * random(engine), rock.delta = -0.2 + 0.6 * random(engine);
      rock.tilt = random(engine) < 0.3 ? 0 : 180 * random(engine) - 90;
    } while (fault_of_anisotropy(rock));
    put(medium, cell, rock);
  }
}

// Proves (Q9).
TEST(Attenuation, OnlyTakesEnergyFromAnisotropicMediaOfAnyQ) {
  const ThreadLimit one_thread(1);
  const int media = long_form() ? 6 : 3, steps = long_form() ? 20000 : 200, cells = 32;
  for (int n = 0; n < media; ++n) {
    SCOPED_TRACE(n);
    auto medium = rock(cells, cells);
    make_anisotropic(medium, unsigned(n) + 5);
    AttenuatingBox<2> box(medium, unsigned(n) + 1, 2, n % 2 ? EdgeLaw::rigid : EdgeLaw::mirror);
    // More of a random stress is at rest than between isotropic rocks.
    expect_falling_energy(box, steps, 0.8);
  }
}

/// Any stiffness about any axes, upright and isotropic rock and water, in lumps of so many cells.
Medium<3> rocks_in_3d(const Index<3>& shape, std::int64_t block, unsigned seed) {
  Medium<3> medium(Grid<3>{shape, 5, {0, 0, 0}});
  for (const auto property : {Property::epsilon1, Property::tilt, Property::azimuth, Property::rotation})
    medium[property] = Field<3>(medium.grid());
  complete_anisotropy(medium);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * uniform(engine); };
  const auto draw = [&]() -> Material {
    const double kind = uniform(engine);
    if (kind < 0.15) return {1500, 0, 1000};
    for (;;) {
      const double vp = between(2500, 4500);
      Material rock{vp, vp * between(0.3, 0.65), between(2000, 2600)};
      if (kind < 0.25) return rock;
      rock.epsilon = between(-0.25, 0.5), rock.delta = between(-0.25, 0.5), rock.gamma = between(-0.25, 0.5);
      if (kind < 0.8)
        rock.orthorhombic = {between(-0.2, 0.5), between(-0.2, 0.5), between(-0.2, 0.3), between(-0.2, 0.5)};
      if (kind < 0.7) rock.tilt = between(-90, 90), rock.azimuth = between(-180, 180);
      if (kind < 0.6) rock.rotation = between(-180, 180);
      if (!fault_of_anisotropy(rock, true)) return rock;
    }
  };
  std::vector<Material> rocks(4096);
  std::generate(rocks.begin(), rocks.end(), draw);
  for (std::int64_t n = 0; n < medium.grid().size(); ++n) {
    const auto at = medium.grid().index(n);
    put(medium, std::size_t(n),
        rocks[std::size_t(((at[2] / block * 16 + at[1] / block) * 16 + at[0] / block) % 4096)]);
  }
  return medium;
}

// Proves (Q12).
TEST(Attenuation, OnlyTakesEnergyFromRockInSpaceOfAnyQ) {
  const ThreadLimit one_thread(1);
  const int media = long_form() ? 6 : 2, steps = long_form() ? 10000 : 60;
  const std::vector<int> orders = {7, 5, 11, 3, 1, 9};
  for (int n = 0; n < media; ++n) {
    SCOPED_TRACE(n);
    const auto medium = rocks_in_3d({20, 9, 10}, n % 2 ? 4 : 1, unsigned(n) + 3);
    AttenuatingBox<3> box(medium, unsigned(n) + 1, 2, n % 4 < 2 ? EdgeLaw::rigid : EdgeLaw::mirror,
                          orders[std::size_t(n) % orders.size()]);
    expect_falling_energy(box, steps, 0.8);
  }
}

// Proves (Q7).
TEST(Attenuation, OnlyTakesEnergyFromMediaOfAnyQ) {
  const ThreadLimit one_thread(1);
  const int media = long_form() ? 6 : 4, steps = long_form() ? 20000 : 200, cells = 32;
  const auto& names = medium_names();
  for (int n = 0; n < media; ++n) {
    const auto& name = names[std::size_t(n * 3 + n / int(names.size())) % names.size()];
    SCOPED_TRACE(name + ' ' + std::to_string(n));
    // Corrections of fourth order in time may raise energy for a moment, as without attenuation.
    AttenuatingBox<2> box(medium_named(name, cells, unsigned(n) + 1), unsigned(n) + 1, 2,
                          n % 2 ? EdgeLaw::rigid : EdgeLaw::mirror);
    expect_falling_energy(box, steps, 0.5);
  }
}

}  // namespace
}  // namespace slipwave::attenuation_test
