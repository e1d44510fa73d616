#include "fuzz/rays.h"

#include <cmath>
#include <cstdio>

namespace raywise::fuzz {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A point that matters: a corner, the middle of an edge or of a triangle, or one of the lattice.
Point make_target(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes) {
    const Point anywhere = {input.lattice(), input.lattice(), input.lattice()};
    if (meshes.empty()) return anywhere;
    const Mesh& mesh = *meshes[input.below(meshes.size())];
    if (mesh.corners().empty()) return anywhere;
    const auto& corners = mesh.corners()[input.below(mesh.corners().size())];
    for (const std::uint64_t corner : corners) {
        if (corner >= mesh.vertices().size()) return anywhere;
    }
    const Point& a = mesh.vertices()[corners[0]];
    const Point& b = mesh.vertices()[corners[1]];
    const Point& c = mesh.vertices()[corners[2]];
    Point p = a;
    switch (input.below(4)) {
        case 1:
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = 0.5 * b[axis] + 0.5 * c[axis];
            break;
        case 2:
            for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (a[axis] + b[axis] + c[axis]) / 3.0;
            break;
        case 3:
            p = b;
            break;
        default:
            break;
    }
    return p;
}

} // namespace

rw_ray make_ray(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes) {
    rw_ray ray{};
    Point origin = make_target(input, meshes);
    if (input.one_in(2)) origin = {input.coordinate(), input.coordinate(), input.coordinate()};
    Point direction{};
    switch (input.below(6)) {
        case 0: // along an axis
            direction[input.below(3)] = input.one_in(2) ? -1.0 : 1.0;
            break;
        case 1:
            direction = {input.lattice(), input.lattice(), input.lattice()};
            break;
        case 2:
            direction = {input.coordinate(), input.coordinate(), input.coordinate()};
            break;
        default: {
            const Point target = make_target(input, meshes);
            for (std::size_t axis = 0; axis < 3; ++axis) direction[axis] = target[axis] - origin[axis];
            break;
        }
    }
    if (input.one_in(6)) { // far away, and tiny or huge directions
        const double scale = std::ldexp(1.0, input.between<int>(-1060, 1020));
        for (double& x : direction) x *= scale;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = origin[axis];
        ray.direction[axis] = direction[axis];
    }
    ray.tmax = infinity;
    if (input.one_in(4)) ray.tmin = input.number();
    if (input.one_in(4)) ray.tmax = input.number();
    if (input.one_in(16)) (input.one_in(2) ? ray.origin : ray.direction)[input.below(3)] = input.number();
    return ray;
}

Skips make_skips(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes) {
    Skips skips;
    for (std::size_t left = input.below(4); left > 0 && !meshes.empty(); --left) {
        const auto geometry = static_cast<std::uint32_t>(input.below(meshes.size()));
        const std::uint64_t triangles = meshes[geometry]->triangle_count();
        const bool nothing = triangles == 0 || input.one_in(4);
        skips.push_back(
            {RW_INVALID_ID, geometry,
             nothing ? RW_INVALID_ID : static_cast<std::uint32_t>(input.below(static_cast<std::size_t>(triangles)))});
    }
    return skips;
}

bool has_nan(const rw_ray& ray) {
    bool found = std::isnan(ray.tmin) || std::isnan(ray.tmax);
    for (int axis = 0; axis < 3; ++axis)
        found = found || std::isnan(ray.origin[axis]) || std::isnan(ray.direction[axis]);
    return found;
}

void describe(const rw_ray& ray) {
    std::fprintf(stderr, "  ray {{%a, %a, %a}, %a, {%a, %a, %a}, %a}\n", ray.origin[0], ray.origin[1], ray.origin[2],
                 ray.tmin, ray.direction[0], ray.direction[1], ray.direction[2], ray.tmax);
}

