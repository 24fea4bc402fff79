// SPDX-License-Identifier: BSD-3-Clause
#include "cli/version.hpp"

#include "cli/version_text.hpp"

namespace slipwave::cli {

const char* version() { return version_text; }

}  // namespace slipwave::cli
