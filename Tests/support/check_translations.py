#!/usr/bin/env python3
"""Every text that users of the windows read is in the tables of Resources/translations, and nothing else is.

Reads the string literals of the rooms with windows, and of what they show of rooms without. A literal is

- a text of the table, or the fixed part of a template there ("Points of " of "Points of {0:text}"), or
- no user text, by a rule or by the lists below, which say why.

Besides, every table has every text, each translation has the placeholders of its text, and no text is unused.
"""

import re
import sys
from pathlib import Path

WINDOWS = ("Source/editor", "Source/app", "Source/plugin")
DOCUMENT = ("Source/document",)

# Writers say what is lost; the editor lists it before an export. Besides those named here they are all files that add to
# a list of losses; readers do, too, of what is told at an import.
LOSSES = re.compile(r"Source/io/formats/(.*Writer|ClipFormat|.*SumLimit|.*AndroidEffects)\.cpp$")
LIST_OF_LOSSES = re.compile(r"\b(LossList|LossTrack|LossKind)\b")
READERS = re.compile(r"(Import|Reader)\.cpp$")

# The core says what an actuator changes of a clip, what of a scene is left out, what cannot feel alike, why an edit is
# refused and what is wrong with a measurement; the editor shows it.
CORE = [Path("Core/pacini") / name for name in (
    "clip/Clip.h", "clip/PackedClip.h", "simplify/Simplify.h", "synthesis/Scene.h",
    "synthesis/ClipAdaptation.h", "synthesis/CompilePlan.h", "synthesis/Culling.h", "synthesis/Transparency.h",
    "clip/edits/Clipboard.h", "clip/edits/TimeEdits.h",
    "linearize/RecordingChecks.h", "linearize/ResponseChecks.h", "linearize/SweepAnalysis.h")]

# Names of presets; what is said of the plugin's is for the command.
PRESETS = Path("Core/pacini/realtime/TranslatorPresets.h")
ENCODER_PRESETS = Path("Source/io/EncoderPresets.cpp")
ERRORS = Path("Core/pacini/foundation/Result.h")  # of the core, which windows show
STUDY_TEMPLATES = Path("Source/study/StudyTemplates.cpp")  # what each asks
FILE_NAMES = Path("Source/io/FileNames.h")  # why a preset cannot be called so
# Why a file cannot be read or written, and what its sound lacks.
FILE_ERRORS = [Path("Source/io") / name for name in (
    "FileHandle.cpp", "AtomicFile.cpp", "AudioReader.cpp", "ClipFile.cpp", "CommentChapters.cpp", "SampleWords.cpp",
    "SoundCodec.cpp", "SoundCues.cpp", "SoundMarkers.cpp", "SoundParts.cpp", "FilmSound.cpp", "InputFile.cpp",
    "CueSheet.cpp", "Id3Chapters.cpp", "Mp4Tables.cpp", "OnsetFile.cpp", "NumberTable.cpp",
    "TextMark.h", "JsonSource.h", "JsonText.cpp", "JsonTree.h", "Json5Cursor.h", "Json5Text.cpp", "FieldsHandler.h",
    "NearestName.h", "ReadWarnings.cpp", "SceneCheck.h")]
# Why a controller does not play, or plays less than it could.
DEVICE_ERRORS = [Path("Source/devices/HidrawController.cpp"), Path("Source/live/LivePad.cpp"),
                 Path("Source/live/OpenedController.cpp")]
# Readers of clips: an import lists what they warn of, and says why they refuse. All that is in the folders of formats.
CLIP_READERS = re.compile(r"Source/io/formats/(\w+/.*|ForeignText|JsonEntry)\.(cpp|h)$")

# What is wrong with settings files, which are the presets of windows.
SETTINGS_ERRORS = [Path("Source/io/FieldsReader.h"), Path("Source/io/Settings.cpp"), Path("Source/io/GivenParameters.cpp"),
                   Path("Source/io/LiveSettings.h"),
                   Path("Core/pacini/foundation/Description.h")]
