#pragma once

#include "diagnosis/diagnose.hpp"

namespace twindeck::diagnosis {

/// Diagnosis of a model whose form may be wrong. A form error that all conditions share competes with every cause. Its scales
/// are summed over under each hypothesis, and the rules of decision 0013 give the verdict.
[[nodiscard]] Diagnosis diagnose_with_form(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed);

}  // namespace twindeck::diagnosis
