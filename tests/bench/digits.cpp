// SPDX-License-Identifier: BSD-3-Clause
// slipwave_digits FOLDER [SCENE]: error against processor seconds of one thread, of six scenes with exact
// traces, as tables of sw-accuracy (FOLDER/SCENE.nc), and what SPECFEM2D took for them (SCENE-SPECFEM2D.nc).
// tests/bench/digits draws them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "io/output_file.hpp"
#include "parallel/threads.hpp"
#include "samples.hpp"
#include "solver/simulation.hpp"
#include "stack_scene.hpp"

namespace slipwave::solver {
namespace {

/// Orders in space and time, the Courant number, and cell sizes, m.
struct Setting {
  int order, time_order;
  double courant;
  std::vector<double> spacings_m;
};
struct SecondsFor {
  double seconds, percent;
};

/// What a scene is computed with, and what SPECFEM2D 8.1 (degree 7, one thread) took for it.
struct Compared {
  StackScene stack;
  std::vector<Setting> settings;
  std::vector<SecondsFor> specfem;
  double deeper_from_m = 0;  // from there on cells four times as large
};

std::vector<LayerStack::Receiver> line_at(double b, double first, double last, double step) {
  std::vector<LayerStack::Receiver> line;
  for (double a = first; a <= last; a += step) line.push_back({a, b});
  return line;
}

StackScene floor_at(double dip_deg) {
  StackScene stack{"floor", {{1500, 0, 1000}, {3000, 1700, 2200}}, {0}};
  stack.dip_deg = dip_deg, stack.source_b = -100;
  stack.receivers = line_at(-40, 100, 700, 100);
  for (const auto& at : line_at(40, 100, 700, 100)) stack.receivers.push_back(at);
  stack.duration_s = 0.7, stack.margin_m = 300;
  // Rows follow what is nowhere a fifth as thick as elsewhere.
  stack.deeper_m = 10 * dip_deg;
  return stack;
}

std::vector<Compared> scenes() {
  StackScene space{"space", {{4500, 2250, 2200}}};
  space.margin_m = 450;  // waves that graze the edges come back
  space.peak_hz = 30, space.duration_s = 0.76, space.force = {{0, 1}},
  space.receivers = {{750, 0}, {1500, 0}};
  StackScene ground{"ground", {{3000, 1700, 2200}}, {0}, true, 15};
  ground.source_b = 20, ground.force = {{0, 1}}, ground.receivers = line_at(10, 100, 600, 100);
  ground.margin_m = 300;
  StackScene layers{
      "layers", {{1800, 900, 1900}, {2600, 1400, 2100}, {3500, 2000, 2300}}, {0, 137.3, 229.2}, true};
  layers.source_b = 20, layers.force = {{0, 1}}, layers.receivers = line_at(10, 100, 600, 100);
  layers.duration_s = 0.8;
  StackScene soft{"soft-ground", {{900, 300, 1800}, {3500, 2000, 2300}}, {0, 30}, true};
  soft.source_b = 8.1, soft.force = {{0, 1}}, soft.receivers = line_at(0, 20, 300, 40);
  soft.duration_s = 0.8, soft.margin_m = 150;
  const std::vector<Setting> of_second_order = {{5, 2, 0.9, {8, 6, 4, 3}}, {7, 2, 0.9, {8, 6, 4, 3, 2, 1.5}}};
  return {{space,
           {{5, 2, 0.9, {6, 4, 3}}, {7, 2, 0.4, {6, 5, 4, 3}}, {11, 4, 1.9, {9, 8, 6.5, 5.25}}},
           {{35, 1}, {68, 0.5}}},
          {floor_at(15), of_second_order, {{1.15, 1}, {3.2, 0.17}, {8.7, 0.054}}},
          {floor_at(30), of_second_order, {{6.5, 1}, {12.8, 0.12}}},
          {ground, of_second_order, {{2.3, 1}, {19.7, 0.114}}},
          {layers, of_second_order, {{6.6, 1}, {13.8, 0.125}}},
          {soft,
           {{5, 2, 0.9, {1, 0.75, 0.6, 0.5}}, {7, 2, 0.9, {1, 0.75, 0.6, 0.5, 0.375}}},
           {{2.2, 4.2}, {8.5, 1}, {10.8, 0.59}, {18, 0.29}, {24.6, 0.153}},
           30}};
}

AccuracyRow row_of(const Compared& compared, const Setting& setting, double spacing_m) {
  auto stack = compared.stack;
  stack.order = setting.order, stack.time_order = setting.time_order;
  stack.cfl = setting.courant, stack.spacing_m = spacing_m;
  auto scene = stack.scene();
  if (const double from_m = compared.deeper_from_m; from_m > 0)
    scene.numerics.bands = {{0, spacing_m}, {from_m, 4 * spacing_m}};
  const auto exact = stack.exact().front();
  const auto began = std::clock();
  const auto found = shoot(scene, 1);
  AccuracyRow row;
  row.seconds = double(std::clock() - began) / CLOCKS_PER_SEC;
  row.order = setting.order, row.time_order = setting.time_order, row.courant = setting.courant;
  row.spacing_m = spacing_m, row.error = relative_error(samples_of(found), samples_of(exact));
  std::printf("%-12s order %2d, %d in time, Courant %.1f, %6.3f m: %7.3f %% %7.2f s\n", stack.name.c_str(),
              row.order, row.time_order, row.courant, row.spacing_m, 100 * row.error, row.seconds);
  std::fflush(stdout);
  return row;
}

void write(const std::string& path, const AccuracyTable& table) {
  OutputFile out(path, OutputFile::Content::binary);
  write_accuracy_table(out, table, "bench");
}

void measure(const std::string& folder, const Compared& compared) {
  auto name = compared.stack.name;
  if (compared.stack.dip_deg > 0) name += "-" + std::to_string(int(compared.stack.dip_deg));
  AccuracyTable own, other;
  own.title = "slipwave", other.title = "SPECFEM2D";
  own.reference = other.reference = "exact traces";
  for (const auto& setting : compared.settings)
    for (const double spacing_m : setting.spacings_m)
      own.rows.push_back(row_of(compared, setting, spacing_m));
  write(folder + "/" + name + ".nc", own);
  for (const auto& [seconds, percent] : compared.specfem) {
    AccuracyRow row;
    row.order = 7, row.seconds = seconds, row.error = percent / 100;
    row.spacing_m = row.courant = std::nan("");
    other.rows.push_back(row);
  }
  write(folder + "/" + name + "-SPECFEM2D.nc", other);
}

}  // namespace
}  // namespace slipwave::solver

int main(int count, char** words) {
  using namespace slipwave;
  if (count < 2) {
    std::fputs("usage: slipwave_digits FOLDER [SCENE]\n", stderr);
    return 2;
  }
  try {
    const ThreadLimit one(1);
    for (const auto& compared : solver::scenes())
      if (count < 3 || compared.stack.name == words[2]) solver::measure(words[1], compared);
  } catch (const Error& error) {
    std::fprintf(stderr, "slipwave_digits: %s\n", error.what());
    return 1;
  }
}
