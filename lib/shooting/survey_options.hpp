// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/given_survey.hpp"

namespace slipwave {

/// These options say where sources and receivers are, as the tools take them.
struct SurveyOptions {
  std::vector<std::string> sources, receivers;  // places, or @FILE: tables
  std::string inject;                           // instead of sources: a gather whose traces are sources
  bool reverse = false;                         // in time
  std::vector<std::string> geometry;            // instead of both: a file of traces, a table, or SPS files
  std::string origin;                           // of the model on the map of the geometry, "X,Y"
  std::optional<double> azimuth_deg;
  std::string source_depth, receiver_depth;  // instead of those of the geometry
  std::string blend;                         // a table
  std::string shots;                         // numbers of those that are shot, "3,10:20"; empty: all

  bool any_source() const { return !sources.empty() || !geometry.empty() || !inject.empty(); }
  bool any_receiver() const { return !receivers.empty() || !geometry.empty(); }
  /// Reads all that the options name, for a model of that dimension. Throws a usage Error naming the option,
  /// or an Error naming file and line.
  GivenSurvey read(int dimension) const;

 private:
  GivenSurvey read_lines(int dimension) const;
  GivenSurvey read_geometry(int dimension) const;
  void check() const;
  MapFrame frame() const;
};

}  // namespace slipwave
