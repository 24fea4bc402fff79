#pragma once

#include <string>
#include <vector>

#include "acquisition/source_kind.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "gather/component.hpp"
#include "shooting/scene_options.hpp"

namespace slipwave {

/// What is simulated and recorded, and the edges.
inline void declare_scene(cli::Options& options, SceneOptions& s) {
  const std::vector<std::string> edges = {"free", "absorbing", "rigid", "mirror"};
  options.positional(s.model, "MODEL");
  options.add("source", s.sources, "X,Z", "where the source is, m; repeated: several shots; in 3-D X,Y,Z");
  options.add("kind", s.kind, "KIND", source_kind_help());
  options.add("wavelet", s.wavelet, "W", "ricker:F, sine:F[:CYCLES], gauss:F or file:PATH; F in Hz");
  options.add("amplitude", s.amplitude, "A", amplitude_help());
  options.add("receivers", s.receivers, "X0:X1:DX,Z",
              "line of receivers or one X,Z, m; may be repeated; in 3-D "
              "X0:X1:DX,Y0:Y1:DY,Z: an area");
  options.add("time", s.duration_s, "T", "length of the traces, s");
  options.add("dt", s.interval_s, "DT", "sampling interval of the traces, s");
  options.add("record", s.record, "LIST",
              "of " + joined(component_names(2)) + "; in 3-D also " + joined(component_names(3, 2)));
  options.add_choice("top", s.top, edges, "the surface z = 0");
  options.add_choice("sides", s.sides, edges, "the left and right edges, in 3-D all four");
  options.add_choice("bottom", s.bottom, edges, "the bottom edge");
  options.add("edge-width", s.edge_width, "CELLS",
              "width of the absorbing layers outside the model; 0: 20, or 40 for plane waves");
  options.add(
      "without", s.without, "LIST",
      "effects of the model to switch off: of slip, friction, viscosity, cohesion, opening, prestress");
  options.add_choice("precision", s.precision, {"float", "double"}, "of the computation");
  options.add("allow-auxetic", s.limits.allow_auxetic, "let vs exceed vp/sqrt(2)");
}

/// Order, time step, slip correction.
inline void declare_numerics(cli::Options& options, SceneOptions& s) {
  options.add_choice("order", s.order, {"1", "3", "5", "7"}, "order of the scheme in space");
  options.add_choice("time-order", s.time_order, {"2", "4"},
                     "order of the splitting in time; 4: six times the work a step, --cfl up to 2");
  options.add_choice("correction", s.correction, {"first", "second", "exponential"},
                     "slip in time: by rules of first or second order, or solved exactly");
  options.add("cfl", s.cfl, "C", "time step over h/vp_max");
  options.add("time-step", s.time_step_s, "S", "time step in s, instead of --cfl");
}

}  // namespace slipwave
