#include "reliability/member_rows.hpp"

#include "aero/wind_model.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/model.hpp"

namespace twindeck::reliability {

using Eigen::Index;

MemberRows stay_forces(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors) {
  const fe::Model& model = *loaded.model;
  const Eigen::MatrixXd full = loaded.system.expand(vectors);
  std::vector<Index> stays;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    if (model.elements[e].type == fe::ElementType::stay) stays.push_back(static_cast<Index>(e));
  const Index n = std::ssize(stays);
  MemberRows out{{}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, vectors.cols())};
  for (Index k = 0; k < n; ++k) {
    const Index e = stays[static_cast<std::size_t>(k)];
    const fe::Element& stay = model.elements[static_cast<std::size_t>(e)];
    const Eigen::Vector3d chord = model.nodes[fe::slot(stay.nodes[1])].x_m - model.nodes[fe::slot(stay.nodes[0])].x_m;
    const double length = chord.norm();
    out.names.push_back(stay.name.empty() ? std::to_string(stay.id) : stay.name);
    out.area_m2[k] = model.sections[fe::slot(stay.section)].area_m2;
    if (loaded.state.stay_pull_N.size() > 0) out.pull_N[k] = loaded.state.stay_pull_N[e];
    const double young = model.materials[fe::slot(stay.material)].youngs_modulus_Pa, pull = out.pull_N[k];
    const double stiffness =
        (pull > 0.0 ? fe::stay_modulus(model, stay, pull).law.modulus(young) : young) * out.area_m2[k] / length;
    out.rows.row(k) = stiffness / length * chord.transpose() *
                      (full.middleRows<3>(6 * stay.nodes[1]) - full.middleRows<3>(6 * stay.nodes[0]));
  }
  return out;
}

MemberRows damper_strokes(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors) {
  MemberRows out;
  const std::vector<const fe::Spring*> dampers = aero::dampers_of(*loaded.model);
  for (const fe::Spring* damper : dampers) out.names.push_back(damper->name);
  out.rows = aero::damper_patterns(loaded, dampers).transpose() * vectors;
  return out;
}

}  // namespace twindeck::reliability
