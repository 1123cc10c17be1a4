#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/model.hpp"

/// Exchange with CalculiX and Abaqus: models as `.inp` files.
namespace twindeck::model_io {

/// A model out of a file of another program.
struct ImportedModel {
  fe::Model model;                           ///< SI
  std::vector<std::string> notes;            ///< what does not enter the model, or was interpreted, a sentence each, for people
  std::vector<std::filesystem::path> files;  ///< the file and those that it includes
};

/// Reads an .inp file, in the flavour of CalculiX or Abaqus (parts with any number of instances): nodes, beams (B31 B32 B33,
/// profiles RECT CIRC PIPE BOX I and general sections), T3D2, S4, S3, springs, dashpots, masses, isotropic materials, supports,
/// sets, rigid links (*MPC BEAM and TIE, *RIGID BODY, *EQUATION that amounts to one), constraints (other equations, *MPC PIN,
/// *TIE). A B32 becomes two beams. The set that a section is given to becomes the group and the section's name; a set of one
/// node becomes a monitoring point. What the format does not know (title, gravity, parameters to update, where pulls come from)
/// is read from the TOML file of the same stem beside it, if there is one ("frame.toml" beside "frame.inp"; its keys are those
/// of model.toml).
/// @throws InputError that names file, line and card: an unsupported card, parameter or element type first of all
[[nodiscard]] ImportedModel read_inp(const std::filesystem::path& file);

enum class InpFlavour {
  calculix,  ///< beams as B32R, pipes or rectangles in a material of their own (inp_expanded_beam.hpp)
  abaqus     ///< beams as B33 or B31 with *BEAM GENERAL SECTION: nothing of them lost
};

/// Writes the model with a *FREQUENCY step of `n_modes`. Stays become trusses with the tangent modulus of their pull (Ernst).
/// @param state  pulls of the stays; empty vectors mean none
/// @return what the file does not carry, a sentence each (geometric stiffness, bending inertia ratios, friction …)
/// @throws InputError  for what the file cannot say and leaving out would change the structure: end releases, tapered beams,
///         elements given by matrices, lumped masses
std::vector<std::string> write_inp(const fe::Model& model, const fe::PrestressState& state, InpFlavour flavour, int n_modes,
                                   const std::filesystem::path& file);

}  // namespace twindeck::model_io
