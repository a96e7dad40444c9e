#!/usr/bin/env python3
"""Checks the schema of textures with an independent validator against what the library writes and refuses.

check_texture_schema.py TEXTURE_TOOL SCHEMA     exit 0 when both agree
"""
import sys

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks.
BEYOND_SCHEMA = ("must be above 0 and the speeds before it", "must have as many numbers as there are nodes")


def check_written(tool, validator, schema):
    """All samples keep to the schema, and use every member of it."""
    documents, used = [], set()
    for name, document in common.written(tool, validator, schema):
        for node in document["nodes"]:
            common.same_order(node, schema["$defs"]["node"]["properties"], f"{name}: nodes")
        used.update(document)
        documents.append(document)
    check(len(documents) == 20, "not all samples are there")
    check(used == set(schema["properties"]), f"no texture was written with {set(schema['properties']) - used}")
    return documents


def main():
    tool, schema = sys.argv[1], common.opened_schema(sys.argv[2])
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema)
    common.check_agreement(tool, validator, documents, 20260103,
                           lambda where, message: message.startswith(BEYOND_SCHEMA), least=(100, 300, 3), rounds=1500)
    return common.result()


if __name__ == "__main__":
    sys.exit(main())
