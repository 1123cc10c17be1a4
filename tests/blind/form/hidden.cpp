#include "blind/form/hidden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::blind::form {

namespace {

using Eigen::Vector2d;

constexpr double kNextZone = 1.1;  ///< of a zone's length: the zone next to the true one is still right
constexpr double kReference_C = 15.0;
constexpr std::array<double, 4> kTemperatures_C = {-6.0, 8.0, 20.0, 33.0};
constexpr std::array<double, 4> kAmplitudes_m = {0.0001, 0.0005, 0.0015, 0.004};

Vector2d middle(const Layout& layout, int beam) {
  const CoarseBeam& b = layout.beams[static_cast<std::size_t>(beam)];
  return 0.5 * (layout.nodes[static_cast<std::size_t>(b.from)] + layout.nodes[static_cast<std::size_t>(b.to)]);
}

/// Where a place of the catalogue lies; nothing for a group or a channel.
std::optional<Vector2d> position_of(const Layout& layout, const std::string& location) {
  const auto colon = location.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const std::string kind = location.substr(0, colon), name = location.substr(colon + 1);
  const auto node = [&](const std::string& id) -> std::optional<Vector2d> {
    const long i = std::atol(id.c_str()) - 1;
    if (i < 0 || i >= static_cast<long>(layout.nodes.size())) return std::nullopt;
    return layout.nodes[static_cast<std::size_t>(i)];
  };
  if (kind == "node") return node(name);
  if (kind == "element") {
    const long e = std::atol(name.c_str()) - 1;
    if (e < 0 || e >= static_cast<long>(layout.beams.size())) return std::nullopt;
    return middle(layout, static_cast<int>(e));
  }
  if (kind == "nodes") {
    const auto comma = name.find(',');
    if (comma == std::string::npos) return std::nullopt;
    const auto a = node(name.substr(0, comma)), b = node(name.substr(comma + 1));
    if (a && b) return 0.5 * (*a + *b);
  }
  if (kind == "support")
    for (const Bearing& bearing : layout.bearings)
      if (name == bearing.name || name == bearing.name + "_turn") return layout.nodes[static_cast<std::size_t>(bearing.node)];
  return std::nullopt;
}

/// A bearing's springs, and the parameters that scale them alone.
std::vector<std::string> names_of_springs(const Layout& layout, const std::string& group) {
  std::vector<std::string> out = {"support:" + group, "group:" + group};
  for (const Quantity& quantity : layout.quantities)
    if (quantity.groups == std::vector<std::string>{group}) out.push_back("group:" + quantity.name);
  return out;
}

/// Draws one family after the other into a Hidden whose turn is set.
class Drawing {
 public:
  Drawing(const Layout& layout, const Eigen::VectorXd& sound_Hz, Stream& random, Hidden& hidden)
      : layout_(layout), sound_Hz_(sound_Hz), random_(random), hidden_(hidden) {}

  void draw() {
    switch (hidden_.turn.category) {
      case Category::sound:
        sound();
        break;
      case Category::two_states:
        after(structural(hidden_.turn.family, true));
        break;
      case Category::one_state:
        once(structural(hidden_.turn.family, false));
        break;
      case Category::conditions:
        conditions();
        break;
      case Category::sensors:
        sensors();
        break;
      case Category::outside:
        outside();
        break;
    }
  }

