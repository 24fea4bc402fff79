// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/error_cause.hpp"
#include "accuracy/wave_train.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// What is promised of the response of fractures: the traces of a shot with slip less those of the same shot
/// without.
struct ResponseError {
  double error = 0;                // up to; relative L2 of velocities of all receivers, below that frequency
  double below_hz = 0;             // twice that of the wavelet
  std::vector<ErrorCause> causes;  // largest first
};

/// All of a setting that the response depends on.
struct ResponseSetting {
  Discretisation cells;
  SlipCorrection correction = SlipCorrection::centred;
  int zone_cells = 0;  // width of absorbing layers
};

/// Of a scene as it is.
ResponseSetting response_setting(const Scene<2>& scene);

/// Estimates errors of the response of fractures before anything is run. Patches of the fractured cells are
/// taken as secondary sources: waves come to them on straight ways, planes slip or give way along the
/// traction that they bring, and P and S waves travel on straight ways to the receivers, with the radiation
/// of that moment and the phases of their ways, so that the sum over the patches has the spectrum that their
/// interference gives it. Dispersion (E15) changes each way, the time step and the cells what a patch sends
/// out (theory.md (S32)), absorbing edges what grazes along them.
class FractureResponse {
 public:
  /// Slip counts also where the scene leaves it out (with_slip).
  explicit FractureResponse(const Scene<2>& scene);
  ~FractureResponse();
  FractureResponse(FractureResponse&&) noexcept;
  FractureResponse& operator=(FractureResponse&&) noexcept;

  /// Whether there is anything to promise; else why_not() says why there is not.
  bool any() const;
  const std::string& why_not() const;
  ResponseError promised(const ResponseSetting& setting) const;
  /// Sentences on what is not in it.
  const std::vector<std::string>& not_covered() const;

 private:
  struct Shot;
  /// Returns whether waves of the fractures would come to a receiver in time, if there were any.
  bool add_shots(const Scene<2>& scene);
  std::vector<std::unique_ptr<Shot>> shots_;
  std::string why_not_;
  std::vector<std::string> not_covered_;
};

}  // namespace slipwave
