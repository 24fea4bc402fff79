#include <algorithm>
#include <cmath>
#include <cstring>

#include "solver/divergence.hpp"
#include "solver/shot_simulation.hpp"

// What the ranks that compute the parts of a shot do together, the halo apart.
namespace slipwave::solver {
namespace {

/// What all ranks report together.
ShotReport of_all(const ShotReport& mine, Ranks& ranks) {
  ShotReport all;
  const auto sum = [&](double value) { return sum_of(&ranks, value); };
  const SlipTotals slip = mine.slip.value_or(SlipTotals{});
  if (sum(mine.slip.has_value()) > 0) all.slip.emplace();
  const SlipTotals totals = {std::int64_t(sum(double(slip.cells))), std::int64_t(sum(double(slip.slipped))),
                             sum(slip.dissipated), sum(slip.out_of_waves)};
  if (all.slip) all.slip = totals;
  const double work = sum(mine.source_work.value_or(0));
  if (sum(mine.source_work.has_value()) > 0) all.source_work = work;
  all.energy_left = sum(mine.energy_left);
  return all;
}

}  // namespace

template <int D, class Real>
void ShotSimulation<D, Real>::use_halo() {
  const auto show = [this](const IndexRange& rows, const auto& to) {
    if (layer_) layer_->show(rows, to);
    const auto lines_a_row = state_.layout.lines() / state_.layout.shape()[D - 1];
    for (auto line = rows.first * lines_a_row; slip_ && line < rows.last * lines_a_row; ++line)
      slip_->show(line, to);
  };
  halo_ = std::make_unique<Halo<D, Real>>(*ranks_, domain_, state_, show);
  pipeline_.use(halo_.get());
}

/// Looks, and now and then asks the others what they saw: throws on all ranks what was seen first.
template <int D, class Real>
void ShotSimulation<D, Real>::check_together() {
  if (!ranks_) return look();
  try {
    if (!seen_) look();
  } catch (const DivergedFields<D>& seen) {
    seen_.emplace(seen.what() + std::string("; ") + surroundings(*scene_, domain_, shot_, seen.first().at),
                  seen.first());
  }
  if (done_ % asked_every != 0 && done_ != steps_) return;
  const auto steps = allgather(ranks_, {seen_ ? double(seen_->first().time.step) : HUGE_VAL});
  const auto first = std::min_element(steps.begin(), steps.end());
  if (std::isinf(*first)) return;
  const auto texts = allgather_texts(*ranks_, seen_ ? seen_->what() : "");
  Divergence<D> unsound;
  unsound.time = {std::int64_t(*first), dt_s_};
  throw DivergedFields<D>(texts[std::size_t(first - steps.begin())], unsound);
}

/// The field of the whole model on the first rank, on the others what they hold of it.
template <int D, class Real>
Field<D> ShotSimulation<D, Real>::joined_field(Field<D> mine) const {
  if (!ranks_) return mine;
  const auto a_row = mine.grid().size() / mine.grid().shape[D - 1];
  const auto& part = domain_.subdomain;
  const std::span<const float> own(mine.data() + (part.first - mine.grid().first[D - 1]) * a_row,
                                   std::size_t((part.last - part.first) * a_row));
  const auto all = gather_on_first(*ranks_, std::as_bytes(own));
  if (all.empty()) return mine;
  Field<D> whole(part.whole(mine.grid()));
  std::memcpy(whole.data(), all.data(), all.size());
  return whole;
}

template <int D, class Real>
ShotReport ShotSimulation<D, Real>::report() const {
  ShotReport report;
  if (slip_) report.slip = slip_->totals();
  if (source_) report.source_work = source_->work();
  report.energy_left = energy(state_, domain_, scene_->model.medium) / (unit_ * unit_);
  return ranks_ ? of_all(report, *ranks_) : report;
}

template void ShotSimulation<2, float>::use_halo();
template void ShotSimulation<2, float>::check_together();
template Field<2> ShotSimulation<2, float>::joined_field(Field<2>) const;
template ShotReport ShotSimulation<2, float>::report() const;
template void ShotSimulation<2, double>::use_halo();
template void ShotSimulation<2, double>::check_together();
template Field<2> ShotSimulation<2, double>::joined_field(Field<2>) const;
template ShotReport ShotSimulation<2, double>::report() const;
template void ShotSimulation<3, float>::use_halo();
template void ShotSimulation<3, float>::check_together();
template Field<3> ShotSimulation<3, float>::joined_field(Field<3>) const;
template ShotReport ShotSimulation<3, float>::report() const;
template void ShotSimulation<3, double>::use_halo();
template void ShotSimulation<3, double>::check_together();
template Field<3> ShotSimulation<3, double>::joined_field(Field<3>) const;
template ShotReport ShotSimulation<3, double>::report() const;

}  // namespace slipwave::solver
