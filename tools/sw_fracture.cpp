// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/history.hpp"
#include "base/parse.hpp"
#include "cli/tool.hpp"
#include "fracture_options.hpp"
#include "geology/region.hpp"
#include "grid/extent.hpp"
#include "grid/longest_side.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/anisotropic_fractures.hpp"
#include "model/effective_medium.hpp"
#include "model/fracture.hpp"
#include "model/fracture_network.hpp"
#include "model/model_netcdf.hpp"
#include "model/planar_fracture.hpp"
#include "model/prestress.hpp"
#include "model/single_fracture.hpp"
#include "model/slip_regime.hpp"
#include "model/split_faces.hpp"

using namespace slipwave;

namespace {

using Settings = FractureSettings;

/// Of "DEG", in 3-D "DEG" or "DEG:AZIMUTH".
template <int D>
Point<D> normal_of(const std::string& text) {
  if constexpr (D == 2) {
    return normal_of_dip(parse_number(text));
  } else {
    const auto angles = parse_numbers(text, ':');
    if (angles.size() > 2) throw Error("found '" + text + "', expected DEG or DEG:AZIMUTH", ErrorKind::usage);
    return normal_of_dip(angles[0], angles.size() == 2 ? angles[1] : 0);
  }
}

/// The other planes of blocks: across the first; in 3-D the second family is vertical, across the strike.
template <int D>
void add_across(std::vector<Point<D>>& normals) {
  const auto n = normals[0];
  if constexpr (D == 2) {
    normals.push_back({-n[1], n[0]});
  } else {
    const bool level = n[0] == 0 && n[1] == 0;
    const auto strike = unit_normal<3>(level ? Point<3>{0, 1, 0} : Point<3>{-n[1], n[0], 0});
    normals.push_back(strike);
    normals.push_back({n[1] * strike[2] - n[2] * strike[1], n[2] * strike[0] - n[0] * strike[2],
                       n[0] * strike[1] - n[1] * strike[0]});
  }
}

template <int D>
std::vector<Point<D>> normals_of(const Settings& settings) {
  std::vector<Point<D>> normals;
  for (const auto& text : settings.dips) {
    normals.push_back(in_place("--dip", [&] { return normal_of<D>(text); }));
  }
  for (const auto& text : settings.normals) {
    normals.push_back(in_place("--normal", [&] { return unit_normal<D>(parse_point<D>(text)); }));
  }
  if (settings.block && normals.size() != 1) {
    throw Error("--block needs exactly one --dip or --normal, found " + std::to_string(normals.size()),
                ErrorKind::usage);
  }
  if (settings.block) add_across<D>(normals);
  if (normals.empty() || normals.size() > D) {
    throw Error("found " + std::to_string(normals.size()) + " of --dip and --normal, give " +
                    (D == 2 ? "one or two" : "one to three"),
                ErrorKind::usage);
  }
  return normals;
}

std::uint64_t seed_of(const Settings& settings) { return std::uint64_t(settings.seed.value_or(1)); }

/// Sets the dip, and in 3-D the azimuth, of planes with this normal.
template <class Planes>
void set_dip(const Point<2>& normal, Planes& planes) {
  planes.dip_deg = dip_of_normal(normal);
}
template <class Planes>
void set_dip(const Point<3>& normal, Planes& planes) {
  const auto [dip_deg, azimuth_deg] = dip_and_azimuth_of(normal);
  planes.dip_deg = dip_deg, planes.azimuth_deg = azimuth_deg;
}

template <int D>
RegionIn<D> region_of(const Settings& settings) {
  const int given =
      !settings.box.empty() + !settings.polygon.empty() + !settings.ellipse.empty() + !settings.slab.empty();
  if (given != 1) {
    throw Error(
        "found " + std::to_string(given) + " of --box, --polygon, --ellipse and --slab, give exactly one",
        ErrorKind::usage);
  }
  if (!settings.polygon.empty()) {
    if constexpr (D == 2) return read_polygon(settings.polygon);
    throw Error("--polygon needs a model in 2-D; in 3-D use --box, --ellipse or --slab", ErrorKind::usage);
  }
  if (!settings.ellipse.empty())
    return in_place("--ellipse", [&] { return parse_ellipse<D>(settings.ellipse); });
  if (!settings.slab.empty()) return in_place("--slab", [&] { return parse_slab<D>(settings.slab); });
  return in_place("--box", [&] { return region_of_box<D>(parse_box<D>(settings.box)); });
}

/// Refuses a region outside the model; whether all of it is inside.
template <int D>
bool check_region(const RegionIn<D>& region, const Grid<D>& grid) {
  const auto model = box_of_grid(grid);
  const double near_m = 1e-6 * grid.spacing_m;
  bool inside = true;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double low_m = region.bounds.low_m[axis], high_m = region.bounds.high_m[axis];
    if (low_m >= model.high_m[axis] || high_m <= model.low_m[axis])
      throw Error("the region at " + shown_box(region.bounds) + " lies outside the model, which is at " +
                      shown_box(model),
                  ErrorKind::usage);
    inside = inside && low_m >= model.low_m[axis] - near_m && high_m <= model.high_m[axis] + near_m;
  }
  return inside;
}

