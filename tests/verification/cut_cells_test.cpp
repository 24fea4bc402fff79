// SPDX-License-Identifier: BSD-3-Clause
// Clusters whose edges cut cells: against laminates, and against waves that know nothing of cells.
#include <gtest/gtest.h>

#include <random>

#include "complex_system.hpp"
#include "layer_in_tension.hpp"
#include "model/cluster_edge.hpp"
#include "model/fracture.hpp"
#include "shared_out.hpp"
#include "solver/effect/linear_slip.hpp"

namespace slipwave::solver::cut_cells_test {
namespace {

using Tensor2 = SymmetricTensor<2, double>;
const double lambda = modulus_p - 2 * mu;

/// Everything on one side of a line with this normal, at a distance from the middle of some cells of 1 m.
struct HalfPlane {
  static constexpr std::int64_t cells = 5;
  double degrees, distance;

  Point<2> normal() const {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
  }
  Model<2> model(const SlipSystem<2>& system) const {
    Model<2> model;
    model.medium = uniform_medium(cells, cells, 1, rock);
    const auto m = normal();
    const Point<2> middle = {cells / 2. + distance * m[0], cells / 2. + distance * m[1]};
    const double far = 100;
    const auto corner = [&](double along, double across) {
      return Point<2>{middle[0] - along * m[1] + across * m[0], middle[1] + along * m[0] + across * m[1]};
    };
    add_fractures<2>(
        model, {"part", {system}},
        region_of_polygon({corner(-far, 0), corner(far, 0), corner(far, -far), corner(-far, -far)}));
    return model;
  }
};
/// The same in space, in which planes and edge strike along y.
Model<3> extruded(const SlipSystem<2>& system, double edge_dip_deg, double distance) {
  constexpr std::int64_t cells = HalfPlane::cells;
  Model<3> model;
  const Grid<3> grid{{cells, cells, cells}, 1, {0, 0, 0}};
  model.medium = {Field<3>(grid, float(rock.vp)), Field<3>(grid, float(rock.vs)),
                  Field<3>(grid, float(rock.rho))};
  SlipSystem<3> planes{{system.normal[0], 0, system.normal[1]}, 0, 0, system.strength_pa};
  planes.law = system.law, planes.compliance = system.compliance;
  const double dip = edge_dip_deg * std::numbers::pi / 180, middle = cells / 2., far = 100;
  const auto along = [&](double part) { return shown(middle + (distance - far / 2) * part); };
  const auto text = along(-std::sin(dip)) + "," + shown(middle) + "," + along(std::cos(dip)) + ":" +
                    shown(far) + "," + shown(far) + "," + shown(far) + ":" + shown(edge_dip_deg);
  add_fractures<3>(model, {"part", {planes}}, parse_slab<3>(text));
  return model;
}

/// The middle cell of such cells, strained by hand.
template <int D>
class CutCell {
 public:
  using Tensor = SymmetricTensor<D, double>;
  explicit CutCell(const Model<D>& model) {
    middle_.fill(2);
    scene_.model = model;
    check(scene_.model);
    scene_.numerics.correction = SlipCorrection::first;
    EdgeLaws<D> edges;
    for (int axis = 0; axis < D; ++axis) edges[axis] = {EdgeLaw::rigid, EdgeLaw::rigid};
    domain_ = make_domain(scene_.model.medium, edges, 1);
    state_ = make_state<D, double>(domain_.grid.shape);
    if (gives(scene_.model.fracture_sets[0]))
      effect_ = std::make_unique<LinearSlip<D, double>>(state_, domain_, scene_, dt_s);
    else
      effect_ = std::make_unique<Slip<D, double>>(state_, domain_, scene_, dt_s);
  }
  double share() const { return fracture_share_of(scene_.model, cell()); }
  Point<D> edge() const { return edge_normal(scene_.model, cell()); }
  Tensor strain(const Tensor& by) {
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += by(i, i);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) at(i, j) += 2 * mu * by(i, j) + (i == j ? lambda * trace : 0);
    run_everywhere(*effect_, {0, dt_s}, state_);
    Tensor stress;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) stress(i, j) = at(i, j);
    run_after_everywhere(*effect_, {0, dt_s}, state_);
    return stress;
  }

