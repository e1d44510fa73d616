//! Texts to and from C.

use std::ffi::{CStr, CString};
use std::os::raw::c_char;
use std::path::Path;

use raywise_sys as sys;

use crate::library::check;
use crate::{Error, Result, Status};

/// A text for C. `what` names the argument in the error.
pub(crate) fn to_c(what: &'static str, text: &str) -> Result<CString> {
    CString::new(text).map_err(|_| Error::Text {
        what,
        text: text.to_owned(),
        reason: "C ends a text at the first zero byte, and this one has a zero inside",
    })
}

/// A path for C, where paths are UTF-8.
pub(crate) fn path_to_c(what: &'static str, path: &Path) -> Result<CString> {
    match path.to_str() {
        Some(text) => to_c(what, text),
        None => Err(Error::Text { what, text: path.to_string_lossy().into_owned(), reason: "the path is not UTF-8" }),
    }
}

/// Copies a text of the library.
///
/// # Safety
/// `text` is NULL or points to a zero-terminated text that stays until this function returns.
pub(crate) unsafe fn copied(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: not NULL; the rest is this function's own condition.
    unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
}

/// A text that the library never frees.
///
/// # Safety
/// `text` is NULL or points to a zero-terminated text that is valid for ever.
pub(crate) unsafe fn constant(text: *const c_char) -> &'static str {
    if text.is_null() {
        return "";
    }
    // SAFETY: not NULL; the rest is this function's own condition.
    unsafe { CStr::from_ptr(text) }.to_str().unwrap_or("")
}

/// Reads a text of unknown length. `write(buffer, capacity, needed)` is one of the `_text` and `_explain` functions.
pub(crate) fn read(mut write: impl FnMut(*mut c_char, u64, *mut u64) -> i32) -> Result<String> {
    let mut needed = 0;
    check(write(std::ptr::null_mut(), 0, &mut needed))?;
    loop {
        let mut buffer = vec![0_u8; needed as usize];
        let status = write(buffer.as_mut_ptr().cast(), buffer.len() as u64, &mut needed);
        // What is told may grow between two calls: figures get longer while other threads ask.
        if status == sys::RW_ERROR_CAPACITY && needed > buffer.len() as u64 {
            continue;
        }
        check(status)?;
        return match CStr::from_bytes_until_nul(&buffer) {
            Ok(text) => Ok(text.to_string_lossy().into_owned()),
            Err(_) => Err(Error::Library {
                status: Status::INTERNAL,
                message: "the library wrote a text without an end".to_owned(),
            }),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_inside_is_refused() {
        let error = to_c("structure", "bv\0h").unwrap_err();
        assert!(error.to_string().starts_with("structure \"bv\\0h\""), "{error}");
        assert_eq!(to_c("structure", "bvh").unwrap().as_bytes(), b"bvh");
    }

    #[cfg(unix)]
    #[test]
    fn a_path_that_is_not_utf8_is_refused() {
        use std::os::unix::ffi::OsStrExt;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"a\xff.obj"));
        assert!(matches!(path_to_c("path", path), Err(Error::Text { what: "path", .. })));
    }

    #[test]
    fn a_text_that_grows_is_read_in_full() {
        let mut told = vec!["one\0", "twelve\0", "twelve\0"].into_iter();
        let text = read(|buffer, capacity, needed| {
            let text = told.next().unwrap();
            // SAFETY: `needed` is a place of `read`.
            unsafe { *needed = text.len() as u64 };
            if buffer.is_null() {
                return sys::RW_OK;
            }
            if capacity < text.len() as u64 {
                return sys::RW_ERROR_CAPACITY;
            }
            // SAFETY: there is room for the text, as was just seen.
            unsafe { std::ptr::copy_nonoverlapping(text.as_ptr().cast(), buffer, text.len()) };
            sys::RW_OK
        });
        assert_eq!(text.unwrap(), "twelve");
    }

    #[test]
    fn null_is_the_empty_text() {
        // SAFETY: NULL is allowed.
        unsafe {
            assert_eq!(copied(std::ptr::null()), "");
            assert_eq!(constant(std::ptr::null()), "");
        }
    }
}
