// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace slipwave {

/// 64 bits that depend evenly on all bits of key and number: the finaliser of splitmix64 (Steele, Lea & Flood
/// 2014, "Fast splittable pseudorandom number generators") over both. A generator without a state, in
/// integers only: element n of the sequence `key` is the same on every machine, whatever was asked before.
std::uint64_t mixed(std::uint64_t key, std::int64_t number);

/// Element `number` of the sequence `key`, evenly distributed in [0, 1).
double uniform(std::uint64_t key, std::int64_t number);
/// Element `number` of the sequence `key`, evenly distributed in [low, high).
double uniform(std::uint64_t key, std::int64_t number, double low, double high);
/// Element `number` of the sequence `key`, with mean 0 and standard deviation 1, within -3.5 to 3.5: a scaled
/// sum of four uniform numbers.
double bell(std::uint64_t key, std::int64_t number);

/// A smooth random curve within -1 to 1: uniform numbers at the whole x, a polynomial of fifth degree between
/// them, so that two derivatives are continuous.
double noise(std::uint64_t key, double x);

/// 0 for x <= low, 1 for x >= high, and between them the cubic with slope 0 at both ends.
double smooth_step(double low, double high, double x);

}  // namespace slipwave
