// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot/page.hpp"

namespace slipwave::plot {

/// Puts title and history of `page` into the bytes of a finished PNG (tEXt, and its resolution as pHYs) or
/// SVG (title and desc elements); a PDF has them from the start and is returned as it is.
std::vector<char> with_provenance(std::vector<char> bytes, const Page& page);

/// Returns a text as the content of an element of XML.
std::string xml_text(const std::string& text);

}  // namespace slipwave::plot
