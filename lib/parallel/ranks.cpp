#include "parallel/ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

namespace slipwave {
namespace {

constexpr int tag_of_joined = 31;

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}

template <class Join>
double folded(Ranks* ranks, double mine, const Join& join) {
  const auto all = allgather(ranks, {mine});
  double value = all.front();
  for (std::size_t n = 1; n < all.size(); ++n) value = join(value, all[n]);
  return value;
}

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

std::vector<double> allgather(Ranks* ranks, const std::vector<double>& mine) {
  if (!ranks) return mine;
  std::vector<double> all;
  for (const auto& bytes : ranks->all_of(bytes_of(mine))) {
    const auto before = all.size();
    all.resize(before + bytes.size() / sizeof(double));
    if (!bytes.empty()) std::memcpy(all.data() + before, bytes.data(), bytes.size());
  }
  return all;
}

double largest_of(Ranks* ranks, double mine) {
  return folded(ranks, mine, [](double a, double b) { return std::max(a, b); });
}

double smallest_of(Ranks* ranks, double mine) {
  return folded(ranks, mine, [](double a, double b) { return std::min(a, b); });
}

double sum_of(Ranks* ranks, double mine) {
  return folded(ranks, mine, [](double a, double b) { return a + b; });
}

std::vector<std::byte> gather_on_first(Ranks& ranks, std::span<const std::byte> mine) {
  constexpr std::size_t piece = std::size_t(1) << 27;  // of a message
  const auto counts = allgather(&ranks, {double(mine.size())});
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
