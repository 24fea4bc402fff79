// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "model/compliance.hpp"

namespace slipwave {

/// What sw-fracture is told.
struct FractureSettings {
  std::string model = "-";
  std::string box, polygon, ellipse, slab;
  std::vector<std::string> segments, traces, discs, rectangles;
  std::optional<double> intensity, concentration;
  std::string network, length, radius;
  int count = 0;
  std::optional<int> seed;
  std::string body;
  std::vector<std::string> dips, normals;
  std::optional<double> friction, viscosity_s, strength_pa;
  std::string law;
  ComplianceText compliance;
  std::optional<double> for_hz, strain_rate;
  bool block = false, opening = false, effective = false, open = false, faces = false;
  std::string prestress;
  std::string name;
  std::string output = "-";
};

/// What the planes do. What is usual: docs/slip.md.
inline void declare_laws(cli::Options& options, FractureSettings& settings) {
  options.add("friction", settings.friction, "Q", "coefficient of friction; of rock 0.6 to 0.85");
  options.add("viscosity", settings.viscosity_s, "ETA",
              "viscosity of slip, s: at twice the strength planes slip at 1/ETA; 0: dry friction; see "
              "--for-frequency");
  options.add("for-frequency", settings.for_hz, "HZ",
              "instead of --viscosity: that at which slip competes with waves of HZ and --strain-rate");
  options.add("strain-rate", settings.strain_rate, "RATE",
              "peak strain rate of these waves, 1/s: of a velocity v of the ground v 2 pi HZ/vp");
  options.add("strength", settings.strength_pa, "PA", "cohesion, Pa [0]");
  options.add("law", settings.law, "LAW",
              "coulomb, or slip-weakening:QD:DC: friction falls from Q to QD over a slip of DC m [coulomb]");
  options.add(
      "compliance", settings.compliance.compliance, "ZN,ZT",
      "compliant planes (linear slip), below friction or without it: normal and tangential compliance of "
      "a plane, m/Pa; usual 1e-14 to 1e-9");
  options.add("stiffness", settings.compliance.stiffness, "KN,KT", "or its stiffness, Pa/m");
  options.add(
      "spacing", settings.compliance.spacing_m, "M",
      "distance between planes, m; of single ones with --viscosity, between those of which each is one");
  options.add("dashpot", settings.compliance.dashpot, "DN,DT", "dashpots beside these springs, Pa s/m");
  options.add("crack-density", settings.compliance.crack_density, "E",
              "or penny-shaped cracks: their number in a unit volume times radius cubed; usual 0.01 to 0.1");
  options.add("aspect", settings.compliance.aspect, "A", "thickness of the cracks over their diameter");
  options.add("fill", settings.compliance.fill_pa, "PA",
              "bulk modulus of the fluid in the cracks: water 2.2e9 [0: dry]");
  options.add("effective", settings.effective,
              "change the rock instead: speeds, epsilon, delta and tilt of the equivalent rock for waves "
              "much longer than the spacing");
}

/// Single fractures, by --compliance or --stiffness of each, and networks of them.
inline void declare_single(cli::Options& options, FractureSettings& settings) {
  options.add("segment", settings.segments, "X,Z:X,Z",
              "instead of a region: one straight fracture; repeatable");
  options.add(
      "trace", settings.traces, "FILE",
      "or fractures along curves of lines \"X Z\", an empty line between two; repeatable; in 3-D plane "
      "polygons");
  options.add("disc", settings.discs, "X,Y,Z:R[:DIP]",
              "or in 3-D a disc of radius R; :DIP:AZIMUTH as in --dip; repeatable");
  options.add("rectangle", settings.rectangles, "X,Y,Z:L,W[:DIP]",
              "or a rectangle, L long down its dip and W wide; repeatable");
  options.add("open", settings.open,
              "single fractures carry no traction: open cracks, instead of --compliance; horizontal or "
              "vertical ones, moved to the nearest face between cells");
  options.add(
      "faces", settings.faces,
      "single fractures split the faces between cells instead of softening the cells beside them: for "
      "compliances above 2e-10 m/Pa, and for friction; horizontal or vertical ones");
  options.add(
      "network", settings.network, "N",
      "or N straight single fractures with centres drawn from the region, of --length, about --dip; in "
      "3-D discs of --radius");
  options.add("intensity", settings.intensity, "P",
              "instead of N: length of single fractures per area of the region, 1/m (P21), in 3-D area per "
              "volume (P32)");
  options.add("length", settings.length, "MIN:MAX[:EXPONENT]",
              "lengths of a network, m: their density falls as a power of the length [2]");
  options.add("radius", settings.radius, "MIN:MAX[:EXPONENT]", "in 3-D radii of its discs, m, likewise");
  options.add("concentration", settings.concentration, "KAPPA",
              "dips of a network: von Mises distribution about --dip, of twice the angle, in 3-D Fisher's of "
              "poles; 0: all directions [all have the dip]");
}

inline void declare(cli::Options& options, FractureSettings& settings) {
  options.positional(settings.model, "M");
  options.add("box", settings.box, "X0:X1,Z0:Z1", "region to fracture: a box, m; in 3-D X0:X1,Y0:Y1,Z0:Z1");
  options.add("polygon", settings.polygon, "FILE", "or in a polygon, one line \"X Z\" per vertex");
  options.add("ellipse", settings.ellipse, "X,Z:A,B[:DIP]",
              "or in an ellipse around X,Z with half axes A, which dips by DIP, and B; in 3-D "
              "X,Y,Z:A,B,C[:DIP[:AZIMUTH]]");
  options.add("slab", settings.slab, "X,Z:L,T[:DIP]",
              "or in a slab of length L and thickness T; in 3-D X,Y,Z:L,WIDTH,T[:DIP[:AZIMUTH]]");
  declare_single(options, settings);
  options.add("count", settings.count, "N",
              "fracture only N small slabs in the region, parallel to the planes");
  options.add("body", settings.body, "L,T",
              "mean length and thickness of the slabs [1/10 of the region's longer side, 1/10 of that]");
  options.add("seed", settings.seed, "S", "random seed of the slabs or of the network [1]");
  options.add(
      "dip", settings.dips, "DEG[:AZIMUTH]",
      "dip of the planes from the horizontal, deepening towards +x, in 3-D towards AZIMUTH degrees from +x "
      "(90: +y); repeat for two families of planes, in 3-D up to three");
  options.add("normal", settings.normals, "NX,NZ",
              "or their normal, of any length; z points down; in 3-D NX,NY,NZ");
  declare_laws(options, settings);
  options.add("block", settings.block, "blocks: add planes at right angles to those of --dip or --normal");
  options.add("opening", settings.opening, "planes open under tension; otherwise they carry it");
  options.add(
      "prestress", settings.prestress, "STRESS",
      "static stress of these cells, Pa: none, lithostatic[:K0] (the overburden; horizontally K0 times that "
      "[lambda/(lambda + 2 mu)]), a pressure, or SXX,SZZ,SXZ, in 3-D SXX,SYY,SZZ,SXY,SXZ,SYZ, tension "
      "positive");
  options.add("name", settings.name, "S", "name of the fracture set [fractures-N]");
  options.add("output,o", settings.output, "M", "model file; - is standard output");
  options.common({"box", "polygon", "slab", "segment", "trace", "disc", "dip", "normal", "friction",
                  "viscosity", "compliance", "spacing", "prestress", "name", "output"});
}

}  // namespace slipwave
