//! Arrays that the library reads where they lie: vertices, triangle corners, ray origins and directions, bounds of rays,
//! ids.

use std::marker::PhantomData;
use std::mem::size_of;

use raywise_sys as sys;

use crate::element::{Element, Float, Index};
use crate::{Error, Result};

/// A borrowed array in the form C takes it (`rw_array`), with its length.
#[derive(Clone, Copy, Debug)]
struct Borrowed<'a> {
    raw: sys::rw_array,
    len: usize,
    data: PhantomData<&'a [u8]>,
}

// SAFETY: this is a shared borrow of plain numbers, in other words a `&[f32]` or the like, and nothing writes through it.
unsafe impl Send for Borrowed<'_> {}
// SAFETY: as above.
unsafe impl Sync for Borrowed<'_> {}

impl<'a> Borrowed<'a> {
    /// `rows` of numbers of type `T`, one behind the other.
    fn packed<T: Element, Row>(rows: &'a [Row]) -> Self {
        let raw = sys::rw_array {
            data: rows.as_ptr().cast(),
            stride: size_of::<Row>() as i64,
            component_stride: size_of::<T>() as i64,
            type_: T::TYPE,
            reserved: 0,
        };
        Borrowed { raw, len: rows.len(), data: PhantomData }
    }
}

// What the four kinds of borrowed numbers share: where they come from, and how many there are.
macro_rules! borrowed_rows {
    ($to:ident, $bound:ident, $row:ty) => {
        impl $to<'_> {
            /// How many there are.
            #[must_use]
            pub fn len(&self) -> usize {
                self.0.len
            }

            /// Whether there are none.
            #[must_use]
            pub fn is_empty(&self) -> bool {
                self.0.len == 0
            }

            pub(crate) fn raw(&self) -> sys::rw_array {
                self.0.raw
            }
        }
        impl<'a, T: $bound> From<&'a [$row]> for $to<'a> {
            fn from(rows: &'a [$row]) -> Self {
                $to(Borrowed::packed::<T, $row>(rows))
            }
        }
        impl<'a, T: $bound> From<&'a Vec<$row>> for $to<'a> {
            fn from(rows: &'a Vec<$row>) -> Self {
                rows.as_slice().into()
            }
        }
        impl<'a, T: $bound, const N: usize> From<&'a [$row; N]> for $to<'a> {
            fn from(rows: &'a [$row; N]) -> Self {
                rows.as_slice().into()
            }
        }
    };
}

/// Points or directions: `&[[f32; 3]]`, `&[[f64; 3]]`, or numbers that lie in another order ([`interleaved`],
/// [`planar`]). Nothing is copied.
///
/// [`interleaved`]: Vectors::interleaved
/// [`planar`]: Vectors::planar
#[derive(Clone, Copy, Debug)]
pub struct Vectors<'a>(Borrowed<'a>);

borrowed_rows!(Vectors, Float, [T; 3]);

impl<'a> Vectors<'a> {
    /// Vectors amid other numbers, e.g. positions in a vertex buffer that holds normals and texture coordinates too:
    /// vector i is `numbers[first + i * step ..][.. 3]`, as long as it lies inside.
    ///
    /// ```
    /// use raywise::Vectors;
    /// // x, y, z, u, v for each of two vertices
    /// let buffer = [0.0_f32, 0.0, 0.0, 0.5, 0.5, 1.0, 0.0, 0.0, 0.5, 0.5];
    /// assert_eq!(Vectors::interleaved(&buffer, 0, 5).unwrap().len(), 2);
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] when `step` is less than 3: the vectors would overlap.
    pub fn interleaved<T: Float>(numbers: &'a [T], first: usize, step: usize) -> Result<Self> {
        if step < 3 {
            return Err(Error::Length { what: "step from one vector to the next", expected: 3, found: step });
        }
        let from_first = numbers.get(first..).unwrap_or(&[]);
        let len = if from_first.len() < 3 { 0 } else { (from_first.len() - 3) / step + 1 };
        let mut borrowed = Borrowed::packed::<T, T>(from_first);
        borrowed.raw.stride = (step * size_of::<T>()) as i64;
        borrowed.len = len;
        Ok(Vectors(borrowed))
    }

    /// All x, then all y, then all z.
    ///
    /// # Errors
    /// [`Error::Length`] when the numbers cannot be divided by three.
    pub fn planar<T: Float>(numbers: &'a [T]) -> Result<Self> {
        let len = numbers.len() / 3;
        if numbers.len() % 3 != 0 {
            return Err(Error::Length { what: "planar vectors", expected: 3 * len + 3, found: numbers.len() });
        }
        let mut borrowed = Borrowed::packed::<T, T>(numbers);
        borrowed.raw.component_stride = (len * size_of::<T>()) as i64;
        borrowed.len = len;
        Ok(Vectors(borrowed))
    }
}

