#!/usr/bin/env python3
"""Checks the schema of profiles with an independent validator against what the library writes and refuses.

check_profile_schema.py PROFILE_TOOL SCHEMA PROFILES     exit 0 when both agree
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks.
BEYOND_SCHEMA = ("must be above lowFrequency", "is too high", "must be above the one before")


def check_written(tool, validator, schema, profiles):
    """All samples and shipped profiles keep to the schema, and use every member of it."""
    documents, used = [], set()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([tool, "write", folder], check=True)
        paths = sorted(Path(folder).iterdir()) + sorted(profiles.glob("*.json"))
        check(len(paths) >= 32, "not all profiles are there")
        for path in paths:
            document = common.strict_json(path.read_bytes())
            problems = [error.message for error in validator.iter_errors(document)]
            check(not problems, f"{path.name} breaks the schema: {problems[:3]}")
            common.same_order(document, schema["properties"], path.name)
            for name, value in document.items():
                check(name in schema["properties"], f"{path.name}: {name} is not in the schema")
                members = schema["properties"].get(name, {}).get("properties", {})
                used.add(name)
                if members and isinstance(value, dict):
                    common.same_order(value, members, f"{path.name}: {name}")
                    used.update(f"{name}.{member}" for member in value)
            for section in document.get("equalizer", []):
                common.same_order(section, schema["$defs"]["section"]["properties"], f"{path.name}: equalizer")
            documents.append(document)
    for name, sub in schema["properties"].items():
        for member in [name] + [f"{name}.{inner}" for inner in sub.get("properties", {})]:
            check(member in used, f"no profile was written with {member}")
    return documents


def main():
    tool, schema_path, profiles = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    schema = common.strict_json(schema_path.read_bytes())
    common.check_schema_itself(schema)
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema, profiles)
    common.check_agreement(tool, validator, documents, 20260102,
                           lambda where, message: message.startswith(BEYOND_SCHEMA), least=(100, 300, 3), rounds=1500)
    print("\n".join(common.failures) if common.failures else "schema and library agree")
    return 1 if common.failures else 0


if __name__ == "__main__":
    sys.exit(main())
