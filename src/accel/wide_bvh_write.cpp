#include "accel/wide_bvh_write.h"

#include "base/lanes.h"

#include <limits>

namespace raywise {
namespace {

// Calls write(begin, n, block) for each block of a leaf.
template <class Write>
void for_each_block(BlockWord* words, std::uint32_t first, std::uint32_t count, const Write& write) {
    for (std::uint32_t begin = 0; begin < count; begin += block_size) {
        const std::uint32_t n = std::min(block_size, count - begin);
        write(begin, n, words + words_per_triangle * (std::size_t{first} + begin));
    }
}

Box box_of(Lanes lower, Lanes upper) {
    return {Vec3(Vec3f(lower[0], lower[1], lower[2])), Vec3(Vec3f(upper[0], upper[1], upper[2]))};
}

} // namespace

LeafWriter::LeafWriter(WideBvh& bvh, const Primitives& primitives)
    : words_(bvh.words.data()), primitives_(primitives), frame_(bvh.frame) {
    const double scale = frame_.scale(); // a power of two
    if (scale >= 0x1p-126 && scale <= 0x1p126 && frame_.from_frame(Vec3(0.0)) == Vec3(0.0)) {
        scale_ = static_cast<float>(scale);
        inverse_scale_ = 1.0f / scale_;
    }
}

WrittenLeaf LeafWriter::write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    WrittenLeaf written{true, {}};
    if (scale_ != 0.0f && write_floats(first, leaf, count, written)) return written;

    for_each_block(words_, first, count, [&](std::uint32_t begin, std::uint32_t n, BlockWord* block) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t primitive = leaf[begin + i];
            const TriangleMesh& mesh = mesh_of(primitive);
            BlockWord* word = block + i;
            for (const Vec3& corner : mesh.corners(primitive - mesh_first_)) {
                const Vec3 p = frame_.to_frame(corner);
                written.box.extend(p);
                const Vec3f rounded(p);
                if (frame_.from_frame(Vec3(rounded)) != corner) written.exact = false;
                for (int axis = 0; axis < 3; ++axis, word += n) word->coordinate = rounded[axis];
            }
            word->primitive = primitive;
        }
    });
    return written;
}

// The same in float32, a fourth of the work. Returns false when that is not enough: where a corner is not float32, or one cannot be had
// back, because it would be below the normal numbers: then the box, of rounded corners, might not hold it.
bool LeafWriter::write_floats(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count,
                              WrittenLeaf& written) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Lanes lower = fill_lanes(infinity);
    Lanes upper = fill_lanes(-infinity);
    IntLanes same{-1, -1, -1, -1};
    for_each_block(words_, first, count, [&](std::uint32_t begin, std::uint32_t n, BlockWord* block) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t primitive = leaf[begin + i];
            const TriangleMesh& mesh = mesh_of(primitive);
            if (!mesh.is_float32()) {
                same = IntLanes{};
                return;
            }
            BlockWord* word = block + i;
            for (const Vec3f& corner : mesh.corners_float32(primitive - mesh_first_)) {
                const Lanes p{corner.x, corner.y, corner.z, 0.0f};
                const Lanes scaled = p * scale_;
                same &= scaled * inverse_scale_ == p;
                lower = min_lanes(lower, scaled);
                upper = max_lanes(upper, scaled);
                for (int axis = 0; axis < 3; ++axis, word += n) word->coordinate = scaled[axis];
            }
            word->primitive = primitive;
        }
    });
    if ((same[0] & same[1] & same[2]) == 0) return false;
    written.box = box_of(lower, upper);
    return true;
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
