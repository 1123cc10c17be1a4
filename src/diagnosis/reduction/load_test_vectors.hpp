#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "diagnosis/reduction/structure.hpp"

/// Load tests of a finite element model or a matrix model, over its free degrees of freedom.
namespace twindeck::diagnosis {

/// A force, a moment or a movement of the ground at a node, in a load case.
struct NodalLoad {
  std::string load, node;
  int direction = 0;    ///< 0-5 = x y z rx ry rz
  double value = 0.0;   ///< [N, N m]; of the ground [m]
  bool ground = false;  ///< the ground moves under a support
  long line = 0;        ///< of loads.csv
};

/// Position of a channel of a load test.
struct Gauge {
  std::string node;                                     ///< node whose rotation is measured, else ""
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< axis of a rotation, direction of a force; zero where unknown
  std::string element;                                ///< of a strain gauge: name or number of a beam, bar or stay; "" for none
  double xi = 0.5;                                    ///< part of the element's length from its first end
  Eigen::Vector2d fibre_m = Eigen::Vector2d::Zero();  ///< local y and z of the gauge in the section
  std::string support;                                ///< support of a force gauge; "" for none
  long line = 0;                                      ///< of channels.csv
};

/// Errors for a load or a gauge that has no location in the model; the caller throws them.
[[nodiscard]] InputError no_such_node(const twindeck::Place& at, const std::string& node);
[[nodiscard]] InputError no_support_to_move(const twindeck::Place& at, const std::string& node, int direction);
[[nodiscard]] InputError no_such_element(const twindeck::Place& at, const std::string& element);
[[nodiscard]] InputError no_such_support(const twindeck::Place& at, const std::string& support,
                                         const std::vector<std::string>& known);

/// Strains are those of uniform beams, bars and stays: fibres along the axis, plane sections, no temperature.
/// @param loads_file, channels_file  for messages
/// @throws InputError  naming the line, for a node that the model lacks or that cannot move in the direction, a movement of the
///         ground where no support holds the node, an element or a support that the model lacks, an element whose strain is not
///         computed, and a force without a direction
[[nodiscard]] LoadTests load_tests_of(const Structure& structure, const Places& places, const std::vector<NodalLoad>& loads,
                                      const std::vector<Gauge>& gauges, const std::string& loads_file,
                                      const std::string& channels_file);

}  // namespace twindeck::diagnosis
