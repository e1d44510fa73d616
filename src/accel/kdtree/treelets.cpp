#include "accel/kdtree/treelets.h"

#include "accel/kdtree/treelet_cuts.h"
#include "base/page_array.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace raywise {
namespace {

constexpr std::size_t leaves_at_a_time = 4096; // between two reports

// A leaf of the binary tree, and where it goes.
struct PlacedLeaf {
    std::uint32_t first;
    std::uint32_t count;
    std::size_t offset;
};

// Fills one treelet after the other, in the order of a walk: what is below a cell follows the cell's treelet.
class TreeletMaker {
public:
    TreeletMaker(const KdTreeData& tree, const BoxF& bounds, std::size_t bytes_per_triangle)
        : tree_(tree), cuts_(tree, bounds), bytes_per_triangle_(bytes_per_triangle) {}

    void make() {
        waiting_.push_back({0, no_treelet, 0});
        while (!waiting_.empty()) {
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            const auto index = static_cast<std::uint32_t>(treelets.size());
            if (next.treelet != no_treelet) treelets[next.treelet].cell[next.cell] = KdLink::treelet(index);
            treelets.emplace_back();
            start(treelets.back());
            fill(index, 0, treelet_levels, next.node);
        }
    }

    PageVector<KdTreelet> treelets;
    PageVector<PlacedLeaf> leaves;
    std::size_t leaf_bytes = 0;

private:
    static constexpr std::uint32_t no_treelet = 0xFFFFFFFFu;

    // A node that begins a treelet, and the cell that it is in.
    struct Waiting {
        std::uint32_t node;
        std::uint32_t treelet;
        std::uint32_t cell;
    };

    static void start(KdTreelet& treelet) {
        std::fill_n(treelet.split, treelet_planes, KdTreelet::no_plane);
        std::fill_n(treelet.cell, treelet_cells, KdLink());
        treelet.shape = KdTreelet::shape_of_none;
    }

    // place: of a plane, with so many levels from it on, or treelet_planes + a cell, with none.
    void fill(std::uint32_t index, std::uint32_t place, int levels, std::uint32_t node) {
        const KdNode& n = tree_.nodes[node];
        const bool is_plane = !n.is_leaf() && levels > 0 && (place == 0 || !cuts_.begins(node, levels));
        if (is_plane) {
            treelets[index].split[place] = n.split();
            treelets[index].shape |= static_cast<std::uint32_t>(n.axis()) << 2 * place;
            fill(index, 2 * place + 1, levels - 1, n.child());
            fill(index, 2 * place + 2, levels - 1, n.child() + 1);
            return;
        }
        while (place < treelet_planes) place = 2 * place + 1; // the first of the cells that it stands for
        const std::uint32_t cell = place - treelet_planes;
        if (n.is_leaf()) {
            if (n.count() > 0) set_cell(index, cell, place_leaf(n));
        } else {
            set_cell(index, cell, KdLink());
            waiting_.push_back({node, index, cell});
        }
    }

    void set_cell(std::uint32_t index, std::uint32_t cell, KdLink link) {
        treelets[index].cell[cell] = link;
        treelets[index].shape |= 1u << (KdTreelet::present_shift + cell);
    }

    KdLink place_leaf(const KdNode& leaf) {
        leaves.push_back({leaf.first(), leaf.count(), leaf_bytes});
        const KdLink link = KdLink::leaf(leaf_bytes);
        const std::size_t bytes = sizeof(KdLeafHead) + bytes_per_triangle_ * leaf.count();
        leaf_bytes += (bytes + KdLink::leaf_alignment - 1) / KdLink::leaf_alignment * KdLink::leaf_alignment;
        return link;
    }

