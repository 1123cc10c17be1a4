#include "ponte/generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "fe/assembly_parameters.hpp"
#include "fe/validate_parts.hpp"
#include "ponte/bridge_definition.hpp"
#include "ponte/deck.hpp"
#include "ponte/definition_file.hpp"
#include "ponte/mast.hpp"
#include "ponte/model_builder.hpp"
#include "ponte/supports.hpp"

namespace twindeck::ponte {

namespace {

std::string entry(const std::string& list, std::size_t i) { return list + "." + std::to_string(i); }

std::vector<std::string> names_in(DefinitionFile& file, const std::string& list) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < file.size(list); ++i) out.push_back(file.text(entry(list, i) + ".name"));
  return out;
}

std::size_t position(const DefinitionFile& file, const std::string& list, const std::vector<std::string>& names,
                     const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError({file.name(), 0, list}, "has no " + list + " '" + name + "'" + did_you_mean(name, names),
                     "name one of the " + list + "s of this file");
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<Change> read_changes(DefinitionFile& file) {
  std::vector<Change> out;
  for (std::size_t i = 0; i < file.size("change"); ++i) {
    const std::string path = entry("change", i);
    out.push_back({file.text(path + ".name"), file.text(path + ".paper_item"), file.text(path + ".meaning")});
  }
  return out;
}

// The file with every change and variant checked, none applied.
DefinitionFile open(const std::filesystem::path& bridge_toml) {
  DefinitionFile file = DefinitionFile::load(bridge_toml);
  offer_optional_keys(file);
  for (const std::string list : {"change", "variant", "mesh_option"})
    for (std::size_t i = 0; i < file.size(list); ++i) file.check_overrides(entry(list, i) + ".set");
  (void)read_changes(file);
  for (const std::string key : {".name", ".meaning"})
    for (std::size_t i = 0; i < file.size("mesh_option"); ++i) (void)file.text(entry("mesh_option", i) + key);
  for (std::size_t i = 0; i < file.size("variant"); ++i) {
    (void)file.text(entry("variant", i) + ".meaning");
    (void)file.text(entry("variant", i) + ".based_on");
    (void)file.choice(entry("variant", i) + ".changes", {"none", "all"});
  }
  return file;
}

void apply_mesh(DefinitionFile& file, const std::string& mesh) {
  if (mesh.empty()) return;
  file.apply(entry("mesh_option", position(file, "mesh_option", names_in(file, "mesh_option"), mesh)) + ".set");
}

// "change.NAME.KEY" as a path of the file, where changes are numbered and keep their values in a table `set`.
std::string resolved(DefinitionFile& file, const std::string& path) {
  const std::string prefix = "change.";
  if (!path.starts_with(prefix)) return path;
  const std::size_t end = path.find('.', prefix.size());
  const std::string name = path.substr(prefix.size(), end - prefix.size());
  return entry("change", position(file, "change", names_in(file, "change"), name)) + ".set" + path.substr(end);
}

// Overrides of a variant after those of the variant that it is based on.
void apply_variant(DefinitionFile& file, const std::string& variant, std::size_t depth = 0) {
  const std::vector<std::string> names = names_in(file, "variant");
  const std::string path = entry("variant", position(file, "variant", names, variant));
  const std::string base = file.text(path + ".based_on");
  if (depth > names.size())
    file.fail(path + ".based_on", "leads back to the variant itself", "let one variant have based_on = \"\"");
  if (!base.empty()) apply_variant(file, base, depth + 1);
  if (file.text(path + ".changes") == "all")
    for (std::size_t i = 0; i < file.size("change"); ++i) file.apply(entry("change", i) + ".set");
  file.apply(path + ".set");
}

// Initial values as they stand in the model; bounds on either side.
void add_parameters(fe::Model& model, const BridgeDefinition& definition) {
  for (const ParameterDefinition& p : definition.parameters) {
    const std::vector<std::string> known = fe::names_of_target(model, p.target);
    for (const std::string& of : p.of)
      if (!contains(known, of))
        throw InputError({definition.source, 0, "parameter '" + p.name + "' of"},
                         "names '" + of + "', which the model does not have" + did_you_mean(of, known),
                         "name a material, a section or a group of springs or masses, as the target asks");
    model.parameters.push_back({p.name, p.target, p.of, fe::units_of(p.target).front(), 1.0, 0.0, 0.0});
  }
  const Eigen::VectorXd standing = fe::initial_parameters(model);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    fe::Parameter& parameter = model.parameters[i];
    parameter.initial = standing[static_cast<Eigen::Index>(i)];
    parameter.lower = parameter.initial * (1.0 - definition.parameters[i].bound);
    parameter.upper = parameter.initial * (1.0 + definition.parameters[i].bound);
  }
}

void add_prestress(fe::Model& model, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks,
                   const MastNodes& mast) {
  model.prestress.rule = fe::PullRule::shape_finding;
  model.prestress.minimum_pull_N = definition.minimum_pull_N;
  model.prestress.ridge = definition.ridge;
  model.prestress.site_weight = definition.site_weight;
  for (const auto& [name, deck] : decks)
    for (const auto& [stay, bracket] : deck.anchors) model.prestress.conditions.push_back({bracket, 2});
  model.prestress.conditions.push_back({mast.top(), 0});
  model.prestress.conditions.push_back({mast.top(), 1});
  for (fe::Element& element : model.elements) {
    const auto pull = definition.site_pull_N.find(element.name);
    if (element.type == fe::ElementType::stay && pull != definition.site_pull_N.end()) element.pull_N = pull->second;
  }
}

