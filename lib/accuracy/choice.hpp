// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "accuracy/ladder.hpp"

namespace slipwave {

/// A way to compute a scene, and what is expected of it.
struct Choice {
  AccuracySetting setting;
  double expected_error = 0;    // ExpectedError::of_reflections_too()
  bool good_enough = false;     // below what was wanted, by the margin
  bool finer_geometry = false;  // other cells are filled from the model's horizons (finer_model())
  double slip_error = 0;        // of the response of fractures by itself, where that is known
  bool of_response = false;     // what is expected is the error of the response of fractures
  /// What stands in the way where none is good enough: the largest cause that no setting cures, or the
  /// largest.
  std::string reason;
};

/// The cheapest of all orders from 3 on (and fourth order in time from order 7 on), Courant numbers that may
/// pay with them, and cells of the model, whole or split (never joined: that would change the geology), whose
/// expected error is below `wanted` by a margin of 1.5 (what is expected is not exact). Costs are in fixed
/// proportions, so the same scene gets the same choice on every machine. The best there is when none is good
/// enough.
Choice cheapest_setting(const Scene<2>& scene, double wanted);

/// The same for the response of fractures (FractureResponse), of second order in time; unless the scene says
/// how wide its absorbing layers are, their width is chosen too. Slip counts also where the scene leaves it
/// out, so that shots with and without it are computed alike. Throws an Error where the error of the response
/// is not known.
Choice cheapest_setting_for_response(const Scene<2>& scene, double wanted);

/// The scene as chosen.
Scene<2> chosen_scene(const Scene<2>& scene, const Choice& choice);

/// "order 7, Courant 0.5, 2.5 m: expected error up to 0.8 %".
std::string sentence_of(const Choice& choice, const Scene<2>& scene);

}  // namespace slipwave