 private:
  static constexpr double dt_s = 1e-3;
  std::size_t cell() const { return std::size_t(scene_.model.grid().flat(middle_)); }
  double& at(int i, int j) {
    auto row = middle_;
    row[0] = 0;
    return state_.field_row(row, FieldRows<D>::normal_stress(0) + Tensor::place(i, j))[middle_[0]];
  }
  Index<D> middle_{};
  Scene<D> scene_;
  Domain<D> domain_;
  State<D, double> state_;
  std::unique_ptr<Effect<D, double>> effect_;
};

/// The mean stress of two layers of rock under a mean strain, of which one, with a share of the volume, has
/// planes: of these compliances, or dry ones that hold `strength` of shear traction. From the equations of
/// layers alone: traction across the edge and strain along it are the same in both.
Tensor2 of_laminate(const Tensor2& strain, double share, const Point<2>& m, const SlipSystem<2>& system) {
  const auto& n = system.normal;
  const Point<2> t = {-n[1], n[0]}, l = {-m[1], m[0]};
  const auto planes = compliance_in(system.compliance, lambda, mu);
  const bool dry = !system.compliance.gives();
  // Unknowns: three stresses each, and slip. Strains xx, zz, xz of a unit of each.
  const auto strain_of = [&](std::size_t component, bool with_planes) {
    Tensor2 s, e;
    s.values[component] = 1;
    const double trace = s(0, 0) + s(1, 1);
    for (int i = 0; i < 2; ++i)
      for (int j = i; j < 2; ++j)
        e(i, j) = (s(i, j) - (i == j ? lambda * trace / (2 * lambda + 2 * mu) : 0)) / (2 * mu);
    if (!with_planes) return e;
    Point<2> tau;
    const double s_n = resolve<2, double>(n, s, tau);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = i; j < 2; ++j)
        e(int(i), int(j)) +=
            planes.normal * s_n * n[i] * n[j] + planes.tangential * (tau[i] * n[j] + n[i] * tau[j]) / 2;
    return e;
  };
  const auto along = [&](const Tensor2& e) {
    return e(0, 0) * l[0] * l[0] + e(1, 1) * l[1] * l[1] + 2 * e(0, 1) * l[0] * l[1];
  };
  const auto stresses = [&](double strength, bool slips) {
    constexpr double unit = 1e9;  // Pa, so that all coefficients are of one size
    ComplexSystem rows(7, std::vector<std::complex<double>>(8));
    for (std::size_t c = 0; c < 3; ++c) {
      rows[c][7] = strain.values[c] * unit;
      for (const bool first : {true, false}) {
        const auto column = (first ? 0 : 3) + c;
        const auto e = strain_of(c, first);
        for (std::size_t k = 0; k < 3; ++k)
          rows[k][column] = (first ? share : 1 - share) * e.values[k] * unit;
        rows[3][column] = (first ? 1 : -1) * along(e) * unit;
        Tensor2 s;
        s.values[c] = 1;
        for (int i = 0; i < 2; ++i)
          rows[std::size_t(4 + i)][column] = (first ? 1 : -1) * (s(i, 0) * m[0] + s(i, 1) * m[1]);
        Point<2> tau;
        resolve<2, double>(n, s, tau);
        if (first && slips) rows[6][column] = tau[0] * t[0] + tau[1] * t[1];
      }
    }
    Tensor2 slip;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = i; j < 2; ++j) slip(int(i), int(j)) = (n[i] * t[j] + t[i] * n[j]) / 2;
    for (std::size_t k = 0; k < 3; ++k) rows[k][6] = share * slip.values[k];
    rows[3][6] = along(slip);
    if (!slips) rows[6][6] = 1;
    rows[6][7] = slips ? strength : 0;
    const auto found = solved(rows);
    std::array<double, 6> stress{};
    for (std::size_t k = 0; k < 6; ++k) stress[k] = found[k].real();
    return stress;
  };
  auto stress = stresses(0, false);
  Tensor2 part;
  for (std::size_t k = 0; k < 3; ++k) part.values[k] = stress[k];
  Point<2> tau;
  resolve<2, double>(n, part, tau);
  const double size = tau[0] * t[0] + tau[1] * t[1];
  if (dry && std::abs(size) > system.strength_pa)
    stress = stresses(std::copysign(system.strength_pa, size), true);
  Tensor2 mean;
  for (std::size_t k = 0; k < 3; ++k) mean.values[k] = share * stress[k] + (1 - share) * stress[3 + k];
  return mean;
}

