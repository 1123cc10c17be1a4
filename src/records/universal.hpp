#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <string>
#include <vector>

namespace twindeck::records {

/// A mode shape or other result at nodes (set 55).
struct NodalResult {
  std::string title;  ///< first line of text
  int analysis = 2;   ///< 2 normal mode, 3 complex mode
  int mode = 0;
  double frequency_Hz = 0.0;
  std::complex<double> eigenvalue;  ///< analysis 3
  double damping_ratio = 0.0;
  bool complex = false;
  std::map<long, Eigen::VectorXcd> values;  ///< by node, 3 or 6 components
};

/// What universal files hold beside time series.
struct UniversalData {
  std::string title;                           ///< set 151
  bool has_header = false, has_units = false;  ///< sets 151, 164
  double length_factor = 1.0;                  ///< set 164: file lengths are metres times this
  std::map<long, Eigen::Vector3d> nodes;       ///< sets 15, 2411 [m]
  std::vector<std::vector<long>> lines;        ///< set 82: chains of nodes
  std::vector<NodalResult> results;            ///< set 55
  std::map<std::string, int> others;           ///< sets that are not read, by number
};

}  // namespace twindeck::records
