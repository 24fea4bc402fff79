// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "half_space.hpp"
#include "layer_stack.hpp"
#include "plane_interface.hpp"

// The exact traces of stacks against closed forms and the coefficients of one interface.
namespace slipwave::solver::layer_stack_test {
namespace {

constexpr Rock water{1500, 0, 1000}, rock{3000, 1600, 2200}, hard{4500, 2250, 2500};

TEST(LayerStack, OfAHalfSpaceMovesItsSurfaceAsGarvinSays) {
  const LayerStack half_space{{rock}, {0}, true, 100};
  const auto found = half_space.ricker(15, 0.001, 500, {{200, 0}, {-350, 0}});
  const double x[] = {200, -350};
  for (std::size_t n = 0; n < 2; ++n) {
    const auto exact = garvin(rock, x[n], 100, {15}, 0.001, 500);
    for (std::size_t row = 0; row < 2; ++row) EXPECT_LT(relative_error(found[n][row], exact[row]), 1e-4);
  }
}

TEST(LayerStack, OfTwoHalfSpacesScattersWithTheirCoefficients) {
  for (const auto& [over, under] : {std::pair{water, rock}, {rock, hard}, {hard, water}}) {
    const auto found = LayerStack{{over, under}, {0}, false, -120}.ricker(15, 0.001, 300, {{150, 90}});
    const auto exact = PlaneInterface{over, under, 120}.scattered_ricker(15, 0.001, 300, 150, 90);
    for (std::size_t row = 0; row < 2; ++row) EXPECT_LT(relative_error(found[0][row], exact[row]), 2e-6);
  }
}

TEST(LayerStack, IsTheSameWithMoreInterfacesThanThereAre) {
  const std::vector<LayerStack::Receiver> places = {{100, -150}, {100, 30}, {-180, 95}, {200, 160}};
  for (const bool explosion : {true, false}) {
    LayerStack one{{hard, rock}, {0}, false, -100, explosion, {0.6, 0.8}};
    LayerStack more{{hard, rock, rock, rock}, {0, 60, 130}, false, -100, explosion, {0.6, 0.8}};
    const auto a = one.ricker(15, 0.001, 300, places), b = more.ricker(15, 0.001, 300, places);
    for (std::size_t n = 0; n < places.size(); ++n)
      for (std::size_t row = 0; row < 2; ++row) EXPECT_LT(relative_error(b[n][row], a[n][row]), 1e-8);
  }
}

TEST(LayerStack, ObeysReciprocity) {
  LayerStack stack{{rock, water, hard}, {0, 80}, false, -110, false, {0, 1}};
  const auto down = stack.ricker(15, 0.001, 300, {{140, 150}});
  stack.source_m = 150;
  stack.force = {1, 0};
  const auto up = stack.ricker(15, 0.001, 300, {{-140, -110}});
  EXPECT_LT(relative_error(down[0][0], up[0][1]), 1e-6);
}

}  // namespace
}  // namespace slipwave::solver::layer_stack_test
