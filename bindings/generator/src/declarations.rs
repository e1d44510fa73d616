//! The header becomes Rust declarations, with bindgen.

use std::collections::BTreeMap;
use std::path::Path;

use bindgen::callbacks::{IntKind, ParseCallbacks};
use bindgen::{Formatter, MacroTypeVariation, RustEdition, RustTarget};

use crate::interface::{self, Constant};
use crate::Failure;

const FIRST_LINE: &str =
    "// Written by bindings/generate.py from raywise.h. Change the header and run that script; do not edit.";

/// What bindgen asks while it works.
#[derive(Debug)]
struct Answers {
    constants: BTreeMap<String, Constant>,
}

impl ParseCallbacks for Answers {
    /// Gives each constant the type that its expression has in C. Left alone, bindgen would go by the value.
    fn int_macro(&self, name: &str, _value: i64) -> Option<IntKind> {
        match self.constants.get(name)?.spelling.as_str() {
            "int32_t" => Some(IntKind::I32),
            "uint32_t" => Some(IntKind::U32),
            "int64_t" => Some(IntKind::I64),
            "uint64_t" => Some(IntKind::U64),
            _ => None,
        }
    }

    /// The header's comments are laid out for reading as they stand. A text block keeps rustdoc from joining their
    /// lines, taking `[0, n)` for a link and `<key>` for markup; a single line needs the latter only.
    fn process_comment(&self, comment: &str) -> Option<String> {
        let lines: Vec<&str> = comment.trim().lines().map(str::trim).collect();
        Some(match lines[..] {
            [line] => format!(" {}", line.replace('[', "\\[").replace('<', "\\<")),
            _ => format!("\n```text\n{}\n```\n", lines.join("\n")),
        })
    }
}

/// The text of `bindings.rs`. It depends on the header alone: language version, edition and layout are fixed, and the
/// printing is done here instead of by whatever rustfmt is installed.
pub fn generate(header: &Path) -> Result<String, Failure> {
    let constants = interface::read(header)?.constants;
    let path = header.to_str().ok_or("the header's path is not UTF-8")?;
    let target = RustTarget::stable(74, 0).map_err(|cause| cause.to_string())?;
    let _guard = interface::alone_with_libclang();
    let bindings = bindgen::Builder::default()
        .header(path)
        .clang_args(["-x", "c", "-std=c99", "-fparse-all-comments"])
        .allowlist_type("rw_.*")
        .allowlist_function("rw_.*")
        .allowlist_var("RW_.*")
        .rust_target(target)
        .rust_edition(RustEdition::Edition2021)
        .parse_callbacks(Box::new(Answers { constants }))
        .default_macro_constant_type(MacroTypeVariation::Signed)
        .derive_default(true)
        .merge_extern_blocks(true)
        .layout_tests(true)
        .generate_comments(true)
        .disable_header_comment()
        .raw_line(FIRST_LINE)
        .formatter(Formatter::Prettyplease)
        .generate()?;
    Ok(format!("{}\n", bindings.to_string().trim_end()))
}
