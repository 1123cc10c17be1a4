#include "model_io/inp_writer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/atomic.hpp"
#include "io/csv.hpp"
#include "model_io/deck_card.hpp"

namespace twindeck::model_io {

using io::format_number;

namespace {

/// CalculiX takes a number of *SPRING for a degree of freedom unless it has a decimal point.
std::string with_point(double value) {
  std::string text = format_number(value);
  if (text.find('.') != std::string::npos) return text;
  const auto exponent = text.find('e');
  return text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
}

/// What no card that we write can say and leaving out would make another structure.
void refuse_what_cannot_be_said(const fe::Model& model) {
  const auto refuse = [&](const std::string& what, const std::string& problem, const std::string& mend) {
    throw InputError({model.source, 0, what}, problem, mend);
  };
  for (const fe::Element& element : model.elements)
    if (element.section2 >= 0)
      refuse(fmt::format("element {}", element.id), "is a tapered beam, for which an .inp file of ours has no section",
             "divide it into uniform beams, or use --export-matrices");
  if (!model.matrix_elements.empty())
    refuse(fmt::format("matrix element '{}'", model.matrix_elements.front().name),
           "is given by its matrices, which an .inp file cannot hold", "leave it out, or use --export-matrices");
  if (model.formulation.lumped_mass)
    refuse("formulation.lumped_mass", "is true, but the elements of an .inp file have consistent masses",
           "set it to false, or use --export-matrices");
}

}  // namespace

InpWriter::InpWriter(const fe::Model& model, const fe::PrestressState& state, InpFlavour flavour)
    : model_(model), state_(state), flavour_(flavour) {
  for (const fe::Node& node : model.nodes) {
    if (node.id < 1 || node.id > 900'000'000)
      throw InputError({model.source, 0, "node"},
                       fmt::format("node {} cannot be exported, expected numbers from 1 to 900000000", node.id),
                       "number the nodes anew");
    last_node_ = std::max(last_node_, node.id);
    nodes_ += fmt::format("{}, {}, {}, {}\n", node.id, format_number(node.x_m.x()), format_number(node.x_m.y()),
                          format_number(node.x_m.z()));
  }
  for (const fe::Element& element : model.elements) last_element_ = std::max(last_element_, element.id);
}

void InpWriter::heading() {
  heading_ =
      fmt::format("*HEADING\n{}\n** SI units; written by twindeck for {}\n", model_.title.empty() ? "model" : model_.title,
                  flavour_ == InpFlavour::calculix ? "CalculiX" : "Abaqus");
  // One node a set: read back as monitoring points.
  for (const auto& [name, node] : model_.monitoring_points)
    supports_ += fmt::format("*NSET, NSET={}\n{}\n", set_name(name), node_id(node));
}

long InpWriter::add_node(const Eigen::Vector3d& x) {
  nodes_ += fmt::format("{}, {}, {}, {}\n", ++last_node_, format_number(x.x()), format_number(x.y()), format_number(x.z()));
  return last_node_;
}

std::string InpWriter::unique(const std::string& wish, std::map<std::string, int>& used, std::size_t longest) {
  std::string name;
  for (const char c : wish) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name.front())) == 0) name = "S" + name;
  name = name.substr(0, longest);
  if (used.emplace(upper_case(name), 1).second) return name;
  for (;;) {
    const std::string ending = fmt::format("_{}", ++used[upper_case(name)]);
    const std::string numbered = name.substr(0, longest - ending.size()) + ending;
    if (used.emplace(upper_case(numbered), 1).second) return numbered;
  }
}

std::string InpWriter::material(const std::string& wish, double youngs_modulus, double poisson_ratio, double density) {
  return named_material(wish, fmt::format("*ELASTIC\n{}, {}\n*DENSITY\n{}\n", format_number(youngs_modulus),
                                          format_number(poisson_ratio), format_number(density)));
}

