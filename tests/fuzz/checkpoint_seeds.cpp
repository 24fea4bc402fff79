// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <string>

#include "checkpoint_target.hpp"

/// checkpoint_seeds FOLDER: puts there what fuzzing begins with.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (const int passes : {1, 9})
    for (const int shots : {0, 1}) {
      const auto content = slipwave::fuzz::checkpoint_content(passes, shots);
      const std::string name =
          std::string(argv[1]) + "/after_" + std::to_string(passes) + "_of_" + std::to_string(shots);
      std::ofstream seed(name, std::ios::binary);
      seed << 'c';
      seed.write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
    }
  std::ofstream(std::string(argv[1]) + "/file") << "fslipwave";
  return 0;
}
