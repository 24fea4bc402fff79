// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

namespace slipwave {
namespace {

constexpr int tag_of_joined = 31;

}  // namespace

void wait_for(Message& message) {
  // Most messages are there or nearly so; who waits longer must not take the processor from who computes.
  for (int looks = 0; !message.done(); ++looks) {
    if (looks < 64)
      std::this_thread::yield();
    else
      std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
}

std::vector<std::byte> gather_on_first(Ranks& ranks, std::span<const std::byte> mine) {
  constexpr std::size_t piece = std::size_t(1) << 27;  // of a message
  const auto counts = allgather(&ranks, std::vector<std::uint64_t>{mine.size()});
  if (ranks.number() > 0) {
    for (std::size_t sent = 0; sent < mine.size(); sent += piece)
      wait_for(*ranks.send(0, tag_of_joined, mine.subspan(sent, std::min(piece, mine.size() - sent))));
    return {};
  }
  std::vector<std::byte> all(mine.begin(), mine.end());
  for (int from = 1; from < ranks.count(); ++from) {
    const auto count = std::size_t(counts[std::size_t(from)]), before = all.size();
    all.resize(before + count);
    const std::span<std::byte> part(all.data() + before, count);
    for (std::size_t come = 0; come < count; come += piece)
      wait_for(*ranks.receive(from, tag_of_joined, part.subspan(come, std::min(piece, count - come))));
  }
  return all;
}

std::vector<std::string> allgather_texts(Ranks& ranks, const std::string& mine) {
  std::vector<std::string> texts;
  for (const auto& bytes : ranks.all_of(std::as_bytes(std::span<const char>(mine))))
    texts.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return texts;
}

void collective_try(Ranks* ranks, const std::function<void()>& what) {
  if (!ranks) return what();
  std::string text;  // its kind and its sentence
  try {
    what();
  } catch (const Error& error) {
    text = char('0' + int(error.kind())) + std::string(error.what());
  }
  for (const auto& first : allgather_texts(*ranks, text))
    if (!first.empty()) throw CollectiveError(first.substr(1), ErrorKind(first[0] - '0'));
}

}  // namespace slipwave