RANGES = ("must be {0} to {1}", "must be a whole number, {0} to {1}")  # as checkValue() puts them together

# Files without a text for users of windows.
FILES = {
    "names in files": [
        "Source/app/editor/EditorSettings.cpp", "Source/app/editor/EditorSettings.h", "Source/document/Autosave.cpp",
        "Source/document/AudioReference.h", "Source/document/Base64.h",
        "Source/document/FolderFiles.cpp", "Source/document/RecentFiles.cpp", "Source/plugin/engine/PluginState.h"],
    "errors of project files, which name places in JSON; English, as the command prints errors of files": [
        "Source/document/EditFields.h", "Source/document/ProjectFields.h", "Source/document/ProjectJson.cpp", "Source/document/ProjectJson.h",
        "Source/document/OperationCheck.h", "Source/document/ProjectScene.cpp", "Source/document/EditLayer.cpp", "Source/document/ProjectEdits.cpp",
        "Source/plugin/engine/PluginState.cpp"],
    "the command line, which is English": ["Source/app/Settings.cpp", "Source/app/CommandLine.h",
                                              "Source/app/Display.h"],
    "units and values of parameters, which are the same in every language for hosts": [
        "Source/plugin/engine/ParameterText.cpp"],
    "the description of the LV2, and errors of building it": ["Source/plugin/engine/Lv2Parameters.cpp"],
    "what hosts show of parameters, ports and the CLAP plugin, the same in every language": [
        "Source/plugin/engine/ParameterGroups.cpp", "Source/plugin/clap/ClapDeclarations.h", "Source/plugin/clap/ClapEntry.cpp",
        "Source/plugin/clap/ClapEventLoop.cpp", "Source/plugin/clap/ClapPorts.cpp"],
    "codes of languages and names of fonts": [
        "Source/editor/Fonts.cpp", "Source/editor/Translation.cpp", "Source/editor/Translation.h"],
}

