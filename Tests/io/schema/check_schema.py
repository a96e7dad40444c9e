#!/usr/bin/env python3
"""Checks the schema of clips with an independent validator against what the library writes and refuses.

check_schema.py CLIP_TOOL SCHEMA BROKEN_FOLDER     exit 0 when both agree
"""
import copy
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError:
    system = "/usr/bin/python3"  # has the package on Debian and Ubuntu, unlike a virtual environment
    if os.path.exists(system) and os.environ.get("PACINI_SCHEMA_RETRY") is None:
        os.execve(system, [system] + sys.argv, dict(os.environ, PACINI_SCHEMA_RETRY="1"))
    sys.exit("check_schema.py: the JSON Schema validator is missing: install python3-jsonschema (4.0 or newer)")

failures = []

# What the schema cannot say and only the reader checks.
BEYOND_SCHEMA = (
    "is earlier than the",
    "is later than the clip's duration",
    "needs lowFrequency <= centreFrequency <= highFrequency",
)
# Here the range depends on other members: the duration and the lower edge.
RANGE_BEYOND_SCHEMA = re.compile(r"(transients|markers)\[\d+\]\.time|noise\[\d+\]\.highFrequency")


def check(condition, message):
    if not condition:
        failures.append(message)


def strict_json(data):
    """Parses bytes as RFC 8259 has it and refuses keys given twice."""

    def pairs(items):
        keys = [key for key, _ in items]
        if len(keys) != len(set(keys)):
            raise ValueError("a key is given twice")
        return dict(items)

    def constant(name):
        raise ValueError(name)

    return json.loads(data.decode("utf-8"), object_pairs_hook=pairs, parse_constant=constant)


def beyond_schema(where, message):
    if message.startswith("is outside"):
        return RANGE_BEYOND_SCHEMA.fullmatch(where) is not None
    return message.startswith(BEYOND_SCHEMA)


def read_with_library(tool, documents):
    """[None or (where, message)] for each document."""
    run = subprocess.run([tool, "read"], input=b"".join(d + b"\0" for d in documents), stdout=subprocess.PIPE, check=True)
    lines = run.stdout.decode("utf-8").splitlines()
    check(len(lines) == len(documents), f"{len(documents)} documents gave {len(lines)} answers")
    return [None if line == "ok" else tuple(line.split("\t")[1:3]) for line in lines]


def subschemas(schema, path="#"):
    yield path, schema
    for group in ("properties", "$defs"):
        for name, sub in schema.get(group, {}).items():
            yield from subschemas(sub, f"{path}/{group}/{name}")
    if isinstance(schema.get("items"), dict):
        yield from subschemas(schema["items"], path + "/items")


def check_schema_itself(schema):
    Draft202012Validator.check_schema(schema)
    for path, sub in subschemas(schema):
        # References start at the root, so each part brings the definitions with it.
        alone = {**sub, "$defs": schema["$defs"]}
        alone.pop("$id", None)
        for example in sub.get("examples", []):
            problems = list(Draft202012Validator(alone).iter_errors(example))
            check(not problems, f"{path}: its own example breaks it: {problems}")
        named = path.rsplit("/", 2)[-2] == "properties" if path != "#" else True
        check(not named or "description" in sub or "$ref" in sub, f"{path}: has no description")


UNWRITTEN = {"phase"}  # members that came later, which are not written at their default


def same_order(document, properties, where):
    order = [key for key in properties if key in document]
    check(list(document) == order, f"{where}: keys are {list(document)}, the schema has {list(properties)}")


