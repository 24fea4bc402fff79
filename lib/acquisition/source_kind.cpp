// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/source_kind.hpp"

#include <algorithm>
#include <cmath>

#include "acquisition/direction.hpp"
#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

template <int D>
std::string notation_of(const SourceKind<D>& kind) {
  return kind.name + (*kind.parameters ? ":" + std::string(kind.parameters) : "");
}

template <int D>
std::string expected_kinds() {
  std::vector<std::string> notations;
  for (const auto& kind : source_kinds<D>()) notations.push_back(notation_of(kind));
  return "expected " + joined(notations, " or ");
}

/// `count` numbers that are not all zero.
template <int D>
std::vector<double> numbers_of(const std::string& text, const std::string& list, std::size_t count) {
  auto numbers = in_place("source kind '" + text + "'", [&] { return parse_numbers(list, ','); });
  if (numbers.size() != count)
    throw Error("source kind '" + text + "': found " + std::to_string(numbers.size()) + " numbers, " +
                    expected_kinds<D>(),
                ErrorKind::usage);
  if (std::all_of(numbers.begin(), numbers.end(), [](double v) { return v == 0; }))
    throw Error("source kind '" + text + "': found only zeros, expected a source that does something",
                ErrorKind::usage);
  return numbers;
}

template <int D>
Mechanism<D> parse_explosion(const std::string&, const std::string&) {
  return Explosion{};
}

template <int D>
void inject_explosion(const Mechanism<D>&, double amplitude, PointInjection<D>& injection) {
  injection.isotropic = true;
  for (int axis = 0; axis < D; ++axis) injection.moment_rate(axis, axis) = amplitude;
}

template <int D>
Mechanism<D> parse_force(const std::string& text, const std::string& parameters) {
  PointForce<D> force;
  const auto numbers = numbers_of<D>(text, parameters, force.vector.size());
  std::copy(numbers.begin(), numbers.end(), force.vector.begin());
  return force;
}

template <int D>
void inject_force(const Mechanism<D>& mechanism, double amplitude, PointInjection<D>& injection) {
  const auto& vector = std::get<PointForce<D>>(mechanism).vector;
  for (std::size_t axis = 0; axis < vector.size(); ++axis) injection.force[axis] = amplitude * vector[axis];
}

template <int D>
Mechanism<D> parse_moment(const std::string& text, const std::string& parameters) {
  MomentTensor<D> moment;
  const auto numbers = numbers_of<D>(text, parameters, moment.tensor.values.size());
  std::copy(numbers.begin(), numbers.end(), moment.tensor.values.begin());
  return moment;
}

template <int D>
void inject_moment(const Mechanism<D>& mechanism, double amplitude, PointInjection<D>& injection) {
  const auto& values = std::get<MomentTensor<D>>(mechanism).tensor.values;
  for (std::size_t i = 0; i < values.size(); ++i) injection.moment_rate.values[i] = amplitude * values[i];
}

template <int D>
Mechanism<D> parse_plane_wave(const std::string& text, const std::string& parameters) {
  const auto numbers = in_place("source kind '" + text + "'", [&] {
    return parameters.find(',') == std::string::npos ? std::vector<double>{parse_number(parameters)}
                                                     : parse_numbers(parameters, ',');
  });
  if (numbers.size() > (D == 2 ? 1 : 2))
    throw Error("source kind '" + text + "': found " + std::to_string(numbers.size()) + " numbers, " +
                    expected_kinds<D>(),
                ErrorKind::usage);
  for (const double angle : numbers)
    if (!(std::abs(angle) <= 360))
      throw Error(
          "source kind '" + text + "': found an angle of " + shown(angle) + " degrees, expected -360 to 360",
          ErrorKind::usage);
  PlaneWave<D> wave;
  wave.angle_deg = numbers[0];
  wave.direction[0] = sine_of_degrees(wave.angle_deg);
  wave.direction[D - 1] = cosine_of_degrees(wave.angle_deg);
  if (numbers.size() == 1) return wave;
  wave.azimuth_deg = numbers[1];
  wave.along = {cosine_of_degrees(wave.azimuth_deg), sine_of_degrees(wave.azimuth_deg)};
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    wave.direction[axis] = sine_of_degrees(wave.angle_deg) * wave.along[axis];
  return wave;
}

