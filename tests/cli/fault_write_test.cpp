// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "fault_scene.hpp"

namespace slipwave::fault_write_test {
namespace {

constexpr int input_output_error = 5, no_space = 28, over_quota = 122;

/// Outputs that cannot be written: each failure is one line, and an older output stays as it was.
class FaultOfWriting : public FaultScene {
 protected:
  /// Runs the command with one more call working each time, in the short form with ever more of them, until
  /// all of them do; returns how many failed.
  int fail_one_after_the_other(const Command& command, const std::string& kind, int error_number,
                               const std::string& cause) {
    write(command.output, "older");
    const auto before = files();
    int failed = 0;
    for (int number = 1; number < 1000; number += long_form() ? 1 : 1 + number / 3) {
      const std::string fault = kind + ':' + std::to_string(number) + ':' + std::to_string(error_number);
      const Ran ran = run(with_fault(fault, command.to_file()));
      if (ran.code == 0) {
        EXPECT_EQ(ran.err, "") << fault << ' ' << command.to_file();
        EXPECT_NE(content(command.output), "older") << fault << ' ' << command.to_file();
        return failed;
      }
      ++failed;
      EXPECT_EQ(ran.code, 1) << fault << ' ' << command.to_file();
      EXPECT_EQ(ran.err, command.sentence(cause)) << fault << ' ' << command.to_file();
      EXPECT_EQ(content(command.output), "older") << fault << ' ' << command.to_file();
      EXPECT_EQ(files(), before) << fault << ' ' << command.to_file();
      if (HasFailure()) return 0;
    }
    ADD_FAILURE() << "a thousand calls failed of " << command.to_file();
    return 0;
  }
};

}  // namespace

TEST_F(FaultOfWriting, AFullDiskIsSaidAtWhicheverWriteItFills) {
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    EXPECT_GE(fail_one_after_the_other(command, "write", no_space, "No space left on device"), 1)
        << command.to_file();
  }
}

TEST_F(FaultOfWriting, AFailingDiskAndAQuotaAreNamed) {
  for (const auto& command : commands()) {
    if (command.tool != "sw-layers" && command.tool != "sw-shoot") continue;
    fail_one_after_the_other(command, "write", input_output_error, "Input/output error");
    fail_one_after_the_other(command, "write", over_quota, "Disk quota exceeded");
  }
}

TEST_F(FaultOfWriting, ThatIsSaidOnlyAtClosingIsHeard) {
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    write(command.output, "older");
    const Ran ran = run(with_fault("close:1:" + std::to_string(over_quota), command.to_file()));
    EXPECT_EQ(ran.code, 1) << command.to_file();
    EXPECT_EQ(ran.err, command.sentence("Disk quota exceeded")) << command.to_file();
    EXPECT_EQ(content(command.output), "older") << command.to_file();
  }
}

TEST_F(FaultOfWriting, ThatStopsTheRenamingLeavesTheOlderFile) {
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    EXPECT_EQ(fail_one_after_the_other(command, "rename", input_output_error, "Input/output error"), 1);
  }
}

TEST_F(FaultOfWriting, AFileSizeLimitIsSaidByEveryTool) {
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    write(command.output, "older");
    const auto before = files();
    for (const int kibibytes : {0, 1}) {
      const std::string limit = "ulimit -f " + std::to_string(kibibytes) + "; ";
      // The limit would hold for the captured streams too, so these go through a pipe.
      const Ran ran = run("(" + limit + command.to_file() + " 2>&3) 3>&1 | cat");
      EXPECT_EQ(ran.code, 1) << limit << command.to_file();
      EXPECT_EQ(ran.out, command.sentence("File too large")) << limit << command.to_file();
      EXPECT_EQ(content(command.output), "older") << limit << command.to_file();
      EXPECT_EQ(files(), before) << limit << command.to_file();
    }
  }
}

