//! The element types that arrays may have. C is told them by number; here they are Rust types.

use raywise_sys as sys;

mod sealed {
    pub trait Element: Copy + Send + Sync + 'static {
        /// `RW_FLOAT32`, `RW_UINT64` and so on.
        const TYPE: i32;
    }
}

pub(crate) use sealed::Element;

/// `f32` or `f64`.
pub trait Float: Element {}

/// `u32` or `u64`: indices and ids.
pub trait Index: Element {}

/// `u8`, `u32` or `u64`: 0 or 1.
pub trait Flag: Element {}

impl Element for f32 {
    const TYPE: i32 = sys::RW_FLOAT32;
}
impl Element for f64 {
    const TYPE: i32 = sys::RW_FLOAT64;
}
impl Element for u8 {
    const TYPE: i32 = sys::RW_UINT8;
}
impl Element for u32 {
    const TYPE: i32 = sys::RW_UINT32;
}
impl Element for u64 {
    const TYPE: i32 = sys::RW_UINT64;
}

impl Float for f32 {}
impl Float for f64 {}
impl Index for u32 {}
impl Index for u64 {}
impl Flag for u8 {}
impl Flag for u32 {}
impl Flag for u64 {}
