#!/usr/bin/env python3
"""Checks the schema of scenes with an independent validator against what the library writes and refuses.

check_scene_schema.py SCENE_TOOL SCHEMA CLIP_SCHEMA TEXTURE_SCHEMA DEMO_SCENES     exit 0 when both agree
"""
import json
import re
import sys
from pathlib import Path

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks: what names and numbers refer to, and rules between members.
BEYOND_SCHEMA = re.compile(r"does not exist|which (several|no) |the name of several |the scene (lists|has) \d+ |is earlier than the|"
                           r"is later than the clip's|is longer than the clip|is needed, or a duration|"
                           r"needs lowFrequency|digits of a larger one|and the speeds before it|as many numbers as there are nodes|"
                           r"plays instead of a clip")


def bundled(schema, **inside):
    """The schema of scenes with those of clips and textures inside: validators differ in how they look up what is
    elsewhere."""
    whole = schema
    for kind, other in inside.items():
        inner = json.loads(json.dumps(other).replace("#/$defs/", f"#/$defs/{kind}-"))
        definitions = {f"{kind}-" + name: sub for name, sub in inner.pop("$defs").items()}
        del inner["$id"]
        whole = json.loads(json.dumps(whole).replace(f'"urn:pacini:{kind}:1"', f'"#/$defs/{kind}-document"'))
        whole["$defs"].update({**definitions, f"{kind}-document": inner})
    return whole


def check_written(tool, validator, schema, demo):
    documents = []
    for name, document in common.written(tool, validator, schema, beside=demo.glob("*.scene.json")):
        for kind, single in (("plays", "play"), ("changes", "change")):
            for item in document.get(kind, []):
                common.same_order(item, schema["$defs"][single]["properties"], f"{name}: {kind}")
        documents.append(document)
    check(len(documents) >= 21, "not all scenes are there")
    return documents[:20]


def beyond_schema(where, message):
    return (BEYOND_SCHEMA.search(message) is not None or where.endswith(".value")
            or common.beyond_schema(re.sub(r"^(clips|textures)\[\d+\]\.(clip|texture)\.", "", where), message))


def main():
    tool, schema_path, clip_path, texture_path, demo = sys.argv[1], *map(Path, sys.argv[2:6])
    schema, clip, texture = (common.strict_json(path.read_bytes()) for path in (schema_path, clip_path, texture_path))
    common.check_schema_itself(schema)
    validator = Draft202012Validator(bundled(schema, clip=clip, texture=texture))
    documents = check_written(tool, validator, schema, demo)
    small = [document for document in documents if len(json.dumps(document)) < 60000]
    check(len(small) > 5, "the samples are too large")
    common.check_agreement(tool, validator, small, 20260103, beyond_schema, least=(50, 200, 10), rounds=1000)
    return common.result()


if __name__ == "__main__":
    sys.exit(main())
