// SPDX-License-Identifier: BSD-3-Clause
// ringing [FILE]: one stiff cell by all rules of slip. A table of columns, or a gather of one trace each.
#include <cstdio>
#include <exception>

#include "one_cell.hpp"
#include "segy/writer.hpp"

int main(int count, char** arguments) try {
  const auto all = slipwave::histories(0.01, 150);
  if (count < 2) {
    std::printf("# step");
    for (const auto& history : all) std::printf("  %s", history.rule.c_str());
    for (std::size_t n = 0; n < all[0].rate.size(); ++n) {
      std::printf("\n%zu", n + 1);
      for (const auto& history : all) std::printf(" %.6f", history.rate[n]);
    }
    std::printf("\n");
    return 0;
  }
  slipwave::OutputFile out(arguments[1], slipwave::OutputFile::Content::binary);
  slipwave::segy::FileInfo info;
  info.axis = {std::int64_t(all[0].rate.size()), 1e-3, 1e-3};
  info.layout.traces = std::int64_t(all.size());
  slipwave::segy::Writer writer(out, info);
  for (std::size_t n = 0; n < all.size(); ++n) {
    slipwave::TraceHeader header;
    header.channel = std::int64_t(n) + 1;
    header.component = slipwave::Component::sxz;
    header.receiver_m[0] = double(n);
    writer.write(header, all[n].rate);
  }
  out.commit();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "ringing: %s\n", error.what());
  return 1;
}
