#include "base/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

using namespace slipwave;

namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path().string() + "/slipwave-unit-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    directory_ = name;
  }
  void TearDown() override { fs::remove_all(directory_); }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return std::size_t(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

  fs::path directory_;
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
  EXPECT_EQ(fs::path(out.path_for_libraries()).parent_path(), directory_);
  std::ofstream(out.path_for_libraries()) << "by name";
  out.commit();
  EXPECT_EQ(content("a"), "by name");
  EXPECT_EQ(entries(), 1u);
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
  EXPECT_EQ(sentence_of(directory_.string()), directory_.string() + ": is a directory, expected a file");
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