/// The region itself, or slabs in it that lie along planes of this normal.
template <int D>
RegionIn<D> bodies_of(const Settings& settings, const RegionIn<D>& region, const Point<D>& normal) {
  if (settings.count == 0) {
    if (settings.body.empty()) return region;
    throw Error("--body needs --count, the number of slabs", ErrorKind::usage);
  }
  const auto& low = region.bounds.low_m;
  const auto& high = region.bounds.high_m;
  Scatter scatter;
  scatter.count = settings.count;
  scatter.seed = seed_of(settings);
  set_dip(normal, scatter);
  for (std::size_t axis = 0; axis < D; ++axis)
    scatter.length_m = std::max(scatter.length_m, (high[axis] - low[axis]) / 10);
  scatter.thickness_m = scatter.length_m / 10;
  if (!settings.body.empty()) {
    const auto body = in_place("--body", [&] { return parse_point<2>(settings.body); });
    scatter.length_m = body[0], scatter.thickness_m = body[1];
  }
  return in_place("--count", [&] { return scattered_in(region, scatter); });
}

template <int D>
void warn_of_large_cells(const Model<D>& model, const cli::Context& context) {
  const auto [length_m, cell] = critical_length(model, model.fracture_sets.size());
  const double side_m = longest_side_m(model.grid(), cell);
  if (length_m > side_m) return;
  context.warn("cells of " + shown(side_m, 3) +
               " m are too large for slip weakening: friction falls to the dynamic one at once where the "
               "prestress presses most, at " +
               place_of(model.grid(), cell) + ". Use cells below " + shown(length_m, 3) +
               " m (--step of the model) or a longer slip distance (--law)");
}

void warn_of_dense_cracks(const Settings& settings, const cli::Context& context) {
  constexpr double densest = 0.2;
  const double density = settings.compliance.crack_density.value_or(0);
  if (density > densest)
    context.warn("a crack density of " + shown(density) + " is above " + shown(densest) +
                 ", to which Hudson's theory of first order holds; usual are 0.01 to 0.1");
}

/// What is allowed and is seldom meant.
void warn_of_slips(const Settings& settings, const cli::Context& context) {
  // Rocks and faults have 0.1 to 1.
  constexpr double largest_friction = 2;
  if (settings.friction.value_or(0) > largest_friction)
    context.warn(
        "--friction " + shown(*settings.friction) +
        ": the coefficient of friction of rocks is below 1; it is the tangent of the angle of friction");
  if (!settings.dips.empty() && !settings.normals.empty())
    context.warn("--dip and --normal each give planes of their own: the set has " +
                 std::to_string(settings.dips.size() + settings.normals.size()) + " families of planes");
}

void refuse(const std::string& sentence) { throw Error(sentence, ErrorKind::usage); }

bool drawn(const Settings& s) { return !s.network.empty() || s.intensity; }
bool given(const Settings& s) {
  return !s.segments.empty() || !s.traces.empty() || !s.discs.empty() || !s.rectangles.empty();
}
bool single(const Settings& s) { return given(s) || drawn(s); }