std::string InpWriter::beam_material(const std::string& wish, const ExpandedBeam& beam) {
  const std::string e = format_number(beam.youngs_modulus_Pa), g12 = format_number(beam.shear_modulus_y_Pa),
                    g13 = format_number(beam.shear_modulus_z_Pa);
  // G23 shears the section in its own plane, which the plates at its ends prevent: any modulus does.
  return named_material(
      wish, fmt::format("*ELASTIC, TYPE=ENGINEERING CONSTANTS\n{0}, {0}, {0}, 0., 0., 0., {1}, {2}\n{1}\n*DENSITY\n{3}\n", e,
                        g12, g13, format_number(beam.density_kg_m3)));
}

std::string InpWriter::named_material(const std::string& wish, const std::string& data) {
  const auto [place, fresh] = material_names_.emplace(wish + "\n" + data, "");
  if (fresh) {
    place->second = unique(wish, used_materials_);
    materials_ += fmt::format("*MATERIAL, NAME={}\n{}", place->second, data);
  }
  return place->second;
}

std::string InpWriter::element_block(const std::string& type, const std::string& group,
                                     const std::vector<std::pair<long, std::vector<long>>>& rows) {
  const auto [place, fresh] = group_sets_.emplace(group, "");
  if (fresh) place->second = set_name(group);
  elements_ += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", type, place->second);
  for (const auto& [id, nodes] : rows) {
    elements_ += std::to_string(id);
    constexpr std::size_t a_line = 16;  // fields that both programs take; a comma at the end goes on
    for (std::size_t i = 0; i < nodes.size(); ++i)
      elements_ += fmt::format("{}{}", (i + 1) % a_line == 0 ? ",\n" : ", ", nodes[i]);
    elements_ += '\n';
  }
  const std::string set = set_name("part");
  elements_ += fmt::format("*ELSET, ELSET={}\n", set);
  for (const auto& [id, nodes] : rows) elements_ += fmt::format("{}\n", id);
  return set;
}

void InpWriter::note(const std::string& sentence) {
  if (!contains(notes_, sentence)) notes_.push_back(sentence);
}

void InpWriter::rigid_equations(long master, const Eigen::Vector3d& master_x, long slave, const Eigen::Vector3d& slave_x,
                                bool rotations) {
  const Eigen::Vector3d r = slave_x - master_x;
  for (int i = 0; i < (rotations ? 6 : 3); ++i) {
    std::string terms = fmt::format("{}, {}, -1.\n{}, {}, 1.\n", slave, i + 1, master, i + 1);
    int count = 2;
    for (int j = 0; j < 3 && i < 3; ++j) {
      const double factor = Eigen::Vector3d::Unit(j).cross(r)[i];
      if (factor == 0.0) continue;
      terms += fmt::format("{}, {}, {}\n", master, j + 4, format_number(factor));
      ++count;
    }
    equations_ += fmt::format("*EQUATION\n{}\n{}", count, terms);
  }
}

void InpWriter::links_and_supports() {
  for (const fe::RigidLink& link : model_.links) {
    const fe::Node &master = model_.nodes[fe::slot(link.master)], &slave = model_.nodes[fe::slot(link.slave)];
    const bool turns = std::ranges::any_of(model_.elements, [&](const fe::Element& e) {
      const bool holds = e.type == fe::ElementType::beam || e.type == fe::ElementType::shell;
      return holds && contains(e.nodes, link.slave);
    });
    rigid_equations(master.id, master.x_m, slave.id, slave.x_m, turns);
  }
  for (const fe::Constraint& c : model_.constraints) {
    equations_ += fmt::format("*EQUATION\n{}\n{}, {}, -1.\n", c.terms.size() + 1, node_id(c.node), c.direction + 1);
    for (const fe::Constraint::Term& term : c.terms)
      equations_ += fmt::format("{}, {}, {}\n", node_id(term.node), term.direction + 1, with_point(term.factor));
  }
  if (model_.supports.empty()) return;
  supports_ += "*BOUNDARY\n";
  for (const fe::Support& support : model_.supports)
    for (std::size_t i = 0; i < 6; ++i)
      if (support.fixed[i]) supports_ += fmt::format("{0}, {1}, {1}\n", node_id(support.node), i + 1);
}

