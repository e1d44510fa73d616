//! Finds libraywise: the folder named by `RAYWISE_LIB_DIR`, or else what pkg-config says.
//!
//! Hands on to crates that depend on this one: `DEP_RAYWISE_LIB_DIR` (folders with the library, separated as in PATH)
//! and `DEP_RAYWISE_INCLUDE` (folders with the header, likewise).

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The library this crate's declarations were made for; pkg-config refuses older ones.
const LEAST_VERSION: &str = "0.2.0";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=RAYWISE_LIB_DIR");
    println!("cargo:rerun-if-env-changed=DOCS_RS");

    // Documentation is built on machines without the library, and nothing is linked there.
    if env::var_os("DOCS_RS").is_some() {
        return;
    }
    match env::var_os("RAYWISE_LIB_DIR").filter(|folder| !folder.is_empty()) {
        Some(folder) => use_folder(Path::new(&folder)),
        None => use_pkg_config(),
    }
}

fn use_folder(folder: &Path) {
    let folder = match folder.canonicalize() {
        Ok(folder) if folder.is_dir() => folder,
        _ => fail(&format!("RAYWISE_LIB_DIR={}: there is no such folder", folder.display())),
    };
    if !holds_library(&folder) {
        fail(&format!("RAYWISE_LIB_DIR={}: there is no libraywise in that folder", folder.display()));
    }
    println!("cargo:rustc-link-search=native={}", folder.display());
    println!("cargo:rustc-link-lib=dylib=raywise");
    let include: Vec<PathBuf> = folder.parent().map(|prefix| prefix.join("include")).into_iter().collect();
    hand_on(&[folder], &include);
}

/// `libraywise.so` on Linux, `libraywise.dylib` on macOS, `raywise.lib` on Windows.
fn holds_library(folder: &Path) -> bool {
    let names = ["libraywise.so", "libraywise.dylib", "raywise.lib", "libraywise.dll.a"];
    names.iter().any(|name| folder.join(name).exists())
}

fn use_pkg_config() {
    // Prints the link lines itself, and asks to run again when PKG_CONFIG_PATH and its like change.
    let found = pkg_config::Config::new().atleast_version(LEAST_VERSION).probe("raywise");
    match found {
        Ok(library) => hand_on(&library.link_paths, &library.include_paths),
        Err(cause) => fail(&format!(
            "libraywise was not found. Name the folder that holds it in RAYWISE_LIB_DIR, or the folder that holds \
             raywise.pc in PKG_CONFIG_PATH.\n\n{cause}"
        )),
    }
}

fn hand_on(library: &[PathBuf], include: &[PathBuf]) {
    let joined = |folders: &[PathBuf]| {
        env::join_paths(folders.iter().map(|folder| folder.as_os_str() as &OsStr)).unwrap_or_default()
    };
    println!("cargo:lib_dir={}", joined(library).to_string_lossy());
    println!("cargo:include={}", joined(include).to_string_lossy());
}

fn fail(text: &str) -> ! {
    eprintln!("raywise-sys: {text}");
    std::process::exit(1);
}