/// Throws a usage Error where friction is half given or contradicts the rest.
void check_friction(const Settings& s) {
  const bool proposed = s.for_hz || s.strain_rate;
  if (proposed && !(s.for_hz && s.strain_rate)) refuse("--for-frequency and --strain-rate need each other");
  if (proposed && s.viscosity_s) refuse("found --viscosity and --for-frequency, give one of both");
  for (const auto& [name, value] : {std::pair{"for-frequency", s.for_hz}, {"strain-rate", s.strain_rate}})
    if (value && !(*value > 0))
      refuse("--" + std::string(name) + ": found " + shown(*value) + ", expected it above zero");
  if (s.friction && !s.viscosity_s && !proposed)
    refuse("--viscosity is missing; expected --viscosity ETA, or --for-frequency HZ --strain-rate RATE");
  for (const auto& [name, value] :
       {std::pair{"friction", s.friction}, {"viscosity", s.viscosity_s}, {"strength", s.strength_pa}})
    if (value && !(*value >= 0))
      refuse("--" + std::string(name) + ": found " + shown(*value) + ", expected it not below zero");
  if (s.friction) return;
  if (!s.compliance.given() && !s.open)
    refuse(
        "--friction is missing; expected --friction Q, or compliant planes: --compliance ZN,ZT, "
        "--stiffness KN,KT or --crack-density E");
  if (s.viscosity_s || proposed || s.strength_pa || !s.law.empty())
    refuse(std::string(s.viscosity_s   ? "--viscosity"
                       : proposed      ? "--for-frequency"
                       : s.strength_pa ? "--strength"
                                       : "--law") +
           " needs --friction");
  if (s.opening) refuse("--opening needs --friction: planes that open carry no tension, springs do");
}

/// Throws a usage Error where a rock that is changed contradicts what belongs to a fracture set.
void check_effective(const Settings& s) {
  if (!s.effective) return;
  for (const auto& [name, given] : {std::pair{"friction", s.friction.has_value()},
                                    {"prestress", !s.prestress.empty()},
                                    {"name", !s.name.empty()}})
    if (given)
      refuse("found --effective and --" + std::string(name) +
             ", which is of a fracture set; --effective makes none");
}

template <int D>
SlipSystem<D> system_of(const Settings& settings, const Point<D>& normal) {
  SlipSystem<D> system = {normal, settings.friction.value_or(0), settings.viscosity_s.value_or(0),
                          settings.strength_pa.value_or(0), settings.opening};
  if (!settings.friction)
    system.law = FrictionLaw::none;
  else if (!settings.law.empty())
    in_place("--law", [&] { set_friction_law(system, settings.law); });
  const auto& springs = settings.compliance;
  if (single(settings) ? !springs.compliance.empty() || !springs.stiffness.empty() : springs.given())
    system.compliance = parse_compliance(springs, single(settings));
  if (single(settings)) system.compliance.spacing_m = settings.compliance.spacing_m.value_or(0);
  if (settings.open)
    system.compliance.normal_m_per_pa = system.compliance.tangential_m_per_pa =
        std::numeric_limits<double>::infinity();
  return system;
}

/// Viscosity is that of planes so far apart, of which a single fracture is one.
void check_viscosity_of_single(const Settings& s) {
  const bool flows = s.viscosity_s.value_or(0) > 0;
  if (s.friction && flows && !s.compliance.spacing_m)
    refuse(
        "--spacing is missing; expected with the --viscosity of a single fracture the distance between the "
        "planes of which it is one, m");
  if (s.compliance.spacing_m && !(*s.compliance.spacing_m > 0))
    refuse("--spacing: found " + shown(*s.compliance.spacing_m) + ", expected it above zero");
  if (s.friction && s.viscosity_s && !flows && s.compliance.spacing_m)
    refuse("--spacing needs a --viscosity above zero: without it a single fracture slips by itself");
}

/// Single fractures open, and have a prestress, only where friction holds them.
void check_opening_of_single(const Settings& s) {
  if (s.friction || (!s.opening && s.prestress.empty())) return;
  const std::string found = s.opening ? "--opening" : "--prestress";
  if (s.open)
    refuse("found --open and " + found +
           ", give one of both: an open fracture carries no traction; one that parts only under tension has "
           "--faces --friction --opening");
  refuse("found " + found + " with single fractures " +
         (s.faces ? "without friction, expected --friction" : "in cells, expected --faces --friction") +
         (s.faces ? "" : " (in 2-D)") +
         ": they open and have a prestress where they stick and slide on the faces between cells");
}

