#!/usr/bin/env python3
"""Checks the include lines of Core and Source against the table of rooms.

check_includes.py ROOT       exit 1 and a list of broken rules, or exit 0
check_includes.py --selftest proves that broken rules are found
"""
import re
import sys
import tempfile
from pathlib import Path

# room -> rooms of Core that it may include (itself is always allowed)
CORE = {
    "foundation": set(),
    "filters": {"foundation"},
    "clip": {"foundation"},
    "simplify": {"foundation", "clip"},
    "analysis": {"foundation", "filters", "clip", "simplify"},
    "actuator": {"foundation", "filters"},
    "linearize": {"foundation", "filters", "actuator"},
    "synthesis": {"foundation", "filters", "clip", "actuator", "linearize"},
    "evaluate": {"foundation", "filters"},
}
CORE["realtime"] = set(CORE)
ALL = set(CORE)

# room of Source -> (rooms of Core, rooms of Source, may include JUCE)
SOURCE = {
    "io": (ALL, {"io"}, False),
    "cli": (ALL, {"io", "devices", "cli"}, False),
    "document": (ALL, {"io", "document"}, False),
    "devices": (ALL, {"devices"}, False),
    "plugin": (ALL, {"io", "devices", "editor", "plugin"}, True),
    "editor": (ALL, {"io", "document", "devices", "editor"}, True),
    "app": (ALL, {"io", "document", "devices", "editor", "plugin", "app"}, True),
}

# What Core must never touch: files, threads, clocks, JSON, hosts, and process-wide state.
CORE_FORBIDDEN = {
    "fstream", "iostream", "filesystem", "cstdio", "thread", "mutex", "shared_mutex", "condition_variable", "future",
    "chrono", "ctime", "csignal", "random", "istream", "ostream", "sstream", "iomanip", "syncstream", "stop_token",
    "semaphore", "latch", "barrier", "locale", "clocale",
}
# Libraries that only one room of Source touches.
ONLY_IN = {"sndfile": "io", "hidapi": "devices"}
CORE_THIRD_PARTY = re.compile(r"^Eigen/")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def standard(name):
    return "/" not in name and "." not in name


def violations(root):
    root = Path(root)
    for path in sorted(root.glob("Core/pacini/**/*.h")):
        room = path.relative_to(root / "Core/pacini").parts[0]
        if room == "pacini.h":
            continue  # all of Core for guests; no room includes it
        if room not in CORE:
            yield f"{path.relative_to(root)}: '{room}' is not a room of Core"
            continue
        for number, kind, name in includes(path):
            where = f"{path.relative_to(root)}:{number}"
            if kind == '"':
                yield f"{where}: Core includes by <pacini/...>, not by \"{name}\""
            elif name.startswith("pacini/"):
                other = name.split("/")[1]
                if other != room and other not in CORE[room]:
                    yield f"{where}: {room} may not include {other}"
            elif name in CORE_FORBIDDEN:
                yield f"{where}: Core may not include <{name}>"
            elif not standard(name) and not CORE_THIRD_PARTY.match(name):
                yield f"{where}: Core may not include <{name}>"
    for path in sorted(p for p in root.glob("Source/**/*") if p.suffix in {".h", ".cpp", ".mm"}):
        room = path.relative_to(root / "Source").parts[0]
        if room not in SOURCE:
            yield f"{path.relative_to(root)}: '{room}' is not a room of Source"
            continue
        core, rooms, juce = SOURCE[room]
        for number, kind, name in includes(path):
            where = f"{path.relative_to(root)}:{number}"
            if name.startswith("pacini/") and name.split("/")[1] not in core:
                yield f"{where}: no such room of Core"
            if name.lower().startswith("juce") and not juce:
                yield f"{where}: {room} may not include JUCE"
            for library, owner in ONLY_IN.items():
                if name.startswith(library) and room != owner:
                    yield f"{where}: only {owner} may include <{name}>"
            if kind == '"':
                other = name.split("/")[0] if "/" in name else room
                if other not in rooms:
                    yield f"{where}: {room} may not include {other}"


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def selftest():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        cases = {
            "Core/pacini/filters/A.h": "#include <pacini/synthesis/Decoder.h>\n",
            "Core/pacini/clip/B.h": "#include <nlohmann/json.hpp>\n",
            "Core/pacini/clip/C.h": "#include <thread>\n",
            "Core/pacini/nowhere/D.h": "\n",
            "Source/io/E.cpp": '#include "cli/Progress.h"\n',
            "Source/cli/F.cpp": "#include <juce_core/juce_core.h>\n",
            "Source/io/G.h": '#include "JuceHeader.h"\n',
            "Source/cli/H.cpp": "#include <sndfile.h>\n",
            "Core/pacini/analysis/methods/I.h": "#include <pacini/synthesis/Decoder.h>\n",
            "Core/pacini/synthesis/J.h": '#include "Decoder.h"\n',
            "Core/pacini/realtime/K.h": "#include <sstream>\n",
            "Source/nowhere/L.cpp": "\n",
        }
        for name, text in cases.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = list(violations(root))
        good = root / "Core/pacini/filters/A.h"
        for name in cases:
            (root / name).unlink()
        good.write_text("#include <pacini/foundation/Units.h>\n#include <vector>\n#include <Eigen/Core>\n")
        clean = list(violations(root))
    if len(found) != len(cases) or clean:
        print("\n".join(found + clean))
        return 1
    return 0


def main():
    if sys.argv[1:] == ["--selftest"]:
        return selftest()
    found = list(violations(sys.argv[1]))
    print("\n".join(found) if found else "include rules: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
