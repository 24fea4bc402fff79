// SPDX-License-Identifier: BSD-3-Clause
// Bands of cells of several sizes (docs/theory/bands.md): nothing feeds waves at their faces.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "acquisition/wavelet.hpp"
#include "lab.hpp"
#include "scene/bands.hpp"
#include "solver/banded_shot.hpp"

namespace slipwave::bands_test {
namespace {

constexpr int box_cells = 96, face_row = 48;
constexpr double box_cell_m = 5;

/// A medium and where its second band begins, rows of 5 m from the top.
struct BandedGround {
  std::string name;
  int widest;  // cells beyond the face, in those before it
  std::function<Material(int i, int k)> rock_at;
  std::vector<FractureTrace<2>> springs = {}, cracks = {};  // on faces
};

/// A trace between two places in cells of the box.
FractureTrace<2> trace(double x1, double z1, double x2, double z2) {
  return {{x1 * box_cell_m, z1 * box_cell_m}, {x2 * box_cell_m, z2 * box_cell_m}};
}

Material rock_of(double vp, double vs, double rho) {
  Material rock;
  rock.vp = vp, rock.vs = vs, rock.rho = rho;
  return rock;
}

/// A rock whose speeds and density are up to 1.2 times as large, by draws of the place.
Material varied(const Material& rock, int i, int k) {
  const auto [vp, vs, rho] = draws_of(i, k, 7);
  return rock_of(rock.vp * std::pow(1.2, vp), rock.vs * std::pow(1.2, vs), rock.rho * std::pow(1.2, rho));
}

std::vector<BandedGround> banded_grounds() {
  const auto soft = rock_of(900, 300, 1800), hard = rock_of(3500, 2000, 2300), water = rock_of(1500, 0, 1000),
             mud = rock_of(1600, 150, 1500);
  // As near to the face as they may be at order 11.
  const double above = face_row - double(rows_beside_band(11)), below = face_row + 2. * rows_beside_band(11);
  return {
      {"FracturesOnFaces",
       2,
       [=](int, int) { return hard; },
       {trace(20, above, 60, above), trace(70, below, 70, 90)},
       {trace(80, 10, 80, above), trace(20, below, 60, below)}},
      {"SoftOverHard", 4, [=](int, int k) { return k < face_row ? soft : hard; }},
      {"HardOverSoft", 4, [=](int, int k) { return k < face_row ? hard : soft; }},
      {"WaterOverHard", 4, [=](int, int k) { return k < face_row ? water : hard; }},
      {"WaterOverMudOverHard", 4,
       [=](int, int k) { return k < face_row - 20 ? water
                                : k < face_row    ? mud
                                                  : hard; }},
      {"RandomCellsOverRandomCells", 4,
       [=](int i, int k) { return varied(k < face_row ? soft : hard, i, k); }},
      {"OneRock", 2, [=](int, int) { return hard; }},
      {"RandomLayers", 2, [=](int, int k) { return varied(hard, 0, k); }},
      {"RandomCells", 2, [=](int i, int k) { return varied(hard, i, k); }},
      {"InterfaceAboveTheFace", 2, [=](int, int k) { return k < face_row - 15 ? soft : hard; }},
      {"SineInOneRock", 2,
       [=](int i, int k) {
         return k < face_row + 36 + 6 * std::sin(0.2 * i) ? hard : rock_of(5000, 3000, 2700);
       }},
  };
}

/// A box of free edges whose cells are `ratio` times as large below a face, and random fields in it.
template <class Real>
class BandedBox {
 public:
  BandedBox(const BandedGround& ground, int ratio, int order, double cfl)
      : scene_(scene_of(ground, ratio, order, cfl)), shot_(scene_, 1) {
    std::mt19937 engine(1);
    const double unit = solver::in_all_bands(scene_, shot_.scenes(), 1).unit;
    for (std::size_t band = 0; band < shot_.scenes().size(); ++band) {
      const auto& domain = shot_.part(band).domain();
      const auto& medium = shot_.scenes()[band].model.medium;
      for (auto k = domain.own.first; k < domain.own.last; ++k)
        for (std::int64_t i = 0; i < domain.grid.shape[0]; ++i)
          fill(shot_.part(band).state(), medium, {i, k},
               [&] { return unit * std::uniform_real_distribution<double>(-1, 1)(engine); });
      shot_.part(band).executor().fields_changed();
    }
  }
  void run(std::int64_t steps) { shot_.run_to(shot_.done() + steps); }
  void step() { run(1); }
  double energy() const { return shot_.report().energy_left; }

