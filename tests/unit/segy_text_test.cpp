// SPDX-License-Identifier: BSD-3-Clause
#include "segy/text.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"

namespace slipwave::segy_text_test {

using namespace slipwave::segy;

namespace {

std::string line(const std::string& text, std::size_t number) {
  return text.substr((number - 1) * text_columns, text_columns);
}

std::string content(const std::string& text, std::size_t number) {
  std::string found = line(text, number).substr(4);
  found.erase(found.find_last_not_of(' ') + 1);
  return found;
}

}  // namespace

TEST(Ebcdic, FollowsCodePage037) {
  // IBM, code page 037: spot checks over all groups of characters
  const std::vector<std::pair<char, int>> known = {
      {'C', 0xC3}, {' ', 0x40}, {'0', 0xF0}, {'9', 0xF9},  {'a', 0x81}, {'i', 0x89}, {'j', 0x91},
      {'r', 0x99}, {'s', 0xA2}, {'z', 0xA9}, {'A', 0xC1},  {'J', 0xD1}, {'S', 0xE2}, {'Z', 0xE9},
      {'.', 0x4B}, {'(', 0x4D}, {')', 0x5D}, {'+', 0x4E},  {'-', 0x60}, {'/', 0x61}, {',', 0x6B},
      {':', 0x7A}, {'=', 0x7E}, {'_', 0x6D}, {'\'', 0x7D}, {'"', 0x7F}, {'%', 0x6C}, {'<', 0x4C},
      {'>', 0x6E}, {'?', 0x6F}, {'*', 0x5C}, {';', 0x5E}};
  for (const auto& [character, byte] : known)
    EXPECT_EQ(encode_text(std::string(1, character), TextEncoding::ebcdic)[0], byte) << character;
}

TEST(Ebcdic, GoesThereAndBackForEveryByte) {
  std::vector<std::uint8_t> bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  for (const TextEncoding encoding : {TextEncoding::ebcdic, TextEncoding::ascii}) {
    const std::string text = decode_text(bytes, encoding);
    EXPECT_EQ(encode_text(text, encoding), bytes);
    EXPECT_EQ(std::set<char>(text.begin(), text.end()).size(), 256U);
  }
}

TEST(TextualHeader, IsNumberedStampedAndFortyLinesOfEighty) {
  const std::string text = lay_out_text(std::vector<std::string>{"slipwave", "source [1, 2] | x!"}, 1);
  ASSERT_EQ(text.size(), 3200U);
  EXPECT_EQ(line(text, 1).substr(0, 12), "C 1 slipwave");
  EXPECT_EQ(content(text, 2), "source (1, 2) / x.");
  EXPECT_EQ(line(text, 10).substr(0, 4), "C10 ");
  EXPECT_EQ(content(text, 39), "SEG Y REV1");
  EXPECT_EQ(content(text, 40), "END TEXTUAL HEADER");
  EXPECT_EQ(content(lay_out_text({}, 2), 39), "SEG-Y REV2.1");
  EXPECT_EQ(encode_text(text, TextEncoding::ebcdic)[0], 0xC3);
}

TEST(TextualHeader, HoldsNothingReadersDislike) {
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  const std::string text = lay_out_text(std::vector<std::string>{all}, 1);
  EXPECT_EQ(text.find_first_of("[]!|^"), std::string::npos);
  for (const char character : text) EXPECT_TRUE(character >= ' ' && character <= '~');
}

TEST(TextualHeader, WrapsLongEntriesAtBlanks) {
  const std::string entry = std::string(70, 'a') + " " + std::string(20, 'b') + " c";
  const std::string text = lay_out_text(std::vector<std::string>{entry}, 1);
  EXPECT_EQ(content(text, 1), std::string(70, 'a'));
  EXPECT_EQ(content(text, 2), "  " + std::string(20, 'b') + " c");
  const std::string unbroken = lay_out_text(std::vector<std::string>{std::string(160, 'x')}, 1);
  EXPECT_EQ(content(unbroken, 1), std::string(76, 'x'));
  // One column where a word was broken, so that it can be put together again.
  EXPECT_EQ(content(unbroken, 2), " " + std::string(75, 'x'));
  EXPECT_EQ(content(unbroken, 3), " " + std::string(9, 'x'));
}

TEST(TextualHeader, KeepsTheLastEntryWhenThereAreTooMany) {
  std::vector<std::string> entries;
  for (int i = 1; i <= 60; ++i) entries.push_back("entry " + std::to_string(i));
  const std::string text = lay_out_text(entries, 1);
  EXPECT_EQ(content(text, 36), "entry 36");
  EXPECT_EQ(content(text, 37), "...");
  EXPECT_EQ(content(text, 38), "entry 60");
  EXPECT_EQ(content(text, 39), "SEG Y REV1");
}

TEST(TextualHeader, GrowsByTheCommandLineOfEveryToolInTheChain) {
  std::string text = lay_out_text(std::vector<std::string>{"sw-shoot m.nc"}, 1);
  text = with_entry(text, "sw-diff a b", 1);
  text = with_entry(text, "sw-diff c d", 1);
  EXPECT_EQ(content(text, 1), "sw-shoot m.nc");
  EXPECT_EQ(content(text, 2), "sw-diff a b");
  EXPECT_EQ(content(text, 3), "sw-diff c d");
  EXPECT_EQ(content(text, 4), "");
  EXPECT_EQ(content(text, 39), "SEG Y REV1");
}

TEST(TextualHeader, TakesANewEntryEvenWhenFull) {
  std::vector<std::string> entries;
  for (int i = 1; i <= 38; ++i) entries.push_back("entry " + std::to_string(i));
  std::string text = with_entry(lay_out_text(entries, 1), "new", 1);
  EXPECT_EQ(content(text, 36), "entry 36");
  EXPECT_EQ(content(text, 37), "...");
  EXPECT_EQ(content(text, 38), "new");
  text = with_entry(text, "newer", 1);
  EXPECT_EQ(content(text, 36), "entry 36");
  EXPECT_EQ(content(text, 38), "newer");
}

TEST(TextualHeader, LeavesLastLinesThatSaySomethingElse) {
  std::string text(text_bytes, ' ');
  text.replace(38 * 80, 13, "C39 processed");
  text = with_entry(text, "new", 1);
  EXPECT_EQ(content(text, 1), "new");
  EXPECT_EQ(content(text, 39), "processed");
  EXPECT_EQ(content(text, 40), "END TEXTUAL HEADER");
  EXPECT_THROW(with_entry("short", "new", 1), Error);
}

TEST(TextualHeader, TellsItsEncodingWithoutALineNumber) {
  const std::string text = std::string(20, ' ') + "CLIENT";
  EXPECT_EQ(encoding_of(encode_text(text, TextEncoding::ascii)), TextEncoding::ascii);
  EXPECT_EQ(encoding_of(encode_text(text, TextEncoding::ebcdic)), TextEncoding::ebcdic);
}

}  // namespace slipwave::segy_text_test
