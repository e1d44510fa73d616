//! The Rust view of the ABI in a form that cbindgen reads.
//!
//! cbindgen describes what a Rust crate *defines*. `raywise-sys` only declares, so each foreign function becomes a
//! definition with an empty body here, each handle a struct without a layout, and everything that has no counterpart in
//! a C header (tests, trait impls) is left out. No type is touched.

use std::collections::BTreeSet;

use syn::{parse_quote, Fields, ForeignItem, ForeignItemFn, Ident, Item, ItemConst, ItemFn, ItemStruct, Safety};

use crate::Failure;

/// A Rust file for cbindgen, and the names it has to write even when no function mentions them.
#[derive(Debug)]
pub struct RustView {
    pub text: String,
    pub type_names: BTreeSet<String>,
}

/// Rewrites the text of `bindings.rs`.
pub fn definitions(declarations: &str) -> Result<RustView, Failure> {
    let file = syn::parse_file(declarations)?;
    let mut items = Vec::new();
    let mut type_names = BTreeSet::new();
    for item in file.items {
        match item {
            Item::Struct(item) => {
                type_names.insert(item.ident.to_string());
                items.push(Item::Struct(plain_struct(item)));
            }
            Item::Type(mut item) => {
                type_names.insert(item.ident.to_string());
                item.attrs.clear();
                items.push(Item::Type(item));
            }
            Item::Const(item) => items.push(Item::Const(typed_constant(item))),
            Item::ForeignMod(block) => {
                for foreign in block.items {
                    match foreign {
                        ForeignItem::Fn(function) => items.push(Item::Fn(definition(function))),
                        _ => return Err("an extern block may hold functions only".into()),
                    }
                }
            }
            Item::Fn(_) | Item::Impl(_) => {}
            _ => return Err("the declarations hold an item that C has no counterpart for".into()),
        }
    }
    let file = syn::File { shebang: None, attrs: Vec::new(), items, ..file };
    Ok(RustView { text: prettyplease::unparse(&file), type_names })
}

/// Keeps `#[repr]`; a handle (bindgen: one private member of no size) becomes a struct that C cannot look into.
fn plain_struct(mut item: ItemStruct) -> ItemStruct {
    let is_handle = matches!(&item.fields, Fields::Named(fields)
        if fields.named.len() == 1 && fields.named[0].ident.as_ref().is_some_and(|name| name == "_unused"));
    if is_handle {
        let name = item.ident;
        return parse_quote!(
            pub struct #name;
        );
    }
    item.attrs.retain(|attribute| attribute.path().is_ident("repr"));
    for field in &mut item.fields {
        field.attrs.clear();
        if let Some(name) = &mut field.ident {
            *name = name_in_c(name);
        }
    }
    item
}

/// bindgen writes a member called `type` as `type_`, because the word belongs to Rust.
fn name_in_c(name: &Ident) -> Ident {
    let text = name.to_string();
    match text.strip_suffix('_') {
        Some(stem) if syn::parse_str::<Ident>(stem).is_err() => Ident::new_raw(stem, name.span()),
        _ => name.clone(),
    }
}

/// A cast makes cbindgen write the type into the macro: `((uint32_t)1)`.
fn typed_constant(item: ItemConst) -> ItemConst {
    let ItemConst { ident, ty, expr, .. } = item;
    parse_quote!(
        pub const #ident: #ty = #expr as #ty;
    )
}

fn definition(function: ForeignItemFn) -> ItemFn {
    let mut signature = function.sig;
    signature.safety = Safety::Unsafe(parse_quote!(unsafe));
    signature.abi = Some(parse_quote!(extern "C"));
    for argument in &mut signature.inputs {
        if let syn::FnArg::Typed(argument) = argument {
            if let syn::Pat::Ident(pattern) = &mut *argument.pat {
                pattern.ident = name_in_c(&pattern.ident);
            }
        }
    }
    parse_quote!(
        #[no_mangle]
        pub #signature {
            loop {}
        }
    )
}
