#include "model/relations.hpp"

#include <cmath>

namespace slipwave {

template <int D>
Field<D> vs_by_castagna(const Field<D>& vp, double fluid_vp) {
  Field<D> vs(vp.grid());
  for (std::size_t cell = 0; cell < vp.size(); ++cell) {
    const double speed = double(vp[cell]);
    // NaN passes on, so that check() names the cell.
    vs[cell] = speed <= fluid_vp ? 0 : float(std::fmax((speed - 1360) / 1.16, 0));
    if (std::isnan(speed)) vs[cell] = vp[cell];
  }
  return vs;
}

template <int D>
Field<D> rho_by_gardner(const Field<D>& vp, const Field<D>& vs) {
  Field<D> rho(vp.grid());
  for (std::size_t cell = 0; cell < vp.size(); ++cell) {
    if (vp[cell] == 0) {
      rho[cell] = 0;
    } else if (vs[cell] == 0) {
      rho[cell] = water_density;
    } else {
      rho[cell] = float(310 * std::pow(double(vp[cell]), 0.25));
    }
  }
  return rho;
}

template Field<2> vs_by_castagna(const Field<2>&, double);
template Field<3> vs_by_castagna(const Field<3>&, double);
template Field<2> rho_by_gardner(const Field<2>&, const Field<2>&);
template Field<3> rho_by_gardner(const Field<3>&, const Field<3>&);

}  // namespace slipwave
