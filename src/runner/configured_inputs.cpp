#include "runner/configured_inputs.hpp"

namespace twindeck::runner {
namespace fs = std::filesystem;

ConfiguredInputs::ConfiguredInputs(Step& step) {
  for (const std::string& name : step.configured_inputs) {
    const bool is_model = name == "model";
    TWINDECK_ASSERT(is_model || name == "campaign");
    step.fields.text(name, is_model ? model_ : campaign_,
                     std::string(is_model ? "model folder (or .inp file)" : "campaign folder (raw records)") +
                         " to work on, unless --" + name + " names another; {results} stands for the folder of --results");
  }
}

void ConfiguredInputs::apply(const Step& step, StepContext& context) const {
  const auto set = [&](const char* name, const std::string& configured, std::optional<fs::path>& folder) {
    if (folder || configured.empty()) return;
    const fs::path path = context.resolved(configured);
    if (!fs::exists(path)) {
      throw InputError(step.fields.place_of(name).value_or(Place{"", 0, name}),
                       "is '" + path.string() + "', which is not there",
                       std::string("run the step or the script that writes it, or give --") + name + " DIR");
    }
    folder = path;
  };
  set("model", model_, context.model);
  set("campaign", campaign_, context.campaign);
}

}  // namespace twindeck::runner