constexpr HalfPlane halves[] = {{90, 0.1},  {90, -0.3}, {0, 0.2},   {45, 0.05},
                                {20, -0.1}, {70, 0.3},  {-30, 0.15}};

// Proves (S39).
TEST(EdgeOfACluster, HasTheNormalOfTheLineThatCutsCells) {
  for (const double distance : {-0.3, -0.1, 0.05, 0.25})
    for (double degrees = 0; degrees < 180; degrees += 7.5) {
      const HalfPlane half{degrees, distance};
      const auto model = half.model({{0, 1}, 0.1, 1, 0});
      const auto cell = std::size_t(model.grid().flat({2, 2}));
      const auto found = edge_normal(model, cell), exact = half.normal();
      EXPECT_GT(std::abs(found[0] * exact[0] + found[1] * exact[1]), std::cos(5 * std::numbers::pi / 180))
          << degrees << ' ' << distance;
    }
}

TEST(EdgeOfACluster, ThatIsThinnerThanACellLiesAlongIt) {
  for (const double dip : {0., 30., 45., 90.}) {
    Model<2> model;
    model.medium = uniform_medium(9, 9, 1, rock);
    add_fractures<2>(model, {"thin", {{{0, 1}, 0.1, 1, 0}}},
                     parse_slab<2>("4.5,4.5:30,0.3:" + std::to_string(dip)));
    const auto found = edge_normal(model, std::size_t(model.grid().flat({4, 4})));
    const auto exact = normal_of_dip(dip);
    EXPECT_GT(std::abs(found[0] * exact[0] + found[1] * exact[1]), std::cos(15 * std::numbers::pi / 180))
        << dip;
  }
}

// Proves (S38).
TEST(CutCell, SlipsAsALaminateOfItsPartsDoes) {
  for (const auto& half : halves)
    for (const double dip : {0., 45., 20., -70.}) {
      SlipSystem<2> dry{normal_of_dip(dip), 0, 0, 1e4};
      CutCell<2> cell(half.model(dry));
      Tensor2 total;
      const Tensor2 by{{2e-7, -1.1e-7, 3e-7}};
      for (int step = 0; step < 20; ++step) {
        for (std::size_t c = 0; c < 3; ++c) total.values[c] += by.values[c];
        const auto found = cell.strain(by), exact = of_laminate(total, cell.share(), cell.edge(), dry);
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(found.values[c], exact.values[c], 1e-2) << half.degrees << ' ' << dip << ' ' << step;
      }
    }
}

// Proves (S38).
TEST(CutCell, GivesWayAsALaminateOfItsPartsDoes) {
  for (const auto& half : halves)
    for (const double dip : {0., 45., 20., -70.}) {
      SlipSystem<2> springs{normal_of_dip(dip)};
      springs.law = FrictionLaw::none;
      springs.compliance = {2e-11, 5e-11, 0, 0, 1};
      CutCell<2> cell(half.model(springs));
      std::mt19937 engine(7);
      std::uniform_real_distribution<double> uniform(-1e-6, 1e-6);
      Tensor2 total;
      for (int step = 0; step < 5; ++step) {
        Tensor2 by;
        for (auto& value : by.values) value = uniform(engine);
        for (std::size_t c = 0; c < 3; ++c) total.values[c] += by.values[c];
        const auto found = cell.strain(by), exact = of_laminate(total, cell.share(), cell.edge(), springs);
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(found.values[c], exact.values[c], 1e-2) << half.degrees << ' ' << dip << ' ' << step;
      }
    }
}

