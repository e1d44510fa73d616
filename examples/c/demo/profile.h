/* The calibration profile: what structures cost on this machine. */
#ifndef DEMO_PROFILE_H
#define DEMO_PROFILE_H

#include "api.h"
#include "args.h"

/* Loads the profile that the decisions are made with, measuring the machine first when it was never measured and
 * args say how. Prints which one it is. The caller releases it. A profile that cannot be used is not a failure:
 * decisions are then made with the next valid one's or with generic constants. */
bool profile_get(const struct api *api, const struct args *args, rw_profile **profile);

/* "generic constants", "user's cache folder" ... */
const char *profile_source(int32_t source);

#endif
