#include "solver/source_pass.hpp"

#include <algorithm>
#include <cmath>

#include "acquisition/interpolation.hpp"
#include "solver/point_access.hpp"

namespace slipwave::solver {
namespace {

template <int D, class Real>
class SourcePass : public Pass {
 public:
  SourcePass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, const Source<D>& source,
             double unit)
      : state_(state), wavelet_(source.wavelet), unit_(unit) {
    using Rows = FieldRows<D>;
    const auto injection = *point_injection(source);
    const auto centre = cell_at(domain, source.position_m);
    const auto& medium = scene.model.medium;
    const double rho = medium.rho(domain.model_cell(centre));
    const double volume = std::pow(domain.grid.spacing_m, D);
    const bool fluid = domain.impedance[wave_s](centre) == 0;
    // An isotropic source works on all normal stresses through the same cells: it must not make shear of its
    // own.
    const bool isotropic = std::holds_alternative<Explosion>(source.mechanism);
    for (int i = 0; i < D; ++i) {
      add(domain, source, Rows::velocity(i), Rows::velocity(i),
          injection.force[std::size_t(i)] / (rho * volume));
      const int like = isotropic ? Rows::normal_stress(D - 1) : Rows::normal_stress(i);
      add(domain, source, Rows::normal_stress(i), like, -injection.moment_rate(i, i) / volume);
      for (int j = i + 1; j < D && !fluid; ++j)
        add(domain, source, Rows::shear_stress(i, j), Rows::shear_stress(i, j),
            -injection.moment_rate(i, j) / volume);
    }
    find_lines(centre);
    std::stable_sort(values_.begin(), values_.end(),
                     [](const ValueWeight& one, const ValueWeight& other) { return one.line < other.line; });
  }
  void run(const StepTime& time, std::int64_t line, const Columns& columns) override {
    if (!acts(time)) return;
    auto value = std::lower_bound(values_.begin(), values_.end(), line,
                                  [](const ValueWeight& one, std::int64_t at) { return one.line < at; });
    if (value == values_.end() || value->line != line) return;
    const double amount = unit_ * 0.5 * time.dt_s * wavelet_(time.end_s());
    Real* const fields = state_.field_row(state_.layout.line_index(line), 0);
    for (; value != values_.end() && value->line == line; ++value) {
      const std::int64_t x = state_.layout.column(value->place);
      if (x >= columns.first && x < columns.last) fields[value->place] += Real(amount * value->weight);
    }
  }
  void run_after(const StepTime& time, std::int64_t line, const Columns& columns) override {
    run(time, line, columns);
  }
  std::string name() const override { return "source"; }
  std::int64_t cells() const override { return std::int64_t(values_.size()); }
  std::span<const std::int64_t> lines() const override { return lines_; }
  bool stirs(const StepTime& time, std::int64_t line) const override {
    return acts(time) && line >= lines_.front() && line <= lines_.back();
  }
  bool acts(const StepTime& time) const override { return time.end_s() <= wavelet_.duration_s(); }
  void keep(Archive&) override {}

 private:
  /// Spreads `strength` over cells of `row` with the weights of a source in row `like`.
  void add(const Domain<D>& domain, const Source<D>& source, int row, int like, double strength) {
    if (strength == 0) return;
    for (auto value : source_weights(state_.layout, domain, source.position_m, like)) {
      value.place += (row - like) * state_.layout.row_pitch();
      value.weight *= strength;
      values_.push_back(value);
    }
  }
  /// All lines that a source in this cell can reach, wherever in the cell it is: lines that are acted on take
  /// two half sweeps a step, and which ones do must not depend on the place, or it would be heard.
  void find_lines(const Index<D>& centre) {
    constexpr std::int64_t reach = widest_stencil / 2;
    lines_ = lines_of(values_);
    for (std::int64_t line = 0; line < state_.layout.lines(); ++line) {
      const auto at = state_.layout.line_index(line);
      bool near = true;
      for (std::size_t axis = 1; axis < D; ++axis) near &= std::abs(at[axis] - centre[axis]) <= reach;
      if (near) lines_.push_back(line);
    }
    std::sort(lines_.begin(), lines_.end());
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
  }
  State<D, Real>& state_;
  Wavelet wavelet_;
  double unit_;
  std::vector<ValueWeight> values_;
  std::vector<std::int64_t> lines_;
};

}  // namespace

template <int D, class Real>
std::unique_ptr<Pass> make_source_pass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                       const Source<D>& source, double unit) {
  return std::make_unique<SourcePass<D, Real>>(state, domain, scene, source, unit);
}

template std::unique_ptr<Pass> make_source_pass(State<2, float>&, const Domain<2>&, const Scene<2>&,
                                                const Source<2>&, double);
template std::unique_ptr<Pass> make_source_pass(State<2, double>&, const Domain<2>&, const Scene<2>&,
                                                const Source<2>&, double);

}  // namespace slipwave::solver
