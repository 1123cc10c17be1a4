#include "ponte/virtual_bridge/virtual_bridge.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/uneven_shells.hpp"
#include "io/csv.hpp"
#include "matching/pairing.hpp"
#include "ponte/generator.hpp"
#include "sensitivity/frequency_jacobian.hpp"

namespace twindeck::ponte {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDeckMode = 0.5;         ///< [-] of the kinetic energy in stays: a mode with less is one of the decks
constexpr double kNeverPaired = 1e3;      ///< a distance in ln f beyond any between two modes
constexpr double kSensorAtNode_m = 0.05;  ///< a sensor is at a node that is this near: the layout prints centimetres

/// Checks that each [[damper]] of the configuration names another type of the bridge's definition, and, if a condition has
/// dampers, that every type has a [[damper]].
void check_damper_types(const CampaignSettings& settings, const fe::Model& model) {
  const std::string prefix = "damper_";
  std::set<std::string> types, seen;
  for (const fe::Spring& spring : model.springs)
    if (spring.group.starts_with(prefix)) types.insert(spring.group.substr(prefix.size()));
  const std::vector<std::string> known(types.begin(), types.end());
  for (const DamperSettings& damper : settings.dampers) {
    if (!types.contains(damper.type))
      throw InputError(
          {"", 0, "damper"},
          fmt::format("'{}' is no type of damper of {}{}", damper.type, settings.bridge, did_you_mean(damper.type, known)),
          known.empty() ? "the bridge has no dampers" : fmt::format("use {}", fmt::join(known, ", ")));
    if (!seen.insert(damper.type).second)
      throw InputError({"", 0, "damper"}, fmt::format("type '{}' stands twice", damper.type), "give each type one table");
  }
  if (std::ranges::none_of(settings.conditions, [](const auto& c) { return c.dampers; })) return;
  for (const std::string& type : known)
    if (!seen.contains(type))
      throw InputError({"", 0, "damper"}, "has no table for type " + type, "add [[damper]] with its mount and friction");
}

/// Assigns a mode to each named one, the nearest pairs first. Modes that are mostly stays are not used.
std::vector<Index> nearest_named(const BridgeState& state, const CampaignSettings& settings) {
  const Index n = std::ssize(settings.named), m = state.modes.frequency_Hz.size();
  MatrixXd distance(n, m);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      const double ratio = state.modes.frequency_Hz[j] / settings.named[static_cast<std::size_t>(i)].frequency_Hz;
      distance(i, j) = state.stay_share[j] < kDeckMode ? std::abs(std::log(ratio)) : kNeverPaired;
    }
  }
  std::map<Index, Index> mode_of;
  for (Index k = 0; k < n; ++k) {
    Index i = 0, j = 0;
    distance.minCoeff(&i, &j);
    mode_of[i] = j;
    distance.row(i).setConstant(1e6);
    distance.col(j).setConstant(1e6);
  }
  return each_of(mode_of, [](const auto& entry) { return entry.second; });
}

/// Refuses corrections that were found for other frequencies or for another bridge. @param state  with the corrections,
/// untouched by temperature
void refuse_stale_corrections(const CampaignSettings& settings, const BridgeState& state) {
  constexpr double kAllowed = 0.002;  // [-] ten times the error at which --calibrate ends, above rounding and turning modes
  if (settings.corrections.empty()) return;
  for (std::size_t i = 0; i < settings.named.size(); ++i) {
    const NamedMode& wanted = settings.named[i];
    const double f_Hz = state.modes.frequency_Hz[state.named[i]];
    if (std::abs(f_Hz / wanted.frequency_Hz - 1.0) > kAllowed)
      throw InputError(
          {settings.corrections, 0, "factor"},
          fmt::format("the bridge has mode {} at {:.4f} Hz, expected {:g} Hz within {:g} %, as mode.frequency says",
                      wanted.name, f_Hz, wanted.frequency_Hz, 100.0 * kAllowed),
          "find corrections for it with --calibrate and corrections = \"\"");
  }
}

constexpr double kBound = 0.5;  // of the parameters, relative

std::string deck_of(const std::string& group) {
  for (const std::string deck : {"foot", "cycle"})
    if (group.starts_with(deck + "_")) return deck;
  return "";
}