/// Throws a usage Error where single fractures are given what belongs to clusters.
void check_single(const Settings& s) {
  if (!drawn(s))
    for (const auto& [name, given] : {std::pair{"length", !s.length.empty()},
                                      {"radius", !s.radius.empty()},
                                      {"concentration", s.concentration.has_value()}})
      if (given) refuse("--" + std::string(name) + " needs --network or --intensity");
  for (const auto& [name, given] : {std::pair{"open", s.open}, {"faces", s.faces}})
    if (given && !single(s))
      refuse("--" + std::string(name) + " needs single fractures: --segment or --trace");
  if (!single(s)) return;
  if (s.open && s.compliance.given())
    refuse("found --open and a compliance, give one of both: an open fracture carries no traction");
  if (s.open && s.friction)
    refuse(
        "found --open and --friction, give one of both: an open fracture carries no traction; one that parts "
        "only under tension has --faces --friction --opening");
  if (s.friction && !s.faces)
    refuse(
        "found --friction with single fractures in cells, expected --faces (in 2-D): they have friction "
        "where they part the faces between cells");
  if (drawn(s) && (given(s) || (!s.network.empty() && s.intensity)))
    refuse(
        "found more than one of --segment, --trace, --network and --intensity, give one (--segment and "
        "--trace may stand together, in 3-D --disc, --rectangle and --trace)");
  if (!s.compliance.given() && !s.open && !s.friction)
    refuse(
        "--compliance is missing; expected --compliance ZN,ZT, --stiffness KN,KT, --open, or --faces and "
        "--friction");
  check_viscosity_of_single(s);
  check_opening_of_single(s);
  if (drawn(s) && s.dips.size() != 1) refuse("--network and --intensity need one --dip");
  const auto& of = s.compliance;
  const bool region = !s.box.empty() || !s.polygon.empty() || !s.ellipse.empty() || !s.slab.empty();
  const std::pair<const char*, bool> others[] = {{"a region", region && !drawn(s)},
                                                 {"--dip", !s.dips.empty() && !drawn(s)},
                                                 {"--normal", !s.normals.empty()},
                                                 {"--count", s.count != 0},
                                                 {"--body", !s.body.empty()},
                                                 {"--block", s.block},
                                                 {"--spacing", of.spacing_m && !s.friction},
                                                 {"--for-frequency", s.for_hz.has_value()},
                                                 {"--dashpot", !of.dashpot.empty()},
                                                 {"--crack-density", of.crack_density.has_value()},
                                                 {"--effective", s.effective}};
  for (const auto& [name, given] : others)
    if (given)
      refuse("found " + std::string(name) +
             " with single fractures, which have --compliance or --stiffness, with --faces --friction, "
             "--viscosity, --strength, --law, --opening and --prestress, and nothing else of clusters");
}

/// Throws a usage Error where single fractures are given what belongs to models of other dimensions.
template <int D>
void check_single_in(const Settings& s) {
  if (!single(s)) return;
  const std::pair<const char*, bool> flat[] = {{"segment", !s.segments.empty()},
                                               {"length", !s.length.empty()},
                                               {"open", s.open},
                                               {"faces", s.faces}},
                                     spatial[] = {{"disc", !s.discs.empty()},
                                                  {"rectangle", !s.rectangles.empty()},
                                                  {"radius", !s.radius.empty()}};
  if constexpr (D == 3) {
    for (const auto& [name, found] : flat)
      if (found)
        refuse("--" + std::string(name) + " needs a model in 2-D; in 3-D single fractures are --disc, " +
               "--rectangle, --trace or a network of discs of --radius, with a compliance");
    if (drawn(s) && s.radius.empty()) refuse("--radius is missing; expected --radius MIN:MAX[:EXPONENT]");
  } else {
    for (const auto& [name, found] : spatial)
      if (found)
        refuse("--" + std::string(name) + " needs a model in 3-D; in 2-D single fractures are --segment, " +
               "--trace or a network of --length");
    if (drawn(s) && s.length.empty()) refuse("--length is missing; expected --length MIN:MAX[:EXPONENT]");
  }
}

