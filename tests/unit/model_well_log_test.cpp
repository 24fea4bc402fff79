// SPDX-License-Identifier: BSD-3-Clause
#include "geology/well_log.hpp"

#include <cmath>

#include "model_cases.hpp"

namespace slipwave::model_well_log_test {
namespace {

const std::string las_head =
    "~Version\n VERS. 2.0 : CWLS\n WRAP.  NO : one line a depth\n~Well\n STRT.FT 100 : start\n NULL. -999.25 "
    ": no value\n"
    "~Curve\n DEPT.FT : depth\n DT  .US/FT 60 520 32 00 : sonic\n DTSM.US/F : shear\n RHOB.G/CC : density\n "
    "GR.GAPI :\n";

WellLog log_of(const std::string& text, const LogChoice& choice = {}) {
  const TextFile file(text);
  return read_well_log(file.path(), choice);
}
std::string said(const std::string& text, const LogChoice& choice = {}) {
  const TextFile file(text);
  auto sentence = sentence_of([&] { read_well_log(file.path(), choice); });
  if (sentence.starts_with(file.path())) sentence.erase(0, file.path().size() + 2);
  return sentence;
}

/// The head of a file whose rows take several lines.
std::string in_several_lines(std::string head) {
  return head.replace(head.find("WRAP.  NO"), 9, "WRAP. YES");
}

/// Thin beds of two rocks, one after the other, 0.1 m each.
WellLog thin_beds() {
  WellLog log;
  log.name = "well";
  for (int n = 0; n < 400; ++n) {
    log.depths_m.push_back(100.05 + 0.1 * n);
    log.materials.push_back(n % 2 ? Material{3000, 1500, 2400} : Material{2000, 800, 2000});
  }
  return log;
}

}  // namespace

TEST(WellLog, OfLasComesInSI) {
  const auto log =
      log_of(las_head +
             "~A DEPTH DT\n 100.0 -999.25 200 2.2 60\n 101.0 100 200 2.2 -999.25\n 102.0 80 160 2.3 61\n");
  ASSERT_EQ(log.depths_m.size(), 2U);
  EXPECT_EQ(log.left_out, 1);
  EXPECT_DOUBLE_EQ(log.depths_m[0], 101 * 0.3048);
  EXPECT_DOUBLE_EQ(log.materials[0].vp, 3048);
  EXPECT_DOUBLE_EQ(log.materials[0].vs, 1524);
  EXPECT_DOUBLE_EQ(log.materials[1].rho, 2300);
  EXPECT_EQ(log.curves,
            "depth from dept (FT), vp from dt (US/FT), vs from dtsm (US/F), rho from rhob (G/CC)");
  // Rows over several lines hold the same, and so does a file that was logged upwards.
  const auto wrapped =
      log_of(in_several_lines(las_head) + "~A\n102.0\n 80 160\n 2.3 61\n101.0 100\n200 2.2 -999.25\n");
  EXPECT_EQ(wrapped.depths_m, log.depths_m);
  EXPECT_EQ(wrapped.materials[0], log.materials[0]);
}

TEST(WellLog, OfColumnsIsKnownByTheirNames) {
  for (const char* text :
       {"DEPTH.M VP.M/S VS.M/S RHO.G/CC\n10 2000 1000 2.1\n11 2100 1000 2.1\n",
        "density [kg/m3];vs [km/s];vp [km/s];depth [km]\n2100;1;2;0.01\n2100;1;2.1;0.011\n",
        "# a log\nDepth (m), Vp, Vs, RHOB (g/cm3), GR (gapi)\n11, 2100, 1000, 2.1, 5\n10, 2000, 1000, 2.1, "
        "5\n"}) {
    const auto log = log_of(text);
    ASSERT_EQ(log.depths_m.size(), 2U) << text;
    EXPECT_NEAR(log.depths_m[1], 11, 1e-12);
    EXPECT_NEAR(log.materials[1].vp, 2100, 1e-9);
    EXPECT_NEAR(log.materials[0].vs, 1000, 1e-9);
    EXPECT_NEAR(log.materials[0].rho, 2100, 1e-9);
  }
  LogChoice related;
  related.vs_from_vp = related.rho_from_vp = true;
  const auto log = log_of("depth vp\n0 2520\n1 2520\n", related);
  EXPECT_NEAR(log.materials[0].vs, 1000, 1e-3);
  EXPECT_NEAR(log.materials[0].rho, 310 * std::pow(2520, 0.25), 1e-3);
}

TEST(WellLog, SaysWhatIsMissingOrAmbiguous) {
  EXPECT_EQ(
      said("depth vp rho\n0 2000 2000\n1 2000 2000\n"),
      "found no curve of vs among depth, vp, rho, expected one called vs, svel, vsvel, dts, dtsm or dtcs, or "
      "--vs-from-vp castagna");
  EXPECT_EQ(said("depth dt vs rho\n0 100 1000 2000\n1 100 1000 2000\n"),
            "column dt: found no unit, expected one, as us/ft or us/m");
  EXPECT_EQ(said("depth vp.ohm vs rho\n0 100 1000 2000\n1 100 1000 2000\n"),
            "column vp: found the unit 'ohm', expected one of speed, as m s-1, km s-1 or ft s-1");
  EXPECT_EQ(said("0 2000 1000 2000\n1 2000 1000 2000\n"),
            "found no header line, expected names above the columns, as DEPTH.M VP.M/S VS.M/S RHO.G/CC");
  EXPECT_EQ(said("~Version\n VERS. 3.0 : CWLS\n"), "line 2: found LAS version '3.0', expected 1.2 or 2.0");
  EXPECT_EQ(said(in_several_lines(las_head) + "~A\n100 100 200 2.2\n"),
            "ends within a row of 5 values, begun on line 14");
  // Rows that are shifted against each other, as by a comma for a point.
  EXPECT_EQ(said(las_head + "~A\n100 100 200 2.2\n"),
            "line 14: found 4 values, expected 5, as many as curves (WRAP is NO)");
  EXPECT_EQ(said(in_several_lines(las_head) + "~A\n100,0 100,0 200 2.2 60\n"),
            "line 14: found more values in a row, expected 5, as many as curves");
  auto metres = las_head;
  metres.replace(metres.find("STRT.FT"), 7, "STRT.M");
  EXPECT_EQ(said(metres + "~A\n100 100 200 2.2 60\n101 100 200 2.2 60\n"),
            "found 100 M in ~Well and 100 FT in the curve dept, expected one unit of depths");
  auto twice = las_head;
  twice.replace(twice.find(" GR.GAPI"), 8, " DT.US/FT");
  EXPECT_EQ(said(twice + "~A\n100 100 200 2.2 60\n101 100 200 2.2 60\n"),
            "found curve dt twice, expected it once");
  EXPECT_EQ(
      said("depth vp vs rho\n-20 2000 1000 2000\n-10 2000 1000 2000\n"),
      "found depths from -20 to -10 m, expected them to count downwards from the surface; heights change "
      "sign");
  EXPECT_EQ(
      said("depth vp vs rho\n10 2000 1000 2000\n20 2000 9999 2000\n"),
      "line 3: found vs 9999 with vp 2000 m/s, expected vs at most vp/sqrt(2) or a missing value, -999.25 "
      "(--allow-auxetic takes it)");
  EXPECT_EQ(said(las_head + "~A\n100 100 200 2.2 x\n"), "line 14: found 'x', expected a number");
  EXPECT_EQ(
      said("depth dt.us/ft vs rho\n0 100 1000 2000\n1 -9999 1000 2000\n"),
      "line 3: found vp -30.483, expected it above 0; missing values are -999.25 (NULL), NaN or nothing");
  EXPECT_EQ(said("depth vp vs rho\n0 2000 1000 2000\n0 2000 1000 2000\n"),
            "line 3: found depth 0 m twice, expected each once");
}

TEST(WellLog, InBlocksIsTheMeanOfItsBeds) {
  const auto layer = layer_of_log(thin_beds(), 10, false, {});
  ASSERT_EQ(layer.profile.size(), 4U);
  EXPECT_EQ(layer.top.depth_m(), 100);
  // Of half of each: harmonic moduli, the mean density.
  const double m1 = 2000. * 2000 * 2000, m2 = 2400. * 3000 * 3000, g1 = 2000. * 800 * 800,
               g2 = 2400. * 1500 * 1500;
  const double rho = 2200, m = 2 / (1 / m1 + 1 / m2), g = 2 / (1 / g1 + 1 / g2);
  EXPECT_NEAR(layer.at_depth(5).vp, std::sqrt(m / rho), 1e-6);
  EXPECT_NEAR(layer.at_depth(35).vs, std::sqrt(g / rho), 1e-6);
  EXPECT_EQ(layer.at_depth(5).epsilon, 0);
  EXPECT_EQ(layer.at_depth(1000), layer.profile.back().material);
  LogChoice thick;
  thick.block_m = 20;
  EXPECT_EQ(layer_of_log(thin_beds(), 10, false, thick).profile.size(), 2U);
}

TEST(WellLog, OfBackusHasTheAnisotropyOfItsBeds) {
  LogChoice backus;
  backus.layered = true;
  const auto of = layer_of_log(thin_beds(), 10, true, backus).at_depth(15);
  // Backus (1962), from the constants of Lame of both rocks.
  const double mu[] = {2000. * 800 * 800, 2400. * 1500 * 1500};
  const double lambda[] = {2000. * 2000 * 2000 - 2 * mu[0], 2400. * 3000 * 3000 - 2 * mu[1]};
  double plate = 0, ratio = 0, inverse = 0, c66 = 0, inverse_mu = 0;
  for (const int n : {0, 1}) {
    const double whole = lambda[n] + 2 * mu[n];
    plate += 0.5 * 4 * mu[n] * (lambda[n] + mu[n]) / whole;
    ratio += 0.5 * lambda[n] / whole;
    inverse += 0.5 / whole;
    c66 += 0.5 * mu[n];
    inverse_mu += 0.5 / mu[n];
  }
  const double c33 = 1 / inverse, c11 = plate + ratio * ratio * c33, c13 = ratio * c33, c44 = 1 / inverse_mu;
  EXPECT_NEAR(of.vp, std::sqrt(c33 / 2200), 1e-6);
  EXPECT_NEAR(of.vs, std::sqrt(c44 / 2200), 1e-6);
  EXPECT_NEAR(of.epsilon, (c11 - c33) / (2 * c33), 1e-9);
  EXPECT_NEAR(of.delta, (std::pow(c13 + c44, 2) - std::pow(c33 - c44, 2)) / (2 * c33 * (c33 - c44)), 1e-9);
  EXPECT_NEAR(of.gamma, (c66 - c44) / (2 * c44), 1e-9);
  EXPECT_GT(of.epsilon, 0.05);
}

TEST(WellLog, LiesInTheModelAtItsDepth) {
  auto log = thin_beds();
  for (auto& depth : log.depths_m) depth -= 80;
  const std::vector<Layer> layers = {{0, 1500, 0, 1000}, layer_of_log(log, 10, false, {})};
  const auto medium = layered_medium(grid_of(3, 8, 10), layers);
  EXPECT_EQ(medium.vp({1, 1}), 1500);
  EXPECT_FLOAT_EQ(medium.vp({1, 2}), float(layers[1].at_depth(5).vp));
  EXPECT_FLOAT_EQ(medium.vp({2, 7}), float(layers[1].at_depth(35).vp));
}

TEST(WellLog, WithGapsOrWaterIsRefusedWithItsDepth) {
  auto gap = thin_beds();
  gap.depths_m.erase(gap.depths_m.begin() + 100, gap.depths_m.begin() + 350);
  gap.materials.erase(gap.materials.begin() + 100, gap.materials.begin() + 350);
  EXPECT_EQ(sentence_of([&] { layer_of_log(gap, 5, false, {}); }),
            "well: found no values of all curves from 115 to 120 m, expected some in each block of 5 m: fill "
            "the gap "
            "or cut the log there");
  auto wet = thin_beds();
  wet.materials[10] = {1500, 0, 1000};
  EXPECT_NE(sentence_of([&] { layer_of_log(wet, 5, false, {}); }).find("found fluid beside rock (vs 0) at "),
            std::string::npos);
  LogChoice thin;
  thin.block_m = 2;
  EXPECT_EQ(sentence_of([&] { layer_of_log(thin_beds(), 5, false, thin); }),
            "found blocks of 2 m, expected at least a cell, 5 m");
}

}  // namespace slipwave::model_well_log_test
