//! The structures that the library can choose from.

use raywise_sys as sys;

use crate::library::{check, ensure_abi};
use crate::{text, Result};

/// The names of all structures, e.g. `"bvh"`; any of them can be forced. Wraps `rw_structure_count` and
/// `rw_structure_name`.
pub fn structures() -> Result<Vec<&'static str>> {
    ensure_abi()?;
    let mut count = 0;
    // SAFETY: the place lives through the call.
    check(unsafe { sys::rw_structure_count(&mut count) })?;
    (0..count).map(structure_name).collect()
}

fn structure_name(index: u32) -> Result<&'static str> {
    let mut name = std::ptr::null();
    // SAFETY: the place lives through the call.
    check(unsafe { sys::rw_structure_name(index, &mut name) })?;
    // SAFETY: the name is a constant text.
    Ok(unsafe { text::constant(name) })
}