template <int D>
FractureNetwork network_of(const Settings& s) {
  FractureNetwork of;
  if (!s.network.empty()) {
    const auto count = in_place("--network", [&] { return parse_integer(s.network); });
    if (count < 1 || count > most_fractures)
      refuse("--network: found " + std::to_string(count) + ", expected 1 to " +
             std::to_string(most_fractures));
    of.count = int(count);
  }
  of.intensity_per_m = s.intensity.value_or(0);
  of.seed = seed_of(s);
  of.concentration = s.concentration;
  const auto normal = in_place("--dip", [&] { return normal_of<D>(s.dips[0]); });
  set_dip(normal, of);
  const auto lengths = in_place(D == 2 ? "--length" : "--radius", [&] {
    const auto& text = D == 2 ? s.length : s.radius;
    auto numbers = parse_numbers(text, ':');
    if (numbers.size() < 2 || numbers.size() > 3) refuse("found '" + text + "', expected MIN:MAX[:EXPONENT]");
    return numbers;
  });
  of.least_m = lengths[0], of.most_m = lengths[1];
  if (lengths.size() == 3) of.exponent = lengths[2];
  return of;
}

template <int D>
std::vector<FractureTrace<D>> network_in(const Settings& settings, const Grid<D>& grid) {
  const auto region = region_of<D>(settings);
  const auto network = network_of<D>(settings);
  check_region(region, grid);
  return drawn_fractures(grid, region, network);
}

/// The traces that are given or drawn.
std::vector<FractureTrace<2>> traces_of(const Settings& settings, const Grid<2>& grid, const cli::Context&) {
  if (drawn(settings)) return network_in(settings, grid);
  std::vector<FractureTrace<2>> all;
  for (const auto& text : settings.segments) {
    all.push_back(in_place("--segment", [&] { return parse_segment(text); }));
    in_place("--segment", [&] { check_trace(grid, all.back()); });
  }
  for (const auto& path : settings.traces)
    for (const auto& trace : read_fracture_traces<2>(path)) {
      in_place("--trace: " + path, [&] { check_trace(grid, trace); });
      all.push_back(trace);
    }
  return all;
}

/// The same of polygons, which end with the model.
std::vector<FractureTrace<3>> traces_of(const Settings& settings, const Grid<3>& grid,
                                        const cli::Context& context) {
  if (drawn(settings)) return network_in(settings, grid);
  std::vector<FractureTrace<3>> all;
  double outside_m2 = 0;
  const auto add = [&](const FractureTrace<3>& polygon) {
    if (const auto fault = fault_of_polygon(polygon); !fault.empty()) refuse(fault);
    all.push_back(clipped(polygon, box_of_grid(grid)));
    if (all.back().empty())
      refuse("found no part of the fracture in the model, which is at " + shown_box(box_of_grid(grid)));
    outside_m2 += std::max(0., area_of(polygon) - area_of(all.back()));
  };
  for (const auto& text : settings.discs) in_place("--disc", [&] { add(parse_disc(text)); });
  for (const auto& text : settings.rectangles) in_place("--rectangle", [&] { add(parse_rectangle(text)); });
  for (const auto& path : settings.traces)
    for (const auto& polygon : read_fracture_traces<3>(path))
      in_place("--trace: " + path, [&] { add(polygon); });
  double area_m2 = 0;
  for (const auto& polygon : all) area_m2 += area_of(polygon);
  if (outside_m2 > 1e-9 * area_m2)
    context.warn("fractures end with the model: " + shown(outside_m2, 3) + " m2 of them are outside");
  return all;
}

/// Checks that fractures can lie on faces, and says how far the farthest is moved to get there.
void place_on_faces(const Settings& settings, const Grid<2>& grid,
                    const std::vector<FractureTrace<2>>& traces, const cli::Context& context) {
  double moved_m = 0;
  for (const auto& trace : traces) {
    const auto place =
        in_place(settings.open ? "--open" : "--faces", [&] { return check_on_faces(grid, trace); });
    if (std::abs(place.moved_m) > std::abs(moved_m)) moved_m = place.moved_m;
  }
  if (std::abs(moved_m) > 1e-6 * grid.spacing_m)
    context.warn("fractures lie on the nearest face between cells, up to " + shown(std::abs(moved_m), 3) +
                 " m beside their traces: what they scatter comes from there");
}

/// How large all fractures of a set are.
std::string size_of(const FractureSet<2>& set) {
  double length_m = 0;
  for (const auto& trace : set.traces) length_m += length_of(trace);
  return shown(length_m, 4) + " m";
}
std::string size_of(const FractureSet<3>& set) {
  double area_m2 = 0;
  for (const auto& polygon : set.traces) area_m2 += area_of(polygon);
  return shown(area_m2, 4) + " m2";
}

