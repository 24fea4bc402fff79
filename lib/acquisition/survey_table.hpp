// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "acquisition/given_survey.hpp"
#include "io/table.hpp"

namespace slipwave {

/// Sources in a row of a table each: columns x, [y,] and z or depth; shot, delay, amplitude, kind, wavelet
/// where given. Rows of one shot are blended. Appended to `survey`. `dimension` is that of the model.
/// Every function here throws Error naming file, line and column.
void read_sources(Table& table, int dimension, GivenSurvey& survey);

/// A receiver of a table, and the shot it belongs to; 0: all.
struct TableReceiver {
  Place place;
  std::int64_t shot = 0, channel = 0;  // 0: not given
  std::string from;
};
/// Receivers in a row each: columns x, [y,] and z or depth; shot and channel where given. x and y that begin
/// with + are counted from the source.
std::vector<TableReceiver> read_receivers(Table& table, int dimension);

/// A whole survey, a row for each trace: columns sx, sz (or sdepth), gx, gz (or gdepth); sy, gy, shot,
/// channel, cdp where given. Rows of a shot may stand anywhere.
GivenSurvey read_survey(Table& table, int dimension);

/// Shots fired into one record: columns record, shot, and delay and amplitude where given. The survey's shots
/// become those of its records, with the receivers that all shots of a record must have in common.
void blend(Table& table, GivenSurvey& survey);

}  // namespace slipwave
