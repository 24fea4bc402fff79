// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <barrier>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>

#include "parallel/ranks.hpp"

namespace slipwave {

/// Ranks that are threads of one process: what is shared out can be tested where there is no MPI, and under
/// sanitizers.
class RanksInThreads {
 public:
  /// Runs body on `count` ranks at once. What it throws on any of them is thrown here when all have ended.
  static void run(int count, const std::function<void(Ranks&)>& body) {
    const auto post = std::make_shared<Post>(count);
    std::vector<std::thread> threads;
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(count));
    for (int number = 0; number < count; ++number)
      threads.emplace_back([&, number] {
        One rank(post, number);
        try {
          body(rank);
        } catch (...) {
          thrown[std::size_t(number)] = std::current_exception();
        }
      });
    for (auto& thread : threads) thread.join();
    for (const auto& one : thrown)
      if (one) std::rethrow_exception(one);
  }

 private:
  using Bytes = std::vector<std::byte>;

  struct Post {
    explicit Post(int ranks) : count(ranks), handed_in(std::size_t(ranks)), all_here(ranks) {}
    const int count;
    std::mutex mutex;
    std::map<std::tuple<int, int, int>, std::deque<Bytes>> letters;  // from, to, tag
    std::vector<Bytes> handed_in;
    std::map<std::pair<int, int>, std::shared_ptr<Post>> groups;  // number of the split, colour
    std::barrier<> all_here;
  };

  class Sent : public Message {
   public:
    bool done() override { return true; }
  };

  class Awaited : public Message {
   public:
    Awaited(std::shared_ptr<Post> post, std::tuple<int, int, int> which, std::span<std::byte> to)
        : post_(std::move(post)), which_(which), to_(to) {}
    bool done() override {
      const std::lock_guard lock(post_->mutex);
      auto& letters = post_->letters[which_];
      if (letters.empty()) return false;
      if (letters.front().size() != to_.size()) std::terminate();  // a message of another length
      std::memcpy(to_.data(), letters.front().data(), to_.size());
      letters.pop_front();
      return true;
    }

   private:
    std::shared_ptr<Post> post_;
    std::tuple<int, int, int> which_;
    std::span<std::byte> to_;
  };

  class One : public Ranks {
   public:
    One(std::shared_ptr<Post> post, int number) : post_(std::move(post)), number_(number) {}
    int count() const override { return post_->count; }
    int number() const override { return number_; }
    std::unique_ptr<Message> send(int to, int tag, std::span<const std::byte> bytes) override {
      const std::lock_guard lock(post_->mutex);
      post_->letters[{number_, to, tag}].emplace_back(bytes.begin(), bytes.end());
      return std::make_unique<Sent>();
    }
    std::unique_ptr<Message> receive(int from, int tag, std::span<std::byte> bytes) override {
      return std::make_unique<Awaited>(post_, std::tuple(from, number_, tag), bytes);
    }
    std::vector<Bytes> all_of(std::span<const std::byte> mine) override {
      post_->handed_in[std::size_t(number_)].assign(mine.begin(), mine.end());
      post_->all_here.arrive_and_wait();
      auto all = post_->handed_in;
      post_->all_here.arrive_and_wait();
      return all;
    }
    std::unique_ptr<Ranks> split(int colour) override {
      const auto all = all_of(std::as_bytes(std::span<const int>(&colour, 1)));
      int alike = 0, before = 0;
      for (int n = 0; n < count(); ++n) {
        int other = 0;
        std::memcpy(&other, all[std::size_t(n)].data(), sizeof(int));
        alike += other == colour;
        before += other == colour && n < number_;
      }
      const std::lock_guard lock(post_->mutex);
      auto& group = post_->groups[{splits_++, colour}];
      if (!group) group = std::make_shared<Post>(alike);
      return std::make_unique<One>(group, before);
    }

   private:
    std::shared_ptr<Post> post_;
    int number_, splits_ = 0;
  };
};

}  // namespace slipwave
