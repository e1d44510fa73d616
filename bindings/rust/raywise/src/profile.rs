//! Calibration profiles: what building and asking each structure costs on this machine.

use std::path::Path;

use raywise_sys as sys;

use crate::handle::Handle;
use crate::library::{check, ensure_abi, size_of_struct};
use crate::{text, Error, Result, Status};

/// The constants that the library decides with (`rw_profile`). They change how long things take, never an answer. Cloning
/// shares the profile.
#[derive(Clone, Debug)]
pub struct Profile {
    handle: Handle<sys::rw_profile>,
}

/// A profile, and why it may not be the one that was asked for.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct LoadedProfile {
    /// What the library will work with.
    pub profile: Profile,
    /// Set when a file was passed over. What is used instead, `profile` tells: see [`Profile::info`].
    pub warning: Option<ProfileWarning>,
}

/// Why a calibration file was not used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ProfileWarning {
    /// One of the `PROFILE_` statuses.
    pub status: Status,
    /// What the library said about it.
    pub message: String,
}

/// Where a profile came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProfileSource {
    /// The generic constants that are compiled in.
    Generic,
    /// The path that was given.
    Path,
    /// The file named by the environment variable `RAYWISE_CALIBRATION`.
    Environment,
    /// The user's cache folder.
    User,
    /// The system's folder.
    System,
    /// A source that this crate does not know: the number in C.
    Other(i32),
}

impl ProfileSource {
    fn from_raw(raw: i32) -> Self {
        match raw {
            sys::RW_PROFILE_SOURCE_GENERIC => ProfileSource::Generic,
            sys::RW_PROFILE_SOURCE_PATH => ProfileSource::Path,
            sys::RW_PROFILE_SOURCE_ENV => ProfileSource::Environment,
            sys::RW_PROFILE_SOURCE_USER => ProfileSource::User,
            sys::RW_PROFILE_SOURCE_SYSTEM => ProfileSource::System,
            other => ProfileSource::Other(other),
        }
    }
}

/// Facts about a profile (`rw_profile_info`).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProfileInfo {
    /// Where it came from.
    pub source: ProfileSource,
    /// Why a file that comes before `source` was passed over, if one was.
    pub passed_over: Option<Status>,
    /// Calibration epoch of the constants.
    pub epoch: u32,
    /// The file in use; empty for the generic constants.
    pub path: String,
    /// Key of the machine it was measured on; `"generic"` for the generic constants.
    pub machine: String,
    /// When it was measured, ISO 8601.
    pub date: String,
    /// The program and version that measured it.
    pub tool: String,
    /// Relative spread of repeated timings; 0.05 is 5 %.
    pub spread: f64,
    /// Threads the machine offered when it was measured.
    pub threads: u32,
}

impl Profile {
    /// Reads the profile in a file, anew with each call. One that cannot be used is not an error: the profile is then that of
    /// the generic constants, and the warning says why. Wraps `rw_profile_load` with a path.
    ///
    /// # Errors
    /// [`Error::Text`] for a path that is not UTF-8; [`Status::OUT_OF_MEMORY`].
    pub fn load(path: impl AsRef<Path>) -> Result<LoadedProfile> {
        let path = text::path_to_c("path", path.as_ref())?;
        Self::load_from(Some(&path))
    }

    /// The first valid profile of: the file named by the environment variable `RAYWISE_CALIBRATION`, the user's
    /// cache folder, the system's folder; the generic constants if there is none. Looked up once in a process and kept:
    /// scenes without a profile of their own have the same one. Wraps `rw_profile_load` with NULL.
    ///
    /// # Errors
    /// [`Status::OUT_OF_MEMORY`].
    pub fn find() -> Result<LoadedProfile> {
        Self::load_from(None)
    }

    fn load_from(path: Option<&std::ffi::CStr>) -> Result<LoadedProfile> {
        ensure_abi()?;
        let path = path.map_or(std::ptr::null(), std::ffi::CStr::as_ptr);
        let mut raw = std::ptr::null_mut();
        // SAFETY: the path is NULL or a zero-terminated text, and both it and the place live through the call.
        let outcome = check(unsafe { sys::rw_profile_load(path, &mut raw) });
        let warning = match outcome {
            Ok(()) => None,
            Err(Error::Library { status, message }) if !raw.is_null() => Some(ProfileWarning { status, message }),
            Err(error) => return Err(error),
        };
        Ok(LoadedProfile { profile: Profile { handle: Handle::take(raw) }, warning })
    }

    /// Tells where the profile came from. Wraps `rw_profile_inspect`.
    pub fn info(&self) -> Result<ProfileInfo> {
        let mut raw = sys::rw_profile_info {
            struct_size: size_of_struct::<sys::rw_profile_info>(),
            ..sys::rw_profile_info::default()
        };
        // SAFETY: the profile lives, and `raw` says how large it is.
        check(unsafe { sys::rw_profile_inspect(self.as_ptr(), &mut raw) })?;
        // SAFETY: the texts belong to the profile, which lives; they are copied.
        let text = |text| unsafe { text::copied(text) };
        let status = Status::from_code(raw.status);
        Ok(ProfileInfo {
            source: ProfileSource::from_raw(raw.source),
            passed_over: (status != Status::OK).then_some(status),
            epoch: raw.epoch,
            path: text(raw.path),
            machine: text(raw.machine),
            date: text(raw.date),
            tool: text(raw.tool),
            spread: raw.spread,
            threads: raw.threads,
        })
    }

    /// Every constant with its unit, for people. Wraps `rw_profile_text`.
    pub fn text(&self) -> Result<String> {
        self.write(sys::RW_FORMAT_TEXT)
    }

    /// Every constant with its unit, as JSON. Wraps `rw_profile_text`.
    pub fn json(&self) -> Result<String> {
        self.write(sys::RW_FORMAT_JSON)
    }

    fn write(&self, format: i32) -> Result<String> {
        text::read(|buffer, capacity, needed| {
            // SAFETY: the profile lives; the buffer has room for `capacity` bytes.
            unsafe { sys::rw_profile_text(self.as_ptr(), format, buffer, capacity, needed) }
        })
    }

    pub(crate) fn as_ptr(&self) -> *const sys::rw_profile {
        self.handle.as_ptr()
    }
}
