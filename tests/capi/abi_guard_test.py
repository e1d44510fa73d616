#!/usr/bin/env python3
"""The guard of the binary interface (tools/abi.py) refuses what it has to refuse, and accepts what is allowed.

Makes libraries of empty functions from the header of raywise 0.2.0, each doctored in one way, and shows them to the
guard with the undoctored one as the earlier release."""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
ABI = ROOT / "tools" / "abi.py"
HEADER = Path("raywise") / "raywise.h"
RELEASED = ROOT / "tests" / "capi" / "previous" / "raywise-0.2.0" / HEADER
ACCEPTED, REFUSED = 0, 1

MEMORY_LIMIT = r"RW_API int32_t rw_scene_set_memory_limit\(rw_scene \*scene, uint64_t bytes\);"
LIMIT_ARGUMENT = r"(rw_scene_set_memory_limit\(rw_scene \*scene), uint64_t bytes"
STATISTICS_END = (r"^\} rw_scene_statistics;", r"    uint64_t more;\n\g<0>")
RAYS_END = (r"^\} rw_rays;", r"    uint64_t more;\n\g<0>")
SWAP_TIMES = [(r"double decide_ns;", "double swapped_ns;"), (r"double build_ns;( +/\* time)", r"double decide_ns;\1"),
              (r"double swapped_ns;", "double build_ns;")]

# What is done to the header, by regular expressions, and what the guard has to say to it.
CASES = [
    ("nothing", ACCEPTED, []),
    ("a new function", ACCEPTED, [(MEMORY_LIMIT, r"\g<0>\nRW_API int32_t rw_new(int32_t number);")]),
    ("a new constant", ACCEPTED, [(r"^#define RW_OK 0", r"\g<0>\n#define RW_NEW 77")]),
    ("a new status", ACCEPTED,
     [(r"^#define RW_STATUS_COUNT 32", "#define RW_ERROR_NEW 32\n#define RW_STATUS_COUNT 33")]),
    ("a later version", ACCEPTED, [(r"^#define RW_VERSION_MINOR 2", "#define RW_VERSION_MINOR 3")]),
    ("members appended to an input", ACCEPTED, [(r"^\} rw_rays;", r"    rw_array more;\n    uint64_t other;\n\g<0>")]),
    ("a member appended to a result", ACCEPTED, [STATISTICS_END]),
    ("members appended to a struct and to what it points to", ACCEPTED,
     [(r"^\} rw_(once_options|query_options);", r"    uint64_t more;\n\g<0>")]),
    ("a member appended to every struct with a struct_size", ACCEPTED,
     [(r"^\} rw_(?!array|output|ray;|hit;|ray_f32|hit_f32|primitive_id)\w+;", r"    uint64_t more;\n\g<0>")]),

    ("a function removed", REFUSED, [(MEMORY_LIMIT, "")]),
    ("a function renamed", REFUSED, [(r"rw_scene_set_memory_limit", "rw_scene_limit_memory")]),
    ("an argument narrowed", REFUSED, [(LIMIT_ARGUMENT, r"\1, uint32_t bytes")]),
    ("an argument's sign changed", REFUSED, [(LIMIT_ARGUMENT, r"\1, int64_t bytes")]),
    ("an argument more", REFUSED, [(LIMIT_ARGUMENT, r"\g<0>, uint64_t more")]),
    ("an argument less", REFUSED, [(LIMIT_ARGUMENT, r"\1")]),
    ("another handle", REFUSED, [(r"rw_mesh_retain\(const rw_mesh", "rw_mesh_retain(const rw_profile")]),
    ("the returned type", REFUSED, [(r"int32_t (rw_scene_set_memory_limit)", r"int64_t \1")]),
    ("a callback's argument", REFUSED, [(r"void \*user, double fraction,", "void *user, float fraction,")]),
    ("a callback in a callback", REFUSED,
     [(r"void \*task_data, uint64_t index\)", "void *task_data, uint32_t index)")]),
    ("a member inserted", REFUSED, [(r"rw_array origin;", r"uint64_t inserted;\n    \g<0>")]),
    ("a member inserted and one appended", REFUSED,
     [(r"rw_array origin;", r"uint64_t inserted;\n    \g<0>"), RAYS_END]),
    ("a member's type changed", REFUSED, [(r"double decide_ns;", "uint64_t decide_ns;")]),
    ("a member's type changed and one appended", REFUSED,
     [(r"double decide_ns;", "uint64_t decide_ns;"), STATISTICS_END]),
    ("a member narrowed, padding in its place", REFUSED,
     [(r"uint64_t degenerate_triangles;", "uint32_t degenerate_triangles;")]),
    ("a nested struct exchanged and a member appended", REFUSED,
     [(r"rw_array direction;", "rw_output direction;"), RAYS_END]),
    ("two members of one type change places", REFUSED, SWAP_TIMES),
    ("two members change places and one is appended", REFUSED, [*SWAP_TIMES, STATISTICS_END]),
    ("the last member removed", REFUSED, [(r"^    uint64_t refits;.*\n", "")]),
    ("a member removed and one appended", REFUSED, [(r"^    double decide_ns;.*\n", ""), STATISTICS_END]),
    ("an array's length", REFUSED, [(r"double origin\[3\];(?= +/\* RW_VIEW_POINT)", "double origin[4];")]),
    ("a member appended to rw_ray, which has no struct_size", REFUSED, [(r"^\} rw_ray;", r"    double time;\n\g<0>")]),
    ("a member appended to rw_hit, which has no struct_size", REFUSED, [(r"^\} rw_hit;", r"    double time;\n\g<0>")]),
    ("a member appended to rw_hit_f32, which has no struct_size", REFUSED,
     [(r"^\} rw_hit_f32;", r"    float time;\n\g<0>")]),
    ("a member appended to rw_array, which others hold", REFUSED, [(r"^\} rw_array;", r"    int64_t more;\n\g<0>")]),
    ("the same and one appended to its holder", REFUSED, [(r"^\} rw_array;", r"    int64_t more;\n\g<0>"), RAYS_END]),
    ("struct_size moved from the front", REFUSED,
     [(r"(typedef struct rw_rays \{\n)( +uint32_t struct_size;\n)( +uint32_t flags; .*\n)", r"\1\3\2")]),
    ("a constant's value", REFUSED, [(r"^#define RW_ERROR_CAPACITY 12", "#define RW_ERROR_CAPACITY 13")]),
    ("a constant's type", REFUSED, [(r"^#define RW_RAYS_LIMIT 1000000000000000ull", "#define RW_RAYS_LIMIT 1e15")]),
    ("a constant removed", REFUSED, [(r"^#define RW_RULE_HAPALA.*\n", "")]),
    ("another soname", REFUSED, []),
    ("another symbol version", REFUSED, []),
]


