#include "blind/records.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "core/random.hpp"
#include "diagnosis/features/same_modes.hpp"
#include "diagnosis/law_diagnosis.hpp"
#include "identification/identification.hpp"

namespace twindeck::blind {

namespace {

using diagnosis::Row;
using diagnosis::RowType;
using Eigen::Index;

struct Identified {
  Eigen::VectorXd hertz;
  Eigen::MatrixXcd shapes;  ///< (n_channels × n_modes) largest entry 1, as real as it can be
  std::vector<double> damping, hertz_std, damping_std;
  std::vector<Eigen::VectorXd> real_std, imag_std;
};

Identified identify(const Bench& bench, const Eigen::MatrixXd& record, double rate_Hz) {
  identification::IdentificationSettings config;
  config.block_rows = 50;  // 5 s: three periods of the lowest mode
  config.maximum_order = 60;
  config.lowest_Hz = 0.3;
  config.highest_Hz = 0.4 * rate_Hz;
  identification::Conditioned conditioned;
  for (const matching::Channel& channel : bench.channels) {
    records::CampaignChannel one;
    one.name = channel.name;
    one.point = channel.point;
    one.direction = channel.direction;
    conditioned.channels.push_back(one);
  }
  for (const Index reference : {0, 1, 4, 5, 8, 9, 12, 13}) conditioned.references.push_back(reference);
  conditioned.records = {record};
  conditioned.rate_Hz = rate_Hz;
  const identification::Identification found = identification::identify_modes(conditioned, config);
  Identified out;
  const auto n = static_cast<Index>(found.modes.size());
  out.hertz.resize(n);
  out.shapes.resize(record.cols(), n);
  for (Index m = 0; m < n; ++m) {
    const auto k = static_cast<std::size_t>(m);
    const identification::Cluster& mode = found.modes[k];
    const identification::ModeDeviation& deviation = found.deviations[k];
    out.hertz[m] = mode.frequency_Hz;
    out.damping.push_back(mode.damping_ratio);
    out.hertz_std.push_back(deviation.frequency_Hz);
    out.damping_std.push_back(deviation.damping_ratio);
    const double largest = mode.shape.cwiseAbs().maxCoeff();
    out.shapes.col(m) = mode.shape / largest;
    out.real_std.emplace_back(deviation.shape_real / largest);
    out.imag_std.emplace_back(deviation.shape_imag / largest);
  }
  return out;
}

}  // namespace

diagnosis::FeatureSet identified_rows(const Bench& bench, const Campaign& campaign) {
  diagnosis::FeatureSet f;
  f.channels = bench.rows.channels;
  f.direction = bench.rows.direction;
  f.conditions = campaign.conditions;
  // As many modes of each condition as the bench's campaign has, shapes where it has shapes.
  std::vector<std::map<std::string, bool>> wanted(f.conditions.size()), shaped(f.conditions.size()),
      turned(f.conditions.size());
  double highest = 0.0;
  for (const Row& row : bench.rows.rows) {
    const auto c = static_cast<std::size_t>(row.condition);
    if (row.type == RowType::frequency) wanted[c][row.mode] = true;
    if (row.type == RowType::frequency && c == 0) highest = std::max(highest, 1.06 * row.value);
    if (row.type == RowType::shape) shaped[c][row.mode] = true;
    if (row.type == RowType::shape_imag) turned[c][row.mode] = true;
  }
  Identified reference;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < campaign.records.size(); ++c) {
    const Identified found = identify(bench, campaign.records[c], campaign.rate_Hz);
    if (c == 0) reference = found;
    const auto same = diagnosis::same_modes(reference.hertz, reference.shapes, found.hertz, found.shapes);
    const auto condition = static_cast<int>(c);
    for (Index m = 0; m < found.hertz.size(); ++m) {
      const auto k = static_cast<std::size_t>(m);
      const int label = c == 0 ? static_cast<int>(m) : same[k];
      if (label < 0 || found.hertz[m] > 1.3 * highest || reference.hertz[label] > highest) continue;
      const std::string name = std::to_string(label + 1);
      if (!wanted[c].contains(name)) continue;
      f.rows.push_back({RowType::frequency, name, -1, "", condition, found.hertz[m], found.hertz_std[k], false});
      f.rows.push_back(
          {RowType::damping, name, -1, "", condition, 100.0 * found.damping[k], 100.0 * found.damping_std[k], false});
      for (Index ch = 0; ch < found.shapes.rows(); ++ch) {
        if (shaped[c].contains(name))
          f.rows.push_back({RowType::shape, name, static_cast<int>(ch), "", condition, found.shapes(ch, m).real(),
                            std::max(found.real_std[k][ch], 1e-6), false});
        if (turned[c].contains(name))
          f.rows.push_back({RowType::shape_imag, name, static_cast<int>(ch), "", condition, found.shapes(ch, m).imag(),
                            std::max(found.imag_std[k][ch], 1e-6), false});
      }
    }
  }
  for (std::size_t c = 0; c < f.conditions.size(); ++c) {
    const std::string& name = f.conditions[c].name;
    double top = 0.0;
    std::string last;
    for (const Row& row : f.rows)
      if (row.type == RowType::frequency && row.condition == static_cast<int>(c) && row.value > top) {
        top = row.value;
        last = row.mode;
      }
    for (Row& row : f.rows)
      if (row.condition == static_cast<int>(c))
        row.held_out = name == "on_large" || name == "hot" || (c < 2 && row.mode == last);
  }
  return f;
}

Score run_records(const Bench& bench, const Hidden& hidden, const Campaign& campaign) {
  const auto begin = std::chrono::steady_clock::now();
  const diagnosis::FeatureSet rows = identified_rows(bench, campaign);
  std::vector<diagnosis::Hypothesis> catalogue;
  for (const diagnosis::Hypothesis& h : bench.catalogue)
    if (h.id != hidden.removed) catalogue.push_back(h);
  const diagnosis::Instantiated entries = diagnosis::instantiate(catalogue, *bench.diagnosing.reduced, rows);
  const diagnosis::FeatureMap map(*bench.diagnosing.reduced, rows, bench.scatter);
  const diagnosis::Inference inference(map, entries.candidates);
  const diagnosis::Diagnosis result = diagnosis::diagnose(inference, {}, hidden.seal.seed);
  return score_of(hidden.seal, result, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

}  // namespace twindeck::blind
