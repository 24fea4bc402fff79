// SPDX-License-Identifier: BSD-3-Clause
#include <mpi.h>

#include <cstdlib>
#include <limits>
#include <mutex>

#include "parallel/ranks_started.hpp"

namespace slipwave {
namespace {

/// One call of MPI at a time: who waits lets others call meanwhile (wait_for).
std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

int length_of(std::size_t bytes) {
  if (bytes > std::size_t(std::numeric_limits<int>::max()))
    throw Error("found a message of " + std::to_string(bytes) +
                " bytes between processes, expected at most " +
                std::to_string(std::numeric_limits<int>::max()) + ": use more of them, or lower --order");
  return int(bytes);
}

class MpiMessage : public Message {
 public:
  explicit MpiMessage(MPI_Request request) : request_(request) {}
  bool done() override {
    const std::lock_guard lock(one_at_a_time());
    int done = 0;
    MPI_Test(&request_, &done, MPI_STATUS_IGNORE);
    return done != 0;
  }

 private:
  MPI_Request request_;
};

class MpiRanks : public Ranks {
 public:
  explicit MpiRanks(MPI_Comm among) : among_(among) {
    MPI_Comm_size(among_, &count_);
    MPI_Comm_rank(among_, &number_);
  }
  ~MpiRanks() override {
    if (among_ == MPI_COMM_WORLD)
      MPI_Finalize();
    else
      MPI_Comm_free(&among_);
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;
  int count() const override { return count_; }
  int number() const override { return number_; }
  std::unique_ptr<Message> send(int to, int tag, std::span<const std::byte> bytes) override {
    const int length = length_of(bytes.size());
    const std::lock_guard lock(one_at_a_time());
    MPI_Request request;
    MPI_Isend(bytes.data(), length, MPI_BYTE, to, tag, among_, &request);
    return std::make_unique<MpiMessage>(request);
  }
  std::unique_ptr<Message> receive(int from, int tag, std::span<std::byte> bytes) override {
    const int length = length_of(bytes.size());
    const std::lock_guard lock(one_at_a_time());
    MPI_Request request;
    MPI_Irecv(bytes.data(), length, MPI_BYTE, from, tag, among_, &request);
    return std::make_unique<MpiMessage>(request);
  }
  std::vector<std::vector<std::byte>> all_of(std::span<const std::byte> mine) override {
    const int length = length_of(mine.size());
    std::vector<int> lengths, places;
    lengths.resize(std::size_t(count_));
    places.resize(std::size_t(count_));
    MPI_Request request;
    start([&] { MPI_Iallgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, among_, &request); });
    wait_for(*std::make_unique<MpiMessage>(request));
    std::size_t all = 0;
    for (std::size_t n = 0; n < lengths.size(); ++n) {
      places[n] = length_of(all);
      all += std::size_t(lengths[n]);
    }
    std::vector<std::byte> bytes(all);
    start([&] {
      MPI_Iallgatherv(mine.data(), length, MPI_BYTE, bytes.data(), lengths.data(), places.data(), MPI_BYTE,
                      among_, &request);
    });
    wait_for(*std::make_unique<MpiMessage>(request));
    std::vector<std::vector<std::byte>> parts;
    for (std::size_t n = 0; n < lengths.size(); ++n) {
      const auto begin = bytes.begin() + places[n];
      parts.emplace_back(begin, begin + lengths[n]);
    }
    return parts;
  }
  std::unique_ptr<Ranks> split(int colour) override {
    const std::lock_guard lock(one_at_a_time());
    MPI_Comm among;
    MPI_Comm_split(among_, colour, number_, &among);
    return std::make_unique<MpiRanks>(among);
  }

 private:
  template <class Call>
  static void start(const Call& call) {
    const std::lock_guard lock(one_at_a_time());
    call();
  }
  MPI_Comm among_;
  int count_ = 1, number_ = 0;
};

/// Launchers describe the processes to each other in the environment. Nothing of MPI is begun without one:
/// that takes a good part of a second.
bool launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

std::unique_ptr<Ranks> started_ranks() {
  if (!launched()) return nullptr;
  int given = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
  auto ranks = std::make_unique<MpiRanks>(MPI_COMM_WORLD);
  if (given < MPI_THREAD_SERIALIZED)
    throw Error("found an MPI without support for threads, expected MPI_THREAD_SERIALIZED");
  if (ranks->count() == 1) ranks.reset();
  return ranks;
}

void end_all_ranks(int status) {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun) MPI_Abort(MPI_COMM_WORLD, status);
}

}  // namespace slipwave