/// From 1 at mid-length to `zones` at the ends, by x, which grows along the deck all the way.
int zone_of(double x_m, double reach_m, int zones) {
  return 1 + std::min(zones - 1, static_cast<int>(std::abs(x_m) / reach_m * zones));
}

void add_parameter(fe::Model& model, const std::string& name, fe::Target target, const std::string& of, const std::string& unit,
                   double value) {
  model.parameters.push_back({name, target, {of}, unit, value, value * (1.0 - kBound), value * (1.0 + kBound)});
}

/// Gives every kind of deck member (foot_top_chord, cycle_long_diagonal, …) a modulus of its own in each of `zones` stretches
/// from mid-length to the ends, and the non-structural mass of each deck a factor in each, as parameters
///
///     E_foot_top_chord_1 (Young's modulus),   m_foot_nonstructural_mass_1 (factor),   …
///
/// Stretches are alike north and south. They stand for the scatter of fabrication and construction between stretches.
/// Values stay as they are until the parameters are changed.
/// @param zones  >= 1
fe::Model with_zoned_members(fe::Model model, int zones) {
  TWINDECK_ASSERT(zones >= 1);
  const auto x_of = [&](int node) { return model.nodes[static_cast<std::size_t>(node)].x_m.x(); };
  std::map<std::string, double> reach_m;
  for (const fe::PointMass& mass : model.masses) {
    double& reach = reach_m[deck_of(mass.group)];
    reach = std::max(reach, std::abs(x_of(mass.node)));
  }
  std::map<std::string, int> material_of;
  for (fe::Element& element : model.elements) {
    const std::string deck = deck_of(element.group);
    if (element.type != fe::ElementType::beam || deck.empty()) continue;
    const double x = (x_of(element.nodes[0]) + x_of(element.nodes[1])) / 2.0;
    const std::string name = element.group + "_" + std::to_string(zone_of(x, reach_m.at(deck), zones));
    const auto [entry, is_new] = material_of.try_emplace(name, static_cast<int>(model.materials.size()));
    if (is_new) {
      fe::Material material = model.materials[static_cast<std::size_t>(element.material)];
      material.name = "steel_" + name;
      model.materials.push_back(material);
      add_parameter(model, "E_" + name, fe::Target::youngs_modulus, material.name, "Pa", material.youngs_modulus_Pa);
    }
    element.material = entry->second;
  }
  std::map<std::string, bool> seen;
  for (fe::PointMass& mass : model.masses) {
    const std::string deck = deck_of(mass.group);
    if (deck.empty()) continue;
    mass.group += "_" + std::to_string(zone_of(x_of(mass.node), reach_m.at(deck), zones));
    if (!seen.emplace(mass.group, true).second) continue;
    add_parameter(model, "m_" + mass.group, fe::Target::point_mass, mass.group, "-", 1.0);
  }
  return model;
}

/// The named modes of a state, as those that look most like the named modes of a neighbouring one.
std::vector<Index> follow_named(const BridgeState& before, const BridgeState& state) {
  const std::vector<int> followed =
      matching::follow_modes((before.modes.shapes(Eigen::all, before.named).transpose() * state.mass_shapes).cwiseAbs2());
  return {followed.begin(), followed.end()};
}

BridgeState solve_bridge(const VirtualBridge& bridge, const CampaignSettings& settings, const VectorXd& theta) {
  BridgeState state;
  const fe::PrestressState pulls = fe::find_prestress(bridge.undivided, theta);
  if (!pulls.status.converged) throw InputError({settings.bridge, 0, "prestress"}, pulls.status.message);
  state.chains =
      fe::with_stay_chains(bridge.undivided, pulls, static_cast<int>(settings.stay_pieces), settings.vibrating_stays);
  state.system = fe::assemble(state.chains.model, state.chains.state);
  state.theta = theta;
  dynamics::ModalSolver solver(state.system);
  state.modes = solver.solve(theta, static_cast<int>(settings.modes));
  if (!state.modes.status.converged) throw InputError({"", 0, "modes"}, state.modes.status.message, "ask for fewer modes");

  // The chains' nodes come last, so that the first dofs are those of the undivided bridge.
  const Index n_deck = bridge.n_deck;
  const auto deck_mass = solver.mass().topLeftCorner(n_deck, n_deck).eval();
  const auto deck_shapes = state.modes.shapes.topRows(n_deck);
  const MatrixXd mass_shapes = deck_mass.selfadjointView<Eigen::Lower>() * deck_shapes;
  state.stay_share = 1.0 - deck_shapes.cwiseProduct(mass_shapes).colwise().sum().transpose().array();
  state.mass_shapes = solver.mass().selfadjointView<Eigen::Lower>() * state.modes.shapes;
  state.named = nearest_named(state, settings);
  return state;
}

