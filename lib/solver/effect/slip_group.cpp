// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/slip_group.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/instantiate.hpp"
#include "model/cluster_edge.hpp"
#include "model/fracture.hpp"
#include "solver/effect/slip_planes.hpp"

namespace slipwave::solver {
namespace {

constexpr std::size_t lanes = std::size_t(Layout<2>::block);

/// mu of a cell whose planes both give way and slide: what slip takes off the traction (S23).
template <int D>
double shear_modulus_above_springs(const std::vector<SlipSystem<D>>& systems, double lambda, double mu,
                                   double share, double dt_s) {
  double follows = 0;
  for (const auto& system : systems) {
    const auto of = in_share(compliance_of<D>(system, true, lambda, mu), share);
    follows += slip::spring_step(mu, of.tangential, of.tangential_damping, dt_s).follows;
  }
  return slip::modulus_above_springs(mu, follows);
}

}  // namespace

template <int D, class Real>
SlipGroup<D, Real>::SlipGroup(const Layout<D>& layout, const Domain<D>& domain, const Scene<D>& scene,
                              const CellsOfSet& of, double dt_s, double unit)
    : set_(&scene.model.fracture_sets[of.set]),
      unit_(unit),
      places_(layout, domain, scene.model, of.set, of.kind),
      count_(places_.stored()) {
  if (of.kind == CellKind::cut) cut_.emplace(count_);
  planes_ = planes_of<D, Real>(set_->systems, unit);
  fill(domain, scene, layout, of.askew, dt_s);
  choose_kernels(scene.numerics.correction);
}

namespace {

/// What a unit of slip strain on planes takes off the stress, C : (n t + t n)/2 with t = (-n_z, n_x).
std::array<double, 3> stress_of_slip(const Point<2>& n, const Elasticity<2>& c) {
  return stress_of_strain<2>(c, {-n[0] * n[1], n[1] * n[0], n[0] * n[0] - n[1] * n[1]});
}

/// Returns the traction along t that a stress has on planes with the normal n.
double traction_along(const Point<2>& n, const std::array<double, 3>& stress) {
  return n[0] * n[1] * (stress[1] - stress[0]) + (n[0] * n[0] - n[1] * n[1]) * stress[2];
}

/// Fills in the response of planes with that normal, and returns the modulus that relaxation counts.
template <class Real>
double respond(PlaneResponse<2, Real>& response, const Point<2>& normal, const Elasticity<2>& c) {
  const auto stress = stress_of_slip(normal, c);
  const double modulus = traction_along(normal, stress);
  for (std::size_t k = 0; k < stress.size(); ++k) response.stress.values[k] = Real(stress[k] / modulus);
  return modulus;
}
template <class Real>
double respond(PlaneResponse<3, Real>& response, const Point<3>& n, const Elasticity<3>& c) {
  // What slip along either tangent takes off the stress, and off the traction along both.
  auto along = tangents_of<3>(n);
  const auto stress_along = [&](const Point<3>& t) {
    return stress_of_strain<3>(c, {n[0] * t[0], n[1] * t[1], n[2] * t[2], n[0] * t[1] + n[1] * t[0],
                                   n[0] * t[2] + n[2] * t[0], n[1] * t[2] + n[2] * t[1]});
  };
  const auto traction = [&](const std::array<double, 6>& s, const Point<3>& t) {
    Point<3> of;
    resolve<3, double>(n, {s}, of);
    return of[0] * t[0] + of[1] * t[1] + of[2] * t[2];
  };
  const auto one = stress_along(along[0]), other = stress_along(along[1]);
  const double a = traction(one, along[0]), b = traction(other, along[1]), mixed = traction(one, along[1]);
  // Turned so that neither takes anything off the traction along the other.
  const double angle = std::atan2(2 * mixed, a - b) / 2, cosine = std::cos(angle), sine = std::sin(angle);
  for (std::size_t i = 0; i < 3; ++i) {
    const double before = along[0][i];
    along[0][i] = cosine * before + sine * along[1][i], along[1][i] = cosine * along[1][i] - sine * before;
  }
  const double larger = traction(stress_along(along[0]), along[0]);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto stress = stress_along(along[k]);
    const double modulus = traction(stress, along[k]);
    response.share[k] = Real(modulus / larger);
    for (std::size_t i = 0; i < 3; ++i) response.along[k][i] = Real(along[k][i]);
    for (std::size_t m = 0; m < 6; ++m) response.stress[k].values[m] = Real(stress[m] / modulus);
  }
  return larger;
}

}  // namespace

