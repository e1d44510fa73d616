#include "contract/peers/peer_list.h"

#include "contract/peers/cgal_peer.h"
#include "contract/peers/embree_peer.h"

#include <algorithm>

namespace raywise::contract {

const std::vector<Peer>& peers() {
    static const std::vector<Peer> rows = {
        {"embree",
         "Debian's Embree 3: `rtcIntersect1` and `rtcOccluded1`; all hits through a filter function that comes with "
         "the query, "
         "keeps each hit and rejects it. Coordinates, rays and intervals are rounded to float32.",
         "Without its robust flag rays slip through edges and corners that triangles share. Around them the filter "
         "function "
         "sees any number of the triangles that meet there, so that hits do not count as crossings. All is float32: "
         "small "
         "detail far from the origin is lost, coordinates beyond 1.8e18 are left out, and products of coordinates "
         "below 1e-19 "
         "vanish. Debian builds it with assertions, so that a ray with a NaN or an infinity ends the process.",
         [] { return make_embree(EmbreeFlags::plain); }, embree_version},
        {"embree-robust", "The same with `RTC_SCENE_FLAG_ROBUST`.",
         "No ray slips through shared edges, but a hit may be found where a ray passes just beside a triangle, and of "
         "the "
         "triangles around an edge the filter function often sees several. float32, limits and assertions as above.",
         [] { return make_embree(EmbreeFlags::robust); }, embree_version},
        {"cgal",
         "CGAL's AABB tree over triangles of `Simple_cartesian<double>`: `first_intersection`, `do_intersect`, "
         "`all_intersections`. An interval moves the ends of the ray, which becomes a segment where tmax is finite.",
         "Rounded predicates, as every float64 program has them, on top of what is said of EPICK.",
         make_cgal_simple_cartesian, cgal_version},
        {"cgal-epick",
         "The same over `Exact_predicates_inexact_constructions_kernel` (EPICK): hit or miss by exact arithmetic, "
         "points "
         "of intersection in float64.",
         "By its definition a triangle is hit by a ray in its plane, and triangles without area are against its rules: "
         "both "
         "are met here. A ray is kept as two points, its origin and origin + direction, rounded: a direction that is "
         "small "
         "beside the origin is lost, and `intersection` adds the direction to a vertex once more. The boxes of "
         "`first_intersection` are tested in rounded arithmetic, so it may miss what `do_intersect` finds.",
         make_cgal_exact_predicates, cgal_version},
        {"trimesh",
         "trimesh's own intersector, `trimesh.ray.ray_triangle`: float64, no tmin, no tmax. All hits by "
         "`ray_triangle_id`.",
         "Absolute tolerances: a triangle counts as parallel when |direction . normal| is below 1e-5, which depends on "
         "the "
         "length of the direction; a hit may lie 1e-6 behind the origin; boxes are 1e-5 wider. So small scenes, short "
         "and long "
         "directions fail. A scene without triangles, and a NaN, raise an exception.",
         nullptr, nullptr},
        {"trimesh-embreex",
         "`trimesh.ray.ray_pyembree`, which trimesh uses once embreex is installed: Embree 4 on a mesh moved and "
         "scaled to a "
         "common size, all hits by starting again beyond each. No tmin, no tmax.",
         "Starting again a little further on passes by the triangles that are hit at the same place, and some right "
         "behind. "
         "`intersects_any` rounds a ray to float32 before it is moved and scaled, `intersects_id` after, so the two "
         "contradict each other. A triangle that is nearly parallel is dropped as in trimesh itself. Otherwise as "
         "embreex.",
         nullptr, nullptr},
        {"embreex", "embreex itself: Embree 4, float32, robust by default. No tmin, no all hits.",
         "float32: as Embree 3 robust, but without assertions; far hits end at t = 1e37.", nullptr, nullptr},
    };
    return rows;
}

const Peer* peer_named(const std::string& key) {
    const auto found = std::find_if(peers().begin(), peers().end(), [&](const Peer& peer) { return key == peer.key; });
    return found == peers().end() ? nullptr : &*found;
}

} // namespace raywise::contract
