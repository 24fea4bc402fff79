// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "accuracy/causes.hpp"
#include "accuracy/response_error.hpp"
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
  /// Of all traces together, with all that is counted; nothing without receivers, or of plane waves.
  std::optional<PromisedError> promise;
  /// What that leaves out.
  std::vector<std::string> not_covered;
  /// Of what slip adds to the traces, where the scene slips, and what that leaves out; or why it is not
  /// known.
  std::optional<ResponseError> response;
  std::vector<std::string> response_leaves_out;
  std::string response_unknown;
  /// That of the direct waves, or of the P waves where there are none.
  double overall() const { return direct.value_or(p); }
  /// The largest of that, of P waves to the end (reflections matter, however small beside the direct waves)
  /// and of what is promised but for slip, so that shots with and without it are computed alike.
  double of_reflections_too() const { return std::max({overall(), p, promise ? promise->without_slip : 0.}); }
};

/// With the step error e(f) (E15) of each medium on the way, n steps in it, and the spectrum W(f) of the
/// wavelet as the wave carries it (times sqrt(f) from a point source in 2-D),
///   error^2 = integral |exp(sum n e) - 1|^2 |W|^2 df / integral |W|^2 df.                           (E16)
/// What interfaces, slip and the edges add is in the promise (ErrorSources).
class WavesOfScene {
 public:
  /// `finer_geometry`: smaller cells will be filled from the model's horizons (finer_model()).
  explicit WavesOfScene(const Scene<2>& scene, bool finer_geometry = false);
  /// For the cells and steps of the scene.
  ExpectedError expected() const { return expected(own_); }
  /// For others, of the same model, survey and recording.
  ExpectedError expected(const Discretisation& cells) const;
  /// Of that the promise alone, which takes less time.
  std::optional<PromisedError> promised(const Discretisation& cells) const;
  /// Of that of_reflections_too() alone; where it is above `most` something between the two, in less time.
  double of_reflections_too(const Discretisation& cells, double most) const;
  /// What is in that but for dispersion, which alone is always larger in larger cells.
  double apart_from_dispersion(const Discretisation& cells) const {
    return sources_.apart_from_dispersion(cells);
  }

 private:
  WavesOfScene(const Discretisation& own, const Scene<2>& isotropic, bool finer_geometry);

  Discretisation own_;
  bool anisotropic_ = false, monotone_ = false;
  ErrorSources sources_;
  std::vector<WaveTrain> direct_, longest_p_, longest_s_;
};

/// Of a scene as it is. In 3-D only what is promised of all traces, in the vertical planes through sources
/// and receivers (ErrorSources).
ExpectedError expected_error(const Scene<2>& scene);
ExpectedError expected_error(const Scene<3>& scene);

}  // namespace slipwave
