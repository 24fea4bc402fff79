// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "acquisition/given_survey.hpp"

namespace slipwave {

/// Whether a text begins as an SPS file does: with a header record H.., or a record S, R or X by columns.
bool looks_like_sps(std::string_view first);

/// A survey from SPS 2.1 files: sources (S), receivers (R) and relations (X), in any order and in as many
/// files as there are. Shots are the field records of X in the order of the file. z is the point depth below
/// the surface elevation. Lengths are in the grid unit of the header records (H201 metres, H20 its name),
/// else in metres. Throws Error naming file, line and columns.
GivenSurvey read_sps(const std::vector<std::string>& paths);

/// Returns the survey that texts give; `names` are those of the files.
GivenSurvey survey_of_sps(const std::vector<std::string>& names, const std::vector<std::string>& texts);

}  // namespace slipwave
