#include "aero/wind_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twindeck::aero {
namespace {

std::vector<double> speeds_up_to(const WindSettings& config, double limit) {
  std::vector<double> speeds;
  for (int i = 1; speeds.empty() || speeds.back() < limit; ++i) speeds.push_back(std::min(i * config.speed_step_m_s, limit));
  return speeds;
}

/// The lowest instability of the followed modes, and what speaks of its cause. Mode 1 alone and Den Hartog's speed without
/// dampers.
CriticalRow critical_row(const WindSettings& config, const std::string& set, const AeroelasticSystem& system, bool dampers,
                         double structural_damping) {
  CriticalRow row;
  const Deployment& deployment = system.deployment();
  row.set = set;
  row.model = deployment.name;
  row.group = deployment.zones.empty() ? deployment.everywhere.group : "Hybrid";
  row.description = deployment.zones.empty() ? deployment.everywhere.description : "Table 14";
  row.dampers = dampers;
  row.structural_damping = structural_damping;
  const Instability instability = first_instability(config, system);
  row.point = instability.point;
  row.lost = instability.lost;
  if (row.point) row.character = aero::galloping_character(system, row.point->motion, row.point->speed_m_s);
  row.divergence_m_s = aero::divergence_speed(system);
  if (!dampers) {
    const AeroelasticSystem alone = system.restricted({0});
    const auto start = aero::still_air_modes(alone.structure());
    const auto point =
        aero::critical_point(alone, aero::follow_mode(alone, start.front(), 1, speeds_up_to(config, config.max_speed_m_s)));
    if (point) row.single_mode_m_s = point->speed_m_s;
    row.den_hartog_m_s = aero::den_hartog_speed(system, 0);
  }
  return row;
}

/// @param modes  how many are followed up to the highest speed
DampingCurves damping_curves(const WindSettings& config, const std::string& set, const AeroelasticSystem& system, bool dampers,
                             double structural_damping, long modes) {
  DampingCurves curves{set, system.deployment().name, dampers, structural_damping, {}};
  int mode = 0;
  for (const ComplexMode& start : aero::still_air_modes(system.structure())) {
    if (++mode > modes) break;
    curves.branches.push_back(aero::follow_mode(system, start, mode, speeds_up_to(config, config.max_speed_m_s)));
  }
  return curves;
}

}  // namespace

Instability first_instability(const WindSettings& config, const AeroelasticSystem& system) {
  Instability lowest;
  const auto tell = [&](const std::string& line) { lowest.lost += (lowest.lost.empty() ? "" : "; ") + line; };
  int mode = 0;
  for (const ComplexMode& start : aero::still_air_modes(system.structure())) {
    if (++mode > config.followed_modes) break;
    const double limit = lowest.point ? lowest.point->speed_m_s : config.max_speed_m_s;
    const Branch branch = aero::follow_mode(system, start, mode, speeds_up_to(config, limit));
    const auto found = aero::critical_point(system, branch);
    if (found && (!lowest.point || found->speed_m_s < lowest.point->speed_m_s)) lowest.point = found;
    if (found && found->bracket_m_s > 2.0 * relative_bracket * found->speed_m_s)
      tell(fmt::format("mode {} loses its damping at {:.6g} m/s or up to {:.6g} m/s below", mode, found->speed_m_s,
                       found->bracket_m_s));
    if (!branch.status.converged && !found) tell(branch.status.message);
  }
  return lowest;
}

Instabilities find_instabilities(const WindSettings& config, const std::vector<FittedSet>& sets, const WindModel& model,
                                 const DampedModel& damped) {
  const ReducedStructure bare = bare_structure(model, config.structural_damping);
  const Wind wind = config.wind();
  const auto system = [&](const FittedSet& set, const Deployment& deployment) {
    return AeroelasticSystem(bare, set.sections, model.strips, model.motions, wind, deployment);
  };
  const std::vector<Deployment> deployments = config.deployments();
  Instabilities found;
  for (const FittedSet& set : sets) {
    const auto add = [&](const AeroelasticSystem& of, bool dampers, double damping, long modes) {
      found.critical.push_back(critical_row(config, set.name, of, dampers, damping));
      if (modes > 0) found.damping.push_back(damping_curves(config, set.name, of, dampers, damping, modes));
    };
    for (const Deployment& deployment : deployments) add(system(set, deployment), false, config.structural_damping, 0);
    const Deployment fitted = everywhere(published_yaw_rule(config.fit_model));
    found.damping.push_back(
        damping_curves(config, set.name, system(set, fitted), false, config.structural_damping, config.followed_modes));
    ReducedStructure identified = bare;
    identified.damping_ratio.setConstant(config.identified_damping);
    add({identified, set.sections, model.strips, model.motions, wind, fitted}, false, config.identified_damping, 1);
    if (damped.dampers == 0) continue;
    add({damped.structure, set.sections, model.strips, damped.motions, wind, fitted}, true, config.structural_damping,
        config.damped_modes);
  }
  return found;
}

StaticResponse static_response(const WindSettings& config, const FittedSet& set, const Deployment& deployment,
                               const WindModel& model, const dynamics::LoadedModel& loaded, const linalg::Cholesky& factor) {
  StaticResponse response{set.name, deployment.name, {}, {}, {}};
  Eigen::VectorXd at_nodes(6 * std::ssize(model.strips));
  for (std::size_t i = 0; i < model.strips.size(); ++i) {
    const Strip& strip = model.strips[i];
    const YawRule& rule = deployment.at(strip.deck, strip.yaw_rad);
    const Eigen::Vector3d force = aero::static_force(set.sections[static_cast<std::size_t>(strip.section)], strip, rule,
                                                     config.density_kg_m3, config.design_speed_m_s, config.equations);
    response.force.push_back(force);
    at_nodes.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        aero::kinematics(strip, rule.axes, config.wind()).transpose() * force;
  }
  const Eigen::VectorXd nodal = model.nodes.motion.transpose() * at_nodes;
  const Eigen::MatrixXd free = loaded.system.expansion.transpose() * nodal;
  const auto motions = motions_of(model.nodes, loaded.system.expand(factor.solve(free)));
  for (std::size_t i = 0; i < motions.size(); ++i) {
    response.displacement.emplace_back(motions[i].col(0).head<3>());
    response.rotation_rad.push_back(aero::nose_up(model.strips[i], motions[i].col(0).tail<3>()));
  }
  return response;
}

std::optional<StaticDifference> static_difference(const std::vector<StaticResponse>& responses, const std::string& a,
                                                  const std::string& b) {
  const StaticResponse *first = nullptr, *second = nullptr;
  for (const StaticResponse& response : responses) {
    if (response.model == a && first == nullptr) first = &response;
    if (response.model == b && second == nullptr) second = &response;
  }
  if (first == nullptr || second == nullptr) return std::nullopt;
  StaticDifference largest;
  for (std::size_t i = 0; i < first->displacement.size(); ++i) {
    largest.displacement_m = std::max(largest.displacement_m, (first->displacement[i] - second->displacement[i]).norm());
    largest.rotation_rad = std::max(largest.rotation_rad, std::abs(first->rotation_rad[i] - second->rotation_rad[i]));
  }
  return largest;
}

double least_damping(const DampingCurves& curves, double up_to_m_s) {
  double least = 1.0;
  for (const Branch& branch : curves.branches)
    for (std::size_t i = 0; i < branch.points.size(); ++i)
      if (branch.speed_m_s[i] <= up_to_m_s) least = std::min(least, branch.points[i].damping_ratio());
  return least;
}

}  // namespace twindeck::aero
