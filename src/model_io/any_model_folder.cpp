#include "model_io/any_model_folder.hpp"

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "io/toml_value.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/load_cases.hpp"
#include "model_io/matrix_model.hpp"
#include "model_io/model_toml.hpp"
#include "model_io/read_elements.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::model_io {
dynamics::ReadModel read_model_folder(const std::filesystem::path& folder) {
  if (!is_matrix_model(folder)) return dynamics::valid_model(read_model(folder));
  dynamics::ReadModel read;
  read.source = folder.string();
  read.matrices = read_matrix_model(folder);
  return read;
}

void save_model(const dynamics::LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder) {
  if (loaded.model) {
    write_model(fe::with_parameters(*loaded.model, theta), folder);
  } else {
    fe::ParametricSystem system = loaded.system;
    for (std::size_t p = 0; p < system.parameters.size(); ++p)
      fe::set_fitted(system.parameters[p], theta[static_cast<Eigen::Index>(p)]);
    write_matrix_model(system, folder);
  }
  carry_load_cases(loaded.source, folder);
}

fe::Model read_model(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw InputError({folder.string(), 0, ""}, "is no folder",
                     "give the folder of a model: model.toml, nodes.csv, elements.csv, …");
  if (is_matrix_model(folder))
    throw InputError({(folder / "model.toml").string(), line_of(folder / "model.toml", "[matrices]"), "matrices"},
                     "this is a matrix model, which has no elements", "give a model folder with elements.csv to this step");
  fe::Model model;
  model.source = folder.string();
  NameIndex index;
  read_nodes(folder, model, index);
  read_materials(folder, model, index);
  read_sections(folder, model, index);
  read_elements(folder, model, index);
  read_supports(folder, model, index);
  read_springs(folder, model, index);
  read_links(folder, model, index);
  read_constraints(folder, model, index);
  read_masses(folder, model, index);
  read_points(folder, model, index);
  read_model_toml(folder / "model.toml", model);
  return model;
}

bool is_matrix_model(const std::filesystem::path& folder) {
  const auto file = folder / "model.toml";
  if (!std::filesystem::exists(file))
    throw InputError({file.string(), 0, ""}, "is not there, but every model folder has one",
                     "write model.toml with at least a title, or point --model at another folder");
  return std::ranges::any_of(io::read_toml(file), [](const io::TomlEntry& entry) { return entry.key == "matrices"; });
}

long line_of(const std::filesystem::path& file, const std::string& text) {
  std::ifstream stream(file);
  std::string line;
  for (long number = 1; std::getline(stream, line); ++number)
    if (line.find(text) != std::string::npos) return number;
  return 0;
}

}  // namespace twindeck::model_io
