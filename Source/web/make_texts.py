#!/usr/bin/env python3
"""Texts of the web page in other languages, as modules that the page loads: texts/de.js, texts/ja.js.

make_texts.py FOLDER       writes them into FOLDER/texts
make_texts.py --check      every text that people read has a translation, and none is unused: exit 1 where not
make_texts.py --selftest   each kind of mistake is found
make_texts.py --list       the texts, in English

A text stands in Source/web/translations, or in Resources/translations when the windows have it too: one source for
each. The format is that of the windows' tables.
"""

import html.parser
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE, OWN, WINDOWS = ROOT / "Source/web/page", ROOT / "Source/web/translations", ROOT / "Resources/translations"
LANGUAGES = ("de", "ja")

# Literals that nobody reads, or that are the same in every language.
NO_TEXTS = {
    "names": {"Pacini", "CC0", "DualSense", "HTS"},
    "names of settings, keys and policies": {
        "pacini language",
        "pacini returns",
        "pacini work",
        "keep the rest",
        "button primary",
        "row ways",
        "11px system-ui, sans-serif",
        "12px system-ui, sans-serif",
        "Escape",
        "Arrow",
    },
}
# Errors of the package and the core that a visitor may see, and what programs say besides.
SHARED = {"package/sound-file.js", "package/module.js"}
ATTRIBUTES = ("aria-label", "aria-roledescription", "title", "label", "data-drop")
LITERAL = re.compile(r"""//[^\n]*|/\*.*?\*/|'((?:\\.|[^'\\\n])*)'|"((?:\\.|[^"\\\n])*)"|`(?:\\.|[^`\\])*`""", re.S)
# What is told of files of sounds, with values in it.
SENTENCE = re.compile(r"`((?:has|is|uses|states) [^`]*)`")
VALUE = re.compile(r"\$\{(?:[^{}]|\{[^{}]*\})*\}")
PLACEHOLDER = re.compile(r"\{\d(?::text)?\}")


class Markup(html.parser.HTMLParser):
    """Texts and names in a page."""

    def __init__(self):
        super().__init__()
        self.texts, self.silent = [], 0

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag in ("script", "style") or (tag != "html" and "lang" in given):
            self.silent += 1
        self.texts += [given[name] for name in ATTRIBUTES if given.get(name)]
        if given.get("name") == "description":
            self.texts.append(given["content"])

    def handle_endtag(self, tag):
        if tag in ("script", "style", "option") and self.silent:
            self.silent -= 1

    def handle_data(self, data):
        text = " ".join(data.split())
        if re.search(r"[^\W\d_]", text) and not self.silent:
            self.texts.append(text)


def literals(text):
    """String literals of a script with what stands before each."""
    for match in LITERAL.finditer(text):
        word = match.group(1) if match.group(1) is not None else match.group(2)
        if match.group(0).startswith("`"):  # calls within a template
            for inner in re.finditer(r"\$\{((?:[^{}]|\{[^{}]*\})*)\}", match.group(0)):
                yield from literals(inner.group(1))
        if word is not None:
            yield text[max(0, match.start() - 400) : match.start()], word.replace("\\'", "'").replace('\\"', '"')


def is_text(word, before):
    """Whether a literal is read by people: marked so, or a sentence."""
    if re.search(r"\b(t|told)\($", before) or re.search(
        r"\bcounted\((?:[^;'()]|\([^()]*\))*, (?:'[^']*',\s+)?$", before
    ):
        return True
    if re.search(r"(from|import|import\() ?$", before) or word in set().union(*NO_TEXTS.values()):
        return False
    return bool(re.search(r"[a-z]{2,} [a-z]{2,}|^[A-Z][a-z]+\b.* |^[A-Z][a-z]{3,}$", word)) and not re.search(
        r"^[.#\[(<]|[<>{]|^\w+Error$|^[A-Z][a-z]+[A-Z]", word
    )