// Nodes on the decks' axes where wind acts: the middles of equal lengths between the end stays, aero_foot_01 … from south to
// north, each on the nearest row of slab nodes.
void add_aerodynamic_nodes(fe::Model& model, const BridgeDefinition& definition,
                           const std::map<std::string, DeckNodes>& decks) {
  for (const DeckDefinition& deck : definition.decks) {
    const double last = stay_positions(deck.stay).back();
    for (int i = 0; i < definition.aerodynamic_nodes; ++i) {
      const double s = last * ((2.0 * i + 1.0) / definition.aerodynamic_nodes - 1.0);
      const DeckNodes::Line& line = decks.at(deck.name).line_near(s);
      model.monitoring_points[fmt::format("aero_{}_{:02d}", deck.name, i + 1)] = line.across[line.across.size() / 2];
    }
  }
}

fe::Model build(const BridgeDefinition& definition, const std::string& title) {
  ModelBuilder builder;
  builder.model.title = definition.title + ", " + title;
  builder.model.gravity_m_s2 = definition.gravity_m_s2;
  builder.model.source = definition.source;
  for (const fe::Material& material : definition.materials) builder.add_material(material);
  std::map<std::string, DeckNodes> decks;
  for (const DeckDefinition& deck : definition.decks) decks[deck.name] = build_deck(builder, deck, definition.mesh);
  const EndNodes ends = build_ends(builder, definition);
  for (const DeckDefinition& deck : definition.decks) build_deck_supports(builder, deck, decks[deck.name], ends);
  const MastNodes mast = build_mast(builder, definition);
  build_stays(builder, definition, decks, mast);
  build_dampers(builder, definition, decks);
  for (const DeckPoint& point : definition.monitoring_points) {
    const DeckNodes::Line& line = decks.at(point.deck).line_near(point.s_m);  // sensors stand between posts too
    builder.model.monitoring_points[point.name] = point.outer_edge ? line.across.back() : line.across.front();
  }
  add_aerodynamic_nodes(builder.model, definition, decks);
  add_prestress(builder.model, definition, decks, mast);
  add_parameters(builder.model, definition);
  return builder.model;
}

}  // namespace

std::string part_of(const std::string& group) {
  static const std::vector<std::pair<std::string, std::string>> parts = {
      {"foot_north", "bearings"}, {"foot_south", "bearings"}, {"cycle_north", "bearings"}, {"cycle_south", "bearings"},
      {"damper", "dampers"},      {"foot", "decks"},          {"cycle", "decks"},          {"slab", "decks"},
      {"mast", "mast"},           {"stay", "stays"},          {"end_block", "end_blocks"}, {"rigid_connection", "end_blocks"},
      {"ramp", "ramps"},          {"pier", "piers"}};  // the first that fits
  const auto found = std::ranges::find_if(parts, [&](const auto& part) { return group.starts_with(part.first); });
  return found == parts.end() ? "other" : found->second;
}

std::vector<Change> as_built_changes(const std::filesystem::path& bridge_toml) {
  DefinitionFile file = open(bridge_toml);
  return read_changes(file);
}

fe::Model generate(const std::filesystem::path& bridge_toml, const std::string& variant, const std::string& mesh) {
  return generate_with_values(bridge_toml, variant, mesh, {});
}

fe::Model generate_with_changes(const std::filesystem::path& bridge_toml, const std::vector<std::string>& changes,
                                const std::string& mesh) {
  DefinitionFile file = open(bridge_toml);
  apply_mesh(file, mesh);
  const std::vector<std::string> names = names_in(file, "change");
  std::string title = "preliminary";
  apply_variant(file, "preliminary");
  for (const std::string& change : changes) {
    file.apply(entry("change", position(file, "change", names, change)) + ".set");
    title += " + " + change;
  }
  return build(read_definition(std::move(file)), title);
}

fe::Model generate_with_values(const std::filesystem::path& bridge_toml, const std::string& variant, const std::string& mesh,
                               const Values& values) {
  DefinitionFile file = open(bridge_toml);
  for (const auto& [path, value] : values) file.set_number(resolved(file, path), value);
  apply_mesh(file, mesh);
  apply_variant(file, variant);
  return build(read_definition(std::move(file)), variant);
}

void write_values(const std::filesystem::path& bridge_toml, const Values& values,
                  const std::map<std::string, std::string>& unit) {
  DefinitionFile file = open(bridge_toml);
  std::ifstream in(bridge_toml);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (const auto& [path, value] : values) {
    const long at = file.line_of(resolved(file, path));
    if (at == 0) file.fail(path, "is not in this file", "name a key by its dotted path");
    std::string& line = lines[static_cast<std::size_t>(at - 1)];
    const std::size_t equals = line.find('='), comment = line.find('#', equals);
    const std::string& its_unit = unit.at(path);
    const std::string text = its_unit == "-" ? fmt::format("{:.8g}", value) : fmt::format("\"{:.8g} {}\"", value, its_unit);
    line = line.substr(0, equals + 1) + " " + text + (comment == std::string::npos ? "" : "  " + line.substr(comment));
  }
  std::ofstream out(bridge_toml);
  for (const std::string& line : lines) out << line << '\n';
  if (!out) throw InputError({bridge_toml.string(), 0, ""}, "cannot be written", "check its permissions");
}

}  // namespace twindeck::ponte
