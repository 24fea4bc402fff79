// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "cube.hpp"
#include "lab.hpp"
#include "memory_archive.hpp"
#include "parallel/threads.hpp"
#include "scene/largest_velocity.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/stability_check.hpp"
#include "solver/simulation.hpp"

// A run whose fields are no longer those of waves ends, and says where that began.
namespace slipwave::solver::solver_instability_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, water{1500, 0, 1000};
constexpr std::int64_t nx = 240, nz = 200;
constexpr double h = 5;

/// 150 m of water over rock with cracks at x from 500 to 700, z from 600 to 700 m.
Scene<2> sea() {
  Scene<2> scene;
  scene.model.medium = uniform_medium(nx, nz, h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t k = 0; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      if (k < 30) put(scene.model.medium, {i, k}, water);
      if (k >= 120 && k < 140 && i >= 100 && i < 140) scene.model.fracture({i, k}) = 1;
    }
  scene.model.fracture_sets = {{"cracks", {{{0.6, 0.8}, 0.5, 1000, 0}}}};
  scene.survey.sources = {{{252.5, 402.5}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:25"), 1e6}};
  scene.survey.receivers_m = {{100, 30}, {402.5, 201.3}, {620, 333}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.edges[1][0] = EdgeLaw::free;
  scene.recording = {{Component::vx, Component::vz, Component::p}, 0.3, 0.001};
  return scene;
}

/// Lets the shot stop once, after so many steps, and continue with a velocity of one cell changed.
class Spoiler : public Pauses {
 public:
  Spoiler(const Scene<2>& scene, std::int64_t after, const Index<2>& model_cell, double velocity)
      : layout_(make_domain(scene.model.medium, scene.edges, zone_cells(scene, scene.survey.sources[0]))
                    .grid.shape,
                FieldRows<2>::count),
        after_(after),
        cell_(model_cell),
        velocity_(velocity) {}
  void begin(const Serialize&) override {}
  bool wanted() override { return !done_; }
  void pause(const Serialize& keep, const ShotPlace& place) override {
    if (place.done != after_) return;
    done_ = true;
    std::vector<char> kept;
    ToMemory to(kept);
    keep(to);
    // The PML on the left comes first.
    const auto at = layout_.cell({cell_[0] + 20, cell_[1]}) + FieldRows<2>::velocity(1) * layout_.row_pitch();
    const auto value = float(velocity_);
    // Steps made and the number of values come first.
    std::memcpy(kept.data() + 2 * sizeof(std::int64_t) + std::size_t(at) * sizeof value, &value,
                sizeof value);
    FromMemory from(kept);
    keep(from);
  }

 private:
  Layout<2> layout_;
  std::int64_t after_;
  Index<2> cell_;
  double velocity_;
  bool done_ = false;
};

/// What is said of a shot in which the velocity of a cell was changed two steps before the fourth check.
std::string said_of(const Scene<2>& scene, const Index<2>& model_cell, double velocity) {
  Spoiler spoiler(scene, 198, model_cell, velocity);
  try {
    shoot<2>(scene, 1, {}, {}, &spoiler);
  } catch (const Unstable& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unstable);
    return error.what();
  }
  return "";
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TEST(Instability, IsPlacedWhereACellWasSpoiltAndTellsOfItsMediumAndWhatIsNear) {
  const std::string hard = "vp=4500 vs=2250 rho=2500", soft = "vp=1500 vs=0 rho=1000";
  struct Case {
    Index<2> cell;
    std::string place, surroundings;
  };
  const Case cases[] = {
      {{200, 100}, "x=1002.5 z=502.5", hard + ", nothing else within 50 m"},
      {{120, 130}, "x=602.5 z=652.5", hard + ", at fracture set cracks"},
      {{120, 115}, "x=602.5 z=577.5", hard + ", 25 m from fracture set cracks"},
      {{200, 30}, "x=1002.5 z=152.5", hard + ", at a fluid-solid interface"},
      {{200, 23}, "x=1002.5 z=117.5", soft + ", at fluid, 30 m from a fluid-solid interface"},
      {{52, 80}, "x=262.5 z=402.5", hard + ", 10 m from the source"},
      {{-5, 100}, "x=-22.5 z=502.5", hard + ", at the PML"},
      {{236, 100}, "x=1182.5 z=502.5", hard + ", 20 m from the PML"},
  };
  for (const auto& [cell, place, surroundings] : cases) {
    const auto said = said_of(sea(), cell, no_number);
    EXPECT_EQ(said.find("the simulation became unstable at " + place + ", t="), 0u) << said;
    EXPECT_NE(said.find(" s (step 200): v"), std::string::npos) << said;
    EXPECT_NE(said.find(" is not finite (limit "), std::string::npos) << said;
    EXPECT_NE(said.find("; " + surroundings + "; seen first in a box from "), std::string::npos) << said;
  }
}

TEST(Instability, ThatIsFiniteIsPlacedAtTheFastestCell) {
  const auto said = said_of(sea(), {200, 100}, 1e20);
  // The wave that the impossible velocity makes has moved by a step or two.
  EXPECT_NE(said.find(" m/s (limit "), std::string::npos) << said;
  const auto place = said.substr(said.find(" x=") + 3, 6);
  EXPECT_NEAR(std::stod(place), 1002.5, 2 * h) << said;
}

TEST(Instability, NearFreeSurfacesAndUnderPrestressIsSaidToBeThere) {
  auto scene = sea();
  EXPECT_NE(said_of(scene, {200, 8}, no_number).find(", 40 m from the free surface"), std::string::npos);
  scene.model.prestress_pa.assign(3, Field<2>(scene.model.grid(), -1e4f));
  scene.model.prestress_pa[2] = Field<2>(scene.model.grid(), 0.0f);
  EXPECT_NE(
      said_of(scene, {120, 130}, no_number).find("at fracture set cracks, at fractures under prestress"),
      std::string::npos);
  for (const auto& [law, edge] :
       {std::pair(EdgeLaw::rigid, "a rigid edge"), std::pair(EdgeLaw::mirror, "a mirror")}) {
    auto other = sea();
    other.edges[0][1] = law;
    // Spread into the edge its middle would be elsewhere.
    EXPECT_NE(said_of(other, {236, 100}, 1e20).find(" m from " + std::string(edge)), std::string::npos);
  }
}

/// Cracks near a source so strong that double precision ends; in single precision fields have their own unit.
Scene<2> too_strong(double amplitude) {
  auto scene = sea();
  scene.survey.sources[0].position_m = {602.5, 552.5};
  scene.survey.sources[0].amplitude = amplitude;
  scene.numerics.double_precision = true;
  // Values at faces overflow before fields do; uniform runs compute none.
  auto& medium = scene.model.medium;
  const auto& shape = medium.grid().shape;
  for (std::int64_t k = 0; k < shape[1]; ++k)
    for (std::int64_t i = k % 2; i < shape[0]; i += 32)
      if (medium.vs({i, k}) > 0) medium.vp({i, k}) *= 0.999F;
  return scene;
}

TEST(Instability, ThatBeganBetweenTwoLooksIsFollowedToItsFirstStep) {
  for (const double amplitude : {1e306, 1e307, 1e308}) {
    std::string before;
    for (const int threads : {1, 2, 3}) {
      const ThreadLimit limit(threads);
      try {
        shoot<2>(too_strong(amplitude), 1);
        FAIL() << amplitude;
      } catch (const Unstable& error) {
        const std::string said = error.what();
        // The source is in a cell whose neighbours overflow first.
        EXPECT_NE(said.find(" the source, "), std::string::npos) << said;
        EXPECT_EQ(said.find("seen first in a box"), std::string::npos) << said;
        EXPECT_TRUE(before.empty() || said == before) << said << before;
        before = said;
      }
    }
  }
}

TEST(Instability, LeavesWhatWasRecordedBeforeIt) {
  auto scene = sea();
  const auto whole = shoot<2>(scene, 1);
  Spoiler spoiler(scene, 198, {200, 100}, no_number);
  try {
    shoot<2>(scene, 1, {}, {}, &spoiler);
    FAIL();
  } catch (const Unstable& error) {
    const double dt_s = time_step_s(scene);
    EXPECT_DOUBLE_EQ(error.sound_until_s(), 150 * dt_s);
    const auto& gather = error.gather();
    ASSERT_EQ(gather.traces.size(), whole.traces.size());
    EXPECT_EQ(gather.axis, whole.axis);
    for (std::size_t n = 0; n < whole.traces.size(); ++n) {
      const auto &samples = gather.traces[n].samples, &all = whole.traces[n].samples;
      ASSERT_EQ(samples.size(), all.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        const double steps = double(k) * whole.axis.interval_s / dt_s;
        // A sample is made of the four steps before and behind it.
        EXPECT_EQ(samples[k], steps < 145.9 ? all[k] : steps > 150 ? 0.0 : samples[k]) << n << ' ' << k;
      }
    }
  }
}

TEST(Instability, InTheLastStepsIsSeenToo) {
  auto scene = sea();
  // 331 steps: the last regular check is that after 300.
  scene.recording.duration_s = 327 * time_step_s(scene);
  scene.recording.interval_s = time_step_s(scene);
  const auto steps = Recorder<2, float>::steps_needed(scene.recording, time_step_s(scene));
  ASSERT_GT(steps, 310);
  ASSERT_LT(steps, 350);
  Spoiler spoiler(scene, 302, {200, 100}, no_number);
  EXPECT_THROW(shoot<2>(scene, 1, {}, {}, &spoiler), Unstable);
}

/// A wave may move cells along one axis alone: the check sees any one component of any cell, and names its
/// axis.
template <int D>
void expect_each_component_seen(const Medium<D>& medium) {
  EdgeLaws<D> edges;
  for (auto& of_axis : edges.law) of_axis.fill(EdgeLaw::rigid);
  const auto domain = make_domain(medium, edges, 0);
  auto state = make_filled_state<D, float>(domain, medium, 1e-3);
  constexpr double limit = 5;
  const StabilityCheck<D, float> check(state, domain, 1, limit);
  Index<D> last = medium.grid().shape;
  for (auto& n : last) --n;
  for (const auto& cell : {Index<D>{}, last})
    for (int axis = 0; axis < D; ++axis)
      for (const double value : {no_number, HUGE_VAL, -1.001 * limit, 0.999 * limit}) {
        float& velocity = state.field_row(cell, FieldRows<D>::velocity(axis))[cell[0]];
        velocity = float(value);
        try {
          check.check({0, 1e-3});
          EXPECT_LT(std::abs(value), limit) << axis;
        } catch (const DivergedFields<D>& seen) {
          EXPECT_FALSE(std::abs(value) < limit) << axis;
          EXPECT_EQ(seen.first().at, cell) << value;
          EXPECT_EQ(seen.first().axis, axis) << value;
        }
        velocity = 0;
      }
}

TEST(Instability, OfOneComponentAloneIsSeen) {
  expect_each_component_seen<2>(uniform_medium(20, 10, h, rock));
  expect_each_component_seen<3>(uniform_cube({20, 6, 5}, h, rock));
}

/// The largest velocity of any cell, of a shot in snapshots of every fifth step: waves change little in the
/// meantime.
double fastest_in(Scene<2> scene) {
  double fastest = 0;
  scene.snapshot_every_s = 5 * time_step_s(scene);
  shoot<2>(scene, 1, {}, [&](double, const FieldReader<2>& field) {
    for (const auto component : {Component::vx, Component::vz})
      for (const float value : field(component)) fastest = std::max(fastest, double(std::abs(value)));
  });
  return fastest;
}

TEST(Instability, TheLargestVelocityIsAboveThoseOfWavesAndNotFarAbove) {
  // All energy in one cell instead of all round the source, none of it lost in the meantime, and 100 to
  // spare.
  for (const auto& [mechanism, wavelet] :
       {std::pair("explosion", "ricker:40"), std::pair("force:1,2", "sine:30:4"),
        std::pair("moment:1,-1,0.5", "gauss:40")}) {
    auto scene = sea();
    scene.survey.sources[0].mechanism = parse_mechanism<2>(mechanism);
    scene.survey.sources[0].wavelet = parse_wavelet(wavelet);
    scene.recording.duration_s = 0.1;
    const double fastest = fastest_in(scene), largest = largest_velocity(scene, 1);
    EXPECT_GT(largest, 100 * fastest) << mechanism << wavelet;
    EXPECT_LT(largest, 1e6 * fastest) << mechanism << wavelet;
  }
  auto plane = sea();
  plane.model.medium = uniform_medium(nx, nz, h, rock);
  plane.model.fracture_sets.clear();
  plane.model.fracture = {};
  plane.survey.sources[0] = {{0, 0}, parse_mechanism<2>("plane:0"), parse_wavelet("ricker:20"), 3};
  plane.edges[1][0] = EdgeLaw::absorbing;
  plane.recording.duration_s = 0.2, plane.numerics.zone_cells = 12;
  EXPECT_GT(largest_velocity(plane, 1), 100 * fastest_in(plane));
  EXPECT_LT(largest_velocity(plane, 1), 1e6 * fastest_in(plane));
}

TEST(Instability, TheLargestVelocityFollowsFromTheEnergyOfTheSource) {
  // (F I)^2/(2 rho V), all of it in one cell: v = F I/(rho V), times 100. A half sine of 10 Hz has I = 1/(10
  // pi).
  auto scene = sea();
  scene.model.medium = uniform_medium(nx, nz, h, rock);
  scene.survey.sources[0].mechanism = parse_mechanism<2>("force:3,4");
  scene.survey.sources[0].wavelet = parse_wavelet("sine:10:0.5");
  scene.survey.sources[0].amplitude = 7;
  const double integral_s = 1 / (10 * std::numbers::pi);
  EXPECT_NEAR(largest_velocity(scene, 1) / (100 * 35 * integral_s / (rock.rho * h * h)), 1, 1e-3);
  // Stress released by cracks adds its own: N cells of s^2 V/(2 rho vs^2), s^2 of all components.
  scene.survey.sources[0].amplitude = 0;
  scene.model.prestress_pa.assign(3, Field<2>(scene.model.grid(), 1e5f));
  const double strain_energies = 40 * 20 * 3e10 / (rock.rho * rock.vs * rock.vs);
  EXPECT_NEAR(largest_velocity(scene, 1) / (100 * std::sqrt(2 * strain_energies / rock.rho)), 1, 1e-6);
}

TEST(Instability, NothingThatStandsStillIsTakenForIt) {
  auto scene = sea();
  scene.survey.sources[0].amplitude = 0;
  EXPECT_NO_THROW(shoot<2>(scene, 1));
}

}  // namespace
}  // namespace slipwave::solver::solver_instability_test
