#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::matching {

/// One-to-one assignment of rows to columns with the largest sum of gains (Hungarian algorithm with potentials, O(r² c)).
/// @param gain  [-] (n_rows × n_columns), finite
/// @return (n_rows) column of each row; -1 for rows without a column (if there are more rows than columns)
/// References: Kuhn (1955), Naval Research Logistics Quarterly 2, 83-97; Jonker and Volgenant (1987), Computing 38, 325-340.
[[nodiscard]] std::vector<int> best_assignment(const Eigen::Ref<const Eigen::MatrixXd>& gain);

}  // namespace twindeck::matching
