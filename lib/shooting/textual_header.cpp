// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/textual_header.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace slipwave {

namespace {

/// "explosion", "plane:20"
template <int D>
std::string kind_of(const Mechanism<D>& mechanism) {
  const auto* wave = std::get_if<PlaneWave<D>>(&mechanism);
  return name_of<D>(mechanism) +
         (wave ? ":" + shown(wave->angle_deg) + (wave->azimuth_deg != 0 ? "," + shown(wave->azimuth_deg) : "")
               : std::string());
}

/// What all sources have in common, by the first of them.
template <int D>
std::string source_entry(const Survey<D>& survey) {
  const auto& source = survey.sources.front();
  bool kinds = false, wavelets = false, amplitudes = false, blended = false;
  for (std::size_t shot = 1; shot <= survey.sources.size(); ++shot) {
    const auto of_shot = survey.sources_of(shot);
    blended = blended || of_shot.size() > 1 || of_shot.front()->delay_s != 0;
    for (const auto* other : of_shot) {
      kinds = kinds || kind_of<D>(other->mechanism) != kind_of<D>(source.mechanism);
      wavelets = wavelets || other->wavelet.text() != source.wavelet.text();
      amplitudes = amplitudes || other->amplitude != source.amplitude;
    }
  }
  const auto value = [](const std::string& of_first, bool differ) {
    return of_first + (differ ? " (others differ)" : "");
  };
  return "source: " + value(kind_of<D>(source.mechanism), kinds) + ", wavelet " +
         value(source.wavelet.text(), wavelets) + ", amplitude " +
         value(shown(source.amplitude), amplitudes) + ", wavelet time zero at " +
         shown(source.wavelet.delay_s()) + " s" + (blended ? " after the delay of each source" : "");
}

}  // namespace

template <int D>
std::vector<std::string> textual_header_of(const Scene<D>& scene, const std::string& history,
                                           const std::string& version) {
  const auto& n = scene.numerics;
  std::vector<std::string> entries = {
      version + ": synthetic seismograms",
      source_entry(scene.survey),
      "scheme: grid-characteristic, order " + std::to_string(n.order) + ", time step " +
          shown(time_step_s(scene)) + " s, grid " + shown(scene.subdomain.whole(scene.model.grid())) +
          (scene.slips() || scene.subdomain.slips ? std::string(", slip: ") + name_of(n.correction)
                                                  : std::string(", no slip")),
  };
  if (const auto& fibre = scene.recording.fibre)
    entries.push_back("das: strain rate along a fibre, mean over a gauge of " + shown(fibre->gauge_m) +
                      " m; fibre " + shown(fibre->angle_deg) + " degrees from down towards +x" +
                      (D == 3 ? ", turned by " + shown(fibre->azimuth_deg) + " degrees from x to y" : ""));
  for (std::size_t begin = 0; begin < history.size();) {
    const auto end = std::min(history.find('\n', begin), history.size());
    if (end > begin) entries.push_back(history.substr(begin, end - begin));
    begin = end + 1;
  }
  return entries;
}

template std::vector<std::string> textual_header_of(const Scene<2>&, const std::string&, const std::string&);
template std::vector<std::string> textual_header_of(const Scene<3>&, const std::string&, const std::string&);

}  // namespace slipwave
