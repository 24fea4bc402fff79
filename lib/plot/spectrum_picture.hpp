// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "plot/look.hpp"
#include "plot/page.hpp"
#include "plot/picture.hpp"
#include "plot/spectra.hpp"

namespace slipwave::plot {

/// Lines over frequency, a panel for each unit, files told apart in the legend; with `log` down to 10^-5
/// (energy: 10^-10) of the greatest. Frequencies end where all spectra stay below a thousandth of their
/// greatest value, unless `look` says what part to show. A file of each trace, or of wavenumbers, alone,
/// becomes colours over trace or wavenumber and frequency, as far as the band of the data reaches; with `log`
/// in dB of the greatest value, down to -60.
Picture draw_spectra(const std::vector<Spectra>& files, bool log, const Look& look, Page page);

}  // namespace slipwave::plot
