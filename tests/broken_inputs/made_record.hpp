#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace twindeck::broken {

/// The sound record of the campaign's base: 3000 samples at 50 Hz of the channels A_x, B_x and C_z. White noise through two
/// oscillators of 2 Hz and 6 Hz with 1 % of damping; the channels' means are 11.5, 23 and 34.5, so
/// that exchanged channels are seen.
/// @return [m/s2] (3000 × 3)
[[nodiscard]] Eigen::MatrixXd sound_record();

/// Writes it. @param format  csv | npy | timed (NPY with the time of 50.4 Hz in its last column) | mat4 | mat5 | mat5z
/// (compressed) | mat73 | hdf5 | uff | uffb | frf | frfb
/// (frequency response functions of the oscillators, text or binary); as CSV with stamps of another kind: packets, late,
/// seconds, parts (all at 50.4 Hz), gap (of 250 samples in whole seconds), midnight, reversed; as CSV whose C_z is stuck, a
/// copy (of A_x), scaled (a copy times -2.5 plus 3) or slow; doubled (the second half is the first again)
/// @throws std::runtime_error  for another format or a file that cannot be written
void write_sound_record(const std::filesystem::path& file, const std::string& format);

}  // namespace twindeck::broken
