#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

/// Frequency response functions in closed form, and a writer of them as universal files: the product reads them and writes
/// none.
namespace twindeck::test {

/// A structure given by its modes, of unit modal mass.
struct ModalModel {
  Eigen::VectorXd frequency_Hz, damping_ratio;
  Eigen::MatrixXd shapes;  ///< (n_points × n_modes)

  /// Acceleration at `response` over force at `reference`:  H = sum over r of  -omega² phi_r phi_r / (omega_r² - omega² + 2 i
  /// zeta_r omega_r omega).
  [[nodiscard]] Eigen::VectorXcd accelerance(Eigen::Index response, Eigen::Index reference, const Eigen::VectorXd& f) const {
    Eigen::VectorXcd h = Eigen::VectorXcd::Zero(f.size());
    for (Eigen::Index r = 0; r < frequency_Hz.size(); ++r)
      for (Eigen::Index k = 0; k < f.size(); ++k) {
        const double own = 2.0 * std::numbers::pi * frequency_Hz[r], w = 2.0 * std::numbers::pi * f[k];
        h[k] += -w * w * shapes(response, r) * shapes(reference, r) /
                std::complex<double>(own * own - w * w, 2.0 * damping_ratio[r] * own * w);
      }
    return h;
  }
};

/// A function of set 58, with what the standard's records 6 to 10 hold.
struct WrittenFunction {
  long response = 1, response_direction = 3, reference = 1, reference_direction = 3;
  Eigen::VectorXd f;   ///< [Hz] ascending
  Eigen::VectorXcd h;  ///< ordinate
  int function = 4, data_type = 6, abscissa = 18, quantity = 12, over = 13;
  bool even = true;
  std::string unit = "m/s^2";
};

/// One set 58 (text) or 58b (binary, little-endian).
inline std::string universal_function(const WrittenFunction& w, bool binary) {
  const bool complex = w.data_type >= 5, wide = w.data_type % 2 == 0;
  const Eigen::Index n = w.f.size();
  const auto axis = [](int type, const char* label, const std::string& unit) {
    return fmt::format("{:>10}{:>5}{:>5}{:>5} {:<20} {:<20}\n", type, 0, 0, 0, label, unit);
  };
  const Eigen::Index bytes = n * ((w.even ? 0 : 4) + (complex ? 2 : 1) * (wide ? 8 : 4));
  std::string text = "    -1\n";
  text +=
      binary ? fmt::format("    58b{:>6}{:>6}{:>12}{:>12}{:>6}{:>6}{:>12}{:>12}\n", 1, 2, 11, bytes, 0, 0, 0, 0) : "    58\n";
  for (int title = 0; title < 5; ++title) text += fmt::format("{:<80}\n", "NONE");
  text += fmt::format("{:>5}{:>10}{:>5}{:>10} {:<10}{:>10}{:>4} {:<10}{:>10}{:>4}\n", w.function, 0, 0, 0, "NONE", w.response,
                      w.response_direction, "NONE", w.reference, w.reference_direction);
  text += fmt::format("{:>10}{:>10}{:>10}{:>13.5E}{:>13.5E}{:>13.5E}\n", w.data_type, n, w.even ? 1 : 0, w.even ? w.f[0] : 0.0,
                      w.even ? w.f[1] - w.f[0] : 0.0, 0.0);
  text += axis(w.abscissa, "Frequency", "Hz") + axis(w.quantity, "Response", w.unit) + axis(w.over, "Force", "N") +
          axis(0, "NONE", "NONE");
  int in_line = 0;
  const auto put = [&](double value, bool as_double) {
    if (!binary) {
      text += fmt::format("{:>20.11E}", value) + (++in_line % 4 == 0 ? "\n" : "");
    } else if (as_double) {
      text.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      const auto narrow = static_cast<float>(value);
      text.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
    }
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!w.even) put(w.f[k], false);
    put(w.h[k].real(), wide);
    if (complex) put(w.h[k].imag(), wide);
  }
  if (binary || in_line % 4 != 0) text += '\n';
  return text + "    -1\n";
}

}  // namespace twindeck::test