void InpWriter::point_mass(const std::string& group, int node, double mass_kg) {
  const std::string set = element_block("MASS", group.empty() ? "masses" : group, {{next_element(), {node_id(node)}}});
  elements_ += fmt::format("*MASS, ELSET={}\n{}\n", set, format_number(mass_kg));
}

void InpWriter::springs_and_masses() {
  const auto direction_axes = [this](const Eigen::Vector3d& d) {
    // x' of the local system is the spring's direction
    const Eigen::Vector3d other = std::abs(d.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d b = other.cross(d).normalized();
    const std::string name = set_name("O_spring");
    elements_ += fmt::format("*ORIENTATION, NAME={}, SYSTEM=RECTANGULAR\n{}, {}, {}, {}, {}, {}\n", name, format_number(d.x()),
                             format_number(d.y()), format_number(d.z()), format_number(b.x()), format_number(b.y()),
                             format_number(b.z()));
    return name;
  };
  for (const fe::Spring& spring : model_.springs) {
    if (!spring.active || spring.series) {
      note("springs that are inactive or in series with a dashpot are left out, as they are in the stiffness matrix");
      continue;
    }
    if (spring.friction_N > 0.0) note("friction of springs is left out");
    if (spring.damping > 0.0) note("dashpots are left out: they do not enter a frequency step");
    if (spring.stiffness <= 0.0) continue;
    int axis = -1;
    for (int i = 0; i < 3; ++i)
      if (std::abs(std::abs(spring.direction[i]) - 1.0) < 1e-9) axis = i;
    const std::string orientation = axis < 0 ? ", ORIENTATION=" + direction_axes(spring.direction) : "";
    const int dof = std::max(axis, 0) + (spring.rotation ? 4 : 1);
    std::vector<long> nodes = {node_id(spring.node)};
    if (spring.node2 >= 0) nodes.push_back(node_id(spring.node2));
    const std::string set = element_block(spring.node2 < 0 ? "SPRING1" : "SPRING2",
                                          spring.group.empty() ? "springs" : spring.group, {{next_element(), nodes}});
    elements_ +=
        fmt::format("*SPRING, ELSET={}{}\n{}\n{}\n", set, orientation,
                    spring.node2 < 0 ? std::to_string(dof) : fmt::format("{0}, {0}", dof), with_point(spring.stiffness));
  }
  for (const fe::PointMass& mass : model_.masses) {
    if (mass.mass_kg > 0.0) point_mass(mass.group, mass.node, mass.mass_kg);
    if (mass.inertia_kg_m2.maxCoeff() <= 0.0) continue;
    if (flavour_ == InpFlavour::calculix) {
      note("rotary inertia of point masses is left out: CalculiX has no such element");
      continue;
    }
    const std::string set =
        element_block("ROTARYI", mass.group.empty() ? "masses" : mass.group, {{next_element(), {node_id(mass.node)}}});
    elements_ += fmt::format("*ROTARY INERTIA, ELSET={}\n{}, {}, {}\n", set, format_number(mass.inertia_kg_m2.x()),
                             format_number(mass.inertia_kg_m2.y()), format_number(mass.inertia_kg_m2.z()));
  }
}

void InpWriter::frequency_step(int n_modes) {
  step_ = fmt::format("*STEP\n*FREQUENCY\n{}\n*NODE FILE\nU\n*END STEP\n", n_modes);
}

std::string InpWriter::text() const {
  std::string comments;
  for (const auto& sentence : notes_) comments += "** " + sentence + "\n";
  return heading_ + comments + "*NODE, NSET=NALL\n" + nodes_ + materials_ + elements_ + equations_ + supports_ + step_;
}

std::vector<std::string> write_inp(const fe::Model& model, const fe::PrestressState& state, InpFlavour flavour, int n_modes,
                                   const std::filesystem::path& file) {
  refuse_what_cannot_be_said(model);
  InpWriter writer(model, state, flavour);
  writer.heading();
  writer.members();
  writer.faces_and_blocks();
  writer.springs_and_masses();
  writer.links_and_supports();
  writer.frequency_step(n_modes);
  io::write_file_atomically(file, writer.text());
  return writer.notes();
}

}  // namespace twindeck::model_io
