// What the camera sees, for rays that start there.
#pragma once

#include "rays/rays.h"

namespace raywise::workloads {

struct VisiblePoints {
    std::vector<Vec3> position;
    std::vector<Vec3> normal; // towards the camera
};

// So many points in image order; the image is made finer until it has them. Empty when nothing is in view.
VisiblePoints visible_points(const RayRequest& request);

} // namespace raywise::workloads
