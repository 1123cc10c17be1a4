#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/deck_model.hpp"
#include "model_io/inp_cards.hpp"
#include "model_io/inp_elements.hpp"
#include "model_io/inp_scopes.hpp"

/// Inside of the library: what an .inp file says, collected card by card in the numbers and names of the file; resolved into an
/// fe::Model when all cards have been read, since an element may stand before its section and a set before its nodes.
namespace twindeck::model_io {

struct InpElement {
  long id = 0;       ///< in the model's numbers, as everywhere below (InpScope)
  int scope = 0;     ///< where its card was read
  std::string type;  ///< "B31", in upper case
  std::vector<long> nodes;
  const InpCard* card = nullptr;
  const InpLine* at = nullptr;  ///< its first data line
  int used = 0;                 ///< how many section, spring, dashpot or mass cards speak of it
  long towards = -1;            ///< of a beam: additional node, to which n1 points from the first one; -1 for none
};

struct InpSet {
  std::string name;  ///< as first written
  int scope = 0;     ///< where it was defined
  std::vector<long> members;
};

/// A part of a surface: a face of a solid, a shell, or the edge of one.
struct InpFacet {
  std::vector<long> nodes;  ///< corners in order around it (2 of an edge), then middles of its edges
  long element = 0;
  bool turning = false;  ///< its nodes have rotations (shells)
};

/// A *SURFACE: of elements' faces, or of nodes alone.
struct InpSurface {
  std::string name;
  std::vector<InpFacet> facets;  ///< empty for a surface of nodes
  std::vector<long> nodes;       ///< of the facets, or given; each once
};

/// Local axes of *ORIENTATION (rectangular): rows x', y', z' in global axes.
using InpOrientation = Eigen::Matrix3d;

struct InpParts : DeckModel {
  explicit InpParts(const InpFile& f) : file(f) {}

  const InpFile& file;
  std::vector<InpScope> scopes{InpScope{}};
  int scope = 0;                      ///< of the card that is being read
  std::map<long, int> scope_of_node;  ///< where *NODE defines it
  std::set<long> with_normal;         ///< nodes whose line gives a normal behind the coordinates
  std::map<long, InpElement> elements;
  std::map<long, double> point_mass_kg;  ///< of elements of type MASS
  std::map<std::string, InpSet> node_sets,
      element_sets;                                    ///< by name in upper case, "INSTANCE.NAME" within an instance
  std::map<std::string, InpSurface> surfaces;          ///< likewise
  std::map<std::string, int> materials;                ///< by name in upper case
  std::map<int, double> second_shear_moduli;           ///< G13 of the orthotropic materials of beams, by position [Pa]
  std::map<std::string, InpOrientation> orientations;  ///< by name in upper case, likewise
  std::vector<DeckEquation> equations;                 ///< the first term is the dependent one
  std::map<int, const InpCard*> uneven_expansion;      ///< of materials where it is not one number
  std::set<const InpCard*> of_stage;                   ///< cards of the static stage, which may move supports
  std::map<long, Eigen::Matrix3d> node_axes;           ///< of *TRANSFORM, rows, by node
  struct OwnSupport {
    DeckPlace at;
    std::string name;
    Directions fixed{};
  };
  std::map<long, OwnSupport> held_own;  ///< supports along such axes, by node
  /// Of a *RIGID BODY with ROT NODE: by that node, whose displacements are the body's rotations, the reference node.
  std::map<long, std::pair<long, const InpCard*>> turned_by;

