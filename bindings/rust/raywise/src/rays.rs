//! Many rays.

use raywise_sys as sys;

use crate::arrays::{repeated, Scalars, Vectors};
use crate::element::Float;
use crate::library::size_of_struct;
use crate::{Error, Result, SkipLists};

/// An origin or a direction for every ray, or one for all of them.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum PerRayVector<'a> {
    /// The same for every ray.
    One([f64; 3]),
    /// One each.
    Each(Vectors<'a>),
}

/// A bound for every ray, or one for all of them.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum PerRayNumber<'a> {
    /// The same for every ray.
    One([f64; 1]),
    /// One each.
    Each(Scalars<'a>),
}

impl<T: Float + Into<f64>> From<[T; 3]> for PerRayVector<'_> {
    fn from(vector: [T; 3]) -> Self {
        PerRayVector::One(vector.map(Into::into))
    }
}

impl<'a> From<Vectors<'a>> for PerRayVector<'a> {
    fn from(vectors: Vectors<'a>) -> Self {
        PerRayVector::Each(vectors)
    }
}

impl From<f64> for PerRayNumber<'_> {
    fn from(number: f64) -> Self {
        PerRayNumber::One([number])
    }
}

impl<'a> From<Scalars<'a>> for PerRayNumber<'a> {
    fn from(numbers: Scalars<'a>) -> Self {
        PerRayNumber::Each(numbers)
    }
}

macro_rules! each_from_rows {
    ($to:ident, $through:ident, $bound:ident, $row:ty) => {
        impl<'a, T: $bound> From<&'a [$row]> for $to<'a> {
            fn from(rows: &'a [$row]) -> Self {
                $to::Each($through::from(rows))
            }
        }
        impl<'a, T: $bound> From<&'a Vec<$row>> for $to<'a> {
            fn from(rows: &'a Vec<$row>) -> Self {
                $to::Each($through::from(rows))
            }
        }
        impl<'a, T: $bound, const N: usize> From<&'a [$row; N]> for $to<'a> {
            fn from(rows: &'a [$row; N]) -> Self {
                $to::Each($through::from(rows))
            }
        }
    };
}

pub(crate) use each_from_rows;

each_from_rows!(PerRayVector, Vectors, Float, [T; 3]);
each_from_rows!(PerRayNumber, Scalars, Float, T);

/// Many rays in the caller's arrays (`rw_rays`). Nothing is copied.
///
/// ```
/// use raywise::Rays;
/// let directions = [[0.0_f32, 0.0, -1.0], [0.0, 0.1, -1.0]];
/// let rays = Rays::new([0.0, 0.0, 5.0], &directions)?.with_tmax(100.0)?;
/// assert_eq!(rays.len(), 2);
/// # Ok::<(), raywise::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rays<'a> {
    origins: PerRayVector<'a>,
    directions: PerRayVector<'a>,
    tmin: Option<PerRayNumber<'a>>,
    tmax: Option<PerRayNumber<'a>>,
    skip: Option<SkipLists<'a>>,
    count: usize,
}

impl<'a> Rays<'a> {
    /// Rays from origins and directions: slices of `[f32; 3]` or `[f64; 3]` with one element per ray, [`Vectors`], or a
    /// single `[f64; 3]` that stands for all rays. They run from t = 0 without an end.
    ///
    /// # Errors
    /// [`Error::Length`] when there are not as many directions as origins.
    pub fn new(origins: impl Into<PerRayVector<'a>>, directions: impl Into<PerRayVector<'a>>) -> Result<Self> {
        let (origins, directions) = (origins.into(), directions.into());
        let count = match (&origins, &directions) {
            (PerRayVector::One(_), PerRayVector::One(_)) => 1,
            (PerRayVector::Each(each), PerRayVector::One(_)) | (PerRayVector::One(_), PerRayVector::Each(each)) => {
                each.len()
            }
            (PerRayVector::Each(origins), PerRayVector::Each(directions)) => {
                same_length("directions", origins.len(), directions.len())?;
                origins.len()
            }
        };
        Ok(Rays { origins, directions, tmin: None, tmax: None, skip: None, count })
    }

    /// The least t that counts: a slice with one number per ray, or one `f64` for all.
    ///
    /// # Errors
    /// [`Error::Length`] when there is not one per ray.
    pub fn with_tmin(mut self, tmin: impl Into<PerRayNumber<'a>>) -> Result<Self> {
        self.tmin = Some(self.one_per_ray("tmin", tmin.into())?);
        Ok(self)
    }

