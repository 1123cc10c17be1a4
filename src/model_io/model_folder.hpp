#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::model_io {

/// Reads a model folder (docs/my_model.md): model.toml, nodes.csv, elements.csv, materials.csv, sections.csv and, where they
/// are there, supports.csv, springs.csv, links.csv, masses.csv, points.csv. Columns are those that `write_model` writes; those
/// with an obvious default may be left out. An empty shear modulus follows from E and nu.
/// @throws InputError with file, line, column for anything that is not as it should be
[[nodiscard]] fe::Model read_model(const std::filesystem::path& folder);
/// Writes a model folder that `read_model` returns unchanged to the 12 significant digits of the files: whatever has been read
/// once is written again byte for byte.
void write_model(const fe::Model& model, const std::filesystem::path& folder);

/// Meaning, unit, range and default of each key of a model folder's model.toml.
[[nodiscard]] std::string describe_model_toml();

/// True if the folder is a matrix model (model.toml has [matrices]).
[[nodiscard]] bool is_matrix_model(const std::filesystem::path& folder);
/// Reads a matrix model: dofs.csv, model.toml, *.mtx. K(theta) = K0 + sum theta_i K_i and M(theta) likewise, all on the union
/// of the patterns (with a full diagonal). M may be singular. Coordinates may be missing (NaN in DofLabel::x_m). Beyond the
/// contract a parameter may give `unit` and `group` (in Parameter::of; its own name if missing), and one name may stand twice,
/// once for the stiffness and once for the mass, with the same values.
/// @throws InputError with file and line for matrices that do not fit dofs.csv or are not symmetric, doubled names, bad bounds
[[nodiscard]] fe::ParametricSystem read_matrix_model(const std::filesystem::path& folder);
/// Writes the same, K and M decomposed at the initial parameters: exact to the last bits where every coefficient is linear in
/// one parameter (always so for what was read), the tangent K0 = K - sum theta_i dK/dtheta_i, K_i = dK/dtheta_i elsewhere.
void write_matrix_model(const fe::ParametricSystem& system, const std::filesystem::path& folder);

/// The files of a model folder that exist, for the manifest's inputs.
[[nodiscard]] std::vector<std::filesystem::path> model_files(const std::filesystem::path& folder);

}  // namespace twindeck::model_io
