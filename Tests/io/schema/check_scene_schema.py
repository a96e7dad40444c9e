#!/usr/bin/env python3
"""Checks the schema of scenes with an independent validator against what the library writes and refuses.

check_scene_schema.py SCENE_TOOL SCHEMA CLIP_SCHEMA DEMO_SCENES     exit 0 when both agree
"""
import json
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks: what names and numbers refer to, and rules between members.
BEYOND_SCHEMA = re.compile(r"does not exist|which (several|no) |the scene (lists|has) \d+ |is earlier than the|"
                           r"is later than the clip's|is longer than the clip|is needed, or a duration|"
                           r"needs lowFrequency|digits of a larger one")


def bundled(schema, clip):
    """The schema of scenes with that of clips inside: validators differ in how they look up what is elsewhere."""
    inner = json.loads(json.dumps(clip).replace("#/$defs/", "#/$defs/clip-"))
    definitions = {"clip-" + name: sub for name, sub in inner.pop("$defs").items()}
    del inner["$id"]
    whole = json.loads(json.dumps(schema).replace('"urn:pacini:clip:1"', '"#/$defs/clip-document"'))
    whole["$defs"].update({**definitions, "clip-document": inner})
    return whole


def check_written(tool, validator, schema, demo):
    documents = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([tool, "write", folder], check=True)
        for path in sorted(Path(folder).iterdir()) + sorted(demo.glob("*.scene.json")):
            document = common.strict_json(path.read_bytes())
            problems = [error.message for error in validator.iter_errors(document)]
            check(not problems, f"{path.name} breaks the schema: {problems[:3]}")
            common.same_order(document, schema["properties"], path.name)
            for kind, single in (("plays", "play"), ("changes", "change")):
                for item in document.get(kind, []):
                    common.same_order(item, schema["$defs"][single]["properties"], f"{path.name}: {kind}")
            documents.append(document)
    check(len(documents) >= 21, "not all scenes are there")
    return documents[:20]


def check_agreement(tool, validator, documents, rounds=1000):
    """After one random change, schema and reader have the same opinion, but for the rules beyond the schema."""
    rng = random.Random(20260103)
    small = [document for document in documents if len(json.dumps(document)) < 60000]
    check(len(small) > 5, "the samples are too large")
    changed = [common.mutate(rng.choice(small), rng) for _ in range(rounds)]
    answers = common.read_with_library(tool, [json.dumps(document).encode() for document, _ in changed])
    counts = {"both accept": 0, "both refuse": 0, "rule beyond the schema": 0}
    for (document, path), answer in zip(changed, answers):
        valid = validator.is_valid(document)
        if valid and answer is None:
            counts["both accept"] += 1
        elif not valid and answer is not None:
            counts["both refuse"] += 1
        elif valid and (BEYOND_SCHEMA.search(answer[1]) or answer[0].endswith(".value")
                        or common.beyond_schema(re.sub(r"^clips\[\d+\]\.clip\.", "", answer[0]), answer[1])):
            counts["rule beyond the schema"] += 1
        else:
            check(False, f"changed at {path}: schema {'accepts' if valid else 'refuses'}, reader says {answer}")
    print("agreement:", counts)
    for name, least in (("both accept", 50), ("both refuse", 200), ("rule beyond the schema", 10)):
        check(counts[name] >= least, f"only {counts[name]} changes where {name}: the test has become weak")


def main():
    tool, schema_path, clip_path, demo = sys.argv[1], *map(Path, sys.argv[2:5])
    schema, clip = (common.strict_json(path.read_bytes()) for path in (schema_path, clip_path))
    common.check_schema_itself(schema)
    validator = Draft202012Validator(bundled(schema, clip))
    check_agreement(tool, validator, check_written(tool, validator, schema, demo))
    print("\n".join(common.failures) if common.failures else "schema and library agree")
    return 1 if common.failures else 0


if __name__ == "__main__":
    sys.exit(main())
