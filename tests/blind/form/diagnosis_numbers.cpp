#include "blind/form/diagnosis_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace twindeck::blind::form {

namespace {

constexpr std::size_t kHeldEntries = 12;   ///< of the ranking, the first ones
constexpr std::size_t kHeldBlocks = 4;     ///< of the residual test, the least likely
constexpr std::size_t kHeldLocations = 4;  ///< the strongest

void add_fit(HeldNumbers& out, const std::string& of, const diagnosis::Fit& fit) {
  if (!fit.made()) return;
  out.add(of + " chi squared", fit.chi_squared);
  out.add(of + " log determinant", fit.log_determinant);
  out.add(of + " estimate", fit.map.x);
  out.add(of + " prediction", fit.all.g);
  out.add(of + " whitened", fit.whitened);
  for (const diagnosis::Cause& cause : fit.causes) out.add(of + " " + cause.candidate->id(), cause.a);
}

void add_effects(HeldNumbers& out, const diagnosis::Diagnosis& result) {
  for (std::size_t e = 0; e < result.effects.size(); ++e) {
    const diagnosis::Effect& effect = result.effects[e];
    std::string name = fmt::format("cause {}", e + 1);
    for (const std::string& member : effect.cluster) name += " " + member;
    out.add(name + " log odds", effect.log_odds);
    out.add(name + " probability", effect.probability);
    for (const diagnosis::EffectParameter& p : effect.parameters) {
      out.add(name + " " + p.name, p.value);
      out.add(name + " " + p.name + " low", p.low);
      out.add(name + " " + p.name + " high", p.high);
    }
    for (const diagnosis::Rival& rival : effect.rivals) out.add(name + " rival " + rival.id, rival.probability);
  }
}

void add_ranking(HeldNumbers& out, const std::vector<diagnosis::Scored>& ranking) {
  for (std::size_t i = 0; i < std::min(kHeldEntries, ranking.size()); ++i) {
    const diagnosis::Scored& scored = ranking[i];
    const std::string name = fmt::format("entry {} {}", i + 1, scored.candidate->id());
    out.add(name + " screen", scored.screen);
    out.add(name + " log odds", scored.log_odds);
    out.add(name + " remaining", scored.remaining);
    out.add(name + " magnitudes", scored.a);
  }
}

void add_form(HeldNumbers& out, const diagnosis::FormReport& form) {
  for (const auto& [name, scale] : {std::pair{"frequency", &form.frequency}, std::pair{"shape", &form.shape}}) {
    out.add(fmt::format("form {} level", name), scale->level);
    out.add(fmt::format("form {} low", name), scale->low);
    out.add(fmt::format("form {} high", name), scale->high);
  }
  out.add("form gain", form.gain.log_gain);
  out.add("form gain low", form.gain.low);
  out.add("form gain reduction_pct", form.gain.reduction_pct);
  out.add("form gain high_pct", form.gain.high_pct);
}

}  // namespace

std::vector<HeldNumber> numbers_of(std::uint64_t seed, const diagnosis::Diagnosis& result) {
  HeldNumbers out(seed);
  out.add("verdict " + std::string(name_of(result.verdict)) + " log odds", result.log_odds);
  out.add("threshold", result.threshold);
  out.add("residual", result.residual.statistic);
  out.add("residual dof", result.residual.dof);
  out.add("residual block p value", result.residual.block_p_value);
  for (std::size_t b = 0; b < std::min(kHeldBlocks, result.residual.blocks.size()); ++b)
    out.add("residual of " + result.residual.blocks[b].name, result.residual.blocks[b].statistic);
  for (std::size_t l = 0; l < std::min(kHeldLocations, result.localisation.size()); ++l)
    out.add("location " + result.localisation[l].location, result.localisation[l].score);
  out.add("gain before", result.gain.before);
  out.add("gain after", result.gain.after);
  out.add("gain low_pct", result.gain.low_pct);
  out.add("gain high_pct", result.gain.high_pct);
  add_effects(out, result);
  add_fit(out, "before", result.before);
  add_fit(out, "after", result.after);
  add_ranking(out, result.ranking);
  if (result.form) add_form(out, *result.form);
  return out.all();
}

}  // namespace twindeck::blind::form