/// Corners of triangles: `&[[u32; 3]]` or `&[[u64; 3]]`. Nothing is copied.
#[derive(Clone, Copy, Debug)]
pub struct Indices<'a>(Borrowed<'a>);

borrowed_rows!(Indices, Index, [T; 3]);

/// One number per ray: `&[f32]` or `&[f64]`. Nothing is copied.
#[derive(Clone, Copy, Debug)]
pub struct Scalars<'a>(Borrowed<'a>);

borrowed_rows!(Scalars, Float, T);

/// One id per entry of a skip list: `&[u32]` or `&[u64]`. Nothing is copied.
#[derive(Clone, Copy, Debug)]
pub struct Ids<'a>(Borrowed<'a>);

borrowed_rows!(Ids, Index, T);

/// One value that stands for every ray. The caller keeps `value` where it is while the result is in use.
pub(crate) fn repeated<T: Element, const N: usize>(value: &[T; N]) -> sys::rw_array {
    sys::rw_array {
        data: value.as_ptr().cast(),
        stride: sys::RW_REPEAT,
        component_stride: 0,
        type_: T::TYPE,
        reserved: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_described_as_they_lie() {
        let points = [[0.0_f32; 3]; 4];
        let vectors = Vectors::from(&points);
        assert_eq!((vectors.len(), vectors.raw().stride, vectors.raw().component_stride), (4, 12, 4));
        assert_eq!(vectors.raw().type_, sys::RW_FLOAT32);
        assert_eq!(vectors.raw().data, points.as_ptr().cast());

        let corners = vec![[0_u64; 3]; 2];
        let indices = Indices::from(&corners);
        assert_eq!((indices.len(), indices.raw().stride, indices.raw().type_), (2, 24, sys::RW_UINT64));
    }

    #[test]
    fn interleaved_counts_whole_vectors_only() {
        let numbers = [0.0_f64; 13];
        let count = |first, step| Vectors::interleaved(&numbers, first, step).unwrap().len();
        assert_eq!(count(0, 5), 3); // 0..3, 5..8, 10..13
        assert_eq!(count(1, 5), 2); // 11..14 is not there
        assert_eq!(count(10, 5), 1);
        assert_eq!(count(11, 5), 0);
        assert_eq!(count(99, 5), 0);
        let strided = Vectors::interleaved(&numbers, 2, 5).unwrap();
        assert_eq!((strided.raw().stride, strided.raw().component_stride), (40, 8));
        assert_eq!(strided.raw().data, numbers[2..].as_ptr().cast());
        assert!(Vectors::interleaved(&numbers, 0, 2).is_err());
    }

    #[test]
    fn planar_has_a_third_of_the_numbers() {
        let numbers = [0.0_f32; 6];
        let vectors = Vectors::planar(&numbers).unwrap();
        assert_eq!((vectors.len(), vectors.raw().stride, vectors.raw().component_stride), (2, 4, 8));
        assert!(Vectors::planar(&numbers[..5]).is_err());
    }
}
