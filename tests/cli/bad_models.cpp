// SPDX-License-Identifier: BSD-3-Clause
#include "bad_models.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/planar_fracture.hpp"
#include "model/single_fracture.hpp"

namespace {

using slipwave::NetcdfFile;
using Type = NetcdfFile::Type;

/// What stands in a model file, each piece free to be wrong.
struct Contents {
  std::vector<double> x, z;
  std::vector<std::string> dimensions = {"z", "x"};  // of the properties
  std::vector<float> vp, vs, rho;
  std::vector<std::uint8_t> fracture;  // none: not in the file
  std::vector<float> share;            // the same
  std::vector<int> slip_set = {0};
  std::vector<double> normal = {0, 1}, friction = {0.1}, viscosity = {1}, strength = {0};
  std::string units = "m s-1", left_out;
  bool texts_for_speeds = false;
  std::vector<double> corners;  // depths, none: not in the file
  std::size_t corner_columns = 0;
  std::string role = "floor";

  Contents(std::size_t columns, std::size_t rows)
      : vp(columns * rows, 3000.f), vs(columns * rows, 1500.f), rho(columns * rows, 2200.f) {
    for (std::size_t i = 0; i < columns; ++i) x.push_back(2.5 + 5 * double(i));
    for (std::size_t k = 0; k < rows; ++k) z.push_back(2.5 + 5 * double(k));
  }
};

// The cell at x = 17.5, z = 12.5.
constexpr std::size_t cell = 2 * 40 + 3;

void write(const std::string& path, const Contents& model) {
  auto file = NetcdfFile::create(path, path);
  file.define_dimension("z", model.z.size());
  file.define_dimension("x", model.x.size());
  const auto define = [&](const std::string& name, Type type, const std::vector<std::string>& dimensions) {
    if (name != model.left_out) file.define_variable(name, type, dimensions);
  };
  const auto put = [&](const std::string& name, const auto& values) {
    if (name != model.left_out) file.put(name, values.data());
  };
  define("x", Type::f64, {"x"});
  define("z", Type::f64, {"z"});
  for (const std::string name : {"vp", "vs", "rho"}) {
    define(name, name == "vp" && model.texts_for_speeds ? Type::text : Type::f32, model.dimensions);
    if (name != model.left_out && !model.units.empty())
      file.put_attribute(name, "units", name == "rho" ? "kg m-3" : model.units);
  }
  if (!model.fracture.empty()) {
    file.define_dimension("fracture_set", 1);
    file.define_dimension("slip_system", model.slip_set.size());
    file.define_dimension("axis", 2);
    define("fracture", Type::u8, {"z", "x"});
    define("fracture_name", Type::text, {"fracture_set"});
    define("slip_set", Type::i32, {"slip_system"});
    define("slip_normal", Type::f64, {"slip_system", "axis"});
    for (const std::string name : {"slip_friction", "slip_viscosity", "slip_strength"})
      define(name, Type::f64, {"slip_system"});
    if (!model.share.empty()) define("fracture_share", Type::f32, {"z", "x"});
    if (!model.share.empty()) put("fracture_share", model.share);
    put("fracture", model.fracture);
    if (model.left_out != "fracture_name") file.put_text("fracture_name", {"cracks"});
    put("slip_set", model.slip_set);
    put("slip_normal", model.normal);
    put("slip_friction", model.friction);
    put("slip_viscosity", model.viscosity);
    put("slip_strength", model.strength);
  }
  if (!model.corners.empty()) {
    file.define_dimension("z_face", model.corners.size() / model.corner_columns);
    file.define_dimension("x_face", model.corner_columns);
    define("depth_bounds", Type::f64, {"z_face", "x_face"});
    define("horizon_floor", Type::f64, {"x"});
    file.put_attribute("horizon_floor", "role", model.role);
    file.put_attribute("horizon_floor", "row", std::vector<int>{3});
    put("depth_bounds", model.corners);
    put("horizon_floor",
        std::vector<double>(model.x.size(), model.corners[3 * std::size_t(model.corner_columns)]));
  }
  put("x", model.x);
  put("z", model.z);
  if (model.texts_for_speeds) {
    file.put_text("vp", std::vector<std::string>(model.vp.size(), "fast"));
  } else {
    put("vp", model.vp);
  }
  put("vs", model.vs);
  put("rho", model.rho);
  file.close();
}

/// Single fractures in a shale, in a way that is not computed.
template <int D>
void write_in_shale(const std::string& path, const slipwave::Grid<D>& grid,
                    const slipwave::FractureSet<D>& set) {
  using slipwave::Field, slipwave::Property;
  slipwave::Model<D> model;
  model.medium.vp = Field<D>(grid, 3000), model.medium.vs = Field<D>(grid, 1500);
  model.medium.rho = Field<D>(grid, 2200);
  model.medium[Property::epsilon] = Field<D>(grid, 0.2F),
  model.medium[Property::delta] = Field<D>(grid, 0.1F);
  add_single_fractures(model, set);
  slipwave::OutputFile out(path, slipwave::OutputFile::Content::binary);
  write_model(model, out);
}

}  // namespace

