#pragma once

#include <filesystem>

#include "records/record.hpp"
#include "records/universal.hpp"

namespace twindeck::records {

/// Reads a universal file: sets 15, 55, 58, 58b, 82, 151, 164, 2411, 2412. Accepts what programs get wrong: a newline too many
/// before or after binary data, a byte count that is not that of the values, Fortran's D exponents, numbers that touch, sets
/// 151 and 164 left out, lines cut short. @param visit  gets the samples of sets 58 of time, a channel a set
/// @param keep_functions  true: the values of sets 58 that are no time series are kept in UniversalData::functions
/// @throws InputError  with file and line for a file that breaks off or a field that is no number
/// Reference: University of Cincinnati, Structural Dynamics Research Laboratory, "Universal File Datasets Summary".
UniversalData scan_universal_sets(const std::filesystem::path& file, const Visitor& visit, RecordInfo& info,
                                  bool keep_functions = false);

/// Whether the first set 58 of a file is a frequency response function or a coherence; spectra in text before it are passed
/// over. False for any other file, and for one that is not there.
[[nodiscard]] bool holds_frequency_responses(const std::filesystem::path& file);

/// The same contract as `scan` (record.hpp), for the time series of universal files.
RecordInfo scan_universal(const std::filesystem::path& file, const Visitor& visit);

}  // namespace twindeck::records
