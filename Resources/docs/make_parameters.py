#!/usr/bin/env python3
"""Makes from the descriptions of parameters, which the command prints: tables of options in the documentation, the JSON
schema of settings, types for JavaScript and for Python.

make_parameters.py [--program PACINI] [--check]
    --program  else build/release/bin/pacini
    --check    changes nothing; exit 1 if a file is not as it would be made
"""
import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SCHEMA = "Resources/schema/pacini.settings.schema.json"
PRESETS = "Source/web/package/presets.js"
TYPES = "Source/web/package/index.d.ts"
LIVE_TYPES = "Source/web/package/translator.d.ts"
PYTHON = "Source/python/pacini/_options.py"
PAGES = ["Resources/docs/settings.md", "Resources/docs/getting-started.md"]
WIDTH = 120


def limits(one):
    if one["kind"] == "choice":
        return " or ".join(one["choices"])
    if "lowest" not in one:
        return ""
    return f"{one['lowest']} to {one['highest']}" + (f" {one['unit']}" if one["unit"] else "")


def usual(one):
    if one["kind"] == "truth" and "default" in one:
        return "on" if one["default"] else "off"
    return str(one.get("default", one.get("usually", "")))


def told(one):
    """The sentence, with range and default."""
    return f"{one['text']}{f' ({limits(one)})' if limits(one) and one['kind'] != 'choice' else ''} [{usual(one)}]"


def table(parameters, where):
    """`where`: the key of what has them, a column of its own, or nothing."""
    lines = ["| option | meaning | range |" + (f" {where} |" if where else "") + " default |",
             "|---|---|---|---|" + ("---|" if where else "")]
    for one in parameters:
        having = " " + ", ".join(one[where]) + " |" if where else ""
        lines.append(f"| `{one['option']}` | {one['text']} | {limits(one)} |{having} {usual(one)} |")
    return "\n".join(lines)


def filled(text, opening, closing, inside):
    """`text` with what stands between each two lines `opening` and `closing` made anew."""
    pattern = re.compile(rf"^([ ]*{opening}[ ]*\n)(?:.*\n)*?([ ]*{closing}[ ]*)$", re.M)
    assert pattern.search(text), f"{opening} is missing"
    return pattern.sub(lambda found: found[1] + inside(found) + "\n" + found[len(found.groups())], text)


def preset_table(presets):
    rows = [f"| `{preset['name']}` | {preset['purpose']} | {values(preset['values'])} |" for preset in presets]
    return "\n".join(["", "| preset | purpose | values |", "|---|---|---|", *rows, ""])


def script_presets(presets, usual_values):
    rows = [json.dumps({**preset, "values": {**usual_values, **preset["values"]}}) for preset in presets]
    return "// Made by Resources/docs/make_parameters.py.\n\nexport const presets = [\n  " + ",\n  ".join(rows) + "\n]\n"


def values(chosen):
    return ", ".join(f"{name} {value}" for name, value in chosen.items()) or "the defaults"


def page(text, described):
    def inside(found):
        part, group = found[2], found[3]
        chosen = [one for one in described[part] if one["group"] == group]
        assert chosen, f"nothing is in {part} {group}"
        return "\n" + table(chosen, {"Other methods": "methods", "Other formats": "formats"}.get(group)) + "\n"

    return filled(text, r"<!-- parameters: (\w+) ([\w ]+?) -->", "<!-- end -->", inside)


def schema_of(one):
    made = {"description": one["text"] + (f", {one['unit']}" if one.get("unit") else "")}
    if one["kind"] == "choice":
        made["enum"] = one["choices"]
    elif one["kind"] in ("truth", "text"):
        made["type"] = {"truth": "boolean", "text": "string"}[one["kind"]]
    else:
        made.update(type="integer" if one["kind"] == "whole" else "number", minimum=one["lowest"], maximum=one["highest"])
    if "default" in one:
        made["default"] = one["default"]
    return made


def play_schema(play):
    """The parts that say how clips are played, each with what its entries are."""
    def entries(listed):
        return {one["name"]: schema_of(one) for one in listed}

    return {
        **entries(play["pan"]),
        "outputs": {
            "description": "Haptic outputs beside each other, of the editor's preview. Encoding does not need them.",
            "type": "array", "maxItems": play["most"],
            "items": {"type": "object", "properties": entries(play["outputs"])}},
        "character": {
            "description": "The editor's live controls. Encoding does not need them.",
            "type": "object",
            "properties": entries(play["character"])},
        "live": {
            "description": "Live parameters of plugin and `pacini live`. Encoding does not need them.",
            "type": "object",
            "properties": entries(play["live"])}}


