//! What a scene will be asked, and how hard to think about it. A wrong word here costs time, never an answer.

use std::time::Duration;

use raywise_sys as sys;

use crate::library::size_of_struct;
use crate::Rays;

/// How rays are spread, which decides what they cost (`RW_RAYS_`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RayKind {
    /// Not known: reckoned as random.
    #[default]
    Any,
    /// No order at all: chords through the scene.
    Random,
    /// From one eye, in the order of an image.
    Camera,
    /// Towards one light, asking whether anything is hit.
    Shadow,
    /// From surfaces, in all directions.
    Diffuse,
}

impl RayKind {
    pub(crate) fn raw(self) -> i32 {
        match self {
            RayKind::Any => sys::RW_RAYS_ANY_KIND,
            RayKind::Random => sys::RW_RAYS_RANDOM,
            RayKind::Camera => sys::RW_RAYS_CAMERA,
            RayKind::Shadow => sys::RW_RAYS_SHADOW,
            RayKind::Diffuse => sys::RW_RAYS_DIFFUSE,
        }
    }
}

/// The C value for a number of rays; `None` stands for a number that nobody knows.
pub(crate) fn count_or_unknown(count: Option<u64>) -> u64 {
    count.unwrap_or(sys::RW_RAYS_UNKNOWN)
}

/// How many rays of which kind are coming (`rw_expected_rays`).
#[derive(Clone, Copy, Debug, Default)]
pub struct ExpectedRays<'a> {
    kind: RayKind,
    count: Option<u64>,
    sample: Option<&'a Rays<'a>>,
}

impl<'a> ExpectedRays<'a> {
    /// So many rays.
    #[must_use]
    pub fn new(count: u64) -> Self {
        ExpectedRays { count: Some(count), ..Default::default() }
    }

    /// Nobody knows how many: `RW_RAYS_UNKNOWN`.
    #[must_use]
    pub fn unknown() -> Self {
        ExpectedRays::default()
    }

    /// Of which kind they are.
    #[must_use]
    pub fn kind(mut self, kind: RayKind) -> Self {
        self.kind = kind;
        self
    }

    /// Some of the rays, for [`Effort::Probe`], [`Effort::Measure`] and [`Rule::Hapala`]. They are copied, at most the
    /// first 1,000 and without their skip lists. Without a sample rays of the kind are made up.
    #[must_use]
    pub fn sample(mut self, rays: &'a Rays<'a>) -> Self {
        self.sample = Some(rays);
        self
    }

    /// Makes a C call with the expectation in the form C takes it.
    pub(crate) fn with_raw<R>(&self, call: impl FnOnce(&sys::rw_expected_rays) -> R) -> R {
        let sample = self.sample.map(Rays::raw);
        call(&sys::rw_expected_rays {
            struct_size: size_of_struct::<sys::rw_expected_rays>(),
            kind: self.kind.raw(),
            count: count_or_unknown(self.count),
            sample: sample.as_ref().map_or(std::ptr::null(), |sample| sample as *const _),
        })
    }
}

/// How hard to think before choosing (`RW_EFFORT_`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Effort {
    /// Formulas only.
    #[default]
    Estimate,
    /// Build the grid and time a sample of rays on it.
    Probe,
    /// Build every candidate that fits and time the sample on each. No further build is started after the limit.
    Measure {
        /// `None`: no limit.
        limit: Option<Duration>,
    },
}

impl Effort {
    /// The constant and the limit in seconds.
    pub(crate) fn raw(self) -> (i32, f64) {
        match self {
            Effort::Estimate => (sys::RW_EFFORT_ESTIMATE, 0.0),
            Effort::Probe => (sys::RW_EFFORT_PROBE, 0.0),
            Effort::Measure { limit: None } => (sys::RW_EFFORT_MEASURE, 0.0),
            // 0 would mean no limit, so a limit of nothing becomes the least there is.
            Effort::Measure { limit: Some(limit) } => {
                (sys::RW_EFFORT_MEASURE, limit.as_secs_f64().max(f64::MIN_POSITIVE))
            }
        }
    }
}

/// By which rule to choose (`RW_RULE_`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rule {
    /// Building plus rays, the smallest predicted total of all candidates.
    #[default]
    SmallestTotal,
    /// Grid or kd-tree by the critical ray count (Hapala, Karlik, Havran 2011).
    Hapala,
}

impl Rule {
    pub(crate) fn raw(self) -> i32 {
        match self {
            Rule::SmallestTotal => sys::RW_RULE_SMALLEST_TOTAL,
            Rule::Hapala => sys::RW_RULE_HAPALA,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_not_told_is_unknown() {
        ExpectedRays::unknown().with_raw(|raw| {
            assert_eq!((raw.count, raw.kind), (sys::RW_RAYS_UNKNOWN, sys::RW_RAYS_ANY_KIND));
            assert!(raw.sample.is_null());
        });
        ExpectedRays::new(5).kind(RayKind::Shadow).with_raw(|raw| {
            assert_eq!((raw.count, raw.kind), (5, sys::RW_RAYS_SHADOW));
        });
    }

    #[test]
    fn a_sample_is_handed_on() {
        let directions = [[0.0, 0.0, 1.0]; 7];
        let rays = Rays::new([0.0; 3], &directions).unwrap();
        ExpectedRays::new(5).sample(&rays).with_raw(|raw| {
            // SAFETY: the sample lives as long as this closure.
            assert_eq!(unsafe { (*raw.sample).count }, 7);
        });
    }

    #[test]
    fn a_limit_of_nothing_is_not_no_limit() {
        assert_eq!(Effort::Measure { limit: None }.raw().1, 0.0);
        assert!(Effort::Measure { limit: Some(Duration::ZERO) }.raw().1 > 0.0);
        assert_eq!(Effort::Measure { limit: Some(Duration::from_millis(250)) }.raw().1, 0.25);
    }
}
