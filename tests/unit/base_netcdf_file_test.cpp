// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/error.hpp"
#include "io/netcdf_container.hpp"
#include "scratch.hpp"

namespace slipwave::base_netcdf_file_test {
namespace {

namespace fs = std::filesystem;

class NetcdfFileTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.file(name); }
  std::vector<char> bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write_sample(const std::string& name) const {
    auto file = NetcdfFile::create(path(name), name);
    file.define_dimension("time", 0);
    file.define_dimension("x", 3);
    file.define_variable("x", NetcdfFile::Type::f64, {"x"});
    file.define_variable("code", NetcdfFile::Type::u8, {"x"});
    file.define_variable("name", NetcdfFile::Type::text, {"x"});
    file.define_variable("v", NetcdfFile::Type::f32, {"time", "x"}, {true, {1, 3}});
    file.put_attribute("x", "units", "m");
    file.put_attribute("", "title", "a sample");
    file.put_attribute("v", "actual_range", std::vector<float>{0, 5});
    file.put("x", std::vector<double>{0.5, 1.5, 0.1}.data());
    file.put("code", std::vector<std::uint8_t>{0, 7, 255}.data());
    file.put_text("name", {"one", "", "drei \xc3\xa4"});
    for (std::size_t step = 0; step < 2; ++step) {
      const std::vector<float> row = {float(3 * step), float(3 * step + 1), float(3 * step + 2)};
      file.put("v", {step, 0}, {1, 3}, row.data());
    }
    file.close();
  }
  static std::string sentence_of(const std::function<void()>& body) {
    try {
      body();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  Scratch scratch_;
};

void expect_sample(const NetcdfFile& file) {
  EXPECT_EQ(file.get<double>("x"), (std::vector<double>{0.5, 1.5, 0.1}));
  EXPECT_EQ(file.get<std::uint8_t>("code"), (std::vector<std::uint8_t>{0, 7, 255}));
  EXPECT_EQ(file.get_text("name"), (std::vector<std::string>{"one", "", "drei \xc3\xa4"}));
  EXPECT_EQ(file.get<float>("v"), (std::vector<float>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(file.get<float>("v", {1, 1}, {1, 2}), (std::vector<float>{4, 5}));
  EXPECT_EQ(file.variable("v").dimensions, (std::vector<std::string>{"time", "x"}));
  EXPECT_EQ(file.dimension_length("time"), 2u);
  EXPECT_FALSE(file.dimension_length("y").has_value());
  EXPECT_EQ(file.text_attribute("x", "units"), "m");
  EXPECT_EQ(file.text_attribute("", "title"), "a sample");
  EXPECT_EQ(file.number_attribute("v", "actual_range"), (std::vector<double>{0, 5}));
  EXPECT_FALSE(file.text_attribute("x", "axis").has_value());
}

}  // namespace

TEST_F(NetcdfFileTest, ReadsBackWhatItWroteFromAFile) {
  write_sample("a.nc");
  expect_sample(NetcdfFile::open(path("a.nc")));
}

TEST_F(NetcdfFileTest, ReadsBackWhatItWroteFromMemory) {
  write_sample("a.nc");
  expect_sample(NetcdfFile::open(bytes("a.nc"), "memory"));
}

TEST_F(NetcdfFileTest, MayMoveWhileOpen) {
  write_sample("a.nc");
  auto first = NetcdfFile::open(bytes("a.nc"), "memory");
  auto second = std::move(first);
  expect_sample(second);
}

TEST_F(NetcdfFileTest, NamesFileAndVariableInErrors) {
  write_sample("a.nc");
  const auto file = NetcdfFile::open(path("a.nc"));
  EXPECT_EQ(sentence_of([&] { file.get<float>("w"); }), path("a.nc") + ": found no variable 'w'");
  EXPECT_EQ(sentence_of([&] { file.get_text("v"); }),
            path("a.nc") + ": v: found another type, expected strings");
  EXPECT_NE(sentence_of([&] {
              file.get<float>("v", {0, 2}, {1, 2});
            }).find(path("a.nc") + ": v: "),
            std::string::npos);
  EXPECT_EQ(sentence_of([&] { file.get<float>("v", {0}, {1}); }),
            path("a.nc") + ": v: found 2 dimensions, expected 1");
  EXPECT_EQ(sentence_of([] { NetcdfFile::open("none.nc"); }), "none.nc: No such file or directory");
  EXPECT_EQ(sentence_of([] { NetcdfFile::open(std::vector<char>(1000, 'x'), "junk"); }),
            "junk: is not a netCDF file");
  EXPECT_EQ(sentence_of([] { NetcdfFile::open(std::vector<char>(), "junk"); }),
            "junk: is empty, expected a netCDF file");
}

TEST_F(NetcdfFileTest, RefusesEveryTruncation) {
  write_sample("a.nc");
  const auto whole = bytes("a.nc");
  for (std::size_t kept = 0; kept < whole.size(); kept += 97) {
    const std::vector<char> part(whole.begin(), whole.begin() + std::ptrdiff_t(kept));
    EXPECT_THROW(NetcdfFile::open(part, "part"), Error) << kept;
  }
}

TEST_F(NetcdfFileTest, RefusesSizesThatTheFileCannotHold) {
  {
    auto file = NetcdfFile::create(path("a.nc"), "a.nc");
    file.define_dimension("x", std::size_t(1) << 40);
    file.define_variable("v", NetcdfFile::Type::f32, {"x"}, {true, {1024}});
    file.put("v", {0}, {3}, std::vector<float>{1, 2, 3}.data());
    file.close();
  }
  const auto file = NetcdfFile::open(path("a.nc"));
  EXPECT_NE(sentence_of([&] { file.get<float>("v"); }).find("which cannot hold as many"), std::string::npos);
  EXPECT_EQ(file.get<float>("v", {1}, {2}), (std::vector<float>{2, 3}));
}

TEST_F(NetcdfFileTest, GivesPhysicalValuesAndNaNWhereThereIsNone) {
  {
    auto file = NetcdfFile::create(path("a.nc"), "a.nc");
    file.define_dimension("x", 3);
    file.define_variable("packed", NetcdfFile::Type::i32, {"x"});
    file.put_attribute("packed", "_FillValue", std::vector<int>{-1});
    file.put_attribute("packed", "scale_factor", std::vector<double>{0.5});
    file.put_attribute("packed", "add_offset", std::vector<double>{100});
    file.put("packed", std::vector<int>{0, -1, 4}.data());
    file.define_variable("unwritten", NetcdfFile::Type::f32, {"x"});
    file.define_variable("ranged", NetcdfFile::Type::f32, {"x"});
    file.put_attribute("ranged", "valid_range", std::vector<double>{0, 5});
    file.put("ranged", std::vector<float>{-1, 5, 6}.data());
    file.define_variable("bounded", NetcdfFile::Type::f32, {"x"});
    file.put_attribute("bounded", "valid_max", std::vector<double>{5});
    file.put("bounded", std::vector<float>{-1, 5, 6}.data());
    file.close();
  }
  const auto file = NetcdfFile::open(path("a.nc"));
  const auto packed = file.get_physical("packed");
  EXPECT_EQ(packed[0], 100);
  EXPECT_TRUE(std::isnan(packed[1]));
  EXPECT_EQ(packed[2], 102);
  const auto ranged = file.get_physical("ranged"), bounded = file.get_physical("bounded");
  EXPECT_TRUE(std::isnan(ranged[0]) && ranged[1] == 5 && std::isnan(ranged[2]));
  EXPECT_TRUE(bounded[0] == -1 && bounded[1] == 5 && std::isnan(bounded[2]));
  for (const float value : file.get_physical("unwritten")) EXPECT_TRUE(std::isnan(value));
}

TEST(NetcdfContainer, TellsNetcdfByItsFirstBytes) {
  EXPECT_TRUE(begins_netcdf(std::string_view("CDF\x01----", 8)));
  EXPECT_TRUE(begins_netcdf(std::string_view("CDF\x05----", 8)));
  EXPECT_TRUE(begins_netcdf("\x89HDF\r\n\x1a\n"));
  EXPECT_FALSE(begins_netcdf(std::string_view("CDF\x03----", 8)));
  EXPECT_FALSE(begins_netcdf("C 1 CLIENT"));
  EXPECT_FALSE(begins_netcdf(""));
}

TEST(NetcdfContainer, ComputesTheSizeOfAClassicFileFromItsHeader) {
  // CDF-1, no records, dimension x = 5, no attributes, float v(x) at byte 80: 80 + 20 bytes.
  std::string header("CDF\x01", 4);
  const auto word = [&](unsigned value) {
    for (int shift = 24; shift >= 0; shift -= 8) header += char(value >> shift & 0xff);
  };
  const auto name = [&](char letter) {
    word(1);
    header += std::string{letter, '\0', '\0', '\0'};
  };
  word(0);
  word(10), word(1), name('x'), word(5);
  word(0), word(0);
  word(11), word(1), name('v'), word(1), word(0), word(0), word(0), word(5), word(20), word(80);
  ASSERT_EQ(header.size(), 80u);
  const auto read_at = [&](std::uint64_t offset, void* to, std::size_t count) {
    if (offset + count > header.size()) return false;
    header.copy(static_cast<char*>(to), count, offset);
    return true;
  };
  EXPECT_NO_THROW(check_not_truncated(read_at, 100));
  EXPECT_THROW(check_not_truncated(read_at, 99), Error);
}

TEST(NetcdfContainer, RefusesLengthsThatWouldWrapRound) {
  // CDF-5, no records, 2^63 dimensions whose names have 2^64 - 16 letters: each would lead back to the one
  // before.
  std::string header("CDF\x05", 4);
  const auto word = [&](std::uint64_t value, int bytes) {
    for (int shift = 8 * bytes - 8; shift >= 0; shift -= 8) header += char(value >> shift & 0xff);
  };
  word(0, 8), word(10, 4), word(std::uint64_t(1) << 63, 8), word(~std::uint64_t(0) - 15, 8);
  header += std::string(68, '\0');
  const auto read_at = [&](std::uint64_t offset, void* to, std::size_t count) {
    if (offset + count > header.size()) return false;
    header.copy(static_cast<char*>(to), count, offset);
    return true;
  };
  EXPECT_THROW(check_not_truncated(read_at, header.size()), Error);
}

}  // namespace slipwave::base_netcdf_file_test
