//! The circle closes on the real header, and it opens at the right place when the Rust view is damaged.

use std::path::{Path, PathBuf};

use raywise_generator::circle::{self, Difference, Report};
use raywise_generator::declarations;

fn small_header() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/small.h")
}

fn real_header() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../capi/include/raywise/raywise.h")
}

fn committed_declarations() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rust/raywise-sys/src/bindings.rs");
    std::fs::read_to_string(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()))
}

fn compare(test: &str, header: &Path, declarations: &str) -> Report {
    let returned = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{test}.h"));
    circle::compare(header, declarations, &returned).unwrap()
}

/// Declares the small header, replaces `from` by `to` (which must be there once) and tells what the circle finds.
fn damaged(test: &str, from: &str, to: &str) -> Vec<Difference> {
    let declarations = declarations::generate(&small_header()).unwrap();
    assert_eq!(declarations.matches(from).count(), 1, "`{from}` should occur once in\n{declarations}");
    compare(test, &small_header(), &declarations.replace(from, to)).differences
}

fn changed(name: &str, part: &str, header: &str, rust: &str) -> Vec<Difference> {
    vec![Difference::Changed { name: name.into(), part: part.into(), header: header.into(), rust: rust.into() }]
}

#[test]
fn the_circle_closes_on_the_small_header() {
    let declarations = declarations::generate(&small_header()).unwrap();
    let report = compare("small", &small_header(), &declarations);
    assert_eq!(report.differences, vec![]);
    assert_eq!([report.structs, report.handles, report.callbacks, report.functions, report.constants], [2, 1, 1, 3, 4]);
}

#[test]
fn the_circle_closes_on_the_committed_declarations() {
    let report = compare("committed", &real_header(), &committed_declarations());
    assert_eq!(report.differences, vec![]);
    assert!(report.structs > 10 && report.functions > 40 && report.constants > 50 && report.handles > 2);
}

#[test]
fn a_dropped_function_of_the_real_header_is_named() {
    let declarations = committed_declarations();
    let damaged = declarations.replacen("pub fn rw_scene_commit(", "pub fn rw_scene_seal(", 1);
    assert_ne!(damaged, declarations);
    let report = compare("real_function", &real_header(), &damaged);
    assert_eq!(
        report.differences,
        vec![
            Difference::Missing { what: "function", name: "rw_scene_commit".into() },
            Difference::Unknown { what: "function", name: "rw_scene_seal".into() },
        ]
    );
}

#[test]
fn generating_twice_gives_the_same_text() {
    assert_eq!(declarations::generate(&real_header()).unwrap(), declarations::generate(&real_header()).unwrap());
}

#[test]
fn a_constant_has_the_type_of_its_expression() {
    let declarations = declarations::generate(&small_header()).unwrap();
    for line in [
        "pub const RW_OK: i32 = 0;",
        "pub const RW_FLAG: u32 = 2;",
        "pub const RW_LOWEST: i64 = -9223372036854775808;",
        "pub const RW_HIGHEST: u64 = 18446744073709551615;",
    ] {
        assert!(declarations.contains(line), "{line} is not in\n{declarations}");
    }
}

#[test]
fn a_changed_member_type_is_named() {
    assert_eq!(
        damaged("member_type", "pub flags: u32,", "pub flags: i32,"),
        changed("rw_whole", "type of member flags", "uint32_t", "int32_t")
    );
}

#[test]
fn a_changed_array_length_is_named() {
    assert_eq!(
        damaged("array_length", "pub origin: [f64; 3usize],", "pub origin: [f64; 4usize],"),
        changed("rw_part", "type of member origin", "double[3]", "double[4]")
    );
}

#[test]
fn a_member_pointer_that_lost_its_const_is_named() {
    assert_eq!(
        damaged("member_const", "pub parts: *const rw_part,", "pub parts: *mut rw_part,"),
        changed("rw_whole", "type of member parts", "const rw_part *", "rw_part *")
    );
}