 private:
  // Tests.
  void once(const Change& change) {
    hidden_.conditions.push_back({"first", false, {}, {}, change});
    if (random_.chance(0.5)) hidden_.conditions.push_back({"second", false, {}, {}, change});
  }
  void after(const Change& change) {
    hidden_.conditions.push_back({"before", false, {}, {}, {}});
    hidden_.conditions.push_back({"after", true, {}, {}, change});
  }
  void by_temperature(const std::function<Change(double)>& change) {
    for (const double t : kTemperatures_C) hidden_.conditions.push_back({fmt::format("t{:.0f}", t), false, t, {}, change(t)});
  }
  void by_amplitude(const std::function<Change(double)>& change) {
    for (const double a : kAmplitudes_m)
      hidden_.conditions.push_back({fmt::format("a{:.1f}", 1e3 * a), false, {}, a, change(a)});
  }
  void sound() {
    const std::string& test = hidden_.turn.family;
    const auto nothing = [](double) { return Change{}; };
    if (test == "two states")
      after({});
    else if (test == "temperatures")
      by_temperature(nothing);
    else if (test == "amplitudes")
      by_amplitude(nothing);
    else
      hidden_.conditions.push_back({"first", false, {}, {}, {}});
    if (test == "repeated test") hidden_.conditions.push_back({"second", false, {}, {}, {}});
    hidden_.words = test;
  }

  // Places and sizes.
  [[nodiscard]] int inner_node() {
    for (;;) {
      const int node = random_.below(static_cast<int>(layout_.nodes.size()));
      if (std::none_of(layout_.bearings.begin(), layout_.bearings.end(), [&](const Bearing& b) { return b.node == node; }))
        return node;
    }
  }
  [[nodiscard]] double log_between(double low, double high) { return std::exp(random_.between(std::log(low), std::log(high))); }
  [[nodiscard]] double near_a_mode() { return sound_Hz_[random_.below(4)] * random_.between(0.93, 1.07); }
  void at_node(const std::string& family, int node) {
    hidden_.sought = {{family}, {}, layout_.nodes[static_cast<std::size_t>(node)], kNextZone * layout_.zone_m};
  }
  void size(const std::string& name, double value, const std::string& of) {
    hidden_.size_name = name;
    hidden_.size = value;
    hidden_.words = fmt::format("{}: {} {:.4g}", of, name, value);
  }

