//! Threads of the host program: its own parallel-for instead of the library's threads.

use std::any::Any;
use std::os::raw::c_void;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use raywise_sys as sys;

/// A parallel-for of the host program (`rw_parallel_for`): `run(count, task)` calls `task(i)` once for each i below
/// `count`, in any order and from any threads, and returns when all calls have returned.
///
/// With rayon:
///
/// ```
/// use rayon::prelude::*;
/// let run = |count: u64, task: &(dyn Fn(u64) + Sync)| (0..count).into_par_iter().for_each(task);
/// let options = raywise::QueryOptions::new().parallel_for(&run);
/// ```
///
/// An index that is asked for twice is worked on once, and one that is too large not at all; when one is left out, the
/// call fails with [`Status::HOST_PARALLEL`](crate::Status::HOST_PARALLEL). A panic is passed on to the caller once the
/// library has returned.
pub type ParallelFor<'a> = &'a (dyn Fn(u64, &(dyn Fn(u64) + Sync)) + Sync + 'a);

/// A parallel-for for the time of one C call.
pub(crate) struct Host<'a> {
    run: Option<ParallelFor<'a>>,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

impl<'a> Host<'a> {
    pub(crate) fn new(run: Option<ParallelFor<'a>>) -> Self {
        Host { run, panic: Mutex::new(None) }
    }

    /// The callback for C and its `user` pointer, good as long as `self` stays where it is.
    pub(crate) fn raw(&self) -> (sys::rw_parallel_for, *mut c_void) {
        match self.run {
            None => (None, std::ptr::null_mut()),
            Some(_) => (Some(run_host), (self as *const Host<'a>).cast_mut().cast()),
        }
    }

    /// Goes on with a panic of the host's code, if there was one.
    pub(crate) fn resume_panic(self) {
        if let Some(payload) = self.panic.into_inner().unwrap_or_else(PoisonError::into_inner) {
            panic::resume_unwind(payload);
        }
    }
}

/// The library's task with its data.
struct Task {
    call: unsafe extern "C" fn(*mut c_void, u64),
    data: *mut c_void,
}

// SAFETY: the C contract lets any thread run a task, also several indices at the same time.
unsafe impl Sync for Task {}

impl Task {
    /// # Safety
    /// The library's parallel-for call that handed out the task has not returned, and `index` is below its count and is
    /// run for the first time.
    unsafe fn run(&self, index: u64) {
        // SAFETY: the condition above is what the C contract asks for.
        unsafe { (self.call)(self.data, index) }
    }
}

unsafe extern "C" fn run_host(user: *mut c_void, count: u64, task: sys::rw_task, task_data: *mut c_void) {
    // SAFETY: `user` is the pointer that `Host::raw` gave beside this function, and the host outlives the C call.
    let host = unsafe { &*user.cast_const().cast::<Host<'_>>() };
    let (Some(run), Some(call)) = (host.run, task) else { return };
    let task = Task { call, data: task_data };
    let attempt = panic::catch_unwind(AssertUnwindSafe(|| {
        let started: Vec<AtomicBool> = (0..count).map(|_| AtomicBool::new(false)).collect();
        run(count, &|index| {
            let is_first = usize::try_from(index)
                .ok()
                .and_then(|index| started.get(index))
                .is_some_and(|started| !started.swap(true, Ordering::Relaxed));
            if is_first {
                // SAFETY: the closure cannot outlive this call of `run_host`; the index was just seen to be below the
                // count and not to have been run.
                unsafe { task.run(index) }
            }
        });
    }));
    if let Err(payload) = attempt {
        host.panic.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(payload);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU64;

    unsafe extern "C" fn count_up(data: *mut c_void, index: u64) {
        // SAFETY: the tests hand in an array of counters that is long enough.
        unsafe { &*data.cast::<AtomicU64>().add(index as usize) }.fetch_add(1, Ordering::Relaxed);
    }

    fn counts_after(run: ParallelFor) -> (Vec<u64>, Host) {
        let counters: Vec<AtomicU64> = (0..4).map(|_| AtomicU64::new(0)).collect();
        let host = Host::new(Some(run));
        let (callback, user) = host.raw();
        let data = counters.as_ptr().cast_mut().cast();
        // SAFETY: there are four counters, and both they and the host outlive the call.
        unsafe { callback.unwrap()(user, 4, Some(count_up), data) };
        (counters.into_iter().map(AtomicU64::into_inner).collect(), host)
    }

    #[test]
    fn each_index_is_run_once_whatever_the_host_does() {
        let twice_and_beyond = |count: u64, task: &(dyn Fn(u64) + Sync)| {
            for index in (0..count + 3).chain(0..count) {
                task(index);
            }
        };
        let (counts, host) = counts_after(&twice_and_beyond);
        assert_eq!(counts, [1; 4]);
        host.resume_panic();
    }

    #[test]
    fn indices_may_run_on_other_threads() {
        let threads = |count: u64, task: &(dyn Fn(u64) + Sync)| {
            std::thread::scope(|scope| {
                for index in 0..count {
                    scope.spawn(move || task(index));
                }
            });
        };
        assert_eq!(counts_after(&threads).0, [1; 4]);
    }

    #[test]
    fn a_panic_waits_until_it_is_resumed() {
        let panics = |_: u64, task: &(dyn Fn(u64) + Sync)| {
            task(2);
            panic!("in the host's loop");
        };
        let (counts, host) = counts_after(&panics);
        assert_eq!(counts, [0, 0, 1, 0]);
        let payload = panic::catch_unwind(AssertUnwindSafe(|| host.resume_panic())).unwrap_err();
        assert_eq!(payload.downcast_ref(), Some(&"in the host's loop"));
    }
}