RayBatch::RayBatch(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes) {
    std::uint64_t count = input.below(12);
    if (input.one_in(16)) count = 250 + input.below(300); // more than one thread's share
    std::vector<rw_ray> wanted;
    for (std::uint64_t i = 0; i < count; ++i) {
        wanted.push_back(i < 16 ? make_ray(input, meshes) : wanted[i % 16]);
    }
    origin_ = InputArray::numbers(input, count, 3, [&](std::uint64_t i, int c) { return wanted[i].origin[c]; });
    direction_ = InputArray::numbers(input, count, 3, [&](std::uint64_t i, int c) { return wanted[i].direction[c]; });
    if (input.one_in(2))
        tmin_ = InputArray::numbers(input, count, 1, [&](std::uint64_t i, int) { return wanted[i].tmin; });
    if (input.one_in(2))
        tmax_ = InputArray::numbers(input, count, 1, [&](std::uint64_t i, int) { return wanted[i].tmax; });
    for (std::uint64_t i = 0; i < count; ++i) {
        rw_ray ray{};
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = origin_.number(i, axis);
            ray.direction[axis] = direction_.number(i, axis);
        }
        ray.tmin = tmin_.is_absent() ? 0.0 : tmin_.number(i, 0);
        ray.tmax = tmax_.is_absent() ? infinity : tmax_.number(i, 0);
        rays_.push_back(ray);
    }

    skips_.resize(count);
    if (input.one_in(3)) make_skip_arrays(input, meshes);

    rw_rays description{};
    description.count = count;
    description.skip_geometry = skip_geometry_.array();
    description.skip_primitive = skip_primitive_.array();
    description.skip_offsets = skip_offsets_.empty() ? nullptr : skip_offsets_.data();
    description.origin = origin_.array();
    description.direction = direction_.array();
    description.tmin = tmin_.array();
    description.tmax = tmax_.array();
    if (input.one_in(32)) {
        switch (input.below(4)) {
            case 0:
                description.flags = 1;
                outcome_.fails_if(true, RW_ERROR_INVALID_ARGUMENT);
                break;
            case 1:
                (input.one_in(2) ? description.origin : description.direction).data = nullptr;
                outcome_.fails_if(count > 0, RW_ERROR_INVALID_ARGUMENT);
                break;
            case 2:
                (input.one_in(2) ? description.origin : description.tmin).type =
                    input.pick({RW_UINT8, RW_UINT64, 6, -7});
                outcome_.fails_if(description.origin.type != origin_.array().type || !tmin_.is_absent(),
                                  RW_ERROR_INVALID_ARGUMENT);
                break;
            default:
                description.count = RW_RAYS_LIMIT + 1 + input.below(2);
                outcome_.fails_if(true, RW_ERROR_TOO_MANY);
                break;
        }
    }
    struct_ = std::make_unique<CallerStruct<rw_rays>>(input, description);
    outcome_.fails_if(struct_->is_wrong(), RW_ERROR_INVALID_ARGUMENT);
    if (struct_->is_of_an_older_program()) { // which knows of no skip lists
        skips_.assign(count, {});
        skip_outcome_ = Outcome("skip lists");
    }
}

void RayBatch::make_skip_arrays(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes) {
    const std::size_t count = skips_.size();
    const bool lists = input.one_in(2);
    std::vector<rw_primitive_id> entries;
    std::vector<std::uint64_t> ends;
    for (std::size_t i = 0; i < count; ++i) {
        const Skips skips = i < 16 ? make_skips(input, meshes) : Skips();
        if (lists) {
            entries.insert(entries.end(), skips.begin(), skips.end());
        } else {
            entries.push_back(skips.empty() ? rw_primitive_id{RW_INVALID_ID, 0, RW_INVALID_ID} : skips.front());
        }
        ends.push_back(entries.size());
    }
    skip_primitive_ = InputArray::ids(input, entries.size(), 1, [&](std::uint64_t i, int) {
        const std::uint32_t id = entries[i].primitive;
        return id == RW_INVALID_ID ? ~std::uint64_t{0} : std::uint64_t{id};
    });
    if (!input.one_in(4)) {
        skip_geometry_ =
            InputArray::ids(input, entries.size(), 1, [&](std::uint64_t i, int) { return entries[i].geometry; });
    }
    if (lists) {
        skip_offsets_ = ends;
        skip_offsets_.insert(skip_offsets_.begin(), 0);
    }

    // As it stands in memory, where elements may overlap.
    const std::uint64_t nothing = skip_primitive_.type() == RW_UINT32 ? RW_INVALID_ID : ~std::uint64_t{0};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::uint64_t k = i == 0 ? 0 : ends[i - 1]; k < ends[i]; ++k) {
            const std::uint64_t geometry = skip_geometry_.is_absent() ? 0 : skip_geometry_.id(k, 0);
            const std::uint64_t primitive = skip_primitive_.id(k, 0);
            if (primitive == nothing) continue;
            const bool is_there = geometry < meshes.size() && primitive < meshes[geometry]->triangle_count();
            skip_outcome_.fails_if(!is_there, RW_ERROR_INDEX_OUT_OF_RANGE);
            if (is_there) {
                skips_[i].push_back(
                    {RW_INVALID_ID, static_cast<std::uint32_t>(geometry), static_cast<std::uint32_t>(primitive)});
            }
        }
    }
}

std::uint64_t RayBatch::nan_count() const {
    std::uint64_t count = 0;
    for (const rw_ray& ray : rays_) count += has_nan(ray) ? 1 : 0;
    return count;
}

bool RayBatch::is_unchanged() const {
    return origin_.is_unchanged() && direction_.is_unchanged() && (tmin_.is_absent() || tmin_.is_unchanged()) &&
           (tmax_.is_absent() || tmax_.is_unchanged()) &&
           (skip_geometry_.is_absent() || skip_geometry_.is_unchanged()) &&
           (skip_primitive_.is_absent() || skip_primitive_.is_unchanged()) && struct_->is_unchanged();
}

} // namespace raywise::fuzz
