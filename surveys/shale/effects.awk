# SPDX-License-Identifier: BSD-3-Clause
# NRMS of the reflections by NAME.txt of sw-compare, and processor times by NAME.times, the output of `times`, whose second line is
# of the programs that were run: user and system, each as 0m1.23s. elastic.times is what the others are divided by.
function seconds(text,  part) {
  split(text, part, "m")
  return 60 * part[1] + part[2]
}
FNR == 1 {
  name = FILENAME
  sub(/.*\//, "", name)
  timed = sub(/\.times$/, "", name)
  if (sub(/\.txt$/, "", name)) names[++count] = name
}
timed && FNR == 2 { spent[name] = seconds($1) + seconds($2) }
$1 == "all" { nrms[name] = $3 }
END {
  print "# effect        against     NRMS of reflections, %   times its time"
  for (n = 1; n <= count; n++) {
    name = names[n]
    with = name == "tilt" ? "tilted" : name
    against = name == "tilt" ? "vertical" : "elastic"
    if (spent[against] > 0) ratio = sprintf("%.2f", spent[with] / spent[against])
    else ratio = "too short to say"
    printf "%-15s %-8s %25.1f %16s\n", name, against, nrms[name], ratio
  }
}
