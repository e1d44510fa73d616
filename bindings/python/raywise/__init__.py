"""raywise: ray queries against triangle meshes, with a structure chosen by measurement.

    import raywise

    with raywise.Scene(vertices, triangles, expected_rays=1e6) as scene:
        hits = scene.intersect(origins, directions)
        print(hits.t[hits.hit], hits.primitive[hits.hit])
        print(scene.explain())

Answers are the same bits whatever structure is used, for one ray or many, with any number of threads.
"""

from . import _declarations
from ._errors import (
    AlreadyCommitted,
    BadPolygon,
    Cancelled,
    Capacity,
    ClosedError,
    CoordinateRange,
    HostParallel,
    IndexOutOfRange,
    InUse,
    InternalError,
    InvalidArgument,
    MemoryLimit,
    MeshFormat,
    MeshNotFound,
    MeshUnreadable,
    NoFaces,
    NotCommitted,
    NotFinite,
    OutOfMemory,
    OverlappingOutput,
    ProfileError,
    ProfileNotFound,
    RayCount,
    RaywiseError,
    ReservedMember,
    SharedMemory,
    TooMany,
    UnknownStructure,
    WrongStructure,
)
from ._explanation import Candidate, Explanation, GridStatistics, SceneStatistics
from ._facts import library_path, structures, version
from ._hits import INVALID_ID, AllHits, Hits
from ._library import LibraryError
from ._memory import Workspace, keep_memory, kept_memory
from ._mesh import Mesh
from ._once import intersect_once, occluded_once
from ._profile import Profile, profile
from ._scene import Bounds, Scene, SceneBusy
from ._view import View

__version__ = ".".join(
    str(number)
    for number in (
        _declarations.RW_VERSION_MAJOR,
        _declarations.RW_VERSION_MINOR,
        _declarations.RW_VERSION_PATCH,
    )
)

__all__ = [
    "INVALID_ID",
    "AllHits",
    "AlreadyCommitted",
    "BadPolygon",
    "Bounds",
    "Cancelled",
    "Candidate",
    "Capacity",
    "ClosedError",
    "CoordinateRange",
    "Explanation",
    "GridStatistics",
    "Hits",
    "HostParallel",
    "InUse",
    "IndexOutOfRange",
    "InternalError",
    "InvalidArgument",
    "LibraryError",
    "MemoryLimit",
    "Mesh",
    "MeshFormat",
    "MeshNotFound",
    "MeshUnreadable",
    "NoFaces",
    "NotCommitted",
    "NotFinite",
    "OutOfMemory",
    "OverlappingOutput",
    "Profile",
    "ProfileError",
    "ProfileNotFound",
    "RayCount",
    "RaywiseError",
    "ReservedMember",
    "Scene",
    "SceneBusy",
    "SceneStatistics",
    "SharedMemory",
    "TooMany",
    "UnknownStructure",
    "View",
    "Workspace",
    "WrongStructure",
    "__version__",
    "intersect_once",
    "keep_memory",
    "kept_memory",
    "library_path",
    "occluded_once",
    "profile",
    "structures",
    "version",
]
