#include "model_io/read_model.hpp"

#include <fstream>

#include "core/error.hpp"
#include "io/toml_value.hpp"
#include "model_io/folder_parts.hpp"
#include "model_io/matrix_model.hpp"
#include "model_io/model_toml.hpp"
#include "model_io/read_attachments.hpp"
#include "model_io/read_elements.hpp"

namespace twindeck::model_io {
namespace {

/// Null where the table has no such key.
const io::TomlValue* find(const io::TomlValue::Table& table, const std::string& key) {
  for (const io::TomlEntry& entry : table) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

}  // namespace

fe::Model read_model(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError({folder.string(), 0, ""}, "is no folder",
                     "give the folder of a model: model.toml, nodes.csv, elements.csv, …");
  }
  if (is_matrix_model(folder)) {
    throw InputError({(folder / "model.toml").string(), line_of(folder / "model.toml", "[matrices]"), "matrices"},
                     "this is a matrix model, which has no elements", "give a model folder with elements.csv to this step");
  }
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
  if (!std::filesystem::exists(file)) {
    throw InputError({file.string(), 0, ""}, "is not there, but every model folder has one",
                     "write model.toml with at least a title, or point --model at another folder");
  }
  return find(io::read_toml(file), "matrices") != nullptr;
}

long line_of(const std::filesystem::path& file, const std::string& text) {
  std::ifstream stream(file);
  std::string line;
  for (long number = 1; std::getline(stream, line); ++number) {
    if (line.find(text) != std::string::npos) return number;
  }
  return 0;
}

}  // namespace twindeck::model_io
