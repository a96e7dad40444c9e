#!/usr/bin/env python3
"""Our declarations of CLAP (Source/plugin/clap/ClapDeclarations.h) have the layouts and values of those of others.

check_clap_abi.py COMPILER              compares them with clap_abi.txt; exit 0, 1 where one differs
check_clap_abi.py COMPILER FOLDER       compares the headers in a checkout of free-audio/clap with it, too
check_clap_abi.py COMPILER --make       writes clap_abi.txt from the crate clap-sys; needs Rust 1.77 and a network

clap_abi.txt has a line for each size, offset and value of 64-bit machines, by the names in C.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADER = HERE.parents[2] / "Source/plugin/clap/ClapDeclarations.h"
GOLDEN = HERE / "clap_abi.txt"
CRATE = "clap-sys"
VERSION = "0.5.0"  # which declares CLAP 1.2.2; what we use is the same in 1.2.10
YOUNGER = {"CLAP_VERSION_REVISION"}


def declared():
    """Structures with their fields, numbers and texts of our header."""
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(encoding="utf-8"), flags=re.DOTALL)
    structures = {}
    for name, body in re.findall(r"typedef struct (\w+) \{\n(.*?)\n\} \w+_t;", text, re.DOTALL):
        body = re.sub(r"union \{.*?\};", "void *specific;", body, flags=re.DOTALL)
        fields = []
        for line in body.splitlines():
            found = re.search(r"\(CLAP_ABI \*(\w+)\)|(\w+)(?:\[\w+\])?;$", line)
            fields.append(found[1] or found[2])
        structures[name] = fields
    numbers = re.findall(r"^ +(CLAP_\w+) = \d+,?$", text, re.MULTILINE)
    numbers += re.findall(r"^#define (CLAP_\w+) (?:\d+|UINT32_MAX)$", text, re.MULTILINE)
    texts = re.findall(r'^#define (CLAP_\w+) "', text, re.MULTILINE)
    return structures, numbers, texts


def lines_by_c(compiler, header, include):
    """What a compiler makes of a header."""
    structures, numbers, texts = declared()
    source = ["#include <stddef.h>", "#include <stdio.h>", f"#include {header}", "int main(void) {"]
    for name, fields in structures.items():
        source.append(f'printf("sizeof {name} %zu\\n", sizeof(struct {name}));')
        for field in fields:
            inner = "x11" if field == "specific" else field
            source.append(f'printf("offsetof {name} {field} %zu\\n", offsetof(struct {name}, {inner}));')
    source += [f'printf("{name} %lld\\n", (long long){name});' for name in numbers]
    source += [f'printf("{name} %s\\n", {name});' for name in texts]
    source.append("return 0; }")
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "abi"
        Path(folder, "abi.c").write_text("\n".join(source))
        subprocess.run([compiler, "-I", include, "-o", program, f"{folder}/abi.c"], check=True)
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


def lines_by_rust():
    """What Rust makes of the crate."""
    structures, numbers, texts = declared()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cargo", "init", "-q", "--vcs", "none", "--name", "abi", folder], check=True)
        subprocess.run(["cargo", "add", "-q", f"{CRATE}@={VERSION}"], check=True, cwd=folder)
        metadata = subprocess.run(
            ["cargo", "metadata", "--format-version", "1"], check=True, cwd=folder, capture_output=True
        )
        [sources] = {
            Path(path).parent / "src"
            for path in re.findall(r'"manifest_path":"([^"]*/clap-sys-[^"]*/Cargo\.toml)"', metadata.stdout.decode())
        }
        modules = [
            str(path.relative_to(sources).with_suffix("")).replace("/", "::").removesuffix("::mod")
            for path in sorted(sources.rglob("*.rs"))
            if path.stem != "lib" and "draft" not in path.parts
        ]
        source = ["#![allow(unused_imports, deprecated, ambiguous_glob_reexports)]"]
        source += [f"use clap_sys::{module}::*;" for module in modules]
        source.append("fn main() {")
        other = {"type": "type_"}
        for name, fields in structures.items():
            source.append(f'println!("sizeof {name} {{}}", std::mem::size_of::<{name}>());')
            source += [
                f'println!("offsetof {name} {field} {{}}", std::mem::offset_of!({name}, {other.get(field, field)}));'
                for field in fields
            ]
        source += [f'println!("{name} {{}}", {name});' for name in numbers]
        source += [f'println!("{name} {{}}", {name}.to_str().unwrap());' for name in texts]
        source.append("}")
        Path(folder, "src/main.rs").write_text("\n".join(source))
        return subprocess.run(
            ["cargo", "run", "-q"], check=True, cwd=folder, capture_output=True, text=True
        ).stdout.splitlines()


def differences(claim, lines):
    def wanted(line):
        return line.split(" ")[0] not in YOUNGER

    golden = [line for line in GOLDEN.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    differing = sorted({*filter(wanted, lines)} ^ {*filter(wanted, golden)})
    print("ok  " if not differing else "FAIL", f"{claim}: {len(lines)} sizes, offsets and values", differing[:10])
    return bool(differing)


def main():
    compiler, *rest = sys.argv[1:]
    if rest == ["--make"]:
        said = lines_by_rust()
        GOLDEN.write_text(
            f"# By {CRATE} {VERSION}: check_clap_abi.py --make\n" + "\n".join(said) + "\n", encoding="utf-8"
        )
        return 0
    failed = differences("our declarations", lines_by_c(compiler, f'"{HEADER}"', str(HEADER.parent)))
    for folder in rest:
        failed |= differences("CLAP's headers", lines_by_c(compiler, "<clap/clap.h>", f"{folder}/include"))
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
