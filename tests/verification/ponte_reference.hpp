#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "io/csv.hpp"
#include "test_places.hpp"

/// What a prototype of the bridge, written independently in another language with its own elements, returned for each variant.
namespace twindeck::reference {

/// Frequencies by variant [Hz], printed to 0.1 mHz.
inline std::map<std::string, std::vector<double>> frequencies() {
  const auto table =
      io::CsvTable::read(std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/verification/ponte_reference_frequencies.csv",
                         {"variant", "mode", "frequency_Hz"});
  std::map<std::string, std::vector<double>> out;
  for (std::size_t row = 0; row < table.rows(); ++row)
    out[table.text(row, "variant")].push_back(table.number(row, "frequency_Hz"));
  return out;
}

struct Solved {
  Eigen::Index dofs;
  Eigen::VectorXd frequency_Hz;
};

inline Solved solve(const fe::Model& model, int n_modes) {
  const fe::PrestressState state = fe::find_prestress(model, fe::initial_parameters(model));
  EXPECT_TRUE(state.status.converged) << state.status.message;
  const fe::ParametricSystem system = fe::assemble(model, state);
  dynamics::ModalSolver solver(system);
  const dynamics::EigenModes modes = solver.solve(system.initial(), n_modes);
  EXPECT_TRUE(modes.status.converged) << modes.status.message;
  return {system.size(), modes.frequency_Hz};
}

}  // namespace twindeck::reference
