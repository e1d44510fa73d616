//! What a C header promises, read with libclang: structs, opaque handles, callback types, functions and constants whose
//! names begin with `rw_` or `RW_`.
//!
//! Types are spelled in one way however the header spells them (`long`, `long long` and `int64_t` are all `int64_t`
//! where they are 64 bits wide), so that two headers can be compared.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use clang::{
    Clang, Entity, EntityKind, EntityVisitResult, EvaluationResult, Index, TranslationUnit, Type, TypeKind, Unsaved,
};

use crate::Failure;

/// One member of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    pub name: String,
    pub spelling: String,
    pub offset_bits: usize,
}

/// A struct with its layout on this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Struct {
    pub size: usize,
    pub alignment: usize,
    pub members: Vec<Member>,
}

/// A function: its arguments in order, and what it returns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    pub arguments: Vec<(String, String)>,
    pub result: String,
}

/// A constant: the type and value of the expression behind a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constant {
    pub spelling: String,
    pub value: String,
}

/// Everything a header declares, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Interface {
    pub structs: BTreeMap<String, Struct>,
    /// Structs that are declared and never defined.
    pub handles: BTreeMap<String, ()>,
    /// Function pointer types, spelled out.
    pub callbacks: BTreeMap<String, String>,
    pub functions: BTreeMap<String, Function>,
    pub constants: BTreeMap<String, Constant>,
}

/// libclang allows one user per process at a time; bindgen is another one.
pub(crate) fn alone_with_libclang() -> MutexGuard<'static, ()> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Reads a header.
pub fn read(header: &Path) -> Result<Interface, Failure> {
    let header = header.canonicalize().map_err(|cause| format!("{}: {cause}", header.display()))?;
    let _guard = alone_with_libclang();
    let clang = Clang::new()?;
    let index = Index::new(&clang, false, false);

    let unit = parse(&index, &header, None)?;
    let mut interface = Interface::default();
    let mut macros = Vec::new();
    for entity in unit.get_entity().get_children() {
        let Some(name) = entity.get_name() else { continue };
        if !name.starts_with("rw_") && !name.starts_with("RW_") {
            continue;
        }
        match entity.get_kind() {
            EntityKind::StructDecl => add_struct(&mut interface, name, entity)?,
            EntityKind::TypedefDecl => add_typedef(&mut interface, name, entity)?,
            EntityKind::FunctionDecl => {
                let function = read_function(entity)?;
                interface.functions.insert(name, function);
            }
            EntityKind::MacroDefinition => {
                if has_value(entity) {
                    macros.push(name);
                }
            }
            EntityKind::MacroExpansion => {}
            kind => return Err(format!("{name}: {kind:?} is not something the ABI may hold").into()),
        }
    }
    for name in interface.structs.keys() {
        interface.handles.remove(name);
    }
    interface.constants = read_constants(&index, &header, &macros)?;
    Ok(interface)
}

/// Parses the header, or `text` in a file beside it which includes the header.
fn parse<'i>(index: &'i Index<'i>, header: &Path, text: Option<&str>) -> Result<TranslationUnit<'i>, Failure> {
    let arguments = ["-x", "c", "-std=gnu99", "-Wno-everything"];
    let main_file: PathBuf = match text {
        None => header.to_path_buf(),
        Some(_) => header.with_file_name("raywise_constants_probe.c"),
    };
    let mut parser = index.parser(main_file.clone());
    parser.arguments(&arguments).detailed_preprocessing_record(true);
    if let Some(text) = text {
        parser.unsaved(&[Unsaved::new(&main_file, text)]);
    }
    let unit = parser.parse()?;
    let errors: Vec<String> = unit
        .get_diagnostics()
        .iter()
        .filter(|diagnostic| diagnostic.get_severity() >= clang::diagnostic::Severity::Error)
        .map(|diagnostic| diagnostic.formatter().format())
        .collect();
    if errors.is_empty() {
        Ok(unit)
    } else {
        Err(format!("{}:\n{}", header.display(), errors.join("\n")).into())
    }
}

fn add_struct(interface: &mut Interface, name: String, entity: Entity) -> Result<(), Failure> {
    if !entity.is_definition() {
        interface.handles.insert(name, ());
        return Ok(());
    }
    let layout = entity.get_type().ok_or("a struct without a type")?;
    let mut members = Vec::new();
    for field in entity.get_children() {
        if field.is_attribute() {
            continue; // packing and alignment show in the layout
        }
        if field.get_kind() != EntityKind::FieldDecl {
            return Err(format!("{name}: {:?} is not something a struct of the ABI may hold", field.get_kind()).into());
        }
        let field_name = field.get_name().ok_or_else(|| format!("{name}: a member without a name"))?;
        if field.is_bit_field() {
            return Err(format!("{name}.{field_name}: bit fields have no portable layout").into());
        }
        members.push(Member {
            spelling: spell(field.get_type().ok_or("a member without a type")?)?,
            offset_bits: field.get_offset_of_field().map_err(|cause| format!("{name}.{field_name}: {cause}"))?,
            name: field_name,
        });
    }
    let size = layout.get_sizeof().map_err(|cause| format!("{name}: {cause}"))?;
    let alignment = layout.get_alignof().map_err(|cause| format!("{name}: {cause}"))?;
    interface.structs.insert(name, Struct { size, alignment, members });
    Ok(())
}

