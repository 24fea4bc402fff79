#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/wave_train.hpp"
#include "scene/scene.hpp"

namespace slipwave {

/// Something that makes traces differ from exact ones.
struct ErrorCause {
  std::string
      name;  // "S waves: 6.1 cells per shortest wavelength", "free surface, a staircase of 15 degrees"
  std::string remedy;     // what would cure it; "" where smaller cells do
  double error = 0;       // relative L2 over all traces, of this cause alone
  bool curable = true;    // falls at least as fast as the cells shrink
  bool by_steps = false;  // of dispersion: shorter steps may help
};

/// What is promised of a scene: the error of all traces together, and where it comes from.
struct PromisedError {
  double error = 0;                // "up to"
  std::vector<ErrorCause> causes;  // largest first
  std::vector<std::string> not_covered;
  /// Of causes that smaller cells do not cure.
  double floor = 0;
};

/// Estimates errors of traces before anything is run, by the response of the layers round each source
/// (StackResponse): dispersion changes speeds, an interface at a wrong place moves it, and both are carried
/// through all waves that reach the receivers. What cannot be put so is added from measured figures.
class ErrorSources {
 public:
  explicit ErrorSources(const Scene<2>& scene);
  ~ErrorSources();
  ErrorSources(ErrorSources&&) noexcept;
  ErrorSources& operator=(ErrorSources&&) noexcept;

  /// For cells and steps of the same model; `courant` is vp_max dt/h.
  PromisedError promised(const Discretisation& cells) const;

 private:
  struct Shot;
  std::vector<std::unique_ptr<Shot>> shots_;
  std::vector<std::string> not_covered_;
  double own_spacing_m_ = 0;
};

}  // namespace slipwave