LITERALS = {
    "messages that list names of files, which are English": [
        ", not '{}'", "must be {}", "must be {}{}", "must be {}, not '{}'{}", "must be a list of {}", "has more than {} {}",
        "'{}' is not one of {}{}"],
    "names of products and of what devices are called": [
        "Pacini", "Pacini Editor", "PaciniEditor", "pacini-editor", " - Pacini Editor", "Noto Sans CJK JP",
        "Noto Sans JP", "Source Han Sans JP", "Hiragino Sans", "Yu Gothic UI", "Meiryo", "IPAexGothic", "IPAPGothic",
        "IPAGothic", "TakaoPGothic", "VL PGothic", "/usr/share/fonts/opentype/noto/NotoSansCJK-", "DualSense",
        "Joy-Con", "LRA 175 Hz", "LRA 235 Hz", "L5 wristband", "L5 test jig", "Coin ERM", "iPhone (Taptic)", "English", "A Framework for Audio-Tactile Signal Translation"],
    "names of threads, folders, settings and functions of libraries": [
        "XESetWireToError", "sf_strerror", "spd-say", "text", "exe", "study", "report", "pacini: ", "folder", "Pacini capture", "Pacini joysticks", "js", "/dev/input", "/dev/snd/seq", "joycon-hd-rumble", "erm-coin", "Pacini set-up", "Pacini clips", "Application Support", "~/.config", "quiet", "primary", "origin", "dark", "true", "GTK_THEME", "gtk-theme-name",
        "gtk-application-prefer-dark-theme", "max ", "fs ", "devices",
        "state", "recovery", "profiles", "Resources/demo", "share/pacini/demo", "pacini", "json", "wav", "pacb",
        "files", "clip", "Presets", "scale", ".sound-", "md", "demo", "pacini-demo", "flac", "plain drive",
        "analysis presets", "output presets", "character presets"],
    "names that Windows keeps for devices": ["CON", "PRN", "AUX", "NUL", "COM", "LPT"],
    "records of studies, which are the same file in every language": [
        "agreed: ", "the touch starts {:.3f} ms earlier", "stopped by the participant", "comfortable at ", "Pacini "],
    "what a measured delay lacks, which the page has own texts for": [
        "outputs", "inputs", "device", "touch", "are the same", "went away or changed"],
    "names that a new thing gets in the project, which is the same file in every language": [
        "capture ", "loop {}", "chapter {}", "Marker ", "Group ", "Group", "-", "the actuator that is measured", "the measurement"],
    "the command line and its log, which are English": [
        "Pacini: ", "PaciniEditor: ", "Pacini: no sound device: ", "STUDY", "Run a study: its folder or file",
        "Fill the screen with the study", "--fresh", "FILE", "TYPE", "CODE",
        "Pacini Editor: sounds become clips that can be reshaped, felt and exported.",
        "Sounds, clips of any known format, folders of them, or a project",
        "Start with the default settings, and leave the saved ones as they are",
        "Kind of sound device, such as ALSA or JACK", "Of menus and controls: en or "],
    "names of files of sounds and profiles": [
        "ui_click", "notification", "heartbeat", "footsteps", "weapon", "explosion", "engine_loop", "rain", "texture",
        "music_bed", "click_clock", "drums_tabla_pattern", "impact_boom", "iter_drum_roll", "knock_wood_bridge",
        "pluck_guitar_harmonics", "sweep_spring_up", "texture_river", "phone-taptic", "l5-wristband", "dualsense-voice-coil"],
    "places in errors and identifiers": [
        "must be a whole number",        "plays[",         "sample rate", "sound", "strength", "lane", "format", "plays[0]", ".bands", "' is not known",
        "channels[", "sweep.", "measurement.", "sweeps[", "clock", "channels"],
    "names of parameters, by which their descriptions are found": [
        "bands", "low", "high", "breakpoints", "sensitivity", "audible", "speech", "quantise"],
    "errors of settings that the windows cannot make": ["must be 8 to 768 kHz to be encoded", "must be 0 to 1",
        "must have 1 to 8 actuators",
        "is not one of the project's sounds"],
    "what libsndfile says, which other words take the place of": ["internal error", "file does not exist",
        "unspecified internal error", "No 'data' chunk marker"],
    "what ffmpeg says, which is counted": [" audio samples of silence", " audio samples"],
    "names in files of formats": ["Simple Parametric", "noise {} {}"],
    "codes of languages": ["en", "ja"],
    "what the library of JSON says, which stays as it is": ["invalid string: ", "invalid number; ", "; last read: "],
    "a file of source that is written, and names in files": ["/* XR_FB_haptic_pcm:", "Vibrotactile Texture"],
    "a place, of which the table has the template": ["line 1, column 1"],
    "an escape in the spelling of the table": [r"is not a valid escape; write \\x and two digits"],
}

# Texts of JUCE's own components, which look in the table, too.
JUCE = {"OK", "(no choices)", "Select All",
        "file:", "Open", "New Folder", "Create Folder",
        "Go up to parent directory", "Overwrite", "File already exists", "There's already a file called: FLNM",
        "Are you sure you want to overwrite it?", "Please enter the name for the folder", "Couldn't create the folder!", "Home folder",
        "Documents", "Desktop", "Pictures", "Choose"}

UNITS = {"Hz", "kHz", "dB", "ms", "s", "W", "ppm", "bit", "ch", "st", "k", "x", "Q", "m", "s²"}

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((.*?)\)\1"|"(?:\\.|[^"\\\n])*"(?:\s*"(?:\\.|[^"\\\n])*")*'
                   r"|'(?:\\.|[^'\\])'", re.S)
PART = re.compile(r'"((?:\\.|[^"\\\n])*)"')
PLACEHOLDER = re.compile(r"\{[^{}]*\}")


