// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "segy/geometry.hpp"
#include "segy/sniff.hpp"
#include "segy/words.hpp"

namespace slipwave::segy_header_test {

using namespace slipwave::segy;

namespace {

template <class Layout>
void check_layout() {
  std::set<std::string_view> names;
  std::vector<int> owners(static_cast<std::size_t>(Layout::size), 0);
  for (const segy::Field& field : Layout::fields) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.meaning.empty());
    for (int byte = field.byte; byte < field.byte + size_of(field.type); ++byte) {
      ASSERT_GE(byte, Layout::first);
      ASSERT_LT(byte, Layout::first + Layout::size);
      EXPECT_EQ(owners[static_cast<std::size_t>(byte - Layout::first)]++, 0) << field.name;
    }
  }
}

TraceHeader header_at(double source_x, double receiver_x) {
  TraceHeader header;
  header.shot = 3;
  header.channel = 17;
  header.component = Component::vz;
  header.source_m = {source_x, 0, 12.5};
  header.receiver_m = {receiver_x, 0, 2.5};
  header.water_depth_source_m = 450;
  return header;
}

}  // namespace

TEST(HeaderLayout, HasNoFieldTwiceAndNoByteTwice) {
  check_layout<TraceLayout>();
  check_layout<BinaryLayout>();
}

TEST(HeaderLayout, CoversEveryByteOfRevision1) {
  int covered = 0;
  for (const segy::Field& field : TraceLayout::fields) covered += size_of(field.type);
  EXPECT_EQ(covered, 232);  // 233 to 240 are unassigned
}

TEST(HeaderWords, StandWhereTheStandardPutsThem) {
  TraceWords words;
  words.set("sx", -2);
  words.set("ns", 60000);
  const auto big = words.in_file_order(Endian::big);
  EXPECT_EQ((std::vector<int>{big[72], big[73], big[74], big[75]}), (std::vector<int>{255, 255, 255, 254}));
  EXPECT_EQ((std::vector<int>{big[114], big[115]}), (std::vector<int>{0xEA, 0x60}));
  const auto little = words.in_file_order(Endian::little);
  EXPECT_EQ((std::vector<int>{little[72], little[75]}), (std::vector<int>{254, 255}));
  EXPECT_EQ(TraceWords(little, Endian::little), words);
  EXPECT_EQ(words.get("sx"), -2);
  EXPECT_EQ(words.get("ns"), 60000);
}

TEST(HeaderWords, RefuseWhatDoesNotFitAndNameTheWord) {
  TraceWords words;
  EXPECT_THROW(words.set("ns", 65536), Error);
  EXPECT_THROW(words.set("delrt", 32768), Error);
  EXPECT_NO_THROW(words.set("fldr", -2147483648));
  try {
    words.set("fldr", 2147483648);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "header word fldr (byte 9) would be 2147483648, its range is -2147483648 to 2147483647");
  }
}

