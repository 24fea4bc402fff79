#!/bin/sh
# completion.sh TOOL OUTPUT [EMULATOR...]: writes the bash completion of a tool, made from what its --help-all says.
#   a|b|c                 one of them
#   NAME                  one of those that the text ends in, "...: a, b, c"
#   LIST                  several of those that the text ends in, "...: a, b, c" or "of a, b, c"
#   FILE, MODEL, ..., -o  file names; every other value is the user's own
set -eu
program=$1
output=$2
shift 2
tool=$(basename "$program")
help=$("$@" "$program" --help-all)
printf '%s\n' "$help" | awk -v tool="$tool" '
  # "a, b, c" behind a word of the text, up to the end of the clause; nothing where the list ends with "...".
  function names_in(text) {
    sub(/[;\[(].*/, "", text)
    if (text !~ /^ *[a-z0-9_-]+(, [a-z0-9_-]+)+ *$/) return ""
    gsub(/, */, " ", text)
    gsub(/^ +| +$/, "", text)
    return text
  }
  function done(    choices) {
    if (names == "" || value == "") return
    if (value ~ /^[a-z0-9][a-z0-9-]*([|][a-z0-9][a-z0-9-]*)*$/) {
      gsub(/[|]/, " ", value)
      words = words "    " names ") choices=\"" value "\" ;;\n"
    } else if (value == "LIST" || value == "NAME") {
      sub(/^.*: /, "", text)
      sub(/^(.* )?of /, "", text)
      choices = names_in(text)
      if (choices != "")
        words = words "    " names ") choices=\"" choices "\"" (value == "LIST" ? " list=yes" : "") " ;;\n"
    } else if (value ~ /^(FILE|GATHER|MODEL|TABLE|M|F)$/ || names ~ /--(output|config)$/) {
      files = files (files == "" ? "" : " | ") names
      return
    }
    valued = valued (valued == "" ? "" : " | ") names
  }
  # "  -o, --output FILE   text": names, and what stands for the value.
  /^  (-., )?--[a-z]/ {
    done()
    line = $0
    sub(/^  /, "", line)
    text = line
    if (!sub(/^.*[^ ]   */, "", text)) text = ""
    sub(/  .*/, "", line)
    count = split(line, word, " ")
    names = value = ""
    for (i = 1; i <= count; ++i) {
      sub(/,$/, "", word[i])
      if (word[i] ~ /^-/) {
        names = names (names == "" ? "" : " | ") word[i]
        if (word[i] ~ /^--/) all = all (all == "" ? "" : " ") word[i]
      } else {
        value = word[i]
      }
    }
    next
  }
  /^   / { sub(/^ +/, ""); text = text " " $0; next }
  { done(); names = "" }
  END {
    done()
    if (all == "") {
      print tool ": --help-all shows no options" > "/dev/stderr"
      exit 1
    }
    name = tool
    gsub(/-/, "_", name)
    print "# bash completion of " tool ", made from its --help-all."
    print "_" name "() {"
    print "  local word=$2 before=$3 choices=\"\" list=\"\" begun=\"\""
    print "  COMPREPLY=()"
    print "  # --name=value comes in three words."
    print "  if [[ $word == = ]]; then"
    print "    word="
    print "  elif [[ $before == = ]]; then"
    print "    before=${COMP_WORDS[COMP_CWORD - 2]}"
    print "  fi"
    print "  case $before in"
    printf "%s", words
    print "  esac"
    print "  if [[ $choices ]]; then"
    print "    if [[ $list ]]; then"
    print "      compopt -o nospace"
    print "      if [[ $word == *,* ]]; then begun=${word%,*},; fi"
    print "    fi"
    print "    mapfile -t COMPREPLY < <(compgen -P \"$begun\" -W \"$choices\" -- \"${word#\"$begun\"}\")"
    print "    compopt +o default"
    print "    return"
    print "  fi"
    print "  case $before in"
    if (files != "") print "    " files ") return ;; # file names"
    if (valued != "") print "    " valued ") compopt +o default; return ;; # nothing to choose from"
    print "  esac"
    print "  if [[ $word == -* ]]; then"
    print "    mapfile -t COMPREPLY < <(compgen -W \"" all "\" -- \"$word\")"
    print "  fi"
    print "}"
    print "complete -o default -F _" name " " tool
  }' > "$output.part"
mv "$output.part" "$output"
