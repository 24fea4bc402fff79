// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/identity.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

#include "base/error.hpp"
#include "base/instantiate.hpp"
#include "checkpoint/checksum.hpp"
#include "scene/bands.hpp"

namespace slipwave {
namespace {

// Structures are taken apart by name, all members of them: one that gains a member does not compile here
// until somebody has decided where the member belongs.

/// A checksum over things of all kinds.
class Digest {
 public:
  void add(double value) { sum_.add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::integral auto value) { sum_.add(std::uint64_t(value)); }
  void add(const std::string& text) { add_all(text); }
  template <class T>
  void add(const std::vector<T>& all) {
    add(all.size());
    for (const auto& one : all) add(one);
  }
  template <std::size_t N>
  void add(const std::array<double, N>& all) {
    for (const double one : all) add(one);
  }
  template <int D, class Value>
  void add(const Field<D, Value>& field) {
    add(field.grid());
    add(field.size());
    sum_.add(field.data(), field.size() * sizeof(Value));
  }
  template <int D>
  void add(const Grid<D>& grid) {
    const auto& [shape, spacing_m, origin_m, first, rows] = grid;
    for (const auto cells : shape) add(cells);
    add(spacing_m);
    add(origin_m);
    for (const auto cells : first) add(cells);
    if (rows) add(rows->corners_m());
  }
  template <int D>
  void add(const SlipSystem<D>& system) {
    const auto& [normal, friction, viscosity_s, strength_pa, opens, law, dynamic_friction, slip_distance_m,
                 compliance] = system;
    add(normal);
    add(opens);
    for (const double constant : {friction, viscosity_s, strength_pa}) add(constant);
    if (law != FrictionLaw::coulomb) {
      add(int(law));
      for (const double constant : {dynamic_friction, slip_distance_m}) add(constant);
    }
    if (compliance.gives() || compliance.spacing_m > 0) add(compliance);
  }
  void add(const LinearCompliance& compliance) {
    const auto& [normal, tangential, normal_dashpot, tangential_dashpot, spacing_m, crack_density, aspect,
                 fill_pa] = compliance;
    for (const double constant :
         {normal, tangential, normal_dashpot, tangential_dashpot, spacing_m, crack_density, aspect, fill_pa})
      add(constant);
  }
  template <int D>
  void add(const FractureSet<D>& set) {
    const auto& [name, systems, traces, on_faces] = set;
    add(name);
    add(systems);
    if (!traces.empty()) add(traces);
    if (on_faces) add(on_faces);
  }
  /// Which optional properties there are counts, too.
  template <int D>
  void add(const Medium<D>& medium) {
    for (const Property property : medium.properties()) {
      if (row_of(property).if_absent) add(row_of(property).name);
      add(medium[property]);
    }
  }
  template <int D>
  void add(const Model<D>& model) {
    const auto& [medium, fracture, sets, share, prestress_pa, title, source, history, geology] = model;
    add(medium);
    add(fracture);
    add(sets);
    if (!share.empty()) add(share);
    add(prestress_pa);
    add(title), add(source), add(history);
  }
  void add(const Wavelet& wavelet) {
    add(wavelet.text());
    const auto* sampled = std::get_if<shape::Sampled>(&wavelet.shape());
    if (!sampled) return;  // the text says it all
    add(sampled->times_s()), add(sampled->values());
    add(sampled->delay_s());
  }
  template <int D>
  void add(const Mechanism<D>& mechanism) {
    add(mechanism.index());
    if (const auto* force = std::get_if<PointForce<D>>(&mechanism)) add(force->vector);
    if (const auto* wave = std::get_if<PlaneWave<D>>(&mechanism)) {
      add(wave->angle_deg);
      add(wave->direction);
      if (!wave->in_x_z()) add(wave->azimuth_deg);
      if (wave->shear) add(1);
    }
    if (const auto* moment = std::get_if<MomentTensor<D>>(&mechanism))
      for (int i = 0; i < D; ++i)
        for (int j = i; j < D; ++j) add(moment->tensor(i, j));
  }
  template <int D>
  void add(const Source<D>& source) {
    const auto& [position_m, mechanism, wavelet, amplitude, delay_s] = source;
    add(position_m);
    add<D>(mechanism);
    add(wavelet);
    add(amplitude);
    if (delay_s != 0) add(delay_s);
  }
  /// Places in the model, and all that headers of traces hold.
  template <int D>
  void add(const Receiver<D>& receiver) {
    const auto& [point_m, channel, bin, map_m] = receiver;
    add(point_m), add(map_m);
    add(channel), add(bin);
  }
  template <int D>
  void add(const Spreads<D>& spreads) {
    for (std::size_t shot = 1; shot <= spreads.given().shots.size(); ++shot) {
      add(spreads.given().shots[shot - 1].number);
      add(spreads.map_source_of(shot));
      add(spreads.receivers_of(shot));
    }
  }
  std::string text() const { return std::to_string(sum_.sum()); }

