#pragma once

#include <string>
#include <vector>

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards of springs and masses.
namespace twindeck::model_io::nastran {

void read_scalar_spring(Parts& parts, const Card& card);  ///< CELAS1, CELAS2
void read_bush(Parts& parts, const Card& card);           ///< CBUSH
void read_mass(Parts& parts, const Card& card);           ///< CONM1, CONM2
void read_scalar_mass(Parts& parts, const Card& card);    ///< CMASS1, CMASS2
void finish_masses(Parts& parts);                         ///< CMASS of a node together
/// A spring or mass given by a matrix on the six displacements of each node; displacements that it does not touch are left out.
void add_matrix(Parts& parts, const std::string& name, const std::vector<int>& nodes, const Eigen::MatrixXd& stiffness,
                const Eigen::MatrixXd& mass);

}  // namespace twindeck::model_io::nastran