/// The modes that calibration starts from, by position among those with less than half of their kinetic energy in the stays.
std::vector<Index> starting_modes(const BridgeState& state, const CampaignSettings& settings) {
  std::vector<Index> deck;
  for (Index j = 0; j < state.stay_share.size(); ++j)
    if (state.stay_share[j] < kDeckMode) deck.push_back(j);
  std::vector<Index> named;
  for (const NamedMode& mode : settings.named) {
    if (mode.deck_mode > std::ssize(deck))
      throw InputError({"", 0, "mode.deck_mode"},
                       fmt::format("is {}, but only {} of the modes are the deck's", mode.deck_mode, deck.size()),
                       "raise `modes`");
    named.push_back(deck[static_cast<std::size_t>(mode.deck_mode - 1)]);
  }
  return named;
}

}  // namespace

VirtualBridge read_virtual_bridge(const std::filesystem::path& definition, const CampaignSettings& settings) {
  VirtualBridge bridge;
  const fe::Model members = with_zoned_members(generate(definition, "as_built"), static_cast<int>(settings.zones));
  bridge.undivided = fe::with_uneven_shells(members, settings.unevenness, settings.unevenness_wavelength_m);
  fe::validate(bridge.undivided);
  check_damper_types(settings, bridge.undivided);
  bridge.uncorrected = fe::initial_parameters(bridge.undivided);
  return bridge;
}

VirtualBridge numbered(VirtualBridge bridge) {
  const fe::ParametricSystem system = fe::assemble(bridge.undivided, fe::find_prestress(bridge.undivided, bridge.uncorrected));
  fe::check_no_mechanism(system, bridge.uncorrected, bridge.undivided.source);
  bridge.n_deck = system.size();
  return bridge;
}

VectorXd corrected_parameters(const VirtualBridge& bridge, const std::filesystem::path& file) {
  VectorXd theta = bridge.uncorrected;
  if (file.empty()) return theta;
  const auto table = io::CsvTable::read(file, {"parameter", "factor"});
  std::vector<std::string> names = each_of(bridge.undivided.parameters, &fe::Parameter::name);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = table.text(row, "parameter");
    const auto at = std::ranges::find(names, name);
    if (at == names.end())
      table.fail(row, "parameter", "'" + name + "' is no parameter of the virtual bridge" + did_you_mean(name, names));
    const double factor = table.number(row, "factor");
    if (factor <= 0.0) table.fail(row, "factor", fmt::format("is {:g}, expected more than 0", factor));
    theta[at - names.begin()] *= factor;
  }
  return theta;
}

VectorXd at_temperature(const VirtualBridge& bridge, const CampaignSettings& settings, VectorXd theta, double temperature_C) {
  for (const TemperatureEffect& effect : settings.temperature) {
    const auto& parameters = bridge.undivided.parameters;
    const auto at = std::ranges::find(parameters, effect.parameter, &fe::Parameter::name);
    if (at == parameters.end())
      throw InputError({settings.bridge, 0, "temperature_effect"},
                       "'" + effect.parameter + "' is no parameter of the virtual bridge");
    theta[at - parameters.begin()] *= 1.0 + effect.per_K * (temperature_C - settings.reference_temperature_C);
  }
  return theta;
}

