#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/reduction/parameter_law.hpp"
#include "diagnosis/reduction/reduced_basis.hpp"
#include "diagnosis/reduction/reduced_matrix.hpp"
#include "diagnosis/reduction/reduction_options.hpp"
#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// A candidate location in reduced coordinates (r = number of basis vectors).
struct ReducedPlace {
  std::string id;
  Eigen::Vector3d x_m;
  std::vector<int> columns;       ///< basis vectors for causes at this location, after the common ones
  ReducedMatrix stiffness, mass;  ///< (r × r), size 0 if the location has none
  ReducedDirections directions;   ///< unit forces
  std::map<std::string, double> attributes;
  ParameterLaw<ReducedMatrix> stiffness_law = {}, mass_law = {};  ///< dependence of its matrices on the parameters
};

/// Position of a support on its line: the part `part` of the way from station `first` to the next one.
struct OnLine {
  Eigen::Index first = 0;
  double part = 0.0;
};
/// @param attributes  of the support's place: stations, x_0 …  @param position  on the line [m]
[[nodiscard]] OnLine on_line(const std::map<std::string, double>& attributes, double position);

/// The structure, projected once onto a small basis. Thousands of changed structures can then be solved:
///   K(theta) = sum a_g(theta) V' K_g V,  M likewise,  V = [modes, corrections for parameters and dampers | corrections by
///   place].
/// A change at a location uses the common vectors and the vectors of the location. These are K^-1 (dK Phi) for a factor, and
/// K^-1 b for a force direction b (statically exact; Craig and Bampton 1968, MacNeal 1971). If there are load tests, V also
/// holds K^-1 f for each load f, and the first-order changes of K^-1 f by parameters, element scatter and causes. V is
/// orthonormal in K up to a common factor.
class ReducedModel {
 public:
  struct Term {
    fe::Coefficient coefficient;
    ReducedMatrix matrix;  ///< (r × r)
  };

  /// @throws InputError if K is singular beyond rigid-body motion
  ReducedModel(const Structure& structure, const Places& places, const ReductionOptions& options);

  std::vector<fe::Parameter> parameters;
  Eigen::VectorXd theta;  ///< (n_parameters) values at which the basis was made
  std::vector<Term> stiffness, mass;
  std::map<std::string, std::vector<ReducedPlace>> sets;
  Eigen::MatrixXd sensors;  ///< (4 n_channels × r), see SensorValues
  int common = 0;           ///< basis vectors that every solve uses: 0 … common-1
  double total_mass_kg = 0.0;
  Eigen::VectorXd frequency_Hz;      ///< of the modes of the unchanged full model
  Eigen::MatrixXd mode_coordinates;  ///< (common × n_modes) the same modes in the common vectors, which hold them
  LoadTests load_tests;              ///< in the basis; at `theta` the displacements are exact

  [[nodiscard]] Eigen::Index size() const { return sensors.cols(); }
  /// The location called `id` in any set; null if there is none.
  [[nodiscard]] const ReducedPlace* place(const std::string& set, const std::string& id) const;

 private:
  /// Terms and places in the coordinates of the common vectors.
  void project(const fe::ParametricSystem& system, const Places& places);
  /// Adds the vectors of locations, in batches that fit into memory, and projects everything to them.
  struct Owner;
  void add_vectors(const Structure& structure, const std::vector<Owner>& owners);

  struct Kept;                  ///< the basis, and the source of the vectors of locations
  std::shared_ptr<Kept> kept_;  ///< copies share it
};

}  // namespace twindeck::diagnosis