#[test]
fn swapped_members_are_named() {
    assert_eq!(
        damaged(
            "member_order",
            "pub struct_size: u32,\n    pub flags: u32,",
            "pub flags: u32,\n    pub struct_size: u32,"
        ),
        changed(
            "rw_whole",
            "members",
            "struct_size, flags, part, parts, visit, visit_user, thing",
            "flags, struct_size, part, parts, visit, visit_user, thing"
        )
    );
}

#[test]
fn a_dropped_member_is_named() {
    assert_eq!(
        damaged("member_dropped", "pub visit_user: *mut ::std::os::raw::c_void,", ""),
        changed(
            "rw_whole",
            "members",
            "struct_size, flags, part, parts, visit, visit_user, thing",
            "struct_size, flags, part, parts, visit, thing"
        )
    );
}

#[test]
fn a_dropped_function_is_named() {
    assert_eq!(
        damaged("function_dropped", "pub fn rw_thing_name() -> *const ::std::os::raw::c_char;", ""),
        vec![Difference::Missing { what: "function", name: "rw_thing_name".into() }]
    );
}

#[test]
fn an_argument_that_lost_its_const_is_named() {
    assert_eq!(
        damaged("argument_const", "point: *const f64,", "point: *mut f64,"),
        changed("rw_thing_ask", "type of argument point", "const double *", "double *")
    );
}

#[test]
fn an_argument_of_another_width_is_named() {
    assert_eq!(
        damaged("argument_width", "count: u64,", "count: u32,"),
        changed("rw_thing_ask", "type of argument count", "uint64_t", "uint32_t")
    );
}

#[test]
fn a_dropped_argument_is_named() {
    assert_eq!(
        damaged("argument_dropped", "count: u64,", ""),
        changed("rw_thing_ask", "arguments", "thing, point, count, answers", "thing, point, answers")
    );
}

#[test]
fn another_result_is_named() {
    assert_eq!(
        damaged(
            "result",
            "pub fn rw_thing_name() -> *const ::std::os::raw::c_char;",
            "pub fn rw_thing_name() -> *mut ::std::os::raw::c_char;"
        ),
        changed("rw_thing_name", "result", "const char *", "char *")
    );
}

#[test]
fn another_value_of_a_constant_is_named() {
    assert_eq!(
        damaged("constant_value", "RW_FLAG: u32 = 2;", "RW_FLAG: u32 = 4;"),
        changed("RW_FLAG", "value", "2", "4")
    );
}

#[test]
fn another_type_of_a_constant_is_named() {
    assert_eq!(
        damaged("constant_type", "RW_FLAG: u32 = 2;", "RW_FLAG: u64 = 2;"),
        changed("RW_FLAG", "type", "uint32_t", "uint64_t")
    );
}

#[test]
fn a_dropped_constant_is_named() {
    assert_eq!(
        damaged("constant_dropped", "pub const RW_OK: i32 = 0;", ""),
        vec![Difference::Missing { what: "constant", name: "RW_OK".into() }]
    );
}

#[test]
fn another_callback_is_named() {
    // The struct member of that type changes with it.
    let callback = "int32_t (*)(void *, double, const char *)";
    let other = "int32_t (*)(void *, float, const char *)";
    assert_eq!(
        damaged("callback", "fraction: f64,", "fraction: f32,"),
        [changed("rw_whole", "type of member visit", callback, other), changed("rw_visit", "type", callback, other),]
            .concat()
    );
}

#[test]
fn a_packed_struct_is_named() {
    let found = damaged(
        "packed",
        "#[repr(C)]\n#[derive(Debug, Copy, Clone)]\npub struct rw_whole {",
        "#[repr(C, packed)]\n#[derive(Debug, Copy, Clone)]\npub struct rw_whole {",
    );
    assert_eq!(found, changed("rw_whole", "alignment", "8", "1"));
}
