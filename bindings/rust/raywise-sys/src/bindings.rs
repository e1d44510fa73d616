// Written by bindings/generate.py from raywise.h. Change the header and run that script; do not edit.

pub const RW_VERSION_MAJOR: i32 = 0;
pub const RW_VERSION_MINOR: i32 = 2;
pub const RW_VERSION_PATCH: i32 = 0;
pub const RW_ABI_VERSION: i32 = 1;
pub const RW_OK: i32 = 0;
pub const RW_ERROR_INVALID_ARGUMENT: i32 = 1;
pub const RW_ERROR_OUT_OF_MEMORY: i32 = 2;
pub const RW_ERROR_NOT_FINITE: i32 = 3;
pub const RW_ERROR_COORDINATE_RANGE: i32 = 4;
pub const RW_ERROR_INDEX_OUT_OF_RANGE: i32 = 5;
pub const RW_ERROR_TOO_MANY: i32 = 6;
pub const RW_ERROR_ALREADY_COMMITTED: i32 = 7;
pub const RW_ERROR_NOT_COMMITTED: i32 = 8;
pub const RW_ERROR_UNKNOWN_STRUCTURE: i32 = 9;
pub const RW_ERROR_WRONG_STRUCTURE: i32 = 10;
pub const RW_ERROR_RAY_COUNT: i32 = 11;
pub const RW_ERROR_CAPACITY: i32 = 12;
pub const RW_ERROR_CANCELLED: i32 = 13;
pub const RW_ERROR_MEMORY_LIMIT: i32 = 14;
pub const RW_ERROR_FILE_NOT_FOUND: i32 = 15;
pub const RW_ERROR_FILE_UNREADABLE: i32 = 16;
pub const RW_ERROR_FILE_FORMAT: i32 = 17;
pub const RW_ERROR_NO_FACES: i32 = 18;
pub const RW_ERROR_BAD_POLYGON: i32 = 19;
pub const RW_ERROR_HOST_PARALLEL: i32 = 20;
pub const RW_ERROR_INTERNAL: i32 = 21;
pub const RW_PROFILE_NOT_FOUND: i32 = 22;
pub const RW_PROFILE_UNREADABLE: i32 = 23;
pub const RW_PROFILE_MALFORMED: i32 = 24;
pub const RW_PROFILE_SCHEMA: i32 = 25;
pub const RW_PROFILE_EPOCH: i32 = 26;
pub const RW_PROFILE_MACHINE: i32 = 27;
pub const RW_PROFILE_RANGE: i32 = 28;
pub const RW_ERROR_RESERVED: i32 = 29;
pub const RW_ERROR_OVERLAP: i32 = 30;
pub const RW_ERROR_SHARED_MEMORY: i32 = 31;
pub const RW_ERROR_IN_USE: i32 = 32;
pub const RW_STATUS_COUNT: i32 = 33;
pub const RW_TYPE_DEFAULT: i32 = 0;
pub const RW_FLOAT32: i32 = 1;
pub const RW_FLOAT64: i32 = 2;
pub const RW_UINT8: i32 = 3;
pub const RW_UINT32: i32 = 4;
pub const RW_UINT64: i32 = 5;
pub const RW_REPEAT: i64 = -9223372036854775808;
pub const RW_PROFILE_SOURCE_GENERIC: i32 = 0;
pub const RW_PROFILE_SOURCE_PATH: i32 = 1;
pub const RW_PROFILE_SOURCE_ENV: i32 = 2;
pub const RW_PROFILE_SOURCE_USER: i32 = 3;
pub const RW_PROFILE_SOURCE_SYSTEM: i32 = 4;
pub const RW_FORMAT_TEXT: i32 = 0;
pub const RW_FORMAT_JSON: i32 = 1;
pub const RW_TRIANGLES_SHARED: u32 = 1;
pub const RW_TRIANGLES_SKIP_INVALID: u32 = 2;
pub const RW_INVALID_ID: u32 = 4294967295;
pub const RW_RAYS_ANY_KIND: i32 = 0;
pub const RW_RAYS_RANDOM: i32 = 1;
pub const RW_RAYS_CAMERA: i32 = 2;
pub const RW_RAYS_SHADOW: i32 = 3;
pub const RW_RAYS_DIFFUSE: i32 = 4;
pub const RW_RAYS_UNKNOWN: u64 = 18446744073709551615;
pub const RW_RAYS_LIMIT: u64 = 1000000000000000;
pub const RW_EFFORT_ESTIMATE: i32 = 0;
pub const RW_EFFORT_PROBE: i32 = 1;
pub const RW_EFFORT_MEASURE: i32 = 2;
pub const RW_RULE_SMALLEST_TOTAL: i32 = 0;
pub const RW_RULE_HAPALA: i32 = 1;
pub const RW_REFIT_WHERE_IT_PAYS: i32 = 0;
pub const RW_REFIT_WHERE_POSSIBLE: i32 = 1;
pub const RW_REFIT_NEVER: i32 = 2;
pub const RW_CANDIDATE_CHOSEN: u32 = 1;
pub const RW_CANDIDATE_FORCED: u32 = 2;
pub const RW_CANDIDATE_OVER_LIMIT: u32 = 4;
pub const RW_CANDIDATE_MEASURED: u32 = 8;
pub const RW_CANDIDATE_NOT_APPLICABLE: u32 = 16;
pub const RW_VIEW_POINT: i32 = 0;
pub const RW_VIEW_DIRECTION: i32 = 1;
/**
```text
Input of n elements with one, two or three components each. Component c of element i is at
(const char *)data + i * stride + c * component_stride. Strides may be negative. A stride of 0 means
packed; component_stride 0 is the size of the type. So AoS and SoA are the same struct with other strides.
```
*/
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_array {
    /// NULL: absent, where the place allows it
    pub data: *const ::std::os::raw::c_void,
    /// bytes from element to element; 0: packed; RW_REPEAT: the same one
    pub stride: i64,
    /// bytes from x to y and from y to z; 0: size of the type
    pub component_stride: i64,
    /// RW_FLOAT32 ... or RW_TYPE_DEFAULT
    pub type_: i32,
    /// 0
    pub reserved: i32,
}
#[test]
fn bindgen_test_layout_rw_array() {
    const UNINIT: ::std::mem::MaybeUninit<rw_array> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_array>(), 32usize, "Size of rw_array");
    assert_eq!(::std::mem::align_of::<rw_array>(), 8usize, "Alignment of rw_array");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).data) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_array::data",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).stride) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_array::stride",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).component_stride) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_array::component_stride",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).type_) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_array::type_",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        28usize,
        "Offset of field: rw_array::reserved",
    );
}
impl Default for rw_array {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
Output, laid out as rw_array. data NULL: not wanted. RW_REPEAT is an error here, as are elements that overlap
(RW_ERROR_OVERLAP) and outputs that share a byte (RW_ERROR_SHARED_MEMORY).
```
*/
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_output {
    pub data: *mut ::std::os::raw::c_void,
    pub stride: i64,
    pub component_stride: i64,
    pub type_: i32,
    /// 0
    pub reserved: i32,
}
#[test]
fn bindgen_test_layout_rw_output() {
    const UNINIT: ::std::mem::MaybeUninit<rw_output> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_output>(), 32usize, "Size of rw_output");
    assert_eq!(::std::mem::align_of::<rw_output>(), 8usize, "Alignment of rw_output");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).data) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_output::data",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).stride) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_output::stride",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).component_stride) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_output::component_stride",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).type_) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_output::type_",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        28usize,
        "Offset of field: rw_output::reserved",
    );
}
impl Default for rw_output {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/// One piece of work: call it once for every index below the count that was asked for.
pub type rw_task = ::std::option::Option<
    unsafe extern "C" fn(task_data: *mut ::std::os::raw::c_void, index: u64),
>;
/**
```text
A parallel-for of the host program: it calls task(task_data, i) exactly once for each i in [0, count), in
any order and from any threads, and returns when all calls have returned.
user: the pointer given beside the function.
```
*/
pub type rw_parallel_for = ::std::option::Option<
    unsafe extern "C" fn(
        user: *mut ::std::os::raw::c_void,
        count: u64,
        task: rw_task,
        task_data: *mut ::std::os::raw::c_void,
    ),
>;
/**
```text
What building and asking each structure costs on this machine; written by raywise-calibrate. It may change how
long things take, never an answer.
```
*/
#[repr(C)]
#[derive(Debug)]
pub struct rw_profile {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_profile_info {
    pub struct_size: u32,
    /// RW_PROFILE_SOURCE_
    pub source: i32,
    /// RW_OK, or why a file was passed over that comes before `source`: the first of them
    pub status: i32,
    /// calibration epoch of the constants
    pub epoch: u32,
    /// of the file in use; empty for the generic constants
    pub path: *const ::std::os::raw::c_char,
    /// key of the machine it was measured on; "generic"
    pub machine: *const ::std::os::raw::c_char,
    /// when it was measured, ISO 8601
    pub date: *const ::std::os::raw::c_char,
    /// the program and version that measured it
    pub tool: *const ::std::os::raw::c_char,
    /// relative spread of repeated timings, 0.05 = 5 %
    pub spread: f64,
    /// threads the machine offered when it was measured
    pub threads: u32,
    /// receives 0
    pub reserved: u32,
}
#[test]
fn bindgen_test_layout_rw_profile_info() {
    const UNINIT: ::std::mem::MaybeUninit<rw_profile_info> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_profile_info>(),
        64usize,
        "Size of rw_profile_info",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_profile_info>(),
        8usize,
        "Alignment of rw_profile_info",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_profile_info::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).source) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_profile_info::source",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).status) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_profile_info::status",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).epoch) as usize - ptr as usize },
        12usize,
        "Offset of field: rw_profile_info::epoch",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).path) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_profile_info::path",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).machine) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_profile_info::machine",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).date) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_profile_info::date",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tool) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_profile_info::tool",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).spread) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_profile_info::spread",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).threads) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_profile_info::threads",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        60usize,
        "Offset of field: rw_profile_info::reserved",
    );
}
impl Default for rw_profile_info {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
A triangle mesh in the caller's memory. Hits name a triangle by its position in `indices`. Degenerate
triangles (no area) are legal and are never hit.
```
*/
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_triangles {
    pub struct_size: u32,
    /// RW_TRIANGLES_
    pub flags: u32,
    /// below 2^32
    pub vertex_count: u64,
    /// vertex_count elements of 3 components, float32 or float64
    pub vertices: rw_array,
    /// below 2^32 - 1; may be 0
    pub triangle_count: u64,
    /**
```text
triangle_count elements of 3 components, uint32 or uint64; data NULL: triangle i has
the vertices 3i, 3i+1, 3i+2, and vertex_count has to be 3 * triangle_count
```
*/
    pub indices: rw_array,
}
#[test]
fn bindgen_test_layout_rw_triangles() {
    const UNINIT: ::std::mem::MaybeUninit<rw_triangles> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_triangles>(), 88usize, "Size of rw_triangles");
    assert_eq!(
        ::std::mem::align_of::<rw_triangles>(),
        8usize,
        "Alignment of rw_triangles",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_triangles::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).flags) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_triangles::flags",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).vertex_count) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_triangles::vertex_count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).vertices) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_triangles::vertices",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).triangle_count) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_triangles::triangle_count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).indices) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_triangles::indices",
    );
}
impl Default for rw_triangles {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/// A mesh read from a file.
#[repr(C)]
#[derive(Debug)]
pub struct rw_mesh {
    _unused: [u8; 0],
}
/// One ray.
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_ray {
    pub origin: [f64; 3usize],
    /// 0 for a ray that starts at its origin
    pub tmin: f64,
    pub direction: [f64; 3usize],
    /// INFINITY for a ray without an end
    pub tmax: f64,
}
#[test]
fn bindgen_test_layout_rw_ray() {
    const UNINIT: ::std::mem::MaybeUninit<rw_ray> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_ray>(), 64usize, "Size of rw_ray");
    assert_eq!(::std::mem::align_of::<rw_ray>(), 8usize, "Alignment of rw_ray");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).origin) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_ray::origin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmin) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_ray::tmin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).direction) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_ray::direction",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmax) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_ray::tmax",
    );
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_ray_f32 {
    pub origin: [f32; 3usize],
    pub tmin: f32,
    pub direction: [f32; 3usize],
    pub tmax: f32,
}
#[test]
fn bindgen_test_layout_rw_ray_f32() {
    const UNINIT: ::std::mem::MaybeUninit<rw_ray_f32> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_ray_f32>(), 32usize, "Size of rw_ray_f32");
    assert_eq!(::std::mem::align_of::<rw_ray_f32>(), 4usize, "Alignment of rw_ray_f32");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).origin) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_ray_f32::origin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmin) as usize - ptr as usize },
        12usize,
        "Offset of field: rw_ray_f32::tmin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).direction) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_ray_f32::direction",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmax) as usize - ptr as usize },
        28usize,
        "Offset of field: rw_ray_f32::tmax",
    );
}
/// A triangle by its ids: the last three of a rw_hit, in the same order.
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_primitive_id {
    /// RW_INVALID_ID while the scene has no instances
    pub instance: u32,
    /// below the number of meshes
    pub geometry: u32,
    /// below the mesh's triangle_count; RW_INVALID_ID: the entry stands for nothing
    pub primitive: u32,
}
#[test]
fn bindgen_test_layout_rw_primitive_id() {
    const UNINIT: ::std::mem::MaybeUninit<rw_primitive_id> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_primitive_id>(),
        12usize,
        "Size of rw_primitive_id",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_primitive_id>(),
        4usize,
        "Alignment of rw_primitive_id",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).instance) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_primitive_id::instance",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_primitive_id::geometry",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).primitive) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_primitive_id::primitive",
    );
}
/// What else there is to say of one ray.
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_ray_options {
    pub struct_size: u32,
    pub skip_count: u32,
    /**
```text
skip_count triangles that the ray passes through without a hit, in any order, repeats allowed; NULL when
skip_count is 0.
```
*/
    pub skip: *const rw_primitive_id,
}
#[test]
fn bindgen_test_layout_rw_ray_options() {
    const UNINIT: ::std::mem::MaybeUninit<rw_ray_options> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_ray_options>(),
        16usize,
        "Size of rw_ray_options",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_ray_options>(),
        8usize,
        "Alignment of rw_ray_options",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_ray_options::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skip_count) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_ray_options::skip_count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skip) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_ray_options::skip",
    );
}
impl Default for rw_ray_options {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
One answer. The point hit is origin + t * direction = (1 - u - v) * v0 + u * v1 + v * v2. The normal is asked for
where it is wanted: rw_scene_normal.
A miss has t = INFINITY, u = v = 0 and RW_INVALID_ID in all ids.
```
*/
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_hit {
    pub t: f64,
    pub u: f64,
    pub v: f64,
    /// RW_INVALID_ID while the scene has no instances
    pub instance: u32,
    /// as given by rw_scene_add_triangles
    pub geometry: u32,
    /// position of the triangle in its mesh
    pub primitive: u32,
    /// receives 0
    pub reserved: u32,
}
#[test]
fn bindgen_test_layout_rw_hit() {
    const UNINIT: ::std::mem::MaybeUninit<rw_hit> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_hit>(), 40usize, "Size of rw_hit");
    assert_eq!(::std::mem::align_of::<rw_hit>(), 8usize, "Alignment of rw_hit");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).t) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_hit::t",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).u) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_hit::u",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).v) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_hit::v",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).instance) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_hit::instance",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry) as usize - ptr as usize },
        28usize,
        "Offset of field: rw_hit::geometry",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).primitive) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_hit::primitive",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        36usize,
        "Offset of field: rw_hit::reserved",
    );
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_hit_f32 {
    pub t: f32,
    pub u: f32,
    pub v: f32,
    pub instance: u32,
    pub geometry: u32,
    pub primitive: u32,
}
#[test]
fn bindgen_test_layout_rw_hit_f32() {
    const UNINIT: ::std::mem::MaybeUninit<rw_hit_f32> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_hit_f32>(), 24usize, "Size of rw_hit_f32");
    assert_eq!(::std::mem::align_of::<rw_hit_f32>(), 4usize, "Alignment of rw_hit_f32");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).t) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_hit_f32::t",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).u) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_hit_f32::u",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).v) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_hit_f32::v",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).instance) as usize - ptr as usize },
        12usize,
        "Offset of field: rw_hit_f32::instance",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_hit_f32::geometry",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).primitive) as usize - ptr as usize },
        20usize,
        "Offset of field: rw_hit_f32::primitive",
    );
}
/// Many rays.
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_rays {
    pub struct_size: u32,
    /// 0
    pub flags: u32,
    pub count: u64,
    /// 3 components, float32 or float64
    pub origin: rw_array,
    /// 3 components, float32 or float64
    pub direction: rw_array,
    /// 1 component, float32 or float64; data NULL: 0
    pub tmin: rw_array,
    /// 1 component, float32 or float64; data NULL: INFINITY
    pub tmax: rw_array,
    /**
```text
Triangles that single rays pass through without a hit: the one a ray starts on, say, or those it has met before.
Entry k is the pair skip_geometry[k], skip_primitive[k]; ids as hits carry them, so that outputs of one batch can
be the input of the next. A primitive with all bits set (RW_INVALID_ID, 2^64 - 1) stands for nothing.
skip_offsets: count + 1 numbers that never fall: ray i has the entries skip_offsets[i] up to, but without,
skip_offsets[i + 1]; NULL: entry i alone is for ray i.
```
*/
    pub skip_offsets: *const u64,
    /// 1 component, uint32 or uint64; data NULL: geometry 0 for all
    pub skip_geometry: rw_array,
    /// 1 component, uint32 or uint64; data NULL: nothing is skipped
    pub skip_primitive: rw_array,
}
#[test]
fn bindgen_test_layout_rw_rays() {
    const UNINIT: ::std::mem::MaybeUninit<rw_rays> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_rays>(), 216usize, "Size of rw_rays");
    assert_eq!(::std::mem::align_of::<rw_rays>(), 8usize, "Alignment of rw_rays");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_rays::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).flags) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_rays::flags",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).count) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_rays::count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).origin) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_rays::origin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).direction) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_rays::direction",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmin) as usize - ptr as usize },
        80usize,
        "Offset of field: rw_rays::tmin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).tmax) as usize - ptr as usize },
        112usize,
        "Offset of field: rw_rays::tmax",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skip_offsets) as usize - ptr as usize },
        144usize,
        "Offset of field: rw_rays::skip_offsets",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skip_geometry) as usize - ptr as usize },
        152usize,
        "Offset of field: rw_rays::skip_geometry",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skip_primitive) as usize - ptr as usize },
        184usize,
        "Offset of field: rw_rays::skip_primitive",
    );
}
impl Default for rw_rays {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/// Where the answers to many rays go, in the order of the rays: those of rw_hit, rounded to the output's type.
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_hits {
    pub struct_size: u32,
    /// 0
    pub flags: u32,
    /// float32 or float64
    pub t: rw_output,
    /// 2 components, float32 or float64
    pub uv: rw_output,
    /// 3 components, float32 or float64: as rw_scene_normal; zero for a miss
    pub normal: rw_output,
    /// uint32 or uint64 (a missing id is then 2^64 - 1)
    pub instance: rw_output,
    /// uint32 or uint64
    pub geometry: rw_output,
    /// uint32 or uint64
    pub primitive: rw_output,
}
#[test]
fn bindgen_test_layout_rw_hits() {
    const UNINIT: ::std::mem::MaybeUninit<rw_hits> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_hits>(), 200usize, "Size of rw_hits");
    assert_eq!(::std::mem::align_of::<rw_hits>(), 8usize, "Alignment of rw_hits");
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_hits::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).flags) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_hits::flags",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).t) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_hits::t",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).uv) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_hits::uv",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).normal) as usize - ptr as usize },
        72usize,
        "Offset of field: rw_hits::normal",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).instance) as usize - ptr as usize },
        104usize,
        "Offset of field: rw_hits::instance",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry) as usize - ptr as usize },
        136usize,
        "Offset of field: rw_hits::geometry",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).primitive) as usize - ptr as usize },
        168usize,
        "Offset of field: rw_hits::primitive",
    );
}
impl Default for rw_hits {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
A progress callback: user as given, fraction from 0 to 1, stage a constant text. Not 0 asks to stop. It is called at
least once per commit, refit, view and batch, never from two threads at once. Commits, refits and views call it
from any of the threads at work. Batches call it from the thread that asked, about every ten milliseconds; with a
parallel_for from any of the host's threads at work.
```
*/
pub type rw_progress = ::std::option::Option<
    unsafe extern "C" fn(
        user: *mut ::std::os::raw::c_void,
        fraction: f64,
        stage: *const ::std::os::raw::c_char,
    ) -> i32,
>;
/**
```text
The memory that batches take while they run, kept from one to the next: a batch like the one before then takes none
from the system, but for what oneTBB or a parallel_for may take. For hosts that ask in a loop; of use to any scene. It
grows to what the largest of its batches took: 48 bytes a ray, 80 where not all of the rays' numbers are float32, for at
most 2^20 rays, and 1 MiB for each thread; for all hits 24 bytes a ray and 32 a hit besides.
```
*/
#[repr(C)]
#[derive(Debug)]
pub struct rw_batch_workspace {
    _unused: [u8; 0],
}
/**
```text
How to run a batch. Whether to stop is looked at by every thread at work, every few milliseconds, and more seldom
only where a single ray takes longer. The batch then returns RW_ERROR_CANCELLED: outputs that were written are
right, others are as they were, and offsets, needed and invalid_rays are not written.
```
*/
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_query_options {
    pub struct_size: u32,
    /// at most so many; 0: as many as the process may use
    pub threads: u32,
    /// NULL: the library's own threads
    pub parallel_for: rw_parallel_for,
    /// handed to parallel_for
    pub parallel_user: *mut ::std::os::raw::c_void,
    /// receives how many rays held a NaN; NULL: not wanted
    pub invalid_rays: *mut u64,
    /// NULL: none
    pub progress: rw_progress,
    /// handed to progress
    pub progress_user: *mut ::std::os::raw::c_void,
    /**
```text
Not 0 asks to stop; NULL: none. Read with relaxed atomic loads, so any thread may set it at any time by an atomic
store (_Atomic int32_t, std::atomic<int32_t>), and a signal handler by a plain one. Aligned to 4 bytes; only
read, and no byte of it may belong to an output.
```
*/
    pub cancel: *const i32,
    /**
```text
NULL: memory of the batch's own. It serves one batch at a time: RW_ERROR_IN_USE, and nothing is written, while
another one is at it, be it of another scene or thread or the one whose callback asks.
```
*/
    pub workspace: *mut rw_batch_workspace,
}
#[test]
fn bindgen_test_layout_rw_query_options() {
    const UNINIT: ::std::mem::MaybeUninit<rw_query_options> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_query_options>(),
        64usize,
        "Size of rw_query_options",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_query_options>(),
        8usize,
        "Alignment of rw_query_options",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_query_options::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).threads) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_query_options::threads",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).parallel_for) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_query_options::parallel_for",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).parallel_user) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_query_options::parallel_user",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).invalid_rays) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_query_options::invalid_rays",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).progress) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_query_options::progress",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).progress_user) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_query_options::progress_user",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).cancel) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_query_options::cancel",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).workspace) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_query_options::workspace",
    );
}
impl Default for rw_query_options {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
Geometry with the structure chosen for it. Fill it, say what is expected of it, commit it; from then on it never
changes. A view of a scene (rw_scene_view) is a scene as well.
```
*/
#[repr(C)]
#[derive(Debug)]
pub struct rw_scene {
    _unused: [u8; 0],
}
/// What the scene will be asked. A wrong word here costs time, never an answer.
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_expected_rays {
    pub struct_size: u32,
    /// RW_RAYS_ kind
    pub kind: i32,
    /// 1 ... RW_RAYS_LIMIT, or RW_RAYS_UNKNOWN; 0 is an error, so that a forgotten count shows
    pub count: u64,
    /**
```text
Some of the caller's rays, for RW_EFFORT_PROBE and RW_EFFORT_MEASURE and RW_RULE_HAPALA; copied, at most the
first 1,000, without their skip lists; NULL: rays of that kind are made up.
```
*/
    pub sample: *const rw_rays,
}
#[test]
fn bindgen_test_layout_rw_expected_rays() {
    const UNINIT: ::std::mem::MaybeUninit<rw_expected_rays> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_expected_rays>(),
        24usize,
        "Size of rw_expected_rays",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_expected_rays>(),
        8usize,
        "Alignment of rw_expected_rays",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_expected_rays::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).kind) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_expected_rays::kind",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).count) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_expected_rays::count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).sample) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_expected_rays::sample",
    );
}
impl Default for rw_expected_rays {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_commit_options {
    pub struct_size: u32,
    /// at most so many; 0: as many as the process may use
    pub threads: u32,
    /// NULL: none
    pub progress: rw_progress,
    /// handed to progress
    pub progress_user: *mut ::std::os::raw::c_void,
    /// NULL: the library's own threads
    pub parallel_for: rw_parallel_for,
    /// handed to parallel_for
    pub parallel_user: *mut ::std::os::raw::c_void,
    /// RW_REFIT_, for rw_scene_refit; of no effect elsewhere
    pub refit: i32,
    /// 0
    pub reserved: i32,
}
#[test]
fn bindgen_test_layout_rw_commit_options() {
    const UNINIT: ::std::mem::MaybeUninit<rw_commit_options> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_commit_options>(),
        48usize,
        "Size of rw_commit_options",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_commit_options>(),
        8usize,
        "Alignment of rw_commit_options",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_commit_options::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).threads) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_commit_options::threads",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).progress) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_commit_options::progress",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).progress_user) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_commit_options::progress_user",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).parallel_for) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_commit_options::parallel_for",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).parallel_user) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_commit_options::parallel_user",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).refit) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_commit_options::refit",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        44usize,
        "Offset of field: rw_commit_options::reserved",
    );
}
impl Default for rw_commit_options {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_scene_statistics {
    pub struct_size: u32,
    pub geometry_count: u32,
    /// all, degenerate and invalid ones included
    pub triangle_count: u64,
    /// without area: never hit
    pub degenerate_triangles: u64,
    /// skipped by RW_TRIANGLES_SKIP_INVALID: never hit
    pub invalid_triangles: u64,
    /// the one in use
    pub structure: *const ::std::os::raw::c_char,
    /// time spent on choosing
    pub decide_ns: f64,
    /// time spent on building what is in use
    pub build_ns: f64,
    /// memory of the structure
    pub structure_bytes: u64,
    /// memory of copied meshes, which a view has in common with its scene
    pub geometry_bytes: u64,
    /// answered in batches so far
    pub rays: u64,
    /// rays with a NaN so far, single calls included
    pub invalid_rays: u64,
    /// wall time of those batches
    pub rays_ns: f64,
    /// how often the structure was refitted since it was built.
    pub refits: u64,
}
#[test]
fn bindgen_test_layout_rw_scene_statistics() {
    const UNINIT: ::std::mem::MaybeUninit<rw_scene_statistics> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_scene_statistics>(),
        104usize,
        "Size of rw_scene_statistics",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_scene_statistics>(),
        8usize,
        "Alignment of rw_scene_statistics",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_scene_statistics::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry_count) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_scene_statistics::geometry_count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).triangle_count) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_scene_statistics::triangle_count",
    );
    assert_eq!(
        unsafe {
            ::std::ptr::addr_of!((*ptr).degenerate_triangles) as usize - ptr as usize
        },
        16usize,
        "Offset of field: rw_scene_statistics::degenerate_triangles",
    );
    assert_eq!(
        unsafe {
            ::std::ptr::addr_of!((*ptr).invalid_triangles) as usize - ptr as usize
        },
        24usize,
        "Offset of field: rw_scene_statistics::invalid_triangles",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).structure) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_scene_statistics::structure",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).decide_ns) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_scene_statistics::decide_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).build_ns) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_scene_statistics::build_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).structure_bytes) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_scene_statistics::structure_bytes",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).geometry_bytes) as usize - ptr as usize },
        64usize,
        "Offset of field: rw_scene_statistics::geometry_bytes",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).rays) as usize - ptr as usize },
        72usize,
        "Offset of field: rw_scene_statistics::rays",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).invalid_rays) as usize - ptr as usize },
        80usize,
        "Offset of field: rw_scene_statistics::invalid_rays",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).rays_ns) as usize - ptr as usize },
        88usize,
        "Offset of field: rw_scene_statistics::rays_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).refits) as usize - ptr as usize },
        96usize,
        "Offset of field: rw_scene_statistics::refits",
    );
}
impl Default for rw_scene_statistics {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
Statistics over the t cells of a uniform grid, of which cell i has n_i references: Hapala, Karlik, Havran 2011, eq.
1 to 6.
```
*/
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct rw_grid_statistics {
    pub struct_size: u32,
    pub resolution: [u32; 3usize],
    pub cells: u64,
    pub empty_cells: u64,
    pub references: u64,
    /// eq. 2
    pub max_references: u64,
    /// eq. 1: empty cells / cells
    pub sparseness: f64,
    /// eq. 3: references per cell
    pub mean: f64,
    /// eq. 4: sum of (n_i - mean)^2 / (t - 1); 0 for a single cell
    pub variance: f64,
    /// square root of the variance
    pub standard_deviation: f64,
    /// eq. 5: sum of (n_i - mean)^3 / t / standard_deviation^3; 0 when the variance is 0
    pub skewness: f64,
    /**
```text
eq. 6: sum of (n_i - mean)^4 / t / variance^2, minus 3, so that it is about 0 for a normal
distribution (excess kurtosis); 0 when the variance is 0
```
*/
    pub kurtosis: f64,
}
#[test]
fn bindgen_test_layout_rw_grid_statistics() {
    const UNINIT: ::std::mem::MaybeUninit<rw_grid_statistics> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_grid_statistics>(),
        96usize,
        "Size of rw_grid_statistics",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_grid_statistics>(),
        8usize,
        "Alignment of rw_grid_statistics",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_grid_statistics::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).resolution) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_grid_statistics::resolution",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).cells) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_grid_statistics::cells",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).empty_cells) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_grid_statistics::empty_cells",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).references) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_grid_statistics::references",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).max_references) as usize - ptr as usize },
        40usize,
        "Offset of field: rw_grid_statistics::max_references",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).sparseness) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_grid_statistics::sparseness",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).mean) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_grid_statistics::mean",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).variance) as usize - ptr as usize },
        64usize,
        "Offset of field: rw_grid_statistics::variance",
    );
    assert_eq!(
        unsafe {
            ::std::ptr::addr_of!((*ptr).standard_deviation) as usize - ptr as usize
        },
        72usize,
        "Offset of field: rw_grid_statistics::standard_deviation",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).skewness) as usize - ptr as usize },
        80usize,
        "Offset of field: rw_grid_statistics::skewness",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).kurtosis) as usize - ptr as usize },
        88usize,
        "Offset of field: rw_grid_statistics::kurtosis",
    );
}
/// One structure as the decision saw it. NaN stands for a figure that is not known.
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_candidate {
    pub struct_size: u32,
    /// RW_CANDIDATE_
    pub flags: u32,
    /// a constant text
    pub structure: *const ::std::os::raw::c_char,
    pub predicted_build_ns: f64,
    /// per ray of the expected kind
    pub predicted_ray_ns: f64,
    /// relative residual of the calibration, 0.2 = 20 %
    pub predicted_error: f64,
    /// build + expected rays; NaN when their number is unknown
    pub predicted_total_ns: f64,
    /// from so many rays on it beats the chosen one; INFINITY: never; NaN for the chosen one
    pub break_even_rays: f64,
    pub predicted_bytes: u64,
    /// 0: not known
    pub actual_bytes: u64,
    pub actual_build_ns: f64,
    /// of the batches so far, or of the sample while choosing
    pub actual_ray_ns: f64,
}
#[test]
fn bindgen_test_layout_rw_candidate() {
    const UNINIT: ::std::mem::MaybeUninit<rw_candidate> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(::std::mem::size_of::<rw_candidate>(), 88usize, "Size of rw_candidate");
    assert_eq!(
        ::std::mem::align_of::<rw_candidate>(),
        8usize,
        "Alignment of rw_candidate",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_candidate::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).flags) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_candidate::flags",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).structure) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_candidate::structure",
    );
    assert_eq!(
        unsafe {
            ::std::ptr::addr_of!((*ptr).predicted_build_ns) as usize - ptr as usize
        },
        16usize,
        "Offset of field: rw_candidate::predicted_build_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).predicted_ray_ns) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_candidate::predicted_ray_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).predicted_error) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_candidate::predicted_error",
    );
    assert_eq!(
        unsafe {
            ::std::ptr::addr_of!((*ptr).predicted_total_ns) as usize - ptr as usize
        },
        40usize,
        "Offset of field: rw_candidate::predicted_total_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).break_even_rays) as usize - ptr as usize },
        48usize,
        "Offset of field: rw_candidate::break_even_rays",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).predicted_bytes) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_candidate::predicted_bytes",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).actual_bytes) as usize - ptr as usize },
        64usize,
        "Offset of field: rw_candidate::actual_bytes",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).actual_build_ns) as usize - ptr as usize },
        72usize,
        "Offset of field: rw_candidate::actual_build_ns",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).actual_ray_ns) as usize - ptr as usize },
        80usize,
        "Offset of field: rw_candidate::actual_ray_ns",
    );
}
impl Default for rw_candidate {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_view_options {
    pub struct_size: u32,
    /// RW_VIEW_
    pub kind: i32,
    /// RW_VIEW_POINT: the point
    pub origin: [f64; 3usize],
    /**
```text
RW_VIEW_DIRECTION: the direction, any length but zero. RW_VIEW_POINT: where the view looks;
all zero: all around, a cube of six planes
```
*/
    pub direction: [f64; 3usize],
    /**
```text
RW_VIEW_POINT with a direction: radians from the direction to the farthest ray, below pi/2;
0: pi/4. Rays outside are answered as by the scene.
```
*/
    pub half_angle: f64,
    /// expected rays: 1 ... RW_RAYS_LIMIT or RW_RAYS_UNKNOWN; 0 is an error
    pub count: u64,
    /// RW_RAYS_ kind, as a rule RW_RAYS_CAMERA or RW_RAYS_SHADOW; 0: camera
    pub ray_kind: i32,
    /// 0
    pub reserved: i32,
    /// forces a structure by name; NULL: the library chooses, the scene's own one included
    pub structure: *const ::std::os::raw::c_char,
}
#[test]
fn bindgen_test_layout_rw_view_options() {
    const UNINIT: ::std::mem::MaybeUninit<rw_view_options> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_view_options>(),
        88usize,
        "Size of rw_view_options",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_view_options>(),
        8usize,
        "Alignment of rw_view_options",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_view_options::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).kind) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_view_options::kind",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).origin) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_view_options::origin",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).direction) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_view_options::direction",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).half_angle) as usize - ptr as usize },
        56usize,
        "Offset of field: rw_view_options::half_angle",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).count) as usize - ptr as usize },
        64usize,
        "Offset of field: rw_view_options::count",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).ray_kind) as usize - ptr as usize },
        72usize,
        "Offset of field: rw_view_options::ray_kind",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).reserved) as usize - ptr as usize },
        76usize,
        "Offset of field: rw_view_options::reserved",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).structure) as usize - ptr as usize },
        80usize,
        "Offset of field: rw_view_options::structure",
    );
}
impl Default for rw_view_options {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
/**
```text
------------------------------------------------------------------------------------------------
One shot: the number of rays is known and nothing is kept
------------------------------------------------------------------------------------------------
```
*/
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct rw_once_options {
    pub struct_size: u32,
    /// RW_RAYS_ kind of the rays
    pub kind: i32,
    /// NULL: the one that rw_profile_load(NULL) gives, looked up once in a process
    pub profile: *const rw_profile,
    /// forces a structure by name; NULL: the library chooses
    pub structure: *const ::std::os::raw::c_char,
    /// bytes of the structure; 0: no limit
    pub memory_limit: u64,
    /// NULL: the defaults
    pub query: *const rw_query_options,
}
#[test]
fn bindgen_test_layout_rw_once_options() {
    const UNINIT: ::std::mem::MaybeUninit<rw_once_options> = ::std::mem::MaybeUninit::uninit();
    let ptr = UNINIT.as_ptr();
    assert_eq!(
        ::std::mem::size_of::<rw_once_options>(),
        40usize,
        "Size of rw_once_options",
    );
    assert_eq!(
        ::std::mem::align_of::<rw_once_options>(),
        8usize,
        "Alignment of rw_once_options",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).struct_size) as usize - ptr as usize },
        0usize,
        "Offset of field: rw_once_options::struct_size",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).kind) as usize - ptr as usize },
        4usize,
        "Offset of field: rw_once_options::kind",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).profile) as usize - ptr as usize },
        8usize,
        "Offset of field: rw_once_options::profile",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).structure) as usize - ptr as usize },
        16usize,
        "Offset of field: rw_once_options::structure",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).memory_limit) as usize - ptr as usize },
        24usize,
        "Offset of field: rw_once_options::memory_limit",
    );
    assert_eq!(
        unsafe { ::std::ptr::addr_of!((*ptr).query) as usize - ptr as usize },
        32usize,
        "Offset of field: rw_once_options::query",
    );
}
impl Default for rw_once_options {
    fn default() -> Self {
        let mut s = ::std::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::std::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    /**
```text
Does: tells the version of the library that was loaded, which may differ from the header's.
major, minor, patch: each may be NULL (not wanted).
Returns: RW_OK.
```
*/
    pub fn rw_version(major: *mut u32, minor: *mut u32, patch: *mut u32) -> i32;
    /**
```text
Does: tells the binary interface of the library that was loaded; compare it with RW_ABI_VERSION after dlopen.
abi: receives the number.
Returns: RW_OK.
```
*/
    pub fn rw_abi_version(abi: *mut u32) -> i32;
    /**
```text
Does: puts a status into words.
status: any value.
Returns: a constant English sentence, never NULL; an unknown status has a text as well.
Owner: the library; valid for ever.
```
*/
    pub fn rw_status_text(status: i32) -> *const ::std::os::raw::c_char;
    /**
```text
Does: tells what went wrong in the calling thread's latest raywise call that did not return RW_OK,
naming the argument and the element, e.g. "triangle 17: index 9000 is out of range, the mesh has 507
vertices".
Returns: a text, never NULL; empty before the first error. Calls that return RW_OK leave it as it was.
Owner: the library; valid until the thread's next raywise call that does not return RW_OK. Threads: each has its
own.
```
*/
    pub fn rw_last_error_message() -> *const ::std::os::raw::c_char;
    /**
```text
Does: hands out a profile. With a path: reads that file, anew with each call. With NULL: the first valid one of the
file named by the environment variable RAYWISE_CALIBRATION ("builtin" there means the generic constants), the
user's cache folder ($XDG_CACHE_HOME or ~/.cache, then raywise/<machine key>.json) and the system's folder
(/etc/raywise/<machine key>.json). The machine key names the processor, the instruction set that the library uses
on it, the last cache's size and the number of usable threads; `raywise-calibrate --help` prints these paths.
These places are looked at once in a process, by the first call that needs a profile and is given none; it is kept,
and what files and environment say later goes unseen. A profile written since can be loaded by its path.
path: UTF-8, or NULL.
profile: receives a profile the caller must release.
Returns: RW_OK when the file was used, or when path is NULL and there was no file at all. An RW_PROFILE_ status
when a file was passed over (that of the first): *profile is then set all the same, with a path to the generic
constants, with NULL to the next valid file's or the generic constants. RW_ERROR_INVALID_ARGUMENT and
RW_ERROR_OUT_OF_MEMORY set nothing.
```
*/
    pub fn rw_profile_load(
        path: *const ::std::os::raw::c_char,
        profile: *mut *mut rw_profile,
    ) -> i32;
    /// Does: adds a reference. Returns: RW_OK.
    pub fn rw_profile_retain(profile: *const rw_profile) -> i32;
    /// Does: gives a reference back; the last one frees. profile: may be NULL. Returns: RW_OK.
    pub fn rw_profile_release(profile: *const rw_profile) -> i32;
    /**
```text
Does: tells where a profile came from.
info: struct_size set; receives the facts. Texts belong to the profile.
Returns: RW_OK.
```
*/
    pub fn rw_profile_inspect(
        profile: *const rw_profile,
        info: *mut rw_profile_info,
    ) -> i32;
    /**
```text
Does: writes the whole profile, every constant with its unit, as text for people or as JSON.
format: RW_FORMAT_TEXT or RW_FORMAT_JSON.
buffer: of capacity bytes, or NULL with capacity 0 to ask for the size only.
needed: receives the bytes it takes, the final zero included; may be NULL.
Returns: RW_OK; RW_ERROR_CAPACITY when buffer is too small (it then holds the beginning, zero-terminated). Asking
for the size only is RW_OK.
```
*/
    pub fn rw_profile_text(
        profile: *const rw_profile,
        format: i32,
        buffer: *mut ::std::os::raw::c_char,
        capacity: u64,
        needed: *mut u64,
    ) -> i32;
    /**
```text
Does: reads an OBJ, PLY, OFF or STL file. A face of n corners becomes n - 2 triangles of its corners, faces in the
order of the file. A convex face becomes the fan about its first corner: (0, 1, 2), (0, 2, 3) and so on. Any other
is cut ear by ear, as seen in the coordinate plane where its area is largest, on exact signs: the corners are
looked at in the order 1, 2 ... n - 1, 0, each one is cut off where the triangle with its neighbours holds nothing
else of the outline, and then those next to a cut, in the order of the cuts. Each triangle has its corners in the
order of the face, beginning with the lowest position. The triangles cover the inside once and nothing else, also
with holes that are joined to the outline by lines there and back, and where the outline touches itself; some have
no area where corners are in line or repeated. A face whose outline crosses itself, or without area, still becomes
n - 2 triangles of its corners, always the same ones and none beyond its convex hull. Once no ear is left, corners
in line with their neighbours are cut off, then any that turns the way the face does, then any. Vertices and faces
are those of the file, in its order. Coordinates are as written: all float64 where float32 would change any, else
all float32. What is wrong with a file is said with the line (of text) or byte where it is. docs/mesh-files.md has
more.
path: UTF-8, or whatever bytes the system names the file by; the ending tells the format.
mesh: receives a mesh the caller must release.
Returns: RW_OK, RW_ERROR_FILE_NOT_FOUND, RW_ERROR_FILE_UNREADABLE, RW_ERROR_FILE_FORMAT, RW_ERROR_NO_FACES,
RW_ERROR_BAD_POLYGON, RW_ERROR_INDEX_OUT_OF_RANGE, RW_ERROR_NOT_FINITE, RW_ERROR_TOO_MANY.
```
*/
    pub fn rw_mesh_load(
        path: *const ::std::os::raw::c_char,
        mesh: *mut *mut rw_mesh,
    ) -> i32;
    /// Does: adds a reference. Returns: RW_OK.
    pub fn rw_mesh_retain(mesh: *const rw_mesh) -> i32;
    /// Does: gives a reference back; the last one frees. mesh: may be NULL. Returns: RW_OK.
    pub fn rw_mesh_release(mesh: *const rw_mesh) -> i32;
    /**
```text
Does: describes the arrays of a mesh, ready for rw_scene_add_triangles.
triangles: struct_size set; receives pointers into the mesh. vertices.type is RW_FLOAT32 or RW_FLOAT64, which
depends on the file (see rw_mesh_load); indices.type is RW_UINT32.
Owner: the arrays belong to the mesh and live as long as it does; a scene that shares them (RW_TRIANGLES_SHARED)
needs the mesh to be kept. Returns: RW_OK.
```
*/
    pub fn rw_mesh_triangles(mesh: *const rw_mesh, triangles: *mut rw_triangles) -> i32;
    /**
```text
Does: tells which face of the file each triangle was cut from.
face_of_triangle: receives a pointer to one uint32 per triangle, owned by the mesh.
face_count: receives the faces in the file; may be NULL.
Returns: RW_OK.
```
*/
    pub fn rw_mesh_faces(
        mesh: *const rw_mesh,
        face_of_triangle: *mut *const u32,
        face_count: *mut u64,
    ) -> i32;
    /**
```text
Does: makes a workspace, which is empty until it is used. workspace: receives it; the caller must release it.
Returns: RW_OK.
```
*/
    pub fn rw_batch_workspace_create(workspace: *mut *mut rw_batch_workspace) -> i32;
    /// Does: frees a workspace. workspace: may be NULL; no batch may be using it. Returns: RW_OK.
    pub fn rw_batch_workspace_release(workspace: *mut rw_batch_workspace) -> i32;
    /**
```text
Does: counts the structures the library can choose from.
Returns: RW_OK.
```
*/
    pub fn rw_structure_count(count: *mut u32) -> i32;
    /**
```text
Does: names a structure: "linear_scan", "uniform_grid", "kd_tree", "bvh", "projected_bvh", "bvh_quality",
"bvh_morton", "two_level_grid". Names stay, and so does their order; more may follow.
index: below the count. name: receives a constant text.
Returns: RW_OK.
```
*/
    pub fn rw_structure_name(
        index: u32,
        name: *mut *const ::std::os::raw::c_char,
    ) -> i32;
    /**
```text
Does: makes an empty scene.
profile: the constants to decide with; retained by the scene. NULL: the one that rw_profile_load(NULL) gives,
looked up once in a process.
scene: receives a scene the caller must release.
Returns: RW_OK.
```
*/
    pub fn rw_scene_create(profile: *const rw_profile, scene: *mut *mut rw_scene) -> i32;
    /// Does: adds a reference. Returns: RW_OK.
    pub fn rw_scene_retain(scene: *const rw_scene) -> i32;
    /// Does: gives a reference back; the last one frees. scene: may be NULL. Returns: RW_OK.
    pub fn rw_scene_release(scene: *const rw_scene) -> i32;
    /**
```text
Does: adds a mesh. Every vertex and index is checked here.
triangles: struct_size set. Copied unless RW_TRIANGLES_SHARED.
geometry: receives the mesh's id: 0, 1, 2 ... in the order of adding; may be NULL.
Returns: RW_OK, RW_ERROR_NOT_FINITE, RW_ERROR_COORDINATE_RANGE,
RW_ERROR_INDEX_OUT_OF_RANGE, RW_ERROR_TOO_MANY, RW_ERROR_ALREADY_COMMITTED, RW_ERROR_RESERVED.
On an error the scene is as it was.
```
*/
    pub fn rw_scene_add_triangles(
        scene: *mut rw_scene,
        triangles: *const rw_triangles,
        geometry: *mut u32,
    ) -> i32;
    /**
```text
Does: says how many rays of which kind are coming. A scene that is not told reckons with RW_RAYS_UNKNOWN.
expected: struct_size set.
Returns: RW_OK, RW_ERROR_RAY_COUNT, RW_ERROR_TOO_MANY (a sample above RW_RAYS_LIMIT),
RW_ERROR_ALREADY_COMMITTED, RW_ERROR_RESERVED (the sample).
```
*/
    pub fn rw_scene_set_expected_rays(
        scene: *mut rw_scene,
        expected: *const rw_expected_rays,
    ) -> i32;
    /**
```text
Does: bounds the memory that the structure may take, the caller's own arrays not counted.
bytes: 0: no limit.
Returns: RW_OK, RW_ERROR_ALREADY_COMMITTED.
```
*/
    pub fn rw_scene_set_memory_limit(scene: *mut rw_scene, bytes: u64) -> i32;
    /**
```text
Does: forces a structure by name. Every structure can be forced on every scene; projected_bvh, which is meant for
views, then works as a hierarchy without projections.
name: one of rw_structure_name; NULL: the library chooses again.
Returns: RW_OK, RW_ERROR_UNKNOWN_STRUCTURE, RW_ERROR_ALREADY_COMMITTED.
```
*/
    pub fn rw_scene_set_structure(
        scene: *mut rw_scene,
        name: *const ::std::os::raw::c_char,
    ) -> i32;
    /**
```text
Does: sets effort and rule of the choice.
effort: RW_EFFORT_. rule: RW_RULE_.
time_limit_seconds: RW_EFFORT_MEASURE starts no further build after so long; 0: no limit.
Returns: RW_OK, RW_ERROR_ALREADY_COMMITTED.
```
*/
    pub fn rw_scene_set_effort(
        scene: *mut rw_scene,
        effort: i32,
        rule: i32,
        time_limit_seconds: f64,
    ) -> i32;
    /**
```text
Does: chooses a structure and builds it. An empty scene is legal: every ray misses.
options: struct_size set; NULL: the defaults.
Returns: RW_OK, RW_ERROR_CANCELLED, RW_ERROR_MEMORY_LIMIT, RW_ERROR_ALREADY_COMMITTED,
RW_ERROR_HOST_PARALLEL. On an error the scene is as it was and may be committed again.
```
*/
    pub fn rw_scene_commit(
        scene: *mut rw_scene,
        options: *const rw_commit_options,
    ) -> i32;
    /**
```text
Does: makes a committed scene of the same triangles at new places: a mesh that deforms, from frame to frame. The
structure is the old one with new boxes where it has such a form ("bvh") and that pays, which takes a fraction of
building; else the same structure is built anew; options->refit says otherwise. It is chosen anew only when the
number of triangles that can be hit has changed more than twofold or it would be over the memory limit. Expectations,
effort, memory limit, profile and a forced structure are those of the old scene. Answers are those of any scene with
these meshes.
scene: committed; stays as it is, may be asked meanwhile, and may be released afterwards. Of a view, the scene it
is of is refitted as well: *refitted is then the same view of that, with what was said for the view.
meshes: all of the scene's, in the order of adding, all with the same struct_size; each with as many triangles as
before, unless options->refit is RW_REFIT_NEVER, and vertices, flags and types of its own. Every vertex and index is
checked. indices.data NULL: the mesh keeps the indices it has in the old scene (none, if it has none or is not
there), and then needs as many vertices and triangles as there; indices that the old scene reads in place
(RW_TRIANGLES_SHARED) are copied unless the flag is set here too. The old scene's vertices are not read: they may be
gone, or moved in place, as long as nobody asks the old scene any more.
mesh_count: as many as the scene has, unless options->refit is RW_REFIT_NEVER. options: struct_size set; NULL: the
defaults.
refitted: receives a scene the caller must release.
Memory: from the second refit on, what scenes made from each other release, and what building takes, is kept for the
next frame: with what is in use at most twice what was in use at once during the last 32 builds. It goes back to the
system with the last of these scenes. In steady state a frame takes no large array from the system:

rw_commit_options options = {sizeof options};
options.refit = RW_REFIT_NEVER; // or leave it: then a "bvh" is refitted
while (next_frame(&mesh)) {     // the same vertices moved, or another mesh with its indices
rw_scene *next;
if (rw_scene_refit(scene, &mesh, 1, &options, &next) != RW_OK) break;
rw_scene_release(scene);
scene = next;
rw_scene_intersect_batch(scene, &rays, &hits, NULL);
}
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_CANCELLED, RW_ERROR_MEMORY_LIMIT, RW_ERROR_HOST_PARALLEL,
RW_ERROR_NOT_FINITE, RW_ERROR_COORDINATE_RANGE, RW_ERROR_INDEX_OUT_OF_RANGE,
RW_ERROR_TOO_MANY, RW_ERROR_RESERVED, RW_ERROR_INVALID_ARGUMENT (also for numbers that differ).
```
*/
    pub fn rw_scene_refit(
        scene: *const rw_scene,
        meshes: *const rw_triangles,
        mesh_count: u32,
        options: *const rw_commit_options,
        refitted: *mut *mut rw_scene,
    ) -> i32;
    /**
```text
Does: says how much memory of released scenes, and of builds that are done, the process keeps for scenes to come. A
program that makes a scene, asks it and releases it, over and over, need not wait for the system to clear the same
pages again; where scenes are refitted frame after frame that is so by itself. At first 0: nothing is kept. Arrays of
256 KiB or more are, and with what is in use at most twice what was in use at once during the last 32 builds.
bytes: at most so many. What is kept beyond that goes back to the system at once, what refitted scenes keep included
(they keep it again from the next frame on); so 0 gives back all there is.
Returns: RW_OK. Threads: any.
```
*/
    pub fn rw_memory_keep(bytes: u64) -> i32;
    /**
```text
Does: tells how much memory is kept right now, for frames of refitted scenes or because of rw_memory_keep.
bytes: receives it.
Returns: RW_OK.
```
*/
    pub fn rw_memory_kept(bytes: *mut u64) -> i32;
    /**
```text
Does: tells the box around all triangles that can be hit.
lower, upper: 3 values each. An empty scene has lower = INFINITY and upper = -INFINITY.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_SHARED_MEMORY.
```
*/
    pub fn rw_scene_bounds(
        scene: *const rw_scene,
        lower: *mut f64,
        upper: *mut f64,
    ) -> i32;
    /**
```text
Does: tells what is in a scene and what it has cost.
statistics: struct_size set. Texts are constants.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED.
```
*/
    pub fn rw_scene_get_statistics(
        scene: *const rw_scene,
        statistics: *mut rw_scene_statistics,
    ) -> i32;
    /**
```text
Does: tells the statistics of the grid in use.
statistics: struct_size set.
Returns: RW_OK, RW_ERROR_WRONG_STRUCTURE when the structure is not uniform_grid, RW_ERROR_NOT_COMMITTED.
```
*/
    pub fn rw_scene_get_grid_statistics(
        scene: *const rw_scene,
        statistics: *mut rw_grid_statistics,
    ) -> i32;
    /**
```text
Does: finds the closest hit of one ray.
options: struct_size set; may be NULL. hit: receives the answer, a miss included.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_INDEX_OUT_OF_RANGE (an id to skip that is not there).
```
*/
    pub fn rw_scene_intersect(
        scene: *const rw_scene,
        ray: *const rw_ray,
        options: *const rw_ray_options,
        hit: *mut rw_hit,
    ) -> i32;
    /**
```text
Does: tells whether a ray hits anything.
options: as rw_scene_intersect. occluded: receives 1 or 0.
Returns: as rw_scene_intersect.
```
*/
    pub fn rw_scene_occluded(
        scene: *const rw_scene,
        ray: *const rw_ray,
        options: *const rw_ray_options,
        occluded: *mut i32,
    ) -> i32;
    /**
```text
Does: finds every hit of one ray, sorted by t, then by (instance, geometry, primitive); a surface crossed at an
edge or a corner counts once (see "All hits" at the top).
options: as rw_scene_intersect. hits: room for capacity answers, or NULL with capacity 0 to ask for the number only.
needed: receives the number of hits there are.
Returns: as rw_scene_intersect, and RW_ERROR_CAPACITY when there are more than capacity (the closest ones are then
written). Asking for the number only is RW_OK.
```
*/
    pub fn rw_scene_intersect_all(
        scene: *const rw_scene,
        ray: *const rw_ray,
        options: *const rw_ray_options,
        hits: *mut rw_hit,
        capacity: u64,
        needed: *mut u64,
    ) -> i32;
    /**
```text
Does: as the three above, for a float32 ray: their answers, rounded (see "float32" at the top). Hits are sorted by
what t is before it is rounded.
```
*/
    pub fn rw_scene_intersect_f32(
        scene: *const rw_scene,
        ray: *const rw_ray_f32,
        options: *const rw_ray_options,
        hit: *mut rw_hit_f32,
    ) -> i32;
    pub fn rw_scene_occluded_f32(
        scene: *const rw_scene,
        ray: *const rw_ray_f32,
        options: *const rw_ray_options,
        occluded: *mut i32,
    ) -> i32;
    pub fn rw_scene_intersect_all_f32(
        scene: *const rw_scene,
        ray: *const rw_ray_f32,
        options: *const rw_ray_options,
        hits: *mut rw_hit_f32,
        capacity: u64,
        needed: *mut u64,
    ) -> i32;
    /**
```text
Does: tells the normal of the triangle that was hit: (v1 - v0) x (v2 - v0), the right-hand rule, of unit length.
hit: of which only the ids are looked at. normal: receives three numbers.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_INDEX_OUT_OF_RANGE (an id that is not there),
RW_ERROR_INVALID_ARGUMENT also for a miss, and for a triangle that cannot be hit: one without area, or an invalid
one.
```
*/
    pub fn rw_scene_normal(
        scene: *const rw_scene,
        hit: *const rw_hit,
        normal: *mut f64,
    ) -> i32;
    pub fn rw_scene_normal_f32(
        scene: *const rw_scene,
        hit: *const rw_hit_f32,
        normal: *mut f32,
    ) -> i32;
    /**
```text
Does: finds the closest hit of many rays; the same bits as rw_scene_intersect for each.
rays: struct_size set. hits: struct_size set; the outputs it names are written to and may share memory
neither with each other and invalid_rays nor with the rays. That they leave alone meshes that are read in place is
not checked.
options: struct_size set; NULL: the defaults.
Rays may come in any order: many are traced in one that suits the structure, which takes 48 bytes a ray, 80 where not
all of their numbers are float32, of at most 2^20 rays, while the call lasts or for as long as the workspace does.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_HOST_PARALLEL and RW_ERROR_OUT_OF_MEMORY (the outputs are then
partly written), RW_ERROR_CANCELLED (see rw_query_options), RW_ERROR_INDEX_OUT_OF_RANGE (a skip list),
RW_ERROR_TOO_MANY (above RW_RAYS_LIMIT), RW_ERROR_RESERVED, RW_ERROR_OVERLAP, RW_ERROR_SHARED_MEMORY,
RW_ERROR_IN_USE.
```
*/
    pub fn rw_scene_intersect_batch(
        scene: *const rw_scene,
        rays: *const rw_rays,
        hits: *const rw_hits,
        options: *const rw_query_options,
    ) -> i32;
    /**
```text
Does: tells for many rays whether they hit anything.
occluded: uint8, uint32 or uint64, 1 or 0 for each ray; data not NULL.
Otherwise as rw_scene_intersect_batch.
```
*/
    pub fn rw_scene_occluded_batch(
        scene: *const rw_scene,
        rays: *const rw_rays,
        occluded: *const rw_output,
        options: *const rw_query_options,
    ) -> i32;
    /**
```text
Does: finds every hit of many rays. The hits of ray i are the elements offsets[i] up to offsets[i + 1] of the
outputs, sorted as in rw_scene_intersect_all.
offsets: room for rays->count + 1 numbers; written in full, RW_ERROR_CAPACITY or not.
hits: outputs with room for capacity answers; NULL with capacity 0 to ask for the offsets only.
needed: receives the number of all hits, offsets[rays->count]; may be NULL. It and offsets are outputs that may
share no memory.
Memory: 24 bytes a ray and 32 a hit, while the call lasts or for as long as the workspace does, beside what rays in
another order take.
Returns: RW_OK; RW_ERROR_CAPACITY when there are more than capacity (no hit is then written, offsets and needed are);
otherwise as rw_scene_intersect_batch.
```
*/
    pub fn rw_scene_intersect_all_batch(
        scene: *const rw_scene,
        rays: *const rw_rays,
        offsets: *mut u64,
        hits: *const rw_hits,
        capacity: u64,
        needed: *mut u64,
        options: *const rw_query_options,
    ) -> i32;
    /**
```text
Does: counts the candidates of the decision; one per structure.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED.
```
*/
    pub fn rw_scene_candidate_count(scene: *const rw_scene, count: *mut u32) -> i32;
    /**
```text
Does: tells one candidate, in the order of rw_structure_name.
index: below the count. candidate: struct_size set.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED.
```
*/
    pub fn rw_scene_get_candidate(
        scene: *const rw_scene,
        index: u32,
        candidate: *mut rw_candidate,
    ) -> i32;
    /**
```text
Does: explains the choice: scene, type of its vertices, profile, each candidate with predicted and actual build
time, ns per ray and bytes.
Arguments and results as rw_profile_text, and RW_ERROR_NOT_COMMITTED.
```
*/
    pub fn rw_scene_explain(
        scene: *const rw_scene,
        format: i32,
        buffer: *mut ::std::os::raw::c_char,
        capacity: u64,
        needed: *mut u64,
    ) -> i32;
    /**
```text
Does: makes a scene of a scene's geometry, seen from a point (camera, point light) or along a direction (sun), and
builds a structure for it when that pays. Rays that do start at the point, or do run along the direction, can be
answered faster by it; all others are answered as by the scene. Either way with the same bits. It is a committed
scene in all that can be asked of one; its statistics are its own.
scene: committed; kept, with the meshes it shares (RW_TRIANGLES_SHARED), for as long as the view lives. Its memory
limit holds for the view's structure as well. A view of a view is one of the scene that the first is of.
options: struct_size set. commit: threads, progress and parallel-for of the build; may be NULL.
view: receives a scene the caller must release.
Returns: RW_OK, RW_ERROR_NOT_COMMITTED, RW_ERROR_RAY_COUNT, RW_ERROR_UNKNOWN_STRUCTURE, RW_ERROR_NOT_FINITE (origin
or direction), RW_ERROR_MEMORY_LIMIT, RW_ERROR_CANCELLED, RW_ERROR_HOST_PARALLEL, RW_ERROR_RESERVED.
```
*/
    pub fn rw_scene_view(
        scene: *const rw_scene,
        options: *const rw_view_options,
        commit: *const rw_commit_options,
        view: *mut *mut rw_scene,
    ) -> i32;
    /**
```text
Does: answers a batch against meshes that are used in place and forgotten afterwards. The structure is chosen for
exactly rays->count rays.
meshes: mesh_count of them, all with the same struct_size; read in place, during the call only. Hits name mesh i as
geometry i.
rays, hits: as rw_scene_intersect_batch. options: struct_size set; NULL: the defaults. Building is watched by the
progress and cancel of options->query as well.
Returns: RW_OK, or what rw_scene_add_triangles, rw_scene_commit and rw_scene_intersect_batch may return.
```
*/
    pub fn rw_once_intersect(
        meshes: *const rw_triangles,
        mesh_count: u32,
        rays: *const rw_rays,
        hits: *const rw_hits,
        options: *const rw_once_options,
    ) -> i32;
    /// Does: as rw_once_intersect, for the question whether anything is hit. occluded: as rw_scene_occluded_batch.
    pub fn rw_once_occluded(
        meshes: *const rw_triangles,
        mesh_count: u32,
        rays: *const rw_rays,
        occluded: *const rw_output,
        options: *const rw_once_options,
    ) -> i32;
}
