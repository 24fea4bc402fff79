// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "accuracy/full_space.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"
#include "solver/sweep/extension_errors.hpp"
#include "solver/sweep/point_weights.hpp"
#include "stack_scene.hpp"

namespace slipwave::solver::solver_position_test {
namespace {

/// The centre of the model at (0, 0) or, with a free top, the middle of its surface.
Medium<2> centred(const Rock& rock, std::int64_t nx, std::int64_t nz, double h, bool below_surface) {
  Medium<2> medium = uniform_medium(nx, nz, h, rock);
  for (auto* field : {&medium.vp, &medium.vs, &medium.rho}) {
    Grid<2> grid = field->grid();
    grid.origin_m = {-double(nx) * h / 2, below_surface ? 0 : -double(nz) * h / 2};
    Field<2> moved(grid);
    std::copy(field->begin(), field->end(), moved.begin());
    *field = moved;
  }
  return medium;
}

/// Traces at places fixed to the source, which is `shift` cells off a cell's centre along both axes.
Gather around_source(const char* mechanism, double shift_x, double shift_z) {
  const double h = 12.5;  // S waves of 8 cells at the peak of the wavelet
  Scene<2> scene;
  scene.model.medium = centred({4500, 2000, 2200}, 201, 201, h, false);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  const Point<2> at = {shift_x * h, shift_z * h};
  scene.survey.sources = {{at, parse_mechanism<2>(mechanism), parse_wavelet("ricker:20"), 1e6}};
  for (const auto& offset : {Point<2>{700, 0}, Point<2>{512.5, 487.5}, Point<2>{-300, 600}})
    scene.survey.receivers_m.push_back({at[0] + offset[0], at[1] + offset[1]});
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.double_precision = true;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.5, 0.001};
  check(scene);
  return shoot(scene, 1);
}

/// Of all traces of a component, the first, second or third of those recorded.
std::vector<double> samples_of(const Gather& gather, std::size_t component) {
  const std::size_t receivers = gather.traces.size() / 3;
  std::vector<double> all;
  for (std::size_t n = component * receivers; n < (component + 1) * receivers; ++n)
    all.insert(all.end(), gather.traces[n].samples.begin(), gather.traces[n].samples.end());
  return all;
}

// Proves (A2).
TEST(SourceAndReceivers, MovedTogetherByPartsOfACellRecordTheSame) {
  // 0.2 % is what a survey asks of positions between cells; the error of the weights (A1) is smaller.
  for (const char* mechanism : {"explosion", "force:0,1", "moment:1,-1,0.5"}) {
    const auto on_centre = around_source(mechanism, 0, 0);
    for (const auto& [x, z] : {std::pair(0.5, 0.5), std::pair(0.25, 0.), std::pair(-0.4, 0.3)}) {
      // In the short form each mechanism is moved by one of them.
      if (!long_form() && x != (mechanism[0] == 'e' ? 0.5 : mechanism[0] == 'f' ? 0.25 : -0.4)) continue;
      const auto moved = around_source(mechanism, x, z);
      for (const std::size_t component : {0, 1, 2})
        EXPECT_LT(relative_error(samples_of(moved, component), samples_of(on_centre, component)), 0.002)
            << mechanism << ' ' << x << ' ' << z << ", component " << component;
    }
  }
}

/// Traces of an explosion in water under a free surface, and the closed form: the direct wave less that of
/// its image. Depths in cells.
struct WaterCase {
  Gather found;
  std::array<std::vector<double>, 5> exact;
};
WaterCase shoot_in_water(double source_depth, double receiver_depth) {
  const Rock water{1500, 0, 1000};
  const double h = 3, peak_hz = 20, interval_s = 0.001;  // 25 cells per wavelength at the peak
  Scene<2> scene;
  scene.model.medium = centred(water, 301, 150, h, true);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  const double zs = source_depth * h, zr = receiver_depth * h, x = 300.7;
  scene.survey.sources = {{{0, zs}, Explosion{}, parse_wavelet("ricker:20"), 1e6}};
  scene.survey.receivers_m = {{x, zr}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.numerics.double_precision = true;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.4, interval_s};
  check(scene);
  WaterCase result{shoot(scene, 1), {}};
  result.exact = ricker_response(peak_hz, interval_s, result.found.axis.count, [&](double omega) {
    Motion motion = explosion_motion(water, omega, x, zr - zs);
    const Motion image = explosion_motion(water, omega, x, zr + zs);
    for (std::size_t row = 0; row < motion.size(); ++row) motion[row] -= image[row];
    motion[2] *= -1;  // the pressure
    return motion;
  });
  for (auto& trace : result.found.traces)
    for (double& sample : trace.samples) sample /= 1e6;
  return result;
}

// Proves (A2).
TEST(ExplosionInWater, IsItselfAndItsImageAtEveryDepthBelowTheSurface) {
  // The error of 100 cells of travel is 1.4 % wherever source and receiver are: the surface adds nothing.
  for (const double receiver : {0., 0.25, 1.5, 8.})
    for (const double source : {0.25, 0.5, 1., 1.7, 3.}) {
      const auto [found, exact] = shoot_in_water(source, receiver);
      for (const std::size_t row : {0, 1, 2}) {
        const auto message = testing::Message()
                             << "component " << row << ", depths " << source << ' ' << receiver;
        if (receiver > 0 || row == 1) {
          EXPECT_LT(relative_error(found.traces[row].samples, exact[row]), 0.016) << message;
        } else {  // on the surface nothing moves along it and there is no pressure
          for (const double sample : found.traces[row].samples)
            ASSERT_LT(std::abs(sample), row == 0 ? 1e-20 : 1e-14) << message;
        }
      }
    }
}

TEST(SourceAndReceivers, RecordRarelyWhatTheyRecordOften) {
  // Binary fractions of a second: the instants of both are the same numbers. Steps take 0.9 ms.
  constexpr double instant = 1. / 16384;
  Scene<2> scene;
  scene.model.medium = uniform_medium(60, 50, 5, {5000, 2200, 2200});
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  scene.survey.sources = {{{120, 90}, parse_mechanism<2>("force:1,2"), parse_wavelet("ricker:40"), 1e6}};
  // Sharing cells, alone, on a centre, below the surface.
  scene.survey.receivers_m = {{101.3, 151.2}, {104.1, 151.2}, {250.9, 33.3}, {62.5, 112.5}, {31, 1.5}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  const auto every = [&](std::int64_t instants) {
    scene.recording = {{Component::vx, Component::vz, Component::p}, 0.25, double(instants) * instant};
    check(scene);
    return shoot(scene, 1);
  };
  const auto often = every(1);
  for (const std::int64_t instants : {4, 16, 128, 256, 1024}) {
    const auto rarely = every(instants);
    ASSERT_EQ(rarely.traces.size(), often.traces.size());
    for (std::size_t n = 0; n < often.traces.size(); ++n) {
      const auto& samples = rarely.traces[n].samples;
      ASSERT_GE(samples.size(), 4U);
      for (std::size_t t = 0; t < samples.size(); ++t)
        ASSERT_EQ(samples[t], often.traces[n].samples[t * std::size_t(instants)])
            << "every " << instants << ", trace " << n << ", sample " << t;
    }
  }
}

/// Each trace against the exact one, relative.
std::vector<double> errors_of(const StackScene& stack) {
  const auto found = shoot(stack.scene(), 1), exact = stack.exact().front();
  std::vector<double> errors;
  for (std::size_t n = 0; n < found.traces.size(); ++n) {
    double squares = 0, all = 0;
    for (std::size_t k = 0; k < found.traces[n].samples.size(); ++k) {
      squares += std::pow(double(found.traces[n].samples[k]) - exact.traces[n].samples[k], 2);
      all += std::pow(exact.traces[n].samples[k], 2);
    }
    errors.push_back(std::sqrt(squares / all));
  }
  return errors;
}

// Proves (A24).
/// On an interface of rocks, along it and across, and beside it motion has the error of the scheme.
TEST(SourceAndReceivers, AtAnInterfaceOfRocksRecordTheExactMotion) {
  for (const double cfl : {0.9, 0.3}) {
    StackScene stack{"two rocks", {{2000, 1100, 1930}, {3300, 1750, 2530}}, {0}};
    stack.source_b = -50, stack.peak_hz = 25, stack.duration_s = 0.4, stack.spacing_m = 2, stack.cfl = cfl;
    for (const double b : {-20., -2., -1., 0., 1., 2.}) stack.receivers.push_back({200, b});
    const auto errors = errors_of(stack);
    // Shorter steps heal less of what the extensions do not know.
    for (std::size_t n = 0; n < errors.size(); ++n) {
      const bool on_it = n % stack.receivers.size() == 3;
      if (cfl == 0.9 || on_it) {
        EXPECT_LT(errors[n], 0.01) << cfl << ", " << n;
      }
    }
  }
}

// Proves (A24).
/// Forces on an interface of rocks, along it and across, make motion elsewhere of second order.
TEST(SourceAndReceivers, OnAnInterfaceOfRocksForcesActToSecondOrder) {
  for (const auto& force : {Point<2>{1, 0}, Point<2>{0, 1}}) {
    std::array<double, 2> worst{};
    for (const int half : {0, 1}) {
      StackScene stack{"two rocks", {{2000, 1100, 1930}, {3300, 1750, 2530}}, {0}};
      stack.source_b = 1e-5, stack.force = force, stack.peak_hz = 25, stack.duration_s = 0.2;
      stack.spacing_m = half ? 1 : 2, stack.margin_m = 40;
      for (const double b : {-30., 30.}) stack.receivers.push_back({100, b});
      for (const double error : errors_of(stack))
        worst[std::size_t(half)] = std::max(worst[std::size_t(half)], error);
    }
    EXPECT_GT(observed_order(worst[0], worst[1]), 1.5) << force[0];
    EXPECT_LT(worst[1], 0.01) << force[0];
  }
}

/// Motion that grows with x, otherwise on both sides of a level interface, makes slopes across: motion along
/// x of v_z, or, of the shear waves of the lower side, that along z of v_x. Returns by how much the field
/// beside it lies off them, of the largest, less what extension_errors() says.
double not_told(const Rock& above, double courant, const std::array<double, 2>& along, bool shear = false) {
  using L = Lab<double>;
  constexpr std::int64_t nx = 321, nz = 300, face = 150, middle = nx / 2;
  constexpr int told_rows = 4, straight = 10, straight_to = 14;
  const Rock below{2500, 1300, 2200};
  const double h = 2, dt_s = courant * h / below.vp;
  auto medium = uniform_medium(nx, nz, h, below);
  for (std::int64_t k = 0; k < face; ++k)
    for (std::int64_t i = 0; i < nx; ++i) put(medium, {i, k}, above);
  L lab(medium, edges_all(EdgeLaw::rigid), 5, dt_s);
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i)
      lab(shear ? L::vz : L::vx, i, k) = along[k < face ? 0 : 1] * double(i - middle);
  const auto speed = [&](const Rock& rock) { return shear ? rock.vs : rock.vp; };
  const SweepsAcross sweeps{5,
                            {speed(above) * above.rho, speed(below) * below.rho},
                            {speed(above) * dt_s / h, speed(below) * dt_s / h},
                            1,
                            0,
                            splitting(2, 2)};
  lab.steps(std::int64_t(60 / sweeps.courant[shear ? 1 : 0]));
  const auto row = [&](std::size_t side, int n) { return side == 0 ? face - 1 - n : face + n; };
  const auto slope = [&](L::Row of, std::size_t side) {
    const double rise = lab(of, middle, row(side, straight_to)) - lab(of, middle, row(side, straight));
    return (side == 0 ? -1 : 1) * rise / (straight_to - straight);
  };
  const L::Row v = shear ? L::vx : L::vz, s = shear ? L::sxz : L::szz;
  const SlopesBeside slopes{{slope(v, 0), slope(v, 1)}, {slope(s, 0), slope(s, 1)}};
  std::array<double, 2> known{};
  if (shear)
    known = {0, -along[1]};
  else if (above.vs == 0)
    known = {-along[0], -(1 - 2 * std::pow(below.vs / below.vp, 2)) * along[1]};
  const auto told = extension_errors(sweeps, slopes, known);
  double largest = 0, difference = 0;
  for (const std::size_t side : {0, 1})
    for (int n = 0; n < told_rows && sweeps.impedance[side] > 0; ++n) {
      const double off = lab(v, middle, row(side, n)) - lab(v, middle, row(side, straight)) -
                         (side == 0 ? 1 : -1) * slopes.v[side] * (straight - n);
      largest = std::max(largest, std::abs(off));
      difference = std::max(difference, std::abs(off - told.v[side][std::size_t(n)]));
    }
  return difference / largest;
}

// Proves (A24).
TEST(ExtensionErrors, AreThoseThatStepsLeaveBesideAnInterface) {
  for (const double courant : {0.9, 0.3}) {
    if (!long_form() && courant == 0.3) continue;
    EXPECT_LT(not_told({1500, 800, 1000}, courant, {1, 1}), 0.02) << courant;
    for (const auto& along : {std::array{1., 0.}, std::array{0., 1.}})
      EXPECT_LT(not_told({1500, 0, 1000}, courant, along), 0.02) << courant << ", " << along[0];
    EXPECT_LT(not_told({1500, 0, 1000}, courant, {1, 1}, true), 0.02) << courant << ", shear";
  }
}

/// Two rocks with a level interface between rows, from the plane x = 0 to one side or to both, and a force
/// on the interface `source_x_m` away, with its mirror image where there is no mirror.
template <int D>
Gather at_a_plane_of_symmetry(bool whole, int axis, double source_x_m) {
  constexpr std::int64_t half = 24, rows = 20;
  const double h = 5;
  Grid<D> grid;
  grid.spacing_m = h;
  grid.shape.fill(rows), grid.origin_m.fill(0);
  grid.shape[0] = whole ? 2 * half : half;
  if (whole) grid.origin_m[0] = -double(half) * h;
  Scene<D> scene;
  auto& medium = scene.model.medium;
  medium = {Field<D>(grid, 3300), Field<D>(grid, 1750), Field<D>(grid, 2530)};
  for (std::int64_t n = 0; n < grid.size(); ++n)
    if (grid.index(n)[D - 1] < rows / 2) {
      const auto at = grid.index(n);
      medium.vp(at) = 2000, medium.vs(at) = 1100, medium.rho(at) = 1930;
    }
  scene.model.fracture = Field<D, std::uint8_t>(grid);
  const auto on_interface = [&](double x_m) {
    Point<D> place;
    place.fill(double(rows) * h / 2);
    place[0] = x_m;
    return place;
  };
  PointForce<D> force;
  force.vector[std::size_t(axis)] = 1;
  auto image = force;
  if (axis == 0) image.vector[0] = -1;
  const auto wavelet = parse_wavelet("ricker:25");
  scene.survey.sources = {{on_interface(source_x_m), force, wavelet, 1e6}};
  if (whole) scene.survey.blended = {{{on_interface(-source_x_m), image, wavelet, 1e6}}};
  for (const double cell : {0., 0.5, 1.2, 3., 4.4, 9.})
    scene.survey.receivers_m.push_back(on_interface(cell * h));
  for (int of = 0; of < D; ++of) scene.edges[of] = {EdgeLaw::rigid, EdgeLaw::rigid};
  if (!whole) scene.edges[0][0] = EdgeLaw::mirror;
  scene.numerics.double_precision = true;
  scene.recording = {{Component::vx, Component::vz}, 0.08, 0.001};
  check(scene);
  return shoot(scene, 1);
}

/// A point on an interface may have images of its terms beyond a plane of symmetry, in any of the columns
/// that it reads: half of a model records what the whole does.
template <int D>
void expect_half_records_what_the_whole_does() {
  for (const int axis : {0, D - 1})
    for (const double source_x_m : {2.5, 9., 60.}) {
      if (!long_form() && (source_x_m == 9) != (axis == 0)) continue;
      const auto whole = at_a_plane_of_symmetry<D>(true, axis, source_x_m),
                 half = at_a_plane_of_symmetry<D>(false, axis, source_x_m);
      double largest = 0, difference = 0;
      for (std::size_t n = 0; n < whole.traces.size(); ++n)
        for (std::size_t k = 0; k < whole.traces[n].samples.size(); ++k) {
          const double one = half.traces[n].samples[k], other = whole.traces[n].samples[k];
          largest = std::max(largest, std::abs(other));
          difference = std::max(difference, std::abs(one - other));
        }
      EXPECT_GT(largest, 0);
      EXPECT_LT(difference, 1e-6 * largest) << axis << ", " << source_x_m;  // samples are single
    }
}
TEST(SourceAndReceivers, OnAnInterfaceBesideAPlaneOfSymmetryAreThoseOfTheWhole) {
  expect_half_records_what_the_whole_does<2>();
  expect_half_records_what_the_whole_does<3>();
}

/// Beside any sides points on an interface read and add to cells of the model.
TEST(SourceAndReceivers, OnAnInterfaceBesideASideStayWithinTheModel) {
  constexpr std::int64_t cells = 30;
  auto medium = uniform_medium(cells, cells, 5, {3300, 1750, 2530});
  for (std::int64_t k = 0; k < cells / 2; ++k)
    for (std::int64_t i = 0; i < cells; ++i)
      medium.vp({i, k}) = 2000, medium.vs({i, k}) = 1100, medium.rho({i, k}) = 1930;
  for (const auto law : {EdgeLaw::free, EdgeLaw::rigid, EdgeLaw::mirror}) {
    auto domain = make_domain(medium, edges_all(law), 1);
    domain.steps = {&medium, 1e-3, 2};
    const Layout<2> layout(domain.grid.shape, FieldRows<2>::count);
    const auto within = [&](const std::vector<ValueWeight>& weights) {
      for (const auto& value : weights)
        if (value.place < 0 || value.place % layout.row_pitch() >= cells) return false;
      return true;
    };
    for (const double cell : {0., 0.5, 1.5, 3.2, 12., 29.8})
      for (const int row : {0, 1}) {
        const Point<2> place = {cell * 5, 75};
        EXPECT_TRUE(within(row_weights<2>(layout, domain, place, row, Side::solid)))
            << int(law) << ' ' << cell;
        EXPECT_TRUE(within(source_weights<2>(layout, domain, place, row, Side::solid)))
            << int(law) << ' ' << cell;
      }
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_position_test
