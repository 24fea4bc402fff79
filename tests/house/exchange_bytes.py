#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""exchange_bytes.py: are the words where docs/exchange.md tells other programs to look? Run in the folder of its recipes;
reads bytes by numpy alone. The survey: shots at x = 100, 200, 300 m, receivers every 20 m from 0 to 600 m, vz and vx."""
import sys

import numpy

WORDS = {1: "i4", 5: "i4", 9: "i4", 13: "i4", 21: "i4", 29: "i2", 37: "i4", 41: "i4", 49: "i4", 69: "i2", 71: "i2", 73: "i4",
         77: "i4", 81: "i4", 85: "i4", 109: "i2", 115: "u2", 117: "u2", 181: "i4", 185: "i4", 189: "i4", 193: "i4"}
faults = []


def expect(true, what):
    if not numpy.all(true):
        faults.append(what)


def traces(name, start=3600, order=">"):
    """Bytes of the file headers, words by byte, samples as unsigned numbers of four bytes."""
    raw = numpy.fromfile(name, numpy.uint8)
    samples = int(raw[start + 114:start + 116].view(order + "u2")[0])
    rows = raw[start:].reshape(-1, 240 + 4 * samples)
    at = {byte: rows[:, byte - 1:byte - 1 + int(kind[1])].copy().view(order + kind)[:, 0].astype(int) for byte, kind in WORDS.items()}
    return raw[:start], at, rows[:, :240], rows[:, 240:].copy().view(order + "u4")


def binary(head, byte):
    return int.from_bytes(bytes(head[byte - 1:byte + 1]), "big", signed=True)


head, survey, _, samples = traces("survey.sgy")
expect(binary(head, 3225) == 5 and bytes(head[3500:3502]) == b"\1\0" and binary(head, 3503) == 1 and binary(head, 3505) == 0,
       "survey: IEEE, revision 1, one length, no extended headers")
scale = {byte: -survey[byte] if (survey[byte] < 0).all() else 1 for byte in (69, 71)}
shot, channel, component = survey[9], survey[13], survey[29]
order = [(s, c, n) for s in (1, 2, 3) for c in (12, 14) for n in range(1, 32)]
expect(list(zip(shot, component, channel)) == order, "survey: 9, 29, 13 are shot, component and channel")
expect(survey[73] / scale[71] == 100 * shot, "survey: 73 is x of the source")
expect(survey[81] / scale[71] == 20 * (channel - 1), "survey: 81 is x of the receiver")
expect((survey[77] == 0) & (survey[85] == 0) & (survey[185] == 0), "survey: y")
expect((survey[49] / scale[69] == 20) & (survey[41] / scale[69] == -10), "survey: depth and elevation")
expect(survey[37] == 20 * (channel - 1) - 100 * shot, "survey: 37 is the offset with its sign")
expect(survey[181] / scale[71] == (survey[73] + survey[81]) / 2 / scale[71], "survey: 181 is the midpoint")
expect(survey[21] == survey[181] / scale[71] / 10 + 1, "survey: 21 counts bins of 10 m")
expect((survey[189] == shot) & (survey[193] == component), "survey: inline and crossline")
expect((survey[109] == 0) & (survey[115] == 301) & (survey[117] == 1000), "survey: sampling")
expect(len(set(zip(shot[component == 12], channel[component == 12]))) == 93, "survey: shot and channel name a trace of one component")

head, line, _, ieee = traces("line.sgy")
expect(sorted(zip(line[21], line[37])) == list(zip(line[21], line[37])) and len(line[21]) == 93, "line: sorted by midpoint and offset")
head, _, _, ibm = traces("ibm.sgy")
fraction = (ibm & 0xFFFFFF) * 2.0 ** -24 * 16.0 ** ((ibm >> 24 & 0x7F).astype(float) - 64) * numpy.where(ibm >> 31, -1, 1)
expect(binary(head, 3225) == 1 and numpy.allclose(fraction, ieee.view(">f4"), rtol=1e-6, atol=0), "ibm: format 1, the same samples")
expect(bytes(traces("ascii.sgy")[0][:3]) == b"C 1", "ascii: text")

_, su, headers, su_samples = traces("gather.su", 0, "=")
_, gather, _, samples = traces("gather.sgy")
expect(numpy.array_equal(su_samples, samples), "Seismic Unix: samples in the order of this machine")
expect(all(numpy.array_equal(su[byte], gather[byte]) for byte in WORDS if byte < 181), "Seismic Unix: header words")
expect(headers[:, 180:] == 0, "Seismic Unix: bytes 181 to 240 are zero")

_, well, _, _ = traces("well.sgy")
expect((well[189] == well[29]) & (well[193] == well[13]), "well: component and channel")
_, area, _, _ = traces("area.sgy")
lines = (2 * area[181] / 1, area[185] / 1)
expect([len(set(area[189])), len(set(area[193]))] == [len(set(lines[1])), len(set(lines[0]))], "area: bins of y and x")
_, volume, _, _ = traces("volume.sgy")
expect(volume[81] * 1.0 / (-volume[71] if volume[71][0] < 0 else 1) == 10 * volume[193] - 5, "volume: crossline along x")
expect(volume[85] * 1.0 / (-volume[71] if volume[71][0] < 0 else 1) == 10 * volume[189] - 5, "volume: inline along y")

for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