  Change structural(const std::string& family, bool change) {
    if (family == "group") return group();
    if (family == "zone") return zone(change ? random_.between(0.4, 0.75) : random_.between(0.4, 0.7));
    if (family == "mass") return mass(random_.between(0.015, 0.06));
    if (family == "soft bearing") return bearing(log_between(0.15, 0.5));
    if (family == "stiff bearing") return bearing(log_between(2.5, 8.0));
    if (family == "bearing") return bearing(random_.chance(0.5) ? log_between(0.05, 0.25) : log_between(5.0, 12.0));
    if (family == "lost") return lost();
    if (family == "moved") return moved();
    if (family == "prop") return prop();
    if (family == "oscillator") return oscillator();
    if (family == "brace") return brace();
    TWINDECK_ASSERT(family == "turn");
    return turn();
  }
  Change group() {
    const int m = random_.below(static_cast<int>(layout_.materials.size()));
    const std::string& name = layout_.materials[static_cast<std::size_t>(m)].name;
    hidden_.sought = {{"stiffness"}, {"group:" + name, "group:E_" + name}, {}, 0.0};
    size("factor", random_.chance(0.5) ? random_.between(0.7, 0.9) : random_.between(1.12, 1.35), name);
    Change out;
    out.material[m] = hidden_.size;
    return out;
  }
  Change zone(double factor) {
    const int e = random_.below(static_cast<int>(layout_.beams.size()));
    hidden_.sought = {{"joint"}, {}, middle(layout_, e), kNextZone * layout_.zone_m};
    size("factor", factor, fmt::format("element {}", e + 1));
    Change out;
    out.beam[e] = factor;
    return out;
  }
  Change mass(double part) {
    const int node = inner_node();
    at_node("mass", node);
    size("mass_kg", part * layout_.total_kg, fmt::format("mass at node {}", node + 1));
    Change out;
    out.masses.push_back({node, hidden_.size});
    return out;
  }
  int any_bearing(const std::set<std::string>& families, const std::string& suffix) {
    for (;;) {
      const int b = random_.below(static_cast<int>(layout_.bearings.size()));
      const Bearing& bearing = layout_.bearings[static_cast<std::size_t>(b)];
      if (!suffix.empty() && !(bearing.turn_N_m > 0.0)) continue;
      hidden_.sought = {families, names_of_springs(layout_, bearing.name + suffix), {}, 0.0};
      hidden_.words = bearing.name + suffix;
      return b;
    }
  }
  Change bearing(double factor) {
    Change out;
    out.bearing[any_bearing({"brg", "stiffness"}, "")] = factor;
    size("factor", factor, hidden_.words);
    return out;
  }
  Change turn() {
    const double factor = random_.chance(0.6) ? log_between(0.05, 0.3) : log_between(4.0, 10.0);
    Change out;
    out.turn[any_bearing({"foundation", "stiffness"}, "_turn")] = factor;
    size("factor", factor, hidden_.words);
    return out;
  }
  Change lost() {
    constexpr double kLiftedOff = 1e-3;  // what is left of a bearing that no longer touches
    Change out;
    out.bearing[any_bearing({"lost", "brg", "stiffness"}, "")] = kLiftedOff;
    hidden_.words += " lost";
    return out;
  }
  Change moved() {
    const int b = any_bearing({"move"}, "");
    double by = random_.between(0.4, 2.0);
    const bool first = b == 0, last = b + 1 == static_cast<int>(layout_.bearings.size());
    if (last || (!first && random_.chance(0.5))) by = -by;
    Change out;
    out.shift_m[b] = by;
    const int node = layout_.bearings[static_cast<std::size_t>(b)].node;
    size("x_m", layout_.nodes[static_cast<std::size_t>(node)].x() + by, fmt::format("{} moved by {:.2f} m", hidden_.words, by));
    return out;
  }
  Change prop() {
    const int node = inner_node();
    at_node("prop", node);
    size("stiffness_N_m", random_.between(0.3, 3.0) * reference_N_m(layout_), fmt::format("prop at node {}", node + 1));
    Change out;
    out.to_ground.push_back({node, layout_.direction, hidden_.size});
    return out;
  }
  Change oscillator() {
    const int node = inner_node();
    at_node("osc", node);
    const double hertz = near_a_mode();
    size("mass_kg", random_.between(0.005, 0.02) * layout_.total_kg,
         fmt::format("oscillator of {:.2f} Hz at node {}", hertz, node + 1));
    Change out;
    out.chains.push_back({node, {{hidden_.size, hertz}}});
    return out;
  }
  Change brace() {
    const int storey = random_.below(static_cast<int>(layout_.floors.size()) / 2), from = 2 * storey, to = 2 * storey + 3;
    const Vector2d a = layout_.nodes[static_cast<std::size_t>(from)], b = layout_.nodes[static_cast<std::size_t>(to)];
    hidden_.sought = {{"tie"}, {fmt::format("nodes:{},{}", from + 1, to + 1)}, 0.5 * (a + b), kNextZone * layout_.zone_m};
    size("stiffness_N_m", 2.0 * random_.between(0.3, 1.5) * reference_N_m(layout_),
         fmt::format("brace of storey {}", storey + 1));
    Change out;
    out.ties.push_back({from, to, hidden_.size});
    return out;
  }

  void conditions() {
    const std::string& family = hidden_.turn.family;
    if (family == "temperature of all") {
      const double rate = random_.between(-0.006, -0.0015);
      hidden_.sought = {{"tempE"}, {"global"}, {}, 0.0};
      size("rate", rate, "all beams");
      return by_temperature([&](double t) {
        Change out;
        out.beams = 1.0 + rate * (t - kReference_C);
        return out;
      });
    }
    const bool frozen = family == "frozen bearing";
    const int b = any_bearing({frozen ? "freeze" : "brgfric"}, "");
    const double factor = frozen ? log_between(3.0, 20.0) : log_between(0.1, 0.5);
    size("factor", factor, hidden_.words);
    const auto acts = [&](bool there) {
      Change out;
      if (there) out.bearing[b] = factor;
      return out;
    };
    if (frozen)
      by_temperature([&](double t) { return acts(t < 0.0); });
    else
      by_amplitude([&](double a) { return acts(a > 0.001); });
  }

