//! The circle: header, Rust declarations, header again; and both headers compared item by item.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::Path;

use crate::interface::{self, Constant, Function, Interface, Struct};
use crate::{rust_view, Failure};

/// One thing that is not the same in the header and in the Rust view of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The header has it, the Rust view does not.
    Missing { what: &'static str, name: String },
    /// The Rust view has it, the header does not.
    Unknown { what: &'static str, name: String },
    /// Both have it, in another form. `part` says which part, e.g. a member or an argument.
    Changed { name: String, part: String, header: String, rust: String },
}

impl fmt::Display for Difference {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Difference::Missing { what, name } => write!(out, "{what} {name}: in the header, not in the Rust view"),
            Difference::Unknown { what, name } => write!(out, "{what} {name}: in the Rust view, not in the header"),
            Difference::Changed { name, part, header, rust } => {
                write!(out, "{name}, {part}: `{header}` in the header, `{rust}` in the Rust view")
            }
        }
    }
}

/// What was compared, and what differs.
#[derive(Clone, Debug)]
pub struct Report {
    pub structs: usize,
    pub handles: usize,
    pub callbacks: usize,
    pub functions: usize,
    pub constants: usize,
    pub differences: Vec<Difference>,
}

/// Turns `declarations` (the text of `bindings.rs`) into a header, writes it to `returned`, and compares the two headers.
pub fn compare(header: &Path, declarations: &str, returned: &Path) -> Result<Report, Failure> {
    write_header(declarations, returned)?;
    let original = interface::read(header)?;
    let returned = interface::read(returned)?;
    Ok(Report {
        structs: original.structs.len(),
        handles: original.handles.len(),
        callbacks: original.callbacks.len(),
        functions: original.functions.len(),
        constants: original.constants.len(),
        differences: differences(&original, &returned),
    })
}

/// Lets cbindgen write the header of the Rust declarations.
pub fn write_header(declarations: &str, output: &Path) -> Result<(), Failure> {
    let view = rust_view::definitions(declarations)?;
    let source = output.with_extension("rs");
    std::fs::write(&source, &view.text)?;

    let mut config = cbindgen::Config {
        language: cbindgen::Language::C,
        style: cbindgen::Style::Both,
        include_guard: Some("RAYWISE_RETURNED_H".into()),
        no_includes: true,
        sys_includes: vec!["stdint.h".into()],
        ..cbindgen::Config::default()
    };
    config.layout.packed = Some("__attribute__((packed))".into());
    config.export.include = view.type_names.into_iter().collect();
    let bindings = cbindgen::Builder::new().with_config(config).with_src(&source).generate()?;
    bindings.write(std::fs::File::create(output)?);
    Ok(())
}

/// Names every difference, in the order structs, handles, callbacks, functions, constants.
pub fn differences(header: &Interface, rust: &Interface) -> Vec<Difference> {
    let mut found = Vec::new();
    pair(&mut found, "struct", &header.structs, &rust.structs, compare_members);
    if found.is_empty() {
        pair(&mut found, "struct", &header.structs, &rust.structs, compare_layouts);
    }
    pair(&mut found, "handle", &header.handles, &rust.handles, |_, _, _, _| {});
    pair(&mut found, "callback", &header.callbacks, &rust.callbacks, |found, name, header, rust| {
        note(found, name, "type", header, rust);
    });
    pair(&mut found, "function", &header.functions, &rust.functions, compare_functions);
    pair(&mut found, "constant", &header.constants, &rust.constants, compare_constants);
    found
}

fn pair<T>(
    found: &mut Vec<Difference>,
    what: &'static str,
    header: &BTreeMap<String, T>,
    rust: &BTreeMap<String, T>,
    compare: impl Fn(&mut Vec<Difference>, &str, &T, &T),
) {
    let names: BTreeSet<&String> = header.keys().chain(rust.keys()).collect();
    for name in names {
        match (header.get(name), rust.get(name)) {
            (Some(header), Some(rust)) => compare(found, name, header, rust),
            (Some(_), None) => found.push(Difference::Missing { what, name: name.clone() }),
            (None, _) => found.push(Difference::Unknown { what, name: name.clone() }),
        }
    }
}

fn note(found: &mut Vec<Difference>, name: &str, part: &str, header: impl ToString, rust: impl ToString) {
    let (header, rust) = (header.to_string(), rust.to_string());
    if header != rust {
        found.push(Difference::Changed { name: name.to_string(), part: part.to_string(), header, rust });
    }
}

fn compare_members(found: &mut Vec<Difference>, name: &str, header: &Struct, rust: &Struct) {
    let before = found.len();
    let names =
        |members: &Struct| -> Vec<String> { members.members.iter().map(|member| member.name.clone()).collect() };
    note(found, name, "members", names(header).join(", "), names(rust).join(", "));
    if found.len() > before {
        return;
    }
    for (header, rust) in header.members.iter().zip(&rust.members) {
        let part = format!("type of member {}", header.name);
        note(found, name, &part, &header.spelling, &rust.spelling);
    }
}

/// The same members with the same types lie elsewhere only when packing or alignment was asked for.
fn compare_layouts(found: &mut Vec<Difference>, name: &str, header: &Struct, rust: &Struct) {
    for (header, rust) in header.members.iter().zip(&rust.members) {
        let part = format!("offset in bits of member {}", header.name);
        note(found, name, &part, header.offset_bits, rust.offset_bits);
    }
    note(found, name, "size", header.size, rust.size);
    note(found, name, "alignment", header.alignment, rust.alignment);
}

fn compare_functions(found: &mut Vec<Difference>, name: &str, header: &Function, rust: &Function) {
    let names =
        |function: &Function| -> Vec<String> { function.arguments.iter().map(|(name, _)| name.clone()).collect() };
    let before = found.len();
    note(found, name, "arguments", names(header).join(", "), names(rust).join(", "));
    if found.len() == before {
        for ((argument, header), (_, rust)) in header.arguments.iter().zip(&rust.arguments) {
            note(found, name, &format!("type of argument {argument}"), header, rust);
        }
    }
    note(found, name, "result", &header.result, &rust.result);
}

fn compare_constants(found: &mut Vec<Difference>, name: &str, header: &Constant, rust: &Constant) {
    note(found, name, "value", &header.value, &rust.value);
    note(found, name, "type", &header.spelling, &rust.spelling);
}
