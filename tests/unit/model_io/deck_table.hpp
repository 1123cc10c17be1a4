#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

/// Frequencies of a deck beside the known ones.
namespace twindeck::model_io::test {

struct KnownDeck {
  std::string program, deck, from;  ///< from: where the known frequencies come from
  double tolerance = 0.0;           ///< [-]
  std::string remark = {};  ///< what explains a tolerance beyond 1 % (beams, solids) or 2 % (shells), or a mode left out
};

/// One line a mode into the file that TWINDECK_DECK_TABLE names (`make decks`), if it names one.
inline void enter_in_deck_table(const KnownDeck& of, const std::vector<double>& found_Hz, const std::vector<double>& known_Hz) {
  const char* table = std::getenv("TWINDECK_DECK_TABLE");
  if (table == nullptr) return;
  const bool fresh = !std::filesystem::exists(table);
  std::ofstream stream(table, std::ios::app);
  if (fresh) stream << "program,deck,mode,known_Hz,found_Hz,difference_pct,allowed_pct,known_from,remark\n";
  for (std::size_t i = 0; i < known_Hz.size(); ++i)
    stream << fmt::format("\"{}\",\"{}\",{},{:.7g},{:.7g},{},{:.4g},\"{}\",\"{}\"\n", of.program, of.deck, i + 1, known_Hz[i],
                          found_Hz[i],
                          known_Hz[i] > 0.0 ? fmt::format("{:.4g}", 100.0 * (found_Hz[i] / known_Hz[i] - 1.0)) : "",
                          100.0 * of.tolerance, of.from, of.remark);
}

/// Every known frequency is met within the tolerance; a known 0 is a rigid motion. Prints the largest difference.
inline void expect_known_frequencies(const KnownDeck& of, const std::vector<double>& found_Hz,
                                     const std::vector<double>& known_Hz) {
  constexpr double rigid = 1e-3;  ///< [-] of the highest known frequency: below, a motion counts as rigid
  ASSERT_GE(found_Hz.size(), known_Hz.size()) << of.deck;
  enter_in_deck_table(of, found_Hz, known_Hz);
  double worst = 0.0;
  for (std::size_t i = 0; i < known_Hz.size(); ++i) {
    if (!(known_Hz[i] > 0.0)) {
      EXPECT_LT(found_Hz[i], rigid * known_Hz.back()) << of.deck << " mode " << i + 1;
      continue;
    }
    const double off = found_Hz[i] / known_Hz[i] - 1.0;
    if (std::abs(off) > std::abs(worst)) worst = off;
    EXPECT_LE(std::abs(off), of.tolerance) << of.deck << " mode " << i + 1 << ": " << found_Hz[i] << " Hz, known "
                                           << known_Hz[i];
  }
  std::cout << fmt::format("{} {}: {} modes, largest difference {:+.3g} %, allowed {:g} %\n", of.program, of.deck,
                           known_Hz.size(), 100.0 * worst, 100.0 * of.tolerance);
}

}  // namespace twindeck::model_io::test
