// SPDX-License-Identifier: BSD-3-Clause
#include "lab.hpp"

#include <cmath>
#include <random>

#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave {

std::vector<int> orders_tried() {
  return long_form() ? std::vector<int>(std::begin(orders), std::end(orders)) : std::vector<int>{3, 5, 11};
}

double energy_density(double vp, double vs, double rho, double vx, double vz, double sxx, double szz,
                      double sxz) {
  if (rho == 0) return 0;
  const double mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
  const double sum = sxx + szz, difference = sxx - szz;
  double elastic = sum * sum / (8 * (lambda + mu));
  if (mu > 0) elastic += difference * difference / (8 * mu) + sxz * sxz / (2 * mu);
  return rho * (vx * vx + vz * vz) / 2 + elastic;
}

double energy_density(const Elasticity<2>& c, double rho, const CellFields& fields) {
  const auto& [vx, vz, sxx, szz, sxz] = fields;
  // Strains by elimination; the shear strain is twice exz.
  const double a = c(3, 3) - c(1, 3) * c(1, 3) / c(1, 1), b = c(3, 5) - c(1, 3) * c(1, 5) / c(1, 1),
               d = c(5, 5) - c(1, 5) * c(1, 5) / c(1, 1);
  const double normal = szz - c(1, 3) / c(1, 1) * sxx, shear = sxz - c(1, 5) / c(1, 1) * sxx;
  const double exz = (shear - b / a * normal) / (d - b * b / a), ezz = (normal - b * exz) / a,
               exx = (sxx - c(1, 3) * ezz - c(1, 5) * exz) / c(1, 1);
  return rho * (vx * vx + vz * vz) / 2 + (sxx * exx + szz * ezz + sxz * exz) / 2;
}

template <class Real>
Lab<Real>::Lab(const Setup& setup)
    : along_z_only_(setup.along_z_only), splitting_(splitting(2, setup.time_order)) {
  auto& model = scene_.model;
  model.medium = setup.medium;
  model.fracture = setup.fracture;
  model.fracture_share = setup.fracture_share;
  model.fracture_sets = setup.fracture_sets;
  model.prestress_pa = setup.prestress_pa;
  scene_.numerics.correction = setup.correction;
  domain_ = solver::make_domain(model.medium, setup.edges, setup.zone_cells, {}, setup.order);
  dt_s_ = setup.cfl * model.grid().spacing_m / fastest_speed(model.medium);
  domain_.steps = {&model.medium, dt_s_, setup.time_order};
  domain_.split = split_faces(model);
  for (auto& face : domain_.split) face.behind = domain_.computed_cell(face.behind);
  domain_.soft = solver::soft_cells(domain_, model);
  state_ = solver::make_state<2, Real>(domain_.grid.shape, domain_.material_kind());
  solver::fill_material(state_, domain_, model.medium, dt_s_);
  sweeps_ = std::make_unique<solver::Sweeps<2, Real>>(state_, domain_, setup.order);
  if (setup.monotone) sweeps_->keep_monotone();
  sweeps_->split_faces(domain_, dt_s_, 1);
  const bool zones = domain_.grid.size() > domain_.model_grid.size();
  const double vp_max = fastest_speed(model.medium);
  if (zones && setup.layer_hz > 0) {
    layer_ = std::make_unique<solver::Pml<2, Real>>(state_.layout, domain_, dt_s_, vp_max, setup.layer_hz,
                                                    setup.time_order);
    sweeps_->use(layer_.get());
  } else if (zones) {
    sponge_ = std::make_unique<Sponge<2, Real>>(domain_, dt_s_, vp_max);
  }
  const auto& sets = model.fracture_sets;
  if (std::any_of(sets.begin(), sets.end(), gives<2>))
    springs_ = std::make_unique<solver::LinearSlip<2, Real>>(state_, domain_, scene_, dt_s_);
  if (scene_.slips()) slip_ = std::make_unique<solver::Slip<2, Real>>(state_, domain_, scene_, dt_s_);

  fill_energies();

  std::mt19937 engine(setup.seed);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
    const auto at = domain_.grid.index(n);
    const auto cell = std::size_t(model.grid().flat(domain_.model_cell(at)));
    if (model.medium.is_void(cell)) continue;
    const bool in_model = domain_.in_model(at);
    if (layer_ && !in_model) continue;
    const auto set = [&](int row, double value) {
      state_.field_row({0, at[1]}, row)[at[0]] = Real(setup.amplitude * value);
    };
    if (setup.fields) {
      const auto fields = setup.fields(int(at[0]), int(at[1]));
      for (int row = 0; row < state_.layout.rows(); ++row) set(row, fields[std::size_t(row)]);
      continue;
    }
    const double z = double(model.medium.rho[cell]) * model.medium.vp[cell];
    const double pressure = z * uniform(engine);
    set(0, uniform(engine));
    set(1, uniform(engine));
    set(2, pressure);
    set(3, model.medium.is_solid(cell) ? z * uniform(engine) : pressure);
    const double shear = model.medium.is_solid(cell) ? 0.3 * z * uniform(engine) : 0;
    if (!state_.fluid) set(4, shear);
  }
}

template <class Real>
void Lab<Real>::fill_energies() {
  const auto& medium = scene_.model.medium;
  energies_.reserve(std::size_t(domain_.grid.size()));
  for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
    const auto at = domain_.grid.index(n);
    const auto cell = std::size_t(medium.grid().flat(domain_.model_cell(at)));
    const double vp = medium.vp[cell], vs = medium.vs[cell], rho = medium.rho[cell];
    const auto of = [&](double vx, double sxx, double szz, double sxz) {
      return energy_density(vp, vs, rho, vx, 0, sxx, szz, sxz);
    };
    const bool solid = vs > 0;
    energies_.push_back({of(1, 0, 0, 0), of(0, 0.5, 0.5, 0), solid ? of(0, 0.5, -0.5, 0) : 0,
                         solid ? of(0, 0, 0, 1) : 0,
                         !domain_.anisotropic_cell(at) && !is_anisotropic(medium, cell)});
  }
}

