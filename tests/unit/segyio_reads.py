#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""segyio_reads.py FILE ENDIAN EXPECTED: does segyio find in FILE what EXPECTED says?

EXPECTED holds lines: "bin BYTE VALUE" of the binary header, "text LINE" (40 of them), and for every trace
"trace BYTE=VALUE ..." followed by "samples VALUE ...".
"""
import sys
import segyio

path, endian, expected = sys.argv[1:]
faults = []
compared = 0


def compare(what, found, wanted):
    global compared
    compared += 1
    if found != wanted:
        faults.append(f"{what}: segyio finds {found!r}, expected {wanted!r}")


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
for fault in faults[:10]:
    print(fault)
sys.exit(1 if faults or compared < 100 else 0)