template <int D, class Real>
std::vector<double> SlipGroup<D, Real>::put_response(std::size_t place, const Elasticity<D>& stiffness) {
  if (!stiffness_.empty()) stiffness_[place] = stiffness;
  const auto& systems = set_->systems;
  std::vector<double> moduli;
  for (std::size_t n = 0; n < systems.size(); ++n)
    moduli.push_back(
        respond(responses_[place * systems.size() + n], unit_normal<D>(systems[n].normal), stiffness));
  return moduli;
}

/// The part of a cut cell that slips is loaded as the cell is where planes open, have springs or lie askew to
/// the axes of anisotropic rock.
template <int D, class Real>
double SlipGroup<D, Real>::put_edge(const Model<D>& model, std::size_t place, std::size_t cell, double lambda,
                                    double mu) {
  const double share = fracture_share_of(model, cell);
  const auto edge = edge_normal(model, cell);
  const bool as_loaded = gives(*set_) || opens() || !responses_.empty();
  const double held = as_loaded ? 0 : held_share_of_all(edge, lambda, mu);
  cut_->put(place, share, held, edge, lambda, mu);
  return share + (1 - share) * held;
}

template <int D, class Real>
double SlipGroup<D, Real>::held_share_of_all(const Point<D>& edge, double lambda, double mu) const {
  const auto& systems = set_->systems;
  const bool alike = systems.size() == 1 || (D == 2 && systems.size() == 2 &&
                                             at_right_angles<D>(systems[0].normal, systems[1].normal));
  if (alike) return held_share<D>(unit_normal<D>(systems[0].normal), edge, lambda, mu);
  return D == 2 ? (lambda + mu) / (lambda + 2 * mu) : 1;
}

template <int D, class Real>
void SlipGroup<D, Real>::fill(const Domain<D>& domain, const Scene<D>& scene, const Layout<D>& layout,
                              bool askew, double dt_s) {
  const auto& model = scene.model;
  const auto& systems = set_->systems;
  using Tensor = SymmetricTensor<D, double>;
  relaxation_.assign(systems.size(), std::vector<Real>(count_));
  gaps_.resize(systems.size());
  for (std::size_t n = 0; n < systems.size(); ++n)
    if (systems[n].opens) gaps_[n].assign(count_, 0);
  if (opens()) {
    lambda_.assign(count_, 0);
    modulus_.assign(count_, 0);
  }
  slips_m_.resize(systems.size());
  if (with_friction_law(law(), [](auto of) { return decltype(of)::has_state; })) {
    for (auto& slips : slips_m_) slips.assign(count_, 0);
    slip_per_pa_.assign(count_, 0);
  }
  if (scene.slip_diary) mu_.assign(count_, 0);
  if (askew) {
    responses_.assign(count_ * systems.size(), {});
    if (D == 2 || scene.slip_diary) stiffness_.assign(count_, {});
  }
  if (!model.prestress_pa.empty()) prestress_.assign(count_ * Tensor::components, 0);
  places_.each(layout, domain, model, [&](std::size_t place, std::size_t cell, bool) {
    const double rho = model.medium.rho[cell], vp = model.medium.vp[cell], vs = model.medium.vs[cell];
    const double rock_mu = rho * vs * vs, lambda = rho * vp * vp - 2 * rock_mu;
    double mu = shear_modulus_above_springs(systems, lambda, rock_mu, fracture_share_of(model, cell), dt_s);
    const double of_part = cut_ ? put_edge(model, place, cell, lambda, rock_mu) : 1;
    const auto moduli = askew ? put_response(place, elasticity_of<D>(material_of(model.medium, cell)))
                              : std::vector<double>{};
    for (std::size_t n = 0; n < systems.size(); ++n) {
      if (askew) mu = moduli[n];
      if (systems[n].slides())
        relaxation_[n][place] = Real(slip::relaxation_pa(systems[n].viscosity_s, unit_ * of_part * mu, dt_s));
    }
    if (opens()) {
      lambda_[place] = Real(lambda);
      modulus_[place] = Real(rho * vp * vp);
    }
    if (!mu_.empty()) mu_[place] = Real(mu);
    if (!slip_per_pa_.empty())
      slip_per_pa_[place] =
          Real(std::min(fracture_share_of(model, cell) / of_part * domain.grid.spacing_m / (unit_ * mu),
                        most_per_distance));
    for (std::size_t c = 0; c < model.prestress_pa.size(); ++c)
      prestress_[c * count_ + place] = Real(unit_ * model.prestress_pa[c][cell]);
  });
}

