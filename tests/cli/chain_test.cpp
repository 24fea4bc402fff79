// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::chain_test {
namespace {

using Chain = Shell;

const std::string layers = "sw-layers --size 600x600 --step 5 --layer 0:2500:1250:2200 ";
const std::string fracture = "sw-fracture - --box 200:400,400:450 --dip 45 --friction 0.1 --viscosity 0 ";
const std::string shoot =
    "sw-shoot - --source 300,100 --wavelet ricker:20 --receivers 0:600:50,10 --time 0.5 --record vx,vz ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(Chain, GoesFromLayersToInfoWithoutAFile) {
  const auto text = done(layers + "| " + fracture + "| " + shoot + "| sw-info -");
  EXPECT_TRUE(has(text, "standard input: gather\n")) << text;
  EXPECT_TRUE(has(text, "traces           26\n")) << text;
  EXPECT_TRUE(has(text, "samples a trace  501\n")) << text;
  EXPECT_EQ(files(), "");
}

TEST_F(Chain, KeepsEveryCommandInTheTextualHeader) {
  done(layers + "| " + fracture + "| " + shoot + "-o g.sgy");
  const auto text = done("head -c 3200 g.sgy | dd conv=ascii status=none");
  for (const std::string tool : {"sw-layers --size 600x600", "sw-fracture --box", "sw-shoot --source"})
    EXPECT_TRUE(has(text, tool)) << text;
}

TEST_F(Chain, TheResponseIsSilentBeforeTheWaveReachesTheCluster) {
  done(layers + "| " + fracture + "-o m.nc");
  done(shoot + "-o slip.sgy < m.nc; " + shoot + "--without slip -o elastic.sgy < m.nc");
  done("sw-diff slip.sgy elastic.sgy -o response.sgy");
  // The cluster is 300 m below the source and 390 m below the receivers: at 2500 m/s nothing comes before
  // 0.276 s. What a stencil of 3 cells a side carries ahead of the wave, three times as fast and ever
  // smaller, is no signal; before it there is nothing at all. Samples are 1 ms each.
  write("peak.sh", R"(
for trace in $(seq 0 25); do
  tail -c +$((3601 + trace * (240 + 4 * 501) + 240 + 4 * $1)) response.sgy | head -c $((4 * $2))
done | od --endian=big -An -v -w4 -t f4 | awk '{ v = $1 < 0 ? -$1 : $1; if (v > top) top = v } END { print top + 0 }'
)");
  const auto peak = [&](const std::string& window) { return std::stod(done("bash peak.sh " + window)); };
  EXPECT_EQ(peak("0 80"), 0);
  EXPECT_GT(peak("300 200"), 0);
  EXPECT_LT(peak("80 180"), 1e-3 * peak("300 200"));
}

TEST_F(Chain, ResponsesAreComparedAndTransformed) {
  done(layers + "| " + fracture + "-o m.nc");
  done(shoot + "-o slip.sgy < m.nc; " + shoot + "--without slip -o elastic.sgy < m.nc");
  done("sw-compare slip.sgy slip.sgy --tolerance 0 > /dev/null");
  const Ran differ = run("sw-compare slip.sgy elastic.sgy --tolerance 0");
  EXPECT_EQ(differ.code, 1);
  for (const char* line : {"\n     all vx ", "\n     all vz "})
    EXPECT_TRUE(has(differ.out, line)) << line << " in\n" << differ.out;
  done("sw-diff slip.sgy elastic.sgy | sw-spectrum --text - > spectrum.txt; test -s spectrum.txt");
  done("sw-diff slip.sgy elastic.sgy | sw-spectrum - -o spectrum.nc; test -s spectrum.nc");
  // Without fractures there is no response at all.
  done(layers + "-o intact.nc; " + shoot + "-o a.sgy < intact.nc; " + shoot +
       "--without slip -q -o b.sgy < intact.nc; sw-compare a.sgy b.sgy --tolerance 0 > /dev/null");
}

}  // namespace slipwave::chain_test
