// SPDX-License-Identifier: BSD-3-Clause
// Every scene of the list gives the same bits by the tiled executor as by the plain one, which does each
// entry of the time step on the whole grid, by any number of threads, and in pieces.
#include "bit_scenes.hpp"
#include "continued.hpp"
#include "long_form.hpp"
#include "plain_and_tiled.hpp"

namespace slipwave::solver::same_bits_test {
namespace {

class SameBits : public testing::TestWithParam<BitScene> {};

// Proves (E9), (E9a), (E20), (F10), (S18), (S27), (S43), (A13).
TEST_P(SameBits, InTilesPlainlyAndInPieces) {
  with_scene(GetParam(), []<int D>(const Scene<D>& scene) {
    const auto plain = plain_outcome_of(scene);
    // Those of pieces are other ones, of all widths.
    std::vector<std::pair<Tiling, int>> kinds = {{{}, 3}};
    if (long_form()) kinds.push_back({{2, D == 2 ? 48 : 7, true}, 1});
    expect_same_in_tiles(scene, plain, kinds);
    expect_same_in_pieces(scene, plain);
    if (auto without = scene; remove_effect_of(without)) {
      EXPECT_FALSE(samples_of(shoot(without, 1)) == plain.samples) << "its effect does nothing";
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Of, SameBits, testing::ValuesIn(bit_scenes()),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace slipwave::solver::same_bits_test
