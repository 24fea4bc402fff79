#include "shooting/textual_header.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace slipwave {

namespace {

/// "explosion", "plane:20"
template <int D>
std::string kind_of(const Mechanism<D>& mechanism) {
  const auto* wave = std::get_if<PlaneWave<D>>(&mechanism);
  return name_of<D>(mechanism) + (wave ? ":" + shown(wave->angle_deg) : std::string());
}

}  // namespace

template <int D>
std::vector<std::string> textual_header_of(const Scene<D>& scene, const std::string& history,
                                           const std::string& version) {
  const auto& source = scene.survey.sources.front();
  const auto& n = scene.numerics;
  std::vector<std::string> entries = {
      version + ": synthetic seismograms",
      "source: " + kind_of<D>(source.mechanism) + ", wavelet " + source.wavelet.text() + ", amplitude " +
          shown(source.amplitude) + ", wavelet time zero at " + shown(source.wavelet.delay_s()) + " s",
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
