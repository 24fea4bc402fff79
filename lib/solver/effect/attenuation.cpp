// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/attenuation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instantiate.hpp"
#include "parallel/threads.hpp"
#include "rock/bulk_part.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave::solver {
namespace {

/// By what all subdomains hold: neighbours retain the same of a cell.
template <int D>
Relaxing what_relaxes(const Domain<D>& domain) {
  if (domain.material_kind() == MaterialKind::fluid) return Relaxing::pressure;
  if (!domain.shear() && !domain.subdomain.shear) return Relaxing::mean;
  return D == 2 && (domain.anisotropic() || !domain.anisotropic_cells().empty()) ? Relaxing::turned
                                                                                 : Relaxing::all;
}

}  // namespace

template <int D, class Real>
RelaxingStress<D, Real>::RelaxingStress(const Layout<D>& layout, const Domain<D>& domain,
                                        const Scene<D>& scene, double dt_s, InjectedStress<D, Real> injected)
    : layout_(layout),
      injected_(std::move(injected)),
      every_(relaxation_steps(scene.numerics)),
      mechanisms_(scene.attenuation->mechanisms.count()),
      parts_(relaxing_parts(D, what_relaxes(domain))),
      moduli_(parts_ > 1 ? 2 : 1),
      what_(what_relaxes(domain)) {
  find_segments(domain, scene.model.medium);
  const auto relaxation = relaxation_by_steps(scene, dt_s);
  fill_shares(domain, scene.model.medium, relaxation);
  if (axes_stored_ > 0) fill_axes(domain, D == 2 ? scene.model.medium : relaxation.medium());
}

template <int D, class Real>
Index<D> RelaxingStress<D, Real>::place_of(std::int64_t line, std::int64_t x) const {
  auto at = layout_.line_index(line);
  at[0] = x;
  return at;
}

template <int D, class Real>
std::size_t RelaxingStress<D, Real>::model_cell(const Domain<D>& domain, std::int64_t line,
                                                std::int64_t x) const {
  return std::size_t(domain.model_grid.flat(domain.model_cell(place_of(line, x))));
}

template <int D, class Real>
bool RelaxingStress<D, Real>::is_taken_for_isotropic(const Domain<D>& domain, const Medium<D>& medium,
                                                     std::int64_t line, std::int64_t x) const {
  return is_tilted_mean(medium, model_cell(domain, line, x)) && !domain.anisotropic_cell(place_of(line, x));
}

template <int D, class Real>
void RelaxingStress<D, Real>::find_segments(const Domain<D>& domain, const Medium<D>& medium) {
  constexpr auto block = relaxation_block;
  static_assert(block == Layout<D>::block, "columns end between two blocks");
  const std::int64_t nx = layout_.shape()[0];
  for (std::int64_t line = 0; line < layout_.lines(); ++line) {
    starts_.push_back(segments_.size());
    for (std::int64_t first = 0; first < nx; first += block) {
      std::int64_t here = 0;
      for (std::int64_t x = first; x < std::min(first + block, nx); ++x)
        here += attenuates(medium, model_cell(domain, line, x));
      cells_ += here;
      if (here == 0) continue;
      const auto what = what_relaxes_in(domain, medium, line, first);
      if (segments_.size() > starts_.back() && segments_.back().last == first &&
          segments_.back().what == what)
        segments_.back().last += block;
      else
        segments_.push_back({first, first + block, stored_, axes_stored_, what,
                             relaxation_kernel<Real>(D, what, mechanisms_)});
      stored_ += block;
      axes_stored_ += axis_values(D, what) * block;
    }
  }
  starts_.push_back(segments_.size());
}

template <int D, class Real>
Relaxing RelaxingStress<D, Real>::what_relaxes_in(const Domain<D>& domain, const Medium<D>& medium,
                                                  std::int64_t line, std::int64_t first) const {
  auto what = what_;
  if constexpr (D == 3)
    for (auto x = first; x < std::min(first + relaxation_block, layout_.shape()[0]); ++x) {
      const auto cell = model_cell(domain, line, x);
      if (what_ != Relaxing::all || !attenuates(medium, cell) || !is_anisotropic(medium, cell)) continue;
      if (has_tilted_axis(medium, cell) && bulk_tensors(material_of(medium, cell)).are_turned())
        return Relaxing::turned;
      what = Relaxing::upright;
    }
  return what;
}

