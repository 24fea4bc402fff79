// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave::cli {

/// The version of what the tools are made of, "0.2.0" or "0.2.0-dev.812+g1a2b3c4" (version.cmake).
const char* version();

}  // namespace slipwave::cli
