#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

/// Room `reliability`: how likely a limit is exceeded, given what is uncertain. It takes random inputs (laws with mean and
/// deviation), limit states as functions of their values, and spectra of responses. It gives probabilities, reliability
/// indices, importance factors, and losses of section and fatigue damage over the years. Nothing here knows of finite elements
/// or files.
namespace twindeck::reliability {

/// Law of one random input, cut to [low, high] where these are given.
enum class LawKind { normal, lognormal, uniform, gumbel, weibull };
/// In the order of LawKind.
inline const std::vector<std::string> law_names = {"normal", "lognormal", "uniform", "gumbel", "weibull"};
[[nodiscard]] std::string law_name(LawKind kind);

struct RandomInput {
  std::string name;
  LawKind kind = LawKind::normal;
  double mean = 0.0,
         deviation = 0.0;           ///< of the law before it is cut, in the input's own unit; a deviation of 0 is a fixed value
  std::optional<double> low, high;  ///< the law is cut to these; a uniform law takes its ends from mean and deviation
  std::string label;                ///< paper | code | assumed | identified | user
  std::string source;               ///< where mean and deviation come from
};

/// Random inputs as functions of independent standard normal numbers u (Rosenblatt's transformation of a Gaussian copula): z =
/// L u with the correlations L L', x_i = F_i^-1(Phi(z_i)). Inputs with a deviation of zero are constants and have no number in
/// u.
/// Reference: Der Kiureghian and Liu (1986), J. Eng. Mech. 112, 85-104; Lebrun and Dutfoy (2009), Prob. Eng. Mech. 24, 312-320.
class RandomVector {
 public:
  /// @param correlation  (n × n) of z in the order of `inputs`; empty: independent
  /// @throws InputError  with the input's name: a deviation below zero, ends in the wrong order or without probability between
  ///         them, a mean that the law cannot have; a correlation matrix that is not positive definite
  explicit RandomVector(std::vector<RandomInput> inputs, const Eigen::MatrixXd& correlation = {});

  [[nodiscard]] Eigen::Index dimension() const { return std::ssize(random_); }  ///< of u
  [[nodiscard]] const std::vector<RandomInput>& inputs() const { return inputs_; }
  /// Name of the input that u_k moves. If inputs are correlated, it is the last one that u_k moves.
  [[nodiscard]] const std::string& name(Eigen::Index k) const { return inputs_[random_[static_cast<std::size_t>(k)]].name; }
  /// @param u  (dimension()) standard normal numbers  @return (n) values of all inputs, fixed ones too
  [[nodiscard]] Eigen::VectorXd values(const Eigen::Ref<const Eigen::VectorXd>& u) const;

 private:
  std::vector<RandomInput> inputs_;
  std::vector<std::size_t> random_;  ///< inputs that have a deviation
  Eigen::MatrixXd factor_;           ///< L
};

}  // namespace twindeck::reliability
