// Attenuation only takes energy: that of the waves and of what has relaxed, together, never rises.
#include <gtest/gtest.h>

#include <random>

#include "lab.hpp"
#include "model/anisotropy.hpp"
#include "solver/effect/attenuation.hpp"

namespace slipwave {
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

/// A random wave field in a medium of random Q, 5 to 1000, between mirrors or rigid walls.
class AttenuatingBox {
 public:
  AttenuatingBox(const Medium<2>& given, unsigned seed, int time_order, EdgeLaw edges)
      : scene_(scene_of(given, seed, time_order)),
        dt_s_(scene_.numerics.time_order == 4 ? 1.6 * stable_time_step_s(scene_)
                                              : stable_time_step_s(scene_)),
        relaxation_(solver::relaxation_by_steps(scene_, dt_s_)),
        medium_(relaxation_.medium()),
        domain_(solver::make_domain(medium_, all_edges(edges), 1)),
        state_(solver::make_filled_state<2, double>(domain_, medium_, dt_s_)),
        sweeps_(state_, domain_, 5),
        effect_(state_.layout, domain_, scene_, dt_s_, {}),
        splitting_(splitting(2, time_order)) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> random(-0.5, 0.5);
    for (std::int64_t k = 0; k < domain_.grid.shape[1]; ++k)
      for (std::int64_t i = 0; i < domain_.grid.shape[0]; ++i) {
        const auto cell = std::size_t(domain_.model_grid.flat({i, k}));
        const double impedance = medium_.rho[cell] * medium_.vp[cell];
        for (int row = 0; row < FieldRows<2>::count; ++row) {
          const bool shear = row == FieldRows<2>::shear_stress(0, 1);
          if (shear && state_.fluid) continue;
          const double size = medium_.is_void(cell) || (shear && !medium_.is_solid(cell)) ? 0
                              : row < 2                                                   ? 1
                                                                                          : impedance;
          state_.field_row({0, k}, row)[i] = size * random(engine);
        }
        if (!medium_.is_solid(cell)) state_.field_row({0, k}, 3)[i] = state_.field_row({0, k}, 2)[i];
      }
  }
  void step() {
    std::size_t along_z = 0;
    const auto all = std::size_t(
        std::count_if(splitting_.begin(), splitting_.end(), [](const auto& s) { return s.axis == 1; }));
    for (const auto& [axis, fraction] : splitting_) {
      sweeps_.along(axis, fraction);
      if (axis != 1 || along_z++ != (all - 1) / 2) continue;
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
    std::size_t place = 0;
    for (std::int64_t k = 0; k < domain_.grid.shape[1]; ++k)
      for (std::int64_t first = 0; first < domain_.grid.shape[0]; first += block) {
        bool any = false;
        for (auto i = first; i < std::min(first + block, domain_.grid.shape[0]); ++i)
          any |= attenuates(medium_, std::size_t(domain_.model_grid.flat({i, k})));
        if (!any) continue;
        for (auto i = first; i < std::min(first + block, domain_.grid.shape[0]); ++i)
          sum +=
              of_cell(std::size_t(domain_.model_grid.flat({i, k})), &relaxed[place + std::size_t(i - first)]);
        place += std::size_t(block) * 9;
      }
    EXPECT_EQ(place, relaxed.size());
    return sum;
  }

 private:
  static Scene<2> scene_of(const Medium<2>& given, unsigned seed, int time_order) {
    Scene<2> scene;
    scene.model.medium = given;
    scene.numerics.time_order = time_order;
    auto& medium = scene.model.medium;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> power(std::log(5.), std::log(1000.));
    for (const auto property : {Property::qp, Property::qs}) {
      medium[property] = Field<2>(medium.grid(), float(PropertyRow::infinite));
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
    const auto c = stiffness_of(medium_, cell);
    const double mean = std::sqrt(c.c11 * c.c33);
    return {(mean + c.c13) / 2, (mean - c.c13) / 2, c.c55};
  }
  double of_cell(std::size_t cell, const double* relaxed) const {
    constexpr std::int64_t block = solver::relaxation_block;
    if (medium_.is_void(cell)) return 0;
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
    return sum * std::pow(domain_.grid.spacing_m, 2);
  }

  Scene<2> scene_;
  double dt_s_;
  StepwiseRelaxation<2> relaxation_;
  Medium<2> medium_;
  solver::Domain<2> domain_;
  solver::State<2, double> state_;
  solver::Sweeps<2, double> sweeps_;
  solver::RelaxingStress<2, double> effect_;
  std::vector<SweepFraction> splitting_;
  std::int64_t steps_ = 0;
};

void expect_falling_energy(AttenuatingBox& box, int steps, double left) {
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

TEST(Attenuation, OnlyTakesEnergyFromAnisotropicMediaOfAnyQ) {
  const ThreadLimit one_thread(1);
  const int media = long_form() ? 30 : 3, steps = long_form() ? 20000 : 200, cells = 32;
  for (int n = 0; n < media; ++n) {
    SCOPED_TRACE(n);
    auto medium = rock(cells, cells);
    make_anisotropic(medium, unsigned(n) + 5);
    AttenuatingBox box(medium, unsigned(n) + 1, 2, n % 2 ? EdgeLaw::rigid : EdgeLaw::mirror);
    // More of a random stress is at rest than between isotropic rocks.
    expect_falling_energy(box, steps, 0.8);
  }
}

TEST(Attenuation, OnlyTakesEnergyFromMediaOfAnyQ) {
  const ThreadLimit one_thread(1);
  const int media = long_form() ? 30 : 4, steps = long_form() ? 20000 : 200, cells = 32;
  const auto& names = medium_names();
  for (int n = 0; n < media; ++n) {
    const auto& name = names[std::size_t(n * 3 + n / int(names.size())) % names.size()];
    SCOPED_TRACE(name + ' ' + std::to_string(n));
    // Corrections of fourth order in time may raise energy for a moment, as without attenuation.
    AttenuatingBox box(medium_named(name, cells, unsigned(n) + 1), unsigned(n) + 1, 2,
                       n % 2 ? EdgeLaw::rigid : EdgeLaw::mirror);
    expect_falling_energy(box, steps, 0.5);
  }
}

}  // namespace
}  // namespace slipwave
