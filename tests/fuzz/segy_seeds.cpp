// SPDX-License-Identifier: BSD-3-Clause
#include "segy_shared.hpp"
#include "segy_target.hpp"

/// segy_seeds FOLDER: puts the files that fuzzing begins with there.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (const auto& seed : slipwave::segy::seeds(5))
    slipwave::segy::put_bytes(std::string(argv[1]) + "/" + seed.name, seed.bytes);
  return 0;
}
