// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/error_cause.hpp"
#include "accuracy/stack_response.hpp"
#include "accuracy/wave_train.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// What is promised of a scene: the error of all traces together, of velocities or of pressure, whichever is
/// larger where both are recorded, and where it comes from.
struct PromisedError {
  double error = 0;  // up to
  /// Of it, all that a setting may change: not the response of fractures, which is a first estimate, nor what
  /// comes back from the sides of the model where interfaces bend.
  double without_slip = 0;
  double slip = 0;                 // that
  double floor = 0;                // of it, what smaller cells and shorter steps do not cure
  std::vector<ErrorCause> causes;  // largest first
};
/// Estimates errors of traces before anything is run, from the response of the layers round each source
/// (StackResponse): dispersion changes speeds, an interface that is badly represented seems to be moved, and
/// both are carried through all waves that reach the receivers. What cannot be put so (near fields, PML at
/// grazing angles, slip) is added from measured figures.
class ErrorSources {
 public:
  /// With `finer_geometry` smaller cells will be filled anew from the horizons of the model; otherwise they
  /// are parts of the cells that there are.
  explicit ErrorSources(const Scene<2>& scene, bool finer_geometry = false);
  /// In 3-D each shot is taken in the vertical planes through its source and its receivers (UprightPlane),
  /// with waves that spread as those of points.
  explicit ErrorSources(const Scene<3>& scene);
  ~ErrorSources();
  ErrorSources(ErrorSources&&) noexcept;
  ErrorSources& operator=(ErrorSources&&) noexcept;

  /// Whether there is anything to promise: a point source and a receiver.
  bool any() const { return !shots_.empty(); }
  /// Of other cells and steps of the same model.
  PromisedError promised(const Discretisation& cells) const;
  /// Of that without_slip alone, in a third of the time; where it is above `most`, something between that and
  /// it, in hardly any.
  double without_slip(const Discretisation& cells, double most) const;
  /// The same but for dispersion, which alone is always larger in larger cells.
  double apart_from_dispersion(const Discretisation& cells) const;
  /// Sentences on what is not in it.
  const std::vector<std::string>& not_covered() const { return not_covered_; }

 private:
  struct Shot;
  struct Sums;
  static void add_dispersion(const Shot& shot, const Discretisation& cells, Sums& sums);
  static void add_interfaces(const Shot& shot, const Discretisation& cells, Sums& sums);
  static void add_all_else(const Shot& shot, const Discretisation& cells, Sums& sums);
  Sums sums_apart_from_dispersion(Recorded what, const Discretisation& cells) const;
  template <int D>
  void add(const Shot& shot, const Scene<D>& scene);
  void note_left_out(double duration_s);
  std::vector<std::unique_ptr<const StackResponse>> responses_;
  std::vector<Recorded> recorded_;
  std::vector<std::unique_ptr<Shot>> shots_;  // once for each of them
  std::vector<std::string> not_covered_;
};

}  // namespace slipwave
