#include "steps/wind/turbulence_files.hpp"

#include <algorithm>
#include <map>

#include "aero/files/turbulence_files.hpp"

namespace twindeck::steps {

wind::TurbulenceSet read_turbulence(const ValidationConfig& config, runner::StepContext& context) {
  wind::TurbulenceSet set = aero::read_turbulence_set(context.input(config.turbulence_file), config.turbulence_set);
  static const std::map<std::string, wind::SpectrumLaw> laws = {{"von_karman", wind::SpectrumLaw::von_karman},
                                                                {"kaimal", wind::SpectrumLaw::kaimal},
                                                                {"en_1991_1_4", wind::SpectrumLaw::en_1991_1_4},
                                                                {"table", wind::SpectrumLaw::table}};
  for (wind::Spectrum& spectrum : set.spectrum) spectrum.law = laws.at(config.spectrum);
  if (!config.spectrum_file.empty()) {
    const auto tables = aero::read_spectra(context.input(config.spectrum_file), config.components());
    for (std::size_t c = 0; c < tables.size(); ++c) set.spectrum[c].table = tables[c];
  }
  if (!config.coherence_file.empty())
    set.coherence = aero::read_coherences(context.input(config.coherence_file), config.components());
  if (config.coherence == "davenport")
    for (wind::PerComponent& decay : set.decay) decay.fill(config.davenport_decay);
  const auto stated = [&set](wind::Component component, const std::vector<double>& decay) {
    if (!decay.empty()) std::copy(decay.begin(), decay.end(), set.decay[static_cast<std::size_t>(component)].begin());
  };
  stated(wind::Component::along, config.decay_v);
  stated(wind::Component::across, config.decay_u);
  stated(wind::Component::vertical, config.decay_w);
  return set;
}

}  // namespace twindeck::steps
