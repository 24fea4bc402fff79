// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/textual_header.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/instantiate.hpp"

namespace slipwave {

namespace {

/// "explosion", "force:0,1", "plane:20": as --kind takes it.
template <int D>
std::string kind_of(const Mechanism<D>& mechanism) {
  std::vector<double> parameters;
  if (const auto* force = std::get_if<PointForce<D>>(&mechanism))
    parameters.assign(force->vector.begin(), force->vector.end());
  if (const auto* moment = std::get_if<MomentTensor<D>>(&mechanism)) {
    for (int i = 0; i < D; ++i) parameters.push_back(moment->tensor(i, i));
    for (int i = 0; i < D; ++i)
      for (int j = i + 1; j < D; ++j) parameters.push_back(moment->tensor(i, j));
  }
  if (const auto* wave = std::get_if<PlaneWave<D>>(&mechanism)) {
    parameters.push_back(wave->angle_deg);
    if (wave->azimuth_deg != 0) parameters.push_back(wave->azimuth_deg);
  }
  std::string text = name_of<D>(mechanism);
  for (std::size_t n = 0; n < parameters.size(); ++n) text += (n == 0 ? ":" : ",") + shown(parameters[n]);
  return text;
}

template <int D>
std::string boundaries_entry(const EdgeLaws<D>& edges) {
  return std::string("boundaries: top ") + name_of(edges[D - 1][0]) + ", sides " + name_of(edges[0][0]) +
         ", bottom " + name_of(edges[D - 1][1]);
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
segy::Heading textual_header_of(const Scene<D>& scene, const std::string& history,
                                const Provenance& provenance) {
  const auto& n = scene.numerics;
  std::vector<std::string> entries = {
      provenance.version + ": synthetic seismograms",
      source_entry(scene.survey),
      "scheme: grid-characteristic, order " + std::to_string(n.order) + ", time step " +
          shown(time_step_s(scene)) + " s, grid " + shown(scene.subdomain.whole(scene.model.grid())) +
          (n.time_order == 2 ? "" : ", order in time " + std::to_string(n.time_order)) +
          (n.monotone ? ", monotone" : "") + (n.double_precision ? ", double precision" : "") +
          (scene.slips() || scene.subdomain.slips ? std::string(", slip: ") + name_of(n.correction)
                                                  : std::string(", no slip")),
      boundaries_entry<D>(scene.edges),
  };
  if (!provenance.measured.empty()) entries.push_back(provenance.measured);
  if (const auto& fibre = scene.recording.fibre)
    entries.push_back(
        "das: strain rate along a fibre, mean over a gauge of " + shown(fibre->gauge_m) + " m; fibre " +
        (fibre->along_path
             ? "through the receivers in their order"
             : shown(fibre->angle_deg) + " degrees from down towards +x" +
                   (D == 3 ? ", turned by " + shown(fibre->azimuth_deg) + " degrees from x to y" : "")));
  return {std::move(entries), history};
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, textual_header_of);

}  // namespace slipwave
