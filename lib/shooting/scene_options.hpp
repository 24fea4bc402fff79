#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/fracture.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"
#include "shooting/survey_options.hpp"

namespace slipwave {

class NetcdfFile;

/// What is simulated, as the options of the tools say it: model, sources, receivers, edges, numerics.
struct SceneOptions {
  std::string model = "-";
  SurveyOptions survey;
  std::string kind = "explosion", wavelet, record = "vz,vx,p";
  std::string top = "free", sides = "absorbing", bottom = "absorbing";
  std::string order = "5", time_order = "2", correction = "second", precision = "float", without,
              executor = "tiled";
  double amplitude = 1, duration_s = 0, interval_s = 0.001, cfl = 0.9;
  std::optional<double> time_step_s;
  int edge_width = 0;
  MediumLimits limits;

  /// The scene, its model not yet read and its survey not yet placed in it. Throws a usage Error naming the
  /// option.
  template <int D>
  Scene<D> without_model() const;
  /// Puts the model in and checks both. Throws an Error naming the file.
  template <int D>
  void read_model_into(Scene<D>& scene, const NetcdfFile& file) const;
  /// Collective: the same of the part that this process of `all` takes, as one of the `group` (may be null)
  /// that shoots a shot together. Errors are thrown on all.
  template <int D>
  void read_part_into(Scene<D>& scene, const NetcdfFile& file, Ranks& all, Ranks* group) const;

 private:
  template <int D>
  void check_model(Model<D>& model) const;
  std::vector<SlipEffect> effects_without() const;
};

}  // namespace slipwave
