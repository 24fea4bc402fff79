// SPDX-License-Identifier: BSD-3-Clause
#include "rock/averaging.hpp"

#include <cmath>

#include "rock/anisotropy.hpp"

namespace slipwave {

bool same_kind(const Material& a, const Material& b) {
  return (a.rho == 0) == (b.rho == 0) && (a.rho == 0 || (a.vs == 0) == (b.vs == 0));
}

bool MaterialMean::add(const Material& part, double volume) {
  if (!(volume > 0) || !same_kind(part, centre_)) return false;
  if (volume_ == 0) first_ = part;
  uniform_ = uniform_ && part == first_;
  volume_ += volume;
  mass_ += volume * part.rho;
  if (part.rho > 0) compliance_p_ += volume / (part.rho * part.vp * part.vp);
  if (part.vs > 0) compliance_s_ += volume / (part.rho * part.vs * part.vs);
  if (part.vs > 0) {
    const auto c = upright_elasticity<3>(part);
    anisotropic_ = anisotropic_ || part.is_anisotropic_in_3d();
    if (part.is_anisotropic_in_3d() && volume > tilted_volume_) {
      tilted_volume_ = volume;
      tilt_ = part.tilt, azimuth_ = part.azimuth, rotation_ = part.rotation;
    }
    ratio_ += volume * c(1, 3) / c(3, 3);
    plate_ += volume * (c(1, 1) - c(1, 3) * c(1, 3) / c(3, 3));
    ratio_y_ += volume * c(2, 3) / c(3, 3);
    plate_y_ += volume * (c(2, 2) - c(2, 3) * c(2, 3) / c(3, 3));
    plate_xy_ += volume * (c(1, 2) - c(1, 3) * c(2, 3) / c(3, 3));
    level_ += volume * c(6, 6);
    compliance_yz_ += volume / c(4, 4);
  }
  return true;
}

Material MaterialMean::mean() const {
  if (volume_ == 0) return centre_;
  if (uniform_) return first_;
  // All parts are of one kind and differ, so none is void.
  if (anisotropic_) return of_layers();
  return {std::sqrt(volume_ * volume_ / (compliance_p_ * mass_)),
          compliance_s_ > 0 ? std::sqrt(volume_ * volume_ / (compliance_s_ * mass_)) : 0, mass_ / volume_};
}

Material MaterialMean::of_layers() const {
  if (volume_ == 0 || uniform_ || compliance_s_ == 0) return mean();
  const double c33 = volume_ / compliance_p_, ratio = ratio_ / volume_;
  const double ratio_y = ratio_y_ / volume_;
  auto mean = material_of(
      orthorhombic({plate_ / volume_ + c33 * ratio * ratio, plate_y_ / volume_ + c33 * ratio_y * ratio_y, c33,
                    volume_ / compliance_yz_, volume_ / compliance_s_, level_ / volume_,
                    plate_xy_ / volume_ + c33 * ratio * ratio_y, c33 * ratio, c33 * ratio_y}),
      mass_ / volume_);
  // Rounding makes no isotropic rock of one with an axis; parts may make one.
  if (mean.is_anisotropic_in_3d()) mean.tilt = tilt_, mean.azimuth = azimuth_, mean.rotation = rotation_;
  return mean;
}

void ScalarMean::add(float part, double volume) {
  volume_ += volume;
  sum_ += rule_ == Mean::harmonic ? volume / double(part) : volume * double(part);
}

double ScalarMean::mean() const {
  if (volume_ == 0) return centre_;
  return rule_ == Mean::harmonic ? volume_ / sum_ : sum_ / volume_;
}

}  // namespace slipwave
