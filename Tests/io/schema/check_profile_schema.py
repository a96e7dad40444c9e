#!/usr/bin/env python3
"""Checks the schema of profiles with an independent validator against what the library writes and refuses.

check_profile_schema.py PROFILE_TOOL SCHEMA PROFILES     exit 0 when both agree
"""
import sys
from pathlib import Path

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks.
BEYOND_SCHEMA = ("must be above lowFrequency", "is too high", "must be above the one before")


def check_written(tool, validator, schema, profiles):
    """All samples and shipped profiles keep to the schema, and use every member of it."""
    documents, used = [], set()
    for file, document in common.written(tool, validator, schema, beside=profiles.glob("*.json")):
        for name, value in document.items():
            check(name in schema["properties"], f"{file}: {name} is not in the schema")
            members = schema["properties"].get(name, {}).get("properties", {})
            used.add(name)
            if members and isinstance(value, dict):
                common.same_order(value, members, f"{file}: {name}")
                used.update(f"{name}.{member}" for member in value)
        for section in document.get("equalizer", []):
            common.same_order(section, schema["$defs"]["section"]["properties"], f"{file}: equalizer")
        documents.append(document)
    check(len(documents) >= 32, "not all profiles are there")
    for name, sub in schema["properties"].items():
        for member in [name] + [f"{name}.{inner}" for inner in sub.get("properties", {})]:
            check(member in used, f"no profile was written with {member}")
    return documents


def main():
    tool, schema, profiles = sys.argv[1], common.opened_schema(sys.argv[2]), Path(sys.argv[3])
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema, profiles)
    common.check_agreement(tool, validator, documents, 20260102,
                           lambda where, message: message.startswith(BEYOND_SCHEMA), least=(100, 300, 3), rounds=1500)
    return common.result()


if __name__ == "__main__":
    sys.exit(main())