TEST_F(FaultOfWriting, AFileSystemThatReallyIsFullIsSaidAndWorksWhenThereIsRoom) {
  done("mkdir small");
  // In a name space of its own, so that nothing stays mounted.
  const std::string mounted = "unshare -m bash -c 'mount -t tmpfs -o size=12k none small && ";
  if (run(mounted + "true'").code != 0) GTEST_SKIP() << "may not mount a file system here";
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    const std::string out = "small/" + command.output;
    const Ran ran =
        run(mounted + "{ echo older > " + out + "; head -c 8192 /dev/zero > small/other; " + command.to(out) +
            " 2> small.txt; echo $? > code; ls -A small > left; cat " + out + " >> left; }'");
    EXPECT_EQ(content("code"), "1\n") << command.to(out);
    EXPECT_EQ(content("small.txt"), command.tool + ": " + out + ": No space left on device\n");
    EXPECT_EQ(content("left"), "other\n" + command.output + "\nolder\n") << command.to(out);
  }
}

TEST_F(FaultOfWriting, ADirectoryThatMayNotBeWrittenIsNamed) {
  // Root may write everywhere, so that somebody else tries.
  const bool root = run("test $(id -u) -eq 0").code == 0;
  const std::string as = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
  done(
      "mkdir closed bin; cp $(dirname $(command -v sw-info))/sw-* bin; chmod 755 . .. bin in; chmod 644 "
      "in/*");
  if (root && run(as + "bin/sw-info in/m.nc > info.txt").code != 0)
    GTEST_SKIP() << "cannot run as another user here";
  for (const auto& command : commands()) {
    if (command.output.empty()) continue;
    const std::string out = "closed/" + command.output;
    done("chmod 755 closed; echo older > " + out + "; chmod 644 " + out + "; chmod 555 closed");
    const Ran ran = run(as + "bin/" + command.to(out));
    EXPECT_EQ(ran.code, 1) << command.to(out);
    EXPECT_EQ(ran.err, command.tool + ": " + out + ": Permission denied\n") << command.to(out);
    EXPECT_EQ(done("cat closed/*; ls -A closed; chmod 755 closed; rm closed/*"),
              "older\n" + command.output + "\n");
  }
}

TEST_F(FaultOfWriting, AnOutputRemovedUnderARunningToolIsMissed) {
  const std::string waiting = "until test -n \"$(find there -name '.out*' -size ";
  const std::string shot = "sw-shoot in/m.nc --source 150,10 --wavelet ricker:10 ";
  const auto expect_missed = [&](const std::string& line, const std::string& size,
                                 const std::string& removal) {
    const Ran ran = run("mkdir there; " + line + " & " + waiting + size + ")\"; do sleep 0.01; done; " +
                        removal + "; wait $!");
    EXPECT_EQ(ran.code, 1) << line << removal;
    EXPECT_EQ(ran.err, "sw-shoot: there/out: No such file or directory\n") << line << removal;
    EXPECT_FALSE(exists("there/out")) << line << removal;
    done("rm -rf there");
  };
  for (const std::string removal : {"rm there/.out*", "rm -r there"}) {
    // Long enough to be running still when this shell gets its turn on a busy machine.
    expect_missed(shot + "--time 20 --receivers 3,3 -o there/out", "-1", removal);
    expect_missed(shot + "--time 2 --every 0.001 --snapshots there/out", "+20k", removal);
  }
}

TEST_F(FaultOfWriting, AnOutputWhoseDirectoryIsGoneBeforeTheFirstByteIsMissed) {
  // The input is a fifo that stays open, so that the tool waits with its output opened.
  const Ran ran = run(
      "mkdir there; mkfifo pipe; sw-fracture - --box 100:200,120:150 --dip 45 --friction 0.1 --viscosity 1 "
      "-o there/out < pipe & exec 3> pipe; until ls there/.out* > /dev/null 2>&1; do sleep 0.01; done; "
      "rm -r there; cat in/m.nc >&3; exec 3>&-; wait $!");
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.err, "sw-fracture: there/out: No such file or directory\n");
}

}  // namespace slipwave::fault_write_test