    const KdTreeData& tree_;
    const TreeletCuts cuts_;
    const std::size_t bytes_per_triangle_;
    PageVector<Waiting> waiting_;
};

CornersF corners_as(float, const TriangleMesh& mesh, std::uint32_t triangle) { return mesh.corners_float32(triangle); }
Corners corners_as(double, const TriangleMesh& mesh, std::uint32_t triangle) { return mesh.corners(triangle); }

template <class T>
void write_leaf(const std::uint32_t* list, std::uint32_t count, const Vec3& center, MeshCursor& cursor,
                std::byte* leaf) {
    double farthest = 0.0;
    std::byte* block = leaf + sizeof(KdLeafHead);
    for (std::uint32_t begin = 0; begin < count; begin += triangle_block_size) {
        const std::uint32_t n = std::min(triangle_block_size, count - begin);
        for (std::uint32_t i = 0; i < n; ++i) {
            cursor.move_to(list[begin + i]);
            const auto corners = corners_as(T(), cursor.mesh(), cursor.triangle(list[begin + i]));
            T numbers[3][3];
            for (std::size_t k = 0; k < 3; ++k) {
                for (int axis = 0; axis < 3; ++axis) {
                    numbers[k][axis] = corners[k][axis];
                    farthest = larger(farthest, std::fabs(static_cast<double>(corners[k][axis]) - center[axis]));
                }
            }
            write_block_triangle(block, n, i, numbers, list[begin + i]);
        }
        block += TriangleBlock<T>::bytes_per_triangle * n;
    }
    // Up by more than the difference was rounded by.
    const double distance = smaller(farthest * (1.0 + 0x1p-50), std::numeric_limits<double>::max());
    const KdLeafHead head{
        distance > std::numeric_limits<float>::max() ? std::numeric_limits<float>::infinity() : round_up(distance),
        count};
    std::memcpy(leaf, &head, sizeof head);
}

template <class T>
void write_leaves(const KdTreeData& tree, const PageVector<PlacedLeaf>& leaves, const BuildInput& input,
                  double progress_begin, std::byte* bytes) {
    const std::size_t chunks = (leaves.size() + leaves_at_a_time - 1) / leaves_at_a_time;
    const Vec3 center = tree.frame.center();
    input.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        MeshCursor cursor(input.primitives);
        const std::size_t begin = chunk * leaves_at_a_time;
        const std::size_t end = std::min(leaves.size(), begin + leaves_at_a_time);
        for (std::size_t i = begin; i < end; ++i) {
            write_leaf<T>(tree.references.data() + leaves[i].first, leaves[i].count, center, cursor,
                          bytes + leaves[i].offset);
        }
        input.progress.report(progress_begin, "kd-tree: leaves");
    });
}

} // namespace

KdTreelets make_treelets(const KdTreeData& tree, const BuildInput& input, double progress_begin) {
    KdTreelets result;
    result.frame = tree.frame;
    result.too_large = tree.too_large;
    if (tree.nodes.empty()) return result;

    const Box relative = tree.frame.relative(input.primitives.bounds());
    result.bounds = round_outwards({relative.lower * tree.frame.scale(), relative.upper * tree.frame.scale()});
    result.hit_error = round_up(0x1p-27 * input.primitives.largest_extent() * tree.frame.scale());
    result.is_float64 = !input.primitives.is_float32();

    TreeletMaker maker(tree, result.bounds, block_bytes_per_triangle(result.is_float64));
    maker.make();
    if (maker.leaf_bytes > KdLink::most_leaf_bytes) {
        result.too_large = true;
        return result;
    }
    result.treelets = PageArray<KdTreelet>(maker.treelets.size());
    std::copy(maker.treelets.begin(), maker.treelets.end(), result.treelets.begin());
    maker.treelets = {};
    result.leaves = room_for_blocks(maker.leaf_bytes);
    if (result.is_float64) {
        write_leaves<double>(tree, maker.leaves, input, progress_begin, result.leaves.data());
    } else {
        write_leaves<float>(tree, maker.leaves, input, progress_begin, result.leaves.data());
    }
    return result;
}

} // namespace raywise
