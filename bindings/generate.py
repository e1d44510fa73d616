#!/usr/bin/env python3
"""Turns raywise.h into the declarations of both bindings. Run it after every change of the header.

    bindings/generate.py                  write both
    bindings/generate.py --only rust      write one: rust or python
    bindings/generate.py --check          write nothing; show how the committed files differ, exit 1 if they do
    bindings/generate.py --circle         turn the Rust declarations back into a header and compare it with raywise.h
                                          type by type and function by function, exit 1 if something differs

--check and --circle can be given together. The Rust part needs cargo and libclang, and from Python the standard library
alone; the Python part needs the Python package libclang.

Environment: CARGO_TARGET_DIR, where the generator is built (build/cargo if unset).
"""

import argparse
import difflib
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADER = ROOT / "capi" / "include" / "raywise" / "raywise.h"
GENERATOR = ROOT / "bindings" / "generator" / "Cargo.toml"
OUTPUTS = {
    "rust": ROOT / "bindings" / "rust" / "raywise-sys" / "src" / "bindings.rs",
    "python": ROOT / "bindings" / "python" / "raywise" / "_declarations.py",
}


def run_generator(*arguments):
    """Builds the generator crate when needed and runs it; its exit code is the caller's to judge."""
    environment = dict(os.environ)
    environment.setdefault("CARGO_TARGET_DIR", str(ROOT / "build" / "cargo"))
    command = ["cargo", "run", "--quiet", "--locked", "--manifest-path", str(GENERATOR), "--"]
    command += [str(argument) for argument in arguments]
    return subprocess.run(command, env=environment, check=False).returncode


def rust_text():
    with tempfile.TemporaryDirectory(prefix="raywise-generate-") as folder:
        output = pathlib.Path(folder) / "bindings.rs"
        if run_generator("declarations", HEADER, output) != 0:
            raise SystemExit("generate.py: the Rust declarations could not be made (see above)")
        return output.read_text(encoding="utf-8")


def python_text():
    # The module lies beside this file; it is imported here so that the Rust part runs without libclang for Python.
    sys.path.insert(0, str(ROOT / "bindings"))
    from emit_python import emit

    return emit(HEADER)


MAKERS = {"rust": rust_text, "python": python_text}


def write(languages):
    for language in languages:
        text = MAKERS[language]()
        path = OUTPUTS[language]
        if path.is_file() and path.read_text(encoding="utf-8") == text:
            print(f"{path.relative_to(ROOT)}: as it was")
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        print(f"{path.relative_to(ROOT)}: written")


def check(languages):
    """Compares what is committed with what the header gives now. Returns whether all is the same."""
    same = True
    for language in languages:
        path = OUTPUTS[language]
        name = str(path.relative_to(ROOT))
        committed = path.read_text(encoding="utf-8") if path.is_file() else ""
        difference = list(
            difflib.unified_diff(
                committed.splitlines(keepends=True),
                MAKERS[language]().splitlines(keepends=True),
                fromfile=f"{name} (committed)",
                tofile=f"{name} (from the header)",
            )
        )
        if difference:
            same = False
            sys.stdout.writelines(difference)
            print(f"{name}: differs from the header; run bindings/generate.py")
        else:
            print(f"{name}: same as from the header")
    return same


def circle():
    """Header, Rust, header: returns whether both headers say the same."""
    with tempfile.TemporaryDirectory(prefix="raywise-circle-") as folder:
        return run_generator("circle", HEADER, OUTPUTS["rust"], pathlib.Path(folder) / "returned.h") == 0


def main():
    sys.stdout.reconfigure(line_buffering=True)  # the generator writes to the same place
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    parser.add_argument("--circle", action="store_true", help="compare the header with the one made from the Rust view")
    parser.add_argument("--only", choices=sorted(OUTPUTS), help="one language instead of both")
    arguments = parser.parse_args()
    if arguments.circle and arguments.only == "python":
        parser.error("the circle goes through Rust")

    languages = [arguments.only] if arguments.only else list(OUTPUTS)
    good = True
    if arguments.check:
        good = check(languages) and good
    if arguments.circle:
        good = circle() and good
    if not arguments.check and not arguments.circle:
        write(languages)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
