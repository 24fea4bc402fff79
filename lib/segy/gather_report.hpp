// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/report.hpp"
#include "segy/describe.hpp"

namespace slipwave::segy {

/// The description for people and, as JSON, for programs. Keys of Seismic Unix files: no "text code", no
/// "text".
Report report_of(const Description& facts);

}  // namespace slipwave::segy
