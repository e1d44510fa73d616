#include "rays/visible_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace raywise::workloads {
namespace {

// Of an image in which less than one pixel in 32 is covered, points are used more than once.
constexpr std::uint64_t most_pixels_per_ray = 32;

VisiblePoints seen_by(const RayRequest& request, std::uint64_t pixels) {
    RayRequest image = request;
    image.count = pixels;
    const Rays rays = camera_rays(image);
    const std::vector<SurfacePoint> hits = request.closest(rays);
    VisiblePoints points;
    for (std::uint64_t i = 0; i < rays.size(); ++i) {
        if (!std::isfinite(hits[i].t)) continue;
        const Vec3 along = rays.direction_of(i);
        points.position.push_back(rays.origin_of(i) + along * hits[i].t);
        points.normal.push_back(glm::dot(hits[i].normal, along) > 0.0 ? -hits[i].normal : hits[i].normal);
    }
    return points;
}

} // namespace

VisiblePoints visible_points(const RayRequest& request) {
    if (!request.closest) throw std::invalid_argument("rays that start on surfaces need a tracer");
    VisiblePoints points;
    if (request.count == 0) return points;
    // A sparse image tells which part of it is covered, so that the real one is drawn about once; within reason, where
    // hardly anything is in view.
    const std::uint64_t trial = std::min<std::uint64_t>(request.count, 1024);
    const std::size_t covered = std::max<std::size_t>(seen_by(request, trial).position.size(), 1);
    const std::uint64_t most = request.count * most_pixels_per_ray;
    std::uint64_t pixels = std::min(request.count * trial / covered + 16, most);
    for (;; pixels = std::min(pixels + pixels / 8 + 64, most)) {
        points = seen_by(request, pixels);
        if (points.position.size() >= request.count || pixels >= most || points.position.empty()) break;
    }
    // Too many are thinned out evenly, so that the whole image stays covered. Too few go round again.
    const std::size_t found = points.position.size();
    if (found == 0) return points;
    VisiblePoints result;
    for (std::uint64_t i = 0; i < request.count; ++i) {
        const std::size_t k = found >= request.count ? static_cast<std::size_t>(i * found / request.count) : i % found;
        result.position.push_back(points.position[k]);
        result.normal.push_back(points.normal[k]);
    }
    return result;
}

} // namespace raywise::workloads
