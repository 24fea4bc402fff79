// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "rock/elasticity.hpp"

namespace slipwave {

/// What of the stiffness of orthorhombic rock relaxes as a bulk modulus does (theory.md (Q11)): of every c_aa
/// the same share, and of c_ab that share of sqrt(c_aa c_bb). It is the largest that leaves a positive rest;
/// of isotropic rock the bulk modulus.
struct BulkPart {
  double share = 0;
  /// The weights of s_aa/sqrt(c_aa): their sum is 1.
  Point<3> weights{};
};
/// Returns the bulk part of a positive stiffness.
BulkPart bulk_part(const Elasticity<3>& orthorhombic);

/// Both tensors of (Q11) in the axes of the grid, by SymmetricTensor<3>: `weights` : s is the size of the
/// bulk part of a stress, with both components off the diagonal counted in one number, and `stress` times
/// that is the part. Of isotropic rock the mean and the unit tensor.
struct BulkTensors {
  std::array<double, 6> weights = {1. / 3, 1. / 3, 1. / 3}, stress = {1, 1, 1};
  /// Whether they have components off the diagonal.
  bool are_turned() const;
};
BulkTensors bulk_tensors(const Material& rock);

}  // namespace slipwave
