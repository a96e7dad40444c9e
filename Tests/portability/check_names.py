"""Programs include <windows.h> before the core: pacini.h and every header of the core compile behind a stand-in for its
macros.

check_names.py SOURCE EIGEN
"""
import subprocess
import sys
from pathlib import Path

SOURCE, EIGEN = Path(sys.argv[1]), sys.argv[2]
CORE = SOURCE / "Core"


def compiles(text):
    done = subprocess.run(["g++", "-std=c++20", "-fsyntax-only", f"-I{CORE}", f"-I{SOURCE}/Tests/portability",
                           "-isystem", EIGEN, "-x", "c++", "-"], input=text, capture_output=True, check=False, text=True)
    return done.returncode == 0, done.stderr


headers = sorted(path.relative_to(CORE).as_posix() for path in (CORE / "pacini").rglob("*.h"))
if len(headers) < 200:
    sys.exit("failed: where are the headers of the core?")
# min and max are kept by pacini.h alone; who includes other headers first defines NOMINMAX, as for the standard library.
ok, errors = compiles("\n".join([
    "#include <windows_macros.h>",
    "#include <pacini/pacini.h>",
    "#if !defined(min) || !defined(max)", "#error pacini.h took macros away", "#endif",
    "#undef min", "#undef max",
    *(f"#include <{header}>" for header in headers), ""]))
if not ok:
    sys.exit(f"failed:\n{errors}")
# The stand-in is seen: a name of its own kind does not compile.
if compiles("#include <windows_macros.h>\nint near = 1;\n")[0]:
    sys.exit("failed: macros of the stand-in do nothing")
print(f"{len(headers)} headers")
