// calibration/profiles/generic.json, embedded when the library is built.
#pragma once

namespace raywise {

extern const char* const generic_profile_text;

} // namespace raywise