  /// Position of a node. @throws InputError if no *NODE defines it
  [[nodiscard]] int node(const DeckPlace& at, long id) const;
  [[noreturn]] void no_node(const DeckPlace& at, long id) const;
  /// "17", or "17 of instance BEAM-2": a node as the file names it.
  [[nodiscard]] std::string node_name(long id) const;
  /// The node that a field names in the scope at hand: "17", "BEAM-2.17"; in the model's numbers, defined.
  [[nodiscard]] long node_id(const InpLine& line, std::size_t field) const;
  /// An element likewise; not necessarily defined.
  [[nodiscard]] long element_id(const InpLine& line, std::size_t field) const;
  /// Whether a field is the number of a node or element (with its instance) rather than the name of a set.
  [[nodiscard]] bool is_number(const std::string& field) const;
  /// Key of a name that is defined in the scope at hand.
  [[nodiscard]] std::string key_here(const std::string& name) const { return key_in(scope, name); }
  [[nodiscard]] std::string key_in(int in, const std::string& name) const;
  /// Key under which `map` has a name used in the scope at hand: that scope's own, "INSTANCE.NAME", or the only one of that
  /// name; empty if there is none.
  template <class Map>
  [[nodiscard]] std::string find_key(const Map& map, const std::string& name) const;
  /// Members of a set. @throws InputError for an unknown name
  [[nodiscard]] const InpSet& set(const std::map<std::string, InpSet>& sets, const DeckPlace& at,
                                  const std::string& name) const;
  /// @throws InputError for an unknown name
  [[nodiscard]] const InpSurface& surface(const DeckPlace& at, const std::string& name) const;
  /// A field that holds the number of a node or the name of a set of nodes.
  [[nodiscard]] std::vector<long> nodes_of(const InpLine& line, std::size_t field) const;
  /// The first field, the number of an element or the name of a set of elements.
  [[nodiscard]] std::vector<long> elements_at(const InpLine& line) const;
  /// Number of the one node that REF NODE= or another parameter names. @throws InputError if it names none or several
  [[nodiscard]] long named_node(const InpCard& card, const std::string& parameter) const;
  /// Position of REF NODE.
  [[nodiscard]] int reference_node(const InpCard& card) const { return node(card, named_node(card, "REF NODE")); }
  /// Node and first degree of freedom that the displacements of a node are: its own, or a body's rotations (ROT NODE).
  [[nodiscard]] std::pair<long, int> moved_by(long id) const {
    const auto found = turned_by.find(id);
    return found == turned_by.end() ? std::pair(id, 0) : std::pair(found->second.first, 3);
  }
  /// Elements are grouped by the set that their *ELEMENT card names, else by that of the section, spring or mass `card`: many
  /// section cards (one a direction n1) may speak of one group. Where several instances have a set of the name, each has a
  /// group, "INSTANCE.NAME".
  [[nodiscard]] std::string group_of(const InpCard& card, const InpElement& element) const;
  /// The set behind group_of.
  [[nodiscard]] const InpSet& group_set(const InpCard& card, const InpElement& element) const;
  /// Name of a set for people: with its instance where another has one of the same name.
  [[nodiscard]] std::string set_name(const std::map<std::string, InpSet>& sets, const InpSet& set) const;
  /// The card below `card`, or null.
  [[nodiscard]] const InpCard* card_after(const InpCard& card) const;
  /// Elements of the set that ELSET= of the card names, marked as used. @throws InputError for one of another kind
  [[nodiscard]] std::vector<InpElement*> elements_of(const InpCard& card, InpKind kind, InpKind or_kind = InpKind::none);
  /// Axes along which degrees of freedom of a node count: those of *TRANSFORM, or the global ones.
  /// @throws InputError where an instance is turned and no *TRANSFORM speaks, but for directions that are `whole`
  [[nodiscard]] Eigen::Matrix3d axes_of(const DeckPlace& at, long id, bool whole = false) const;
  /// Whether the card at hand stands in an instance that is rotated.
  [[nodiscard]] bool is_turned() const { return scopes[static_cast<std::size_t>(scope)].turned(); }
  /// @throws InputError where it does: directions given by number are not sure there
  void refuse_turned(const DeckPlace& at) const;
};

template <class Map>
std::string InpParts::find_key(const Map& map, const std::string& name) const {
  const std::string own = key_here(name), plain = upper_case(name);
  if (map.contains(own)) return own;
  if (map.contains(plain)) return plain;
  const std::size_t point = plain.find('.');
  if (scopes.size() == 1 && point != std::string::npos && map.contains(plain.substr(point + 1))) return plain.substr(point + 1);
  // A deck of one instance may leave its name out.
  if (scopes.size() == 2 && map.contains(key_in(1, name))) return key_in(1, name);
  return "";
}

}  // namespace twindeck::model_io
