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

}  // namespace

template <int D>
Medium<D> medium_of(const Geology& geology, const Grid<D>& regular) {
  if (geology.marmousi) return marmousi_medium_of(geology, regular);
  auto layers = geology.layers;
  for (auto& layer : layers) {
    auto shape = layer.top.shape();
    shape.endless = true;
    layer.top = Horizon(std::move(shape));
  }
  const auto fit = fit_layers(regular, layers, as_can_be(geology.fit));
  return layered_medium(fit.grid, layers, geology.average, fit.rows);
}

template Medium<2> medium_of(const Geology&, const Grid<2>&);
template Medium<3> medium_of(const Geology&, const Grid<3>&);

}  // namespace slipwave
