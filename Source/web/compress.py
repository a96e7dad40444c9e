#!/usr/bin/env python3
"""Puts compressed copies beside the texts and modules of a folder, where servers of static files look: compress.py FOLDER

FILE.gz by Python, FILE.br by the program brotli where it is there. What has a copy of the same content is passed over.
Scripts are served without lines that are comments, which are a tenth of what a first visit loads of them.
"""
import gzip
import re
import shutil
import subprocess
import sys
from pathlib import Path

COMMENTS = re.compile(rb"^[ \t]*(?://[^\n]*|/\*(?s:.*?)\*/[ \t]*)\n", re.M)
KINDS = {".js", ".html", ".css", ".wasm", ".txt", ".svg"}


def main():
    brotli = shutil.which("brotli")
    for path in sorted(Path(sys.argv[1]).rglob("*")):
        if path.suffix not in KINDS or not path.is_file():
            continue
        if path.suffix == ".js":
            path.write_bytes(COMMENTS.sub(b"", path.read_bytes()))
        content = path.read_bytes()
        packed, smaller = path.with_name(path.name + ".gz"), path.with_name(path.name + ".br")
        if packed.exists() and gzip.decompress(packed.read_bytes()) == content and (smaller.exists() or not brotli):
            continue
        packed.write_bytes(gzip.compress(content, 9, mtime=0))
        smaller.unlink(missing_ok=True)
        if brotli:
            subprocess.run([brotli, "--quality=11", "--output=" + str(smaller), str(path)], check=True)


if __name__ == "__main__":
    main()
