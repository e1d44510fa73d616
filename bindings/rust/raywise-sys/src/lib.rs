//! Declarations of the C interface of raywise, as in `raywise.h`; the crate `raywise` is the safe way to use them.
//!
//! The library is found by the environment variable `RAYWISE_LIB_DIR` (the folder of `libraywise.so`) or by pkg-config.
//! The declarations are written by a script from the header and are checked in, so that building this crate needs no
//! libclang. Their layout tests run with `cargo test`.
//!
//! One name is not the header's: a member called `type` there is `type_` here, because Rust keeps that word for itself.

#![allow(non_camel_case_types)]

#[allow(clippy::all, clippy::undocumented_unsafe_blocks, unsafe_op_in_unsafe_fn)]
#[rustfmt::skip]
mod bindings;

pub use bindings::*;
