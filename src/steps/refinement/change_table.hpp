#pragma once

#include <filesystem>

#include "ponte/change_study.hpp"

namespace twindeck::steps {

/// changes.csv: `change,paper_item,meaning,mode,frequency_before_Hz,frequency_alone_Hz,effect_alone_pct,effect_cumulative_pct,
/// mac_alone,mac_cumulative`. Effects are relative to the preliminary model; cumulative: this change and all before it.
/// mac_cumulative is the one with the state before.
void write_changes(const ponte::ChangeStudy& study, const std::filesystem::path& folder);

}  // namespace twindeck::steps
