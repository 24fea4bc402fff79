// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/messages.hpp"
#include "base/report.hpp"
#include "scene/scene.hpp"
#include "shooting/provenance.hpp"
#include "shooting/shooting.hpp"

namespace slipwave {

/// Whether anything is measured: --error, --measure, --error-gather.
bool measures(const ShootingOptions& options);
/// Throws a usage Error on options of errors that contradict each other.
void check_measuring(const ShootingOptions& options);

/// Measures the error of a checked scene (measured_error()), or searches the cheapest setting for the one
/// that is wanted (reach_error()), says what was found, shoots the whole survey so and writes it, and the
/// error of each trace where that is asked for.
template <int D>
void shoot_measured(const Scene<D>& scene, const ShootingOptions& options, const OutputOptions& output,
                    const Provenance& provenance, const Messages& messages);

/// What runs in larger cells tell of a scene that is not run itself.
template <int D>
Report measured_report(const Scene<D>& scene, const ShootingOptions& options, const Messages& messages);

}  // namespace slipwave
