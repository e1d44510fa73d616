//! Lets this crate's own tests and examples find the library they were linked with. Nothing of this reaches a program
//! that merely depends on the crate.

use std::env;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let is_unix = env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family.split(',').any(|name| name == "unix"));
    if !is_unix {
        return;
    }
    for folder in env::split_paths(&env::var_os("DEP_RAYWISE_LIB_DIR").unwrap_or_default()) {
        println!("cargo:rustc-link-arg=-Wl,-rpath,{}", folder.display());
    }
}
