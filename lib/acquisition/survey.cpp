#include "acquisition/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {

namespace {

template <int D>
std::string expected_mechanisms() {
  return D == 2 ? "expected explosion, force:AX,AZ, moment:MXX,MZZ,MXZ or plane:ANGLE"
                : "expected explosion, force:AX,AY,AZ, moment:MXX,MYY,MZZ,MXY,MXZ,MYZ or plane:ANGLE";
}

/// `count` numbers that are not all zero.
template <int D>
std::vector<double> components(const std::string& text, const std::string& list, std::size_t count) {
  auto numbers = in_place("source kind '" + text + "'", [&] { return parse_numbers(list, ','); });
  if (numbers.size() != count)
    throw Error("source kind '" + text + "': found " + std::to_string(numbers.size()) + " numbers, " +
                    expected_mechanisms<D>(),
                ErrorKind::usage);
  if (std::all_of(numbers.begin(), numbers.end(), [](double v) { return v == 0; }))
    throw Error("source kind '" + text + "': found only zeros, expected a source that does something",
                ErrorKind::usage);
  return numbers;
}

template <int D>
PlaneWave<D> plane_wave(const std::string& text, const std::string& number) {
  const double angle = in_place("source kind '" + text + "'", [&] { return parse_number(number); });
  if (!(std::abs(angle) <= 360))
    throw Error(
        "source kind '" + text + "': found an angle of " + shown(angle) + " degrees, expected -360 to 360",
        ErrorKind::usage);
  // Multiples of 90 degrees travel along the grid exactly.
  const auto exact_sine = [](double degrees) {
    const double turned = std::remainder(degrees, 360.);
    if (std::fmod(turned, 180.) == 0) return 0.;
    return turned == 90 ? 1. : turned == -90 ? -1. : std::sin(turned * std::numbers::pi / 180);
  };
  PlaneWave<D> wave;
  wave.angle_deg = angle;
  wave.direction[0] = exact_sine(angle);
  wave.direction[D - 1] = exact_sine(angle + 90);
  return wave;
}

template <int D>
void check_inside(const std::string& what, const Point<D>& point, const Grid<D>& grid) {
  bool inside = true;
  for (int axis = 0; axis < D; ++axis)
    inside = inside && point[axis] >= grid.origin_m[axis] && point[axis] <= grid.end(axis);
  if (inside) return;
  std::string place, extent;
  for (int axis = 0; axis < D; ++axis) {
    const std::string name(1, axis_names<D>()[axis]), separator = axis == 0 ? "" : " ";
    place += separator + name + "=" + shown(point[axis]);
    extent += separator + name + "=" + shown(grid.origin_m[axis]) + ".." + shown(grid.end(axis));
  }
  throw Error(what + " at " + place + " lies outside the model, expected " + extent);
}

}  // namespace

template <int D>
std::optional<PointInjection<D>> point_injection(const Source<D>& source) {
  PointInjection<D> injection;
  if (std::holds_alternative<Explosion>(source.mechanism)) {
    for (int axis = 0; axis < D; ++axis) injection.moment_rate(axis, axis) = source.amplitude;
  } else if (const auto* force = std::get_if<PointForce<D>>(&source.mechanism)) {
    for (int axis = 0; axis < D; ++axis) injection.force[axis] = source.amplitude * force->vector[axis];
  } else if (const auto* moment = std::get_if<MomentTensor<D>>(&source.mechanism)) {
    for (std::size_t i = 0; i < moment->tensor.values.size(); ++i)
      injection.moment_rate.values[i] = source.amplitude * moment->tensor.values[i];
  } else {
    return {};
  }
  return injection;
}

template <int D>
Mechanism<D> parse_mechanism(const std::string& text) {
  if (text == "explosion") return Explosion{};
  const auto colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon != std::string::npos) {
    const std::string list = text.substr(colon + 1);
    if (kind == "force") {
      PointForce<D> force;
      const auto numbers = components<D>(text, list, force.vector.size());
      std::copy(numbers.begin(), numbers.end(), force.vector.begin());
      return force;
    }
    if (kind == "moment") {
      MomentTensor<D> moment;
      const auto numbers = components<D>(text, list, moment.tensor.values.size());
      std::copy(numbers.begin(), numbers.end(), moment.tensor.values.begin());
      return moment;
    }
    if (kind == "plane") return plane_wave<D>(text, list);
  }
  throw Error("source kind: found '" + text + "', " + expected_mechanisms<D>(), ErrorKind::usage);
}

template <int D>
const char* name_of(const Mechanism<D>& mechanism) {
  constexpr const char* names[] = {"explosion", "force", "moment", "plane"};
  return names[mechanism.index()];
}

template <int D>
void check(const Survey<D>& survey, const Grid<D>& grid) {
  for (std::size_t n = 0; n < survey.sources.size(); ++n) {
    const auto& source = survey.sources[n];
    if (!std::isfinite(source.amplitude))
      throw Error("source " + std::to_string(n + 1) +
                  ": found an amplitude that is not finite, expected a number");
    if (!std::holds_alternative<PlaneWave<D>>(source.mechanism))
      check_inside<D>("source " + std::to_string(n + 1), source.position_m, grid);
  }
  for (std::size_t n = 0; n < survey.receivers_m.size(); ++n)
    check_inside<D>("receiver " + std::to_string(n + 1), survey.receivers_m[n], grid);
}

template std::optional<PointInjection<2>> point_injection<2>(const Source<2>&);
template std::optional<PointInjection<3>> point_injection<3>(const Source<3>&);
template Mechanism<2> parse_mechanism<2>(const std::string&);
template Mechanism<3> parse_mechanism<3>(const std::string&);
template const char* name_of<2>(const Mechanism<2>&);
template const char* name_of<3>(const Mechanism<3>&);
template void check<2>(const Survey<2>&, const Grid<2>&);
template void check<3>(const Survey<3>&, const Grid<3>&);

}  // namespace slipwave
