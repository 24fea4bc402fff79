// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "base/small_matrix.hpp"
#include "rock/medium.hpp"

namespace slipwave {

/// What tells an orthorhombic rock from one that is alike in all horizontal directions (VTI): Tsvankin's
/// (1997) parameters of the plane of y and z, delta(3) of that of x and y, and gamma(2) (theory.md (O2)).
struct Orthorhombic {
  double epsilon1 = 0, delta1 = 0, delta3 = 0, gamma2 = 0;
  bool operator==(const Orthorhombic&) const = default;
};

/// The elastic constants of a rock that no parameters describe, along the axes of the grid, Pa: the upper
/// triangle of Voigt's matrix, row by row. Rock of 2-D may have those of the plane of x and z alone (c11,
/// c13, c15, c33, c35, c55); the others are 0 then.
using ElasticConstants = std::array<double, 21>;
/// The place of c_mn among them, m not above n.
constexpr std::size_t place_of_constant(int m, int n) { return std::size_t((m - 1) * (12 - m) / 2 + n - 1); }
/// The property that holds one, by its place.
constexpr Property constant_at(std::size_t place) { return Property(std::size_t(Property::c11) + place); }

/// Elastic constants, or none: most rock has none, and room for a pointer to them.
class ConstantsIfAny {
 public:
  ConstantsIfAny() = default;
  explicit ConstantsIfAny(const ElasticConstants& of) : of_(std::make_unique<ElasticConstants>(of)) {}
  ConstantsIfAny(const ConstantsIfAny& other) : of_(other.copy()) {}
  ConstantsIfAny(ConstantsIfAny&&) = default;
  ConstantsIfAny& operator=(const ConstantsIfAny& other) {
    if (of_ || other.of_) of_ = other.copy();
    return *this;
  }
  ConstantsIfAny& operator=(ConstantsIfAny&&) = default;
  ~ConstantsIfAny() = default;
  explicit operator bool() const { return of_ != nullptr; }
  const ElasticConstants& operator*() const { return *of_; }
  /// All 0 where there are none.
  ElasticConstants values() const { return of_ ? *of_ : ElasticConstants{}; }
  bool operator==(const ConstantsIfAny& other) const {
    return of_ && other.of_ ? *of_ == *other.of_ : !of_ && !other.of_;
  }

 private:
  std::unique_ptr<ElasticConstants> copy() const {
    return of_ ? std::make_unique<ElasticConstants>(*of_) : nullptr;
  }
  std::unique_ptr<ElasticConstants> of_;
};

/// What an elastic point of a medium is made of. vs = 0 is fluid, rho = 0 is void, as in Medium.
struct Material {
  double vp = 0, vs = 0;          // m/s
  double rho = 0;                 // kg/m3
  double epsilon = 0, delta = 0;  // of Thomsen; then vp and vs are those along the axis of symmetry
  double tilt = 0;                // of that axis from the vertical, degrees: the dip of beds, deepening to +x

  double gamma = 0;                               // of S waves in level directions, felt in 3-D alone
  std::optional<Orthorhombic> orthorhombic = {};  // none: alike in all horizontal directions
  // Of the axes in 3-D, degrees: where beds deepen, and their turn about the tilted axis (theory.md (O6)).
  double azimuth = 0, rotation = 0;

  /// Say all but the density: vp and vs are sqrt(c33/rho) and sqrt(c55/rho) then, the parameters 0.
  ConstantsIfAny constants = {};

