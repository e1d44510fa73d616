//! Two directions between `raywise.h` and Rust.
//!
//! * [`declarations`]: the header becomes the declarations of the crate `raywise-sys` (bindgen).
//! * [`circle`]: those declarations become a header again (cbindgen), and [`interface`] reads both headers with one
//!   parser and names every difference. What bindgen or a hand had changed on the way would show up here.

pub mod circle;
pub mod declarations;
pub mod interface;
pub mod rust_view;

/// Anything that stops a step, in words for the person who ran the script.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;
