// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"
#include "scratch.hpp"

namespace slipwave::base_output_file_test {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.file(name); }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return std::size_t(std::distance(fs::directory_iterator(scratch_.path()), fs::directory_iterator()));
  }

  /// A process writes something and is killed before it is whole.
  static void kill_a_writer_of(const std::string& path) {
    const pid_t child = fork();
    if (child == 0) {
      OutputFile out(path, OutputFile::Content::text);
      out.write("12345", 5);
      raise(SIGKILL);
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
  }

  Scratch scratch_;
};

}  // namespace

TEST_F(OutputFileTest, AppearsWholeAtCommitAndNotBefore) {
  OutputFile out(path("a"), OutputFile::Content::text);
  out.write("12345", 5);
  EXPECT_FALSE(fs::exists(path("a")));
  out.commit();
  EXPECT_EQ(content("a"), "12345");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, WithoutCommitLeavesTheOlderFileAndNothingElse) {
  std::ofstream(path("a")) << "older";
  {
    OutputFile out(path("a"), OutputFile::Content::text);
    out.write("12345", 5);
    EXPECT_EQ(entries(), 2u);
  }
  EXPECT_EQ(content("a"), "older");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, TakesMoreThanItsBuffer) {
  std::string large(3'000'000, 'x');
  for (std::size_t i = 0; i < large.size(); i += 1000) large[i] = char('a' + i / 1000 % 26);
  OutputFile out(path("a"), OutputFile::Content::binary);
  out.write(large.data(), 10);
  out.write(large.data() + 10, 2'000'000);
  for (std::size_t at = 2'000'010; at < large.size(); at += 7) {
    out.write(large.data() + at, std::min<std::size_t>(7, large.size() - at));
  }
  out.commit();
  EXPECT_EQ(content("a"), large);
}

TEST_F(OutputFileTest, HandsItsTemporaryToLibraries) {
  OutputFile out(path("a"), OutputFile::Content::binary);
  EXPECT_EQ(fs::path(out.path_for_libraries()).parent_path(), scratch_.path());
  std::ofstream(out.path_for_libraries()) << "by name";
  out.commit();
  EXPECT_EQ(content("a"), "by name");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFileTest, RemovesWhatAKilledWriterOfTheSameFileHasLeft) {
  for (const char* name : {"a", "b"}) kill_a_writer_of(path(name));
  ASSERT_EQ(entries(), 2u);
  {
    OutputFile out(path("a"), OutputFile::Content::text);
    EXPECT_EQ(entries(), 2u);  // its own, and that of the other file
    out.commit();
  }
  EXPECT_EQ(entries(), 2u);
  EXPECT_TRUE(fs::exists(path("a")));
  OutputFile(path("b"), OutputFile::Content::text).commit();
  EXPECT_EQ(entries(), 2u);
  EXPECT_TRUE(fs::exists(path("b")));
}

TEST_F(OutputFileTest, TakesNothingForAStrayThatIsNone) {
  fs::create_directory(path("elsewhere"));
  std::ofstream(path("elsewhere/x")) << "x";
  fs::create_symlink(path("elsewhere/x"), path(".a.abcdef.tmp"));
  fs::create_directory(path(".a.bcdefg.tmp"));
  ASSERT_EQ(mkfifo(path(".a.cdefgh.tmp").c_str(), 0600), 0);
  for (const char* name : {".a.abc.tmp", ".a.abcdefg.tmp", ".a.abcdef", ".ab.abcdef.tmp", "a.abcdef.tmp"})
    std::ofstream(path(name)) << "x";
  OutputFile(path("a"), OutputFile::Content::text).commit();
  EXPECT_EQ(entries(), 10u);
  EXPECT_EQ(content("elsewhere/x"), "x");
}

