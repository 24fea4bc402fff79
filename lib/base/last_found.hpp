// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

namespace slipwave {

/// The value of the last key that was asked for: of cells one after the other, most of which are alike, what
/// takes long is found once for neighbours. Each thread has one of its own.
template <class Key, class Value>
class LastFound {
 public:
  /// Returns find(key), which it calls where the key is another one than before.
  template <class Find>
  const Value& operator()(Key key, const Find& find) {
    if (!value_ || !(key == key_)) {
      value_ = find(key);
      key_ = std::move(key);
    }
    return *value_;
  }

 private:
  Key key_{};
  std::optional<Value> value_;
};

}  // namespace slipwave
