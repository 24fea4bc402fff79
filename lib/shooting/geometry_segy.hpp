// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "acquisition/given_survey.hpp"

namespace slipwave {

/// The survey of a SEG-Y or Seismic Unix file of anybody: a shot for each field record and place of a source,
/// receivers in the order of its traces; what several components recorded at one receiver counts once.
/// Where the words of coordinates are missing, receivers stand at their offset from the source along x, or
/// both lie about their midpoint. `already_read`: bytes taken from standard input. Throws Error naming
/// the trace and the word that is wrong, or what is missing.
GivenSurvey read_trace_geometry(const std::string& path, std::vector<std::uint8_t> already_read = {});

}  // namespace slipwave