TEST_F(OutputFileTest, LeavesTheTemporariesOfLivingWritersAlone) {
  OutputFile one(path("a"), OutputFile::Content::text);
  auto file = NetcdfFile::create(one.path_for_libraries(), "a");
  OutputFile other(path("a"), OutputFile::Content::text);
  other.write("other", 5);
  // A third in a process of its own, which sees no locks of its own there.
  const pid_t child = fork();
  if (child == 0) {
    {
      OutputFile third(path("a"), OutputFile::Content::text);
      third.write("third", 5);
      third.commit();
    }
    _exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(content("a"), "third");
  EXPECT_EQ(entries(), 3u);
  other.commit();
  EXPECT_EQ(content("a"), "other");
  file.define_dimension("x", 3);
  file.close();
  one.commit();
  EXPECT_EQ(entries(), 1u);
  EXPECT_EQ(NetcdfFile::open(path("a")).dimension_length("x"), 3u);
}

TEST_F(OutputFileTest, IsWrittenByManyAtOnceAndOneOfThemWins) {
  constexpr int writers = 4, times = 100;
  std::vector<pid_t> children;
  for (int writer = 0; writer < writers; ++writer) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    const std::string text(5000, char('0' + writer));
    try {
      for (int n = 0; n < times; ++n) {
        OutputFile out(path("a"), OutputFile::Content::text);
        out.write(text.data(), text.size());
        out.commit();
      }
    } catch (const Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(entries(), 1u);
  const auto last = content("a");
  EXPECT_EQ(last, std::string(5000, last.at(0)));
}

TEST_F(OutputFileTest, WritesSpecialFilesInPlace) {
  OutputFile out("/dev/null", OutputFile::Content::binary);
  std::ofstream(out.path_for_libraries()) << "by name";
  out.commit();
  struct stat status {};
  ASSERT_EQ(stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(OutputFileTest, KeepsItsTemporaryPrivateUntilCommit) {
  OutputFile out(path("a"), OutputFile::Content::binary);
  struct stat status {};
  ASSERT_EQ(stat(out.path_for_libraries().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(OutputFileTest, HasAPrivateTemporaryWhateverTheUmaskAndThenTheModeTheUmaskAsksFor) {
  const auto mode_of = [](const std::string& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
  };
  for (const mode_t mask : {0000, 0022, 0027, 0077}) {
    const mode_t before = umask(mask);
    OutputFile out(path("a"), OutputFile::Content::binary);
    EXPECT_EQ(mode_of(out.path_for_libraries()), 0600u) << std::oct << mask;
    out.commit();
    umask(before);
    EXPECT_EQ(mode_of(path("a")), 0666u & ~mask) << std::oct << mask;
    fs::remove(path("a"));
  }
}

TEST_F(OutputFileTest, KeepsTheModeOfAnOlderFileButForSpecialBits) {
  for (const mode_t mode : {0600, 0644, 0660, 04755}) {
    std::ofstream(path("a")) << "older";
    ASSERT_EQ(chmod(path("a").c_str(), mode), 0);
    OutputFile out(path("a"), OutputFile::Content::text);
    out.write("1", 1);
    out.commit();
    struct stat status {};
    ASSERT_EQ(stat(path("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, mode & 0777);
  }
}

TEST_F(OutputFileTest, NamesTheFileWhenItCannotBeWritten) {
  const auto sentence_of = [](const std::string& name) -> std::string {
    try {
      OutputFile out(name, OutputFile::Content::binary);
      const std::string bytes(1'000'000, 'x');
      out.write(bytes.data(), bytes.size());
      out.commit();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(sentence_of(path("no/a")), path("no/a") + ": No such file or directory");
  EXPECT_EQ(sentence_of(scratch_.path().string()),
            scratch_.path().string() + ": is a directory, expected a file");
  EXPECT_EQ(sentence_of("/dev/full"), "/dev/full: No space left on device");
}

TEST_F(OutputFileTest, KnowsItsInputsByWhateverName) {
  std::ofstream(path("model.nc")) << "model";
  fs::create_symlink(path("model.nc"), path("link.nc"));
  fs::create_hard_link(path("model.nc"), path("same.nc"));
  for (const char* name : {"model.nc", "link.nc", "same.nc"})
    EXPECT_THROW(expect_other_files(path(name), {"-", path("model.nc")}), Error) << name;
  EXPECT_NO_THROW(expect_other_files(path("new.nc"), {path("model.nc")}));
  EXPECT_NO_THROW(expect_other_files("-", {"-"}));
  EXPECT_NO_THROW(expect_other_files("/dev/null", {"/dev/null"}));
}

}  // namespace slipwave::base_output_file_test
