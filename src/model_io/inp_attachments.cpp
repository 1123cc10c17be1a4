#include "model_io/inp_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_joints.hpp"

namespace twindeck::model_io {
namespace {

/// Values of the card's data lines, without the empty line that stands for "no degree of freedom" with SPRINGA.
std::vector<const InpLine*> filled_lines(const InpCard& card) {
  std::vector<const InpLine*> lines;
  for (const InpLine& line : card.data) {
    if (std::any_of(line.fields.begin(), line.fields.end(), [](const std::string& f) { return !f.empty(); }))
      lines.push_back(&line);
  }
  return lines;
}

/// Whether the card stands in an instance that is rotated: directions given by number are not sure there.
bool is_turned(const InpParts& parts) { return parts.scopes[static_cast<std::size_t>(parts.scope)].turned(); }

[[noreturn]] void refuse_turned(const InpParts& parts, const InpCard& card, long line) {
  parts.file.fail(card, line, "names a direction by its number in an instance that is rotated, which is not read",
                  "write the card at the level of the assembly, or give a spring an ORIENTATION");
}

/// "ENCASTRE" … as fixed degrees of freedom; false for another word.
bool named_support(const std::string& word, std::array<bool, 6>& fixed) {
  static const std::map<std::string, std::array<bool, 6>> known = {
      {"ENCASTRE", {true, true, true, true, true, true}},  {"PINNED", {true, true, true, false, false, false}},
      {"XSYMM", {true, false, false, false, true, true}},  {"YSYMM", {false, true, false, true, false, true}},
      {"ZSYMM", {false, false, true, true, true, false}},  {"XASYMM", {false, true, true, true, false, false}},
      {"YASYMM", {true, false, true, false, true, false}}, {"ZASYMM", {true, true, false, false, false, true}}};
  const auto found = known.find(upper_case(word));
  if (found == known.end()) return false;
  fixed = found->second;
  return true;
}

}  // namespace

InpOrientation inp_axes_of(const InpParts& parts, const InpCard& card) {
  if (!card.has("ORIENTATION")) return InpOrientation::Identity();
  const auto found = parts.orientations.find(parts.find_key(parts.orientations, card.get("ORIENTATION")));
  if (found == parts.orientations.end()) {
    parts.file.fail(card, card.line, fmt::format("orientation '{}' is not defined", card.get("ORIENTATION")),
                    "define it by *ORIENTATION");
  }
  return found->second;
}

void attach_inp_spring(InpParts& parts, const InpCard& card) {
  if (is_of_joint(parts.file, card)) return;  // read with the joint above it
  parts.file.allow(card, {"ELSET", "ORIENTATION"});
  const bool dashpot = card.keyword == "DASHPOT";
  (void)parts.file.required(card, "ELSET");
  const InpOrientation axes = inp_axes_of(parts, card);
  const bool sure = !is_turned(parts) || card.has("ORIENTATION");
  const auto lines = filled_lines(card);
  for (const InpElement* element : parts.elements_of(card)) {
    if (inp_kind(element->type) != (dashpot ? InpKind::dashpot : InpKind::spring))
      parts.refuse_kind(card, *element, "such an element takes another card");
    const bool axial = element->type.back() == 'A';
    const std::size_t value_line = axial ? 0 : 1;
    if (lines.size() <= value_line) {
      parts.file.fail(card, card.line, "a data line is missing",
                      axial ? "give the constant" : "give the degree of freedom, then the constant");
    }
    if (lines.size() > value_line + 1) {
      parts.file.fail(card, lines[value_line + 1]->line,
                      "has more data lines: values that depend on something are not supported", "give one constant");
    }
    const std::string group = parts.group_of(card, *element);
    fe::Spring s;
    s.name = fmt::format("{}_{}", group, element->id);
    s.group = group;
    s.node = parts.node(*element->card, element->line, element->nodes[0]);
    if (element->nodes.size() > 1) s.node2 = parts.node(*element->card, element->line, element->nodes[1]);
    if (axial) {
      s.direction =
          parts.model.nodes[static_cast<std::size_t>(s.node2)].x_m - parts.model.nodes[static_cast<std::size_t>(s.node)].x_m;
      if (s.direction.norm() < 1e-12) {
        parts.file.fail(*element->card, element->line,
                        fmt::format("{} {} has no length, so no direction", element->type, element->id),
                        "use SPRING2 with a degree of freedom");
      }
      s.direction.normalize();
    } else {
      const int dof = parts.file.dof(card, *lines[0], 0);
      if (!sure) refuse_turned(parts, card, lines[0]->line);
      if (element->nodes.size() > 1 && lines[0]->fields.size() > 1 && parts.file.dof(card, *lines[0], 1) != dof) {
        parts.file.fail(card, lines[0]->line, "joins two different degrees of freedom, which is not supported",
                        "give the same one for both nodes");
      }
      s.rotation = dof > 2;
      s.direction = axes.row(dof % 3).transpose();
    }
    const double value = parts.file.number(card, *lines[value_line], 0);
    if (value < 0.0) parts.file.fail(card, lines[value_line]->line, "the constant must not be negative", "check the sign");
    (dashpot ? s.damping : s.stiffness) = value;
    parts.model.springs.push_back(s);
  }
}

void attach_inp_mass(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"ELSET"});
  const auto lines = filled_lines(card);
  const bool rotary = card.keyword == "ROTARY INERTIA";
  if (lines.empty()) parts.file.fail(card, card.line, "has no data line", rotary ? "give I11, I22, I33" : "give the mass");
  fe::PointMass mass;
  (void)parts.file.required(card, "ELSET");
  if (rotary) {
    for (std::size_t i = 0; i < 6; ++i) {
      const double value = parts.file.number_or(card, *lines[0], i, 0.0);
      if (i < 3) mass.inertia_kg_m2[static_cast<int>(i)] = value;
      if (i > 2 && value != 0.0)
        parts.file.fail(card, lines[0]->line, "products of inertia are not supported", "turn them to principal axes");
    }
  } else {
    mass.mass_kg = parts.file.number(card, *lines[0], 0);
  }
  const auto& inertia = mass.inertia_kg_m2;
  if (is_turned(parts) && (inertia[0] != inertia[1] || inertia[0] != inertia[2])) refuse_turned(parts, card, lines[0]->line);
  if (mass.mass_kg < 0.0 || mass.inertia_kg_m2.minCoeff() < 0.0)
    parts.file.fail(card, lines[0]->line, "must not be negative", "check the sign");
  for (const InpElement* element : parts.elements_of(card)) {
    if (element->type != (rotary ? "ROTARYI" : "MASS")) parts.refuse_kind(card, *element, "such an element takes another card");
    mass.group = parts.group_of(card, *element);
    mass.node = parts.node(*element->card, element->line, element->nodes[0]);
    parts.model.masses.push_back(mass);
  }
}

