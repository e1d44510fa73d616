//! Counted handles: cloning retains, dropping releases. Closing one twice cannot be written down.

use std::ptr::NonNull;

use raywise_sys as sys;

use crate::library::check;
use crate::Result;

/// A C type with `_retain` and `_release`.
///
/// # Safety
/// The two functions count references of this type and may be called from any thread, as may every function that takes a
/// pointer to const of it.
pub(crate) unsafe trait Counted {
    const RETAIN: unsafe extern "C" fn(*const Self) -> i32;
    const RELEASE: unsafe extern "C" fn(*const Self) -> i32;
}

macro_rules! counted {
    ($($raw:ident, $retain:ident, $release:ident;)*) => {
        $(
            // SAFETY: the C contract: handles are counted, and what takes a const handle may run in any thread.
            unsafe impl Counted for sys::$raw {
                const RETAIN: unsafe extern "C" fn(*const Self) -> i32 = sys::$retain;
                const RELEASE: unsafe extern "C" fn(*const Self) -> i32 = sys::$release;
            }
        )*
    };
}

counted! {
    rw_profile, rw_profile_retain, rw_profile_release;
    rw_mesh, rw_mesh_retain, rw_mesh_release;
    rw_scene, rw_scene_retain, rw_scene_release;
}

/// One reference to a handle.
#[derive(Debug)]
pub(crate) struct Handle<R: Counted>(NonNull<R>);

// SAFETY: see `Counted`: a reference may be used and given back on any thread. What needs the handle alone goes through
// `as_mut_ptr`, and that takes `&mut self`.
unsafe impl<R: Counted> Send for Handle<R> {}
// SAFETY: as above.
unsafe impl<R: Counted> Sync for Handle<R> {}

impl<R: Counted> Handle<R> {
    /// Takes over the reference that a `_create` or `_load` function hands out through its last argument.
    pub(crate) fn create(call: impl FnOnce(*mut *mut R) -> i32) -> Result<Self> {
        let mut raw = std::ptr::null_mut();
        check(call(&mut raw))?;
        Ok(Self::take(raw))
    }

    /// Takes over a reference.
    ///
    /// # Panics
    /// When there is none: the library promised one and broke its word.
    pub(crate) fn take(raw: *mut R) -> Self {
        Handle(NonNull::new(raw).expect("the library reported success and handed out no handle"))
    }

    pub(crate) fn as_ptr(&self) -> *const R {
        self.0.as_ptr()
    }

    /// For functions that need the handle alone.
    pub(crate) fn as_mut_ptr(&mut self) -> *mut R {
        self.0.as_ptr()
    }
}

impl<R: Counted> Clone for Handle<R> {
    fn clone(&self) -> Self {
        // SAFETY: this reference keeps the handle alive during the call.
        let status = unsafe { R::RETAIN(self.as_ptr()) };
        assert_eq!(status, sys::RW_OK, "a living handle could not be retained");
        Handle(self.0)
    }
}

impl<R: Counted> Drop for Handle<R> {
    fn drop(&mut self) {
        // SAFETY: this gives back the one reference that `self` stands for.
        let status = unsafe { R::RELEASE(self.as_ptr()) };
        debug_assert_eq!(status, sys::RW_OK);
    }
}