std::map<double, BridgeState> solve_states(const VirtualBridge& bridge, const CampaignSettings& settings,
                                           const VectorXd& theta) {
  std::map<double, BridgeState> states;
  const BridgeState& reference =
      states.emplace(settings.reference_temperature_C, solve_bridge(bridge, settings, theta)).first->second;
  refuse_stale_corrections(settings, reference);
  for (const ConditionSettings& condition : settings.conditions) {
    if (states.contains(condition.temperature_C)) continue;
    BridgeState state = solve_bridge(bridge, settings, at_temperature(bridge, settings, theta, condition.temperature_C));
    state.named = follow_named(reference, state);
    states.emplace(condition.temperature_C, std::move(state));
  }
  return states;
}

VectorXd imposed_damping(const BridgeState& state, const CampaignSettings& settings) {
  const Eigen::ArrayXd stays = state.stay_share.array().max(0.0).min(1.0);
  VectorXd damping = stays * settings.stay_damping + (1.0 - stays) * settings.other_damping;
  for (std::size_t i = 0; i < state.named.size(); ++i) damping[state.named[i]] = settings.named[i].damping_ratio;
  return damping;
}

MatrixXd at_channels(const BridgeState& state, const MatrixXd& x, const std::vector<sensors::LayoutChannel>& channels) {
  const std::vector<int> nodes =
      sensors::nodes_at(state.chains.model, each_of(channels, &sensors::LayoutChannel::x_m), kSensorAtNode_m);
  const MatrixXd full = state.system.expand(x);
  MatrixXd out(std::ssize(channels), x.cols());
  for (std::size_t c = 0; c < channels.size(); ++c)
    out.row(static_cast<Index>(c)) = channels[c].cosines.transpose() * full.middleRows(6 * nodes[c], 3);
  return out;
}

BridgeTuning tune(const VirtualBridge& bridge, const CampaignSettings& settings, const Reporter& reporter) {
  constexpr int kSteps = 40;
  constexpr double kLongestStep = 0.08;  // of a logarithm: in a longer step modes may change places unnoticed
  constexpr double kGood = 2e-4;         // a tenth of the 0.2 % allowed
  const Index n = std::ssize(settings.named), p = bridge.uncorrected.size();
  BridgeTuning found{bridge.uncorrected, VectorXd::Zero(n), {false, "no step was made"}};
  std::optional<BridgeState> before;
  for (int step = 0; step < kSteps; ++step) {
    BridgeState state = solve_bridge(bridge, settings, found.theta);
    state.named = before ? follow_named(*before, state) : starting_modes(state, settings);
    const MatrixXd slope = sensitivity::frequency_jacobian(state.system, found.theta, state.modes);
    MatrixXd jacobian(n, p);  // d ln f / d ln theta
    for (Index i = 0; i < n; ++i) {
      const Index at = state.named[static_cast<std::size_t>(i)];
      const double f = state.modes.frequency_Hz[at];
      found.error[i] = std::log(f / settings.named[static_cast<std::size_t>(i)].frequency_Hz);
      jacobian.row(i) = slope.row(at).cwiseProduct(found.theta.transpose()) / f;
    }
    reporter.say(fmt::format("calibration, step {}: largest error {:.4f} %, largest correction {:.2f}", step,
                             100.0 * found.error.cwiseAbs().maxCoeff(),
                             (found.theta.array() / bridge.uncorrected.array()).log().abs().maxCoeff()));
    if (found.error.cwiseAbs().maxCoeff() < kGood) {
      found.status = {true, ""};
      return found;
    }
    // min |e + J d|² / w² + |x + d|² / s² over the change d of the logarithms x.
    const VectorXd x = (found.theta.array() / bridge.uncorrected.array()).log();
    const double w = 1.0 / (settings.frequency_weight * settings.frequency_weight),
                 s = 1.0 / (settings.correction_spread * settings.correction_spread);
    const MatrixXd normal = w * jacobian.transpose() * jacobian + s * MatrixXd::Identity(p, p);
    const VectorXd change = normal.ldlt().solve(-w * jacobian.transpose() * found.error - s * x);
    const double longest = change.cwiseAbs().maxCoeff();
    found.theta = found.theta.array() * (change.array() * std::min(1.0, kLongestStep / longest)).exp();
    before = std::move(state);
    found.status = {false, fmt::format("after {} steps a named frequency is still off by {:.3f} %", step + 1,
                                       100.0 * found.error.cwiseAbs().maxCoeff())};
  }
  return found;
}

}  // namespace twindeck::ponte