def keys(root=ROOT):
    """Every English text, with where it is from."""
    found = {}

    def take(text, place):
        found.setdefault(text, place)

    for name in ("index.html", "guide.html"):
        markup = Markup()
        markup.feed((PAGE / name).read_text(encoding="utf-8"))
        for text in markup.texts:
            # Cards have their length in their words, and their names in those of their buttons.
            text = re.sub(r"^\d+\.\d s, ", "{0} s, ", text)
            text = re.sub(
                r"^(Play|Feel) (?=(?:Heartbeat|Knock|Footsteps|Tabla|Engine|Explosion|Rain|Button)).*",
                r"\1 {0:text}",
                text,
            )
            if text not in set().union(*NO_TEXTS.values()):
                take(text, name)
    for path in sorted(PAGE.glob("*.js")):
        if path.name in ("service-worker.js", "early.js", "text.js"):
            continue
        for before, word in literals(path.read_text(encoding="utf-8")):
            if is_text(word, before):
                take(word, path.name)
    take(", ", "text.js")
    for name in sorted(SHARED):
        for before, word in literals((ROOT / "Source/web" / name).read_text(encoding="utf-8")):
            if re.search(r"(bad\(|message: )$", before):
                take(word, name)
    for name in ("package/sound-file.js", "package/sound-markers.js", "package/sound-words.js"):
        for sentence in SENTENCE.findall((ROOT / "Source/web" / name).read_text(encoding="utf-8")):
            count = iter(range(10))
            take(VALUE.sub(lambda _: f"{{{next(count)}}}", sentence), name)
    for template in (
        "is no clip in a format that is read",
        "has chapters in an ID3 tag, which are not read here",
        "has a marker behind the end of its sound, which is left out",
        "The page's module cannot be loaded ({0}). Load the page again.",
        "{0:text} cannot be read any more: it was moved or changed. Open it again.",
    ):
        take(template, "worker.js")
    for path in sorted((ROOT / "Resources/docs/guide").glob("*.md")):
        take(path.read_text(encoding="utf-8").split("\n")[0].removeprefix("# "), path.name)
    for path in sorted((ROOT / "profiles").glob("*.json")):
        profile = json.loads(path.read_text(encoding="utf-8"))
        take(profile.get("shortName", profile["name"]), path.name)
    for name in ("l5-wristband", "dualsense-voice-coil", "joycon-hd-rumble", "lra-175", "erm-coin"):  # of a figure
        take(json.loads((ROOT / f"profiles/{name}.json").read_text(encoding="utf-8"))["name"], name)
    for preset in re.findall(
        r'"name": "([\w-]+)", "purpose": "([^"]+)"',
        (ROOT / "Source/web/package/presets.js").read_text(encoding="utf-8"),
    ):
        take(preset[0].capitalize().replace("-", " "), "presets.js")
        take(preset[1], "presets.js")
    return found


def table(path):
    pairs = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line or line.startswith(("#", "language:", "countries:")):
            continue
        match = re.fullmatch(r'"((?:\\.|[^"\\])*)" = "((?:\\.|[^"\\])*)"', line)
        if not match:
            raise SystemExit(f'{path}:{number}: not "text" = "translation"')
        key, value = (part.replace('\\"', '"') for part in match.groups())
        if key in pairs:
            raise SystemExit(f"{path}:{number}: a second time: {key}")
        pairs[key] = value
    return pairs


def formats_of(code):
    """What writers of formats say of what they keep and lose, which the windows' table has in sections of its own."""
    text = (WINDOWS / f"{code}.txt").read_text(encoding="utf-8")
    sections = re.findall(r"^# io/formats[^\n]*\n(.*?)(?=^# |\Z)", text, re.S | re.M)
    wanted = dict(re.findall(r'^"((?:\\.|[^"\\])*)" = "((?:\\.|[^"\\])*)"$', "\n".join(sections), re.M))
    return {key.replace('\\"', '"'): value.replace('\\"', '"') for key, value in wanted.items()}


def translations(code, wanted):
    """The table that the page gets."""
    own, windows = table(OWN / f"{code}.txt"), table(WINDOWS / f"{code}.txt")
    made = {key: own.get(key, windows.get(key)) for key in wanted}
    return {**formats_of(code), **{key: value for key, value in made.items() if value is not None}}


def problems_of(wanted, own, windows, code):
    """What is wrong with a table, a line each."""
    formats = formats_of(code)
    for key, place in wanted.items():
        if key not in own and key not in windows:
            yield f"{place}: not in translations/{code}.txt: {key!r}"
    for key, value in own.items():
        if key not in wanted:
            yield f"translations/{code}.txt: not used: {key!r}"
        if key in windows and (key in formats or own[key] == windows[key]):
            yield f"translations/{code}.txt: the windows have it too: {key!r}"
        if sorted(PLACEHOLDER.findall(key)) != sorted(PLACEHOLDER.findall(value)):
            yield f"translations/{code}.txt: other placeholders: {key!r} = {value!r}"
        if not value.strip() and key.strip():
            yield f"translations/{code}.txt: no translation: {key!r}"


