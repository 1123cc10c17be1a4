#pragma once

#include <filesystem>
#include <string>

namespace twindeck::broken {

/// Applies one change to the input that lies in `folder`. Words as in split_words; FILE is relative to the folder, lines and
/// data rows count from 1 (row 1 is the line below the header).
///
///     set FILE ROW COLUMN VALUE     a cell of a CSV file; ROW may be * for all
///     rename FILE COLUMN NEW        a column's name
///     drop FILE COLUMN              a column with its cells
///     add FILE COLUMN VALUE         a column with one value in all rows
///     line FILE N TEXT              line N becomes TEXT
///     insert FILE N TEXT            TEXT becomes line N, what stood there follows
///     remove FILE N                 line N goes
///     append FILE TEXT              bytes at the end
///     repeat FILE COUNT TEXT        the same bytes COUNT times at the end
///     replace FILE BEFORE AFTER     the first place that reads BEFORE
///     replace_all FILE BEFORE AFTER every place
///     cut FILE BYTES                keeps so many bytes; -N drops the last N
///     utf16 FILE                    its ASCII letters as UTF-16 with a mark
///     bytes FILE OFFSET TEXT        overwrites bytes; -N counts from the end
///     write FILE TEXT               a file of this text and no other
///     delete FILE                   a file or folder goes
///     folder FILE                   an empty folder stands in its place
///     link FILE TARGET              a symbolic link stands in its place
///     pipe FILE                     a named pipe that nobody writes to
///     copy FILE TO                  a second file or folder of the same content
///     record FILE FORMAT            the sound record (made_record.hpp) in csv, npy, mat4, mat5, mat5z, mat73, hdf5, uff,
///                                   uffb …
///     covariance FILE ROWS STD      an NPY matrix: STD squared on the diagonal
///     element FILE ROW COLUMN VALUE an element of an NPY matrix of float64 in C order
///
/// @throws std::runtime_error  for a change that cannot be made or changes nothing: a case must not pass because it did nothing
void apply_change(const std::filesystem::path& folder, const std::string& change);

}  // namespace twindeck::broken
