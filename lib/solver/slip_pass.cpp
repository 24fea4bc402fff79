#include "solver/slip_pass.hpp"

#include <algorithm>

#include "fracture/slip_law.hpp"

namespace slipwave::solver {
namespace {

template <int D, class Real, class Correction>
class SlipPass : public Pass {
 public:
  SlipPass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene, double dt_s)
      : state_(state) {
    const auto& model = scene.model;
    for (std::size_t set = 0; set < model.fracture_sets.size(); ++set)
      for (const auto& system : model.fracture_sets[set].systems) {
        Group group;
        for (std::size_t axis = 0; axis < D; ++axis) group.normal[axis] = Real(system.normal[axis]);
        group.law = {Real(system.friction), Real(system.strength_pa)};
        for (std::size_t cell = 0; cell < model.fracture.size(); ++cell) {
          if (model.fracture[cell] != set + 1) continue;
          const auto at = domain.computed_cell(domain.model_grid.index(std::int64_t(cell)));
          const double mu = double(model.medium.rho[cell]) * model.medium.vs[cell] * model.medium.vs[cell];
          const std::int64_t line = state.layout.line_number(at);
          group.starts.resize(std::size_t(line) + 1, group.columns.size());
          group.columns.push_back(at[0]);
          group.d.push_back(slip_d<Real>(system.viscosity_s, mu, dt_s));
        }
        group.starts.resize(std::size_t(state.layout.lines()) + 1, group.columns.size());
        group.memory.resize(group.columns.size());
        cells_ += std::int64_t(group.columns.size());
        if (!group.columns.empty()) groups_.push_back(std::move(group));
      }
    lines_ = fracture_lines(state.layout, domain, model);
  }

  void run(const StepTime&, std::int64_t line, const Columns& columns) override {
    each_cell(line, columns, [](Group& group, std::size_t n, Stress<D, Real>& s) {
      correct<Correction, D, Real>(group.law, group.normal, group.d[n], s, group.memory[n]);
    });
  }
  void run_after(const StepTime&, std::int64_t line, const Columns& columns) override {
    if constexpr (requires(typename Correction::template Memory<D, Real> memory) { memory.ahead; })
      each_cell(line, columns, [](Group& group, std::size_t n, Stress<D, Real>& s) {
        slipwave::begin<Correction, D, Real>(group.normal, s, group.memory[n]);
      });
  }
  std::string name() const override { return "slip, " + std::string(Correction::name) + " order"; }
  std::int64_t cells() const override { return cells_; }
  std::span<const std::int64_t> lines() const override { return lines_; }
  void keep(Archive& archive) override {
    if constexpr (!std::is_empty_v<typename Correction::template Memory<D, Real>>)
      for (auto& group : groups_) archive.fixed(group.memory);
  }

 private:
  struct Group {
    Traction<D, Real> normal{};
    SlipStrength<Real> law;
    std::vector<std::int64_t> columns;  // of the cells, line after line
    std::vector<std::size_t> starts;    // of each line in columns, and the end
    std::vector<Real> d;
    std::vector<typename Correction::template Memory<D, Real>> memory;
  };
  /// Runs change(group, number in the group, stress) on the stress of every cell of these columns, system
  /// after system.
  template <class Change>
  void each_cell(std::int64_t line, const Columns& columns, const Change& change) {
    using Rows = FieldRows<D>;
    const std::int64_t pitch = state_.layout.row_pitch();
    Real* const fields = state_.field_row(state_.layout.line_index(line), 0);
    for (auto& group : groups_) {
      const auto begin = group.columns.begin() + std::ptrdiff_t(group.starts[std::size_t(line)]);
      const auto end = group.columns.begin() + std::ptrdiff_t(group.starts[std::size_t(line) + 1]);
      for (auto at = std::lower_bound(begin, end, columns.first); at != end && *at < columns.last; ++at) {
        Real* const cell = fields + *at;
        Stress<D, Real> s;
        for (int i = 0; i < D; ++i) {
          s(i, i) = cell[Rows::normal_stress(i) * pitch];
          for (int j = i + 1; j < D; ++j) s(i, j) = cell[Rows::shear_stress(i, j) * pitch];
        }
        change(group, std::size_t(at - group.columns.begin()), s);
        for (int i = 0; i < D; ++i) {
          cell[Rows::normal_stress(i) * pitch] = s(i, i);
          for (int j = i + 1; j < D; ++j) cell[Rows::shear_stress(i, j) * pitch] = s(i, j);
        }
      }
    }
  }

  State<D, Real>& state_;
  std::vector<Group> groups_;  // one a slip system
  std::vector<std::int64_t> lines_;
  std::int64_t cells_ = 0;
};

}  // namespace

template <int D, class Real>
std::unique_ptr<Pass> make_slip_pass(State<D, Real>& state, const Domain<D>& domain, const Scene<D>& scene,
                                     double dt_s) {
  if (scene.numerics.correction == SlipCorrection::first)
    return std::make_unique<SlipPass<D, Real, FirstOrder>>(state, domain, scene, dt_s);
  return std::make_unique<SlipPass<D, Real, SecondOrder>>(state, domain, scene, dt_s);
}

template <int D>
std::vector<std::int64_t> fracture_lines(const Layout<D>& layout, const Domain<D>& domain,
                                         const Model<D>& model) {
  std::vector<std::int64_t> lines;
  for (std::size_t cell = 0; cell < model.fracture.size(); ++cell)
    if (model.fracture[cell] != 0)
      lines.push_back(layout.line_number(domain.computed_cell(model.grid().index(std::int64_t(cell)))));
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

template std::vector<std::int64_t> fracture_lines(const Layout<2>&, const Domain<2>&, const Model<2>&);
template std::unique_ptr<Pass> make_slip_pass(State<2, float>&, const Domain<2>&, const Scene<2>&, double);
template std::unique_ptr<Pass> make_slip_pass(State<2, double>&, const Domain<2>&, const Scene<2>&, double);

}  // namespace slipwave::solver
