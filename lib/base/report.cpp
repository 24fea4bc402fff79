// SPDX-License-Identifier: BSD-3-Clause
#include "base/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "base/utf8.hpp"

namespace slipwave {
namespace {

std::string json_number(double value) { return std::isfinite(value) ? shown(value) : "null"; }

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// Seven digits are enough for people, and what a float holds.
std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

}  // namespace

std::string json_string(const std::string& text) {
  std::string quoted = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    if (byte == '"' || byte == '\\') {
      quoted += '\\';
      quoted += text[i];
    } else if (byte < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      quoted += escape;
    } else if (length == 0) {
      quoted += char(0xc0 | byte >> 6);
      quoted += char(0x80 | (byte & 0x3f));
    } else {
      quoted += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return quoted + '"';
}

void Report::text(const std::string& key, const std::string& value) {
  std::string line = value;
  for (std::size_t at = 0; (at = line.find('\n', at)) != std::string::npos;) line.replace(at, 1, "; ");
  entries_.push_back({key, line, json_string(value)});
}

void Report::texts(const std::string& key, const std::vector<std::string>& values) {
  std::string json = "[";
  for (const auto& value : values) {
    entries_.push_back({key, value, ""});
    if (json.size() > 1) json += ", ";
    json += json_string(value);
  }
  entries_.push_back({key, "", json + "]"});
}

void Report::count(const std::string& key, std::int64_t value) {
  entries_.push_back({key, std::to_string(value), std::to_string(value)});
}

void Report::number(const std::string& key, double value, const std::string& unit) {
  entries_.push_back(
      {key, with_unit(short_number(value), unit),
       std::string("{\"value\": ") + json_number(value) + ", \"unit\": " + json_string(unit) + "}"});
}

void Report::range(const std::string& key, double low, double high, const std::string& unit) {
  const std::string text = low == high ? short_number(low) : short_number(low) + " to " + short_number(high);
  entries_.push_back({key, with_unit(text, unit),
                      std::string("{\"low\": ") + json_number(low) + ", \"high\": " + json_number(high) +
                          ", \"unit\": " + json_string(unit) + "}"});
}

void Report::list(const std::string& key, const std::vector<Report>& items) {
  std::string json = "[";
  for (const auto& item : items) {
    entries_.push_back({key, item.joined(), ""});
    if (json.size() > 1) json += ", ";
    json += item.json();
  }
  entries_.push_back({key, "", json + "]"});
}

void Report::append(const Report& other) {
  entries_.insert(entries_.end(), other.entries_.begin(), other.entries_.end());
}

std::string Report::lines() const {
  std::size_t width = 0;
  for (const auto& entry : entries_) {
    if (!entry.shown.empty()) width = std::max(width, entry.key.size());
  }
  std::string text;
  for (const auto& entry : entries_) {
    if (entry.shown.empty()) continue;
    text +=
        std::string("  ") + entry.key + std::string(width - entry.key.size() + 2, ' ') + entry.shown + "\n";
  }
  return text;
}

std::string Report::json() const {
  std::string text = "{";
  for (const auto& entry : entries_) {
    if (entry.json.empty()) continue;
    std::string key = entry.key;
    std::replace(key.begin(), key.end(), ' ', '_');
    if (text.size() > 1) text += ", ";
    text.append(json_string(key)).append(": ").append(entry.json);
  }
  return text + '}';
}

std::string Report::joined() const {
  std::string text;
  for (const auto& entry : entries_) {
    if (entry.shown.empty()) continue;
    if (!text.empty()) text += ", ";
    text.append(entry.key).append(" ").append(entry.shown);
  }
  return text;
}

}  // namespace slipwave
