// SPDX-License-Identifier: BSD-3-Clause
#include "model/geology.hpp"

#include "base/error.hpp"

namespace slipwave {
namespace {

/// What could be followed in the cells it was asked for need not be in others.
FitChoice as_can_be(FitChoice choice) {
  choice.asked = false;
  return choice;
}

Medium<2> marmousi_medium_of(const Geology& geology, const Grid<2>& regular) {
  const auto fit = fit_marmousi(regular, *geology.marmousi, as_can_be(geology.fit));
  return marmousi_medium(fit.grid, *geology.marmousi, geology.average != Average::none);
}
Medium<3> marmousi_medium_of(const Geology&, const Grid<3>&) {
  throw Error("found a geology like Marmousi's in 3-D, expected it in 2-D");
}

/// The layers with tops that go as far as cells may.
std::vector<Layer> endless(std::vector<Layer> layers) {
  for (auto& layer : layers) {
    auto shape = layer.top.shape();
    shape.endless = true;
    layer.top = Horizon(std::move(shape));
  }
  return layers;
}

}  // namespace

template <int D>
Medium<D> medium_of(const Geology& geology, const Grid<D>& regular) {
  if (geology.marmousi) return marmousi_medium_of(geology, regular);
  const auto layers = endless(geology.layers);
  const auto fit = fit_layers(regular, layers, as_can_be(geology.fit));
  return layered_medium(fit.grid, layers, geology.average, fit.rows);
}

template <int D>
std::size_t tops_left_out(const Geology& geology, const Grid<D>& regular) {
  if (geology.layers.empty()) return 0;
  return fit_layers(regular, endless(geology.layers), as_can_be(geology.fit)).left_out.size();
}

template <int D>
bool tops_on_faces(const Geology& geology, const Grid<D>& regular) {
  if (geology.layers.empty()) return false;
  const auto fit = fit_layers(regular, endless(geology.layers), {});
  return !fit.grid.rows && fit.left_out.empty();
}

template bool tops_on_faces(const Geology&, const Grid<2>&);
template bool tops_on_faces(const Geology&, const Grid<3>&);
template std::size_t tops_left_out(const Geology&, const Grid<2>&);
template std::size_t tops_left_out(const Geology&, const Grid<3>&);
template Medium<2> medium_of(const Geology&, const Grid<2>&);
template Medium<3> medium_of(const Geology&, const Grid<3>&);

}  // namespace slipwave
