#!/usr/bin/env python3
"""Serves a folder on this machine alone: serve.py FOLDER [PORT]

Of a file that has a compressed copy beside it (compress.py), browsers that take it get that.
"""
import functools
import http.server
import re
import sys
from pathlib import Path


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm",
                      ".js": "text/javascript", ".pacb": "application/octet-stream"}
    encoding = None  # of what is sent

    def send_head(self):
        self.encoding = None
        file = Path(self.translate_path(self.path))
        taken = re.split(r"[\s,;]+", self.headers.get("Accept-Encoding", ""))
        if file.is_dir():
            file /= "index.html"
        for name, suffix in (("br", ".br"), ("gzip", ".gz")):
            copy = file.with_name(file.name + suffix)
            if name in taken and copy.is_file():
                self.encoding = name
                there = self.path
                path, mark, query = there.partition("?")
                self.path = (path + "index.html" if path.endswith("/") else path) + suffix + mark + query
                try:
                    return super().send_head()
                finally:
                    self.path = there
        return super().send_head()

    def guess_type(self, path):
        return super().guess_type(re.sub(r"\.(br|gz)$", "", str(path)) if self.encoding else path)

    def end_headers(self):
        if self.encoding:
            self.send_header("Content-Encoding", self.encoding)
        self.send_header("Vary", "Accept-Encoding")
        self.send_header("Cache-Control", "no-cache")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Content-Security-Policy", "frame-ancestors 'none'")  # the pages say the rest
        super().end_headers()

    def log_message(self, *_):
        pass


folder, port = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8722
server = http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(Handler, directory=folder))
try:
    server.serve_forever()
except KeyboardInterrupt:
    sys.exit(0)
