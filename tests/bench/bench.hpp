// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Each file of benchmarks registers its own. Names are paths of NAME:VALUE, which `report` takes apart.
namespace slipwave::bench {

void register_triad();
void register_kernels();
void register_steps();
void register_cubes();
void register_effects();
void register_growth();

}  // namespace slipwave::bench
