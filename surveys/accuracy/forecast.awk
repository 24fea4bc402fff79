# SPDX-License-Identifier: BSD-3-Clause
# Tables of sw-accuracy in: a line for each of measured over expected error and time, lowest and highest of its settings.
/^#/ { next }
{ time = $11 / $12; n = FILENAME; sub(/.*\//, "", n); sub(/\.txt$/, "", n) }
n != name { line(); name = n; rungs = timed = good = prompt = 0; low = early = 1e9; high = late = 0 }
{
  timed++
  if (time < early) early = time
  if (time > late) late = time
  if (time < 1.3 && time > 1 / 1.3) prompt++
}
$8 == "-" { next }
{
  ratio = $8 / $10
  rungs++
  if (ratio < low) low = ratio
  if (ratio > high) high = ratio
  if (ratio < 2 && ratio > 0.5) good++
}
END { line() }

function line() {
  if (name == "") {
    print "measured over expected       error            within a factor 2   time           within a factor 1.3"
    return
  }
  printf "%-24s %6.2f to %-8.2f %9d of %-6d %6.2f to %-6.2f %9d of %d\n", name, low, high, good, rungs, early, late, prompt, timed
}
