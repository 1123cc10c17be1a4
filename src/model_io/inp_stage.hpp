#pragma once

#include "model_io/inp_parts.hpp"
#include "model_io/inp_scopes.hpp"

/// Inside of the library: the static steps before the step with *FREQUENCY, whose loads the modes are asked about.
///
/// The modes are those of the loaded structure if a static step has NLGEOM; in CalculiX also if the step with *FREQUENCY has
/// PERTURBATION. Abaqus takes up the loads only if geometric nonlinearity is accounted for before; its rule holds for a deck
/// that is written for it alone (InpFile::sign_of_abaqus). A load of a later step replaces one of an earlier step at the same
/// place, OP=NEW drops all of its kind; loads of one step add up.
namespace twindeck::model_io {

/// The cards of the stage.
struct InpStage {
  bool asked = false;                  ///< modes about the loaded state are asked for, and something loads it
  bool large = false;                  ///< NLGEOM
  std::vector<InpReading> cards;       ///< of the static steps, in order
  std::vector<InpReading> initial;     ///< *INITIAL CONDITIONS, above the steps
  std::vector<const InpCard*> unused;  ///< loads that do not act on modes
  std::string note;                    ///< which program's rule was taken where both differ, else ""
};

/// @throws InputError  for initial stresses that no step takes up, and for *RESTART, READ: the state is in another run's files
[[nodiscard]] InpStage find_inp_stage(const InpFile& file, const InpPlan& plan);

/// Turns the cards of the stage into loads of the model, whose nodes and elements are final.
/// @throws InputError  for a load that is not carried, by its name
void read_inp_stage(InpParts& parts, const InpStage& stage);

}  // namespace twindeck::model_io
