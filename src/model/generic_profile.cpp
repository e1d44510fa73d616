#include "model/generic_profile_text.h"
#include "model/profile.h"

namespace raywise {

const Profile& generic_profile() {
    static const Profile profile = parse_profile(generic_profile_text); // source is generic by default
    return profile;
}

} // namespace raywise
