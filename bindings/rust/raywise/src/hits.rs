//! Where the answers to many rays go: vectors of their own, or the caller's slices.

use std::marker::PhantomData;
use std::mem::size_of;
use std::ops::Range;

use raywise_sys as sys;

use crate::element::{Element, Flag, Float, Index};
use crate::hit::id;
use crate::library::size_of_struct;
use crate::rays::same_length;
use crate::{Hit, Result};

/// The answers to many rays, one element per answer in each vector.
///
/// A miss has an infinite t and [`Hits::NOTHING`] in all ids.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Hits {
    /// In units of the direction's length; infinite for a miss.
    pub t: Vec<f64>,
    /// The weights of the triangle's second and third corner.
    pub uv: Vec<[f64; 2]>,
    /// Geometric, of unit length; zero for a miss.
    pub normal: Vec<[f64; 3]>,
    /// Which instance; [`Hits::NOTHING`] in a scene without instances.
    pub instance: Vec<u32>,
    /// Which mesh.
    pub geometry: Vec<u32>,
    /// Which triangle of the mesh.
    pub primitive: Vec<u32>,
    /// How many of the rays held a NaN. They miss.
    pub invalid_rays: u64,
}

impl Hits {
    /// The id of nothing, `RW_INVALID_ID`.
    pub const NOTHING: u32 = sys::RW_INVALID_ID;

    pub(crate) fn with_len(len: usize) -> Self {
        Hits {
            t: vec![0.0; len],
            uv: vec![[0.0; 2]; len],
            normal: vec![[0.0; 3]; len],
            instance: vec![0; len],
            geometry: vec![0; len],
            primitive: vec![0; len],
            invalid_rays: 0,
        }
    }

    pub(crate) fn all_mut(&mut self) -> HitsMut<'_> {
        HitsMut::new()
            .t(&mut self.t)
            .uv(&mut self.uv)
            .normal(&mut self.normal)
            .instance(&mut self.instance)
            .geometry(&mut self.geometry)
            .primitive(&mut self.primitive)
    }

    pub(crate) fn truncate(&mut self, len: usize) {
        self.t.truncate(len);
        self.uv.truncate(len);
        self.normal.truncate(len);
        self.instance.truncate(len);
        self.geometry.truncate(len);
        self.primitive.truncate(len);
    }

    /// How many answers, misses included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// One answer; `None` for a miss.
    ///
    /// # Panics
    /// When there is no such answer.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Hit> {
        let [u, v] = self.uv[index];
        Some(Hit {
            t: self.t[index],
            u,
            v,
            instance: id(self.instance[index]),
            geometry: id(self.geometry[index])?,
            primitive: self.primitive[index],
        })
    }

    /// All answers in order; `None` for a miss.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<Hit>> + '_ {
        (0..self.len()).map(|index| self.get(index))
    }
}

/// Every hit of many rays: those of ray i are the answers `offsets[i] .. offsets[i + 1]`, sorted by t.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct AllHits {
    /// One more than there are rays.
    pub offsets: Vec<u64>,
    /// The hits of all rays, one ray after the other.
    pub hits: Hits,
}

impl AllHits {
    /// Which answers belong to a ray.
    ///
    /// # Panics
    /// When there is no such ray.
    #[must_use]
    pub fn range(&self, ray: usize) -> Range<usize> {
        self.offsets[ray] as usize..self.offsets[ray + 1] as usize
    }

    /// The hits of a ray, closest first.
    ///
    /// # Panics
    /// When there is no such ray.
    pub fn of_ray(&self, ray: usize) -> impl ExactSizeIterator<Item = Hit> + '_ {
        let range = self.range(ray);
        range.map(|index| self.hits.get(index).expect("the answers to the question for all hits are hits"))
    }
}

/// A borrowed slice in the form C takes it (`rw_output`), with its length.
#[derive(Debug)]
pub(crate) struct Output<'a> {
    raw: sys::rw_output,
    len: usize,
    data: PhantomData<&'a mut [u8]>,
}

// SAFETY: this is an exclusive borrow of plain numbers, in other words a `&mut [f32]` or the like.
unsafe impl Send for Output<'_> {}
// SAFETY: nothing can be done with a shared reference to it but asking for its length and address.
unsafe impl Sync for Output<'_> {}

impl<'a> Output<'a> {
    /// `rows` of numbers of type `T`.
    pub(crate) fn packed<T: Element, Row>(rows: &'a mut [Row]) -> Self {
        let raw = sys::rw_output {
            data: rows.as_mut_ptr().cast(),
            stride: size_of::<Row>() as i64,
            component_stride: size_of::<T>() as i64,
            type_: T::TYPE,
            reserved: 0,
        };
        Output { raw, len: rows.len(), data: PhantomData }
    }

    pub(crate) fn flags<T: Flag>(rows: &'a mut [T]) -> Self {
        Output::packed::<T, T>(rows)
    }

    /// The slice as C takes it, if it is of the right length.
    pub(crate) fn raw(&mut self, what: &'static str, expected: usize) -> Result<sys::rw_output> {
        same_length(what, expected, self.len)?;
        Ok(self.raw)
    }
}

