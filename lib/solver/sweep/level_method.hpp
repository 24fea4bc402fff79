// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "solver/sweep/row_method.hpp"
#include "solver/sweep/sweep_tables.hpp"

namespace slipwave::solver {

/// Level rows (theory.md (E6)-(E10)), whose loops know uniform runs.
template <int D, class Real>
class LevelMethod final : public RowMethod<D, Real> {
 public:
  explicit LevelMethod(const SweepTables<D, Real>& tables);

  void reconstruct(const RowPart<D, Real>& part, std::int64_t stride, OutgoingWaves<Real> outgoing,
                   PrefetchQueue<Real>& prefetch) const override;
  void solve(const RowFaces<D, Real>& faces) const override;
  void update(const RowPart<D, Real>& part, const RowFlux<Real>& flux,
              PrefetchQueue<Real>& prefetch) const override;

  /// Whether the loops over a row of a sweep across, over the faces before it and over the row `done` that it
  /// updates can be one.
  bool fuses(int axis, const Index<D>& here, const Index<D>& done, const IndexRange& columns) const;
  /// Does all three in that loop: the faces lie before the row that is reconstructed, the states before and
  /// behind the cells of `done` are those of `flux`.
  void advance(const RowFaces<D, Real>& faces, const RowPart<D, Real>& done, const RowFlux<Real>& flux) const;

  std::int64_t memory_bytes() const { return bytes_of(plain_lines_); }

 private:
  const InterfaceKernels<Real>& face_kernels(bool uniform) const {
    const auto& all = *tables_.kernels[uniform];
    return tables_.anisotropic ? all.anisotropic_face[D - 2]
           : tables_.shear     ? all.face[D - 2]
                               : all.fluid_face;
  }

  const SweepTables<D, Real>& tables_;
  /// [axis][line]: whether no cell of it needs more than a fused row: level, without stencils of its own.
  std::array<std::vector<char>, std::size_t(D)> plain_lines_;
};

}  // namespace slipwave::solver
