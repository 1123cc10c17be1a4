#include "diagnosis/mode_blocks.hpp"

#include <map>
#include <string>

namespace twindeck::diagnosis {

namespace {

constexpr int kFewestBlocks = 3;  // blocks, for resampling

}  // namespace

std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition) {
  const FormModes modes = plain.map().form_modes(fit.base, fit.causes);
  std::map<int, int> place;  // position of a row among the training rows
  for (std::size_t r = 0; r < plain.training().size(); ++r) place[plain.training()[r]] = static_cast<int>(r);
  std::map<std::string, std::vector<int>> blocks;
  for (std::size_t m = 0; m < modes.paired.size(); ++m) {
    const MeasuredMode& mode = plain.map().measured_modes()[m];
    std::string name = modes.paired[m].model_mode >= 0 ? std::to_string(modes.paired[m].model_mode) : "label " + mode.label;
    if (by_condition) name += " in " + std::to_string(mode.condition);
    std::vector<int>& block = blocks[name];
    std::vector<int> rows = mode.real_rows;
    rows.insert(rows.end(), mode.imag_rows.begin(), mode.imag_rows.end());
    rows.push_back(mode.frequency);
    rows.push_back(mode.damping);
    for (const int r : rows)
      if (const auto at = place.find(r); at != place.end()) block.push_back(at->second);
  }
  std::vector<std::vector<int>> out;
  for (auto& [name, block] : blocks)
    if (!block.empty()) out.push_back(std::move(block));
  return std::ssize(out) < kFewestBlocks && !by_condition ? mode_blocks(plain, fit, true) : out;
}

}  // namespace twindeck::diagnosis
