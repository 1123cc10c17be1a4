#include "blind/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "diagnosis/law_diagnosis.hpp"

namespace twindeck::blind {

namespace {

std::string magnitudes_of(const diagnosis::Candidate& candidate, const Eigen::VectorXd& a) {
  std::string text;
  for (Eigen::Index i = 0; i < a.size(); ++i) text += fmt::format("{}{:.4g}", i ? ", " : "", candidate.physical(a, i));
  return text;
}

}  // namespace

void explain(const diagnosis::Inference& inference, const Sealed& seal, int entries) {
  const auto t0 = std::chrono::steady_clock::now();
  const diagnosis::Fit base = inference.fit({}, {});
  const auto t1 = std::chrono::steady_clock::now();
  (void)inference.map().predict(inference.map().base(base.map.x * 1.01), {}, false);
  const auto t2 = std::chrono::steady_clock::now();
  (void)inference.map().predict(inference.map().base(base.map.x * 1.011), {}, true);
  const auto t3 = std::chrono::steady_clock::now();
  const auto ms = [](auto a, auto b) { return 1e3 * std::chrono::duration<double>(b - a).count(); };
  fmt::print("base fit {:.1f} ms {} it, predict {:.1f} ms, with jacobian {:.1f} ms\n", ms(t0, t1), base.map.iterations,
             ms(t1, t2), ms(t2, t3));
  fmt::print("{}\nwithout a cause: chi2 {:.1f} of {} dof\n", seal.text(), base.chi_squared, inference.dof());
  const diagnosis::ResidualTest test = diagnosis::residual_test(inference, base);
  for (std::size_t i = 0; i < std::min<std::size_t>(test.blocks.size(), 4); ++i)
    fmt::print("  not expected: {} ({} rows), statistic {:.1f} of {} dof, p {:.2g}\n", test.blocks[i].name, test.blocks[i].rows,
               test.blocks[i].statistic, test.blocks[i].dof, test.blocks[i].p_value);
  const diagnosis::Diagnosis result = diagnosis::diagnose(inference, {}, seal.seed);
  const std::vector<diagnosis::Scored>& ranking = result.ranking;
  int place = 0, shown = 0;
  const auto is_truth = [&](const diagnosis::Candidate& candidate) {
    for (std::size_t i = 0; i < seal.families.size(); ++i)
      if (candidate.id() == seal.families[i] + "@" + seal.locations[i]) return true;
    return false;
  };
  for (const diagnosis::Scored& scored : ranking) {
    ++place;
    const bool truth = is_truth(*scored.candidate);
    if (shown >= entries && !truth) continue;
    ++shown;
    std::string after = "not fitted";
    if (scored.fitted) {  // what a fit of everything from here leaves, refined or not
      const auto begin = std::chrono::steady_clock::now();
      const diagnosis::Fit with = inference.fit({{scored.candidate, scored.a}}, base.map.x);
      fmt::print("[{} it {:.3f} s] ", with.map.iterations,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      after =
          fmt::format("joint fit chi2 {:.1f} at ({}){}", with.chi_squared, magnitudes_of(*scored.candidate, with.causes[0].a),
                      with.map.status.converged ? "" : " NOT CONVERGED");
    }
    fmt::print("{}{:>4} {:<28} {} screen {:>7.1f} odds {:>7.1f} chi2 {:>7.1f} at ({}); {}\n", truth ? "*" : " ", place,
               scored.candidate->id(), scored.fitted ? "fitted" : "screened", scored.screen, scored.log_odds, scored.remaining,
               magnitudes_of(*scored.candidate, scored.a), after);
  }
  for (const auto& candidate : inference.candidates()) {
    if (!is_truth(*candidate)) continue;
    const diagnosis::Cause cause = cause_of(*candidate, seal);
    for (const bool from_base : {true, false}) {
      const diagnosis::Fit with = inference.fit({cause}, from_base ? base.map.x : Eigen::VectorXd());
      fmt::print("from the truth's own magnitudes and x of {}: {} chi2 {:.1f} at ({})\n", from_base ? "the base" : "the prior",
                 candidate->id(), with.chi_squared, magnitudes_of(*candidate, with.causes[0].a));
    }
  }
}

}  // namespace twindeck::blind
