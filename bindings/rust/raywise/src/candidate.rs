//! The structures as the decision saw them.

use raywise_sys as sys;

use crate::library::size_of_struct;
use crate::text;

/// One structure as the decision saw it (`rw_candidate`). `None` stands for a figure that is not known.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Candidate {
    /// Its name.
    pub structure: &'static str,
    /// It is the one in use.
    pub chosen: bool,
    /// It was chosen because the caller named it.
    pub forced: bool,
    /// It would not fit the memory limit.
    pub over_limit: bool,
    /// It was built and timed while choosing.
    pub measured: bool,
    /// It has no meaning here: there is no view, or it is outside the rule.
    pub not_applicable: bool,
    /// Predicted time to build it, ns.
    pub predicted_build_ns: Option<f64>,
    /// Predicted time per ray of the expected kind, ns.
    pub predicted_ray_ns: Option<f64>,
    /// Relative residual of the calibration; 0.2 is 20 %.
    pub predicted_error: Option<f64>,
    /// Building plus the expected rays, ns; `None` when their number is unknown.
    pub predicted_total_ns: Option<f64>,
    /// From so many rays on it beats the chosen one; infinite: never; `None` for the chosen one.
    pub break_even_rays: Option<f64>,
    /// Predicted memory.
    pub predicted_bytes: u64,
    /// Its memory, if it was built.
    pub actual_bytes: Option<u64>,
    /// What building it took, ns, if it was built.
    pub actual_build_ns: Option<f64>,
    /// What a ray took, ns: of the batches so far, or of the sample while choosing.
    pub actual_ray_ns: Option<f64>,
}

impl Candidate {
    /// A struct for the library to fill.
    pub(crate) fn blank() -> sys::rw_candidate {
        sys::rw_candidate { struct_size: size_of_struct::<sys::rw_candidate>(), ..sys::rw_candidate::default() }
    }

    /// # Safety
    /// `raw` was filled by the library.
    pub(crate) unsafe fn from_raw(raw: &sys::rw_candidate) -> Self {
        let has = |flag: u32| raw.flags & flag != 0;
        let known = |figure: f64| (!figure.is_nan()).then_some(figure);
        Candidate {
            // SAFETY: the name is a constant text.
            structure: unsafe { text::constant(raw.structure) },
            chosen: has(sys::RW_CANDIDATE_CHOSEN),
            forced: has(sys::RW_CANDIDATE_FORCED),
            over_limit: has(sys::RW_CANDIDATE_OVER_LIMIT),
            measured: has(sys::RW_CANDIDATE_MEASURED),
            not_applicable: has(sys::RW_CANDIDATE_NOT_APPLICABLE),
            predicted_build_ns: known(raw.predicted_build_ns),
            predicted_ray_ns: known(raw.predicted_ray_ns),
            predicted_error: known(raw.predicted_error),
            predicted_total_ns: known(raw.predicted_total_ns),
            break_even_rays: known(raw.break_even_rays),
            predicted_bytes: raw.predicted_bytes,
            actual_bytes: (raw.actual_bytes != 0).then_some(raw.actual_bytes),
            actual_build_ns: known(raw.actual_build_ns),
            actual_ray_ns: known(raw.actual_ray_ns),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_is_none() {
        let raw = sys::rw_candidate {
            flags: sys::RW_CANDIDATE_CHOSEN | sys::RW_CANDIDATE_MEASURED,
            structure: b"bvh\0".as_ptr().cast(),
            predicted_build_ns: 5.0,
            predicted_total_ns: f64::NAN,
            break_even_rays: f64::INFINITY,
            ..Candidate::blank()
        };
        // SAFETY: filled as the library would, with a constant name.
        let candidate = unsafe { Candidate::from_raw(&raw) };
        assert_eq!(candidate.structure, "bvh");
        assert!(candidate.chosen && candidate.measured && !candidate.forced && !candidate.over_limit);
        assert_eq!(candidate.predicted_build_ns, Some(5.0));
        assert_eq!(candidate.predicted_total_ns, None);
        assert_eq!(candidate.break_even_rays, Some(f64::INFINITY));
        assert_eq!(candidate.actual_bytes, None);
    }
}
