#!/usr/bin/env python3
"""The version is the same wherever it is written, and nothing is said to be there since a later one."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
HEADER = "capi/include/raywise/raywise.h"
NUMBER = r"(\d+\.\d+\.\d+)"

# Where a whole version stands, as a regular expression whose groups, joined by points, are it.
PLACES = [
    (HEADER, r"^#define RW_VERSION_MAJOR (\d+)\n#define RW_VERSION_MINOR (\d+)\n#define RW_VERSION_PATCH (\d+)$"),
    ("bindings/python/raywise/_declarations.py",
     r"^RW_VERSION_MAJOR = (\d+)\nRW_VERSION_MINOR = (\d+)\nRW_VERSION_PATCH = (\d+)$"),
    ("bindings/rust/Cargo.toml", r'^version = "%s"$' % NUMBER),
    ("bindings/rust/raywise/Cargo.toml", r'^raywise-sys = \{ version = "=%s"' % NUMBER),
    ("bindings/rust/raywise-sys/build.rs", r'^const LEAST_VERSION: &str = "%s";$' % NUMBER),
    ("CHANGELOG.md", r"\A.*?^## %s" % NUMBER),
] + [(lock, r'^name = "%s"\nversion = "%s"$' % (package, NUMBER))
     for lock in ("bindings/rust/Cargo.lock", "examples/rust/Cargo.lock", "tests/bench/rust/Cargo.lock")
     for package in ("raywise", "raywise-sys")]

# Where a program asks for a minor version.
REQUESTS = [
    ("examples/CMakeLists.txt", r"^find_package\(raywise (\d+\.\d+) "),
    ("examples/rust/Cargo.toml", r'^raywise = \{ version = "(\d+\.\d+)"'),
    ("examples/rust/Cargo.toml", r'would write: raywise = "(\d+\.\d+)"'),
    ("tests/bench/rust/Cargo.toml", r'^raywise = \{ version = "(\d+\.\d+)"'),
]


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


def found(path, pattern):
    return [match if isinstance(match, str) else ".".join(match)
            for match in re.findall(pattern, text_of(path), flags=re.MULTILINE | re.DOTALL)]


def main():
    version = text_of("VERSION").strip()
    minor = version.rsplit(".", 1)[0]
    wrong = []
    for places, wanted in ((PLACES, version), (REQUESTS, minor)):
        for path, pattern in places:
            if found(path, pattern) != [wanted]:
                wrong.append(f"{path}: {pattern} finds {found(path, pattern)}, not {wanted}")

    # The header says at the top since when all is there, and where a function or a member is younger.
    since = found(HEADER, r"[Ss]ince:? (\d+\.\d+)")
    if not found(HEADER, r"\* - Since\. All is there since (\d+\.\d+),"):
        wrong.append(f"{HEADER}: it does not say since when all is there")
    later = sorted({each for each in since if tuple(map(int, each.split("."))) > tuple(map(int, minor.split(".")))})
    if later:
        wrong.append(f"{HEADER}: since {', '.join(later)}, and this is {version}")

    for line in wrong:
        print(line)
    print(f"version {version}: {len(PLACES) + len(REQUESTS)} places, {len(since)} times since, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