def written(tool, validator, schema, beside=(), order=None):
    """Name and content of each sample that the tool writes, in this order, and of the files `beside`. All of them keep
    to the schema, and to the order of its members."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([tool, "write", folder], check=True)
        for path in sorted(Path(folder).iterdir(), key=order) + sorted(beside):
            document = strict_json(path.read_bytes())
            problems = [error.message for error in validator.iter_errors(document)]
            check(not problems, f"{path.name} breaks the schema: {problems[:3]}")
            same_order(document, schema["properties"], path.name)
            yield path.name, document


def check_written(tool, validator, schema):
    documents = []
    for name, document in written(tool, validator, schema, order=lambda path: int(path.stem)):
        check(set(document) == set(schema["properties"]), f"{name}: members differ from the schema's")
        for kind, single in (("bands", "band"), ("transients", "transient"), ("noise", "noiseBand"), ("markers", "marker")):
            for item in document[kind]:
                same_order(item, schema["$defs"][single]["properties"], f"{name}: {kind}")
                check(set(item) | UNWRITTEN == set(schema["$defs"][single]["properties"]) | UNWRITTEN,
                      f"{name}: {kind}: members differ")
                check(all(item.get(member, 1) != 0 for member in UNWRITTEN), f"{name}: {kind}: writes a default")
        documents.append(document)
    check(len(documents) == 20, "not all sample clips were written")
    return documents


def check_broken(tool, validator, folder):
    """Each broken document is refused by the JSON parser, the schema or only by the reader, as its table says."""
    table = json.loads((folder / "table.json").read_text(encoding="utf-8"))
    texts = [(folder / entry["file"]).read_bytes() for entry in table]
    for entry, text in zip(table, texts):
        try:
            refused_by = "schema" if list(validator.iter_errors(strict_json(text))) else "reader"
        except ValueError:
            refused_by = "json"
        check(refused_by == entry["by"], f"{entry['file']}: refused by {refused_by}, expected {entry['by']}")
    # A NUL byte would end the document on its way to the library.
    sendable = [(e, t) for e, t in zip(table, texts) if b"\0" not in t and t]
    for (entry, _), answer in zip(sendable, read_with_library(tool, [t for _, t in sendable])):
        check(answer is not None and answer[0] == entry["where"], f"{entry['file']}: the reader says {answer}")
    check(len(sendable) > 80, "the table of broken documents has shrunk")


def containers(value, path=()):
    if isinstance(value, (dict, list)):
        yield value, path
        for key, sub in value.items() if isinstance(value, dict) else enumerate(value):
            yield from containers(sub, path + (key,))


VALUES = [None, True, False, 0, -1, 1, 2, 0.5, 1e-4, -0.25, 999, 1001, 86401, 400001, 2**31, 1e9 + 1, "", "x", [], {}, [1], [{}], {"a": 1}]


def mutate(document, rng):
    """One fault, or one harmless change, anywhere in the document."""
    document = copy.deepcopy(document)
    places = [(c, p) for c, p in containers(document) if len(c) > 0]
    # Deep places are many: choose the depth first, so that every kind of member gets its share.
    depth = rng.choice(sorted({len(p) for _, p in places}))
    container, path = rng.choice([(c, p) for c, p in places if len(p) == depth])
    key = rng.choice(list(container) if isinstance(container, dict) else range(len(container)))
    kind = rng.randrange(4)
    if kind == 0:
        del container[key]
    elif kind == 1 and isinstance(container, dict):
        container["unknown" + str(rng.randrange(9))] = rng.choice(VALUES)
    else:
        container[key] = rng.choice(VALUES)
    return document, path + (key,)


# Objects whose members have any name: null is no value of theirs.
FREE_NAMES = {"encoder", "sources", "lowLabel", "highLabel", "question", "label", "text", "welcome", "consent", "goodbye"}


def without_nulls(value, name=""):
    """What the reader makes of null: the member is missing. The schema describes what is written and has none."""
    if isinstance(value, dict) and name not in FREE_NAMES:
        return {key: without_nulls(sub, key) for key, sub in value.items() if sub is not None}
    return [without_nulls(sub) for sub in value] if isinstance(value, list) else value


def check_agreement(tool, validator, documents, seed, is_beyond, least, rounds):
    """After one random change of a document, schema and reader have the same opinion, but for the rules of which
    is_beyond(where, message) says that the schema cannot know them. least: how many of the changes both accept, both
    refuse and only the reader refuses at the very least."""
    rng = random.Random(seed)
    changed = [mutate(rng.choice(documents), rng) for _ in range(rounds)]
    answers = read_with_library(tool, [json.dumps(document).encode("utf-8") for document, _ in changed])
    counts = {"both accept": 0, "both refuse": 0, "rule beyond the schema": 0}
    for (document, path), answer in zip(changed, answers):
        valid = validator.is_valid(without_nulls(document))
        if valid and answer is None:
            counts["both accept"] += 1
        elif not valid and answer is not None:
            counts["both refuse"] += 1
        elif valid and is_beyond(*answer):
            counts["rule beyond the schema"] += 1
        else:
            check(False, f"changed at {path}: schema {'accepts' if valid else 'refuses'}, reader says {answer}")
    print("agreement:", counts)
    for name, wanted in zip(counts, least):
        check(counts[name] >= wanted, f"only {counts[name]} changes where {name}: the test has become weak")


def opened_schema(path):
    schema = strict_json(Path(path).read_bytes())
    check_schema_itself(schema)
    return schema


def result():
    """The exit code, once all was checked."""
    print("\n".join(failures) if failures else "schema and library agree")
    return 1 if failures else 0


def main():
    tool, schema, broken = sys.argv[1], opened_schema(sys.argv[2]), Path(sys.argv[3])
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema)
    check_broken(tool, validator, broken)
    small = [d for d in documents if d["bands"] and len(json.dumps(d)) < 20000]
    check_agreement(tool, validator, small, 20260101, beyond_schema, least=(100, 300, 10), rounds=1500)
    return result()


if __name__ == "__main__":
    sys.exit(main())
