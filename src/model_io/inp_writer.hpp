#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "model_io/inp.hpp"
#include "model_io/inp_expanded_beam.hpp"

/// Inside of the library: the text of an .inp file, grown block by block. Names are shortened to what both programs take
/// (letters, digits, underscore), numbers carry 12 digits.
namespace twindeck::model_io {

class InpWriter {
 public:
  InpWriter(const fe::Model& model, const fe::PrestressState& state, InpFlavour flavour);

  void heading();
  void members();  ///< inp_write_members.cpp; may add nodes: middle nodes, ends of offsets
  void faces_and_blocks();
  void springs_and_masses();
  void links_and_supports();
  void frequency_step(int n_modes);

  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// Elements of a group; returns the set for their section: the group itself, or one of its own where the group has several.
  std::string element_block(const std::string& type, const std::string& group,
                            const std::vector<std::pair<long, std::vector<long>>>& rows);
  void point_mass(const std::string& group, int node, double mass_kg);
  static std::string unique(const std::string& wish, std::map<std::string, int>& used, std::size_t longest = 70);
  /// CalculiX takes names of sets up to 20 letters.
  std::string set_name(const std::string& wish) {
    return unique(wish, used_names_, flavour_ == InpFlavour::calculix ? 20 : 70);
  }
  std::string material(const std::string& wish, double youngs_modulus, double poisson_ratio, double density);
  std::string beam_material(const std::string& wish, const ExpandedBeam& beam);
  std::string named_material(const std::string& wish, const std::string& data);
  long add_node(const Eigen::Vector3d& x);
  long node_id(int node) const { return model_.nodes[fe::slot(node)].id; }
  long next_element() { return ++last_element_; }
  void rigid_equations(long master, const Eigen::Vector3d& master_x, long slave, const Eigen::Vector3d& slave_x,
                       bool rotations);
  void note(const std::string& sentence);
  void beams();
  void bars_and_stays();
  /// The element's group, or its section's name.
  std::string group_name(const fe::Element& element) const;
  /// Numbers of the nodes at the beam's ends, its offsets' ends where it has any; fills the geometry.
  std::vector<long> beam_ends(const fe::Element& element, fe::BeamGeometry& geometry);
  void general_section(const std::string& set, const fe::Section& section, const fe::Material& material,
                       const Eigen::Vector3d& n1, bool shear);
  void expanded_section(const std::string& set, const fe::Section& section, const fe::Material& material,
                        const Eigen::Vector3d& axis, const Eigen::Vector3d& n1);
  void note_expansion(const fe::Section& section, const ExpandedBeam& beam);

  const fe::Model& model_;
  const fe::PrestressState& state_;
  InpFlavour flavour_;
  std::string nodes_, materials_, elements_, equations_, supports_, step_, heading_;
  std::map<std::string, std::string> material_names_;  ///< data -> name
  std::map<std::string, int> used_names_, used_materials_;
  std::map<std::string, std::string> group_sets_;  ///< group -> set
  std::map<std::string, long> offset_ends_;        ///< node and offset -> node at its end
  std::vector<std::string> notes_;
  long last_node_ = 0, last_element_ = 0;
};

}  // namespace twindeck::model_io