 private:
  void add_all(const std::string& text) {
    add(text.size());
    sum_.add(text.data(), text.size());
  }
  Checksum sum_;
};

template <class... Things>
std::string digest_of(const Things&... things) {
  Digest digest;
  (digest.add(things), ...);
  return digest.text();
}

/// "3 mechanisms for 4 to 50 Hz, speeds at 20 Hz".
std::string shown_attenuation(const Attenuation& attenuation) {
  const auto& [mechanisms, reference_hz] = attenuation;
  return std::to_string(mechanisms.count()) + " mechanisms for " + shown(mechanisms.low_hz()) + " to " +
         shown(mechanisms.high_hz()) + " Hz, speeds at " + shown(reference_hz) + " Hz";
}

}  // namespace

template <int D>
Identity identity_of(const Scene<D>& scene) {
  const auto& [model, part, survey, edges, numerics, recording, snapshot_every_s, with_slip, slip_diary,
               attenuation] = scene;
  if (!part.is_whole()) throw Error("found a part of a scene, expected the whole of it");
  const auto& [order, cfl, given_step_s, zones, correction, double_precision, time_order, monotone, tiling,
               bands] = numerics;
  const auto& [components, duration_s, interval_s, fibre, before_s] = recording;
  const auto& [sources, receivers_m, blended, spreads, misplaced] = survey;
  static_assert(std::is_same_v<std::remove_cvref_t<decltype(tiling)>, Tiling>);        // changes no result
  static_assert(std::is_same_v<std::remove_cvref_t<decltype(misplaced)>, ErrorKind>);  // nor does this
  const double step_s = given_step_s ? *given_step_s : time_step_s(scene);
  std::string recorded;
  for (const auto component : components)
    recorded += (recorded.empty() ? "" : ",") + std::string(name_of(component));
  if (fibre)
    recorded += " (fibre at " + shown(fibre->angle_deg) + ", " + shown(fibre->azimuth_deg) + " degrees" +
                (fibre->along_path ? " along its path" : "") + ", gauge " + shown(fibre->gauge_m) + " m)";
  Identity identity = {
      {"grid", shown(model.grid())},
      {"order", std::to_string(order)},
      {"time order", std::to_string(time_order)},
      {"time step", shown(step_s) + " s"},
      {"cfl", shown(cfl)},
      {"precision", double_precision ? "double" : "float"},
      {"slip correction", name_of(correction)},
      {"slip", with_slip ? "on" : "off"},
      {"diary of slip", slip_diary ? "kept" : "not kept"},
      {"edge width", std::to_string(zones)},
      {"length of the traces", shown(duration_s) + " s"},
      {"sampling interval", shown(interval_s) + " s"},
      {"components", recorded},
      {"time between snapshots", snapshot_every_s ? shown(*snapshot_every_s) + " s" : "none"},
      {"number of sources", std::to_string(sources.size())},
      {"number of receivers", std::to_string(spreads ? spreads->count_of(1) : receivers_m.size())},
  };
  if (before_s > 0) identity.push_back({"time before the record", shown(before_s) + " s"});
  if (!bands.empty()) identity.push_back({"cells", shown(bands)});
  if (monotone) identity.push_back({"criterion of monotonicity", "kept"});
  if (attenuation) identity.push_back({"attenuation", shown_attenuation(*attenuation)});
  for (int axis = 0; axis < D; ++axis)
    for (const int side : {0, 1})
      identity.push_back(
          {std::string(side ? "high" : "low") + " edge of " + axis_names<D>()[std::size_t(axis)],
           name_of(edges[axis][side])});
  identity.push_back({"model", digest_of(model), false});
  identity.push_back({"source or wavelet", digest_of(sources), false});
  if (!blended.empty()) identity.push_back({"blended source", digest_of(blended), false});
  identity.push_back({"set of receivers", spreads ? digest_of(*spreads) : digest_of(receivers_m), false});
  return identity;
}

std::optional<std::string> difference_of(const Identity& found, const Identity& expected) {
  for (const auto& trait : expected) {
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const Trait& other) { return other.name == trait.name; });
    if (same != found.end() && same->value == trait.value) continue;
    if (!trait.in_words || same == found.end()) return "another " + trait.name;
    return trait.name + ' ' + same->value + ", expected " + trait.value;
  }
  if (found.size() != expected.size()) return "more traits";
  return {};
}

void serialize(Archive& archive, Identity& identity) {
  identity.resize(archive.count(identity.size(), 17));
  for (auto& [name, value, in_words] : identity) {
    archive.text(name);
    archive.text(value);
    archive.flag(in_words);
  }
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, identity_of);

}  // namespace slipwave
