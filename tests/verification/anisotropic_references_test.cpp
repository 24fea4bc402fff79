// SPDX-License-Identifier: BSD-3-Clause
// The references that anisotropic rock is held against, by each other and by closed forms; stiffnesses,
// cells that relax and waves of layers by them.
#include <gtest/gtest.h>

#include "anisotropic_scene.hpp"
#include "anisotropic_space.hpp"
#include "layer_stack.hpp"
#include "rock/bulk_part.hpp"
#include "rock/space_motion.hpp"
#include "solver/effect/attenuation.hpp"
#include "solver/kernels/relaxation_kernels.hpp"

namespace slipwave::solver::anisotropic_references_test {
namespace {

/// By how much the traces of two references differ, at most in one of them.
template <class Traces, class Others>
double largest_difference(const Traces& found, const Others& wanted) {
  double largest = 0;
  for (std::size_t n = 0; n < wanted.size(); ++n)
    for (std::size_t row = 0; row < wanted[n].size(); ++row)
      largest = std::max(largest, relative_error(found[n][row], wanted[n][row]));
  return largest;
}

// Proves (V1).
TEST(AnisotropicStack, OfIsotropicLayersIsThatOfPotentials) {
  // Two methods that share nothing: roots of the Christoffel equation, and potentials with closed direct
  // waves.
  constexpr Rock rock{3000, 1600, 2200}, under{4500, 2250, 2500}, water{1500, 0, 1000};
  const std::vector<LayerStack::Receiver> places = {{150, 30}, {-80, 170}, {200, 250}};
  for (const auto& [over, below, explosion] :
       {std::tuple{rock, under, true}, {rock, under, false}, {water, rock, true}}) {
    const auto layer = [](const Rock& of) { return layer_of(Material{of.vp, of.vs, of.rho}); };
    AnisotropicStack stack{{layer(over), layer(below)}, {200}, true, 100};
    if (explosion) stack.explosion = 1;
    if (!explosion) stack.force = {0.6, 0.8};
    const auto closed =
        LayerStack{{over, below}, {0, 200}, true, 100, explosion, {0.6, 0.8}}.ricker(15, 0.001, 300, places);
    const auto found = stack.ricker(15, 0.001, 300, {{150, 30}, {-80, 170}, {200, 250}});
    EXPECT_LT(largest_difference(found, closed), 2e-5) << explosion;
  }
}

// Proves (T4).
TEST(TiltedStack, OfATurnedRockIsTheTurnedField) {
  // The same rock by both kinds of roots: in axes of its beds, and in those of the grid.
  const Dip turned(30);
  AnisotropicStack beds{{layer_of(shale)}, {}}, grid{{layer_of(dipping_shale)}, {}};
  beds.force = {0.6, 0.8}, grid.force = turned(0.6, 0.8);
  std::vector<AnisotropicStack::Receiver> along_grid;
  for (const auto& at : {turned(0, 200), turned(-160, 90)}) along_grid.push_back({at[0], at[1]});
  auto wanted = beds.ricker(peak_hz, 0.001, 250, {{0, 200}, {-160, 90}});
  for (auto& of : wanted)
    for (std::size_t n = 0; n < 250; ++n) {
      const auto motion = turned(of[0][n], of[1][n]);
      of[0][n] = motion[0], of[1][n] = motion[1];
    }
  EXPECT_LT(largest_difference(grid.ricker(peak_hz, 0.001, 250, along_grid), wanted), 1e-4);
}

TEST(AttenuatingStack, OfRocksWithoutLossIsTheElasticOne) {
  constexpr double infinite = PropertyRow::infinite;
  AnisotropicStack elastic{{layer_of(dipping_shale)}, {}};
  elastic.force = {0.6, 0.8};
  auto lossless = elastic;
  lossless.layers[0].relaxed = relaxed(dipping_shale, {infinite, infinite});
  const auto wanted = elastic.ricker(peak_hz, 0.002, 100, {{90, 150}});
  EXPECT_LT(largest_difference(lossless.ricker(peak_hz, 0.002, 100, {{90, 150}}), wanted), 1e-9);
}

// Proves (O3).
TEST(AnisotropicSpace, OfIsotropicRockIsStokesSolution) {
  constexpr RickerForm wavelet{30};
  const Material rock{4500, 2600, 2500};
  const Point<3> r = {71, -42, 55};
  const double distance = std::hypot(r[0], r[1], r[2]), tp = distance / rock.vp, ts = distance / rock.vs;
  const AnisotropicSpace space(rock);
  for (int axis = 0; axis < 3; ++axis) {
    const auto found = space.velocity(r, axis, wavelet, 0.001, 120);
    for (int component = 0; component < 3; ++component) {
      const double along = r[std::size_t(axis)] * r[std::size_t(component)] / (distance * distance);
      const double same = axis == component;
      std::vector<double> wanted;
      for (int n = 0; n < 120; ++n) {
        const double t = n * 0.001;
        const double near =
            tp * wavelet(t - tp) - ts * wavelet(t - ts) + wavelet.integral(t - tp) - wavelet.integral(t - ts);
        wanted.push_back(((3 * along - same) * near / std::pow(distance, 3) +
                          along * wavelet.slope(t - tp) / (rock.vp * rock.vp * distance) -
                          (along - same) * wavelet.slope(t - ts) / (rock.vs * rock.vs * distance)) /
                         (4 * std::numbers::pi * rock.rho));
      }
      EXPECT_LT(relative_error(found[std::size_t(component)], wanted), 1e-4) << axis << component;
    }
  }
}

// Proves (O6).
TEST(TiltedSpace, HasTheStiffnessOfTurnedAxes) {
  // All indices of C_ijkl turned one after another about the axes of the grid.
  for (const auto& rock :
       {turned_by(shale, 30, 0), turned_by(shale, -20, 70), turned_by(cracked, 40, 25, -50)}) {
    const auto c = elasticity_of<3>(rock);
    const AnisotropicSpace other(rock);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        EXPECT_NEAR(c.voigt[i][j], other.stiffness(i, j), 1e-9 * c.voigt[2][2]);
  }
  // Towards +x it is that of the plane.
  const auto rock = turned_by(shale, 30, 0);
  const auto c = elasticity_of<3>(rock).voigt;
  const auto plane = elasticity_of<2>(rock);
  EXPECT_NEAR(c[0][0], plane(1, 1), 1);
  EXPECT_NEAR(c[0][2], plane(1, 3), 1);
  EXPECT_NEAR(c[0][4], plane(1, 5), 1);
  EXPECT_NEAR(c[2][2], plane(3, 3), 1);
  EXPECT_NEAR(c[2][4], plane(3, 5), 1);
  EXPECT_NEAR(c[4][4], plane(5, 5), 1);
  // Waves of directions out of it turn more.
  const auto turning = turned_by(crossed, 30, 0);
  EXPECT_GT(backward_group_velocity(elasticity_of<3>(turning), 2),
            backward_group_velocity(elasticity_of<2>(turning), 1));
}

// Proves (O7).
TEST(TiltedSpace, HasTheWavesOfUprightRockAboutItsAxes) {
  const auto rock = turned_by(cracked, 40, 25, -50);
  const auto axes = axes_of<3>(rock);
  const auto c = elasticity_of<3>(rock);
  const Point<3> own = {0.48, 0.6, 0.64};
  Point<3> n{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 3; ++a) n[i] += own[a] * axes[a][i];
  const auto found = phase_speeds<3>(c, rock.rho, n),
             wanted = phase_speeds<3>(upright_elasticity<3>(cracked), rock.rho, own);
  for (std::size_t wave = 0; wave < 3; ++wave) EXPECT_NEAR(found[wave], wanted[wave], 1e-6);
  // Motions solve the Christoffel equation, and stresses of strains have their energy.
  const auto waves = slipwave::waves_along<3>(c, n);
  for (std::size_t wave = 0; wave < 3; ++wave)
    for (int i = 0; i < 3; ++i) {
      double sum = 0;
      for (int m = 0; m < 81; ++m) {
        const int j = m / 27, k = m / 9 % 3, l = m / 3 % 3;
        if (m % 3 == 0)
          sum += c(i, j, k, l) * n[std::size_t(j)] * n[std::size_t(l)] * waves.vectors[wave][std::size_t(k)];
      }
      EXPECT_NEAR(sum, waves.values[wave] * waves.vectors[wave][std::size_t(i)], 1e-6 * waves.values[0]);
    }
  const std::array<double, 6> strain = {1e-3, -2e-3, 3e-3, 4e-3, -1e-3, 2e-3};
  std::array<double, 6> stress{};
  double energy = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) stress[i] += c.voigt[i][j] * strain[j];
    energy += stress[i] * strain[i];
  }
  std::swap(stress[3], stress[5]);  // as SymmetricTensor has them
  EXPECT_NEAR(complementary<3>(c, stress), energy, 1e-9 * energy);
}

