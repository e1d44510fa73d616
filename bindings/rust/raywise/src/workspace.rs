//! The memory of batches, kept from one to the next.

use std::ptr::NonNull;

use raywise_sys as sys;

use crate::library::{check, ensure_abi};
use crate::Result;

/// The memory that batches take while they run (`rw_batch_workspace`): a batch like the one before then takes none from the
/// system. For programs that ask in a loop; hand it to [`QueryOptions::workspace`](crate::QueryOptions::workspace).
///
/// It serves one batch at a time: another one fails with [`Status::IN_USE`](crate::Status::IN_USE) meanwhile.
///
/// ```
/// # fn main() -> raywise::Result<()> {
/// let workspace = raywise::Workspace::new()?;
/// let options = raywise::QueryOptions::new().workspace(&workspace);
/// # let _ = options;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Workspace(NonNull<sys::rw_batch_workspace>);

// SAFETY: the C contract: a workspace may be used from any thread.
unsafe impl Send for Workspace {}
// SAFETY: and refuses a second batch at the same time.
unsafe impl Sync for Workspace {}

impl Workspace {
    /// An empty one.
    pub fn new() -> Result<Self> {
        ensure_abi()?;
        let mut raw = std::ptr::null_mut();
        // SAFETY: it receives a pointer.
        check(unsafe { sys::rw_batch_workspace_create(&mut raw) })?;
        Ok(Workspace(NonNull::new(raw).expect("the library makes a workspace or says why not")))
    }

    pub(crate) fn as_ptr(&self) -> *mut sys::rw_batch_workspace {
        self.0.as_ptr()
    }
}

impl Drop for Workspace {
    fn drop(&mut self) {
        // SAFETY: made by `new`, given back once; options that borrow it are gone.
        unsafe { sys::rw_batch_workspace_release(self.0.as_ptr()) };
    }
}
