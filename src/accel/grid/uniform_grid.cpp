#include "accel/grid/uniform_grid.h"

#include "geometry/triangle_box_overlap.h"

#include <algorithm>
#include <atomic>
#include <memory>

namespace raywise {
namespace {

// Fixed, so that the result does not depend on the number of threads.
constexpr std::uint32_t primitives_per_block = 1u << 14;

// Cells are numbered, and references counted, in 32 bits.
constexpr double most_cells = 0x1p30;
// Along an axis: what the walk's proof and the overlap test have room for.
constexpr double most_cells_along_axis = 0x1p24;
// References beyond this many per primitive coarsen the grid: large primitives that overlap each other, for which
// smaller cells gain little.
constexpr std::uint64_t most_references_per_primitive = 24;
constexpr std::uint64_t references_always_allowed = 1u << 16;
constexpr std::uint64_t most_references = 0xFFFFFFF0u;

// A reference on its way to its cell.
struct Pair {
    std::uint32_t cell;
    std::uint32_t primitive;
};

Corners to_cells(const CellLattice& lattice, const Corners& c) {
    const auto to_cells = [&](const Vec3& p) { return (p - lattice.bounds.lower) * lattice.cells_per_unit; };
    return {to_cells(c[0]), to_cells(c[1]), to_cells(c[2])};
}

// The cells in runs of 2^shift, small enough for the counters of a run to stay in the cache: counting and filling
// references straight into all cells would miss it at nearly every step when the primitives come in no order.
struct Runs {
    explicit Runs(std::uint64_t cells) {
        while (shift < 14 || (cells >> shift) > 2048) ++shift;
        count = ((cells - 1) >> shift) + 1;
    }
    unsigned shift = 10;
    std::uint64_t count;
};

struct Block {
    std::vector<Pair> pairs;                // in the order of primitives
    std::vector<std::uint32_t> run_offsets; // first counts per run, then where each run's pairs go
};

class Builder {
public:
    Builder(const BuildInput& input, const CellLattice& lattice)
        : input_(input),
          lattice_(lattice),
          cells_(std::uint64_t{lattice.resolution[0]} * lattice.resolution[1] * lattice.resolution[2]),
          runs_(cells_),
          blocks_((input.primitives.count() - 1) / primitives_per_block + 1) {}

    // False when there are too many references; the total is found the same for every number of threads.
    bool find_pairs() {
        const std::uint64_t hittable = input_.primitives.hittable_count();
        const std::uint64_t allowed =
            cells_ == 1
                ? most_references
                : std::min(most_references, hittable * most_references_per_primitive + references_always_allowed);
        std::atomic<std::uint64_t> total{0};
        std::atomic<std::uint64_t> done{0};
        input_.parallel.for_each(blocks_.size(), [&](std::uint64_t b) {
            if (total > allowed) return;
            find_pairs(b, allowed);
            total += blocks_[b].pairs.size();
            input_.progress.report(0.6 * static_cast<double>(++done) / static_cast<double>(blocks_.size()),
                                   "grid: cells");
        });
        references_ = total;
        return total <= allowed;
    }

    void sort_pairs(std::vector<std::uint32_t>& offsets, std::vector<std::uint32_t>& references,
                    std::vector<std::uint64_t>& occupied) {
        std::vector<std::uint64_t> run_begin(runs_.count + 1, 0);
        std::uint64_t position = 0;
        for (std::uint64_t run = 0; run < runs_.count; ++run) {
            run_begin[run] = position;
            for (Block& block : blocks_) {
                const std::uint32_t count = block.run_offsets[run];
                block.run_offsets[run] = static_cast<std::uint32_t>(position);
                position += count;
            }
        }
        run_begin[runs_.count] = position;

        const std::unique_ptr<Pair[]> by_run(new Pair[std::max<std::uint64_t>(references_, 1)]);
        input_.parallel.for_each(blocks_.size(), [&](std::uint64_t b) {
            Block block = std::move(blocks_[b]);
            std::uint32_t* next = block.run_offsets.data();
            for (const Pair& pair : block.pairs) by_run[next[pair.cell >> runs_.shift]++] = pair;
        });
        input_.progress.report(0.75, "grid: lists");

        std::atomic<std::uint64_t> done{0};
        offsets.resize(cells_ + 1);
        offsets[cells_] = static_cast<std::uint32_t>(references_);
        references.resize(references_);
        occupied.resize((cells_ + 63) / 64);
        input_.parallel.for_each(runs_.count, [&](std::uint64_t run) {
            const std::uint64_t first_cell = run << runs_.shift;
            const std::uint64_t cells = std::min(cells_ - first_cell, std::uint64_t{1} << runs_.shift);
            std::vector<std::uint32_t> next(cells, 0);
            for (std::uint64_t i = run_begin[run]; i < run_begin[run + 1]; ++i) ++next[by_run[i].cell - first_cell];
            auto begin = static_cast<std::uint32_t>(run_begin[run]);
            for (std::uint64_t c = 0; c < cells; ++c) {
                offsets[first_cell + c] = begin;
                const std::uint32_t count = next[c];
                // A word belongs to one run.
                occupied[(first_cell + c) / 64] |= std::uint64_t{count != 0} << (first_cell + c) % 64;
                next[c] = begin;
                begin += count;
            }
            for (std::uint64_t i = run_begin[run]; i < run_begin[run + 1]; ++i) {
                references[next[by_run[i].cell - first_cell]++] = by_run[i].primitive;
            }
            input_.progress.report(0.75 + 0.25 * static_cast<double>(++done) / static_cast<double>(runs_.count),
                                   "grid: lists");
        });
    }

private:
    void find_pairs(std::uint64_t b, std::uint64_t allowed) {
        const Primitives& primitives = input_.primitives;
        Block& block = blocks_[b];
        block.run_offsets.assign(runs_.count, 0);
        const auto begin = static_cast<std::uint32_t>(b * primitives_per_block);
        const std::uint32_t end = std::min(primitives.count() - begin, primitives_per_block) + begin;
        block.pairs.reserve(2 * std::size_t{end - begin});
        const std::uint32_t row = lattice_.resolution[0];
        const std::uint32_t layer = row * lattice_.resolution[1];
        for (std::uint32_t i = begin; i < end; ++i) {
            if (!primitives.is_hittable(i)) continue;
            const Corners corners = to_cells(lattice_, primitives.corners(i));
            for_each_overlapped_cell(corners, bounding_cells(corners, lattice_.resolution),
                                     [&](std::int32_t x, std::int32_t y, std::int32_t z) {
                                         const std::uint32_t cell = static_cast<std::uint32_t>(x) +
                                                                    static_cast<std::uint32_t>(y) * row +
                                                                    static_cast<std::uint32_t>(z) * layer;
                                         block.pairs.push_back({cell, i});
                                         ++block.run_offsets[cell >> runs_.shift];
                                     });
            if (block.pairs.size() > allowed) return; // the total is too large already
        }
    }