/// Of fractures that lie on each other, which is rarely meant; drawn ones may.
template <int D>
void warn_of_doubled(const Settings& settings, const FractureSet<D>& set, const cli::Context& context) {
  const double doubled = drawn(settings) ? 0 : doubled_size(set.traces);
  if (!(doubled > 0)) return;
  context.warn(shown(doubled, 4) + (D == 2 ? " m" : " m2") +
               " of the fractures lie on others, and have the compliance of both there; if that is not "
               "meant, give each of them once");
}

/// Puts single fractures into the model, and says how many cells they lie in, or faces on.
template <int D>
FractureCount put_single(const Settings& settings, Model<D>& model, const cli::Context& context) {
  FractureSet<D> set{settings.name, {}, {}};
  set.traces = traces_of(settings, model.grid(), context);
  if (set.name.empty()) set.name = "fractures-" + std::to_string(model.fracture_sets.size() + 1);
  const auto& first = set.traces.front();
  set.on_faces = settings.open || settings.faces;
  if constexpr (D == 2) {
    set.systems = {system_of<D>(settings, normal_between_tips(first))};
    if (set.on_faces) place_on_faces(settings, model.grid(), set.traces, context);
  } else {
    set.systems = {system_of<D>(settings, normal_of_polygon(first))};
  }
  const auto count = add_single_fractures(model, set);
  if (!settings.prestress.empty())
    set_prestress(model, model.fracture_sets.size(),
                  in_place("--prestress", [&] { return parse_prestress<D>(settings.prestress); }));
  context.note(std::to_string(set.traces.size()) + " single fracture" + (set.traces.size() == 1 ? "" : "s") +
               " of set '" + set.name + "', " + size_of(set) + " in all, " + (set.on_faces ? "on " : "in ") +
               std::to_string(count.marked) + (set.on_faces ? " faces" : " cells"));
  warn_of_doubled(settings, set, context);
  if (count.taken > 0)
    context.warn(std::to_string(count.taken) +
                 " cells of earlier clusters have only the single fractures now");
  return count;
}

/// Gives the set just made the viscosity at which slip competes with the wave asked for, and says it.
template <int D>
void put_viscosity(const Settings& settings, Model<D>& model, const cli::Context& context) {
  if (!settings.for_hz) return;
  const auto code = model.fracture_sets.size();
  const auto found = in_place("--for-frequency", [&] {
    return competing_slip(model, code, {*settings.for_hz, *settings.strain_rate});
  });
  for (auto& system : model.fracture_sets[code - 1].systems) system.viscosity_s = found.competing_viscosity_s;
  context.say("viscosity " + shown(found.competing_viscosity_s, 3) +
              " s, at which slip competes with waves of " + shown(*settings.for_hz) + " Hz and " +
              shown(*settings.strain_rate) + " 1/s (strength " + shown(found.strength_pa, 3) +
              " Pa); a tenth of it is near dry friction, ten "
              "times as much hardly slips");
}

template <int D>
FractureCount change_rock(const Settings&, Model<D>&, const std::vector<SlipSystem<D>>&, const RegionIn<D>&) {
  throw Error("--effective needs a model in 2-D; leave it out and the planes are springs", ErrorKind::usage);
}
template <>
FractureCount change_rock<2>(const Settings&, Model<2>& model, const std::vector<SlipSystem<2>>& systems,
                             const RegionIn<2>& region) {
  return in_place("--effective", [&] { return make_effective(model, systems, region.contains); });
}

/// Adds the set just described, with its stress and viscosity, and says how many cells it has.
template <int D>
FractureCount put_set(const Settings& settings, Model<D>& model, const std::vector<SlipSystem<D>>& systems,
                      const RegionIn<D>& region, const cli::Context& context) {
  const auto prestress = in_place("--prestress", [&] {
    return parse_prestress<D>(settings.prestress.empty() ? "none" : settings.prestress);
  });
  FractureSet<D> set{settings.name, systems};
  if (set.name.empty()) set.name = "fractures-" + std::to_string(model.fracture_sets.size() + 1);
  const auto count = add_fractures<D>(model, set, region);
  if (!settings.prestress.empty()) set_prestress(model, model.fracture_sets.size(), prestress);
  put_viscosity(settings, model, context);
  context.note(std::to_string(count.marked) + " cells of set '" + set.name + "', " +
               std::to_string(count.taken) + " of them from earlier sets" +
               (count.cut > 0 ? "; its edge cuts " + std::to_string(count.cut) +
                                    " of them, in which planes slip in a share of the cell"
                              : ""));
  return count;
}

