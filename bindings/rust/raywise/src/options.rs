//! How to run a batch, and how to run a build.

use std::any::Any;
use std::fmt;
use std::ops::ControlFlow;
use std::os::raw::{c_char, c_void};
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::AtomicI32;

use raywise_sys as sys;

use crate::library::size_of_struct;
use crate::parallel::{Host, ParallelFor};
use crate::text;
use crate::workspace::Workspace;

/// How to run a batch (`rw_query_options`).
#[derive(Clone, Copy, Default)]
pub struct QueryOptions<'a> {
    threads: u32,
    parallel_for: Option<ParallelFor<'a>>,
    progress: Option<QueryProgress<'a>>,
    cancel: Option<&'a AtomicI32>,
    workspace: Option<&'a Workspace>,
}

type QueryProgress<'a> = &'a (dyn Fn(f64, &str) -> ControlFlow<()> + Sync);

impl<'a> QueryOptions<'a> {
    /// As many threads as the process may use, the library's own.
    #[must_use]
    pub fn new() -> Self {
        QueryOptions::default()
    }

    /// At most so many threads; 0: as many as the process may use.
    #[must_use]
    pub fn threads(mut self, threads: u32) -> Self {
        self.threads = threads;
        self
    }

    /// The host's threads instead of the library's.
    #[must_use]
    pub fn parallel_for(mut self, run: ParallelFor<'a>) -> Self {
        self.parallel_for = Some(run);
        self
    }

    /// Is told the fraction done, from 0 to 1, and the stage, about every ten milliseconds; `ControlFlow::Break` stops the
    /// batch, which then fails with [`Status::CANCELLED`](crate::Status::CANCELLED). Answers that were written are right.
    ///
    /// It is called from the thread that asked, with [`parallel_for`](QueryOptions::parallel_for) from any of the host's at
    /// work, and never from two at once. A panic stops the batch as well, and goes on in the caller once the library has
    /// returned.
    #[must_use]
    pub fn progress(mut self, progress: &'a (dyn Fn(f64, &str) -> ControlFlow<()> + Sync)) -> Self {
        self.progress = Some(progress);
        self
    }

    /// Any number but 0 stops the batch, as `progress` does. It may be stored at any time, from any thread.
    #[must_use]
    pub fn cancel(mut self, flag: &'a AtomicI32) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// The memory that batches take, kept from one to the next; see [`Workspace`].
    #[must_use]
    pub fn workspace(mut self, workspace: &'a Workspace) -> Self {
        self.workspace = Some(workspace);
        self
    }

    /// Makes a C call with these options, and goes on with a panic of the host's code afterwards.
    /// `invalid_rays` receives the number of rays with a NaN.
    pub(crate) fn with_raw<R>(&self, invalid_rays: &mut u64, call: impl FnOnce(&sys::rw_query_options) -> R) -> R {
        let host = Host::new(self.parallel_for);
        let (parallel_for, parallel_user) = host.raw();
        let mut listener = self.progress.map(|tell| Listener::new(Box::new(tell)));
        let (progress, progress_user) = Listener::raw(listener.as_mut());
        let result = call(&sys::rw_query_options {
            struct_size: size_of_struct::<sys::rw_query_options>(),
            threads: self.threads,
            parallel_for,
            parallel_user,
            invalid_rays,
            progress,
            progress_user,
            cancel: self.cancel.map_or(std::ptr::null(), |flag| flag.as_ptr().cast_const()),
            workspace: self.workspace.map_or(std::ptr::null_mut(), Workspace::as_ptr),
        });
        Listener::resume_panic(listener);
        host.resume_panic();
        result
    }
}

impl fmt::Debug for QueryOptions<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("QueryOptions")
            .field("threads", &self.threads)
            .field("parallel_for", &self.parallel_for.map(|_| ".."))
            .field("progress", &self.progress.map(|_| ".."))
            .field("cancel", &self.cancel)
            .field("workspace", &self.workspace)
            .finish()
    }
}

/// What [`Scene::refit_with`](crate::Scene::refit_with) does with the old structure (`RW_REFIT_`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RefitPolicy {
    /// New boxes around it, where that is reckoned to pay by the rays expected.
    #[default]
    WhereItPays,
    /// New boxes around it wherever it has such a form, however they overlap.
    WherePossible,
    /// Built anew; numbers of triangles and meshes may change from frame to frame.
    Never,
}

impl RefitPolicy {
    fn raw(self) -> i32 {
        match self {
            RefitPolicy::WhereItPays => sys::RW_REFIT_WHERE_IT_PAYS,
            RefitPolicy::WherePossible => sys::RW_REFIT_WHERE_POSSIBLE,
            RefitPolicy::Never => sys::RW_REFIT_NEVER,
        }
    }
}

type Progress<'a> = Box<dyn FnMut(f64, &str) -> ControlFlow<()> + Send + 'a>;

/// How to run a build (`rw_commit_options`).
///
/// ```
/// use std::ops::ControlFlow;
/// use raywise::CommitOptions;
/// let options = CommitOptions::new().threads(1).progress(|fraction, stage| {
///     println!("{stage}: {:.0} %", 100.0 * fraction);
///     ControlFlow::Continue(())
/// });
/// ```
#[derive(Default)]
pub struct CommitOptions<'a> {
    threads: u32,
    progress: Option<Progress<'a>>,
    parallel_for: Option<ParallelFor<'a>>,
    refit: RefitPolicy,
}

impl<'a> CommitOptions<'a> {
    /// As many threads as the process may use, the library's own, and no progress told.
    #[must_use]
    pub fn new() -> Self {
        CommitOptions::default()
    }

    /// At most so many threads; 0: as many as the process may use.
    #[must_use]
    pub fn threads(mut self, threads: u32) -> Self {
        self.threads = threads;
        self
    }

