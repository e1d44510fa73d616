#!/usr/bin/env python3
"""Guards the binary interface: a program built with an earlier release has to run with the library of today.

    tools/abi.py check --library build/dev/capi/libraywise.so    compares with every earlier interface (capi_abi_test)
    tools/abi.py write --library build/dev/capi/libraywise.so    keeps today's interface as one more (make abi)

What earlier releases promised is in two places: capi/abi/raywise-MAJOR.MINOR.abi.xml, libabigail's account of functions and
types, and tests/capi/previous/raywise-VERSION/, the header, for the values of the constants.

Allowed are new functions, new constants, and new members behind the last one of a struct that begins with struct_size.
libabigail's own clause for that (has_data_member_inserted_at = end) also hides whatever else was changed in such a
struct. So what an old program cannot reach is cut off here, and abidiff judges the rest with no clause but that for new
functions."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BASELINES = ROOT / "capi" / "abi"
PREVIOUS = ROOT / "tests" / "capi" / "previous"
HEADERS = ROOT / "capi" / "include"
HEADER = Path("raywise") / "raywise.h"

# Tell what version it is, and count what may grow.
FREE_CONSTANTS = {"RW_VERSION_MAJOR", "RW_VERSION_MINOR", "RW_VERSION_PATCH", "RW_STATUS_COUNT"}


class Failure(Exception):
    """A tool could not do its work: neither accepted nor refused."""


def run(command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def interface_of(library, headers):
    """abidw's account of what the header shows of the library. Nothing in it depends on where it was built."""
    tree = ElementTree.ElementTree(ElementTree.fromstring(run([
        "abidw", "--headers-dir", headers, "--drop-private-types", "--no-comp-dir-path", "--no-corpus-path",
        "--exported-interfaces-only", "--no-show-locs", "--no-elf-needed", "--no-architecture", library])))
    for unit in tree.iter("abi-instr"):
        unit.set("path", os.path.basename(unit.get("path")))
    if tree.find(".//function-decl") is None:
        raise Failure(f"{library}: abidw found no function, was it built without debug information?")
    return tree


def growing_structs(tree):
    """Structs whose first member is struct_size, by name."""
    found = {}
    for struct in tree.iter("class-decl"):
        first = struct.find("data-member")
        if first is not None and first.find("var-decl").get("name") == "struct_size":
            found[struct.get("name")] = struct
    return found


def cut_to(baseline, today):
    """Takes off today's structs what lies behind the end of the baseline's."""
    before, after = growing_structs(baseline), growing_structs(today)
    for name in before.keys() & after.keys():
        struct, size = after[name], int(before[name].get("size-in-bits"))
        if int(struct.get("size-in-bits")) <= size:
            continue
        for member in struct.findall("data-member"):
            if int(member.get("layout-offset-in-bits")) >= size:
                struct.remove(member)
        struct.set("size-in-bits", str(size))


def compare_interfaces(baseline, library, headers, folder):
    today = interface_of(library, headers)
    cut_to(ElementTree.parse(baseline), today)
    today_file = Path(folder) / "today.abi.xml"
    today.write(today_file)
    # --harmless: what libabigail takes for harmless, such as two members of one type that change places, is not.
    result = subprocess.run(
        ["abidiff", "--no-default-suppression", "--suppressions", BASELINES / "suppressions.ini", "--harmless",
         "--no-architecture", baseline, today_file], capture_output=True, text=True, check=False)
    return result.returncode == 0, result.stdout + result.stderr


def constants_of(header, compiler):
    text = run([compiler, "-dM", "-E", "-x", "c", header])
    return dict(re.findall(r"^#define (RW_\w+) (.+)$", text, re.MULTILINE))


def compare_constants(previous, header, compiler):
    before, today = constants_of(previous, compiler), constants_of(header, compiler)
    changes = [f"  '{name}' was {value}, now {today.get(name, 'it is gone')}" for name, value in sorted(before.items())
               if name not in FREE_CONSTANTS and today.get(name) != value]
    return not changes, "Changed or removed constants:\n" + "\n".join(changes)


def check(options):
    baselines = sorted(options.baselines.glob("*.abi.xml"))
    headers = sorted(options.previous.glob(f"*/{HEADER}"))
    if not baselines or not headers:
        raise Failure(f"no earlier interface in {options.baselines} and {options.previous}")
    good = True
    with tempfile.TemporaryDirectory() as folder:
        comparisons = [(path.name, compare_interfaces(path, options.library, options.headers, folder))
                       for path in baselines]
    comparisons += [(f"header of {path.parent.parent.name}",
                     compare_constants(path, options.headers / HEADER, options.compiler)) for path in headers]
    for name, (same, report) in comparisons:
        print(f"{name}: {'compatible' if same else 'NOT COMPATIBLE'}")
        if not same:
            print(report)
            good = False
    return 0 if good else 1


def write(options):
    header = options.headers / HEADER
    constants = constants_of(header, options.compiler)
    major, minor, patch = (constants[f"RW_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH"))
    baseline = options.baselines / f"raywise-{major}.{minor}.abi.xml"
    kept = options.previous / f"raywise-{major}.{minor}.{patch}" / HEADER
    # What was promised stays promised: writing over it would only silence the guard.
    for path in (baseline, kept):
        if path.exists():
            raise Failure(f"{path} is there already; is RW_VERSION_ in the header that of the new release?")
    interface = interface_of(options.library, options.headers)
    ElementTree.indent(interface, " ")
    baseline.parent.mkdir(parents=True, exist_ok=True)
    interface.write(baseline)
    kept.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(header, kept)
    print(f"{baseline}\n{kept}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["check", "write"])
    parser.add_argument("--library", type=Path, required=True, help="libraywise.so with debug information")
    parser.add_argument("--headers", type=Path, default=HEADERS, help="the folder with raywise/raywise.h")
    parser.add_argument("--baselines", type=Path, default=BASELINES, help="the folder of the *.abi.xml")
    parser.add_argument("--previous", type=Path, default=PREVIOUS, help="the folder of the earlier headers")
    parser.add_argument("--compiler", default=os.environ.get("CC", "cc"), help="C compiler, for its preprocessor")
    options = parser.parse_args()
    try:
        return check(options) if options.command == "check" else write(options)
    except (Failure, OSError) as failure:
        print(f"abi.py: {failure}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
