#pragma once

#include "scene/scene.hpp"

namespace slipwave {

/// Throws an Error on the first cell whose anisotropy can not be computed together with what else happens
/// there (theory.md 1.10): one that rows of a fitted grid bend round, or whose planes open, or lie askew
/// (lie_askew()) and are springs or weaken where they cross; in 3-D any under a plane wave.
template <int D>
void check_anisotropy(const Scene<D>& scene);

}  // namespace slipwave