 private:
  static Scene<2> scene_of(const BandedGround& ground, int ratio, int order, double cfl) {
    Scene<2> scene;
    scene.model.medium = of_rocks(box_cells, ground.rock_at);
    for (const bool open : {false, true}) {
      const auto& traces = open ? ground.cracks : ground.springs;
      if (traces.empty()) continue;
      SlipSystem<2> planes;
      planes.law = FrictionLaw::none;
      planes.compliance.normal_m_per_pa = open ? HUGE_VAL : 1e-10;
      planes.compliance.tangential_m_per_pa = open ? HUGE_VAL : 2e-10;
      scene.model.fracture_sets.push_back({open ? "cracks" : "springs", {planes}, traces, true});
    }
    scene.edges = all_edges(EdgeLaw::free);
    scene.numerics.order = order;
    scene.numerics.cfl = cfl;
    scene.numerics.double_precision = std::is_same_v<Real, double>;
    scene.numerics.bands = {{0, box_cell_m}, {face_row * box_cell_m, ratio * box_cell_m}};
    scene.recording = {{Component::vz}, 1e3, 1};
    // A source that never begins, but whose strength lets fields be as large as they are.
    scene.survey.sources.push_back(
        {{100, 100}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:20"), 1e20, 1e5});
    return scene;
  }
  template <class Draw>
  static void fill(solver::State<2, Real>& state, const Medium<2>& medium, const Index<2>& at, Draw&& draw) {
    const auto cell = std::size_t(medium.grid().flat(at));
    const double z = double(medium.rho[cell]) * medium.vp[cell];
    const auto put = [&](int row, double value) { state.field_row({0, at[1]}, row)[at[0]] = Real(value); };
    for (const int row : {0, 1}) put(row, draw());
    const double pressure = z * draw();
    const bool solid = medium.is_solid(cell);
    put(2, pressure), put(3, solid ? z * draw() : pressure);
    if (solid) put(4, z * draw());
  }

  Scene<2> scene_;
  solver::BandedShot<2, Real> shot_;
};

/// Energies are sums of numbers of that many digits.
template <class Real>
constexpr double lost_digits = std::is_same_v<Real, double> ? 1e-12 : 1e-6;

template <class Real>
void expect_falling_energy(const BandedGround& ground, int ratio, int order, double cfl) {
  BandedBox<Real> box(ground, ratio, order, cfl);
  // From order 7 on little energy is gained later on (docs/theory/bands.md).
  const int steps = order > 5 || cfl != 0.9 ? 2000 : 20000;
  const double first = box.energy();
  double before = first;
  for (std::int64_t n = 0; n < 200; n += 10) {
    box.run(10);
    const double now = box.energy();
    ASSERT_LE(now, before + lost_digits<Real> * first)
        << ground.name << ", ratio " << ratio << ", order " << order << ", Courant number " << cfl
        << ", step " << n;
    before = now;
  }
  EXPECT_LT(before, 0.7 * first);
  if (!long_form()) return;
  SCOPED_TRACE(ground.name + ", ratio " + std::to_string(ratio) + ", order " + std::to_string(order));
  expect_fall_in_the_long_run(box, steps, lost_digits<Real>);
}

class Bands : public testing::TestWithParam<BandedGround> {};

TEST_P(Bands, NeverAddEnergyAtTheirFaces) {
  // For each ground the short form has other Courant numbers, and of several ratios every other order.
  std::size_t turn = GetParam().name.size();
  for (int ratio = 2; ratio <= GetParam().widest; ++ratio)
    for (const int order : orders_tried())
      for (const double cfl : share_of(std::vector{0.5, 0.9, 1.}, turn++ % 4)) {
        // 96 rows leave fewer than order 11 needs below a face to cells four times as large.
        if (order > 7 && ratio > 3) continue;
        if (!long_form() && GetParam().widest > 2 && (ratio + order / 2) % 2 != 0) continue;
        expect_falling_energy<double>(GetParam(), ratio, order, cfl);
        if (testing::Test::HasFatalFailure()) return;
      }
}

TEST_P(Bands, NeverAddEnergyInFloat) {
  for (int ratio = 2; ratio <= GetParam().widest; ratio += 2)
    expect_falling_energy<float>(GetParam(), ratio, 7, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Hard, Bands, testing::ValuesIn(banded_grounds()),
                         [](const auto& ground) { return ground.param.name; });

}  // namespace
}  // namespace slipwave::bands_test
