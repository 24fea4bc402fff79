// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "gather/trace.hpp"
#include "io/output_file.hpp"
#include "segy/reader.hpp"
#include "segy/writer.hpp"

namespace slipwave::segy {

/// Two shots of `receivers` receivers and the components of a 2-D run, samples whole numbers that every
/// format holds.
inline Gather survey_gather(std::int64_t samples = 51, int receivers = 4, double interval_s = 0.002) {
  Gather gather{{samples, interval_s, 0}, {}};
  for (int shot = 1; shot <= 2; ++shot)
    for (const Component component :
         {Component::vx, Component::vz, Component::p, Component::sxx, Component::szz, Component::sxz})
      for (int channel = 1; channel <= receivers; ++channel) {
        slipwave::Trace trace;
        trace.header.shot = shot;
        trace.header.channel = channel;
        trace.header.component = component;
        trace.header.source_m = {1000.0 + 50 * shot, 0, 7.5};
        trace.header.receiver_m = {900.0 + 12.5 * channel, 0, 2.5};
        trace.header.water_depth_source_m = trace.header.water_depth_receiver_m = 450;
        for (std::int64_t n = 0; n < samples; ++n)
          trace.samples.push_back(static_cast<double>((7 * n + 3 * channel + shot) % 101));
        gather.traces.push_back(trace);
      }
  return gather;
}

inline void write_file(const std::string& path, const Gather& gather, const FileFormat& format) {
  OutputFile out(path, OutputFile::Content::binary);
  write_gather(out, gather, format,
               {{"slipwave test"}, "sw-shoot model.nc --source 1050,7.5 -o {component}.sgy"});
  out.commit();
}

inline Gather read_file(const std::string& path, const ReadOptions& options = {}) {
  Reader reader(path, options);
  Gather gather{reader.axis(), {}};
  Trace trace;
  while (reader.next(trace)) gather.traces.push_back({reader.si_header(trace), trace.samples});
  return gather;
}

}  // namespace slipwave::segy
