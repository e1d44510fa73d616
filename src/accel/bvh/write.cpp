#include "accel/bvh/write.h"

#include "base/lanes.h"

#include <limits>

namespace raywise {
namespace {

// Calls write(begin, n, block) for each block of a leaf.
template <class T, class Write>
void for_each_new_block(std::byte* blocks, std::uint32_t first, std::uint32_t count, const Write& write) {
    for (std::uint32_t begin = 0; begin < count; begin += triangle_block_size) {
        write(begin, std::min(triangle_block_size, count - begin),
              blocks + TriangleBlock<T>::bytes_per_triangle * (std::size_t{first} + begin));
    }
}

} // namespace

void make_blocks(WideBvh& bvh, const Primitives& primitives, std::size_t triangles) {
    const auto& meshes = primitives.meshes();
    bvh.is_float64 = !std::all_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh->is_float32(); });
    const std::size_t bytes = bvh.bytes_per_triangle() * triangles;
    bvh.blocks = PageArray<std::byte>(bytes + triangle_block_padding);
    std::fill_n(bvh.blocks.data() + bytes, triangle_block_padding, std::byte{});
}

LeafWriter::LeafWriter(WideBvh& bvh, const Primitives& primitives) : bvh_(bvh), primitives_(primitives) {}

LeafWriter::Leaf LeafWriter::write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    const Box box = bvh_.is_float64 ? write_float64(first, leaf, count) : write_float32(first, leaf, count);
    const Box relative = bvh_.frame.relative(box);
    const double distance = max_component(larger(magnitudes(relative.lower), magnitudes(relative.upper)));
    // Rounded as the builders' boxes are.
    const double scale = bvh_.frame.scale();
    Leaf written{NodeRef::leaf(first, count, distance), {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
        written.lower[axis] = static_cast<double>(round_down(scale * relative.lower[axis]));
        written.upper[axis] = static_cast<double>(round_up(scale * relative.upper[axis]));
    }
    return written;
}

Box LeafWriter::write_float64(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    Box box;
    for_each_new_block<double>(bvh_.blocks.data(), first, count,
                               [&](std::uint32_t begin, std::uint32_t n, std::byte* block) {
                                   for (std::uint32_t i = 0; i < n; ++i) {
                                       const std::uint32_t primitive = leaf[begin + i];
                                       const TriangleMesh& mesh = mesh_of(primitive);
                                       const Corners corners = mesh.corners(primitive - mesh_first_);
                                       double numbers[3][3];
                                       for (std::size_t k = 0; k < 3; ++k) {
                                           box.extend(corners[k]);
                                           for (std::size_t axis = 0; axis < 3; ++axis)
                                               numbers[k][axis] = corners[k][static_cast<glm::length_t>(axis)];
                                       }
                                       write_block_triangle(block, n, i, numbers, primitive);
                                   }
                               });
    return box;
}

Box LeafWriter::write_float32(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Lanes lower = fill_lanes(infinity);
    Lanes upper = fill_lanes(-infinity);
    for_each_new_block<float>(bvh_.blocks.data(), first, count,
                              [&](std::uint32_t begin, std::uint32_t n, std::byte* block) {
                                  for (std::uint32_t i = 0; i < n; ++i) {
                                      const std::uint32_t primitive = leaf[begin + i];
                                      const TriangleMesh& mesh = mesh_of(primitive);
                                      const CornersF corners = mesh.corners_float32(primitive - mesh_first_);
                                      float numbers[3][3];
                                      for (std::size_t k = 0; k < 3; ++k) {
                                          const Lanes p{corners[k].x, corners[k].y, corners[k].z, 0.0f};
                                          lower = min_lanes(lower, p);
                                          upper = max_lanes(upper, p);
                                          for (std::size_t axis = 0; axis < 3; ++axis) numbers[k][axis] = p[axis];
                                      }
                                      write_block_triangle(block, n, i, numbers, primitive);
                                  }
                              });
    return {Vec3(Vec3f(lower[0], lower[1], lower[2])), Vec3(Vec3f(upper[0], upper[1], upper[2]))};
}

const TriangleMesh& LeafWriter::mesh_of(std::uint32_t primitive) {
    if (primitive - mesh_first_ >= mesh_count_) {
        const std::uint32_t geometry = primitives_.locate(primitive).geometry;
        mesh_ = primitives_.meshes()[geometry].get();
        mesh_first_ = primitives_.number({geometry, 0});
        mesh_count_ = mesh_->triangle_count();
    }
    return *mesh_;
}

} // namespace raywise
