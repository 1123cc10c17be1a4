#pragma once

#include "identification/identification.hpp"

/// Modes of a hammer or shaker test from its frequency response functions.
namespace twindeck::identification {

/// Reads the frequency response functions of one setup and cuts them to the band of the configuration (band.lowest,
/// band.highest).
/// @return  `responses`, channels, references and notes; no records
/// @throws InputError  as read_frequency_responses; for an unknown channel in `exclude` or `references`, and for fewer than 40
///         lines in the band
[[nodiscard]] Conditioned condition_responses(const records::Campaign& campaign, const records::RecordGroup& group,
                                              const IdentificationSettings& config);

/// Stabilisation diagram by pLSCF (plscf.hpp), selection as for records, then the modal model of the selected modes
/// (modal_fit.hpp) for frequency, damping, shape and their standard deviations, which come from the residuals of the fit. Of
/// modes that the functions do not determine the worst is dropped and the others are fitted again, until each is determined:
/// its frequency to a share of its half bandwidth (IdentifyOptions::largest_bandwidth_share), its damping ratio beyond noise,
/// its half-power band within the lines. Where maximum_order was not configured, orders go to 120 in steps of twice order_step.
/// Lines and references may lower them.
/// @param conditioned  from condition_responses @return shapes of the points of the shape, in their order
[[nodiscard]] Identification identify_responses(const Conditioned& conditioned, const IdentificationSettings& config);

/// Scale of each channel in the poles' shapes: its RMS over lines and other sides, each of which was brought to unit RMS first.
[[nodiscard]] Eigen::VectorXd response_scale(const records::FrequencyResponses& responses);

/// Squares of the singular values of H(f), line by line (complex mode indicator function), channels scaled to unit RMS. Empty
/// for lines at uneven distances.
[[nodiscard]] SingularSpectra response_spectra(const records::FrequencyResponses& responses);

}  // namespace twindeck::identification