// Proves (A18).
TEST(SpaceLayerWaves, SolveTheChristoffelEquationAndGoTheWayTheyShould) {
  using Complex = std::complex<double>;
  const std::array<double, 2> along = {1.2e-4, -0.9e-4};
  for (const auto& rock : {Material{3000, 1600, 2300}, shale, turned_by(shale, 30, 40),
                           turned_by(cracked, 0, 35), turned_by(cracked, 40, 25, -50)}) {
    const auto stiffness = elasticity_of<3>(rock);
    const double modulus = stiffness.voigt[2][2];
    for (const bool down : {true, false}) {
      const auto waves = layer_waves(rock, along, down);
      ASSERT_EQ(waves.size(), 3U);
      for (const auto& wave : waves) {
        const std::array<Complex, 3> slowness = {along[0], along[1], wave.down};
        const auto stress = stress_of_motion<3, Complex>(stiffness, slowness, wave.motion);
        // rho v' = div s of f(t - p.x): rho v = -s p.
        Complex power = 0;
        double size = 0;
        for (int i = 0; i < 3; ++i) {
          Complex force = 0;
          for (int j = 0; j < 3; ++j) force += stress[Elasticity<3>::pair(i, j)] * slowness[std::size_t(j)];
          EXPECT_LT(std::abs(rock.rho * wave.motion[std::size_t(i)] + force), 1e-6 * rock.rho) << rock.tilt;
          power -= std::conj(wave.motion[std::size_t(i)]) * stress[Elasticity<3>::pair(i, 2)];
          size += std::norm(wave.motion[std::size_t(i)]);
        }
        EXPECT_NEAR(size, 1, 1e-9);
        const double sign = down ? 1 : -1;
        if (std::abs(wave.down.imag()) > 0)
          EXPECT_LT(sign * wave.down.imag(), 0);
        else
          EXPECT_GT(sign * power.real(), -1e-9 * std::sqrt(modulus * rock.rho));
      }
    }
  }
}

