#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# layers.sh ROOT: includes of lib/ and among folders of lib/solver go downwards only, and each foreign library is included in its own place.
set -eu
cd "$1"
find lib tools -name '*.?pp' | sort | xargs awk '
  BEGIN {
    below["base"] = "base"
    below["io"] = below["base"] " io"
    below["parallel"] = below["base"] " parallel"
    below["grid"] = "base io parallel grid"
    below["rock"] = below["grid"] " rock"
    below["geology"] = below["rock"] " geology"
    below["fracture"] = below["grid"] " fracture"
    below["model"] = below["geology"] " fracture model"
    below["build"] = below["model"] " build"
    below["acquisition"] = below["grid"] " acquisition"
    below["gather"] = below["grid"] " gather"
    below["scene"] = below["build"] " acquisition gather scene"
    below["solver"] = below["scene"] " solver"
    below["checkpoint"] = below["solver"] " checkpoint"
    below["accuracy"] = below["scene"] " accuracy"
    below["segy"] = "base io parallel grid gather segy"
    below["traces"] = below["segy"] " grid traces"
    below["output"] = below["scene"] " output"
    below["planning"] = below["solver"] " accuracy planning"
    below["shooting"] = below["planning"] " checkpoint output segy shooting"
    below["plot"] = below["output"] " segy accuracy plot"
    below["cli"] = "base io parallel cli"
    # Folders of lib/solver; the files beside them may include all.
    inside["kernels"] = "kernels"
    inside["sweep"] = inside["kernels"] " sweep"
    inside["effect"] = inside["sweep"] " effect"
    inside["record"] = inside["sweep"] " record"
    inside["schedule"] = inside["effect"] " record schedule"
  }
  function broken(what) {
    printf "%s:%d: %s\n", FILENAME, FNR, what
    bad = 1
  }
  function only_in(library, header, place) {
    if (header !~ library) return
    if (FILENAME !~ place) broken("<" header "> belongs in " place)
  }
  FNR == 1 {
    parts = split(FILENAME, part, "/")
    room = part[1] == "lib" ? part[2] : ""
    folder = room == "solver" && parts == 4 ? part[3] : ""
    if (folder != "" && !(folder in inside)) broken("lib/solver/" folder " has no place in the order of folders")
  }
  FNR == 1 && room != "" && !(room in below) { broken("lib/" room " has no place in the order of rooms") }
  /^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\"")
    if (room == "") next
    if (quoted[2] !~ "^[a-z0-9_]+(/[a-z0-9_]+)?/[a-z0-9_]+[.]hpp$") broken("include \"" quoted[2] "\": write \"room/file.hpp\"")
    parts = split(quoted[2], part, "/")
    if (folder != "" && part[1] == "solver" && index(" " inside[folder] " ", " " (parts == 3 ? part[2] : "-") " ") == 0)
      broken("lib/solver/" folder " must not include \"" quoted[2] "\"")
    # Dispersion is that of the reconstruction that the kernels use; the header includes nothing.
    formula = room == "accuracy" && quoted[2] == "solver/kernels/reconstruction.hpp"
    if (index(" " below[room] " ", " " part[1] " ") == 0 && !formula) broken(room " must not include \"" quoted[2] "\"")
  }
  /^[ \t]*#[ \t]*include[ \t]*</ {
    header = $0
    sub(/^[^<]*</, "", header)
    sub(/>.*$/, "", header)
    only_in("^fftw", header, "^lib/base/fft[.]cpp$")
    only_in("^(tbb|oneapi)/", header, "^lib/parallel/threads[.]cpp$")
    only_in("^netcdf", header, "^lib/.*netcdf[a-z_]*[.][ch]pp$")
    only_in("^udunits2", header, "^lib/io/units[.]cpp$")
    only_in("^boost/", header, "^(lib/cli|tools)/")
    only_in("^(cairo|pango)", header, "^lib/plot/")
    only_in("^mpi[.]h", header, "^lib/parallel/ranks_mpi[.]cpp$")
  }
  END { exit bad }'
