#include "blind/form/form_trial.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "blind/form/diagnosis_numbers.hpp"
#include "blind/form/measurement.hpp"
#include "diagnosis/files/catalogue_files.hpp"
#include "diagnosis/law_diagnosis.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "test_places.hpp"

namespace twindeck::blind::form {

namespace {

using Eigen::Index;

constexpr double kLeastSigma = 6.0;  ///< a hidden cause that moves the rows by less is drawn anew
constexpr int kAttempts = 10;
/// Part of the form error that the main feature leaves alone, from which on it is a cause itself.
constexpr double kMainFeature = 1.0 / 3.0;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// True factors of the parameters: in the middle half of their bounds.
Eigen::VectorXd draw_factors(const Layout& layout, Stream& random) {
  Eigen::VectorXd factors(static_cast<Index>(layout.quantities.size()));
  for (Index q = 0; q < factors.size(); ++q) {
    const Quantity& quantity = layout.quantities[static_cast<std::size_t>(q)];
    factors[q] = std::exp(0.5 * random.between(std::log(quantity.lower), std::log(quantity.upper)));
  }
  return factors;
}

const std::vector<diagnosis::Hypothesis>& catalogue() {
  static const std::vector<diagnosis::Hypothesis> all =
      diagnosis::read_catalogue(std::string(TWINDECK_SOURCE_DIR) + "/workflows/common/hypotheses");
  return all;
}

std::vector<matching::Channel> channels_of(const Layout& layout) {
  std::vector<matching::Channel> channels;
  for (std::size_t c = 0; c < layout.channel_nodes.size(); ++c) {
    matching::Channel channel;
    channel.name = channel_name(layout, static_cast<int>(c));
    const Eigen::Vector2d& x = layout.nodes[static_cast<std::size_t>(layout.channel_nodes[c])];
    channel.x_m = Eigen::Vector3d(x.x(), 0.0, x.y());
    channel.direction = layout.direction == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    channels.push_back(channel);
  }
  return channels;
}

/// As step 9 makes it ready where nothing is configured.
diagnosis::ReductionOptions reduction_for(int modes) {
  diagnosis::ReductionOptions reduction;
  reduction.modes = 24;
  reduction.parameter_vectors = 60;
  reduction.least_correction = 2.5e-4;
  reduction.element_change = 0.1;
  reduction.corrected_modes = std::max(12, modes + 2);
  return reduction;
}

/// Whether an answer names the one feature of the form that leaves more than any other by itself, if it sits at one place and
/// leaves a third of the form error or more: that is a cause, though nobody hid it.
bool names_main_feature(const FormCase& hidden, const std::vector<std::string>& answers) {
  const auto& features = hidden.calibrated.form.features;
  if (answers.empty() || features.empty()) return false;
  const dynamics::LoadedModel loaded = dynamics::from_model(coarse_model(hidden.truth.layout));
  std::size_t main = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (const double alone = rms_of_feature_alone(loaded.system, hidden.truth, static_cast<int>(i)); alone > most) {
      most = alone;
      main = i;
    }
  if (!is_local(features[main].what) || most < kMainFeature * hidden.calibrated.reached) return false;
  const Sought sought = sought_of(hidden.truth.layout, features[main]);
  return std::any_of(answers.begin(), answers.end(),
                     [&](const std::string& a) { return names(hidden.truth.layout, sought, a); });
}

void score_size(const FormCase& hidden, const diagnosis::Diagnosis& result, FormScore& score) {
  if (hidden.hidden.size_name.empty() || result.effects.empty()) return;
  const diagnosis::Effect& first = result.effects.front();
  if (!names(hidden.truth.layout, hidden.hidden.sought, first.cluster.front())) return;
  for (const diagnosis::EffectParameter& p : first.parameters) {
    if (p.name != hidden.hidden.size_name) continue;
    score.sized = true;
    score.found_size = p.value;
    std::tie(score.low, score.high) = std::minmax(p.low, p.high);
    score.covered = score.size >= score.low && score.size <= score.high;
  }
}

bool is_complete(const diagnosis::Diagnosis& result) {
  const bool whole = std::all_of(result.effects.begin(), result.effects.end(), [](const diagnosis::Effect& effect) {
    return effect.cause.candidate != nullptr && !effect.cluster.empty() && !effect.sentence.empty();
  });
  return result.form && result.form->frequency.level > 0.0 && std::isfinite(result.form->gain.low) && !result.message.empty() &&
         whole;
}

}  // namespace

FormCase make_form_case(std::uint64_t seed, std::optional<double> level) {
  Stream random(seed);
  FormCase out;
  out.seed = seed;
  Turn turn = turn_of(seed);
  if (level) turn.level = *level;
  // 1. The structure, its true parameters, and a form error of the size that is asked for.
  out.truth.layout = draw_layout(turn.kind, random);
  out.truth.factors = draw_factors(out.truth.layout, random);
  const dynamics::LoadedModel loaded = dynamics::from_model(coarse_model(out.truth.layout));
  out.calibrated = calibrate(loaded.system, out.truth, turn.level, random);
  out.truth.form = out.calibrated.form;
  // 2. What happens to it: drawn anew while the rows hardly show it.
  const Eigen::VectorXd sound_Hz = measurable_modes(out.truth, {}).frequency_Hz;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Hidden drawn = draw_hidden(out.truth.layout, turn, sound_Hz, random);
    const double sigma = visibility(out.truth, drawn);
    if (attempt == 0 || sigma > out.sigma) {
      out.hidden = drawn;
      out.sigma = sigma;
    }
    if (sigma >= kLeastSigma || turn.category == Category::sound) break;
  }
  // 3. The measurement.
  out.features = rows_of(out.truth.layout, out.hidden, measure(out.truth, out.hidden), random);
  return out;
}

