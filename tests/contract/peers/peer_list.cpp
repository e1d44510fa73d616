#include "contract/peers/peer_list.h"

#include "contract/peers/cgal_peer.h"
#include "contract/peers/embree_peer.h"

#include <algorithm>

namespace raywise::contract {

const std::vector<Peer>& peers() {
    static const std::vector<Peer> rows = {
        {"embree",
         "Debian's Embree 3 without flags: `rtcIntersect1` and `rtcOccluded1`, all hits through a filter function that "
         "rejects and keeps each. Coordinates, rays and intervals are rounded to float32.",
         [] { return make_embree(EmbreeFlags::plain); }, embree_version},
        {"embree-robust", "The same with `RTC_SCENE_FLAG_ROBUST`.", [] { return make_embree(EmbreeFlags::robust); },
         embree_version},
        {"cgal",
         "CGAL's AABB tree over triangles of `Simple_cartesian<double>`: `first_intersection`, `do_intersect`, "
         "`all_intersections`. An interval moves the ends of the ray, which becomes a segment where tmax is finite.",
         make_cgal_simple_cartesian, cgal_version},
        {"cgal-epick",
         "The same over `Exact_predicates_inexact_constructions_kernel` (EPICK): hit or miss by exact arithmetic, points "
         "of intersection in float64.",
         make_cgal_exact_predicates, cgal_version},
        {"trimesh", "trimesh's own intersector, `trimesh.ray.ray_triangle`: float64, no tmin, no tmax.", nullptr, nullptr},
        {"trimesh-embreex",
         "`trimesh.ray.ray_pyembree`, which trimesh uses once embreex is installed: Embree 4 on a mesh scaled to a common "
         "size, all hits by starting again beyond each. No tmin, no tmax.",
         nullptr, nullptr},
        {"embreex", "embreex itself: Embree 4, float32, robust by default. No tmin, no all hits.", nullptr, nullptr},
    };
    return rows;
}

const Peer* peer_named(const std::string& key) {
    const auto found = std::find_if(peers().begin(), peers().end(), [&](const Peer& peer) { return key == peer.key; });
    return found == peers().end() ? nullptr : &*found;
}

} // namespace raywise::contract
