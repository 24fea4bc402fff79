#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# completion.sh TOOL FOLDER [EMULATOR...]: writes the completions of a tool for bash (bash/TOOL), zsh (zsh/_TOOL) and fish
# (fish/TOOL.fish), all made from one table of what its --help-all says:
#   a|b|c                 one of them
#   NAME                  one of those that the text ends in, "...: a, b, c"
#   LIST                  several of those that the text ends in, "...: a, b, c" or "of a, b, c"
#   FILE, MODEL, ..., -o  file names; every other value is the user's own
set -eu
program=$1
folder=$2
shift 2
tool=$(basename "$program")
help=$("$@" "$program" --help-all)
mkdir -p "$folder/bash" "$folder/zsh" "$folder/fish"

# A line of each option, with tabs between: names with blanks between, switch|one|list|file|own, choices, text.
table=$(printf '%s\n' "$help" | awk '
  # "a, b, c" behind a word of the text, up to the end of the clause; nothing where the list ends with "...".
  function names_in(text) {
    sub(/[;\[(].*/, "", text)
    if (text !~ /^ *[a-z0-9_-]+(, [a-z0-9_-]+)+ *$/) return ""
    gsub(/, */, " ", text)
    gsub(/^ +| +$/, "", text)
    return text
  }
  function done(    kind, choices, end) {
    if (names == "") return
    kind = value == "" ? "switch" : "own"
    choices = ""
    if (value ~ /^[a-z0-9][a-z0-9-]*([|][a-z0-9][a-z0-9-]*)*$/) {
      kind = "one"
      choices = value
      gsub(/[|]/, " ", choices)
    } else if (value == "LIST" || value == "NAME") {
      end = text
      sub(/^.*: /, "", end)
      sub(/^(.* )?of /, "", end)
      choices = names_in(end)
      if (choices != "") kind = value == "LIST" ? "list" : "one"
    } else if (value ~ /^(FILE|GATHER|MODEL|TABLE|M|F)$/ || names ~ /--(output|config)$/) {
      kind = "file"
    }
    gsub(/\t/, " ", text)
    print names "\t" kind "\t" choices "\t" text
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
      if (word[i] ~ /^-/)
        names = names (names == "" ? "" : " ") word[i]
      else
        value = word[i]
    }
    next
  }
  /^   / { sub(/^ +/, ""); text = text (text == "" ? "" : " ") $0; next }
  { done(); names = "" }
  END { done() }')
[ -n "$table" ] || { echo "$tool: --help-all shows no options" >&2; exit 1; }

# written FILE AWK...: what awk makes of the table becomes that file at once.
written() {
  file=$1
  shift
  printf '%s\n' "$table" | awk -F '\t' -v tool="$tool" -v quote="'" "$@" > "$file.part"
  mv "$file.part" "$file"
}

written "$folder/bash/$tool" '
  {
    cases = $1
    gsub(/ /, " | ", cases)
    count = split($1, name, " ")
    for (i = 1; i <= count; ++i) if (name[i] ~ /^--/) all = all (all == "" ? "" : " ") name[i]
    if ($2 == "one" || $2 == "list")
      words = words "    " cases ") choices=\"" $3 "\"" ($2 == "list" ? " list=yes" : "") " ;;\n"
    if ($2 == "file") files = files (files == "" ? "" : " | ") cases
    if ($2 != "file" && $2 != "switch") valued = valued (valued == "" ? "" : " | ") cases
  }
  END {
    function_name = tool
    gsub(/-/, "_", function_name)
    print "# bash completion of " tool ", made from its --help-all."
    print "_" function_name "() {"
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
    print "complete -o default -F _" function_name " " tool
  }'

# In zsh and fish every option has its text; without quotes.
written "$folder/zsh/_$tool" '
  BEGIN {
    print "#compdef " tool
    print "# zsh completion of " tool ", made from its --help-all."
    print "_arguments -s -S \\"
  }
  {
    text = $4
    gsub(quote, "", text)
    gsub(/[][\\:]/, "\\\\&", text)
    action = ""
    if ($2 == "own") action = ":value:"
    if ($2 == "file") action = ":file:_files"
    if ($2 == "list") action = ":list:_values -s , name " $3
    if ($2 == "one") action = ":value:(" $3 ")"
    count = split($1, name, " ")
    for (i = 1; i <= count; ++i)
      print "  " quote "*" name[i] (action != "" && name[i] ~ /^--/ ? "=" : "") "[" text "]" action quote " \\"
  }
  END { print "  " quote "*:file:_files" quote }'

written "$folder/fish/$tool.fish" '
  BEGIN { print "# fish completion of " tool ", made from its --help-all." }
  {
    text = $4
    gsub(/\\/, "", text)
    gsub(quote, "", text)
    count = split($1, name, " ")
    option = ""
    for (i = 1; i <= count; ++i) {
      word = name[i]
      option = option (sub(/^--/, "", word) ? " -l " : " -s ")
      sub(/^-/, "", word)
      option = option word
    }
    values = $2 == "switch" ? "" : $2 == "file" ? " -r -F" : " -x"
    if ($2 == "one") values = values " -a " quote $3 quote
    # Of a list fish offers what is typed so far, and each name behind it.
    if ($2 == "list")
      values = values " -a " quote "(string replace -r -- \"[^,]*\\z\" \"\" (commandline -ct | string replace -r -- \"^--[a-z-]*=\" \"\"))" \
               "{" joined($3) "}" quote
    print "complete -c " tool option values " -d " quote text quote
  }
  function joined(names) { gsub(/ /, ",", names); return names }'
