// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"

namespace slipwave {

/// A message in progress. Its buffer must stay until done() says so.
class Message {
 public:
  virtual ~Message() = default;
  /// Whether it has been delivered.
  virtual bool done() = 0;
};

/// The processes that compute something together, each with a number. Any of its threads may send and
/// receive; what is collective all of them do, in the same order, from one thread each.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int count() const = 0;
  /// Returns the number of this one: 0 to count() - 1.
  virtual int number() const = 0;
  /// Messages between two ranks with the same tag (0 to 31) arrive in the order in which they were sent; what
  /// is received has the length of what was sent.
  virtual std::unique_ptr<Message> send(int to, int tag, std::span<const std::byte> bytes) = 0;
  virtual std::unique_ptr<Message> receive(int from, int tag, std::span<std::byte> bytes) = 0;
  /// Collective: the contributions of all ranks, by their numbers, on all ranks.
  virtual std::vector<std::vector<std::byte>> all_of(std::span<const std::byte> mine) = 0;
  /// Collective: those that name the same colour, in the order of their numbers.
  virtual std::unique_ptr<Ranks> split(int colour) = 0;
};

/// Waits until a message is delivered. Polls, but yields the processor to others meanwhile.
void wait_for(Message& message);

/// Collective: what the ranks give, one after the other by their numbers, on all of them; what it was given
/// where there is one process (null).
template <class T>
std::vector<T> allgather(Ranks* ranks, const std::vector<T>& mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (!ranks) return mine;
  std::vector<T> all;
  for (const auto& bytes : ranks->all_of(std::as_bytes(std::span<const T>(mine)))) {
    const auto before = all.size();
    all.resize(before + bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(all.data() + before, bytes.data(), bytes.size());
  }
  return all;
}
/// Collective: the largest, smallest and sum of what the ranks give. The sum is taken in the order of their
/// numbers.
template <class T>
T largest_of(Ranks* ranks, T mine) {
  const auto all = allgather(ranks, std::vector<T>{mine});
  return *std::max_element(all.begin(), all.end());
}
template <class T>
T smallest_of(Ranks* ranks, T mine) {
  const auto all = allgather(ranks, std::vector<T>{mine});
  return *std::min_element(all.begin(), all.end());
}
template <class T>
T sum_of(Ranks* ranks, T mine) {
  const auto all = allgather(ranks, std::vector<T>{mine});
  return std::accumulate(all.begin() + 1, all.end(), all.front());
}
/// Collective: the bytes of all ranks on the first one alone, nothing on the others; of any size.
std::vector<std::byte> gather_on_first(Ranks& ranks, std::span<const std::byte> mine);
template <class T>
std::vector<T> gather_on_first(Ranks& ranks, const std::vector<T>& mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto bytes = gather_on_first(ranks, std::as_bytes(std::span<const T>(mine)));
  std::vector<T> all(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  return all;
}
/// Collective: what the ranks say, by their numbers, on all of them.
std::vector<std::string> allgather_texts(Ranks& ranks, const std::string& mine);

/// An error that all ranks know of and throw.
class CollectiveError : public Error {
 public:
  using Error::Error;
};
/// Thrown where another rank says what went wrong: this one ends with the same exit status, silently.
struct EndedElsewhere {
  ErrorKind kind = ErrorKind::data;
};
/// Collective: does what each rank has to do of it. Where that throws an Error on any of them, the sentence
/// of the first of those is thrown on all.
void collective_try(Ranks* ranks, const std::function<void()>& what);

}  // namespace slipwave
