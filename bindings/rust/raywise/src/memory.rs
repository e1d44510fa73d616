//! Memory that is kept for scenes to come.

use raywise_sys as sys;

use crate::library::{check, ensure_abi};
use crate::Result;

/// Says how many bytes of dropped scenes, and of builds that are done, the process keeps for scenes to come. At first 0. A
/// program that makes a scene, asks it and drops it, over and over, need not wait for the system to clear the same pages
/// again; frames made by [`Scene::refit`](crate::Scene::refit) keep theirs by themselves. What is kept beyond `bytes` goes back
/// at once, so 0 gives back all there is. Wraps `rw_memory_keep`.
///
/// # Errors
/// When the library that was found does not fit this crate.
pub fn keep_memory(bytes: u64) -> Result<()> {
    ensure_abi()?;
    // SAFETY: a plain number.
    check(unsafe { sys::rw_memory_keep(bytes) })
}

/// How many bytes are kept right now. Wraps `rw_memory_kept`.
///
/// # Errors
/// When the library that was found does not fit this crate.
pub fn kept_memory() -> Result<u64> {
    ensure_abi()?;
    let mut bytes = 0;
    // SAFETY: the place lives through the call.
    check(unsafe { sys::rw_memory_kept(&mut bytes) })?;
    Ok(bytes)
}