TEST(SurveyLayout, ChoosesTheCoarsestScalarThatIsExact) {
  const auto scalar = [](double source_x, double receiver_x) {
    TraceHeader header = header_at(source_x, receiver_x);
    header.source_m[2] = header.receiver_m[2] = 0;
    return layout_of(std::vector<TraceHeader>{header}).coordinate_scalar;
  };
  EXPECT_EQ(scalar(100, 200), 1);
  EXPECT_EQ(scalar(100, 201), -10);  // the midpoint is 150.5
  EXPECT_EQ(scalar(100.5, 200.5), -10);
  EXPECT_EQ(scalar(100.25, 200.25), -100);
  EXPECT_EQ(scalar(0.125, 0.125), -1000);
  EXPECT_EQ(scalar(1.0 / 3, 200), -10000);  // never exact: the finest
  EXPECT_EQ(scalar(1.0 / 3, 10e6), -100);   // 10^10 mm do not fit, 10^9 cm do
  EXPECT_THROW(scalar(0, 3e9), Error);
  EXPECT_THROW(scalar(0, std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(SurveyLayout, TakesHalfTheReceiverSpacingForBins) {
  std::vector<TraceHeader> headers;
  for (const Component component : {Component::vz, Component::p})
    for (int i = 0; i < 4; ++i) {
      headers.push_back(header_at(1000, 1000 + 25.0 * i));
      headers.back().component = component;
    }
  const SurveyLayout layout = layout_of(headers);
  EXPECT_EQ(layout.bin_m, 12.5);
  EXPECT_EQ(layout.traces_per_shot, 8);
  EXPECT_EQ(layout.traces, 8);
}

TEST(SurveyLayout, GivesCloseLinesNumbersOfTheirOwn) {
  // Lines 4 m apart of receivers every 25 m, the source between them; and the same turned by 90 degrees.
  for (const std::size_t along : {0U, 1U})
    for (const double from : {0., -8., 3., 10.1}) {
      std::vector<TraceHeader> headers;
      for (int line = 0; line < 7; ++line)
        for (int n = 0; n < 5; ++n) {
          TraceHeader header = header_at(0, 0);
          header.source_m[along] = 60;
          header.source_m[1 - along] = from + 9;
          header.receiver_m[along] = 25. * n;
          header.receiver_m[1 - along] = from + 4. * line;
          headers.push_back(header);
        }
      const SurveyLayout layout = layout_of(headers);
      EXPECT_EQ(along == 0 ? layout.bin_m : layout.bin_y_m, 12.5);
      EXPECT_NEAR(along == 0 ? layout.bin_y_m : layout.bin_m, 2, 1e-12);
      std::vector<std::int64_t> numbers;
      for (std::size_t trace = 0; trace < headers.size(); trace += 5) {
        const TraceWords words = words_from_si(headers[trace], layout);
        numbers.push_back(along == 0 ? words.get("iline") : words.get("xline"));
      }
      for (std::size_t line = 1; line < numbers.size(); ++line) {
        const bool passes_zero = numbers[line - 1] < 0 && numbers[line] > 0;  // there is no bin 0
        EXPECT_EQ(numbers[line] - numbers[line - 1], passes_zero ? 2 : 1) << from << ", line " << line;
      }
    }
}

TEST(SurveyLayout, NumbersLinesByShotAndComponentWellsByChannelAreasByMidpoint) {
  // Two shots into three receivers each, of two components.
  const auto numbers_of = [](auto&& receiver) {
    std::vector<TraceHeader> headers;
    for (const int shot : {4, 7})
      for (const Component component : {Component::vz, Component::p})
        for (int n = 0; n < 3; ++n) {
          headers.push_back(header_at(100. * shot, 0));
          headers.back().shot = shot;
          headers.back().channel = n + 1;
          headers.back().component = component;
          headers.back().receiver_m = receiver(shot, n);
        }
    const SurveyLayout layout = layout_of(headers);
    std::vector<std::pair<std::int64_t, std::int64_t>> numbers;
    for (const auto& header : headers) {
      const TraceWords words = words_from_si(header, layout);
      numbers.emplace_back(words.get("iline"), words.get("xline"));
    }
    return numbers;
  };
  using Numbers = std::vector<std::pair<std::int64_t, std::int64_t>>;
  using Place = std::array<double, 3>;
  EXPECT_EQ(numbers_of([](int, int n) {
              return Place{25. * n, 0, 5};
            }),
            (Numbers{{4, 12},
                     {4, 12},
                     {4, 12},
                     {4, 11},
                     {4, 11},
                     {4, 11},
                     {7, 12},
                     {7, 12},
                     {7, 12},
                     {7, 11},
                     {7, 11},
                     {7, 11}}));
  EXPECT_EQ(numbers_of([](int shot, int n) {
              return Place{100. * shot + 50, 0, 5. * n};
            }),
            (Numbers{{12, 1},
                     {12, 2},
                     {12, 3},
                     {11, 1},
                     {11, 2},
                     {11, 3},
                     {12, 1},
                     {12, 2},
                     {12, 3},
                     {11, 1},
                     {11, 2},
                     {11, 3}}));
  // Midpoints at x = 200 and 350 m, y = 0, 50 and 100 m, in bins of 50 m.
  EXPECT_EQ(
      numbers_of([](int, int n) {
        return Place{0, 100. * n, 5};
      }),
      (Numbers{
          {1, 5}, {2, 5}, {3, 5}, {1, 5}, {2, 5}, {3, 5}, {1, 8}, {2, 8}, {3, 8}, {1, 8}, {2, 8}, {3, 8}}));
}

TEST(SurveyLayout, TakesLinesFarApartAndSingleReceiversAsOneLine) {
  std::vector<TraceHeader> headers;
  for (const double y : {0., 100.})
    for (int n = 0; n < 3; ++n) {
      headers.push_back(header_at(0, 25. * n));
      headers.back().receiver_m[1] = y;
    }
  EXPECT_EQ(layout_of(headers).bin_y_m, 12.5);
  // A crooked line: nothing but noise across it.
  headers.clear();
  for (int n = 0; n < 6; ++n) {
    headers.push_back(header_at(0, 25. * n));
    headers.back().receiver_m[1] = 0.1 * (n % 3);
  }
  EXPECT_NEAR(layout_of(headers).bin_y_m, 12.5, 1e-3);
}

TEST(SurveyLayout, NumbersBinsWithoutAZero) {
  EXPECT_EQ(bin_of(0, 5), 1);
  EXPECT_EQ(bin_of(5, 5), 2);
  EXPECT_EQ(bin_of(2.4, 5), 1);
  EXPECT_EQ(bin_of(-5, 5), -1);
  EXPECT_EQ(bin_of(100, 12.5), 9);
}

TEST(TraceWords, FollowTheTableOfTheFormat) {
  const TraceHeader header = header_at(1000, 850.5);
  const TraceWords words = words_from_si(header, layout_of(std::vector<TraceHeader>{header}));
  EXPECT_EQ(words.get("scalco"), -100);  // midpoint 925.25
  EXPECT_EQ(words.get("scalel"), -100);
  EXPECT_EQ(words.get("sx"), 100000);
  EXPECT_EQ(words.get("gx"), 85050);
  EXPECT_EQ(words.get("cdpx"), 92525);
  EXPECT_EQ(words.get("sdepth"), 1250);
  EXPECT_EQ(words.get("gelev"), -250);
  EXPECT_EQ(words.get("swdep"), 45000);
  EXPECT_EQ(words.get("offset"), -150);  // 149.5 to the next whole metre, the receiver before the source
  EXPECT_EQ(words.get("trid"), 12);
  EXPECT_EQ(words.get("unit"), 6);
  EXPECT_EQ(words.get("fldr"), 3);
  EXPECT_EQ(words.get("ep"), 3);
  EXPECT_EQ(words.get("tracf"), 17);
  EXPECT_EQ(words.get("counit"), 1);
}

TEST(TraceWords, GiveTheSameSiBack) {
  FileHeader file;
  file.major = 1;
  for (const auto& row : component_rows()) {
    const Component component = row.component;
    TraceHeader header = header_at(1234.5, -77.25);
    header.component = component;
    header.source_m[1] = 3;
    const TraceHeader back =
        si_from_words(words_from_si(header, layout_of(std::vector<TraceHeader>{header})), file);
    EXPECT_EQ(back.component, component);
    EXPECT_EQ(back.source_m, header.source_m);
    EXPECT_EQ(back.receiver_m, header.receiver_m);
    EXPECT_EQ(back.water_depth_source_m, 450);
    EXPECT_EQ(back.shot, 3);
    EXPECT_EQ(back.channel, 17);
  }
}

TEST(TraceWords, SayTheUnitOfEachComponent) {
  const auto unit_of_trace = [](Component component) {
    TraceHeader header = header_at(1234.5, -77.25);
    header.component = component;
    return words_from_si(header, layout_of(std::vector<TraceHeader>{header})).get("unit");
  };
  EXPECT_EQ(unit_of_trace(Component::p), 1);
  EXPECT_EQ(unit_of_trace(Component::ux), 5);
  EXPECT_EQ(unit_of_trace(Component::vz), 6);
  EXPECT_EQ(unit_of_trace(Component::az), 7);
  EXPECT_EQ(unit_of_trace(Component::das), -1);
}

TEST(TraceWords, ApplyScalarsFeetAndTheTimeScalar) {
  EXPECT_EQ(scaled(12, 100), 1200);
  EXPECT_EQ(scaled(12, -100), 0.12);
  EXPECT_EQ(scaled(12, 0), 12);
  FileHeader file;
  file.major = 1;
  file.feet = true;
  TraceWords words;
  words.set("gx", 1000);
  words.set("delrt", 10000);
  words.set("tscal", -10);
  EXPECT_DOUBLE_EQ(si_from_words(words, file).receiver_m[0], 304.8);
  EXPECT_DOUBLE_EQ(start_s(words, file), 1);
  file.major = 0;  // byte 215 is free there
  EXPECT_DOUBLE_EQ(start_s(words, file), 10);
}

TEST(Sniff, TakesNoNetcdfForSeismicUnix) {
  std::vector<std::uint8_t> trace(240 + 4 * 10, 0);
  trace[115] = 10;  // ns, big-endian
  EXPECT_EQ(kind_of(trace, trace.size()), FileKind::su);
  for (const std::string_view signature : {"\x89HDF\r\n\x1a\n", "CDF\x01", "CDF\x02", "CDF\x05"}) {
    std::copy(signature.begin(), signature.end(), trace.begin());
    EXPECT_EQ(kind_of(trace, trace.size()), FileKind::unknown) << signature;
  }
}

}  // namespace slipwave::segy_header_test