  void sensors() {
    once({});
    const int channels = static_cast<int>(layout_.channel_nodes.size());
    SensorFault& fault = hidden_.fault;
    fault.channel = random_.below(channels);
    const std::string name = channel_name(layout_, fault.channel);
    if (hidden_.turn.family == "reversed") {
      fault.what = SensorFault::What::reversed;
      hidden_.sought = {{"pol"}, {"channel:" + name}, {}, 0.0};
      hidden_.words = name + " reversed";
    } else if (hidden_.turn.family == "exchanged") {
      fault.what = SensorFault::What::exchanged;
      do fault.other = random_.below(channels);
      while (fault.other == fault.channel);
      const std::string other = channel_name(layout_, fault.other);
      hidden_.sought = {{"swap"}, {"channels:" + name + "," + other, "channels:" + other + "," + name}, {}, 0.0};
      hidden_.words = name + " and " + other + " exchanged";
    } else {
      fault.what = SensorFault::What::scaled;
      fault.factor = random_.chance(0.5) ? random_.between(0.5, 0.75) : random_.between(1.35, 2.0);
      hidden_.sought = {{"gain"}, {"channel:" + name}, {}, 0.0};
      size("factor", fault.factor, name);
    }
  }

  void outside() {
    const std::string& family = hidden_.turn.family;
    hidden_.words = family;
    if (family == "ground turn") return after(ground_turn());
    if (family == "coupled oscillators") return random_.chance(0.5) ? after(coupled()) : once(coupled());
    if (family == "axial force") return after(axial());
    if (family == "gap") return gap();
    if (family == "hardening bearing") return hardening();
    if (family == "nonlinear damper") return damper();
    if (family == "snow") return snow();
    TWINDECK_ASSERT(family == "vee of temperature");
    const double rate = random_.between(0.003, 0.008), turning = random_.between(8.0, 14.0);
    by_temperature([&](double t) {
      Change out;
      out.beams = 1.0 + rate * std::abs(t - turning);
      return out;
    });
  }
  [[nodiscard]] double bending() const {
    return layout_.materials.front().youngs_modulus_Pa * layout_.sections.front().inertia_m4;
  }
  Change ground_turn() {
    Change out;
    out.to_ground.push_back({inner_node(), 2, random_.between(1.0, 6.0) * bending() / layout_.span_m});
    return out;
  }
  Change coupled() {
    const double hertz = near_a_mode();
    Change out;
    out.chains.push_back({inner_node(),
                          {{random_.between(0.005, 0.015) * layout_.total_kg, 0.95 * hertz},
                           {random_.between(0.005, 0.015) * layout_.total_kg, 1.1 * hertz}}});
    return out;
  }
  Change axial() {
    const double part = random_.between(0.04, 0.12), euler_N = std::pow(std::numbers::pi / layout_.span_m, 2) * bending();
    Change out;
    out.compression_N = (random_.chance(0.5) ? part : -part) * euler_N;
    return out;
  }
  /// A stop on both sides that is met beyond the gap: secant stiffness of a piecewise linear spring under a harmonic motion
  /// (describing function of a dead zone; Gelb and Vander Velde 1968, Multiple-Input Describing Functions and Nonlinear System
  /// Design).
  void gap() {
    const int node = inner_node();
    const double N_m = random_.between(0.5, 3.0) * reference_N_m(layout_), gap_m = random_.between(0.0003, 0.0012);
    by_amplitude([&](double a) {
      Change out;
      const double ratio = gap_m / (std::numbers::sqrt2 * a);
      if (ratio < 1.0) {
        const double part = 1.0 - 2.0 / std::numbers::pi * (std::asin(ratio) + ratio * std::sqrt(1.0 - ratio * ratio));
        out.to_ground.push_back({node, layout_.direction, part * N_m});
      }
      return out;
    });
  }
  void hardening() {
    const int b = random_.below(static_cast<int>(layout_.bearings.size()));
    const double most = random_.between(1.0, 4.0);
    by_amplitude([&](double a) {
      Change out;
      out.bearing[b] = 1.0 + most * std::pow(a / kAmplitudes_m.back(), 2);
      return out;
    });
  }
  /// Force ~ velocity to the power 0.4, in series with its mount: the equivalent dashpot falls with amplitude.
  void damper() {
    constexpr double kPower = 0.4, kMiddle_m = 0.001;
    const int node = inner_node();
    const double N_m = random_.between(0.5, 2.0) * reference_N_m(layout_);
    by_amplitude([&](double a) {
      Change out;
      out.damper =
          Change::Damper{node, N_m, N_m / (2.0 * std::numbers::pi * sound_Hz_[0]) * std::pow(a / kMiddle_m, kPower - 1.0)};
      return out;
    });
  }
  void snow() {
    const int n = static_cast<int>(layout_.nodes.size()), third = n / 3, from = random_.below(n - third);
    const double kg = random_.between(0.04, 0.08) * layout_.total_kg / third;
    by_temperature([&](double t) {
      Change out;
      if (t < 0.0)
        for (int node = from; node < from + third; ++node) out.masses.push_back({node, kg});
      return out;
    });
  }