    /// Is told the fraction done, from 0 to 1, and the stage; `ControlFlow::Break` stops the build, which then fails
    /// with [`Status::CANCELLED`](crate::Status::CANCELLED).
    ///
    /// It may be called from any of the threads at work, never from two at once. A panic stops the build as well, and
    /// goes on in the caller once the library has returned.
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(f64, &str) -> ControlFlow<()> + Send + 'a) -> Self {
        self.progress = Some(Box::new(progress));
        self
    }

    /// The host's threads instead of the library's.
    #[must_use]
    pub fn parallel_for(mut self, run: ParallelFor<'a>) -> Self {
        self.parallel_for = Some(run);
        self
    }

    /// What becomes of the structure when the build is a refit; of no effect on others.
    #[must_use]
    pub fn refit(mut self, policy: RefitPolicy) -> Self {
        self.refit = policy;
        self
    }

    /// Makes a C call with these options, and goes on with a panic of the caller's code afterwards.
    pub(crate) fn with_raw<R>(self, call: impl FnOnce(&sys::rw_commit_options) -> R) -> R {
        let host = Host::new(self.parallel_for);
        let (parallel_for, parallel_user) = host.raw();
        let mut listener = self.progress.map(Listener::new);
        let (progress, progress_user) = Listener::raw(listener.as_mut());
        let result = call(&sys::rw_commit_options {
            struct_size: size_of_struct::<sys::rw_commit_options>(),
            threads: self.threads,
            progress,
            progress_user,
            parallel_for,
            parallel_user,
            refit: self.refit.raw(),
            reserved: 0,
        });
        Listener::resume_panic(listener);
        host.resume_panic();
        result
    }
}

impl fmt::Debug for CommitOptions<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("CommitOptions")
            .field("threads", &self.threads)
            .field("progress", &self.progress.as_ref().map(|_| ".."))
            .field("parallel_for", &self.parallel_for.map(|_| ".."))
            .field("refit", &self.refit)
            .finish()
    }
}

/// A progress closure for the time of one C call.
struct Listener<'a> {
    tell: Progress<'a>,
    panic: Option<Box<dyn Any + Send>>,
}

impl<'a> Listener<'a> {
    fn new(tell: Progress<'a>) -> Self {
        Listener { tell, panic: None }
    }

    /// In the form C takes it, for as long as the listener lives and is not moved.
    fn raw(listener: Option<&mut Self>) -> (sys::rw_progress, *mut c_void) {
        match listener {
            None => (None, std::ptr::null_mut()),
            Some(listener) => (Some(tell_listener), (listener as *mut Listener<'_>).cast()),
        }
    }

    fn resume_panic(listener: Option<Self>) {
        if let Some(payload) = listener.and_then(|listener| listener.panic) {
            panic::resume_unwind(payload);
        }
    }
}

unsafe extern "C" fn tell_listener(user: *mut c_void, fraction: f64, stage: *const c_char) -> i32 {
    const GO_ON: i32 = 0;
    const STOP: i32 = 1;
    // SAFETY: `user` points to the listener of the C call that is running. That call never tells from two threads at
    // once, and nobody else touches the listener meanwhile, so the reference is the only one.
    let listener = unsafe { &mut *user.cast::<Listener<'_>>() };
    if listener.panic.is_some() {
        return STOP;
    }
    // SAFETY: the stage is a constant text.
    let stage = unsafe { text::constant(stage) };
    match panic::catch_unwind(AssertUnwindSafe(|| (listener.tell)(fraction, stage))) {
        Ok(ControlFlow::Continue(())) => GO_ON,
        Ok(ControlFlow::Break(())) => STOP,
        Err(payload) => {
            listener.panic = Some(payload);
            STOP
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tell(raw: &sys::rw_commit_options, fraction: f64) -> i32 {
        let stage = b"building\0".as_ptr().cast();
        // SAFETY: both belong together, and the stage is a constant text.
        unsafe { raw.progress.unwrap()(raw.progress_user, fraction, stage) }
    }

    #[test]
    fn progress_is_told_and_can_stop() {
        let mut told = Vec::new();
        let options = CommitOptions::new().threads(3).progress(|fraction, stage| {
            told.push((fraction, stage.to_owned()));
            if fraction < 0.5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        options.with_raw(|raw| {
            assert_eq!(raw.threads, 3);
            assert_eq!(tell(raw, 0.25), 0);
            assert_ne!(tell(raw, 0.75), 0);
        });
        assert_eq!(told, [(0.25, "building".to_owned()), (0.75, "building".to_owned())]);
    }

    #[test]
    fn a_panic_in_progress_stops_and_goes_on_after_the_call() {
        let mut reached_the_end = false;
        let options = CommitOptions::new().progress(|_, _| panic!("in progress"));
        let payload = panic::catch_unwind(AssertUnwindSafe(|| {
            options.with_raw(|raw| {
                assert_ne!(tell(raw, 0.0), 0);
                assert_ne!(tell(raw, 0.1), 0);
                reached_the_end = true;
            });
        }))
        .unwrap_err();
        assert!(reached_the_end);
        assert_eq!(payload.downcast_ref(), Some(&"in progress"));
    }

    #[test]
    fn without_callbacks_c_gets_null() {
        CommitOptions::new().with_raw(|raw| {
            assert!(raw.progress.is_none() && raw.progress_user.is_null());
            assert!(raw.parallel_for.is_none() && raw.parallel_user.is_null());
        });
        let mut invalid = 0;
        QueryOptions::new().threads(2).with_raw(&mut invalid, |raw| {
            assert!(raw.parallel_for.is_none() && raw.progress.is_none() && raw.cancel.is_null());
            assert_eq!(raw.threads, 2);
        });
    }
}
