#pragma once

#include "scene/scene.hpp"

namespace slipwave {

/// Throws an Error on the first cell whose anisotropy can not be computed together with what else happens
/// there (theory.md 1.10): one whose planes open, or lie askew (lie_askew()) and weaken where they cross or
/// are springs that slide, have dashpots or lie on faces; in 3-D one whose planes lie askew and are springs,
/// or any under a plane wave.
template <int D>
void check_anisotropy(const Scene<D>& scene);

}  // namespace slipwave
