#include "diagnosis/null_calibration.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <mutex>
#include <numbers>
#include <random>

#include "core/parallel.hpp"
#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

namespace {

/// Standard normal numbers by our own transform (Box and Muller 1958), the same everywhere.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1.0p-53,
                 v = static_cast<double>(random_() >> 11) * 0x1.0p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

NullCalibration run_null_calibration(const ReducedModel& model, const FeatureSet& features, const ScatterOptions& scatter,
                                     const std::vector<Hypothesis>& catalogue, const SearchOptions& search, int count,
                                     std::uint64_t seed, const std::function<void(int)>& progress,
                                     const std::map<std::string, int>& bound) {
  const Instantiated entries = instantiate(catalogue, model, features);
  FeatureMap original(model, features, scatter);
  original.bind_modes(bound);
  const Eigen::MatrixXd factor = original.covariance().llt().matrixL();
  const Inference nominal(original, entries.candidates);
  const Fit as_measured = nominal.fit({}, {});
  const ScreenTable table = as_measured.all.valid ? nominal.screen_table(as_measured) : ScreenTable{};
  NullCalibration result;
  result.log_odds.assign(static_cast<std::size_t>(count), 0.0);
  result.chi_squared.assign(static_cast<std::size_t>(count), 0.0);
  int done = 0;
  std::mutex counting;
  parallel_for(count, [&](int i) {
    Normal normal(seed * 1000003u +
                  static_cast<std::uint64_t>(i));  // each its own stream: the number of threads changes nothing
    Eigen::VectorXd x(static_cast<Eigen::Index>(original.nuisances().size()));
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const Nuisance& v = original.nuisances()[static_cast<std::size_t>(j)];
      do x[j] = v.kind == Nuisance::Kind::level ? 0.1 * normal() : normal();
      while (x[j] < v.lower || x[j] > v.upper);
    }
    const Prediction truth = original.predict(original.base(x), {}, false);
    if (truth.valid) {
      Eigen::VectorXd noise(truth.g.size());
      for (Eigen::Index r = 0; r < noise.size(); ++r) noise[r] = normal();
      FeatureMap drawn = original;
      drawn.set_values(truth.g + factor * noise);
      const Instantiated own = instantiate(catalogue, model, drawn.features());  // ranges that follow what is measured
      Inference inference(drawn, own.candidates);
      inference.use(&table);
      const Fit base = inference.fit({}, {});
      const auto ranking = inference.search(base, search);
      result.chi_squared[static_cast<std::size_t>(i)] = base.chi_squared;
      result.log_odds[static_cast<std::size_t>(i)] =
          ranking.empty() ? -20.0 : tempered_log_odds(ranking.front(), inference.dof());
    }
    const std::scoped_lock lock(counting);
    if (progress) progress(++done);
  });
  return result;
}

}  // namespace twindeck::diagnosis