  const Layout& layout_;
  const Eigen::VectorXd& sound_Hz_;
  Stream& random_;
  Hidden& hidden_;
};

}  // namespace

bool names(const Layout& layout, const Sought& sought, const std::string& answer) {
  const auto at = answer.find('@');
  if (at == std::string::npos || !sought.families.contains(answer.substr(0, at))) return false;
  std::string location = answer.substr(at + 1);
  location = location.substr(0, location.find_first_of("[(#| "));
  if (std::find(sought.locations.begin(), sought.locations.end(), location) != sought.locations.end()) return true;
  if (!sought.where) return false;
  const auto position = position_of(layout, location);
  return position && (*position - *sought.where).norm() <= sought.reach_m;
}

Sought sought_of(const Layout& layout, const Feature& feature) {
  using What = Feature::What;
  const auto node = [&](int i) { return layout.nodes[static_cast<std::size_t>(i)]; };
  const double reach = kNextZone * layout.zone_m;
  switch (feature.what) {
    case What::splice:
      return {{"joint"}, {}, node(feature.place), reach};
    case What::joint: {
      const CoarseBeam& beam = layout.beams[static_cast<std::size_t>(feature.place / 2)];
      return {{"joint"}, {}, node(feature.place % 2 == 0 ? beam.from : beam.to), reach};
    }
    case What::end_turn: {
      const Bearing& bearing = layout.bearings[static_cast<std::size_t>(feature.place)];
      return {{"foundation", "brg", "stiffness"}, names_of_springs(layout, bearing.name + "_turn"), node(bearing.node), 0.01};
    }
    case What::diaphragm:
      return {{"mass"}, {}, node(feature.place), reach};
    case What::floor:
      return {{"mass"}, {}, node(layout.floors[static_cast<std::size_t>(feature.place)].node), reach};
    case What::infill:
      return {{"tie"}, {}, 0.5 * (node(2 * feature.place) + node(2 * feature.place + 3)), reach};
    default:
      return {};
  }
}

Hidden draw_hidden(const Layout& layout, const Turn& turn, const Eigen::VectorXd& sound_Hz, Stream& random) {
  Hidden hidden;
  hidden.turn = turn;
  Drawing(layout, sound_Hz, random, hidden).draw();
  return hidden;
}

}  // namespace twindeck::blind::form