/// An S wave that travels down moves towards +x when its wavelet is positive.
template <int D>
Mechanism<D> parse_plane_s_wave(const std::string& text, const std::string& parameters) {
  auto wave = std::get<PlaneWave<D>>(parse_plane_wave<D>(text, parameters));
  wave.shear = true;
  return wave;
}

/// An angle of the source kind within -most .. most degrees, least .. most where it is given.
double angle_of(const std::string& text, const char* name, double angle, double least, double most) {
  if (angle >= least && angle <= most) return angle;
  throw Error("source kind '" + text + "': found " + name + " " + shown(angle) + " degrees, expected " +
                  shown(least) + " to " + shown(most),
              ErrorKind::usage);
}

/// Aki & Richards (2002), box 4.4, with x as north and y as east.
template <int D>
Mechanism<D> parse_double_couple(const std::string& text, const std::string& parameters) {
  const auto numbers = in_place("source kind '" + text + "'", [&] { return parse_numbers(parameters, ','); });
  if (numbers.size() != (D == 2 ? 1 : 3))
    throw Error("source kind '" + text + "': found " + std::to_string(numbers.size()) + " numbers, " +
                    expected_kinds<D>(),
                ErrorKind::usage);
  const double strike = D == 2 ? 270 : angle_of(text, "STRIKE", numbers[0], -360, 360);
  const double dip = angle_of(text, "DIP", numbers[D == 2 ? 0 : 1], D == 2 ? -180 : 0, D == 2 ? 180 : 90);
  const double rake = D == 2 ? 90 : angle_of(text, "RAKE", numbers[2], -360, 360);
  const auto sine = sine_of_degrees, cosine = cosine_of_degrees;
  const double along = cosine(rake), up = sine(rake);
  MomentTensor<D> moment;
  auto& m = moment.tensor;
  constexpr int x = 0, z = D - 1;
  m(x, x) = -(sine(dip) * along * sine(2 * strike) + sine(2 * dip) * up * sine(strike) * sine(strike));
  m(z, z) = sine(2 * dip) * up;
  m(x, z) = -(cosine(dip) * along * cosine(strike) + cosine(2 * dip) * up * sine(strike));
  if constexpr (D == 3) {
    m(1, 1) = sine(dip) * along * sine(2 * strike) - sine(2 * dip) * up * cosine(strike) * cosine(strike);
    m(0, 1) = sine(dip) * along * cosine(2 * strike) + sine(2 * dip) * up * sine(2 * strike) / 2;
    m(1, 2) = -(cosine(dip) * along * sine(strike) - cosine(2 * dip) * up * cosine(strike));
  }
  return moment;
}

template <int D>
constexpr SourceKind<D> kinds[] = {
    {"explosion", "", "", D == 2 ? "N m/s per m" : "N m/s", parse_explosion<D>, inject_explosion<D>},
    {"force", D == 2 ? "AX,AZ" : "AX,AY,AZ", "", D == 2 ? "N/m" : "N", parse_force<D>, inject_force<D>},
    {"moment", D == 2 ? "MXX,MZZ,MXZ" : "MXX,MYY,MZZ,MXY,MXZ,MYZ", "", D == 2 ? "N m/s per m" : "N m/s",
     parse_moment<D>, inject_moment<D>},
    {"plane", D == 2 ? "ANGLE" : "ANGLE[,AZIMUTH]", "degrees, 0 is down", "m/s", parse_plane_wave<D>,
     nullptr},
    {"double-couple", D == 2 ? "DIP" : "STRIKE,DIP,RAKE", "", D == 2 ? "N m/s per m" : "N m/s",
     parse_double_couple<D>, inject_moment<D>},
    {"plane-s", D == 2 ? "ANGLE" : "ANGLE[,AZIMUTH]", "SV", "m/s", parse_plane_s_wave<D>, nullptr},
};

