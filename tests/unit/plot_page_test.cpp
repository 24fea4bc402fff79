// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <png.h>

#include <csetjmp>
#include <map>
#include <string>

#include "base/error.hpp"
#include "plot/canvas.hpp"
#include "plot/model_picture.hpp"
#include "plot_cases.hpp"
#include "plot_pixels.hpp"

namespace slipwave::plot::plot_page_test {
namespace {

std::string refusal_of(const PageSettings& settings, Format format = Format::png) {
  try {
    page_of(format, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "";
}

TEST(PlotPage, FormatsGoByTheEnding) {
  EXPECT_EQ(format_of("a.png"), Format::png);
  EXPECT_EQ(format_of("x/b.PDF"), Format::pdf);
  EXPECT_EQ(format_of("c.d.svg"), Format::svg);
  EXPECT_EQ(format_of("-"), Format::png);
  for (const char* name : {"a.gif", "png", "a", "a.png.gz", ""}) EXPECT_THROW(format_of(name), Error) << name;
}

TEST(PlotPage, SizesAreInCentimetresOrPixels) {
  const auto in_cm = page_of(Format::png, {"25.4x12.7cm", 100.0, "", ""});
  EXPECT_NEAR(in_cm.width_pt, 720, 1e-9);
  EXPECT_NEAR(in_cm.height_pt, 360, 1e-9);
  const auto in_px = page_of(Format::png, {"1200x800px", 200.0, "", ""});
  EXPECT_NEAR(in_px.width_pt * in_px.scale(), 1200, 1e-9);
  EXPECT_NEAR(in_px.height_pt * in_px.scale(), 800, 1e-9);
}

TEST(PlotPage, APngHasThePixelsAskedFor) {
  for (const char* size : {"333x277px", "1200x801px"}) {
    const auto pixels = decoded(draw_model(three_blocks(), false, {}, {}, page_of_size(size)).bytes);
    EXPECT_EQ(std::to_string(pixels.width) + "x" + std::to_string(pixels.height) + "px", size);
  }
}

TEST(PlotPage, SaysWhatIsWrongWithASize) {
  EXPECT_NE(refusal_of({"50x40", {}, "", ""}).find("--size: found '50x40'"), std::string::npos);
  EXPECT_NE(refusal_of({"2x1cm", {}, "", ""}).find("expected at least 4x3cm"), std::string::npos);
  EXPECT_NE(refusal_of({"90000x900px", {}, "", ""}).find("at most 20000"), std::string::npos);
  EXPECT_NE(refusal_of({"0x5cm", {}, "", ""}).find("--size"), std::string::npos);
  EXPECT_NE(refusal_of({"", 5.0, "", ""}).find("--dpi: found 5"), std::string::npos);
  EXPECT_NE(refusal_of({"", {}, "a\nb", ""}).find("--title: found byte 10 at place 2"), std::string::npos);
  EXPECT_NE(refusal_of({"", {}, "\xc3", ""}).find("--title: found byte 195"), std::string::npos);
  EXPECT_EQ(refusal_of({"", {}, "\u00e4hnlich \u2212 gleich", ""}), "");
}

TEST(PlotPage, TheSameCallsGiveTheSameBytes) {
  for (const auto format : {Format::png, Format::pdf}) {
    const auto page = page_of(format, {"", {}, "Twice", "sw-plot m.nc"});
    EXPECT_EQ(draw_model(fractured_blocks(), false, {}, {}, page).bytes,
              draw_model(fractured_blocks(), false, {}, {}, page).bytes);
  }
}

/// The texts of a PNG and its pixels per metre, as libpng finds them; its checksums are right, or it would
/// not.
std::map<std::string, std::string> texts_of(const std::vector<char>& bytes) {
  std::map<std::string, std::string> texts;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  struct Source {
    const char* at;
  } source{bytes.data()};
  if (setjmp(png_jmpbuf(png))) {  // where libpng goes when a chunk's checksum is wrong
    ADD_FAILURE() << "libpng refuses it";
    png_destroy_read_struct(&png, &info, nullptr);
    return {};
  }
  png_set_read_fn(png, &source, [](png_structp reading, png_bytep to, std::size_t count) {
    auto* from = static_cast<Source*>(png_get_io_ptr(reading));
    std::copy(from->at, from->at + count, reinterpret_cast<char*>(to));
    from->at += count;
  });
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(png, info);
  png_textp found = nullptr;
  int count = 0;
  png_get_text(png, info, &found, &count);
  for (int n = 0; n < count; ++n) texts[found[n].key] = found[n].text;
  texts["pixels per metre"] = std::to_string(png_get_x_pixels_per_meter(png, info));
  png_destroy_read_struct(&png, &info, nullptr);
  return texts;
}

TEST(PlotPage, APngKeepsTitleCommandAndResolution) {
  for (const std::string& title : {std::string("Plain"), std::string("\u00e4hnlich")}) {
    const auto page = page_of(Format::png, {"8x6cm", 254.0, title, "sw-plot m.nc --title x"});
    auto texts = texts_of(draw_model(three_blocks(), false, {}, {}, page).bytes);
    EXPECT_EQ(texts["Title"], title);
    EXPECT_EQ(texts["History"], "sw-plot m.nc --title x");
    EXPECT_EQ(texts["pixels per metre"], "10000");
  }
}

TEST(PlotPage, TextsOfFilesAreDrawnAsFarAsTheyCanBe) {
  EXPECT_EQ(legible("a\xff\x01 \u00e4\xc3"), "a?? \u00e4?");
  ModelSection section = fractured_blocks();
  section.sets[0].name = "\xe9t\xe9\n";
  EXPECT_GT(decoded(draw_model(section, true, {}, {}, page_of_size("")).bytes).width, 0);
  for (const auto format : {Format::pdf, Format::svg}) {
    const auto page = page_of(format, {"", {}, "", "sw-plot \xe9\x02.nc"});
    EXPECT_GT(draw_model(section, false, {}, {}, page).bytes.size(), 1000u);
  }
}

TEST(PlotPage, LettersAreShapedAsTheirScriptAsks) {
  EXPECT_LT(text_width("AVAVAV", 9), 3 * (text_width("A", 9) + text_width("V", 9)) - 0.5);  // kerning
  // Lam and alef are one letter together, and others reach to their neighbours.
  EXPECT_LT(text_width("\u0644\u0627", 9), text_width("\u0644", 9) + text_width("\u0627", 9) - 0.5);
}

TEST(PlotPage, AnSvgHoldsItsTextAsText) {
  const auto page = page_of(Format::svg, {"", {}, "A < B & \u00e9t\u00e9", ""});
  const auto bytes = draw_model(three_blocks(), false, {}, {}, page).bytes;
  const std::string svg(bytes.begin(), bytes.end());
  EXPECT_NE(svg.find(">A &lt; B &amp; \u00e9t\u00e9</text>"), std::string::npos);
  EXPECT_NE(svg.find(">depth (m)</text>"), std::string::npos);
  EXPECT_NE(svg.find("rotate(-90)"), std::string::npos);
  EXPECT_EQ(svg.find("<symbol"), std::string::npos) << "letters as outlines";
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(PlotPage, TextsAreShortenedToTheirRoom) {
  const std::string text = "\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc and so on";
  EXPECT_EQ(shortened(text, 1000, 9), text);
  for (const double room : {60.0, 30.0, 12.0}) {
    const auto shorter = shortened(text, room, 9);
    EXPECT_LE(text_width(shorter, 9), room);
    EXPECT_EQ(shorter.substr(shorter.size() - 3), "\u2026");
    EXPECT_NO_THROW(check_text(shorter));  // cut between characters
  }
  EXPECT_EQ(shortened(text, 1, 9), "");
}

}  // namespace
}  // namespace slipwave::plot::plot_page_test
