// SPDX-License-Identifier: BSD-3-Clause
#include "segy/text.hpp"

#include <algorithm>
#include <cstdio>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave::segy {
namespace {

constexpr std::size_t width = text_columns - text_prefix;
constexpr std::size_t free_lines = text_lines - 2;

std::string numbered(std::size_t index, const std::string& content) {
  char number[16];
  std::snprintf(number, sizeof number, "C%2u ", static_cast<unsigned>(index + 1));
  std::string line = number + content;
  line.resize(text_columns, ' ');
  return line;
}

char transliterated(char character) {
  switch (character) {
    case '[':
      return '(';
    case ']':
      return ')';
    case '|':
      return '/';
    case '\t':
      return ' ';
    case '!':
    case '^':
      return '.';
    default:
      return character >= ' ' && character <= '~' ? character : '.';
  }
}

/// The columns of one entry: broken at blanks where there are some, what follows the first line indented by
/// two columns, and by one where a word was broken.
std::vector<std::string> wrapped(const std::string& entry) {
  std::string rest = entry;
  std::transform(rest.begin(), rest.end(), rest.begin(), transliterated);
  std::vector<std::string> lines;
  std::string indent;
  while (true) {
    const std::size_t room = width - indent.size();
    if (rest.size() <= room) {
      lines.push_back(indent + rest);
      return lines;
    }
    std::size_t cut = rest.rfind(' ', room);
    if (cut == std::string::npos || cut == 0) cut = room;
    lines.push_back(indent + rest.substr(0, cut));
    const bool at_blank = rest[cut] == ' ';
    rest.erase(0, at_blank ? cut + 1 : cut);
    indent = at_blank ? "  " : " ";
  }
}

std::string stamp(int revision) {
  return revision >= 2 ? "SEG-Y REV2.1" : "SEG Y REV" + std::to_string(revision);
}

bool is_blank(char character) { return character <= ' ' || character > '~'; }

/// What stands behind the line's number; control characters at its ends count as blanks.
std::string content_of(std::string_view line) {
  if (line.size() > 3 && (line[0] == 'C' || line[0] == 'c')) line.remove_prefix(3);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return std::string(line);
}

bool may_be_stamped(const std::string& content) {
  return content.empty() || content.starts_with("SEG Y REV") || content.starts_with("SEG-Y REV") ||
         content.starts_with("SEG-Y_REV") || content.starts_with("END TEXTUAL HEADER") ||
         content.starts_with("END EBCDIC");
}

/// Puts `lines` into the 38 free ones from `from` on, so that the last `kept` of them are there whatever the
/// room.
void fill(std::vector<std::string>& into, std::size_t from, const std::vector<std::string>& lines,
          std::size_t kept) {
  const std::size_t room = free_lines - from;
  if (lines.size() <= room) {
    for (std::size_t i = 0; i < lines.size(); ++i) into[from + i] = numbered(from + i, lines[i]);
    return;
  }
  kept = std::min(kept, free_lines - 1);
  const std::size_t gap = free_lines - kept - 1;  // the line "..."
  for (std::size_t i = from; i < gap; ++i) into[i] = numbered(i, lines[i - from]);
  into[gap] = numbered(gap, "...");
  for (std::size_t i = 0; i < kept; ++i)
    into[gap + 1 + i] = numbered(gap + 1 + i, lines[lines.size() - kept + i]);
}

std::vector<std::string> header_lines(std::string_view text) {
  if (text.size() != text_bytes)
    throw Error("a textual header of " + std::to_string(text.size()) + " characters, expected 3200");
  return lines_of(text);
}

}  // namespace

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at + text_columns <= text.size(); at += text_columns)
    lines.emplace_back(text.substr(at, text_columns));
  return lines;
}

std::string lay_out_text(std::span<const std::string> entries, int revision) {
  std::vector<std::string> lines;
  std::size_t of_last = 0;
  for (const std::string& entry : entries) {
    const std::vector<std::string> more = wrapped(entry);
    of_last = more.size();
    lines.insert(lines.end(), more.begin(), more.end());
  }
  std::vector<std::string> laid(text_lines);
  for (std::size_t i = 0; i < text_lines; ++i) laid[i] = numbered(i, "");
  fill(laid, 0, lines, of_last);
  laid[38] = numbered(38, stamp(revision));
  laid[39] = numbered(39, "END TEXTUAL HEADER");
  return joined_by(laid, "");
}

std::string lay_out_text(std::span<const std::string> entries, std::span<const std::string> always,
                         int revision) {
  std::vector<std::string> all(entries.begin(), entries.end());
  all.insert(all.end(), always.begin(), always.end());
  std::vector<std::vector<std::string>> first;
  std::size_t lines = 0, rest = 0;
  for (const std::string& entry : entries) lines += first.emplace_back(wrapped(entry)).size();
  for (const std::string& entry : always) rest += wrapped(entry).size();
  if (lines + rest <= free_lines) return lay_out_text(all, revision);
  constexpr std::size_t room_for_tools = 4, beginning = 3;
  const std::size_t most = free_lines - std::min(free_lines, rest + room_for_tools);
  const auto longer = [](const auto& one, const auto& other) { return one.size() < other.size(); };
  while (lines > most) {
    const auto longest = std::max_element(first.begin(), first.end(), longer);
    if (longest->size() > beginning) {
      longest->pop_back();
      longest->back() = "  ...";
    } else if (first.size() > beginning) {
      // The command that came last says most; a line "..." stands for those before it.
      const std::vector<std::string> gap = {"..."};
      const auto last_but_one = first.end() - 2;
      const auto victim = *last_but_one == gap ? last_but_one - 1 : last_but_one;
      lines -= victim->size();
      if (victim != last_but_one) {
        first.erase(victim);
      } else {
        *victim = gap;
        ++lines;
      }
      continue;
    } else {
      break;
    }
    --lines;
  }
  std::vector<std::string> laid;
  for (const auto& entry : first) laid.insert(laid.end(), entry.begin(), entry.end());
  laid.insert(laid.end(), always.begin(), always.end());
  return lay_out_text(laid, revision);
}

std::string with_entry(std::string_view text, const std::string& entry, int revision) {
  std::vector<std::string> laid = header_lines(text);
  std::size_t used = free_lines;
  while (used > 0 && content_of(laid[used - 1]).empty()) --used;
  const std::vector<std::string> more = wrapped(entry);
  fill(laid, used, more, more.size());
  for (std::size_t i = used + more.size(); i < free_lines; ++i) laid[i] = numbered(i, "");
  if (may_be_stamped(content_of(laid[38]))) laid[38] = numbered(38, stamp(revision));
  if (may_be_stamped(content_of(laid[39]))) laid[39] = numbered(39, "END TEXTUAL HEADER");
  return joined_by(laid, "");
}

std::vector<std::string> shown_lines(std::string_view text) {
  std::vector<std::string> lines;
  for (std::string& line : header_lines(text)) {
    if (content_of(line).empty()) continue;
    for (char& character : line)
      if (is_blank(character) && character != ' ') character = '.';
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace slipwave::segy
