#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "model/fracture.hpp"
#include "parallel/ranks.hpp"
#include "scene/scene.hpp"

namespace slipwave {

class NetcdfFile;

/// The options that describe a shot, for the tools that shoot: model, source, receivers, edges, numerics.
struct ShotSettings {
  std::string model = "-";
  std::vector<std::string> sources, receivers;
  std::string kind = "explosion", wavelet, record = "vz,vx,p";
  std::string top = "free", sides = "absorbing", bottom = "absorbing";
  std::string order = "5", time_order = "2", correction = "second", precision = "float", without;
  double amplitude = 1, duration_s = 0, interval_s = 0.001, cfl = 0.9;
  std::optional<double> time_step_s;
  int edge_width = 0;
  MediumLimits limits;

  /// What is shot and recorded, and the edges.
  void declare_scene(cli::Options& options);
  /// Order, step, slip correction and precision.
  void declare_numerics(cli::Options& options);
  /// The scene, its model not yet read.
  template <int D>
  Scene<D> without_model() const;
  /// Puts the model in and checks both.
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
