#include "records/covariance.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.hpp"
#include "io/npy.hpp"

namespace twindeck::records {

namespace {

using Eigen::Index;

constexpr double asymmetry = 1e-9;        ///< [-] of sqrt(c_ii c_jj): what single precision and rounding leave
constexpr double least_share = 1e-12;     ///< [-] of a variance that the rows before it must leave open; less is rounding
constexpr double least_variance = 1e-60;  ///< [SI²] the inverse of less is no number to compute with
constexpr double most_variance = 1e30;    ///< [SI²]

struct Refusal {
  const std::filesystem::path& file;
  [[noreturn]] void operator()(const std::string& problem, const std::string& mend) const {
    throw InputError({file.string(), 0, ""}, problem, mend);
  }
};

/// True if the rows before `n` leave at least `least_share` open of the variance of each of the first `n`.
bool leading_part_is_definite(const Eigen::MatrixXd& correlation, Index n) {
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation.topLeftCorner(n, n));
  if (factor.info() != Eigen::Success) return false;
  return (factor.matrixLLT().diagonal().array().square() > least_share).all();
}

/// The first row at which the elimination breaks down: the smallest leading part that is not definite ends with it.
Index first_dependent_row(const Eigen::MatrixXd& correlation) {
  Index definite = 0, broken = correlation.rows();
  while (broken - definite > 1) {
    const Index middle = (definite + broken) / 2;
    (leading_part_is_definite(correlation, middle) ? definite : broken) = middle;
  }
  return broken - 1;
}

void check_entries(const Eigen::MatrixXd& c, const Refusal& refuse) {
  for (Index i = 0; i < c.rows(); ++i) {
    if (!std::isfinite(c(i, i)) || c(i, i) < least_variance || c(i, i) > most_variance)
      refuse(fmt::format("the variance of row {} of rows.csv is {:g}, expected a positive number from {:g} to {:g}", i + 1,
                         c(i, i), least_variance, most_variance),
             "entry (i, i) is the square of the standard deviation of row i, in the row's unit");
  }
  for (Index i = 0; i < c.rows(); ++i) {
    for (Index j = 0; j < i; ++j) {
      const double scale = std::sqrt(c(i, i)) * std::sqrt(c(j, j));
      if (!std::isfinite(c(i, j)) || !std::isfinite(c(j, i)))
        refuse(fmt::format("the covariance of rows {} and {} of rows.csv is not finite", j + 1, i + 1),
               "replace NaN and infinity");
      if (std::abs(c(i, j) - c(j, i)) > asymmetry * scale)
        refuse(fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}", j + 1, i + 1, c(j, i),
                           c(i, j)),
               "a covariance is symmetric; save (C + C.T) / 2 if the difference is rounding");
      if (std::abs(c(i, j)) >= scale)
        refuse(fmt::format("is not positive definite: rows {} and {} of rows.csv have a correlation of {:.6g}", j + 1, i + 1,
                           c(i, j) / scale),
               "a correlation lies between -1 and 1; leave one of the two rows out if they measure the same");
    }
  }
}

}  // namespace

Eigen::MatrixXd read_covariance(const std::filesystem::path& file, Index n_rows) {
  const Refusal refuse{file};
  Eigen::MatrixXd c = io::read_npy(file);
  if (c.rows() != n_rows || c.cols() != n_rows)
    refuse(fmt::format("is {} x {}, but rows.csv has {} rows", c.rows(), c.cols(), n_rows),
           "give a square matrix in the order of rows.csv, or remove the file so that the column std counts");
  check_entries(c, refuse);
  c = (0.5 * (c + c.transpose())).eval();
  const Eigen::VectorXd root = c.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = root.asDiagonal() * c * root.asDiagonal();
  if (!leading_part_is_definite(correlation, n_rows))
    refuse(fmt::format("is not positive definite: row {} of rows.csv follows from the rows before it",
                       first_dependent_row(correlation) + 1),
           "leave rows out that are combinations of others, or add the variance of their noise to the diagonal");
  return c;
}

}  // namespace twindeck::records
