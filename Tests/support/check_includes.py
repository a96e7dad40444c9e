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
    "analysis": {"foundation", "filters", "clip", "simplify", "hearing"},
    "actuator": {"foundation", "filters"},
    "linearize": {"foundation", "filters", "actuator"},
    "synthesis": {"foundation", "filters", "clip", "actuator", "linearize", "texture"},
    "hearing": {"foundation"},
    "texture": {"foundation", "filters", "clip"},
    "evaluate": {"foundation", "filters", "hearing"},
}
CORE["runtime"] = {"foundation", "clip", "actuator", "synthesis", "texture"}
CORE["realtime"] = set(CORE)
ALL = set(CORE)

# room of Source, a folder or one in it -> (rooms of Source that it may include, modules of JUCE that it may not).
# A room may include nothing that one of its rooms may not, so what holds for a line holds for all that it brings along.
NO_JUCE = ("juce",)
NO_WINDOWS = ("juce_gui_basics", "juce_gui_extra", "juce_audio_utils", "JuceHeader")
SOURCE = {
    "io": ({"io"}, NO_JUCE),
    "study": ({"io", "study"}, NO_JUCE),
    "phone": ({"io", "devices", "phone"}, NO_JUCE),
    "live": ({"io", "devices", "live"}, NO_JUCE),
    "cli": ({"io", "study", "devices", "live", "phone", "cli"}, NO_JUCE),
    "document": ({"io", "document"}, NO_JUCE),
    "devices": ({"devices"}, NO_JUCE),
    "library": ({"io", "devices", "library"}, NO_JUCE),
    "python": ({"io", "python"}, NO_JUCE),
    "web": ({"io", "document", "devices", "web"}, NO_JUCE),
    "plugin/engine": ({"io", "document", "devices", "live", "plugin/engine"}, NO_WINDOWS),
    "plugin/window": ({"io", "study", "document", "devices", "live", "editor", "plugin/engine", "plugin/window"}, ()),
    "plugin/clap": ({"io", "study", "document", "devices", "live", "editor", "plugin/engine", "plugin/window", "plugin/clap"}, ()),
    "plugin/mingw": ({"plugin/mingw"}, NO_JUCE),
    "editor": ({"io", "study", "document", "devices", "editor"}, ()),
    "app": ({"io", "study", "document", "devices", "live", "phone", "editor", "plugin/engine", "plugin/window", "app"}, ()),
}

# What Core must never touch: files, threads, clocks, JSON, hosts, and process-wide state.
CORE_FORBIDDEN = {
    "fstream", "iostream", "filesystem", "cstdio", "thread", "mutex", "shared_mutex", "condition_variable", "future",
    "chrono", "ctime", "csignal", "random", "istream", "ostream", "sstream", "iomanip", "syncstream", "stop_token",
    "semaphore", "latch", "barrier", "locale", "clocale",
}
# Libraries that only one room of Source touches.
ONLY_IN = {"sndfile": {"io"}, "hidapi": {"devices"}, "boost": {"study", "phone"}, "nanobind": {"python"},
           "rtaudio": {"live"}}
CORE_THIRD_PARTY = re.compile(r"^Eigen/")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def standard(name):
    return "/" not in name and "." not in name


def room_of(path, rooms):
    """The room in which a path (`plugin/engine/LiveEngine.h`) lies; its first folder when that is no room."""
    first, *rest = path.split("/")
    inner = "/".join([first, *rest[:1]])
    return inner if inner in rooms else first


def is_of(name, library):
    return name.lower().startswith(library.lower())


def leaks(rooms):
    """Rooms through which another one gets what it may not include."""
    for room, (others, forbidden) in rooms.items():
        for other in sorted(others):
            inner, kept_out = rooms[other]
            for more in sorted(inner - others):
                yield f"{room} may not include {more}, but gets it through {other}"
            for library in forbidden:
                if not any(is_of(library, kept) for kept in kept_out):
                    yield f"{room} may not include {library}, but gets it through {other}"


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
    yield from leaks(SOURCE)
    for path in sorted(p for p in root.glob("Source/**/*") if p.suffix in {".h", ".cpp", ".mm"}):
        place = path.relative_to(root / "Source")
        room = room_of(place.as_posix(), SOURCE)
        if room not in SOURCE:
            yield f"{path.relative_to(root)}: '{room}' is not a room of Source"
            continue
        rooms, forbidden = SOURCE[room]
        for number, kind, name in includes(path):
            where = f"{path.relative_to(root)}:{number}"
            if name.startswith("pacini/") and name.split("/")[1] not in ALL:
                yield f"{where}: no such room of Core"
            if any(is_of(name, library) for library in forbidden):
                yield f"{where}: {room} may not include <{name}>"
            for library, owners in ONLY_IN.items():
                if name.startswith(library) and room not in owners:
                    yield f"{where}: only {' and '.join(sorted(owners))} may include <{name}>"
            if kind == '"':
                other = room_of(name, SOURCE) if "/" in name else room
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
            "Source/document/M.h": "#include <juce_core/juce_core.h>\n",
            "Source/document/N.h": '#include "editor/clip/session/Session.h"\n',
            "Source/document/O.h": '#include "plugin/engine/LiveEngine.h"\n',
            "Source/plugin/P.h": "\n",
            "Source/plugin/engine/Q.h": '#include "editor/Theme.h"\n',
            "Source/plugin/engine/R.h": '#include "plugin/window/PluginWindow.h"\n',
            "Source/plugin/engine/S.h": "#include <juce_gui_basics/juce_gui_basics.h>\n",
            "Source/plugin/engine/T.h": "#include <juce_gui_extra/juce_gui_extra.h>\n",
            "Source/plugin/engine/U.h": "#include <juce_audio_utils/juce_audio_utils.h>\n",
            "Source/plugin/engine/V.h": '#include "plugin/PluginWindow.h"\n',
            "Source/plugin/window/W.h": '#include "app/AudioDevices.h"\n',
            "Source/editor/X.h": '#include "plugin/engine/LiveEngine.h"\n',
        }
        for name, text in cases.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = {line.split(":")[0]: line for line in violations(root)}
        for name in cases:
            (root / name).unlink()
        good = {
            "Core/pacini/filters/A.h": "#include <pacini/foundation/Units.h>\n#include <vector>\n#include <Eigen/Core>\n",
            "Source/plugin/engine/B.h": '#include "document/Project.h"\n#include "plugin/engine/A.h"\n'
                                        "#include <juce_audio_processors/juce_audio_processors.h>\n",
            "Source/plugin/window/C.h": '#include "editor/Theme.h"\n#include "plugin/engine/B.h"\n'
                                        "#include <juce_gui_basics/juce_gui_basics.h>\n",
        }
        for name, text in good.items():
            (root / name).write_text(text)
        clean = list(violations(root))
    # The table itself: a room that gets an editor, and one that gets windows, through another.
    through = [({**SOURCE, "document": ({"io", "document", "editor"}, NO_JUCE)}, "plugin/engine may not include editor"),
               ({**SOURCE, "io": ({"io"}, NO_WINDOWS)}, "document may not include juce"),
               ({**SOURCE, "io": ({"io"}, ())}, "plugin/engine may not include juce_gui_basics")]
    missed = [name for name in cases if name not in found] + \
             [wanted for table, wanted in through if not any(line.startswith(wanted) for line in leaks(table))]
    if missed or len(found) != len(cases) or clean:
        print("\n".join([*found.values(), *clean, *(f"not found: {name}" for name in missed)]))
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
