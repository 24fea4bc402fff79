// SPDX-License-Identifier: BSD-3-Clause
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
  std::string top = "free", sides = "absorbing", bottom = "absorbing", ground = "free";
  std::string order = "5", time_order = "2", correction = "centred", precision = "float", without,
              executor = "tiled",
              bands;  // empty: none, which is said where they would pay
  double amplitude = 1, duration_s = 0, interval_s = 0.001, cfl = 0.9;
  std::optional<double> time_step_s, q_frequency_hz;
  int q_mechanisms = AttenuationChoice().mechanisms;
  std::string q_band;
  int edge_width = 0;
  bool monotone = false;
  MediumLimits limits;

  /// The scene, its model not yet read and its survey not yet placed in it. Throws a usage Error naming the
  /// option.
  template <int D>
  Scene<D> without_model() const;
  /// Puts the model in and checks both; what attenuates makes the medium unrelaxed. Returns warnings. Throws
  /// an Error naming the file.
  template <int D>
  std::vector<std::string> read_model_into(Scene<D>& scene, const NetcdfFile& file) const;
  /// Places the survey anew where it is measured from the ground, as after the model has been made anew in
  /// smaller cells. Throws an Error naming what cannot be placed.
  template <int D>
  void place_again(Scene<D>& scene) const;
  /// Collective: as read_model_into() the part that this process of `all` takes, as one of the `group` (may
  /// be null) that shoots a shot together. Errors are thrown on all.
  template <int D>
  std::vector<std::string> read_part_into(Scene<D>& scene, const NetcdfFile& file, Ranks& all,
                                          Ranks* group) const;

 private:
  /// Takes out the effects that `without` names; returns the sets whose planes do nothing
  /// (leave_out_inert()).
  template <int D>
  std::vector<std::string> check_model(Model<D>& model, double resolution) const;
  AttenuationChoice attenuation() const;
  template <int D>
  std::vector<std::string> idle(const Scene<D>& scene) const;
  template <int D>
  void set_ground(Scene<D>& scene, const Grid<D>& grid) const;
  template <int D>
  std::vector<std::string> prepare_model(Scene<D>& scene) const;
  std::vector<ModelEffect> effects_without() const;
};

}  // namespace slipwave