/// One system, or two at right angles in 2-D, have kernels. They need the prestress resolved on the planes.
template <int D, class Real>
void SlipGroup<D, Real>::choose_kernels(SlipCorrection correction) {
  const auto& systems = set_->systems;
  open_ = opens() ? gap_kernel<Real>(D) : nullptr;
  const bool two = D == 2 && systems.size() == 2 && at_right_angles<D>(systems[0].normal, systems[1].normal);
  std::vector<Real> resolved;
  const auto add_row = [&](const Real* weights, Real of_diagonal) {
    for (std::size_t place = 0; place < count_; ++place) {
      Real sum = 0;
      for (std::size_t c = 0; c < std::size_t(SymmetricTensor<D, Real>::components); ++c)
        sum += (c < D ? of_diagonal : Real(1)) * weights[c] *
               (prestress_.empty() ? Real(0) : prestress_[c * count_ + place]);
      resolved.push_back(sum);
    }
  };
  const bool extended = !prestress_.empty() || opens();
  if (extended) {
    for (std::size_t n = 0; n < systems.size(); ++n) add_row(planes_.normal[n], 1);
    if (std::any_of(gaps_.begin(), gaps_.end(), [](const auto& gaps) { return gaps.empty(); }))
      shut_.assign(count_, 0);
  }
  if ((systems.size() == 1 || two) && responses_.empty()) {
    kernels_ = slip_kernels<Real>({D, int(systems.size()), correction, extended, law()});
    retained_.assign(count_ * std::size_t(kernels_.retained_rows), 0);
    if (extended)
      for (std::size_t t = 0; t < D - 1; ++t) add_row(planes_.shear[t], Real(0.5));
  } else {
    // By the centred rule slip follows the law as by the second-order one; only the waves feel it otherwise.
    centred_ = correction == SlipCorrection::centred;
    const auto rule = centred_ ? SlipCorrection::second : correction;
    if (centred_) retained_.assign(count_ * std::size_t(2 * SymmetricTensor<D, Real>::components), 0);
    with_friction_law(law(), [&](auto of) { add_joint<decltype(of)>(rule); });
  }
  resolved_ = std::move(resolved);
}

template <int D, class Real>
template <class Law>
void SlipGroup<D, Real>::add_joint(SlipCorrection correction) {
  std::vector<typename JointSlip<D, Real, Law>::System> all;
  for (const auto& system : set_->systems) {
    const auto n = unit_normal<D>(system.normal);
    all.push_back({{}, constants_of<D, Real>(system, unit_)});
    for (std::size_t i = 0; i < D; ++i) all.back().normal[i] = Real(n[i]);
  }
  joint_ = JointSlip<D, Real, Law>(correction, std::move(all));
}

template <int D, class Real>
FrictionLaw SlipGroup<D, Real>::law() const {
  const auto& systems = set_->systems;
  const bool weakens = std::any_of(systems.begin(), systems.end(),
                                   [](const auto& s) { return s.law == FrictionLaw::slip_weakening; });
  return weakens ? FrictionLaw::slip_weakening : FrictionLaw::coulomb;
}