fn add_typedef(interface: &mut Interface, name: String, entity: Entity) -> Result<(), Failure> {
    let target = entity.get_typedef_underlying_type().ok_or_else(|| format!("{name}: a typedef of nothing"))?;
    match target.get_canonical_type().get_kind() {
        // `typedef struct rw_x { ... } rw_x;` and `typedef struct rw_x rw_x;` say nothing beyond the struct.
        TypeKind::Record if spell(target)? == name => Ok(()),
        TypeKind::Pointer => {
            interface.callbacks.insert(name, spell(target)?);
            Ok(())
        }
        _ => Err(format!("{name}: a typedef of {} is not expected in the ABI", spell(target)?).into()),
    }
}

fn read_function(entity: Entity) -> Result<Function, Failure> {
    let name = entity.get_name().unwrap_or_default();
    let mut arguments = Vec::new();
    for argument in entity.get_arguments().unwrap_or_default() {
        let spelling = spell(argument.get_type().ok_or("an argument without a type")?)?;
        arguments.push((argument.get_name().unwrap_or_default(), spelling));
    }
    if entity.is_variadic() {
        return Err(format!("{name}: variadic functions have no place in the ABI").into());
    }
    let result = spell(entity.get_result_type().ok_or_else(|| format!("{name}: no result type"))?)?;
    Ok(Function { arguments, result })
}

/// A macro that stands for a value: it takes no arguments and is not empty.
fn has_value(entity: Entity) -> bool {
    let tokens = entity.get_range().map(|range| range.tokenize()).unwrap_or_default();
    !entity.is_function_like_macro() && tokens.len() > 1
}

/// Lets the compiler work out type and value of each macro.
fn read_constants<'i>(
    index: &'i Index<'i>,
    header: &Path,
    macros: &[String],
) -> Result<BTreeMap<String, Constant>, Failure> {
    const PREFIX: &str = "value_of_";
    let file_name = header.file_name().and_then(|name| name.to_str()).ok_or("a header without a name")?;
    let mut text = format!("#include \"{file_name}\"\n");
    for name in macros {
        text.push_str(&format!("static const __typeof__({name}) {PREFIX}{name} = {name};\n"));
    }
    let unit = parse(index, header, Some(&text))?;
    let mut constants = BTreeMap::new();
    let mut failure = None;
    unit.get_entity().visit_children(|entity, _| {
        let full_name = entity.get_name().unwrap_or_default();
        if let (EntityKind::VarDecl, Some(name)) = (entity.get_kind(), full_name.strip_prefix(PREFIX)) {
            match read_constant(entity) {
                Ok(constant) => {
                    constants.insert(name.to_string(), constant);
                }
                Err(cause) => failure = Some(format!("{name}: {cause}")),
            }
        }
        EntityVisitResult::Continue
    });
    match failure {
        Some(failure) => Err(failure.into()),
        None => Ok(constants),
    }
}

fn read_constant(entity: Entity) -> Result<Constant, Failure> {
    let value = match entity.evaluate() {
        Some(EvaluationResult::SignedInteger(value)) => value.to_string(),
        Some(EvaluationResult::UnsignedInteger(value)) => value.to_string(),
        Some(EvaluationResult::Float(value)) => format!("{value:?}"),
        other => return Err(format!("{other:?} is not a number").into()),
    };
    let spelling = spell(entity.get_type().ok_or("a constant without a type")?)?;
    let spelling = spelling.strip_prefix("const ").unwrap_or(&spelling).to_string();
    Ok(Constant { spelling, value })
}

/// Spells a type in the one way used for comparing.
fn spell(any: Type) -> Result<String, Failure> {
    let canonical = any.get_canonical_type();
    let qualifier = if canonical.is_const_qualified() { "const " } else { "" };
    if let Some(pointee) = canonical.get_pointee_type() {
        if pointee.get_canonical_type().get_result_type().is_some() {
            return Ok(format!("{qualifier}{}", spell_function(pointee.get_canonical_type())?));
        }
        let behind = if canonical.is_const_qualified() { " const" } else { "" };
        return Ok(format!("{} *{behind}", spell(pointee)?));
    }
    if let (Some(element), Some(length)) = (canonical.get_element_type(), canonical.get_size()) {
        return Ok(format!("{}[{length}]", spell(element)?));
    }
    Ok(format!("{qualifier}{}", spell_plain(canonical)?))
}

fn spell_function(prototype: Type) -> Result<String, Failure> {
    let result = spell(prototype.get_result_type().ok_or("a function pointer without a result")?)?;
    let mut arguments = Vec::new();
    for argument in prototype.get_argument_types().unwrap_or_default() {
        arguments.push(spell(argument)?);
    }
    Ok(format!("{result} (*)({})", arguments.join(", ")))
}

fn spell_plain(canonical: Type) -> Result<String, Failure> {
    let bits = || canonical.get_sizeof().map(|bytes| bytes * 8);
    Ok(match canonical.get_kind() {
        TypeKind::Void => "void".into(),
        TypeKind::Float => "float".into(),
        TypeKind::Double => "double".into(),
        TypeKind::CharS | TypeKind::CharU => "char".into(),
        TypeKind::SChar | TypeKind::Short | TypeKind::Int | TypeKind::Long | TypeKind::LongLong => {
            format!("int{}_t", bits().map_err(|cause| cause.to_string())?)
        }
        TypeKind::UChar | TypeKind::UShort | TypeKind::UInt | TypeKind::ULong | TypeKind::ULongLong => {
            format!("uint{}_t", bits().map_err(|cause| cause.to_string())?)
        }
        TypeKind::Record => {
            let name = canonical.get_declaration().and_then(|declaration| declaration.get_name());
            name.ok_or("a struct without a name")?
        }
        kind => return Err(format!("{kind:?} ({}) has no place in the ABI", canonical.get_display_name()).into()),
    })
}
