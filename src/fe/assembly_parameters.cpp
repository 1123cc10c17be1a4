#include "fe/assembly_parameters.hpp"

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::fe {

namespace {

bool names(const Parameter& parameter, const std::string& name) { return contains(parameter.of, name); }

/// That of the first part which the parameter names.
template <typename Part>
double value_of(const std::vector<Part>& parts, const Parameter& parameter, double Part::*value) {
  for (const Part& part : parts)
    if (names(parameter, part.name)) return part.*value;
  return parameter.initial;
}

/// The value of the first thing that a parameter names; the other things keep their ratio to it. Factors of groups stand for
/// themselves.
double standing_value(const Model& model, const Parameter& parameter) {
  const Target target = parameter.target;
  if (target == Target::youngs_modulus) return value_of(model.materials, parameter, &Material::youngs_modulus_Pa);
  if (target == Target::density) return value_of(model.materials, parameter, &Material::density_kg_m3);
  if (target == Target::thickness) return value_of(model.sections, parameter, &Section::thickness_m);
  if (target == Target::bending_inertia_ratio) return value_of(model.sections, parameter, &Section::bending_inertia_ratio);
  if (target == Target::area) return value_of(model.sections, parameter, &Section::area_m2);
  return parameter.initial;
}

void scale(Model& model, const Parameter& parameter, double ratio) {
  for (Material& material : model.materials) {
    if (!names(parameter, material.name)) continue;
    if (parameter.target == Target::youngs_modulus) {
      material.youngs_modulus_Pa *= ratio;
      material.shear_modulus_Pa *= ratio;
    } else if (parameter.target == Target::density) {
      material.density_kg_m3 *= ratio;
    }
  }
  for (Section& section : model.sections) {
    if (!names(parameter, section.name)) continue;
    if (parameter.target == Target::thickness) section.thickness_m *= ratio;
    if (parameter.target == Target::bending_inertia_ratio) section.bending_inertia_ratio *= ratio;
    if (parameter.target == Target::area) section.area_m2 *= ratio;
  }
  if (parameter.target == Target::spring_stiffness)
    for (Spring& spring : model.springs)
      if (names(parameter, spring.group)) spring.stiffness *= ratio;
  if (parameter.target == Target::point_mass)
    for (PointMass& mass : model.masses)
      if (names(parameter, mass.group)) {
        mass.mass_kg *= ratio;
        mass.inertia_kg_m2 *= ratio;
      }
}

}  // namespace

Eigen::VectorXd initial_parameters(const Model& model) {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(model.parameters.size()));
  for (std::size_t p = 0; p < model.parameters.size(); ++p)
    theta[static_cast<Eigen::Index>(p)] = standing_value(model, model.parameters[p]);
  return theta;
}

void set_fitted(Parameter& parameter, double value) {
  if (value != parameter.initial) parameter.nominal = parameter.expected();
  parameter.initial = value;
}

Model with_parameters(const Model& model, const Eigen::VectorXd& theta) {
  const Eigen::VectorXd standing = initial_parameters(model);
  TWINDECK_ASSERT(theta.size() == standing.size());
  Model changed = model;
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(p);
    if (theta[row] == standing[row]) continue;
    scale(changed, model.parameters[p], theta[row] / standing[row]);
    set_fitted(changed.parameters[p], theta[row]);
  }
  return changed;
}

}  // namespace twindeck::fe
