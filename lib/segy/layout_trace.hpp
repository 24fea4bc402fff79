// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "segy/field.hpp"

namespace slipwave::segy {

/// The 240 bytes before the samples of a trace. Bytes 181 to 240 are free in revision 0, and Seismic Unix
/// keeps other things there.
struct TraceLayout {
  static constexpr int first = 1;
  static constexpr int size = 240;
  static constexpr auto fields = [] {
    using enum FieldType;
    return std::to_array<Field>({
        {"tracl", 1, i4, "trace number within the line"},
        {"tracr", 5, i4, "trace number within the file"},
        {"fldr", 9, i4, "field record number (shot)"},
        {"tracf", 13, i4, "trace number within the field record (channel)"},
        {"ep", 17, i4, "energy source point number"},
        {"cdp", 21, i4, "ensemble number (midpoint bin)"},
        {"cdpt", 25, i4, "trace number within the ensemble"},
        {"trid", 29, i2, "trace identification code (component)"},
        {"nvs", 31, i2, "vertically summed traces"},
        {"nhs", 33, i2, "horizontally stacked traces"},
        {"duse", 35, i2, "data use: 1 production, 2 test"},
        {"offset", 37, i4, "signed distance from source to receiver"},
        {"gelev", 41, i4, "receiver elevation (scalel)"},
        {"selev", 45, i4, "surface elevation at the source (scalel)"},
        {"sdepth", 49, i4, "source depth below the surface (scalel)"},
        {"gdel", 53, i4, "datum elevation at the receiver (scalel)"},
        {"sdel", 57, i4, "datum elevation at the source (scalel)"},
        {"swdep", 61, i4, "water depth at the source (scalel)"},
        {"gwdep", 65, i4, "water depth at the receiver (scalel)"},
        {"scalel", 69, i2, "scalar of elevations and depths: > 0 multiplies, < 0 divides"},
        {"scalco", 71, i2, "scalar of coordinates: > 0 multiplies, < 0 divides"},
        {"sx", 73, i4, "source coordinate x (scalco)"},
        {"sy", 77, i4, "source coordinate y (scalco)"},
        {"gx", 81, i4, "receiver coordinate x (scalco)"},
        {"gy", 85, i4, "receiver coordinate y (scalco)"},
        {"counit", 89, i2, "coordinate units: 1 length, 2 seconds of arc, 3 degrees, 4 DMS"},
        {"wevel", 91, i2, "weathering velocity"},
        {"swevel", 93, i2, "subweathering velocity"},
        {"sut", 95, i2, "uphole time at the source, ms (tscal)"},
        {"gut", 97, i2, "uphole time at the receiver, ms (tscal)"},
        {"sstat", 99, i2, "source static correction, ms (tscal)"},
        {"gstat", 101, i2, "receiver static correction, ms (tscal)"},
        {"tstat", 103, i2, "total static applied, ms (tscal)"},
        {"laga", 105, i2, "lag time A, ms (tscal)"},
        {"lagb", 107, i2, "lag time B, ms (tscal)"},
        {"delrt", 109, i2, "delay from the source to the first sample, ms (tscal)"},
        {"muts", 111, i2, "mute start, ms (tscal)"},
        {"mute", 113, i2, "mute end, ms (tscal)"},
        {"ns", 115, u2, "samples of this trace"},
        {"dt", 117, u2, "sample interval of this trace, us"},
        {"gain", 119, i2, "gain type of the field instruments"},
        {"igc", 121, i2, "instrument gain constant, dB"},
        {"igi", 123, i2, "instrument initial gain, dB"},
        {"corr", 125, i2, "correlated: 1 no, 2 yes"},
        {"sfs", 127, i2, "sweep frequency at start, Hz"},
        {"sfe", 129, i2, "sweep frequency at end, Hz"},
        {"slen", 131, i2, "sweep length, ms"},
        {"styp_sweep", 133, i2, "sweep type"},
        {"stas", 135, i2, "sweep taper length at start, ms"},
        {"stae", 137, i2, "sweep taper length at end, ms"},
        {"tatyp", 139, i2, "taper type"},
        {"afilf", 141, i2, "alias filter frequency, Hz"},
        {"afils", 143, i2, "alias filter slope, dB/octave"},
        {"nofilf", 145, i2, "notch filter frequency, Hz"},
        {"nofils", 147, i2, "notch filter slope, dB/octave"},
        {"lcf", 149, i2, "low cut frequency, Hz"},
        {"hcf", 151, i2, "high cut frequency, Hz"},
        {"lcs", 153, i2, "low cut slope, dB/octave"},
        {"hcs", 155, i2, "high cut slope, dB/octave"},
        {"year", 157, i2, "year of the recording"},
        {"day", 159, i2, "day of the year"},
        {"hour", 161, i2, "hour of the day"},
        {"minute", 163, i2, "minute of the hour"},
        {"sec", 165, i2, "second of the minute"},
        {"timbas", 167, i2, "time basis code"},
        {"trwf", 169, i2, "trace weighting factor"},
        {"grnors", 171, i2, "geophone group number of roll switch position one"},
        {"grnofr", 173, i2, "geophone group number of trace one of the field record"},
        {"grnlof", 175, i2, "geophone group number of the last trace of the field record"},
        {"gaps", 177, i2, "gap size (groups dropped)"},
        {"otrav", 179, i2, "over travel of the taper"},
        {"cdpx", 181, i4, "ensemble coordinate x (scalco)"},
        {"cdpy", 185, i4, "ensemble coordinate y (scalco)"},
        {"iline", 189, i4, "in-line number"},
        {"xline", 193, i4, "cross-line number"},
        {"sp", 197, i4, "shot point number (spscal)"},
        {"spscal", 201, i2, "scalar of the shot point number"},
        {"unit", 203, i2, "unit of the samples: 1 Pa, 5 m, 6 m/s, 7 m/s2, -1 other"},
        {"tdcm", 205, i4, "transduction constant, mantissa"},
        {"tdce", 209, i2, "transduction constant, power of ten"},
        {"tdcu", 211, i2, "transduction unit"},
        {"devid", 213, i2, "device or trace identifier"},
        {"tscal", 215, i2, "scalar of the times in bytes 95 to 114"},
        {"styp", 217, i2, "source type and orientation"},
        {"sdir1", 219, i2, "source energy direction, vertical"},
        {"sdir2", 221, i2, "source energy direction, cross-line"},
        {"sdir3", 223, i2, "source energy direction, in-line"},
        {"smm", 225, i4, "source measurement, mantissa"},
        {"sme", 229, i2, "source measurement, power of ten"},
        {"smu", 231, i2, "source measurement unit"},
    });
  }();
};

}  // namespace slipwave::segy
