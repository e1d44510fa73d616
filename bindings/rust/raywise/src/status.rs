//! The library's status values.

use std::fmt;

use raywise_sys as sys;

use crate::text;

/// What a C function returned: one of the `RW_ERROR_` and `RW_PROFILE_` values.
///
/// A value that this crate does not know (from a newer library) is kept as it is, so this is a number with names and not
/// an `enum`. It can be matched like one:
///
/// ```
/// use raywise::Status;
/// # let status = Status::CANCELLED;
/// match status {
///     Status::CANCELLED => println!("stopped"),
///     Status::MEMORY_LIMIT => println!("too large"),
///     other => println!("{other}"),
/// }
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Status(i32);

macro_rules! statuses {
    ($($(#[$doc:meta])* $name:ident = $constant:ident;)*) => {
        impl Status {
            $($(#[$doc])* #[doc = concat!("`", stringify!($constant), "`.")] pub const $name: Status = Status(sys::$constant);)*

            /// The constant's name in the C header, e.g. `"RW_ERROR_CANCELLED"`; `None` for a value that this crate
            /// does not know.
            #[must_use]
            pub fn name(self) -> Option<&'static str> {
                match self {
                    $(Status::$name => Some(stringify!($constant)),)*
                    _ => None,
                }
            }
        }
    };
}

statuses! {
    /// All went well.
    OK = RW_OK;
    /// NULL, an unknown constant, a struct that cannot be, or a number out of its range.
    INVALID_ARGUMENT = RW_ERROR_INVALID_ARGUMENT;
    /// An allocation failed; nothing was changed but a batch's outputs.
    OUT_OF_MEMORY = RW_ERROR_OUT_OF_MEMORY;
    /// A vertex, origin or direction has a NaN or infinite coordinate.
    NOT_FINITE = RW_ERROR_NOT_FINITE;
    /// A float64 vertex lies beyond what a float32 box can hold.
    COORDINATE_RANGE = RW_ERROR_COORDINATE_RANGE;
    /// An index or id names a vertex, geometry or triangle that is not there.
    INDEX_OUT_OF_RANGE = RW_ERROR_INDEX_OUT_OF_RANGE;
    /// More vertices or triangles than the ids can count, or more rays than `RW_RAYS_LIMIT`.
    TOO_MANY = RW_ERROR_TOO_MANY;
    /// A committed scene cannot be changed.
    ALREADY_COMMITTED = RW_ERROR_ALREADY_COMMITTED;
    /// The scene has to be committed first.
    NOT_COMMITTED = RW_ERROR_NOT_COMMITTED;
    /// No structure has that name.
    UNKNOWN_STRUCTURE = RW_ERROR_UNKNOWN_STRUCTURE;
    /// The question has no meaning for the structure in use.
    WRONG_STRUCTURE = RW_ERROR_WRONG_STRUCTURE;
    /// An expected ray count of zero, or above `RW_RAYS_LIMIT`.
    RAY_COUNT = RW_ERROR_RAY_COUNT;
    /// The output is too small.
    CAPACITY = RW_ERROR_CAPACITY;
    /// The progress callback asked to stop.
    CANCELLED = RW_ERROR_CANCELLED;
    /// No candidate fits the memory limit.
    MEMORY_LIMIT = RW_ERROR_MEMORY_LIMIT;
    /// There is no such file.
    FILE_NOT_FOUND = RW_ERROR_FILE_NOT_FOUND;
    /// The file is there but cannot be opened or read.
    FILE_UNREADABLE = RW_ERROR_FILE_UNREADABLE;
    /// The file's kind is unknown or its content is not of that kind.
    FILE_FORMAT = RW_ERROR_FILE_FORMAT;
    /// A mesh file without a single face.
    NO_FACES = RW_ERROR_NO_FACES;
    /// A face with fewer than three corners.
    BAD_POLYGON = RW_ERROR_BAD_POLYGON;
    /// The caller's parallel-for left a task out.
    HOST_PARALLEL = RW_ERROR_HOST_PARALLEL;
    /// An unexpected failure; please report it.
    INTERNAL = RW_ERROR_INTERNAL;
    /// Profile: there is no file at that path.
    PROFILE_NOT_FOUND = RW_PROFILE_NOT_FOUND;
    /// Profile: the file cannot be opened, is not a plain file or is too large.
    PROFILE_UNREADABLE = RW_PROFILE_UNREADABLE;
    /// Profile: truncated, not JSON, or a member is missing or of the wrong type.
    PROFILE_MALFORMED = RW_PROFILE_MALFORMED;
    /// Profile: written in another format version.
    PROFILE_SCHEMA = RW_PROFILE_SCHEMA;
    /// Profile: measured on kernels that have changed since.
    PROFILE_EPOCH = RW_PROFILE_EPOCH;
    /// Profile: measured on another machine, or with another instruction set on this one.
    PROFILE_MACHINE = RW_PROFILE_MACHINE;
    /// Profile: a constant is negative, not finite or beyond belief.
    PROFILE_RANGE = RW_PROFILE_RANGE;
    /// A reserved member is not zero.
    RESERVED = RW_ERROR_RESERVED;
    /// The strides of an output let its elements overlap.
    OVERLAP = RW_ERROR_OVERLAP;
    /// Two outputs, or an output and the rays, share memory.
    SHARED_MEMORY = RW_ERROR_SHARED_MEMORY;
    /// A workspace serves one batch at a time, and another one is at it.
    IN_USE = RW_ERROR_IN_USE;
}

impl Status {
    /// The status with this number.
    #[must_use]
    pub const fn from_code(code: i32) -> Status {
        Status(code)
    }

    /// The number that the C function returned.
    #[must_use]
    pub const fn code(self) -> i32 {
        self.0
    }

    /// The status in words; every value has some. Wraps `rw_status_text`.
    #[must_use]
    pub fn text(self) -> &'static str {
        // SAFETY: the function takes any value and returns a text that is valid for ever.
        unsafe { text::constant(sys::rw_status_text(self.0)) }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name() {
            Some(name) => out.write_str(name),
            None => write!(out, "status {}", self.0),
        }
    }
}

impl fmt::Debug for Status {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_status_of_the_header_has_a_name_and_a_text() {
        let mut texts = HashSet::new();
        for code in 0..sys::RW_STATUS_COUNT {
            let status = Status::from_code(code);
            assert!(status.name().is_some(), "{code}");
            assert!(!status.text().is_empty(), "{status}");
            assert!(texts.insert(status.text()), "{status} has the text of another status");
        }
    }

    #[test]
    fn an_unknown_status_is_kept() {
        let status = Status::from_code(123_456);
        assert_eq!(status.code(), 123_456);
        assert_eq!(status.name(), None);
        assert_eq!(status.to_string(), "status 123456");
        assert!(!status.text().is_empty());
    }
}
