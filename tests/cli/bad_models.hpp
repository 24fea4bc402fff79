// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Writes models that no tool of ours would write into `directory`, NAME.nc for each flaw: nan.nc,
/// negative.nc, ... The model is rock of 40 x 20 cells of 5 m, with fluid in the first two rows where its
/// flaw asks for it.
void write_bad_models(const std::string& directory);
