// What float32 tests of triangles need of a ray, in the coordinates of a SceneFrame: as the members of PreparedRay; z is the major axis.
#pragma once

namespace raywise {

struct TriangleRay {
    int x_axis;
    int y_axis;
    int z_axis;
    float origin_x;
    float origin_y;
    float origin_z;
    float shear_x;
    float shear_y;
    float inverse_z;
    float corner_error; // of a sheared coordinate, at most
};

} // namespace raywise