template <int D, class Real>
void RelaxingStress<D, Real>::fill_shares(const Domain<D>& domain, const Medium<D>& medium,
                                          const StepwiseRelaxation<D>& relaxation) {
  for (int l = 0; l < mechanisms_; ++l) rows_.decays[l] = Real(relaxation.decay(l));
  memory_ = Buffer<Real>(stored_ * mechanisms_ * parts_);
  shares_ = Buffer<Real>(stored_ * mechanisms_ * moduli_);
  clear_untouched(memory_);
  clear_untouched(shares_);
  parallel_for(layout_.lines(), 16, [&](std::int64_t begin, std::int64_t end, int) {
    const auto shares_of = relaxation.shares_in_turn();
    for (auto line = begin; line < end; ++line)
      for (const auto& segment : segments(line)) {
        for (auto x = segment.first; x < std::min(segment.last, layout_.shape()[0]); ++x) {
          const auto of =
              shares_of(model_cell(domain, line, x), is_taken_for_isotropic(domain, medium, line, x));
          for (int l = 0; l < mechanisms_; ++l) {
            const double decay = relaxation.decay(l);
            const auto place = segment.place + (x - segment.first), lane = place % relaxation_block;
            Real* const share =
                shares_.data() + (place - lane) * mechanisms_ * moduli_ + l * relaxation_block + lane;
            *share = Real(decay * of.bulk[std::size_t(l)]);
            if (moduli_ == 2) share[mechanisms_ * relaxation_block] = Real(decay * of.shear[std::size_t(l)]);
          }
        }
      }
  });
}

template <int D, class Real>
void RelaxingStress<D, Real>::fill_axes(const Domain<D>& domain, const Medium<D>& medium) {
  axes_ = Buffer<Real>(axes_stored_);
  for (std::int64_t line = 0; line < layout_.lines(); ++line)
    for (const auto& segment : segments(line))
      for (auto x = segment.first; x < segment.last && axis_values(D, segment.what) > 0; ++x) {
        const bool in_grid = x < layout_.shape()[0];
        const auto place = x - segment.first, lane = place % relaxation_block;
        Real* to = axes_.data() + segment.axes + (place - lane) * axis_values(D, segment.what) + lane;
        const auto put = [&](double value) { *to = Real(value), to += relaxation_block; };
        if constexpr (D == 2) {
          RelaxingAxis axis;
          if (in_grid && !is_taken_for_isotropic(domain, medium, line, x))
            axis = relaxing_axis(rock_of(medium, model_cell(domain, line, x)));
          for (const double value : {axis.even, axis.odd, axis.cosine, axis.sine}) put(value);
        } else {
          BulkTensors tensors;
          const auto cell = model_cell(domain, line, in_grid ? x : layout_.shape()[0] - 1);
          if (is_anisotropic(medium, cell)) tensors = bulk_tensors(material_of(medium, cell));
          const std::ptrdiff_t components = axis_values(D, segment.what) / 2;
          for (const auto* tensor : {&tensors.weights, &tensors.stress})
            std::for_each(tensor->begin(), tensor->begin() + components, put);
        }
      }
}

/// Columns end between two vectors or with the row.
template <int D, class Real>
void RelaxingStress<D, Real>::apply_between(const StepTime& time, const RowFields<Real>& fields,
                                            const IndexRange& columns) {
  const auto of_row = segments(fields.row);
  if (of_row.empty() || time.step % every_ != every_ - 1) return;
  const std::int64_t end = columns.last == layout_.shape()[0] ? layout_.padded_nx() : columns.last;
  injected_.without(double(time.step), fields, columns, [&] {
    for (const auto& segment : of_row) {
      const std::int64_t first = std::max(segment.first, columns.first), last = std::min(segment.last, end);
      if (first >= last) continue;
      auto rows = rows_;
      rows.stress = fields.field(FieldRows<D>::normal_stress(0)) + first;
      rows.pitch = fields.pitch;
      const auto place = segment.place + (first - segment.first);
      rows.memory = memory_.data() + place * mechanisms_ * parts_;
      rows.shares = shares_.data() + place * mechanisms_ * moduli_;
      if (axes_.size() > 0)
        rows.axes = axes_.data() + segment.axes + (first - segment.first) * axis_values(D, segment.what);
      segment.relax(last - first, rows);
    }
  });
}

template <int D, class Real>
void RelaxingStress<D, Real>::exchange(const IndexRange& rows,
                                       const std::function<void(Real*, std::int64_t)>& to) {
  const auto lines_a_row = layout_.lines() / layout_.shape()[D - 1];
  for (auto line = rows.first * lines_a_row; line < rows.last * lines_a_row; ++line)
    for (const auto& segment : segments(line))
      to(memory_.data() + segment.place * mechanisms_ * parts_,
         (segment.last - segment.first) * mechanisms_ * parts_);
}

template <int D, class Real>
std::string RelaxingStress<D, Real>::name() const {
  return "attenuation, " + std::to_string(mechanisms_) + " mechanisms";
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class RelaxingStress);

}  // namespace slipwave::solver