// Proves (A18).
TEST(SpaceLayerWaves, OfLevelBedsAreThoseOfAnyStiffnessThatIsNextToThem) {
  const std::array<double, 2> along = {1.2e-4, -0.9e-4};
  const auto level = layer_waves(shale, along, true),
             any = layer_waves(turned_by(shale, 1e-5, 20), along, true);
  for (const auto& wave : level) {
    double nearest = 1;
    for (const auto& other : any) nearest = std::min(nearest, std::abs(other.down - wave.down));
    EXPECT_LT(nearest, 1e-9);
  }
}

/// Sixteen cells of a rock, each under a strain of its own that swings; the first six are strained in one
/// component each.
class SwingingCells {
 public:
  SwingingCells(const Material& rock, const Qualities& of, const Attenuation& attenuation, double interval_s)
      : medium_(uniform_rock(Grid<3>{{1, 1, 1}, 5, {}}, rock)), interval_s_(interval_s), count_(3) {
    for (const auto property : {Property::qp, Property::qs})
      medium_[property] = Field<3>(medium_.grid(), float(property == Property::qp ? of.p : of.s));
    EXPECT_EQ(unrelax(medium_, attenuation), "");
    const StepwiseRelaxation<3> relaxation(medium_, attenuation.mechanisms, interval_s);
    const auto now = material_of(relaxation.medium(), 0);
    stiffness_ = elasticity_of<3>(now);
    const auto tensors = bulk_tensors(now);
    what_ = tensors.are_turned() ? Relaxing::turned : Relaxing::upright;
    const int components = axis_values(3, what_) / 2;
    const auto shares = relaxation.shares(0);
    const auto put = [](std::vector<double>& to, double value) { to.insert(to.end(), block, value); };
    for (const auto* tensor : {&tensors.weights, &tensors.stress})
      for (int c = 0; c < components; ++c) put(axes_, (*tensor)[std::size_t(c)]);
    for (const auto* share : {&shares.bulk, &shares.shear})
      for (int l = 0; l < count_; ++l) put(shares_, relaxation.decay(l) * (*share)[std::size_t(l)]);
    for (int l = 0; l < count_; ++l) rows_.decays[l] = relaxation.decay(l);
    memory_.assign(std::size_t(block * count_ * 6), 0);
  }
  Relaxing what() const { return what_; }
  /// The stiffness in the last of so many cycles, by Voigt's pairs.
  AttenuatingSpace::Moduli stiffness(double hz, int cycles) {
    const double omega = 2 * std::numbers::pi * hz;
    const auto steps = std::int64_t(std::round(cycles / (hz * interval_s_))),
               last = steps * (cycles - 1) / cycles;
    rows_.stress = stress_.data(), rows_.pitch = block, rows_.memory = memory_.data();
    rows_.shares = shares_.data(), rows_.axes = axes_.data();
    AttenuatingSpace::Moduli sum{};
    const auto relax = relaxation_kernel<double>(3, what_, count_);
    for (std::int64_t n = 0; n < steps; ++n) {
      const double t = double(n) * interval_s_;
      const double grown = std::sin(omega * (t + interval_s_)) - std::sin(omega * t);
      for (std::size_t one = 0; one < 6; ++one)
        for (std::size_t other = 0; other < 6; ++other)
          stress_[row_of(one) * block + other] += stiffness_.voigt[one][other] * grown;
      const auto before = stress_;
      relax(block, rows_);
      if (n < last) continue;
      const auto turn = std::polar(2. / double(steps - last), -omega * (t + interval_s_)) * Complex(0, 1);
      for (std::size_t one = 0; one < 6; ++one)
        for (std::size_t other = 0; other < 6; ++other) {
          const auto at = row_of(one) * block + other;
          sum[one][other] += turn * (before[at] + stress_[at]) / 2.;
        }
    }
    return sum;
  }

