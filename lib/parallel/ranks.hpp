#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace slipwave {

/// A message under way. What it is made from or comes to must stay until done() says so.
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
  /// Of this one: 0 to count() - 1.
  virtual int number() const = 0;
  /// Messages between two ranks with the same tag (0 to 31) arrive in the order in which they were sent; what
  /// is received has the length of what was sent.
  virtual std::unique_ptr<Message> send(int to, int tag, std::span<const std::byte> bytes) = 0;
  virtual std::unique_ptr<Message> receive(int from, int tag, std::span<std::byte> bytes) = 0;
  /// Collective: what every rank hands in, by their numbers, on all ranks.
  virtual std::vector<std::vector<std::byte>> all_of(std::span<const std::byte> mine) = 0;
  /// Collective: those that name the same colour, in the order of their numbers.
  virtual std::unique_ptr<Ranks> split(int colour) = 0;
};

/// Until a message is delivered. Looks again and again, but leaves the processor to others meanwhile.
void wait_for(Message& message);

/// Collective: the largest, smallest and sum of what the ranks hand in; where there is one process (null),
/// what it handed in. The sum is taken in the order of their numbers.
double largest_of(Ranks* ranks, double mine);
double smallest_of(Ranks* ranks, double mine);
double sum_of(Ranks* ranks, double mine);
/// Collective: what the ranks hand in, one after the other, on all of them.
std::vector<double> allgather(Ranks* ranks, const std::vector<double>& mine);
/// Collective: the same on the first rank alone, nothing on the others; of any size.
std::vector<std::byte> gather_on_first(Ranks& ranks, std::span<const std::byte> mine);
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
