// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "acquisition/given_survey.hpp"

namespace slipwave {

/// The traces of a SEG-Y or Seismic Unix gather as sources where they were recorded (theory.md (A20)): a shot
/// for each field record, in which every trace is the wavelet of a force along its component (vx, vy, vz) or,
/// of pressure, of an explosion. With `reversed` the last sample of each record comes first, at t = 0. Traces
/// of zeros are left out. Throws Error naming the trace that cannot be injected: of another component, with
/// samples that are not finite, or that begins before t = 0.
GivenSurvey read_injection(const std::string& path, bool reversed, int dimension);

}  // namespace slipwave
