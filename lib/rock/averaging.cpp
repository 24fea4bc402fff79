// SPDX-License-Identifier: BSD-3-Clause
#include "rock/averaging.hpp"

#include <cmath>

#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"

namespace slipwave {
namespace {

constexpr std::array<std::size_t, 3> across_layers = {2, 3, 4}, along_layers = {0, 1, 5};

SmallMatrix<3> block_of(const SmallMatrix<6>& c, const std::array<std::size_t, 3>& rows,
                        const std::array<std::size_t, 3>& columns) {
  SmallMatrix<3> block;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) block[i][k] = c[rows[i]][columns[k]];
  return block;
}

void add_layer(SumsOfLayers& sums, Elasticity<3> c, double volume) {
  // Of rock of the plane of x and z: what moves across that moves by itself.
  if (c(4, 4) == 0) c.set(4, 4, c(5, 5));
  const auto inverse = inverse_of(block_of(c.voigt, across_layers, across_layers));
  const auto coupled = block_of(c.voigt, along_layers, across_layers);
  const auto ratio = product_of(inverse, transposed(coupled));
  sums.compliance = sum_of(sums.compliance, inverse, volume);
  sums.ratio = sum_of(sums.ratio, ratio, volume);
  sums.plate =
      sum_of(sums.plate,
             sum_of(block_of(c.voigt, along_layers, along_layers), product_of(coupled, ratio), -1.), volume);
}

}  // namespace

template <int D>
ConstantsIfAny constants_of(const Medium<D>& medium, std::size_t cell) {
  ElasticConstants constants;
  bool any = false;
  for (std::size_t n = 0; n < constants.size(); ++n) {
    constants[n] = medium.value(constant_at(n), cell);
    any = any || constants[n] != 0;
  }
  return any && !medium.is_void(cell) ? ConstantsIfAny(constants) : ConstantsIfAny();
}

template <int D>
void put_constants(Medium<D>& medium, std::size_t cell, const ElasticConstants& constants) {
  for (std::size_t n = 0; n < constants.size(); ++n)
    if (const auto property = constant_at(n); medium.has(property))
      medium[property][cell] = float(constants[n]);
}

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
    constants_ = constants_ || part.constants;
    if (sums_) add_layer(*sums_, elasticity_of<3>(part), volume);
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
  if (constants_) return of_any_layers();
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

Material MaterialMean::of_any_layers() const {
  const double share = 1 / volume_;
  const auto stiffness = inverse_of(times(sums_->compliance, share)), ratio = times(sums_->ratio, share);
  const auto mixed = product_of(stiffness, ratio),
             level = sum_of(times(sums_->plate, share), product_of(transposed(ratio), mixed));
  Elasticity<3> mean;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto n = across_layers[i], m = across_layers[k], t = along_layers[k];
      mean.voigt[n][m] = stiffness[i][k], mean.voigt[along_layers[i]][t] = level[i][k];
      mean.voigt[n][t] = mean.voigt[t][n] = mixed[i][k];
    }
  return rock_of_constants<3>(mean, mass_ * share);
}

void ScalarMean::add(float part, double volume) {
  volume_ += volume;
  sum_ += rule_ == Mean::harmonic ? volume / double(part) : volume * double(part);
}

double ScalarMean::mean() const {
  if (volume_ == 0) return centre_;
  return rule_ == Mean::harmonic ? volume_ / sum_ : sum_ / volume_;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, put_constants);
template ConstantsIfAny constants_of(const Medium<2>&, std::size_t);
template ConstantsIfAny constants_of(const Medium<3>&, std::size_t);

}  // namespace slipwave
