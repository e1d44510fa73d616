//! What can go wrong.

use crate::Status;

/// The result of everything that can fail here.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What went wrong. The text names the argument and the element.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The library refused. `message` is the text of `rw_last_error_message`.
    #[error("{message} ({status})")]
    Library {
        /// What the C function returned.
        status: Status,
        /// What the library said about it.
        message: String,
    },

    /// Two things that belong together are not equally long.
    #[error("{what}: {found} elements, where {expected} are needed")]
    Length {
        /// Which argument.
        what: &'static str,
        /// How many elements it has to have.
        expected: usize,
        /// How many it has.
        found: usize,
    },

    /// Offsets that belong to consecutive lists have to be in order.
    #[error("{what}[{index}] is {value}, below the {before} before it")]
    Falling {
        /// Which argument.
        what: &'static str,
        /// The first offset that is too low.
        index: usize,
        /// What it is.
        value: u64,
        /// What the offset before it is.
        before: u64,
    },

    /// More elements than the library can be told of.
    #[error("{what}: {found} elements, and {limit} are the most there can be")]
    TooMany {
        /// Which argument.
        what: &'static str,
        /// How many elements it has.
        found: usize,
        /// How many it can have.
        limit: usize,
    },

    /// The room given for the hits is too small; none was written.
    #[error("there are {needed} hits and room for {capacity}")]
    Capacity {
        /// How many hits there are.
        needed: u64,
        /// How many the outputs have room for.
        capacity: u64,
    },

    /// A text or path that cannot be handed to C.
    #[error("{what} {text:?}: {reason}")]
    Text {
        /// Which argument.
        what: &'static str,
        /// The text, with what is not UTF-8 replaced.
        text: String,
        /// Why it cannot be handed on.
        reason: &'static str,
    },

    /// The library that was loaded has another binary interface than the one this crate was made for.
    #[error("the library that was loaded has the binary interface {found}, this crate was made for {expected}")]
    AbiMismatch {
        /// The interface of this crate, `RW_ABI_VERSION`.
        expected: u32,
        /// What `rw_abi_version` said.
        found: u32,
    },
}

impl Error {
    /// The library's status behind this error; `None` when the library was not asked.
    #[must_use]
    pub fn status(&self) -> Option<Status> {
        match self {
            Error::Library { status, .. } => Some(*status),
            Error::Capacity { .. } => Some(Status::CAPACITY),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_name_what_was_wrong() {
        let error = Error::Length { what: "directions", expected: 3, found: 2 };
        assert_eq!(error.to_string(), "directions: 2 elements, where 3 are needed");
        assert_eq!(error.status(), None);
        let error = Error::Falling { what: "skip offsets", index: 3, value: 5, before: 9 };
        assert_eq!(error.to_string(), "skip offsets[3] is 5, below the 9 before it");
        let error = Error::TooMany { what: "skip", found: 9, limit: 8 };
        assert_eq!(error.to_string(), "skip: 9 elements, and 8 are the most there can be");

        let error = Error::Library { status: Status::CANCELLED, message: "stopped".into() };
        assert_eq!(error.to_string(), "stopped (RW_ERROR_CANCELLED)");
        assert_eq!(error.status(), Some(Status::CANCELLED));
    }

    #[test]
    fn errors_can_travel() {
        fn travels<T: Send + Sync + 'static + std::error::Error>() {}
        travels::<Error>();
    }
}
