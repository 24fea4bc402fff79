// SPDX-License-Identifier: BSD-3-Clause
// What each effect costs: the same scene of 600 x 500 cells with and without it.
#include "bench.hpp"
#include "parallel/threads.hpp"
#include "run.hpp"
#include "solver/simulation.hpp"

namespace slipwave::bench {
namespace {

/// A whole shot, computed everywhere or only where something has come to and will be seen of.
void shot(benchmark::State& state, const Case& what) {
  const auto scene = make_scene(what);
  const ThreadLimit threads(what.threads);
  state.counters["seconds_per_shot"] =
      least_seconds(state, [&] { benchmark::DoNotOptimize(shoot<2>(scene, 1)); });
}

}  // namespace

void register_effects() {
  const auto add = [](const std::string& name, const auto& change) {
    Case what;
    what.variety = Variety::layered;
    change(what);
    register_run("effect:" + name, what);
  };
  add("none", [](Case&) {});
  add("none, every cell another material", [](Case& what) { what.variety = Variety::random; });
  add("all rows bent", [](Case& what) { what.curvilinear = true; });
  add("all rows bent, every cell another material", [](Case& what) {
    what.curvilinear = true;
    what.variety = Variety::random;
  });
  add("free surface", [](Case& what) { what.top = EdgeLaw::free; });
  add("PML on three sides", [](Case& what) { what.others = EdgeLaw::absorbing; });
  add("PML on four sides", [](Case& what) { what.top = what.others = EdgeLaw::absorbing; });
  add("zones of a plane wave", [](Case& what) {
    what.top = what.others = EdgeLaw::absorbing;
    what.plane_wave = true;
  });
  add("slip in 1 % of the cells", [](Case& what) { what.slipping = 0.01; });
  // What patches of a line cost beside their cells is much where they are short.
  for (const double share : {0., 0.01})
    add(std::string(share > 0 ? "slip in 1 %" : "none") + ", 3000 x 3000 cells", [share](Case& what) {
      what.nx = what.nz = 3000;
      what.slipping = share;
    });
  add("attenuation in all cells", [](Case& what) { what.attenuating = 40; });
  add("attenuation in all cells, every cell another material", [](Case& what) {
    what.variety = Variety::random;
    what.attenuating = 40;
  });
  add("slip in 10 % of the cells", [](Case& what) { what.slipping = 0.1; });
  add("slip in all cells", [](Case& what) { what.slipping = 1; });
  const auto add_slip = [&](const std::string& kind, const auto& change) {
    add("slip in all cells, " + kind, [&](Case& what) {
      what.slipping = 1;
      change(what);
    });
  };
  add_slip("first order", [](Case& what) { what.correction = SlipCorrection::first; });
  add_slip("exponential", [](Case& what) { what.correction = SlipCorrection::exponential; });
  add_slip("blocks", [](Case& what) { what.blocks = true; });
  add_slip("static stress", [](Case& what) { what.under_stress = true; });
  add_slip("parting planes", [](Case& what) { what.parting = true; });
  add("10 receivers", [](Case& what) {
    what.receivers = 10;
    what.duration_s = 10;
  });
  add("1000 receivers", [](Case& what) {
    what.receivers = 1000;
    what.duration_s = 10;
  });
  // Of all components, every step a sample, as line surveys record: against one receiver.
  for (const int receivers : {1, 1000})
    for (const bool pressure_alone : {true, false})
      add(std::to_string(receivers) + (receivers > 1 ? " receivers of " : " receiver of ") +
              (pressure_alone ? "p" : "vx, vz and p"),
          [=](Case& what) {
            what.receivers = receivers;
            what.recorded = {Component::p};
            if (!pressure_alone) what.recorded = {Component::vx, Component::vz, Component::p};
            what.duration_s = 10;
          });
  add("a snapshot every 20 steps",
      [](Case& what) { what.snapshot_every_s = 20 * time_step_s(make_scene(what)); });
  add("all fluid", [](Case& what) { what.fluid = true; });
  // 6000 x 6000 m in cells of 4 m.
  for (const bool fluid : {false, true})
    add(std::string(fluid ? "all fluid" : "none") + ", 1500 x 1500 cells", [=](Case& what) {
      what.nx = what.nz = 1500;
      what.fluid = fluid;
    });
  for (const double duration_s : {0.5, 1., 2.})
    for (const bool only_where_seen : {false, true}) {
      Case what;
      what.variety = Variety::layered;
      what.top = EdgeLaw::free;
      what.others = EdgeLaw::absorbing;
      what.nx = 1000;
      what.nz = 600;
      what.at_the_surface = true;
      what.receivers = 100;
      what.duration_s = duration_s;
      what.only_where_seen = only_where_seen;
      const std::string name = std::string("computed:") + (only_where_seen ? "where seen" : "everywhere") +
                               "/milliseconds:" + std::to_string(int(1000 * duration_s));
      benchmark::RegisterBenchmark(name.c_str(), [what](benchmark::State& state) { shot(state, what); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace slipwave::bench
