#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "modal/modes.hpp"
#include "steps/shared/model_source.hpp"

/// Files that a step writes about a model and its modes, in addition to those of model_io.
namespace twindeck::steps {

/// Modes of a model as the steps publish them: translations x y z at every node of an FE model (rotations are left out: no
/// sensor measures them and they double the file), every degree of freedom of a matrix model.
/// @param model  null for a matrix model
[[nodiscard]] modal::ModeSet published_modes(const fe::Model* model, const fe::ParametricSystem& system,
                                             const dynamics::EigenModes& modes);

/// stays.csv: `stay,group,length_m,pull_N,site_pull_N,stress_Pa,equivalent_modulus_Pa`. Length between the nodes; cable force
/// of the prestress state; site value if the model gives one (Element::pull_N > 0); stress T/A; Ernst's tangent modulus at that
/// stress.
/// @param model  null for a matrix model: header only
void write_stays(const fe::Model* model, const fe::PrestressState& state, const std::filesystem::path& folder);

/// member_forces.csv: `element,group,x_m,y_m,z_m,length_m,axial_force_N` of every beam and bar under dead load and cable
/// forces: middle and length between the ends (nodes and offsets), axial force, tension positive.
/// @param model  null for a matrix model: header only
void write_member_forces(const fe::Model* model, const fe::PrestressState& state, const std::filesystem::path& folder);

/// dampers.csv: `damper,group,damping_N_s_m,stiffness_N_m,arrangement` of the springs whose group begins with "damper";
/// arrangement viscous (no spring), parallel (Kelvin) or series (Maxwell).
void write_dampers(const fe::Model* model, const std::filesystem::path& folder);

/// The part of a structure that a group of elements or springs belongs to.
using PartOf = std::function<std::string(const std::string& group)>;

/// summary.csv: `quantity,value,unit`: degrees of freedom, nodes, elements of each type, springs, links, masses, parameters;
/// and, where parts are known, nodes, elements of each type and springs of each part ("shells_decks").
/// @param part_of  empty: parts are not known
void write_summary(const fe::Model* model, const fe::ParametricSystem& system, const PartOf& part_of,
                   const std::filesystem::path& folder);

/// model.inp for CalculiX, model_abaqus.inp for Abaqus, with a message about what such a file cannot hold.
/// @throws InputError  for a matrix model, which has no elements
void export_inp(const dynamics::LoadedModel& loaded, int n_modes, const StepContext& context);

}  // namespace twindeck::steps
