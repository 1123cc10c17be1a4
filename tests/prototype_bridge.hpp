#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "io/csv.hpp"
#include "ponte/generator.hpp"
#include "test_places.hpp"

/// An earlier reconstruction of the bridge, and the bridge as a prototype has it that was written independently.
namespace twindeck::tests {

inline std::filesystem::path prototype_folder() {
  return std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/data/ponte_prototype";
}

inline std::filesystem::path prototype_toml() { return prototype_folder() / "prototype.toml"; }

/// With the prototype's formulation: Euler beams, its drilling and mass rules, and the pulls that its frequencies belong to.
inline fe::Model prototype_bridge(const std::string& variant) {
  const auto table = io::CsvTable::read(prototype_folder() / "pulls.csv", {"variant", "stay", "pull_kN"});
  std::map<std::string, double> pull_N;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, "variant") == variant) pull_N[table.text(row, "stay")] = 1e3 * table.number(row, "pull_kN");
  fe::Model model = ponte::generate(prototype_toml(), variant);
  model.prestress.rule = fe::PullRule::given;
  model.formulation.shear_flexible = false;
  model.formulation.beam_rotary_inertia = false;
  model.formulation.shell_rotary_inertia = false;
  model.formulation.drilling = fe::Formulation::Drilling::diagonal;
  for (fe::Element& element : model.elements)
    if (element.type == fe::ElementType::stay) element.pull_N = pull_N.at(element.name);
  return model;
}

}  // namespace twindeck::tests