def literals(path):
    """Line and text of the string literals of a source; those side by side are one."""
    text = path.read_text(encoding="utf-8")
    for match in TOKEN.finditer(text):
        token = match.group(0)
        if not token.startswith('"'):
            continue
        before = text[text.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        if before.startswith("#include") or "static_assert" in before or 'extern "C"' in before:
            continue
        yield text.count("\n", 0, match.start()) + 1, "".join(PART.findall(token)).replace("\\n", "\n")


def numbered(text):
    """The placeholders of fmt, or of a message, as the plain ones of the table; values side by side are one."""
    text = re.sub(r"(\{\}){2,}", "{}", text)
    count = iter(range(100))
    return PLACEHOLDER.sub(lambda m: re.sub(r":.*", "}", m.group(0)) if re.match(r"\{\d+[:}]", m.group(0))
                           else "{%d}" % next(count), text)


def is_text(text, name):
    """Whether a literal may be a text that someone reads."""
    plain = PLACEHOLDER.sub(" ", text)
    words = re.findall(r"[^\W\d_]+", plain)
    if not any(len(word) > 1 for word in words) or all(word in UNITS for word in words):
        return False
    if re.fullmatch(r"[*.~/\w;-]*\.[a-z0-9]{1,10}([;*.\w]*)?", text) or text.startswith(("--", "\\x", ":")):
        return False
    if re.fullmatch(r"No actuator \(flat\) \d+", text):
        return False  # numbers of profiles to come, which only lists of hosts show
    if re.fullmatch(r"[a-z]+([A-Z][a-z0-9]*|\d)+", text):
        return False  # an identifier
    if name == "reader":  # its sentences have signs of files and comparisons in them
        return " " in text.strip() and not re.search(r"[#\n\t]|;$|import |\{\{|^[^a-z]*: \{\}$", text)
    if name.startswith("Source/io"):
        return " " in text.strip() and not re.search(r"[<>#=\n\t]|;$|\\\"|import |\{\{|: \{\}$", text)
    if name.startswith("Source/document") or name.endswith("ParameterTable.h"):
        return not re.fullmatch(r"[a-z-]+\d*", text) or text in ("travel", "heat")
    return True


def table(path):
    pairs = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith('"'):
            continue
        match = re.fullmatch(r'"((?:\\.|[^"\\])*)" = "((?:\\.|[^"\\])*)"', line)
        if not match:
            raise SystemExit(f"{path}:{number}: not \"text\" = \"translation\"")
        if match.group(1) in pairs:
            raise SystemExit(f"{path}:{number}: a second time: {match.group(1)}")
        pairs[match.group(1)] = match.group(2)
    return pairs


def tables_of(root):
    return {path.stem: table(path) for path in sorted((root / "Resources/translations").glob("*.txt"))}


def says_losses(path, name):
    """Whether a file of a format says what is lost when one is written."""
    if path.suffix == ".h" or READERS.search(name):
        return False
    return bool(LOSSES.search(name) or LIST_OF_LOSSES.search(path.read_text(encoding="utf-8")))


def check(root, tables):
    """What is wrong, a line each; and the texts that tables must have."""
    no_texts = {text for texts in LITERALS.values() for text in texts}
    skipped = {name for names in FILES.values() for name in names}
    wanted = {}
    quoting = set()  # what readers say, with texts in quotes, too
    for folder in WINDOWS + DOCUMENT + ("Source/io/formats",):
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix not in (".cpp", ".h") or name in skipped:
                continue
            if folder == "Source/io/formats" and not (says_losses(path, name) or CLIP_READERS.search(name)):
                continue
            for line, text in literals(path):
                reads = folder == "Source/io/formats" and not says_losses(path, name)
                if reads:
                    quoting.add(numbered(text))
                if text not in no_texts and is_text(text, "reader" if reads else name):
                    wanted.setdefault(numbered(text), f"{name}:{line}")
    for presets in (PRESETS, ENCODER_PRESETS):
        for line, text in literals(root / presets):
            if re.match(r"[A-Z0-9]", text):
                wanted.setdefault(text, f"{presets.as_posix()}:{line}")
    templates = (root / STUDY_TEMPLATES).read_text(encoding="utf-8")
    for match in re.finditer(r'\{"[\w-]+",\s*"([^"]*)",\s*("(?:\\.|[^"\\])*"(?:\s*"(?:\\.|[^"\\])*")*),\s*\d+(?:,\s*\w+)*\}',
                             templates):
        line = templates.count("\n", 0, match.start()) + 1
        for text in (match.group(1), "".join(PART.findall(match.group(2)))):
            wanted.setdefault(text, f"{STUDY_TEMPLATES.as_posix()}:{line}")
    shorter = {" (costs {0} dB)"}  # ends of sentences whose whole is in the table, with and without
    for source in (ERRORS, FILE_NAMES, *CORE, *FILE_ERRORS, *DEVICE_ERRORS, *SETTINGS_ERRORS):
        for line, text in literals(root / source):
            quoting.add(numbered(text))
            if text not in no_texts and numbered(text) not in shorter and is_text(text, "reader"):
                wanted.setdefault(numbered(text), f"{source.as_posix()}:{line}")
    for text in RANGES:
        wanted.setdefault(text, SETTINGS_ERRORS[-1].as_posix())
    problems = []
    for code, pairs in tables.items():
        keys = {numbered(key) for key in pairs}
        parts = {part for key in keys if "{" in key for part in PLACEHOLDER.split(key)}
        for text, place in wanted.items():
            lines = [line for line in text.split("\n") if line.strip()]
            # "line {0}", before ": " and what is wrong there
            if not all(line in keys or line in parts or not is_text(line, place) or
                       line + ": {%d}" % len(PLACEHOLDER.findall(line)) in keys for line in lines):
                problems.append(f"{place}: not in {code}.txt: {text!r}")
        literal = set(wanted) | {line for text in wanted for line in text.split("\n")} | quoting
        literal |= {part for text in wanted for part in PLACEHOLDER.split(text) if re.search(r"\w", part)}
        for key, translation in pairs.items():
            plain = numbered(key)
            if sorted(PLACEHOLDER.findall(key)) != sorted(PLACEHOLDER.findall(translation)):
                problems.append(f"{code}.txt: other placeholders: {key!r} = {translation!r}")
            if not translation.strip():
                problems.append(f"{code}.txt: no translation: {key!r}")
            used = plain in literal or key in JUCE
            if not used and "{" in key:
                fixed = [part for part in PLACEHOLDER.split(plain) if re.search(r"\w", part)]
                used = any(part in literal for part in fixed) and all(  # units and single words are no texts
                    part in literal or not is_text(part, "Source/io") for part in fixed)
            if not used:
                problems.append(f"{code}.txt: not used: {key!r}")
    return problems, wanted


def selftest(root):
    """Each kind of mistake is found."""
    tables = tables_of(root)
    german = tables["de"]
    del german["Go to start"]
    german["{0} points"] = "Punkte"
    german["A text that no window has"] = "Ein Text, den kein Fenster hat"
    german["Close"] = ""
    problems = "\n".join(check(root, tables)[0])
    missed = [kind for kind in ("not in de.txt: 'Go to start'", "other placeholders: '{0} points'",
                                "not used: 'A text that no window has'", "no translation: 'Close'")
              if kind not in problems]
    for text, wanted in (("Go to start", True), ("silent", True), (" dB", False), ("*.wav;*.flac", False),
                         ("snapToGrid", False), ("{0} Hz", False)):
        if is_text(text, "Source/editor/A.cpp") != wanted:
            missed.append(f"is_text({text!r})")
    print("\n".join(missed) if missed else "all found")
    return 1 if missed else 0


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    if sys.argv[2:] == ["--selftest"]:
        return selftest(root)
    problems, wanted = check(root, tables_of(root))
    for problem in problems:
        print(problem)
    print(f"{len(wanted)} texts, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
