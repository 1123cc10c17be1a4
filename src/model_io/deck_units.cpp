#include "model_io/deck_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace twindeck::model_io {
namespace {

constexpr double pound_force_N = 4.4482216152605;  ///< 0.45359237 kg times standard gravity, exact

constexpr std::array<std::pair<const char*, double>, 5> lengths = {
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};
constexpr std::array<std::pair<const char*, double>, 8> forces = {{{"N", 1.0},
                                                                   {"kN", 1e3},
                                                                   {"MN", 1e6},
                                                                   {"lbf", pound_force_N},
                                                                   {"kip", 1e3 * pound_force_N},
                                                                   {"kgf", 9.80665},
                                                                   {"tonf", 9806.65},
                                                                   {"lb", pound_force_N}}};

template <class Table>
double look_up(const Table& table, const std::string& name, const DeckPlace& at, const std::string& mend) {
  std::string known;
  for (const auto& [unit, factor] : table) {
    if (upper_case(name) == upper_case(unit)) return factor;
    known += (known.empty() ? "" : ", ") + std::string(unit);
  }
  at.fail(name.empty() ? "is missing: the deck does not say its units"
                       : fmt::format("'{}' is unknown, expected one of {}", name, known),
          mend);
}

/// Factors of the six displacements of each node: a stiffness or mass between i and j scales by their product.
void scale_matrix(Eigen::MatrixXd& matrix, const std::vector<fe::MatrixElement::Dof>& dofs, double translation, double length) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const int turns =
          (dofs[static_cast<std::size_t>(i)].direction > 2 ? 1 : 0) + (dofs[static_cast<std::size_t>(j)].direction > 2 ? 1 : 0);
      matrix(i, j) *= translation * std::pow(length, turns);
    }
  }
}

}  // namespace

void UnitKeys::add_to(io::FieldTable& table) {
  table.text("units.length", length, "unit of length of the Nastran deck: m, cm, mm, in, ft")
      .text("units.force", force, "unit of force of the Nastran deck: N, kN, MN, lbf, kip, kgf");
}

DeckUnits units_of(const std::string& length, const std::string& force, const std::array<DeckPlace, 2>& at,
                   const std::string& mend) {
  return {look_up(lengths, length, at[0], mend), look_up(forces, force, at[1], mend)};
}

DeckUnits units_of(const UnitKeys& keys, const std::filesystem::path& beside) {
  return units_of(keys.length, keys.force, {{{&beside, 0, "units.length"}, {&beside, 0, "units.force"}}},
                  fmt::format("write [units] with length (m, cm, mm, in, ft) and force (N, kN, MN, lbf, kip, kgf) into {}",
                              beside.filename().string()));
}

void to_si(fe::Model& model, const DeckUnits& units, double wtmass) {
  const double l = units.length_m, f = units.force_N, mass = wtmass * f / l;
  for (fe::Node& node : model.nodes) node.x_m *= l;
  for (fe::Material& m : model.materials) {
    m.youngs_modulus_Pa *= f / (l * l);
    m.shear_modulus_Pa *= f / (l * l);
    m.density_kg_m3 *= mass / (l * l * l);
  }
  const double l2 = l * l, l4 = l2 * l2;
  for (fe::Section& s : model.sections) {
    for (double* area : {&s.area_m2, &s.shear_area_y_m2, &s.shear_area_z_m2}) *area *= l2;
    for (double* moment : {&s.inertia_y_m4, &s.inertia_z_m4, &s.inertia_yz_m4, &s.torsion_m4}) *moment *= l4;
    s.thickness_m *= l;
  }
  for (fe::Element& e : model.elements)
    for (Eigen::Vector3d& offset : e.offset_m) offset *= l;
  for (fe::Spring& s : model.springs) s.stiffness *= s.rotation ? f * l : f / l;
  for (fe::MatrixElement& e : model.matrix_elements) {
    scale_matrix(e.stiffness, e.dofs, f / l, l);
    scale_matrix(e.mass, e.dofs, mass, l);
  }
  // Factors between displacements and rotations carry a length.
  for (fe::Constraint& c : model.constraints)
    for (fe::Constraint::Term& term : c.terms)
      term.factor *= std::pow(l, (term.direction > 2 ? 1 : 0) - (c.direction > 2 ? 1 : 0));
  for (fe::Prestress::Load& load : model.prestress.loads) load.value *= load.movement ? l : load.direction > 2 ? f * l : f;
  for (fe::PointMass& m : model.masses) {
    m.mass_kg *= mass;
    m.inertia_kg_m2 *= mass * l2;
  }
}

}  // namespace twindeck::model_io
