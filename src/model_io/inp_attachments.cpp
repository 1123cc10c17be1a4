#include "model_io/inp_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model_io/spread_mass.hpp"

namespace twindeck::model_io {
namespace {

/// Values of the card's data lines, without the empty line that stands for "no degree of freedom" with SPRINGA.
std::vector<const InpLine*> filled_lines(const InpCard& card) {
  std::vector<const InpLine*> lines;
  for (const InpLine& line : card.data)
    if (std::ranges::any_of(line.fields, [](const std::string& f) { return !f.empty(); })) lines.push_back(&line);
  return lines;
}

/// "ENCASTRE" … as fixed degrees of freedom; false for another word.
bool named_support(const std::string& word, Directions& fixed) {
  static const std::map<std::string, Directions> known = {
      {"ENCASTRE", {true, true, true, true, true, true}},  {"PINNED", {true, true, true, false, false, false}},
      {"XSYMM", {true, false, false, false, true, true}},  {"YSYMM", {false, true, false, true, false, true}},
      {"ZSYMM", {false, false, true, true, true, false}},  {"XASYMM", {false, true, true, true, false, false}},
      {"YASYMM", {true, false, true, false, true, false}}, {"ZASYMM", {true, true, false, false, false, true}}};
  const auto found = known.find(upper_case(word));
  if (found == known.end()) return false;
  fixed = found->second;
  return true;
}

bool names_no_set(const InpCard& card) { return (card.keyword == "SPRING" || card.keyword == "DASHPOT") && !card.has("ELSET"); }

/// Whether a *SPRING or *DASHPOT belongs to the *JOINT above it.
bool is_of_joint(const InpFile& file, const InpCard& card) {
  const InpCard* at = &card;
  while (at != file.cards().data() && names_no_set(*at)) --at;
  return at != &card && at->keyword == "JOINT";
}

double not_negative(const InpLine& line, std::size_t i) {
  const double value = line.number(i);
  if (value < 0.0) line.fail("the constant must not be negative", "check the sign");
  return value;
}

/// Axes of the nodes of a spring without *ORIENTATION.
InpOrientation axes_of_nodes(const InpParts& parts, const DeckPlace& at, const InpElement& element) {
  const InpOrientation axes = parts.axes_of(at, element.nodes.front());
  if (!axes.isApprox(parts.axes_of(at, element.nodes.back()), 1e-9))
    at.fail(fmt::format("element {} joins nodes whose axes *TRANSFORM turns differently", element.id),
            "give the spring an ORIENTATION");
  return axes;
}

/// A spring or dashpot of an element along one of the axes.
void add_spring(InpParts& parts, const InpCard& card, const InpElement& element, const std::string& name, int dof,
                const InpOrientation& axes, double value, bool dashpot) {
  const int node2 = element.nodes.size() > 1 ? parts.node(*element.at, element.nodes[1]) : -1;
  parts.add_spring(name, parts.group_of(card, element), parts.node(*element.at, element.nodes[0]), node2, dof, axes,
                   dashpot ? 0.0 : value, dashpot ? value : 0.0);
}

}  // namespace

InpOrientation inp_axes_of(const InpParts& parts, const InpCard& card) {
  if (!card.has("ORIENTATION")) return InpOrientation::Identity();
  const auto found = parts.orientations.find(parts.find_key(parts.orientations, card.get("ORIENTATION")));
  if (found == parts.orientations.end())
    card.fail(fmt::format("orientation '{}' is not defined", card.get("ORIENTATION")), "define it by *ORIENTATION");
  return found->second;
}

void attach_inp_spring(InpParts& parts, const InpCard& card) {
  if (is_of_joint(parts.file, card)) return;  // read with the joint above it
  card.allow({"ELSET", "ORIENTATION"});
  const bool dashpot = card.keyword == "DASHPOT";
  (void)card.required("ELSET");
  const InpOrientation axes = inp_axes_of(parts, card);
  const auto lines = filled_lines(card);
  for (const InpElement* element : parts.elements_of(card, dashpot ? InpKind::dashpot : InpKind::spring)) {
    const bool axial = element->type.back() == 'A';
    const std::size_t value_line = axial ? 0 : 1;
    if (lines.size() <= value_line)
      card.fail("a data line is missing", axial ? "give the constant" : "give the degree of freedom, then the constant");
    if (lines.size() > value_line + 1)
      lines[value_line + 1]->fail("has more data lines: values that depend on something are not supported",
                                  "give one constant");
    const std::string name = fmt::format("{}_{}", parts.group_of(card, *element), element->id);
    int dof = 0;
    InpOrientation along = axes;
    if (axial) {
      const Eigen::Vector3d line =
          parts.place(parts.node(*element->at, element->nodes[1])) - parts.place(parts.node(*element->at, element->nodes[0]));
      if (line.norm() < 1e-12)
        element->at->fail(fmt::format("{} {} has no length, so no direction", element->type, element->id),
                          "use SPRING2 with a degree of freedom");
      along.row(0) = line.normalized();
    } else {
      dof = lines[0]->component(0);
      if (!card.has("ORIENTATION")) along = axes_of_nodes(parts, *lines[0], *element);
      if (element->nodes.size() > 1 && lines[0]->fields.size() > 1 && lines[0]->component(1) != dof)
        lines[0]->fail("joins two different degrees of freedom, which is not supported", "give the same one for both nodes");
    }
    add_spring(parts, card, *element, name, dof, along, not_negative(*lines[value_line], 0), dashpot);
  }
}

void attach_inp_joint(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET", "ORIENTATION"});
  const InpOrientation axes = inp_axes_of(parts, card);
  const std::vector<InpElement*> elements = parts.elements_of(card, InpKind::joint);
  const InpCard* below = parts.card_after(card);
  if (below == nullptr || !names_no_set(*below))
    card.fail("has no *SPRING or *DASHPOT below it", "give one for each degree of freedom that is held");
  for (; below != nullptr && names_no_set(*below); below = parts.card_after(*below)) {
    below->allow({});
    if (below->data.size() != 2)
      below->fail(fmt::format("has {} data lines, expected two", below->data.size()),
                  "the degree of freedom, then one constant");
    const int dof = below->data[0].component(0);
    if (below->data[0].fields.size() > 1 && below->data[0].component(1) != dof)
      below->data[0].fail("names no single degree of freedom from 1 to 6", "give the same number for both nodes");
    const double value = not_negative(below->data[1], 0);
    for (const InpElement* element : elements)
      add_spring(parts, card, *element, fmt::format("{}_{}_{}", parts.group_of(card, *element), element->id, dof + 1), dof,
                 card.has("ORIENTATION") ? axes : axes_of_nodes(parts, card, *element), value, below->keyword == "DASHPOT");
  }
}

void attach_inp_mass(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET"});
  const auto lines = filled_lines(card);
  const bool rotary = card.keyword == "ROTARY INERTIA";
  if (lines.empty()) card.fail("has no data line", rotary ? "give I11, I22, I33" : "give the mass");
  (void)card.required("ELSET");
  fe::PointMass mass;
  if (rotary) {
    mass.inertia_kg_m2 = lines[0]->vector(0);
    if (!lines[0]->vector(3).isZero(0.0))
      lines[0]->fail("products of inertia are not supported", "turn them to principal axes");
  } else {
    mass.mass_kg = lines[0]->number(0);
  }
  const auto& inertia = mass.inertia_kg_m2;
  if (inertia[0] != inertia[1] || inertia[0] != inertia[2]) parts.refuse_turned(*lines[0]);
  if (mass.mass_kg < 0.0 || inertia.minCoeff() < 0.0) lines[0]->fail("must not be negative", "check the sign");
  for (const InpElement* element : parts.elements_of(card, InpKind::mass)) {
    if (element->type != (rotary ? "ROTARYI" : "MASS"))
      card.fail(fmt::format("element {} of its set is a {}", element->id, element->type), "such an element takes another card");
    mass.group = parts.group_of(card, *element);
    mass.node = parts.node(*element->at, element->nodes[0]);
    parts.model.masses.push_back(mass);
    if (!rotary) parts.point_mass_kg[element->id] = mass.mass_kg;
  }
}

void spread_inp_mass(InpParts& parts, const InpCard& card) {
  card.allow({"ELSET", "UNITS", "DISTRIBUTION"});
  const std::string units = upper_case(card.required("UNITS")), shares = upper_case(card.get("DISTRIBUTION"));
  SpreadMass mass{.value = card.line_of(0, "the mass").number(0), .owner = card.required("ELSET")};
  if (units == "MASS PER LENGTH" || units == "MASS PER AREA") {
    mass.per = units == "MASS PER AREA" ? MassPer::area : MassPer::length;
  } else if (units == "TOTAL MASS") {
    mass.total = true;
    mass.as_density = shares != "VOLUME PROPORTIONAL";
    if (mass.as_density && !shares.empty() && shares != "MASS PROPORTIONAL")
      card.fail(fmt::format("DISTRIBUTION={} is not known", shares), "MASS PROPORTIONAL and VOLUME PROPORTIONAL are read");
  } else if (units != "MASS PER VOLUME") {
    card.fail(fmt::format("UNITS={} is not known", units),
              "TOTAL MASS, MASS PER VOLUME, MASS PER AREA and MASS PER LENGTH are read");
  }
  spread_mass(parts, card, parts.set(parts.element_sets, card, card.get("ELSET")).members, mass);
}

void release_inp_ends(InpParts& parts, const InpCard& card) {
  static const std::map<std::string, unsigned> codes = {{"M1", 0b010000},    {"M2", 0b100000},   {"T", 0b001000},
                                                        {"M1-M2", 0b110000}, {"M1-T", 0b011000}, {"M2-T", 0b101000},
                                                        {"ALLM", 0b111000}};
  card.allow({});
  std::map<long, std::size_t> position;
  for (std::size_t i = 0; i < parts.model.elements.size(); ++i) position.emplace(parts.model.elements[i].id, i);
  for (const InpLine& line : card.data) {
    const auto code = codes.find(line.word(2));
    const bool first = line.word(1) == "S1";
    if (code == codes.end() || (!first && line.word(1) != "S2"))
      line.fail(fmt::format("releases '{}' at end '{}', which is not known", line.text(2), line.text(1)),
                "write element or set, S1 or S2, then M1, M2, T, M1-M2, M1-T, M2-T or ALLM");
    for (const long id : parts.elements_at(line)) {
      const auto found = position.find(id);
      if (found == position.end() || parts.model.elements[found->second].type != fe::ElementType::beam)
        line.fail(fmt::format("element {} is no beam", id), "release the ends of beams");
      const std::size_t last = parts.pieces.contains(id) ? parts.pieces.at(id) - 1 : 0;
      fe::Element& e = parts.model.elements[found->second + (first ? 0 : last)];
      e.releases = static_cast<std::uint16_t>(e.releases | (code->second << (first ? 0U : 6U)));
    }
  }
}

void attach_inp_boundary(InpParts& parts, const InpCard& card) {
  card.allow({"OP", "TYPE", "AMPLITUDE"});
  if (upper_case(card.get("TYPE", "DISPLACEMENT")) != "DISPLACEMENT")
    card.fail("only TYPE=DISPLACEMENT is supported", "fix displacements and rotations");
  for (const InpLine& line : card.data) {
    if (line.fields.size() < 2) line.fail("has no degree of freedom", "write node or set, first, last degree of freedom");
    Directions fixed{};
    if (!named_support(line.fields[1], fixed)) {
      const int first = line.component(1), last = line.blank(2) ? first : line.component(2);
      if (last < first)
        line.fail(fmt::format("holds degrees of freedom from {} to {}, which are none", first + 1, last + 1),
                  "write node or set, first, last degree of freedom");
      for (int dof = first; dof <= last; ++dof) fixed[fe::slot(dof)] = true;
      if (line.number_or(3, 0.0) != 0.0 && !parts.of_stage.contains(&card))
        line.fail("prescribes a displacement that is not zero, which is not supported",
                  "supports hold at zero; a static step with NLGEOM or before *STEP, PERTURBATION may move them");
    }
    const bool whole = fixed[0] == fixed[1] && fixed[0] == fixed[2] && fixed[3] == fixed[4] && fixed[3] == fixed[5];
    const bool set = !parts.is_number(line.fields[0]);
    for (const long id : parts.nodes_of(line, 0)) {
      const std::string name = set ? line.fields[0] : fmt::format("node_{}", id);
      (void)parts.axes_of(line, id, whole);
      if (parts.node_axes.contains(id)) {
        InpParts::OwnSupport& own = parts.held_own.emplace(id, InpParts::OwnSupport{line, name}).first->second;
        for (std::size_t d = 0; d < 6; ++d) own.fixed[d] = own.fixed[d] || fixed[d];
        (void)parts.node(line, id);
        continue;
      }
      const auto [node, first] = parts.moved_by(id);
      Directions of_node{};
      for (std::size_t d = 0; d < (first == 0 ? 6U : 3U); ++d) of_node[fe::slot(first) + d] = fixed[d];
      parts.hold(name, parts.node(line, node), of_node);
    }
  }
}

}  // namespace twindeck::model_io
