//! The library that was loaded: is it the right one, and what did it say last?

use std::fmt;
use std::sync::OnceLock;

use raywise_sys as sys;

use crate::{text, Error, Result, Status};

/// A version number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Version {
    /// Changes when the interface changes.
    pub major: u32,
    /// Changes when something is added.
    pub minor: u32,
    /// Changes when something is mended.
    pub patch: u32,
}

impl fmt::Display for Version {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// The version of the header this crate was made from.
pub const HEADER_VERSION: Version = Version {
    major: sys::RW_VERSION_MAJOR as u32,
    minor: sys::RW_VERSION_MINOR as u32,
    patch: sys::RW_VERSION_PATCH as u32,
};

/// The version of the library that was loaded, which may differ from [`HEADER_VERSION`]. Wraps `rw_version`.
pub fn version() -> Result<Version> {
    let mut version = Version { major: 0, minor: 0, patch: 0 };
    // SAFETY: the three places live through the call.
    check(unsafe { sys::rw_version(&mut version.major, &mut version.minor, &mut version.patch) })?;
    Ok(version)
}

/// The binary interface of the library that was loaded. Wraps `rw_abi_version`.
pub fn abi_version() -> Result<u32> {
    let mut abi = 0;
    // SAFETY: the place lives through the call.
    check(unsafe { sys::rw_abi_version(&mut abi) })?;
    Ok(abi)
}

/// Makes sure, once per process, that the library is of the binary interface this crate declares. Everything that
/// creates a handle or passes a struct asks this first.
pub(crate) fn ensure_abi() -> Result<()> {
    static ANSWER: OnceLock<Result<()>> = OnceLock::new();
    ANSWER.get_or_init(|| compare_abi(abi_version()?)).clone()
}

fn compare_abi(found: u32) -> Result<()> {
    let expected = sys::RW_ABI_VERSION as u32;
    if found == expected {
        Ok(())
    } else {
        Err(Error::AbiMismatch { expected, found })
    }
}

/// Turns a status into a result. To be called right after the C function, on the same thread: the message belongs to the
/// thread's latest failure.
pub(crate) fn check(code: i32) -> Result<()> {
    let status = Status::from_code(code);
    if status == Status::OK {
        Ok(())
    } else {
        Err(Error::Library { status, message: last_message(status) })
    }
}

fn last_message(status: Status) -> String {
    // SAFETY: the text is never NULL and stays until this thread's next call; it is copied here.
    let message = unsafe { text::copied(sys::rw_last_error_message()) };
    if message.is_empty() {
        status.text().to_owned()
    } else {
        message
    }
}

/// The `struct_size` of an option or result struct.
pub(crate) fn size_of_struct<T>() -> u32 {
    std::mem::size_of::<T>() as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_has_the_interface_of_this_crate() {
        assert_eq!(abi_version(), Ok(1));
        assert_eq!(ensure_abi(), Ok(()));
        assert!(version().unwrap() >= HEADER_VERSION);
    }

    #[test]
    fn another_interface_is_refused() {
        let error = compare_abi(7).unwrap_err();
        assert_eq!(error, Error::AbiMismatch { expected: 1, found: 7 });
        assert_eq!(
            error.to_string(),
            "the library that was loaded has the binary interface 7, this crate was made for 1"
        );
    }

    #[test]
    fn a_null_output_is_an_error_with_a_message() {
        // SAFETY: the function is specified to refuse NULL.
        let error = check(unsafe { sys::rw_abi_version(std::ptr::null_mut()) }).unwrap_err();
        assert_eq!(error.status(), Some(Status::INVALID_ARGUMENT));
        let Error::Library { message, .. } = error else { panic!("{error:?}") };
        assert!(!message.is_empty());
    }
}