 private:
  static constexpr std::size_t block = std::size_t(relaxation_block);
  /// Of fields, which have xy before xz and yz.
  static std::size_t row_of(std::size_t voigt) { return voigt < 3 ? voigt : 8 - voigt; }

  Medium<3> medium_;
  double interval_s_;
  int count_;
  Elasticity<3> stiffness_;
  Relaxing what_;
  std::vector<double> stress_ = std::vector<double>(6 * block), memory_, shares_, axes_;
  RelaxationRows<double> rows_{};
};

// Proves (Q11).
TEST(AttenuatingSpace, RelaxesAsItsComplexStiffnesses) {
  const double peak_hz = 20;
  const Attenuation attenuation{Mechanisms(3, peak_hz / 5, 2.5 * peak_hz), peak_hz};
  for (const auto& rock : {shale, cracked, turned_by(shale, 30, 90), turned_by(cracked, 40, 25, -50)})
    for (const double hz : {8., 20., 35.}) {
      SwingingCells cells(rock, {40, 25}, attenuation, 1 / (400 * hz));
      EXPECT_EQ(cells.what(), rock.tilt == 0 ? Relaxing::upright : Relaxing::turned);
      const auto found = cells.stiffness(hz, 25),
                 wanted = AttenuatingSpace(rock, {40, 25}, attenuation.mechanisms, peak_hz).stiffness(hz);
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          EXPECT_LT(std::abs(found[i][j] - wanted[i][j]), 2e-4 * std::abs(wanted[2][2]))
              << rock.tilt << ' ' << hz << ' ' << i << j << ' ' << found[i][j] << wanted[i][j];
    }
}

// Proves (Q9).
TEST(AttenuatingAnisotropy, RelaxesIsotropicCellsAsIsotropicMediaDo) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> random(-1, 1);
  constexpr int cells = 2 * relaxation_block, mechanisms = 3;
  std::vector<float> stress(3 * cells), memory(3 * mechanisms * cells), shares(2 * mechanisms * cells);
  for (auto* values : {&stress, &memory})
    std::generate(values->begin(), values->end(), [&] { return random(engine); });
  std::generate(shares.begin(), shares.end(), [&] { return 0.1F * std::abs(random(engine)); });
  std::vector<float> axes(axis_values(2, Relaxing::turned) * cells, 0.F);
  for (std::size_t n = 0; n < axes.size(); ++n) axes[n] = n / relaxation_block % 2 == 0 ? 1.F : 0.F;
  auto other_stress = stress, other_memory = memory;
  RelaxationRows<float> rows{stress.data(), cells, memory.data(), shares.data(), nullptr, {0.1F, 0.3F, 0.5F}};
  relaxation_kernel<float>(2, Relaxing::all, mechanisms)(cells, rows);
  rows.stress = other_stress.data(), rows.memory = other_memory.data(), rows.axes = axes.data();
  relaxation_kernel<float>(2, Relaxing::turned, mechanisms)(cells, rows);
  EXPECT_EQ(other_stress, stress);
  EXPECT_EQ(other_memory, memory);
}

}  // namespace
}  // namespace slipwave::solver::anisotropic_references_test
