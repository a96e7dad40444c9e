#!/usr/bin/env python3
"""Checks the schema of textures with an independent validator against what the library writes and refuses.

check_texture_schema.py TEXTURE_TOOL SCHEMA     exit 0 when both agree
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks.
BEYOND_SCHEMA = ("must be above 0 and the speeds before it", "must have as many numbers as there are nodes")


def check_written(tool, validator, schema):
    """All samples keep to the schema, and use every member of it."""
    documents, used = [], set()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([tool, "write", folder], check=True)
        for path in sorted(Path(folder).iterdir()):
            document = common.strict_json(path.read_bytes())
            problems = [error.message for error in validator.iter_errors(document)]
            check(not problems, f"{path.name} breaks the schema: {problems[:3]}")
            common.same_order(document, schema["properties"], path.name)
            for node in document["nodes"]:
                common.same_order(node, schema["$defs"]["node"]["properties"], f"{path.name}: nodes")
            used.update(document)
            documents.append(document)
    check(len(documents) == 20, "not all samples are there")
    check(used == set(schema["properties"]), f"no texture was written with {set(schema['properties']) - used}")
    return documents


def main():
    tool, schema_path = sys.argv[1], Path(sys.argv[2])
    schema = common.strict_json(schema_path.read_bytes())
    common.check_schema_itself(schema)
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema)
    common.check_agreement(tool, validator, documents, 20260103,
                           lambda where, message: message.startswith(BEYOND_SCHEMA), least=(100, 300, 3), rounds=1500)
    print("\n".join(common.failures) if common.failures else "schema and library agree")
    return 1 if common.failures else 0


if __name__ == "__main__":
    sys.exit(main())
