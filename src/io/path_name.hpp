#pragma once

#include <string>

namespace twindeck {
struct Place;
}

namespace twindeck::io {

/// Checks a name of the input (a condition, setup, stay, matrix …) that becomes part of a path below a step's folder. A name
/// with a slash, or "..", would let a step write elsewhere.
/// @param what   "condition", for the message
/// @param place  where the name stands
/// @throws InputError  unless the name has 1 to 100 bytes, none of them /, \ or a control character, and does not begin with a
/// point
void check_path_name(const std::string& name, const std::string& what, const Place& place);

/// Checks a name of the input that no path is made of here, but that a script may make one of: a channel. It may hold slashes,
/// as names in HDF5 files and of loggers do ("Dev1/ai0"), and must not lead out of the folder that it is put below.
/// @param what   "channel", for the message
/// @throws InputError  for a name that is empty, begins with a slash, has a part "." or "..", or holds a control character
void check_inner_name(const std::string& name, const std::string& what, const Place& place);

}  // namespace twindeck::io
