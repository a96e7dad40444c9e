#!/usr/bin/env python3
"""Checks the schema of studies with an independent validator against what the library writes and refuses.

check_study_schema.py STUDY_TOOL SCHEMA     exit 0 when both agree
"""

import sys

import check_schema as common
from check_schema import Draft202012Validator, check

# What the schema cannot say and only the reader checks: names that lead somewhere, and numbers that hang on others.
BEYOND_SCHEMA = (
    "must be above low",
    "must be above 0 and at most step",
    "must be above 0",
    "no stimulus is called",
    "no group is called",
    "another one is called, too",
    "has more than one of",
    "has nothing to feel",
    "is held against",
    "leaves nothing",
    "needs two at least",
    "too many for one page",
    "not a translation method",
    "has both",
    "needs two stimuli at least",
    "is not a single event",
    "is in the mix twice",
    "needs two actuators at least",
    "belong to kind choice",
    "belong to the task questionnaire",
    "needs two at least, to choose from",
    "must make a scale of at most 20 points",
    "without the place that is asked for",
    "needs two events at least",
    "different events; 12 are the most",
    "has a level that is felt and a mix",
)
# Ranges that hang on other members.
PLACES_BEYOND_SCHEMA = (".adaptive.start", ".scale.step", "masking.highFrequency", ".tone.fade", ".adaptive.highest")


def beyond_schema(where, message):
    # Stimuli are needed where a block is no questionnaire.
    return (any(text in message for text in BEYOND_SCHEMA) or where.endswith(PLACES_BEYOND_SCHEMA)
            or (where, message) == ("stimuli", "has none"))


def check_written(tool, validator, schema):
    documents, used = [], set()
    for name, document in common.written(tool, validator, schema):
        used.update(document)
        for kind, entries in (("stimulus", document.get("stimuli", [])), ("block", document["blocks"])):
            for entry in entries:
                common.same_order(entry, schema["$defs"][kind]["properties"], f"{name}: {kind}")
                used.update(f"{kind}.{member}" for member in entry)
        documents.append(document)
    known = set(schema["properties"])
    for kind in ("stimulus", "block"):
        known.update(f"{kind}.{member}" for member in schema["$defs"][kind]["properties"])
    check(used == known, f"schema and studies differ in {sorted(used ^ known)}")
    return documents


def main():
    tool, schema = sys.argv[1], common.opened_schema(sys.argv[2])
    validator = Draft202012Validator(schema)
    documents = check_written(tool, validator, schema)
    common.check_agreement(tool, validator, documents, 20261127, beyond_schema, least=(100, 300, 10), rounds=1500)
    return common.result()


if __name__ == "__main__":
    sys.exit(main())
