#include "model_io/inp_joints.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "model_io/inp_attachments.hpp"
#include "model_io/inp_elements.hpp"

namespace twindeck::model_io {

namespace {

bool names_no_set(const InpCard& card) { return (card.keyword == "SPRING" || card.keyword == "DASHPOT") && !card.has("ELSET"); }

}  // namespace

bool is_of_joint(const InpFile& file, const InpCard& card) {
  const InpCard* at = &card;
  while (at != file.cards().data() && names_no_set(*at)) --at;
  return at != &card && at->keyword == "JOINT";
}

void attach_inp_joint(InpParts& parts, const InpCard& card) {
  parts.file.allow(card, {"ELSET", "ORIENTATION"});
  const InpOrientation axes = inp_axes_of(parts, card);
  if (!card.has("ORIENTATION") && parts.scopes[static_cast<std::size_t>(parts.scope)].turned())
    parts.file.fail(card, card.line, "has no ORIENTATION in an instance that is rotated, where its directions are not sure",
                    "give one");
  const std::vector<InpElement*> elements = parts.elements_of(card);
  for (const InpElement* element : elements) {
    if (inp_kind(element->type) != InpKind::joint) parts.refuse_kind(card, *element, "*JOINT is for JOINTC");
  }
  std::size_t found = 0;
  for (const InpCard* below = parts.card_after(card); below != nullptr && names_no_set(*below);
       below = parts.card_after(*below)) {
    parts.file.allow(*below, {});
    if (below->data.size() != 2)
      parts.file.fail(*below, below->line, fmt::format("has {} data lines, expected two", below->data.size()),
                      "the degree of freedom, then one constant");
    const long dof = parts.file.integer(*below, below->data[0], 0);
    const double value = parts.file.number(*below, below->data[1], 0);
    if (dof < 1 || dof > 6 || (below->data[0].fields.size() > 1 && parts.file.integer(*below, below->data[0], 1) != dof))
      parts.file.fail(*below, below->data[0].line, "names no single degree of freedom from 1 to 6",
                      "give the same number for both nodes");
    if (value < 0.0) parts.file.fail(*below, below->data[1].line, "the constant must not be negative", "check the sign");
    for (const InpElement* element : elements) {
      fe::Spring s;
      s.group = parts.group_of(card, *element);
      s.name = fmt::format("{}_{}_{}", s.group, element->id, dof);
      s.node = parts.node(*element->card, element->line, element->nodes[0]);
      s.node2 = parts.node(*element->card, element->line, element->nodes[1]);
      s.rotation = dof > 3;
      s.direction = axes.row((dof - 1) % 3).transpose();
      (below->keyword == "DASHPOT" ? s.damping : s.stiffness) = value;
      parts.model.springs.push_back(s);
    }
    ++found;
  }
  if (found == 0)
    parts.file.fail(card, card.line, "has no *SPRING or *DASHPOT below it", "give one for each degree of freedom that is held");
}

}  // namespace twindeck::model_io
