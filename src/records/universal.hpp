#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <map>
#include <string>
#include <vector>

namespace twindeck::records {

/// A mode shape or other result at nodes (set 55).
struct NodalResult {
  std::string title;  ///< first line of text
  int analysis = 2;   ///< 2 normal mode, 3 and 7 complex mode (of an equation of first and second order)
  int mode = 0;
  double frequency_Hz = 0.0;
  std::complex<double> eigenvalue;  ///< [rad/s] of a complex mode
  double damping_ratio = 0.0;
  bool complex = false;
  std::map<long, Eigen::VectorXcd> values;  ///< by node, 3 or 6 components
  [[nodiscard]] bool is_complex_mode() const { return analysis == 3 || analysis == 7; }
};

/// An element (set 2412).
struct UniversalElement {
  long label = 0;
  long descriptor = 0;  ///< 11 rod, 21 beam, 91 and 94 shell of three and four nodes, 111 tetrahedron, 115 hexahedron,
                        ///< 118 and 116 those with nodes on their edges
  std::vector<long> nodes;
};

/// Whether elements of that kind have a line with the node of their orientation.
[[nodiscard]] constexpr bool is_beam(long descriptor) { return descriptor == 11 || (descriptor >= 21 && descriptor <= 24); }

/// Numbers of the format's lists: types of functions (record 6 of set 58) and of quantities (records 8 to 10).
enum UniversalCode {
  kAutoSpectrum = 2,
  kCrossSpectrum = 3,
  kFrequencyResponse = 4,
  kCoherence = 6,
  kDisplacementData = 8,
  kReactionForceData = 9,
  kVelocityData = 11,
  kAccelerationData = 12,
  kForceData = 13,
  kFrequencyData = 18
};

/// A function of set 58 that is no time series: a frequency response function, a coherence, a spectrum.
struct UniversalFunction {
  int function = 0;                      ///< type, UniversalCode
  int number = 0;                        ///< position among the sets 58 of the file, from 1
  long line = 0;                         ///< where its record 6 stands
  std::string response, reference;       ///< node and direction, "12+z"; empty for none
  std::vector<std::string> other_names;  ///< of the response: its entity, the title lines
  std::string unit;                      ///< of the ordinate's numerator, as written
  int quantity = 0, over = 0;            ///< type of data of the ordinate's numerator and denominator; 0: not known
  int abscissa = 0;                      ///< type of data of the abscissa
  std::string abscissa_unit;             ///< as written
  bool complex = false;                  ///< false: real values, an amplitude
  Eigen::Index lines = 0;                ///< number of values
  /// (n_lines) abscissa, as written. Without the values: first and last line of an even one, nothing of an uneven one.
  Eigen::VectorXd at;
  std::vector<std::complex<double>> ordinate;  ///< (n_lines), if it was asked for
};

/// What universal files hold beside time series.
struct UniversalData {
  std::string title;                           ///< set 151
  bool has_header = false, has_units = false;  ///< sets 151, 164
  double length_factor = 1.0;                  ///< set 164: file lengths are metres times this
  std::map<long, Eigen::Vector3d> nodes;       ///< sets 15, 2411 [m]
  std::map<long, std::array<long, 2>> axes;    ///< numbers of the axes for the position and the motion of a node
  std::vector<UniversalElement> elements;      ///< set 2412
  std::vector<std::vector<long>> lines;        ///< set 82: chains of nodes
  std::vector<NodalResult> results;            ///< set 55
  std::vector<UniversalFunction> functions;    ///< sets 58 that are no time series
  std::map<std::string, int> others;           ///< sets that are not read, by number
};

}  // namespace twindeck::records