def schema(described, methods, presets, play):
    parts = {"encode": {
        "description": "Of encoding, as options of `pacini encode`. A method takes the parameters that it has.",
        "type": "object",
        "properties": {"method": {"description": "How sound is translated.", "enum": methods, "default": "a2vt"},
                       "preset": {"description": "Values for a kind of sound, of a2vt; other entries override it.", "enum": presets},
                       **{one["name"]: schema_of(one) for one in described["encode"]}}},
             "export": {
        "description": "Of formats of other programs. Each entry counts for the formats that have it.",
        "type": "object",
        "properties": {one["name"]: schema_of(one) for one in described["export"]}},
             **play_schema(play)}
    whole = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:pacini:settings:1",
        "title": "Pacini settings, version 1",
        "description": "Values of what can be set. What is left out keeps its default. Unknown keys are passed over with a warning.",
        "type": "object",
        "required": ["format", "version"],
        "properties": {"format": {"const": "pacini.settings"}, "version": {"const": 1}, **parts}}
    return json.dumps(whole, indent=2) + "\n"


def typed(text, described):
    script = {"number": "number", "whole": "number", "truth": "boolean"}

    def lines(part):
        made = []
        for one in described[part]:
            kind = script.get(one["kind"]) or " | ".join(f"'{choice}'" for choice in one["choices"])
            made.append(f"  /** {told(one)} */\n  {one['name']}?: {kind}")
        return "\n".join(made)

    return filled(text, r"// parameters: (\w+)", "// end", lambda found: lines(found[2]))


def types(text, described, presets):
    names = " | ".join(f"'{preset['name']}'" for preset in presets)
    text = filled(text, r"// presets", "// end of presets",
                  lambda _: f"  /** Values for a kind of sound; other options override it. */\n  preset?: {names}")
    return typed(text, described)


def python(described):
    kinds = {"number": "float", "whole": "int", "truth": "bool"}
    def options(name, summary, part):
        lines = ["", "", f"class {name}(TypedDict, total=False):", f'    """{summary}"""', ""]
        for one in described[part]:
            lines.append(f"    {one['option'][2:].replace('-', '_')}: Optional[{kinds.get(one['kind'], 'str')}]")
        return lines

    lines = ['"""Types of options; made by Resources/docs/make_parameters.py."""', "", "from typing import Optional, TypedDict", "",
             "from ._profile import AnyProfile",
             *options("EncodeOptions", "Options of encoding; None is the method's own.", "encode"),
             *options("ExportOptions", "Options of formats of other programs; None is the usual.", "export"),
             "    profile: Optional[AnyProfile]"]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n", 1)[1])
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/pacini")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()

    def reported(*words):
        done = subprocess.run([options.program.resolve(), *words, "--json"], capture_output=True, check=True)
        return json.loads(done.stdout)

    printed = reported("encode", "--print-settings")
    every, presets = printed["parameters"], printed["presets"]
    described = {part: [one for one in listed if one["kind"] != "profile"] for part, listed in every.items()}
    methods = [method["name"] for method in reported("encode", "--list-methods")["methods"]]
    varied = {name for preset in presets for name in preset["values"]}
    usual_values = {one["name"]: one["default"] for one in described["encode"] if one["name"] in varied}
    names = [preset["name"] for preset in presets]
    made = {PRESETS: script_presets(presets, usual_values), PYTHON: python(described),
            SCHEMA: schema(described, methods, names, printed["play"]), TYPES: types((ROOT / TYPES).read_text(), described, presets),
            LIVE_TYPES: typed((ROOT / LIVE_TYPES).read_text(), {"live": printed["play"]["live"]})}
    for name in PAGES:
        made[name] = page((ROOT / name).read_text(), every)
    made[PAGES[0]] = filled(made[PAGES[0]], "<!-- presets -->", "<!-- end of presets -->", lambda _: preset_table(presets))
    stale = [name for name, text in made.items() if not (ROOT / name).exists() or (ROOT / name).read_text() != text]
    for name in stale:
        if options.check:
            print(f"{name} is not as Resources/docs/make_parameters.py makes it")
        else:
            (ROOT / name).write_text(made[name])
            print("wrote", ROOT / name)
    return 1 if options.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