class Maker:
    """Makes doctored libraries in a folder of their own."""

    def __init__(self, compiler, folder):
        self.compiler, self.folder = compiler, folder

    def make(self, name, substitutions):
        place = self.folder / re.sub(r"\W+", "_", name)
        header = place / HEADER
        header.parent.mkdir(parents=True)
        header.write_text(doctored(RELEASED.read_text(), name, substitutions))
        source, script, library = place / "library.c", place / "library.map", place / "library.so"
        source.write_text(empty_functions(header.read_text()))
        version = "RAYWISE_2" if name == "another symbol version" else "RAYWISE_1"
        script.write_text(f"{version} {{ global: rw_*; local: *; }};")
        soname = "libraywise.so.2" if name == "another soname" else "libraywise.so.1"
        run([self.compiler, "-std=c99", "-g", "-shared", "-fPIC", f"-I{place}", f"-Wl,-soname,{soname}",
             f"-Wl,--version-script={script}", "-o", library, source])
        return place, library


def run(command):
    subprocess.run([str(word) for word in command], check=True)


def doctored(text, name, substitutions):
    for pattern, replacement in substitutions:
        text, count = re.subn(pattern, replacement, text, flags=re.MULTILINE)
        if count == 0:
            sys.exit(f"'{name}': {pattern} is not in the header")
    return text


def empty_functions(header):
    declarations = re.findall(r"^RW_API ([^;]*);", header, re.MULTILINE)
    return "#include <raywise/raywise.h>\n" + "".join(f"{each} {{ return 0; }}\n" for each in declarations)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--compiler", default="cc", help="C compiler")
    options = parser.parse_args()
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(options.compiler, Path(folder))
        place, library = maker.make("the release", [])
        earlier = ["--baselines", f"{folder}/baselines", "--previous", f"{folder}/previous",
                   "--compiler", options.compiler]
        run([ABI, "write", "--library", library, "--headers", place, *earlier])
        for name, wanted, substitutions in CASES:
            place, library = maker.make(name, substitutions)
            result = subprocess.run([ABI, "check", "--library", library, "--headers", place, *earlier],
                                    capture_output=True, text=True, check=False)
            good = result.returncode == wanted and (wanted == ACCEPTED or "NOT COMPATIBLE" in result.stdout)
            failures += not good
            print(f"{'ok' if good else 'FAILED'}: {name}: exit code {result.returncode}, wanted {wanted}")
            if not good:
                print(result.stdout + result.stderr)
    print(f"{len(CASES)} cases, {failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