// Proves (S39).
TEST(CutCell, InSpaceComesToWhatItDoesInAPlane) {
  for (const bool gives : {false, true})
    for (const double edge_dip : {0., 90., 45., -25.})
      for (const double dip : {0., 45., 20.}) {
        SlipSystem<2> planes{normal_of_dip(dip), 0, 0, 1e4};
        if (gives) planes.law = FrictionLaw::none, planes.compliance = {2e-11, 5e-11, 0, 0, 1};
        CutCell<3> cell(extruded(planes, edge_dip, 0.2));
        const auto edge = cell.edge();
        ASSERT_NEAR(edge[1], 0, 1e-6);
        const Tensor2 total{{4e-6, -2.2e-6, 6e-6}};
        SymmetricTensor<3, double> by, found;
        by(0, 0) = total(0, 0), by(2, 2) = total(1, 1), by(0, 2) = total(0, 1);
        cell.strain(by);
        // The stiffer direction, along the edge, stands for both: what is left goes off in some steps.
        for (int step = 0; step < 60; ++step) found = cell.strain({});
        const auto exact = of_laminate(total, cell.share(), {edge[0], edge[2]}, planes);
        EXPECT_NEAR(found(0, 0), exact(0, 0), 1) << gives << ' ' << edge_dip << ' ' << dip;
        EXPECT_NEAR(found(2, 2), exact(1, 1), 1) << gives << ' ' << edge_dip << ' ' << dip;
        EXPECT_NEAR(found(0, 2), exact(0, 1), 1) << gives << ' ' << edge_dip << ' ' << dip;
      }
}

// Proves (S39).
TEST(CutCells, LetTheResponseConvergeWhereverEdgesLie) {
  const auto exact = tension::reference(600);
  const auto error = [&](double h, double offset, bool shared) {
    return errors_below_60_hz(tension::solved(SlipCorrection::centred, {h, offset, shared}, 0.9), exact);
  };
  for (const double offset : {0.25, 0.5, 0.75}) {
    const auto coarse = error(5, offset, true), fine = error(2.5, offset, true);
    EXPECT_LT(coarse.back, 2.5) << offset;
    EXPECT_GT(observed_order(coarse.back, fine.back), 1.2) << offset;
    EXPECT_LT(coarse.through, 1.1) << offset;
    EXPECT_GT(observed_order(coarse.through, fine.through), 1.6) << offset;
  }
  // By cells that slip all or nothing the layer lies half a cell beside its place.
  EXPECT_GT(error(5, 0.5, false).back, 15);
}

/// A force above a slab of planes that dips, so that its edges cut cells everywhere.
Scene<2> slab_of(const std::vector<SlipSystem<2>>& systems) {
  Scene<2> scene;
  scene.model.medium = uniform_medium(60, 48, 10, rock);
  add_fractures<2>(scene.model, {"slab", systems}, parse_slab("300,260:330,57:20"));
  scene.survey.sources = {{{270, 90}, PointForce<2>{{0.5, 1}}, parse_wavelet("ricker:20"), 1e9}};
  scene.survey.receivers_m = {{190, 120}, {410, 120}, {330, 400}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.recording = {{Component::vx, Component::vz}, 0.15, 0.001};
  return scene;
}

TEST(CutCells, OfShareOneAreWholeCellsToTheBit) {
  const auto scene = slab_of({{normal_of_dip(50), 0.2, 300, 100}});
  auto whole = scene, marked = scene;
  whole.model.fracture_share = {};
  std::fill(marked.model.fracture_share.begin(), marked.model.fracture_share.end(), 1.F);
  EXPECT_TRUE(samples_of(shoot(marked, 1)) == samples_of(shoot(whole, 1)));
}

}  // namespace
}  // namespace slipwave::solver::cut_cells_test