def check():
    wanted = keys()
    problems = [
        one
        for code in LANGUAGES
        for one in problems_of(wanted, table(OWN / f"{code}.txt"), table(WINDOWS / f"{code}.txt"), code)
    ]
    for code in LANGUAGES:
        there = {path.name for path in (OWN / "guide" / code).glob("*.md")}
        problems += [
            f"translations/guide/{code}: {path.name} is missing"
            for path in sorted((ROOT / "Resources/docs/guide").glob("*.md"))
            if path.name not in there
        ]
    for path in sorted(PAGE.glob("*.js")):
        # A sentence with values in it is a template of t(), so that it can be translated.
        if path.name in ("service-worker.js", "text.js", "worker.js"):
            continue
        for match in LITERAL.finditer(path.read_text(encoding="utf-8")):
            if match.group(0).startswith("`"):
                plain = re.sub(r"\$\{(?:[^{}]|\{[^{}]*\})*\}", "", match.group(0))
                if (
                    "${" not in plain
                    and re.search(r"[A-Za-z]{2,} [a-z]{2,}", plain)
                    and not re.search(r"pacini work|rgb|<p", plain)
                ):
                    problems.append(f"{path.name}: a sentence that is not translated: {plain[:60]}")
    problems += phone_problems()
    print("\n".join([*problems, f"{len(wanted)} texts, {len(problems)} problems"]))
    return 1 if problems else 0


def phone_problems(folder=ROOT / "Source/phone/page"):
    """The same of the page for phones, which has both languages in one file."""
    wanted = set()
    for name in ("index.html", "pair.html"):
        markup = Markup()
        markup.feed((folder / name).read_text(encoding="utf-8"))
        wanted.update(markup.texts)
        wanted.update(re.findall(r' alt="([^"]+)"', (folder / name).read_text(encoding="utf-8")))
    script = (folder / "phone.js").read_text(encoding="utf-8")
    wanted.update(word for before, word in literals(script) if re.search(r"\bt\($", before))
    for before, word in literals(script):
        if re.search(r"[a-z]{2,} [a-z]{2,}", word) and word not in wanted:
            yield f"phone.js: a sentence that is not translated: {word!r}"
    parts = re.split(r"^  (de|ja): \{$", (folder / "texts.js").read_text(encoding="utf-8"), flags=re.M)
    for code, part in zip(parts[1::2], parts[2::2]):
        there = dict(re.findall(r"^    '((?:\\.|[^'])*)': '((?:\\.|[^'])*)',?$", part, re.M))
        yield from (f"phone/page/texts.js: not in {code}: {key!r}" for key in sorted(wanted - set(there)))
        yield from (f"phone/page/texts.js: not used in {code}: {key!r}" for key in sorted(set(there) - wanted))
        yield from (
            f"phone/page/texts.js: other placeholders in {code}: {key!r}"
            for key, value in there.items()
            if sorted(PLACEHOLDER.findall(key)) != sorted(PLACEHOLDER.findall(value))
        )


def selftest():
    wanted = keys()
    own, windows = table(OWN / "de.txt"), table(WINDOWS / "de.txt")
    own.pop("Analysing...")
    own["A text that the page does not have"] = "Ein Text"
    own["Undo"] = windows["Undo"]
    own["On {0}."] = "Darauf."
    own["Cancelled."] = ""
    found = "\n".join(problems_of(wanted, own, windows, "de"))
    missed = [
        kind
        for kind in (
            "not in translations/de.txt: 'Analysing...'",
            "not used: 'A text that the page does not have'",
            "the windows have it too: 'Undo'",
            "other placeholders: 'On {0}.'",
            "no translation: 'Cancelled.'",
        )
        if kind not in found
    ]
    print("\n".join(missed) if missed else "all found")
    return 1 if missed else 0


def main():
    if sys.argv[1] == "--check":
        return check()
    if sys.argv[1] == "--selftest":
        return selftest()
    wanted = keys()
    if sys.argv[1] == "--list":
        print("\n".join(f"{place}: {key}" for key, place in wanted.items()))
        return 0
    folder = Path(sys.argv[1]) / "texts"
    folder.mkdir(exist_ok=True)
    for code in LANGUAGES:
        made = json.dumps(translations(code, wanted), ensure_ascii=False, indent=0)
        text = f"// Made by make_texts.py.\nexport default {made}\n"
        path = folder / f"{code}.js"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
