// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "segy/field.hpp"

namespace slipwave::segy {

/// The 400 bytes after the textual header. Fields from 3261 on (except 3501 to 3506) exist since revision 2.
struct BinaryLayout {
  static constexpr int first = 3201;
  static constexpr int size = 400;
  static constexpr auto fields = [] {
    using enum FieldType;
    return std::to_array<Field>({
        {"job", 3201, i4, "job identification number"},
        {"line", 3205, i4, "line number"},
        {"reel", 3209, i4, "reel number"},
        {"ntrpr", 3213, i2, "data traces per ensemble"},
        {"nart", 3215, i2, "auxiliary traces per ensemble"},
        {"dt", 3217, u2, "sample interval, us"},
        {"dto", 3219, u2, "sample interval of the field recording, us"},
        {"ns", 3221, u2, "samples per trace"},
        {"nso", 3223, u2, "samples per trace of the field recording"},
        {"format", 3225, i2, "sample format code"},
        {"fold", 3227, i2, "ensemble fold"},
        {"sort", 3229, i2, "trace sorting: 1 as recorded, 2 common depth point, 5 common source"},
        {"vsum", 3231, i2, "vertical sum"},
        {"sweep_start", 3233, i2, "sweep frequency at start, Hz"},
        {"sweep_end", 3235, i2, "sweep frequency at end, Hz"},
        {"sweep_length", 3237, i2, "sweep length, ms"},
        {"sweep_type", 3239, i2, "sweep type"},
        {"sweep_channel", 3241, i2, "trace number of the sweep channel"},
        {"taper_start", 3243, i2, "sweep taper length at start, ms"},
        {"taper_end", 3245, i2, "sweep taper length at end, ms"},
        {"taper_type", 3247, i2, "taper type"},
        {"correlated", 3249, i2, "correlated data traces: 1 no, 2 yes"},
        {"gain_recovered", 3251, i2, "binary gain recovered: 1 yes, 2 no"},
        {"amplitude_recovery", 3253, i2, "amplitude recovery method"},
        {"mfeet", 3255, i2, "measurement system: 1 metres, 2 feet"},
        {"polarity", 3257, i2, "impulse signal polarity"},
        {"vibrator_polarity", 3259, i2, "vibratory polarity code"},
        {"xntrpr", 3261, i4, "data traces per ensemble, overrides ntrpr"},
        {"xnart", 3265, i4, "auxiliary traces per ensemble, overrides nart"},
        {"xns", 3269, i4, "samples per trace, overrides ns"},
        {"xdt", 3273, f8, "sample interval, us, overrides dt"},
        {"xdto", 3281, f8, "sample interval of the field recording, us, overrides dto"},
        {"xnso", 3289, i4, "samples per trace of the field recording, overrides nso"},
        {"xfold", 3293, i4, "ensemble fold, overrides fold"},
        {"byte_order", 3297, u4, "16909060 (0x01020304): shows the byte order"},
        {"major", 3501, u1, "major revision number"},
        {"minor", 3502, u1, "minor revision number"},
        {"fixed", 3503, i2, "1: all traces have the same length"},
        {"extended", 3505, i2, "extended textual headers, -1: up to an EndText stanza"},
        {"extra_headers", 3507, u2, "additional 240-byte headers a trace"},
        {"survey", 3509, i2, "survey type"},
        {"time_basis", 3511, i2, "time basis code"},
        {"ntraces", 3513, u8, "traces in the file"},
        {"first_trace", 3521, u8, "offset of the first trace from the start of the file, bytes"},
        {"trailers", 3529, i4, "data trailer stanzas of 3200 bytes"},
    });
  }();
};

/// The textual and the binary header.
inline constexpr std::size_t file_header_bytes = BinaryLayout::first - 1 + BinaryLayout::size;

}  // namespace slipwave::segy