void write_bad_models(const std::string& directory) {
  const auto with = [&](const std::string& name, const std::function<void(Contents&)>& flaw) {
    Contents model(40, 20);
    flaw(model);
    write(directory + "/" + name + ".nc", model);
  };
  const auto fractured = [&](const std::string& name, const std::function<void(Contents&)>& flaw) {
    with(name, [&](Contents& model) {
      model.fracture.assign(model.vp.size(), 0);
      model.fracture[cell] = 1;
      flaw(model);
    });
  };
  with("nan", [](Contents& model) { model.vp[cell] = std::nanf(""); });
  with("infinite", [](Contents& model) { model.vs[cell] = std::numeric_limits<float>::infinity(); });
  with("negative", [](Contents& model) { model.vp[cell] = -3000; });
  with("weightless", [](Contents& model) { model.rho[cell] = 0; });
  with("fast", [](Contents& model) { model.vs[cell] = 2900; });
  with("missing", [](Contents& model) { model.left_out = "rho"; });
  with("turned", [](Contents& model) { model.dimensions = {"x", "z"}; });
  with("flat", [](Contents& model) {
    model.dimensions = {"x"};
    for (auto* values : {&model.vp, &model.vs, &model.rho}) values->resize(40);
  });
  with("other-step", [](Contents& model) {
    for (auto& z : model.z) z *= 2;
  });
  with("uneven", [](Contents& model) { model.x[7] += 1; });
  with("nan-place", [](Contents& model) { model.x[7] = std::nan(""); });
  with("deep", [](Contents& model) {
    for (auto& z : model.z) z += 100;
  });
  with("no-units", [](Contents& model) { model.units.clear(); });
  with("kilograms", [](Contents& model) { model.units = "kg"; });
  with("text", [](Contents& model) { model.texts_for_speeds = true; });
  const auto fitted = [&](const std::string& name, const std::function<void(Contents&)>& flaw) {
    with(name, [&](Contents& model) {
      model.corner_columns = 41;
      for (std::size_t n = 0; n < std::size_t(41) * 21; ++n) model.corners.push_back(5 * double(n / 41));
      flaw(model);
    });
  };
  fitted("nan-corner", [](Contents& model) { model.corners[3 * 41 + 7] = std::nan(""); });
  fitted("folded", [](Contents& model) { model.corners[3 * 41 + 7] = 9; });
  fitted("thin-row", [](Contents& model) {
    for (std::size_t i = 0; i < 41; ++i) model.corners[3 * 41 + i] = 10.5;
  });
  fitted("few-corners", [](Contents& model) {
    model.corners.resize(std::size_t(40) * 21);
    model.corner_columns = 40;
  });
  fitted("ceiling", [](Contents& model) { model.role = "ceiling"; });
  write(directory + "/one-cell.nc", Contents(1, 1));
  write(directory + "/tall.nc", Contents(2, 70000));

  fractured("code", [](Contents& model) { model.fracture[cell] = 2; });
  fractured("share", [](Contents& model) { model.share.assign(model.vp.size(), 1.5F); });
  fractured("wet", [](Contents& model) { model.vs[cell] = 0; });
  fractured("no-set", [](Contents& model) { model.slip_set = {1}; });
  fractured("no-system", [](Contents& model) { model.slip_set = {-1}; });
  fractured("no-friction", [](Contents& model) { model.left_out = "slip_friction"; });
  fractured("no-names", [](Contents& model) { model.left_out = "fracture_name"; });
  fractured("long-normal", [](Contents& model) { model.normal = {1, 1}; });
  fractured("nan-normal", [](Contents& model) { model.normal = {std::nan(""), 1}; });
  fractured("pushing", [](Contents& model) { model.friction = {-0.1}; });
  fractured("nan-viscosity", [](Contents& model) { model.viscosity = {std::nan("")}; });
  fractured("weak", [](Contents& model) { model.strength = {-1}; });
  slipwave::FractureSet<2> slit{"slit", {{{0, 1}, 0.5, 0, 0}}, {{{50, 50}, {150, 50}}}, true};
  write_in_shale<2>(directory + "/vti-faulted.nc", {{40, 20}, 5, {0, 0}}, slit);
  slipwave::FractureSet<3> disc{"disc", {{{0, 0, 1}, 0, 0, 0, false, slipwave::FrictionLaw::none}}};
  disc.systems[0].compliance.normal_m_per_pa = disc.systems[0].compliance.tangential_m_per_pa = 1e-10;
  disc.traces = {slipwave::parse_disc("50,50,50:30")};
  write_in_shale<3>(directory + "/vti-disc.nc", {{10, 10, 10}, 10, {0, 0, 0}}, disc);
  fractured("three-systems", [](Contents& model) {
    model.slip_set = {0, 0, 0};
    model.normal = {0, 1, 1, 0, 0.6, 0.8};
    model.friction = model.viscosity = model.strength = {0.1, 0.1, 0.1};
  });
}