void attach_inp_boundary(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"OP", "TYPE"});
  if (upper_case(card.get("TYPE", "DISPLACEMENT")) != "DISPLACEMENT")
    parts.file.fail(card, card.line, "only TYPE=DISPLACEMENT is supported", "fix displacements and rotations");
  for (const InpLine& line : card.data) {
    if (line.fields.size() < 2)
      parts.file.fail(card, line.line, "has no degree of freedom", "write node or set, first, last degree of freedom");
    std::array<bool, 6> fixed{};
    if (!named_support(line.fields[1], fixed)) {
      const int first = parts.file.dof(card, line, 1);
      const int last = line.fields.size() > 2 && !line.fields[2].empty() ? parts.file.dof(card, line, 2) : first;
      if (last < first)
        parts.file.fail(card, line.line,
                        fmt::format("holds degrees of freedom from {} to {}, which are none", first + 1, last + 1),
                        "write node or set, first, last degree of freedom");
      for (int dof = first; dof <= last; ++dof) fixed[static_cast<std::size_t>(dof)] = true;
      if (parts.file.number_or(card, line, 3, 0.0) != 0.0 && !parts.of_stage.contains(&card)) {
        parts.file.fail(card, line.line, "prescribes a displacement that is not zero, which is not supported",
                        "supports hold at zero; a static step with NLGEOM or before *STEP, PERTURBATION may move them");
      }
    }
    const bool whole = fixed[0] == fixed[1] && fixed[0] == fixed[2] && fixed[3] == fixed[4] && fixed[3] == fixed[5];
    if (is_turned(parts) && !whole) refuse_turned(parts, card, line.line);
    const bool set = !parts.is_number(line.fields[0]);
    for (const long id : parts.nodes_of(card, line, 0)) {
      const int node = parts.node(card, line.line, id);
      auto& supports = parts.model.supports;
      auto found = std::find_if(supports.begin(), supports.end(), [node](const fe::Support& s) { return s.node == node; });
      if (found == supports.end()) {
        supports.push_back({set ? line.fields[0] : fmt::format("node_{}", id), node, {}});
        found = supports.end() - 1;
      }
      for (std::size_t i = 0; i < 6; ++i) found->fixed[i] = found->fixed[i] || fixed[i];
    }
  }
}

}  // namespace twindeck::model_io
