// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "acquisition/source_kind.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "gather/component.hpp"
#include "shooting/scene_options.hpp"

namespace slipwave {

/// What is simulated and recorded, and the boundaries.
inline void declare_scene(cli::Options& options, SceneOptions& s) {
  const std::vector<std::string> edges = {"free", "absorbing", "rigid", "mirror"};
  options.positional(s.model, "MODEL");
  options.add(
      "source", s.survey.sources, "X,Z",
      "position of the source, m; X0:X1:DX,Z or repeated: several shots; Z may be surface+D or floor-D; "
      "@FILE: a table; in 3-D X,Y,Z");
  options.add("kind", s.kind, "KIND", source_kind_help());
  options.add("wavelet", s.wavelet, "W", "ricker:F, sine:F[:CYCLES], gauss:F, file:PATH[:TRACE]; Hz");
  options.add("amplitude", s.amplitude, "A",
              "peak of the moment rate, force or velocity: " + amplitude_help());
  options.add("receivers", s.survey.receivers, "X0:X1:DX,Z",
              "line of receivers, or one at X,Z, m; repeatable; +X0:+X1:DX moves with the source; Z may be "
              "surface+D or floor-D; @FILE: a table; in 3-D also an area, X0:X1:DX,Y0:Y1:DY,Z");
  options.add("geometry", s.survey.geometry, "FILE",
              "the survey of a SEG-Y, SU or CSV file, or of SPS files");
  options.add("origin", s.survey.origin, "X,Y", "with --geometry: the model's origin on its map");
  options.add("azimuth", s.survey.azimuth_deg, "DEG",
              "with --geometry: x axis on its map, clockwise from north [90]");
  options.add("source-depth", s.survey.source_depth, "Z",
              "with --geometry: depth of sources instead of the file's");
  options.add("receiver-depth", s.survey.receiver_depth, "Z", "the same for all receivers");
  options.add("blend", s.survey.blend, "FILE", "table of shots that are fired into one record");
  options.add("shots", s.survey.shots, "LIST", "only these shots of the survey, by number: 3,10:20");
  options.add("time", s.duration_s, "T", "length of the traces, s");
  options.add("dt", s.interval_s, "DT", "sampling interval of the traces, s");
  options.add("record", s.record, "LIST",
              "components: " + joined(component_names(2)) +
                  " (das:ANGLE:GAUGE, das:path:GAUGE); in 3-D also those with y");
  options.add_choice(
      "top", s.top, edges,
      "boundary at z = 0: free (no traction), absorbing, rigid (no motion) or mirror (a plane of symmetry: "
      "no motion across it, no shear traction)");
  options.add_choice("sides", s.sides, edges,
                     "the same for the left and right boundaries, in 3-D for all four");
  options.add_choice("bottom", s.bottom, edges, "the same for the boundary at the bottom");
  options.add_choice("ground", s.ground, {"free", "absorbing"},
                     "the same for the ground below void, where rows of cells begin at it");
  options.add("edge-width", s.edge_width, "CELLS",
              "width of the absorbing zones outside the model; 0: 20, for plane waves 2/3 wavelength");
  options.add("without", s.without, "LIST",
              "effects to switch off: slip, friction, viscosity, cohesion, opening, prestress, attenuation, "
              "anisotropy, compliance");
  options.add("q-frequency", s.q_frequency_hz, "F",
              "with qp, qs: frequency of the model's speeds, Hz [that of the wavelet]");
  options.add("q-band", s.q_band, "F1,F2",
              "band of constant qp and qs, Hz [1/5 to 2.5 times that of the wavelet]");
  options.add("q-mechanisms", s.q_mechanisms, "N", "relaxation mechanisms, 2 to 5");
  options.add("allow-slow", s.limits.allow_slow, "allow speeds and densities that no rock or fluid has");
  options.add("allow-auxetic", s.limits.allow_auxetic, "allow vs above vp/sqrt(2)");
  options.add_choice("precision", s.precision, {"float", "double"}, "floating-point precision");
  options.headings({{"source", "Source"},
                    {"receivers", "Receivers and recording"},
                    {"top", "Model and its boundaries"},
                    {"precision", "Numerics"}});
}

/// Numbers of a list as texts.
template <std::size_t Count>
std::vector<std::string> texts_of(const int (&numbers)[Count]) {
  std::vector<std::string> texts;
  for (const int number : numbers) texts.push_back(std::to_string(number));
  return texts;
}

/// Order, time step, slip correction.
inline void declare_numerics(cli::Options& options, SceneOptions& s) {
  options.add_choice("order", s.order, texts_of(orders), "order of the scheme in space");
  options.add_choice("time-order", s.time_order, texts_of(time_orders),
                     "order in time; 4: five times the work per step, --cfl up to 2");
  options.add("monotone", s.monotone, "no overshoots: limit waves by the criterion of monotonicity");
  options.add_choice("correction", s.correction, {"first", "second", "exponential", "centred"},
                     "time integration of slip: of first or second order, exact per step, or of second order "
                     "for the waves, too");
  options.add("cfl", s.cfl, "C", "Courant number: time step over h/vp_max");
  options.add("time-step", s.time_step_s, "S", "time step, s, instead of --cfl");
  options.excludes("cfl", {"time-step"});
  // For who checks the program: the reference executor, slow and on one process.
  options.add_choice("executor", s.executor, {"tiled", "plain"}, cli::hidden);
}

}  // namespace slipwave