static_assert(std::size(kinds<2>) >= std::variant_size_v<Mechanism<2>>);

}  // namespace

template <int D>
std::span<const SourceKind<D>> source_kinds() {
  return kinds<D>;
}

template <int D>
Mechanism<D> parse_mechanism(const std::string& text) {
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  for (const auto& kind : source_kinds<D>()) {
    const bool any_parameter = *kind.parameters != '\0';
    if (name == kind.name && any_parameter == (colon != std::string::npos))
      return kind.parse(text, any_parameter ? text.substr(colon + 1) : "");
  }
  throw Error("source kind: found '" + text + "', " + expected_kinds<D>(), ErrorKind::usage);
}

template <int D>
const char* name_of(const Mechanism<D>& mechanism) {
  if (const auto* wave = std::get_if<PlaneWave<D>>(&mechanism); wave && wave->shear) return "plane-s";
  return source_kinds<D>()[mechanism.index()].name;
}

template <int D>
std::optional<PointInjection<D>> point_injection(const Source<D>& source) {
  const auto inject = source_kinds<D>()[source.mechanism.index()].inject;
  if (!inject) return {};
  PointInjection<D> injection;
  inject(source.mechanism, source.amplitude, injection);
  return injection;
}

std::string source_kind_help() {
  std::vector<std::string> notations, others;
  for (std::size_t n = 0; n < std::size(kinds<2>); ++n) {
    const auto& kind = kinds<2>[n];
    const std::string own = notation_of(kind), other = notation_of(kinds<3>[n]);
    notations.push_back(own + (*kind.remark ? " (" + std::string(kind.remark) + ")" : ""));
    if (own != other) others.push_back(other);
  }
  return joined(notations, " or ") + "; in 3-D " + joined(others);
}

std::string amplitude_help() {
  std::string help;
  std::vector<std::string> units, others;
  const auto add = [](std::vector<std::string>& to, const std::string& unit) {
    if (std::find(to.begin(), to.end(), unit) != to.end()) return false;
    to.push_back(unit);
    return true;
  };
  for (std::size_t n = 0; n < std::size(kinds<2>); ++n) {
    const std::string unit = kinds<2>[n].amplitude_unit, other = kinds<3>[n].amplitude_unit;
    if (unit != other) add(others, other);
    if (!add(units, unit)) continue;
    std::vector<std::string> names;
    for (const auto& kind : kinds<2>)
      if (kind.amplitude_unit == unit) names.emplace_back(kind.name);
    help += joined(names) + ": " + unit + "; ";
  }
  return help + "in 3-D " + joined(others, " and ");
}

/// A moment lasts where the integral of its wavelet is more than this share of its spectrum at its own
/// frequency: with less, what (A8a) keeps from moving on is less than 1 % of the waves.
constexpr double lasting_share = 0.01;

template <int D>
Moment moment_of(const Source<D>& source) {
  const auto& wavelet = source.wavelet;
  const double stays = wavelet.amplitude_spectrum(0);
  if (stays <= lasting_share * wavelet.amplitude_spectrum(wavelet.nominal_hz())) return Moment::passing;
  const auto injection = point_injection(source);
  for (int i = 0; injection && i < D; ++i)
    for (int j = i; j < D; ++j)
      if (injection->moment_rate(i, j) != 0) return Moment::lasting;
  return Moment::passing;
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, source_kinds);
SLIPWAVE_INSTANTIATE_D(FUNCTION, point_injection);
SLIPWAVE_INSTANTIATE_D(FUNCTION, moment_of);
SLIPWAVE_INSTANTIATE_D(FUNCTION, parse_mechanism);
SLIPWAVE_INSTANTIATE_D(FUNCTION, name_of);

}  // namespace slipwave
