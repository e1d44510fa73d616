// What is known of a scene before anything is built: numbers that costs grow with.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace raywise {

// Cells are those of a uniform grid with four cells per triangle, lines those that meet the box of the scene, any of them alike.
struct SceneFeatures {
    double triangles = 0.0;  // that can be hit
    double boxes = 0.0;      // of triangles, that a line meets
    double cells = 0.0;      // that a line crosses
    double filled = 0.0;     // of those, that hold a triangle
    double crowding = 0.0;   // how many triangles there are around a triangle, in the cell of its middle
    double references = 0.0; // cells that the box of a triangle reaches into
};

// For all that reads, writes or shows them.
struct SceneFeature {
    const char* name;
    double SceneFeatures::*value;
};
inline constexpr std::array scene_features = {
    SceneFeature{"triangles", &SceneFeatures::triangles}, SceneFeature{"boxes", &SceneFeatures::boxes},
    SceneFeature{"cells", &SceneFeatures::cells},         SceneFeature{"filled", &SceneFeatures::filled},
    SceneFeature{"crowding", &SceneFeatures::crowding},   SceneFeature{"references", &SceneFeatures::references},
};

inline constexpr double feature_cells_per_triangle = 4.0;

// A closed surface of triangles of about one size, like that of a scanned object: for where a look at the triangles would cost more than it
// can save. As measured on bumpy_sphere of calibration/scenes, 100 to 500,000 triangles.
inline SceneFeatures typical_features(std::uint64_t triangles) {
    const double n = static_cast<double>(triangles);
    if (triangles == 0) return {};
    const double root = std::cbrt(n);
    SceneFeatures features;
    features.triangles = n;
    features.boxes = 5.0;
    features.cells = std::cbrt(feature_cells_per_triangle) * root;
    features.crowding = 1.0 + 0.25 * root;
    features.references = 2.0 + 40.0 / root;
    features.filled =
        features.cells * std::fmin(1.0, features.references / (feature_cells_per_triangle * features.crowding));
    return features;
}

} // namespace raywise