    const BuildInput& input_;
    const CellLattice& lattice_;
    std::uint64_t cells_;
    Runs runs_;
    std::vector<Block> blocks_;
    std::uint64_t references_ = 0;
};

} // namespace

std::array<std::uint32_t, 3> grid_resolution(const Vec3& size, double primitives, double density) {
    const double wanted = std::clamp(primitives * density, 1.0, most_cells);
    const double largest = max_component(size);
    std::array<std::uint32_t, 3> resolution{1, 1, 1};
    if (!(largest > 0x1p-900)) return resolution; // a point, or too small for the inverse of a cell's width
    // In units of the largest size, so that volumes neither over- nor underflow.
    const Vec3 relative = size / largest;
    std::array<bool, 3> divided{};
    for (int axis = 0; axis < 3; ++axis) divided[static_cast<std::size_t>(axis)] = relative[axis] > 0.0;
    for (;;) {
        // Cells per unit, if the divided axes share all cells: the root of wanted / volume. In logarithms, as a thin
        // box's volume may be tiny.
        double logarithm = std::log2(wanted);
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!divided[static_cast<std::size_t>(axis)]) continue;
            logarithm -= std::log2(relative[axis]);
            ++axes;
        }
        const double scale = std::exp2(logarithm / axes);
        bool thin = false;
        for (int axis = 0; axis < 3; ++axis) {
            auto&& is_divided = divided[static_cast<std::size_t>(axis)];
            if (is_divided && relative[axis] * scale < 1.0) {
                is_divided = false;
                thin = true;
            }
        }
        if (thin) continue; // never all: the largest axis has at least the mean number of cells, which is 1 or more
        for (int axis = 0; axis < 3; ++axis) {
            if (!divided[static_cast<std::size_t>(axis)]) continue;
            // 2^-40: so that whole numbers come out whole.
            resolution[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(
                std::clamp(relative[axis] * scale * (1.0 + 0x1p-40), 1.0, most_cells_along_axis));
        }
        return resolution;
    }
}

UniformGrid::UniformGrid(const BuildInput& input, double density) : TraversedAccel(input.primitives) {
    const Primitives& primitives = input.primitives;
    if (primitives.hittable_count() == 0) return;
    lattice_.bounds = primitives.bounds();
    const Vec3 size = primitives.bounds().size();

    double cells = density * static_cast<double>(primitives.hittable_count());
    for (;;) {
        lattice_.resolution = grid_resolution(size, cells, 1.0);
        for (int axis = 0; axis < 3; ++axis) {
            const double count = lattice_.resolution[static_cast<std::size_t>(axis)];
            lattice_.width[axis] = size[axis] / count;
            lattice_.cells_per_unit[axis] = count > 1.0 ? count / size[axis] : 0.0;
        }
        Builder builder(input, lattice_);
        if (builder.find_pairs()) {
            builder.sort_pairs(offsets_, references_, occupied_);
            break;
        }
        cells /= 4.0; // with one cell everything fits
    }
}

std::size_t UniformGrid::bytes() const {
    return sizeof *this + (offsets_.capacity() + references_.capacity()) * sizeof(std::uint32_t) +
           occupied_.capacity() * sizeof(std::uint64_t);
}

} // namespace raywise
