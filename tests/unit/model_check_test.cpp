// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "model_cases.hpp"

namespace slipwave::model_check_test {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

std::string refusal(const std::function<void(Model<2>&)>& spoil, const MediumLimits& limits = {}) {
  auto model = water_over_rock(grid_of(4, 5, 10), 2);
  spoil(model);
  return sentence_of([&] { check(model, limits); });
}

// Cell (1, 3): rock at x = 15, z = 35.
constexpr std::size_t rock = 13;

void mark(Model<2>& model, std::size_t cell, std::uint8_t code) {
  model.fracture = Field<2, std::uint8_t>(model.grid());
  model.fracture[cell] = code;
  model.fracture_sets = {{"set", {{{0.6, 0.8}, 0.1, 1, 0}}}};
}

}  // namespace

TEST(ModelCheck, LetsASoundModelThrough) {
  EXPECT_EQ(refusal([](Model<2>&) {}), "no error");
  EXPECT_EQ(refusal([](Model<2>& model) { mark(model, rock, 1); }), "no error");
}

TEST(ModelCheck, NamesTheFirstBadCellWithItsPlace) {
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.vs[rock] = not_a_number; }),
            "vs at x=15 z=35 is NaN, expected a finite number not below zero");
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.vp[rock] = model.medium.vp[rock + 1] = -1; }),
            "vp at x=15 z=35 is -1, expected a finite number not below zero");
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.rho[rock] = std::numeric_limits<float>::infinity(); }),
            "rho at x=15 z=35 is inf, expected a finite number not below zero");
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.vp[rock] = model.medium.vs[rock] = 0; }),
            "vp at x=15 z=35 is 0, expected a speed above zero outside void");
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.rho[rock] = 0; }),
            "rho at x=15 z=35 is 0 with vp 3000 and vs 1500, expected both 0 in void or a density");
}

TEST(ModelCheck, TakesVoidWithoutSpeeds) {
  EXPECT_EQ(refusal([](Model<2>& model) {
              model.medium.vp[rock] = model.medium.vs[rock] = model.medium.rho[rock] = 0;
            }),
            "no error");
}

TEST(ModelCheck, RefusesNegativeLambdaUnlessAllowed) {
  // lambda = rho (vp^2 - 2 vs^2) vanishes at vs = vp/sqrt(2), also when that is rounded up to a float.
  EXPECT_EQ(refusal([](Model<2>& model) {
              model.medium.vs[rock] = std::nextafter(float(3000 / std::sqrt(2.0)), 1e9f);
            }),
            "no error");
  const auto spoil = [](Model<2>& model) { model.medium.vs[rock] = 2200; };
  EXPECT_EQ(
      refusal(spoil),
      "vs at x=15 z=35 is 2200, expected at most vp/sqrt(2) = 2121.3203 (lambda < 0 needs --allow-auxetic)");
  EXPECT_EQ(refusal(spoil, {.allow_auxetic = true}), "no error");
}

TEST(ModelCheck, RefusesOtherUnitsWithTheirRemedyUnlessAllowed) {
  const auto refused = [](const char* unit, const std::function<void(Model<2>&)>& spoil) {
    const auto sentence = refusal(spoil);
    EXPECT_NE(sentence.find(std::string("build the model with --units ") + unit + ", if it is meant so"),
              std::string::npos)
        << sentence;
    EXPECT_EQ(refusal(spoil, {.allow_slow = true}), "no error");
  };
  const auto material = [](float vp, float vs, float rho) {
    return [=](Model<2>& model) {
      model.medium.vp[rock] = vp;
      model.medium.vs[rock] = vs;
      model.medium.rho[rock] = rho;
    };
  };
  refused("km/s", material(3, 1.5F, 2200));
  refused("km/s", material(3000, 1.5F, 2200));
  refused("km/s,g/cm3", material(3, 1.5F, 2.2F));
  refused("g/cm3", material(3000, 1500, 2.2F));
  refused("g/cm3", material(1500, 0, 1));
  refused("ft/s", material(18000, 9000, 2200));
}

TEST(ModelCheck, TakesMudSnowAndAir) {
  const auto taken = [](float vp, float vs, float rho) {
    EXPECT_EQ(refusal([&](Model<2>& model) {
                model.medium.vp[rock] = vp;
                model.medium.vs[rock] = vs;
                model.medium.rho[rock] = rho;
              }),
              "no error");
  };
  taken(1500, 20, 1500);
  taken(150, 90, 50);
  taken(340, 0, 1.2F);
}

TEST(ModelCheck, RefusesAVanishingBulkModulusAlways) {
  // K = rho (vp^2 - 4/3 vs^2).
  EXPECT_EQ(refusal([](Model<2>& model) { model.medium.vs[rock] = 2599; }, {.allow_auxetic = true}),
            "vs at x=15 z=35 is 2599, expected below vp sqrt(3)/2 = 2598.0762 (positive bulk modulus)");
}

TEST(ModelCheck, RefusesFracturesWithoutSetOrRock) {
  EXPECT_EQ(refusal([](Model<2>& model) { mark(model, rock, 2); }),
            "fracture at x=15 z=35 is 2, expected at most 1, the number of sets");
  EXPECT_EQ(refusal([](Model<2>& model) { mark(model, 1, 1); }),
            "fracture at x=15 z=5 lies in fluid; only solid cells can be fractured");
  EXPECT_EQ(refusal([](Model<2>& model) {
              mark(model, rock, 1);
              model.medium.vp[rock] = model.medium.vs[rock] = model.medium.rho[rock] = 0;
            }),
            "fracture at x=15 z=35 lies in void; only solid cells can be fractured");
}

TEST(ModelCheck, RefusesUnphysicalSlipConstants) {
  const auto with = [](const std::function<void(SlipSystem<2>&)>& spoil) {
    return refusal([&](Model<2>& model) {
      mark(model, rock, 1);
      spoil(model.fracture_sets[0].systems[0]);
    });
  };
  EXPECT_EQ(with([](auto& system) {
              system.normal = {1, 1};
            }),
            "fracture set 1 'set': found a normal of length 1.4142135623730951, expected a unit vector");
  EXPECT_EQ(with([](auto& system) { system.friction = -0.1; }),
            "fracture set 1 'set': friction is -0.1, expected a finite number not below zero");
  EXPECT_EQ(with([](auto& system) { system.viscosity_s = std::nan(""); }),
            "fracture set 1 'set': viscosity is nan, expected a finite number not below zero");
  const auto weak = [&](double friction, double dynamic, double distance_m) {
    return with([&](auto& system) {
      system.law = FrictionLaw::slip_weakening;
      system.friction = friction, system.dynamic_friction = dynamic, system.slip_distance_m = distance_m;
    });
  };
  EXPECT_EQ(weak(0.5, 0.6, 1),
            "fracture set 1 'set': dynamic friction is 0.6, expected at most the static "
            "friction of 0.5");
  EXPECT_EQ(weak(0.5, -0.1, 1),
            "fracture set 1 'set': dynamic friction is -0.1, expected a finite number not below zero");
  EXPECT_EQ(weak(0.5, 0.1, 0), "fracture set 1 'set': slip distance is 0 m, expected it above zero");
  EXPECT_EQ(weak(0.5, 0.1, std::nan("")),
            "fracture set 1 'set': slip distance is nan m, expected it above zero");
  EXPECT_EQ(refusal([](Model<2>& model) {
              mark(model, rock, 1);
              model.fracture_sets[0].systems.clear();
            }),
            "fracture set 1 'set' has 0 slip systems, expected 1 to 2");
}

}  // namespace slipwave::model_check_test