  /// In 2-D and in 3-D.
  bool is_anisotropic() const { return epsilon != 0 || delta != 0 || constants; }
  bool is_anisotropic_in_3d() const { return is_anisotropic() || gamma != 0 || orthorhombic; }
  bool operator==(const Material&) const = default;
};

/// Whether a cell has elastic constants.
template <int D>
bool has_constants(const Medium<D>& medium, std::size_t cell) {
  return medium.has(Property::c33) && medium[Property::c33][cell] != 0 && !medium.is_void(cell);
}
/// Returns those of a cell of a medium that has some; nothing where all are 0, and in void.
template <int D>
ConstantsIfAny constants_of(const Medium<D>& medium, std::size_t cell);
template <int D>
void put_constants(Medium<D>& medium, std::size_t cell, const ElasticConstants& constants);

/// The material of a cell.
template <int D>
Material material_of(const Medium<D>& medium, std::size_t cell) {
  Material of = {double(medium.vp[cell]),
                 double(medium.vs[cell]),
                 double(medium.rho[cell]),
                 medium.value(Property::epsilon, cell),
                 medium.value(Property::delta, cell),
                 medium.value(Property::tilt, cell),
                 medium.value(Property::gamma, cell)};
  of.azimuth = medium.value(Property::azimuth, cell);
  of.rotation = medium.value(Property::rotation, cell);
  if (medium.has(Property::c33)) of.constants = constants_of(medium, cell);
  if (!medium.has(Property::epsilon1)) return of;
  const Orthorhombic found = {medium.value(Property::epsilon1, cell), medium.value(Property::delta1, cell),
                              medium.value(Property::delta3, cell), medium.value(Property::gamma2, cell)};
  if (!(found == Orthorhombic{of.epsilon, of.delta, 0, of.gamma})) of.orthorhombic = found;
  return of;
}

/// Writes the material of a cell, rounded to float.
template <int D>
void put(Medium<D>& medium, std::size_t cell, const Material& material) {
  medium.vp[cell] = float(material.vp);
  medium.vs[cell] = float(material.vs);
  medium.rho[cell] = float(material.rho);
  if (medium.has(Property::epsilon)) medium[Property::epsilon][cell] = float(material.epsilon);
  if (medium.has(Property::delta)) medium[Property::delta][cell] = float(material.delta);
  if (medium.has(Property::tilt)) medium[Property::tilt][cell] = float(material.tilt);
  if (medium.has(Property::gamma)) medium[Property::gamma][cell] = float(material.gamma);
  if (medium.has(Property::azimuth)) medium[Property::azimuth][cell] = float(material.azimuth);
  if (medium.has(Property::rotation)) medium[Property::rotation][cell] = float(material.rotation);
  if (medium.has(Property::c33)) put_constants(medium, cell, material.constants.values());
  if (!medium.has(Property::epsilon1)) return;
  const auto of =
      material.orthorhombic.value_or(Orthorhombic{material.epsilon, material.delta, 0, material.gamma});
  medium[Property::epsilon1][cell] = float(of.epsilon1), medium[Property::delta1][cell] = float(of.delta1);
  medium[Property::delta3][cell] = float(of.delta3), medium[Property::gamma2][cell] = float(of.gamma2);
}

/// Both solid, both fluid or both void.
bool same_kind(const Material& a, const Material& b);

/// Sums of flat layers of rocks of any elastic constants, by volume (theory.md (O5a)), with the components N
/// (zz, yz, xz) and T (xx, yy, xy) of stresses and strains.
struct SumsOfLayers {
  SmallMatrix<3> compliance{};  // NN^-1
  SmallMatrix<3> ratio{};       // NN^-1 NT
  SmallMatrix<3> plate{};       // TT - TN NN^-1 NT
};

/// The material that stands for a cell made of several (theory.md M1, M2): density is the arithmetic mean
/// over the parts, lambda + 2 mu and mu are the harmonic ones, weighted by volume. Where a part is
/// anisotropic the mean is that of flat layers of the parts (Backus 1962; theory.md V5), whose lambda + 2 mu
/// along the vertical and mu are the same; where their axes are tilted, that is the mean about the axis of
/// the largest anisotropic part. Where a part has elastic constants the layers lie level, and the mean has
/// elastic constants, too (theory.md (O5a)). Only parts of the kind of the cell's centre count, so nothing is
/// ever averaged across an interface of solid, fluid and void. Parts may come from anywhere: pieces cut off
/// by planes, smaller cells, samples of a curved horizon.
class MaterialMean {
 public:
  /// `any_constants`: parts may have elastic constants.
  explicit MaterialMean(const Material& centre, bool any_constants = false) : centre_(centre) {
    if (any_constants) sums_.emplace();
  }
  /// A part of the cell; volumes need not add up to anything. Says whether it counts.
  bool add(const Material& part, double volume);
  /// The mean; where all that counts is one material, exactly that. The centre's if nothing was added.
  Material mean() const;
  /// The mean of flat layers of the parts, also where all of them are isotropic: then its epsilon and delta
  /// are those about the normal of whatever cuts the cell (theory.md (T1)), and its speeds and density those
  /// of mean(). The centre's where all that counts is one material, or fluid.
  Material of_layers() const;
  /// Whether a part is anisotropic by itself.
  bool has_anisotropic_part() const { return anisotropic_; }

 private:
  Material of_any_layers() const;

  Material centre_, first_;
  bool uniform_ = true;
  double volume_ = 0;                                      // of what counts
  double mass_ = 0, compliance_p_ = 0, compliance_s_ = 0;  // sums of volume times rho, 1/(lambda+2mu), 1/mu
  double ratio_ = 0, plate_ = 0;  // of anisotropic parts and others: volume times c13/c33, c11 - c13^2/c33
  // The same along y, of c12 in the plane of both, and volume times c66 and 1/c44.
  double ratio_y_ = 0, plate_y_ = 0, plate_xy_ = 0, level_ = 0, compliance_yz_ = 0;
  bool anisotropic_ = false, constants_ = false;
  std::optional<SumsOfLayers> sums_;
  // Of the axes of the largest anisotropic part.
  double tilt_ = 0, azimuth_ = 0, rotation_ = 0, tilted_volume_ = 0;
};

/// The mean of a property that stands by itself, over the parts of a cell that count for MaterialMean.
class ScalarMean {
 public:
  /// `centre` is the mean while nothing is added.
  ScalarMean(Mean rule, float centre) : rule_(rule), centre_(double(centre)) {}
  void add(float part, double volume);
  double mean() const;

 private:
  Mean rule_;
  double centre_;
  double volume_ = 0, sum_ = 0;  // sum: of volume times the value, or its inverse
};

}  // namespace slipwave
