#include "solver/pipeline.hpp"

#include <algorithm>
#include <atomic>

#include "base/parallel.hpp"

namespace slipwave::solver {
namespace {

// Measured on grids from 10^4 to 10^8 cells (tests/bench, docs/performance.md).
/// Columns of a stripe: what the sweeps need of them stays in a first cache of 32 to 48 KiB.
constexpr std::int64_t usual_stripe = 256;
/// Steps a pass through memory makes: two are up to a tenth faster than one, more gain nothing.
constexpr int usual_steps = 2;
/// Rows that are asked for before the first sweep comes to them.
constexpr std::int64_t rows_ahead = 1;
/// Rows of a band, at least. Between bands some rows leave the cache.
constexpr std::int64_t fewest_band_rows = 32;

}  // namespace

template <int D, class Real>
Pipeline<D, Real>::Pipeline(Sweeps<D, Real>& sweeps, const State<D, Real>& state, int time_order, double dt_s,
                            EndOfStep<Real>& end, const Passage& passage)
    : sweeps_(sweeps),
      layout_(state.layout),
      active_(state),
      everywhere_(passage.everywhere),
      splitting_(splitting(D, time_order)),
      dt_s_(dt_s),
      end_(end),
      steps_a_pass_(passage.steps > 0 ? passage.steps : usual_steps),
      stripe_width_(passage.stripe_cells > 0 ? passage.stripe_cells : usual_stripe),
      rows_(layout_.shape()[D - 1]),
      side_rows_(sweeps.sides_bend() ? FreeEdge<D, Real>::reach : 0) {
  const auto longest = stages(0, steps_a_pass_);
  longest_ = longest.back().behind + side_rows_;
  std::int64_t along_x = 0, along_z = 0, widest = 0;
  for (const auto& stage : longest) {
    along_x += stage.kind == Stage::along_z ? 0 : stage.kind == Stage::along_x ? 1 : 2;
    along_z += stage.kind == Stage::along_z;
    widest = std::max(widest, stage.ahead);
  }
  band_rows_ = std::max(fewest_band_rows, longest_ + 2 * max_reach);
  bands_ = std::max<std::int64_t>(1, rows_ / band_rows_);
  const int threads = parallel_threads();
  const auto most = std::int64_t(Pass::most_steps_under_way / steps_a_pass_);
  under_way_.resize(std::size_t(threads > 1 ? std::clamp<std::int64_t>(threads + 1, 1, most) : 1));
  for (auto& pass : under_way_)
    for (std::int64_t n = 0; n < along_z; ++n)
      pass.rings.emplace_back(0, layout_.padded_nx(), sweeps.ring_rows());
  const auto stripe = std::min(stripe_width_ * 2 + widest, layout_.padded_nx());
  for (int n = 0; n < parallel_workers(); ++n)
    workers_.push_back({sweeps.make_workspace(stripe + 2 * Sweeps<D, Real>::lag),
                        std::vector<Carry<Real>>(std::size_t(along_x * carries_a_sweep())),
                        std::vector<Columns>(2 * longest.size())});
}

template <int D, class Real>
std::int64_t Pipeline<D, Real>::memory_bytes() const {
  const auto ring = layout_.padded_nx() * (6 + 4 * sweeps_.ring_rows()) * std::int64_t(sizeof(Real));
  return std::int64_t(under_way_.size() * under_way_.front().rings.size()) * ring;
}

/// The stages of a pass that makes these steps.
template <int D, class Real>
auto Pipeline<D, Real>::stages(std::int64_t first, std::int64_t last) const -> std::vector<Stage> {
  std::vector<Stage> all;
  // The last sweep of a step and the first of the next are alike: both belong to the end of a step.
  const Real end = Real(splitting_.front().part);
  if (first == 0) all.push_back({Stage::along_x, end, {0, dt_s_}});
  for (std::int64_t step = first; step < last; ++step) {
    for (std::size_t n = 1; n + 1 < splitting_.size(); ++n)
      all.push_back({splitting_[n].axis == 0 ? Stage::along_x : Stage::along_z,
                     Real(splitting_[n].part),
                     {step, dt_s_}});
    all.push_back({Stage::end_of_step, end, {step, dt_s_}});
  }
  std::int64_t behind = 0;
  int along_x = 0, along_z = 0;
  for (auto& stage : all) {
    stage.behind = behind;
    const bool z = stage.kind == Stage::along_z;
    behind += z ? sweeps_.rows_behind() : side_rows_;
    stage.number = z ? along_z++ : along_x;
    if (!z) along_x += stage.kind == Stage::end_of_step ? 2 : 1;
  }
  constexpr std::int64_t each = 2 * Sweeps<D, Real>::lag;
  std::int64_t ahead = 0;
  for (auto stage = all.rbegin(); stage != all.rend(); ++stage) {
    if (stage->kind == Stage::end_of_step) ahead += each;
    stage->ahead = ahead;
    ahead += each;
  }
  return all;
}

template <int D, class Real>
std::int64_t Pipeline<D, Real>::stripes() const {
  return std::max<std::int64_t>(1, (layout_.shape()[0] + stripe_width_ / 2) / stripe_width_);
}

/// Lines of a band that wait for the next stripe; where there is none, nothing waits.
template <int D, class Real>
std::int64_t Pipeline<D, Real>::carries_a_sweep() const {
  return stripes() > 1 ? 2 * band_rows_ + longest_ : 1;
}

/// Where a sweep that much ahead ends in a stripe. The one before it in the pass is two blocks ahead of it,
/// or at the end of the line.
template <int D, class Real>
std::int64_t Pipeline<D, Real>::last_column(std::int64_t stripe, std::int64_t ahead) const {
  constexpr auto block = Layout<D>::block;
  const std::int64_t nx = layout_.shape()[0], count = stripes();
  const std::int64_t nominal = stripe + 1 == count ? nx : (stripe + 1) * nx / count / block * block;
  return nominal + ahead + 2 * Sweeps<D, Real>::lag >= nx ? nx : nominal + ahead;
}

template <int D, class Real>
std::int64_t Pipeline<D, Real>::run(std::int64_t first, std::int64_t last,
                                    const std::function<bool()>& pause) {
  const std::int64_t passes = (last - first + steps_a_pass_ - 1) / steps_a_pass_;
  // A pass is decided on in its first band, which comes after that of the pass before.
  std::atomic<std::int64_t> made = passes;
  parallel_passes(
      passes, bands_, std::int64_t(under_way_.size()), [&](std::int64_t pass, std::int64_t band, int worker) {
        if (pause && band == 0 && pass > 0 && pass < made && pause()) made = pass;
        if (pass >= made) return;
        const std::int64_t begin = first + pass * steps_a_pass_;
        run_band(pass, band, begin, std::min(begin + steps_a_pass_, last), workers_[std::size_t(worker)]);
      });
  return std::min(first + made * steps_a_pass_, last);
}

template <int D, class Real>
void Pipeline<D, Real>::run_band(std::int64_t number, std::int64_t band, std::int64_t first,
                                 std::int64_t last, Worker& worker) {
  auto& pass = under_way_[std::size_t(number) % under_way_.size()];
  if (band == 0) {
    pass.stages = stages(first, last);
    const Box all{{0, rows_}, {0, layout_.shape()[0]}}, growth = growth_of_a_step();
    for (auto& stage : pass.stages) stage.needed = everywhere_ ? all : end_.needed(stage.time, growth);
    for (std::int64_t step = first; step < last; ++step) end_.begin({step, dt_s_});
  }
  const bool ends = band + 1 == bands_;
  const Columns rows{band * band_rows_, ends ? rows_ + longest_ : (band + 1) * band_rows_};
  std::fill(worker.columns.begin(), worker.columns.end(), Columns{});
  for (std::int64_t stripe = 0; stripe < stripes(); ++stripe) {
    for (std::size_t n = 0; n < pass.stages.size(); ++n) {
      const auto& stage = pass.stages[n];
      auto* const columns = &worker.columns[2 * n];
      columns[0] = {columns[0].last, last_column(stripe, stage.ahead)};
      columns[1] = {columns[1].last, last_column(stripe, stage.ahead - 2 * Sweeps<D, Real>::lag)};
    }
    run_stripe(pass, rows, worker);
  }
  if (ends)
    for (std::int64_t step = first; step < last; ++step) end_.finish({step, dt_s_});
}

template <int D, class Real>
void Pipeline<D, Real>::run_stripe(UnderWay& pass, const Columns& rows, Worker& worker) {
  const std::int64_t carried = carries_a_sweep();
  for (std::int64_t arriving = rows.first; arriving < rows.last; ++arriving) {
    if (arriving + rows_ahead < rows_)
      sweeps_.expect(arriving + rows_ahead, worker.columns.front(), worker.work.coming());
    for (std::size_t n = 0; n < pass.stages.size(); ++n) {
      const auto& stage = pass.stages[n];
      const auto& columns = worker.columns[2 * n];
      const std::int64_t row = arriving - stage.behind;
      if (stage.kind == Stage::along_z) {
        if (row >= 0 && row < rows_ + sweeps_.rows_behind() && !columns.empty())
          along_z(stage, row, columns, pass.rings[std::size_t(stage.number)], worker);
        continue;
      }
      if (side_rows_ > 0 && row >= 0 && row < rows_ && !columns.empty()) sweeps_.keep_sides(row, columns);
      const std::int64_t line = row - side_rows_;
      if (line < 0 || line >= rows_ ||
          !stage.needed.meets({line, line + 1},
                              {(&columns)[stage.kind == Stage::end_of_step].first, columns.last}))
        continue;
      const std::int64_t in_band = stripes() > 1 ? arriving - rows.first : 0;
      Carry<Real>* const carries = worker.carries.data() + stage.number * carried + in_band;
      if (!columns.empty()) sweeps_.measure_sides(line);
      if (stage.kind == Stage::along_x) {
        if (!columns.empty()) along_x(line, columns, stage.part, *carries, worker);
      } else {
        end_of_step(stage, line, columns, (&columns)[1], carries, worker);
      }
    }
  }
}

template <int D, class Real>
bool Pipeline<D, Real>::quiet(const Columns& rows, const Columns& columns) const {
  if (everywhere_) return false;
  for (auto row = std::max<std::int64_t>(rows.first, 0); row < std::min(rows.last, rows_); ++row)
    if (!active_.quiet(row, columns)) return false;
  return true;
}

template <int D, class Real>
void Pipeline<D, Real>::look_for_active(std::int64_t line, const Columns& columns) {
  if (!everywhere_) active_.look(line, columns);
}

template <int D, class Real>
void Pipeline<D, Real>::along_z(const Stage& stage, std::int64_t step, const Columns& columns,
                                Ring<Real>& ring, Worker& worker) {
  constexpr auto lag = Sweeps<D, Real>::lag;
  const std::int64_t done = step - sweeps_.rows_behind();
  if (!stage.needed.meets({done, step + 1}, columns)) return;
  // Free edges read some cells of the columns beside these.
  if (quiet({done - 1, step + 1}, {columns.first - lag, columns.last + lag})) {
    sweeps_.pass_over_z(step, columns, ring);
    return;
  }
  sweeps_.measure_ends(step, {columns.first == 0 ? 0 : columns.first + lag, columns.last + lag});
  sweeps_.along_z(step, columns, stage.part, ring, worker.work);
  if (done < 0 || done >= rows_) return;
  look_for_active(done, columns);
  worker.swept += columns.count();
}

template <int D, class Real>
void Pipeline<D, Real>::along_x(std::int64_t line, const Columns& columns, Real part, Carry<Real>& carry,
                                Worker& worker) {
  constexpr auto reach = 2 * Sweeps<D, Real>::lag;
  if (quiet({line - side_rows_, line + side_rows_ + 1}, {columns.first - reach, columns.last + reach})) {
    carry = {};
    return;
  }
  sweeps_.along_x(line, columns, part, carry, worker.work);
  look_for_active(line, columns);
}

template <int D, class Real>
void Pipeline<D, Real>::end_of_step(const Stage& stage, std::int64_t line, const Columns& first,
                                    const Columns& second, Carry<Real>* carries, Worker& worker) {
  const StepTime& time = stage.time;
  const auto passes = [&](auto&& what) {
    what();
    if (end_.stirs(time, line)) look_for_active(line, first);
  };
  if (end_.whole(time, line)) {
    if (!first.empty()) {
      along_x(line, first, stage.part, *carries, worker);
      passes([&] { end_.run(time, line, first); });
      end_.look(time, line, first, sweeps_.fields_of(line), layout_.row_pitch());
      passes([&] { end_.run_after(time, line, first); });
    }
    if (!second.empty()) along_x(line, second, stage.part, carries[carries_a_sweep()], worker);
    return;
  }
  if (first.empty()) return;
  if (end_.looks(time, line)) {
    constexpr auto lag = Sweeps<D, Real>::lag;
    const Columns seen{first.first == 0 ? 0 : first.first + lag,
                       first.last == layout_.shape()[0] ? first.last : first.last + lag};
    end_.look(time, line, seen, sweeps_.ahead_along_x(line, seen, stage.part, worker.work),
              worker.work.pitch());
  }
  along_x(line, first, 2 * stage.part, *carries, worker);
  passes([&] {
    end_.run(time, line, first);
    end_.run_after(time, line, first);
  });
}

template <int D, class Real>
void Pipeline<D, Real>::find_active_cells() {
  for (std::int64_t line = 0; line < layout_.lines(); ++line) look_for_active(line, {0, layout_.shape()[0]});
}

/// By how many rows and columns the fields of a cell spread in a step at most.
template <int D, class Real>
Box Pipeline<D, Real>::growth_of_a_step() const {
  std::int64_t along_x = 0, along_z = 0;
  for (const auto& part : splitting_) (part.axis == 0 ? along_x : along_z) += 1;
  const auto bends = FreeEdge<D, Real>::reach, sweep = sweeps_.reach() + 1;
  const std::int64_t rows = along_z * sweep + (sweeps_.sides_bend() ? along_x * bends : 0);
  const std::int64_t columns = along_x * sweep + (sweeps_.ends_bend() ? along_z * bends : 0);
  return {{rows, rows}, {columns, columns}};
}

template <int D, class Real>
std::int64_t Pipeline<D, Real>::swept_cells() const {
  std::int64_t cells = 0;
  for (const auto& worker : workers_) cells += worker.swept;
  return cells;
}

template class Pipeline<2, float>;
template class Pipeline<2, double>;

}  // namespace slipwave::solver
