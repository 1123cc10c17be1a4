#pragma once

#include <string>
#include <vector>

#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s1_model.
struct ModelConfig {
  std::string variant = "preliminary";
  int n_modes = 15;
  std::string displacements = "as_model";
  int load_steps = 1;
  std::vector<std::string> meshes;

  io::FieldTable fields() {
    io::FieldTable table;
    table.text("variant", variant, "variant of the generator: preliminary, refined, … (a model folder has none)")
        .integer("n_modes", n_modes, {1.0, 200.0}, "number of modes, from the lowest")
        .choice("displacements", displacements, {"as_model", "linear", "large"},
                "equilibrium under dead load and pulls: as model.toml says, in the undeformed or in the deformed geometry")
        .integer("load_steps", load_steps, {1.0, 1000.0},
                 "large displacements: dead load and pulls grow in so many equal steps")
        .texts("meshes", meshes, "other meshes of the generator whose modes are compared (mesh_convergence.csv); empty: none");
    return table;
  }
};

}  // namespace twindeck::steps
