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
    // A sheared coordinate is wrong by at most corner_error + corner_error_slope M, with M the largest coordinate of a corner relative
    // to the origin, sheared or along z.
    float corner_error;
    float corner_error_slope = 0.0f;
};

} // namespace raywise
