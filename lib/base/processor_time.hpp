// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave {

/// Processor time this process has used so far, all its threads together, s. Only differences mean something.
double processor_time_s();

}  // namespace slipwave
