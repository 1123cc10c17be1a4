#include "diagnosis/splitting_measurement.hpp"

#include <fmt/format.h>

namespace twindeck::diagnosis {

namespace {

/// A condition or a sensor that only one of the two needs; empty if there is none.
std::string splitting_condition(const FeatureMap& map, const Candidate& a, const Candidate& b) {
  const auto& needs_a = a.hypothesis->needs.distinct;
  const auto& needs_b = b.hypothesis->needs.distinct;
  for (const auto* needs : {&needs_a, &needs_b})
    for (const auto& [key, count] : *needs)
      if (a.hypothesis != b.hypothesis && (!needs_a.contains(key) || !needs_b.contains(key)))
        return fmt::format("the same modes at further values of {}", key);
  if (a.hypothesis->set == "dampers" && b.hypothesis->set == "dampers" && a.hypothesis != b.hypothesis)
    return "the modes with dampers at two or more amplitudes, one of them beyond slip";
  if (a.hypothesis->measurement || b.hypothesis->measurement) {
    std::string names;
    for (const Candidate* c : {&a, &b})
      for (const int channel : c->channels)
        names += (names.empty() ? "" : ", ") + map.features().channels[static_cast<std::size_t>(channel)];
    return "a repeated record with a second, calibrated sensor beside " + names;
  }
  return "";
}

/// Where the shapes of two entries differ most, of the modes as measured now; empty if no shape can tell them apart.
std::string splitting_shape(const FeatureMap& map, const Fit& base, const Scored& a, const Scored& b) {
  const auto nodes = map.model().sets.find("nodes");
  if (nodes == map.model().sets.end() || map.measured_modes().empty()) return "";
  double largest = 0.0;
  std::string where;
  const auto shapes_of = [&](const Scored& scored) {
    std::vector<Cause> causes = base.causes;
    causes.push_back({scored.candidate, scored.a});
    return map.node_motion(base.base, causes);
  };
  const auto motion_a = shapes_of(a), motion_b = shapes_of(b);
  for (const auto& [name, values] : motion_a) {
    const auto other = motion_b.find(name);
    if (other == motion_b.end() || other->second.size() != values.size()) continue;
    Eigen::Index mode = 0;
    const double difference = (values - other->second).cwiseAbs().maxCoeff(&mode);
    if (difference > largest) {
      largest = difference;
      const auto space = name.rfind(' ');  // "node:17 z", or "node:17" where it moves in one direction only
      where = fmt::format("the shape of mode {} at {}{}", map.measured_modes()[static_cast<std::size_t>(mode)].label,
                          name.substr(0, space), space == std::string::npos ? "" : " along " + name.substr(space + 1));
    }
  }
  return where.empty() ? "" : fmt::format("{} (differs by {:.1f} % of the largest)", where, 100.0 * largest);
}

}  // namespace

std::string splitting_measurement(const Inference& inference, const Fit& base, const std::vector<const Scored*>& members) {
  if (members.size() < 2) return "";
  const std::string condition = splitting_condition(inference.map(), *members[0]->candidate, *members[1]->candidate);
  return condition.empty() ? splitting_shape(inference.map(), base, *members[0], *members[1]) : condition;
}

}  // namespace twindeck::diagnosis