void score_answer(const FormCase& hidden, const diagnosis::Diagnosis& result, FormScore& score) {
  score.verdict = name_of(result.verdict);
  score.log_odds = result.log_odds;
  score.complete = is_complete(result);
  score.answered = result.verdict == diagnosis::Verdict::named || result.verdict == diagnosis::Verdict::ambiguous;
  std::vector<std::string> answers;
  for (const diagnosis::Effect& effect : result.effects) {
    answers.insert(answers.end(), effect.cluster.begin(), effect.cluster.end());
    for (std::size_t i = 0; i < effect.cluster.size(); ++i)
      score.found += (score.found.empty() ? "" : i == 0 ? " + " : " or ") + effect.cluster[i];
  }
  const bool something_else =
      std::any_of(answers.begin(), answers.end(), [](const std::string& a) { return a.starts_with("other@"); });
  score.reported = score.answered && !something_else;
  const auto right = [&](const std::string& a) { return names(hidden.truth.layout, hidden.hidden.sought, a); };
  score.in_set = std::any_of(answers.begin(), answers.end(), right);
  score.further =
      score.in_set && std::any_of(result.effects.begin(), result.effects.end(), [&](const diagnosis::Effect& effect) {
        return std::none_of(effect.cluster.begin(), effect.cluster.end(), right);
      });
  score.localised = names_main_feature(hidden, answers);
  if (result.form) {
    score.form_frequency = result.form->frequency.level;
    score.form_shape = result.form->shape.level;
    score.gain_low = result.form->gain.low;
    score.gain_claimed = !result.effects.empty() && result.form->gain.low > 0.0;
  }
  score_size(hidden, result, score);
}

FormScore prepare_score(const FormCase& hidden) {
  const Layout& layout = hidden.truth.layout;
  FormScore score;
  score.seed = hidden.seed;
  score.turn = hidden.hidden.turn;
  score.structure = name_of(layout.kind);
  score.words = hidden.hidden.words;
  score.reached = hidden.calibrated.reached;
  score.shape = hidden.calibrated.shape;
  score.least_mac = hidden.calibrated.least_mac;
  score.severity = hidden.calibrated.form.severity;
  score.sigma = hidden.sigma;
  score.size = hidden.hidden.size;
  score.modes = layout.modes;
  score.channels = static_cast<int>(layout.channel_nodes.size());
  score.conditions = static_cast<int>(hidden.features.conditions.size());
  score.rows = static_cast<int>(hidden.features.rows.size());
  return score;
}

void run_form_case(const FormCase& hidden, FormScore& score, const std::function<void(const diagnosis::Diagnosis&)>& look) {
  const Layout& layout = hidden.truth.layout;
  const double begin = cpu_seconds();
  constexpr double kTolerance_m = 0.5;  // of step 9
  const auto model = diagnosis::prepare_model(dynamics::from_model(coarse_model(layout)), channels_of(layout), kTolerance_m);
  const diagnosis::Structure structure = model->structure();
  const diagnosis::Places places = diagnosis::find_places(structure, {});
  const diagnosis::ReducedModel reduced(structure, places, reduction_for(layout.modes));
  const diagnosis::FeatureMap map(reduced, hidden.features, {});
  const diagnosis::Instantiated entries = diagnosis::instantiate(catalogue(), reduced, hidden.features);
  const diagnosis::Inference inference(map, entries.candidates);
  const diagnosis::Diagnosis result = diagnosis::diagnose(inference, {}, hidden.seed);
  score.seconds = cpu_seconds() - begin;
  score_answer(hidden, result, score);
  score.numbers = numbers_of(hidden.seed, result);
  if (look) look(result);
}

}  // namespace twindeck::blind::form