template <int D, class Real>
bool SlipGroup<D, Real>::opens() const {
  return std::any_of(set_->systems.begin(), set_->systems.end(), [](const auto& s) { return s.opens; });
}

template <int D, class Real>
bool SlipGroup<D, Real>::holds(std::size_t place) const {
  return std::any_of(relaxation_.begin(), relaxation_.end(), [&](const auto& of) { return of[place] > 0; });
}

template <int D, class Real>
Real SlipGroup<D, Real>::gap(std::size_t place) const {
  Real widest = 0;
  for (const auto& gaps : gaps_)
    if (!gaps.empty()) widest = std::max(widest, gaps[place]);
  return widest;
}

template <int D, class Real>
SymmetricTensor<D, Real> SlipGroup<D, Real>::prestress(std::size_t place) const {
  SymmetricTensor<D, Real> s;
  if (!prestress_.empty())
    for (std::size_t c = 0; c < s.values.size(); ++c) s.values[c] = prestress_[c * count_ + place];
  return s;
}

template <int D, class Real>
std::vector<std::vector<Real>*> SlipGroup<D, Real>::memory() {
  std::vector<std::vector<Real>*> all = {&retained_};
  for (auto& gaps : gaps_) all.push_back(&gaps);
  for (auto& slips : slips_m_)
    if (!slips.empty()) all.push_back(&slips);
  if (cut_) all.push_back(&cut_->memory());
  return all;
}

template <int D, class Real>
void SlipGroup<D, Real>::exchange(std::int64_t line, const std::function<void(Real*, std::int64_t)>& to) {
  for (const auto& segment : segments(line))
    for (auto* const memory : this->memory())
      for (auto place = segment.place; place < memory->size(); place += count_)
        to(memory->data() + place, segment.last - segment.first);
}

template <int D, class Real>
SlipRows<Real> SlipGroup<D, Real>::rows(Real* stress, std::int64_t pitch, std::size_t place) {
  SlipRows<Real> rows{};
  rows.stress = stress;
  rows.pitch = pitch;
  const auto from = [place](auto& row) { return row.empty() ? nullptr : row.data() + place; };
  const auto systems = set_->systems.size();
  for (std::size_t n = 0; n < systems && n < 2; ++n) {
    rows.relaxation[n] = from(relaxation_[n]);
    rows.gap[n] = from(gaps_[n].empty() ? shut_ : gaps_[n]);
    rows.slip_m[n] = from(slips_m_[n]);
  }
  rows.retained = from(retained_);
  rows.prestress = from(resolved_);
  rows.slip_per_pa = from(slip_per_pa_);
  // Null pointers of absent rows are not moved.
  rows.retained_pitch = retained_.empty() ? 0 : std::int64_t(count_);
  rows.prestress_pitch = resolved_.empty() ? 0 : std::int64_t(count_);
  return rows;
}

template <int D, class Real>
void SlipGroup<D, Real>::act(SlipAct act, Real* stress, std::int64_t pitch, std::size_t place,
                             std::int64_t n) {
  if (!cut_) return act_on(act, stress, pitch, place, n);
  // Planes of a part that open leave no more traction than those of the whole cell would.
  const bool as_whole = act == SlipAct::open;
  cut_->apply(stress, pitch, place, n, as_whole,
              [&](Real* part, std::int64_t part_pitch, std::size_t first, std::int64_t count) {
                act_on(act, part, part_pitch, first, count);
              });
}

template <int D, class Real>
void SlipGroup<D, Real>::act_on(SlipAct act, Real* stress, std::int64_t pitch, std::size_t place,
                                std::int64_t n) {
  if (act == SlipAct::open) {
    if (open_) open(stress, pitch, place, n);
  } else if (kernels_.slip) {
    (act == SlipAct::begin ? kernels_.begin : kernels_.slip)(n, planes_, rows(stress, pitch, place));
  } else {
    std::visit(
        [&](const auto& joint) { slip_jointly(joint, stress, pitch, place, n, act == SlipAct::begin); },
        joint_);
  }
}

