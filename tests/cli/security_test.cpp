// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>

#include "fault_scene.hpp"

namespace slipwave::security_test {
namespace {

/// What tools do with names and texts that somebody chose to do harm.
class Security : public FaultScene {
 protected:
  static std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char letter : word) text += letter == '\'' ? "'\\''" : std::string(1, letter);
    return text + "'";
  }
};

}  // namespace

TEST_F(Security, NamesThatAShellWouldRunAreNames) {
  const std::array<std::string, 4> begins = {"$(touch hacked)`touch hacked`",
                                             "a;touch hacked;' & touch hacked '",
                                             "a\ntouch hacked\n|touch hacked", "*?[a]~ && touch hacked #"};
  std::size_t turn = 0;
  for (const auto& command : commands()) {
    ++turn;
    for (std::size_t n = 0; n < begins.size(); ++n) {
      // In the short form one of them for each command.
      if (!long_form() && (n + turn) % begins.size() != 0) continue;
      const auto& begin = begins[n];
      if (command.output.empty() || command.tool == "sw-accuracy" || command.tool == "sw-marmousi") continue;
      const std::string name = begin + command.output.substr(command.output.rfind('.'));
      const Ran ran = run(command.to(quoted(name)));
      EXPECT_EQ(ran.code, 0) << command.to(quoted(name)) << '\n' << ran.err;
      EXPECT_TRUE(exists(name)) << command.to(quoted(name));
      // The same as an input that is not what was expected: refused, and said on one line.
      const Ran refused = run("sw-compare " + quoted(name) + " " + quoted(name) + " > /dev/null");
      EXPECT_TRUE(refused.err.empty() || std::count(refused.err.begin(), refused.err.end(), '\n') == 1)
          << refused.err;
      done("rm -- " + quoted(name));
      ASSERT_FALSE(exists("hacked")) << command.to(quoted(name));
    }
  }
}

TEST_F(Security, TemporariesAreNobodyElsesWhileToolsRun) {
  // The tools wait for more of their input with their outputs open, which are then looked at.
  const std::string waiting =
      "for i in $(seq 999); do ls -A there | grep -q tmp && break; sleep 0.01; done; find there -name "
      "'.*.tmp' -printf '%m\\n' | "
      "sort -u; ";
  for (const auto& [tool, input, output] :
       {std::array{"sw-fracture - --box 100:200,120:150 --dip 45 --friction 0.1 --viscosity 1 -o there/",
                   "in/m.nc", "out.nc"},
        std::array{"sw-spectrum - -o there/", "in/a.sgy", "out.nc"},
        std::array{"sw-convert - --format ibm -o there/", "in/a.sgy", "out.sgy"}}) {
    const Ran ran =
        run("umask 000; mkdir there; mkfifo pipe; " + std::string(tool) + output +
            " < pipe & exec 3> pipe; head -c -100 " + input + " >&3; " + waiting + "tail -c 100 " + input +
            " >&3; exec 3>&-; wait $!; echo $?; stat -c '%a' there/" + output + "; rm -r there pipe");
    EXPECT_EQ(ran.out, "600\n0\n666\n") << tool << '\n' << ran.err;
  }
}

}  // namespace slipwave::security_test