    /// The greatest t that counts: a slice with one number per ray, or one `f64` for all.
    ///
    /// # Errors
    /// [`Error::Length`] when there is not one per ray.
    pub fn with_tmax(mut self, tmax: impl Into<PerRayNumber<'a>>) -> Result<Self> {
        self.tmax = Some(self.one_per_ray("tmax", tmax.into())?);
        Ok(self)
    }

    /// Triangles that single rays pass through without a hit: [`SkipLists`], or `&Hits` or `&AllHits` of as many rays.
    ///
    /// ```
    /// use raywise::{Hits, Rays, Result, Scene};
    /// fn next_hits(scene: &Scene, rays: &Rays<'_>, previous: &Hits) -> Result<Hits> {
    ///     scene.intersect_batch(&rays.with_skip(previous)?)
    /// }
    /// ```
    ///
    /// An id that is not there is found when the rays are asked about:
    /// [`Status::INDEX_OUT_OF_RANGE`](crate::Status::INDEX_OUT_OF_RANGE).
    ///
    /// # Errors
    /// [`Error::Length`] when there is not a list for each ray and an id for each of their entries, [`Error::Falling`]
    /// when an offset is below the one before it.
    pub fn with_skip(mut self, skip: impl Into<SkipLists<'a>>) -> Result<Self> {
        let skip = skip.into();
        skip.check(self.count)?;
        self.skip = Some(skip);
        Ok(self)
    }

    fn one_per_ray(&self, what: &'static str, bounds: PerRayNumber<'a>) -> Result<PerRayNumber<'a>> {
        if let PerRayNumber::Each(each) = &bounds {
            same_length(what, self.count, each.len())?;
        }
        Ok(bounds)
    }

    /// How many rays.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The rays as C takes them. What stands for all rays lies in `self`, so the result is good as long as `self` stays
    /// where it is.
    pub(crate) fn raw(&self) -> sys::rw_rays {
        let vector = |any: &PerRayVector| match any {
            PerRayVector::One(vector) => repeated(vector),
            PerRayVector::Each(vectors) => vectors.raw(),
        };
        let number = |any: &Option<PerRayNumber>| match any {
            None => sys::rw_array::default(),
            Some(PerRayNumber::One(number)) => repeated(number),
            Some(PerRayNumber::Each(numbers)) => numbers.raw(),
        };
        let mut raw = sys::rw_rays {
            struct_size: size_of_struct::<sys::rw_rays>(),
            count: self.count as u64,
            origin: vector(&self.origins),
            direction: vector(&self.directions),
            tmin: number(&self.tmin),
            tmax: number(&self.tmax),
            ..sys::rw_rays::default()
        };
        if let Some(skip) = &self.skip {
            skip.add_to(&mut raw);
        }
        raw
    }
}

/// Whether two arrays that belong together are equally long.
pub(crate) fn same_length(what: &'static str, expected: usize, found: usize) -> Result<()> {
    if found == expected {
        Ok(())
    } else {
        Err(Error::Length { what, expected, found })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_to_agree() {
        let three = vec![[0.0_f64; 3]; 3];
        let two = [[1.0_f32; 3]; 2];
        assert_eq!(Rays::new(&three, &two).unwrap_err(), Error::Length { what: "directions", expected: 3, found: 2 });
        let rays = Rays::new(&three, [0.0, 0.0, 1.0]).unwrap();
        assert_eq!(rays.len(), 3);
        assert_eq!(rays.with_tmin(&[0.0_f32; 2]).unwrap_err(), Error::Length { what: "tmin", expected: 3, found: 2 });
        assert_eq!(rays.with_tmax(&[0.0_f64; 4]).unwrap_err(), Error::Length { what: "tmax", expected: 3, found: 4 });
        assert!(rays.with_tmin(0.5).unwrap().with_tmax(&[1.0_f32; 3]).is_ok());
    }

    #[test]
    fn what_stands_for_all_rays_is_repeated() {
        let directions = [[0.0_f32, 0.0, 1.0]; 5];
        let rays = Rays::new([1.0_f32, 2.0, 3.0], &directions).unwrap().with_tmax(9.0).unwrap();
        let raw = rays.raw();
        assert_eq!(raw.count, 5);
        assert_eq!((raw.origin.stride, raw.origin.type_), (sys::RW_REPEAT, sys::RW_FLOAT64));
        assert_eq!((raw.direction.stride, raw.direction.type_), (12, sys::RW_FLOAT32));
        assert!(raw.tmin.data.is_null());
        assert_eq!(raw.tmax.stride, sys::RW_REPEAT);
    }

    #[test]
    fn one_origin_and_one_direction_are_one_ray() {
        assert_eq!(Rays::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap().len(), 1);
        let none: [[f64; 3]; 0] = [];
        assert!(Rays::new(&none, [0.0, 0.0, 1.0]).unwrap().is_empty());
    }
}
