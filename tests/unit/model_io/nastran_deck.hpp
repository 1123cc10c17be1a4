#pragma once

#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "fe/structure.hpp"
#include "model_io/nastran.hpp"
#include "test_folder.hpp"

/// Small decks for the tests of the Nastran reader.
namespace twindeck::model_io::test {

inline const std::string si_units = "[units]\nlength = \"m\"\nforce = \"N\"\n";

/// Reads a deck of the test's own; `units` is the TOML file beside it.
inline ImportedModel import_deck(const TestFolder& folder, const std::string& deck, const std::string& units = si_units) {
  folder.write("deck.bdf", deck);
  folder.write("deck.toml", units);
  return read_nastran(folder.path() / "deck.bdf");
}

/// Frequencies [Hz], rigid motions included.
inline std::vector<double> frequencies(const fe::Model& model, int n_modes) {
  const fe::Structure structure(model);
  const Eigen::VectorXd theta = fe::initial_parameters(model);
  const fe::ParametricSystem system = structure.system(structure.prestress(theta));
  dynamics::ModalSolver solver(system);
  const dynamics::EigenModes modes = solver.solve_available(theta, n_modes);
  EXPECT_TRUE(modes.status.converged) << modes.status.message;
  return {modes.frequency_Hz.begin(), modes.frequency_Hz.end()};
}

}  // namespace twindeck::model_io::test
