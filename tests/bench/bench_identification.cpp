/// Times one part of the identification in a process of its own, so that its peak memory is its own:
///
///     bench_identification write FILE.npy                     the record of identification_record.hpp
///     bench_identification covariance|data|deviations|clustering FILE.npy
///
/// prints `cpu_s peak_MB modes_found spurious`. Peak memory is that of the whole process with the record in it, up to the end
/// of the task; modes are judged afterwards, as the product reports them, with what the standard deviations drop.
#include <cstdio>
#include <numeric>
#include <string>

#include "bench/cost.hpp"
#include "bench/identification_record.hpp"
#include "identification/identify.hpp"
#include "identification/ssi_cov.hpp"
#include "identification/ssi_data.hpp"
#include "io/npy.hpp"
#include "linalg/one_thread.hpp"
#include "npy_double.hpp"
#include "signal/condition.hpp"

namespace {

using namespace twindeck;
using Eigen::Index;

constexpr Index kBlockRows = 50, kBlocks = 50;

void judge(const std::vector<identification::Cluster>& modes, int& found, int& spurious) {
  std::vector<bool> taken(modes.size(), false);
  found = 0;
  for (const double truth : bench::kRecordFrequencies_Hz) {
    for (std::size_t m = 0; m < modes.size(); ++m) {
      if (taken[m] || std::abs(modes[m].frequency_Hz / truth - 1.0) > 0.005) continue;
      taken[m] = true;
      ++found;
      break;
    }
  }
  spurious = static_cast<int>(std::count(taken.begin(), taken.end(), false));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string task = argv[1];
  linalg::use_one_thread();
  if (task == "write") {
    io::write_npy(bench::identification_record(), argv[2]);
    return 0;
  }
  const Eigen::MatrixXd data = signal::detrended(io::read_npy(argv[2]));
  std::vector<Index> references(static_cast<std::size_t>(data.cols()));
  std::iota(references.begin(), references.end(), 0);
  identification::IdentifyOptions options;
  options.block_rows = kBlockRows;
  options.limits.highest_Hz = 8.0;
  const std::vector<int> orders = options.orders();
  const auto select = [&](const identification::ShiftModels& models) {
    auto diagram = identification::stabilisation_diagram(identification::poles_of(models), options.criteria, options.limits);
    return identification::automatic_clusters(diagram, orders, options.automatic);
  };
  const auto reported = [&] {
    const auto blocks = signal::correlations(data, references, 2 * kBlockRows, 20);
    return task == "data" ? identification::identify_from_data({data}, references, blocks, bench::kRecordRate_Hz, options).modes
                          : identification::identify(blocks, bench::kRecordRate_Hz, options).modes;
  };
  double seconds = 0.0;
  int found = 0, spurious = 0;
  const double start = bench::cpu_seconds();
  if (task == "data") {
    const auto samples = static_cast<double>(data.rows() - 2 * kBlockRows + 1);
    const auto subspace = identification::ssi_data({identification::hankel_gram(data, references, kBlockRows)}, samples,
                                                   data.cols(), data.cols(), kBlockRows, orders.back());
    const auto models = identification::shift_models(subspace.observability, orders, bench::kRecordRate_Hz);
    seconds = bench::cpu_seconds() - start;
  } else {
    const auto blocks = signal::correlations(data, references, 2 * kBlockRows, task == "deviations" ? kBlocks : 1);
    const auto observability = identification::ssi_cov(blocks.mean(), kBlockRows, data.cols(), orders.back());
    const auto models = identification::shift_models(observability, orders, bench::kRecordRate_Hz);
    seconds = bench::cpu_seconds() - start;
    const double after = bench::cpu_seconds();
    if (task == "deviations") {
      // Standard deviations of every pole of every order, beyond the identification itself.
      const auto factors = identification::pole_factors(
          observability, models, identification::covariance_changes(blocks, kBlockRows, observability, models));
      seconds = bench::cpu_seconds() - after;
      if (factors.of.empty()) return 3;
    }
    const double before = bench::cpu_seconds();
    const auto modes = select(models);
    if (task == "clustering") seconds = bench::cpu_seconds() - before;
    if (modes.empty()) return 3;
  }
  const double megabytes = bench::peak_MB();
  judge(reported(), found, spurious);
  std::printf("%.3f %.0f %d %d\n", seconds, megabytes, found, spurious);
  return 0;
}
