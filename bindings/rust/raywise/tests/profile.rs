//! Calibration profiles: given, found, and passed over.

mod common;

use std::path::Path;

use common::Result;
use raywise::{Error, Profile, ProfileSource, Status};

#[test]
fn there_is_always_a_profile() -> Result {
    let found = Profile::find()?;
    let info = found.profile.info()?;
    assert!(!info.machine.is_empty());
    assert!(info.spread >= 0.0);

    let text = found.profile.text()?;
    assert!(text.lines().count() > 3, "{text}");
    let json: serde_json::Value = serde_json::from_str(&found.profile.json()?)?;
    assert!(json.is_object());
    Ok(())
}

#[test]
fn a_file_that_is_not_there_is_a_warning() -> Result {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("there_is_no_such_profile.json");
    let loaded = Profile::load(&path)?;
    let warning = loaded.warning.expect("there is no such file");
    assert_eq!(warning.status, Status::PROFILE_NOT_FOUND);
    assert!(!warning.message.is_empty());
    let info = loaded.profile.info()?;
    assert_ne!(info.source, ProfileSource::Path);
    assert_eq!(info.passed_over, Some(Status::PROFILE_NOT_FOUND));
    Ok(())
}

#[test]
fn a_file_that_is_not_a_profile_is_a_warning() -> Result {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let profile = folder.join("profile_nonsense.json");
    for content in ["", "{", "[1, 2, 3]", "{\"a\": 1}", "\0\0\0"] {
        std::fs::write(&profile, content)?;
        let loaded = Profile::load(&profile)?;
        let status = loaded.warning.expect(content).status;
        assert!(matches!(status, Status::PROFILE_MALFORMED | Status::PROFILE_SCHEMA), "{content:?}: {status}");
        assert!(loaded.profile.info()?.passed_over.is_some());
    }
    let loaded = Profile::load(folder)?;
    assert_eq!(loaded.warning.map(|warning| warning.status), Some(Status::PROFILE_UNREADABLE));
    Ok(())
}

/// The words for a file that was passed over are true whatever is used instead.
#[test]
fn no_status_says_what_is_used_instead() {
    for code in 0..raywise_sys::RW_STATUS_COUNT {
        let status = Status::from_code(code);
        let about_profiles = status.name().is_some_and(|name| name.starts_with("RW_PROFILE_"));
        assert_eq!(status.text().starts_with("a calibration profile was passed over: "), about_profiles, "{status}");
        assert!(!status.text().contains("generic"), "{status}");
    }
}

/// What was found is kept for the process.
#[test]
fn the_same_profile_is_found_again() -> Result {
    let first = Profile::find()?;
    let again = Profile::find()?;
    assert_eq!(first.profile.info()?, again.profile.info()?);
    assert_eq!(first.warning, again.warning);
    Ok(())
}

/// A generic profile is what the library prints of itself, so a copy of it is taken or refused for a stated reason, and
/// whichever it is, answers come from the profile that is then in force.
#[test]
fn a_written_profile_is_read_or_refused_with_a_reason() -> Result {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("profile_copy.json");
    let missing = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no_profile_here.json");
    let original = Profile::load(missing)?.profile;
    std::fs::write(&path, original.json()?)?;
    let copy = Profile::load(&path)?;
    let info = copy.profile.info()?;
    match copy.warning {
        None => {
            assert_eq!(info.source, ProfileSource::Path);
            assert_eq!(Path::new(&info.path), path);
        }
        Some(warning) => assert!(warning.status.name().is_some_and(|name| name.starts_with("RW_PROFILE_"))),
    }
    Ok(())
}

#[test]
fn a_path_with_a_zero_is_refused() {
    assert!(matches!(Profile::load("a\0b"), Err(Error::Text { what: "path", .. })));
}