template <class Real>
void Lab<Real>::step() {
  const solver::StepTime time{steps_, dt_s_};
  for (std::size_t k = 0; k < splitting_.size(); ++k)
    if (const auto& sweep = splitting_[k]; sweep.axis == 1 || !along_z_only_)
      sweeps_->along(sweep.axis, Real(sweep.fraction), {time.step, k});
  if (sponge_) sponge_->damp(state_);
  if (springs_) solver::run_everywhere(*springs_, time, state_);
  if (slip_) slip([&] { solver::run_everywhere(*slip_, time, state_); });
  if (slip_) slip([&] { solver::run_after_everywhere(*slip_, time, state_); });
  if (springs_) solver::run_after_everywhere(*springs_, time, state_);
  ++steps_;
}

/// What slip and opening take off the stress of a cell is the elastic stress of a strain, on which the static
/// stress does work: their product, of both stresses by Hooke's law.
template <class Real>
template <class Act>
void Lab<Real>::slip(const Act& act) {
  const auto& model = scene_.model;
  if (model.prestress_pa.empty()) return act();
  const auto stress = [&](std::size_t cell, int row) {
    const auto at = domain_.computed_cell(model.grid().index(std::int64_t(cell)));
    return double(state_.field_row({0, at[1]}, 2 + row)[at[0]]);
  };
  std::vector<std::array<double, 3>> before(model.fracture.size());
  for (std::size_t cell = 0; cell < before.size(); ++cell)
    if (model.fracture[cell])
      for (int row = 0; row < 3; ++row) before[cell][std::size_t(row)] = stress(cell, row);
  act();
  const double h = domain_.grid.spacing_m;
  for (std::size_t cell = 0; cell < before.size(); ++cell) {
    if (!model.fracture[cell]) continue;
    const double rho = model.medium.rho[cell], vp = model.medium.vp[cell], vs = model.medium.vs[cell];
    const double mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
    double off[3], still[3];
    for (int row = 0; row < 3; ++row) {
      off[row] = before[cell][std::size_t(row)] - stress(cell, row);
      still[row] = model.prestress_pa[std::size_t(row)][cell];
    }
    const double even = (off[0] + off[1]) * (still[0] + still[1]) / (4 * (lambda + mu));
    const double shear = (off[0] - off[1]) * (still[0] - still[1]) / (4 * mu) + off[2] * still[2] / mu;
    work_of_prestress_ += h * h * (even + shear);
  }
}

template <class Real>
double Lab<Real>::sum(Stress which) const {
  const auto& medium = scene_.model.medium;
  const auto& still = scene_.model.prestress_pa;
  const double h = domain_.grid.spacing_m;
  double total = 0;
  for (std::int64_t k = 0; k < domain_.grid.shape[1]; ++k) {
    const Real* row[5];
    for (int field = 0; field < 5; ++field) row[field] = state_.field_row({0, k}, field);
    for (std::int64_t i = 0; i < domain_.grid.shape[0]; ++i) {
      const auto cell = std::size_t(medium.grid().flat(domain_.model_cell({i, k})));
      double s[3];
      for (int c = 0; c < 3; ++c) {
        s[c] = c == 2 && state_.fluid ? 0 : double(row[2 + c][i]);
        if (which == Stress::all && !still.empty()) s[c] += still[std::size_t(c)][cell];
      }
      const double vx = row[0][i], vz = row[1][i];
      if (const auto& of = energies_[std::size_t(domain_.grid.flat({i, k}))]; of.isotropic) {
        const double even = s[0] + s[1], odd = s[0] - s[1];
        total += h * h *
                 (of.kinetic * (vx * vx + vz * vz) + of.even * even * even + of.odd * odd * odd +
                  of.shear * s[2] * s[2]);
        continue;
      }
      const CellFields fields = {vx, vz, s[0], s[1], s[2]};
      total +=
          h * h *
          energy_density(domain_.anisotropic_cell({i, k}) ? domain_.anisotropic_medium({i, k})->elasticity
                                                          : upright_elasticity<2>(material_of(medium, cell)),
                         medium.rho[cell], fields);
    }
  }
  return total;
}

template <class Real>
double Lab<Real>::energy() const {
  return sum(Stress::of_waves) + (springs_ ? springs_->stored_energy() : 0) +
         (sweeps_->split() ? sweeps_->split()->stored_energy() : 0);
}

template <class Real>
double Lab<Real>::kinetic_energy() const {
  const auto& medium = scene_.model.medium;
  double total = 0;
  for (std::int64_t n = 0; n < domain_.grid.size(); ++n) {
    const auto at = domain_.grid.index(n);
    const double rho = medium.rho[std::size_t(medium.grid().flat(domain_.model_cell(at)))];
    for (int axis = 0; axis < 2; ++axis)
      total += rho * std::pow(double(state_.field_row({0, at[1]}, axis)[at[0]]), 2) / 2;
  }
  return total * std::pow(domain_.grid.spacing_m, 2);
}

template <class Real>
double Lab<Real>::energy_with_prestress() const {
  return sum(Stress::all) + (sweeps_->split() ? sweeps_->split()->stored_energy() : 0);
}

template class Lab<float>;
template class Lab<double>;

}  // namespace slipwave