template <int D, class Real>
void SlipGroup<D, Real>::rest() {
  if (retained_.empty()) return;
  constexpr int components = SymmetricTensor<D, Real>::components;
  std::array<Real, components * lanes> none;
  for (std::size_t place = 0; place < count_; place += lanes) {
    none.fill(0);
    act(SlipAct::begin, none.data(), lanes, place, lanes);
  }
  for (auto& slips : slips_m_) std::fill(slips.begin(), slips.end(), Real(0));
}

/// Forth and back, as opening of one system changes the normal stress of the others.
template <int D, class Real>
void SlipGroup<D, Real>::open(Real* stress, std::int64_t pitch, std::size_t place, std::int64_t n) {
  const int systems = int(gaps_.size());
  for (int visit = 0; visit < 2 * systems - 1; ++visit) {
    const int system = visit < systems ? visit : 2 * systems - 2 - visit;
    auto& gap = gaps_[std::size_t(system)];
    if (gap.empty()) continue;
    open_(n, planes_, system,
          {stress, pitch, gap.data() + place, lambda_.data() + place, modulus_.data() + place,
           resolved_.data() + std::size_t(system) * count_ + place});
  }
}

template <int D, class Real>
template <class Law>
void SlipGroup<D, Real>::slip_jointly(const JointSlip<D, Real, Law>& joint, Real* stress, std::int64_t pitch,
                                      std::size_t place, std::int64_t n, bool begins) {
  std::array<Real, JointSlip<D, Real, Law>::most_systems> relaxation{}, slip_m{};
  std::array<bool, JointSlip<D, Real, Law>::most_systems> open{};
  for (std::int64_t i = 0; i < n; ++i) {
    const auto at = place + std::size_t(i);
    if (!holds(at)) continue;
    SymmetricTensor<D, Real> s, total = prestress(at);
    for (std::size_t c = 0; c < s.values.size(); ++c) {
      s.values[c] = stress[std::int64_t(c) * pitch + i];
      if (centred_ && !begins) s.values[c] += ahead(c, at) - explicit_half(c, at);
      total.values[c] += s.values[c];
    }
    const auto before = s;
    for (std::size_t k = 0; k < relaxation_.size(); ++k) {
      relaxation[k] = relaxation_[k][at];
      open[k] = !gaps_[k].empty() && gaps_[k][at] > 0;
      if (Law::has_state) slip_m[k] = slips_m_[k][at];
    }
    const Real slip_per_pa = Law::has_state ? slip_per_pa_[at] : Real(0);
    const typename JointSlip<D, Real, Law>::Cell cell = {
        relaxation.data(), open.data(), slip_m.data(), slip_per_pa,
        responses_.empty() ? nullptr : responses_.data() + at * relaxation_.size()};
    if (begins)
      joint.begin(s, total, cell);
    else
      joint.slip(s, total, cell);
    for (std::size_t k = 0; Law::has_state && k < slips_m_.size(); ++k) slips_m_[k][at] = slip_m[k];
    for (std::size_t c = 0; c < s.values.size(); ++c) {
      if (centred_ && begins) {
        explicit_half(c, at) = before.values[c] - s.values[c];
        s.values[c] = before.values[c] - ahead(c, at);
      } else if (centred_) {
        ahead(c, at) = (before.values[c] - s.values[c] + explicit_half(c, at)) / 2;
      }
      stress[std::int64_t(c) * pitch + i] = s.values[c];
    }
  }
}

template <int D, class Real>
std::int64_t SlipGroup<D, Real>::memory_bytes() const {
  std::size_t values = 0;
  for (const auto* of_systems : {&relaxation_, &gaps_, &slips_m_})
    for (const auto& of_system : *of_systems) values += of_system.size();
  for (const auto* row :
       {&shut_, &lambda_, &modulus_, &mu_, &prestress_, &resolved_, &retained_, &slip_per_pa_})
    values += row->size();
  return std::int64_t(values * sizeof(Real) + responses_.size() * sizeof(responses_[0]) +
                      stiffness_.size() * sizeof(Elasticity<D>)) +
         places_.memory_bytes() + (cut_ ? cut_->memory_bytes() : 0);
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class SlipGroup);

}  // namespace slipwave::solver
