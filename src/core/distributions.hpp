#pragma once

/// Probabilities and quantiles of the laws that several rooms ask for, by Boost.Math. Each function takes plain numbers [-] and
/// gives a plain number [-]; a probability outside its open interval is our own mistake (TWINDECK_ASSERT).
namespace twindeck {

/// P(U <= u) of the standard normal law.
[[nodiscard]] double normal_probability(double u);
/// P(U > u) of the standard normal law, accurate where it is small.
[[nodiscard]] double normal_tail(double u);
/// u with P(U <= u) = probability, in ]0, 1[.
[[nodiscard]] double normal_quantile(double probability);
/// z with P(|U| <= z) = level, in ]0, 1[: half the width of a two-sided interval in standard deviations.
[[nodiscard]] double two_sided_normal_quantile(double level);

/// P(|T| > |t|) of Student's law. @param degrees  of freedom, > 0
[[nodiscard]] double student_two_sided_tail(double t, double degrees);
/// t with P(T <= t) = probability, in ]0, 1[, of Student's law. @param degrees  of freedom, > 0
[[nodiscard]] double student_quantile(double degrees, double probability);

/// P(X > x) of the chi-squared law; 1 for x <= 0. @param degrees  of freedom, > 0
[[nodiscard]] double chi_squared_tail(double x, double degrees);

}  // namespace twindeck
