#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/inp_cards.hpp"

/// Inside of the library: what an .inp file says, collected card by card in the numbers and names of the file; resolved into an
/// fe::Model when all cards have been read, since an element may stand before its section and a set before its nodes.
namespace twindeck::model_io {

struct InpElement {
  long id = 0;
  std::string type;  ///< "B31", in upper case
  std::vector<long> nodes;
  const InpCard* card = nullptr;
  long line = 0;
  int used = 0;  ///< how many section, spring, dashpot or mass cards speak of it
};

struct InpSet {
  std::string name;  ///< as first written
  std::vector<long> members;
};

/// sum coefficient · displacement = 0; the first term is the dependent one.
struct InpEquation {
  struct Term {
    long node;
    int dof;  ///< 0-5
    double coefficient;
  };
  const InpCard* card;
  long line;
  std::vector<Term> terms;
};

/// Local axes of *ORIENTATION (rectangular): rows x', y', z' in global axes.
using InpOrientation = Eigen::Matrix3d;

struct InpParts {
  explicit InpParts(const InpFile& f) : file(f) {}

  const InpFile& file;
  fe::Model model;  ///< nodes and materials; the rest when it is resolved
  std::map<long, int> node_position;
  std::map<long, InpElement> elements;
  std::map<std::string, InpSet> node_sets, element_sets;  ///< by name in upper case
  std::map<std::string, int> materials;                   ///< by name in upper case
  std::map<int, double> second_shear_moduli;              ///< G13 of the orthotropic materials of beams, by position [Pa]
  std::map<std::string, InpOrientation> orientations;
  std::vector<InpEquation> equations;
  long last_element_id = 0;        ///< the largest so far, for elements that come out of one with more nodes
  std::vector<std::string> notes;  ///< what was read over, for people

  /// Position of a node. @throws InputError if no *NODE defines it
  [[nodiscard]] int node(const InpCard& card, long line, long id) const;
  /// Members of a set (its name may carry the instance: "PART-1-1.SLAB"). @throws InputError for an unknown name
  [[nodiscard]] const InpSet& set(const std::map<std::string, InpSet>& sets, const InpCard& card, long line,
                                  const std::string& name) const;
  /// A field that holds the number of a node or the name of a set of nodes.
  [[nodiscard]] std::vector<long> nodes_of(const InpCard& card, const InpLine& line, std::size_t field) const;
  /// Elements are grouped by the set that their *ELEMENT card names, else by that of the section, spring or mass `card`: many
  /// section cards (one a direction n1) may speak of one group.
  [[nodiscard]] std::string group_of(const InpCard& card, const InpElement& element) const;
  /// The card below `card`, or null.
  [[nodiscard]] const InpCard* card_after(const InpCard& card) const;
  /// Elements of the set that ELSET= of the card names, marked as used.
  [[nodiscard]] std::vector<InpElement*> elements_of(const InpCard& card);
};

}  // namespace twindeck::model_io
