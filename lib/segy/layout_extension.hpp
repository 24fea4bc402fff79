// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "segy/field.hpp"

namespace slipwave::segy {

/// Trace header extension 1 of revision 2, the 240 bytes that may follow a trace header (byte 3507): words
/// that are too narrow there. One that is not 0 takes the place of the standard header's. The last eight
/// bytes hold its name, SEG00001.
struct ExtensionLayout {
  static constexpr int first = 1;
  static constexpr int size = 240;
  static constexpr auto fields = [] {
    using enum FieldType;
    return std::to_array<Field>({
        {"xtracl", 1, u8, "trace number within the line"},
        {"xtracr", 9, u8, "trace number within the file"},
        {"xfldr", 17, i8, "field record number (shot)"},
        {"xcdp", 25, i8, "ensemble number"},
        {"xgelev", 33, f8, "receiver elevation"},
        {"xgdepth", 41, f8, "receiver depth below the surface"},
        {"xselev", 49, f8, "surface elevation at the source"},
        {"xsdepth", 57, f8, "source depth below the surface"},
        {"xgdel", 65, f8, "datum elevation at the receiver"},
        {"xsdel", 73, f8, "datum elevation at the source"},
        {"xswdep", 81, f8, "water depth at the source"},
        {"xgwdep", 89, f8, "water depth at the receiver"},
        {"xsx", 97, f8, "source coordinate x"},
        {"xsy", 105, f8, "source coordinate y"},
        {"xgx", 113, f8, "receiver coordinate x"},
        {"xgy", 121, f8, "receiver coordinate y"},
        {"xoffset", 129, f8, "distance from source to receiver"},
        {"xns", 137, u4, "samples of this trace"},
        {"nanoseconds", 141, i4, "nanoseconds to add to the second of the recording"},
        {"xdt", 145, f8, "sample interval of this trace, us"},
        {"cable", 153, i4, "cable number or identifier of the recorder"},
        {"headers", 157, u2, "additional headers of this trace"},
        {"last", 159, i2, "last trace flag"},
        {"xcdpx", 161, f8, "ensemble coordinate x"},
        {"xcdpy", 169, f8, "ensemble coordinate y"},
    });
  }();
};

}  // namespace slipwave::segy