template <int D>
void fracture(const Settings& settings, const NetcdfFile& file, OutputFile& out,
              const cli::Context& context) {
  check_single_in<D>(settings);
  std::vector<SlipSystem<D>> systems;
  if (!single(settings))
    for (const auto& normal : normals_of<D>(settings)) systems.push_back(system_of<D>(settings, normal));
  const auto whole = single(settings) ? RegionIn<D>{} : region_of<D>(settings);
  const auto region = single(settings) ? whole : bodies_of<D>(settings, whole, systems[0].normal);
  auto model = read_model<D>(file);
  const auto input = settings.model == "-" ? "standard input" : settings.model;
  // Whoever built the model decided about vs > vp/sqrt(2).
  in_place(input, [&] { check(model, {.allow_auxetic = true, .allow_slow = true}); });
  // Ellipses and slabs are often meant to reach through the whole model, and their bounds beyond it.
  if (!single(settings) && !check_region(whole, model.grid()) && !settings.box.empty())
    context.warn("the box at " + shown_box(whole.bounds) + " leaves the model, which is at " +
                 shown_box(box_of_grid(model.grid())) + ": planes end there");
  warn_of_dense_cracks(settings, context);
  const auto count = single(settings)     ? put_single(settings, model, context)
                     : settings.effective ? change_rock<D>(settings, model, systems, region)
                                          : put_set<D>(settings, model, systems, region, context);
  check(model, {.allow_auxetic = true, .allow_slow = true});
  if (const auto fault = fault_in_anisotropic_rock(model)) throw Error(fault->text);
  warn_of_slips(settings, context);
  if (!settings.effective) warn_of_large_cells(model, context);
  if (count.left && single(settings)) {
    context.warn("fractures end where rock does: " + std::to_string(count.left) +
                 (settings.open || settings.faces ? " faces beside fluid or void stay whole"
                                                  : " fluid or void cells beside them stay intact"));
  } else if (count.left) {
    context.warn(std::to_string(count.left) + " fluid or void cells in the region stay intact, " +
                 std::to_string(count.marked) +
                 " cells are fractured; a region within rock (--box, --polygon) has none");
  }
  append_history(model.history, context.command_line);
  model.source = context.version;
  write_model(model, out);
}

void run(const Settings& settings, const cli::Context& context) {
  if (settings.polygon == "-" && settings.model == "-") {
    throw Error("--polygon: standard input holds the model already, expected a file", ErrorKind::usage);
  }
  if (settings.model == "-" && std::count(settings.traces.begin(), settings.traces.end(), "-") > 0)
    refuse("--trace: standard input holds the model already, expected a file");
  if (settings.seed && settings.count == 0 && !drawn(settings))
    refuse("--seed needs --count, --network or --intensity");
  if (settings.seed && *settings.seed < 0)
    refuse("--seed: found " + std::to_string(*settings.seed) + ", expected 0 or more");
  check_single(settings);
  check_friction(settings);
  check_effective(settings);
  OutputFile out(settings.output, OutputFile::Content::binary);
  const auto file = NetcdfFile::open(settings.model);
  if (dimension_of(file) == 3) return fracture<3>(settings, file, out, context);
  fracture<2>(settings, file, out, context);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  return cli::run_tool(
      argc, argv,
      {"sw-fracture", "Puts a cluster of parallel fractures, or single ones, into a model.",
       "[M] (--box BOX | ...) (--dip DEG | --normal NX,NZ) (--friction Q --viscosity ETA | --compliance "
       "ZN,ZT "
       "--spacing M) [-o M]",
       "sw-fracture model.nc --box 500:2000,2000:2100 --dip 45 --friction 0.1 --viscosity 4e3 -o broken.nc"},
      [&](cli::Options& options) { declare(options, settings); },
      [&](const cli::Context& context) { run(settings, context); });
}
