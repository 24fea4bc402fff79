#pragma once

#include <algorithm>
#include <optional>

#include "accuracy/wave_train.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Relative L2 errors that the scheme's dispersion leaves in the waves of a scene, before anything is run.
struct ExpectedError {
  /// Of the direct waves, all shots and receivers together, each by its energy: P and S along straight rays
  /// as the source radiates them, the Rayleigh wave where source and receiver are near a free surface; in
  /// water together with their reflection from it. Nothing where none arrives before the traces end.
  std::optional<double> direct;
  /// Of P and S waves that are on their way as long as the traces last, the mean over all directions, in each
  /// medium for the share of time that a ray through the whole model spends there. No s in fluids only.
  double p = 0;
  std::optional<double> s;
  /// That of the direct waves, or of the P waves where there are none.
  double overall() const { return direct.value_or(p); }
  /// The larger of that and of P waves to the end: reflections matter, however small beside the direct waves.
  double of_reflections_too() const { return std::max(overall(), p); }
};

/// With the step error e(f) (E15) of each medium on the way, n steps in it, and the spectrum W(f) of the
/// wavelet as the wave carries it (times sqrt(f) from a point source in 2-D),
///   error^2 = integral |exp(sum n e) - 1|^2 |W|^2 df / integral |W|^2 df.                           (E16)
/// What interfaces, slip and the edges add is not in it.
class WavesOfScene {
 public:
  explicit WavesOfScene(const Scene<2>& scene);
  /// For the cells and steps of the scene.
  ExpectedError expected() const { return expected(own_); }
  /// For others, of the same model, survey and recording.
  ExpectedError expected(const Discretisation& cells) const;

 private:
  Discretisation own_;
  std::vector<WaveTrain> direct_, longest_p_, longest_s_;
};

}  // namespace slipwave
