// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "accuracy/dispersion.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Cells and steps; the medium apart, all that dispersion depends on.
struct Discretisation {
  int order = 5;
  double time_step_s = 0;
  double spacing_m = 0;
  int time_order = 2;
};

/// What the scheme's dispersion does to the direct waves of a scene, derived before anything is run: P and S
/// waves along straight rays from sources to receivers as the sources radiate them, some of them for all,
/// anisotropic rock as slow as in its slowest directions. With the step error e(f) (E15) of each medium on
/// the way, n steps in it, and the spectrum W(f) of the wavelet as the wave carries it (times sqrt(f) of a
/// line source, f of a point source),
///   error^2 = integral |exp(sum n e) - 1|^2 |W|^2 df / integral |W|^2 df.                          (E16)
/// Reflected waves, those along interfaces and edges, and what sources and fractures do are not in it.
template <int D>
class DirectWaves {
 public:
  explicit DirectWaves(const Scene<D>& scene);

  /// Relative L2 errors of all direct P waves and of all S waves; nothing where none arrives.
  struct Error {
    std::optional<double> p, s;
  };
  Error error(const Discretisation& cells) const;
  /// Returns the error of both together, each by its energy; where none arrives, that of the slowest waves at
  /// the sources on the way as long as the traces last.
  double together(const Discretisation& cells) const;
  /// Returns the error of the slowest waves of the scene on the way as long as the traces last.
  double latest(const Discretisation& cells) const;

 private:
  /// How long a wave travels in a medium.
  struct Leg {
    double vp = 0, vs = 0, time_s = 0;
  };
  /// A direct wave.
  struct Ray {
    WaveKind kind = WaveKind::p;
    double energy = 1;  // against that of the others
    double angle = 0;   // radians from the vertical
    std::vector<Leg> legs;
  };
  /// A frequency and its share of the energy of a ray.
  struct Line {
    double hz = 0, energy = 0;
  };

  void add_shot(const Scene<D>& scene, std::size_t shot);
  void add_ray(const Medium<D>& medium, const Point<D>& from, const Point<D>& to, Ray ray, double last_s);
  double squared_error(const Discretisation& cells, const Ray& ray) const;

  std::vector<Line> band_;
  std::vector<Ray> rays_;
  Ray latest_;
  bool arrive_ = true;
};

/// The cells and steps of a scene.
template <int D>
Discretisation discretisation_of(const Scene<D>& scene);

}  // namespace slipwave
