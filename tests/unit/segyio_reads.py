#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""segyio_reads.py FILE ENDIAN EXPECTED...: does segyio find in each FILE what its EXPECTED says?

EXPECTED holds lines: "bin BYTE VALUE" of the binary header, "text LINE" (40 of them), and for every trace
"trace BYTE=VALUE ..." followed by "samples VALUE ...".
"""
import sys
import segyio

faults = []
compared = 0
path = ""


def compare(what, found, wanted):
    global compared
    compared += 1
    if found != wanted:
        faults.append(f"{path}: {what}: segyio finds {found!r}, expected {wanted!r}")


for path, endian, expected in zip(*[iter(sys.argv[1:])] * 3):
    compared = 0
    lines = open(expected, encoding="latin-1").read().split("\n")
    with segyio.open(path, ignore_geometry=True, endian=endian) as file:
        known = {int(key) for key in file.header[0].keys()}
        text = file.text[0].decode("ascii")
        number = 0
        row = 0
        for line in lines:
            kind, _, rest = line.partition(" ")
            if kind == "bin":
                byte, value = map(int, rest.split())
                compare(f"binary header {byte}", file.bin[byte], value)
            elif kind == "text":
                compare(f"text line {row + 1}", text[80 * row:80 * row + 80], rest)
                row += 1
            elif kind == "trace":
                for word in rest.split():
                    byte, value = map(int, word.split("="))
                    # segyio 1.8.3 takes the water depth at the source for two bytes, it has four
                    if byte in known and byte != 61:
                        compare(f"trace {number + 1} byte {byte}", file.header[number][byte], value)
            elif kind == "samples":
                compare(f"trace {number + 1} samples", [float(x) for x in file.trace[number]],
                        [float(x) for x in rest.split()])
                number += 1
        compare("number of traces", file.tracecount, number)
        compare("words known to segyio", len(known) >= 85, True)
    if compared < 100:
        faults.append(f"{path}: {compared} comparisons, expected 100 at least")
for fault in faults[:10]:
    print(fault)
sys.exit(1 if faults or not path else 0)