/// The caller's slices for the answers (`rw_hits`), each of them optional and as long as there are answers.
///
/// ```
/// use raywise::HitsMut;
/// let mut t = vec![0.0_f32; 100];
/// let mut primitive = vec![0_u64; 100];
/// let hits = HitsMut::new().t(&mut t).primitive(&mut primitive);
/// ```
#[derive(Debug, Default)]
pub struct HitsMut<'a> {
    t: Option<Output<'a>>,
    uv: Option<Output<'a>>,
    normal: Option<Output<'a>>,
    instance: Option<Output<'a>>,
    geometry: Option<Output<'a>>,
    primitive: Option<Output<'a>>,
}

impl<'a> HitsMut<'a> {
    /// Nothing is wanted yet.
    #[must_use]
    pub fn new() -> Self {
        HitsMut::default()
    }

    /// t, infinite for a miss.
    #[must_use]
    pub fn t<T: Float>(mut self, t: &'a mut [T]) -> Self {
        self.t = Some(Output::packed::<T, T>(t));
        self
    }

    /// u and v.
    #[must_use]
    pub fn uv<T: Float>(mut self, uv: &'a mut [[T; 2]]) -> Self {
        self.uv = Some(Output::packed::<T, [T; 2]>(uv));
        self
    }

    /// The geometric normal.
    #[must_use]
    pub fn normal<T: Float>(mut self, normal: &'a mut [[T; 3]]) -> Self {
        self.normal = Some(Output::packed::<T, [T; 3]>(normal));
        self
    }

    /// Which instance. The id of nothing is the greatest number of its type.
    #[must_use]
    pub fn instance<T: Index>(mut self, instance: &'a mut [T]) -> Self {
        self.instance = Some(Output::packed::<T, T>(instance));
        self
    }

    /// Which mesh. The id of nothing is the greatest number of its type.
    #[must_use]
    pub fn geometry<T: Index>(mut self, geometry: &'a mut [T]) -> Self {
        self.geometry = Some(Output::packed::<T, T>(geometry));
        self
    }

    /// Which triangle. The id of nothing is the greatest number of its type.
    #[must_use]
    pub fn primitive<T: Index>(mut self, primitive: &'a mut [T]) -> Self {
        self.primitive = Some(Output::packed::<T, T>(primitive));
        self
    }

    fn slices(&mut self) -> [(&'static str, Option<&mut Output<'a>>); 6] {
        [
            ("output t", self.t.as_mut()),
            ("output uv", self.uv.as_mut()),
            ("output normal", self.normal.as_mut()),
            ("output instance", self.instance.as_mut()),
            ("output geometry", self.geometry.as_mut()),
            ("output primitive", self.primitive.as_mut()),
        ]
    }

    /// The length that all slices have; `None` when nothing is wanted.
    pub(crate) fn common_len(&mut self) -> Result<Option<usize>> {
        let mut common = None;
        for (what, output) in self.slices() {
            if let Some(output) = output {
                same_length(what, *common.get_or_insert(output.len), output.len)?;
            }
        }
        Ok(common)
    }

    /// The slices as C takes them, if each is of the right length.
    pub(crate) fn raw(&mut self, expected: usize) -> Result<sys::rw_hits> {
        let mut raw = [sys::rw_output::default(); 6];
        for (place, (what, output)) in raw.iter_mut().zip(self.slices()) {
            if let Some(output) = output {
                *place = output.raw(what, expected)?;
            }
        }
        let [t, uv, normal, instance, geometry, primitive] = raw;
        let struct_size = size_of_struct::<sys::rw_hits>();
        Ok(sys::rw_hits { struct_size, flags: 0, t, uv, normal, instance, geometry, primitive })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;

    #[test]
    fn each_slice_has_to_be_as_long_as_there_are_answers() {
        let mut t = [0.0_f64; 3];
        let mut ids = [0_u32; 2];
        let mut hits = HitsMut::new().t(&mut t).geometry(&mut ids);
        let error = hits.raw(3).unwrap_err();
        assert_eq!(error, Error::Length { what: "output geometry", expected: 3, found: 2 });
        let error = hits.common_len().unwrap_err();
        assert_eq!(error, Error::Length { what: "output geometry", expected: 3, found: 2 });
    }

    #[test]
    fn what_is_not_wanted_is_null() {
        let mut normal = [[0.0_f32; 3]; 2];
        let raw = HitsMut::new().normal(&mut normal).raw(2).unwrap();
        assert!(raw.t.data.is_null() && raw.uv.data.is_null() && raw.instance.data.is_null());
        assert_eq!(raw.normal.data, normal.as_mut_ptr().cast());
        assert_eq!((raw.normal.stride, raw.normal.component_stride, raw.normal.type_), (12, 4, sys::RW_FLOAT32));
        assert_eq!(HitsMut::new().common_len(), Ok(None));
    }

    #[test]
    fn hits_are_read_one_by_one() {
        let mut hits = Hits::with_len(2);
        hits.t = vec![1.5, f64::INFINITY];
        hits.instance = vec![Hits::NOTHING; 2];
        hits.geometry[1] = Hits::NOTHING;
        hits.primitive = vec![7, Hits::NOTHING];
        let found: Vec<_> = hits.iter().collect();
        assert_eq!(found[0].map(|hit| (hit.t, hit.primitive, hit.instance)), Some((1.5, 7, None)));
        assert_eq!(found[1], None);
    }
}
