#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/reduction/structure.hpp"
#include "matching/measured.hpp"

/// Describes locations of the diagnosis ("node:725", "support:pier_W", "group:E_s") in words for a person at the structure.
namespace twindeck::diagnosis {

/// Where a person would look.
struct PlaceInWords {
  std::string words;    ///< "the deck at x = 34 m (node 725, at the sensor A5)"
  Eigen::Vector3d x_m;  ///< NaN where no single point can be named
};

/// Words for the locations of one model.
///
/// A location is described by the user's names (group of elements, support, stay, damper, sensor) and by its coordinates along
/// the axes in which the structure extends. For a matrix model without coordinates only names are used.
class PlaceWords {
 public:
  /// @param model     null for a matrix model
  /// @param dofs      of a matrix model; not read where there is a finite element model
  /// @param channels  of the measurement
  /// @param places    of the diagnosis, with the elements of zones and stays
  PlaceWords(const fe::Model* model, const std::vector<fe::DofLabel>& dofs, const std::vector<matching::Channel>& channels,
             const Places& places);

  /// A location of unknown kind is returned unchanged.
  [[nodiscard]] PlaceInWords at(const std::string& location) const;

 private:
  using Points = std::vector<Eigen::Vector3d>;
  struct Landmark {
    std::string words;
    Eigen::Vector3d x_m;
  };

  void measure_extent(const std::vector<fe::DofLabel>& dofs);
  void find_parts();
  void find_landmarks();
  [[nodiscard]] std::string coordinates(const Eigen::Vector3d& x) const;  ///< "x = 34 m, y = 5 m"; "" where unknown
  [[nodiscard]] std::string near(const Eigen::Vector3d& x) const;  ///< ", 3.2 m from the sensor A5"; "" if nothing is near
  [[nodiscard]] Points distinct(const Points& points) const;
  [[nodiscard]] PlaceInWords with_points(const std::string& words, const Points& points) const;

  [[nodiscard]] PlaceInWords node(const std::string& name) const;
  [[nodiscard]] PlaceInWords nodes(const std::vector<std::string>& names) const;
  [[nodiscard]] PlaceInWords zone(const std::string& location, const std::string& name) const;
  [[nodiscard]] PlaceInWords support(const std::string& name) const;
  [[nodiscard]] PlaceInWords stay(const std::string& name) const;
  [[nodiscard]] PlaceInWords dampers(const std::string& names) const;
  [[nodiscard]] PlaceInWords channels(const std::vector<std::string>& names) const;
  [[nodiscard]] PlaceInWords group(const std::string& name) const;
  [[nodiscard]] PlaceInWords groups(const std::vector<std::string>& names) const;

  const fe::Model* model_;
  std::vector<matching::Channel> channels_;
  const Places& places_;
  std::map<std::string, Eigen::Vector3d> node_x_m_;  ///< by name; NaN where a matrix model gives none
  std::map<std::string, std::string> part_of_node_;  ///< group that most elements at a node belong to, by the node's name
  std::vector<Landmark> landmarks_;
  double extent_m_ = 0.0;        ///< largest dimension of the structure
  int axis_ = 0;                 ///< axis of the largest dimension
  std::array<bool, 3> shown_{};  ///< axes whose coordinate is shown
  int decimals_ = 0;             ///< of coordinates
};

}  // namespace twindeck::diagnosis
