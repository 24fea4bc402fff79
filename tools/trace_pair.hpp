// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/error.hpp"
#include "cli/tool.hpp"
#include "segy/pair.hpp"
#include "segy/reader.hpp"
#include "trace_input.hpp"

namespace slipwave {

/// The arguments of tools that read two gathers of the same survey side by side.
struct TracePair {
  std::string a, b;
  TraceInput input_options;

  void declare(cli::Options& options) {
    options.positional(a, "A");
    options.positional(b, "B");
    options.require("A");
    options.require("B");
  }
};

/// The two, opened.
struct OpenPair {
  segy::Reader a, b;
  segy::PairReader both{a, b};

  explicit OpenPair(const TracePair& inputs)
      : a(first_of(inputs), inputs.input_options.to_damage()),
        b(inputs.b, inputs.input_options.to_damage()) {}
  /// Throws an Error where an input ended too early, once all whole pairs were used.
  void expect_whole() const {
    a.expect_whole();
    b.expect_whole();
  }
  /// Of both, once they were read.
  void warn_of_doubts(const cli::Context& context) const {
    for (const auto* reader : {&a, &b})
      for (const auto& sentence : reader->doubts()) context.warn(sentence);
  }
  OpenPair(const OpenPair&) = delete;
  OpenPair& operator=(const OpenPair&) = delete;

 private:
  static const std::string& first_of(const TracePair& inputs) {
    if (inputs.a == "-" && inputs.b == "-")
      throw Error("A and B are both standard input, expected two inputs", ErrorKind::usage);
    return inputs.a;
  }
};

}  // namespace slipwave
