// SPDX-License-Identifier: BSD-3-Clause
#include "model/compliance.hpp"

#include <array>

#include "base/error.hpp"
#include "base/parse.hpp"

namespace slipwave {
namespace {

/// "NORMAL,TANGENTIAL", neither below zero.
std::array<double, 2> pair_of(const std::string& option, const std::string& text) {
  return in_place(option, [&] {
    const auto numbers = parse_numbers(text, ',');
    if (numbers.size() != 2 || !(numbers[0] >= 0) || !(numbers[1] >= 0))
      refuse("found '" + text + "', expected two numbers not below zero");
    return std::array{numbers[0], numbers[1]};
  });
}

double above_zero(const std::string& option, const std::optional<double>& value, const std::string& unit) {
  if (!value) refuse(option + " is missing");
  if (!(*value > 0)) refuse(option + ": found " + shown(*value) + ", expected it above zero" + unit);
  return *value;
}

LinearCompliance of_cracks(const ComplianceText& text) {
  if (!text.compliance.empty() || !text.stiffness.empty() || text.spacing_m || !text.dashpot.empty())
    refuse(
        "--crack-density says what --compliance, --stiffness, --spacing and --dashpot say of planes; "
        "give cracks or planes");
  LinearCompliance of;
  of.crack_density = above_zero("--crack-density", text.crack_density, "");
  if (text.fill_pa && !(*text.fill_pa >= 0))
    refuse("--fill: found " + shown(*text.fill_pa) + ", expected a bulk modulus not below zero, Pa");
  of.fill_pa = text.fill_pa.value_or(0);
  if (text.aspect) of.aspect = above_zero("--aspect", text.aspect, "");
  if (of.aspect > 1) refuse("--aspect: found " + shown(of.aspect) + ", expected it at most 1");
  if (of.fill_pa > 0 && !text.aspect) refuse("--fill needs --aspect: thin cracks are stiffer when filled");
  if (text.aspect && !(of.fill_pa > 0))
    refuse(
        "--aspect needs a --fill above zero: the compliance of dry cracks does not depend on their "
        "thickness");
  return of;
}

}  // namespace

bool ComplianceText::given() const {
  return !compliance.empty() || !stiffness.empty() || !dashpot.empty() || spacing_m || crack_density ||
         aspect || fill_pa;
}

LinearCompliance parse_compliance(const ComplianceText& text, bool single) {
  if (text.crack_density) return of_cracks(text);
  if (text.aspect || text.fill_pa) refuse("--aspect and --fill need --crack-density");
  if (text.compliance.empty() == text.stiffness.empty())
    refuse(text.compliance.empty() ? "--spacing and --dashpot need --compliance or --stiffness"
                                   : "found --compliance and --stiffness, give one of both");
  LinearCompliance of;
  if (!text.compliance.empty()) {
    const auto [normal, tangential] = pair_of("--compliance", text.compliance);
    if (normal == 0 && tangential == 0)
      refuse("--compliance: found '" + text.compliance + "', expected one of both above zero");
    of.normal_m_per_pa = normal, of.tangential_m_per_pa = tangential;
  } else {
    const auto [normal, tangential] = pair_of("--stiffness", text.stiffness);
    if (normal == 0 || tangential == 0)
      refuse("--stiffness: found '" + text.stiffness + "', expected both above zero, Pa/m");
    of.normal_m_per_pa = 1 / normal, of.tangential_m_per_pa = 1 / tangential;
  }
  if (single) return of;
  of.spacing_m = above_zero("--spacing", text.spacing_m, ", the distance between planes in m");
  if (!text.dashpot.empty()) {
    const auto [normal, tangential] = pair_of("--dashpot", text.dashpot);
    of.normal_dashpot_pa_s_m = normal, of.tangential_dashpot_pa_s_m = tangential;
  }
  return of;
}

}  // namespace slipwave
